/* Curves of special points over two parameters agree with the special points of branches over one.
 * tests: orbit/special_curve.c
 * labels: long */
#include "special_curves.h"

#include <string.h>

static void curves_end_where_branches_say(void **state)
{
    (void)state;
    static const struct {
        fst_branch_kind kind;
        fst_special_type type;
        double from, to, kappa_from, kappa_to;
    } cases[] = {
        {FST_BRANCH_COUNTER, FST_SPECIAL_PITCHFORK, 0.18, 0.4, 1.2, 2.0},
        {FST_BRANCH_COUNTER, FST_SPECIAL_ORIGIN_CROSSING, 0.12, 0.4, 1.2, 2.0},
        {FST_BRANCH_COUNTER, FST_SPECIAL_FOLD, 2.4, 5.0, 1.2, 2.0},
        {FST_BRANCH_COUNTER, FST_SPECIAL_HOPF, 0.12, 0.2, 1.3, 1.8},
        {FST_BRANCH_LOCKED, FST_SPECIAL_FOLD, 0.115, 0.14, 1.4, 1.6},
        {FST_BRANCH_ALL, FST_SPECIAL_NEIMARK_SACKER, 0.12, 0.14, 1.45, 1.55},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        fst_branch b = curve(cases[k].kind, cases[k].type, cases[k].from, cases[k].to, cases[k].kappa_from,
                             cases[k].kappa_to);
        assert_int_equal(b.branches, 1);
        assert_int_equal(b.followed, cases[k].type);
        /* the curve ends within 1e-8 of the range's kappa, which moves omega along the curve by as much */
        CHECK_ENDS(&b, cases[k].kind, cases[k].type, cases[k].from, cases[k].to, cases[k].kappa_from,
                   cases[k].kappa_to, 1e-8);
        for (size_t i = 0; i < b.point_count; ++i) {
            const fst_branch_point *p = &b.points[i];
            assert_true(p->stable); /* the critical multipliers do not count here */
            if (cases[k].type == FST_SPECIAL_HOPF || cases[k].type == FST_SPECIAL_NEIMARK_SACKER)
                CHECK_CLOSE(least_real_part_of_pairs(p), 0.0, 1e-9);
            if (cases[k].type == FST_SPECIAL_PITCHFORK)
                CHECK_CLOSE(nearest_multiplier(p, -1.0), 0.0, 1e-9);
        }
        fst_branch_free(&b);
    }
}

/* A point in the middle of a curve is special too, and the curve is smooth. */
static void points_between_are_special(void **state)
{
    (void)state;
    fst_branch b = curve(FST_BRANCH_COUNTER, FST_SPECIAL_PITCHFORK, 0.18, 0.4, 1.0, 2.5);
    assert_true(b.point_count > 8);
    for (size_t i = 1; i < b.point_count; ++i) {
        assert_true((b.points[i].value > b.points[i - 1].value) == (b.points[1].value > b.points[0].value));
        assert_true((b.points[i].second > b.points[i - 1].second) == (b.points[1].value > b.points[0].value));
    }
    const fst_branch_point *middle = &b.points[b.point_count / 3];
    CHECK_CLOSE(middle->value,
                at_kappa(FST_BRANCH_COUNTER, FST_SPECIAL_PITCHFORK, middle->second, middle->value, 0.18, 0.4),
                1e-9);
    fst_branch_free(&b);
}

/* Exchanging the two parameters gives the same curve. */
static void parameters_may_be_exchanged(void **state)
{
    (void)state;
    const fst_params params = scene_at(0.26885303399, 1.5);
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 1.3, 1.8);
    o.key = "model.kappa";
    o.second_key = "drive.omega";
    o.second_from = 0.25;
    o.second_to = 0.29;
    o.special = FST_SPECIAL_PITCHFORK;
    fst_branch b = followed(&params, &o);
    const fst_branch_point *p = point_at(&b, 0.29); /* the second parameter */
    CHECK_CLOSE(at_kappa(FST_BRANCH_COUNTER, FST_SPECIAL_PITCHFORK, p->value, 0.29, 0.25, 0.32), p->second,
                1e-9);
    fst_branch_free(&b);
}

/* Dry friction, under two blocks: a pitchfork's curve runs into that of a grazing, ends there, and says so.  A branch
 * over the frequency has that grazing where the curve ends, and shortly before both points. */
static void curves_end_at_grazings(void **state)
{
    (void)state;
    static const char *const scene[][2] = {{"bead.radius", "2.5mm"},    {"bead.mass", "0.5g"},
                                           {"bead.remanence", "1.2T"},  {"magnet.shape", "parts"},
                                           {"magnet.depth", "16.2mm"},  {"friction.law", "coulomb"},
                                           {"drive.frequency", "17Hz"}, {"friction.mu", "0.175"}};
    fst_params params = fst_default_params();
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 16.7, 17.2);
    fst_error error;
    for (size_t i = 0; i < sizeof scene / sizeof *scene; ++i)
        if (fst_params_set(&params, scene[i][0], scene[i][1], &error) != FST_OK)
            fail_msg("%s", error.sentence);
    params.magnet_part_count = 2;
    for (int i = 0; i < 2; ++i)
        params.magnet_parts[i] = (fst_magnet_part){.kind = FST_PART_CUBOID,
                                                   .centre = {i ? -21.5e-3 : 21.5e-3},
                                                   .size = {13e-3, 40e-3, 9e-3},
                                                   .remanence = {0, 0, i ? -0.567 : 0.567}};
    o.key = "drive.frequency";
    o.second_key = "friction.mu";
    o.second_from = 0.17;
    o.second_to = 0.2;
    o.special = FST_SPECIAL_PITCHFORK;
    fst_branch b = followed(&params, &o);
    assert_int_equal(b.branches, 1);
    int ends = 0;
    for (size_t i = 0; i < b.end_count; ++i) {
        if (!strstr(b.ends[i].reason, "(grazing)"))
            continue;
        ++ends;
        double mu;
        assert_int_equal(sscanf(b.ends[i].reason, "at %*f, %lf", &mu), 1);
        fst_branch_options over_one = over_omega(FST_BRANCH_COUNTER, 17.0, 17.2);
        over_one.key = "drive.frequency";
        params.friction_mu = mu;
        fst_branch at = followed(&params, &over_one);
        CHECK_CLOSE(special_near(&at, FST_SPECIAL_GRAZING, b.ends[i].value)->value, b.ends[i].value, 1e-4);
        fst_branch_free(&at);
        params.friction_mu = mu - 1e-5;
        at = followed(&params, &over_one);
        const double pitchfork = special_near(&at, FST_SPECIAL_PITCHFORK, b.ends[i].value)->value;
        assert_true(pitchfork > special_near(&at, FST_SPECIAL_GRAZING, pitchfork)->value);
        fst_branch_free(&at);
    }
    assert_int_equal(ends, 1);
    fst_branch_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_end_where_branches_say),
        cmocka_unit_test(points_between_are_special),
        cmocka_unit_test(parameters_may_be_exchanged),
        cmocka_unit_test(curves_end_at_grazings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
