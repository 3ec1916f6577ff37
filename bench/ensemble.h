/* ensemble.h - the job of the benchmarks of many trajectories, and the ways to do it.
 *
 * The job: dynamics `rigid`, the paper's parameters, omegas on [0.36, 1.20], some drive periods each from the
 * free-rolling start at r = 0.95.
 */
#ifndef FST_BENCH_ENSEMBLE_H
#define FST_BENCH_ENSEMBLE_H

#include <gsl/gsl_odeiv2.h>

#include "final_states.h"

typedef struct ensemble_point {
    fst_params params;
    fst_model *model;
    double start[FST_STATE_SIZE], t_end;
} ensemble_point;

/* 0: it could not be made. */
int ensemble_point_make(ensemble_point *p, double omega, int periods);

/* A way to take points to their ends at a tolerance; 0: it failed. */
typedef struct ensemble_method {
    const char *name;
    int (*solve)(const struct ensemble_method *self, const ensemble_point *const *points, int count,
                 double tolerance, double (*ends)[FST_STATE_SIZE]);
    const fst_lane_engine *engine;
    const gsl_odeiv2_step_type **step;
    int threads;
} ensemble_method;

/* `solve` of: one trajectory after another; lanes; GSL. */
int ensemble_by_scalar(const ensemble_method *self, const ensemble_point *const *points, int count,
                       double tolerance, double (*ends)[FST_STATE_SIZE]);
int ensemble_by_lanes(const ensemble_method *self, const ensemble_point *const *points, int count,
                      double tolerance, double (*ends)[FST_STATE_SIZE]);
int ensemble_by_gsl(const ensemble_method *self, const ensemble_point *const *points, int count,
                    double tolerance, double (*ends)[FST_STATE_SIZE]);

/* GSL with the 26 time integrals of a row as further components over the second half of the way, which is what
 * its user would do for means.  They have no say in the step sizes.  Returns of Phi, extremes and a regime,
 * which a row has too, are not looked for. */
int ensemble_by_gsl_with_means(const ensemble_method *self, const ensemble_point *const *points, int count,
                               double tolerance, double (*ends)[FST_STATE_SIZE]);

/* Rows with all keys, the means over the second half of the periods: in lanes, or without an engine one after
 * another (fst_run). */
int ensemble_by_rows(const ensemble_method *self, const ensemble_point *const *points, int count,
                     double tolerance, double (*ends)[FST_STATE_SIZE]);

/* The same with all of their results. */
int ensemble_rows(const fst_lane_engine *engine, const ensemble_point *const *points, int count,
                  double tolerance, fst_run_result *results);

/* Evaluations of the right-hand side by `solve` since this was last set to 0; not those of rows. */
extern uint64_t ensemble_evaluations;

#endif
