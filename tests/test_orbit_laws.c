/* What orbits and branches must obey however they were found: derivatives by parameters, the ends of a range,
 * the shape of an orbit against a trajectory along it, and the passage of the axis. */
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

/* d(rhs)/d(parameter) of every scaled group, against differences of models made from outside. */
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
        assert_int_equal(fst_flow_advance(flow, orbit->means.period * i / count, 0, &stop, NULL), FST_OK);
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
        CHECK_CONTAINS(branch.ends[i].reason, "the end of the range");
    fst_branch_free(&branch);
}

/* Where the orbit passes the axis, its closest approach changes sides: the branch stops turning round the axis.
 */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_by_parameters),
        cmocka_unit_test(swings_are_those_of_the_path),
        cmocka_unit_test(branches_end_at_their_borders),
        cmocka_unit_test(the_axis_is_passed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
