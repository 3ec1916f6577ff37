/* shadow.c - the bead's outline, apart from its shadow.
 *
 *         lit side            The shadow moves with the bead, always on the same side, and differs from the
 *        .-----. . .          plate as the bead does.  But the bead covers its shadow, so all around the bead the
 *       /       \     `       brightness steps at once, also from bead to shadow, while the shadow's own outline is
 *      |  bead   |     .      soft, fainter, and hidden where the bead is.  The circle with the greatest mean step
 *       \       / shadow      is the bead's.  What is darker than the plate beyond it, on the same side in all
 *        `-----' . . '        samples, is its shadow.
 */
#include "follow/shadow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/order.h"

enum { ANGLES = 48, LOOKS = 4, MARGIN = 3, GRID = 20, MOST_INSIDE = 4096 };

#define ACROSS 0.75      /* pixels from the circle to where the step is taken */
#define FINEST 0.01      /* pixels to which the circle is found */
#define LEAST_RADIUS 1.5 /* pixels */
#define WHITE 255.0f     /* gray levels */
#define BEYOND 1.5       /* pixels: a soft outline reaches so far out */
#define LEAST_SHADE 0.08 /* of the bead's contrast: less does not widen the bead */
#define SAME_SIDE 0.85   /* of 1, where the shadow is on the same side in all samples; a half circle has 0.64 */
#define SURELY 0.2       /* pixels: a diameter is not known better */
#define LARGE 0.9        /* of the samples have smaller circles */
#define LEAST_WHOLE 0.7  /* of such a large circle: a smaller one is that of a mark */
#define MOST_SHADE 0.75  /* of the bead's contrast: the rest must show the bead */

/* By which part of the background's level the pixels around a spot are darker; brighter, of white. */
typedef struct window {
    float *dark;
    int left, top, width, height;
    double cosines[ANGLES], sines[ANGLES];
} window;

/* A circle in a window, and its mean step. */
typedef struct circle {
    double place[3]; /* column, row, radius */
    double step;
} circle;

static double dark_at(const window *w, double column, double row)
{
    const double x = fmax(0.0, fmin(column, w->width - 1.001)), y = fmax(0.0, fmin(row, w->height - 1.001));
    const int i = (int)x, j = (int)y;
    const double p = x - i, q = y - j;
    const float *at = w->dark + (size_t)j * (size_t)w->width + (size_t)i;
    return (1.0 - q) * ((1.0 - p) * (double)at[0] + p * (double)at[1]) +
           q * ((1.0 - p) * (double)at[w->width] + p * (double)at[w->width + 1]);
}

static double step_across(const window *w, const double place[3], double across, int first, int count)
{
    double sum = 0.0;
    for (int i = first; i < first + count; ++i) {
        const int k = i % ANGLES;
        const double c = w->cosines[k], s = w->sines[k], in = place[2] - across, out = place[2] + across;
        sum += dark_at(w, place[0] + in * c, place[1] + in * s) -
               dark_at(w, place[0] + out * c, place[1] + out * s);
    }
    return sum / count;
}

/* The circle with the greatest step: on a grid first, then by ever smaller moves. */
static circle find_circle(const window *w)
{
    const int least = w->width < w->height ? w->width : w->height;
    double move = fmax(1.0, (double)least / GRID);
    circle best = {.step = -INFINITY};
    for (double radius = LEAST_RADIUS; radius <= 0.5 * least; radius += move)
        for (double row = radius; row <= w->height - radius; row += move)
            for (double column = radius; column <= w->width - radius; column += move) {
                const double place[3] = {column, row, radius}, step = step_across(w, place, move, 0, ANGLES);
                if (step > best.step)
                    best = (circle){{column, row, radius}, step};
            }
    return best;
}

/* Move a circle to where the step across an arc of it is greatest, by ever smaller moves. */
static circle refine(const window *w, circle best, int first, int count)
{
    double move = 1.0;
    best.step = step_across(w, best.place, ACROSS, first, count);
    while (best.step > 0.0 && move > FINEST) {
        int moved = 0;
        for (int k = 0; k < 6; ++k) {
            circle other = best;
            other.place[k / 2] += k % 2 ? move : -move;
            other.step =
                other.place[2] >= LEAST_RADIUS ? step_across(w, other.place, ACROSS, first, count) : 0.0;
            if (other.step > best.step) {
                best = other;
                moved = 1;
            }
        }
        move *= moved ? 1.0 : 0.5;
    }
    return best;
}

