/* Dry friction on a plate without a magnet, for which each number has a formula: how a slip ends, how fast the
 * bead then rolls, and how rolling resistance brings a bead to rest.  The turning frame, which computes all
 * this, must not show.  Besides, on a line: a slip that a magnet's push turns round.
 * tests: ode/automaton.inl ode/slip.c ode/rest.c model/contact/coulomb.inl model/contact/resistance.inl
 * labels: memcheck */
#include "physics.h"

#include "model/model.h"
#include "ode/flow.h"

static fst_params plate_alone(fst_friction_law law, double mu)
{
    fst_params p = bead_at(0.29, FST_DYNAMICS_RIGID);
    p.model_kappa = 0;
    p.friction_law = (int)law;
    p.friction_mu = mu;
    return p;
}

static const double THROWN[FST_STATE_SIZE] = {0.7, -0.3, 0.02, 0.05, 0.6, 0.0, 0.8, 0.9, -0.4, 1.3};

/* (2/5) eps^2 W + eps e x v: the moment about the contact. */
static void moment_about_contact(double eps, const double *state, double moment[3])
{
    for (int i = 0; i < 3; ++i)
        moment[i] = 0.4 * eps * eps * state[FST_WX + i];
    moment[0] -= eps * state[FST_VY];
    moment[1] += eps * state[FST_VX];
}

/* Sliding from V0 at the deceleration mu g, and from then on rolling:
 *     V = V0 (1 - t/t1),   v = v0 - mu g t u,   W = W0 + 5/(2 eps) mu g t e x u,   x = x0 + v0 t - mu g t^2/2 u
 * until t1 = 2 |V0|/(7 mu g), when v = v0 - (2/7) V0; the plate is then V0^2/7 warmer. */
static void check_thrown(fst_params p, double t)
{
    fst_model *model = model_of(&p);
    const fst_groups g = fst_model_groups(model);
    const double *s = THROWN, brake = p.friction_mu * g.gravity;
    const double slip[2] = {s[FST_VX] - g.eps * s[FST_WY], s[FST_VY] + g.eps * s[FST_WX]};
    const double size = hypot(slip[0], slip[1]), t1 = 2 * size / (7 * brake), slid = fmin(t, t1);
    const double u[3] = {slip[0] / size, slip[1] / size, 0}, up[3] = {0, 0, 1};
    double exu[3], lab[FST_STATE_SIZE], before[3], after[3];
    cross(up, u, exu);
    state_after(model, 1e-13, s, t, lab);
    turn_state(lab, g.omega * t, lab);
    for (int i = 0; i < 2; ++i) {
        const double v = s[FST_VX + i] - brake * slid * u[i];
        CHECK_CLOSE(lab[FST_VX + i], v, 2e-13);
        CHECK_CLOSE(lab[FST_X + i],
                    s[FST_X + i] + s[FST_VX + i] * slid - 0.5 * brake * slid * slid * u[i] + v * (t - slid),
                    3e-12);
    }
    for (int i = 0; i < 3; ++i)
        CHECK_CLOSE(lab[FST_WX + i], s[FST_WX + i] + 2.5 / g.eps * brake * slid * exu[i], 3e-12);
    moment_about_contact(g.eps, s, before);
    moment_about_contact(g.eps, lab, after);
    CHECK_CLOSE(greatest_difference(before, after, 3), 0, 1e-13);
    const fst_observation o = fst_observe(model, lab);
    const double left = size * (1 - slid / t1);
    CHECK_CLOSE(o.slip_norm, left, 1e-12);
    CHECK_CLOSE(fst_observe(model, s).energy - o.energy, (size * size - left * left) / 7, 1e-13);
    fst_model_free(model);
}

static void test_thrown(void **unused)
{
    (void)unused;
    static const double mu[] = {0.01, 0.2, 3.0};
    for (int i = 0; i < 3; ++i)
        for (double t = 0.01; t < 2000; t *= 2.9)
            check_thrown(plate_alone(FST_FRICTION_COULOMB, mu[i]), t);
    fst_params p = plate_alone(FST_FRICTION_COULOMB, 0.2);
    p.friction_mu_static = 0.5; /* once it slides, that does not count */
    check_thrown(p, 30);
    check_thrown(p, 90);
}

