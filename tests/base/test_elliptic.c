/* The complete elliptic integrals of base/elliptic.inl: against quadrature, limits and a relation, and double
 * against long double.
 * tests: base/elliptic.inl
 * labels: long-double */
#include "both_precisions.h"

#define PI 3.14159265358979323846264338327950288L

/* One integral of the two that are computed at once; the other has other numbers. */
#define ONE_OF_TWO(real)                                                                                       \
    static fst_elliptic_##real mean_##real(REAL_##real a, REAL_##real product, REAL_##real c)                  \
    {                                                                                                          \
        const REAL_##real as[2] = {1, a}, products[2] = {0.75, product}, cs[2] = {0.5, c};                     \
        fst_elliptic_##real e[2];                                                                              \
        fst_elliptic_means_##real(as, products, cs, e);                                                        \
        return e[1];                                                                                           \
    }                                                                                                          \
    static REAL_##real third_##real(const fst_elliptic_##real *m, REAL_##real p)                               \
    {                                                                                                          \
        const fst_elliptic_##real e[2] = {*m, *m};                                                             \
        const REAL_##real ps[2] = {p, 0.8};                                                                    \
        REAL_##real sums[2];                                                                                   \
        fst_elliptic_thirds_##real(e, ps, sums);                                                               \
        return sums[0];                                                                                        \
    }
#define REAL_double double
#define REAL_long_double long double
ONE_OF_TWO(double)
ONE_OF_TWO(long_double)

/* K, E and Pi(alpha^2) of k' = sqrt(1 - k^2) and p = sqrt(1 - alpha^2), from the first step of the mean of 1
 * and k'. */
typedef struct integrals {
    long double k, e, third;
} integrals;

static integrals integrals_ld(long double root, long double p)
{
    const long double c0 = 1 - root * root, c = (1 - root) / 2;
    const fst_elliptic_long_double m = mean_long_double((1 + root) / 2, root, c);
    const long double q = third_long_double(&m, p);
    const long double k = PI / (2 * m.mean);
    return (integrals){k, k * (1 - c0 / 2 - c * c - c * c * c * c * m.squares),
                       k * (1 + (1 - p) * (1 + p) / (p * p) * (1 + q) / 2)};
}

static integrals integrals_double(double root, double p)
{
    const double c0 = (1 - root) * (1 + root), c = (1 - root) / 2;
    const fst_elliptic_double m = mean_double((1 + root) / 2, root, c);
    const double q = third_double(&m, p), k = (double)PI / (2 * m.mean);
    return (integrals){k, k * (1 - c0 / 2 - c * c - c * c * c * c * m.squares),
                       k * (1 + (1 - p) * (1 + p) / (p * p) * (1 + q) / 2)};
}

/* The trapezoidal rule, which is exact to rounding for these periodic functions once the points are many. */
static integrals by_quadrature(long double root, long double p)
{
    enum { POINTS = 4000 };
    integrals sum = {0, 0, 0};
    for (int i = 0; i < POINTS; ++i) {
        const long double angle = PI / 2 * (i + 0.5L) / POINTS, s = sinl(angle), c = cosl(angle);
        const long double delta = sqrtl(c * c + root * root * s * s);
        sum.k += 1 / delta;
        sum.e += delta;
        sum.third += 1 / ((c * c + p * p * s * s) * delta);
    }
    const long double step = PI / 2 / POINTS;
    return (integrals){sum.k * step, sum.e * step, sum.third * step};
}

static void test_quadrature(void **unused)
{
    (void)unused;
    static const long double roots[] = {0.02L, 0.1L, 0.3L, 0.7L, 0.99L, 1.0L};
    static const long double ps[] = {0.7L, 1, 1.3L, 2};
    for (size_t i = 0; i < sizeof roots / sizeof *roots; ++i)
        for (size_t j = 0; j < 2 * sizeof ps / sizeof *ps; ++j) {
            const long double p = j % 2 && ps[j / 2] < 1 ? ps[j / 2] * roots[i] : ps[j / 2];
            const integrals expected = by_quadrature(roots[i], p);
            const integrals found = integrals_ld(roots[i], p);
            CHECK_CLOSE_LD(found.k / expected.k, 1, 2e-18);
            CHECK_CLOSE_LD(found.e / expected.e, 1, 4e-18);
            CHECK_CLOSE_LD(found.third / expected.third, 1, 1e-17);
        }
}

/* Legendre's relation, E K' + E' K - K K' = pi/2, to moduli that quadrature does not reach; and K tends to
 * log(4/k'). */
static void test_relation_and_limit(void **unused)
{
    (void)unused;
    for (long double root = 0.9L; root > 1e-9L; root *= 0.4L) {
        const long double other = sqrtl((1 - root) * (1 + root));
        const integrals a = integrals_ld(root, 1), b = integrals_ld(other, 1);
        CHECK_CLOSE_LD(a.e * b.k + b.e * a.k - a.k * b.k, PI / 2, 5e-18);
    }
    for (double root = 1e-6; root > 1e-14; root *= 0.1) {
        CHECK_CLOSE_LD(integrals_double(root, 1).k, log(4 / root), 1e-11);
        CHECK_CLOSE_LD(integrals_double(root, 1).e, 1, 1e-11);
    }
}

/* What is left once the leading terms are taken away by hand keeps its digits as the modulus goes to zero:
 * 1 - M -> c^2/4 and the sum of squares -> 1/8. */
static void test_small_moduli(void **unused)
{
    (void)unused;
    for (double c = 1e-3; c > 1e-100; c *= 0.01) {
        const fst_elliptic_double m = mean_double(1, (1 - c) * (1 + c), c);
        CHECK_CLOSE(m.below / (c * c / 4), 1, c * c + 4e-16);
        CHECK_CLOSE(m.squares * 8, 1, c * c + 4e-16);
    }
}

static void test_double_rounds_only(void **unused)
{
    (void)unused;
    uint64_t seed = 5;
    double worst[3] = {0, 0, 0};
    for (int trial = 0; trial < 20000; ++trial) {
        const double root = trial % 2 ? uniform(&seed, 0, 1) : pow(10, uniform(&seed, -12, 0));
        const double p = uniform(&seed, sqrt(root) / 2, 2);
        const integrals rounded = integrals_double(root, p), exact = integrals_ld(root, p);
        const long double off[3] = {rounded.k / exact.k - 1, rounded.e / exact.e - 1,
                                    rounded.third / exact.third - 1};
        for (int i = 0; i < 3; ++i)
            worst[i] = fmax(worst[i], (double)fabsl(off[i]));
    }
    CHECK_WITHIN(worst[0], 0, 8e-16);
    CHECK_WITHIN(worst[1], 0, 2e-14); /* near k = 1 a difference of like terms: cylinders do without it */
    CHECK_WITHIN(worst[2], 0, 3e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quadrature),
        cmocka_unit_test(test_relation_and_limit),
        cmocka_unit_test(test_small_moduli),
        cmocka_unit_test(test_double_rounds_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
