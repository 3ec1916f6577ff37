/* legend.c - the title above a figure and the key below it, laid out in pixels.
 *
 * gnuplot's own key lies over the data or squeezes them, and its titles are cut off where they are too long.
 * Here lines are broken by the number of their letters, and the key has as many columns as its longest entry
 * allows. */
#include "draw/legend.h"

#include <stdio.h>
#include <string.h>

enum {
    MARGIN = 10,
    TITLE_LINE = 19, /* pixels from line to line */
    ABOUT_LINE = 16,
    KEY_LINE = 18,
    SAMPLE = 30, /* pixels for what stands before the words */
    MOST_LINES = 5,
    LABEL_LINE = 16,
    LABEL_AWAY = 38, /* of an axis' label from the frame, with the numbers between them */
    LINE_SIZE = 272  /* bytes, four for each letter of the longest line */
};

/* Mean widths of a letter in pixels; wide ones of DejaVu Sans, the widest of the usual fonts. */
static const double TITLE_LETTER = 8.3, ABOUT_LETTER = 7.1, KEY_LETTER = 7.0, LABEL_LETTER = 7.4;

/* The letters of a text, without the marks that lower one. */
static int letters(const char *text)
{
    int count = 0;
    for (; *text; ++text)
        count += ((unsigned char)*text & 0xC0) != 0x80 && !strchr("_{}\\", *text);
    return count;
}

/* Whether a line may end at a blank: not between a number and its unit or its error, "17.62 ± 0.01 mm". */
static int may_end(const char *text, size_t blank)
{
    const char before = blank > 0 ? text[blank - 1] : ' ';
    const int after_sign = blank > 1 && memcmp(text + blank - 2, "±", 2) == 0;
    return !after_sign && !strchr("0123456789=", before) && !strchr("=", text[blank + 1]);
}

/* The bytes of a text of so many letters; of `plain` text each sign is one. */
static size_t bytes_of(const char *text, int longest, int plain)
{
    size_t end = 0;
    for (int seen = 0; text[end]; ++end) {
        seen += ((unsigned char)text[end] & 0xC0) != 0x80 && (plain || !strchr("_{}", text[end]));
        if (seen > longest)
            break;
    }
    return end;
}

/* Where a line of a text ends: at a line end, or at the last blank before it becomes too long. */
static size_t line_end(const char *text, int longest, int plain)
{
    const size_t most = bytes_of(text, longest, plain), line = strcspn(text, "\n");
    if (line <= most)
        return line;
    for (size_t blank = most; blank > 0; --blank)
        if (text[blank] == ' ' && may_end(text, blank))
            return blank;
    return most;
}

/* Break a text into lines of at most `longest` letters, the last of which ends with dots where there were more; returns
 * how many lines there are. */
static int break_lines(const char *text, int longest, int plain, char lines[MOST_LINES][LINE_SIZE])
{
    int count = 0;
    while (*text && count < MOST_LINES) {
        const size_t end = line_end(text, longest, plain);
        const int cut = count + 1 == MOST_LINES && text[end];
        const size_t kept = cut ? bytes_of(text, longest - 1, plain) : end;
        (void)snprintf(lines[count++], LINE_SIZE, "%.*s%s", (int)(kept < end ? kept : end), text,
                       cut ? "…" : "");
        text += end;
        text += *text == '\n' ? 1 : strspn(text, " ");
    }
    return count;
}

static int title_lines(const fst_legend *legend, char lines[MOST_LINES][LINE_SIZE])
{
    return break_lines(legend->title, (int)((FST_FIGURE_WIDTH - 2 * MARGIN) / TITLE_LETTER), 1, lines);
}

static int about_lines(const fst_legend *legend, char lines[MOST_LINES][LINE_SIZE])
{
    return break_lines(legend->about, (int)((FST_FIGURE_WIDTH - 2 * MARGIN) / ABOUT_LETTER), 1, lines);
}

void fst_legend_add(fst_legend *legend, fst_sample_kind sample, const char *style, const char *words)
{
    for (int i = 0; i < legend->count; ++i)
        if (strcmp(legend->entries[i].words, words) == 0 && strcmp(legend->entries[i].style, style) == 0)
            return;
    if (legend->count == FST_LEGEND_ENTRIES)
        return;
    fst_legend_entry *entry = &legend->entries[legend->count++];
    *entry = (fst_legend_entry){.sample = sample, .length = SAMPLE - 8};
    (void)snprintf(entry->style, sizeof entry->style, "%s", style);
    (void)snprintf(entry->words, sizeof entry->words, "%s", words);
}

void fst_plain_words(const char *text, char *words, size_t size)
{
    size_t used = 0;
    for (; *text && used + 3 < size; ++text) {
        if (strchr("_^@&~{}\\", *text))
            words[used++] = '\\';
        words[used++] = *text;
    }
    words[used] = '\0';
}

