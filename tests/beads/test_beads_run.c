/* Runs of several beads: what is told of opposite beads, a walker, a bar and a bead that leaves the plate, and what is
 * refused.
 *
 * tests: beads/run.c beads/seen.c beads/groups.c beads/setup.c
 * labels: numbers */
#include <festoon/beads.h>

#include "base/constants.h"
#include "physics.h"

static const double EPS = 2.5 / 23;

static fst_status run_beads(const fst_params *beads, int count, const fst_beads_options *options,
                            fst_beads_result *result, fst_error *error)
{
    const fst_beads_options usual = fst_default_beads_options();
    return fst_beads_run(beads, count, options ? options : &usual, result, error);
}

/* The result, which is the next call's too. */
static fst_beads_result *result_of(const fst_params *beads, int count, const fst_beads_options *options)
{
    static fst_beads_result result;
    fst_error error = {FST_OK, "", ""};
    fst_beads_free(&result);
    if (run_beads(beads, count, options, &result, &error) != FST_OK)
        fail_msg("fst_beads_run: %s", error.sentence);
    return &result;
}

static void check_refused(const fst_params *beads, int count, const fst_beads_options *options,
                          const char *part)
{
    static fst_beads_result result;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(run_beads(beads, count, options, &result, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, part);
}

/* Two beads at 30 Hz whose angles differ by `apart` degrees. */
static void two_beads(double apart, fst_params beads[2])
{
    for (int i = 0; i < 2; ++i) {
        beads[i] = fst_default_params();
        beads[i].drive_frequency = 30;
        beads[i].start_phi = 3 + apart * i;
        beads[i].run_periods = 100;
        beads[i].run_discard = 60;
    }
}

/* Opposite beads: two groups, each counter-rotating; one bead's numbers are those of `festoon run`. */
static void test_apart(void **unused)
{
    (void)unused;
    fst_params beads[2];
    two_beads(180, beads);
    const fst_beads_result *two = result_of(beads, 2, NULL);
    assert_int_equal(two->outcome, FST_BEADS_APART);
    assert_int_equal(two->group_count, 2);
    assert_int_equal(two->touch_count, 2); /* with the plate */
    assert_int_equal(two->event_count, 0);
    const double mean_load = two->beads[0].mean_load_weights;
    for (int i = 0; i < 2; ++i) {
        assert_int_equal(two->groups[i].kind, FST_BEAD_GROUP_SINGLE);
        assert_int_equal(two->beads[i].regime, FST_REGIME_COUNTER_ROTATING);
        CHECK_CLOSE(two->beads[i].mean_r, two->groups[i].mean_r, 1e-6);
        CHECK_CLOSE(two->beads[i].mean_alpha_dot, two->groups[i].centre_rate, 1e-9);
        CHECK_CLOSE(two->beads[i].final_state[2], EPS, 1e-15);
        assert_true(isnan(two->groups[i].axis_rate) && isnan(two->beads[i].ejected_at));
    }
    CHECK_CLOSE(two->energy_residual, 0, 1e-9);
    CHECK_CLOSE(two->beads[0].mean_alpha_dot / two->omega, -0.132, 1e-3);

    fst_run_options options = fst_default_run_options();
    fst_run_result alone;
    const fst_beads_result *one = result_of(beads, 1, NULL);
    assert_int_equal(fst_run(&beads[0], &options, &alone, NULL), FST_OK);
    CHECK_CLOSE(one->beads[0].mean_r, alone.mean_r, 1e-3);
    CHECK_CLOSE(one->beads[0].mean_alpha_dot, alone.mean_alpha_dot, 1e-4);
    CHECK_CLOSE(greatest_difference(one->beads[0].final_state, alone.final_state, 2), 0, 1e-8);
    assert_true(fabs(one->beads[0].mean_load_weights - mean_load) > 1e-4); /* the other one's field is felt */
}

/* A pair that snapped walks: its axis turns with the magnet, its centre against it. */
static void test_walker(void **unused)
{
    (void)unused;
    fst_params beads[2];
    two_beads(37, beads);
    for (int i = 0; i < 2; ++i) {
        beads[i].run_periods = 400;
        beads[i].run_discard = 200;
    }
    fst_beads_options options = fst_default_beads_options();
    options.chi = 1.243e-3;
    const fst_beads_result *r = result_of(beads, 2, &options);
    assert_int_equal(r->outcome, FST_BEADS_WALKER);
    assert_int_equal(r->group_count, 1);
    assert_int_equal(r->groups[0].kind, FST_BEAD_GROUP_PAIR);
    CHECK_CLOSE(r->groups[0].axis_rate / r->omega, 1, 1e-3);
    CHECK_CLOSE(r->groups[0].centre_rate / r->omega, -0.1211756265, 2e-3);
    CHECK_CLOSE(r->drive_power, 5.0949300e-3, 3e-5);
    CHECK_CLOSE(r->drive_power, r->plate_power + r->pair_power + r->impact_power, 1e-5);
    assert_true(r->event_count == FST_BEADS_EVENTS && r->counts[FST_BEAD_EVENT_LAND] > FST_BEADS_EVENTS / 10);
    assert_true(r->restitution == 0.0 && r->forces_unique);
    CHECK_CLOSE(r->energy_residual, 0, 1e-8);
}

/* A bar by time stepping: the same numbers, with errors of the step; and what cannot be stepped. */
static void test_bar_by_stepping(void **unused)
{
    (void)unused;
    fst_params beads[2];
    two_beads(37, beads);
    for (int i = 0; i < 2; ++i) {
        beads[i].impact_restitution = 0.8;
        beads[i].run_periods = 200;
        beads[i].run_discard = 150;
    }
    fst_beads_options options = fst_default_beads_options();
    options.chi = 1.243e-3;
    options.method = FST_BEADS_STEPPING;
    const fst_beads_result *r = result_of(beads, 2, &options);
    assert_int_equal(r->outcome, FST_BEADS_BAR);
    assert_int_equal(r->accepted, 200 * 2000);
    CHECK_CLOSE(r->groups[0].axis_rate / r->omega, 1, 1e-6);
    CHECK_CLOSE(r->drive_power / 5.53486e-5, 1, 2e-4);
    assert_int_equal(r->touch_count, 3);
    for (int i = 0; i < 2; ++i)
        CHECK_CLOSE(r->beads[i].mean_load_weights, 19.72219, 1e-3);
    CHECK_CLOSE(r->touches[2].force, 3.29360694, 1e-4);
    assert_true(r->solver_residual < 1e-7 && r->deepest < 1e-8 && r->energy_residual < 1e-2);
    options.steps_per_turn = 3;
    check_refused(beads, 2, &options, "time stepping makes 3 steps in a turn");
    options.steps_per_turn = NAN;
    check_refused(beads, 2, &options, "it needs 20 to");
}

/* The walker, whose beads land 2.25 times a turn, by time stepping: halving the step halves the errors of its radius, of its
 * drive's power and of the energy; they are below half a per cent at 1000 steps a turn. */
static void test_walker_by_stepping(void **unused)
{
    (void)unused;
    fst_params beads[2];
    two_beads(37, beads);
    for (int i = 0; i < 2; ++i) {
        beads[i].run_periods = 250;
        beads[i].run_discard = 150;
    }
    fst_beads_options options = fst_default_beads_options();
    options.chi = 1.243e-3;
    const fst_beads_result *r = result_of(beads, 2, &options);
    const double radius = r->beads[0].mean_r, power = r->drive_power, rate = r->groups[0].centre_rate;
    double wrong[2][2];
    options.method = FST_BEADS_STEPPING;
    for (int i = 0; i < 2; ++i) {
        options.steps_per_turn = i ? 4000 : 1000;
        r = result_of(beads, 2, &options);
        assert_int_equal(r->outcome, FST_BEADS_WALKER);
        wrong[i][0] = fabs(r->beads[0].mean_r / radius - 1);
        wrong[i][1] = fabs(r->drive_power / power - 1);
        CHECK_CLOSE(r->groups[0].centre_rate / rate, 1, i ? 1e-3 : 3e-3);
        CHECK_CLOSE(r->groups[0].axis_rate / r->omega, 1, 2e-3);
        CHECK_CLOSE(r->drive_power, r->plate_power + r->pair_power + r->impact_power, 2e-5);
        CHECK_CLOSE(r->energy_residual, 0, i ? 3e-5 : 3e-4);
    }
    for (int k = 0; k < 2; ++k) {
        assert_true(wrong[0][k] < 0.01);
        CHECK_CLOSE(log2(wrong[0][k] / wrong[1][k]) / 2, 1, 0.3);
    }
}

/* Restitution changes the walk: at 0.5 the mean r is 0.762 and the centre's rate -0.165 of the drive's; without friction
 * between the beads the pair walks too. */
static void test_other_walkers(void **unused)
{
    (void)unused;
    fst_params beads[2];
    fst_beads_options options = fst_default_beads_options();
    options.chi = 1.243e-3;
    two_beads(37, beads);
    for (int i = 0; i < 2; ++i) {
        beads[i].run_periods = 200;
        beads[i].run_discard = 100;
        beads[i].impact_restitution = 0.5;
    }
    const fst_beads_result *r = result_of(beads, 2, &options);
    assert_int_equal(r->outcome, FST_BEADS_WALKER);
    CHECK_CLOSE(r->beads[0].mean_r, 0.762, 1e-3);
    CHECK_CLOSE(r->groups[0].centre_rate / r->omega, -0.165, 1e-3);
    two_beads(60, beads);
    options.pair_rate = 0;
    r = result_of(beads, 2, &options);
    assert_int_equal(r->outcome, FST_BEADS_WALKER);
    assert_true(r->pair_power == 0.0 && r->plate_power > 0 && r->impact_power > 0);
}

/* The same pair with restitution 0.8 becomes a bar, which turns about the axis. */
static void test_bar(void **unused)
{
    (void)unused;
    fst_params beads[2];
    two_beads(37, beads);
    for (int i = 0; i < 2; ++i) {
        beads[i].impact_restitution = 0.8;
        beads[i].run_periods = 200;
        beads[i].run_discard = 150;
    }
    fst_beads_options options = fst_default_beads_options();
    options.chi = 1.243e-3;
    const fst_beads_result *r = result_of(beads, 2, &options);
    assert_int_equal(r->outcome, FST_BEADS_BAR);
    assert_true(isnan(r->groups[0].centre_rate) && r->groups[0].mean_r < 1e-6);
    CHECK_CLOSE(r->groups[0].axis_rate / r->omega, 1, 1e-6);
    CHECK_CLOSE(r->drive_power, 5.53486e-5, 1e-8);
    assert_int_equal(r->touch_count, 3);
    for (int i = 0; i < 2; ++i) {
        CHECK_CLOSE(r->beads[i].mean_load_weights, 19.72219, 1e-3);
        assert_int_equal(r->touches[i].beads[1], -1);
    }
    CHECK_CLOSE(r->touches[2].force, 3.29360694, 1e-5);
}

/* The opposite pair at 30 Hz, settled: <r> = 0.92580221 and alpha'/omega = -0.13233988 over whole returns, of which the
 * window of 400 turns holds no whole number. */
static void test_opposite_pair(void **unused)
{
    (void)unused;
    fst_params beads[2];
    fst_beads_options options = fst_default_beads_options();
    options.chi = 1.243e-3;
    two_beads(180, beads);
    for (int i = 0; i < 2; ++i) {
        beads[i].run_periods = 1000;
        beads[i].run_discard = 600;
    }
    const fst_beads_result *r = result_of(beads, 2, &options);
    assert_int_equal(r->outcome, FST_BEADS_APART);
    for (int i = 0; i < 2; ++i) {
        CHECK_CLOSE(r->beads[i].mean_r, 0.92580221, 1e-5);
        CHECK_CLOSE(r->beads[i].mean_alpha_dot / r->omega, -0.13233988, 2e-5);
    }
}

/* Six beads, evenly spread, fall together.  On the way a contact whose load vanishes may neither press, nor graze, nor
 * open alone: it opens together with another. */
static void test_contacts_that_open_together(void **unused)
{
    (void)unused;
    fst_params beads[6];
    for (int i = 0; i < 6; ++i) {
        beads[i] = fst_default_params();
        beads[i].drive_frequency = 30;
        beads[i].start_phi = 3 + 60.0 * i;
        beads[i].run_periods = 15;
        beads[i].run_discard = 10;
    }
    const fst_beads_result *r = result_of(beads, 6, NULL);
    assert_int_equal(r->counts[FST_BEAD_EVENT_TOUCH], 5);
    CHECK_CLOSE(r->energy_residual, 0, 1e-8);
}

/* The first bead slips and spins under much dry friction, and the second leans on it: their contacts have no consistent
 * state.  The others stand in a row, far from them. */
static const fst_beads_result *result_of_leaning(int count)
{
    static const double lean = 0.2;
    fst_params beads[8];
    double state[8 * FST_BEAD_NUMBERS] = {0};
    two_beads(180, beads);
    for (int i = 0; i < count; ++i) {
        double *bead = state + FST_BEAD_NUMBERS * i;
        beads[i] = beads[0];
        beads[i].friction_law = FST_FRICTION_COULOMB;
        beads[i].friction_mu = 3;
        bead[2] = EPS;
        bead[6] = 1;
        if (i < 2) {
            bead[0] = (i ? EPS : -EPS) * cos(lean);
            bead[2] += 2 * EPS * sin(lean) * i;
            bead[3] = -2;
            bead[10] = -15;
        } else {
            bead[0] = 2 * EPS * (i - 5);
            bead[1] = 3;
        }
    }
    fst_beads_options options = fst_default_beads_options();
    options.state = state;
    return result_of(beads, count, &options);
}

/* The run ends there and says so. */
static void test_no_state(void **unused)
{
    (void)unused;
    const fst_beads_result *r = result_of_leaning(2);
    assert_int_equal(r->outcome, FST_BEADS_UNDECIDED);
    assert_int_equal(r->paradox.motions, 0);
    assert_true(r->paradox.time == 0 && r->paradox.touch_count == 2 && r->group_count == 1);
    CHECK_CONTAINS(r->reason, "paradox: at t = 0 there is no consistent state of 2 contacts");
    CHECK_CONTAINS(r->reason, "run.method: stepping goes on");
}

/* Of many contacts not all states are tried, and the run does not say that there is none. */
static void test_no_state_found(void **unused)
{
    (void)unused;
    const fst_beads_result *r = result_of_leaning(8);
    assert_int_equal(r->outcome, FST_BEADS_UNDECIDED);
    assert_true(r->paradox.motions == 0 && r->paradox.touch_count > 10);
    CHECK_CONTAINS(r->reason, "crowded: at t = 0 no consistent state was found of ");
}

/* Behind the time `since` bead 1 should stand in the laboratory; by how much samples are ever off that. */
typedef struct stand {
    double since, place_and_n[6], worst;
    int turning, count;
} stand;

static void place_and_moment(const double *bead, double angle, double lab[6])
{
    const double c = cos(angle), s = sin(angle);
    for (int k = 0; k < 2; ++k) {
        const double *v = bead + 6 * k;
        lab[3 * k] = c * v[0] - s * v[1];
        lab[3 * k + 1] = s * v[0] + c * v[1];
        lab[3 * k + 2] = v[2];
    }
}

static fst_status watch_stand(void *user, const fst_beads_sample *sample, fst_error *error)
{
    static const double rest[3] = {0};
    stand *s = user;
    const double *bead = sample->states;
    double lab[6];
    (void)error;
    if (sample->t <= s->since)
        return FST_OK;
    place_and_moment(bead, s->turning ? FST_TWO_PI * sample->drive_turns : 0, lab);
    s->worst = fmax(s->worst, greatest_difference(lab, s->place_and_n, 6));
    s->worst = fmax(s->worst, greatest_difference(bead + 3, rest, 3));
    s->worst = fmax(s->worst, greatest_difference(bead + 9, rest, 3));
    ++s->count;
    return FST_OK;
}

/* In samples a bead that is gone stands where it went, on axes that turn, by either method, and on the laboratory's. */
static void check_stands(fst_params beads[2], fst_beads_options options)
{
    for (int i = 0; i < 3; ++i) {
        stand s = {.turning = i < 2};
        options.method = i == 1 ? FST_BEADS_STEPPING : FST_BEADS_EXACT;
        options.sample = NULL;
        beads[0].world_frame = beads[1].world_frame = i < 2 ? FST_FRAME_TURNING : FST_FRAME_LABORATORY;
        const fst_beads_result *r = result_of(beads, 2, &options);
        s.since = r->beads[0].ejected_at;
        place_and_moment(r->beads[0].final_state, s.turning ? r->omega * s.since : 0, s.place_and_n);
        options.sample = watch_stand;
        options.user = &s;
        (void)result_of(beads, 2, &options);
        assert_true(s.since > 0 && s.since < 1 && s.count > 100);
        CHECK_CLOSE(s.worst, 0, 1e-12);
    }
}

/* A plate that ends before the bead's orbit: it is ejected, the other, nearer to the axis, goes on. */
static void test_ejected(void **unused)
{
    (void)unused;
    fst_params beads[2];
    two_beads(180, beads);
    double state[2 * FST_BEAD_NUMBERS] = {0};
    for (int i = 0; i < 2; ++i) {
        double *bead = state + FST_BEAD_NUMBERS * i;
        beads[i].plate_radius = 2.0 * 23e-3;
        beads[i].run_periods = 20;
        beads[i].run_discard = 10;
        bead[0] = i ? -0.95 : 1.8;
        bead[2] = EPS;
        bead[3] = i ? 0.0 : 2.0;
        bead[6] = 1.0;
    }
    fst_beads_options options = fst_default_beads_options();
    options.state = state;
    const fst_beads_result *r = result_of(beads, 2, &options);
    assert_int_equal(r->outcome, FST_BEADS_EJECTED);
    assert_int_equal(r->beads[0].regime, FST_REGIME_EJECTED);
    assert_true(r->beads[0].ejected_at > 0 && r->beads[0].ejected_at < 1 && isnan(r->beads[0].mean_r));
    assert_true(isnan(r->beads[1].ejected_at) && r->beads[1].mean_r > 0.3 && r->group_count == 1);
    CHECK_CONTAINS(r->reason, "bead 1 passed the plate's edge");
    CHECK_CLOSE(r->energy_residual, 0, 1e-9);
    check_stands(beads, options);
}

/* chi follows from the moment of a bead of 1.2 T where nothing says another one. */
static void test_moments(void **unused)
{
    (void)unused;
    fst_params beads[2];
    two_beads(180, beads);
    fst_beads_options told = fst_default_beads_options();
    told.chi = 1.2429418375691e-3;
    const fst_bead_result usual = result_of(beads, 2, NULL)->beads[0];
    CHECK_CLOSE(greatest_difference(result_of(beads, 2, &told)->beads[0].final_state, usual.final_state, 2), 0,
                1e-9);
    told.chi = 1e-9;
    assert_true(greatest_difference(result_of(beads, 2, &told)->beads[0].final_state, usual.final_state, 2) >
                1e-3);
}

static void test_refused(void **unused)
{
    (void)unused;
    fst_params beads[9];
    fst_beads_options options = fst_default_beads_options();
    two_beads(5, beads);
    check_refused(beads, 2, NULL, "beads 1 and 2 overlap at the start");
    check_refused(beads, 9, NULL, "9 beads: the method exact takes 1 to 8");
    two_beads(180, beads);
    options.pair_rate = -1;
    check_refused(beads, 2, &options, "must not be negative");
    options.cookie = 0;
    check_refused(beads, 2, &options, "never initialised");
    beads[1].drive_frequency = 31;
    check_refused(beads, 2, NULL, "drive.frequency differs between bead 1 and bead 2");
    for (int i = 0; i < 2; ++i)
        beads[i].friction_law = FST_FRICTION_ROLLING;
    check_refused(beads, 2, NULL, "friction.law must be viscous, coulomb or none");
    two_beads(180, beads);
    beads[1].bead_material = FST_MATERIAL_MIXED;
    check_refused(beads, 2, NULL, "bead 2: several beads, or one in a world, are hard magnets");
    two_beads(180, beads);
    beads[0].model_dynamics = FST_DYNAMICS_FARAGO2020;
    check_refused(beads, 2, NULL, "model.dynamics must be rigid");
    two_beads(180, beads);
    beads[0].magnet_shape = FST_MAGNET_GRID;
    check_refused(beads, 2, NULL, "has that of one plane");
}

/* A caller who says stop is obeyed. */
static fst_status stop(void *user, double fraction, const char *what, fst_error *error)
{
    (void)user, (void)what, (void)error;
    return fraction > 0.1 ? FST_INTERRUPTED : FST_OK;
}

static void test_interrupted(void **unused)
{
    (void)unused;
    static fst_beads_result result;
    const fst_progress progress = {NULL, stop};
    fst_params beads[2];
    fst_beads_options options = fst_default_beads_options();
    options.progress = &progress;
    two_beads(180, beads);
    assert_int_equal(run_beads(beads, 2, &options, &result, NULL), FST_INTERRUPTED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_apart),
        cmocka_unit_test(test_walker),
        cmocka_unit_test(test_bar),
        cmocka_unit_test(test_other_walkers),
        cmocka_unit_test(test_ejected),
        cmocka_unit_test(test_moments),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_interrupted),
        cmocka_unit_test(test_opposite_pair),
        cmocka_unit_test(test_contacts_that_open_together),
        cmocka_unit_test(test_no_state),
        cmocka_unit_test(test_no_state_found),
        cmocka_unit_test(test_walker_by_stepping),
        cmocka_unit_test(test_bar_by_stepping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
