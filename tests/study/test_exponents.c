/* Lyapunov exponents: a few motions whose exponents are known exactly; two samples of one chaotic motion, which
 * must agree; and long computations, which must show progress and be stoppable. test_exponents_long.c has 100
 * known motions.
 * tests: study/exponent.c study/growth.c orbit/lyapunov.c
 * labels: numbers */
#include "exponent_states.h"

#include "study/growth.h"

enum { STATES = 15 };

/* Runs shorter than by default: their error bars must cover the exact values all the same. */
static fst_params short_scene(int index)
{
    fst_params params = exponent_scene(index);
    params.run_periods = 120;
    params.run_discard = 80;
    return params;
}

static void errors_cover(void **state)
{
    (void)state;
    coverage spectrum = {0, 0, 0, 0.0}, across = {0, 0, 0, 0.0};
    int states = 0;
    for (int i = 0; states < STATES; ++i) {
        const fst_params params = short_scene(i);
        known_exponents known;
        fst_lyapunov l;
        if (!exponents_known(&params, &known))
            continue;
        ++states;
        assert_int_equal(fst_lyapunov_find(&params, NULL, &l, NULL), FST_OK);
        for (int c = 1; c < FST_EIGENVALUE_COUNT; ++c)
            assert_true(l.exponents[c] <= l.exponents[c - 1]); /* sorted from the greatest down */
        for (int c = 0; c < known.count; ++c) {
            cover(&spectrum, l.exponents[c], l.errors[c], known.exponents[c]);
            CHECK_CLOSE(l.exponents[c], known.exponents[c], 0.01 * fabs(known.exponents[c]) + 1e-4);
        }
        if (!known.is_orbit)
            continue;
        const fst_exponent asked = exponent_across_flow(&params, known.state);
        cover(&across, asked.value, asked.standard_error, known.across_flow);
        CHECK_CLOSE(asked.value, known.across_flow, 0.01 * fabs(known.across_flow) + 1e-4);
    }
    print_message("spectrum: %d of %d within one error, at most %.2f off; across the flow: %d of %d, %.2f\n",
                  spectrum.within_one, spectrum.all, spectrum.greatest, across.within_one, across.all,
                  across.greatest);
    assert_true(across.all >= 5);
    assert_true(spectrum.within_one >= 0.68 * spectrum.all && across.within_one >= 0.68 * across.all);
    assert_int_equal(spectrum.within_three, spectrum.all);
    assert_int_equal(across.within_three, across.all);
}

/* The exponent of the paper's orbit at 10.7 Hz, more closely than the 1 % above. */
static void the_paper_s_orbit(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    known_exponents known;
    assert_true(exponents_known(&params, &known));
    const fst_exponent asked = exponent_across_flow(&params, known.state);
    CHECK_CLOSE(asked.value, known.across_flow, 1e-4 * fabs(known.across_flow));
    CHECK_CLOSE(known.across_flow, -0.0277292221454, 1e-9);
    /* A length known to a factor of e gives, over a time T, a rate known to 1/T, however little it scatters. */
    assert_true(asked.standard_error >= 1.0 / asked.duration);
    assert_true(asked.standard_error < 0.01 * fabs(known.across_flow));
}

/* ------------------------------------------------------------------ growth */

static uint64_t random_bits = 88172645463325252U;

static double uniform(void)
{
    random_bits ^= random_bits << 13;
    random_bits ^= random_bits >> 7;
    random_bits ^= random_bits << 17;
    return (double)(random_bits >> 11) / 9007199254740992.0;
}

static fst_growth_rate rate_of(double (*length)(double), double duration, int pieces, double noise)
{
    fst_growth growth;
    fst_growth_clock clock;
    memset(&growth, 0, sizeof growth);
    memset(&clock, 0, sizeof clock);
    clock.duration = duration;
    for (int i = 0; i < pieces; ++i) {
        const double from = duration * i / pieces, to = duration * (i + 1) / pieces;
        fst_growth_pass(&clock, to - from);
        fst_growth_add(&growth, &clock, length(to) - length(from) + noise * (uniform() - 0.5));
    }
    return fst_growth_conclude(&growth);
}

static double swinging(double t)
{
    return -0.02 * t + 3.0 * sin(0.7 * t) + sin(0.31 * t);
}

static double arriving(double t) /* a direction that turns into place slowly */
{
    return -0.02 * t + log(1.0 + 10.0 * exp(-0.01 * t));
}

static double drifting(double t) /* the rate goes from 0 to 0.01 */
{
    return 0.5e-5 * t * t;
}

static double even(double t)
{
    return 0.01 * t;
}

