/* bench_ensemble.c - many trajectories: festoon's lanes and rows against GSL with the same right-hand side.
 *
 * The job: dynamics `rigid`, the paper's parameters, omegas evenly on [0.36, 1.20], 200 drive periods each from
 * the free-rolling start at r = 0.95.  The error is the max-norm of the final state against long double, the
 * worst over 256 of the omegas (over 16 for the slowest opponent).  Each solver gets the loosest tolerance, on
 * a grid of sixteenths of a decade, that reaches the goal there; then all run in turn, round after round, and
 * times and ratios are medians over the rounds.  Before that, what the core can do at most, and how far final
 * states at tight tolerances are from GSL's.
 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "lanes/final_states.h"
#include "peak.h"
#include "reference.h"

#define TWO_PI 6.283185307179586476925287
enum { OMEGAS = 4096, CHECKED = 256, SEARCHED = 16, ROUNDS = 5, PERIODS = 200 };

typedef struct point {
    fst_params params;
    fst_model *model;
    double start[FST_STATE_SIZE], reference[FST_STATE_SIZE], t_end;
} point;

static point points[OMEGAS];
static uint64_t evaluations; /* evaluations of the right-hand side by the solver at work */

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

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(const double *values, int count)
{
    double sorted[ROUNDS];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, ascending);
    return sorted[count / 2];
}

/* ------------------------------------------------------------------ solvers: some points to their ends */

typedef struct solver {
    const char *name;
    int (*solve)(const struct solver *self, const int *which, int count, double tolerance,
                 double (*ends)[FST_STATE_SIZE]);
    const fst_lane_engine *engine;
    const gsl_odeiv2_step_type **step;
    int threads, sample;                              /* points of a timed round */
    int first_quarter;                                /* looser tolerances are not tried, in quarter decades */
    int checked;                                      /* points at which the final error is taken */
    double tolerance, error, ms[ROUNDS], evaluations; /* evaluations of one trajectory */
    double processor_ms[ROUNDS];                      /* of all threads */
} solver;

static fst_flow *flow_at(const point *p, double tolerance)
{
    fst_flow_options o = fst_default_flow_options();
    fst_flow *flow = NULL;
    o.rtol = tolerance;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = tolerance;
    (void)fst_flow_new(p->model, &o, p->start, &flow, NULL);
    return flow;
}

static int by_scalar(const solver *self, const int *which, int count, double tolerance,
                     double (*ends)[FST_STATE_SIZE])
{
    (void)self;
    for (int i = 0; i < count; ++i) {
        fst_stop stop;
        fst_flow *flow = flow_at(&points[which[i]], tolerance);
        const int good = flow && fst_flow_advance(flow, points[which[i]].t_end, 0, &stop, NULL) == FST_OK;
        if (good)
            memcpy(ends[i], fst_flow_get(flow).state, sizeof ends[i]);
        evaluations += good ? flow->rhs_calls : 0;
        fst_flow_free(flow);
        if (!good)
            return 0;
    }
    return 1;
}

typedef struct share {
    const solver *self;
    const int *which;
    int count, good;
    double tolerance, (*ends)[FST_STATE_SIZE];
    uint64_t evaluations;
} share;

static void *do_share(void *user)
{
    share *s = user;
    fst_flow **flows = calloc((size_t)s->count, sizeof *flows);
    double *t_end = calloc((size_t)s->count, sizeof *t_end);
    s->good = flows && t_end;
    for (int i = 0; s->good && i < s->count; ++i) {
        flows[i] = flow_at(&points[s->which[i]], s->tolerance);
        t_end[i] = points[s->which[i]].t_end;
        s->good = flows[i] != NULL;
    }
    s->good = s->good && fst_final_states(s->self->engine, flows, t_end, s->count, s->ends, NULL) == FST_OK;
    for (int i = 0; s->good && i < s->count; ++i)
        s->evaluations += flows[i]->rhs_calls;
    for (int i = 0; flows && i < s->count; ++i)
        fst_flow_free(flows[i]);
    free(flows);
    free(t_end);
    return NULL;
}

