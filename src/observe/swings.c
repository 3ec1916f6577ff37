/* swings.c - where do the cycles of a libration begin and end, in a window that nobody ends early?
 *
 * Means over whole drive periods are not means of a motion that swings with a period of its own.  Each block
 * between two marks holds some whole cycles and a part of another one:
 *
 *     drive      |-----|-----|-----|-----|-----|-----|
 *     r          ^  .  ^  .  ^  .  ^  .  ^  .  ^  .  ^       2.1 periods of the drive are a cycle: all blocks
 *                |   cycle   |   cycle   |   cycle   |       cut off nearly the same, and agree on a wrong mean
 *
 * r has maxima in each cycle, one or several, and the state at a maximum comes back a cycle later.  So the
 * state at a maximum is compared with those at the eight maxima before it: the latest of these that is nearly
 * as close as the closest lies a cycle back.  From then on maxima are counted.  The last one of each cycle is a
 * mark.  Only the marks that the series keeps are located, because that takes time.
 *
 * The motion need not repeat itself: where marks have different states, the errors of the means say so
 * (means.c).
 */
#include "observe/swings.h"

#include <math.h>
#include <string.h>

static const double NOISE = 100.0;   /* times run.rtol; docs/regimes.md, Noise */
static const double AS_CLOSE = 10.0; /* eight cycles of a motion that comes closer differ by eight times one */
static const double COVERS = 0.5;    /* part of the window */
static const double LAST_BLOCKS = 2.0; /* may lack at the window's end */
enum { LEAST_BLOCKS = 4 };

void fst_swings_begin(fst_swings *s, double rtol)
{
    memset(s, 0, sizeof *s);
    s->noise = NOISE * rtol;
    fst_marks_begin(&s->marks);
}

int fst_swings_need(const fst_swings *s, double speed)
{
    return speed > s->noise && (s->maxima == 0 || (s->to_come <= 1 && fst_marks_keeps_next(&s->marks)));
}

void fst_swings_pass(fst_swings *s, double speed)
{
    if (!(speed > s->noise) || --s->to_come > 0)
        return;
    s->to_come = s->maxima;
    fst_marks_pass(&s->marks);
}

/* How many maxima ago the state was nearly this one; 0: too few are known. */
static int find(const fst_swings *s, const double *state)
{
    double distances[FST_SWINGS_PAST], nearest = INFINITY;
    if (s->seen < FST_SWINGS_PAST)
        return 0;
    for (int i = 0; i < FST_SWINGS_PAST; ++i) {
        distances[i] = fst_state_distance(state, s->past[i]);
        nearest = fmin(nearest, distances[i]);
    }
    int i = 0;
    while (distances[i] > AS_CLOSE * nearest)
        ++i;
    return i + 1;
}

void fst_swings_look(fst_swings *s, fst_quadrature *q, fst_flow *flow)
{
    const double before = fst_radial_function(flow, flow->step.y, NULL),
                 after = fst_radial_function(flow, flow->step.end, NULL);
    const double x = fst_flow_locate(flow, fst_radial_function, 0.0, 1.0, before, after);
    fst_mark mark;
    if (s->maxima == 0) {
        double state[FST_STATE_SIZE];
        fst_flow_at(flow, x, state);
        s->maxima = find(s, state);
        memmove(s->past[1], s->past[0], sizeof s->past - sizeof s->past[0]);
        memcpy(s->past[0], state, sizeof s->past[0]);
        s->seen += s->seen < FST_SWINGS_PAST;
        if (s->maxima == 0)
            return;
    }
    s->to_come = s->maxima;
    fst_mark_take(&mark, q, flow, x, 1);
    fst_marks_offer(&s->marks, &mark);
}

int fst_swings_cover(const fst_swings *s, double from, double now)
{
    const fst_mark_series *marks = &s->marks;
    if (marks->count <= LEAST_BLOCKS)
        return 0;
    const double covered = fst_twofold_difference(marks->latest.t, marks->kept[0].t);
    return covered >= COVERS * (now - from) &&
           now - marks->latest.t.high <= LAST_BLOCKS * covered / (marks->count - 1);
}
