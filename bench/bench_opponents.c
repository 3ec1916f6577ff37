/* bench_opponents.c - work and precision: error against time of a trajectory, for festoon and for others.
 *
 *   bench_opponents WORK-PRECISION.csv REFERENCE.csv
 *
 * The job is that of bench_ensemble, with the same right-hand side for all; the error is the greatest component
 * of a final state's difference from long double, the worst of the trajectories that a solver computes (slow
 * solvers compute fewer).  Times are those of the processor, since other programs may be at work: medians of
 * rounds in which all solvers take their turn.  The first file gets a line for each solver and tolerance, the
 * second one the final states in long double, by which opponents_scipy.py judges.
 */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "final_states.h"
#include "opponents_job.h"
#include "opponents_model.h"
#include "reference.h"

enum { POINTS = 32, ROUNDS = 3, TOLERANCES = 10, MOST_SOLVERS = 8 };

static const job_trajectory *trajectories[POINTS];
static double references[POINTS][FST_STATE_SIZE];

typedef struct solver {
    const char *name;
    int (*solve)(const struct solver *self, const int *which, int count, double tolerance,
                 double (*ends)[FST_STATE_SIZE]);
    int count; /* number of trajectories */
    const fst_lane_engine *engine;
    const gsl_odeiv2_step_type **step;
    int works[TOLERANCES];
    double error[TOLERANCES], ms[TOLERANCES][ROUNDS];
} solver;

/* ------------------------------------------------------------------ solvers */

static fst_flow *flow_of(const job_trajectory *trajectory, double tolerance)
{
    fst_flow_options options = fst_default_flow_options();
    fst_flow *flow = NULL;
    double start[FST_STATE_SIZE];
    options.rtol = tolerance;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = tolerance;
    job_start(trajectory, start);
    (void)fst_flow_new(job_model(trajectory), &options, start, &flow, NULL);
    return flow;
}

static int by_scalar(const solver *self, const int *which, int count, double tolerance,
                     double (*ends)[FST_STATE_SIZE])
{
    (void)self;
    int good = 1;
    for (int i = 0; i < count && good; ++i) {
        fst_stop stop;
        const job_trajectory *trajectory = trajectories[which[i]];
        fst_flow *flow = flow_of(trajectory, tolerance);
        good = flow && fst_flow_next(flow, job_end_time(trajectory), 0, &stop, NULL) == FST_OK;
        if (good)
            memcpy(ends[i], fst_flow_get(flow).state, sizeof ends[i]);
        fst_flow_free(flow);
    }
    return good;
}

static int by_lanes(const solver *self, const int *which, int count, double tolerance,
                    double (*ends)[FST_STATE_SIZE])
{
    fst_flow *flows[POINTS] = {NULL};
    double t_end[POINTS];
    int good = 1;
    for (int i = 0; i < count; ++i) {
        flows[i] = flow_of(trajectories[which[i]], tolerance);
        t_end[i] = job_end_time(trajectories[which[i]]);
        good = good && flows[i];
    }
    good = good && fst_final_states(self->engine, flows, t_end, count, ends, NULL) == FST_OK;
    for (int i = 0; i < count; ++i)
        fst_flow_free(flows[i]);
    return good;
}

static int gsl_rhs(double t, const double y[], double dy[], void *data)
{
    (void)t;
    job_rhs(data, y, dy);
    return GSL_SUCCESS;
}

static int by_gsl(const solver *self, const int *which, int count, double tolerance,
                  double (*ends)[FST_STATE_SIZE])
{
    int good = 1;
    for (int i = 0; i < count && good; ++i) {
        const job_trajectory *trajectory = trajectories[which[i]];
        gsl_odeiv2_system system = {gsl_rhs, NULL, FST_STATE_SIZE, (void *)(uintptr_t)trajectory};
        gsl_odeiv2_driver *driver =
            gsl_odeiv2_driver_alloc_y_new(&system, *self->step, 1e-3, tolerance, tolerance);
        double t = 0.0;
        job_start(trajectory, ends[i]);
        good = gsl_odeiv2_driver_apply(driver, &t, job_end_time(trajectory), ends[i]) == GSL_SUCCESS;
        gsl_odeiv2_driver_free(driver);
    }
    return good;
}

static int by_odeint(const solver *self, const int *which, int count, double tolerance,
                     double (*ends)[FST_STATE_SIZE])
{
    (void)self;
    int good = 1;
    for (int i = 0; i < count && good; ++i)
        good = job_by_odeint(trajectories[which[i]], tolerance, ends[i]);
    return good;
}

