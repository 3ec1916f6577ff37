/* cycle.c - does a motion that does not turn about the axis come back to where it was?
 *
 * A libration need not cross the section X = 0 of the returns.  But r has maxima in each of its cycles, one or
 * several:
 *
 *      r |    A           A           A           A     the states at the maxima are compared with those of the
 *        |   / \   B     / \   B     / \   B     /      latest eight: this one, with two maxima to a cycle, comes
 *        |  /   \_/ \   /   \_/ \   /   \_/ \   /       back to the second before
 *        +------------------------------------------ t
 *
 * A state that is that of an earlier maximum completes a cycle; from then on the states at later maxima are
 * compared with the last that completed one.  Which maximum that is does not matter.
 *
 * A bead that spirals into a place of rest comes back too, each time a little nearer to it.  So the way that
 * the states at the maxima have still to go must be small beside the motion itself.
 */
#include "observe/cycle.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"

/* The way that may be left, over the size of the motion; and the least size of one that is seen. */
static const double WAY_OF_SIZE = 1e-3, LEAST_SIZE = 1e-5;
static const double SAME_ANGLE = 0.5; /* Phi, unwrapped, comes back within this */

void fst_cycle_begin(fst_cycle *c, double rtol)
{
    memset(c, 0, sizeof *c);
    c->since = -1;
    fst_closing_begin(&c->closing, rtol);
}

void fst_cycle_forget(fst_cycle *c)
{
    c->since = -1;
    fst_closing_forget(&c->closing);
}

void fst_cycle_watch(fst_cycle *c, int watch)
{
    if (c->watched == watch)
        return;
    c->watched = watch;
    c->seen = 0;
    fst_cycle_forget(c);
}

/* The state at a maximum joins the past ones. */
static void keep(fst_cycle *c, const double *state)
{
    memmove(c->past[1], c->past[0], sizeof c->past - sizeof c->past[0]);
    memcpy(c->past[0], state, sizeof c->past[0]);
    c->seen += c->seen < FST_CYCLE_MAXIMA;
}

/* Which of the past maxima completes a cycle with this state, and *nearest, the distance of the nearest one;
 * -1: none. */
static int find(const fst_cycle *c, const double *state, double *nearest)
{
    *nearest = INFINITY;
    for (int i = 0; i < c->seen; ++i) {
        const double d = fst_state_distance(state, c->past[i]);
        *nearest = fmin(*nearest, d);
        if (d < c->closing.limit)
            return i;
    }
    return -1;
}

/* Where the last completed cycle began, or no cycle goes on: 1 if this maximum completes one. */
static int completes(fst_cycle *c, fst_mark *mark)
{
    double nearest;
    if (c->since >= 0) {
        const double d = fst_state_distance(mark->state, c->past[c->since]);
        if (d < c->closing.limit) {
            mark->full_distance = d;
            return 1;
        }
        if (++c->since < FST_CYCLE_MAXIMA)
            return 0;
        fst_cycle_forget(c);
    }
    if (find(c, mark->state, &nearest) >= 0) {
        mark->full_distance = nearest;
        return 1;
    }
    fst_closing_see(&c->closing, mark, nearest);
    return 0;
}

int fst_cycle_step(fst_cycle *c, fst_quadrature *q, fst_flow *flow)
{
    if (!c->watched)
        return 0;
    const double before = fst_radial_function(flow, flow->step.y, NULL),
                 after = fst_radial_function(flow, flow->step.end, NULL);
    if (!(before > 0 && after <= 0))
        return 0;
    const double x = fst_flow_locate(flow, fst_radial_function, 0.0, 1.0, before, after);
    fst_mark_take(&c->latest, q, flow, x, fst_cycle_needs_integrals(c));
    const int completed = completes(c, &c->latest);
    keep(c, c->latest.state);
    if (completed)
        c->since = 0;
    return completed;
}

int fst_cycle_settles(fst_cycle *c, double until, double speed)
{
    fst_closing *closing = &c->closing;
    if (!fst_closing_add(closing, &c->latest, until))
        return 0;
    const double size = speed * fst_closing_turn(closing) / FST_TWO_PI;
    return size > LEAST_SIZE && fst_closing_way(closing, until) <= WAY_OF_SIZE * size &&
           fabs(closing->mark[2].bead_angle - closing->mark[0].bead_angle) < SAME_ANGLE;
}
