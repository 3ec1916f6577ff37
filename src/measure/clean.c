/* clean.c - places at which the bead cannot have been.
 *
 * Before anything is known of the motion: a bead does not jump to and fro from frame to frame.  Once it is
 * known: a place far from the model of the motion, and far from what its neighbours deviate, is one of
 * something else.
 */
#include "measure/work.h"

#include <string.h>

#include "base/order.h"

/* Nearer to the model than this part of a radius no place is wild: a computed motion may have no other noise. */
#define EXACT 1e-9

/* How far a place lies from the line between the seen places before and behind it. */
static double bulge(const measure_work *work, size_t i)
{
    const double span = work->t[i + 1] - work->t[i - 1], part = (work->t[i] - work->t[i - 1]) / span;
    const double dx = work->x[i] - work->x[i - 1] - part * (work->x[i + 1] - work->x[i - 1]);
    const double dy = work->y[i] - work->y[i - 1] - part * (work->y[i + 1] - work->y[i - 1]);
    /* The path bends: over a longer span it bulges by the square of it. */
    const double frames = fmax(1.0, 0.5 * span * work->fps);
    return sqrt(dx * dx + dy * dy) / (frames * frames);
}

/* Mark places far outside of all others: beyond three times the median distance from the median place. */
static void reject_outside(fst_track *track, const measure_work *work, double *sorted)
{
    double middle[2];
    const double *const places[2] = {work->x, work->y};
    for (int k = 0; k < 2; ++k) {
        memcpy(sorted, places[k], work->count * sizeof *sorted);
        middle[k] = fst_median(sorted, work->count);
    }
    for (size_t i = 0; i < work->count; ++i)
        sorted[i] = hypot(work->x[i] - middle[0], work->y[i] - middle[1]);
    const double limit = 3.0 * fst_median(sorted, work->count);
    for (size_t i = 0; i < work->count; ++i)
        if (hypot(work->x[i] - middle[0], work->y[i] - middle[1]) > limit)
            track->flag[work->row[i]] = FST_FRAME_REJECTED;
}

size_t measure_reject_jumps(fst_track *track, const measure_work *work)
{
    size_t rejected = 0;
    if (work->count < 8)
        return 0;
    double *bulges = work->scratch, *sorted = bulges + work->count;
    reject_outside(track, work, sorted);
    for (size_t i = 1; i + 1 < work->count; ++i)
        sorted[i - 1] = bulges[i] = bulge(work, i);
    bulges[0] = bulges[work->count - 1] = 0.0;
    const double limit = 8.0 * fst_median(sorted, work->count - 2);
    /* A wild place makes its neighbours bulge by half of what it does itself: take the worst of each three. */
    for (size_t i = 1; i + 1 < work->count; ++i)
        if (bulges[i] > limit && bulges[i] >= bulges[i - 1] && bulges[i] >= bulges[i + 1])
            track->flag[work->row[i]] = FST_FRAME_REJECTED;
    for (size_t i = 0; i < work->count; ++i)
        rejected += track->flag[work->row[i]] == FST_FRAME_REJECTED;
    return rejected;
}

/* How far places usually are from the model. */
static double usual_distance(const measure_work *work, double *sorted)
{
    for (size_t i = 0; i < work->count; ++i)
        sorted[i] = hypot(work->r_off[i], work->r[i] * work->a_off[i]);
    return fst_median(sorted, work->count);
}

size_t measure_take_back(fst_track *track, measure_work *work)
{
    size_t taken = 0;
    double row[MEASURE_MOST_COLUMNS];
    const double limit = 4.0 * usual_distance(work, work->scratch);
    const size_t spare = work->count; /* there is room for one row more */
    for (size_t i = work->first; i < track->rows; ++i) {
        if (track->flag[i] != FST_FRAME_REJECTED)
            continue;
        measure_place_row(work, spare, i);
        (void)measure_radial_row(work, spare, row);
        const double off = work->r[spare] - measure_regression_value(&work->radial, row);
        (void)measure_angular_row(work, spare, row);
        const double turned = work->alpha[spare] - measure_regression_value(&work->angular, row);
        if (hypot(off, work->r[spare] * turned) < limit) {
            track->flag[i] = FST_FRAME_SEEN;
            ++taken;
        }
    }
    return taken;
}

size_t measure_reject_far(fst_track *track, const measure_work *work)
{
    size_t rejected = 0;
    double *off = work->scratch, *sorted = off + work->count;
    for (size_t i = 0; i < work->count; ++i) {
        off[i] = hypot(work->r_off[i], work->r[i] * work->a_off[i]);
    }
    const double usual = fmax(usual_distance(work, sorted), EXACT * work->radial.coefficient[0]);
    for (size_t i = 0; i < work->count; ++i) {
        /* The median of five neighbours: of a motion that the model lacks they deviate as much. */
        double near[5];
        size_t n = 0;
        for (size_t k = i > 1 ? i - 2 : 0; k <= i + 2 && k < work->count; ++k)
            near[n++] = off[k];
        const double neighbours = fst_median(near, n);
        if (off[i] > 6.0 * usual && off[i] > 4.0 * neighbours) {
            track->flag[work->row[i]] = FST_FRAME_REJECTED;
            ++rejected;
        }
    }
    return rejected;
}
