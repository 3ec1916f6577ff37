/* The integrator: errors follow the tolerance, motion without friction can be reversed, landing is exact,
 * events are located, the angle is unwrapped.
 * tests: ode/flow.c ode/trajectory.c ode/advance.c ode/dop853.inl
 * labels: bits */
#include "physics.h"

#include "base/winding.h"
#include "ode/flow.h"

/* Error of the end state and the drift of |n|, against a trajectory at a hundredth of the tightest tolerance:
 * both are proportional to the tolerance (over a decade, each falls by a factor of 4 to 25). */
static void test_errors_scale_with_the_tolerance(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        const fst_params p = bead_at(0.405, (fst_dynamics)dynamics);
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE], reference[FST_STATE_SIZE], error_before = NAN, drift_before = NAN;
        const double t = 20 * TWO_PI / 0.405;
        start_of(&p, model, start);
        state_after(model, 1e-14, start, t, reference);
        for (double tolerance = 1e-6; tolerance > 5e-13; tolerance /= 10) {
            fst_flow *flow = flow_of(model, tolerance, start);
            advance_to(flow, t, 0);
            const fst_flow_info info = fst_flow_get(flow);
            const double error = greatest_difference(info.state, reference, FST_STATE_SIZE);
            CHECK_WITHIN(error, 0.1 * tolerance, 10 * tolerance);
            CHECK_WITHIN(info.norm_drift, 0.1 * tolerance, 10 * tolerance);
            if (!isnan(error_before)) {
                CHECK_WITHIN(error_before / error, 4, 25);
                CHECK_WITHIN(drift_before / info.norm_drift, 4, 25);
            }
            error_before = error;
            drift_before = info.norm_drift;
            CHECK_CLOSE(dot(info.state + FST_NX, info.state + FST_NX), 1, 1e-15);
            fst_flow_free(flow);
        }
        fst_model_free(model);
    }
}

/* Each component has its own tolerance: a loose one for W alone gives longer steps. */
static void test_tolerance_of_a_component(void **unused)
{
    (void)unused;
    const fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow_options options = fst_default_flow_options();
    options.rtol = 1e-12;
    uint64_t accepted[3];
    for (int loose = 0; loose < 3; ++loose) {
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            options.atol[i] = loose == 2 || (loose == 1 && i >= FST_WX) ? 1e-6 : 1e-12;
        fst_flow *flow;
        assert_int_equal(fst_flow_new(model, &options, start, &flow, NULL), FST_OK);
        advance_to(flow, 100, 0);
        accepted[loose] = fst_flow_get(flow).accepted;
        fst_flow_free(flow);
    }
    assert_true(accepted[1] < accepted[0] && accepted[2] < accepted[1]);
    fst_model_free(model);
}

/* Without friction the motion can be reversed: forward, and then backward to its beginning, Phi included. */
static void test_reversible_without_friction(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        const fst_params p = frictionless_bead((fst_dynamics)dynamics);
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE];
        start_of(&p, model, start);
        fst_flow *flow = flow_of(model, 1e-13, start);
        assert_int_equal(advance_to(flow, 120, 0), FST_AT_TIME);
        const fst_flow_info there = fst_flow_get(flow);
        CHECK_WITHIN(greatest_difference(there.state, start, FST_STATE_SIZE), 0.1, 10);
        assert_int_equal(advance_to(flow, 0, 0), FST_AT_TIME);
        const fst_flow_info back = fst_flow_get(flow);
        assert_true(back.t == 0 && back.t_low == 0);
        CHECK_CLOSE(greatest_difference(back.state, start, FST_STATE_SIZE), 0, 3e-11);
        CHECK_CLOSE(back.bead_angle, 3 / DEGREES, 1e-10);
        CHECK_CLOSE(back.drive_turns, 0, 1e-15);
        fst_flow_free(flow);
        fst_model_free(model);
    }
}

/* A bead at rest on the axis without a field: steps cost nothing, so the test can make enough of them for a
 * plain sum of times to lose its digits. */
