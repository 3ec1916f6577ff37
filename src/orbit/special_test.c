/* special_test.c - tests for special points, and where they vanish.
 *
 * A test is a number of a solution that changes its sign at special points of one kind:
 *
 *     FOLD      the tangent's part along the parameter       the curve turns back
 *     MINUS     product of (1 + multiplier)                  pitchfork of an S2 orbit, period doubling
 *     PLUS      product of (multiplier - 1), of an           two curves meet; also zero at a fold
 *               equilibrium: of the eigenvalues
 *     PAIR      |multiplier|^2 - 1, of an equilibrium the    Neimark-Sacker, Hopf
 *               real part, of the pair nearest to zero
 *     ORIGIN    distance from the axis, with its side        the orbit passes through r = 0
 *
 * Products are used, and not single multipliers, because they stay smooth where multipliers meet and exchange
 * their order; complex pairs contribute positive factors, so a product changes its sign with a real multiplier
 * only.  The pair nearest to the border may be another one at the next point; so PAIR asks whether the numbers
 * of unstable pairs and of all unstable directions changed, and the way is halved until one pair is left.
 *
 * The zero is located between two points of a curve by a bracketing method with a bisection every sixth time;
 * each try is a solution interpolated between the two and corrected by Newton's method (node.c).  A test that
 * jumps over zero is not a special point, but an error.  Where curves of equilibria meet, Newton's matrix is
 * singular, and the value is interpolated from solutions a little away on both sides.
 */
#include "orbit/special_test.h"

#include "base/bracket.h"
#include "base/error.h"

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

