/* clock.c - films that are slowed in parts.
 *
 * What a phone exports of slow motion is slowed in its middle: there the frames are farther apart by the film's clock, but
 * the bead goes as far from one frame to the next as elsewhere.  Rates then follow from the frames, not from such a clock.
 * The clock is right where it only jitters, where frames are lost, and where a camera takes fewer frames for a while: by it
 * the bead is as fast everywhere, or it rests in some parts and goes farther from one frame to the next in others.
 */
#include "measure/work.h"

#include <stdlib.h>

#include "base/error.h"
#include "base/order.h"

/* So many steps in a row that all differ by such a factor from the usual one are a part of its own, if the film has this
 * share of them; the bead's speed differs by as much there. */
enum { STRETCH = 12 };
#define FACTOR 1.7
#define LEAST_SHARE 0.05

/* From a row to the next one, s a frame. */
static double step_at(const fst_track *track, size_t i)
{
    return (track->t[i + 1] - track->t[i]) / fmax(1.0, (double)(track->frame[i + 1] - track->frame[i]));
}

static int differ(double a, double b)
{
    return a > FACTOR * b || b > FACTOR * a;
}

/* Mark the steps of parts in which all differ from the usual one; returns how many. */
static size_t mark_parts(const fst_track *track, double usual, unsigned char *apart)
{
    size_t marked = 0, row = 0;
    for (size_t i = 0; i + 1 < track->rows; ++i) {
        row = differ(step_at(track, i), usual) ? row + 1 : 0;
        const size_t behind = row == STRETCH ? STRETCH : row > STRETCH;
        for (size_t k = 0; k < behind; ++k)
            apart[i - k] = 1;
        marked += behind;
    }
    return marked;
}

enum { STEP, SPEED, WAY }; /* s a frame; length a s; length a frame */

/* The median of one of these within these parts, or without them. */
static double median_of(const fst_track *track, const unsigned char *apart, int within, int what, double *room)
{
    size_t count = 0;
    for (size_t i = 0; i + 1 < track->rows; ++i) {
        if (apart[i] != within || (what != STEP && (isnan(track->x[i]) || isnan(track->x[i + 1]))))
            continue;
        const double step = step_at(track, i), time = track->t[i + 1] - track->t[i];
        const double way = hypot(track->x[i + 1] - track->x[i], track->y[i + 1] - track->y[i]);
        room[count++] = what == STEP ? step : what == SPEED ? way / time : way / time * step;
    }
    return fst_median(room, count);
}

/* Whether one of these differs between these parts and the others. */
static int parts_differ(const fst_track *track, const unsigned char *apart, int what, double *room)
{
    return differ(median_of(track, apart, 0, what, room), median_of(track, apart, 1, what, room));
}

fst_status measure_forget_slowed_clock(fst_track *track, fst_measurement *measured, fst_error *error)
{
    if (!isfinite(track->fps) || track->steady || track->rows < 2)
        return FST_OK;
    double *room = malloc(track->rows * sizeof *room);
    unsigned char *apart = calloc(track->rows, 1);
    if (!room || !apart) {
        free(room);
        free(apart);
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for a track of %zu frames", track->rows);
    }
    const double steps = (double)(track->rows - 1), usual = median_of(track, apart, 0, STEP, room);
    if ((double)mark_parts(track, usual, apart) > LEAST_SHARE * steps &&
        parts_differ(track, apart, SPEED, room) && !parts_differ(track, apart, WAY, room)) {
        const double one = 1e3 * median_of(track, apart, 0, STEP, room);
        const double other = 1e3 * median_of(track, apart, 1, STEP, room);
        measure_warn(measured,
                     "the film is slowed in parts: its frames are %.3g ms apart in some and %.3g ms in others, "
                     "but the bead goes as far from frame to frame; its clock is not used: give the frame rate",
                     fmin(one, other), fmax(one, other));
        track->fps = NAN;
        for (size_t i = 0; i < track->rows; ++i)
            track->t[i] = NAN;
    }
    free(room);
    free(apart);
    return FST_OK;
}
