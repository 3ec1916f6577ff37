/* bench_shares.c - where the time of rows in lanes goes.
 *
 *   bench_shares                print the shares of each part
 *   bench_shares --steps FORM   print how often each instruction of one round of steps is executed, as offsets
 *                               into this program (ports.py reads that)
 *
 * Rows are given an engine of lanes with a clock around each of its functions (timed_engine.h); what is left is
 * scalar code.  The right-hand side is timed alone, and so are steps, of which the rest is the sums of the
 * stages, the error and the sizes.  The job is that of ensemble.h with 200 drive periods.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ensemble.h"
#include "instructions.h"
#include "peak.h"
#include "results.h"
#include "rhs_lanes.h"
#include "timed_engine.h"

enum { POINTS = 96, PERIODS = 200, ROUNDS = 5, EVALUATIONS = 12, AT_A_TIME = 1000, TRIES = 20 };

typedef struct form {
    fst_arithmetic arithmetic;
    int lanes;
    const char *name;
    rhs_lanes *rhs;
} form;

#if defined(__x86_64__) && defined(__GNUC__)
static const form FORMS[] = {{FST_ARITHMETIC_PORTABLE, 8, "portable, 8 lanes", rhs_lanes_portable8},
                             {FST_ARITHMETIC_AVX2, 4, "avx2", rhs_lanes_avx2},
                             {FST_ARITHMETIC_AVX512, 8, "avx512", rhs_lanes_avx512}};
enum { FORM_COUNT = sizeof FORMS / sizeof *FORMS };
#else
static const form FORMS[1];
enum { FORM_COUNT = 0 };
#endif

static ensemble_point points[POINTS];
static const ensemble_point *which[POINTS];

/* ------------------------------------------------------------------ one round of steps */

typedef struct steps {
    const fst_lane_engine *engine;
    void *batch;
    fst_flow *flows[FST_MOST_LANES];
} steps;

static void free_steps(steps *s)
{
    for (int l = 0; l < FST_MOST_LANES; ++l)
        fst_flow_free(s->flows[l]);
    free(s->batch);
}

/* Lanes that may make the same step again and again, because nobody calls advance(). */
static int make_steps(steps *s, const fst_lane_engine *engine)
{
    const size_t bytes = (engine->bytes + 63) / 64 * 64;
    *s = (steps){.engine = engine, .batch = aligned_alloc(64, bytes)};
    if (!s->batch)
        return 0;
    memset(s->batch, 0, bytes);
    for (int l = 0; l < engine->width; ++l) {
        const ensemble_point *p = which[l * POINTS / engine->width];
        fst_flow_options options = fst_default_flow_options();
        options.first_step = 1e-3;
        if (fst_flow_new(p->model, &options, p->start, &s->flows[l], NULL) != FST_OK)
            return 0;
        engine->load(s->batch, l, s->flows[l], 1e9);
    }
    return 1;
}

static void one_round(void *user)
{
    const steps *s = user;
    (void)s->engine->try_steps(s->batch);
}

/* ------------------------------------------------------------------ times */

/* Ticks of a round of steps, and of as many evaluations of the right-hand side alone: the least of some tries.
 */
static void time_alone(const form *f, steps *s, double *step, double *evaluations)
{
    const fst_groups groups = fst_model_groups(points[0].model);
    *step = *evaluations = INFINITY;
    for (int i = 0; i < TRIES; ++i) {
        double began = timed_engine_now();
        for (int k = 0; k < AT_A_TIME; ++k)
            one_round(s);
        *step = fmin(*step, (timed_engine_now() - began) / AT_A_TIME);
        began = timed_engine_now();
        f->rhs(&points[0].params, &groups, points[0].start, AT_A_TIME * EVALUATIONS);
        *evaluations = fmin(*evaluations, (timed_engine_now() - began) / AT_A_TIME);
    }
}

typedef struct shares {
    double part[TIMED_PARTS], scalar, rounds, accepted, observed; /* the parts as shares of the whole */
} shares;

static int time_rows(const fst_lane_engine *engine, double tolerance, shares *to)
{
    static fst_run_result results[POINTS];
    timed_engine account;
    const fst_lane_engine timed = timed_engine_of(engine, &account);
    const double began = timed_engine_now();
    if (!ensemble_rows(&timed, which, POINTS, tolerance, results))
        return 0;
    const double whole = timed_engine_now() - began - account.readings_ticks;
    to->scalar = 1.0;
    for (int i = 0; i < TIMED_PARTS; ++i) {
        to->part[i] = account.ticks[i] / whole;
        to->scalar -= to->part[i];
    }
    to->rounds = account.rounds;
    to->accepted = account.accepted;
    to->observed = account.observed;
    return 1;
}

