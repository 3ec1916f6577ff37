/* Integrals over steps in which the bead passes the axis closely, or its moment the radial direction
 * (observe/passages.h): of a free bead, whose motion is known, against sums over points that crowd where the
 * direction turns; of runs, against runs with shorter steps; and in lanes.
 * tests: observe/passages.c observe/quadrature.c observe/integrals.inl */
#include "few_rows.h"
#include "physics.h"
#include "same_results.h"

#include "observe/quadrature.h"

enum { POINTS = 4000 };

/* A bead that nothing moves: in the laboratory it goes straight on, and n turns about W. */
typedef struct free_bead {
    double start[FST_STATE_SIZE]; /* in the laboratory, at t = 0 */
    double meets, within;         /* the time of the passage, and how long it takes */
} free_bead;

static fst_params free_params(void)
{
    fst_params p = fst_default_params();
    p.model_kappa = 1e-12;
    p.drive_omega = 0.3;
    p.friction_law = FST_FRICTION_NONE;
    return p;
}

/* The state after the time t, in the magnet's frame. */
static void state_at(const free_bead *bead, double t, double omega, double *state)
{
    double lab[FST_STATE_SIZE];
    memcpy(lab, bead->start, sizeof lab);
    const double *w = bead->start + FST_WX, turn = sqrt(dot(w, w));
    for (int i = 0; i < 2; ++i)
        lab[FST_X + i] += t * lab[FST_VX + i];
    if (turn > 0) {
        const double axis[3] = {w[0] / turn, w[1] / turn, w[2] / turn};
        turn_about(axis, turn * t, bead->start + FST_NX, lab + FST_NX);
    }
    turn_state(lab, -omega * t, state);
}

/* The integrands after the time t times `weight`, added. */
static void add_at(const free_bead *bead, const fst_flow *flow, double t, double weight, double *sums)
{
    const fst_world_double *c = fst_flow_world(flow);
    double state[FST_NUMBERS] = {0}, integrands[FST_Q_COUNT];
    fst_pull_double pull;
    fst_seen_double seen;
    state_at(bead, t, flow->step.omega, state);
    fst_pull_at_double(c, state, c->height, &pull);
    fst_see_double(c, fst_flow_modes(flow), flow->step.omega, state, &pull, &seen);
    fst_integrands_double(c, fst_flow_modes(flow), state, &pull, &seen, 0.0, 0.0, integrands);
    for (int i = 0; i < FST_Q_COUNT; ++i)
        sums[i] += weight * integrands[i];
}

/* The integrals from 0 to t1, by t = meets + within sinh(u): Simpson's rule in u on both sides of the
 * passage. */
static void expected_integrals(const free_bead *bead, const fst_flow *flow, double t1, double *sums)
{
    const double u[3] = {asinh(-bead->meets / bead->within), 0.0, asinh((t1 - bead->meets) / bead->within)};
    for (int i = 0; i < FST_Q_COUNT; ++i)
        sums[i] = 0.0;
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i <= POINTS; ++i) {
            const double step = (u[side + 1] - u[side]) / POINTS, at = u[side] + i * step;
            const double share = i == 0 || i == POINTS ? 1.0 : i % 2 ? 4.0 : 2.0;
            add_at(bead, flow, bead->meets + bead->within * sinh(at),
                   share / 3.0 * step * bead->within * cosh(at), sums);
        }
    /* Of r alpha'^2, whose peak hangs on the last digits of t: the turn of e_r along v. */
    const double *v = bead->start + FST_VX, before = bead->meets / bead->within,
                 after = (t1 - bead->meets) / bead->within;
    sums[FST_Q_CENTRIFUGAL] = hypot(v[0], v[1]) * (after / hypot(after, 1.0) + before / hypot(before, 1.0));
}

/* Integrals whose integrands depend on a direction. */
static const int TURNING[] = {
    FST_Q_R,       FST_Q_SLIP_R,          FST_Q_SLIP_ALPHA, FST_Q_SPIN_TERM,    FST_Q_CENTRIFUGAL,
    FST_Q_FORCE_R, FST_Q_FORCE_R_PRINTED, FST_Q_EQ23,       FST_Q_N_R,          FST_Q_N_ALPHA,
    FST_Q_N_RR,    FST_Q_N_RALPHA,        FST_Q_N_RZ,       FST_Q_N_ALPHAALPHA, FST_Q_N_ALPHAZ};

