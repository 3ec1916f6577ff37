/* special.c - what happens between two neighbouring points of a curve.
 *
 * At a special point the number of unstable directions changes, or the curve turns, or another one leaves it:
 *
 *        fold            pitchfork         transcritical       Hopf
 *                             ___
 *          .---            .-'               \    .-            an equilibrium loses its stability, and
 *         (           -----+ - - -            \ .'              small orbits about it are born, of the
 *          '- - -          '-___               X                frequency of the pair of eigenvalues
 *                                           .-' \               that crosses the imaginary axis
 *                                         .'     \
 *
 * (full lines attract, broken ones do not).  Orbits have the same with multipliers instead of eigenvalues: +1
 * is a fold, -1 a pitchfork of a symmetric orbit (its half map) or a period doubling of another, a pair on the
 * unit circle a Neimark-Sacker point.  Where an orbit passes through the axis r = 0 nothing happens to it but
 * that it ceases to turn round the axis; that is reported too (origin-crossing).  Under dry friction an orbit may
 * gain or lose a rest, or a flight; the return to itself is not smooth there (grazing).
 *
 * Each of these is the zero of one test (special_test.c): where a test has different signs at the two points,
 * the zero between is located, named, and the first point of the branch that is born there is sought
 * (switching.c).  Two zeros of one test in one step would go unseen, so the step is halved where more
 * directions became unstable than the tests account for.
 *
 * Some curves end.  Orbits without the symmetry meet the branch of symmetric ones, orbits shrink to an
 * equilibrium at its Hopf point, equilibria meet a branch of higher symmetry: beyond, the curve would only come
 * back as its own mirror image, so each turn of the parameter is looked at for that before it is called a fold.
 */
#include "orbit/special.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/dot.h"
#include "base/error.h"
#include "observe/marks.h"
#include "orbit/normal_form.h"
#include "orbit/special_test.h"

/* Two solutions with a grazing between them, so close along the curve, show where it is. */
#define GAP_AT_GRAZING 1e-5

/* Between which two nodes one looks, and who hears of it. */
typedef struct interval {
    const fst_family *family;
    const fst_curve_sink *sink;
    const fst_node *a, *b;
    fst_curve_end *end;
} interval;

static fst_status tell(const interval *i, fst_special_type type, const fst_node *at, int criticality,
                       const fst_node *born, fst_error *error)
{
    if (!i->sink->special)
        return FST_OK;
    return i->sink->special(i->sink->user, type, at, criticality, born, error);
}

/* Whether tests may not jump on the way.  Under dry friction those of orbits that rest or fly do; and a step so short,
 * to a border on which the curve begins, has no direction. */
static int is_smooth(const interval *i)
{
    return i->a->captures + i->b->captures == 0 && i->b->length > 1e-7;
}

/* What changed between the nodes has no place between them: b may lie on another curve than a. */
static void doubt(const interval *i)
{
    if (is_smooth(i))
        fst_curve_end_set(i->end, FST_END_LOST,
                          "its stability changes between %.10g and %.10g at no special point: it may go on as "
                          "another branch",
                          i->a->s.value, i->b->s.value);
}

/* ------------------------------------------------------------------ naming and switching */

/* The state half a period on. */
static void half_way(const fst_solution *s, double y[FST_STATE_SIZE])
{
    if (s->symmetric)
        fst_apply_s2(s->y[0], y);
    else
        memcpy(y, s->y[s->segments / 2], FST_STATE_SIZE * sizeof *y);
}

/* How a solution differs from what it is half a period on, or (`image`) from the image under S2 of that. */
static void asymmetry(const fst_solution *s, int image, double difference[FST_STATE_SIZE])
{
    half_way(s, difference);
    if (image)
        fst_apply_s2(difference, difference);
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        difference[k] -= s->y[0][k];
}

/* Whether a curve passes through a solution that is its own image, or repeats itself after half the period: then it goes
 * on as its own image, or half a period on. */
static int becomes_its_image(const fst_node *a, const fst_node *b, int image)
{
    double at_a[FST_STATE_SIZE], at_b[FST_STATE_SIZE], size = 0.0;
    asymmetry(&a->s, image, at_a);
    asymmetry(&b->s, image, at_b);
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        size += at_a[k] * at_a[k] + at_b[k] * at_b[k];
    return size > 1e-12 && fst_dot(at_a, at_b, FST_STATE_SIZE) < -0.01 * size; /* rounding has signs too */
}

