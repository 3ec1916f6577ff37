/* The equations of motion and what is read off a state, against a second writing in plain vectors, and the
 * scaled groups that follow from parameters in SI.
 * tests: model/model.c model/field.c model/dynamics.inl model/observe.inl model/world.inl */
#include "physics.h"

#include "model/model.h"

static const double UP[3] = {0, 0, 1};

/* Force, torque per mass and slip of a bead at a state, from the public field alone. */
typedef struct forces {
    double b[3], g[3][3], force[3], torque[3], slip[3], energy;
} forces;

static forces forces_on(const fst_model *model, const double *y)
{
    const fst_groups p = fst_model_groups(model);
    const double *v = y + FST_VX, *n = y + FST_NX, *w = y + FST_WX;
    forces f;
    fst_field(model, y[FST_X], y[FST_Y], f.b, f.g);
    const double hard = p.material == FST_MATERIAL_PARAMAGNETIC ? 0 : p.kappa * p.eps * p.eps;
    const double n_dot_b = dot(n, f.b);
    double nxb[3], wxe[3];
    cross(n, f.b, nxb);
    cross(w, UP, wxe);
    for (int i = 0; i < 3; ++i) {
        f.force[i] = (hard + 2 * p.b * n_dot_b) * dot(f.g[i], n) + 2 * p.a * dot(f.g[i], f.b);
        f.torque[i] = hard * nxb[i] + 2 * p.b * n_dot_b * nxb[i];
        f.slip[i] = (i < 2 ? v[i] : 0) - p.eps * wxe[i];
    }
    f.energy = 0.5 * (v[0] * v[0] + v[1] * v[1]) + 0.2 * p.eps * p.eps * dot(w, w) - hard * n_dot_b -
               p.a * dot(f.b, f.b) - p.b * n_dot_b * n_dot_b;
    return f;
}

/* dv/dt = F - f, dn/dt = W x n, dW/dt = 5/(2 eps^2) tau + 5/(2 eps) e x f, in the laboratory; farago2020 adds
 * (W.n) W x n.  The library's derivative gains omega e x (.) on the way there. */
static void check_equations(const fst_model *model, const double *y)
{
    const fst_groups p = fst_model_groups(model);
    const forces f = forces_on(model, y);
    const double *n = y + FST_NX, *w = y + FST_WX;
    const double friction = p.friction == FST_FRICTION_VISCOUS;
    double dy[FST_STATE_SIZE], expected[FST_STATE_SIZE], wxn[3], exf[3];
    fst_rhs(model, y, dy);
    cross(w, n, wxn);
    cross(UP, f.slip, exf);
    const double lost = p.dynamics == FST_DYNAMICS_FARAGO2020 ? dot(w, n) : 0;
    for (int i = 0; i < 2; ++i) {
        expected[FST_X + i] = y[FST_VX + i];
        expected[FST_VX + i] = f.force[i] - friction * f.slip[i];
    }
    for (int i = 0; i < 3; ++i) {
        expected[FST_NX + i] = wxn[i];
        expected[FST_WX + i] =
            2.5 / (p.eps * p.eps) * f.torque[i] + 2.5 / p.eps * friction * exf[i] + lost * wxn[i];
    }
    static const int horizontal[] = {FST_X, FST_VX, FST_NX, FST_WX};
    for (int i = 0; i < 4; ++i) {
        expected[horizontal[i]] += p.omega * y[horizontal[i] + 1];
        expected[horizontal[i] + 1] -= p.omega * y[horizontal[i]];
    }
    CHECK_CLOSE(greatest_difference(dy, expected, FST_STATE_SIZE), 0, 2e-13 * 2.5 / (p.eps * p.eps));
}

