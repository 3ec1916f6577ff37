/* bench_ensemble.c - many trajectories: festoon's lanes and rows against GSL with the same right-hand side.
 *
 * The job is that of ensemble.h with 200 drive periods.  The error is the max-norm of the final state against
 * long double, the worst over 256 of the omegas.  Each solver gets the loosest tolerance, on a grid of
 * sixteenths of a decade, that reaches the goal there; then all run in turn, round after round, and times and
 * ratios are medians over the rounds.  Before that, what the core can do at most, and how far final states at
 * tight tolerances are from GSL's.
 *
 * Full rows have the tolerance of the final states that the same engine computes, because a row holds its final
 * state too.  What their means, extremes and periods are wrong by is measured besides, against rows in the
 * portable form at a tolerance of 1e-13.  For a user who needs no final state, rows are computed once more with
 * the loosest tolerance at which their means and periods reach the goal.
 */
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "ensemble.h"
#include "peak.h"
#include "reference.h"
#include "results.h"
#include "row_errors.h"

enum { OMEGAS = 4096, CHECKED = 256, CHECKED_ROWS = 64, SEARCHED = 16, ROUNDS = 5, PERIODS = 200 };
enum { GSL, GSL_WITH_MEANS, MOST_SOLVERS = 20 }; /* the first two solvers, to which all are compared */

static ensemble_point points[OMEGAS];
static double references[OMEGAS][FST_STATE_SIZE];
static fst_run_result row_references[CHECKED_ROWS];

/* Indices of `count` points spread over the omegas; the points of a smaller power of two are among those of a
 * larger one. */
static int spread(int i, int count)
{
    return (int)((long)i * OMEGAS / count + OMEGAS / (2 * CHECKED));
}

/* Seconds of this thread's processor time, which other programs disturb less, or by the wall clock. */
static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef enum goal_of { STATES, SAME_AS_STATES, MEANS } goal_of;

typedef struct solver {
    ensemble_method method;
    int sample;                                       /* points of a timed round */
    int checked;                                      /* points at which the final error is taken */
    goal_of goal_of;                                  /* what has to reach the goal */
    double tolerance, error, ms[ROUNDS], evaluations; /* evaluations of one trajectory */
    double processor_ms[ROUNDS];                      /* of all threads */
    row_errors rows;
} solver;

/* ------------------------------------------------------------------ errors */

static row_errors rows_at(const solver *s, double tolerance)
{
    static fst_run_result rows[CHECKED_ROWS];
    const ensemble_point *which[CHECKED_ROWS];
    for (int i = 0; i < CHECKED_ROWS; ++i)
        which[i] = &points[spread(i, CHECKED_ROWS)];
    if (ensemble_rows(s->method.engine, which, CHECKED_ROWS, tolerance, rows))
        return row_errors_of(rows, row_references, CHECKED_ROWS);
    return (row_errors){.states = INFINITY, .means = INFINITY, .period = INFINITY};
}

static double worst_error(const solver *s, double tolerance, int count)
{
    const ensemble_point *which[CHECKED] = {NULL};
    static double ends[CHECKED][FST_STATE_SIZE];
    double worst = 0.0;
    for (int i = 0; i < count; ++i)
        which[i] = &points[spread(i, count)];
    if (!s->method.solve(&s->method, which, count, tolerance, ends))
        return INFINITY;
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            worst = fmax(worst, fabs(ends[i][k] - references[spread(i, count)][k]));
    return worst;
}

/* The error at a tolerance: first at a few points, and if it reaches the goal there, at all. */
static double error_at(const solver *s, double tolerance, double goal)
{
    if (s->goal_of == MEANS) {
        const row_errors rows = rows_at(s, tolerance);
        return fmax(rows.means, rows.period);
    }
    const double error = worst_error(s, tolerance, SEARCHED);
    return error <= goal && s->checked > SEARCHED ? worst_error(s, tolerance, s->checked) : error;
}

static double quarter_decades(int quarters)
{
    return pow(10.0, -0.25 * quarters);
}

/* The loosest tolerance that reaches the goal: first among quarter decades, then among sixteenths within the
 * quarter before it, so that no solver has to be much better than asked.  Final states add up the errors of all
 * steps, so that none reaches the goal with a tolerance above it; means may. */
