/* bench_dry.c - dry friction: what a drive period costs at a given error of <r>, and a basin's trajectory alone
 * and in lanes.
 *
 * At mu = 0.2 and 10.7 Hz, the bead's periodic motion of three captures a return.  Processor time of one
 * thread. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <festoon/festoon.h>

enum { ROUNDS = 3, BASIN = 64 };
static const double PERIODS = 150.0;

static double seconds(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static fst_params dry_bead(void)
{
    fst_params p = fst_default_params();
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = 0.2;
    p.drive_frequency = 10.7;
    p.run_periods = PERIODS;
    p.run_discard = 50.0;
    return p;
}

/* <r> of a run, and the least processor time of some. */
static double timed_run(const fst_params *p, int rounds, double *least)
{
    const fst_run_options options = fst_default_run_options();
    fst_run_result result = {.mean_r = NAN};
    fst_error error = {FST_OK, "", ""};
    *least = INFINITY;
    for (int i = 0; i < rounds; ++i) {
        const double began = seconds();
        if (fst_run(p, &options, &result, &error) != FST_OK)
            (void)puts(error.sentence);
        *least = fmin(*least, seconds() - began);
    }
    return result.mean_r;
}

static void alone(double exact)
{
    static const double rtol[] = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
    (void)puts("            run.rtol   error of <r>   ms a drive period");
    for (size_t i = 0; i < sizeof rtol / sizeof *rtol; ++i) {
        fst_params p = dry_bead();
        double time;
        p.run_rtol = rtol[i];
        const double off = timed_run(&p, ROUNDS, &time) - exact;
        (void)printf("            %-8.0e   %-12.1e   %.3f\n", rtol[i], fabs(off), 1e3 * time / PERIODS);
    }
}

/* ------------------------------------------------------------------ a basin */

typedef struct basin {
    int next;
    fst_params params;
    double worst, exact;
    int outcomes[16];
} basin;

static int next_start(void *user, fst_row_job *job)
{
    basin *b = user;
    if (b->next == BASIN)
        return 0;
    memset(job, 0, sizeof *job);
    job->params = b->params;
    job->params.start_r = 0.7 + 0.05 * (b->next % 8);
    job->params.start_phi = 5.0 * (b->next / 8);
    job->point = b->next++;
    return 1;
}

static int take(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                const fst_error *error)
{
    (void)job, (void)error;
    basin *b = user;
    b->outcomes[status == FST_OK ? result->regime : 15] += 1;
    if (status == FST_OK && result->regime == FST_REGIME_COUNTER_ROTATING)
        b->worst = fmax(b->worst, fabs(result->mean_r - b->exact));
    return 0;
}

/* The trajectories of a basin by so many lanes of a form; *alone: the time of one by one lane, which is
 * measured there. */
static void in_lanes(const fst_params *p, double exact, fst_arithmetic arithmetic, int lanes, double *alone)
{
    basin b = {.params = *p, .exact = exact};
    const fst_row_work work = {
        .user = &b, .arithmetic = arithmetic, .lanes = lanes, .next = next_start, .done = take};
    fst_error error = {FST_OK, "", ""};
    const double began = seconds();
    if (fst_rows(&work, &error) != FST_OK) {
        (void)printf("            %s: %s\n", fst_arithmetic_name(arithmetic), error.sentence);
        return;
    }
    const double time = (seconds() - began) / BASIN;
    if (lanes == 1)
        *alone = time;
    (void)printf("            %-9s %d lanes   %6.1f ms a trajectory, %5.2f times cheaper;",
                 fst_arithmetic_name(arithmetic), lanes, 1e3 * time, *alone / time);
    for (int i = 0; i <= FST_REGIME_LIFTED; ++i)
        if (b.outcomes[i])
            (void)printf(" %d %s", b.outcomes[i], fst_regime_name((fst_regime)i));
    (void)printf(", <r> of those to %.1e\n", b.worst);
}

static void basins(const fst_params *p, double exact)
{
    double alone = 0.0;
    in_lanes(p, exact, FST_ARITHMETIC_PORTABLE, 1, &alone);
    in_lanes(p, exact, FST_ARITHMETIC_PORTABLE, 4, &alone);
    in_lanes(p, exact, FST_ARITHMETIC_PORTABLE, 8, &alone);
    in_lanes(p, exact, FST_ARITHMETIC_AVX2, 4, &alone);
    in_lanes(p, exact, FST_ARITHMETIC_AVX512, 8, &alone);
}

int main(void)
{
    fst_params p = dry_bead();
    double time;
    p.run_rtol = 1e-13;
    p.run_periods = 300.0;
    p.run_discard = 150.0;
    const double exact = timed_run(&p, 1, &time);
    (void)printf("dry friction, mu = 0.2, 10.7 Hz: <r> = %.12f\n", exact);
    alone(exact);
    p = dry_bead();
    for (p.run_rtol = 1e-5; p.run_rtol > 1e-11; p.run_rtol *= 1e-3) {
        (void)printf("a basin's trajectories: %g drive periods, %d starts, run.rtol = %.0e\n", PERIODS,
                     (int)BASIN, p.run_rtol);
        basins(&p, exact);
    }
    return 0;
}