/* Local components by the definition of e_r and e_alpha; drive power omega e.(x x F + tau); load g - F_z. */
static void check_observation(const fst_model *model, const double *y)
{
    const fst_groups p = fst_model_groups(model);
    const forces f = forces_on(model, y);
    const fst_observation o = fst_observe(model, y);
    const double r = hypot(y[FST_X], y[FST_Y]), er[3] = {y[FST_X] / r, y[FST_Y] / r, 0};
    const double ealpha[3] = {-er[1], er[0], 0}, *n = y + FST_NX;
    double nxb[3];
    cross(n, f.b, nxb);
    CHECK_CLOSE(o.r, r, 1e-15);
    CHECK_CLOSE(o.cos_bead_angle, er[0], 1e-15);
    CHECK_CLOSE(o.sin_bead_angle, er[1], 1e-15);
    CHECK_CLOSE(o.n[0], dot(n, er), 1e-15);
    CHECK_CLOSE(o.n[1], dot(n, ealpha), 1e-15);
    CHECK_CLOSE(o.n[2], n[2], 0);
    CHECK_CLOSE(o.b[0], dot(f.b, er), 1e-14);
    CHECK_CLOSE(o.b[1], dot(f.b, ealpha), 1e-14);
    CHECK_CLOSE(o.b[2], f.b[2], 0);
    CHECK_CLOSE(o.b_norm, sqrt(dot(f.b, f.b)), 1e-14);
    CHECK_CLOSE(o.angle, atan2(sqrt(dot(nxb, nxb)), dot(n, f.b)), 1e-7);
    CHECK_CLOSE(cos(o.angle), dot(n, f.b) / o.b_norm, 1e-14);
    CHECK_CLOSE(o.slip[0], dot(f.slip, er), 1e-15);
    CHECK_CLOSE(o.slip[1], dot(f.slip, ealpha), 1e-15);
    CHECK_CLOSE(o.slip_norm, sqrt(dot(f.slip, f.slip)), 1e-15);
    CHECK_CLOSE(o.spin, dot(y + FST_WX, n), 2e-15);
    CHECK_CLOSE(o.load, p.gravity - f.force[2], 1e-14);
    CHECK_CLOSE(o.energy, f.energy, 1e-13);
    const double friction = p.friction == FST_FRICTION_VISCOUS ? dot(f.slip, f.slip) : 0;
    CHECK_CLOSE(o.friction_power, friction, 1e-14);
    const double torque = y[FST_X] * f.force[1] - y[FST_Y] * f.force[0] + f.torque[2];
    CHECK_CLOSE(o.drive_power, p.omega * torque, 1e-14);
}

static void test_equations_and_observations(void **unused)
{
    (void)unused;
    uint64_t seed = 41;
    for (int which = 0; which < 12; ++which) {
        fst_params p = bead_at(0.31, which & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
        p.friction_law = which & 2 ? FST_FRICTION_NONE : FST_FRICTION_VISCOUS;
        p.bead_material = which / 4;
        p.bead_a = 2.3e-3;
        p.bead_b = -1.7e-3;
        fst_model *model = model_of(&p);
        for (int trial = 0; trial < 50; ++trial) {
            double state[FST_STATE_SIZE];
            random_state(&seed, state);
            check_equations(model, state);
            check_observation(model, state);
        }
        fst_model_free(model);
    }
}

/* The field exerts no torque on a paramagnetic bead: on a frictionless plate W stays. */
static void test_paramagnet_feels_no_torque(void **unused)
{
    (void)unused;
    uint64_t seed = 42;
    fst_params p = bead_at(0.31, FST_DYNAMICS_RIGID);
    p.bead_material = FST_MATERIAL_PARAMAGNETIC;
    p.bead_a = 5e-3;
    p.bead_b = 7e-3; /* ignored for this material */
    p.friction_law = FST_FRICTION_NONE;
    fst_model *model = model_of(&p);
    const fst_groups g = fst_model_groups(model);
    assert_true(g.kappa == 0 && g.b == 0 && g.a == 5e-3);
    double state[FST_STATE_SIZE], dy[FST_STATE_SIZE];
    random_state(&seed, state);
    fst_rhs(model, state, dy);
    CHECK_CLOSE(dy[FST_WX], g.omega * state[FST_WY], 1e-15);
    CHECK_CLOSE(dy[FST_WY], -g.omega * state[FST_WX], 1e-15);
    CHECK_CLOSE(dy[FST_WZ], 0, 0);
    fst_model_free(model);
}

/* On the axis e_r and e_alpha do not exist, but every result must still be a number. */
static void test_axis_is_finite(void **unused)
{
    (void)unused;
    const fst_params p = fst_default_params();
    fst_model *model = model_of(&p);
    const double state[FST_STATE_SIZE] = {0, 0, 0.1, 0.2, 1, 0, 0, 0.1, 0.2, 0.3};
    const fst_observation o = fst_observe(model, state);
    const double numbers[] = {o.r,      o.cos_bead_angle, o.sin_bead_angle, o.n[0],       o.n[1],      o.b[0],
                              o.b_norm, o.angle,          o.slip[0],        o.slip[1],    o.slip_norm, o.spin,
                              o.load,   o.energy,         o.friction_power, o.drive_power};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i)
        assert_true(isfinite(numbers[i]));
    assert_true(o.r == 0);
    CHECK_CLOSE(o.b_norm, 3.5881763330877854623, 1e-13);
    fst_model_free(model);
}

/* start.spin = rolling: the contact at rest, W along e_r, alpha' = -eps omega/(r - eps); rest: nothing moves.
 */