/* The columns of the key, and the width of each. */
static int key_columns(const fst_legend *legend, double *width)
{
    double widest = 0.0;
    for (int i = 0; i < legend->count; ++i) {
        const double wide = SAMPLE + 8.0 + KEY_LETTER * letters(legend->entries[i].words);
        widest = wide > widest ? wide : widest;
    }
    const double room = FST_FIGURE_WIDTH - 2.0 * MARGIN;
    int columns = widest > 0.0 ? (int)(room / widest) : 1;
    columns = columns < 1 ? 1 : columns > legend->count ? legend->count : columns;
    *width = columns > 0 ? room / columns : room;
    return columns;
}

/* The lines of an entry; it has several where it has no room in a column as wide as the figure. */
static int entry_lines(const fst_legend_entry *entry, char lines[MOST_LINES][LINE_SIZE])
{
    const double room = FST_FIGURE_WIDTH - 2.0 * MARGIN - SAMPLE - 6.0;
    return break_lines(entry->words, (int)(room / KEY_LETTER), 0, lines);
}

/* The lines of the entries above one, in one column. */
static int lines_above(const fst_legend *legend, int entry)
{
    char lines[MOST_LINES][LINE_SIZE];
    int count = 0;
    for (int i = 0; i < entry; ++i)
        count += entry_lines(&legend->entries[i], lines);
    return count;
}

static int key_rows(const fst_legend *legend)
{
    double width;
    const int columns = key_columns(legend, &width);
    if (columns == 1)
        return lines_above(legend, legend->count);
    return columns > 0 ? (legend->count + columns - 1) / columns : 0;
}

int fst_legend_head(const fst_legend *legend)
{
    char lines[MOST_LINES][LINE_SIZE];
    return MARGIN + TITLE_LINE * title_lines(legend, lines) + ABOUT_LINE * about_lines(legend, lines);
}

int fst_legend_foot(const fst_legend *legend)
{
    return legend->count > 0 ? MARGIN + KEY_LINE * key_rows(legend) : 0;
}

int fst_lines_of(const char *text, double pixels)
{
    char lines[MOST_LINES][LINE_SIZE];
    return break_lines(text, (int)(pixels / LABEL_LETTER), 0, lines);
}

void fst_figure_panels(fst_figure_file *figure)
{
    (void)fputs("set multiplot\nset grid ls 101\n", figure->script);
}

double fst_figure_across(const fst_figure_file *figure, double pixels)
{
    return (pixels + figure->canvas.pad) / (FST_FIGURE_WIDTH + 2.0 * figure->canvas.pad);
}

void fst_figure_place(fst_figure_file *figure, int height, const double frame[4])
{
    (void)fprintf(figure->script,
                  "set lmargin at screen %.5f\nset rmargin at screen %.5f\n"
                  "set tmargin at screen %.5f\nset bmargin at screen %.5f\n",
                  fst_figure_across(figure, frame[0]), fst_figure_across(figure, frame[1]),
                  1.0 - frame[2] / height, 1.0 - frame[3] / height);
}

void fst_figure_axis_label(fst_figure_file *figure, int height, fst_side side, const char *text,
                           fst_colour colour, const double frame[4])
{
    char lines[MOST_LINES][LINE_SIZE];
    const int level = side == FST_SIDE_BELOW || side == FST_SIDE_ABOVE;
    const double room = level ? frame[1] - frame[0] : frame[3] - frame[2];
    const int count = break_lines(text, (int)(room / LABEL_LETTER), 0, lines);
    for (int i = 0; i < count; ++i) {
        double x = 0.5 * (frame[0] + frame[1]), y = 0.5 * (frame[2] + frame[3]);
        if (side == FST_SIDE_BELOW)
            y = frame[3] + LABEL_AWAY + LABEL_LINE * i;
        else if (side == FST_SIDE_ABOVE)
            y = frame[2] - LABEL_AWAY - 6 - LABEL_LINE * (count - 1 - i);
        else
            x = side == FST_SIDE_LEFT ? 12 + LABEL_LINE * i
                                      : FST_FIGURE_WIDTH - 10 - LABEL_LINE * (count - 1 - i);
        (void)fputs("set label ", figure->script);
        fst_figure_quote(figure, lines[i]);
        (void)fprintf(figure->script, " at screen %.5f,%.5f center%s textcolor rgb '%s'\n",
                      fst_figure_across(figure, x), 1.0 - y / height, level ? "" : " rotate by 90",
                      fst_colour_code(colour));
    }
}

void fst_figure_colour_scale(fst_figure_file *figure, int height, const char *label, const double frame[4])
{
    const double left = fst_figure_across(figure, frame[0]);
    (void)fprintf(
        figure->script, "unset cblabel\nset colorbox horizontal user origin %.5f,%.5f size %.5f,%.5f\n", left,
        1.0 - frame[3] / height, fst_figure_across(figure, frame[1]) - left, (frame[3] - frame[2]) / height);
    fst_figure_axis_label(figure, height, FST_SIDE_BELOW, label, FST_COLOUR_BLACK, frame);
}

