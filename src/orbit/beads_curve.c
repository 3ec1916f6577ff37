/* beads_curve.c - equilibria of beads over one parameter, point by point.
 *
 * A step goes along the tangent of the curve of states and parameter, and Newton's method comes back to the curve across
 * it (curve.c has a picture).  The contacts are those of the start, so a curve ends where one of them would have to pull,
 * where beads meet that no contact keeps apart, or, without a plate, where a bead touches the magnet or is as far from it
 * as plate.radius.  Between two points are sought:
 *
 *     contact   the least load or force, or the least gap, passes 0; the curve ends there
 *     fold      the parameter turns back; pitchfork where the curve goes on to its own image there
 *     hopf      the real part of a pair of eigenvalues passes 0; of a real one: pitchfork where the state is its own image
 *               under half a turn with the beads exchanged, else transcritical; of motions that repeat themselves a
 *               multiplier leaves the unit circle: neimark-sacker, or at -1 period-doubling
 *
 * each by secants on a number that passes 0 there, with the solution between corrected every time.
 */
#include "orbit/beads_curve.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bracket.h"
#include "base/constants.h"
#include "base/error.h"

enum { MOST_NODES = 4000, LOCATING = 60 };
static const double FIRST_STEP = 0.02, SHORTEST_STEP = 1e-8; /* in the units of numbers */
static const double LEAST_COSINE = 0.95, LOCATED = 1e-13;
static const double HALF_TURN = FST_PI - 1e-9; /* beyond it a multiplier's angle is that of a negative number */

static double product(const beads_curve *t, const double *a, const double *b)
{
    const int numbers = FST_BEAD_NUMBERS * t->count;
    double unit[BEADS_NUMBERS], sum = a[numbers] * b[numbers];
    beads_units(&t->world, unit);
    for (int i = 0; i < numbers; ++i)
        sum += a[i] * b[i] / (unit[i] * unit[i]);
    return sum;
}

static fst_status set_world(beads_curve *t, double value, fst_error *error)
{
    return t->over.at(t->over.user, value, &t->world, error);
}

static fst_status add_special(beads_curve *t, fst_special_type type, fst_error *error)
{
    const fst_status status = set_world(t, t->middle.value, error);
    return status == FST_OK ? t->keep_special(t->user, type, &t->world, &t->middle, error) : status;
}

static void set_end(fst_branch_end *end, fst_end_type type, double value, const char *reason)
{
    *end = (fst_branch_end){.type = type, .family = -1, .image = -1, .value = value};
    (void)snprintf(end->reason, sizeof end->reason, "%s", reason);
}

/* ------------------------------------------------------------------ between two points */

/* What passes 0. */
enum { FORCE, GAP, WAY, TURN, GROWTH };
static double test_of(beads_curve *t, const beads_node *at, int test, int rank)
{
    int which;
    if (test == TURN)
        return at->way[FST_BEAD_NUMBERS * t->count];
    if (test == GROWTH)
        return at->lock.re[rank];
    if (test == WAY)
        return isnan(t->world.plate) ? beads_way_out(&t->world, 0, at->lock.state, &which) : 1.0;
    return test == FORCE ? beads_lock_least_force(&t->world, &at->lock, &which)
                         : beads_lock_least_gap(&t->world, &at->lock, &which);
}

/* The solution at the fraction x between here and next. */
static fst_status between(beads_curve *t, double x, beads_node *out, fst_error *error)
{
    const beads_node *a = &t->here, *b = &t->next;
    *out = *a;
    for (int i = 0; i < FST_BEAD_NUMBERS * t->count; ++i)
        out->lock.state[i] += x * (b->lock.state[i] - a->lock.state[i]);
    out->value += x * (b->value - a->value);
    fst_status status =
        beads_lock_across(t->lapack, t->repeat, &t->over, &out->value, &out->lock, out->way, error);
    return status == FST_OK ? set_world(t, out->value, error) : status;
}

/* t->middle: where the test passes 0 between here and next. */
static fst_status locate(beads_curve *t, int test, int rank, fst_error *error)
{
    fst_bracket z = {0.0, 1.0, test_of(t, &t->here, test, rank), test_of(t, &t->next, test, rank), 0};
    fst_status status = FST_OK;
    t->middle = t->next;
    for (int i = 0; i < LOCATING && z.hi - z.lo > LOCATED && status == FST_OK; ++i) {
        const double x = i % 8 == 7 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
        if (!(x > z.lo && x < z.hi))
            break;
        status = between(t, x, &t->middle, error);
        const double value = status == FST_OK ? test_of(t, &t->middle, test, rank) : NAN;
        if (fabs(value) < LOCATED)
            break;
        fst_bracket_take(&z, x, value);
    }
    return status;
}

