/* Orbits, exponents and locked states under dry friction: against an independent integrator (an event-driven
 * one in other variables, tolerance 1e-12), and against each other.
 * tests: orbit/rolling_lock.c orbit/locked.c orbit/dry_carry.c
 * labels: numbers slow */
#include "branches.h"

#include <stdlib.h>
#include <string.h>

#include "ode/flow.h"
#include "orbit/family.h"
#include "study/exponent.h"

static fst_params coulomb(double hertz, double mu)
{
    fst_params params = fst_default_params();
    fst_error error;
    char text[32];
    (void)snprintf(text, sizeof text, "%.17g", hertz);
    assert_int_equal(fst_params_set(&params, "drive.frequency", text, &error), FST_OK);
    assert_int_equal(fst_params_set(&params, "friction.law", "coulomb", &error), FST_OK);
    params.friction_mu = mu;
    return params;
}

static fst_orbit orbit_of(const fst_params *params)
{
    fst_orbit orbit;
    fst_error error;
    if (fst_orbit_find(params, NULL, &orbit, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return orbit;
}

static int zeros_of(const fst_orbit *orbit)
{
    int zeros = 0;
    for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i)
        zeros += orbit->multiplier_re[i] == 0.0 && orbit->multiplier_im[i] == 0.0;
    return zeros;
}

/* Means and period; two multipliers exactly zero, and the others not. */
static void against_another_integrator(void **unused)
{
    (void)unused;
    const fst_params params = coulomb(10.7, 0.2);
    const fst_orbit orbit = orbit_of(&params);
    CHECK_CLOSE(orbit.means.period, 22.595921694947, 2e-9);
    CHECK_CLOSE(orbit.means.mean_r, 0.731289718772, 1e-9);
    CHECK_CLOSE(orbit.means.mean_alpha_dot, -0.062930962965, 1e-10);
    CHECK_CLOSE(orbit.means.mean_nz, 0.197250421346, 1e-9);
    assert_int_equal(zeros_of(&orbit), 2);
    assert_true(orbit.stable && orbit.trivial_error < 1e-6);
    double greatest = 0.0;
    for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i)
        greatest = fmax(greatest, hypot(orbit.multiplier_re[i], orbit.multiplier_im[i]));
    CHECK_CLOSE(orbit.relaxation_time, -orbit.means.period / log(greatest), 1e-6);
}

/* Weak friction: the contact slips all the way, and no direction is lost. */
static void without_rests(void **unused)
{
    (void)unused;
    const fst_params params = coulomb(10.7, 0.1);
    const fst_orbit orbit = orbit_of(&params);
    assert_int_equal(zeros_of(&orbit), 0);
    assert_int_equal(orbit.symmetry, FST_SYMMETRY_S2);
}

