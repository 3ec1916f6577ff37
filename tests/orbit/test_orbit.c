/* Periodic orbits and equilibria against independent numbers, against the flow itself, and against the laws of
 * the variational equations.
 * tests: orbit/search.c orbit/newton.c orbit/spectrum.c orbit/festoons.c orbit/locked.c
 * labels: numbers */
#include "numeric.h"

#include <stdio.h>

#include <festoon/festoon.h>

static fst_params scene(const char *omega, const char *dynamics)
{
    fst_params params = fst_default_params();
    fst_error error;
    assert_int_equal(fst_params_set(&params, "drive.omega", omega, &error), FST_OK);
    assert_int_equal(fst_params_set(&params, "model.dynamics", dynamics, &error), FST_OK);
    return params;
}

static fst_orbit orbit_at(const char *omega, const char *dynamics)
{
    const fst_params params = scene(omega, dynamics);
    fst_orbit orbit;
    fst_error error;
    const fst_status status = fst_orbit_find(&params, NULL, &orbit, &error);
    if (status != FST_OK)
        fail_msg("omega = %s: %s", omega, error.sentence);
    return orbit;
}

/* N from long simulations by another program, with equations written independently. */
static void festoons_of_known_patterns(void **state)
{
    (void)state;
    static const struct {
        const char *omega, *dynamics;
        double festoons;
        fst_symmetry symmetry;
    } known[] = {
        {"0.21", "rigid", 4.0412798181, FST_SYMMETRY_S1},
        {"0.25", "rigid", 5.1653784764, FST_SYMMETRY_S1},
        {"0.2845", "rigid", 11.970596631, FST_SYMMETRY_S2},
        {"0.352", "rigid", 13.6226520692, FST_SYMMETRY_S2},
        {"0.405", "rigid", 14.6553798944, FST_SYMMETRY_S2},
        {"0.21", "farago2020", 3.9982607147, FST_SYMMETRY_S1},
        {"0.25", "farago2020", 5.0446829134, FST_SYMMETRY_S1},
        {"0.352", "farago2020", 13.9543332139, FST_SYMMETRY_S2},
        {"0.405", "farago2020", 14.9806964307, FST_SYMMETRY_S2},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; ++i) {
        const fst_orbit orbit = orbit_at(known[i].omega, known[i].dynamics);
        CHECK_CLOSE(orbit.means.festoons, known[i].festoons, 1e-9);
        assert_int_equal(orbit.symmetry, known[i].symmetry);
        assert_true(orbit.stable);
        assert_true(orbit.residual < 1e-12);
        assert_true(orbit.trivial_error < 1e-10);
        assert_int_equal(orbit.turns, -1);
    }
}

/* Means and extremes of these orbits, by that other program. */
static void means_of_a_known_pattern(void **state)
{
    (void)state;
    const fst_orbit orbit = orbit_at("0.352", "rigid");
    CHECK_CLOSE(orbit.means.mean_r, 0.88687385821, 1e-10);
    CHECK_CLOSE(orbit.means.std_r, 0.01811838202091, 1e-10);
    CHECK_CLOSE(orbit.means.mean_alpha_dot, -0.06057137353924, 1e-11);
    CHECK_CLOSE(orbit.means.mean_phi_dot, 0.4125713735393, 1e-11);
    CHECK_CLOSE(orbit.means.max_angle_deg, 2.937003568996, 1e-8);
    CHECK_CLOSE(orbit.means.tilt_deg, 24.9232688979, 1e-8);
    CHECK_CLOSE(orbit.means.min_r, 0.8644869636669, 1e-10);
    CHECK_CLOSE(orbit.means.max_b, 4.332787076063, 1e-9);
    CHECK_CLOSE(orbit.means.mean_drive_power, orbit.means.mean_friction_power, 1e-14);
}