static void find_tolerance(solver *s, double goal)
{
    const int loosest = (int)lround(-4.0 * log10(goal)), tightest = 58;
    int quarter = s->goal_of == MEANS ? loosest - 8 : loosest;
    while (quarter <= tightest && error_at(s, quarter_decades(quarter), goal) > goal)
        ++quarter;
    s->error = INFINITY;
    for (int sixteenth = 3; sixteenth >= 0 && s->error > goal; --sixteenth) {
        s->tolerance = quarter_decades(quarter) * pow(10.0, sixteenth / 16.0);
        s->error = error_at(s, s->tolerance, goal);
    }
}

static int is_row(const solver *s)
{
    return s->method.solve == ensemble_by_rows;
}

static void set_tolerance(solver *solvers, int index, double goal)
{
    solver *s = &solvers[index];
    if (s->goal_of != SAME_AS_STATES)
        find_tolerance(s, goal);
    for (int k = 0; s->goal_of == SAME_AS_STATES && k < index; ++k)
        if (solvers[k].method.engine == s->method.engine && solvers[k].method.step == s->method.step &&
            solvers[k].goal_of == STATES)
            s->tolerance = solvers[k].tolerance;
    if (s->goal_of == SAME_AS_STATES && !is_row(s))
        s->error = worst_error(s, s->tolerance, s->checked);
    if (is_row(s)) {
        s->rows = rows_at(s, s->tolerance);
        s->error = s->goal_of == MEANS ? s->error : worst_error(s, s->tolerance, s->checked);
    }
}

/* ------------------------------------------------------------------ times */

static void time_round(solver *s, int round)
{
    static const ensemble_point *which[OMEGAS];
    static double ends[OMEGAS][FST_STATE_SIZE];
    /* Runs at low omegas last longer, so two threads get every other one instead of a half of the list each. */
    const int half = s->sample / 2;
    for (int i = 0; i < s->sample; ++i)
        which[i] = &points[spread(i < half ? 2 * i : 2 * (i - half) + 1, s->sample)];
    ensemble_evaluations = 0;
    const clockid_t clock = s->method.threads == 2 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID;
    const double start = seconds(clock), processor_start = seconds(CLOCK_PROCESS_CPUTIME_ID);
    (void)s->method.solve(&s->method, which, s->sample, s->tolerance, ends);
    s->ms[round] = 1e3 * (seconds(clock) - start) / s->sample;
    s->processor_ms[round] = 1e3 * (seconds(CLOCK_PROCESS_CPUTIME_ID) - processor_start) / s->sample;
    s->evaluations = (double)ensemble_evaluations / s->sample;
}

/* The median of numbers that stay as they are, or of their ratios. */
static double median(const double *above, const double *below)
{
    double ratio[ROUNDS];
    for (int i = 0; i < ROUNDS; ++i)
        ratio[i] = below ? above[i] / below[i] : above[i];
    return result_median(ratio, ROUNDS);
}

/* A cell of the table of all solvers, in the column of this kind for this goal. */
static void put(const solver *s, const char *column, double goal, const char *format, double value)
{
    char name[64];
    (void)snprintf(name, sizeof name, "%s, %.0e", column, goal);
    result_put("many trajectories", s->method.name, name, format, value);
}

static void report(const solver *s, const solver *opponents, double goal)
{
    const double ms = median(s->ms, NULL), ratio = median(opponents[GSL].ms, s->ms);
    printf("%-40s %9.1e %9.1e %9.3f %9.2f", s->method.name, s->tolerance, s->error, ms, ratio);
    put(s, "tolerance", goal, "%.1e", s->tolerance);
    put(s, "error", goal, "%.1e", s->error);
    put(s, "ms", goal, "%.2f", ms);
    put(s, "GSL / it", goal, "%.2f", ratio);
    if (s->evaluations > 0) {
        printf(" %9.0f %9.1f", s->evaluations, 1e6 * ms / s->evaluations);
        put(s, "evaluations", goal, "%.0f", s->evaluations);
        put(s, "ns each", goal, "%.1f", 1e6 * ms / s->evaluations);
    }
    if (is_row(s)) {
        const double with_means = median(opponents[GSL_WITH_MEANS].ms, s->ms);
        printf(" (GSL with means / it %.2f)", with_means);
        put(s, "GSL with means / it", goal, "%.2f", with_means);
    }
    printf("\n");
    fflush(stdout);
}

/* The processor time that two threads lose to each other. Time by the clock would contain what other programs
 * do. */
static void report_threads(const solver *one, const solver *two, double goal)
{
    const double ratio = median(two->processor_ms, one->processor_ms);
    printf("  two threads take %.3f times the processor time of one\n", ratio);
    put(two, "processor time over that of one thread", goal, "%.3f", ratio);
}

