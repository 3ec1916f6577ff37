/* run.controller: damped takes fewer evaluations than plain for the same error, keeps the order of the method
 * and the balance of energy, and says the same of a motion. */
#include "physics.h"

static const double OMEGAS[] = {0.25, 0.352, 0.405, 0.6, 0.9};
enum { BEADS = 5, PERIODS = 20 };

typedef struct end {
    double state[FST_STATE_SIZE];
    uint64_t rhs_calls, accepted, rejected;
} end;

static end end_of(const fst_model *model, const double *start, double tolerance, fst_controller controller,
                  double t)
{
    fst_flow_options options = fst_default_flow_options();
    options.rtol = tolerance;
    options.controller = controller;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = tolerance;
    fst_flow *flow;
    assert_int_equal(fst_flow_new(model, &options, start, &flow, NULL), FST_OK);
    (void)advance_to(flow, t, 0);
    const fst_flow_info info = fst_flow_get(flow);
    end e = {.rhs_calls = info.rhs_calls, .accepted = info.accepted, .rejected = info.rejected};
    memcpy(e.state, info.state, sizeof e.state);
    fst_flow_free(flow);
    return e;
}

/* With a method of order 8 the error falls as the eighth power of the number of evaluations, so that their
 * logarithms add up to a cost, log(calls) + log(error)/8, that does not depend on the tolerance. */
static void test_fewer_evaluations_at_equal_error(void **unused)
{
    (void)unused;
    double cost[2] = {0, 0};
    uint64_t steps[2] = {0, 0}, rejected[2] = {0, 0};
    int count = 0;
    for (int b = 0; b < BEADS; ++b) {
        const fst_params p = bead_at(OMEGAS[b], FST_DYNAMICS_RIGID);
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE];
        start_of(&p, model, start);
        const double t = PERIODS * TWO_PI / OMEGAS[b];
        const end reference = end_of(model, start, 1e-14, FST_CONTROLLER_PLAIN, t);
        for (double tolerance = 1e-7; tolerance > 5e-12; tolerance /= 3, ++count)
            for (int c = 0; c < 2; ++c) {
                const end e = end_of(model, start, tolerance, (fst_controller)c, t);
                const double error = greatest_difference(e.state, reference.state, FST_STATE_SIZE);
                CHECK_WITHIN(error, 0.005 * tolerance, 20 * tolerance);
                cost[c] += log((double)e.rhs_calls) + log(error) / 8;
                steps[c] += e.accepted + e.rejected;
                rejected[c] += e.rejected;
            }
        fst_model_free(model);
    }
    CHECK_WITHIN(exp((cost[1] - cost[0]) / count), 0.85, 0.95);
    assert_true(rejected[0] > steps[0] / 20 && rejected[1] < steps[1] / 50);
}

/* The energy that the drive brings and friction takes away is accounted for; regime and means are those of the
 * plain controller, to what the tolerance makes of them. */
static void test_same_motion(void **unused)
{
    (void)unused;
    for (int dry = 0; dry < 2; ++dry) {
        fst_run_result results[2];
        for (int c = 0; c < 2; ++c) {
            fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
            p.friction_law = dry ? FST_FRICTION_COULOMB : FST_FRICTION_VISCOUS;
            p.run_periods = 60;
            p.run_discard = 40;
            fst_error error = {FST_OK, "", ""};
            p.run_controller = c;
            const fst_run_options options = fst_default_run_options();
            if (fst_run(&p, &options, &results[c], &error) != FST_OK)
                fail_msg("%s", error.sentence);
            CHECK_WITHIN(results[c].energy_residual, 0, 1e-8);
        }
        assert_int_equal(results[0].regime, results[1].regime);
        CHECK_CLOSE(results[1].mean_r, results[0].mean_r, 1e-8);
        CHECK_CLOSE(results[1].mean_alpha_dot, results[0].mean_alpha_dot, 1e-8);
        CHECK_CLOSE(results[1].festoons, results[0].festoons, 1e-7);
        assert_true(results[1].rhs_calls != results[0].rhs_calls);
    }
}

/* Steps of splitting are fixed: there is no size to choose. */
static void test_refused_where_steps_are_fixed(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.run_method = FST_METHOD_SPLITTING;
    p.run_controller = FST_CONTROLLER_DAMPED;
    fst_error error;
    assert_int_equal(fst_params_check_effects(&p, &error), FST_BAD_INPUT);
    assert_string_equal(error.where, "run.controller");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fewer_evaluations_at_equal_error),
        cmocka_unit_test(test_same_motion),
        cmocka_unit_test(test_refused_where_steps_are_fixed),
    };
    return cmocka_run_group_tests_name("controller", tests, NULL, NULL);
}
