/* The order of the method and of its dense output, in long double, where rounding leaves room to see it.
 *
 * Fitted slopes of log error against log step: 8 for the end of a stretch in steps of one size, with n
 * renormalised after each as in a run; 9 and 8 for one step and the inside of it (a dense output of order 7
 * errs by h^8).
 * tests: ode/dop853.inl ode/bead_step.inl
 * labels: long-double bits */
#include "physics_ld.h"

#include "ode/bead_step.inl"

typedef fst_bead_step_long_double step_ld;

static void begin(step_ld *s, const world_ld *c, const double *state, long double h, long double ramp)
{
    memset(s, 0, sizeof *s);
    s->context.world = *c;
    s->omega = c->omega;
    s->ramp = ramp;
    s->h = h;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        s->y[i] = state[i];
    (void)fst_renormalise_long_double(s->y); /* beyond the digits of a double */
    fst_begin_steps_long_double(s);
}

/* Makes `count` steps of size h; the state at their end. */
static void steps(const world_ld *c, const double *state, int count, long double h, long double ramp,
                  long double *end)
{
    step_ld s;
    begin(&s, c, state, h, ramp);
    for (int i = 0; i < count; ++i) {
        if (i > 0)
            fst_next_step_long_double(&s, c->omega + i * h * ramp);
        fst_bead_try_step_long_double(&s);
        (void)fst_finish_step_long_double(&s);
    }
    memcpy(end, s.end, FST_STATE_SIZE * sizeof *end);
}

static double distance(const long double *a, const long double *b)
{
    long double greatest = 0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        greatest = fmaxl(greatest, fabsl(a[i] - b[i]));
    return (double)greatest;
}

/* Least-squares slope of y against x. */
static double slope(const double *x, const double *y, int count)
{
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int i = 0; i < count; ++i) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
    }
    return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

enum { SIZES = 6 };

/* Mean logarithm of the error over several starts, since a single start may happen to have no leading error
 * term. */
enum { STARTS = 12 };

static void random_starts(int which, double states[STARTS][FST_STATE_SIZE])
{
    uint64_t seed = 71 + (uint64_t)which;
    for (int k = 0; k < STARTS; ++k)
        random_state(&seed, states[k]);
}

static void test_order_of_the_method(void **unused)
{
    (void)unused;
    for (int which = 0; which < CASES; ++which) {
        const fst_params p = params_of_case(which);
        const world_ld c = world_of(&p);
        double states[STARTS][FST_STATE_SIZE], log_h[SIZES], log_error[SIZES] = {0};
        random_starts(which, states);
        /* Without torque and friction the motion is so smooth that only long steps err by more than rounding.
         */
        const int fewest = which / 2 == 3 ? 24 : 100;
        const long double stretch = 4, ramp = which % 3 == 0 ? 0.01L : 0;
        for (int k = 0; k < STARTS; ++k) {
            long double reference[FST_STATE_SIZE], end[FST_STATE_SIZE];
            steps(&c, states[k], 500, stretch / 500, ramp, reference);
            for (int i = 0; i < SIZES; ++i) {
                const int count = fewest + i * fewest / 4;
                steps(&c, states[k], count, stretch / count, ramp, end);
                log_h[i] = -log(count);
                log_error[i] += log(distance(end, reference)) / STARTS;
            }
        }
        CHECK_WITHIN(slope(log_h, log_error, SIZES), 7.7, 8.6);
    }
}

/* Greatest error of the dense output inside one step of the size h, and the error at its end. */
static double errors_of_one_step(const world_ld *c, const double *state, long double h, double *at_end)
{
    step_ld s;
    begin(&s, c, state, h, 0);
    fst_bead_try_step_long_double(&s);
    (void)fst_finish_step_long_double(&s);
    fst_bead_make_dense_long_double(&s);
    long double exact[FST_STATE_SIZE], inside[FST_STATE_SIZE];
    double worst = 0;
    for (int k = 1; k < 8; ++k) {
        steps(c, state, 8, h * k / 8 / 8, 0, exact);
        fst_bead_evaluate_dense_long_double(FST_STATE_SIZE, &s.dense[0][0], (int)(sizeof s.y / sizeof *s.y),
                                            k / 8.0L, inside);
        worst = fmax(worst, distance(inside, exact));
    }
    steps(c, state, 8, h / 8, 0, exact);
    *at_end = distance(s.end, exact);
    return worst;
}

static void test_order_of_the_dense_output(void **unused)
{
    (void)unused;
    for (int which = 0; which < CASES; ++which) {
        const fst_params p = params_of_case(which);
        const world_ld c = world_of(&p);
        double states[STARTS][FST_STATE_SIZE], log_h[SIZES], log_end[SIZES] = {0}, log_inside[SIZES] = {0};
        random_starts(which, states);
        for (int i = 0; i < SIZES; ++i)
            for (int k = 0; k < STARTS; ++k) {
                double at_end;
                const long double h = (which / 2 == 3 ? 0.2L : 0.08L) / (1 + 0.3L * i);
                log_h[i] = log((double)h);
                log_inside[i] += log(errors_of_one_step(&c, states[k], h, &at_end)) / STARTS;
                log_end[i] += log(at_end) / STARTS;
            }
        CHECK_WITHIN(slope(log_h, log_end, SIZES), 8.4, 9.6);
        CHECK_WITHIN(slope(log_h, log_inside, SIZES), 7.6, 8.5);
    }
}

/* The dense output meets both ends of its step, with their derivatives. */
static void test_dense_output_meets_the_ends(void **unused)
{
    (void)unused;
    const fst_params p = params_of_case(8);
    const world_ld c = world_of(&p);
    uint64_t seed = 91;
    double state[FST_STATE_SIZE];
    random_state(&seed, state);
    step_ld s;
    begin(&s, &c, state, 0.1L, 0);
    fst_bead_try_step_long_double(&s);
    (void)fst_finish_step_long_double(&s);
    fst_bead_make_dense_long_double(&s);
    const long double d = 1e-6L;
    long double at[4][FST_STATE_SIZE];
    const long double places[4] = {0, d, 1 - d, 1};
    for (int k = 0; k < 4; ++k)
        fst_bead_evaluate_dense_long_double(FST_STATE_SIZE, &s.dense[0][0], (int)(sizeof s.y / sizeof *s.y),
                                            places[k], at[k]);
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        CHECK_CLOSE_LD(at[0][i], s.y[i], 0);
        CHECK_CLOSE_LD(at[3][i], s.end[i], 1e-18);
        CHECK_CLOSE_LD((at[1][i] - at[0][i]) / (d * s.h), s.k[0][i], 1e-4);
        CHECK_CLOSE_LD((at[3][i] - at[2][i]) / (d * s.h), s.k[12][i], 1e-4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_of_the_method),
        cmocka_unit_test(test_order_of_the_dense_output),
        cmocka_unit_test(test_dense_output_meets_the_ends),
    };
    return cmocka_run_group_tests_name("integrator_ld", tests, NULL, NULL);
}
