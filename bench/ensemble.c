#include "ensemble.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_errno.h>

#include "study/lane_rows.h"

uint64_t ensemble_evaluations;

int ensemble_point_make(ensemble_point *p, double omega, int periods)
{
    p->params = fst_default_params();
    p->params.drive_omega = omega;
    p->params.run_periods = periods;
    p->params.run_discard = periods / 2;
    p->t_end = periods * FST_TWO_PI / omega;
    return fst_model_new(&p->params, &p->model, NULL) == FST_OK &&
           fst_start_state(&p->params, p->model, p->start, NULL) == FST_OK;
}

/* ------------------------------------------------------------------ one after another */

static fst_flow *flow_at(const ensemble_point *p, double tolerance)
{
    fst_flow_options o = fst_default_flow_options();
    fst_flow *flow = NULL;
    o.rtol = tolerance;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = tolerance;
    (void)fst_flow_new(p->model, &o, p->start, &flow, NULL);
    return flow;
}

int ensemble_by_scalar(const ensemble_method *self, const ensemble_point *const *points, int count,
                       double tolerance, double (*ends)[FST_STATE_SIZE])
{
    (void)self;
    int good = 1;
    for (int i = 0; i < count && good; ++i) {
        fst_stop stop;
        fst_flow *flow = flow_at(points[i], tolerance);
        good = flow && fst_flow_next(flow, points[i]->t_end, 0, &stop, NULL) == FST_OK;
        if (good)
            memcpy(ends[i], fst_flow_get(flow).state, sizeof ends[i]);
        ensemble_evaluations += good ? flow->rhs_calls : 0;
        fst_flow_free(flow);
    }
    return good;
}

/* ------------------------------------------------------------------ lanes */

typedef struct share {
    const fst_lane_engine *engine;
    const ensemble_point *const *points;
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
        flows[i] = flow_at(s->points[i], s->tolerance);
        t_end[i] = s->points[i]->t_end;
        s->good = flows[i] != NULL;
    }
    s->good = s->good && fst_final_states(s->engine, flows, t_end, s->count, s->ends, NULL) == FST_OK;
    for (int i = 0; s->good && i < s->count; ++i)
        s->evaluations += flows[i]->rhs_calls;
    for (int i = 0; flows && i < s->count; ++i)
        fst_flow_free(flows[i]);
    free(flows);
    free(t_end);
    return NULL;
}

int ensemble_by_lanes(const ensemble_method *self, const ensemble_point *const *points, int count,
                      double tolerance, double (*ends)[FST_STATE_SIZE])
{
    share shares[2];
    pthread_t thread;
    const int half = self->threads == 2 ? count / 2 : count;
    shares[0] = (share){self->engine, points, half, 0, tolerance, ends, 0};
    shares[1] = (share){self->engine, points + half, count - half, 0, tolerance, ends + half, 0};
    if (self->threads == 2 && pthread_create(&thread, NULL, do_share, &shares[1]) != 0)
        return 0;
    (void)do_share(&shares[0]);
    ensemble_evaluations += shares[0].evaluations;
    if (self->threads < 2)
        return shares[0].good;
    pthread_join(thread, NULL);
    ensemble_evaluations += shares[1].evaluations;
    return shares[0].good && shares[1].good;
}

/* ------------------------------------------------------------------ GSL */

static int gsl_rhs(double t, const double y[], double dy[], void *data)
{
    (void)t;
    const ensemble_point *point = data;
    const fst_world_double *c = &point->model->world;
    fst_pull_double pull;
    ensemble_evaluations += 1;
    fst_rhs_double(c, NULL, c->omega, y, dy, &pull);
    return GSL_SUCCESS;
}

int ensemble_by_gsl(const ensemble_method *self, const ensemble_point *const *points, int count,
                    double tolerance, double (*ends)[FST_STATE_SIZE])
{
    int good = 1;
    for (int i = 0; i < count && good; ++i) {
        gsl_odeiv2_system system = {gsl_rhs, NULL, FST_STATE_SIZE, (void *)(uintptr_t)points[i]};
        gsl_odeiv2_driver *driver =
            gsl_odeiv2_driver_alloc_y_new(&system, *self->step, 1e-3, tolerance, tolerance);
        double t = 0.0;
        memcpy(ends[i], points[i]->start, sizeof points[i]->start);
        good = gsl_odeiv2_driver_apply(driver, &t, points[i]->t_end, ends[i]) == GSL_SUCCESS;
        gsl_odeiv2_driver_free(driver);
    }
    return good;
}

