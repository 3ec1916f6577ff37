/* Our logarithm and arctangent against the C library's in long double, in units in the last place.
 * tests: base/elementary.inl
 * labels: long-double */
#include "blocks_ld.h"

#include <float.h>
#include <stdio.h>

/* |value - exact| in units of the last place of a double, or of a long double, near `exact`. */
static double ulps(double value, long double exact)
{
    int exponent;
    (void)frexpl(exact, &exponent);
    return (double)(fabsl(value - exact) / ldexpl(1.0L, exponent - DBL_MANT_DIG));
}

static double ulps_ld(long double value, long double exact)
{
    int exponent;
    (void)frexpl(exact, &exponent);
    return (double)(fabsl(value - exact) / ldexpl(1.0L, exponent - LDBL_MANT_DIG));
}

static double random_scale(uint64_t *seed, double decades)
{
    return exp(uniform(seed, -decades * 2.3, decades * 2.3));
}

static void test_logarithm(void **unused)
{
    (void)unused;
    uint64_t seed = 5;
    double worst = 0, worst_ld = 0;
    for (int i = 0; i < 200000; ++i) {
        const double x = i % 2 ? uniform(&seed, 0.5, 2.0) : random_scale(&seed, 100);
        worst = fmax(worst, ulps(fst_log_of_ratio_double(x, 1, x - 1), logl(x)));
        worst_ld = fmax(worst_ld, ulps_ld(fst_log_of_ratio_long_double(x, 1, (long double)x - 1), logl(x)));
    }
    /* Sum, quotient and result are rounded, half a unit each, and log 2 may take half of what remains away. */
    CHECK_WITHIN(worst, 0.5, 2.0);
    CHECK_WITHIN(worst_ld, 0.5, 2.5);
    CHECK_CLOSE(fst_log_of_ratio_double(1, 1, 0), 0.0, 0.0);
    /* A ratio whose difference is known: log1p. */
    for (int i = 0; i < 1000; ++i) {
        const double f = 0.2 * random_scale(&seed, 1) * pow(10.0, -i % 300);
        CHECK_WITHIN(ulps(fst_log_of_ratio_double(1 + f, 1, f), log1pl(f)), 0.0, 2.6);
    }
}

static void test_angle(void **unused)
{
    (void)unused;
    uint64_t seed = 6;
    double worst = 0, worst_ld = 0;
    for (int i = 0; i < 200000; ++i) {
        const double x = uniform(&seed, -1, 1) * (i % 2 ? 1 : random_scale(&seed, 10));
        const double y = uniform(&seed, -1, 1) * (i % 3 ? 1 : random_scale(&seed, 10));
        worst = fmax(worst, ulps(fst_angle_double(y, x), atan2l(y, x)));
        worst_ld = fmax(worst_ld, ulps_ld(fst_angle_long_double(y, x), atan2l(y, x)));
    }
    CHECK_WITHIN(worst, 0.5, 2.0);
    CHECK_WITHIN(worst_ld, 0.4, 2.5);
    static const double places[][2] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}, {1, 1}, {1, -1}, {-1, -1}, {0, 0}};
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i)
        CHECK_SAME_BITS(fst_angle_double(places[i][0], places[i][1]), atan2(places[i][0], places[i][1]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_logarithm), cmocka_unit_test(test_angle)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