static void test_start_states(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    const fst_groups g = fst_model_groups(model);
    for (double phi = -400; phi < 400; phi += 33.7) {
        p.start_phi = phi;
        p.start_r = 0.95 + phi / 1000;
        double y[FST_STATE_SIZE];
        start_of(&p, model, y);
        const fst_observation o = fst_observe(model, y);
        CHECK_CLOSE(o.r, p.start_r, 1e-15);
        CHECK_CLOSE(o.cos_bead_angle, cos(phi / DEGREES), 1e-14);
        CHECK_CLOSE(o.sin_bead_angle, sin(phi / DEGREES), 1e-14);
        CHECK_CLOSE(o.slip_norm, 0, 1e-15);
        CHECK_CLOSE(o.angle, 0, 1e-7);
        const double alpha_dot = (y[FST_X] * y[FST_VY] - y[FST_Y] * y[FST_VX]) / (o.r * o.r);
        CHECK_CLOSE(alpha_dot, -g.eps * g.omega / (o.r - g.eps), 1e-14);
        CHECK_CLOSE(y[FST_WX], g.omega * o.r / (o.r - g.eps) * o.cos_bead_angle, 1e-14);
        CHECK_CLOSE(y[FST_WY], g.omega * o.r / (o.r - g.eps) * o.sin_bead_angle, 1e-14);
        CHECK_CLOSE(y[FST_WZ], 0, 0);
        p.start_spin = FST_SPIN_REST;
        start_of(&p, model, y);
        for (int i = 0; i < 2; ++i)
            assert_true(y[FST_VX + i] == 0);
        for (int i = 0; i < 3; ++i)
            assert_true(y[FST_WX + i] == 0);
        CHECK_CLOSE(fst_observe(model, y).angle, 0, 1e-7);
        p.start_spin = FST_SPIN_ROLLING;
    }
    fst_model_free(model);
}

static void expect_no_start(fst_params p)
{
    fst_model *model = model_of(&p);
    double y[FST_STATE_SIZE];
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_start_state(&p, model, y, &error), FST_BAD_INPUT);
    assert_int_equal(error.code, FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "start."));
    fst_model_free(model);
}

static void test_starts_that_do_not_exist(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    p.start_r = 2.5 / 23; /* no free rolling at r = eps */
    expect_no_start(p);
    p.start_r = 0;
    expect_no_start(p);
    p.start_r = 10.0; /* the edge */
    expect_no_start(p);
    p.start_spin = FST_SPIN_REST;
    expect_no_start(p);
}

/* The paper's numbers in SI give the published groups, and moment and B0 give kappa = mu B0/(m R^2 gamma^2).
 */
static void test_groups(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    fst_model *model = model_of(&p);
    fst_groups g = fst_model_groups(model);
    CHECK_CLOSE(g.eps, 2.5 / 23, 1e-16);
    CHECK_CLOSE(g.h, 18.7 / 23, 2e-16);
    CHECK_CLOSE(g.lambda, 40.0 / 92, 1e-16);
    CHECK_CLOSE(g.kappa, 1.5, 0);
    CHECK_CLOSE(g.gravity, 9.81 / (0.023 * 312.5 * 312.5), 1e-17);
    CHECK_CLOSE(g.omega, 10.7 * 0.020106192982974676, 1e-16);
    CHECK_CLOSE(g.plate_radius, 10, 1e-14);
    fst_model_free(model);
    p.magnet_lines = 1;
    model = model_of(&p);
    assert_true(fst_model_groups(model).lambda == 0);
    fst_model_free(model);
    p.bead_moment = 0.05;
    p.magnet_b0 = 0.02;
    model = model_of(&p);
    g = fst_model_groups(model);
    CHECK_CLOSE(g.kappa, 0.05 * 0.02 / (0.5e-3 * 2.5e-3 * 2.5e-3 * 312.5 * 312.5), 1e-12);
    fst_model_free(model);
}

/* A struct that was never initialised, and contradictions, are told apart from numbers. */
static void test_bad_params(void **unused)
{
    (void)unused;
    fst_model *model;
    fst_error error = {FST_OK, "", ""};
    fst_params p;
    memset(&p, 0, sizeof p);
    assert_int_equal(fst_model_new(&p, &model, &error), FST_BAD_INPUT);
    assert_null(model);
    static const struct {
        size_t field;
        double value;
    } wrong[] = {{offsetof(fst_params, bead_radius), -1},     {offsetof(fst_params, friction_gamma), 0},
                 {offsetof(fst_params, drive_omega), -0.2},   {offsetof(fst_params, model_kappa), NAN},
                 {offsetof(fst_params, run_rtol), INFINITY},  {offsetof(fst_params, run_discard), 400},
                 {offsetof(fst_params, start_phi), -INFINITY}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        p = fst_default_params();
        memcpy((char *)&p + wrong[i].field, &wrong[i].value, sizeof(double));
        error.sentence[0] = '\0';
        assert_int_equal(fst_model_new(&p, &model, &error), FST_BAD_INPUT);
        assert_null(model);
        assert_true(strlen(error.sentence) > 10);
        assert_int_equal(fst_model_new(&p, &model, NULL), FST_BAD_INPUT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equations_and_observations),
        cmocka_unit_test(test_paramagnet_feels_no_torque),
        cmocka_unit_test(test_axis_is_finite),
        cmocka_unit_test(test_start_states),
        cmocka_unit_test(test_starts_that_do_not_exist),
        cmocka_unit_test(test_groups),
        cmocka_unit_test(test_bad_params),
    };
    return cmocka_run_group_tests_name("model", tests, NULL, NULL);
}
