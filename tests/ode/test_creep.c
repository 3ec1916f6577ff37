/* A slip that creeps: its direction against the equations of motion, to the order that is claimed; a motion that
 * creeps for turns against steps of the mode slip alone, in its energy, its neighbours and its work.
 * tests: ode/creep.c ode/onset.c model/contact/lag.inl ode/neighbours.c */
#include "physics.h"

#include "model/model.h"
#include "observe/quadrature.h"
#include "ode/creep.h"
#include "ode/flow.h"
#include "ode/neighbours.h"
#include "ode/onset.h"

static fst_params creeping_bead(void)
{
    fst_params p = fst_default_params();
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = 0.4;
    p.drive_frequency = 8.6666666667;
    return p;
}

static double turns(const fst_model *model, double count)
{
    return count * TWO_PI / fst_model_groups(model).omega;
}

/* ------------------------------------------------------------------ the direction of the slip */

/* The angle between the known direction of a slip and the integrated one, in a state where the push is `part` of
 * friction: after 32 s/|A| nothing is left of a start along the push.  Without the last term of the lag: `less`. */
static double off_direction(int farago, double part, double s, int less)
{
    static const double start[FST_STATE_SIZE] = {0.4, 0.6, 0.05, -0.03, -0.6, -0.3, 0.74, -0.5, 0.2, 0.6};
    fst_params p = creeping_bead();
    fst_pull_double pull;
    p.model_dynamics = farago ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
    fst_model *model = model_of(&p);
    double y[FST_NUMBERS] = {0.0};
    memcpy(y, start, sizeof start);
    (void)fst_renormalise_double(y);
    const fst_modes_double slips = fst_new_modes_double();
    fst_magnetic_pull_double(&model->world, &slips, y, &pull);
    fst_contact_double at = fst_contact_of_double(&model->world, &slips, y, &pull);
    const double a = fst_norm_2_double(at.push);
    p.friction_mu = a / part / (model->world.yielding * at.load);
    fst_model_free(model);
    model = model_of(&p);
    fst_set_slip_double(&model->world, y, (const double[2]){s * at.push[0] / a, s * at.push[1] / a});
    fst_flow *flow = flow_of(model, 1e-15, y);
    while (flow->t.high < 32 * s / a) {
        assert_int_equal(fst_flow_step(flow, 32 * s / a, NULL), FST_OK);
        assert_int_equal(fst_contact_mode(flow), FST_MODE_SLIP);
    }
    double v[2], u[2];
    fst_creeping k = fst_creeping_at(flow, flow->step.end);
    k.lag.curve *= !less;
    fst_slip_double(&model->world, flow->step.end, v);
    fst_lag_direction_double(&k.lag, 0.0, k.push, v, u);
    const double off = fabs(u[0] * v[1] - u[1] * v[0]) / fst_norm_2_double(v);
    fst_flow_free(flow);
    fst_model_free(model);
    return off;
}

/* It is of the fourth order in s, and without that term of the third. */
static void test_direction(void **unused)
{
    (void)unused;
    static const double parts[] = {0.995, 1.0, 1.02};
    for (int farago = 0; farago < 2; ++farago)
        for (int i = 0; i < 3; ++i) {
            const double fine = off_direction(farago, parts[i], 5e-4, 0);
            CHECK_WITHIN(off_direction(farago, parts[i], 1e-3, 0) / fine, 15, 40);
            CHECK_WITHIN(fine, 0, 5e-9);
            const double less = off_direction(farago, parts[i], 5e-4, 1);
            CHECK_WITHIN(off_direction(farago, parts[i], 1e-3, 1) / less, 6, 10);
        }
}

/* ------------------------------------------------------------------ a whole motion */

/* After 46 turns, of which the last ten creep: made by steps of the mode slip alone (57068 of them) at a tolerance of
 * 1e-13; and the work of friction. */
static const double BY_SLIPS[FST_STATE_SIZE + 1] = {0.3589949667074,  0.007066654909147, 0.001638603628506,
                                                    0.07662082726385, -0.8623403296111,  0.001659735650468,
                                                    0.5063263781434,  -0.704946710443,   0.004143418361639,
                                                    0.5858706241169,  0.1571741209808};

