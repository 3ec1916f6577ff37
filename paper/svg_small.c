/* svg_small.c - a figure made small enough for a page that holds all of them.
 *
 * gnuplot writes a coloured path as thousands of separate lines, each with its colour, to a hundredth of a
 * pixel. On the page a figure is some hundred pixels wide, so that this much is not seen:
 *
 *     <path stroke='rgb(18, 63, 140)'  d='M1.01,1.02 L2.03,3.04  '/>
 *     <path stroke='rgb(18, 64, 141)'  d='M2.03,3.04 L3.05,5.06  '/>   -->   <path stroke='#138' d='M1,1l1,2 1,2.1'/>
 *
 * Lines that go on where the last one ended, in a colour that is hardly another, become one path; of points on
 * a straight line only the ends stay; places are rounded to a tenth of a pixel, and told from the last one.
 * Everything else keeps its meaning.  The file beside the page has it all.
 */
#include "paper/svg_small.h"

#include <festoon/festoon_tools.h>

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A coloured path's red, green and blue have 16 steps of 0 to 255, and stay as long as they are no further off.
 */
enum { COLOUR_STEP = 17, SAME_COLOUR = 14 };
/* A point is left out if it lies within so many pixels of the line through its neighbours, and at most so many
 * in turn. */
static const double ON_LINE = 0.2;
enum { MOST_LEFT_OUT = 6 };

typedef struct point {
    double x, y;
} point;

/* The place at which the pen stands, in tenths of a pixel. */
typedef struct pen {
    long x, y;
} pen;

/* A path of lines in one colour that may still go on. */
typedef struct stroke {
    int open, colour[3], left_out;
    point last[2]; /* the last two points: written, and not yet written */
    pen at;
} stroke;

typedef struct small {
    FILE *out;
    fst_printed printed; /* what goes into `out` */
    stroke path;
    char *group; /* an opened <g ...> whose content is still to come; NULL: none */
} small;

/* ------------------------------------------------------------------ places */

static void put_tenths(FILE *out, long tenths)
{
    const long size = labs(tenths);
    (void)fputs(tenths < 0 ? "-" : "", out);
    if (size >= 10 || size == 0)
        (void)fprintf(out, "%ld", size / 10);
    if (size % 10)
        (void)fprintf(out, ".%ld", size % 10);
}

/* No figure is wider than this. */
static long tenths_of(double value)
{
    return lround(10.0 * fmax(-1e6, fmin(1e6, value)));
}

static void put_number(FILE *out, double value)
{
    put_tenths(out, tenths_of(value));
}

/* Move the pen to a place: by its coordinates after "M", by the step from the last place after "l" and " ". */
static void put_point(FILE *out, char before, point to, pen *at)
{
    const pen next = {tenths_of(to.x), tenths_of(to.y)};
    const int is_step = before != 'M';
    const long dy = next.y - (is_step ? at->y : 0);
    (void)fputc(before, out);
    put_tenths(out, next.x - (is_step ? at->x : 0));
    (void)fputs(dy < 0 ? "" : ",", out); /* a minus parts two numbers as well */
    put_tenths(out, dy);
    *at = next;
}

/* The distance of `at` from the line through two points. */
static double off_line(point from, point at, point to)
{
    const double dx = to.x - from.x, dy = to.y - from.y, length = hypot(dx, dy);
    return length > 0.0 ? fabs((at.x - from.x) * dy - (at.y - from.y) * dx) / length
                        : hypot(at.x - from.x, at.y - from.y);
}

/* Read "M1.01,1.02 L2.03,3.04 ... Z": moves and lines to absolute places.  Returns 0, with nothing written,
 * where it is another kind of path. */
static int put_path(FILE *out, const char *text, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        if (!strchr("MLZ0123456789.,- \n\t", text[i]))
            return 0;
    const char *c = text;
    char last = ' ';
    pen at = {0, 0};
    while (c < text + size) {
        point to;
        int used = 0;
        if (*c == 'Z') {
            (void)fputc('z', out);
            last = 'Z';
        } else if ((*c == 'M' || *c == 'L') && sscanf(c + 1, "%lf,%lf%n", &to.x, &to.y, &used) == 2) {
            put_point(out, *c == 'M' ? 'M' : last == 'L' ? ' ' : 'l', to, &at);
            last = *c;
        }
        c += 1 + used;
    }
    return 1;
}

