/* bench_trajectory.c - one trajectory on one core: festoon against GSL's rk8pd with the same right-hand side.
 *
 * The job: dynamics `rigid`, the paper's parameters, omega = 0.405, 200 drive periods from the free-rolling
 * start at r = 0.95.  Each solver gets the loosest tolerance, on a grid of quarter decades, at which the final
 * state is within 1e-9 (greatest component) of a long-double reference; then the two run in turn, and the ratio
 * of their times is taken pair by pair.  Both are compiled with the same flags, and the right-hand side is the
 * same inline body.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "model/model.h"
#include "reference.h"

#define TWO_PI 6.283185307179586476925287
static const double GOAL = 1e-9;

typedef struct job {
    fst_model *model;
    double start[FST_STATE_SIZE], reference[FST_STATE_SIZE], t_end;
    uint64_t rhs_calls;
} job;

typedef int (*solver)(job *job, double tolerance, double end[FST_STATE_SIZE]);

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_festoon(job *j, double tolerance, double end[FST_STATE_SIZE])
{
    fst_flow_options o = fst_default_flow_options();
    o.rtol = tolerance;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = tolerance;
    fst_flow *flow;
    fst_stop stop;
    if (fst_flow_new(j->model, &o, j->start, &flow, NULL) != FST_OK)
        return 0;
    const int good = fst_flow_next(flow, j->t_end, 0, &stop, NULL) == FST_OK;
    const fst_flow_info info = fst_flow_get(flow);
    memcpy(end, info.state, sizeof info.state);
    j->rhs_calls = info.rhs_calls;
    fst_flow_free(flow);
    return good;
}

static int gsl_rhs(double t, const double y[], double dy[], void *data)
{
    (void)t;
    job *j = data;
    fst_pull_double p;
    fst_rhs_double(&j->model->world, NULL, j->model->world.omega, y, dy, &p);
    j->rhs_calls += 1;
    return GSL_SUCCESS;
}

static int by_gsl(job *j, double tolerance, double end[FST_STATE_SIZE])
{
    gsl_odeiv2_system system = {gsl_rhs, NULL, FST_STATE_SIZE, j};
    j->rhs_calls = 0;
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, tolerance, tolerance);
    double t = 0.0;
    memcpy(end, j->start, sizeof j->start);
    const int good = gsl_odeiv2_driver_apply(driver, &t, j->t_end, end) == GSL_SUCCESS;
    gsl_odeiv2_driver_free(driver);
    return good;
}

static double error_of(const job *j, const double *end)
{
    double worst = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        const double e = fabs(end[i] - j->reference[i]);
        worst = e > worst ? e : worst;
    }
    return worst;
}

/* The loosest tolerance that reaches the goal, and the error there. */
static double loosest(job *j, solver solve, double *error)
{
    for (int quarter = 28; quarter <= 60; ++quarter) {
        double tolerance = 1.0, end[FST_STATE_SIZE];
        for (int i = 0; i < quarter; ++i)
            tolerance *= 0.56234132519034908;
        if (!solve(j, tolerance, end))
            continue;
        *error = error_of(j, end);
        if (*error <= GOAL)
            return tolerance;
    }
    return 0.0;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, ascending);
    return values[count / 2];
}

static double time_of(job *j, solver solve, double tolerance)
{
    double end[FST_STATE_SIZE];
    const double start = seconds();
    (void)solve(j, tolerance, end);
    return seconds() - start;
}

/* Nanoseconds of one right-hand side in a chain of dependent calls: the least and the median of many short
 * rounds. */
static void time_rhs(const job *j)
{
    enum { ROUNDS = 301, CALLS = 2000 };
    static double round_ns[ROUNDS];
    double y[FST_STATE_SIZE], dy[FST_STATE_SIZE];
    memcpy(y, j->start, sizeof y);
    for (int r = 0; r < ROUNDS; ++r) {
        const double start = seconds();
        for (int i = 0; i < CALLS; ++i) {
            fst_pull_double p;
            fst_rhs_double(&j->model->world, NULL, j->model->world.omega, y, dy, &p);
            for (int k = 0; k < FST_STATE_SIZE; ++k)
                y[k] += 1e-14 * dy[k]; /* the next call depends on all of this one */
        }
        round_ns[r] = (seconds() - start) / CALLS * 1e9;
    }
    const volatile double sink = y[0]; /* keeps the compiler from leaving the calls out */
    (void)sink;
    const double middle = median(round_ns, ROUNDS);
    printf("right-hand side, 10 charges, 1 core:   %.1f ns (median), %.1f ns (least)\n", middle, round_ns[0]);
}

int main(void)
{
    enum { PAIRS = 31 };
    fst_params p = fst_default_params();
    p.drive_omega = 0.405;
    job j;
    fst_error error;
    if (fst_model_new(&p, &j.model, &error) != FST_OK ||
        fst_start_state(&p, j.model, j.start, &error) != FST_OK) {
        fprintf(stderr, "%s\n", error.sentence);
        return 1;
    }
    j.t_end = 200 * TWO_PI / p.drive_omega;
    const fst_groups groups = fst_model_groups(j.model);
    double coarser[FST_STATE_SIZE];
    if (!reference_state(&p, &groups, j.start, j.t_end, 1e-17L, j.reference) ||
        !reference_state(&p, &groups, j.start, j.t_end, 1e-15L, coarser))
        return 1;
    printf("job: rigid, omega = 0.405, 200 drive periods, goal: final state within %.0e\n", GOAL);
    printf("long-double reference: its own error about %.1e\n", error_of(&j, coarser));
    time_rhs(&j);
    double our_error = 0, their_error = 0;
    const double ours = loosest(&j, by_festoon, &our_error), theirs = loosest(&j, by_gsl, &their_error);
    double t_ours[PAIRS], t_theirs[PAIRS], ratio[PAIRS];
    uint64_t our_calls = 0, their_calls = 0;
    for (int i = 0; i < PAIRS; ++i) {
        t_ours[i] = time_of(&j, by_festoon, ours);
        our_calls = j.rhs_calls;
        t_theirs[i] = time_of(&j, by_gsl, theirs);
        their_calls = j.rhs_calls;
        ratio[i] = t_theirs[i] / t_ours[i];
    }
    const double ms_ours = 1e3 * median(t_ours, PAIRS), ms_theirs = 1e3 * median(t_theirs, PAIRS);
    printf("%-22s %10s %10s %12s %10s %8s\n", "solver", "tolerance", "error", "rhs calls", "ms", "ns/rhs");
    printf("%-22s %10.1e %10.1e %12llu %10.2f %8.1f\n", "festoon, scalar", ours, our_error,
           (unsigned long long)our_calls, ms_ours, 1e6 * ms_ours / (double)our_calls);
    printf("%-22s %10.1e %10.1e %12llu %10.2f %8.1f\n", "GSL rk8pd", theirs, their_error,
           (unsigned long long)their_calls, ms_theirs, 1e6 * ms_theirs / (double)their_calls);
    const double middle = median(ratio, PAIRS);
    printf("time of GSL rk8pd over festoon: median %.2f (%.2f to %.2f over %d pairs)\n", middle, ratio[0],
           ratio[PAIRS - 1], PAIRS);
    fst_model_free(j.model);
    return 0;
}
