/* bench_ensemble.c - many trajectories: festoon's lanes and rows against GSL with the same right-hand side.
 *
 * The job: dynamics `rigid`, the paper's parameters, omegas evenly on [0.36, 1.20], 200 drive periods each from
 * the free-rolling start at r = 0.95.  The error is the max-norm of the final state against long double, the
 * worst over a subset of the omegas.  Each solver gets the loosest tolerance, on a grid of quarter decades,
 * that reaches the goal on that subset; then all run in turn, round after round, and times and ratios are
 * medians over the rounds.
 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "ensemble/final_states.h"
#include "reference.h"

#define TWO_PI 6.283185307179586476925287
enum { OMEGAS = 4096, CHECKED = 16, ROUNDS = 5, PERIODS = 200 };

typedef struct point {
    fst_params params;
    fst_model *model;
    double start[FST_STATE_SIZE], reference[FST_STATE_SIZE], t_end;
} point;

static point points[OMEGAS];

/* Indices of `count` points spread over the omegas. */
static int spread(int i, int count)
{
    return (int)((2 * (long)i + 1) * OMEGAS / (2 * count));
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
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
    int threads, sample; /* points of a timed round */
    int first_quarter;   /* looser tolerances are not tried */
    double tolerance, error, ms[ROUNDS];
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
    shares[0] = (share){self, which, half, 0, tolerance, ends};
    shares[1] = (share){self, which + half, count - half, 0, tolerance, ends + half};
    if (self->threads == 2 && pthread_create(&thread, NULL, do_share, &shares[1]) != 0)
        return 0;
    (void)do_share(&shares[0]);
    if (self->threads < 2)
        return shares[0].good;
    pthread_join(thread, NULL);
    return shares[0].good && shares[1].good;
}

static int gsl_rhs(double t, const double y[], double dy[], void *data)
{
    (void)t;
    const fst_model *model = data;
    fst_pull_double p;
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

static int never(void *user)
{
    (void)user;
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
    const fst_row_work work = {&source, form, self->engine->width, next_row, row_done, never};
    return fst_rows(&work, NULL) == FST_OK;
}

/* ------------------------------------------------------------------ errors and times */

static double worst_error(const solver *s, double tolerance)
{
    int which[CHECKED];
    double ends[CHECKED][FST_STATE_SIZE], worst = 0.0;
    for (int i = 0; i < CHECKED; ++i)
        which[i] = spread(i, CHECKED);
    if (!s->solve(s, which, CHECKED, tolerance, ends))
        return INFINITY;
    for (int i = 0; i < CHECKED; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            worst = fmax(worst, fabs(ends[i][k] - points[which[i]].reference[k]));
    return worst;
}

/* The loosest tolerance of quarter decades that reaches the goal. */
static void find_tolerance(solver *s, double goal)
{
    s->tolerance = 0.0;
    for (int quarter = s->first_quarter; quarter <= 38; ++quarter) {
        const double tolerance = pow(10.0, -0.25 * (20 + quarter));
        s->error = worst_error(s, tolerance);
        if (s->error <= goal) {
            s->tolerance = tolerance;
            return;
        }
    }
}

static void time_round(solver *s, int round)
{
    static int which[OMEGAS];
    static double ends[OMEGAS][FST_STATE_SIZE];
    /* Runs at low omegas last longer: threads, which take a half of the list each, get every other one. */
    const int half = s->sample / 2;
    for (int i = 0; i < s->sample; ++i)
        which[i] = spread(i < half ? 2 * i : 2 * (i - half) + 1, s->sample);
    const double start = seconds();
    (void)s->solve(s, which, s->sample, s->tolerance, ends);
    s->ms[round] = 1e3 * (seconds() - start) / s->sample;
}

static void report(const solver *s, const solver *opponent)
{
    double ratio[ROUNDS];
    for (int i = 0; i < ROUNDS; ++i)
        ratio[i] = opponent->ms[i] / s->ms[i];
    printf("%-34s %9.1e %9.1e %9.3f %9.2f\n", s->name, s->tolerance, s->error, median(s->ms, ROUNDS),
           median(ratio, ROUNDS));
    fflush(stdout);
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
    for (int i = 0; i < CHECKED; ++i) {
        point *p = &points[spread(i, CHECKED)];
        const fst_groups groups = fst_model_groups(p->model);
        if (!reference_state(&groups, p->start, p->t_end, 1e-16L, p->reference))
            return 0;
    }
    return 1;
}

static void compare(solver *solvers, int count, double goal)
{
    printf("\ngoal: every final state within %.0e of long double (worst of %d)\n", goal, CHECKED);
    printf("%-34s %9s %9s %9s %9s\n", "", "tolerance", "error", "ms", "GSL / it");
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
    for (int i = 0; i < count; ++i)
        report(&solvers[i], &solvers[0]);
}

int main(void)
{
    solver solvers[12];
    int count = 0;
    if (!prepare()) {
        fprintf(stderr, "the job could not be prepared\n");
        return 1;
    }
    printf("job: rigid, %d omegas on [0.36, 1.20], %d drive periods; ms are per trajectory (wall clock)\n",
           OMEGAS, PERIODS);
    solvers[count++] =
        (solver){.name = "GSL rk8pd", .solve = by_gsl, .step = &gsl_odeiv2_step_rk8pd, .sample = 8};
    solvers[count++] = (solver){.name = "GSL msadams",
                                .solve = by_gsl,
                                .step = &gsl_odeiv2_step_msadams,
                                .sample = 2,
                                .first_quarter = 24};
    solvers[count++] = (solver){.name = "festoon scalar", .solve = by_scalar, .sample = 8};
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
        solvers[count++] = (solver){
            .name = engines[i].states, .solve = by_lanes, .engine = engine, .threads = 1, .sample = 128};
        if (engines[i].two)
            solvers[count++] = (solver){
                .name = engines[i].two, .solve = by_lanes, .engine = engine, .threads = 2, .sample = 256};
        solvers[count++] = (solver){.name = engines[i].rows, .solve = by_rows, .engine = engine, .sample = 96};
    }
    compare(solvers, count, 1e-9);
    compare(solvers, count, 1e-6);
    for (int i = 0; i < OMEGAS; ++i)
        fst_model_free(points[i].model);
    return 0;
}