/* ------------------------------------------------------------------ coloured lines */

/* Read <path stroke='rgb(r, g, b)' d='Mx,y Lx,y '/>, which is how gnuplot writes one line of a coloured path.
 */
static int read_line(const char *tag, int colour[3], point *from, point *to)
{
    int end = 0;
    if (sscanf(tag, "<path stroke='rgb(%d,%d,%d)' d='M%lf,%lf L%lf,%lf '/>%n", &colour[0], &colour[1],
               &colour[2], &from->x, &from->y, &to->x, &to->y, &end) != 7)
        return 0;
    return end > 0 && tag[end] == '\0';
}

static void end_stroke(small *s)
{
    stroke *path = &s->path;
    if (!path->open)
        return;
    put_point(s->out, path->open > 1 ? ' ' : 'l', path->last[1], &path->at);
    (void)fputs("'/>", s->out);
    path->open = 0;
}

static int goes_on(const stroke *path, const int rgb[3], point from)
{
    int same = path->open && fabs(path->last[1].x - from.x) < 0.011 && fabs(path->last[1].y - from.y) < 0.011;
    for (int i = 0; i < 3; ++i)
        same = same && abs(rgb[i] - COLOUR_STEP * path->colour[i]) <= SAME_COLOUR;
    return same;
}

static void add_line(small *s, const int rgb[3], point from, point to)
{
    stroke *path = &s->path;
    int colour[3];
    for (int i = 0; i < 3; ++i)
        colour[i] = (rgb[i] + COLOUR_STEP / 2) / COLOUR_STEP & 15;
    if (!goes_on(path, rgb, from)) {
        end_stroke(s);
        (void)fprintf(s->out, "<path stroke='#%x%x%x' d='", colour[0], colour[1], colour[2]);
        put_point(s->out, 'M', from, &path->at);
        memcpy(path->colour, colour, sizeof path->colour);
        path->last[0] = from;
        path->open = 1;
        path->left_out = 0;
    } else if (path->left_out < MOST_LEFT_OUT && off_line(path->last[0], path->last[1], to) < ON_LINE) {
        ++path->left_out;
    } else {
        put_point(s->out, path->open > 1 ? ' ' : 'l', path->last[1], &path->at);
        path->last[0] = path->last[1];
        path->open = 2; /* the letter of its lines is written */
        path->left_out = 0;
    }
    path->last[1] = to;
}

/* ------------------------------------------------------------------ tags */

/* The value of an attribute without needless blanks, with places rounded if it has any. */
static void put_value(FILE *out, const char *text, size_t size, int places)
{
    char before = '(';
    for (size_t i = 0; i < size;) {
        char *end;
        int colour[3], used = 0;
        if (strncmp(text + i, "rgb(", 4) == 0 &&
            sscanf(text + i, "rgb(%d,%d,%d)%n", &colour[0], &colour[1], &colour[2], &used) == 3 && used > 0) {
            (void)fprintf(out, "#%02x%02x%02x", colour[0] & 255, colour[1] & 255, colour[2] & 255);
            i += (size_t)used;
            before = ')';
            continue;
        }
        const int number = places && !isdigit((unsigned char)before) && before != '.' &&
                           (isdigit((unsigned char)text[i]) || text[i] == '-' || text[i] == '.');
        if (number) {
            put_number(out, strtod(text + i, &end));
            if (end > text + i) {
                i = (size_t)(end - text);
                before = '0';
                continue;
            }
        }
        before = text[i++];
        if (isspace((unsigned char)before)) {
            while (i < size && isspace((unsigned char)text[i]))
                ++i;
            if (i == size)
                break;
            before = ' ';
        }
        (void)fputc(before, out);
    }
}

