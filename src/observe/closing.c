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
 * Four marks in a row must lie below the limit, and the way that is left must be no more than the limit.  rho
 * is taken over eight marks: over one or two of them it is lost in the errors of the steps where it is close to
 * 1, and then the way is much longer than the distance.  Where the distances do not fall, the way is the last
 * one times the number of marks that the rest of the run would have.
 *
 * Under dry friction the errors of the steps may be as large as a third of the limit, because a step ends where
 * the contact changes, and then no distance says more.  But it is known how long the last power of ten down to
 * the limit took.  While the marks go on to repeat, the way goes on to fall as fast, unseen:
 *
 *     ten limits |x
 *          limit |- - x- - - - - - - -      way = limit 0.1^(stood/fall)/(1 - rho), and twice the distance
 *                |     x x x  x x x x       between states that are at least half of `stood` apart, because
 *                +-----|------------- t     something slower may hide
 *                 fall      stood
 *
 * The times and the changes of Phi between
 * successive marks must agree too, and the means of r and n_z.  Means of other quantities need not: on an orbit
 * that passes the axis closely the directions along r and alpha turn so fast that the errors of their integrals
 * are larger than whatever the motion still has to go.
 *
 * A bead that is put down on an unstable orbit repeats itself from the start, until it leaves.  So the states
 * must have differed by far more than the limit before: what comes closer by so much is attracted.  It may
 * still have come to an unstable orbit, near the few ways that lead there.  Then the distances rise again, each
 * above the one before.
 */
#include "observe/closing.h"

#include <math.h>
#include <string.h>

/* Times the limit: what counts as far, and the distance of a later mark; by what the times and angles between
 * marks, and the means, may differ. */
static const double FAR = 1000.0, STILL_THE_SAME = 10.0, SAME_TURN = 10.0, SAME_MEANS = 100.0;
/* Distances below this part of the tolerance may rise because of the errors of the steps. */
static const double SEEN_TO_RISE = 0.1;
/* The limit is ten times the tolerance, but not beyond these: an orbit whose returns differ by 1e-6 is closed,
 * and its symmetry is to be seen too. */
static const double LEAST_LIMIT = 1e-9, MOST_LIMIT = 1e-7;

static const double TEN = 10.0; /* limits: where the fall is timed from */

enum { FIRST, BEFORE, LAST };
enum {
    RISES = 5, /* one after the other: an unstable orbit is left */
    LEAST_REPEATS = 2 * FST_CLOSING_PAST
};

void fst_closing_begin(fst_closing *c, double rtol)
{
    memset(c, 0, sizeof *c);
    c->rtol = rtol;
    c->limit = fmin(fmax(LEAST_LIMIT, 10.0 * rtol), MOST_LIMIT);
}

void fst_closing_see(fst_closing *c, const fst_mark *mark, double distance)
{
    if (!(distance <= TEN * c->limit))
        c->far_at = mark->t.high;
    c->approached |= distance > FAR * c->limit && isfinite(distance);
}

double fst_closing_turn(const fst_closing *c)
{
    return fst_time_between(&c->mark[BEFORE], &c->mark[LAST]);
}

/* The way of what fell to the limit and then could not be seen to fall. */
static double way_below(const fst_closing *c)
{
    const double fall = c->since - c->far_at, stood = c->mark[LAST].t.high - c->since;
    if (!c->floored || c->repeats < LEAST_REPEATS)
        return INFINITY;
    return c->limit * pow(TEN, -stood / fall) / (1.0 - pow(TEN, -fst_closing_turn(c) / fall)) +
           2.0 * fst_state_distance(c->mark[LAST].state, c->stood[1]);
}

double fst_closing_way(const fst_closing *c, double until)
{
    const double last = c->distances[0], before = c->distances[FST_CLOSING_PAST];
    const double marks = fmax((until - c->mark[LAST].t.high) / fst_closing_turn(c), 1.0);
    if (c->known <= FST_CLOSING_PAST)
        return INFINITY;
    const double rho = pow(last / before, 1.0 / FST_CLOSING_PAST);
    return fmin(last * (rho < 1.0 ? fmin(1.0 / (1.0 - rho), marks) : marks), way_below(c));
}

/* Whether the motion between the last two marks was the one between the two before. */
static int way_agrees(const fst_closing *c)
{
    static const int compared[] = {FST_Q_R, FST_Q_N_Z};
    const fst_mark *first = &c->mark[FIRST], *before = &c->mark[BEFORE], *last = &c->mark[LAST];
    const double turn = fst_time_between(before, last), longer = turn - fst_time_between(first, before),
                 further = (last->bead_angle - before->bead_angle) - (before->bead_angle - first->bead_angle);
    int agrees =
        fabs(longer) <= SAME_TURN * c->limit * fmax(turn, 1.0) && fabs(further) <= SAME_TURN * c->limit;
    for (size_t i = 0; i < sizeof compared / sizeof *compared; ++i)
        agrees &= fabs(fst_mean_between(before, last, compared[i]) -
                       fst_mean_between(first, before, compared[i])) <= SAME_MEANS * c->limit;
    return agrees;
}

void fst_closing_forget(fst_closing *c)
{
    c->count = c->known = 0;
    c->repeats = 0;
}

void fst_closing_go_on(fst_closing *c, double distance)
{
    memmove(c->distances + 1, c->distances, FST_CLOSING_PAST * sizeof *c->distances);
    c->distances[0] = distance;
    c->known = isnan(distance) ? 0 : c->known + (c->known <= FST_CLOSING_PAST);
}

/* One more mark repeats. */
static void stand(fst_closing *c, const fst_mark *mark)
{
    if (c->repeats++ == 0)
        c->since = mark->t.high;
    if (c->repeats & (c->repeats - 1))
        return;
    memcpy(c->stood[1], c->stood[0], sizeof c->stood[0]);
    memcpy(c->stood[0], mark->state, sizeof c->stood[0]);
}

int fst_closing_add(fst_closing *c, const fst_mark *mark, double until)
{
    fst_closing_go_on(c, mark->full_distance);
    if (!(mark->full_distance < c->limit)) {
        fst_closing_see(c, mark, mark->full_distance);
        c->count = 0;
        c->repeats = 0;
        return 0;
    }
    stand(c, mark);
    if (c->count > 0) {
        memmove(c->mark, c->mark + 1, 2 * sizeof *c->mark);
        c->mark[LAST] = *mark;
    }
    c->count += c->count <= 3;
    return c->count > 3 && c->approached && fst_closing_way(c, until) <= c->limit && way_agrees(c);
}

int fst_closing_holds(const fst_closing *c)
{
    int rising = 1;
    for (int i = 0; i < RISES; ++i)
        rising &= c->distances[i] > c->distances[i + 1];
    return c->known > RISES && c->distances[0] < STILL_THE_SAME * c->limit &&
           !(rising && c->distances[0] > SEEN_TO_RISE * c->rtol);
}
