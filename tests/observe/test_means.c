/* Means and their errors, from marks made by hand whose means are known; and the powers on a ramp and the
 * extremes of a window, against the path itself.
 * tests: observe/means.c observe/marks.c */
#include "physics.h"

#include "observe/means.h"
#include "study/conclude.h"

/* ------------------------------------------------------------------ marks made by hand */

enum { BLOCKS = 12 };
static const double SPAN = 7.5; /* duration of a block */

typedef struct by_hand {
    fst_watched_run run;
    fst_params params;
    fst_mark_series marks;
} by_hand;

/* A run that has not begun, with marks at which every integral is zero. */
static by_hand *begin(void)
{
    by_hand *b = test_calloc(1, sizeof *b);
    fst_error error = {FST_OK, "", ""};
    b->params = bead_at(0.31, FST_DYNAMICS_RIGID);
    if (fst_watched_run_begin(&b->run, &b->params, NULL, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    fst_marks_begin(&b->marks);
    for (int i = 0; i <= BLOCKS; ++i) {
        fst_mark mark;
        memset(&mark, 0, sizeof mark);
        mark.t.high = 100.0 + SPAN * i;
        mark.omega = 0.31;
        fst_marks_offer(&b->marks, &mark);
    }
    return b;
}

static fst_run_result conclude(by_hand *b)
{
    fst_run_result result;
    fst_result_clear(&result);
    b->marks.latest = b->marks.kept[BLOCKS];
    fst_means_fill(&b->run.window, &b->marks, &b->params, &result);
    fst_watched_run_free(&b->run);
    test_free(b);
    return result;
}

/* Give a quantity the mean `value` in every block. */
static void fill(by_hand *b, int which, double value)
{
    for (int i = 0; i <= BLOCKS; ++i)
        b->marks.kept[i].integrals[which] = value * SPAN * i;
}

/* Blocks that scatter without a drift: the error is twice their standard deviation over the root of their
 * number, which 95 of 100 means keep. */
static void test_errors_from_the_scatter_of_blocks(void **unused)
{
    (void)unused;
    static const double scatter[BLOCKS] = {1, -1, 0.4, -0.4, 0.9, -0.9, -0.6, 0.6, 1.1, -1.1, -0.2, 0.2};
    const double mean = 0.83, size = 1e-3;
    by_hand *b = begin();
    double sum = 0.0, sum2 = 0.0;
    for (int i = 0; i < BLOCKS; ++i) {
        b->marks.kept[i + 1].integrals[FST_Q_R] =
            b->marks.kept[i].integrals[FST_Q_R] + SPAN * (mean + size * scatter[i]);
        sum += scatter[i];
        sum2 += scatter[i] * scatter[i];
    }
    const double deviation = size * sqrt((sum2 - sum * sum / BLOCKS) / (BLOCKS - 1));
    const fst_run_result r = conclude(b);
    CHECK_CLOSE(r.mean_r, mean + size * sum / BLOCKS, 1e-14);
    CHECK_CLOSE(r.mean_r_error / (deviation / sqrt(BLOCKS)), 2.0, 1e-9);
}

/* Of a chaotic motion, whose halves tell of how far later ones may lie: their difference, in each sense, unless it is
 * beyond all that n_z may be. */
static void test_errors_of_halves(void **unused)
{
    (void)unused;
    const fst_params p = fst_default_params();
    by_hand *b = begin();
    fst_run_result r;
    fst_result_clear(&r);
    for (int i = 0; i <= BLOCKS; ++i) {
        const double past = i > BLOCKS / 2 ? i - BLOCKS / 2 : 0; /* blocks of the second half */
        b->marks.kept[i].integrals[FST_Q_R] = SPAN * (0.8 * i - 0.03 * past);
        b->marks.kept[i].integrals[FST_Q_N_Z] = SPAN * (0.9 * i - 1.8 * past);
        b->marks.kept[i].bead_angle = SPAN * (-0.2 * i + 0.01 * past);
    }
    b->marks.latest = b->marks.kept[BLOCKS];
    r.mean_nz = 0.25;
    fst_means_of_chaos(&b->run.window, &b->marks, &p, &r);
    CHECK_CLOSE(r.mean_r_error, 0.03, 1e-12);
    CHECK_CLOSE(r.mean_alpha_dot_error, 0.01, 1e-12);
    CHECK_CLOSE(r.mean_nz_error, 1.25, 1e-12);
    fst_watched_run_free(&b->run);
    test_free(b);
}

/* Thirds of chaos that go one way by chance are no drift: the error is that of scattered blocks.  Of a drift that is more
 * than chance it is the range of the blocks at most, because a series through the thirds ends anywhere. */
static void test_chaos_that_seems_to_drift(void **unused)
{
    (void)unused;
    static const double scatter[BLOCKS] = {1, -1, 0.4, -0.4, 0.9, -0.9, -0.6, 0.6, 1.1, -1.1, -0.2, 0.2};
    const fst_params p = fst_default_params();
    for (int much = 0; much < 2; ++much) {
        by_hand *b = begin();
        fst_run_result r;
        double sum = 0.0, sum2 = 0.0, least = INFINITY, greatest = -INFINITY;
        for (int i = 0; i < BLOCKS; ++i) {
            const double block = 1e-3 * (scatter[i] + (much ? 0.5 : 0.02) * i);
            b->marks.kept[i + 1].integrals[FST_Q_R] = b->marks.kept[i].integrals[FST_Q_R] + SPAN * block;
            sum += block;
            sum2 += block * block;
            least = fmin(least, block);
            greatest = fmax(greatest, block);
        }
        b->marks.latest = b->marks.kept[BLOCKS];
        const double deviation = sqrt((sum2 - sum * sum / BLOCKS) / (BLOCKS - 1));
        fst_result_clear(&r);
        fst_means_of_chaos(&b->run.window, &b->marks, &p, &r);
        CHECK_CLOSE(r.mean_r_error, much ? greatest - least : 2.0 * deviation / sqrt(BLOCKS), 1e-12);
        fst_means_fill(&b->run.window, &b->marks, &p, &r);
        assert_true(r.mean_r_error > 5.0 * (greatest - least)); /* of any other motion that drifts so */
        fst_watched_run_free(&b->run);
        test_free(b);
    }
}

/* What chaos does in one block it may go on with in the next: blocks that come in equal pairs are half as many. */
static void test_chaos_that_goes_on(void **unused)
{
    (void)unused;
    enum { PAIRS = 8 };
    static const double pairs[PAIRS] = {1, -1, 0.4, -0.4, -0.9, 0.9, 0.6, -0.6};
    const fst_params p = fst_default_params();
    by_hand *b = begin();
    fst_run_result r;
    double sum2 = 0.0;
    for (int i = BLOCKS + 1; i <= 2 * PAIRS; ++i) {
        fst_mark mark = {.omega = 0.31};
        mark.t.high = 100.0 + SPAN * i;
        fst_marks_offer(&b->marks, &mark);
    }
    for (int i = 0; i < 2 * PAIRS; ++i) {
        b->marks.kept[i + 1].integrals[FST_Q_R] =
            b->marks.kept[i].integrals[FST_Q_R] + SPAN * 1e-3 * pairs[i / 2];
        sum2 += 0.5e-6 * pairs[i / 2] * pairs[i / 2]; /* their sum is 0 */
    }
    b->marks.latest = b->marks.kept[2 * PAIRS];
    fst_result_clear(&r);
    fst_means_of_chaos(&b->run.window, &b->marks, &p, &r);
    CHECK_CLOSE(r.mean_r_error, 2.0 * sqrt(sum2 / (PAIRS - 1) / PAIRS), 1e-12);
    fst_watched_run_free(&b->run);
    test_free(b);
}

/* Such a motion has these errors, and no other one: a run of a few periods, chaotic by the exponent that it is told. */
static void test_halves_of_chaos(void **unused)
{
    (void)unused;
    for (int growth = 0; growth <= 100; growth += 100) {
        fst_params p = bead_at(0.17, FST_DYNAMICS_RIGID);
        fst_watched_run *run = test_calloc(1, sizeof *run);
        fst_run_result plain, r;
        fst_error error;
        int over = 0, needs;
        p.friction_law = FST_FRICTION_COULOMB;
        p.friction_mu = growth ? 0.366 : 0.3675;
        p.run_rtol = 1e-8;
        p.run_periods = 30.0;
        p.run_discard = 10.0;
        assert_int_equal(fst_watched_run_begin(run, &p, NULL, &error), FST_OK);
        while (!over)
            assert_int_equal(fst_watched_run_go_on(run, 1000, &over, &error), FST_OK);
        const fst_mark_series *series = fst_window_series(&run->window, run->flow->t);
        const fst_exponent exponent = {.duration = 1000.0, .value = growth / 1000.0, .standard_error = 1e-9};
        fst_result_clear(&plain);
        fst_means_fill(&run->window, series, &p, &plain);
        fst_result_clear(&r);
        assert_int_equal(fst_conclude(run, &exponent, &r, &needs, &error), FST_OK);
        assert_int_equal(r.regime, growth ? FST_REGIME_CHAOTIC : FST_REGIME_LIBRATING);
        if (growth) {
            const double of_blocks = plain.mean_nz_error;
            fst_means_of_chaos(&run->window, series, &p, &plain);
            assert_true(plain.mean_nz_error > 1.1 * of_blocks);
        }
        assert_true(r.mean_r_error == plain.mean_r_error && r.mean_nz_error == plain.mean_nz_error &&
                    r.mean_alpha_dot_error == plain.mean_alpha_dot_error);
        fst_watched_run_free(run);
        test_free(run);
    }
}

/* Blocks that come closer to their limit in turns from either side, or first fast and then slowly: the error
 * covers the limit, and is no wider than some blocks of the approach. */
static void test_errors_of_an_approach(void **unused)
{
    (void)unused;
    static const double factors[] = {-0.9, -0.7, -0.4, 0.3, 0.6, 0.8};
    const double limit = 0.83, size = 1e-3;
    for (size_t i = 0; i < sizeof factors / sizeof *factors; ++i)
        for (int two = 0; two < 2; ++two) {
            by_hand *b = begin();
            for (int k = 0; k < BLOCKS; ++k)
                b->marks.kept[k + 1].integrals[FST_Q_R] =
                    b->marks.kept[k].integrals[FST_Q_R] +
                    SPAN * (limit + size * (pow(factors[i], k) - two * 3.0 * pow(0.2, k)));
            const fst_run_result r = conclude(b);
            CHECK_WITHIN(r.mean_r_error, fabs(r.mean_r - limit), 3.0 * size);
        }
}

/* The states at the marks of a section differ as much in the later blocks as in the first: all blocks may lack
 * the same, and the error says so though they agree. */
static void test_errors_of_marks_that_differ(void **unused)
{
    (void)unused;
    by_hand *b = begin();
    fill(b, FST_Q_R, 0.83);
    fill(b, FST_Q_R2, 0.83 * 0.83 + 0.04);
    CHECK_WITHIN(conclude(b).mean_r_error, 0.0, 1e-9);
    b = begin();
    fill(b, FST_Q_R, 0.83);
    fill(b, FST_Q_R2, 0.83 * 0.83 + 0.04);
    for (int i = 0; i <= BLOCKS; ++i)
        b->marks.kept[i].state[FST_X] = i % 2 ? 0.01 : 0.0;
    CHECK_WITHIN(conclude(b).mean_r_error, 0.01 / BLOCKS, 0.04 / BLOCKS);
}

/* The balance d(energy) = (drive - friction) dt, broken in any one block, is seen. */
static void test_a_broken_balance_in_any_block(void **unused)
{
    (void)unused;
    for (int broken = 0; broken < BLOCKS; ++broken) {
        by_hand *b = begin();
        fill(b, FST_Q_DRIVE_POWER, 2e-3);
        fill(b, FST_Q_FRICTION_POWER, 2e-3);
        for (int i = broken + 1; i <= BLOCKS; ++i)
            b->marks.kept[i].energy = 1e-7;
        const fst_run_result r = conclude(b);
        CHECK_CLOSE(r.energy_residual, 1e-7 / (2e-3 * SPAN * BLOCKS), 1e-12);
    }
}

/* n on a circle in a plane of a known tilt, the circle's centre off the origin. */
static void test_tilt_of_a_known_plane(void **unused)
{
    (void)unused;
    uint64_t seed = 5;
    for (int i = 0; i < 20; ++i) {
        double normal[3], other[3], u[3], v[3], along = 0.0, length = 0.0;
        random_unit(&seed, normal);
        random_unit(&seed, other);
        for (int k = 0; k < 3; ++k)
            along += normal[k] * other[k];
        for (int k = 0; k < 3; ++k) {
            u[k] = other[k] - along * normal[k];
            length += u[k] * u[k];
        }
        for (int k = 0; k < 3; ++k)
            u[k] /= sqrt(length);
        for (int k = 0; k < 3; ++k)
            v[k] = normal[(k + 1) % 3] * u[(k + 2) % 3] - normal[(k + 2) % 3] * u[(k + 1) % 3];
        const double centre = 0.8, radius = 0.6; /* more of n along the normal than in the plane */
        static const int second[3][3] = {{FST_Q_N_RR, FST_Q_N_RALPHA, FST_Q_N_RZ},
                                         {FST_Q_N_RALPHA, FST_Q_N_ALPHAALPHA, FST_Q_N_ALPHAZ},
                                         {FST_Q_N_RZ, FST_Q_N_ALPHAZ, FST_Q_N_ZZ}};
        by_hand *b = begin();
        for (int k = 0; k < 3; ++k) {
            fill(b, FST_Q_N_R + k, centre * normal[k]);
            for (int l = 0; l < 3; ++l)
                fill(b, second[k][l],
                     centre * centre * normal[k] * normal[l] +
                         0.5 * radius * radius * (u[k] * u[l] + v[k] * v[l]));
        }
        CHECK_CLOSE(conclude(b).tilt_deg, DEGREES * asin(fabs(normal[2])), 1e-6);
    }
}

/* ------------------------------------------------------------------ from outside */

/* mu N/(R omega_0), all of it in SI. */
static void test_the_rate_of_dry_friction(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    p.run_periods = 20;
    p.run_discard = 10;
    p.friction_mu = 0.13;
    const fst_run_result r = run_of(&p);
    const double newtons_per_mass = r.mean_load_weights * p.plate_gravity;
    CHECK_CLOSE(r.dry_friction_rate * p.bead_radius * TWO_PI * p.drive_frequency,
                p.friction_mu * newtons_per_mass, 1e-9 * newtons_per_mass);
}

/* The energy balance holds on a fast ramp too, where the drive changes within a step. */
static void test_powers_on_a_ramp(void **unused)
{
    (void)unused;
    const fst_params p = bead_at(0.31, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow *flow = flow_of(model, 1e-12, start);
    fst_quadrature q;
    fst_flow_begin_ramp(flow, 2e-3);
    fst_quadrature_begin(&q, flow);
    const double energy = fst_observe(model, flow->step.end).energy;
    while (flow->t.high < 60.0) {
        double integrals[FST_Q_COUNT], phi;
        assert_int_equal(fst_flow_step(flow, 60.0, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
        fst_quadrature_at(&q, flow, 1.0, integrals, &phi);
        const double work = integrals[FST_Q_DRIVE_POWER] - integrals[FST_Q_FRICTION_POWER];
        CHECK_CLOSE(fst_observe(model, flow->step.end).energy - energy, work, 1e-10);
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

typedef struct sampled {
    double least[2], greatest[2];
} sampled;

static fst_status look(void *user, const fst_sample *sample, fst_error *error)
{
    sampled *s = user;
    const double values[2] = {sample->seen.r, sample->seen.b_norm};
    (void)error;
    for (int i = 0; i < 2; ++i) {
        s->least[i] = fmin(s->least[i], values[i]);
        s->greatest[i] = fmax(s->greatest[i], values[i]);
    }
    return FST_OK;
}

/* Extremes are those of the window alone, wherever in a step it begins: on a decaying transient the larger
 * swings before the window do not count. */
static void test_extremes_begin_with_the_window(void **unused)
{
    (void)unused;
    for (int i = 0; i < 100; ++i) {
        fst_params p = bead_at(0.31, FST_DYNAMICS_RIGID);
        sampled s = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
        fst_run_options options = fst_default_run_options();
        fst_run_result r;
        p.start_r = 1.15;
        p.run_discard = 0.3 + 0.017 * i;
        p.run_periods = p.run_discard + 1.0 + 1e-9;
        p.run_samples = 4000;
        options.sample_from = p.run_discard;
        options.sink.user = &s;
        options.sink.sample = look;
        assert_int_equal(fst_run(&p, &options, &r, NULL), FST_OK);
        CHECK_CLOSE(r.min_r, s.least[0], 2e-3 * s.greatest[0] / 64);
        CHECK_CLOSE(r.max_r, s.greatest[0], 2e-3 * s.greatest[0] / 64);
        CHECK_CLOSE(r.min_b, s.least[1], 2e-3 * s.greatest[1] / 16);
        CHECK_CLOSE(r.max_b, s.greatest[1], 2e-3 * s.greatest[1] / 16);
    }
}

/* However much an open orbit's states differ, its <alpha'> cannot lack more than half a turn of Phi over the
 * window's time; where they differ little, it lacks less. */
static void test_errors_of_open_turning(void **unused)
{
    (void)unused;
    static const double apart[] = {0.01, 10.0};
    for (int far = 0; far < 2; ++far) {
        by_hand *b = begin();
        b->run.window.least_bead_angle = 0.0;
        b->run.window.greatest_bead_angle = 100.0;
        for (int i = 0; i <= BLOCKS; ++i)
            b->marks.kept[i].state[FST_X] = i % 2 ? apart[far] : 0.0;
        const double half_turn = FST_PI / (SPAN * BLOCKS);
        const double expected = far ? half_turn : 0.31 * 2.0 * apart[far] / BLOCKS;
        CHECK_CLOSE(conclude(b).mean_alpha_dot_error, expected, 1e-9 * expected);
    }
}

/* Within less than a whole drive period there are no means, and the reason names the keys that would help. */
static void test_no_whole_period(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.run_periods = 1.5;
    p.run_discard = 1.0;
    const fst_run_result result = run_of(&p);
    assert_int_equal(result.regime, FST_REGIME_UNDECIDED);
    assert_true(isnan(result.mean_r) && isnan(result.mean_r_error));
    assert_non_null(strstr(result.reason, "1.5 drive periods and 1 of them"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_errors_from_the_scatter_of_blocks),
        cmocka_unit_test(test_errors_of_halves),
        cmocka_unit_test(test_chaos_that_seems_to_drift),
        cmocka_unit_test(test_chaos_that_goes_on),
        cmocka_unit_test(test_halves_of_chaos),
        cmocka_unit_test(test_errors_of_an_approach),
        cmocka_unit_test(test_errors_of_marks_that_differ),
        cmocka_unit_test(test_a_broken_balance_in_any_block),
        cmocka_unit_test(test_tilt_of_a_known_plane),
        cmocka_unit_test(test_the_rate_of_dry_friction),
        cmocka_unit_test(test_powers_on_a_ramp),
        cmocka_unit_test(test_extremes_begin_with_the_window),
        cmocka_unit_test(test_errors_of_open_turning),
        cmocka_unit_test(test_no_whole_period),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