static void check_motion(double rtol, double within, int *creeps)
{
    const fst_params p = creeping_bead();
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], sums[FST_Q_COUNT], phi;
    start_of(&p, model, start);
    const double t = turns(model, 46), before = fst_observe(model, start).energy;
    fst_flow *flow = flow_of(model, rtol, start);
    fst_quadrature q;
    fst_quadrature_begin(&q, flow);
    for (*creeps = 0; flow->t.high < t; *creeps += fst_contact_mode(flow) == FST_MODE_CREEP) {
        assert_int_equal(fst_flow_step(flow, t, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
    }
    fst_quadrature_at(&q, flow, 1.0, sums, &phi);
    CHECK_CLOSE(greatest_difference(flow->step.end, BY_SLIPS, FST_STATE_SIZE), 0, within);
    CHECK_CLOSE(sums[FST_Q_FRICTION_POWER], BY_SLIPS[FST_STATE_SIZE], within);
    const double gained = sums[FST_Q_DRIVE_POWER] - sums[FST_Q_FRICTION_POWER];
    CHECK_CLOSE(fst_observe(model, flow->step.end).energy - before, gained, 20 * rtol);
    fst_flow_free(flow);
    fst_model_free(model);
}

static void test_motion(void **unused)
{
    (void)unused;
    int creeps;
    check_motion(1e-12, 1e-9, &creeps);
    assert_true(creeps > 300);
    check_motion(1e-10, 1e-7, &creeps);
    assert_true(creeps > 300);
}

/* 60 turns took 37 million evaluations, and 100 more take what a motion does that rolls. */
static void test_work(void **unused)
{
    (void)unused;
    const fst_params p = creeping_bead();
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow *flow = flow_of(model, 1e-10, start);
    while (flow->t.high < turns(model, 60))
        assert_int_equal(fst_flow_step(flow, turns(model, 60), NULL), FST_OK);
    CHECK_WITHIN((double)flow->rhs_calls, 0, 6e5);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* ------------------------------------------------------------------ neighbours */

/* A flow in a long creep, after 46 turns, whose slip is at least s. */
static fst_flow *creep_of(const fst_model *model, const fst_params *p, double s)
{
    double start[FST_STATE_SIZE], slip[2] = {0, 0};
    start_of(p, model, start);
    fst_flow *flow = flow_of(model, 1e-12, start);
    while (flow->t.high < turns(model, 46) || fst_contact_mode(flow) != FST_MODE_CREEP ||
           hypot(slip[0], slip[1]) < s) {
        assert_int_equal(fst_flow_step(flow, INFINITY, NULL), FST_OK);
        fst_slip_double(fst_flow_world(flow), flow->step.end, slip);
    }
    return flow;
}

/* Where a motion is after a time that begins at `start`, by steps whose slip creeps. */
static void end_of(const fst_model *model, const double *start, double time, double *end)
{
    fst_flow *flow = flow_of(model, 1e-13, start);
    while (flow->t.high < time)
        assert_int_equal(fst_flow_step(flow, time, NULL), FST_OK);
    assert_int_equal(fst_contact_mode(flow), FST_MODE_CREEP);
    memcpy(end, flow->step.end, FST_STATE_SIZE * sizeof *end);
    fst_flow_free(flow);
}

/* A neighbour that is off by d at the start is off by `end` at the end. */
static void neighbour_of(const fst_model *model, const double *start, double time, const double *d, double *end)
{
    fst_neighbours b = {.count = 1, .parameter = -1};
    memcpy(b.d[0], d, FST_STATE_SIZE * sizeof *d);
    fst_flow *flow = flow_of(model, 1e-13, start);
    fst_neighbours_start(&b, flow);
    while (flow->t.high < time) {
        assert_int_equal(fst_flow_step(flow, time, NULL), FST_OK);
        fst_neighbours_follow(&b, flow);
    }
    fst_neighbours_at_equal_times(&b, flow);
    memcpy(end, b.d[0], FST_STATE_SIZE * sizeof *end);
    fst_flow_free(flow);
}

/* Neighbours of a motion that creeps, with slips of their own, against differences. */
static void test_neighbours(void **unused)
{
    (void)unused;
    const double h = 1e-8, time = 0.1;
    const fst_params p = creeping_bead();
    fst_model *model = model_of(&p);
    fst_flow *flow = creep_of(model, &p, 1e-5);
    double start[FST_STATE_SIZE], d[FST_STATE_SIZE], at[FST_STATE_SIZE], ends[2][FST_STATE_SIZE],
        end[FST_STATE_SIZE];
    memcpy(start, flow->step.end, sizeof start);
    fst_flow_free(flow);
    for (int column = 0; column < FST_STATE_SIZE; ++column) {
        memset(d, 0, sizeof d);
        d[column] = 1.0;
        if (column >= FST_NX && column <= FST_NZ) /* across n */
            fst_cross_double(start + FST_NX, (const double[3]){d[4], d[5], d[6]}, d + FST_NX);
        for (int side = 0; side < 2; ++side) {
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                at[i] = start[i] + (side ? h : -h) * d[i];
            end_of(model, at, time, ends[side]);
        }
        neighbour_of(model, start, time, d, end);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            CHECK_CLOSE(end[i], (ends[1][i] - ends[0][i]) / (2 * h), 1e-4);
    }
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_direction),
        cmocka_unit_test(test_motion),
        cmocka_unit_test(test_work),
        cmocka_unit_test(test_neighbours),
    };
    return cmocka_run_group_tests_name("creep", tests, NULL, NULL);
}
