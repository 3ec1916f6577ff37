/* fst_run() against the paper's Table 1 and the numbers of an independent implementation; and its means,
 * extremes and samples against their definitions.
 * tests: study/run.c study/simulation.c observe/returns.c */
#include "physics.h"

#include "reference_runs.h"

/* ------------------------------------------------------------------ against published and independent numbers
 */

/* Runs shared by several tests: [dynamics][drive of the reference table]. */
static fst_run_result results[2][REFERENCE_RUNS];

static const fst_run_result *reference_of(int dynamics)
{
    return dynamics == FST_DYNAMICS_RIGID ? REFERENCE_RIGID : REFERENCE_FARAGO2020;
}

static int run_all(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics)
        for (int i = 0; i < REFERENCE_RUNS; ++i) {
            const fst_params p = bead_at(reference_of(dynamics)[i].omega, (fst_dynamics)dynamics);
            const fst_run_options options = fst_default_run_options();
            if (fst_run(&p, &options, &results[dynamics][i], NULL) != FST_OK)
                return -1;
        }
    return 0;
}

/* The paper's Table 1: numbers of festoons, within 1.2 % for the equations as printed, and the symmetries. */
static void test_table_1(void **unused)
{
    (void)unused;
    static const struct {
        double omega, festoons;
        fst_symmetry symmetry;
    } published[] = {{0.21, 3.98, FST_SYMMETRY_S1},
                     {0.25, 5.03, FST_SYMMETRY_S1},
                     {0.2845, 5.99, FST_SYMMETRY_S1},
                     {0.352, 13.98, FST_SYMMETRY_S2},
                     {0.405, 14.96, FST_SYMMETRY_S2}};
    int found = 0;
    for (int row = 0; row < 5; ++row)
        for (int i = 0; i < REFERENCE_RUNS; ++i) {
            const fst_run_result *r = &results[FST_DYNAMICS_FARAGO2020][i];
            if (r->omega != published[row].omega)
                continue;
            CHECK_CLOSE(r->festoons, published[row].festoons, 0.012 * published[row].festoons);
            assert_int_equal(r->symmetry, published[row].symmetry);
            assert_int_equal(r->regime, FST_REGIME_COUNTER_ROTATING);
            ++found;
        }
    assert_int_equal(found, 5);
}

static void check_number(const char *name, double omega, double actual, double expected, double tolerance)
{
    const double allowed = tolerance * fmax(1.0, fabs(expected));
    if (!(fabs(actual - expected) <= allowed))
        fail_msg("omega %g: %s = %.15g, reference %.15g, off by %.3g", omega, name, actual, expected,
                 actual - expected);
}

/* Every number of the reference table: means to a relative 1e-10, extremes and angles to 1e-8; a thousand times
 * worse close to the period halving, where the motion still relaxes. */
static void test_reference_runs(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics)
        for (int i = 0; i < REFERENCE_RUNS; ++i) {
            const fst_run_result *r = &results[dynamics][i], *reference = &reference_of(dynamics)[i];
            const double tolerance = dynamics == FST_DYNAMICS_FARAGO2020 && r->omega == 0.2845 ? 1e-6 : 1e-9;
            assert_int_equal(r->regime, reference->regime);
            assert_int_equal(r->symmetry, reference->symmetry);
#define COMPARE(name) check_number(#name, r->omega, r->name, reference->name, tolerance);
            REFERENCE_LIST(COMPARE)
        }
}

/* Error bars cover what is left of the transient; where the orbit has closed only the tolerance is left. */
static void test_errors_of_the_means(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics)
        for (int i = 0; i < REFERENCE_RUNS; ++i) {
            const fst_run_result *r = &results[dynamics][i];
            const int relaxing = dynamics == FST_DYNAMICS_FARAGO2020 && r->omega == 0.2845;
            CHECK_WITHIN(r->mean_r_error, 0, relaxing ? 1e-7 : 1e-9);
            CHECK_WITHIN(r->mean_alpha_dot_error, 0, relaxing ? 1e-7 : 1e-9);
            CHECK_WITHIN(r->mean_nz_error, 0, relaxing ? 1e-6 : 1e-9);
        }
}

