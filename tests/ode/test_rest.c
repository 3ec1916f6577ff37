/* A plate that resists rolling: a bead at rest stays at rest, exactly, until the magnet's torque is stronger.
 * tests: ode/rest.c model/contact/resistance.inl */
#include "physics.h"

#include "ode/flow.h"

/* A bead of which the magnet pulls a little: near its place of least energy under a magnet that turns slowly.
 */
static fst_params slow_magnet(double omega, double resistance, fst_friction_law law)
{
    fst_params p = bead_at(omega, FST_DYNAMICS_RIGID);
    p.friction_law = (int)law;
    p.friction_mu = 0.5;
    p.friction_rolling_resistance = resistance;
    return p;
}

/* A state at rest at (x, y), with the moment along the field there but for a small angle. */
static void put_at_rest(const fst_model *model, double x, double y, double off, double *state)
{
    double b[3], grad[3][3], size = 0;
    fst_field(model, x, y, b, grad);
    b[1] += off * sqrt(b[0] * b[0] + b[2] * b[2]);
    memset(state, 0, FST_STATE_SIZE * sizeof *state);
    state[FST_X] = x;
    state[FST_Y] = y;
    for (int i = 0; i < 3; ++i)
        size += b[i] * b[i];
    for (int i = 0; i < 3; ++i)
        state[FST_NX + i] = b[i] / sqrt(size);
}

/* How much of what the resistance can hold the magnet asks for. */
static double asked(const fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    const double *y = flow->step.end;
    fst_pull_double p;
    double twist[3], torque[2];
    fst_pull_at_double(c, y, c->height, &p);
    fst_cross_double(y + FST_NX, p.b, twist);
    torque[0] = p.strength * twist[0] - c->eps * p.force[1]; /* tau + eps e x F */
    torque[1] = p.strength * twist[1] + c->eps * p.force[0];
    return hypot(torque[0], torque[1]) / (c->resistance.arm * fst_load_double(c, p.force));
}

/* Under a magnet that stands (nearly) still the bead keeps its place and does not roll, to the last bit of its
 * velocities, however long; the moment may turn about the vertical, against which a point has no friction. */
static void test_stays_at_rest(void **unused)
{
    (void)unused;
    static const fst_friction_law laws[] = {FST_FRICTION_COULOMB, FST_FRICTION_ROLLING};
    for (int i = 0; i < 2; ++i) {
        const fst_params p = slow_magnet(1e-6, 0.3, laws[i]);
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE], lab[FST_STATE_SIZE];
        put_at_rest(model, 0.71, 0.3, 0.02, start);
        fst_flow *flow = flow_of(model, 1e-10, start);
        CHECK_WITHIN(asked(flow), 0.05, 0.9);
        double turned = 0;
        while (flow->t.high < 300) {
            assert_int_equal(fst_flow_step(flow, 300, NULL), FST_OK);
            const double *y = flow->step.end;
            CHECK_SAME_BITS(hypot(y[FST_VX], y[FST_VY]), 0.0);
            CHECK_SAME_BITS(hypot(y[FST_WX], y[FST_WY]), 0.0);
            turned = fmax(turned, fabs(y[FST_WZ]));
            turn_state(y, 1e-6 * flow->t.high, lab);
            CHECK_CLOSE(lab[FST_X], start[FST_X], 1e-14);
            CHECK_CLOSE(lab[FST_Y], start[FST_Y], 1e-14);
        }
        assert_true(turned > 1e-3);
        CHECK_SAME_BITS(fst_observe(model, flow->step.end).slip_norm, 0.0);
        fst_flow_free(flow);
        fst_model_free(model);
    }
}

/* The magnet turns on, and its torque on a bead at rest grows.  The bead starts just when the resistance can no
 * longer hold it, whatever the tolerance, and then with a rotation that grows from nothing. */
static void test_starts_when_asked(void **unused)
{
    (void)unused;
    double when[3] = {0, 0, 0};
    for (int i = 0; i < 3; ++i) {
        const fst_params p = slow_magnet(0.02, 0.25, FST_FRICTION_COULOMB);
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE];
        put_at_rest(model, 0.71, 0.3, 0.02, start);
        fst_flow *flow = flow_of(model, pow(10, -8 - 2 * i), start), *told = flow_of(model, flow->rtol, start);
        while (flow->contact.roll.next != FST_ROLL_STARTS && flow->t.high < 300) {
            assert_int_equal(fst_flow_step(flow, 300, NULL), FST_OK);
            CHECK_SAME_BITS(hypot(flow->step.end[FST_WX], flow->step.end[FST_WY]), 0.0);
            CHECK_WITHIN(asked(flow), 0, 1 + 1e-9);
        }
        CHECK_CLOSE(asked(flow), 1, 1e-9);
        when[i] = flow->t.high;
        assert_int_equal(fst_flow_get(told).rests, 1);
        assert_int_equal(advance_to(told, 300, FST_AT_ROLL), FST_AT_ROLL);
        assert_int_equal(fst_flow_get(told).rests, 0);
        CHECK_SAME_BITS(fst_flow_get(told).t, when[i]);
        fst_flow_free(told);
        for (int step = 0; step < 20; ++step)
            assert_int_equal(fst_flow_step(flow, 300, NULL), FST_OK);
        assert_true(hypot(flow->step.end[FST_WX], flow->step.end[FST_WY]) > 0);
        fst_flow_free(flow);
        fst_model_free(model);
    }
    CHECK_WITHIN(when[2], 1, 299);
    CHECK_CLOSE(when[0], when[2], 1e-6);
    CHECK_CLOSE(when[1], when[2], 1e-8);
}

/* A run over many rests: its means do not depend on the tolerance, and its losses make up for the drive. */
static void test_run_with_rests(void **unused)
{
    (void)unused;
    double mean[2], steps[2];
    for (int i = 0; i < 2; ++i) {
        fst_params p = bead_at(0.2151, FST_DYNAMICS_RIGID);
        p.friction_law = FST_FRICTION_COULOMB;
        p.friction_mu = 0.2;
        p.friction_rolling_resistance = 0.05;
        p.run_periods = 100;
        p.run_discard = 80;
        p.run_rtol = i ? 1e-12 : 1e-9;
        const fst_run_result r = run_of(&p);
        mean[i] = r.mean_r;
        steps[i] = (double)r.rhs_calls / p.run_periods;
        CHECK_WITHIN(fabs(r.energy_residual), 0, 1e-6);
    }
    CHECK_CLOSE(mean[0], mean[1], 1e-7);
    CHECK_WITHIN(steps[0], 0,
                 9000); /* evaluations a turn: none are spent on a rotation that is nearly nothing */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stays_at_rest),
        cmocka_unit_test(test_starts_when_asked),
        cmocka_unit_test(test_run_with_rests),
    };
    return cmocka_run_group_tests_name("rest", tests, NULL, NULL);
}
