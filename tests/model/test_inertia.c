/* Hollow and coated beads: bead.inertia is the number beta = I/(m R^2).
 *
 * Each number here follows from Newton's and Euler's laws with beta written out.  A force -f at the contact
 * point changes v by -f and W by e x f/(beta eps), hence the slip V = v - eps W x e by -k f, k = 1 + 1/beta.
 * So a slip ends after |V0|/(k mu g), takes V0^2/(2 k), and leaves the moment beta eps^2 W + eps e x v about
 * the contact as it was.
 * tests: model/bead.c model/world.inl
 * labels: numbers */
#include "few_rows.h"
#include "physics.h"
#include "same_results.h"

#include "model/model.h"
#include "ode/flight.h"

static const double BETAS[] = {0.001, 0.25, 0.4, 2.0 / 3.0};
enum { BETA_COUNT = sizeof BETAS / sizeof *BETAS };

static fst_params bead_of(double beta, fst_dynamics dynamics, fst_friction_law law)
{
    fst_params p = bead_at(0.29, dynamics);
    p.bead_inertia = beta;
    p.friction_law = (int)law;
    return p;
}

static fst_params bead_without_magnet(double beta, fst_friction_law law)
{
    fst_params p = bead_of(beta, FST_DYNAMICS_RIGID, law);
    p.model_kappa = 0;
    return p;
}

/* ------------------------------------------------------------------ another writing of the equations */

typedef struct laboratory {
    const fst_model *model;
    const fst_params *params;
    fst_groups groups;
} laboratory;

/* The field in the laboratory at the time t, by the library; G[i][j] = dB_i/dx_j. */
static void field_in_laboratory(const laboratory *at, double t, const double *x, double b[3], double g[3][3])
{
    const double angle = at->groups.omega * t, c = cos(angle), s = sin(angle);
    const double turn[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
    double there_b[3], there[3][3];
    fst_field(at->model, c * x[0] + s * x[1], c * x[1] - s * x[0], there_b, there);
    for (int i = 0; i < 3; ++i) {
        b[i] = 0;
        for (int j = 0; j < 3; ++j) {
            b[i] += turn[i][j] * there_b[j];
            g[i][j] = 0;
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l)
                    g[i][j] += turn[i][k] * there[k][l] * turn[j][l];
        }
    }
}

/* The accelerations of the centre and of the rotation under the plate's force -f. */
static void accelerate(const laboratory *at, const double *y, const double force[3], const double torque[3],
                       const double f[2], double *dy)
{
    const double beta = at->params->bead_inertia, eps = at->groups.eps, *n = y + FST_NX, *w = y + FST_WX;
    const double arm[3] = {0, 0, -eps}, pushed[3] = {-f[0], -f[1], 0};
    double of_plate[3], lost[3];
    cross(arm, pushed, of_plate);
    cross(w, n, lost);
    for (int i = 0; i < 2; ++i)
        dy[FST_VX + i] = force[i] - f[i];
    for (int i = 0; i < 3; ++i) {
        dy[FST_WX + i] = (torque[i] + of_plate[i]) / (beta * eps * eps);
        if (at->params->model_dynamics == FST_DYNAMICS_FARAGO2020)
            dy[FST_WX + i] += dot(w, n) * lost[i];
    }
}

static void slip_of(double eps, const double *y, double slip[2])
{
    slip[0] = y[FST_VX] - eps * y[FST_WY];
    slip[1] = y[FST_VY] + eps * y[FST_WX];
}

/* f of the laws; that of rolling is sought: the slip's acceleration is linear in f, and shall vanish. */
static void friction_in_laboratory(const laboratory *at, const double *y, const double force[3],
                                   const double torque[3], double f[2])
{
    double slip[2], free[2], pushed[2], dy[FST_STATE_SIZE] = {0};
    slip_of(at->groups.eps, y, slip);
    f[0] = f[1] = 0;
    switch (at->params->friction_law) {
    case FST_FRICTION_VISCOUS:
        f[0] = slip[0];
        f[1] = slip[1];
        return;
    case FST_FRICTION_COULOMB:
        for (int i = 0; i < 2; ++i)
            f[i] =
                at->params->friction_mu * (at->groups.gravity - force[2]) * slip[i] / hypot(slip[0], slip[1]);
        return;
    case FST_FRICTION_ROLLING:
        accelerate(at, y, force, torque, f, dy);
        slip_of(at->groups.eps, dy, free);
        accelerate(at, y, force, torque, (const double[2]){1, 1}, dy);
        slip_of(at->groups.eps, dy, pushed);
        for (int i = 0; i < 2; ++i)
            f[i] = free[i] / (free[i] - pushed[i]);
        return;
    default:
        return;
    }
}