/* Whether a curve of orbits without the symmetry passes through one that has it. */
static int meets_symmetric(const fst_family *family, const fst_node *a, const fst_node *b)
{
    return family->has_s2 && a->s.segments >= 2 && !a->s.symmetric && a->seen.turns != 0 &&
           becomes_its_image(a, b, 1);
}

/* Whether it is an equilibrium that S2 maps onto itself, on the axis: there the symmetry can break.  Elsewhere
 * nothing is broken where an eigenvalue passes 0: a family that slips changes places with one that rolls. */
static int is_own_image(const fst_solution *s)
{
    double image[FST_STATE_SIZE];
    fst_apply_s2(s->y[0], image);
    return s->segments == 0 && fst_state_distance(image, s->y[0]) < 1e-6;
}

/* How large an orbit is: the way between its states half a period apart. */
static double extent(const fst_solution *s)
{
    double half[FST_STATE_SIZE];
    half_way(s, half);
    return fst_state_distance(half, s->y[0]);
}

/* 1 where the new branch lies on the side on which the old one has more unstable directions, -1 on the other.
 */
static int criticality_of(const fst_node *a, const fst_node *b, const fst_node *at, const fst_node *born)
{
    const double moved = born->s.value - at->s.value;
    const int more = fst_count_unstable(&b->s) - fst_count_unstable(&a->s);
    if (fabs(moved) < 1e-11 * fabs(at->s.value) || more == 0)
        return 0;
    return (moved > 0) == ((b->s.value > a->s.value) == (more > 0)) ? 1 : -1;
}

/* The equilibrium in the middle of a small orbit, at a value of the parameter. */
static fst_status middle_of(const fst_family *family, const fst_solution *orbit, double value, fst_node *out,
                            fst_error *error)
{
    fst_solution s = *orbit;
    fst_direction none;
    memset(&none, 0, sizeof none);
    s.segments = 0;
    s.value = value;
    double half[FST_STATE_SIZE];
    if (orbit->segments > 0)
        half_way(orbit, half);
    for (int k = 0; k < FST_STATE_SIZE && orbit->segments > 0; ++k)
        s.y[0][k] = 0.5 * (orbit->y[0][k] + half[k]);
    fst_solution_move(&s, &none, 0.0);
    const fst_status status = fst_solution_correct(family, &s, NULL, error);
    return status == FST_OK ? fst_node_make(family, &s, out, error) : status;
}

/* Real part of the eigenvalue whose frequency is nearest. */
static double growth_at(const fst_solution *s, double frequency)
{
    int best = 0;
    for (int i = 1; i < s->multipliers; ++i)
        if (fabs(s->im[i] - frequency) < fabs(s->im[best] - frequency))
            best = i;
    return s->re[best];
}

/* Where an orbit that turns back at `orbit` shrinks to an equilibrium, a pair of whose eigenvalues crosses the
 * axis with the orbit's frequency: by secants on the pair's real part.  1 if that is so. */
static int find_hopf(const fst_family *family, const fst_node *a, const fst_node *b, double frequency,
                     fst_node *hopf)
{
    fst_error ignored;
    fst_node other;
    const double reach = 20.0 * fabs(a->s.value - b->s.value) + 1e-3 * fabs(b->s.value);
    if (a->s.segments == 0 || fmin(extent(&a->s), extent(&b->s)) > 0.3 ||
        middle_of(family, &b->s, a->s.value + 1e-4 * family->scale, &other, &ignored) != FST_OK ||
        middle_of(family, &b->s, a->s.value, hopf, &ignored) != FST_OK)
        return 0;
    double f = growth_at(&hopf->s, frequency), before = growth_at(&other.s, frequency);
    for (int i = 0; i < 30 && fabs(f) > 1e-14; ++i) {
        const double step = -f * (hopf->s.value - other.s.value) / (f - before);
        if (!(fabs(step) > 1e-15 * family->scale))
            break;
        other = *hopf;
        before = f;
        if (!(fabs(hopf->s.value + step - a->s.value) < reach) ||
            middle_of(family, &other.s, other.s.value + step, hopf, &ignored) != FST_OK)
            return 0;
        f = growth_at(&hopf->s, frequency);
    }
    return fabs(f) < 1e-10;
}

