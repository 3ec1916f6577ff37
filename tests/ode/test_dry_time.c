/* Dry friction: time along a trajectory whose steps are not measured in time.  It lands where it is asked to,
 * finds events where a step of another kind of integration finds them, and does not run backwards.
 * tests: ode/pace.c ode/advance.c */
#include "physics.h"

#include "model/model.h"
#include "observe/quadrature.h"
#include "ode/flow.h"

static fst_params dry_bead(void)
{
    fst_params p = bead_at(0.215, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = 0.2;
    return p;
}

static fst_flow *begun(const fst_params *p, double rtol, fst_model **model)
{
    double start[FST_STATE_SIZE];
    *model = model_of(p);
    start_of(p, *model, start);
    return flow_of(*model, rtol, start);
}

/* Each of many times is met exactly, often several within a step; to ask again is not work; and the states are
 * those of a trajectory that lands on each time by a step of its own. */
static void test_landing(void **unused)
{
    (void)unused;
    const fst_params p = dry_bead();
    fst_model *model;
    fst_flow *flow = begun(&p, 1e-12, &model);
    int slips = 0;
    for (int i = 1; i <= 300; ++i) {
        const double t = 0.173 * i;
        double state[FST_STATE_SIZE], start[FST_STATE_SIZE];
        assert_int_equal(advance_to(flow, t, 0), FST_AT_TIME);
        fst_flow_info info = fst_flow_get(flow);
        assert_true(info.t == t && info.t_low == 0.0);
        const uint64_t calls = info.rhs_calls;
        assert_int_equal(advance_to(flow, t, 0), FST_AT_TIME);
        assert_true(fst_flow_get(flow).rhs_calls == calls);
        slips += fst_contact_mode(flow) == FST_MODE_SLIP;
        if (i % 15)
            continue;
        start_of(&p, model, start);
        state_after(model, 1e-12, start, t, state);
        CHECK_CLOSE(greatest_difference(state, info.state, FST_STATE_SIZE), 0, 1e-10);
    }
    assert_true(slips > 100);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* Many landings do not add up: a piece-wise trajectory ends where a whole one does. */
static void test_landing_by_steps(void **unused)
{
    (void)unused;
    const fst_params p = dry_bead();
    fst_model *model, *again;
    fst_flow *whole = begun(&p, 1e-12, &model), *pieces = begun(&p, 1e-12, &again);
    for (int i = 1; i <= 1000; ++i)
        while (pieces->t.high < 0.05 * i)
            assert_int_equal(fst_flow_step(pieces, 0.05 * i, NULL), FST_OK);
    while (whole->t.high < 50.0)
        assert_int_equal(fst_flow_step(whole, 50.0, NULL), FST_OK);
    assert_true(pieces->t.high == 50.0 && pieces->t.low == 0.0);
    CHECK_CLOSE(greatest_difference(pieces->step.end, whole->step.end, FST_STATE_SIZE), 0, 1e-10);
    fst_flow_free(pieces);
    fst_flow_free(whole);
    fst_model_free(model);
    fst_model_free(again);
}

/* Sections: X = 0 there, the time is that at which a trajectory made to land there has X = 0, times grow, Phi
 * is an odd multiple of pi/2, and events do not disturb the trajectory. */
static void test_sections(void **unused)
{
    (void)unused;
    const fst_params p = dry_bead();
    fst_model *model, *again;
    fst_flow *flow = begun(&p, 1e-12, &model), *undisturbed = begun(&p, 1e-12, &again);
    double before = 0;
    int in_slip = 0;
    for (int i = 0; i < 24; ++i) {
        assert_int_equal(advance_to(flow, 1e4, FST_AT_SECTION), FST_AT_SECTION);
        const fst_flow_info info = fst_flow_get(flow);
        double start[FST_STATE_SIZE], state[FST_STATE_SIZE];
        assert_true(info.t > before);
        before = info.t;
        CHECK_CLOSE(info.state[FST_X], 0, 1e-14);
        CHECK_CLOSE(fabs(sin(info.bead_angle)), 1, 1e-14);
        CHECK_CLOSE(info.alpha, info.bead_angle + 0.215 * info.t, 1e-11);
        start_of(&p, model, start);
        state_after(model, 1e-12, start, info.t, state);
        CHECK_CLOSE(greatest_difference(state, info.state, FST_STATE_SIZE), 0, 3e-9);
        in_slip += fst_contact_mode(flow) == FST_MODE_SLIP;
    }
    assert_true(in_slip > 4);
    advance_to(flow, before + 10, 0);
    advance_to(undisturbed, before + 10, 0);
    const fst_flow_info a = fst_flow_get(flow), b = fst_flow_get(undisturbed);
    assert_memory_equal(a.state, b.state, sizeof a.state);
    fst_flow_free(flow);
    fst_flow_free(undisturbed);
    fst_model_free(model);
    fst_model_free(again);
}

/* Within a slip the time at a fraction and the fraction at a time are each other's inverse, and the clock goes
 * as the state does: x moves by v. */
static void test_clock(void **unused)
{
    (void)unused;
    const fst_params p = dry_bead();
    fst_model *model;
    fst_flow *flow = begun(&p, 1e-10, &model);
    int steps = 0;
    while (flow->t.high < 60) {
        assert_int_equal(fst_flow_step(flow, 60, NULL), FST_OK);
        const double whole = fst_twofold_difference(flow->t, flow->t_start);
        CHECK_CLOSE(fst_contact_time(flow, 0.0), 0, 1e-16);
        CHECK_CLOSE(fst_contact_time(flow, 1.0), whole, 1e-13);
        double last = 0;
        for (double x = 0.05; x < 1; x += 0.05) {
            const double t = fst_contact_time(flow, x);
            assert_true(t > last);
            last = t;
            if (t > 1e-9)
                CHECK_CLOSE(fst_contact_fraction(flow, t), x, 1e-8);
        }
        steps += fst_contact_mode(flow) == FST_MODE_SLIP;
    }
    assert_true(steps > 100);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* What was at rest does not tell when it came to rest. */
static void test_no_way_back(void **unused)
{
    (void)unused;
    const fst_params p = dry_bead();
    fst_model *model;
    fst_flow *flow = begun(&p, 1e-10, &model);
    fst_stop stop;
    fst_error error = {FST_OK, "", ""};
    advance_to(flow, 20, 0);
    assert_int_equal(fst_flow_next(flow, 3, 0, &stop, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "time cannot run backwards under dry friction");
    assert_int_equal(advance_to(flow, 21, 0), FST_AT_TIME); /* and it goes on as if nobody had asked */
    assert_true(fst_flow_get(flow).t == 21.0);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* A drive that rises while steps are measured in theta: against steps so small that the drive is constant in
 * each. The latter is of the second order in their size. */
static void test_ramp(void **unused)
{
    (void)unused;
    const fst_params p = dry_bead();
    const double rate = 2e-3, t = 40;
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], ends[3][FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow_options options = fst_default_flow_options();
    options.rtol = 1e-12;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = 1e-12;
    options.ramp = rate;
    fst_flow *flow;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_flow_new(model, &options, start, &flow, &error), FST_OK);
    advance_to(flow, t, 0);
    const fst_flow_info info = fst_flow_get(flow);
    CHECK_CLOSE(info.omega, 0.215 + rate * t, 1e-15);
    CHECK_CLOSE(info.drive_turns, (0.215 * t + 0.5 * rate * t * t) / TWO_PI, 1e-13);
    for (int k = 0; k < 2; ++k) { /* pieces of constant drive */
        const int pieces = 400 << k;
        double y[FST_STATE_SIZE];
        memcpy(y, start, sizeof y);
        for (int i = 0; i < pieces; ++i) {
            fst_model piece = *model;
            piece.groups.omega = piece.world.omega = 0.215 + rate * t * (i + 0.5) / pieces;
            state_after(&piece, 1e-12, y, t / pieces, y);
        }
        memcpy(ends[k], y, sizeof y);
    }
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        ends[2][i] = (4 * ends[1][i] - ends[0][i]) / 3;
    const double coarse = greatest_difference(ends[0], info.state, FST_STATE_SIZE),
                 fine = greatest_difference(ends[1], info.state, FST_STATE_SIZE);
    CHECK_WITHIN(coarse / fine, 3.0, 5.0);
    CHECK_CLOSE(greatest_difference(ends[2], info.state, FST_STATE_SIZE), 0, 0.1 * fine);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* ------------------------------------------------------------------ runs */

typedef struct watch {
    const fst_model *model;
    double start[FST_STATE_SIZE], period, ramp_from, ramp_rate;
    int samples, checked;
} watch;

/* A sample is at its time, and there is the state of a trajectory that was made to land there. */
static fst_status look(void *user, const fst_sample *sample, fst_error *error)
{
    (void)error;
    watch *w = user;
    CHECK_CLOSE(sample->t, w->samples * w->period / 16, 1e-12 * (1 + sample->t));
    if (w->samples++ % 7)
        return FST_OK;
    fst_flow_options options = fst_default_flow_options();
    fst_flow *flow;
    if (fst_flow_new(w->model, &options, w->start, &flow, error) != FST_OK)
        fail_msg("%s", error->sentence);
    advance_to(flow, sample->t, 0);
    const fst_flow_info info = fst_flow_get(flow);
    CHECK_CLOSE(greatest_difference(info.state, sample->state, FST_STATE_SIZE), 0, 1e-7);
    CHECK_CLOSE(sample->drive_turns, info.drive_turns, 1e-12);
    CHECK_CLOSE(sample->omega, 0.215, 0);
    CHECK_CLOSE(sample->seen.slip_norm, fst_observe(w->model, info.state).slip_norm, 1e-7);
    fst_flow_free(flow);
    w->checked += 1;
    return FST_OK;
}

static void test_samples(void **unused)
{
    (void)unused;
    fst_params p = dry_bead();
    p.run_periods = 6;
    p.run_discard = 0;
    p.run_samples = 16;
    fst_model *model = model_of(&p);
    watch w = {.model = model, .period = TWO_PI / 0.215};
    start_of(&p, model, w.start);
    fst_run_options options = fst_default_run_options();
    options.sink.user = &w;
    options.sink.sample = look;
    fst_run_result result;
    fst_error error = {FST_OK, "", ""};
    (void)fst_run(&p, &options, &result, &error);
    CHECK_WITHIN(w.samples, 6 * 16, 6 * 16 + 1);
    assert_true(w.checked > 12);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_landing),     cmocka_unit_test(test_landing_by_steps),
        cmocka_unit_test(test_sections),    cmocka_unit_test(test_clock),
        cmocka_unit_test(test_no_way_back), cmocka_unit_test(test_ramp),
        cmocka_unit_test(test_samples),
    };
    return cmocka_run_group_tests_name("dry_time", tests, NULL, NULL);
}
