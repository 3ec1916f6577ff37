/* Dry friction against numbers of another program (dry_golden.h): states, times of slip and stick, periodic
 * motions and their means.
 * tests: ode/slip.c ode/contact.c model/contact/coulomb.inl
 * labels: bits */
#include "physics.h"

#include "dry_golden.h"
#include "model/model.h"
#include "observe/quadrature.h"
#include "ode/flow.h"

enum {
    CASES_COUNT = sizeof GOLDEN / sizeof *GOLDEN,
    ORBITS_COUNT = sizeof GOLDEN_ORBITS / sizeof *GOLDEN_ORBITS
};

static fst_params params_of(double frequency, double mu, int farago)
{
    fst_params p = fst_default_params();
    p.drive_frequency = frequency;
    p.drive_omega = NAN;
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = mu;
    p.model_dynamics = farago ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
    return p;
}

static fst_params params_of_golden(const golden_case *g)
{
    fst_params p = params_of(g->frequency, g->mu, g->farago);
    if (g->rolling)
        p.friction_law = FST_FRICTION_ROLLING;
    p.friction_mu_static = g->mu_static;
    p.friction_stribeck_speed = g->stribeck * p.magnet_half_length * p.friction_gamma;
    p.friction_rolling_resistance = g->resistance;
    return p;
}

/* The start of a slip or of a stick is the next of the expected ones. */
static void take_event(const golden_case *g, int *event, double time)
{
    if (*event < GOLDEN_EVENTS && (g->events[*event] != 0 || time == 0)) {
        const double expected = g->events[*event];
        if (fabs(time - expected) > fmax(10 * g->event_error, 1e-9))
            fail_msg("%g Hz, mu %g: event %d at %.12g, expected %.12g", g->frequency, g->mu, *event, time,
                     expected);
        ++*event;
    }
}