static void rate_in_laboratory(const laboratory *at, double t, const double *y, double *dy)
{
    const double strength = at->groups.kappa * at->groups.eps * at->groups.eps, *n = y + FST_NX;
    double b[3], g[3][3], force[3], torque[3], f[2];
    field_in_laboratory(at, t, y, b, g);
    cross(n, b, torque);
    for (int i = 0; i < 3; ++i) {
        force[i] = strength * dot(g[i], n);
        torque[i] *= strength;
    }
    dy[FST_X] = y[FST_VX];
    dy[FST_Y] = y[FST_VY];
    cross(y + FST_WX, n, dy + FST_NX);
    friction_in_laboratory(at, y, force, torque, f);
    accelerate(at, y, force, torque, f, dy);
}

/* Runge and Kutta's classical method. */
static void integrate(const laboratory *at, const double *start, double t_end, int steps, double *y)
{
    static const double part[4] = {0, 0.5, 0.5, 1}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const double h = t_end / steps;
    memcpy(y, start, FST_STATE_SIZE * sizeof *y);
    for (int step = 0; step < steps; ++step) {
        double slope[FST_STATE_SIZE] = {0}, sum[FST_STATE_SIZE] = {0};
        for (int stage = 0; stage < 4; ++stage) {
            double stage_y[FST_STATE_SIZE];
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                stage_y[i] = y[i] + part[stage] * h * slope[i];
            rate_in_laboratory(at, h * (step + part[stage]), stage_y, slope);
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                sum[i] += weight[stage] * h * slope[i];
        }
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            y[i] += sum[i];
    }
}

/* The same motion by the library, in its turning axes, and by the equations above, in the laboratory. */
static void check_motion(const fst_params *p, double t)
{
    double start[FST_STATE_SIZE] = {0.71, 0.3, 0.1, -0.06, 0.6, 0.0, 0.8, 0.3, -0.4, 0.5};
    double ours[FST_STATE_SIZE], coarse[FST_STATE_SIZE], fine[FST_STATE_SIZE];
    fst_model *model = model_of(p);
    const laboratory at = {model, p, fst_model_groups(model)};
    if (p->friction_law == FST_FRICTION_ROLLING) {
        start[FST_VX] = at.groups.eps * start[FST_WY];
        start[FST_VY] = -at.groups.eps * start[FST_WX];
    }
    state_after(model, 1e-12, start, t, ours);
    turn_state(ours, at.groups.omega * t, ours);
    integrate(&at, start, t, 1000, coarse);
    integrate(&at, start, t, 2000, fine);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        fine[i] += (fine[i] - coarse[i]) / 15;
    CHECK_CLOSE(greatest_difference(ours, fine, FST_STATE_SIZE), 0, 1e-9);
    fst_model_free(model);
}

static void test_another_method(void **unused)
{
    (void)unused;
    for (int i = 0; i < BETA_COUNT; ++i)
        for (int dynamics = 0; dynamics < 2; ++dynamics)
            for (int law = FST_FRICTION_VISCOUS; law <= FST_FRICTION_ROLLING; ++law) {
                fst_params p = bead_of(BETAS[i], (fst_dynamics)dynamics, (fst_friction_law)law);
                p.friction_mu = 0.01; /* it slips all the time */
                check_motion(&p, BETAS[i] < 0.1 ? 0.02 : 2.0);
            }
}

/* ------------------------------------------------------------------ slips without a magnet */

/* beta eps^2 W + eps e x v. */
static void moment_about_contact(double beta, double eps, const double *state, double moment[3])
{
    for (int i = 0; i < 3; ++i)
        moment[i] = beta * eps * eps * state[FST_WX + i];
    moment[0] -= eps * state[FST_VY];
    moment[1] += eps * state[FST_VX];
}