/* ------------------------------------------------------------------ inside and beyond */

/* The lower third of the bead's contrast, as contrast_of() of learn.c has it for a whole spot. */
static double inside(const window *w, const circle *c)
{
    double values[MOST_INSIDE];
    int count = 0;
    for (int row = 0; row < w->height; ++row)
        for (int column = 0; column < w->width && count < MOST_INSIDE; ++column)
            if (hypot(column - c->place[0], row - c->place[1]) < fmax(c->place[2] - 2.0, 0.5 * c->place[2]))
                values[count++] = (double)w->dark[row * w->width + column];
    qsort(values, (size_t)count, sizeof *values, fst_ascending);
    return count > 0 ? values[count / 3] : 0.0;
}

/* How dark it is beyond the circle, by direction and distance, and which side has more of it. */
static void look_beyond(const window *w, const circle *c, int sample, follow_outline *outline)
{
    for (int k = 0; k < FOLLOW_SECTORS; ++k)
        for (int bin = 0; bin < FOLLOW_BEYOND; ++bin) {
            double sum = 0.0;
            for (int look = 0; look < LOOKS; ++look) {
                const double turn = FST_TWO_PI * (k + (look + 0.5) / LOOKS) / FOLLOW_SECTORS;
                const double way = c->place[2] * (1.0 + 2.0 * bin / FOLLOW_BEYOND) + BEYOND;
                const double x = c->place[0] + way * cos(turn), y = c->place[1] + way * sin(turn);
                if (x >= 0.0 && y >= 0.0 && x <= w->width - 1.0 && y <= w->height - 1.0)
                    sum += fmax(0.0, dark_at(w, x, y)) / LOOKS;
            }
            outline->beyond[k][bin][sample] = sum;
            outline->side[sample][0] += sum * cos(FST_TWO_PI * (k + 0.5) / FOLLOW_SECTORS);
            outline->side[sample][1] += sum * sin(FST_TWO_PI * (k + 0.5) / FOLLOW_SECTORS);
        }
}

static fst_status open_window(window *w, const follow_blobs *b, int sample, double sign, const follow_box *box,
                              fst_error *error)
{
    const follow_still *s = b->still;
    const int across = box->right - box->left, down = box->bottom - box->top;
    const int room = MARGIN + (across > down ? across : down) / 2, right = box->right + room,
              bottom = box->bottom + room;
    w->left = box->left > room ? box->left - room : 0;
    w->top = box->top > room ? box->top - room : 0;
    w->width = (right < s->width ? right + 1 : s->width) - w->left;
    w->height = (bottom < s->height ? bottom + 1 : s->height) - w->top;
    w->dark = malloc((size_t)w->width * (size_t)w->height * sizeof *w->dark);
    if (!w->dark)
        return fst_fail(error, FST_NO_MEMORY, "track", "no memory for a spot");
    const size_t size = (size_t)s->width * (size_t)s->height;
    const float *gains = s->gains + (size_t)sample * (size_t)s->height;
    for (int row = 0; row < w->height; ++row)
        for (int column = 0; column < w->width; ++column) {
            const size_t at = (size_t)(w->top + row) * (size_t)s->width + (size_t)(w->left + column);
            const float behind = gains[w->top + row] * s->level[at];
            const float off = behind - (float)s->samples[(size_t)sample * size + at];
            w->dark[row * w->width + column] = sign > 0.0 ? off / fmaxf(behind, 1.0f) : -off / WHITE;
        }
    for (int k = 0; k < ANGLES; ++k) {
        w->cosines[k] = cos(FST_TWO_PI * k / ANGLES);
        w->sines[k] = sin(FST_TWO_PI * k / ANGLES);
    }
    return FST_OK;
}

fst_status follow_outline_add(follow_outline *outline, const follow_blobs *blobs, int sample, double sign,
                              const follow_box *box, fst_error *error)
{
    window w;
    const fst_status status = open_window(&w, blobs, sample, sign, box, error);
    if (status != FST_OK)
        return status;
    const circle c = refine(&w, find_circle(&w), 0, ANGLES);
    if (c.step > 0.0) {
        const int at = outline->seen++;
        outline->diameters[at] = 2.0 * c.place[2];
        outline->contrasts[at] = inside(&w, &c);
        outline->places[sample][0] = w.left + c.place[0];
        outline->places[sample][1] = w.top + c.place[1];
        for (int k = 0; k < FOLLOW_HALVES; ++k)
            outline->halves[k][at] = 2.0 * refine(&w, c, ANGLES * k / FOLLOW_HALVES, ANGLES / 2).place[2];
        look_beyond(&w, &c, at, outline);
    }
    free(w.dark);
    return FST_OK;
}