/* Whether half a turn maps the state onto itself, with the beads in the opposite order. */
static int is_own_image(const beads_curve *t, const beads_lock *lock)
{
    static const double half_turn[3] = {-1, -1, 1};
    for (int i = 0; i < t->count; ++i)
        for (int k = 0; k < 3; ++k)
            if (fabs(lock->state[FST_BEAD_NUMBERS * i + k] -
                     half_turn[k] * lock->state[FST_BEAD_NUMBERS * (t->count - 1 - i) + k]) > 1e-6)
                return 0;
    return 1;
}

/* The curve ends at the magnet, or as far from it as a bead may be. */
static fst_status end_on_the_way(beads_curve *t, fst_branch_end *end, fst_error *error)
{
    char reason[128];
    int what;
    const fst_status status = locate(t, WAY, 0, error);
    if (status != FST_OK)
        return status;
    (void)beads_way_out(&t->world, 0, t->middle.lock.state, &what);
    (void)snprintf(reason, sizeof reason,
                   what == BEADS_AT_MAGNET ? "the bead touches the magnet at %.12g"
                                           : "the bead is plate.radius away at %.12g",
                   t->middle.value);
    set_end(end, what == BEADS_AT_MAGNET ? FST_END_CONTACT : FST_END_RADIUS, t->middle.value, reason);
    return FST_OK;
}

/* The curve ends at a contact. */
static fst_status end_at_contact(beads_curve *t, int test, fst_branch_end *end, fst_error *error)
{
    char reason[192], bodies[64];
    int which;
    const fst_status status = locate(t, test, 0, error);
    if (status != FST_OK)
        return status;
    if (test == FORCE)
        (void)beads_lock_least_force(&t->world, &t->next.lock, &which);
    else
        (void)beads_lock_least_gap(&t->world, &t->next.lock, &which);
    const beads_contact *c = &t->world.contact[which];
    if (c->second < 0)
        (void)snprintf(bodies, sizeof bodies, "bead %d and the plate", c->first + 1);
    else
        (void)snprintf(bodies, sizeof bodies, "beads %d and %d", c->first + 1, c->second + 1);
    (void)snprintf(reason, sizeof reason,
                   test == FORCE ? "the force between %s falls to 0 at %.12g" : "%s meet at %.12g", bodies,
                   t->middle.value);
    set_end(end, FST_END_CONTACT, t->middle.value, reason);
    return add_special(t, FST_SPECIAL_CONTACT, error);
}

/* Whether an eigenvalue is real, or the multiplier of a motion that repeats itself. */
static int is_real(const beads_curve *t, const beads_lock *lock, int rank)
{
    return lock->im[rank] == 0.0 || (t->repeat && fabs(lock->im[rank]) * t->repeat->period > HALF_TURN);
}

/* The special point in t->middle, where the eigenvalue of this rank crosses the axis. */
static fst_special_type type_of(const beads_curve *t, int rank)
{
    const beads_lock *lock = &t->middle.lock;
    if (!is_real(t, lock, rank))
        return t->repeat ? FST_SPECIAL_NEIMARK_SACKER : FST_SPECIAL_HOPF;
    if (lock->im[rank] != 0.0)
        return FST_SPECIAL_PERIOD_DOUBLING;
    return is_own_image(t, lock) ? FST_SPECIAL_PITCHFORK : FST_SPECIAL_TRANSCRITICAL;
}

/* What happens between here and next, and whether the curve ends there. */
static fst_status look_between(beads_curve *t, int *ends, fst_branch_end *end, fst_error *error)
{
    const int p = FST_BEAD_NUMBERS * t->count;
    const beads_lock *a = &t->here.lock, *b = &t->next.lock;
    for (int test = FORCE; test <= WAY; ++test)
        if (test_of(t, &t->next, test, 0) < 0) {
            *ends = 1;
            return test == WAY ? end_on_the_way(t, end, error) : end_at_contact(t, test, end, error);
        }
    int change = abs(b->unstable - a->unstable);
    fst_status status = FST_OK;
    if (t->here.way[p] * t->next.way[p] < 0) {
        status = locate(t, TURN, 0, error);
        if (status == FST_OK)
            status = add_special(t,
                                 is_own_image(t, &t->middle.lock) && !is_own_image(t, a) ? FST_SPECIAL_PITCHFORK
                                                                                         : FST_SPECIAL_FOLD,
                                 error);
        change -= change > 0;
    }
    for (int rank = a->unstable < b->unstable ? a->unstable : b->unstable; change > 0 && status == FST_OK;) {
        status = locate(t, GROWTH, rank, error);
        if (status != FST_OK)
            break;
        const int pair = !is_real(t, &t->middle.lock, rank);
        status = add_special(t, type_of(t, rank), error);
        rank += 1 + pair;
        change -= 1 + pair;
    }
    return status;
}