/* The time at which a slip of the speed 0.15 comes to rest.  A speed so small that it counts as rest is reached
 * before the end by no more than 1e-12. */
static double slip_ends_at(const fst_params *p)
{
    fst_model *model = model_of(p);
    const double start[FST_STATE_SIZE] = {0.3, 0, 0.15, 0, 0, 0, 1, 0, 0, 0.7};
    fst_flow *flow = flow_of(model, 1e-13, start);
    assert_int_equal(fst_contact_mode(flow), FST_MODE_SLIP);
    double end = 0;
    while (fst_contact_mode(flow) == FST_MODE_SLIP) {
        end = flow->t.high;
        assert_true(end < 1e4);
        assert_int_equal(fst_flow_step(flow, INFINITY, NULL), FST_OK);
    }
    fst_flow_free(flow);
    fst_model_free(model);
    return end;
}

/* 2 s/(7 mu g); and where friction falls as the slip grows, mu = mu_d + (mu_s - mu_d)/(1 + s^2/v^2), by an
 * integral. */
static void test_end_of_slip(void **unused)
{
    (void)unused;
    const double s = 0.15;
    fst_params p = plate_alone(FST_FRICTION_COULOMB, 0.2);
    fst_model *model = model_of(&p);
    const fst_groups group = fst_model_groups(model);
    fst_model_free(model);
    const double g = group.gravity;
    CHECK_CLOSE(slip_ends_at(&p), 2 * s / (7 * 0.2 * g), 2e-11);
    p.friction_mu_static = 0.5;
    p.friction_stribeck_speed = 0.04 * p.magnet_half_length * p.friction_gamma;
    double sum = 0;
    enum { PANELS = 4000 };
    for (int i = 0; i < PANELS; ++i) /* Gauss's rule of two points */
        for (int side = -1; side <= 1; side += 2) {
            const double at = s * (i + 0.5 + side * 0.5 / sqrt(3.0)) / PANELS, part = at / 0.04;
            sum += 0.5 * s / PANELS / (3.5 * g * (0.2 + 0.3 / (1 + part * part)));
        }
    CHECK_CLOSE(slip_ends_at(&p), sum, 1e-10);
}

/* Rolling resistance brakes a bead that rolls by (5/7) c g; it stops after v/((5/7) c g), a distance
 * v^2/(2 (5/7) c g) away, and stays there, whatever the dry law. */
static void test_rolling_stops(void **unused)
{
    (void)unused;
    static const fst_friction_law laws[] = {FST_FRICTION_ROLLING, FST_FRICTION_COULOMB};
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            fst_params p = plate_alone(laws[i], 0.3);
            p.friction_rolling_resistance = j ? 0.01 : 0.001;
            fst_model *model = model_of(&p);
            const fst_groups g = fst_model_groups(model);
            const double v = 0.03, brake = 5.0 / 7 * p.friction_rolling_resistance * g.gravity,
                         stops = v / brake;
            const double start[FST_STATE_SIZE] = {0.4, 0.1, v, 0, 0, 0, 1, 0, v / g.eps, 0};
            double lab[FST_STATE_SIZE];
            const double t = 0.9 * stops;
            state_after(model, 1e-12, start, t, lab);
            turn_state(lab, g.omega * t, lab);
            CHECK_CLOSE(lab[FST_VX], v - brake * t, 1e-11);
            CHECK_CLOSE(lab[FST_X], 0.4 + v * t - 0.5 * brake * t * t, 1e-10 * stops);
            const double energy = fst_observe(model, start).energy, now = fst_observe(model, lab).energy;
            CHECK_CLOSE((energy - now) / energy, 1 - 0.1 * 0.1, 1e-9);
            state_after(model, 1e-13, start, 1.1 * stops, lab);
            turn_state(lab, g.omega * 1.1 * stops, lab);
            for (int k = 0; k < 2; ++k) { /* at rest: not slow, but at rest */
                CHECK_SAME_BITS(fabs(lab[FST_VX + k]), 0.0);
                CHECK_SAME_BITS(fabs(lab[FST_WX + k]), 0.0);
            }
            CHECK_CLOSE(lab[FST_X], 0.4 + 0.5 * v * stops, 1e-6);
            CHECK_CLOSE(lab[FST_Y], 0.1, 1e-7);
            fst_model_free(model);
        }
}