static void flow_on(const fst_params *params, double time, const double *from, double *to)
{
    fst_model *model;
    fst_flow *flow;
    fst_stop stop;
    fst_error error;
    fst_flow_options options = fst_default_flow_options();
    options.rtol = 1e-14;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = 1e-14;
    assert_int_equal(fst_model_new(params, &model, &error), FST_OK);
    assert_int_equal(fst_flow_new(model, &options, from, &flow, &error), FST_OK);
    assert_int_equal(fst_flow_next(flow, time, 0, &stop, &error), FST_OK);
    memcpy(to, fst_flow_get(flow).state, FST_STATE_SIZE * sizeof *to);
    fst_flow_free(flow);
    fst_model_free(model);
}

static double distance(const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum);
}

/* The state lies on Phi = pi/2 with Phi falling, and comes back after its period; a symmetric one comes back as
 * its image after half a turn. */
static void orbits_close(void **state)
{
    (void)state;
    static const char *const omegas[] = {"0.19", "0.25", "0.352", "1", "3"};
    for (size_t i = 0; i < sizeof omegas / sizeof *omegas; ++i) {
        const fst_orbit orbit = orbit_at(omegas[i], "rigid");
        const fst_params params = scene(omegas[i], "rigid");
        double end[FST_STATE_SIZE], image[FST_STATE_SIZE];
        CHECK_CLOSE(orbit.state[FST_X], 0.0, 1e-15);
        assert_true(orbit.state[FST_Y] > 0);
        assert_true(orbit.state[FST_VX] + orbit.means.omega * orbit.state[FST_Y] > 0);
        flow_on(&params, orbit.means.period, orbit.state, end);
        CHECK_CLOSE(distance(end, orbit.state), 0.0, 2e-11);
        flow_on(&params, 0.5 * orbit.means.period, orbit.state, end);
        fst_apply_s2(end, image);
        assert_true((distance(image, orbit.state) < 1e-11) == (orbit.symmetry == FST_SYMMETRY_S2));
    }
}

/* A small disturbance shrinks by the leading multiplier each turn. */
static void leading_multiplier_is_the_rate_of_return(void **state)
{
    (void)state;
    const fst_orbit orbit = orbit_at("0.25", "rigid");
    const fst_params params = scene("0.25", "rigid");
    double y[FST_STATE_SIZE], gap[2];
    memcpy(y, orbit.state, sizeof y);
    y[FST_Y] += 1e-4;
    for (int turn = 0; turn < 12; ++turn) {
        const double from[FST_STATE_SIZE] = {y[0], y[1], y[2], y[3], y[4], y[5], y[6], y[7], y[8], y[9]};
        flow_on(&params, orbit.means.period, from, y);
        /* only the part across the flow: the part along it does not shrink */
        fst_model *model;
        double rate[FST_STATE_SIZE], along = 0.0, speed2 = 0.0, across = 0.0;
        assert_int_equal(fst_model_new(&params, &model, NULL), FST_OK);
        fst_rhs(model, orbit.state, rate);
        fst_model_free(model);
        for (int i = 0; i < FST_STATE_SIZE; ++i) {
            along += (y[i] - orbit.state[i]) * rate[i];
            speed2 += rate[i] * rate[i];
        }
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            across += pow(y[i] - orbit.state[i] - along / speed2 * rate[i], 2);
        gap[turn % 2] = sqrt(across);
    }
    double greatest = 0.0;
    for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i)
        greatest = fmax(greatest, hypot(orbit.multiplier_re[i], orbit.multiplier_im[i]));
    CHECK_CLOSE(gap[1] / gap[0], greatest, 1e-3);
}

static void festoon_numbers_are_exact(void **state)
{
    (void)state;
    const fst_params params = scene("0.352", "rigid");
    fst_festoon_list list;
    fst_error error;
    assert_int_equal(fst_festoons_find(&params, 12.0, NULL, &list, &error), FST_OK);
    assert_int_equal(list.count, 1);
    CHECK_CLOSE(list.orbits[0].means.festoons, 12.0, 1e-10);
    char omega[32];
    (void)snprintf(omega, sizeof omega, "%.17g", list.omegas[0]);
    CHECK_CLOSE(orbit_at(omega, "rigid").means.festoons, 12.0,
                1e-9); /* found from the scene's start, without the search for N */
    fst_festoons_free(&list);
}