enum { WITH_MEANS = FST_STATE_SIZE + FST_Q_OTHERS };

static int gsl_rhs_with_integrands(double t, const double y[], double dy[], void *data)
{
    (void)t;
    const ensemble_point *point = data;
    const fst_world_double *c = &point->model->world;
    fst_pull_double pull;
    fst_seen_double seen;
    double integrands[FST_Q_COUNT];
    ensemble_evaluations += 1;
    fst_rhs_double(c, NULL, c->omega, y, dy, &pull);
    fst_see_double(c, NULL, c->omega, y, &pull, &seen);
    fst_integrands_double(c, NULL, y, &pull, &seen, 1.0, 1.0, integrands);
    memcpy(dy + FST_STATE_SIZE, integrands, FST_Q_OTHERS * sizeof *integrands);
    return GSL_SUCCESS;
}

int ensemble_by_gsl_with_means(const ensemble_method *self, const ensemble_point *const *points, int count,
                               double tolerance, double (*ends)[FST_STATE_SIZE])
{
    int good = 1;
    double scale[WITH_MEANS];
    for (int i = 0; i < WITH_MEANS; ++i)
        scale[i] = i < FST_STATE_SIZE ? 1.0 : 1e30;
    for (int i = 0; i < count && good; ++i) {
        void *point = (void *)(uintptr_t)points[i];
        gsl_odeiv2_system first = {gsl_rhs, NULL, FST_STATE_SIZE, point};
        gsl_odeiv2_system second = {gsl_rhs_with_integrands, NULL, WITH_MEANS, point};
        gsl_odeiv2_driver *run_up =
            gsl_odeiv2_driver_alloc_y_new(&first, *self->step, 1e-3, tolerance, tolerance);
        gsl_odeiv2_driver *window = gsl_odeiv2_driver_alloc_scaled_new(&second, *self->step, 1e-3, tolerance,
                                                                       tolerance, 1.0, 0.0, scale);
        double t = 0.0, y[WITH_MEANS] = {0.0};
        memcpy(y, points[i]->start, sizeof points[i]->start);
        good = gsl_odeiv2_driver_apply(run_up, &t, 0.5 * points[i]->t_end, y) == GSL_SUCCESS &&
               gsl_odeiv2_driver_apply(window, &t, points[i]->t_end, y) == GSL_SUCCESS;
        memcpy(ends[i], y, sizeof ends[i]);
        gsl_odeiv2_driver_free(run_up);
        gsl_odeiv2_driver_free(window);
    }
    return good;
}

/* ------------------------------------------------------------------ rows */

typedef struct row_source {
    const ensemble_point *const *points;
    int count, next, good;
    double tolerance;
    fst_run_result *results;
} row_source;

static int next_row(void *user, fst_row_job *job)
{
    row_source *s = user;
    if (s->next == s->count)
        return 0;
    memset(job, 0, sizeof *job);
    job->point = s->next;
    job->params = s->points[s->next++]->params;
    job->params.run_rtol = s->tolerance;
    return 1;
}

static int row_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    (void)error;
    row_source *s = user;
    s->good = s->good && status == FST_OK;
    if (status == FST_OK)
        s->results[job->point] = *result;
    return 0;
}

int ensemble_rows(const fst_lane_engine *engine, const ensemble_point *const *points, int count,
                  double tolerance, fst_run_result *results)
{
    row_source source = {points, count, 0, 1, tolerance, results};
    const fst_row_work work = {&source, FST_ARITHMETIC_PORTABLE, 1, next_row, row_done, NULL};
    /* The engine is given as it is, which allows bench_shares to time what it does. */
    const fst_status status = engine ? fst_lane_rows(&work, NULL, engine, NULL) : fst_rows(&work, NULL);
    return status == FST_OK && source.good;
}

int ensemble_by_rows(const ensemble_method *self, const ensemble_point *const *points, int count,
                     double tolerance, double (*ends)[FST_STATE_SIZE])
{
    fst_run_result *results = calloc((size_t)count, sizeof *results);
    const int good = results && ensemble_rows(self->engine, points, count, tolerance, results);
    for (int i = 0; i < count && good; ++i)
        memcpy(ends[i], results[i].final_state, sizeof ends[i]);
    free(results);
    return good;
}