static int by_lanes(const solver *self, const int *which, int count, double tolerance,
                    double (*ends)[FST_STATE_SIZE])
{
    share shares[2];
    pthread_t thread;
    const int half = self->threads == 2 ? count / 2 : count;
    shares[0] = (share){self, which, half, 0, tolerance, ends, 0};
    shares[1] = (share){self, which + half, count - half, 0, tolerance, ends + half, 0};
    if (self->threads == 2 && pthread_create(&thread, NULL, do_share, &shares[1]) != 0)
        return 0;
    (void)do_share(&shares[0]);
    evaluations += shares[0].evaluations;
    if (self->threads < 2)
        return shares[0].good;
    pthread_join(thread, NULL);
    evaluations += shares[1].evaluations;
    return shares[0].good && shares[1].good;
}

static int gsl_rhs(double t, const double y[], double dy[], void *data)
{
    (void)t;
    const fst_model *model = data;
    fst_pull_double p;
    evaluations += 1;
    fst_rhs_double(&model->coefficients, model->coefficients.omega, y, dy, &p);
    return GSL_SUCCESS;
}

static int by_gsl(const solver *self, const int *which, int count, double tolerance,
                  double (*ends)[FST_STATE_SIZE])
{
    int good = 1;
    for (int i = 0; i < count && good; ++i) {
        const point *p = &points[which[i]];
        gsl_odeiv2_system system = {gsl_rhs, NULL, FST_STATE_SIZE, p->model};
        gsl_odeiv2_driver *driver =
            gsl_odeiv2_driver_alloc_y_new(&system, *self->step, 1e-3, tolerance, tolerance);
        double t = 0.0;
        memcpy(ends[i], p->start, sizeof p->start);
        good = gsl_odeiv2_driver_apply(driver, &t, p->t_end, ends[i]) == GSL_SUCCESS;
        gsl_odeiv2_driver_free(driver);
    }
    return good;
}

/* ------------------------------------------------------------------ rows */

typedef struct row_source {
    const int *which;
    int count, next;
    double tolerance;
} row_source;

static int next_row(void *user, fst_row_job *job)
{
    row_source *s = user;
    if (s->next == s->count)
        return 0;
    memset(job, 0, sizeof *job);
    job->params = points[s->which[s->next++]].params;
    job->params.run_rtol = s->tolerance;
    return 1;
}

static int row_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    (void)user, (void)job, (void)status, (void)result, (void)error;
    return 0;
}

/* Rows with all keys, the means over the second half of the periods; the final states are not needed here. */
static int by_rows(const solver *self, const int *which, int count, double tolerance,
                   double (*ends)[FST_STATE_SIZE])
{
    (void)ends;
    row_source source = {which, count, 0, tolerance};
    const fst_arithmetic form = !self->engine->fused       ? FST_ARITHMETIC_PORTABLE
                                : self->engine->width == 8 ? FST_ARITHMETIC_AVX512
                                                           : FST_ARITHMETIC_AVX2;
    const fst_row_work work = {&source, form, self->engine->width, next_row, row_done, NULL};
    return fst_rows(&work, NULL) == FST_OK;
}

/* ------------------------------------------------------------------ errors and times */

static double worst_error(const solver *s, double tolerance, int count)
{
    int which[CHECKED] = {0};
    static double ends[CHECKED][FST_STATE_SIZE];
    double worst = 0.0;
    for (int i = 0; i < count; ++i)
        which[i] = spread(i, count);
    if (!s->solve(s, which, count, tolerance, ends))
        return INFINITY;
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            worst = fmax(worst, fabs(ends[i][k] - points[which[i]].reference[k]));
    return worst;
}

/* The error at a tolerance: first at a few points, and if it reaches the goal there, at all. */
static double error_at(const solver *s, double tolerance, double goal)
{
    const double error = worst_error(s, tolerance, SEARCHED);
    return error <= goal && s->checked > SEARCHED ? worst_error(s, tolerance, s->checked) : error;
}

/* The loosest tolerance that reaches the goal: first among quarter decades, then among sixteenths within the
 * quarter before it, so that no solver has to be much better than asked. */