/* Patterns beside the origin crossing, the period halving and the fold, beyond the last point of the branch. */
static void festoons_up_to_the_ends_of_the_branch(void **state)
{
    (void)state;
    static const struct {
        double festoons, low, high;
        fst_symmetry symmetry;
    } near[] = {{3.1036, 0.178891159, 0.17890, FST_SYMMETRY_S1},
                {5.7593, 0.26884, 0.268853034, FST_SYMMETRY_S1},
                {11.5189, 0.268853034, 0.26886, FST_SYMMETRY_S2},
                {136.1, 3.3895, 3.389510252, FST_SYMMETRY_S2}};
    const fst_params params = scene("0.352", "rigid");
    fst_branch_options options = fst_default_branch_options();
    options.from = 0.17;
    options.to = 4.0;
    fst_branch branch;
    fst_festoon_list list;
    fst_error error;
    assert_int_equal(fst_branch_follow(&params, &options, &branch, &error), FST_OK);
    for (size_t i = 0; i < sizeof near / sizeof *near; ++i) {
        assert_int_equal(fst_festoons_on(&params, &branch, near[i].festoons, NULL, &list, &error), FST_OK);
        assert_int_equal(list.count, 1);
        assert_int_equal(list.orbits[0].symmetry, near[i].symmetry);
        CHECK_CLOSE(list.orbits[0].means.festoons, near[i].festoons, 1e-8);
        assert_true(list.omegas[0] > near[i].low && list.omegas[0] < near[i].high);
        fst_festoons_free(&list);
    }
    assert_int_equal(fst_festoons_on(&params, &branch, 6.0, NULL, &list, &error), FST_NO_CONVERGENCE);
    CHECK_CONTAINS(
        error.sentence,
        "N is from 3.10358 to 5.7594 on its S1 orbits; N is from 11.5188 to 136.167 on its S2 orbits");
    fst_branch_free(&branch);
}

static fst_status never(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    (void)user, (void)fraction, (void)error;
    fail_msg("the branch is followed");
    return FST_INTERRUPTED;
}

static void numbers_without_meaning_cost_no_work(void **state)
{
    (void)state;
    static const double wrong[] = {1.0, 0.0, -1.0, 1e6, 1e9, NAN, INFINITY};
    const fst_params params = fst_default_params();
    const fst_progress progress = {NULL, never};
    fst_festoon_list list;
    fst_error error;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        assert_int_equal(fst_festoons_find(&params, wrong[i], &progress, &list, &error), FST_BAD_INPUT);
        CHECK_CONTAINS(error.sentence, "greater than 1 and less than 1e6");
    }
}

/* Shooting alone would accept an equilibrium, with any time as its period. The stable locked state loses its
 * stability at omega = 0.15264, and below that swings about it decay slowly. */
static void a_locked_bead_has_no_orbit(void **state)
{
    (void)state;
    static const struct {
        const char *key, *value;
    } locked[] = {{"drive.omega", "0.05"},
                  {"drive.omega", "0.149"},
                  {"drive.omega", "0.15"},
                  {"drive.omega", "0.1525"},
                  {"model.kappa", "100"}};
    for (size_t i = 0; i < sizeof locked / sizeof *locked; ++i) {
        fst_params params = fst_default_params();
        fst_orbit orbit;
        fst_locked_list list;
        fst_error error;
        assert_int_equal(fst_params_set(&params, locked[i].key, locked[i].value, &error), FST_OK);
        if (fst_orbit_find(&params, NULL, &orbit, &error) != FST_NO_CONVERGENCE)
            fail_msg("%s = %s: an orbit of period %g", locked[i].key, locked[i].value, orbit.means.period);
        assert_int_equal(orbit.outcome, FST_ORBIT_LOCKED);
        CHECK_CONTAINS(error.sentence, "locks to the magnet");
        assert_int_equal(fst_locked_find(&params, NULL, &list, &error), FST_OK);
        assert_true(list.states[0].stable);
        fst_locked_free(&list);
    }
}