/* Two runs that differ in tolerance alone agree in every mean. */
static void test_means_do_not_depend_on_the_tolerance(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        fst_params p = bead_at(dynamics ? 0.25 : 0.405, (fst_dynamics)dynamics);
        p.run_periods = 300;
        p.run_rtol = 1e-9;
        const fst_run_result loose = run_of(&p);
        p.run_rtol = 1e-12;
        const fst_run_result tight = run_of(&p);
        assert_int_equal(loose.regime, tight.regime);
        assert_int_equal(loose.symmetry, tight.symmetry);
#define AGREE(name) check_number(#name, p.drive_omega, loose.name, tight.name, 1e-8);
        REFERENCE_LIST(AGREE)
        CHECK_WITHIN(loose.norm_drift / tight.norm_drift, 200, 5000);
    }
}

/* ------------------------------------------------------------------ samples */

typedef struct collected {
    int count, capacity, stop_after;
    fst_sample *samples;
} collected;

static fst_status collect(void *user, const fst_sample *sample, fst_error *error)
{
    (void)error;
    collected *c = user;
    if (c->stop_after && c->count >= c->stop_after)
        return FST_INTERRUPTED;
    assert_true(c->count < c->capacity);
    c->samples[c->count++] = *sample;
    return FST_OK;
}

static fst_status run_collecting(const fst_params *p, double sample_from, int stop_after, collected *c,
                                 fst_run_result *result)
{
    c->capacity = 2 + (int)(p->run_periods * p->run_samples);
    c->count = 0;
    c->stop_after = stop_after;
    c->samples = test_calloc((size_t)c->capacity, sizeof *c->samples);
    fst_run_options options = fst_default_run_options();
    options.sink.user = c;
    options.sink.sample = collect;
    options.sample_from = sample_from;
    return fst_run(p, &options, result, NULL);
}

/* Samples lie at exact fractions of the drive period, and their columns agree: the laboratory's numbers with
 * those of the turning frame, alpha with Phi plus the drive's phase, the observation with the state. Sampling
 * changes no bit of the motion. */
static void test_samples(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.run_periods = 60;
    p.run_discard = 20;
    p.run_samples = 7;
    fst_model *model = model_of(&p);
    collected c;
    fst_run_result watched;
    assert_int_equal(run_collecting(&p, 0, 0, &c, &watched), FST_OK);
    assert_int_equal(c.count, 60 * 7 + 1);
    for (int i = 0; i < c.count; ++i) {
        const fst_sample *s = &c.samples[i];
        CHECK_CLOSE(s->drive_turns, i / 7.0, 1e-13);
        CHECK_CLOSE(s->t, i / 7.0 * TWO_PI / 0.405, 1e-12);
        CHECK_CLOSE(s->omega, 0.405, 0);
        CHECK_CLOSE(s->alpha, s->bead_angle + TWO_PI * s->drive_turns, 1e-12);
        const double r = hypot(s->x, s->y);
        CHECK_CLOSE(s->x, r * cos(s->alpha), 1e-12);
        CHECK_CLOSE(s->y, r * sin(s->alpha), 1e-12);
        double lab[FST_STATE_SIZE];
        turn_state(s->state, TWO_PI * s->drive_turns, lab);
        CHECK_CLOSE(hypot(s->x - lab[FST_X], s->y - lab[FST_Y]), 0, 1e-12);
        CHECK_CLOSE(greatest_difference(s->v_lab, lab + FST_VX, 2), 0, 1e-12);
        CHECK_CLOSE(greatest_difference(s->n_lab, lab + FST_NX, 3), 0, 1e-12);
        CHECK_CLOSE(greatest_difference(s->w_lab, lab + FST_WX, 3), 0, 1e-11);
        const fst_observation o = fst_observe(model, s->state);
        CHECK_CLOSE(s->seen.r, o.r, 0);
        CHECK_CLOSE(s->seen.energy, o.energy, 0);
        CHECK_CLOSE(s->seen.drive_power, o.drive_power, 0);
        if (i > 0)
            CHECK_WITHIN(s->bead_angle - c.samples[i - 1].bead_angle, -TWO_PI / 4, 0);
    }
    const fst_run_result alone = run_of(&p);
    assert_memory_equal(alone.final_state, watched.final_state, sizeof alone.final_state);
    assert_memory_equal(alone.final_state, c.samples[c.count - 1].state, sizeof alone.final_state);
    assert_true(alone.mean_r == watched.mean_r && alone.max_b == watched.max_b);
    test_free(c.samples);
    fst_model_free(model);
}

