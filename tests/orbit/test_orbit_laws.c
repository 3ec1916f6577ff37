/* Laws that hold for orbits and branches however they were found: derivatives by parameters, the ends of a
 * range, the shape of an orbit against a trajectory along it, and the passage of the axis.
 * tests: orbit/family.c orbit/describe.c orbit/special_test.c
 * labels: numbers slow */
#include "branches.h"

#include <stdlib.h>

#include "orbit/family.h"

/* ------------------------------------------------------------------ derivatives by a parameter */

static void rhs_at(const fst_params *base, const char *key, double value, const double *state, double *rate)
{
    fst_params params = *base;
    fst_model *model;
    fst_error error = {FST_OK, "", ""};
    char text[32];
    (void)snprintf(text, sizeof text, "%.17g", value);
    assert_int_equal(fst_params_set(&params, key, text, &error), FST_OK);
    if (fst_model_new(&params, &model, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    fst_rhs(model, state, rate);
    fst_model_free(model);
}

/* d(rhs)/d(parameter) for every scaled group, against differences of whole models. */
static void derivatives_by_parameters(void **unused)
{
    (void)unused;
    static const struct {
        const char *key;
        double value;
    } cases[] = {{"drive.omega", 0.31}, {"model.kappa", 1.5},  {"model.eps", 0.11},
                 {"model.h", 0.8},      {"model.lambda", 0.4}, {"bead.a", 1e-3}};
    const double state[FST_STATE_SIZE] = {0.7, -0.3, 0.1, 0.2, 0.48, 0.6, 0.64, 0.5, -0.7, 0.2};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const char *key = cases[i].key;
        const double value = cases[i].value, step = 1e-4 * value;
        double by[FST_STATE_SIZE], below[FST_STATE_SIZE], above[FST_STATE_SIZE], largest = 0.0;
        fst_params params = scene_of(0.31, "rigid");
        fst_family family;
        fst_setup setup;
        fst_error error = {FST_OK, "", ""};
        params.bead_material = FST_MATERIAL_MIXED;
        params.bead_a = 1e-3;
        if (fst_family_begin(&family, &params, key, &error) != FST_OK ||
            fst_family_setup(&family, value, &setup, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        fst_setup_by_parameter(&setup, state, by);
        rhs_at(&params, key, value - step, state, below);
        rhs_at(&params, key, value + step, state, above);
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            largest = fmax(largest, fabs(by[k]));
        assert_true(largest > 1e-6);
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            CHECK_CLOSE(by[k], (above[k] - below[k]) / (2 * step), 1e-6 * largest);
    }
}

/* ------------------------------------------------------------------ along an orbit */

static fst_orbit orbit_at(double omega)
{
    const fst_params params = scene_of(omega, "rigid");
    fst_orbit orbit;
    fst_error error = {FST_OK, "", ""};
    if (fst_orbit_find(&params, NULL, &orbit, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return orbit;
}

/* r along one period of an orbit, at `count` even moments. */
static void radii(double omega, const fst_orbit *orbit, int count, double *r)
{
    const fst_params params = scene_of(omega, "rigid");
    const fst_flow_options options = fst_default_flow_options();
    fst_model *model;
    fst_flow *flow;
    fst_stop stop;
    assert_int_equal(fst_model_new(&params, &model, NULL), FST_OK);
    assert_int_equal(fst_flow_new(model, &options, orbit->state, &flow, NULL), FST_OK);
    for (int i = 0; i < count; ++i) {
        assert_int_equal(fst_flow_next(flow, orbit->means.period * i / count, 0, &stop, NULL), FST_OK);
        const fst_flow_info info = fst_flow_get(flow);
        r[i] = hypot(info.state[FST_X], info.state[FST_Y]);
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

/* Where an orbit swings twice in a whole turn, `swing_ratio` is the larger fall of r over the smaller one,
 * less 1. */
static void swings_are_those_of_the_path(void **unused)
{
    (void)unused;
    enum { COUNT = 4000 };
    static const double omegas[] = {0.24, 0.26};
    double *r = malloc(COUNT * sizeof *r);
    assert_non_null(r);
    for (size_t i = 0; i < sizeof omegas / sizeof *omegas; ++i) {
        const fst_orbit orbit = orbit_at(omegas[i]);
        double extreme[8], fall[2];
        int count = 0, top = 0;
        radii(omegas[i], &orbit, COUNT, r);
        for (int k = 0; k < COUNT; ++k) {
            const double before = r[(k + COUNT - 1) % COUNT], after = r[(k + 1) % COUNT];
            if ((r[k] - before) * (after - r[k]) > 0 || count == 8)
                continue;
            if (count == 0)
                top = r[k] < before ? 1 : 0;
            extreme[count++] = r[k];
        }
        assert_int_equal(count, 4);
        for (int k = 0; k < 2; ++k)
            fall[k] = extreme[(top + 2 * k) % 4] - extreme[(top + 2 * k + 1) % 4];
        const double larger = fmax(fall[0], fall[1]), smaller = fmin(fall[0], fall[1]);
        assert_true(smaller > 0);
        CHECK_CLOSE((orbit.swing_ratio + 1.0) * smaller / larger, 1.0, 1e-2);
    }
    CHECK_CLOSE(orbit_at(0.352).swing_ratio, 0.0, 0.0); /* the halves of a symmetric orbit are alike */
    free(r);
}

/* ------------------------------------------------------------------ branches */

/* A branch fills its range, goes up to both borders exactly, and never leaves it. */
static void branches_end_at_their_borders(void **unused)
{
    (void)unused;
    static const double from = 0.3333, to = 0.3777;
    const fst_params params = scene_of(0.35, "rigid");
    const fst_branch_options options = over_omega(FST_BRANCH_COUNTER, from, to);
    fst_branch branch = followed(&params, &options);
    double least = INFINITY, greatest = -INFINITY;
    for (size_t i = 0; i < branch.point_count; ++i) {
        least = fmin(least, branch.points[i].value);
        greatest = fmax(greatest, branch.points[i].value);
    }
    assert_true(least == from);
    assert_true(greatest == to);
    for (size_t i = 0; i < branch.end_count; ++i)
        assert_int_equal(branch.ends[i].type, FST_END_RANGE);
    fst_branch_free(&branch);
}

/* Where the orbit passes through the axis, the sign of its closest approach changes and the orbit ceases to
 * turn round the axis. */
static void the_axis_is_passed(void **unused)
{
    (void)unused;
    const fst_params params = scene_of(0.19, "rigid");
    const fst_branch_options options = over_omega(FST_BRANCH_COUNTER, 0.176, 0.195);
    fst_branch branch = followed(&params, &options);
    const fst_special *s = special_near(&branch, FST_SPECIAL_ORIGIN_CROSSING, 0.17889115893);
    CHECK_CLOSE(s->value, 0.17889115893, 1e-9);
    CHECK_CLOSE(s->at.min_r, 0.0, 1e-8);
    fst_branch_free(&branch);
}

/* A libration loses its stability exactly where a pair of its multipliers leaves the unit circle. */
static void a_pair_leaves_the_circle(void **unused)
{
    (void)unused;
    const fst_params params = scene_of(0.129, "rigid");
    const fst_branch_options options = over_omega(FST_BRANCH_ALL, 0.1288, 0.1305);
    fst_branch branch = followed(&params, &options);
    const fst_special *s = special_near(&branch, FST_SPECIAL_NEIMARK_SACKER, 0.129014691545);
    double least = INFINITY;
    CHECK_CLOSE(s->value, 0.129014691545, 1e-9);
    assert_int_equal(s->criticality, -1);
    for (int i = 0; i < s->at.multipliers; ++i)
        if (fabs(s->at.multiplier_im[i]) > 1e-6)
            least = fmin(least, fabs(hypot(s->at.multiplier_re[i], s->at.multiplier_im[i]) - 1.0));
    CHECK_CLOSE(least, 0.0, 1e-8);
    fst_branch_free(&branch);
}

/* Determinant of the Jacobian at the equilibrium on the axis, where n lies along X and turns with the magnet.
 * The direction along n is left out, because nothing changes along it. */
static double determinant_on_the_axis(double omega, double nx)
{
    enum { N = FST_STATE_SIZE - 1 };
    const fst_params params = scene_of(omega, "rigid");
    double state[FST_STATE_SIZE] = {0}, whole[FST_STATE_SIZE][FST_STATE_SIZE], a[N][N], product = 1.0;
    fst_model *model;
    state[FST_NX] = nx;
    state[FST_WZ] = omega;
    assert_int_equal(fst_model_new(&params, &model, NULL), FST_OK);
    fst_jacobian(model, state, whole, NULL);
    fst_model_free(model);
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j)
            a[i][j] = whole[i + (i >= FST_NX)][j + (j >= FST_NX)];
    for (int k = 0; k < N; ++k) {
        int best = k;
        for (int i = k + 1; i < N; ++i)
            best = fabs(a[i][k]) > fabs(a[best][k]) ? i : best;
        for (int j = 0; j < N && best != k; ++j) {
            const double kept = a[k][j];
            a[k][j] = a[best][j];
            a[best][j] = kept;
        }
        product *= best == k ? a[k][k] : -a[k][k];
        for (int i = k + 1; i < N; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (int j = k; j < N; ++j)
                a[i][j] -= factor * a[k][j];
        }
    }
    return product;
}

/* The pitchfork on the axis is where that determinant is zero, to the last digits. */
static void the_pitchfork_on_the_axis(void **unused)
{
    (void)unused;
    double best = INFINITY;
    const fst_params params = scene_of(0.2, "rigid");
    const fst_branch_options options = over_omega(FST_BRANCH_LOCKED, 0.19, 0.205);
    fst_branch branch = followed(&params, &options);
    const fst_special *s = special_near(&branch, FST_SPECIAL_PITCHFORK, 0.1975839610);
    for (int sign = -1; sign <= 1; sign += 2) {
        double lo = 0.197, hi = 0.198, f_lo = determinant_on_the_axis(lo, sign);
        if ((f_lo < 0) == (determinant_on_the_axis(hi, sign) < 0))
            continue;
        for (int i = 0; i < 50; ++i) {
            const double middle = 0.5 * (lo + hi);
            *((determinant_on_the_axis(middle, sign) < 0) == (f_lo < 0) ? &lo : &hi) = middle;
        }
        best = fabs(s->value - lo) < fabs(best) ? s->value - lo : best;
    }
    CHECK_CLOSE(best, 0.0, 1e-11);
    fst_branch_free(&branch);
}

/* Over the height of the bead both states on the axis have a pitchfork. Newton's matrix is singular there, and
 * the method fails nearby. The pitchfork must still be found, with steps of any length, and a branch that comes
 * from off the axis must end there and not be taken for one that turns in a fold. */
static void pitchforks_on_the_axis_over_the_height(void **unused)
{
    (void)unused;
    static const double steps[] = {0.5, 0.02}, places[] = {0.905835876962, 0.68605196508};
    const fst_params params = fst_default_params();
    for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i)
        for (size_t k = 0; k < sizeof places / sizeof *places; ++k) {
            fst_branch_options options = fst_default_branch_options();
            options.kind = FST_BRANCH_LOCKED;
            options.key = "model.h";
            options.from = places[k] - 0.03;
            options.to = places[k] + 0.03;
            options.longest_step = steps[i];
            fst_branch branch = followed(&params, &options);
            const fst_special *s = special_near(&branch, FST_SPECIAL_PITCHFORK, places[k]);
            CHECK_CLOSE(s->value, places[k], 2e-10);
            assert_true(s->born >= 0 && s->criticality == 1);
            for (size_t m = 0; m < branch.special_count; ++m)
                if (branch.specials[m].type == FST_SPECIAL_FOLD &&
                    fabs(branch.specials[m].value - places[k]) < 1e-6)
                    fail_msg("steps of %g: a fold at the pitchfork at %.9g", steps[i], places[k]);
            fst_branch_free(&branch);
        }
}

/* Two crossings within one long step do not hide each other: with steps ten times as long as usual the same
 * Hopf point is found. Beside it, its pair of eigenvalues meets on the real axis. */
static void crossings_in_a_long_step(void **unused)
{
    (void)unused;
    const fst_params params = scene_of(0.21513626, "rigid");
    fst_branch_options options = fst_default_branch_options();
    options.kind = FST_BRANCH_LOCKED;
    options.key = "model.h";
    options.from = 0.5;
    options.to = 0.85;
    options.longest_step = 5.0;
    fst_branch branch = followed(&params, &options);
    CHECK_CLOSE(special_near(&branch, FST_SPECIAL_HOPF, 0.79098553)->value, 0.79098553139, 1e-7);
    CHECK_CLOSE(special_near(&branch, FST_SPECIAL_FOLD, 0.79602187)->value, 0.79602186607, 1e-7);
    CHECK_CLOSE(special_near(&branch, FST_SPECIAL_HOPF, 0.83383715)->value, 0.83383714925, 1e-7);
    fst_branch_free(&branch);
}

/* Ends the work after a given number of points. */
static fst_status lose_patience(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    int *left = user;
    (void)fraction, (void)error;
    *left -= 1;
    return *left > 0 ? FST_OK : FST_INTERRUPTED;
}

/* A branch of doubled period ends where it meets the orbits of half the period again; beyond, it would come back as
 * itself, half a period on. */
static void a_doubled_branch_is_followed_once(void **unused)
{
    (void)unused;
    const fst_params params = scene_of(0.21513626, "rigid");
    fst_branch_options options = fst_default_branch_options();
    options.kind = FST_BRANCH_COUNTER;
    options.key = "model.h";
    options.from = 0.51;
    options.to = 0.56;
    int left = 20000, doubled = 0; /* the number of questions, one every 4000 evaluations */
    const fst_progress progress = {&left, lose_patience};
    options.progress = &progress;
    fst_branch branch = followed(&params, &options);
    for (size_t i = 0; i < branch.end_count; ++i) {
        if (branch.ends[i].type != FST_END_OTHER_BRANCH)
            continue;
        doubled += 1;
        const fst_branch_end *end = &branch.ends[i];
        assert_true(fabs(end->value - special_near(&branch, FST_SPECIAL_PERIOD_DOUBLING, 0.5160627)->value) <
                    1e-3);
        for (size_t k = 0; k + 1 < branch.point_count; ++k)
            if (branch.points[k].branch == end->branch && branch.points[k + 1].branch == end->branch)
                assert_true(branch.points[k + 1].value < branch.points[k].value); /* it never goes back */
        for (size_t k = 0; k < branch.end_count; ++k)
            assert_true(k == i || branch.ends[k].branch != branch.ends[i].branch); /* it has one end */
    }
    assert_int_equal(doubled, 1);
    fst_branch_free(&branch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_by_parameters),
        cmocka_unit_test(swings_are_those_of_the_path),
        cmocka_unit_test(branches_end_at_their_borders),
        cmocka_unit_test(the_axis_is_passed),
        cmocka_unit_test(the_pitchfork_on_the_axis),
        cmocka_unit_test(pitchforks_on_the_axis_over_the_height),
        cmocka_unit_test(a_pair_leaves_the_circle),
        cmocka_unit_test(crossings_in_a_long_step),
        cmocka_unit_test(a_doubled_branch_is_followed_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