/* A tag with its attributes in single quotes, which need no change inside the page's double ones. */
static void put_tag(FILE *out, const char *tag, size_t size)
{
    const int is_mark = strstr(tag, " id=") != NULL; /* the shape of a mark, drawn at another scale */
    for (size_t i = 0; i < size;) {
        const char c = tag[i];
        if (c != '"' && c != '\'') {
            size_t next = i + 1;
            while (isspace((unsigned char)c) && next < size && isspace((unsigned char)tag[next]))
                ++next;
            if (!isspace((unsigned char)c))
                (void)fputc(c, out);
            else if (tag[next] != '>' && tag[next] != '/' && tag[next] != '=' && tag[i - 1] != '=')
                (void)fputc(' ', out);
            i = next;
            continue;
        }
        const char *value = tag + i + 1, *end = memchr(value, c, size - i - 1);
        const size_t length = end ? (size_t)(end - value) : size - i - 1;
        const int is_path = !is_mark && i >= 3 && strncmp(tag + i - 3, " d=", 3) == 0;
        const int has_places = strncmp(value, "translate(", 10) == 0 ||
                               (i >= 7 && strncmp(tag + i - 7, "points=", 7) == 0) ||
                               (i >= 9 && strncmp(tag + i - 9, "points = ", 9) == 0);
        const char quote = memchr(value, '\'', length) ? '"' : '\'';
        (void)fputc(quote, out);
        if (!is_path || !put_path(out, value, length))
            put_value(out, value, length, has_places && !is_mark && !strstr(tag, "scale("));
        (void)fputc(quote, out);
        i += length + 2;
    }
}

static int begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* A group is written once it has content. */
static void put_group(small *s)
{
    if (s->group)
        put_tag(s->out, s->group, strlen(s->group));
    free(s->group);
    s->group = NULL;
}

static void take_tag(small *s, char *tag)
{
    int colour[3];
    point from, to;
    if (s->group && strcmp(tag, "</g>") == 0) { /* an empty group draws nothing */
        free(s->group);
        s->group = NULL;
        return;
    }
    put_group(s);
    if (read_line(tag, colour, &from, &to)) {
        add_line(s, colour, from, to);
        return;
    }
    end_stroke(s);
    if (begins(tag, "<g ") && tag[strlen(tag) - 2] != '/' && !strstr(tag, " id=")) {
        s->group = strdup(tag);
        s->printed.failed |= !s->group;
    } else {
        put_tag(s->out, tag, strlen(tag));
    }
}

/* Text between tags; gnuplot's line ends between elements mean nothing. */
static void take_text(small *s, const char *text, size_t size)
{
    int means = 0;
    for (size_t i = 0; i < size; ++i)
        means = means || !isspace((unsigned char)text[i]) || text[i] == ' ';
    if (!means || memchr(text, '\n', size) || memchr(text, '\t', size)) {
        for (means = 0; size > 0 && !means; ++text, --size)
            means = !isspace((unsigned char)*text);
        if (!means)
            return;
        --text;
        ++size;
    }
    put_group(s);
    end_stroke(s);
    (void)fwrite(text, 1, size, s->out);
}

/* The end of a piece that shows nothing: <?xml ...?>, a comment, the title and the description; NULL: it shows.
 */
static char *after_unseen(char *at)
{
    static const char *const unseen[][2] = {
        {"<?", "?>"}, {"<!--", "-->"}, {"<title>", "</title>"}, {"<desc>", "</desc>"}};
    for (size_t i = 0; i < sizeof unseen / sizeof unseen[0]; ++i) {
        char *end = begins(at, unseen[i][0]) ? strstr(at, unseen[i][1]) : NULL;
        if (end)
            return end + strlen(unseen[i][1]);
    }
    return NULL;
}

/* The '>' that ends a tag, past quoted values. */
static char *end_of_tag(char *at)
{
    for (char quote = '\0'; *at; ++at) {
        if (quote)
            quote = *at == quote ? '\0' : quote;
        else if (*at == '"' || *at == '\'')
            quote = *at;
        else if (*at == '>')
            return at;
    }
    return NULL;
}

char *fst_svg_small(char *svg)
{
    small s = {0};
    s.out = fst_print_begin(&s.printed);
    if (!s.out)
        return NULL;
    for (char *at = svg; *at;) {
        char *next = *at == '<' ? after_unseen(at) : NULL;
        if (next) {
            at = next;
            continue;
        }
        char *end = *at == '<' ? end_of_tag(at) : NULL;
        if (!end) {
            const size_t length = 1 + strcspn(at + 1, "<");
            take_text(&s, at, length);
            at += length;
            continue;
        }
        const char kept = end[1];
        end[1] = '\0';
        take_tag(&s, at);
        end[1] = kept;
        at = end + 1;
    }
    put_group(&s);
    end_stroke(&s);
    return fst_print_end(&s.printed);
}
