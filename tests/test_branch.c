/* Branches: the special points stay where they are however the work is done, agree between families that meet
 * there, and direct simulation shows on both sides of each what it says. */
#include "numeric.h"

#include <stdio.h>

#include <festoon/festoon.h>

static fst_params scene(double omega, const char *dynamics)
{
    fst_params params = fst_default_params();
    fst_error error;
    assert_int_equal(fst_params_set(&params, "model.dynamics", dynamics, &error), FST_OK);
    char text[32];
    (void)snprintf(text, sizeof text, "%.17g", omega);
    assert_int_equal(fst_params_set(&params, "drive.omega", text, &error), FST_OK);
    return params;
}

static fst_branch follow(fst_branch_kind kind, const char *dynamics, double from, double to, double tolerance,
                         double step)
{
    const fst_params params = scene(0.3, dynamics);
    fst_branch_options o = fst_default_branch_options();
    fst_branch branch;
    fst_error error;
    o.kind = kind;
    o.from = from;
    o.to = to;
    o.tolerance = tolerance;
    o.longest_step = step;
    const fst_status status = fst_branch_follow(&params, &o, &branch, &error);
    if (status != FST_OK)
        fail_msg("%s", error.sentence);
    return branch;
}

static const fst_special *find(const fst_branch *branch, fst_special_type type, double near)
{
    for (size_t i = 0; i < branch->special_count; ++i)
        if (branch->specials[i].type == type && fabs(branch->specials[i].value - near) < 1e-3)
            return &branch->specials[i];
    fail_msg("no %s near %g", fst_special_name(type), near);
    return NULL;
}

static const struct special_point {
    const char *dynamics;
    fst_special_type type;
    double value;
    int criticality;
} SPECIALS[] = {
    {"rigid", FST_SPECIAL_PITCHFORK, 0.26885303399, 1},
    {"rigid", FST_SPECIAL_FOLD, 3.38951025245, 0},
    {"rigid", FST_SPECIAL_ORIGIN_CROSSING, 0.17889115893, 0},
    {"rigid", FST_SPECIAL_HOPF, 0.15263663056, 1},
    {"rigid", FST_SPECIAL_HOPF, 0.03357948816, -1},
    {"rigid", FST_SPECIAL_FOLD, 0.03180383352, 0},
    {"farago2020", FST_SPECIAL_PITCHFORK, 0.28972621571, 1},
    {"farago2020", FST_SPECIAL_FOLD, 2.36353343934, 0},
    {"farago2020", FST_SPECIAL_ORIGIN_CROSSING, 0.17924973066, 0},
};
enum { SPECIAL_COUNT = sizeof SPECIALS / sizeof *SPECIALS };

/* Every tolerance tightened a hundredfold and the steps more than halved move no special point by 1e-9. */
static void specials_do_not_depend_on_tolerances(void **state)
{
    (void)state;
    static const char *const dynamics[] = {"rigid", "farago2020"};
    for (int d = 0; d < 2; ++d) {
        fst_branch loose = follow(FST_BRANCH_COUNTER, dynamics[d], 0.02, 5.0, 1e-12, 0.5);
        fst_branch tight = follow(FST_BRANCH_COUNTER, dynamics[d], 0.02, 5.0, 1e-14, 0.2);
        assert_int_equal(loose.special_count, tight.special_count);
        for (int i = 0; i < SPECIAL_COUNT; ++i) {
            const struct special_point *wanted = &SPECIALS[i];
            if (strcmp(wanted->dynamics, dynamics[d]) != 0)
                continue;
            const fst_special *a = find(&loose, wanted->type, wanted->value);
            const fst_special *b = find(&tight, wanted->type, wanted->value);
            CHECK_CLOSE(a->value, b->value, 1e-9);
            CHECK_CLOSE(b->value, wanted->value, 1e-9);
            assert_int_equal(a->criticality, wanted->criticality);
            assert_int_equal(b->criticality, wanted->criticality);
        }
        fst_branch_free(&loose);
        fst_branch_free(&tight);
    }
}

/* No branch jumps: neighbouring points are near each other, with one symmetry. */
static void branches_do_not_jump(void **state)
{
    (void)state;
    fst_branch b = follow(FST_BRANCH_COUNTER, "rigid", 0.1, 3.0, 1e-12, 0.5);
    for (size_t i = 0; i + 1 < b.point_count; ++i) {
        const fst_branch_point *p = &b.points[i], *q = p + 1;
        if (p->branch != q->branch)
            continue;
        assert_true(fabs(p->value - q->value) < 0.1);
        assert_true(fabs(p->mean_r - q->mean_r) < 0.15);
        assert_true((p->symmetry == FST_SYMMETRY_S2) == (q->symmetry == FST_SYMMETRY_S2));
    }
    fst_branch_free(&b);
}