static fst_flow *idle_flow(double step)
{
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.model_kappa = 0;
    fst_model *model = model_of(&p);
    const double start[FST_STATE_SIZE] = {0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
    fst_flow_options options = fst_default_flow_options();
    options.first_step = options.greatest_step = step;
    fst_flow *flow;
    assert_int_equal(fst_flow_new(model, &options, start, &flow, NULL), FST_OK);
    fst_model_free(model);
    return flow;
}

/* 100 000 drive periods: every tenth is landed on exactly, and the drive phase loses nothing. */
static void test_landing_is_exact(void **unused)
{
    (void)unused;
    const double period = TWO_PI / 0.3;
    fst_flow *flow = idle_flow(3 * period);
    for (int i = 1; i <= 10000; ++i) {
        const double t = 10.0 * i * period;
        assert_int_equal(advance_to(flow, t, 0), FST_AT_TIME);
        const fst_flow_info info = fst_flow_get(flow);
        assert_true(info.t == t && info.t_low == 0);
        CHECK_CLOSE(info.drive_turns, 10.0 * i, 4.5e-16 * 10.0 * i);
        CHECK_CLOSE(info.alpha - info.bead_angle, TWO_PI * info.drive_turns, 1e-15 * info.alpha);
    }
    fst_flow_free(flow);
}

/* 100 000 steps of a size h without landing: the time is 100 000 h, to twice the digits of a double. */
static void test_time_is_compensated(void **unused)
{
    (void)unused;
    const double h = TWO_PI / 0.3 / 7;
    const int count = 100000;
    fst_flow *flow = idle_flow(h);
    for (int i = 0; i < count; ++i)
        assert_int_equal(fst_flow_step(flow, 1e12, NULL), FST_OK);
    const fst_flow_info info = fst_flow_get(flow);
    const double product = count * h, rest = fma(count, h, -product);
    CHECK_CLOSE((info.t - product) + (info.t_low - rest), 0, 1e-23);
    assert_true(info.t_low != 0);
    fst_flow_free(flow);
}

/* The dense output is continuous from step to step and follows the trajectory inside them. */
static void test_dense_output_is_continuous(void **unused)
{
    (void)unused;
    const fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], at[FST_STATE_SIZE], exact[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow *flow = flow_of(model, 1e-10, start);
    for (int step = 0; step < 300; ++step) {
        double end_before[FST_STATE_SIZE];
        memcpy(end_before, flow->step.end, sizeof end_before);
        assert_int_equal(fst_flow_step(flow, 1e6, NULL), FST_OK);
        fst_flow_at(flow, 0, at);
        CHECK_CLOSE(greatest_difference(at, end_before, FST_STATE_SIZE), 0, 1e-15);
        fst_flow_at(flow, 1, at);
        CHECK_CLOSE(greatest_difference(at, flow->step.end, FST_STATE_SIZE), 0, 5e-15);
        if (step % 30 != 7)
            continue;
        state_after(model, 1e-14, flow->step.y, 0.6 * flow->step.h, exact);
        fst_flow_at(flow, 0.6, at);
        CHECK_CLOSE(greatest_difference(at, exact, FST_STATE_SIZE), 0, 3e-9);
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

/* X = 0 is found to rounding at every half return, and stopping there leaves the trajectory as it is. */
static void test_section(void **unused)
{
    (void)unused;
    const fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], undisturbed[FST_STATE_SIZE];
    start_of(&p, model, start);
    const double t_end = 40 * TWO_PI / 0.405;
    state_after(model, 1e-10, start, t_end, undisturbed);
    fst_flow *flow = flow_of(model, 1e-10, start);
    int crossings = 0;
    double phi_before = 0;
    while (advance_to(flow, t_end, FST_AT_SECTION) == FST_AT_SECTION) {
        const fst_flow_info info = fst_flow_get(flow);
        CHECK_CLOSE(info.state[FST_X], 0, 3e-16);
        const double quarter = (info.bead_angle - TWO_PI / 4) / (TWO_PI / 2);
        CHECK_CLOSE(quarter, round(quarter), 1e-13);
        if (crossings++)
            CHECK_CLOSE(info.bead_angle - phi_before, -TWO_PI / 2, 1e-12);
        phi_before = info.bead_angle;
    }
    /* Phi turns by omega (1 + 2/13.655...) in each period, as in the published pattern; here the turns are only
     * counted. */
    CHECK_WITHIN(crossings, 90, 95);
    const fst_flow_info info = fst_flow_get(flow);
    assert_true(info.t == t_end && info.t_low == 0);
    CHECK_CLOSE(greatest_difference(info.state, undisturbed, FST_STATE_SIZE), 0, 0);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* A time right behind an event is landed on as exactly as any other. */
static void test_time_after_an_event(void **unused)
{
    (void)unused;
    const fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow *flow = flow_of(model, 1e-10, start);
    for (int i = 0; i < 200; ++i) {
        assert_int_equal(advance_to(flow, 1e5, FST_AT_SECTION), FST_AT_SECTION);
        const double t = fst_flow_get(flow).t + 0.003 * (1 + i % 7);
        assert_int_equal(advance_to(flow, t, FST_AT_SECTION), FST_AT_TIME);
        const fst_flow_info info = fst_flow_get(flow);
        assert_true(info.t == t && info.t_low == 0);
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

/* A bead without a field rolls straight over the edge at r = 10: the time and place of the crossing, and the
 * motion after it. */
static void test_edge(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.model_kappa = 0;
    fst_model *model = model_of(&p);
    const double eps = fst_model_groups(model).eps;
    /* rolling along the laboratory's x at the speed 1/4: r^2 = (9.5 + t/4)^2 + 1 */
    const double start[FST_STATE_SIZE] = {9.5, 1, 0.25, 0, 0, 0, 1, 0, 0.25 / eps, 0};
    fst_flow *flow = flow_of(model, 1e-12, start);
    assert_int_equal(advance_to(flow, 40, FST_AT_EDGE), FST_AT_EDGE);
    const fst_flow_info info = fst_flow_get(flow);
    CHECK_CLOSE(info.t, 4 * (sqrt(99) - 9.5), 1e-11);
    CHECK_CLOSE(hypot(info.state[FST_X], info.state[FST_Y]), 10, 2e-15);
    /* The next call continues the motion; the bead is beyond the edge and does not cross it again. */
    assert_int_equal(advance_to(flow, 40, FST_AT_EDGE), FST_AT_TIME);
    assert_true(fst_flow_get(flow).t == 40);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* This orbit reaches r = 0.9389535264 once in each turn. An edge just inside it is met, however little and
 * briefly the bead would be over it within a step; an edge just outside is not. */
static void test_grazing_the_edge(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.21, FST_DYNAMICS_FARAGO2020);
    const fst_run_result orbit = run_of(&p);
    CHECK_CLOSE(orbit.max_r, 0.9389535264018697, 1e-9);
    for (int power = 2; power <= 8; ++power)
        for (int side = -1; side <= 1; side += 2) {
            const double edge = orbit.max_r + side * pow(10, -power);
            p.plate_radius = edge * p.magnet_half_length;
            fst_model *model = model_of(&p);
            fst_flow *flow = flow_of(model, 1e-10, orbit.final_state);
            const fst_stop stop = advance_to(flow, 3 * orbit.period, FST_AT_EDGE);
            assert_int_equal(stop, side < 0 ? FST_AT_EDGE : FST_AT_TIME);
            const fst_flow_info info = fst_flow_get(flow);
            if (stop == FST_AT_EDGE && hypot(orbit.final_state[FST_X], orbit.final_state[FST_Y]) < edge)
                CHECK_CLOSE(hypot(info.state[FST_X], info.state[FST_Y]), edge, 1e-14);
            fst_flow_free(flow);
            fst_model_free(model);
        }
}

/* A bead whose moment points against the field leaves the plate where kappa eps^2 n.dB/dz = g. */
static void test_lift_off(void **unused)
{
    (void)unused;
    const fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    start[FST_WX] += 30; /* spins so fast that n cannot settle in the field */
    fst_flow *flow = flow_of(model, 1e-11, start);
    assert_int_equal(advance_to(flow, 1000, FST_AT_LIFT_OFF), FST_AT_LIFT_OFF);
    const fst_flow_info info = fst_flow_get(flow);
    const fst_groups g = fst_model_groups(model);
    double b[3], grad[3][3];
    fst_field(model, info.state[FST_X], info.state[FST_Y], b, grad);
    CHECK_CLOSE(g.kappa * g.eps * g.eps * dot(info.state + FST_NX, grad[2]), g.gravity, 1e-14);
    CHECK_CLOSE(fst_observe(model, info.state).load, 0, 1e-14);
    double before[FST_STATE_SIZE];
    for (double fraction = 0.02; fraction < 0.999; fraction += 0.01) { /* the load is positive all the way */
        state_after(model, 1e-11, start, fraction * info.t, before);
        assert_true(fst_observe(model, before).load > 0);
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

/* Unwrapped Phi against atan2 differences along a fine polygon. */
static void test_unwrapped_phi(void **unused)
{
    (void)unused;
    for (int which = 0; which < 3; ++which) {
        fst_params p = bead_at(which == 0 ? 0.21 : 0.13, FST_DYNAMICS_RIGID);
        p.start_r = which == 2 ? 0.3 : 0.95;
        p.start_phi = 200;
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE], at[FST_STATE_SIZE];
        start_of(&p, model, start);
        fst_flow *flow = flow_of(model, 1e-9, start);
        double phi = fst_flow_get(flow).bead_angle, last = phi;
        CHECK_CLOSE(remainder(phi - 200 / DEGREES, TWO_PI), 0, 1e-14);
        while (flow->t.high < 1500) {
            assert_int_equal(fst_flow_step(flow, 1500, NULL), FST_OK);
            for (int i = 1; i <= 200; ++i) {
                fst_flow_at(flow, i / 200.0, at);
                const double angle = atan2(at[FST_Y], at[FST_X]);
                phi += remainder(angle - last, TWO_PI);
                last = angle;
            }
            CHECK_CLOSE(fst_winding_angle(&flow->bead_angle), phi, 1e-9);
        }
        fst_flow_free(flow);
        fst_model_free(model);
    }
}

/* Without a field the bead passes the axis in a straight line, as close as 1e-9 on either side: Phi changes by
 * half a turn, with a sign that depends on the side, and by the turning of the drive. */
static void test_passage_by_the_axis(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.model_kappa = 0;
    fst_model *model = model_of(&p);
    const double eps = fst_model_groups(model).eps;
    for (int power = 0; power <= 9; ++power)
        for (int side = -1; side <= 1; side += 2) {
            const double miss = side * pow(10, -power), speed = 0.5;
            const double start[FST_STATE_SIZE] = {-2, miss, speed, 0, 0, 0, 1, 0, speed / eps, 0};
            fst_flow *flow = flow_of(model, 1e-12, start);
            advance_to(flow, 8, 0);
            const fst_flow_info info = fst_flow_get(flow);
            const double turned = atan2(miss, 2) - atan2(miss, -2); /* the change of alpha in the laboratory */
            CHECK_CLOSE(info.alpha - atan2(miss, -2), turned, 1e-9);
            CHECK_CLOSE(info.bead_angle, info.alpha - 0.3 * 8, 1e-14);
            fst_flow_free(flow);
        }
    fst_model_free(model);
}

/* Phi = pi is one place whether Y is +0 or -0: the angle is continuous from the start. */
static void test_phi_is_continuous_from_the_start(void **unused)
{
    (void)unused;
    for (int turns = -2; turns <= 2; ++turns) {
        fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
        p.start_phi = 180 + 360.0 * turns;
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE];
        start_of(&p, model, start);
        fst_flow *flow = flow_of(model, 1e-10, start);
        const double phi = fst_flow_get(flow).bead_angle;
        advance_to(flow, 1e-3, 0);
        CHECK_CLOSE(fst_flow_get(flow).bead_angle, phi, 1e-2);
        fst_flow_free(flow);
        fst_model_free(model);
    }
}

/* A motion that cannot be integrated ends with a status and a sentence that says when and where. */
static void test_failures_say_where(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow *flow;
    fst_stop stop;
    fst_error error = {FST_OK, "", ""};
    fst_flow_options options = fst_default_flow_options();
    start[FST_WX] = 1e200; /* this overflows within one step */
    assert_int_equal(fst_flow_new(model, &options, start, &flow, &error), FST_OK);
    assert_int_equal(fst_flow_next(flow, 100, 0, &stop, &error), FST_NOT_FINITE);
    assert_int_equal(error.code, FST_NOT_FINITE);
    assert_non_null(strstr(error.where, "t = 0"));
    assert_non_null(strstr(error.where, "r = 0.95"));
    fst_flow_free(flow);
    start[FST_WX] = 1e15; /* n turns so fast that the step size would fall below rounding */
    assert_int_equal(fst_flow_new(model, &options, start, &flow, &error), FST_OK);
    assert_int_equal(fst_flow_next(flow, 100, 0, &stop, &error), FST_STEP_UNDERFLOW);
    assert_non_null(strstr(error.sentence, "t = "));
    fst_flow_free(flow);
    start[FST_WX] = NAN;
    assert_int_equal(fst_flow_new(model, &options, start, &flow, &error), FST_BAD_INPUT);
    start[FST_WX] = 0;
    options.rtol = -1;
    assert_int_equal(fst_flow_new(model, &options, start, &flow, &error), FST_BAD_INPUT);
    memset(&options, 0, sizeof options);
    assert_int_equal(fst_flow_new(model, &options, start, &flow, &error), FST_BAD_INPUT);
    assert_null(flow);
    options = fst_default_flow_options();
    assert_int_equal(fst_flow_new(model, &options, start, &flow, &error), FST_OK);
    assert_int_equal(fst_flow_next(flow, NAN, 0, &stop, &error), FST_BAD_INPUT);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* A ramp is the drive omega + rate t: its phase is the integral, and the work done follows it. */
static void test_ramp(void **unused)
{
    (void)unused;
    const fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow_options options = fst_default_flow_options();
    options.ramp = 1e-4;
    fst_flow *flow;
    assert_int_equal(fst_flow_new(model, &options, start, &flow, NULL), FST_OK);
    for (double t = 100; t <= 1000; t += 100) {
        advance_to(flow, t, 0);
        const fst_flow_info info = fst_flow_get(flow);
        CHECK_CLOSE(info.omega, 0.3 + 1e-4 * t, 1e-15);
        CHECK_CLOSE(info.drive_turns, (0.3 * t + 0.5e-4 * t * t) / TWO_PI, 1e-13);
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_errors_scale_with_the_tolerance),
        cmocka_unit_test(test_tolerance_of_a_component),
        cmocka_unit_test(test_reversible_without_friction),
        cmocka_unit_test(test_landing_is_exact),
        cmocka_unit_test(test_time_is_compensated),
        cmocka_unit_test(test_dense_output_is_continuous),
        cmocka_unit_test(test_section),
        cmocka_unit_test(test_time_after_an_event),
        cmocka_unit_test(test_edge),
        cmocka_unit_test(test_grazing_the_edge),
        cmocka_unit_test(test_lift_off),
        cmocka_unit_test(test_unwrapped_phi),
        cmocka_unit_test(test_passage_by_the_axis),
        cmocka_unit_test(test_phi_is_continuous_from_the_start),
        cmocka_unit_test(test_failures_say_where),
        cmocka_unit_test(test_ramp),
    };
    return cmocka_run_group_tests_name("integrator", tests, NULL, NULL);
}
