/* How a run ends: at the first of two bounds that are met in one step, and at once if its caller says so.
 * tests: study/watched_run.c observe/returns.c
 * labels: bits */
#include "physics.h"

#include "ode/flow.h"

enum { EDGE, LIFT };

static fst_params flying_bead(void)
{
    fst_params p = bead_at(0.31, FST_DYNAMICS_RIGID);
    p.run_periods = 40;
    p.run_discard = 0;
    return p;
}

/* r and the upward pull on the bead at a fraction of the flow's last step. */
static void look(fst_flow *flow, double x, double value[2])
{
    value[EDGE] = flow->groups.plate_radius - fst_flow_function_at(flow, x, fst_edge_function);
    value[LIFT] = flow->groups.gravity - fst_flow_function_at(flow, x, fst_load_function);
}

/* The plate ends where the bead is at one fraction of a step, and its weight is what the magnet lifts at
 * another: the run ends at whichever comes first. */
static void test_the_earlier_of_two_bounds(void **unused)
{
    (void)unused;
    fst_params p = flying_bead();
    const fst_params bead = p;
    const double acceleration = p.magnet_half_length * p.friction_gamma * p.friction_gamma;
    p.plate_radius = 1e3 * p.magnet_half_length;
    p.plate_gravity = 999.9;
    fst_model *model = model_of(&p);
    int tried = 0;
    for (int i = 0; i < 40 && tried < 6; ++i) {
        double start[FST_STATE_SIZE], most[2] = {0.0, -INFINITY}, n[3], norm = 0.0, grad[3][3];
        start_of(&p, model, start);
        for (int k = 0; k < 4; ++k)
            start[k] = 0.0;
        start[FST_X] = 0.2 + 0.01 * i;
        start[FST_VX] = 0.2 + 0.005 * i;
        fst_field(model, start[FST_X], 0.0, n, grad);
        for (int k = 0; k < 3; ++k)
            norm += n[k] * n[k];
        for (int k = 0; k < 3; ++k)
            start[FST_NX + k] = -n[k] / sqrt(norm); /* so that the magnet pushes the bead up */
        fst_flow *flow = flow_of(model, p.run_rtol, start);
        for (int step = 0; step < 60 && flow->t.high < 30.0; ++step) {
            double at[5][2];
            int rises = step > 0;
            assert_int_equal(fst_flow_step(flow, 1e3, NULL), FST_OK);
            for (int k = 0; k < 5; ++k)
                look(flow, 0.25 * k, at[k]);
            for (int which = 0; which < 2; ++which) {
                for (int k = 1; k < 5; ++k)
                    rises = rises && at[k][which] > at[k - 1][which] && at[k][which] > most[which];
                most[which] = fmax(most[which], fmax(at[0][which], at[4][which]));
            }
            if (!rises || !(at[1][LIFT] > 0))
                continue;
            for (int first = 0; first < 2; ++first) {
                fst_params q = bead;
                fst_run_options options = fst_default_run_options();
                fst_run_result r;
                q.plate_radius = at[first == EDGE ? 1 : 3][EDGE] * q.magnet_half_length;
                q.plate_gravity = at[first == LIFT ? 1 : 3][LIFT] * acceleration;
                options.start = start;
                assert_int_equal(fst_run(&q, &options, &r, NULL), FST_OK);
                assert_int_equal(r.regime, first == EDGE ? FST_REGIME_EJECTED : FST_REGIME_LIFTED);
                CHECK_CLOSE(r.end_time, fst_flow_time(flow, 0.25).high, 1e-6);
            }
            tried += 1;
            break;
        }
        fst_flow_free(flow);
    }
    fst_model_free(model);
    assert_true(tried > 2);
}

typedef struct patience {
    int calls, most;
} patience;

static fst_status lose_patience(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    patience *p = user;
    (void)error;
    CHECK_WITHIN(fraction, 0.0, 1.0);
    p->calls += 1;
    return p->calls > p->most ? FST_INTERRUPTED : FST_OK;
}

/* A caller that ends the run is not asked again. */
static void test_progress_that_says_stop(void **unused)
{
    (void)unused;
    for (int most = 0; most < 5; ++most) {
        fst_params p = bead_at(0.31, FST_DYNAMICS_RIGID);
        fst_run_options options = fst_default_run_options();
        fst_run_result r;
        patience caller = {0, most};
        const fst_progress progress = {&caller, lose_patience};
        options.progress = &progress;
        assert_int_equal(fst_run(&p, &options, &r, NULL), FST_INTERRUPTED);
        assert_int_equal(caller.calls, most + 1);
    }
}

/* A bead that turns at first and is then caught does not turn regularly: its means are over the whole window,
 * not over the turning alone, and no direction follows from them. */
static void test_a_bead_that_was_caught(void **unused)
{
    (void)unused;
    for (int i = 0; i < 3; ++i) {
        fst_params p = bead_at(0.175 + 0.00125 * i, FST_DYNAMICS_RIGID);
        p.run_discard = 0;
        p.run_periods = 40;
        p.run_rtol = 1e-8;
        const fst_run_result r = run_of(&p);
        assert_true(r.returns >= 6); /* the bead did turn */
        CHECK_CLOSE(r.window_periods, 40, 1.0);
        assert_true(r.regime != FST_REGIME_COUNTER_ROTATING && r.regime != FST_REGIME_COROTATING);
        assert_null(fst_symmetry_name(r.symmetry));
    }
}

/* A bead that turns to and fro makes no whole returns: its means are over whole drive periods. */
static void test_turning_to_and_fro(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.5, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_NONE;
    p.start_r = 1.5;
    p.start_spin = FST_SPIN_REST;
    p.run_periods = 80;
    p.run_discard = 20;
    const fst_run_result r = run_of(&p);
    assert_true(r.returns > 20);
    CHECK_CLOSE(r.window_periods, 60, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_earlier_of_two_bounds),
        cmocka_unit_test(test_progress_that_says_stop),
        cmocka_unit_test(test_a_bead_that_was_caught),
        cmocka_unit_test(test_turning_to_and_fro),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