static void report_rows(const solver *s, const char *table)
{
    const char *name = s->method.name;
    printf("%-40s %9.1e %9.1e %9.1e %9.1e %9.1e %4d   %s, %s\n", name, s->tolerance, s->rows.states,
           s->rows.means, s->rows.extremes, s->rows.period, s->rows.regimes, s->rows.worst_mean,
           s->rows.worst_extreme);
    result_put(table, name, "tolerance", "%.1e", s->tolerance);
    result_put(table, name, "final states", "%.1e", s->rows.states);
    result_put(table, name, "means", "%.1e", s->rows.means);
    result_put(table, name, "extremes", "%.1e", s->rows.extremes);
    result_put(table, name, "period", "%.1e", s->rows.period);
    result_put(table, name, "other regimes", "%.0f", s->rows.regimes);
}

static void compare(solver *solvers, int count, double goal)
{
    char errors[64];
    (void)snprintf(errors, sizeof errors, "errors of rows, goal %.0e", goal);
    printf("\ngoal: every final state within %.0e of long double (worst of %d); \"by means\": means "
           "and periods (of %d)\n",
           goal, CHECKED, CHECKED_ROWS);
    printf("%-40s %9s %9s %9s %9s %9s %9s\n", "", "tolerance", "error", "ms", "GSL / it", "rhs", "ns / rhs");
    for (int i = 0; i < count; ++i)
        set_tolerance(solvers, i, goal);
    for (int round = 0; round < ROUNDS; ++round)
        for (int i = 0; i < count; ++i)
            time_round(&solvers[i], round);
    for (int i = 0; i < count; ++i) {
        report(&solvers[i], solvers, goal);
        if (solvers[i].method.threads == 2)
            report_threads(&solvers[i - 1], &solvers[i], goal);
    }
    printf("\n%-40s %9s %9s %9s %9s %9s  other regimes of %d, worst keys\n", "errors of rows", "tolerance",
           "states", "means", "extremes", "period", CHECKED_ROWS);
    for (int i = 0; i < count; ++i)
        if (is_row(&solvers[i]))
            report_rows(&solvers[i], errors);
    fflush(stdout);
}

/* ------------------------------------------------------------------ what is there */

static void report_peak(void)
{
    for (int doubles = 4; doubles <= 8; doubles += 4) {
        const double one = peak_seconds(doubles, 1), two = peak_seconds(doubles, 2);
        if (one > 0)
            printf("fused operations on %d doubles: %.4f ns each, %.2f times as many on two threads\n", doubles,
                   1e9 * one, 2.0 * one / two);
    }
}