static const double THROWN[FST_STATE_SIZE] = {0.7, -0.3, 0.02, 0.05, 0.6, 0.0, 0.8, 0.9, -0.4, 1.3};

/* After the time t the part `left` of the slip is left. */
static void check_slip(const fst_params *p, double t, double left, double tolerance)
{
    fst_model *model = model_of(p);
    const fst_groups g = fst_model_groups(model);
    const double beta = p->bead_inertia, k = 1 + 1 / beta;
    double lab[FST_STATE_SIZE], slip[2], before[3], after[3];
    slip_of(g.eps, THROWN, slip);
    const double size = hypot(slip[0], slip[1]);
    state_after(model, 1e-13, THROWN, t, lab);
    turn_state(lab, g.omega * t, lab);
    const fst_observation o = fst_observe(model, lab);
    CHECK_CLOSE(o.slip_norm, left * size, tolerance);
    for (int i = 0; i < 2; ++i)
        CHECK_CLOSE(lab[FST_VX + i], THROWN[FST_VX + i] - (1 - left) * slip[i] / k, tolerance);
    CHECK_CLOSE(fst_observe(model, THROWN).energy - o.energy, (1 - left * left) * size * size / (2 * k),
                tolerance);
    moment_about_contact(beta, g.eps, THROWN, before);
    moment_about_contact(beta, g.eps, lab, after);
    CHECK_CLOSE(greatest_difference(before, after, 3), 0, tolerance);
    fst_model_free(model);
}

static void test_slips_end(void **unused)
{
    (void)unused;
    for (int i = 0; i < BETA_COUNT; ++i) {
        const double k = 1 + 1 / BETAS[i];
        fst_params p = bead_without_magnet(BETAS[i], FST_FRICTION_VISCOUS);
        for (double x = 0.2; x < 5; x *= 2)
            check_slip(&p, x / k, exp(-x), 1e-12);
        p = bead_without_magnet(BETAS[i], FST_FRICTION_COULOMB);
        p.friction_mu = 0.13;
        fst_model *model = model_of(&p);
        const fst_groups g = fst_model_groups(model);
        fst_model_free(model);
        double slip[2];
        slip_of(g.eps, THROWN, slip);
        const double end = hypot(slip[0], slip[1]) / (k * p.friction_mu * g.gravity);
        static const double parts[] = {0.3, 0.999, 1.001, 3.0};
        for (int j = 0; j < 4; ++j)
            check_slip(&p, parts[j] * end, fmax(1 - parts[j], 0), 1e-12);
    }
}

/* A bead that does not turn is pushed over the plate: it ends up rolling with 1/(1 + beta) of its speed. */
static void test_pushed_bead(void **unused)
{
    (void)unused;
    for (int i = 0; i < BETA_COUNT; ++i)
        for (int patch = FST_PATCH_POINT; patch <= FST_PATCH_HERTZ; ++patch) {
            const double beta = BETAS[i], v = 0.05;
            fst_params p = bead_without_magnet(beta, FST_FRICTION_COULOMB);
            p.contact_patch = patch;
            if (patch == FST_PATCH_HERTZ)
                p.contact_radius = 0.2e-3;
            fst_model *model = model_of(&p);
            const fst_groups g = fst_model_groups(model);
            const double start[FST_STATE_SIZE] = {0.4, 0.1, v, 0, 0, 0, 1};
            const double end = v / ((1 + 1 / beta) * p.friction_mu * g.gravity);
            double lab[FST_STATE_SIZE];
            state_after(model, 1e-12, start, 0.5 * end, lab);
            CHECK_CLOSE(hypot(lab[FST_VX], lab[FST_VY]), v * (1 - 0.5 * beta / (1 + beta)), 1e-9);
            state_after(model, 1e-12, start, 1.01 * end, lab);
            CHECK_CLOSE(hypot(lab[FST_VX], lab[FST_VY]), v / (1 + beta), 1e-9);
            CHECK_CLOSE(g.eps * hypot(lab[FST_WX], lab[FST_WY]), v / (1 + beta), 1e-9);
            fst_model_free(model);
        }
}