/* The exponents of a bead on the orbit are the logarithms of its multipliers by time. */
static void exponents_against_multipliers(void **unused)
{
    (void)unused;
    fst_params params = coulomb(10.7, 0.2);
    fst_lyapunov l;
    fst_error error;
    params.run_periods = 160.0;
    const fst_orbit orbit = orbit_of(&params);
    if (fst_lyapunov_find(&params, NULL, &l, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    double expected[FST_EIGENVALUE_COUNT] = {0.0}; /* that of the flow direction first */
    for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i) {
        const double size = hypot(orbit.multiplier_re[i], orbit.multiplier_im[i]);
        double rate = log(size) / orbit.means.period;
        int place = 1 + i;
        for (; place > 1 && expected[place - 1] < rate; --place)
            expected[place] = expected[place - 1];
        expected[place] = rate;
    }
    assert_true(l.converged);
    for (int i = 0; i < FST_EIGENVALUE_COUNT; ++i) {
        if (i < 7)
            CHECK_CLOSE(l.exponents[i], expected[i], 4.0 * l.errors[i]);
        else
            assert_true(isinf(l.exponents[i]) && l.exponents[i] < 0);
    }
}

/* The exponent that a run asks for, of the one vector across the flow: that of the leading multiplier; the same
 * with friction that is stronger at rest, where the release is a jump. */
static void exponent_of_a_run(void **unused)
{
    (void)unused;
    for (int stronger = 0; stronger < 2; ++stronger) {
        fst_params params = coulomb(10.7, 0.2);
        params.friction_mu_static = stronger ? 0.25 : NAN;
        const fst_orbit orbit = orbit_of(&params);
        fst_model *model;
        fst_error error;
        fst_exponent exponent, *asked = &exponent;
        if (fst_model_new(&params, &model, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        memset(&exponent, 0, sizeof exponent);
        exponent.world = &model->world;
        memcpy(exponent.state, orbit.state, sizeof exponent.state);
        exponent.duration = 400.0 * orbit.means.period;
        exponent.rtol = 1e-10;
        if (fst_largest_exponents(&fst_tangents_scalar, &asked, 1, NULL, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        assert_false(exponent.failed);
        CHECK_CLOSE(exponent.value, -1.0 / orbit.relaxation_time, exponent.standard_error);
        assert_true(exponent.standard_error < 1e-3);
        fst_model_free(model);
    }
}

/* A bead that only rolls: no orbit, and the sentence says why. */
static void rolling_has_no_orbit(void **unused)
{
    (void)unused;
    fst_params params = coulomb(10.7, 0.2);
    fst_orbit orbit;
    fst_error error;
    params.friction_law = FST_FRICTION_ROLLING;
    assert_int_equal(fst_orbit_find(&params, NULL, &orbit, &error), FST_NO_CONVERGENCE);
    assert_int_equal(orbit.outcome, FST_ORBIT_ROLLS);
    assert_non_null(strstr(error.sentence, "only rolls"));
    fst_branch branch;
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 0.2, 0.3);
    assert_int_equal(fst_branch_follow(&params, &o, &branch, &error), FST_BAD_INPUT);
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The equations of rest of a bead that rolls, written out for a hard magnet:
 * (7/5) eps^2 omega e x W_h = tau_h + eps e x F, tau_z = 0, v = omega e x x = eps W x e, W = omega e + psi n.
 */
static void check_rolling_lock(const fst_model *model, double mu, const fst_rolling_lock *l)
{
    const fst_groups g = fst_model_groups(model);
    const double *n = l->state + FST_NX, *w = l->state + FST_WX, *v = l->state + FST_VX;
    const double eps = g.eps, omega = g.omega, s = g.kappa * eps * eps;
    const fst_world_double *c = &model->world;
    fst_pull_double p;
    double tau[3];
    fst_pull_at_double(c, l->state, c->height, &p);
    fst_cross_double(n, p.b, tau);
    for (int i = 0; i < 3; ++i)
        tau[i] *= s;
    const double left[2] = {-1.4 * eps * eps * omega * w[1], 1.4 * eps * eps * omega * w[0]};
    CHECK_CLOSE(left[0], tau[0] - eps * p.force[1], 1e-12);
    CHECK_CLOSE(left[1], tau[1] + eps * p.force[0], 1e-12);
    CHECK_CLOSE(tau[2], 0.0, 1e-13);
    CHECK_CLOSE(v[0], eps * w[1], 1e-13);
    CHECK_CLOSE(v[1], -eps * w[0], 1e-13);
    CHECK_CLOSE(v[1], omega * l->state[FST_X], 1e-13);
    const double turn[3] = {w[0], w[1], w[2] - omega};
    double across[3];
    fst_cross_double(turn, n, across); /* W - omega e lies along n */
    CHECK_CLOSE(sqrt(dot(across, across)), 0.0, 1e-10 * (1.0 + fabs(w[2])));
    /* Newton: v' = F - f, and v turns with the magnet. */
    const double f[2] = {p.force[0] + omega * v[1], p.force[1] - omega * v[0]};
    CHECK_CLOSE(l->use, hypot(f[0], f[1]) / (mu * (g.gravity - p.force[2])), 1e-9);
}

static void rolling_locks(void **unused)
{
    (void)unused;
    const fst_params params = coulomb(5.0, 0.2);
    fst_model *model;
    fst_locked_list list;
    fst_error error;
    if (fst_model_new(&params, &model, &error) != FST_OK ||
        fst_locked_find(&params, NULL, &list, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    assert_int_equal(list.family_count, 5);
    for (size_t i = 0; i < list.family_count; ++i) {
        const fst_rolling_lock *ends[2] = {&list.families[i].from, &list.families[i].to};
        for (int k = 0; k < 2; ++k) {
            check_rolling_lock(model, 0.2, ends[k]);
            assert_int_equal(ends[k]->end, FST_ROLLING_CONE);
            CHECK_CLOSE(ends[k]->use, 1.0, 1e-9);
        }
    }
    /* Slipping ones: the friction is mu N against the slip, and the power what the slip takes. */
    assert_true(list.count >= 4);
    for (size_t i = 0; i < list.count; ++i) {
        const fst_observation o = fst_observe(model, list.states[i].state);
        double rate[FST_STATE_SIZE];
        fst_rhs(model, list.states[i].state, rate);
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            CHECK_CLOSE(rate[k], 0.0, 1e-10);
        assert_true(list.states[i].slip > 1e-6 && o.friction_power > 0);
    }
    fst_locked_free(&list);
    fst_model_free(model);
}

/* The tolerance of runs is no matter of equilibria: a coarse one must not take slow slips for none, which would
 * lead Newton's method to states without a load, as in this setup. */
static void locks_at_any_tolerance(void **unused)
{
    (void)unused;
    fst_params params = coulomb(90.0, 0.05);
    params.friction_mu_static = 0.065;
    params.friction_stribeck_speed = 0.2;
    params.model_kappa = 1.38;
    for (int k = 0; k < 2; ++k) {
        fst_locked_list list;
        fst_error error;
        params.run_rtol = k ? 1e-5 : 1e-10;
        if (fst_locked_find(&params, NULL, &list, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        assert_int_equal(list.count, 0);
        fst_locked_free(&list);
    }
}

/* Stronger friction holds a bead where weaker friction did: families grow. */
static void families_grow_with_friction(void **unused)
{
    (void)unused;
    double reach[2];
    for (int k = 0; k < 2; ++k) {
        const fst_params params = coulomb(30.0, k ? 0.2 : 0.1);
        fst_locked_list list;
        fst_error error;
        if (fst_locked_find(&params, NULL, &list, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        assert_true(list.family_count >= 1);
        reach[k] = 0.0;
        for (size_t i = 0; i < list.family_count; ++i)
            if (list.families[i].from.r < 0.1) /* the one through the axis */
                reach[k] = list.families[i].from.r;
        fst_locked_free(&list);
    }
    assert_true(reach[0] > 0.0 && reach[1] > reach[0]);
}

/* Between two drives the orbit loses a rest: grazing is where. */
static void grazing(void **unused)
{
    (void)unused;
    fst_params params = coulomb(10.7, 0.2);
    fst_error error;
    assert_int_equal(fst_params_set(&params, "drive.omega", "0.435", &error), FST_OK);
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 0.43, 0.445);
    fst_branch branch = followed(&params, &o);
    const fst_special *s = special_near(&branch, FST_SPECIAL_GRAZING, 0.43853);
    double rests[2];
    for (int k = 0; k < 2; ++k) {
        char text[32];
        (void)snprintf(text, sizeof text, "%.17g", s->value + (k ? 1e-5 : -1e-5));
        assert_int_equal(fst_params_set(&params, "drive.omega", text, &error), FST_OK);
        rests[k] = orbit_of(&params).means.captures_per_return;
    }
    assert_true(rests[0] != rests[1]);
    for (size_t i = 0; i < branch.end_count; ++i)
        assert_int_equal(branch.ends[i].type, FST_END_RANGE);
    fst_branch_free(&branch);
}

/* A slipping lock over the drive: it folds, and ends where its slip falls to nothing on a family that rolls, at
 * that one's own end. */
static void slipping_lock_meets_rolling_ones(void **unused)
{
    (void)unused;
    fst_params params = coulomb(6.5, 0.2);
    fst_error error;
    fst_branch_options o = fst_default_branch_options();
    o.kind = FST_BRANCH_LOCKED;
    o.key = "drive.frequency";
    o.from = 6.2;
    o.to = 7.6;
    fst_branch branch = followed(&params, &o);
    int folds = 0, met = 0;
    for (size_t i = 0; i < branch.special_count; ++i)
        folds += branch.specials[i].type == FST_SPECIAL_FOLD;
    assert_true(folds >= 1);
    for (size_t i = 0; i < branch.end_count; ++i) {
        if (branch.ends[i].type != FST_END_ROLLS)
            continue;
        fst_locked_list list;
        char text[32];
        double r = NAN, nearest = INFINITY;
        for (size_t k = 0; k < branch.point_count; ++k)
            if (branch.points[k].branch == branch.ends[i].branch && branch.points[k].slip < 1e-4)
                r = branch.points[k].mean_r;
        (void)snprintf(text, sizeof text, "%.17g", branch.ends[i].value);
        assert_int_equal(fst_params_set(&params, "drive.frequency", text, &error), FST_OK);
        if (fst_locked_find(&params, NULL, &list, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        for (size_t k = 0; k < list.family_count; ++k)
            nearest = fmin(nearest, fmin(fabs(list.families[k].from.r - r), fabs(list.families[k].to.r - r)));
        CHECK_CLOSE(nearest, 0.0, 1e-3);
        met += 1;
        fst_locked_free(&list);
    }
    assert_true(met >= 1);
    fst_branch_free(&branch);
}

/* A fold followed over drive and friction at once: at an end of the curve it is the fold of the branch there.
 */
static void curve_of_folds(void **unused)
{
    (void)unused;
    const fst_params params = coulomb(7.0, 0.2), there = coulomb(7.0, 0.18);
    fst_branch_options o = fst_default_branch_options();
    o.kind = FST_BRANCH_LOCKED;
    o.key = "drive.frequency";
    o.from = 7.3;
    o.to = 7.7;
    o.second_key = "friction.mu";
    o.second_from = 0.18;
    o.second_to = 0.22;
    o.special = FST_SPECIAL_FOLD;
    fst_branch curve = followed(&params, &o);
    o.second_key = NULL;
    fst_branch branch = followed(&there, &o);
    double nearest = INFINITY, at = INFINITY;
    for (size_t i = 0; i < curve.point_count; ++i)
        if (fabs(curve.points[i].second - 0.18) < nearest) {
            nearest = fabs(curve.points[i].second - 0.18);
            at = curve.points[i].value;
        }
    CHECK_CLOSE(nearest, 0.0, 1e-12);
    nearest = INFINITY;
    for (size_t i = 0; i < branch.special_count; ++i)
        if (branch.specials[i].type == FST_SPECIAL_FOLD)
            nearest = fmin(nearest, fabs(branch.specials[i].value - at));
    CHECK_CLOSE(nearest, 0.0, 1e-7);
    fst_branch_free(&curve);
    fst_branch_free(&branch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(against_another_integrator),
                                       cmocka_unit_test(without_rests),
                                       cmocka_unit_test(exponents_against_multipliers),
                                       cmocka_unit_test(exponent_of_a_run),
                                       cmocka_unit_test(rolling_has_no_orbit),
                                       cmocka_unit_test(rolling_locks),
                                       cmocka_unit_test(locks_at_any_tolerance),
                                       cmocka_unit_test(families_grow_with_friction),
                                       cmocka_unit_test(curve_of_folds),
                                       cmocka_unit_test(grazing),
                                       cmocka_unit_test(slipping_lock_meets_rolling_ones)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