/* Final states at 1e-13 against GSL's and against long double. */
static void check_final_states(const solver *gsl, const solver *ours)
{
    static double theirs[SEARCHED][FST_STATE_SIZE], ends[SEARCHED][FST_STATE_SIZE];
    const ensemble_point *which[SEARCHED];
    double apart = 0.0;
    for (int i = 0; i < SEARCHED; ++i)
        which[i] = &points[spread(i, SEARCHED)];
    if (!gsl->method.solve(&gsl->method, which, SEARCHED, 1e-13, theirs) ||
        !ours->method.solve(&ours->method, which, SEARCHED, 1e-13, ends))
        return;
    for (int i = 0; i < SEARCHED; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            apart = fmax(apart, fabs(ends[i][k] - theirs[i][k]));
    const double error = worst_error(ours, 1e-13, SEARCHED), gsl_error = worst_error(gsl, 1e-13, SEARCHED);
    printf("at a tolerance of 1e-13, %s are within %.1e of GSL's rk8pd, and %.1e of long double (GSL: %.1e)\n",
           ours->method.name, apart, error, gsl_error);
    result_put("final states at a tolerance of 1e-13", ours->method.name, "from long double", "%.1e", error);
    result_put("final states at a tolerance of 1e-13", ours->method.name, "from GSL", "%.1e", apart);
    result_put("final states at a tolerance of 1e-13", gsl->method.name, "from long double", "%.1e", gsl_error);
    fflush(stdout);
}

/* Computes every other reference, from *part on; then *part says whether all succeeded. */
static void *make_references(void *part)
{
    int *good = part, first = *good;
    const ensemble_point *rows[CHECKED_ROWS];
    static fst_run_result results[2][CHECKED_ROWS];
    for (int i = first, k = 0; i < CHECKED_ROWS; i += 2)
        rows[k++] = &points[spread(i, CHECKED_ROWS)];
    *good = ensemble_rows(fst_lane_engine_of(FST_ARITHMETIC_PORTABLE, 0), rows, CHECKED_ROWS / 2, 1e-13,
                          results[first]);
    for (int i = first, k = 0; i < CHECKED_ROWS; i += 2)
        row_references[i] = results[first][k++];
    for (int i = first; i < CHECKED; i += 2) {
        const int index = spread(i, CHECKED);
        const ensemble_point *p = &points[index];
        const fst_groups groups = fst_model_groups(p->model);
        *good = *good && reference_state(&p->params, &groups, p->start, p->t_end, 1e-15L, references[index]);
    }
    return NULL;
}

static int prepare(void)
{
    for (int i = 0; i < OMEGAS; ++i)
        if (!ensemble_point_make(&points[i], 0.36 + (1.20 - 0.36) * i / (OMEGAS - 1.0), PERIODS))
            return 0;
    int parts[2] = {0, 1};
    pthread_t thread;
    if (pthread_create(&thread, NULL, make_references, &parts[1]) != 0)
        return 0;
    (void)make_references(&parts[0]);
    pthread_join(thread, NULL);
    return parts[0] && parts[1];
}

static int list_opponents(solver *solvers)
{
    solvers[GSL] = (solver){
        .method = {.name = "GSL rk8pd, final states", .solve = ensemble_by_gsl, .step = &gsl_odeiv2_step_rk8pd},
        .sample = 8,
        .checked = CHECKED};
    solvers[GSL_WITH_MEANS] = (solver){.method = {.name = "GSL rk8pd, with means",
                                                  .solve = ensemble_by_gsl_with_means,
                                                  .step = &gsl_odeiv2_step_rk8pd},
                                       .sample = 8,
                                       .checked = SEARCHED,
                                       .goal_of = SAME_AS_STATES};
    solvers[2] = (solver){.method = {.name = "festoon scalar, final states", .solve = ensemble_by_scalar},
                          .sample = 8,
                          .checked = CHECKED};
    return 3;
}

static int list_engines(solver *solvers, int count)
{
    static const struct {
        fst_arithmetic form;
        int lanes;
        const char *states, *rows, *by_means, *two;
    } engines[] = {
        {FST_ARITHMETIC_PORTABLE, 8, "portable, 8 lanes, final states", "portable, 8 lanes, full rows",
         "portable, 8 lanes, full rows by means", NULL},
        {FST_ARITHMETIC_AVX2, 4, "avx2, final states", "avx2, full rows", "avx2, full rows by means", NULL},
        {FST_ARITHMETIC_AVX512, 8, "avx512, final states", "avx512, full rows", "avx512, full rows by means",
         "avx512, final states, 2 threads"}};
    for (size_t i = 0; i < sizeof engines / sizeof *engines; ++i) {
        const fst_lane_engine *engine = fst_lane_engine_of(engines[i].form, engines[i].lanes);
        if (!engine)
            continue;
        const ensemble_method lanes = {engines[i].states, ensemble_by_lanes, engine, NULL, 1},
                              two = {engines[i].two, ensemble_by_lanes, engine, NULL, 2},
                              rows = {engines[i].rows, ensemble_by_rows, engine, NULL, 1},
                              by_means = {engines[i].by_means, ensemble_by_rows, engine, NULL, 1};
        solvers[count++] = (solver){.method = lanes, .sample = 128, .checked = CHECKED};
        if (two.name)
            solvers[count++] =
                (solver){.method = two, .sample = 256, .checked = CHECKED, .goal_of = SAME_AS_STATES};
        solvers[count++] =
            (solver){.method = rows, .sample = 96, .checked = CHECKED, .goal_of = SAME_AS_STATES};
        solvers[count++] = (solver){.method = by_means, .sample = 96, .goal_of = MEANS};
    }
    return count;
}

int main(void)
{
    static solver solvers[MOST_SOLVERS];
    if (!prepare()) {
        fprintf(stderr, "the job could not be prepared\n");
        return 1;
    }
    printf("job: rigid, %d omegas on [0.36, 1.20], %d drive periods; ms of processor time a trajectory (two "
           "threads: of time)\n",
           OMEGAS, PERIODS);
    const int count = list_engines(solvers, list_opponents(solvers));
    report_peak();
    for (int i = 1; i < count; ++i)
        if (solvers[i].method.solve == ensemble_by_lanes && solvers[i].method.threads == 1)
            check_final_states(&solvers[GSL], &solvers[i]);
    compare(solvers, count, 1e-9);
    compare(solvers, count, 1e-6);
    for (int i = 0; i < OMEGAS; ++i)
        fst_model_free(points[i].model);
    return 0;
}