/* A rolling bead of the speed v has (1 + beta) v^2/2; the resistance takes c_rr g for each length. */
static void test_rolling_resistance(void **unused)
{
    (void)unused;
    for (int i = 0; i < BETA_COUNT; ++i) {
        fst_params p = bead_without_magnet(BETAS[i], FST_FRICTION_COULOMB);
        p.friction_rolling_resistance = 0.005;
        fst_model *model = model_of(&p);
        const fst_groups g = fst_model_groups(model);
        const double v = 0.03, brake = p.friction_rolling_resistance * g.gravity / (1 + BETAS[i]);
        const double start[FST_STATE_SIZE] = {0.4, 0.1, v, 0, 0, 0, 1, 0, v / g.eps, 0}, t = 0.7 * v / brake;
        double lab[FST_STATE_SIZE];
        state_after(model, 1e-12, start, t, lab);
        turn_state(lab, g.omega * t, lab);
        CHECK_CLOSE(lab[FST_VX], 0.3 * v, 1e-11);
        CHECK_CLOSE(lab[FST_X], 0.4 + v * t - 0.5 * brake * t * t, 1e-9);
        state_after(model, 1e-12, start, 1.01 * v / brake, lab);
        CHECK_SAME_BITS(hypot(lab[FST_WX], lab[FST_WY]), 0.0);
        fst_model_free(model);
    }
}

/* A bead that pivots on a disc of radius a: W.e falls at the rate (3 pi/16) mu g a/(beta eps^2). */
static void test_pivoting(void **unused)
{
    (void)unused;
    for (int i = 0; i < BETA_COUNT; ++i) {
        fst_params p = bead_without_magnet(BETAS[i], FST_FRICTION_COULOMB);
        p.contact_patch = FST_PATCH_HERTZ;
        p.contact_radius = 0.2e-3;
        fst_model *model = model_of(&p);
        const fst_groups g = fst_model_groups(model);
        const double a = p.contact_radius / g.length_unit, w = 0.2;
        const double brake = 3 * FST_PI / 16 * p.friction_mu * g.gravity * a / (BETAS[i] * g.eps * g.eps);
        const double start[FST_STATE_SIZE] = {[FST_X] = 0.4, [FST_NX] = 1, [FST_WZ] = w};
        double end[FST_STATE_SIZE];
        state_after(model, 1e-12, start, 0.6 * w / brake, end);
        CHECK_CLOSE(end[FST_WZ], 0.4 * w, 1e-10);
        state_after(model, 1e-12, start, 1.01 * w / brake, end);
        CHECK_CLOSE(end[FST_WZ], 0, 1e-7);
        fst_model_free(model);
    }
}

/* ------------------------------------------------------------------ impacts */

/* A bead that does not turn falls on the plate with the speed `falls` while it moves along at the speed v. */
static fst_flow *after_impact(const fst_params *p, double falls, double v)
{
    fst_model *model = model_of(p);
    const double start[FST_STATE_SIZE] = {[FST_X] = 0.2, [FST_NX] = 1, [FST_VX] = v};
    fst_flow *flow = flow_of(model, 1e-11, start);
    flow->step.context.modes.contact = FST_MODE_FLIGHT;
    fst_flight_begin(flow->step.end, falls);
    fst_bead_flow_restart(flow);
    (void)advance_to(flow, 2.001 * falls / fst_model_groups(model).gravity, 0);
    assert_int_equal((int)flow->contact.impacts, 1);
    fst_model_free(model);
    return flow;
}

static void test_impacts(void **unused)
{
    (void)unused;
    for (int i = 0; i < BETA_COUNT; ++i) {
        const double beta = BETAS[i], falls = 0.01, v = 0.05;
        fst_params p = bead_without_magnet(beta, FST_FRICTION_COULOMB);
        p.impact_restitution = 0.6;
        p.friction_mu = 5; /* takes the whole slip: an impulse v/k, which leaves v/(1 + beta) */
        fst_flow *flow = after_impact(&p, falls, v);
        const double eps = fst_flow_world(flow)->eps, *y = flow->step.end;
        const double of_fall = 0.5 * falls * falls * (1 - 0.36);
        CHECK_CLOSE(hypot(y[FST_VX], y[FST_VY]), v / (1 + beta), 1e-12);
        CHECK_CLOSE(eps * hypot(y[FST_WX], y[FST_WY]), v / (1 + beta), 1e-12);
        CHECK_CLOSE(flow->contact.impact_loss, of_fall + 0.5 * v * v * beta / (1 + beta), 1e-12);
        fst_flow_free(flow);
        p.friction_mu = 1e-3; /* takes a part: the impulse J = mu 1.6 z' */
        const double impulse = 1e-3 * 1.6 * falls, slip = v - (1 + 1 / beta) * impulse;
        flow = after_impact(&p, falls, v);
        y = flow->step.end;
        CHECK_CLOSE(hypot(y[FST_VX], y[FST_VY]), v - impulse, 1e-12);
        CHECK_CLOSE(hypot(y[FST_WX], y[FST_WY]), impulse / (beta * eps), 1e-11);
        CHECK_CLOSE(flow->contact.impact_loss, of_fall + 0.5 * impulse * (v + slip), 1e-12);
        fst_flow_free(flow);
    }
}