/* Five periods at a tolerance: the worst component's error; and the events, where they are wanted. */
static double error_after_five(const golden_case *g, double rtol, int with_events)
{
    const fst_params p = params_of_golden(g);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    const double t = 5 * TWO_PI / fst_model_groups(model).omega;
    fst_flow *flow = flow_of(model, rtol, start);
    fst_quadrature q;
    fst_quadrature_begin(&q, flow);
    int event = 0, sticks = fst_contact_mode(flow) == FST_MODE_STICK;
    if (with_events && !sticks && !g->rolling)
        take_event(g, &event, 0.0);
    while (flow->t.high < t) {
        const double now = flow->t.high;
        assert_int_equal(fst_flow_step(flow, t, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
        const int stuck = sticks;
        sticks = fst_contact_mode(flow) == FST_MODE_STICK;
        if (with_events && sticks != stuck && !g->rolling)
            take_event(g, &event, sticks ? -now : now);
    }
    const double error = greatest_difference(flow->step.end, g->state, FST_STATE_SIZE);
    if (with_events) {
        double sums[FST_Q_COUNT], phi;
        fst_quadrature_at(&q, flow, 1.0, sums, &phi);
        CHECK_CLOSE(sums[FST_Q_FRICTION_POWER], g->friction_work, fmax(g->error, 1e-10));
        assert_true(g->rolling || event > 0);
    }
    fst_flow_free(flow);
    fst_model_free(model);
    return error;
}

static void test_states_and_events(void **unused)
{
    (void)unused;
    for (int i = 0; i < CASES_COUNT; ++i) {
        const double error = error_after_five(&GOLDEN[i], 1e-13, 1);
        if (error > fmax(GOLDEN[i].error, 2e-11))
            fail_msg("%g Hz, mu %g, dynamics %d: off by %.3g, of which the other program is sure to %.3g",
                     GOLDEN[i].frequency, GOLDEN[i].mu, GOLDEN[i].farago, error, GOLDEN[i].error);
    }
}

/* Stops at stick and at slip come at these times too, and leave the motion as it is, to the last bit. */
static void test_stops(void **unused)
{
    (void)unused;
    int told = 0;
    for (int i = 0; i < CASES_COUNT; ++i) {
        const golden_case *g = &GOLDEN[i];
        const fst_params p = params_of_golden(g);
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE], end[FST_STATE_SIZE];
        start_of(&p, model, start);
        const double t = 5 * TWO_PI / fst_model_groups(model).omega;
        fst_flow *flow = flow_of(model, 1e-13, start);
        int event = 0;
        if (!g->rolling && !fst_flow_get(flow).sticks)
            take_event(g, &event, 0.0);
        for (;;) {
            const fst_stop stop = advance_to(flow, t, FST_AT_STICK | FST_AT_SLIP);
            if (stop == FST_AT_TIME)
                break;
            assert_int_equal(fst_flow_get(flow).sticks, stop == FST_AT_STICK);
            take_event(g, &event, stop == FST_AT_STICK ? -flow->t.high : flow->t.high);
        }
        assert_true(g->rolling ? event == 0 : event == GOLDEN_EVENTS || g->events[event] == 0);
        told += event;
        state_after(model, 1e-13, start, t, end);
        assert_memory_equal(end, flow->step.end, sizeof end);
        fst_flow_free(flow);
        fst_model_free(model);
    }
    assert_true(told > 20);
}

/* At the default tolerance, a hundred times that at which `error` was found. */
static void test_states_at_default(void **unused)
{
    (void)unused;
    for (int i = 0; i < CASES_COUNT; ++i) {
        const double error = error_after_five(&GOLDEN[i], 1e-10, 0);
        if (error > fmax(1e-7, 100 * GOLDEN[i].error))
            fail_msg("%g Hz, mu %g: off by %.3g", GOLDEN[i].frequency, GOLDEN[i].mu, error);
    }
}

/* ------------------------------------------------------------------ periodic motions */

/* One period from the golden state: it is back, and the means are right. */
static void check_orbit(const golden_orbit *g, double rtol, double tolerance)
{
    const fst_params p = params_of(g->frequency, g->mu, g->farago);
    fst_model *model = model_of(&p);
    fst_flow *flow = flow_of(model, rtol, g->orbit);
    fst_quadrature q;
    fst_quadrature_begin(&q, flow);
    while (flow->t.high < g->period) {
        assert_int_equal(fst_flow_step(flow, g->period, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
    }
    double sums[FST_Q_COUNT], phi;
    fst_quadrature_at(&q, flow, 1.0, sums, &phi);
    CHECK_CLOSE(greatest_difference(flow->step.end, g->orbit, FST_STATE_SIZE), 0, 30 * tolerance);
    CHECK_CLOSE(sums[FST_Q_FRICTION_POWER] / g->period, g->friction_power, tolerance);
    CHECK_CLOSE(sums[FST_Q_DRIVE_POWER] / g->period, g->friction_power, tolerance);
    CHECK_CLOSE(sums[FST_Q_STICKING] / g->period, g->sticking, 10 * tolerance);
    CHECK_CLOSE((double)flow->contact.captures, g->captures, 1); /* one may fall on the ends */
    fst_flow_free(flow);
    fst_model_free(model);
}

static void test_orbits(void **unused)
{
    (void)unused;
    for (int i = 0; i < ORBITS_COUNT; ++i)
        check_orbit(&GOLDEN_ORBITS[i], 1e-12, fmax(GOLDEN_ORBITS[i].error, 1e-10));
}

/* What a run says at the default tolerance, right to 1e-7. */
static void test_means_of_runs(void **unused)
{
    (void)unused;
    for (int i = 0; i < ORBITS_COUNT; ++i) {
        const golden_orbit *g = &GOLDEN_ORBITS[i];
        fst_params p = params_of(g->frequency, g->mu, g->farago);
        p.run_periods = 40;
        p.run_discard = 10;
        fst_run_options options = fst_default_run_options();
        options.start = g->orbit;
        fst_run_result r;
        fst_error error = {FST_OK, "", ""};
        if (fst_run(&p, &options, &r, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        fst_model *model = model_of(&p);
        const double weight = fst_model_groups(model).gravity;
        fst_model_free(model);
        CHECK_CLOSE(r.mean_r, g->r, 1e-7);
        CHECK_CLOSE(r.mean_alpha_dot, g->alpha_dot, 1e-7);
        CHECK_CLOSE(r.mean_nz, g->nz, 1e-7);
        CHECK_CLOSE(r.mean_load_weights * weight, g->load, 1e-7);
        CHECK_CLOSE(r.mean_friction_power / g->friction_power, 1, 1e-6);
        CHECK_CLOSE(r.mean_drive_power / g->friction_power, 1, 1e-6);
        CHECK_CLOSE(r.effective_rate / (g->friction_power / g->slip_2), 1, 1e-6);
        CHECK_CLOSE(r.sticking, g->sticking, 1e-6);
        CHECK_CLOSE(r.captures_per_return, g->captures, 1e-6);
        CHECK_WITHIN(r.energy_residual, 0, 1e-10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_states_and_events), cmocka_unit_test(test_stops),
        cmocka_unit_test(test_states_at_default), cmocka_unit_test(test_orbits),
        cmocka_unit_test(test_means_of_runs),
    };
    return cmocka_run_group_tests_name("dry_golden", tests, NULL, NULL);
}
