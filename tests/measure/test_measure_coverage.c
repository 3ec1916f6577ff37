/* The errors of fst_measure_track() cover: of 500 films of beads that the library moves, with every fault that
 * a film may have, about 68 of 100 numbers lie within one error of the truth, and about 95 within two.
 * tests: measure/measure.c measure/errors.c
 * labels: long */
#include "measure_coverage.h"

static void test_500_films(void **state)
{
    (void)state;
    check_coverage(MOTIONS, 500, 0, 0);
}

static void test_short_films(void **state)
{
    (void)state;
    check_coverage(MOTIONS, 500, 3.0, 8.0);
}

static void test_coarse_films(void **state)
{
    (void)state;
    check_coarse_coverage(MOTIONS, 500);
}

static void test_settling_films(void **state)
{
    (void)state;
    check_settling_coverage(MOTIONS, 300);
}

static void test_clockless_films(void **state)
{
    (void)state;
    check_clockless_coverage(MOTIONS, 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_500_films), cmocka_unit_test(test_short_films),
                                       cmocka_unit_test(test_coarse_films),
                                       cmocka_unit_test(test_settling_films),
                                       cmocka_unit_test(test_clockless_films)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