/* The equilibria know nothing of the orbits, and yet lose their stability where these are born. */
static void hopf_points_agree_between_orbits_and_equilibria(void **state)
{
    (void)state;
    fst_branch orbits = follow(FST_BRANCH_COUNTER, "rigid", 0.02, 0.5, 1e-13, 0.5);
    fst_branch equilibria = follow(FST_BRANCH_LOCKED, "rigid", 0.02, 0.5, 1e-13, 0.3);
    const double at[] = {0.15263663056, 0.03357948816};
    for (int i = 0; i < 2; ++i)
        CHECK_CLOSE(find(&orbits, FST_SPECIAL_HOPF, at[i])->value,
                    find(&equilibria, FST_SPECIAL_HOPF, at[i])->value, 1e-9);
    /* On the axis the rotation of n alone decides: these need no solution. */
    CHECK_CLOSE(find(&equilibria, FST_SPECIAL_PITCHFORK, 0.1975839610)->at.mean_r, 0.0, 1e-6);
    fst_branch_free(&orbits);
    fst_branch_free(&equilibria);
}

static fst_run_result simulate(double omega)
{
    fst_params params = scene(omega, "rigid");
    const fst_run_options options = fst_default_run_options();
    fst_run_result result;
    params.run_periods = 700;
    params.run_discard = 600;
    assert_int_equal(fst_run(&params, &options, &result, NULL), FST_OK);
    return result;
}

static void simulation_on_both_sides(void **state)
{
    (void)state;
    /* the pitchfork: mean n_z differs from zero below, by a root of the distance, and vanishes above */
    const double near = fabs(simulate(0.26885303399 - 0.004).mean_nz),
                 far = fabs(simulate(0.26885303399 - 0.016).mean_nz);
    assert_true(near > 0.03);
    CHECK_CLOSE(far / near, 2.0, 0.1);
    assert_true(fabs(simulate(0.26885303399 + 0.006).mean_nz) < 1e-6);
    /* the axis: turning above, swinging below */
    assert_int_equal(simulate(0.1795).regime, FST_REGIME_COUNTER_ROTATING);
    assert_int_equal(simulate(0.1782).regime, FST_REGIME_LIBRATING);
    /* the Hopf point: swinging above, at rest below */
    assert_int_equal(simulate(0.1545).regime, FST_REGIME_LIBRATING);
    assert_int_equal(simulate(0.1505).regime, FST_REGIME_LOCKED);
}

/* The upper end: a bead set on the orbit stays below it, and is lost beyond. */
static void counter_rotation_ends_at_the_upper_fold(void **state)
{
    (void)state;
    fst_branch b = follow(FST_BRANCH_COUNTER, "rigid", 3.2, 3.6, 1e-12, 0.2);
    const fst_special *fold = find(&b, FST_SPECIAL_FOLD, 3.38951025245);
    const double below = fold->value - 0.02, beyond = fold->value + 0.03;
    for (int side = 0; side < 2; ++side) {
        const fst_params params = scene(side ? beyond : below, "rigid");
        const fst_branch_point *best = NULL;
        for (size_t i = 0; i < b.point_count; ++i)
            if (b.points[i].stable && (!best || fabs(b.points[i].value - below) < fabs(best->value - below)))
                best = &b.points[i];
        fst_model *model;
        fst_flow *flow;
        fst_stop stop;
        const fst_flow_options options = fst_default_flow_options();
        assert_int_equal(fst_model_new(&params, &model, NULL), FST_OK);
        assert_int_equal(fst_flow_new(model, &options, best->state, &flow, NULL), FST_OK);
        assert_int_equal(fst_flow_advance(flow, side ? 20000.0 : 3000.0, 0, &stop, NULL), FST_OK);
        const fst_flow_info info = fst_flow_get(flow);
        const double r = hypot(info.state[FST_X], info.state[FST_Y]);
        if (side)
            assert_true(r > 4.0);
        else
            CHECK_CLOSE(r, best->mean_r, 0.1);
        fst_flow_free(flow);
        fst_model_free(model);
    }
    fst_branch_free(&b);
}

/* Any parameter will do: the pitchfork over kappa, at the omega where it lies at kappa = 1.5. */
static void another_parameter(void **state)
{
    (void)state;
    const fst_params params = scene(0.26885303399, "rigid");
    fst_branch_options o = fst_default_branch_options();
    fst_branch branch;
    o.key = "model.kappa";
    o.from = 1.2;
    o.to = 2.0;
    assert_int_equal(fst_branch_follow(&params, &o, &branch, NULL), FST_OK);
    const fst_special *pitchfork = NULL;
    for (size_t i = 0; i < branch.special_count; ++i)
        if (branch.specials[i].type == FST_SPECIAL_PITCHFORK)
            pitchfork = &branch.specials[i];
    assert_non_null(pitchfork);
    CHECK_CLOSE(pitchfork->value, 1.5, 1e-8);
    fst_branch_free(&branch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(specials_do_not_depend_on_tolerances),
        cmocka_unit_test(branches_do_not_jump),
        cmocka_unit_test(hopf_points_agree_between_orbits_and_equilibria),
        cmocka_unit_test(simulation_on_both_sides),
        cmocka_unit_test(counter_rotation_ends_at_the_upper_fold),
        cmocka_unit_test(another_parameter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
