/* The orbit of a start is the one on which a simulation from that start ends: of two conjugate ones (each the
 * image of the other under S2, with opposite <n_z>) the right one.
 * tests: orbit/search.c
 * labels: numbers */
#include "branches.h"

enum { STARTS = 48 };

/* Element `index` of the van der Corput sequence in base `base`. */
static double spread(int index, int base)
{
    double value = 0.0, digit = 1.0 / base;
    for (; index > 0; index /= base, digit /= base)
        value += digit * (index % base);
    return value;
}

static fst_params start_number(int i)
{
    const double omega = i % 4 == 3 ? 0.3 + 1.5 * spread(i, 2) : 0.16 + 0.125 * spread(i, 2);
    fst_params params = scene_of(omega, i % 2 ? "rigid" : "farago2020");
    params.start_r = 0.5 + 0.8 * spread(i, 3);
    params.start_phi = 360.0 * spread(i, 5);
    params.start_spin = i % 3 ? FST_SPIN_ROLLING : FST_SPIN_REST;
    return params;
}

/* Simulates a start; returns whether it ends on an orbit. */
static int simulate(fst_params params, fst_run_result *run)
{
    fst_error error;
    params.run_periods = 400.0;
    params.run_discard = 300.0;
    const fst_run_options options = fst_default_run_options();
    if (fst_run(&params, &options, run, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return run->regime == FST_REGIME_COUNTER_ROTATING || run->regime == FST_REGIME_LIBRATING;
}

static void a_simulation_ends_on_the_orbit(void **state)
{
    int above[2] = {0, 0}, below[2] = {0, 0}, librations = 0, compared = 0;
    (void)state;
    for (int i = 1; i <= STARTS; ++i) {
        const fst_params params = start_number(i);
        fst_orbit orbit;
        fst_run_result run;
        fst_error error;
        if (fst_orbit_find(&params, NULL, &orbit, &error) != FST_OK || !simulate(params, &run))
            continue;
        compared += 1;
        /* A run's window holds no whole number of librations, and may still hold the end of the transient. */
        const double off = 2e-3, split = orbit.relaxation_time < 2000.0 ? 5e-3 : 0.05;
        if (run.regime != orbit.means.regime || !(fabs(run.mean_r - orbit.means.mean_r) < off) ||
            !(fabs(run.mean_nz - orbit.means.mean_nz) < split))
            fail_msg("start %d (omega = %.10g, r = %g, Phi = %g): the run has <r> = %.9g, <n_z> = %.9g; the "
                     "orbit %.9g, %.9g",
                     i, run.omega, params.start_r, params.start_phi, run.mean_r, run.mean_nz,
                     orbit.means.mean_r, orbit.means.mean_nz);
        if (orbit.symmetry == FST_SYMMETRY_S1) {
            above[i % 2] += orbit.means.mean_nz > 0.02;
            below[i % 2] += orbit.means.mean_nz < -0.02;
        }
        librations += orbit.turns == 0;
    }
    print_message("%d compared, %d librations; of both signs %d and %d, %d and %d\n", compared, librations,
                  above[0], below[0], above[1], below[1]);
    for (int dynamics = 0; dynamics < 2; ++dynamics) /* both conjugates are met with both dynamics */
        assert_true(above[dynamics] >= 3 && below[dynamics] >= 3);
    assert_true(compared >= 30);
    assert_true(librations >= 3);
}

/* The image of a start under S2 leads to the image of the orbit. */
static void an_image_leads_to_the_image(void **state)
{
    (void)state;
    fst_params params = scene_of(0.2151362649, "rigid");
    fst_orbit orbit[2];
    fst_error error;
    for (int half = 0; half < 2; ++half) {
        params.start_phi = 40.0 + 180.0 * half;
        if (fst_orbit_find(&params, NULL, &orbit[half], &error) != FST_OK)
            fail_msg("%s", error.sentence);
    }
    assert_true(fabs(orbit[0].means.mean_nz) > 0.2);
    CHECK_CLOSE(orbit[0].means.mean_nz + orbit[1].means.mean_nz, 0.0, 1e-10);
    CHECK_CLOSE(orbit[0].means.mean_r - orbit[1].means.mean_r, 0.0, 1e-10);
    CHECK_CLOSE(orbit[0].multiplier_re[0] - orbit[1].multiplier_re[0], 0.0, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_simulation_ends_on_the_orbit),
        cmocka_unit_test(an_image_leads_to_the_image),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
