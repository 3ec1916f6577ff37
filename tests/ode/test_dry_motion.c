/* Dry friction over the magnet: the laws rolling, coulomb and none as each other's limits, energy, symmetries.
 * tests: ode/contact.c model/contact/coulomb.inl model/contact/rolling.inl model/contact/none.inl */
#include "physics.h"

#include "model/model.h"
#include "observe/quadrature.h"
#include "ode/flow.h"

static fst_params dry_bead(double omega, fst_dynamics dynamics, fst_friction_law law, double mu)
{
    fst_params p = bead_at(omega, dynamics);
    p.friction_law = (int)law;
    p.friction_mu = mu;
    return p;
}

/* The law coulomb in eight variants that use every key. */
enum { VARIANTS = 8 };
static fst_params variant(int which, double omega)
{
    fst_params p =
        dry_bead(omega, which & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID, FST_FRICTION_COULOMB, 0.2);
    if (which / 2 == 1)
        p.friction_mu_static = 0.3;
    if (which == 3)
        p.friction_stribeck_speed = 0.05;
    if (which / 2 == 2)
        p.friction_rolling_resistance = 2e-3;
    if (which / 2 == 3)
        p.friction_rolling_resistance = 0.2; /* at rest for a part of the time */
    return p;
}

/* ------------------------------------------------------------------ limits */

/* mu = 0 has the bits of `none`. */
static void test_no_friction(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        fst_params p = dry_bead(0.3, (fst_dynamics)dynamics, FST_FRICTION_COULOMB, 0.0);
        p.start_r = 0.8;
        p.run_periods = 20;
        const fst_run_result a = run_of(&p);
        p.friction_law = FST_FRICTION_NONE;
        const fst_run_result b = run_of(&p);
        assert_memory_equal(a.final_state, b.final_state, sizeof a.final_state);
        assert_int_equal(a.regime, b.regime);
        assert_true(a.rhs_calls == b.rhs_calls);
        CHECK_SAME_BITS(a.mean_r, b.mean_r);
        CHECK_SAME_BITS(a.mean_alpha_dot, b.mean_alpha_dot);
    }
}

/* Friction that never lets go is `rolling`. */
static void test_rough_plate(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        fst_params p = dry_bead(0.3, (fst_dynamics)dynamics, FST_FRICTION_COULOMB, 10.0);
        double start[FST_STATE_SIZE], ends[2][FST_STATE_SIZE];
        for (int law = 0; law < 2; ++law) {
            if (law)
                p.friction_law = FST_FRICTION_ROLLING;
            fst_model *model = model_of(&p);
            start_of(&p, model, start);
            state_after(model, 1e-13, start, 80, ends[law]);
            fst_model_free(model);
        }
        CHECK_CLOSE(greatest_difference(ends[0], ends[1], FST_STATE_SIZE), 0, 3e-11);
    }
}

/* ------------------------------------------------------------------ rolling for ever */

/* (X, Y; nX, nY, nZ; WX, WY, WZ; t) -> (X, -Y; nX, -nY, nZ; -...): what a film that runs backwards shows in a
 * mirror. */
static void reverse(const double *state, double *image)
{
    static const double sign[FST_STATE_SIZE] = {1, -1, -1, 1, 1, -1, 1, 1, -1, 1};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        image[i] = sign[i] * state[i];
}

/* A state that rolls. */
static void rolling_state(uint64_t *seed, double eps, double *y)
{
    random_state(seed, y);
    for (int i = FST_WX; i < FST_STATE_SIZE; ++i)
        y[i] *= 0.4;
    y[FST_VX] = eps * y[FST_WY];
    y[FST_VY] = -eps * y[FST_WX];
}

static void test_rolling_is_reversible(void **unused)
{
    (void)unused;
    uint64_t seed = 5;
    for (int dynamics = 0; dynamics < 2; ++dynamics)
        for (int trial = 0; trial < 4; ++trial) {
            const fst_params p = dry_bead(0.3, (fst_dynamics)dynamics, FST_FRICTION_ROLLING, 0.2);
            fst_model *model = model_of(&p);
            double y[FST_STATE_SIZE], end[FST_STATE_SIZE], back[FST_STATE_SIZE];
            rolling_state(&seed, fst_model_groups(model).eps, y);
            state_after(model, 1e-13, y, 12, end);
            reverse(end, end);
            state_after(model, 1e-13, end, 12, back);
            reverse(back, back);
            CHECK_CLOSE(greatest_difference(y, back, FST_STATE_SIZE), 0, 1e-10);
            fst_model_free(model);
        }
}

