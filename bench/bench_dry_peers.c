/* bench_dry_peers.c - what a mean costs under dry friction: festoon's event-driven runs against Siconos and
 * CVODE.
 *
 * The job is that of dry_peers.h.  An opponent and the run that it is compared with reach the same error of
 * <r>; the settings below are the loosest that do, and the table shows the errors that were reached.  Times are
 * those of the processor for a drive period, with everything that a solver needs to be made; medians of rounds
 * in which all take their turn, and of the ratios within a round.  festoon's runs give all their results, not
 * <r> alone.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "dry_peers.h"

#ifdef DRY_SICONOS
#include <siconos/numerics/Friction_cst.h>
#endif

enum { ROUNDS = 5 };
static const double TWO_PI = 6.283185307179586476925287;

typedef struct solver {
    const char *name;
    double goal;
    dry_peer *solve;
    dry_setting setting;
    int against; /* index of the festoon run with the same goal */
    int works;
    double error, ms[ROUNDS];
} solver;

static int by_festoon(const dry_job *job, const dry_setting *setting, double *mean_r, double *periods)
{
    fst_params p = job->params;
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    p.run_periods = *periods = 13.0;
    p.run_discard = 3.0;
    p.run_rtol = setting->step;
    options.start = job->start;
    const int good = fst_run(&p, &options, &result, NULL) == FST_OK;
    *mean_r = result.mean_r;
    return good;
}

enum { AT_3, AT_4, AT_6, AT_8, AT_10 };
static solver solvers[] = {
    {.name = "festoon run", .goal = 1e-3, .solve = by_festoon, .setting = {.step = 2.2e-4}, .against = AT_3},
    {.name = "festoon run", .goal = 1e-4, .solve = by_festoon, .setting = {.step = 3.7e-5}, .against = AT_4},
    {.name = "festoon run", .goal = 1e-6, .solve = by_festoon, .setting = {.step = 5.5e-7}, .against = AT_6},
    {.name = "festoon run", .goal = 1e-8, .solve = by_festoon, .setting = {.step = 2.4e-8}, .against = AT_8},
    {.name = "festoon run", .goal = 1e-10, .solve = by_festoon, .setting = {.step = 1.5e-9}, .against = AT_10},
#ifdef DRY_SICONOS
    {.name = "Siconos, its quickest solver",
     .goal = 1e-3,
     .solve = dry_by_siconos,
     .setting = {.solver = SICONOS_FRICTION_3D_ONECONTACT_QUARTIC_NU, .step = 0.08},
     .against = AT_3},
    {.name = "Siconos, its usual solver",
     .goal = 1e-3,
     .solve = dry_by_siconos,
     .setting = {.solver = SICONOS_FRICTION_3D_NSGS, .step = 0.08},
     .against = AT_3},
    {.name = "the same, pull at the beginning",
     .goal = 1e-3,
     .solve = dry_by_siconos,
     .setting = {.solver = SICONOS_FRICTION_3D_NSGS, .early = 1, .step = 0.006},
     .against = AT_3},
    {.name = "Siconos, its quickest solver",
     .goal = 1e-4,
     .solve = dry_by_siconos,
     .setting = {.solver = SICONOS_FRICTION_3D_ONECONTACT_QUARTIC_NU, .step = 0.018},
     .against = AT_4},
    {.name = "Siconos, its quickest solver",
     .goal = 1e-6,
     .solve = dry_by_siconos,
     .setting = {.solver = SICONOS_FRICTION_3D_ONECONTACT_QUARTIC_NU, .step = 2.25e-4},
     .against = AT_6},
#endif
#ifdef DRY_CVODE
    {.name = "CVODE BDF, regularised law",
     .goal = 1e-3,
     .solve = dry_by_cvode,
     .setting = {.step = 1e-5, .width = 3e-4},
     .against = AT_3},
    {.name = "CVODE BDF, regularised law",
     .goal = 1e-4,
     .solve = dry_by_cvode,
     .setting = {.step = 5e-7, .width = 2.5e-5},
     .against = AT_4},
    {.name = "CVODE BDF, regularised law",
     .goal = 1e-6,
     .solve = dry_by_cvode,
     .setting = {.step = 1e-10, .width = 1.5e-7},
     .against = AT_6},
    {.name = "CVODE BDF, regularised law",
     .goal = 1e-8,
     .solve = dry_by_cvode,
     .setting = {.step = 1e-14, .width = 6.5e-10},
     .against = AT_8},
#endif
};
enum { SOLVERS = sizeof solvers / sizeof *solvers };

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double mean_at(const dry_job *job, double rtol, double periods, double *state)
{
    fst_params p = job->params;
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    p.run_periods = periods;
    p.run_discard = 0.5 * periods;
    p.run_rtol = rtol;
    if (state)
        options.start = state;
    if (fst_run(&p, &options, &result, NULL) != FST_OK)
        return NAN;
    if (state)
        memcpy(state, result.final_state, sizeof result.final_state);
    return result.mean_r;
}

