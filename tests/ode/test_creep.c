/* A slip that creeps: its direction against the equations of motion, to the order that is claimed; a motion that
 * creeps for turns against steps of the mode slip alone, in its energy, its neighbours and its work.  The same of a
 * disc, of which all of the slip is known; and its limit, the point.
 * tests: ode/creep.c ode/onset.c model/contact/lag.inl ode/neighbours.c model/contact/coulomb.inl */
#include "physics.h"

#include "model/disc.h"
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

static void check_motion(const fst_params *p, double count, const double *expected, double rtol, double within)
{
    fst_model *model = model_of(p);
    double start[FST_STATE_SIZE], sums[FST_Q_COUNT], phi;
    start_of(p, model, start);
    const double t = turns(model, count), before = fst_observe(model, start).energy;
    fst_flow *flow = flow_of(model, rtol, start);
    fst_quadrature q;
    int creeps = 0;
    fst_quadrature_begin(&q, flow);
    for (; flow->t.high < t; creeps += fst_contact_mode(flow) == FST_MODE_CREEP) {
        assert_int_equal(fst_flow_step(flow, t, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
    }
    fst_quadrature_at(&q, flow, 1.0, sums, &phi);
    CHECK_CLOSE(greatest_difference(flow->step.end, expected, FST_STATE_SIZE), 0, within);
    CHECK_CLOSE(sums[FST_Q_FRICTION_POWER], expected[FST_STATE_SIZE], within);
    const double lost = sums[FST_Q_FRICTION_POWER] + sums[FST_Q_PIVOTING_POWER];
    CHECK_CLOSE(fst_observe(model, flow->step.end).energy - before, sums[FST_Q_DRIVE_POWER] - lost, 20 * rtol);
    assert_true(creeps > 300);
    fst_flow_free(flow);
    fst_model_free(model);
}

static void test_motion(void **unused)
{
    (void)unused;
    const fst_params p = creeping_bead();
    check_motion(&p, 46, BY_SLIPS, 1e-12, 1e-9);
    check_motion(&p, 46, BY_SLIPS, 1e-10, 1e-7);
}

static double work(const fst_params *p, double count)
{
    fst_model *model = model_of(p);
    double start[FST_STATE_SIZE];
    start_of(p, model, start);
    fst_flow *flow = flow_of(model, 1e-10, start);
    while (flow->t.high < turns(model, count))
        assert_int_equal(fst_flow_step(flow, turns(model, count), NULL), FST_OK);
    const double calls = (double)flow->rhs_calls;
    fst_flow_free(flow);
    fst_model_free(model);
    return calls;
}

/* 60 turns took 37 million evaluations, and 100 more take what a motion does that rolls. */
static void test_work(void **unused)
{
    (void)unused;
    const fst_params p = creeping_bead();
    CHECK_WITHIN(work(&p, 60), 0, 6e5);
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

/* ------------------------------------------------------------------ a disc */

static fst_params disc_of(double radius)
{
    fst_params p = creeping_bead();
    p.drive_frequency = 8;
    p.contact_patch = FST_PATCH_HERTZ;
    p.contact_radius = radius;
    return p;
}

/* How far the known slip of a disc is off the integrated one, over it, when nothing is left of the start. */
static double off_slip(double radius, int rounds)
{
    static const double start[FST_STATE_SIZE] = {0.522206, 0.708906, 0.033735,  0.011444, -0.736169,
                                                 0.205748, 0.644765, -0.129017, 0.265921, 0.265554};
    fst_params p = disc_of(radius);
    p.friction_mu = 0.8;
    fst_model *model = model_of(&p);
    double y[FST_NUMBERS] = {0.0}, v[2];
    fst_pull_double pull;
    fst_flow *flow = flow_of(model, 1e-14, start);
    fst_creep_is_followed(flow); /* in the mode slip */
    while (flow->t.high < 1.0)
        assert_int_equal(fst_flow_step(flow, 1.0, NULL), FST_OK);
    memcpy(y, flow->step.end, FST_STATE_SIZE * sizeof *y);
    fst_modes_double m = *fst_flow_modes(flow);
    assert_int_equal(m.contact, FST_MODE_SLIP);
    m.contact = FST_MODE_CREEP;
    m.way = 1.0;
    fst_fit_gain(flow, y, &m, rounds);
    fst_magnetic_pull_double(&model->world, &m, y, &pull);
    const fst_contact_double at = fst_contact_of_double(&model->world, &m, y, &pull);
    const fst_disc_creep_double k = fst_coulomb_creep_double(&model->world.law.coulomb, &at);
    fst_slip_double(&model->world, y, v);
    const double off = hypot(v[0] - k.slip[0], v[1] - k.slip[1]) / fst_norm_2_double(v);
    fst_flow_free(flow);
    fst_model_free(model);
    return off;
}

/* It is of the fourth order in the radius, and after two rounds only of the third. */
static void test_slip_of_disc(void **unused)
{
    (void)unused;
    for (int order = 3; order < 5; ++order) {
        const int rounds = order == 3 ? 2 : 4;
        const double coarse = off_slip(2e-4, rounds), middle = off_slip(1e-4, rounds),
                     fine = off_slip(5e-5, rounds);
        CHECK_WITHIN(log2(middle / fine), order - 0.2, order + 0.3);
        CHECK_WITHIN(0.5 * log2(coarse / fine), order - 0.2, order + 0.35);
        CHECK_WITHIN(fine, 0, order == 3 ? 1e-8 : 1e-10);
    }
}

/* After 20 turns, by steps of the mode slip alone (947 million evaluations, which are 1e-8 off) at a tolerance of
 * 1e-12, with a floor of 1e-11 under |w|; and the work of friction. */
static const double DISC_BY_SLIPS[FST_STATE_SIZE + 1] = {
    -0.2053064989558,   -0.3452145056479, -8.732950737831e-05, 0.1180004300084,
    -0.9713171183945,   0.03448027759634, -0.2352746607069,    -1.085126433825,
    -0.001414614763263, -0.1081116283286, 0.02957505644408};

static void test_motion_of_disc(void **unused)
{
    (void)unused;
    const fst_params p = disc_of(1e-4);
    check_motion(&p, 20, DISC_BY_SLIPS, 1e-8, 2e-7);
    check_motion(&p, 20, DISC_BY_SLIPS, 1e-10, 3e-8);
    CHECK_WITHIN(work(&p, 20), 0, 6e5); /* they took 35 million */
}

/* A larger disc, which comes to rest many times and lets go: against steps of the mode slip. */
static void test_rests_of_disc(void **unused)
{
    (void)unused;
    const fst_params p = disc_of(1e-3);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], ends[2][FST_STATE_SIZE];
    start_of(&p, model, start);
    for (int followed = 0; followed < 2; ++followed) {
        fst_flow *flow = flow_of(model, 1e-11, start);
        if (followed)
            fst_creep_is_followed(flow);
        while (flow->t.high < turns(model, 2))
            assert_int_equal(fst_flow_step(flow, turns(model, 2), NULL), FST_OK);
        assert_true(flow->contact.captures > 3);
        memcpy(ends[followed], flow->step.end, sizeof ends[followed]);
        fst_flow_free(flow);
    }
    CHECK_CLOSE(greatest_difference(ends[0], ends[1], FST_STATE_SIZE), 0, 1e-6);
    fst_model_free(model);
}

/* A disc whose pivoting comes to nothing while it creeps is held there where friction can
 * hold it, and else pivots on the other way. */
static void test_ways_of_disc(void **unused)
{
    (void)unused;
    const fst_params p = disc_of(3e-4);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow *flow = flow_of(model, 1e-9, start);
    int held = 0, turned = 0;
    while (flow->t.high < turns(model, 2)) {
        fst_pull_double p_start;
        const fst_modes_double was = *fst_flow_modes(flow), *is = fst_flow_modes(flow);
        assert_int_equal(fst_flow_step(flow, turns(model, 2), NULL), FST_OK);
        const int holds = was.contact == FST_MODE_CREEP && is->contact == FST_MODE_STICK;
        const int turns_round =
            was.contact == FST_MODE_CREEP && is->contact == FST_MODE_CREEP && is->way != was.way;
        fst_magnetic_pull_double(&model->world, is, flow->step.y, &p_start);
        const double left = fst_disc_hold(&model->world, is, flow->step.y, &p_start);
        assert_true((!holds || left > -1e-9) && (!turns_round || left < 1e-9));
        held += holds;
        turned += turns_round;
    }
    assert_true(held > 3 && turned > 3);
    fst_flow_free(flow);
    fst_model_free(model);
}

static void end_of_disc(double radius, double *end)
{
    fst_params p = disc_of(radius);
    p.friction_mu = 0.5;
    p.drive_frequency = 6;
    if (radius == 0.0) {
        p.contact_patch = FST_PATCH_POINT;
        p.contact_radius = NAN;
    }
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    state_after(model, 1e-9, start, 30, end);
    fst_model_free(model);
}

/* Smaller discs come closer to a point, in proportion to their radius. */
static void test_limit_of_disc(void **unused)
{
    (void)unused;
    double point[FST_STATE_SIZE], ends[3][FST_STATE_SIZE], off[3];
    end_of_disc(0.0, point);
    for (int i = 0; i < 3; ++i) {
        end_of_disc(1e-5 / (1 << i), ends[i]);
        off[i] = greatest_difference(ends[i], point, FST_STATE_SIZE);
        if (i > 0)
            CHECK_WITHIN(off[i - 1] / off[i], 1.97, 2.05);
    }
    for (int j = 0; j < FST_STATE_SIZE; ++j)
        CHECK_CLOSE(2.0 * ends[2][j] - ends[1][j], point[j], 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_direction),     cmocka_unit_test(test_motion),
        cmocka_unit_test(test_work),          cmocka_unit_test(test_neighbours),
        cmocka_unit_test(test_slip_of_disc),  cmocka_unit_test(test_motion_of_disc),
        cmocka_unit_test(test_rests_of_disc), cmocka_unit_test(test_limit_of_disc),
        cmocka_unit_test(test_ways_of_disc),
    };
    return cmocka_run_group_tests_name("creep", tests, NULL, NULL);
}
