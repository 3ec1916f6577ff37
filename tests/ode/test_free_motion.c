/* Motions with exact solutions: a sphere that no torque acts on, and a bead that rolls and slips in no field.
 *
 * All of them have kappa = 0; the turning frame, which computes them, must not show in the laboratory.
 * tests: ode/flow.c model/dynamics.inl */
#include "physics.h"

static fst_model *free_model(fst_dynamics dynamics, fst_friction_law law)
{
    fst_params p = bead_at(0.29, dynamics);
    p.model_kappa = 0;
    p.friction_law = (int)law;
    return model_of(&p);
}

/* The state after the time t, in the laboratory's components; at t = 0 these agree with the turning frame's. */
static void lab_state_after(const fst_model *model, const double *start, double t, double *lab)
{
    double state[FST_STATE_SIZE];
    state_after(model, 1e-13, start, t, state);
    turn_state(state, fst_model_groups(model).omega * t, lab);
}

static const double SPINNING[FST_STATE_SIZE] = {0.7, -0.3, 0.02, 0.05, 0.6, 0.0, 0.8, 0.9, -0.4, 1.3};

/* No torque: W stays, n circles it on a cone at the rate |W|, and x moves straight on. */
static void test_torque_free_rigid(void **unused)
{
    (void)unused;
    fst_model *model = free_model(FST_DYNAMICS_RIGID, FST_FRICTION_NONE);
    const double *n0 = SPINNING + FST_NX, *w = SPINNING + FST_WX, rate = sqrt(dot(w, w));
    const double axis[3] = {w[0] / rate, w[1] / rate, w[2] / rate};
    for (double t = 5; t < 100; t += 19) {
        double lab[FST_STATE_SIZE], n[3];
        lab_state_after(model, SPINNING, t, lab);
        turn_about(axis, rate * t, n0, n);
        CHECK_CLOSE(greatest_difference(lab + FST_NX, n, 3), 0, 2e-11);
        CHECK_CLOSE(greatest_difference(lab + FST_WX, w, 3), 0, 2e-12);
        for (int i = 0; i < 2; ++i) {
            CHECK_CLOSE(lab[FST_VX + i], SPINNING[FST_VX + i], 1e-12);
            CHECK_CLOSE(lab[FST_X + i], SPINNING[FST_X + i] + SPINNING[FST_VX + i] * t, 1e-11);
        }
    }
    fst_model_free(model);
}

/* The paper's printed equations: n runs on a great circle at the rate |W x n|, whatever the spin psi' about n,
 * which stays; W = n x n' + psi' n goes with n. */
static void test_torque_free_farago2020(void **unused)
{
    (void)unused;
    fst_model *model = free_model(FST_DYNAMICS_FARAGO2020, FST_FRICTION_NONE);
    const double *n0 = SPINNING + FST_NX, *w0 = SPINNING + FST_WX, spin = dot(w0, n0);
    double rate0[3];
    cross(w0, n0, rate0);
    const double rate = sqrt(dot(rate0, rate0));
    for (double t = 5; t < 100; t += 19) {
        double lab[FST_STATE_SIZE], n[3], n_dot[3], w[3];
        lab_state_after(model, SPINNING, t, lab);
        for (int i = 0; i < 3; ++i) {
            n[i] = n0[i] * cos(rate * t) + rate0[i] / rate * sin(rate * t);
            n_dot[i] = -rate * n0[i] * sin(rate * t) + rate0[i] * cos(rate * t);
        }
        cross(n, n_dot, w);
        for (int i = 0; i < 3; ++i)
            w[i] += spin * n[i];
        CHECK_CLOSE(greatest_difference(lab + FST_NX, n, 3), 0, 2e-11);
        CHECK_CLOSE(greatest_difference(lab + FST_WX, w, 3), 0, 2e-11);
    }
    fst_model_free(model);
}

/* Viscous friction alone.  V' = -(7/2) V, so with E = 1 - exp(-7t/2)
 *     V = V0 (1 - E),  v = v0 - (2/7) V0 E,  W = W0 + 5/(7 eps) (e x V0) E,
 *     x = x0 + (v0 - (2/7) V0) t + (4/49) V0 E,
 * and V0^2/7 is dissipated on the way to rolling. */