static void find_tolerance(solver *s, double goal)
{
    int quarter = s->first_quarter;
    while (quarter <= 38 && error_at(s, pow(10.0, -0.25 * (20 + quarter)), goal) > goal)
        ++quarter;
    s->error = INFINITY;
    for (int sixteenth = 3; sixteenth >= 0 && s->error > goal; --sixteenth) {
        s->tolerance = pow(10.0, -0.25 * (20 + quarter) + sixteenth / 16.0);
        s->error = error_at(s, s->tolerance, goal);
    }
}

static void time_round(solver *s, int round)
{
    static int which[OMEGAS];
    static double ends[OMEGAS][FST_STATE_SIZE];
    /* Runs at low omegas last longer, so two threads get every other one instead of a half of the list each. */
    const int half = s->sample / 2;
    for (int i = 0; i < s->sample; ++i)
        which[i] = spread(i < half ? 2 * i : 2 * (i - half) + 1, s->sample);
    evaluations = 0;
    const clockid_t clock = s->threads == 2 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID;
    const double start = seconds(clock), processor_start = seconds(CLOCK_PROCESS_CPUTIME_ID);
    (void)s->solve(s, which, s->sample, s->tolerance, ends);
    s->ms[round] = 1e3 * (seconds(clock) - start) / s->sample;
    s->processor_ms[round] = 1e3 * (seconds(CLOCK_PROCESS_CPUTIME_ID) - processor_start) / s->sample;
    s->evaluations = (double)evaluations / s->sample;
}

static void report(const solver *s, const solver *opponent)
{
    double ratio[ROUNDS];
    for (int i = 0; i < ROUNDS; ++i)
        ratio[i] = opponent->ms[i] / s->ms[i];
    printf("%-34s %9.1e %9.1e %9.3f %9.2f", s->name, s->tolerance, s->error, median(s->ms, ROUNDS),
           median(ratio, ROUNDS));
    if (s->evaluations > 0)
        printf(" %9.0f %9.1f", s->evaluations, 1e6 * median(s->ms, ROUNDS) / s->evaluations);
    printf("\n");
    fflush(stdout);
}

/* The processor time that two threads lose to each other. Time by the clock would contain what other programs
 * do. */
static void report_threads(const solver *one, const solver *two)
{
    double ratio[ROUNDS];
    for (int i = 0; i < ROUNDS; ++i)
        ratio[i] = two->processor_ms[i] / one->processor_ms[i];
    printf("  two threads take %.3f times the processor time of one\n", median(ratio, ROUNDS));
}

/* Computes every other reference, from *part on; then *part says whether all succeeded. */
static void *make_references(void *part)
{
    int *good = part, i = *good;
    for (*good = 1; i < CHECKED; i += 2) {
        point *p = &points[spread(i, CHECKED)];
        const fst_groups groups = fst_model_groups(p->model);
        *good = *good && reference_state(&p->params, &groups, p->start, p->t_end, 1e-15L, p->reference);
    }
    return NULL;
}

static int prepare(void)
{
    for (int i = 0; i < OMEGAS; ++i) {
        point *p = &points[i];
        p->params = fst_default_params();
        p->params.drive_omega = 0.36 + (1.20 - 0.36) * i / (OMEGAS - 1.0);
        p->params.run_periods = PERIODS;
        p->params.run_discard = PERIODS / 2;
        p->t_end = PERIODS * TWO_PI / p->params.drive_omega;
        if (fst_model_new(&p->params, &p->model, NULL) != FST_OK ||
            fst_start_state(&p->params, p->model, p->start, NULL) != FST_OK)
            return 0;
    }
    int parts[2] = {0, 1};
    pthread_t thread;
    if (pthread_create(&thread, NULL, make_references, &parts[1]) != 0)
        return 0;
    (void)make_references(&parts[0]);
    pthread_join(thread, NULL);
    return parts[0] && parts[1];
}