static fst_status greatest_load(void *user, const fst_sample *sample, fst_error *error)
{
    (void)error;
    double *greatest = user;
    *greatest = fmax(*greatest, sample->seen.load);
    return FST_OK;
}

/* At this drive the load is greatest in a wide gap between the stages of a step. */
static void test_extreme_between_distant_stages(void **unused)
{
    (void)unused;
    fst_params p = bead_at(1.003125, FST_DYNAMICS_RIGID);
    p.run_periods = 60;
    p.run_discard = 20;
    p.run_rtol = 1e-8;
    p.run_samples = 4000;
    double sampled = 0;
    fst_run_options options = fst_default_run_options();
    options.sample_from = p.run_discard;
    options.sink.user = &sampled;
    options.sink.sample = greatest_load;
    fst_run_result r;
    assert_int_equal(fst_run(&p, &options, &r, NULL), FST_OK);
    fst_model *model = model_of(&p);
    const double gravity = fst_model_groups(model).gravity;
    fst_model_free(model);
    CHECK_WITHIN(r.max_load_weights * gravity / sampled, 1 - 1e-9, 1 + 2e-5);
}

/* Phi and alpha are continuous from the first sample on, also if the start has Phi = 180 degrees. */
static void test_samples_from_half_a_turn(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.start_phi = 180;
    p.run_periods = 3;
    p.run_discard = 0;
    collected c;
    fst_run_result result;
    assert_int_equal(run_collecting(&p, 0, 0, &c, &result), FST_OK);
    for (int i = 1; i < c.count; ++i)
        CHECK_WITHIN(c.samples[i].bead_angle - c.samples[i - 1].bead_angle, -1, 0);
    test_free(c.samples);
}

/* Means by the trapezoidal rule and extremes of samples, over whole turns of Phi. */
typedef struct brute {
    double weight, r, b, b2, nz, power, load, slip2;
    double least_r, most_r, least_b, most_b, most_angle, most_slip, most_load;
} brute;

/* The weight of an interval between samples: the part of it between the first and the last passage of Phi,
 * which falls, through a multiple of 2 pi. */
static void add_interval(brute *sum, const fst_sample *a, const fst_sample *b, double first_turn,
                         double last_turn)
{
    const double from = a->bead_angle / TWO_PI, to = b->bead_angle / TWO_PI;
    const double high = fmin(from, first_turn), low = fmax(to, last_turn);
    if (high <= low)
        return;
    const double f = 0.5 * (high - low) / (from - to);
    const fst_observation *const ends[] = {&a->seen, &b->seen};
    for (int i = 0; i < 2; ++i) {
        const fst_observation *o = ends[i];
        sum->weight += f;
        sum->r += f * o->r;
        sum->b += f * o->b_norm;
        sum->b2 += f * o->b_norm * o->b_norm;
        sum->nz += f * o->n[2];
        sum->power += f * o->friction_power;
        sum->load += f * o->load;
        sum->slip2 += f * o->slip_norm * o->slip_norm;
    }
}

static brute brute_force(const collected *c)
{
    brute sum = {.least_r = INFINITY, .least_b = INFINITY};
    const double first_turn = floor(c->samples[0].bead_angle / TWO_PI);
    const double last_turn = ceil(c->samples[c->count - 1].bead_angle / TWO_PI);
    for (int i = 0; i < c->count; ++i) {
        const fst_observation *o = &c->samples[i].seen;
        sum.least_r = fmin(sum.least_r, o->r);
        sum.most_r = fmax(sum.most_r, o->r);
        sum.least_b = fmin(sum.least_b, o->b_norm);
        sum.most_b = fmax(sum.most_b, o->b_norm);
        sum.most_angle = fmax(sum.most_angle, o->angle);
        sum.most_slip = fmax(sum.most_slip, o->slip_norm);
        sum.most_load = fmax(sum.most_load, o->load);
        if (i > 0)
            add_interval(&sum, &c->samples[i - 1], &c->samples[i], first_turn, last_turn);
    }
    return sum;
}

/* The orbit has closed, so any whole number of returns has the same means. Samples a 2048th of a period apart
 * miss an extreme by at most about 4e-6 of the oscillation. */
