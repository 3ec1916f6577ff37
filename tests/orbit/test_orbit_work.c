/* Beside a bifurcation the bead settles slowly and Newton's method converges slowly: the orbit of a start must
 * still be found with little work, counted in evaluations of the equations of motion. One attempt by Newton's
 * method costs some 10^4 of them, following the bead for 400 drive periods some 10^5.
 * tests: orbit/departure.c orbit/search.c
 * labels: counted numbers */
#include "branches.h"

#include "count/count_evaluations.h"

static fst_orbit found(double omega, const char *dynamics, long long most)
{
    const fst_params params = scene_of(omega, dynamics);
    fst_orbit orbit;
    fst_error error;
    const long long before = fst_test_evaluations;
    if (fst_orbit_find(&params, NULL, &orbit, &error) != FST_OK)
        fail_msg("%s at %.10g: %s", dynamics, omega, error.sentence);
    print_message("%s at %.10g: %lld evaluations\n", dynamics, omega, fst_test_evaluations - before);
    if (fst_test_evaluations - before > most)
        fail_msg("%s at %.10g: %lld evaluations, expected at most %lld", dynamics, omega,
                 fst_test_evaluations - before, most);
    assert_true(orbit.stable);
    assert_true(orbit.residual < 1e-12);
    return orbit;
}

/* The square of a libration's amplitude grows in proportion to the distance from its supercritical Hopf point.
 */
static void beside_hopf_points(void **state)
{
    static const struct {
        const char *dynamics;
        double hopf;
    } points[] = {{"rigid", 0.092106345}, {"farago2020", 0.098864612}};
    static const double away[] = {1e-5, 4.3655e-5, 9.3655e-5, 4e-4, 9e-4};
    (void)state;
    for (size_t k = 0; k < sizeof points / sizeof *points; ++k) {
        double ratio = 0.0;
        for (size_t i = 0; i < sizeof away / sizeof *away; ++i) {
            const fst_orbit o = found(points[k].hopf + away[i], points[k].dynamics, 350000);
            assert_int_equal(o.turns, 0);
            const double here = o.means.std_r * o.means.std_r / away[i];
            if (i > 0)
                CHECK_CLOSE(here / ratio, 1.0, 0.02);
            ratio = here;
        }
    }
}

/* Both sides of the period halving; below it |<n_z>| falls as the root of the distance. */
static void beside_the_period_halving(void **state)
{
    static const double away[] = {-5.3e-5, -3.4e-6, -3.4e-8, 6.6e-8, 6e-6, 5e-5};
    const double at = 0.268853034;
    double ratio = 0.0;
    (void)state;
    for (size_t i = 0; i < sizeof away / sizeof *away; ++i) {
        const fst_orbit o = found(at + away[i], "rigid", 300000);
        assert_int_equal(o.symmetry, away[i] < 0 ? FST_SYMMETRY_S1 : FST_SYMMETRY_S2);
        if (away[i] >= 0)
            continue;
        const double here = fabs(o.means.mean_nz) / sqrt(-away[i]);
        if (i > 0)
            CHECK_CLOSE(here / ratio, 1.0, 0.03);
        ratio = here;
    }
}

static void below_the_fold(void **state)
{
    static const double away[] = {1e-6, 1e-5, 1e-4, 1e-3};
    (void)state;
    for (size_t i = 0; i < sizeof away / sizeof *away; ++i) {
        (void)found(3.389510252 - away[i], "rigid", 250000);
        (void)found(2.363533439 - away[i], "farago2020", 250000);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beside_hopf_points),
        cmocka_unit_test(beside_the_period_halving),
        cmocka_unit_test(below_the_fold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