double fst_pair_frequency(const fst_solution *s)
{
    double frequency = NAN, least = INFINITY;
    for (int i = 0; i < s->multipliers; ++i) {
        const double off = s->segments > 0 ? fabs(hypot(s->re[i], s->im[i]) - 1.0) : fabs(s->re[i]);
        if (s->im[i] > 0 && is_pair(s, i) && off < least) {
            least = off;
            frequency = s->segments > 0 ? atan2(s->im[i], s->re[i]) : s->im[i];
        }
    }
    return frequency;
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

int fst_count_unstable_pairs(const fst_solution *s)
{
    int count = 0;
    for (int i = 0; i < s->multipliers; ++i)
        if (is_pair(s, i) && (s->segments > 0 ? hypot(s->re[i], s->im[i]) > 1.0 : s->re[i] > 0.0))
            count += 1;
    return count / 2;
}

int fst_count_unstable(const fst_solution *s)
{
    int count = 0;
    for (int i = 0; i < s->multipliers; ++i)
        count += s->segments > 0 ? hypot(s->re[i], s->im[i]) > 1.0 : s->re[i] > 1e-13;
    return count;
}

int fst_test_changes(const fst_node *a, const fst_node *b, int test)
{
    const double fa = fst_test_value(a, test), fb = fst_test_value(b, test);
    if (!isfinite(fa) || !isfinite(fb))
        return 0;
    if (test == FST_TEST_PAIR)
        return fst_count_unstable_pairs(&a->s) != fst_count_unstable_pairs(&b->s) &&
               fst_count_unstable(&a->s) != fst_count_unstable(&b->s);
    if (test == FST_TEST_ORIGIN && a->seen.turns == b->seen.turns)
        return 0;
    return (fa < 0) != (fb < 0);
}

/* Halve the way until the same pair, the one nearest to the border at both ends, changes sides. */
static int narrow_to_one_pair(const fst_family *family, const fst_node *a, const fst_node *b, double *lo,
                              double *hi, double *f_lo, double *f_hi)
{
    const int count_lo = fst_count_unstable_pairs(&a->s), before = fst_count_unstable(&a->s);
    fst_error ignored;
    for (int i = 0; i < 5; ++i) {
        fst_node node;
        const double x = 0.5 * (*lo + *hi);
        if (fst_node_between(family, a, b, x, &node, &ignored) != FST_OK)
            return 0;
        if (fst_count_unstable_pairs(&node.s) != count_lo && fst_count_unstable(&node.s) != before)
            *hi = x, *f_hi = pair_value(&node.s);
        else
            *lo = x, *f_lo = pair_value(&node.s);
    }
    return (*f_lo < 0) != (*f_hi < 0);
}

/* The nearest solutions on either side, between which the next is guessed, and their places on the way. */
typedef struct around {
    fst_node node[2];
    double at[2];
} around;

/* A solution on one side takes the place of that side's, unless both would be too close to show the curve's way. */
static void close_in(around *near, const fst_node *node, double x, int side, double length)
{
    if (fabs(near->at[!side] - x) * length < 1e-5)
        return;
    near->node[side] = *node;
    near->at[side] = x;
    near->node[1].length = (near->at[1] - near->at[0]) * length;
}

fst_status fst_locate_special(const fst_family *family, const fst_node *a, const fst_node *b, int test,
                              fst_node *out, fst_error *error)
{
    fst_bracket z = {0.0, 1.0, fst_test_value(a, test), fst_test_value(b, test), 0};
    const double greatest = fmax(fabs(z.f_lo), fabs(z.f_hi));
    /* Tests of an orbit that is released from rests are known no better (ode/neighbours.c). */
    const double noise = a->captures + b->captures > 0 ? 1e-7 * fmax(1.0, greatest) : 0.0;
    const double known = fmax(1e-8, 10.0 * noise); /* what is no jump */
    const double least = fmax(noise, family->location * (test == FST_TEST_PAIR ? 10.0 : fmin(1.0, greatest)));
    const int curves_meet = test == FST_TEST_PLUS && a->s.segments == 0;
    *out = fabs(z.f_lo) < fabs(z.f_hi) ? *a : *b;
    if (test == FST_TEST_PAIR && !narrow_to_one_pair(family, a, b, &z.lo, &z.hi, &z.f_lo, &z.f_hi))
        return fst_fail(error, FST_NO_CONVERGENCE, "special point", "no single pair crosses at %.10g",
                        a->s.value);
    around near = {{*a, *b}, {0.0, 1.0}};
    for (int i = 0; i < 60 && (z.hi - z.lo) * b->length > 1e-13; ++i) {
        const double x = i % 6 == 5 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
        fst_node node;
        const fst_status status = fst_node_between(family, &near.node[0], &near.node[1],
                                                   (x - near.at[0]) / (near.at[1] - near.at[0]), &node, error);
        /* Where two curves of equilibria meet, Newton's matrix is singular, and its method fails within some
         * 1e-7 of the place.  What was found so near is a place to interpolate about (fst_pitchfork_value). */
        if (status == FST_NO_CONVERGENCE && curves_meet && fabs(fst_test_value(out, test)) < 1e-4 * greatest)
            return FST_OK;
        if (status != FST_OK)
            return status;
        const double f = fst_test_value(&node, test);
        const double moved = fabs(node.s.value - out->s.value);
        *out = node;
        out->length = x * b->length;
        if (a->captures == b->captures && node.captures != a->captures)
            return fst_fail(error, FST_NO_CONVERGENCE, "special point", "two grazings hide it at %.10g",
                            node.s.value);
        if (!isfinite(f))
            return fst_fail(error, FST_NO_CONVERGENCE, "special point", "a test is undefined at %.10g",
                            node.s.value);
        if (fabs(f) <= least ||
            (i > 1 && fabs(f) < fmin(100.0 * least, known) && moved < family->location * family->scale))
            break;
        if (!curves_meet) /* close to the place a solution is known poorly across the curve */
            close_in(&near, &node, x, (f < 0) != (z.f_lo < 0), b->length);
        fst_bracket_take(&z, x, f);
    }
    if (!(fabs(fst_test_value(out, test)) < known))
        return fst_fail(error, FST_NO_CONVERGENCE, "special point", "a test jumps at %.10g", out->s.value);
    return FST_OK;
}

/* At a pitchfork of equilibria Newton's matrix is singular, and solutions near it are known poorly.  A little
 * away they are not: the parameter as a function of the test, by Lagrange's formula through six points around
 * the first estimate `at`, and its value at zero. */
double fst_pitchfork_value(const fst_family *family, const fst_node *a, const fst_node *b, const fst_node *at)
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