static void test_means_and_extremes_by_brute_force(void **unused)
{
    (void)unused;
    for (int dynamics = 0; dynamics < 2; ++dynamics) {
        fst_params p = bead_at(dynamics ? 0.21 : 0.352, (fst_dynamics)dynamics);
        p.run_periods = 260;
        p.run_discard = 220;
        p.run_samples = 2048;
        fst_model *model = model_of(&p);
        const double gravity = fst_model_groups(model).gravity;
        fst_model_free(model);
        collected c;
        fst_run_result r;
        assert_int_equal(run_collecting(&p, 220, 0, &c, &r), FST_OK);
        assert_int_equal(c.count, 40 * 2048 + 1);
        const brute sum = brute_force(&c);
        const double weight = sum.weight, mean_b = sum.b / weight;
        CHECK_CLOSE(r.mean_r, sum.r / weight, 1e-7);
        CHECK_CLOSE(r.mean_b, mean_b, 1e-6);
        CHECK_CLOSE(r.std_b, sqrt(sum.b2 / weight - mean_b * mean_b), 1e-6);
        CHECK_CLOSE(r.mean_nz, sum.nz / weight, 1e-6);
        CHECK_CLOSE(r.mean_friction_power, sum.power / weight, 1e-9);
        CHECK_CLOSE(r.rms_slip, sqrt(sum.slip2 / weight), 1e-8);
        CHECK_CLOSE(r.mean_load_weights, sum.load / weight / gravity, 1e-5);
        CHECK_WITHIN(sum.least_r - r.min_r, -1e-12, 1e-6);
        CHECK_WITHIN(r.max_r - sum.most_r, -1e-12, 1e-6);
        CHECK_WITHIN(sum.least_b - r.min_b, -1e-12, 2e-6);
        CHECK_WITHIN(r.max_b - sum.most_b, -1e-12, 2e-6);
        CHECK_WITHIN(r.max_angle_deg - DEGREES * sum.most_angle, -1e-10, 1e-4);
        CHECK_WITHIN(r.max_slip - sum.most_slip, -1e-12, 1e-6);
        CHECK_WITHIN(r.max_load_weights - sum.most_load / gravity, -1e-10, 1e-4);
        test_free(c.samples);
    }
}

/* A callback that fails ends the run with its status, and the samples until then are kept. */
static void test_interruption(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    collected c;
    fst_run_result result;
    assert_int_equal(run_collecting(&p, 0, 64 * 50 + 1, &c, &result), FST_INTERRUPTED);
    assert_int_equal(c.count, 64 * 50 + 1);
    CHECK_WITHIN(result.periods, 50, 50.3);
    CHECK_CLOSE(c.samples[c.count - 1].drive_turns, 50, 1e-12);
    assert_true(isnan(result.mean_r) && result.regime == FST_REGIME_UNDECIDED);
    assert_non_null(strstr(result.reason, "interrupted"));
    test_free(c.samples);
    assert_int_equal(run_collecting(&p, 0, 64 * 300 + 1, &c, &result), FST_INTERRUPTED);
    CHECK_CLOSE(result.mean_r, reference_of(FST_DYNAMICS_RIGID)[4].mean_r, 1e-8);
    test_free(c.samples);
}

/* ------------------------------------------------------------------ windows */

/* Without a discard the window is the whole run, and the error bars cover the transient. */
static void test_no_discard(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.run_discard = 0;
    const fst_run_result all = run_of(&p);
    const double mean_r = results[FST_DYNAMICS_RIGID][4].mean_r;
    CHECK_WITHIN(fabs(all.mean_r - mean_r), 1e-6, 1e-3);
    CHECK_WITHIN(all.mean_r_error, 1e-6, 1e-3);
    CHECK_CLOSE(all.mean_r, mean_r, 4 * all.mean_r_error);
    CHECK_WITHIN(all.window_periods, 398, 400);
    p.start_phi = 180; /* the same motion by the symmetry S2, but for the sign of <n_z> */
    const fst_run_result turned = run_of(&p);
    CHECK_CLOSE(turned.mean_alpha_dot, all.mean_alpha_dot, 1e-4);
}

/* Stops the run after so many calls. */
static fst_status stop_soon(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    int *left = user;
    assert_true(fraction >= 0 && fraction <= 1);
    (void)error;
    return --*left > 0 ? FST_OK : FST_INTERRUPTED;
}