/* How dark the shadow is, and where it is (rad, from right to down); 0: there is none.  It is on the same side in all
 * samples.  What motion blurs is on both sides of the bead, or, where the circle lies at one end of it, on sides
 * that change. */
static double find_shade(follow_outline *outline, double contrast, double *where)
{
    double dark[FOLLOW_SECTORS][FOLLOW_BEYOND], most = 0.0, odd = 0.0, all[2] = {0.0, 0.0}, lengths = 0.0;
    for (int i = 0; i < outline->seen; ++i) {
        all[0] += outline->side[i][0];
        all[1] += outline->side[i][1];
        lengths += hypot(outline->side[i][0], outline->side[i][1]);
    }
    for (int k = 0; k < FOLLOW_SECTORS; ++k)
        for (int bin = 0; bin < FOLLOW_BEYOND; ++bin) {
            dark[k][bin] = fst_median(outline->beyond[k][bin], (size_t)outline->seen);
            most = fmax(most, dark[k][bin]);
        }
    for (int k = 0; k < FOLLOW_SECTORS; ++k)
        for (int bin = 0; bin < FOLLOW_BEYOND; ++bin)
            odd = fmax(odd, dark[k][bin] - dark[(k + FOLLOW_SECTORS / 2) % FOLLOW_SECTORS][bin]);
    *where = atan2(all[1], all[0]);
    const int same = hypot(all[0], all[1]) > SAME_SIDE * lengths;
    return same && odd > LEAST_SHADE * contrast ? fmin(most, MOST_SHADE * contrast) : 0.0;
}

/* A dot on the bead may step more than the bead's outline: its circle was taken for the bead's.  Samples that show no such
 * dot have the bead's, so leave out circles that are much smaller than the large ones. */
static void leave_out_dots(follow_outline *o)
{
    double sorted[FOLLOW_SAMPLES];
    int kept = 0;
    memcpy(sorted, o->diameters, (size_t)o->seen * sizeof *sorted);
    qsort(sorted, (size_t)o->seen, sizeof *sorted, fst_ascending);
    const double least = LEAST_WHOLE * sorted[(int)(LARGE * (o->seen - 1) + 0.5)];
    for (int i = 0; i < o->seen; ++i) {
        if (o->diameters[i] < least)
            continue;
        o->diameters[kept] = o->diameters[i];
        o->contrasts[kept] = o->contrasts[i];
        memcpy(o->side[kept], o->side[i], sizeof o->side[i]);
        for (int k = 0; k < FOLLOW_HALVES; ++k)
            o->halves[k][kept] = o->halves[k][i];
        for (int k = 0; k < FOLLOW_SECTORS; ++k)
            for (int bin = 0; bin < FOLLOW_BEYOND; ++bin)
                o->beyond[k][bin][kept] = o->beyond[k][bin][i];
        ++kept;
    }
    o->seen = kept;
}

void follow_outline_decide(follow_outline *outline, double sign)
{
    double where, low = INFINITY, high = 0.0, half[FOLLOW_HALVES];
    if (outline->seen == 0)
        return;
    leave_out_dots(outline);
    const size_t seen = (size_t)outline->seen;
    const double contrast = fst_median(outline->contrasts, seen);
    outline->shade = find_shade(outline, contrast, &where);
    if (sign < 0.0) /* what is dark beside a bright bead is not a part of its spot */
        outline->shade = 0.0;
    outline->diameter = fst_median(outline->diameters, seen);
    for (int k = 0; k < FOLLOW_HALVES; ++k) {
        half[k] = fst_median(outline->halves[k], seen);
        low = fmin(low, half[k]);
        high = fmax(high, half[k]);
    }
    outline->error = hypot(SURELY, 0.5 * (high - low));
    if (!(outline->shade > 0.0))
        return;
    /* A shadow that lies close, and is almost as dark as the bead, draws the circle outwards; the half on the lit side,
     * which begins a quarter of a turn after the shadow, is not drawn. */
    const double first = FOLLOW_HALVES * (where / FST_TWO_PI + 1.25);
    outline->diameter = fmin(outline->diameter, half[(int)(first + 0.5) % FOLLOW_HALVES]);
}