/* The outcome says where a start leads: to an orbit, off the plate, or to neither in the time given. */
static void a_start_that_leads_elsewhere(void **state)
{
    (void)state;
    static const struct {
        const char *omega, *key, *value;
        fst_orbit_outcome outcome;
    } cases[] = {{"0.3", "start.r", "0.95", FST_ORBIT_FOUND},
                 {"5", "start.r", "3", FST_ORBIT_EJECTED},
                 {"4", "start.r", "0.95", FST_ORBIT_UNSETTLED}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        fst_params params = scene(cases[i].omega, "rigid");
        fst_orbit orbit;
        fst_error error;
        assert_int_equal(fst_params_set(&params, cases[i].key, cases[i].value, &error), FST_OK);
        const fst_status status = fst_orbit_find(&params, NULL, &orbit, &error);
        assert_int_equal(orbit.outcome, cases[i].outcome);
        assert_int_equal(status, cases[i].outcome == FST_ORBIT_FOUND ? FST_OK : FST_NO_CONVERGENCE);
    }
}

static void a_libration_is_an_orbit_without_turns(void **state)
{
    (void)state;
    const fst_orbit orbit = orbit_at("0.16", "rigid");
    assert_int_equal(orbit.turns, 0);
    assert_int_equal(orbit.symmetry, FST_SYMMETRY_NONE);
    assert_true(isnan(orbit.means.festoons));
    CHECK_CLOSE(orbit.means.mean_alpha_dot, 0.16, 1e-15);
}

/* The bead turns for a while before the magnet catches it; a long run ends on the same libration. */
static void a_libration_that_catches_a_turning_bead(void **state)
{
    (void)state;
    static const char *const omegas[] = {"0.164", "0.17", "0.176"};
    for (size_t i = 0; i < sizeof omegas / sizeof *omegas; ++i) {
        const fst_params params = scene(omegas[i], "rigid");
        const fst_orbit orbit = orbit_at(omegas[i], "rigid");
        const fst_run_options options = fst_default_run_options();
        fst_run_result result;
        assert_int_equal(fst_run(&params, &options, &result, NULL), FST_OK);
        assert_int_equal(result.regime, FST_REGIME_LIBRATING);
        assert_true(orbit.stable);
        assert_int_equal(orbit.turns, 0);
        CHECK_CLOSE(orbit.means.min_r, result.min_r, 1e-9);
        CHECK_CLOSE(orbit.means.max_r, result.max_r, 1e-9);
    }
}

/* Every listed state stands still, has its image in the list, and the sum of the indices is the same at every
 * omega: states come and go in pairs of opposite index. */
static void locked_states(void **state)
{
    (void)state;
    static const char *const omegas[] = {"0.02", "0.05", "0.1", "0.15", "0.2", "0.4", "2"};
    for (size_t k = 0; k < sizeof omegas / sizeof *omegas; ++k) {
        const fst_params params = scene(omegas[k], "rigid");
        fst_locked_list list;
        fst_model *model;
        assert_int_equal(fst_locked_find(&params, NULL, &list, NULL), FST_OK);
        assert_int_equal(fst_model_new(&params, &model, NULL), FST_OK);
        if (list.index_sum != 2)
            fail_msg("omega = %s: %zu states, sum of indices %d", omegas[k], list.count, list.index_sum);
        for (size_t i = 0; i < list.count; ++i) {
            double rate[FST_STATE_SIZE], image[FST_STATE_SIZE], nearest = INFINITY;
            fst_rhs(model, list.states[i].state, rate);
            fst_apply_s2(list.states[i].state, image);
            for (int c = 0; c < FST_STATE_SIZE; ++c)
                CHECK_CLOSE(rate[c], 0.0, 1e-11);
            for (size_t j = 0; j < list.count; ++j)
                nearest = fmin(nearest, distance(image, list.states[j].state));
            CHECK_CLOSE(nearest, 0.0, 1e-8);
        }
        fst_model_free(model);
        fst_locked_free(&list);
    }
}