/* A curve of orbits ends at the equilibrium `at`, having come from `a`. */
static fst_status report_hopf_end(const interval *i, const fst_node *at, double frequency, fst_error *error)
{
    const fst_family *family = i->family;
    fst_node beside;
    fst_error ignored;
    int criticality = 0;
    fst_curve_end_set(i->end, FST_END_EQUILIBRIUM, "it shrinks to an equilibrium at %.12g", at->s.value);
    /* Unstable pairs of the equilibrium lie on one side; the orbits on that of a small one, or of the one seen
     * last. */
    fst_node small;
    const int found = fst_switch_at_hopf(family, at, frequency, &small, &ignored) == FST_OK;
    const double step = copysign(1e-4 * family->scale, (found ? small.s.value : i->a->s.value) - at->s.value);
    criticality = fst_pair_criticality(family, &at->s, frequency);
    if (!criticality && middle_of(family, &at->s, at->s.value + step, &beside, &ignored) == FST_OK)
        criticality = growth_at(&beside.s, frequency) > 0 ? 1 : -1;
    return tell(i, FST_SPECIAL_HOPF, at, criticality, NULL, error);
}

fst_status fst_look_for_hopf_end(const fst_family *family, const fst_curve_sink *sink, const fst_node *a,
                                 const fst_node *b, fst_curve_end *end, fst_error *error)
{
    fst_node at;
    const interval i = {family, sink, a, b, end};
    const double frequency = FST_TWO_PI / fst_whole_period(&b->s);
    return find_hopf(family, a, b, frequency, &at) ? report_hopf_end(&i, &at, frequency, error) : FST_OK;
}

/* Whether a curve of equilibria that turns here does so because it meets another: at a fold the equations'
 * derivative by the parameter lies outside the range of the Jacobian, at a pitchfork inside.  The left null
 * vector w says, found by inverse iteration: w.f_p = 0. */
static int is_branch_point(const fst_family *family, const fst_solution *s)
{
    enum { N = FST_TANGENT_SIZE };
    fst_setup setup;
    double by[FST_STATE_SIZE], basis[FST_STATE_SIZE][N], w[N], part[N], greatest = 0.0;
    if (fst_family_setup(family, s->value, &setup, NULL) != FST_OK)
        return 0;
    for (int i = 0; i < N; ++i)
        w[i] = 1.0 / (1.0 + i);
    for (int round = 0; round < 3; ++round) {
        double a[N * N];
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j)
                a[i * N + j] = s->map[j][i] + (i == j ? 1e-10 : 0.0);
        if (family->lapack->solve(N, 1, a, w) != 0)
            return 0;
        const double length = sqrt(fst_dot(w, w, N));
        for (int i = 0; i < N; ++i)
            w[i] /= length;
    }
    fst_setup_by_parameter(&setup, s->y[0], by);
    fst_tangent_basis(s->y[0], basis);
    fst_tangent_part(basis, by, part);
    for (int j = 0; j < N; ++j)
        greatest = fmax(greatest, fabs(w[j] * part[j]));
    return fabs(fst_dot(w, part, N)) < 1e-3 * fmax(greatest, 0.01 * sqrt(fst_dot(part, part, N)));
}

/* A curve of orbits went through the equilibrium on which they shrink, from a to b, and comes back on itself:
 * what happens on the way down belongs to it, up to an orbit a twentieth as large as that at a. */
static fst_status look_before_hopf_end(const interval *i, fst_error *error)
{
    const fst_node *a = i->a, *b = i->b;
    const double x = 0.95 * extent(&a->s) / (extent(&a->s) + extent(&b->s));
    fst_node last;
    fst_error ignored;
    fst_curve_end before = {.type = FST_END_NONE};
    if (fst_node_between(i->family, a, b, x, &last, &ignored) != FST_OK)
        return FST_OK;
    last.length = x * b->length;
    const fst_status status = fst_specials_between(i->family, i->sink, a, &last, &before, error);
    return status == FST_OK && before.type == FST_END_NONE ? i->sink->node(i->sink->user, &last, error)
                                                           : status;
}

/* A turn of the parameter between a and b.  The curve of S1 orbits also turns where it meets the symmetric one, that of
 * librations where they shrink to nothing, and that of orbits whose period has doubled where it meets the orbits of half
 * the period: there it would only come back on itself. */
