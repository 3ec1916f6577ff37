/* A branch stays on its curve however long its steps may become: the special points keep their places, types
 * and criticalities, and no step lands on another curve nearby.
 * tests: orbit/curve.c orbit/special.c
 * labels: numbers slow */
#include "branches.h"

typedef struct expected {
    fst_special_type type;
    double value;
    int criticality;
} expected;

static void check_specials(const fst_branch *b, const expected *wanted, size_t count, double step)
{
    for (size_t i = 0; i < count; ++i) {
        size_t k = 0;
        while (k < b->special_count &&
               !(b->specials[k].type == wanted[i].type && fabs(b->specials[k].value - wanted[i].value) < 2e-6))
            ++k;
        if (k == b->special_count)
            fail_msg("steps up to %g: no %s at %.9g", step, fst_special_name(wanted[i].type), wanted[i].value);
        if (b->specials[k].criticality != wanted[i].criticality)
            fail_msg("steps up to %g: the criticality of the %s at %.9g is %d", step,
                     fst_special_name(wanted[i].type), wanted[i].value, b->specials[k].criticality);
    }
    if (b->special_count != count)
        fail_msg("steps up to %g: %zu special points, expected %zu", step, b->special_count, count);
}

/* Neighbouring points of a branch are close together: the states differ by no more than some multiple of the
 * differences of parameter and period. */
static void check_branch(fst_branch_kind kind, double from, double to, const expected *wanted, size_t count)
{
    static const double steps[] = {0.5, 20.0};
    const fst_params params = scene_of(0.3, "rigid");
    int branches = 0;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i) {
        fst_branch_options o = over_omega(kind, from, to);
        o.longest_step = steps[i];
        fst_branch b = followed(&params, &o);
        check_specials(&b, wanted, count, steps[i]);
        branches = i == 0 ? b.branches : branches;
        if (b.branches != branches)
            fail_msg("steps up to %g: %d branches, with short ones %d", steps[i], b.branches, branches);
        fst_branch_free(&b);
    }
}

static void counter_rotation(void **state)
{
    static const expected wanted[] = {{FST_SPECIAL_PITCHFORK, 0.268853033991, 1},
                                      {FST_SPECIAL_ORIGIN_CROSSING, 0.178891158927, 0},
                                      {FST_SPECIAL_HOPF, 0.152636630556, 1}};
    (void)state;
    check_branch(FST_BRANCH_COUNTER, 0.1, 0.35, wanted, sizeof wanted / sizeof *wanted);
}

static void locked_families(void **state)
{
    static const expected wanted[] = {
        {FST_SPECIAL_PITCHFORK, 0.251595368, 1}, {FST_SPECIAL_HOPF, 0.222590125856, 1},
        {FST_SPECIAL_PITCHFORK, 0.197583961, 1}, {FST_SPECIAL_HOPF, 0.152636630556, 1},
        {FST_SPECIAL_FOLD, 0.127746588032, 0},   {FST_SPECIAL_HOPF, 0.130322791346, -1},
        {FST_SPECIAL_HOPF, 0.204219278781, -1},  {FST_SPECIAL_FOLD, 0.207299010348, 0},
        {FST_SPECIAL_FOLD, 0.186164392083, 0}};
    (void)state;
    check_branch(FST_BRANCH_LOCKED, 0.1, 0.35, wanted, sizeof wanted / sizeof *wanted);
}

/* The vector from one point of equilibria to the next, in the space of states and parameter; returns its
 * length. */
static double way_between(const fst_branch_point *a, const fst_branch_point *b, double way[FST_STATE_SIZE + 1])
{
    double sum = 0.0;
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        way[k] = b->state[k] - a->state[k];
    way[FST_STATE_SIZE] = b->value - a->value;
    for (int k = 0; k <= FST_STATE_SIZE; ++k)
        sum += way[k] * way[k];
    return sqrt(sum);
}

/* At low drives families of equilibria pass close by each other. A step that turns sharply from the one before
 * has landed on another family, so the tangent may turn by at most 18 degrees in a step. (Without that limit
 * turns of 36 to 50 degrees occur here.) */
static void steps_do_not_turn_sharply(void **state)
{
    (void)state;
    for (int i = 0; i < 2; ++i) {
        const fst_params params = scene_of(0.2, i ? "farago2020" : "rigid");
        fst_branch_options o = over_omega(FST_BRANCH_LOCKED, 0.02, 0.3);
        o.longest_step = i ? 60.0 : 5.0;
        o.follow = 0;
        fst_branch b = followed(&params, &o);
        size_t compared = 0;
        for (size_t k = 0; k + 2 < b.point_count; ++k) {
            const fst_branch_point *p = &b.points[k];
            double first[FST_STATE_SIZE + 1], second[FST_STATE_SIZE + 1], along = 0.0;
            if (p[0].branch != p[1].branch || p[1].branch != p[2].branch)
                continue;
            const double one = way_between(&p[0], &p[1], first), other = way_between(&p[1], &p[2], second);
            if (!(one > 1e-6 && other > 1e-6))
                continue;
            for (int c = 0; c <= FST_STATE_SIZE; ++c)
                along += first[c] * second[c];
            if (along < 0.93 * one * other)
                fail_msg("a turn of %.3g degrees on branch %d at %g", acos(along / (one * other)) * 57.29578,
                         p[1].branch, p[1].value);
            compared += 1;
        }
        assert_true(compared > 100);
        fst_branch_free(&b);
    }
}

/* Over the height of the bead families lie close together and run the same way, so that Newton's method may
 * correct a long step onto the wrong one. The distance between prediction and correction shows this. (Without
 * that limit one step lands beyond the border of the range, where no equilibrium exists, and the whole branch
 * fails.) */
static void steps_do_not_land_far_away(void **state)
{
    static const double folds[] = {0.333263, 0.394009, 0.405458, 0.467670, 0.519281, 0.552479, 0.617588};
    static const double steps[] = {5.0, 100.0, 1000.0};
    (void)state;
    const fst_params params = scene_of(0.09, "rigid");
    for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i) {
        fst_branch_options o = over_omega(FST_BRANCH_LOCKED, 0.2, 1.0);
        o.key = "model.h";
        o.longest_step = steps[i];
        o.follow = 0;
        fst_branch b = followed(&params, &o);
        size_t found = 0;
        for (size_t k = 0; k < b.special_count; ++k)
            found += b.specials[k].type == FST_SPECIAL_FOLD;
        if (found != sizeof folds / sizeof *folds)
            fail_msg("steps up to %g: %zu folds", steps[i], found);
        for (size_t k = 0; k < found; ++k)
            assert_true(fabs(special_near(&b, FST_SPECIAL_FOLD, folds[k])->value - folds[k]) < 2e-6);
        fst_branch_free(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counter_rotation),
        cmocka_unit_test(locked_families),
        cmocka_unit_test(steps_do_not_turn_sharply),
        cmocka_unit_test(steps_do_not_land_far_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