static void the_stable_locked_state_is_where_a_run_ends(void **state)
{
    (void)state;
    const fst_params params = scene("0.05", "rigid");
    fst_locked_list list;
    fst_run_result result;
    const fst_run_options options = fst_default_run_options();
    fst_params brief = params;
    brief.run_periods = 60;
    brief.run_discard = 40;
    assert_int_equal(fst_locked_find(&params, NULL, &list, NULL), FST_OK);
    assert_int_equal(fst_run(&brief, &options, &result, NULL), FST_OK);
    assert_int_equal(result.regime, FST_REGIME_LOCKED);
    assert_true(list.states[0].stable && list.states[1].stable && !list.states[2].stable);
    CHECK_CLOSE(list.states[0].r, result.mean_r, 1e-9);
    fst_locked_free(&list);
}

/* The exponents sum to the divergence of the flow, -7 with viscous friction; those of an orbit are the
 * logarithms of its multipliers, and those of an equilibrium the real parts of its eigenvalues. */
static void exponents(void **state)
{
    (void)state;
    fst_params params = scene("0.25", "rigid");
    params.run_periods = 150;
    params.run_discard = 100;
    fst_lyapunov l;
    assert_int_equal(fst_lyapunov_find(&params, NULL, &l, NULL), FST_OK);
    double sum = 0.0;
    for (int i = 0; i < FST_EIGENVALUE_COUNT; ++i)
        sum += l.exponents[i];
    CHECK_CLOSE(sum, -7.0, 1e-6);
    const fst_orbit orbit = orbit_at("0.25", "rigid");
    CHECK_CLOSE(l.exponents[0], 0.0, 2e-3);
    assert_int_equal(l.flow_direction, 0);
    CHECK_CLOSE(l.exponents[1], log(orbit.multiplier_re[0]) / orbit.means.period, 2e-3);
    CHECK_CLOSE(l.exponents[2], log(orbit.multiplier_re[1]) / orbit.means.period, 5e-3);
    params = scene("0.05", "rigid");
    params.run_periods = 90;
    params.run_discard = 60;
    fst_locked_list list;
    assert_int_equal(fst_lyapunov_find(&params, NULL, &l, NULL), FST_OK);
    assert_int_equal(fst_locked_find(&params, NULL, &list, NULL), FST_OK);
    double greatest = -INFINITY;
    for (int i = 0; i < FST_EIGENVALUE_COUNT; ++i)
        greatest = fmax(greatest, list.states[0].eigenvalue_re[i]);
    CHECK_CLOSE(l.exponents[0], greatest, 1e-6);
    assert_int_equal(l.flow_direction, -1);
    fst_locked_free(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(festoons_of_known_patterns),
        cmocka_unit_test(means_of_a_known_pattern),
        cmocka_unit_test(orbits_close),
        cmocka_unit_test(leading_multiplier_is_the_rate_of_return),
        cmocka_unit_test(festoon_numbers_are_exact),
        cmocka_unit_test(festoons_up_to_the_ends_of_the_branch),
        cmocka_unit_test(numbers_without_meaning_cost_no_work),
        cmocka_unit_test(a_locked_bead_has_no_orbit),
        cmocka_unit_test(a_start_that_leads_elsewhere),
        cmocka_unit_test(a_libration_is_an_orbit_without_turns),
        cmocka_unit_test(a_libration_that_catches_a_turning_bead),
        cmocka_unit_test(locked_states),
        cmocka_unit_test(the_stable_locked_state_is_where_a_run_ends),
        cmocka_unit_test(exponents),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