static fst_status report_turn(const interval *i, fst_error *error)
{
    const fst_node *a = i->a, *b = i->b;
    fst_node at;
    fst_error why;
    const double frequency = FST_TWO_PI / fst_whole_period(&b->s);
    if (meets_symmetric(i->family, a, b)) {
        fst_curve_end_set(i->end, FST_END_SYMMETRIC_ORBIT, "it ends on the symmetric branch near %.6g",
                          b->s.value);
        return FST_OK;
    }
    if (find_hopf(i->family, a, b, frequency, &at)) {
        const fst_status status = look_before_hopf_end(i, error);
        return status == FST_OK ? report_hopf_end(i, &at, frequency, error) : status;
    }
    if (a->s.segments >= 2 && !a->s.symmetric && becomes_its_image(a, b, 0)) {
        fst_curve_end_set(i->end, FST_END_OTHER_BRANCH, "it ends where its period has doubled, near %.6g",
                          b->s.value);
        return FST_OK;
    }
    if (!i->sink->special && a->s.segments > 0) /* nobody hears of a fold */
        return FST_OK;
    /* At a fold of orbits a multiplier passes 1, once. */
    const int alone = a->s.segments > 0 && is_smooth(i) && !fst_test_changes(a, b, FST_TEST_PLUS);
    if (alone || fst_locate_special(i->family, a, b, FST_TEST_FOLD, &at, &why) != FST_OK) {
        if (a->s.segments == 0) /* Newton's matrix is singular where two curves meet */
            fst_curve_end_set(i->end, FST_END_OTHER_BRANCH, "it ends on another branch near %.6g", b->s.value);
        else
            doubt(i);
        return FST_OK;
    }
    if (at.s.segments == 0 && (becomes_its_image(a, b, 1) || is_branch_point(i->family, &at.s))) {
        fst_curve_end_set(i->end, FST_END_HIGHER_SYMMETRY, "it ends on a branch of higher symmetry at %.12g",
                          at.s.value);
        return FST_OK;
    }
    return tell(i, FST_SPECIAL_FOLD, &at, 0, NULL, error);
}

static fst_status report_other(const interval *i, int test, const fst_node *at, fst_error *error)
{
    fst_node born;
    fst_error ignored;
    fst_status switched = FST_NO_CONVERGENCE;
    fst_special_type type = FST_SPECIAL_ORIGIN_CROSSING;
    const int orbit = at->s.segments > 0;
    int criticality = 0;
    if (test == FST_TEST_MINUS) {
        type = at->s.symmetric ? FST_SPECIAL_PITCHFORK : FST_SPECIAL_PERIOD_DOUBLING;
        switched = fst_switch_at_minus_one(i->family, at, &born, &ignored);
    } else if (test == FST_TEST_PAIR) {
        const double frequency = fst_pair_frequency(orbit ? &at->s : &i->b->s);
        type = orbit ? FST_SPECIAL_NEIMARK_SACKER : FST_SPECIAL_HOPF;
        criticality = fst_pair_criticality(i->family, &at->s, frequency);
        if (!orbit)
            switched = fst_switch_at_hopf(i->family, at, frequency, &born, &ignored);
    } else if (test == FST_TEST_PLUS) {
        /* The place itself is known poorly across the curve, for Newton's matrix is singular there. */
        type = is_own_image(&i->a->s) && is_own_image(&i->b->s) ? FST_SPECIAL_PITCHFORK
                                                                : FST_SPECIAL_TRANSCRITICAL;
        if (!orbit)
            switched = fst_switch_at_pitchfork(i->family, at, &born, &ignored);
    }
    const int found = switched == FST_OK;
    if (found && !criticality && type != FST_SPECIAL_TRANSCRITICAL)
        criticality = criticality_of(i->a, i->b, at, &born);
    return tell(i, type, at, criticality, found && i->sink->follow ? &born : NULL, error);
}

/* Whether more became unstable, or stable, between two nodes than the tests that change sign account for: as
 * where a pair crosses the border and meets on the real axis right after. */
static int hides_something(const fst_node *a, const fst_node *b)
{
    const int change = abs(fst_count_unstable(&a->s) - fst_count_unstable(&b->s));
    const int pairs = abs(fst_count_unstable_pairs(&a->s) - fst_count_unstable_pairs(&b->s));
    return change > 2 ||
           change > 2 * pairs + fst_test_changes(a, b, FST_TEST_MINUS) + fst_test_changes(a, b, FST_TEST_PLUS);
}

/* The last two solutions that have the rest or flight which appears at a grazing. */
typedef struct appearing {
    double at[2], shortest[2]; /* the later one first; NAN: not known */
} appearing;

/* Where it is nothing.  It lasts as long as a push, or a slip, stays beyond the summit of a parabola: its time grows as
 * the root of the distance, and its square straight.  While one is known, by the usual slope, over `unit`, the way of
 * length 1 towards the grazing. */
