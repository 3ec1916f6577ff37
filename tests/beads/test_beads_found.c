/* What a start of several beads leads to: locked bars, the orbit of an opposite pair, the drives at which bars sway or
 * break, and refusals.
 *
 * tests: orbit/beads_scene.c orbit/beads_orbit.c orbit/beads_branch.c
 * labels: numbers */
#include "some_beads.h"

static const double EPS = 2.5 / 23;

/* A row of beads near the axis, at rest and nearly in touch, with moments along the field. */
static void bar(int count, fst_params *beads, fst_beads_options *options)
{
    *options = fst_default_beads_options();
    options->chi = CHI;
    for (int i = 0; i < count; ++i) {
        beads[i] = at_30_hz();
        const double x = (2.2 * i - 1.1 * (count - 1)) * EPS;
        beads[i].start_r = fabs(x);
        beads[i].start_phi = x < 0 ? 180 : 0;
        beads[i].start_spin = FST_SPIN_REST;
        beads[i].run_periods = 100;
    }
}

static void test_bar(void **unused)
{
    (void)unused;
    fst_params beads[3];
    fst_beads_locked locked;
    fst_error error = {FST_OK, "", ""};
    fst_beads_options options;
    bar(3, beads, &options);
    if (fst_beads_locked_find(beads, 3, &options, &locked, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    CHECK_CLOSE((locked.state[1][2] / EPS - 1) / 2, 0.05165622, 5e-9);
    CHECK_CLOSE(locked.load_weights[0], 30.21196, 5e-6);
    CHECK_CLOSE(locked.load_weights[1], 0, 0);
    CHECK_CLOSE(locked.power, 1.830241e-4, 5e-11);
    CHECK_CLOSE(fabs(locked.phi_deg[2] - locked.phi_deg[0]), 180, 1e-5);
    assert_int_equal(locked.touch_count, 4);
    for (int i = 0; i < 4; ++i)
        if (locked.touches[i].beads[1] >= 0)
            CHECK_CLOSE(locked.touches[i].force, 3.46217435, 5e-9);
    assert_true(locked.stable && locked.forces_unique);
    assert_int_equal(locked.eigenvalues, 25);
    assert_int_equal(locked.free, 0);
}

static void opposite(double apart, fst_params *beads, fst_beads_options *options)
{
    *options = fst_default_beads_options();
    options->chi = CHI;
    for (int i = 0; i < 2; ++i) {
        beads[i] = at_30_hz();
        beads[i].start_phi = 3 + apart * i;
        beads[i].run_periods = 30;
    }
}

static void test_pair(void **unused)
{
    (void)unused;
    fst_params beads[2];
    fst_beads_orbit orbit;
    fst_error error = {FST_OK, "", ""};
    fst_beads_options options;
    opposite(180, beads, &options);
    if (fst_beads_orbit_find(beads, 2, &options, &orbit, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    assert_true(orbit.exchanges && orbit.stable);
    for (int i = 0; i < 2; ++i) {
        CHECK_CLOSE(orbit.mean_r[i], 0.92580221093, 5e-12);
        CHECK_CLOSE(orbit.mean_alpha_dot[i] / orbit.omega, -0.13233987620, 5e-12);
    }
    CHECK_CLOSE(fabs(orbit.multiplier_re[0]), 0.9991387, 5e-8);
    CHECK_CLOSE(orbit.drive_power, orbit.plate_power + orbit.pair_power, 1e-12);
}

/* At 26 Hz opposition is unstable, and a pair at about 171 degrees is stable. */
static void test_pair_aside(void **unused)
{
    (void)unused;
    fst_params beads[2];
    fst_beads_orbit orbit;
    fst_error error = {FST_OK, "", ""};
    fst_beads_options options;
    opposite(180, beads, &options);
    beads[0].drive_frequency = beads[1].drive_frequency = 26;
    assert_int_equal(fst_beads_orbit_find(beads, 2, &options, &orbit, &error), FST_OK);
    assert_true(orbit.exchanges && !orbit.stable);
    beads[1].start_phi = 173;
    assert_int_equal(fst_beads_orbit_find(beads, 2, &options, &orbit, &error), FST_OK);
    assert_true(!orbit.exchanges && orbit.stable);
    const double *a = orbit.state[0], *b = orbit.state[1];
    CHECK_CLOSE(fabs(beads_turned_by(a, b)) * 360 / TURN, 171, 2);
}

static void test_refusals(void **unused)
{
    (void)unused;
    fst_params beads[2];
    fst_beads_orbit orbit;
    fst_beads_locked locked;
    fst_beads_branch branch;
    fst_error error;
    fst_beads_options options;
    opposite(50, beads, &options);
    assert_int_equal(fst_beads_orbit_find(beads, 2, &options, &orbit, &error), FST_NO_CONVERGENCE);
    assert_non_null(strstr(error.sentence, "run.periods"));
    opposite(180, beads, &options);
    assert_int_equal(fst_beads_locked_find(beads, 2, &options, &locked, &error), FST_NO_CONVERGENCE);
    assert_non_null(strstr(error.sentence, "no state in which they turn with the magnet"));
    assert_int_equal(fst_beads_branch_follow(beads, 2, &options, "drive.frequency", 3, 3, &branch, &error),
                     FST_BAD_INPUT);
    beads[0].friction_law = beads[1].friction_law = FST_FRICTION_COULOMB;
    assert_int_equal(fst_beads_locked_find(beads, 2, &options, &locked, &error), FST_BAD_INPUT);
    options.cookie = 0;
    assert_int_equal(fst_beads_locked_find(beads, 2, &options, &locked, &error), FST_BAD_INPUT);
}

/* Whether a bar of two parts within six turns of this drive, from a locked state. */
static int parts(const fst_beads_locked *at, double frequency)
{
    fst_params params = at_30_hz();
    fst_error error;
    double state[BEADS_NUMBERS];
    params.drive_frequency = frequency;
    fst_model *model = model_of(&params);
    const beads_world world = paper_beads(2, model, 1.0);
    memcpy(state, at->state, sizeof(double[2][FST_BEAD_NUMBERS]));
    for (int i = 0; i < 2; ++i)
        bead_of(state, i)[2] -= EPS;
    beads_flow *flow = begin_beads(&world, state, 1e-10);
    while (flow->t.high < 6 * TURN / world.omega && flow->counts[FST_BEAD_EVENT_PART] == 0)
        assert_int_equal(beads_go(flow, 6 * TURN / world.omega, &error), FST_OK);
    const int parted = flow->counts[FST_BEAD_EVENT_PART] > 0;
    free(flow);
    fst_model_free(model);
    return parted;
}

/* A bar of two breaks where its contact force falls to 0; before that it sways in a window between two Hopf points. */
static void test_branch(void **unused)
{
    (void)unused;
    fst_params beads[2];
    fst_beads_branch branch;
    fst_error error = {FST_OK, "", ""};
    fst_beads_options options;
    bar(2, beads, &options);
    if (fst_beads_branch_follow(beads, 2, &options, "drive.frequency", 10, 400, &branch, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    assert_int_equal(branch.special_count, 3);
    for (int i = 0; i < 2; ++i) {
        const fst_beads_locked *at = &branch.specials[i].at;
        assert_int_equal(branch.specials[i].type, FST_SPECIAL_HOPF);
        CHECK_CLOSE(at->eigenvalue_re[0], 0, 1e-9);
        assert_true(at->eigenvalue_im[0] > 0);
    }
    const fst_beads_special *breaks = &branch.specials[2];
    assert_int_equal(breaks->type, FST_SPECIAL_CONTACT);
    assert_int_equal(branch.ends[0].type, FST_END_RANGE);
    assert_int_equal(branch.ends[1].type, FST_END_CONTACT);
    CHECK_CLOSE(breaks->at.touches[2].force, 0, 1e-10);
    for (size_t i = 0; i < branch.point_count; ++i) {
        const int sways =
            branch.values[i] > branch.specials[0].value && branch.values[i] < branch.specials[1].value;
        assert_int_equal(branch.points[i].stable, !sways);
        assert_true(i == 0 || branch.values[i] > branch.values[i - 1]);
    }
    const size_t before = branch.point_count - 2;
    assert_false(parts(&branch.points[before], branch.values[before]));
    assert_true(parts(&breaks->at, 1.005 * breaks->value));
    fst_beads_branch_free(&branch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bar), cmocka_unit_test(test_pair),
                                       cmocka_unit_test(test_pair_aside), cmocka_unit_test(test_refusals),
                                       cmocka_unit_test(test_branch)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