/* The state with x, n and W moved by d along one of seven directions that span them. */
static void moved(const double *y, double eps, int direction, double d, double *out)
{
    double basis[2][3], along[3] = {1, 0, 0};
    const double *n = y + FST_NX;
    if (fabs(n[0]) > 0.7)
        along[0] = 0, along[1] = 1;
    cross(n, along, basis[0]);
    const double size = sqrt(dot(basis[0], basis[0]));
    for (int i = 0; i < 3; ++i)
        basis[0][i] /= size;
    cross(n, basis[0], basis[1]);
    memcpy(out, y, FST_STATE_SIZE * sizeof *y);
    if (direction < 2)
        out[direction] += d;
    else if (direction < 4)
        for (int i = 0; i < 3; ++i)
            out[FST_NX + i] = n[i] * cos(d) + basis[direction - 2][i] * sin(d);
    else
        out[FST_WX + direction - 4] += d;
    out[FST_VX] = eps * out[FST_WY];
    out[FST_VY] = -eps * out[FST_WX];
}

static double determinant(double m[7][7])
{
    double product = 1;
    for (int k = 0; k < 7; ++k) {
        int pivot = k;
        for (int i = k + 1; i < 7; ++i)
            if (fabs(m[i][k]) > fabs(m[pivot][k]))
                pivot = i;
        for (int j = 0; j < 7 && pivot != k; ++j) {
            const double swap = m[k][j];
            m[k][j] = m[pivot][j];
            m[pivot][j] = swap;
        }
        product *= pivot == k ? m[k][k] : -m[k][k];
        for (int i = k + 1; i < 7; ++i)
            for (int j = 6; j >= k; --j)
                m[i][j] -= m[i][k] / m[k][k] * m[k][j];
    }
    return product;
}

/* How much the flow of the law rolling changes the volume dx dn dW in the time t. */
static double volume_factor(fst_dynamics dynamics, double t)
{
    const fst_params p = dry_bead(0.3, dynamics, FST_FRICTION_ROLLING, 0.2);
    fst_model *model = model_of(&p);
    const double eps = fst_model_groups(model).eps, d = 5e-4;
    double y[FST_STATE_SIZE], end[FST_STATE_SIZE], m[7][7] = {{0}};
    uint64_t seed = 11;
    rolling_state(&seed, eps, y);
    state_after(model, 1e-13, y, t, end);
    for (int j = 0; j < 7; ++j)
        for (int k = -2; k <= 2; ++k) {
            static const double weight[] = {1.0 / 12, -2.0 / 3, 0, 2.0 / 3, -1.0 / 12};
            double from[FST_STATE_SIZE], to[FST_STATE_SIZE], unit[FST_STATE_SIZE];
            if (k == 0)
                continue;
            moved(y, eps, j, k * d, from);
            state_after(model, 1e-13, from, t, to);
            for (int i = 0; i < 7; ++i) { /* the components along the directions at the end */
                double along = to[i < 2 ? i : FST_WX + i - 4];
                if (i >= 2 && i < 4) {
                    moved(end, eps, i, TWO_PI / 4, unit);
                    along = dot(to + FST_NX, unit + FST_NX);
                }
                m[i][j] += weight[k + 2] * along / d;
            }
        }
    fst_model_free(model);
    return fabs(determinant(m));
}

static void test_rolling_keeps_volume(void **unused)
{
    (void)unused;
    CHECK_CLOSE(volume_factor(FST_DYNAMICS_RIGID, 4), 1, 1e-7);
    CHECK_WITHIN(fabs(volume_factor(FST_DYNAMICS_FARAGO2020, 4) - 1), 1e-3,
                 10); /* the printed equations do not */
}

/* ------------------------------------------------------------------ energy */

