/* special.c - finding what happens between two nodes of a curve. */
#include "orbit/curve.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bracket.h"
#include "base/error.h"
#include "orbit/normal_form.h"

/* ------------------------------------------------------------------ between two nodes */

static double hermite(double a, double ta, double b, double tb, double h, double x)
{
    const double d = b - a, rest = 1.0 - x;
    return a + x * d + x * rest * (rest * (h * ta - d) - x * (h * tb - d));
}

void fst_solution_between(const fst_node *a, const fst_node *b, double x, fst_solution *s)
{
    const fst_direction *ta = &a->s.tangent, *tb = &b->s.tangent;
    const double h = b->length;
    fst_direction step;
    memset(&step, 0, sizeof step);
    *s = a->s;
    for (int i = 0; i < fst_states_of(s); ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            step.y[i][k] = hermite(a->s.y[i][k], ta->y[i][k], b->s.y[i][k], tb->y[i][k], h, x) - a->s.y[i][k];
    step.period = hermite(a->s.period, ta->period, b->s.period, tb->period, h, x) - a->s.period;
    step.value = hermite(a->s.value, ta->value, b->s.value, tb->value, h, x) - a->s.value;
    s->on_section = 0;
    fst_solution_move(s, &step, 1.0);
}

fst_status fst_node_between(const fst_family *family, const fst_node *a, const fst_node *b, double x,
                            fst_node *out, fst_error *error)
{
    fst_solution s;
    fst_direction way;
    fst_direction_between(&a->s, &b->s, &way);
    fst_solution_between(a, b, x, &s);
    const fst_status status = fst_solution_correct(family, &s, &way, error);
    return status == FST_OK ? fst_node_make(family, &s, out, error) : status;
}

/* ------------------------------------------------------------------ tests */

/* A complex pair that may cross.  The equilibria on the axis have one that never does: friction does not brake
 * the swinging of n about the vertical there, and the real part is zero at every omega. */
static int is_pair(const fst_solution *s, int i)
{
    return fabs(s->im[i]) > 1e-9 * (1.0 + fabs(s->re[i])) && (s->segments > 0 || fabs(s->re[i]) > 1e-13);
}

/* How far the critical complex pair is from the border of stability; NAN without a pair. */
static double pair_value(const fst_solution *s)
{
    double nearest = NAN;
    for (int i = 0; i < s->multipliers; ++i) {
        if (!is_pair(s, i))
            continue;
        const double value = s->segments > 0 ? s->re[i] * s->re[i] + s->im[i] * s->im[i] - 1.0 : s->re[i];
        if (!(fabs(value) >= fabs(nearest)))
            nearest = value;
    }
    return nearest;
}

/* The frequency of the critical pair of an equilibrium. */
static double pair_frequency(const fst_solution *s)
{
    int best = -1;
    for (int i = 0; i < s->multipliers; ++i)
        if (is_pair(s, i) && s->im[i] > 0 && (best < 0 || fabs(s->re[i]) < fabs(s->re[best])))
            best = i;
    return best < 0 ? NAN : s->im[best];
}

/* The angle of the pair of multipliers nearest to the unit circle. */
static double pair_angle(const fst_solution *s)
{
    double angle = NAN, least = INFINITY;
    for (int i = 0; i < s->multipliers; ++i) {
        const double off = fabs(hypot(s->re[i], s->im[i]) - 1.0);
        if (s->im[i] > 0 && is_pair(s, i) && off < least) {
            least = off;
            angle = atan2(s->im[i], s->re[i]);
        }
    }
    return angle;
}

/* The product of (sign + multiplier), or of the eigenvalues: it changes sign with a real one only. */
static double product(const fst_solution *s, double shift)
{
    double re = 1.0, im = 0.0;
    for (int i = 0; i < s->multipliers; ++i) {
        const double a = shift + s->re[i], b = s->im[i], t = re * a - im * b;
        im = re * b + im * a;
        re = t;
    }
    return re;
}

double fst_test_value(const fst_node *node, int test)
{
    const fst_solution *s = &node->s;
    switch (test) {
    case FST_TEST_FOLD:
        return s->tangent.value;
    case FST_TEST_MINUS:
        return s->segments > 0 ? product(s, 1.0) : NAN;
    case FST_TEST_PLUS:
        return product(s, s->segments > 0 ? -1.0 : 0.0);
    case FST_TEST_PAIR:
        return pair_value(s);
    default:
        return node->closest;
    }
}

/* How many multipliers lie outside, pairs alone. */
static int unstable_pairs(const fst_solution *s)
{
    int count = 0;
    for (int i = 0; i < s->multipliers; ++i)
        if (is_pair(s, i) && (s->segments > 0 ? hypot(s->re[i], s->im[i]) > 1.0 : s->re[i] > 0.0))
            count += 1;
    return count / 2;
}

static int unstable(const fst_solution *s)
{
    int count = 0;
    for (int i = 0; i < s->multipliers; ++i)
        count += s->segments > 0 ? hypot(s->re[i], s->im[i]) > 1.0 : s->re[i] > 1e-13;
    return count;
}

static int changes_sign(const fst_node *a, const fst_node *b, int test)
{
    const double fa = fst_test_value(a, test), fb = fst_test_value(b, test);
    if (!isfinite(fa) || !isfinite(fb))
        return 0;
    if (test == FST_TEST_PAIR)
        return unstable_pairs(&a->s) != unstable_pairs(&b->s) && unstable(&a->s) != unstable(&b->s);
    if (test == FST_TEST_ORIGIN && a->seen.turns == b->seen.turns)
        return 0;
    return (fa < 0) != (fb < 0);
}

/* Halve the way until the same pair, the one nearest to the border at both ends, changes sides. */
static int narrow_to_one_pair(const fst_family *family, const fst_node *a, const fst_node *b, double *lo,
                              double *hi, double *f_lo, double *f_hi)
{
    const int count_lo = unstable_pairs(&a->s), before = unstable(&a->s);
    fst_error ignored;
    for (int i = 0; i < 5; ++i) {
        fst_node node;
        const double x = 0.5 * (*lo + *hi);
        if (fst_node_between(family, a, b, x, &node, &ignored) != FST_OK)
            return 0;
        if (unstable_pairs(&node.s) != count_lo && unstable(&node.s) != before)
            *hi = x, *f_hi = pair_value(&node.s);
        else
            *lo = x, *f_lo = pair_value(&node.s);
    }
    return (*f_lo < 0) != (*f_hi < 0);
}

fst_status fst_locate_special(const fst_family *family, const fst_node *a, const fst_node *b, int test,
                              fst_node *out, fst_error *error)
{
    fst_bracket z = {0.0, 1.0, fst_test_value(a, test), fst_test_value(b, test), 0};
    const double least =
        family->location * (test == FST_TEST_PAIR ? 10.0 : fmin(1.0, fmax(fabs(z.f_lo), fabs(z.f_hi))));
    *out = fabs(z.f_lo) < fabs(z.f_hi) ? *a : *b;
    if (test == FST_TEST_PAIR && !narrow_to_one_pair(family, a, b, &z.lo, &z.hi, &z.f_lo, &z.f_hi))
        return fst_fail(error, FST_NO_CONVERGENCE, "special point", "no single pair crosses at %.10g",
                        a->s.value);
    for (int i = 0; i < 60 && (z.hi - z.lo) * b->length > 1e-13; ++i) {
        const double x = i % 6 == 5 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
        fst_node node;
        const fst_status status = fst_node_between(family, a, b, x, &node, error);
        if (status != FST_OK)
            return status;
        const double f = fst_test_value(&node, test);
        const double moved = fabs(node.s.value - out->s.value);
        *out = node;
        if (!isfinite(f))
            return fst_fail(error, FST_NO_CONVERGENCE, "special point", "a test is undefined at %.10g",
                            node.s.value);
        if (fabs(f) <= least || (i > 1 && fabs(f) < 100.0 * least && moved < family->location * family->scale))
            break;
        fst_bracket_take(&z, x, f);
    }
    if (!(fabs(fst_test_value(out, test)) < 1e-8))
        return fst_fail(error, FST_NO_CONVERGENCE, "special point", "a test jumps at %.10g", out->s.value);
    return FST_OK;
}

/* At a pitchfork of equilibria Newton's matrix is singular, and solutions near it are known poorly.  A little
 * away they are not: the parameter as a function of the test, by Lagrange's formula through six points around
 * the first estimate `at`, and its value at zero. */
static double interpolate_pitchfork(const fst_family *family, const fst_node *a, const fst_node *b,
                                    const fst_node *at)
{
    enum { POINTS = 6 };
    double value[POINTS], f[POINTS], sum = 0.0;
    fst_error ignored;
    fst_direction way, part;
    fst_direction_between(&a->s, &b->s, &way);
    fst_direction_between(&a->s, &at->s, &part);
    const double middle =
        fst_direction_product(family, &a->s, &way, &part) / fst_direction_product(family, &a->s, &way, &way);
    for (int i = 0; i < POINTS; ++i) {
        fst_node node;
        const double away = 0.05 * (i < POINTS / 2 ? i - POINTS / 2 : i - POINTS / 2 + 1);
        if (fst_node_between(family, a, b, middle + away, &node, &ignored) != FST_OK)
            return at->s.value;
        value[i] = node.s.value;
        f[i] = fst_test_value(&node, FST_TEST_PLUS);
    }
    for (int i = 0; i < POINTS; ++i) {
        double term = value[i] - at->s.value;
        for (int j = 0; j < POINTS; ++j)
            if (j != i)
                term *= f[j] / (f[j] - f[i]);
        sum += term;
    }
    return fabs(sum) < 1e-5 * family->scale ? at->s.value + sum : at->s.value;
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

static double greatest_difference(const double *a, const double *b)
{
    double greatest = 0.0;
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        greatest = fmax(greatest, fabs(a[k] - b[k]));
    return greatest;
}

/* How an orbit differs from its image under S2. */
static void asymmetry(const fst_solution *s, double difference[FST_STATE_SIZE])
{
    double half[FST_STATE_SIZE];
    half_way(s, half);
    fst_apply_s2(half, difference);
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        difference[k] -= s->y[0][k];
}

/* Whether a curve of orbits without the symmetry passes through one that has it: then it goes on as its own
 * image. */
static int meets_symmetric(const fst_node *a, const fst_node *b)
{
    double at_a[FST_STATE_SIZE], at_b[FST_STATE_SIZE], product_ab = 0.0, size = 0.0;
    if (a->s.segments < 2 || a->s.symmetric || a->seen.turns == 0)
        return 0;
    asymmetry(&a->s, at_a);
    asymmetry(&b->s, at_b);
    for (int k = 0; k < FST_STATE_SIZE; ++k) {
        product_ab += at_a[k] * at_b[k];
        size += at_a[k] * at_a[k] + at_b[k] * at_b[k];
    }
    return product_ab < -0.01 * size;
}

/* Whether it is an equilibrium that S2 maps onto itself, on the axis: there the symmetry can break.  Elsewhere
 * nothing is broken where an eigenvalue passes 0: a family that slips changes places with one that rolls. */
static int is_own_image(const fst_solution *s)
{
    double image[FST_STATE_SIZE];
    fst_apply_s2(s->y[0], image);
    return s->segments == 0 && greatest_difference(image, s->y[0]) < 1e-6;
}

/* How large an orbit is: the way between its states half a period apart. */
static double extent(const fst_solution *s)
{
    double half[FST_STATE_SIZE];
    half_way(s, half);
    return greatest_difference(half, s->y[0]);
}

/* 1 where the new branch lies on the side on which the old one has more unstable directions, -1 on the other.
 */
static int criticality_of(const fst_node *a, const fst_node *b, const fst_node *at, const fst_node *born)
{
    const double moved = born->s.value - at->s.value;
    const int more = unstable(&b->s) - unstable(&a->s);
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
static fst_status report_hopf_end(fst_curve *curve, const fst_node *a, const fst_node *at, double frequency,
                                  fst_error *error)
{
    fst_node beside;
    fst_error ignored;
    int criticality = 0;
    (void)snprintf(curve->reason, sizeof curve->reason, "it shrinks to an equilibrium at %.12g", at->s.value);
    /* Unstable pairs of the equilibrium lie on one side; the orbits on that of a small one, or of the one seen
     * last. */
    fst_node small;
    const int found = fst_switch_at_hopf(curve->family, at, frequency, &small, &ignored) == FST_OK;
    const double step =
        copysign(1e-4 * curve->family->scale, (found ? small.s.value : a->s.value) - at->s.value);
    criticality = fst_pair_criticality(curve->family, &at->s, frequency);
    if (!criticality && middle_of(curve->family, &at->s, at->s.value + step, &beside, &ignored) == FST_OK)
        criticality = growth_at(&beside.s, frequency) > 0 ? 1 : -1;
    return curve->sink.special(curve->sink.user, FST_SPECIAL_HOPF, at, criticality, NULL, error);
}

fst_status fst_look_for_hopf_end(fst_curve *curve, const fst_node *a, const fst_node *b, fst_error *error)
{
    fst_node at;
    const double frequency = 6.283185307179586476925287 / fst_whole_period(&b->s);
    return find_hopf(curve->family, a, b, frequency, &at) ? report_hopf_end(curve, a, &at, frequency, error)
                                                          : FST_OK;
}

/* Whether a curve of equilibria that turns here does so because it meets another: at a fold the equations'
 * derivative by the parameter lies outside the range of the Jacobian, at a pitchfork inside.  The left null
 * vector w tells, found by inverse iteration: w.f_p = 0. */
static int is_branch_point(const fst_family *family, const fst_solution *s)
{
    enum { N = FST_TANGENT_SIZE };
    fst_setup setup;
    double by[FST_STATE_SIZE], basis[FST_STATE_SIZE][N], w[N], along = 0.0, size = 0.0, greatest = 0.0;
    if (fst_family_setup(family, s->value, &setup, NULL) != FST_OK)
        return 0;
    for (int i = 0; i < N; ++i)
        w[i] = 1.0 / (1.0 + i);
    for (int round = 0; round < 3; ++round) {
        double a[N * N], length = 0.0;
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j)
                a[i * N + j] = s->map[j][i] + (i == j ? 1e-10 : 0.0);
        if (family->lapack->solve(N, 1, a, w) != 0)
            return 0;
        for (int i = 0; i < N; ++i)
            length += w[i] * w[i];
        for (int i = 0; i < N; ++i)
            w[i] /= sqrt(length);
    }
    fst_setup_by_parameter(&setup, s->y[0], by);
    fst_tangent_basis(s->y[0], basis);
    for (int j = 0; j < N; ++j) {
        double part = 0.0;
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            part += basis[i][j] * by[i];
        along += w[j] * part;
        size += part * part;
        greatest = fmax(greatest, fabs(w[j] * part));
    }
    return fabs(along) < 1e-3 * fmax(greatest, 0.01 * sqrt(size));
}

/* A curve of orbits went through the equilibrium on which they shrink, from a to b, and comes back on itself:
 * what happens on the way down belongs to it, up to an orbit a twentieth as large as that at a. */
static fst_status look_before_hopf_end(fst_curve *curve, const fst_node *a, const fst_node *b, fst_error *error)
{
    const double x = 0.95 * extent(&a->s) / (extent(&a->s) + extent(&b->s));
    fst_node last;
    fst_error ignored;
    int ends = 0;
    if (fst_node_between(curve->family, a, b, x, &last, &ignored) != FST_OK)
        return FST_OK;
    last.length = x * b->length;
    const fst_status status = fst_specials_between(curve, a, &last, &ends, error);
    return status == FST_OK && !ends ? curve->sink.node(curve->sink.user, &last, error) : status;
}

/* A turn of the parameter between a and b.  The curve of S1 orbits also turns where it meets the symmetric one,
 * and that of librations where they shrink to nothing: there it would only come back on itself. */
static fst_status report_turn(fst_curve *curve, const fst_node *a, const fst_node *b, int *ends,
                              fst_error *error)
{
    fst_node at;
    fst_error why;
    const double frequency = 6.283185307179586476925287 / fst_whole_period(&b->s);
    if (meets_symmetric(a, b)) {
        (void)snprintf(curve->reason, sizeof curve->reason, "it ends on the symmetric branch near %.6g",
                       b->s.value);
        *ends = 1;
        return FST_OK;
    }
    if (find_hopf(curve->family, a, b, frequency, &at)) {
        const fst_status status = look_before_hopf_end(curve, a, b, error);
        *ends = 1;
        return status == FST_OK ? report_hopf_end(curve, a, &at, frequency, error) : status;
    }
    if (fst_locate_special(curve->family, a, b, FST_TEST_FOLD, &at, &why) != FST_OK) {
        if (a->s.segments == 0) { /* Newton's matrix is singular where two curves meet */
            (void)snprintf(curve->reason, sizeof curve->reason, "it ends on another branch near %.6g",
                           b->s.value);
            *ends = 1;
        }
        return FST_OK;
    }
    if (at.s.segments == 0 && is_branch_point(curve->family, &at.s)) {
        (void)snprintf(curve->reason, sizeof curve->reason, "it ends on a branch of higher symmetry at %.12g",
                       at.s.value);
        *ends = 1;
        return FST_OK;
    }
    return curve->sink.special(curve->sink.user, FST_SPECIAL_FOLD, &at, 0, NULL, error);
}

static fst_status report_other(fst_curve *curve, const fst_node *a, const fst_node *b, int test,
                               const fst_node *at, fst_error *error)
{
    fst_node born;
    fst_error ignored;
    fst_status switched = FST_NO_CONVERGENCE;
    fst_special_type type = FST_SPECIAL_ORIGIN_CROSSING;
    const int orbit = at->s.segments > 0;
    int criticality = 0;
    if (test == FST_TEST_MINUS) {
        type = at->s.symmetric ? FST_SPECIAL_PITCHFORK : FST_SPECIAL_PERIOD_DOUBLING;
        switched = fst_switch_at_minus_one(curve->family, at, &born, &ignored);
    } else if (test == FST_TEST_PAIR) {
        const double frequency = orbit ? pair_angle(&at->s) : pair_frequency(&b->s);
        type = orbit ? FST_SPECIAL_NEIMARK_SACKER : FST_SPECIAL_HOPF;
        criticality = fst_pair_criticality(curve->family, &at->s, frequency);
        if (!orbit)
            switched = fst_switch_at_hopf(curve->family, at, frequency, &born, &ignored);
    } else if (test == FST_TEST_PLUS) {
        type = is_own_image(&at->s) ? FST_SPECIAL_PITCHFORK : FST_SPECIAL_TRANSCRITICAL;
        if (!orbit)
            switched = fst_switch_at_pitchfork(curve->family, at, &born, &ignored);
    }
    const int found = switched == FST_OK;
    if (found && !criticality && type != FST_SPECIAL_TRANSCRITICAL)
        criticality = criticality_of(a, b, at, &born);
    return curve->sink.special(curve->sink.user, type, at, criticality, found && curve->follow ? &born : NULL,
                               error);
}

/* Whether more became unstable, or stable, between two nodes than the tests that change sign account for: as
 * where a pair crosses the border and meets on the real axis right after. */
static int hides_something(const fst_node *a, const fst_node *b)
{
    const int change = abs(unstable(&a->s) - unstable(&b->s));
    const int pairs = abs(unstable_pairs(&a->s) - unstable_pairs(&b->s));
    return change > 2 ||
           change > 2 * pairs + changes_sign(a, b, FST_TEST_MINUS) + changes_sign(a, b, FST_TEST_PLUS);
}

fst_status fst_specials_between(fst_curve *curve, const fst_node *a, const fst_node *b, int *ends,
                                fst_error *error)
{
    fst_node at;
    fst_error why;
    /* Several crossings in one step may hide each other: look at its halves. */
    if (hides_something(a, b) && b->length > 1e-4 &&
        fst_node_between(curve->family, a, b, 0.5, &at, &why) == FST_OK) {
        fst_node last = *b;
        at.length = last.length = 0.5 * b->length;
        const fst_status first = fst_specials_between(curve, a, &at, ends, error);
        return first != FST_OK || *ends ? first : fst_specials_between(curve, &at, &last, ends, error);
    }
    const int turn = changes_sign(a, b, FST_TEST_FOLD);
    fst_status status = turn ? report_turn(curve, a, b, ends, error) : FST_OK;
    for (int test = FST_TEST_FOLD + 1; test < FST_TEST_COUNT && !*ends && status == FST_OK; ++test) {
        if (!changes_sign(a, b, test) || (test == FST_TEST_PLUS && turn))
            continue;
        if (fst_locate_special(curve->family, a, b, test, &at, &why) != FST_OK)
            continue;
        if (test == FST_TEST_PLUS && at.s.segments == 0) {
            fst_setup setup;
            at.s.value = at.seen.value = interpolate_pitchfork(curve->family, a, b, &at);
            if (fst_family_setup(curve->family, at.s.value, &setup, &why) == FST_OK)
                at.seen.omega = setup.model.groups.omega;
        }
        if (status == FST_OK)
            status = report_other(curve, a, b, test, &at, error);
    }
    return status;
}
