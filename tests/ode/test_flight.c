/* A bead that leaves the plate: what is known exactly without a magnet (parabolas, the time of all bounces,
 * what their friction takes), the field at a height, and the balance of energy through flights and impacts.
 * tests: ode/flight.c */
#include "physics.h"

#include "model/modes.h"
#include "model/tangent.inl"
#include "ode/flight.h"

static fst_params bouncing_bead(double restitution)
{
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.impact_restitution = restitution;
    return p;
}

/* A bead without a magnet that is thrown up at the speed `climb` and slips at `slip`. */
static fst_flow *thrown_bead(const fst_params *p, double climb, double slip)
{
    fst_model *model = model_of(p);
    double state[FST_STATE_SIZE] = {0};
    state[FST_X] = 0.2;
    state[FST_NX] = 1;
    state[FST_VX] = slip;
    fst_flow *flow = flow_of(model, 1e-11, state);
    fst_model_free(model);
    flow->step.context.modes.contact = FST_MODE_FLIGHT;
    fst_flight_begin(flow->step.end, climb);
    fst_bead_flow_restart(flow);
    return flow;
}

static double speed_of(const fst_flow *flow)
{
    return hypot(flow->step.end[FST_VX], flow->step.end[FST_VY]);
}

/* Up and down again in 2 z'/g, with no friction; each bounce returns the part e_n of the speed and rubs with mu
 * times its impulse; all of them take 2 z'/(g (1 - e_n)). */
static void test_bounces_without_a_magnet(void **unused)
{
    (void)unused;
    fst_params p = bouncing_bead(0.7);
    p.model_kappa = 0;
    fst_flow *flow = thrown_bead(&p, 0.01, 0.5);
    const double g = fst_flow_world(flow)->gravity, hop = 0.02 / g, mu = p.friction_mu;
    (void)advance_to(flow, 0.25 * hop, 0);
    const double height = flow->step.end[FST_HEIGHT], climb = flow->step.end[FST_CLIMB];
    CHECK_CLOSE(climb, 0.005, 1e-13);
    CHECK_CLOSE(height, 0.375 * 0.01 * 0.01 / g, 1e-12);
    CHECK_CLOSE(speed_of(flow), 0.5, 1e-12);
    (void)advance_to(flow, 0.999 * hop, 0);
    assert_int_equal((int)flow->contact.impacts, 0);
    (void)advance_to(flow, 1.001 * hop, 0);
    assert_int_equal((int)flow->contact.impacts, 1);
    CHECK_CLOSE(flow->contact.impulse, 1.7 * 0.01, 1e-12);
    CHECK_CLOSE(speed_of(flow), 0.5 - mu * 1.7 * 0.01, 1e-11);
    const double rest = hop / (1 - 0.7);
    (void)advance_to(flow, 0.999 * rest, 0);
    assert_true(fst_flight_is_on(flow));
    (void)advance_to(flow, 1.0001 * rest, 0);
    assert_int_equal(fst_contact_mode(flow), FST_MODE_SLIP);
    const double impulses = 1.7 * 0.01 / (1 - 0.7);
    CHECK_CLOSE(flow->contact.impulse, impulses, 1e-10);
    CHECK_CLOSE(speed_of(flow), 0.5 - mu * impulses - mu * g * 0.0001 * rest, 1e-9);
    CHECK_WITHIN((double)flow->contact.impacts, 30, 100);
    fst_flow_free(flow);
}

/* Strong friction takes the whole slip in the first impact, and the bead rolls: 5/7 of its speed is left. */
static void test_impact_that_stops_the_slip(void **unused)
{
    (void)unused;
    fst_params p = bouncing_bead(0.0);
    p.model_kappa = 0;
    p.friction_mu = 5.0;
    fst_flow *flow = thrown_bead(&p, 0.01, 0.05);
    const double hop = 0.02 / fst_flow_world(flow)->gravity;
    static const fst_stop stops[] = {FST_AT_TOUCH, FST_AT_STICK};
    for (int i = 0; i < 2; ++i) { /* both at once, and both are told */
        assert_int_equal(advance_to(flow, 1.01 * hop, FST_AT_STICK | FST_AT_TOUCH | FST_AT_SLIP), stops[i]);
        CHECK_CLOSE(fst_flow_get(flow).t, hop, 1e-12);
        assert_true(fst_flow_get(flow).sticks && !fst_flow_get(flow).flies);
    }
    assert_int_equal(advance_to(flow, 1.01 * hop, FST_AT_STICK | FST_AT_TOUCH | FST_AT_SLIP), FST_AT_TIME);
    assert_int_equal((int)flow->contact.impacts, 1);
    assert_int_equal(fst_contact_mode(flow), FST_MODE_STICK);
    CHECK_CLOSE(speed_of(flow), 5.0 / 7.0 * 0.05, 1e-12);
    CHECK_CLOSE(flow->contact.impact_loss, 0.5 * 0.01 * 0.01 + 0.05 * 0.05 / 7, 1e-12);
    fst_flow_free(flow);
}