/* The defect of dE = (drive - friction - resistance) dt at the end of every step, over the work of friction. */
static double worst_defect(const fst_params *p, double rtol, double t_end, int *slips)
{
    fst_model *model = model_of(p);
    double start[FST_STATE_SIZE], worst = 0, work = 0;
    start_of(p, model, start);
    fst_flow *flow = flow_of(model, rtol, start);
    fst_quadrature q;
    fst_quadrature_begin(&q, flow);
    const double energy = fst_observe(model, start).energy;
    while (flow->t.high < t_end) {
        assert_int_equal(fst_flow_step(flow, t_end, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
        static const double places[] = {0.37, 0.81, 1.0};
        for (int i = 0; i < 3; ++i) {
            double sums[FST_Q_COUNT], phi, state[FST_STATE_SIZE];
            fst_quadrature_at(&q, flow, places[i], sums, &phi);
            fst_flow_at(flow, places[i], state);
            work = sums[FST_Q_FRICTION_POWER] + sums[FST_Q_ROLLING_POWER];
            const double gain = fst_observe(model, state).energy - energy;
            worst = fmax(worst, fabs(gain - (sums[FST_Q_DRIVE_POWER] - work)));
        }
        *slips += fst_contact_mode(flow) == FST_MODE_SLIP;
    }
    fst_flow_free(flow);
    fst_model_free(model);
    return worst / (work > 0 ? work : 1.0);
}

static void test_energy_balance(void **unused)
{
    (void)unused;
    for (int which = 0; which < VARIANTS; ++which) {
        const fst_params p = variant(which, 0.215);
        int slips = 0;
        const double t = 5 * TWO_PI / 0.215, at_default = worst_defect(&p, 1e-10, t, &slips);
        CHECK_WITHIN(at_default, 0, 1e-8);
        CHECK_WITHIN(worst_defect(&p, 1e-12, t, &slips), 0, 1e-10);
        assert_true(slips > 100);
    }
    int none = 0;
    const fst_params p = dry_bead(0.3, FST_DYNAMICS_RIGID, FST_FRICTION_ROLLING, 0.2);
    CHECK_WITHIN(worst_defect(&p, 1e-12, 100, &none), 0, 1e-12);
}

/* Friction never drives: f.V >= 0, and 0 where the contact sticks. */
static void test_friction_only_takes(void **unused)
{
    (void)unused;
    for (int which = 0; which < VARIANTS; ++which) {
        const fst_params p = variant(which, 0.3);
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE];
        start_of(&p, model, start);
        fst_flow *flow = flow_of(model, 1e-10, start);
        int modes[3] = {0, 0, 0};
        while (flow->t.high < 150) {
            assert_int_equal(fst_flow_step(flow, 150, NULL), FST_OK);
            for (double x = 0.1; x < 1.05; x += 0.1) {
                double state[FST_STATE_SIZE];
                fst_flow_at(flow, fmin(x, 1.0), state);
                const fst_observation o = fst_observe(model, state);
                CHECK_WITHIN(o.friction_power, -1e-18, 1);
                if (fst_contact_mode(flow) == FST_MODE_STICK)
                    CHECK_CLOSE(o.slip_norm, 0, 1e-11);
            }
            ++modes[fst_contact_mode(flow)];
        }
        assert_true(modes[FST_MODE_SLIP] > 10 && modes[FST_MODE_STICK] > 10);
        fst_flow_free(flow);
        fst_model_free(model);
    }
}

/* ------------------------------------------------------------------ symmetries */

static void mirror(const double *state, double *image)
{
    static const double sign[FST_STATE_SIZE] = {1, -1, 1, -1, 1, -1, 1, -1, 1, -1};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        image[i] = sign[i] * state[i];
}

/* The magnet turned by half a turn, and the mirror with the magnet turning the other way, through slips,
 * captures and releases. */
static void test_symmetries(void **unused)
{
    (void)unused;
    for (int which = 0; which < VARIANTS; ++which) {
        const fst_params p = variant(which, 0.215);
        fst_model *model = model_of(&p), back = *model;
        back.groups.omega = back.world.omega = -0.215;
        const double t = 3 * TWO_PI / 0.215;
        double start[FST_STATE_SIZE], end[FST_STATE_SIZE], image[FST_STATE_SIZE], end_of_image[FST_STATE_SIZE];
        start_of(&p, model, start);
        state_after(model, 1e-12, start, t, end);
        fst_apply_s2(start, image);
        state_after(model, 1e-12, image, t, end_of_image);
        fst_apply_s2(end_of_image, end_of_image);
        CHECK_CLOSE(greatest_difference(end_of_image, end, FST_STATE_SIZE), 0, 1e-9);
        mirror(start, image);
        state_after(&back, 1e-12, image, t, end_of_image);
        mirror(end_of_image, end_of_image);
        CHECK_CLOSE(greatest_difference(end_of_image, end, FST_STATE_SIZE), 0, 1e-9);
        fst_model_free(model);
    }
}

/* Gamma is a unit of time: changed at a fixed moment and gravity it leaves the motion as
 * it is in seconds. */
static void test_gamma_is_a_unit(void **unused)
{
    (void)unused;
    for (int which = 0; which < VARIANTS; ++which) {
        fst_params p = variant(which, NAN);
        p.drive_omega = NAN;
        p.drive_frequency = 10.7;
        double ends[2][FST_STATE_SIZE];
        for (int i = 0; i < 2; ++i) {
            const double factor = i ? 1.6 : 1.0;
            p.friction_gamma = 312.5 * factor;
            p.model_kappa = 1.5 / (factor * factor);
            fst_model *model = model_of(&p);
            double start[FST_STATE_SIZE];
            start_of(&p, model, start);
            state_after(model, 1e-12, start, 3 * TWO_PI / fst_model_groups(model).omega, ends[i]);
            for (int k = 0; k < FST_STATE_SIZE; ++k)
                if (k == FST_VX || k == FST_VY || k >= FST_WX)
                    ends[i][k] *= factor;
            fst_model_free(model);
        }
        CHECK_CLOSE(greatest_difference(ends[0], ends[1], FST_STATE_SIZE), 0, 2e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_friction),
        cmocka_unit_test(test_rough_plate),
        cmocka_unit_test(test_rolling_is_reversible),
        cmocka_unit_test(test_rolling_keeps_volume),
        cmocka_unit_test(test_energy_balance),
        cmocka_unit_test(test_friction_only_takes),
        cmocka_unit_test(test_symmetries),
        cmocka_unit_test(test_gamma_is_a_unit),
    };
    return cmocka_run_group_tests_name("dry_motion", tests, NULL, NULL);
}