/* ------------------------------------------------------------------ writing */

static void write_title(fst_figure_file *figure, const fst_legend *legend, int height)
{
    char lines[MOST_LINES][LINE_SIZE];
    double y = height - MARGIN - 0.4 * TITLE_LINE;
    int count = title_lines(legend, lines);
    for (int i = 0; i < count; ++i, y -= TITLE_LINE) {
        (void)fputs("set label ", figure->script);
        fst_figure_quote(figure, lines[i]);
        (void)fprintf(figure->script, " at %g,%g center front noenhanced font ',15'\n", 0.5 * FST_FIGURE_WIDTH,
                      y);
    }
    count = about_lines(legend, lines);
    for (int i = 0; i < count; ++i, y -= ABOUT_LINE) {
        (void)fputs("set label ", figure->script);
        fst_figure_quote(figure, lines[i]);
        (void)fprintf(figure->script, " at %g,%g center front noenhanced font ',12' textcolor rgb '#555555'\n",
                      0.5 * FST_FIGURE_WIDTH, y);
    }
}

static void entry_place(const fst_legend *legend, int i, double *x, double *y)
{
    double width;
    const int columns = key_columns(legend, &width), rows = key_rows(legend);
    const int column = columns == 1 ? 0 : i / rows, row = columns == 1 ? lines_above(legend, i) : i % rows;
    *x = MARGIN + width * column + (columns == 1 ? 6.0 : 0.0);
    *y = 0.5 * MARGIN + KEY_LINE * (rows - row - 0.5);
}

static void write_samples(fst_figure_file *figure, const fst_legend *legend)
{
    static const char *const with[] = {[FST_SAMPLE_LINE] = "using 1:2 with lines",
                                       [FST_SAMPLE_POINT] = "using 1:2 every ::1::1 with points",
                                       [FST_SAMPLE_LINE_POINT] = "using 1:2 with linespoints",
                                       [FST_SAMPLE_BOX] = "using 1:2:(11):(5) with boxxyerror",
                                       [FST_SAMPLE_ARROW] =
                                           "using 1:2:3:4 with vectors head filled size screen 0.014,18"};
    (void)fputs("plot ", figure->script);
    for (int i = 0; i < legend->count; ++i) {
        const fst_legend_entry *entry = &legend->entries[i];
        double x, y;
        char name[24];
        if (entry->sample == FST_SAMPLE_NONE)
            continue;
        entry_place(legend, i, &x, &y);
        (void)snprintf(name, sizeof name, "key%d", i + 1);
        fst_figure_block(figure, name, "x y in pixels");
        if (entry->sample == FST_SAMPLE_ARROW)
            (void)fprintf(figure->data, "%g %g %g 0\n", x + 0.5 * (SAMPLE - 8 - entry->length), y,
                          entry->length);
        else if (entry->sample == FST_SAMPLE_BOX)
            (void)fprintf(figure->data, "%g %g\n", x + 0.5 * (SAMPLE - 8), y);
        else
            for (int k = 0; k < 3; ++k)
                (void)fprintf(figure->data, "%g %g\n", x + 0.5 * k * (SAMPLE - 8), y);
        (void)fprintf(figure->script, "data index 'key%d' %s %s notitle, \\\n     ", i + 1, with[entry->sample],
                      entry->style);
    }
    (void)fputs("NaN notitle\n", figure->script);
}

void fst_legend_write(fst_figure_file *figure, const fst_legend *legend, int height)
{
    FILE *script = figure->script;
    (void)fputs("unset arrow\nunset label\nunset object\nunset title\nunset grid\nunset border\nunset tics\n"
                "unset colorbox\nunset key\nunset logscale\n"
                "set size noratio\n",
                script);
    fst_figure_place(figure, height, (const double[4]){0, FST_FIGURE_WIDTH, 0, height});
    (void)fprintf(script, "set xrange [0:%d]\nset yrange [0:%d]\n", FST_FIGURE_WIDTH, height);
    write_title(figure, legend, height);
    for (int i = 0; i < legend->count; ++i) {
        char lines[MOST_LINES][LINE_SIZE];
        double x, y;
        entry_place(legend, i, &x, &y);
        const int count = entry_lines(&legend->entries[i], lines);
        for (int k = 0; k < count; ++k) {
            (void)fputs("set label ", script);
            fst_figure_quote(figure, lines[k]);
            (void)fprintf(script, " at %g,%g left front font ',12'\n",
                          x + (legend->entries[i].sample == FST_SAMPLE_NONE ? 0 : SAMPLE), y - KEY_LINE * k);
        }
    }
    write_samples(figure, legend);
    (void)fputs("unset multiplot\n", script);
}
