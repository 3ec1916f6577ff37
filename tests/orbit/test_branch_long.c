/* Whole branches: special points do not depend on tolerances or steps, and families that meet agree where they
 * meet.
 * tests: orbit/special.c orbit/counter.c
 * labels: long */
#include "branches.h"

static fst_branch follow(const char *dynamics, double from, double to, double tolerance, double step)
{
    const fst_params params = scene_of(0.3, dynamics);
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, from, to);
    o.tolerance = tolerance;
    o.longest_step = step;
    return followed(&params, &o);
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

/* Tightening every tolerance (integration and location a hundredfold, Newton's residual tenfold) and more than
 * halving the steps moves no special point by 1e-9. */
static void specials_do_not_depend_on_tolerances(void **state)
{
    (void)state;
    static const char *const dynamics[] = {"rigid", "farago2020"};
    for (int d = 0; d < 2; ++d) {
        fst_branch loose = follow(dynamics[d], 0.02, 5.0, 1e-12, 0.5);
        fst_branch tight = follow(dynamics[d], 0.02, 5.0, 1e-14, 0.2);
        assert_int_equal(loose.special_count, tight.special_count);
        for (int i = 0; i < SPECIAL_COUNT; ++i) {
            const struct special_point *wanted = &SPECIALS[i];
            if (strcmp(wanted->dynamics, dynamics[d]) != 0)
                continue;
            const fst_special *a = special_near(&loose, wanted->type, wanted->value);
            const fst_special *b = special_near(&tight, wanted->type, wanted->value);
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
    fst_branch b = follow("rigid", 0.1, 3.0, 1e-12, 0.5);
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

/* The branch of equilibria is computed without the orbits, and yet loses its stability where these are born. */
static void hopf_points_agree_between_orbits_and_equilibria(void **state)
{
    (void)state;
    fst_branch orbits = follow("rigid", 0.02, 0.5, 1e-13, 0.5);
    const fst_params params = scene_of(0.3, "rigid");
    const fst_branch_options o = over_omega(FST_BRANCH_LOCKED, 0.02, 0.5);
    fst_branch equilibria = followed(&params, &o);
    const double at[] = {0.15263663056, 0.03357948816};
    for (int i = 0; i < 2; ++i)
        CHECK_CLOSE(special_near(&orbits, FST_SPECIAL_HOPF, at[i])->value,
                    special_near(&equilibria, FST_SPECIAL_HOPF, at[i])->value, 1e-9);
    /* A pitchfork of equilibria on the axis, where only the rotation of n decides: it must lie on the axis. */
    CHECK_CLOSE(special_near(&equilibria, FST_SPECIAL_PITCHFORK, 0.1975839610)->at.mean_r, 0.0, 1e-6);
    fst_branch_free(&orbits);
    fst_branch_free(&equilibria);
}

/* Where an orbit ceases to attract its period doubles, and the branch that is born there is followed as far as the range
 * goes, though its residuals stand still above 1e-12. */
static void doubled_period_is_followed(const fst_branch *b)
{
    const fst_special *first = special_near(b, FST_SPECIAL_PERIOD_DOUBLING, 14.0707728);
    assert_true(first->born > 0);
    for (size_t i = 0; i < b->end_count; ++i)
        if (b->ends[i].branch == first->born)
            assert_int_equal(b->ends[i].type, FST_END_RANGE);
}

/* With dry friction a branch is followed from an orbit that attracts on one side; where the orbit repels on both, by another
 * multiplier, the place is listed and no more. */
static void what_repels_is_listed_only(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    assert_int_equal(fst_params_set(&params, "friction.law", "coulomb", NULL), FST_OK);
    assert_int_equal(fst_params_set(&params, "friction.mu", "0.1", NULL), FST_OK);
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 9.45, 11.0);
    o.key = "drive.frequency";
    fst_branch b = followed(&params, &o);
    int born = 0, listed = 0;
    for (size_t i = 0; i < b.special_count; ++i) {
        const fst_special *s = &b.specials[i];
        if (s->type != FST_SPECIAL_PERIOD_DOUBLING && s->type != FST_SPECIAL_PITCHFORK)
            continue;
        int repels = 0;
        for (int k = 0; k < s->at.multipliers; ++k)
            repels |= hypot(s->at.multiplier_re[k], s->at.multiplier_im[k]) > 1.01;
        assert_true(!repels || s->born < 0);
        listed += repels;
        born += s->born >= 0;
    }
    assert_true(listed > 0 && born > 0);
    fst_branch_free(&b);
}

/* Over two blocks orbits that rest turn round where the greatest multiplier passes 1.  Their multipliers are known to
 * 1e-7 alone, and the point must not be lost in that. */
static void a_fold_of_orbits_that_rest(void **state)
{
    (void)state;
    static const char *const keys[][2] = {{"friction.law", "coulomb"},
                                          {"friction.mu", "0.15"},
                                          {"bead.radius", "2.5mm"},
                                          {"bead.mass", "0.5g"},
                                          {"bead.remanence", "1.2"},
                                          {"magnet.shape", "parts"},
                                          {"magnet.depth", "16.2mm"},
                                          {"magnet.parts[0].kind", "cuboid"},
                                          {"magnet.parts[0].centre[0]", "21.5mm"},
                                          {"magnet.parts[0].size[0]", "13mm"},
                                          {"magnet.parts[0].size[1]", "40mm"},
                                          {"magnet.parts[0].size[2]", "9mm"},
                                          {"magnet.parts[0].remanence[2]", "0.567"},
                                          {"magnet.parts[1].kind", "cuboid"},
                                          {"magnet.parts[1].centre[0]", "-21.5mm"},
                                          {"magnet.parts[1].size[0]", "13mm"},
                                          {"magnet.parts[1].size[1]", "40mm"},
                                          {"magnet.parts[1].size[2]", "9mm"},
                                          {"magnet.parts[1].remanence[2]", "-0.567"}};
    fst_params params = fst_default_params();
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i)
        assert_int_equal(fst_params_set(&params, keys[i][0], keys[i][1], NULL), FST_OK);
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 14.0, 14.6);
    o.key = "drive.frequency";
    fst_branch b = followed(&params, &o);
    const fst_special *fold = NULL;
    for (size_t i = 0; i < b.special_count; ++i)
        if (b.specials[i].type == FST_SPECIAL_FOLD && b.specials[i].value < 14.1)
            fold = &b.specials[i];
    assert_non_null(fold);
    /* The branch comes from above and goes back up: of the neighbouring points one is unstable by a multiplier above 1,
     * the other stable. */
    size_t least = 0;
    for (size_t i = 1; i < b.point_count; ++i)
        if (b.points[i].branch == fold->branch && b.points[i].mean_r > 0.785 &&
            fabs(b.points[i].value - fold->value) < fabs(b.points[least].value - fold->value))
            least = i;
    assert_true(least > 0 && least + 1 < b.point_count);
    assert_true(b.points[least].value >= fold->value);
    assert_true(b.points[least - 1].value > fold->value && b.points[least + 1].value > fold->value);
    assert_int_not_equal(b.points[least - 1].stable, b.points[least + 1].stable);
    doubled_period_is_followed(&b);
    fst_branch_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(specials_do_not_depend_on_tolerances),
        cmocka_unit_test(branches_do_not_jump),
        cmocka_unit_test(hopf_points_agree_between_orbits_and_equilibria),
        cmocka_unit_test(what_repels_is_listed_only),
        cmocka_unit_test(a_fold_of_orbits_that_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
