/* closing.c - when does a motion that comes back to a section repeat itself for good?
 *
 * The states at successive marks approach a limit by a factor rho each, until the errors of the steps are all
 * that is left:
 *
 *     distance |  x
 *              |     x                        way to go = distance/(1 - rho)
 *              |        x
 *        limit |- - - - - -x- - - - - -
 *              |              x  x x  x       errors of the steps
 *              +------------------------- marks
 *
 * Four marks in a row must lie below the limit, and the way that is left, with the larger of the last two
 * factors, must be no more than ten times the limit.  Where the distances do not fall, the way is the distance
 * times the number of marks that the rest of the run would have.  The times and the changes of Phi between
 * successive marks must agree too, and the means of r and n_z.  Means of other quantities need not: on an orbit that
 * passes the axis closely the directions along r and alpha turn so fast that the errors of their integrals are
 * larger than whatever the motion still has to go.
 *
 * A bead that is put down on an unstable orbit repeats itself from the start, until it leaves.  So the states
 * must have differed by far more than the limit before: what comes closer by so much is attracted.
 */
#include "observe/closing.h"

#include <math.h>
#include <string.h>

/* Times the limit: what counts as far, the way that may be left, and the distance of a later mark. */
static const double FAR = 1000.0, WAY = 10.0, STILL_THE_SAME = 10.0;
static const double LEAST_LIMIT = 1e-9; /* or ten times the tolerance of the integration */

enum { FIRST, BEFORE, LAST };

void fst_closing_begin(fst_closing *c, double rtol)
{
    memset(c, 0, sizeof *c);
    c->rtol = rtol;
    c->limit = fmax(LEAST_LIMIT, 10.0 * rtol);
}

void fst_closing_see(fst_closing *c, double distance)
{
    c->approached |= distance > FAR * c->limit && isfinite(distance);
}

static double time_between(const fst_mark *first, const fst_mark *last)
{
    return fst_twofold_difference(last->t, first->t);
}

double fst_closing_turn(const fst_closing *c)
{
    return time_between(&c->mark[BEFORE], &c->mark[LAST]);
}

double fst_closing_way(const fst_closing *c, double until)
{
    const double distance = c->mark[LAST].full_distance, before = c->mark[BEFORE].full_distance;
    const double rho = fmax(distance / before, before / c->mark[FIRST].full_distance);
    const double marks = fmax((until - c->mark[LAST].t.high) / fst_closing_turn(c), 1.0);
    if (distance == 0.0)
        return 0.0;
    return distance * (rho < 1.0 ? fmin(1.0 / (1.0 - rho), marks) : marks);
}

/* The mean of an integrand between two marks. */
static double mean(const fst_mark *first, const fst_mark *last, int which)
{
    return (last->integrals[which] - first->integrals[which]) / time_between(first, last);
}

/* Whether the motion between the last two marks was the one between the two before. */
static int way_agrees(const fst_closing *c)
{
    static const int compared[] = {FST_Q_R, FST_Q_N_Z};
    const fst_mark *first = &c->mark[FIRST], *before = &c->mark[BEFORE], *last = &c->mark[LAST];
    const double turn = time_between(before, last), longer = turn - time_between(first, before),
                 further = (last->bead_angle - before->bead_angle) - (before->bead_angle - first->bead_angle);
    int agrees = fabs(longer) <= WAY * c->limit * fmax(turn, 1.0) && fabs(further) <= WAY * c->limit;
    for (size_t i = 0; i < sizeof compared / sizeof *compared; ++i)
        agrees &= fabs(mean(before, last, compared[i]) - mean(first, before, compared[i])) <= WAY * WAY * c->limit;
    return agrees;
}

int fst_closing_add(fst_closing *c, const fst_mark *mark, double until)
{
    if (!(mark->full_distance < c->limit)) {
        fst_closing_see(c, mark->full_distance);
        c->count = 0;
        return 0;
    }
    if (c->count > 0) {
        memmove(c->mark, c->mark + 1, 2 * sizeof *c->mark);
        c->mark[LAST] = *mark;
    }
    c->count += c->count <= 3;
    return c->count > 3 && c->approached && fst_closing_way(c, until) <= WAY * c->limit && way_agrees(c);
}

int fst_closing_holds(const fst_closing *c, double distance)
{
    return distance < STILL_THE_SAME * c->limit;
}