/* A plate that resists rolling more than friction can drive it, c > mu: a bead that is thrown with a rotation w
 * and slips stops rotating after 2 eps w/(5 (c - mu) g), slides on without rolling, against mu g, and is at
 * rest after v/(mu g), a distance v^2/(2 mu g) away.  Without rotation it slides from the start. */
static void test_slides_without_rolling(void **unused)
{
    (void)unused;
    const double mu = 0.2, c = 0.5, v = 0.06;
    for (int i = 0; i < 2; ++i) {
        fst_params p = plate_alone(FST_FRICTION_COULOMB, mu);
        p.friction_rolling_resistance = c;
        fst_model *model = model_of(&p);
        const fst_groups g = fst_model_groups(model);
        const double w = i ? 0.0 : 0.5 * v / g.eps, stops = v / (mu * g.gravity);
        const double start[FST_STATE_SIZE] = {0.4, 0.1, v, 0, 0, 0, 1, 0, w, 0};
        const double rolls = 2 * g.eps * w / (5 * (c - mu) * g.gravity);
        double lab[FST_STATE_SIZE];
        assert_true(rolls < 0.5 * stops);
        for (int k = 0; k < 3; ++k) {
            const double t = k == 2 ? 1.2 * stops : k == 1 ? 0.9 * stops : 0.5 * rolls;
            const double until = fmin(t, stops);
            state_after(model, 1e-12, start, t, lab);
            turn_state(lab, g.omega * t, lab);
            CHECK_CLOSE(lab[FST_VX], v - mu * g.gravity * until, 1e-11);
            CHECK_CLOSE(lab[FST_X], 0.4 + v * until - 0.5 * mu * g.gravity * until * until, 1e-10);
            CHECK_CLOSE(lab[FST_WY], fmax(w * (1 - t / fmax(rolls, 1e-300)), 0), 1e-11);
            if (t > rolls)
                CHECK_SAME_BITS(fabs(lab[FST_WY]), 0.0);
            if (t > stops)
                CHECK_SAME_BITS(fabs(lab[FST_VX]), 0.0);
        }
        fst_model_free(model);
    }
}

/* A bead that slips straight against a push that friction cannot hold: the slip stops, begins anew and has
 * turned round.  The drive stands still, so that nothing leads off the line of the motion. */
static void test_turns_round(void **unused)
{
    (void)unused;
    fst_params p = plate_alone(FST_FRICTION_COULOMB, 1e-3);
    p.model_kappa = 1;
    fst_model *model = model_of(&p);
    const double start[FST_STATE_SIZE] = {0.7, 0, 0.05, 0, 0, 0, -1, 0, 0, 0};
    fst_flow *flow = flow_of(model, 1e-8, start);
    flow->drive.omega = 0;
    fst_bead_flow_restart(flow);
    double slip[2], last = start[FST_VX];
    int steps = 0, begins = 0;
    while (last > -1e-4 && ++steps < 100) {
        assert_int_equal(fst_flow_step(flow, 10, NULL), FST_OK);
        fst_slip_double(fst_flow_world(flow), flow->step.end, slip);
        assert_true(fst_contact_mode(flow) != FST_MODE_STICK && fabs(slip[1]) < 1e-15);
        begins |= fst_contact_mode(flow) == FST_MODE_ONSET;
        last = slip[0];
    }
    assert_true(begins && last < -1e-4);
    fst_flow_free(flow);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_thrown),        cmocka_unit_test(test_end_of_slip),
        cmocka_unit_test(test_rolling_stops), cmocka_unit_test(test_slides_without_rolling),
        cmocka_unit_test(test_turns_round),
    };
    return cmocka_run_group_tests_name("dry_exact", tests, NULL, NULL);
}
