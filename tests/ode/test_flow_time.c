/* Time and the drive's phase along a trajectory: exact at a time that was asked for, and without drift after
 * any length of time; and how much of a run is discarded.
 * tests: ode/advance.c ode/trajectory.c model/drive.c */
#include "physics.h"

#include "model/params.h"
#include "ode/flow.h"

static fst_flow *begun(const fst_params *p, fst_model **model)
{
    double start[FST_STATE_SIZE];
    fst_error error = {FST_OK, "", ""};
    fst_flow *flow = NULL;
    const fst_flow_options options = fst_default_flow_options();
    *model = model_of(p);
    if (fst_start_state(p, *model, start, &error) != FST_OK ||
        fst_flow_new(*model, &options, start, &flow, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return flow;
}

/* The flow lands exactly on the time asked for, and asking for it again takes no step. */
static void test_landing_leaves_nothing(void **unused)
{
    (void)unused;
    const fst_params p = bead_at(0.31, FST_DYNAMICS_RIGID);
    fst_model *model;
    fst_flow *flow = begun(&p, &model);
    for (int i = 1; i <= 40; ++i) {
        const double t = 7.1 * i + (i > 20 ? 100.0 / 3.0 : 0.0); /* several steps further */
        fst_stop stop;
        while (flow->t.high < t)
            assert_int_equal(fst_flow_step(flow, t, NULL), FST_OK);
        assert_true(flow->t.high == t);
        assert_true(flow->t.low == 0.0);
        const uint64_t accepted = fst_flow_get(flow).accepted;
        assert_int_equal(fst_flow_next(flow, t, 0, &stop, NULL), FST_OK);
        assert_true(fst_flow_get(flow).accepted == accepted);
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

/* The phase of the drive at times of 10^3 to 10^12, against long double; on a ramp it is the integral of omega.
 */
static void test_the_phase_does_not_drift(void **unused)
{
    (void)unused;
    const long double two_pi = 6.283185307179586476925286766559005768L;
    const fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_model *model;
    fst_flow *flow = begun(&p, &model);
    for (double t = 1000.7; t < 2e12; t *= 7.3) {
        double whole, rest;
        const fst_twofold time = {t, 0.0};
        fst_drive_turns(&flow->drive, time, &whole, &rest);
        const long double turns = (long double)0.3 * (long double)t / two_pi;
        CHECK_WITHIN(rest, 0.0, 1.0);
        assert_true(whole == floor(whole));
        CHECK_CLOSE((double)((long double)whole - turns + (long double)rest), 0.0,
                    1e-15 + 3e-19 * (double)turns);
    }
    fst_flow_begin_ramp(flow, 1e-3);
    for (double t = 0.5; t < 1000.0; t *= 1.9) {
        double whole, rest;
        const fst_twofold time = {t, 0.0};
        fst_drive_turns(&flow->drive, time, &whole, &rest);
        CHECK_CLOSE(fst_drive_rate_double(&flow->drive, time), 0.3 + 1e-3 * t, 1e-15);
        CHECK_CLOSE(whole + rest, (0.3 * t + 0.5e-3 * t * t) / (double)two_pi, 1e-12);
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

/* A bead on which nothing acts goes straight outwards; the plate ends at `edge`. */
static fst_flow *going_outwards(double edge, fst_model **model)
{
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    const double state[FST_STATE_SIZE] = {0.1, 0.02, 0.05, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
    p.friction_law = FST_FRICTION_NONE;
    p.model_kappa = 0.0;
    p.plate_radius = edge * p.magnet_half_length;
    *model = model_of(&p);
    return flow_of(*model, 1e-10, state);
}

/* Two events in one step are reported one after the other, the earlier one first. */
static void test_two_events_in_a_step(void **unused)
{
    (void)unused;
    const unsigned events = FST_AT_SECTION | FST_AT_EDGE;
    fst_model *model;
    fst_flow *flow = going_outwards(1000.0, &model);
    int tried = 0;
    for (int step = 0; step < 400 && tried < 10; ++step) {
        assert_int_equal(fst_flow_step(flow, 1e4, NULL), FST_OK);
        const double *y = flow->step.y, *end = flow->step.end;
        if (!(y[FST_X] * end[FST_X] < 0))
            continue;
        const double x = fst_flow_locate(flow, fst_section_function, 0.0, 1.0, y[FST_X], end[FST_X]);
        double at[FST_STATE_SIZE];
        fst_flow_at(flow, x, at);
        const double crossing = hypot(at[FST_X], at[FST_Y]), r_end = hypot(end[FST_X], end[FST_Y]);
        if (!(r_end > crossing * (1 + 1e-6)))
            continue;
        fst_model *smaller_model;
        fst_flow *smaller = going_outwards(0.5 * (crossing + r_end), &smaller_model);
        fst_stop stop = FST_AT_SECTION, before = FST_AT_TIME;
        double time = 0.0, time_before = 0.0;
        while (stop == FST_AT_SECTION) {
            before = stop;
            time_before = time;
            assert_int_equal(fst_flow_next(smaller, 1e4, events, &stop, NULL), FST_OK);
            time = fst_flow_get(smaller).t;
            assert_true(time > time_before);
        }
        assert_int_equal(stop, FST_AT_EDGE);
        assert_int_equal(before, FST_AT_SECTION);
        CHECK_CLOSE(time_before, fst_flow_time(flow, x).high, 1e-9);
        tried += 1;
        fst_flow_free(smaller);
        fst_model_free(smaller_model);
    }
    assert_true(tried > 2);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* A run no longer than the default discard discards half of itself; a discard that was set is kept. */
static void test_the_discard_of_short_runs(void **unused)
{
    (void)unused;
    static const struct {
        double periods, discard, expected;
    } cases[] = {{400, 200, 200}, {200, 200, 100}, {60, 200, 30}, {201, 200, 200}, {60, 50, 50}, {60, 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        fst_params p = fst_default_params();
        p.run_periods = cases[i].periods;
        p.run_discard = cases[i].discard;
        CHECK_CLOSE(fst_run_discard(&p), cases[i].expected, 0.0);
        assert_int_equal(fst_params_validate(&p, NULL), FST_OK);
    }
    fst_params p = fst_default_params();
    p.run_periods = 60;
    p.run_discard = 60;
    assert_int_equal(fst_params_validate(&p, NULL), FST_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_landing_leaves_nothing),
        cmocka_unit_test(test_the_phase_does_not_drift),
        cmocka_unit_test(test_two_events_in_a_step),
        cmocka_unit_test(test_the_discard_of_short_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