static void compare(solver *solvers, int count, double goal)
{
    printf("\ngoal: every final state within %.0e of long double (worst of %d; msadams: %d)\n", goal, CHECKED,
           SEARCHED);
    printf("%-34s %9s %9s %9s %9s %9s %9s\n", "", "tolerance", "error", "ms", "GSL / it", "rhs", "ns / rhs");
    for (int i = 0; i < count; ++i)
        if (solvers[i].solve != by_rows)
            find_tolerance(&solvers[i], goal);
        else
            for (int k = 0; k < i; ++k)
                if (solvers[k].engine == solvers[i].engine) {
                    solvers[i].tolerance = solvers[k].tolerance;
                    solvers[i].error = solvers[k].error;
                }
    for (int round = 0; round < ROUNDS; ++round)
        for (int i = 0; i < count; ++i)
            time_round(&solvers[i], round);
    for (int i = 0; i < count; ++i) {
        report(&solvers[i], &solvers[0]);
        if (solvers[i].threads == 2)
            report_threads(&solvers[i - 1], &solvers[i]);
    }
}

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
    int which[SEARCHED];
    double apart = 0.0;
    for (int i = 0; i < SEARCHED; ++i)
        which[i] = spread(i, SEARCHED);
    if (!gsl->solve(gsl, which, SEARCHED, 1e-13, theirs) || !ours->solve(ours, which, SEARCHED, 1e-13, ends))
        return;
    for (int i = 0; i < SEARCHED; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            apart = fmax(apart, fabs(ends[i][k] - theirs[i][k]));
    printf("at a tolerance of 1e-13, %s are within %.1e of GSL's rk8pd, and %.1e of long double (GSL: %.1e)\n",
           ours->name, apart, worst_error(ours, 1e-13, SEARCHED), worst_error(gsl, 1e-13, SEARCHED));
    fflush(stdout);
}

int main(void)
{
    solver solvers[12];
    int count = 0;
    if (!prepare()) {
        fprintf(stderr, "the job could not be prepared\n");
        return 1;
    }
    printf("job: rigid, %d omegas on [0.36, 1.20], %d drive periods; ms of processor time a trajectory (two "
           "threads: of time)\n",
           OMEGAS, PERIODS);
    solvers[count++] = (solver){
        .name = "GSL rk8pd", .solve = by_gsl, .step = &gsl_odeiv2_step_rk8pd, .sample = 8, .checked = CHECKED};
    solvers[count++] = (solver){.name = "GSL msadams",
                                .solve = by_gsl,
                                .step = &gsl_odeiv2_step_msadams,
                                .sample = 2,
                                .first_quarter = 24};
    solvers[count++] = (solver){.name = "festoon scalar", .solve = by_scalar, .sample = 8, .checked = CHECKED};
    static const struct {
        fst_arithmetic form;
        int lanes;
        const char *states, *rows, *two;
    } engines[] = {
        {FST_ARITHMETIC_PORTABLE, 8, "portable, 8 lanes, final states", "portable, 8 lanes, full rows", NULL},
        {FST_ARITHMETIC_AVX2, 4, "avx2, final states", "avx2, full rows", NULL},
        {FST_ARITHMETIC_AVX512, 8, "avx512, final states", "avx512, full rows",
         "avx512, final states, 2 threads"}};
    for (size_t i = 0; i < sizeof engines / sizeof *engines; ++i) {
        const fst_lane_engine *engine = fst_lane_engine_of(engines[i].form, engines[i].lanes);
        if (!engine)
            continue;
        solvers[count++] = (solver){.name = engines[i].states,
                                    .solve = by_lanes,
                                    .engine = engine,
                                    .threads = 1,
                                    .sample = 128,
                                    .checked = CHECKED};
        if (engines[i].two)
            solvers[count++] = (solver){.name = engines[i].two,
                                        .solve = by_lanes,
                                        .engine = engine,
                                        .threads = 2,
                                        .sample = 256,
                                        .checked = CHECKED};
        solvers[count++] = (solver){.name = engines[i].rows, .solve = by_rows, .engine = engine, .sample = 96};
    }
    report_peak();
    for (int i = 1; i < count; ++i)
        if (solvers[i].solve == by_lanes && solvers[i].threads == 1)
            check_final_states(&solvers[0], &solvers[i]);
    compare(solvers, count, 1e-9);
    compare(solvers, count, 1e-6);
    for (int i = 0; i < OMEGAS; ++i)
        fst_model_free(points[i].model);
    return 0;
}