static double appears_at(const appearing *past, double unit)
{
    const double one = past->shortest[0] * past->shortest[0], two = past->shortest[1] * past->shortest[1];
    return isnan(two) ? past->at[0] + 2.0 * one * unit
                      : past->at[0] + one * (past->at[1] - past->at[0]) / (one - two);
}

/* Where between `at` to look for a grazing next that is thought to be at `place`, and need not be known closer than
 * `close`: the end further away comes near to it.  `blind` tries before told nothing of the place. */
static double guess_grazing(const appearing *past, double place, const double at[2], double close, int blind)
{
    const double gap = at[1] - at[0], middle = at[0] + 0.5 * gap;
    if (blind > 1 || (isnan(past->at[1]) && !(place > at[0] && place < at[1])))
        return middle;
    const int near = place > middle;
    const double off = fmax((near ? at[1] - place : place - at[0]), 0.0);
    const double beyond = blind || off == 0.0 ? 0.1 * gap : off + fmax(0.05 * off, 0.4 * close);
    return beyond >= gap ? middle : near ? at[1] - beyond : at[0] + beyond;
}

/* Dry friction: between a and b an orbit gains or loses a rest or a flight, where a slip just dies, or a push just passes
 * the edge of the cone of static friction.  The place is known as well as solutions can be found beside it,
 * where the return has a kink or a jump.  The closer they are, the dearer: the slip dies ever more slowly.  Brings the
 * solutions beside it, at the places `at`, closer; which of the two is the closer one. */
static int enclose_grazing(const interval *i, const fst_family *family, double at[2], fst_node beside[2])
{
    enum { TRIES = 14 };
    const double length = i->b->length, wide = 0.01;
    const int rests = i->b->captures > i->a->captures;
    const double unit = (rests ? -1.0 : 1.0) / length, close = GAP_AT_GRAZING / length;
    appearing past = {.at = {at[rests], NAN}, .shortest = {beside[rests].shortest, NAN}};
    fst_node middle;
    fst_error ignored;
    int blind = 0; /* tries in a row on the side without it that left more than half of the way */
    for (int k = 0; k < TRIES && at[1] - at[0] > close; ++k) {
        const double gap = at[1] - at[0];
        const double x = guess_grazing(&past, appears_at(&past, unit), at, close, blind);
        const int from = x - at[0] > at[1] - x;
        beside[1].length = gap * length;
        /* Near a kink the tangent on its own side is the better guide. */
        const fst_status status =
            gap * length > wide
                ? fst_node_between(family, &beside[0], &beside[1], (x - at[0]) / gap, &middle, &ignored)
                : fst_node_ahead(family, &beside[from], (x - at[from]) * length, &middle, &ignored);
        if (status != FST_OK)
            break;
        const int side = middle.captures != i->a->captures;
        at[side] = x;
        beside[side] = middle;
        if (side == rests)
            past = (appearing){{x, past.at[0]}, {middle.shortest, past.shortest[0]}};
        blind = side != rests && blind < 2 && at[1] - at[0] > 0.5 * gap ? blind + 1 : 0;
    }
    return at[1] - appears_at(&past, unit) < appears_at(&past, unit) - at[0];
}

/* The same from a and b, by rough integrations; only the solutions that it ends with are made exact. */
static int find_grazing(const interval *i, double at[2], fst_node beside[2])
{
    fst_family eased = *i->family;
    fst_error ignored;
    eased.tolerance = fmax(eased.tolerance, 1e-9);
    eased.residual = 1e-7;
    at[0] = 0.0, at[1] = 1.0;
    beside[0] = *i->a, beside[1] = *i->b;
    (void)enclose_grazing(i, &eased, at, beside);
    for (int side = 0; side < 2; ++side) {
        const fst_node *end = side ? i->b : i->a, rough = beside[side];
        if (at[side] != side && (fst_node_ahead(i->family, &rough, 0.0, &beside[side], &ignored) != FST_OK ||
                                 beside[side].captures != rough.captures)) {
            beside[side] = *end; /* it is closer than the rough one could tell */
            at[side] = side;
        }
    }
    return enclose_grazing(i, i->family, at, beside);
}

static fst_status look_between(const fst_family *family, const fst_curve_sink *sink, const fst_node *a,
                               const fst_node *b, fst_curve_end *end, fst_error *error);

