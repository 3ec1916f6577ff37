/* Dry friction against time stepping that knows neither modes nor events: Moreau-Jean steps whose contact
 * Siconos solves (moreau_jean.h).  Their order is 1; extrapolated, their mean of r is that of a run.
 * tests: ode/contact.c
 * labels: long siconos */
#include "physics.h"

#include "moreau_jean.h"

enum { DISCARD = 4, TURNS = 12, HALVINGS = 3 };

static fst_params dry_bead(double mu, double frequency)
{
    fst_params p = fst_default_params();
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = mu;
    p.drive_frequency = frequency;
    return p;
}

/* The mean of r of a run of which the start is already part of the motion, and a state of it. */
static double mean_of_run(fst_params p, double *state)
{
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    fst_error error = {FST_OK, "", ""};
    p.run_rtol = 1e-12;
    for (int i = 0; i < 2; ++i) {
        options.start = i ? state : NULL;
        if (fst_run(&p, &options, &result, &error) != FST_OK)
            fail_msg("fst_run: %s", error.sentence);
        memcpy(state, result.final_state, sizeof result.final_state);
        CHECK_WITHIN(result.sticking, 0.05, 0.95);
    }
    return result.mean_r;
}

static double mean_by_steps(const fst_model *model, double mu, const double *start, double h, int early,
                            int solver)
{
    moreau_jean stepper;
    double end = 0.0;
    moreau_jean_begin(&stepper, model, mu, start, h, solver, 1e-12);
    stepper.early = early;
    const double mean = moreau_jean_mean_r(&stepper, DISCARD, TURNS, 2000.0, &end);
    assert_int_equal(stepper.failures, 0);
    moreau_jean_end(&stepper);
    return mean;
}

/* The error halves with h, and twice the finer mean less the coarser one is 20 times closer. */
static void check_order(double mu, double frequency, int early, double h)
{
    fst_params p = dry_bead(mu, frequency);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], mean[HALVINGS + 1];
    const double exact = mean_of_run(p, start);
    for (int i = 0; i <= HALVINGS; ++i)
        mean[i] =
            mean_by_steps(model, mu, start, h / (1 << i), early, SICONOS_FRICTION_3D_ONECONTACT_QUARTIC_NU);
    for (int i = 0; i < HALVINGS; ++i) {
        const double error = mean[i + 1] - exact, extrapolated = 2.0 * mean[i + 1] - mean[i];
        const double order = log2((mean[i] - exact) / error);
        print_message("mu %g, %g Hz, h %g: error %.2e, order %.3f, extrapolated %.2e\n", mu, frequency,
                      h / (2 << i), error, order, extrapolated - exact);
        CHECK_CLOSE(order, 1.0, 0.07);
        CHECK_CLOSE(extrapolated, exact, 0.05 * fabs(error));
    }
    fst_model_free(model);
}

static void test_order(void **unused)
{
    (void)unused;
    check_order(0.2, 10.7, 0, 2e-3);
    check_order(0.3, 10.7, 0, 5e-4);
    check_order(0.2, 20.0, 0, 5e-4);
    check_order(0.2, 10.7, 1, 5e-4);
}

/* Another solver of Siconos finds the same contact. */
static void test_solvers(void **unused)
{
    (void)unused;
    fst_params p = dry_bead(0.2, 10.7);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    (void)mean_of_run(p, start);
    const double one = mean_by_steps(model, 0.2, start, 0.01, 0, SICONOS_FRICTION_3D_ONECONTACT_QUARTIC_NU);
    const double other = mean_by_steps(model, 0.2, start, 0.01, 0, SICONOS_FRICTION_3D_NSGS);
    print_message("solvers differ by %.2e\n", one - other);
    CHECK_CLOSE(one, other, 1e-6);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_order), cmocka_unit_test(test_solvers)};
    return cmocka_run_group_tests_name("dry_siconos", tests, NULL, NULL);
}