/* A run of any length reports progress, ends when told to, and overflows no counter. */
static void test_huge_runs_can_be_stopped(void **unused)
{
    (void)unused;
    for (int i = 0; i < 4; ++i) {
        fst_params p = bead_at(0.35, FST_DYNAMICS_RIGID);
        p.run_periods = 1e9;
        p.run_discard = i % 2 ? 0 : 999999999;
        p.run_samples = 100000;
        fst_run_options options = fst_default_run_options();
        int left = 40;
        const fst_progress progress = {&left, stop_soon};
        options.progress = &progress;
        if (i >= 2) {
            options.ramp_from = 0.35;
            options.ramp_to = 0.20;
            options.ramp_points = 1000000;
            options.ramp_wait = i == 2 ? 0 : 1e6;
        }
        fst_run_result result;
        assert_int_equal(fst_run(&p, &options, &result, NULL), FST_INTERRUPTED);
        assert_int_equal(left, 0);
        assert_non_null(strstr(result.reason, "interrupted"));
    }
}

typedef struct refusal {
    int refused, told_again;
} refusal;

/* Refuses once, past the middle, and notes whether it is called again. */
static fst_status refuse_once(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    refusal *r = user;
    r->told_again += r->refused;
    if (r->refused || fraction < 0.6)
        return FST_OK;
    r->refused = 1;
    error->code = FST_INTERRUPTED; /* always valid, although this caller of fst_run() passes no error */
    return FST_INTERRUPTED;
}

/* A run that was told to end reports nothing more, although its motion, a libration, would need the largest
 * exponent. */
static void test_refused_runs_are_silent(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    assert_int_equal(fst_params_set(&p, "model.kappa", "1.5", NULL), FST_OK);
    assert_int_equal(fst_params_set(&p, "drive.frequency", "5.5 Hz", NULL), FST_OK);
    assert_int_equal(run_of(&p).regime, FST_REGIME_LIBRATING);
    fst_run_options options = fst_default_run_options();
    refusal refused = {0, 0};
    const fst_progress progress = {&refused, refuse_once};
    options.progress = &progress;
    fst_run_result result;
    assert_int_equal(fst_run(&p, &options, &result, NULL), FST_INTERRUPTED);
    assert_int_equal(refused.refused, 1);
    assert_int_equal(refused.told_again, 0);
    assert_true(isnan(result.largest_exponent));
}

/* Returns are half turns of Phi: two in each mean period of the window. */
static void test_returns_are_counted(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    const fst_run_result r = run_of(&p);
    const double half_turns = 2 * r.window_periods * TWO_PI / r.omega / r.period;
    CHECK_WITHIN((double)r.returns, half_turns, half_turns + 3);
}

/* ------------------------------------------------------------------ bad input */

static void test_bad_options(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    fst_run_result result;
    fst_error error = {FST_OK, "", ""};
    fst_run_options options;
    memset(&options, 0, sizeof options);
    assert_int_equal(fst_run(&p, &options, &result, &error), FST_BAD_INPUT);
    options = fst_default_run_options();
    options.ramp_from = 0.3;
    assert_int_equal(fst_run(&p, &options, &result, &error), FST_BAD_INPUT);
    options.ramp_to = -0.3;
    assert_int_equal(fst_run(&p, &options, &result, &error), FST_BAD_INPUT);
    options = fst_default_run_options();
    p.start_r = 11;
    assert_int_equal(fst_run(&p, &options, &result, &error), FST_BAD_INPUT);
    p = fst_default_params();
    p.run_discard = 400;
    assert_int_equal(fst_run(&p, &options, &result, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "run.discard"));
    assert_true(isnan(result.mean_r));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table_1),
        cmocka_unit_test(test_reference_runs),
        cmocka_unit_test(test_errors_of_the_means),
        cmocka_unit_test(test_means_do_not_depend_on_the_tolerance),
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_samples_from_half_a_turn),
        cmocka_unit_test(test_extreme_between_distant_stages),
        cmocka_unit_test(test_means_and_extremes_by_brute_force),
        cmocka_unit_test(test_interruption),
        cmocka_unit_test(test_no_discard),
        cmocka_unit_test(test_huge_runs_can_be_stopped),
        cmocka_unit_test(test_refused_runs_are_silent),
        cmocka_unit_test(test_returns_are_counted),
        cmocka_unit_test(test_bad_options),
    };
    return cmocka_run_group_tests_name("run", tests, run_all, NULL);
}