static void test_slip_decays(void **unused)
{
    (void)unused;
    fst_model *model = free_model(FST_DYNAMICS_RIGID, FST_FRICTION_VISCOUS);
    const double eps = fst_model_groups(model).eps, *s = SPINNING;
    const double slip[3] = {s[FST_VX] - eps * s[FST_WY], s[FST_VY] + eps * s[FST_WX], 0}, up[3] = {0, 0, 1};
    double exv[3];
    cross(up, slip, exv);
    for (double t = 0.05; t < 30; t *= 2) {
        const double decayed = -expm1(-3.5 * t);
        double lab[FST_STATE_SIZE];
        lab_state_after(model, s, t, lab);
        for (int i = 0; i < 2; ++i) {
            CHECK_CLOSE(lab[FST_VX + i], s[FST_VX + i] - 2.0 / 7 * slip[i] * decayed, 1e-12);
            CHECK_CLOSE(lab[FST_X + i],
                        s[FST_X + i] + (s[FST_VX + i] - 2.0 / 7 * slip[i]) * t + 4.0 / 49 * slip[i] * decayed,
                        3e-12);
        }
        for (int i = 0; i < 3; ++i)
            CHECK_CLOSE(lab[FST_WX + i], s[FST_WX + i] + 5 / (7 * eps) * exv[i] * decayed, 3e-12);
        const fst_observation o = fst_observe(model, lab);
        CHECK_CLOSE(o.slip_norm, hypot(slip[0], slip[1]) * (1 - decayed), 1e-12);
        const double lost = fst_observe(model, s).energy - o.energy;
        CHECK_CLOSE(lost, dot(slip, slip) / 7 * (1 - (1 - decayed) * (1 - decayed)), 1e-12);
    }
    fst_model_free(model);
}

/* A ball thrown along d that spins about the horizontal a = e x d: W keeps its direction, and n turns about a
 * by A(t) = (w + 5 Vs/(7 eps)) t - (10 Vs/(49 eps)) E.  farago2020 agrees where n is perpendicular to a, so
 * that no spin about n exists, and where it is along it, but not otherwise. */
static void test_thrown_ball(void **unused)
{
    (void)unused;
    static const double away[3] = {0.8, 0.6, 0}, axis[3] = {-0.6, 0.8, 0};
    static const double across[3] = {0.8 * 0.8, 0.6 * 0.8, 0.6}, oblique[3] = {0.36, 0.48, 0.8};
    static const struct {
        fst_dynamics dynamics;
        const double *n;
        int agrees;
    } throws[] = {{FST_DYNAMICS_RIGID, oblique, 1},
                  {FST_DYNAMICS_RIGID, across, 1},
                  {FST_DYNAMICS_FARAGO2020, across, 1},
                  {FST_DYNAMICS_FARAGO2020, axis, 1},
                  {FST_DYNAMICS_FARAGO2020, oblique, 0}};
    const double v = 0.2, w = -0.7, t = 6;
    for (size_t k = 0; k < sizeof throws / sizeof *throws; ++k) {
        fst_model *model = free_model(throws[k].dynamics, FST_FRICTION_VISCOUS);
        const double eps = fst_model_groups(model).eps, slip = v - eps * w;
        double start[FST_STATE_SIZE] = {0.3, 0.1, v * away[0], v * away[1]}, lab[FST_STATE_SIZE], n[3];
        for (int i = 0; i < 3; ++i) {
            start[FST_NX + i] = throws[k].n[i];
            start[FST_WX + i] = w * axis[i];
        }
        lab_state_after(model, start, t, lab);
        const double angle = (w + 5 * slip / (7 * eps)) * t + 10 * slip / (49 * eps) * expm1(-3.5 * t);
        turn_about(axis, angle, throws[k].n, n);
        const double off = greatest_difference(lab + FST_NX, n, 3);
        if (throws[k].agrees)
            CHECK_CLOSE(off, 0, 1e-11);
        else
            CHECK_WITHIN(off, 0.01, 2);
        fst_model_free(model);
    }
}

/* Rolling without slip, any W: v and W stay, and n never leaves its cone about W. */
static void test_rolling(void **unused)
{
    (void)unused;
    fst_model *model = free_model(FST_DYNAMICS_RIGID, FST_FRICTION_VISCOUS);
    const double eps = fst_model_groups(model).eps, t = 40;
    double start[FST_STATE_SIZE], lab[FST_STATE_SIZE], n[3];
    memcpy(start, SPINNING, sizeof start);
    start[FST_VX] = eps * start[FST_WY];
    start[FST_VY] = -eps * start[FST_WX];
    lab_state_after(model, start, t, lab);
    const double *w = start + FST_WX, rate = sqrt(dot(w, w)), axis[3] = {w[0] / rate, w[1] / rate, w[2] / rate};
    turn_about(axis, rate * t, start + FST_NX, n);
    CHECK_CLOSE(greatest_difference(lab + FST_NX, n, 3), 0, 1e-11);
    CHECK_CLOSE(greatest_difference(lab + FST_WX, w, 3), 0, 1e-12);
    for (int i = 0; i < 2; ++i)
        CHECK_CLOSE(lab[FST_X + i], start[FST_X + i] + start[FST_VX + i] * t, 1e-11);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_torque_free_rigid), cmocka_unit_test(test_torque_free_farago2020),
        cmocka_unit_test(test_slip_decays),       cmocka_unit_test(test_thrown_ball),
        cmocka_unit_test(test_rolling),
    };
    return cmocka_run_group_tests_name("free_motion", tests, NULL, NULL);
}
