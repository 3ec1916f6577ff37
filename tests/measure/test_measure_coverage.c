/* The errors of fst_measure_track() cover: of 500 films of beads that the library moves, with every fault that
 * a film may have, about 68 of 100 numbers lie within one error of the truth, and about 95 within two.
 * tests: measure/measure.c measure/errors.c
 * labels: long */
#include "measure_coverage.h"

#include <string.h>

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

/* Of films of one to two seconds all numbers that there are, by the table of measures. */
static void test_films_of_a_second(void **state)
{
    static const double drives[2] = {10.7, 16.0};
    made_motion motions[2];
    coverage c = {.counted = 0};
    uint64_t chance = 20260106;
    double noise = 0.0;
    (void)state;
    for (int i = 0; i < fst_measured_count(); ++i) {
        const char *name = fst_measured_at(i)->name;
        int known = strstr("scale_error noise turns settled_after_s fps", name) != NULL;
        for (int q = 0; q < COVERED; ++q)
            known |= strncmp(name, covered_names[q], strlen(covered_names[q])) == 0;
        if (!known)
            fail_msg("%s is compared with no truth", name);
    }
    make_motions(motions, drives, 2, 3.0);
    for (int i = 0; i < 400; ++i) {
        int has_drive;
        made_film film = random_film(&chance, 6.0, &has_drive);
        film.seconds = 1.0 + made_chance(&chance);
        film.fps = fmax(film.fps, 100.0);
        const fst_measurement m = cover_film(&c, i, &motions[i % 2], &film, has_drive);
        CHECK_CLOSE(m.fps, film.fps, 1.1e-3 * film.fps); /* 239.76 and 240 are too near to choose between */
        CHECK_CLOSE(m.turns, film.seconds * fabs(motions[i % 2].bead), 0.3);
        noise += m.noise / film.noise;
        assert_true(!(m.settled_after_s > 0.5 * film.seconds) && isnan(m.scale_error));
    }
    CHECK_CLOSE(noise / c.counted, 1.0, 0.05);
    judge_coverage(&c, 3.0, 0.3 * c.counted);
    for (int i = 0; i < 2; ++i)
        made_motion_free(&motions[i]);
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
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_500_films),         cmocka_unit_test(test_short_films),
        cmocka_unit_test(test_films_of_a_second), cmocka_unit_test(test_coarse_films),
        cmocka_unit_test(test_settling_films),    cmocka_unit_test(test_clockless_films)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