static void growth_and_its_error(void **state)
{
    (void)state;
    fst_growth_rate rate = rate_of(swinging, 1000.0, 1000, 0.0);
    CHECK_CLOSE(rate.value, -0.02, 1e-5);
    assert_true(fabs(rate.value + 0.02) < rate.error && rate.error < 2e-3);
    for (double duration = 100.0; duration < 3000.0; duration *= 1.5) {
        rate = rate_of(arriving, duration, 1000, 0.0);
        assert_true(fabs(rate.value + 0.02) < 3.0 * fmax(rate.error, 1.0 / duration));
    }
    /* A rate that drifts one way has not settled: the error is the whole difference between its halves. */
    rate = rate_of(drifting, 1000.0, 1000, 0.0);
    CHECK_CLOSE(rate.value, 0.005, 1e-8);
    CHECK_CLOSE(rate.error, 0.005, 1e-6);
    int within = 0, within_three = 0;
    double mean_error = 0.0;
    enum { SAMPLES = 500 };
    for (int i = 0; i < SAMPLES; ++i) {
        rate = rate_of(even, 1000.0, 320, 3.0);
        within += fabs(rate.value - 0.01) < rate.error;
        within_three += fabs(rate.value - 0.01) < 3.0 * rate.error;
        mean_error += rate.error / SAMPLES;
    }
    assert_true(within >= 0.68 * SAMPLES && within_three >= 0.99 * SAMPLES);
    /* The true error is sqrt(3/2) times that of the plain mean, sqrt(320/12) 3/1000. */
    const double true_error = sqrt(1.5 * 320.0 / 12.0) * 3e-3;
    print_message("of %d noisy means %d within one error, %d within three; mean error %.2f of the true one\n",
                  SAMPLES, within, within_three, mean_error / true_error);
    assert_true(mean_error > true_error && mean_error < 1.5 * true_error);
}

/* ------------------------------------------------------------------ chaos */

/* Without friction this start leads to chaos (test_regimes.c), and two stretches of the motion are two samples
 * of it. */
static void chaos_agrees_with_itself(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    params.friction_law = FST_FRICTION_NONE;
    params.drive_omega = 0.4;
    params.start_r = 1.1;
    fst_exponent first = {0}, second = {0};
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    params.run_periods = 300;
    params.run_discard = 50;
    assert_int_equal(fst_run(&params, &options, &result, NULL), FST_OK);
    first = exponent_across_flow(&params, result.final_state);
    options.start = result.final_state;
    fst_run_result later;
    assert_int_equal(fst_run(&params, &options, &later, NULL), FST_OK);
    second = exponent_across_flow(&params, later.final_state);
    print_message("%g +- %g, %g +- %g\n", first.value, first.standard_error, second.value,
                  second.standard_error);
    assert_true(first.value > 3.0 * first.standard_error && second.value > 3.0 * second.standard_error);
    CHECK_CLOSE(first.value, second.value, 3.0 * hypot(first.standard_error, second.standard_error));
}

/* ------------------------------------------------------------------ long ones */

typedef struct watcher {
    uint64_t told, stop_at;
    double last;
} watcher;

static fst_status watch(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    watcher *w = user;
    (void)error;
    assert_true(fraction >= w->last && fraction <= 1.0);
    w->last = fraction;
    return ++w->told == w->stop_at ? FST_INTERRUPTED : FST_OK;
}

static void lyapunov_obeys(void **state)
{
    (void)state;
    static const double drives[2] = {1e-6, 10.7};
    for (int i = 0; i < 2; ++i) {
        fst_params params = fst_default_params();
        params.drive_frequency = drives[i];
        params.run_periods = 1e9; /* more steps than an int or an int64_t can count */
        for (int discarded = 0; discarded < 2; ++discarded) {
            watcher w = {0, 100, 0.0};
            const fst_progress progress = {&w, watch};
            fst_lyapunov l;
            params.run_discard = discarded ? 1e8 : 0.0;
            assert_int_equal(fst_lyapunov_find(&params, &progress, &l, NULL), FST_INTERRUPTED);
            assert_int_equal(w.told, 100);
        }
    }
}

static void exponents_obey(void **state)
{
    (void)state;
    fst_model *model = NULL;
    fst_params params = fst_default_params();
    assert_int_equal(fst_model_new(&params, &model, NULL), FST_OK);
    fst_exponent asked, *list[1] = {&asked};
    memset(&asked, 0, sizeof asked);
    asked.world = &model->world;
    asked.duration = 1e15;
    asked.rtol = 1e-7;
    assert_int_equal(fst_start_state(&params, model, asked.state, NULL), FST_OK);
    watcher w = {0, 10, 0.0};
    const fst_progress progress = {&w, watch};
    assert_int_equal(fst_largest_exponents(&fst_tangents_scalar, list, 1, &progress, NULL), FST_INTERRUPTED);
    /* A step takes twelve evaluations, also if it is rejected. */
    assert_true(asked.rhs_calls <= 12 * 64 * 10);
    fst_model_free(model);
}

/* A run that needs an exponent reports progress while it computes it, and can be stopped meanwhile. */
static void a_run_tells_of_its_exponent(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    params.drive_omega = 0.11; /* it librates */
    params.run_periods = 40;
    params.run_discard = 20;
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    watcher all = {0, 0, 0.0};
    const fst_progress to_all = {&all, watch};
    options.progress = &to_all;
    assert_int_equal(fst_run(&params, &options, &result, NULL), FST_OK);
    assert_true(isfinite(result.largest_exponent) && all.last > 0.75);
    watcher some = {0, all.told - 1, 0.0};
    const fst_progress to_some = {&some, watch};
    options.progress = &to_some;
    assert_int_equal(fst_run(&params, &options, &result, NULL), FST_INTERRUPTED);
    assert_true(some.last > 0.75);
    CHECK_CONTAINS(result.reason, "interrupted");
    assert_int_equal(result.regime, FST_REGIME_UNDECIDED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(growth_and_its_error),
        cmocka_unit_test(errors_cover),
        cmocka_unit_test(the_paper_s_orbit),
        cmocka_unit_test(chaos_agrees_with_itself),
        cmocka_unit_test(lyapunov_obeys),
        cmocka_unit_test(exponents_obey),
        cmocka_unit_test(a_run_tells_of_its_exponent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
