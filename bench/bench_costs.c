/* bench_costs.c - what a trajectory and a row cost at which tolerance, and a drive period of them in runs of
 * how many.
 *
 * The job is that of ensemble.h.  All ways take their turn at all costs, round after round; printed are medians
 * of the processor time.  Low omegas come first, because their runs last longest, so that few lanes idle at the
 * end.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "ensemble.h"
#include "results.h"

enum { MOST_POINTS = 64, ROUNDS = 3, TOLERANCES = 10, LENGTHS = 5, USUAL_PERIODS = 200, MOST_WAYS = 8 };
static const int LENGTH[LENGTHS] = {20, 50, 200, 800, 3200};
static const double USUAL_TOLERANCE = 1e-9;

typedef struct way {
    ensemble_method method;
    int points; /* at the usual tolerance and length */
    double at_tolerance[TOLERANCES][ROUNDS], at_length[LENGTHS][ROUNDS];
} way;

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Seconds that a point takes; INFINITY where it could not be done. */
static double seconds_each(const way *w, double tolerance, int periods)
{
    static ensemble_point points[MOST_POINTS];
    const ensemble_point *which[MOST_POINTS] = {NULL};
    static double ends[MOST_POINTS][FST_STATE_SIZE];
    const int least = w->method.engine ? 16 : 2, wanted = w->points * USUAL_PERIODS / periods;
    const int count = wanted < least ? least : wanted < w->points ? wanted : w->points;
    int good = 1;
    for (int i = 0; i < count; ++i) {
        good = ensemble_point_make(&points[i], 0.36 + (1.20 - 0.36) * (i + 0.5) / count, periods) && good;
        which[i] = &points[i];
    }
    const double began = seconds();
    good = good && w->method.solve(&w->method, which, count, tolerance, ends);
    const double took = seconds() - began;
    for (int i = 0; i < count; ++i)
        fst_model_free(points[i].model);
    return good ? took / count : INFINITY;
}

static double tolerance_of(int i)
{
    return pow(10.0, -4 - i);
}

static void measure(way *ways, int count)
{
    for (int round = 0; round < ROUNDS; ++round)
        for (int i = 0; i < TOLERANCES; ++i)
            for (int k = 0; k < count; ++k)
                ways[k].at_tolerance[i][round] = seconds_each(&ways[k], tolerance_of(i), USUAL_PERIODS);
    for (int round = 0; round < ROUNDS; ++round)
        for (int i = 0; i < LENGTHS; ++i)
            for (int k = 0; k < count; ++k)
                ways[k].at_length[i][round] = seconds_each(&ways[k], USUAL_TOLERANCE, LENGTH[i]);
}

static void report(way *ways, int count)
{
    char column[32];
    printf("cost against tolerance: ms of processor time a run of %d drive periods\n%-36s", USUAL_PERIODS, "");
    for (int i = 0; i < TOLERANCES; ++i)
        printf(" %7.0e", tolerance_of(i));
    for (int k = 0; k < count; ++k) {
        printf("\n%-36s", ways[k].method.name);
        for (int i = 0; i < TOLERANCES; ++i) {
            const double ms = 1e3 * result_median(ways[k].at_tolerance[i], ROUNDS);
            printf(" %7.3g", ms);
            (void)snprintf(column, sizeof column, "%.0e", tolerance_of(i));
            result_put("cost against tolerance", ways[k].method.name, column, "%.3g", ms);
        }
    }
    printf("\n\ncost against periods: us of processor time a drive period at a tolerance of %.0e\n%-36s",
           USUAL_TOLERANCE, "");
    for (int i = 0; i < LENGTHS; ++i)
        printf(" %7d", LENGTH[i]);
    for (int k = 0; k < count; ++k) {
        printf("\n%-36s", ways[k].method.name);
        for (int i = 0; i < LENGTHS; ++i) {
            const double us = 1e6 * result_median(ways[k].at_length[i], ROUNDS) / LENGTH[i];
            printf(" %7.3g", us);
            (void)snprintf(column, sizeof column, "%d", LENGTH[i]);
            result_put("cost against periods", ways[k].method.name, column, "%.3g", us);
        }
    }
    printf("\n");
}

int main(void)
{
    static way ways[MOST_WAYS];
    static const struct {
        fst_arithmetic form;
        int lanes, states_points, rows_points;
        const char *states, *rows;
    } engines[] = {
        {FST_ARITHMETIC_PORTABLE, 8, 48, 16, "portable, 8 lanes, final states", "portable, 8 lanes, full rows"},
        {FST_ARITHMETIC_AVX2, 4, 48, 48, "avx2, final states", "avx2, full rows"},
        {FST_ARITHMETIC_AVX512, 8, 64, 48, "avx512, final states", "avx512, full rows"}};
    int count = 0;
    ways[count++] = (way){.method = {.name = "scalar, final states", .solve = ensemble_by_scalar}, .points = 6};
    ways[count++] = (way){.method = {.name = "scalar, full rows", .solve = ensemble_by_rows}, .points = 4};
    for (size_t i = 0; i < sizeof engines / sizeof *engines; ++i) {
        const fst_lane_engine *engine = fst_lane_engine_of(engines[i].form, engines[i].lanes);
        const ensemble_method states = {engines[i].states, ensemble_by_lanes, engine, NULL, 1},
                              rows = {engines[i].rows, ensemble_by_rows, engine, NULL, 1};
        if (!engine)
            continue;
        ways[count++] = (way){.method = states, .points = engines[i].states_points};
        ways[count++] = (way){.method = rows, .points = engines[i].rows_points};
    }
    measure(ways, count);
    report(ways, count);
    return 0;
}