/* ------------------------------------------------------------------ following */

/* From t->next, which is beyond the range, back to the border. */
static fst_status stop_at_border(beads_curve *t, fst_error *error)
{
    const double border = t->next.value > t->high ? t->high : t->low;
    const double part = (border - t->here.value) / (t->next.value - t->here.value);
    for (int i = 0; i < FST_BEAD_NUMBERS * t->count; ++i)
        t->next.lock.state[i] = t->here.lock.state[i] + part * (t->next.lock.state[i] - t->here.lock.state[i]);
    t->next.value = border;
    const fst_status status = set_world(t, border, error);
    return status == FST_OK ? beads_lock_correct(t->lapack, t->repeat, &t->world, &t->next.lock, error)
                            : status;
}

static int is_within(const beads_curve *t, double value)
{
    return value >= t->low && value <= t->high;
}

/* The point a step h along the tangent from here, or on the border of the range. */
static fst_status step(beads_curve *t, double h, int *at_border, fst_error *error)
{
    const int p = FST_BEAD_NUMBERS * t->count;
    fst_status status = FST_OK;
    t->next = t->here;
    for (int i = 0; i < p; ++i)
        t->next.lock.state[i] += h * t->here.way[i];
    t->next.value += h * t->here.way[p] * t->over.scale;
    if (is_within(t, t->next.value)) {
        status = beads_lock_across(t->lapack, t->repeat, &t->over, &t->next.value, &t->next.lock, t->next.way,
                                   error);
        if (status == FST_OK && product(t, t->here.way, t->next.way) < LEAST_COSINE)
            status = fst_fail(error, FST_NO_CONVERGENCE, "branch", "the curve turns too sharply");
    }
    *at_border = status == FST_OK && !is_within(t, t->next.value);
    if (*at_border)
        status = stop_at_border(t, error);
    return status == FST_OK ? set_world(t, t->next.value, error) : status;
}

/* From t->here to the end. */
static fst_status follow(beads_curve *t, fst_branch_end *end, fst_error *error)
{
    double h = FIRST_STEP;
    for (int nodes = 0; nodes < MOST_NODES; ++nodes) {
        int at_border = 0, ends = 0;
        const double slope = fabs(t->here.way[FST_BEAD_NUMBERS * t->count]) * t->over.scale;
        h = fmin(fmin(h, t->longest), t->share * (t->high - t->low) / slope);
        fst_status status = step(t, h, &at_border, error);
        if (status == FST_INTERRUPTED || status == FST_NO_MEMORY)
            return status;
        if (status != FST_OK) {
            h *= 0.5;
            if (h > SHORTEST_STEP)
                continue;
            set_end(end, FST_END_LOST, t->here.value, "no further point was found");
            return FST_OK;
        }
        status = look_between(t, &ends, end, error);
        if (status != FST_OK)
            return status;
        t->here = ends ? t->middle : t->next;
        status = set_world(t, t->here.value, error); /* special points between have worlds of their own */
        if (status == FST_OK)
            status = t->keep(t->user, &t->world, &t->here, error);
        if (status != FST_OK || ends)
            return status;
        if (at_border) {
            set_end(end, FST_END_RANGE, t->here.value, "at the end of the range");
            return FST_OK;
        }
        h *= t->here.lock.iterations <= 4 ? 1.5 : 0.8;
    }
    set_end(end, FST_END_COUNT_LIMIT, t->here.value, "so many points were followed that it was given up");
    return FST_OK;
}

fst_status beads_curve_follow(beads_curve *t, double value, const beads_lock *start, fst_error *error)
{
    fst_status status = FST_OK;
    for (int way = 0; way < 2 && status == FST_OK; ++way) {
        memset(&t->here, 0, sizeof t->here);
        t->here.lock = *start;
        t->here.value = value;
        t->here.way[FST_BEAD_NUMBERS * t->count] =
            way ? 1.0 : -1.0; /* its tangent: first at the value itself */
        status = beads_lock_across(t->lapack, t->repeat, &t->over, &t->here.value, &t->here.lock, t->here.way,
                                   error);
        if (status == FST_OK)
            status = set_world(t, t->here.value, error);
        if (status == FST_OK && way)
            status = t->keep(t->user, &t->world, &t->here, error);
        if (status == FST_OK)
            status = follow(t, &t->ends[way], error);
        if (status == FST_OK && !way)
            t->reverse(t->user);
    }
    return status;
}