/* ------------------------------------------------------------------ energy over the magnet */

static double kinetic_and_magnetic(const laboratory *at, const double *y)
{
    const double eps2 = at->groups.eps * at->groups.eps, *v = y + FST_VX, *w = y + FST_WX;
    double b[3], g[3][3];
    fst_field(at->model, y[FST_X], y[FST_Y], b, g);
    return 0.5 * (v[0] * v[0] + v[1] * v[1]) + 0.5 * at->params->bead_inertia * eps2 * dot(w, w) -
           at->groups.kappa * eps2 * dot(y + FST_NX, b);
}

/* The energy is that of the formula, and without friction E - omega L_z is kept, L_z with beta eps^2 W. */
static void test_jacobi_integral(void **unused)
{
    (void)unused;
    for (int i = 0; i < BETA_COUNT; ++i) {
        fst_params p = frictionless_bead(FST_DYNAMICS_RIGID);
        p.bead_inertia = BETAS[i];
        fst_model *model = model_of(&p);
        const laboratory at = {model, &p, fst_model_groups(model)};
        double y[FST_STATE_SIZE], first = NAN;
        start_of(&p, model, y);
        fst_flow *flow = flow_of(model, 1e-12, y);
        for (int t = 0; t <= 40; ++t) {
            (void)advance_to(flow, t, 0);
            memcpy(y, fst_flow_get(flow).state, sizeof y);
            const double energy = kinetic_and_magnetic(&at, y);
            const double turning = y[FST_X] * y[FST_VY] - y[FST_Y] * y[FST_VX] +
                                   BETAS[i] * at.groups.eps * at.groups.eps * y[FST_WZ];
            CHECK_CLOSE(fst_observe(model, y).energy, energy, 1e-14);
            first = t == 0 ? energy - p.drive_omega * turning : first;
            CHECK_CLOSE(energy - p.drive_omega * turning, first, 1e-12);
        }
        fst_flow_free(flow);
        fst_model_free(model);
    }
}

/* A few turns in which nothing repeats: what the drive gives is what all losses take and the bead keeps. */
enum { VARIANTS = 6 };
static fst_params variant(int which, double beta, fst_dynamics dynamics)
{
    static const fst_friction_law laws[VARIANTS] = {FST_FRICTION_VISCOUS, FST_FRICTION_COULOMB,
                                                    FST_FRICTION_COULOMB, FST_FRICTION_COULOMB,
                                                    FST_FRICTION_ROLLING, FST_FRICTION_COULOMB};
    fst_params p = bead_of(beta, dynamics, laws[which]);
    p.run_periods = 7.3;
    p.run_discard = 1;
    p.start_phi = 0.4;
    if (which == 2) {
        p.contact_patch = FST_PATCH_HERTZ;
        p.contact_radius = 0.2e-3;
    }
    if (which == 3 || which == 4)
        p.friction_rolling_resistance = 0.02;
    if (which == 5) { /* it is lifted again and again */
        p.friction_mu = 0.05;
        p.impact_restitution = 0.5;
        p.drive_omega = 1.8;
        p.run_periods = 25.3;
    }
    return p;
}

