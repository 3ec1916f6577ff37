/* A source and a contact law from examples/c/own through the public functions: chosen by name, run, computed in
 * lanes with the bits of the scalar form, and on orbits whose derivatives are those of the motion. No file of
 * src/ knows of them.
 * tests: model/source/sources.inl model/contact/contacts.inl model/param_table.c
 * labels: own */
#include "few_rows.h"
#include "physics.h"

#include "lanes/lanes.h"
#include "orbit/newton.h"
#include "study/lane_rows.h"

/* The paper's bead over a magnet of two charges, on a plate with quadratic friction. */
static fst_params own_bead(double omega)
{
    fst_params p = bead_at(omega, FST_DYNAMICS_RIGID);
    fst_error error;
    if (fst_params_set(&p, "magnet.shape", "charges", &error) != FST_OK ||
        fst_params_set(&p, "friction.law", "quadratic", &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return p;
}

/* ------------------------------------------------------------------ names */

static void test_names(void **unused)
{
    (void)unused;
    fst_params p = own_bead(0.4);
    fst_error error;
    assert_int_equal(p.magnet_shape, FST_MAGNET_CHARGES);
    assert_int_equal(p.friction_law, FST_FRICTION_QUADRATIC);
    assert_int_equal(fst_params_set(&p, "own.grip", "12", &error), FST_OK);
    assert_true(p.own_grip == 12.0);
    assert_int_equal(fst_params_set(&p, "own.grip", "-1", &error), FST_BAD_INPUT);
    assert_int_equal(fst_params_set(&p, "friction.law", "quadratik", &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "the nearest is quadratic");
    CHECK_CONTAINS(error.sentence, "viscous, none, ");
    const fst_param_info *law = fst_param_at(fst_param_find("friction.law"));
    CHECK_CONTAINS(law->names, "viscous|none|");
    CHECK_CONTAINS(law->names, "|quadratic"); /* after festoon's own laws, whatever their number */
    CHECK_CONTAINS(law->doc, "viscous: friction force -m gamma V");
    CHECK_CONTAINS(law->doc, "; quadratic: friction force own.grip N |V| V, with the normal load N.");
    CHECK_CONTAINS(fst_param_at(fst_param_find("magnet.shape"))->names, "lines|");
    CHECK_CONTAINS(fst_param_at(fst_param_find("magnet.shape"))->names, "|charges");
}

/* ------------------------------------------------------------------ a run */

/* Two charges of strength 5 at X = 1 and -1 make a single line of festoon's: the same motion from another
 * source. */
static void test_same_magnet_same_motion(void **unused)
{
    (void)unused;
    fst_params charges = bead_at(0.5, FST_DYNAMICS_RIGID), line = charges;
    charges.magnet_shape = FST_MAGNET_CHARGES;
    line.magnet_lines = 1;
    charges.run_periods = line.run_periods = 60;
    const fst_run_result a = run_of(&charges), b = run_of(&line);
    assert_int_equal(a.regime, FST_REGIME_COUNTER_ROTATING);
    assert_int_equal(a.regime, b.regime);
    CHECK_CLOSE(a.mean_r, b.mean_r, 1e-8);
    CHECK_CLOSE(a.mean_alpha_dot, b.mean_alpha_dot, 1e-8);
    CHECK_CLOSE(a.max_load_weights, b.max_load_weights, 1e-5);
    CHECK_CLOSE(greatest_difference(a.final_state, b.final_state, FST_STATE_SIZE), 0.0, 1e-6);
}

/* The law takes out what the drive puts in, and the result does not depend on the tolerance. */
static void test_run(void **unused)
{
    (void)unused;
    fst_params p = own_bead(0.5);
    p.run_periods = 120;
    p.run_discard = 60;
    const fst_run_result r = run_of(&p);
    assert_int_equal(r.regime, FST_REGIME_COUNTER_ROTATING);
    assert_true(r.mean_friction_power > 1e-6);
    CHECK_CLOSE(r.mean_drive_power / r.mean_friction_power, 1.0, 1e-6);
    p.run_rtol = 1e-12;
    const fst_run_result tight = run_of(&p);
    CHECK_CLOSE(r.mean_r, tight.mean_r, 1e-8);
    CHECK_CLOSE(r.mean_friction_power / tight.mean_friction_power, 1.0, 1e-7);
}

/* ------------------------------------------------------------------ lanes */

enum { JOBS = 12 };
/* Festoon's own sources and laws mixed with these, including runs whose regime needs an exponent. */
static fst_params job_params(int i)
{
    fst_params p = own_bead(0.44 + 0.02 * i);
    p.own_reach = 1.0 + 0.01 * i;
    p.own_grip = 250.0 + 10.0 * i;
    p.run_periods = 16;
    p.run_discard = 4;
    if (i % 4 == 1)
        p.friction_law = FST_FRICTION_VISCOUS;
    if (i % 4 == 2)
        p.magnet_shape = FST_MAGNET_LINES;
    if (i % 3 == 0) {
        p.drive_omega = 0.13 + 0.001 * i;
        p.model_kappa = 0.93;
    }
    return p;
}

static void fill(const void *unused, int row, fst_row_job *job)
{
    (void)unused;
    job->params = job_params(row);
}

static void test_lanes(void **unused)
{
    (void)unused;
    static few_rows alone = {.count = JOBS, .fill = fill}, beside = {.count = JOBS, .fill = fill};
    int exponents = 0;
    do_few_rows(&alone, FST_ARITHMETIC_PORTABLE, 1);
    for (int i = 0; i < JOBS; ++i) {
        const fst_params p = job_params(i);
        const fst_run_result run = run_of(&p);
        assert_memory_equal(run.final_state, alone.results[i].final_state, sizeof run.final_state);
        exponents += isfinite(run.largest_exponent);
    }
    assert_true(exponents > 0);
    for (int lanes = 4; lanes <= 8; lanes += 4) {
        if (!fst_lane_engine_of(FST_ARITHMETIC_PORTABLE, lanes))
            continue;
        do_few_rows(&beside, FST_ARITHMETIC_PORTABLE, lanes);
        for (int i = 0; i < JOBS; ++i)
            for (int k = 0; k < fst_result_count(); ++k) {
                const size_t at = fst_result_at(k)->offset;
                if (memcmp((const char *)&alone.results[i] + at, (const char *)&beside.results[i] + at,
                           sizeof(double)) != 0)
                    fail_msg("job %d in %d lanes: %s differs", i, lanes, fst_result_at(k)->name);
            }
    }
    for (int form = FST_ARITHMETIC_AVX2; form <= FST_ARITHMETIC_AVX512; ++form) {
        if (!fst_lane_engine_of((fst_arithmetic)form, 0))
            continue;
        do_few_rows(&beside, (fst_arithmetic)form, 0);
        for (int i = 0; i < JOBS; ++i) {
            const fst_run_result *a = &alone.results[i], *b = &beside.results[i];
            assert_int_equal(a->regime, b->regime);
            CHECK_CLOSE(greatest_difference(a->final_state, b->final_state, FST_STATE_SIZE), 0.0, 1e-6);
            CHECK_CLOSE(a->mean_friction_power, b->mean_friction_power, 1e-8);
        }
    }
}

/* ------------------------------------------------------------------ orbits */

static fst_orbit orbit_of(const fst_params *p)
{
    fst_orbit orbit;
    fst_error error = {FST_OK, "", ""};
    if (fst_orbit_find(p, NULL, &orbit, &error) != FST_OK)
        fail_msg("fst_orbit_find: %s", error.sentence);
    return orbit;
}

/* The map whose multipliers the library reports: over half a turn and S2, or over a whole turn. */
static void return_map(const fst_model *model, const fst_orbit *orbit, const double *start, double *end)
{
    const int half = orbit->symmetry == FST_SYMMETRY_S2;
    state_after(model, 1e-14, start, half ? 0.5 * orbit->means.period : orbit->means.period, end);
    if (half)
        fst_apply_s2(end, end);
}

/* The map's derivative in the tangent space at the orbit's state, by differences. */
static void differences_of_map(const fst_model *model, const fst_orbit *orbit,
                               double m[FST_TANGENT_SIZE][FST_TANGENT_SIZE])
{
    const double d = 1e-4;
    double basis[FST_STATE_SIZE][FST_TANGENT_SIZE];
    fst_tangent_basis(orbit->state, basis);
    memset(m, 0, sizeof(double[FST_TANGENT_SIZE][FST_TANGENT_SIZE]));
    for (int j = 0; j < FST_TANGENT_SIZE; ++j)
        for (int k = -2; k <= 2; ++k) {
            static const double weight[] = {1.0 / 12, -2.0 / 3, 0, 2.0 / 3, -1.0 / 12};
            double moved[FST_STATE_SIZE], end[FST_STATE_SIZE];
            if (k == 0)
                continue;
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                moved[i] = orbit->state[i] + k * d * basis[i][j];
            return_map(model, orbit, moved, end);
            for (int row = 0; row < FST_TANGENT_SIZE; ++row)
                for (int i = 0; i < FST_STATE_SIZE; ++i)
                    m[row][j] += weight[k + 2] * basis[i][row] * end[i] / d;
        }
}

/* The eight multipliers and the 1 of the flow's own direction are the eigenvalues of the map's derivative: the
 * traces of its powers are the sums of their powers. */
static void check_multipliers(const fst_model *model, const fst_orbit *orbit)
{
    double m[FST_TANGENT_SIZE][FST_TANGENT_SIZE], power[FST_TANGENT_SIZE][FST_TANGENT_SIZE];
    double re[FST_MULTIPLIER_COUNT], im[FST_MULTIPLIER_COUNT];
    differences_of_map(model, orbit, m);
    memcpy(power, m, sizeof power);
    memcpy(re, orbit->multiplier_re, sizeof re);
    memcpy(im, orbit->multiplier_im, sizeof im);
    for (int exponent = 1; exponent <= FST_TANGENT_SIZE; ++exponent) {
        double trace = 0.0, sum = 1.0, next[FST_TANGENT_SIZE][FST_TANGENT_SIZE];
        for (int i = 0; i < FST_TANGENT_SIZE; ++i)
            trace += power[i][i];
        for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i) {
            sum += re[i];
            const double real = re[i] * orbit->multiplier_re[i] - im[i] * orbit->multiplier_im[i];
            im[i] = re[i] * orbit->multiplier_im[i] + im[i] * orbit->multiplier_re[i];
            re[i] = real;
        }
        CHECK_CLOSE(trace, sum, 1e-6);
        for (int i = 0; i < FST_TANGENT_SIZE; ++i)
            for (int j = 0; j < FST_TANGENT_SIZE; ++j) {
                next[i][j] = 0.0;
                for (int k = 0; k < FST_TANGENT_SIZE; ++k)
                    next[i][j] += power[i][k] * m[k][j];
            }
        memcpy(power, next, sizeof power);
    }
}

/* The residual after one of Newton's iterations from a guess at the distance `off`. */
static double left_by_newton(const fst_params *p, const fst_orbit *orbit, double off)
{
    static fst_newton_system system;
    fst_family family;
    fst_solution s;
    fst_error error = {FST_OK, "", ""};
    memset(&s, 0, sizeof s);
    s.symmetric = orbit->symmetry == FST_SYMMETRY_S2;
    s.period = s.symmetric ? 0.5 * orbit->means.period : orbit->means.period;
    memcpy(s.y[0], orbit->state, sizeof s.y[0]);
    s.on_section = 1;
    if (fst_family_begin(&family, p, NULL, &error) != FST_OK ||
        fst_solution_chain(&family, &s, s.symmetric ? 1 : 2, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    s.y[0][FST_Y] += off;
    s.y[0][FST_VX] -= 0.3 * off;
    s.y[0][FST_WY] += off;
    if (fst_solution_approach(&family, &s, NULL, &error) != FST_OK ||
        fst_newton_equations(&family, &s, &system, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return s.residual;
}

/* Newton's method refuses half turns of a magnet that is not its own image under them. */
static void check_half_turns(const fst_params *p, const fst_orbit *orbit, int own_image)
{
    static fst_newton_system system;
    fst_family family;
    fst_solution s;
    fst_error error = {FST_OK, "", ""};
    memset(&s, 0, sizeof s);
    s.symmetric = s.segments = s.on_section = 1;
    s.period = 0.5 * orbit->means.period;
    memcpy(s.y[0], orbit->state, sizeof s.y[0]);
    if (fst_family_begin(&family, p, NULL, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    assert_int_equal(fst_newton_equations(&family, &s, &system, &error),
                     own_image ? FST_OK : FST_NO_CONVERGENCE);
}

/* One magnet is its own image under half a turn, the other lies off the middle: over that one no orbit is
 * sought or found by half turns. */
static void check_orbit(double shift)
{
    fst_params p = own_bead(0.5);
    p.own_shift = shift;
    const fst_orbit orbit = orbit_of(&p);
    assert_int_equal(orbit.turns, -1);
    assert_true(orbit.stable);
    assert_int_equal(orbit.symmetry, shift == 0.0 ? FST_SYMMETRY_S2 : FST_SYMMETRY_S1);
    CHECK_CLOSE(orbit.means.mean_drive_power / orbit.means.mean_friction_power, 1.0, 1e-9);
    check_half_turns(&p, &orbit, shift == 0.0);
    fst_model *model = model_of(&p);
    double end[FST_STATE_SIZE];
    return_map(model, &orbit, orbit.state, end);
    CHECK_CLOSE(greatest_difference(end, orbit.state, FST_STATE_SIZE), 0.0, 1e-11);
    check_multipliers(model, &orbit);
    fst_model_free(model);
    /* Quadratic convergence: a guess ten times closer leaves a residual a hundred times smaller. */
    const double far = left_by_newton(&p, &orbit, 1e-2), near = left_by_newton(&p, &orbit, 1e-3);
    assert_true(far < 1e-2 && near > 1e-8);
    CHECK_WITHIN(far / near, 50.0, 200.0);
}

static void test_orbit(void **unused)
{
    (void)unused;
    check_orbit(0.0);
    check_orbit(0.02);
}

/* Locked states are found as well, and their residuals vanish. */
static void test_locked(void **unused)
{
    (void)unused;
    const fst_params p = own_bead(0.1);
    fst_locked_list list;
    fst_error error = {FST_OK, "", ""};
    if (fst_locked_find(&p, NULL, &list, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    assert_true(list.count > 0);
    fst_model *model = model_of(&p);
    for (size_t i = 0; i < list.count; ++i) {
        double rate[FST_STATE_SIZE];
        const double zero[FST_STATE_SIZE] = {0.0};
        fst_rhs(model, list.states[i].state, rate);
        CHECK_CLOSE(greatest_difference(rate, zero, FST_STATE_SIZE), 0.0, 1e-11);
    }
    fst_model_free(model);
    fst_locked_free(&list);
}

/* A branch over the weight: friction that asks for the load moves the locked states with it; that of a viscous
 * plate does not, and such a branch is refused. */
static void test_weight(void **unused)
{
    (void)unused;
    fst_params p = own_bead(0.1);
    fst_branch_options options = fst_default_branch_options();
    fst_branch branch;
    fst_error error = {FST_OK, "", ""};
    options.kind = FST_BRANCH_LOCKED;
    options.key = "plate.gravity";
    options.from = 9.0;
    options.to = 10.0;
    if (fst_branch_follow(&p, &options, &branch, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    double least = INFINITY, greatest = 0.0;
    for (size_t i = 0; i < branch.point_count; ++i)
        if (branch.points[i].branch == 0) {
            least = fmin(least, branch.points[i].bead_angle_deg);
            greatest = fmax(greatest, branch.points[i].bead_angle_deg);
        }
    assert_true(branch.complete && greatest > least + 1e-6);
    fst_branch_free(&branch);
    p.friction_law = FST_FRICTION_VISCOUS;
    assert_int_equal(fst_branch_follow(&p, &options, &branch, &error), FST_BAD_INPUT);
    assert_string_equal(error.where, "fst_branch_options.key");
    CHECK_CONTAINS(error.sentence, "with friction.law = viscous");
    p.friction_law = FST_FRICTION_QUADRATIC;
    options.key = "plate.radius";
    assert_int_equal(fst_branch_follow(&p, &options, &branch, &error), FST_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),  cmocka_unit_test(test_same_magnet_same_motion),
        cmocka_unit_test(test_run),    cmocka_unit_test(test_lanes),
        cmocka_unit_test(test_orbit),  cmocka_unit_test(test_locked),
        cmocka_unit_test(test_weight),
    };
    return cmocka_run_group_tests_name("own_physics", tests, NULL, NULL);
}