/* Tests may jump there: they are looked at on either side, and across only where it is hardly known. */
static fst_status report_grazing(const interval *i, fst_error *error)
{
    const double much = 1e-3;
    double at[2];
    fst_node beside[2], last = *i->b;
    const int near = find_grazing(i, at, beside);
    fst_status status = fst_watch_ask(i->family->watch, error);
    const double gap = (at[1] - at[0]) * i->b->length;
    beside[0].length = at[0] * i->b->length;
    last.length = (1.0 - at[1]) * i->b->length;
    if (status == FST_OK && at[0] > 0.0)
        status = look_between(i->family, i->sink, i->a, &beside[0], i->end, error);
    if (status == FST_OK && i->end->type == FST_END_NONE)
        status = tell(i, FST_SPECIAL_GRAZING, &beside[near], 0, NULL, error);
    if (status == FST_OK && i->end->type == FST_END_NONE && gap > fmax(much * i->b->length, GAP_AT_GRAZING)) {
        fst_node other = beside[1];
        other.length = gap;
        status = look_between(i->family, i->sink, &beside[0], &other, i->end, error);
    }
    if (status == FST_OK && i->end->type == FST_END_NONE && at[1] < 1.0)
        status = fst_specials_between(i->family, i->sink, &beside[1], &last, i->end, error);
    return status;
}

fst_status fst_specials_between(const fst_family *family, const fst_curve_sink *sink, const fst_node *a,
                                const fst_node *b, fst_curve_end *end, fst_error *error)
{
    const interval i = {family, sink, a, b, end};
    if (!sink->special) /* nobody hears of the points: the end of the curve alone is looked for */
        return fst_test_changes(a, b, FST_TEST_FOLD) ? report_turn(&i, error) : FST_OK;
    return a->s.segments > 0 && a->captures != b->captures ? report_grazing(&i, error)
                                                           : look_between(family, sink, a, b, end, error);
}

/* Look on either side of a solution between the two. */
static fst_status look_in_parts(const interval *i, const fst_node *between, fst_error *error)
{
    fst_node last = *i->b;
    last.length -= between->length;
    const fst_status first = fst_specials_between(i->family, i->sink, i->a, between, i->end, error);
    return first != FST_OK || i->end->type != FST_END_NONE
               ? first
               : fst_specials_between(i->family, i->sink, between, &last, i->end, error);
}

/* What the tests show. */
static fst_status look_between(const fst_family *family, const fst_curve_sink *sink, const fst_node *a,
                               const fst_node *b, fst_curve_end *end, fst_error *error)
{
    const interval i = {family, sink, a, b, end};
    fst_node at;
    fst_error why;
    /* Several crossings in one step may hide each other: look at its halves. */
    const int hides = hides_something(a, b) && b->length > 1e-4;
    if (hides && fst_node_between(family, a, b, 0.5, &at, &why) == FST_OK) {
        at.length = 0.5 * b->length;
        return look_in_parts(&i, &at, error);
    }
    const int turn = fst_test_changes(a, b, FST_TEST_FOLD);
    fst_status status = turn ? report_turn(&i, error) : FST_OK;
    if (hides && end->type == FST_END_NONE)
        doubt(&i);
    for (int test = FST_TEST_FOLD + 1; test < FST_TEST_COUNT && end->type == FST_END_NONE && status == FST_OK;
         ++test) {
        if (!fst_test_changes(a, b, test) || (test == FST_TEST_PLUS && turn))
            continue;
        if (fst_locate_special(family, a, b, test, &at, &why) != FST_OK) {
            if (a->captures == b->captures && at.captures != a->captures && at.length > 1e-4)
                return look_in_parts(&i, &at, error); /* two grazings */
            if (test != FST_TEST_ORIGIN && at.captures == a->captures)
                doubt(&i);
            continue;
        }
        if (test == FST_TEST_PLUS && at.s.segments > 0 && fabs(at.s.tangent.value) < 1e-6) {
            doubt(&i); /* a fold, after which the curve turned back */
            continue;
        }
        if (test == FST_TEST_PLUS && at.s.segments == 0) {
            fst_setup setup;
            at.s.value = at.seen.value = fst_pitchfork_value(family, a, b, &at);
            if (fst_family_setup(family, at.s.value, &setup, &why) == FST_OK)
                at.seen.omega = setup.model.groups.omega;
        }
        if (status == FST_OK)
            status = report_other(&i, test, &at, error);
    }
    return status;
}