static int list_solvers(solver *solvers)
{
    static const struct {
        fst_arithmetic form;
        int lanes;
        const char *name;
    } engines[] = {{FST_ARITHMETIC_PORTABLE, 8, "festoon portable 8 lanes"},
                   {FST_ARITHMETIC_AVX2, 4, "festoon avx2"},
                   {FST_ARITHMETIC_AVX512, 8, "festoon avx512"}};
    int count = 0;
    solvers[count++] =
        (solver){.name = "GSL msadams", .solve = by_gsl, .count = 2, .step = &gsl_odeiv2_step_msadams};
    solvers[count++] =
        (solver){.name = "GSL rk8pd", .solve = by_gsl, .count = 8, .step = &gsl_odeiv2_step_rk8pd};
    solvers[count++] = (solver){.name = "Boost.odeint fehlberg78", .solve = by_odeint, .count = 8};
    solvers[count++] = (solver){.name = "festoon scalar", .solve = by_scalar, .count = 8};
    for (size_t i = 0; i < sizeof engines / sizeof *engines; ++i) {
        const fst_lane_engine *engine = fst_lane_engine_of(engines[i].form, engines[i].lanes);
        if (engine)
            solvers[count++] =
                (solver){.name = engines[i].name, .solve = by_lanes, .count = POINTS, .engine = engine};
    }
    return count;
}

/* ------------------------------------------------------------------ measuring */

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double tolerance_of(int i)
{
    return pow(10.0, -4 - i);
}

/* One turn of a solver at one tolerance: its time and error. */
static void take_turn(solver *s, int tolerance, int round)
{
    int which[POINTS];
    double ends[POINTS][FST_STATE_SIZE], worst = 0.0;
    for (int i = 0; i < s->count; ++i)
        which[i] = (2 * i + 1) * POINTS / (2 * s->count);
    const double begin = seconds();
    s->works[tolerance] = s->solve(s, which, s->count, tolerance_of(tolerance), ends);
    s->ms[tolerance][round] = 1e3 * (seconds() - begin) / s->count;
    for (int i = 0; i < s->count && s->works[tolerance]; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            worst = fmax(worst, fabs(ends[i][k] - references[which[i]][k]));
    s->error[tolerance] = worst;
}

static double median(const double ms[ROUNDS])
{
    const double least = fmin(fmin(ms[0], ms[1]), ms[2]), most = fmax(fmax(ms[0], ms[1]), ms[2]);
    return ms[0] + ms[1] + ms[2] - least - most;
}

static int prepare(const char *path)
{
    FILE *out = fopen(path, "w");
    if (!out)
        return 0;
    (void)fputs("index,count,X,Y,vX,vY,nX,nY,nZ,WX,WY,WZ\n", out);
    int good = 1;
    for (int i = 0; i < POINTS && good; ++i) {
        trajectories[i] = job_trajectory_new(i, POINTS);
        if (!trajectories[i])
            break;
        const fst_groups groups = fst_model_groups(job_model(trajectories[i]));
        double start[FST_STATE_SIZE];
        job_start(trajectories[i], start);
        good = reference_state(job_params(trajectories[i]), &groups, start, job_end_time(trajectories[i]),
                               1e-16L, references[i]);
        (void)fprintf(out, "%d,%d", i, POINTS);
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            (void)fprintf(out, ",%.17g", references[i][k]);
        (void)fputc('\n', out);
    }
    return fclose(out) == 0 && good && trajectories[POINTS - 1];
}

static int report(const solver *solvers, int count, const char *path)
{
    FILE *out = fopen(path, "w");
    if (!out)
        return 0;
    (void)fputs("solver,tolerance,error,ms\n", out);
    printf("\nwork and precision: %-12s %9s %9s %9s\n", "", "tolerance", "error", "ms");
    for (int s = 0; s < count; ++s)
        for (int i = 0; i < TOLERANCES; ++i) {
            if (!solvers[s].works[i])
                continue;
            const double ms = median(solvers[s].ms[i]);
            printf("%-34s %9.1e %9.1e %9.3f  (%d trajectories)\n", solvers[s].name, tolerance_of(i),
                   solvers[s].error[i], ms, solvers[s].count);
            (void)fprintf(out, "%s,%.1e,%.3e,%.4f\n", solvers[s].name, tolerance_of(i), solvers[s].error[i],
                          ms);
        }
    return fclose(out) == 0;
}

int main(int argc, char **argv)
{
    static solver solvers[MOST_SOLVERS];
    if (argc != 3) {
        fprintf(stderr, "usage: bench_opponents WORK-PRECISION.csv REFERENCE.csv\n");
        return 2;
    }
    if (!prepare(argv[2])) {
        fprintf(stderr, "the job could not be prepared, or %s not written\n", argv[2]);
        return 1;
    }
    const int count = list_solvers(solvers);
    (void)gsl_set_error_handler_off();
    for (int round = 0; round < ROUNDS; ++round)
        for (int i = 0; i < TOLERANCES; ++i)
            for (int s = 0; s < count; ++s)
                take_turn(&solvers[s], i, round);
    if (!report(solvers, count, argv[1])) {
        fprintf(stderr, "%s: %s\n", argv[1], strerror(errno));
        return 1;
    }
    return 0;
}
