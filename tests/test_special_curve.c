/* Special points over two parameters: their curves pass where the same points lie over one. */
#include "numeric.h"

#include <stdio.h>
#include <string.h>

#include <festoon/festoon.h>

static fst_params scene(double omega, double kappa)
{
    fst_params params = fst_default_params();
    fst_error error;
    char text[32];
    (void)snprintf(text, sizeof text, "%.17g", omega);
    assert_int_equal(fst_params_set(&params, "drive.omega", text, &error), FST_OK);
    (void)snprintf(text, sizeof text, "%.17g", kappa);
    assert_int_equal(fst_params_set(&params, "model.kappa", text, &error), FST_OK);
    return params;
}

static fst_branch over_omega(fst_branch_kind kind, fst_special_type type, double from, double to,
                             double kappa_from, double kappa_to)
{
    const fst_params params = scene(0.3, 1.5);
    fst_branch_options o = fst_default_branch_options();
    fst_branch branch;
    fst_error error;
    o.kind = kind;
    o.from = from;
    o.to = to;
    o.second_key = "model.kappa";
    o.second_from = kappa_from;
    o.second_to = kappa_to;
    o.special = type;
    if (fst_branch_follow(&params, &o, &branch, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return branch;
}

/* The special point near `omega` over omega alone, at another kappa. */
static double at_kappa(fst_branch_kind kind, fst_special_type type, double kappa, double omega, double from,
                       double to)
{
    const fst_params params = scene(fmin(fmax(0.3, from), to), kappa);
    fst_branch_options o = fst_default_branch_options();
    fst_branch branch;
    fst_error error;
    double nearest = NAN;
    o.kind = kind;
    o.from = from;
    o.to = to;
    if (fst_branch_follow(&params, &o, &branch, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    for (size_t i = 0; i < branch.special_count; ++i)
        if (branch.specials[i].type == type &&
            !(fabs(branch.specials[i].value - omega) >= fabs(nearest - omega)))
            nearest = branch.specials[i].value;
    fst_branch_free(&branch);
    return nearest;
}

static const fst_branch_point *end_at(const fst_branch *b, double kappa)
{
    for (size_t i = 0; i < b->point_count; ++i)
        if (fabs(b->points[i].second - kappa) < 1e-7)
            return &b->points[i];
    fail_msg("no point at kappa = %g", kappa);
    return NULL;
}

/* At both ends of the range of kappa the curve's omega is the one that a branch over omega alone gives there.
 */
static void curves_end_where_branches_say(void **state)
{
    (void)state;
    static const struct {
        fst_special_type type;
        double from, to;
    } cases[] = {
        {FST_SPECIAL_PITCHFORK, 0.18, 0.4},
        {FST_SPECIAL_ORIGIN_CROSSING, 0.12, 0.4},
        {FST_SPECIAL_FOLD, 2.4, 5.0},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        fst_branch b = over_omega(FST_BRANCH_COUNTER, cases[k].type, cases[k].from, cases[k].to, 1.2, 2.0);
        assert_int_equal(b.branches, 1);
        assert_int_equal(b.followed, cases[k].type);
        for (int end = 0; end < 2; ++end) {
            const double kappa = end ? 2.0 : 1.2;
            const fst_branch_point *p = end_at(&b, kappa);
            const double single =
                at_kappa(FST_BRANCH_COUNTER, cases[k].type, kappa, p->value, cases[k].from, cases[k].to);
            /* kappa itself was reached within 1e-8 of its range; along the curve that moves omega as far */
            CHECK_CLOSE(p->value, single, 2e-8);
            assert_true(p->stable);
        }
        fst_branch_free(&b);
    }
}

/* Every point between is a special point: at its kappa the branch over omega has the multiplier -1 there, which
 * is what the point's own multipliers say; and the curve is smooth. */
static void points_between_are_special(void **state)
{
    (void)state;
    fst_branch b = over_omega(FST_BRANCH_COUNTER, FST_SPECIAL_PITCHFORK, 0.18, 0.4, 1.0, 2.5);
    assert_true(b.point_count > 8);
    for (size_t i = 0; i < b.point_count; ++i) {
        double nearest = INFINITY;
        for (int m = 0; m < b.points[i].multipliers; ++m)
            nearest = fmin(nearest, hypot(b.points[i].multiplier_re[m] + 1.0, b.points[i].multiplier_im[m]));
        CHECK_CLOSE(nearest, 0.0, 1e-9);
        if (i > 0) {
            assert_true((b.points[i].value > b.points[i - 1].value) == (b.points[1].value > b.points[0].value));
            assert_true((b.points[i].second > b.points[i - 1].second) ==
                        (b.points[1].value > b.points[0].value));
        }
    }
    const fst_branch_point *middle = &b.points[b.point_count / 3];
    CHECK_CLOSE(middle->value,
                at_kappa(FST_BRANCH_COUNTER, FST_SPECIAL_PITCHFORK, middle->second, middle->value, 0.18, 0.4),
                1e-9);
    fst_branch_free(&b);
}

/* Equilibria: a Hopf point with its frequency, and the fold of the second family. */
static void curves_of_equilibria(void **state)
{
    (void)state;
    fst_branch b = over_omega(FST_BRANCH_COUNTER, FST_SPECIAL_HOPF, 0.12, 0.2, 1.3, 1.8);
    for (int end = 0; end < 2; ++end) {
        const fst_branch_point *p = end_at(&b, end ? 1.8 : 1.3);
        CHECK_CLOSE(p->value,
                    at_kappa(FST_BRANCH_COUNTER, FST_SPECIAL_HOPF, end ? 1.8 : 1.3, p->value, 0.12, 0.2), 1e-8);
    }
    for (size_t i = 0; i < b.point_count; ++i) {
        double least = INFINITY;
        for (int m = 0; m < b.points[i].multipliers; ++m)
            if (fabs(b.points[i].multiplier_im[m]) > 1e-3)
                least = fmin(least, fabs(b.points[i].multiplier_re[m]));
        CHECK_CLOSE(least, 0.0, 1e-9);
    }
    fst_branch_free(&b);
}

/* With the parameters exchanged the same curve comes out. */
static void parameters_may_be_exchanged(void **state)
{
    (void)state;
    const fst_params params = scene(0.26885303399, 1.5);
    fst_branch_options o = fst_default_branch_options();
    fst_branch b;
    o.key = "model.kappa";
    o.from = 1.3;
    o.to = 1.8;
    o.second_key = "drive.omega";
    o.second_from = 0.25;
    o.second_to = 0.29;
    o.special = FST_SPECIAL_PITCHFORK;
    assert_int_equal(fst_branch_follow(&params, &o, &b, NULL), FST_OK);
    const fst_branch_point *p = end_at(&b, 0.29);
    CHECK_CLOSE(p->second, 0.29, 1e-9);
    CHECK_CLOSE(at_kappa(FST_BRANCH_COUNTER, FST_SPECIAL_PITCHFORK, p->value, 0.29, 0.25, 0.32), p->second,
                1e-9);
    fst_branch_free(&b);
}

static void refusals(void **state)
{
    (void)state;
    const fst_params params = scene(0.3, 1.5);
    fst_branch_options o = fst_default_branch_options();
    fst_branch b;
    fst_error error;
    o.from = 0.28;
    o.to = 0.4;
    o.second_key = "model.kappa";
    o.second_from = 1.0;
    o.second_to = 2.0;
    o.special = FST_SPECIAL_FOLD;
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_NO_CONVERGENCE);
    CHECK_CONTAINS(error.sentence, "no fold lies between");
    o.second_key = "drive.omega";
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    o.second_key = "bead.moment"; /* follows from others here, so it has no value of its own */
    o.special = FST_SPECIAL_PITCHFORK;
    o.from = 0.2;
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "bead.moment");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_end_where_branches_say),
        cmocka_unit_test(points_between_are_special),
        cmocka_unit_test(curves_of_equilibria),
        cmocka_unit_test(parameters_may_be_exchanged),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