/* Fails unless integrals are the expected ones; `scale` of each is of the size of its integrand. */
static void check_integrals(const free_bead *bead, const fst_flow *flow, const double *got, double t)
{
    const fst_world_double *c = fst_flow_world(flow);
    double expected[FST_Q_COUNT];
    expected_integrals(bead, flow, t, expected);
    for (size_t k = 0; k < sizeof TURNING / sizeof *TURNING; ++k) {
        const int i = TURNING[k];
        const double scale = i == FST_Q_FORCE_R || i == FST_Q_FORCE_R_PRINTED ? 10.0 * c->hard
                             : i == FST_Q_EQ23                                ? 4.0 * c->hard_over_eps
                                                                              : 1.0;
        if (!(fabs(got[i] - expected[i]) <= 2e-10 * scale * t))
            fail_msg("within %g: integral %d is %.15g, expected %.15g", bead->within, i, got[i], expected[i]);
    }
}

/* Follow the bead to the time t, and compare at the end and within the step that holds the passage. */
static void check_passage(const free_bead *bead, double t)
{
    const fst_params p = free_params();
    fst_model *model = model_of(&p);
    fst_flow *flow = flow_of(model, 1e-13, bead->start);
    fst_quadrature q;
    double got[FST_Q_COUNT], angle;
    int passages = 0;
    fst_quadrature_begin(&q, flow);
    while (flow->t.high < t) {
        assert_int_equal(fst_flow_step(flow, t, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
        if (!(flow->t_start.high <= bead->meets && bead->meets < flow->t.high))
            continue;
        passages = q.passages;
        const double places[] = {0.2, 0.5 * (1.0 + (bead->meets - flow->t_start.high) / flow->step.h)};
        for (int i = 0; i < 2; ++i) {
            fst_quadrature_at(&q, flow, places[i], got, &angle);
            check_integrals(bead, flow, got, fst_flow_time(flow, places[i]).high);
        }
    }
    assert_true(passages);
    fst_quadrature_at(&q, flow, 1.0, got, &angle);
    check_integrals(bead, flow, got, t);
    fst_flow_free(flow);
    fst_model_free(model);
}

static const double TIMES[] = {1.0, 1e-2, 1e-5, 1e-9};

static void test_axis(void **unused)
{
    (void)unused;
    const double v = 0.05, meets = 2.3;
    for (size_t i = 0; i < sizeof TIMES / sizeof *TIMES; ++i)
        for (int turns = 0; turns < 2; ++turns) {
            const free_bead bead = {
                {-v * meets, v * TIMES[i], v, 0, 0.48, 0.64, 0.6, 0.2 * turns, -0.1 * turns, 0.3 * turns},
                meets,
                TIMES[i]};
            check_passage(&bead, 5.0);
        }
}

static void test_pole(void **unused)
{
    (void)unused;
    const double w = 0.4, meets = 2.3;
    for (size_t i = 0; i < sizeof TIMES / sizeof *TIMES; ++i) {
        const double beside = w * TIMES[i], there = w * meets;
        const free_bead bead = {
            {0.8, 0, 0, 0, cos(beside) * cos(there), sin(beside), cos(beside) * sin(there), 0, w, 0},
            meets,
            TIMES[i]};
        check_passage(&bead, 5.0);
    }
}

/* Straight over the axis e_r jumps to its opposite, and r alpha'^2 has the area 2 v; n straight through e_r. */
static void test_straight_through(void **unused)
{
    (void)unused;
    const double v = 0.05, meets = 2.3, t = 5.0;
    const double start[FST_STATE_SIZE] = {-v * meets, 0, v, 0, 0.6, 0, 0.8, 0, 0, 0};
    const fst_params p = free_params();
    fst_model *model = model_of(&p);
    fst_flow *flow = flow_of(model, 1e-13, start);
    fst_quadrature q;
    double got[FST_Q_COUNT], angle;
    fst_quadrature_begin(&q, flow);
    while (flow->t.high < t) {
        assert_int_equal(fst_flow_step(flow, t, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
    }
    fst_quadrature_at(&q, flow, 1.0, got, &angle);
    CHECK_CLOSE(got[FST_Q_CENTRIFUGAL], 2 * v, 1e-9);
    CHECK_CLOSE(got[FST_Q_R], 0.5 * v * (meets * meets + (t - meets) * (t - meets)), 1e-9);
    CHECK_CLOSE(got[FST_Q_SLIP_R], v * (t - 2 * meets), 1e-9);
    CHECK_CLOSE(got[FST_Q_N_R], 0.6 * (t - 2 * meets), 1e-9);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* Under dry friction, where steps are in a time of their own: the squares of n's components add up to 1, so
 * their integrals to the time, of which those of n_r^2 and n_alpha^2 are resolved on the axis and that of n_z^2
 * is not. */
static void test_dry(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = 0.3;
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    const double shift[2] = {start[FST_X] + 0.2, start[FST_Y] - 1e-4};
    for (int i = 0; i < 2; ++i)
        start[FST_X + i] -= shift[i];
    start[FST_VX] = 0.3;
    start[FST_VY] = 0.0;
    fst_flow *flow = flow_of(model, 1e-11, start);
    fst_quadrature q;
    double got[FST_Q_COUNT], angle;
    int passages = 0;
    fst_quadrature_begin(&q, flow);
    while (flow->t.high < 2.0) {
        assert_int_equal(fst_flow_step(flow, 2.0, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
        passages += q.passages != 0;
    }
    fst_quadrature_at(&q, flow, 1.0, got, &angle);
    assert_true(passages > 0);
    CHECK_CLOSE(got[FST_Q_N_RR] + got[FST_Q_N_ALPHAALPHA] + got[FST_Q_N_ZZ], 2.0, 1e-10);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* ------------------------------------------------------------------ runs */

/* Orbits that pass the axis and e_r closely at every return, and at some. */
static const struct {
    double omega, kappa;
    fst_dynamics dynamics;
    fst_friction_law law;
} ORBITS[] = {{0.22, 2.2, FST_DYNAMICS_RIGID, FST_FRICTION_VISCOUS},
              {0.18, 1.5, FST_DYNAMICS_RIGID, FST_FRICTION_VISCOUS},
              {0.235, 2.5, FST_DYNAMICS_RIGID, FST_FRICTION_VISCOUS},
              {0.27377, 3.4005, FST_DYNAMICS_FARAGO2020, FST_FRICTION_VISCOUS}};
enum { ORBIT_COUNT = sizeof ORBITS / sizeof *ORBITS };

static fst_params orbit_params(int i)
{
    fst_params p = bead_at(ORBITS[i].omega, ORBITS[i].dynamics);
    p.model_kappa = ORBITS[i].kappa;
    p.friction_law = (int)ORBITS[i].law;
    p.run_periods = 60;
    p.run_discard = 40;
    return p;
}

static double result_of(const fst_run_result *result, const char *name)
{
    double value = NAN;
    for (int k = 0; k < fst_result_count(); ++k)
        if (strcmp(fst_result_at(k)->name, name) == 0)
            memcpy(&value, (const char *)result + fst_result_at(k)->offset, sizeof value);
    return value;
}

static void check_turning_means(int i, const fst_run_result *a, const fst_run_result *b)
{
    static const char *const names[] = {"mean_r",        "std_r",         "eq21_centrifugal",
                                        "eq21_magnetic", "eq21_friction", "eq21_magnetic_printed",
                                        "eq21_spin",     "eq23_magnetic", "mean_v_alpha",
                                        "tilt_deg"};
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        const double x = result_of(a, names[k]), y = result_of(b, names[k]);
        const double scale = fmax(fabs(y), 0.01); /* of the forces, of which the mean may be the small rest */
        if (!(fabs(x - y) <= 2e-10 * scale))
            fail_msg("orbit %d: %s is %.15g, expected %.15g", i, names[k], x, y);
    }
}

static void test_runs(void **unused)
{
    (void)unused;
    for (int i = 0; i < ORBIT_COUNT; ++i) {
        fst_params p = orbit_params(i);
        const fst_run_result usual = run_of(&p);
        p.run_rtol = 1e-13;
        const fst_run_result tight = run_of(&p);
        check_turning_means(i, &usual, &tight);
    }
}

static void fill_row(const void *with, int row, fst_row_job *job)
{
    (void)with;
    job->params = orbit_params(row % ORBIT_COUNT);
    job->params.run_periods -= row;
}

static void test_lanes(void **unused)
{
    (void)unused;
    few_rows rows = {.count = 9, .fill = fill_row};
    const fst_arithmetic best = fst_best_arithmetic();
    for (int form = 0; form < (best == FST_ARITHMETIC_PORTABLE ? 1 : 2); ++form) {
        do_few_rows(&rows, form ? best : FST_ARITHMETIC_PORTABLE, form ? 0 : 4);
        for (int i = 0; i < rows.count; ++i) {
            fst_row_job job;
            fill_row(NULL, i, &job);
            const fst_run_result alone = run_of(&job.params);
            if (form)
                check_turning_means(i, &rows.results[i], &alone);
            else
                check_same_result(i, &rows.results[i], &alone);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_axis), cmocka_unit_test(test_pole), cmocka_unit_test(test_straight_through),
        cmocka_unit_test(test_dry),  cmocka_unit_test(test_runs), cmocka_unit_test(test_lanes),
    };
    return cmocka_run_group_tests_name("passages", tests, NULL, NULL);
}