static double median_share(const shares *s, size_t offset)
{
    double values[ROUNDS];
    for (int i = 0; i < ROUNDS; ++i)
        memcpy(&values[i], (const char *)&s[i] + offset, sizeof values[i]);
    return result_median(values, ROUNDS);
}

static void put(const char *row, const char *column, double share)
{
    printf("    %-52s %5.1f %%\n", row, 100.0 * share);
    result_put("shares of full rows", row, column, "%.1f %%", 100.0 * share);
}

#define MEDIAN(member) median_share(measured, offsetof(shares, member))

static void report_form(const form *f, const fst_lane_engine *engine, double tolerance, double rhs_in_steps)
{
    shares measured[ROUNDS];
    char column[64];
    for (int i = 0; i < ROUNDS; ++i)
        if (!time_rows(engine, tolerance, &measured[i]))
            return;
    (void)snprintf(column, sizeof column, "%s, %.0e", f->name, tolerance);
    printf("  full rows, %s:\n", column);
    const double in_steps = MEDIAN(part[TIMED_STEPS]);
    put("steps: right-hand side", column, in_steps * rhs_in_steps);
    put("steps: sums of the stages, error, sizes", column, in_steps * (1.0 - rhs_in_steps));
    put("whether something may have happened", column, MEDIAN(part[TIMED_WATCHING]));
    put("integrands and their integrals", column, MEDIAN(part[TIMED_OBSERVATION]));
    put("extremes", column, MEDIAN(part[TIMED_EXTREMES]));
    put("scalar code, with copies out of lanes", column, MEDIAN(part[TIMED_IN_AND_OUT]) + MEDIAN(scalar));
    const shares *s = &measured[0]; /* the same in every round */
    put("(of the lanes, a step accepted in)", column, s->accepted / (s->rounds * engine->width));
    put("(of these steps, observed)", column, s->observed / s->accepted);
    fflush(stdout);
}

static void report(const form *f, const fst_lane_engine *engine, double ns_of_tick)
{
    steps s;
    double step, evaluations;
    if (!make_steps(&s, engine))
        return;
    time_alone(f, &s, &step, &evaluations);
    free_steps(&s);
    const double peak = 1e9 * peak_seconds(engine->width, 1);
    printf("%s: one evaluation of all lanes alone %.1f ns, %d of them and a round of steps %.3f; a fused "
           "operation %.4f ns\n",
           f->name, ns_of_tick * evaluations / EVALUATIONS, EVALUATIONS, evaluations / step, peak);
    const double rhs_in_steps = fmin(1.0, evaluations / step);
    result_put("steps alone", f->name, "ns an evaluation alone", "%.1f",
               ns_of_tick * evaluations / EVALUATIONS);
    result_put("steps alone", f->name, "ns an evaluation in a step", "%.1f", ns_of_tick * step / EVALUATIONS);
    result_put("steps alone", f->name, "ns a fused operation", "%.4f", peak);
    report_form(f, engine, 1e-9, rhs_in_steps);
    report_form(f, engine, 1e-6, rhs_in_steps);
}

int main(int argc, char **argv)
{
    for (int i = 0; i < POINTS; ++i) {
        if (!ensemble_point_make(&points[i], 0.36 + (1.20 - 0.36) * (i + 0.5) / POINTS, PERIODS))
            return 1;
        which[i] = &points[i];
    }
    const double ns_of_tick = timed_engine_ns_of_tick();
    for (int i = 0; i < FORM_COUNT; ++i) {
        const fst_lane_engine *engine = fst_lane_engine_of(FORMS[i].arithmetic, FORMS[i].lanes);
        steps s;
        if (!engine || (argc > 2 && strcmp(argv[2], FORMS[i].name) != 0))
            continue;
        if (argc < 3)
            report(&FORMS[i], engine, ns_of_tick);
        else if (make_steps(&s, engine)) {
            one_round(&s);
            instructions_print(one_round, &s);
            free_steps(&s);
        }
    }
    for (int i = 0; i < POINTS; ++i)
        fst_model_free(points[i].model);
    return 0;
}