static void test_energy_balance(void **unused)
{
    (void)unused;
    double flying = 0, sticking = 0;
    static const double betas[] = {0.05, 0.25, 2.0 / 3.0};
    for (int i = 0; i < 3; ++i)
        for (int dynamics = 0; dynamics < 2; ++dynamics)
            for (int which = 0; which < VARIANTS; ++which) {
                const fst_params p = variant(which, betas[i], (fst_dynamics)dynamics);
                const fst_run_result run = run_of(&p);
                CHECK_WITHIN(run.energy_residual, 0, 1e-7);
                assert_true(fabs(run.mean_drive_power) > 1e-7);
                flying += which == 5 ? run.flying : 0;
                sticking += which == 1 && run.sticking > 0.01 && run.sticking < 0.99;
            }
    assert_true(flying > 0.3);
    assert_true(sticking > 3);
}

/* ------------------------------------------------------------------ the key */

static void test_the_solid_sphere_is_the_default(void **unused)
{
    (void)unused;
    for (int which = 0; which < VARIANTS; ++which) {
        fst_params given = variant(which, NAN, FST_DYNAMICS_RIGID), not_given = given;
        not_given.bead_inertia = fst_default_params().bead_inertia;
        assert_int_equal(fst_params_set(&given, "bead.inertia", "0.4", NULL), FST_OK);
        const fst_run_result a = run_of(&given), b = run_of(&not_given);
        check_same_result(which, &a, &b);
    }
}

static void test_out_of_range(void **unused)
{
    (void)unused;
    static const char *const wrong[] = {"0.0005", "0.7", "0", "-0.4", "nan"};
    fst_params p = fst_default_params();
    for (int i = 0; i < 5; ++i) {
        fst_error error = {FST_OK, "", ""};
        assert_int_equal(fst_params_set(&p, "bead.inertia", wrong[i], &error), FST_BAD_INPUT);
        CHECK_CONTAINS(error.where, "bead.inertia");
        assert_true(strlen(error.sentence) > 10);
        CHECK_SAME_BITS(p.bead_inertia, 0.4);
    }
    p.bead_inertia = 0.7; /* by the other door */
    fst_model *model = NULL;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_model_new(&p, &model, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "out of range");
    assert_int_equal(fst_params_set(&p, "bead.inertia", "0.001", NULL), FST_OK);
    assert_int_equal(fst_params_set(&p, "bead.inertia", "0.6666666666666667", NULL), FST_OK);
}

/* ------------------------------------------------------------------ lanes */

enum { JOBS = 9 };
static void fill(const void *law, int row, fst_row_job *job)
{
    static const double beta[3] = {0.25, 0.4, 2.0 / 3.0};
    job->params = bead_of(beta[row % 3], row & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID,
                          *(const fst_friction_law *)law);
    job->params.drive_omega = 0.2 + 0.02 * row;
    job->params.run_periods = 5;
    job->params.run_discard = 1;
}

/* Beads of different inertia beside each other have the bits that each has alone. */
static void test_lanes(void **unused)
{
    (void)unused;
    static const fst_friction_law laws[] = {FST_FRICTION_VISCOUS, FST_FRICTION_COULOMB, FST_FRICTION_ROLLING};
    for (int i = 0; i < 3; ++i)
        for (int lanes = 4; lanes <= 8; lanes += 4) {
            static few_rows beside;
            beside = (few_rows){.count = JOBS, .fill = fill, .with = &laws[i]};
            if (!fst_lane_engine_of(FST_ARITHMETIC_PORTABLE, lanes))
                continue;
            do_few_rows(&beside, FST_ARITHMETIC_PORTABLE, lanes);
            for (int row = 0; row < JOBS; ++row) {
                fst_row_job job;
                fill(&laws[i], row, &job);
                const fst_run_result alone = run_of(&job.params);
                assert_memory_equal(beside.results[row].final_state, alone.final_state,
                                    sizeof alone.final_state);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_another_method),
        cmocka_unit_test(test_slips_end),
        cmocka_unit_test(test_pushed_bead),
        cmocka_unit_test(test_rolling_resistance),
        cmocka_unit_test(test_pivoting),
        cmocka_unit_test(test_impacts),
        cmocka_unit_test(test_jacobi_integral),
        cmocka_unit_test(test_energy_balance),
        cmocka_unit_test(test_the_solid_sphere_is_the_default),
        cmocka_unit_test(test_out_of_range),
        cmocka_unit_test(test_lanes),
    };
    return cmocka_run_group_tests_name("inertia", tests, NULL, NULL);
}