/* The job, with a start on the periodic motion; 0 if it could not be made. */
static int prepare(dry_job *job, double *mean_r)
{
    fst_params smooth;
    job->params = fst_default_params();
    job->params.friction_law = FST_FRICTION_COULOMB;
    job->params.friction_mu = job->mu = 0.2;
    job->params.drive_frequency = 10.7;
    smooth = job->params;
    smooth.friction_law = FST_FRICTION_NONE;
    if (fst_model_new(&job->params, &job->model, NULL) != FST_OK ||
        fst_model_new(&smooth, &job->smooth, NULL) != FST_OK ||
        fst_start_state(&job->params, job->model, job->start, NULL) != FST_OK)
        return 0;
    job->drive_period = TWO_PI / job->model->world.omega;
    *mean_r = mean_at(job, 1e-13, 400.0, job->start);
    *mean_r = mean_at(job, 1e-13, 100.0, job->start);
    return isfinite(*mean_r);
}

static int compare(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static double median(const double *numbers)
{
    double sorted[ROUNDS];
    memcpy(sorted, numbers, sizeof sorted);
    qsort(sorted, ROUNDS, sizeof *sorted, compare);
    return sorted[ROUNDS / 2];
}

/* The solvers that take part: CVODE, the last ones of the list, only if its times say something. */
static int count_solvers(void)
{
    int count = SOLVERS;
#ifdef DRY_CVODE
    if (!dry_cvode_is_optimised()) {
        printf("\nCVODE is Debian's, compiled without optimisation: it is left out\n");
        while (solvers[count - 1].solve == dry_by_cvode)
            --count;
    }
#endif
    return count;
}

static void take_turn(solver *s, const dry_job *job, double reference, int round)
{
    double mean_r = NAN, periods = NAN;
    const double begin = seconds();
    s->works = s->solve(job, &s->setting, &mean_r, &periods);
    s->ms[round] = 1e3 * (seconds() - begin) / periods;
    s->error = fabs(mean_r - reference);
}

static void report(int count)
{
    printf("\ndry friction, mu 0.2, 10.7 Hz: ms of the processor a drive period, for an error of <r>\n");
    printf("%-32s %8s %10s %9s %9s %12s\n", "", "goal", "setting", "error", "ms", "it / festoon");
    for (int i = 0; i < count; ++i) {
        const solver *s = &solvers[i];
        double ratio[ROUNDS];
        if (!s->works) {
            printf("%-32s %8.0e failed\n", s->name, s->goal);
            continue;
        }
        for (int round = 0; round < ROUNDS; ++round)
            ratio[round] = s->ms[round] / solvers[s->against].ms[round];
        printf("%-32s %8.0e %10.2e %9.1e %9.3f %12.2f%s\n", s->name, s->goal,
               s->setting.width > 0.0 ? s->setting.width : s->setting.step, s->error, median(s->ms),
               median(ratio), s->error > s->goal ? "  (misses its goal)" : "");
    }
    printf("settings: run.rtol; Siconos: length of a step; CVODE: v_s of V/sqrt(V^2 + v_s^2)\n");
}

int main(void)
{
    dry_job job;
    double reference;
    if (!prepare(&job, &reference)) {
        fprintf(stderr, "the job could not be prepared\n");
        return 1;
    }
    const int count = count_solvers();
    for (int round = 0; round < ROUNDS; ++round)
        for (int i = 0; i < count; ++i)
            take_turn(&solvers[i], &job, reference, round);
    report(count);
    fst_model_free(job.model);
    fst_model_free(job.smooth);
    return 0;
}