/* A bead that loses nothing bounces for ever. */
static void test_elastic_bead(void **unused)
{
    (void)unused;
    fst_params p = bouncing_bead(1.0);
    p.model_kappa = 0;
    fst_flow *flow = thrown_bead(&p, 0.01, 0.0);
    const double hop = 0.02 / fst_flow_world(flow)->gravity;
    for (int i = 1; i <= 100; ++i) { /* which is told of each touch of the plate */
        assert_int_equal(advance_to(flow, 100.5 * hop, FST_AT_TOUCH | FST_AT_LEAVE), FST_AT_TOUCH);
        CHECK_CLOSE(fst_flow_get(flow).t, i * hop, 1e-10);
        assert_true(fst_flow_get(flow).flies);
    }
    assert_int_equal(advance_to(flow, 100.5 * hop, FST_AT_TOUCH | FST_AT_LEAVE), FST_AT_TIME);
    const double height = flow->step.end[FST_HEIGHT], climb = flow->step.end[FST_CLIMB];
    assert_int_equal((int)flow->contact.impacts, 100);
    CHECK_CLOSE(climb, 0.0, 1e-11);
    CHECK_CLOSE(height, 0.01 * 0.02 / 8 * 2 / fst_flow_world(flow)->gravity, 1e-9);
    fst_flow_free(flow);
}

/* At a height the field is that of a bead put there, bit for bit. */
static void test_field_at_a_height(void **unused)
{
    (void)unused;
    fst_params p = bouncing_bead(0.5), higher = p;
    p.model_h = 0.75;
    higher.model_h = 1.0;
    fst_model *low = model_of(&p), *high = model_of(&higher);
    uint64_t seed = 3;
    double state[FST_STATE_SIZE];
    random_state(&seed, state);
    fst_motion_double bead = fst_motion_at(&low->world, state, 1e-10);
    bead.modes.contact = FST_MODE_FLIGHT;
    bead.numbers[FST_HEIGHT] = 0.25;
    fst_pull_double raised, expected;
    fst_linear_double linear, linear_there;
    double slope[FST_STATE_SIZE];
    fst_magnetic_pull_double(&low->world, &bead.modes, bead.numbers, &raised);
    fst_pull_at_double(&high->world, state, high->world.height, &expected);
    fst_linearise_double(&low->world, &bead.modes, 0.3, bead.numbers, &linear, slope);
    bead.numbers[FST_HEIGHT] = 0.0;
    fst_linearise_double(&high->world, &bead.modes, 0.3, bead.numbers, &linear_there, slope);
    assert_memory_equal(&linear.at, &linear_there.at, sizeof linear.at);
    for (int i = 0; i < 3; ++i) {
        CHECK_SAME_BITS(raised.b[i], expected.b[i]);
        CHECK_SAME_BITS(raised.force[i], expected.force[i]);
    }
    fst_model_free(low);
    fst_model_free(high);
}

/* Weak friction and a fast drive: the magnet lifts the bead off again and again. */
static fst_params lifted_bead(void)
{
    fst_params p = fst_default_params();
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = 0.05;
    p.drive_frequency = 90;
    p.run_periods = 25;
    p.run_discard = 5;
    return p;
}

static void test_energy_through_flights(void **unused)
{
    (void)unused;
    fst_params p = lifted_bead();
    static const double bounce[] = {0.8, 0.5, 0.0};
    for (int i = 0; i < 3; ++i) {
        p.impact_restitution = bounce[i];
        p.run_rtol = 1e-10;
        const fst_run_result run = run_of(&p);
        CHECK_WITHIN(run.flying, 0.05, 0.6);
        CHECK_WITHIN(run.impacts_per_return, 0.1, 100);
        CHECK_WITHIN(run.energy_residual, 0, 3e-9);
        CHECK_WITHIN(run.mean_impact_power, 1e-6, 1);
        p.run_rtol = 1e-12;
        const fst_run_result finer = run_of(&p);
        CHECK_WITHIN(finer.energy_residual, 0, 3e-11);
        CHECK_CLOSE(run.mean_r, finer.mean_r, 2e-5);
        CHECK_CLOSE(run.flying, finer.flying, 1e-4);
    }
}

/* Without impact.restitution the model ends where the load vanishes. */
static void test_without_restitution_the_run_ends(void **unused)
{
    (void)unused;
    const fst_params p = lifted_bead();
    const fst_run_result run = run_of(&p);
    assert_int_equal(run.regime, FST_REGIME_LIFTED);
}

static void test_bad_input(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_params_set(&p, "impact.restitution", "-0.1", &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "out of range");
    assert_int_equal(fst_params_set(&p, "impact.restitution", "1.1", &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "0 to 1");
}

/* At 80 Hz the magnet throws the bead up again and again: it comes down on the plate, never below it. */
static void test_never_below_the_plate(void **unused)
{
    (void)unused;
    fst_params p = bouncing_bead(0.6);
    p.drive_omega = NAN;
    p.drive_frequency = 80;
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], highest = 0;
    start_of(&p, model, start);
    fst_flow *flow = flow_of(model, 1e-10, start);
    while (flow->t.high < 12) {
        assert_int_equal(fst_flow_step(flow, 12, NULL), FST_OK);
        for (int i = 1; i <= 4 && fst_flight_is_on(flow); ++i) {
            fst_motion_double at;
            fst_flow_motion_at(flow, 0.25 * i, &at);
            CHECK_WITHIN(at.numbers[FST_HEIGHT], -1e-13, 0.1);
            highest = fmax(highest, at.numbers[FST_HEIGHT]);
        }
    }
    assert_true(flow->contact.impacts >= 2 && highest > 1e-3);
    fst_flow_free(flow);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bounces_without_a_magnet),
        cmocka_unit_test(test_impact_that_stops_the_slip),
        cmocka_unit_test(test_elastic_bead),
        cmocka_unit_test(test_field_at_a_height),
        cmocka_unit_test(test_energy_through_flights),
        cmocka_unit_test(test_never_below_the_plate),
        cmocka_unit_test(test_without_restitution_the_run_ends),
        cmocka_unit_test(test_bad_input),
    };
    return cmocka_run_group_tests_name("flight", tests, NULL, NULL);
}
