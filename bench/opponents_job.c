#include "opponents_job.h"

#include <stdlib.h>
#include <string.h>

#include "model/model.h"
#include "opponents_model.h"

struct job_trajectory {
    fst_params params;
    fst_model *model;
    double start[JOB_STATE_SIZE];
};

static const double TWO_PI = 6.283185307179586476925287;
enum { PERIODS = 200 };

const job_trajectory *job_trajectory_new(int index, int count)
{
    job_trajectory *t = calloc(1, sizeof *t);
    if (!t)
        return NULL;
    t->params = fst_default_params();
    t->params.drive_omega = 0.36 + (1.20 - 0.36) * (index + 0.5) / count;
    if (fst_model_new(&t->params, &t->model, NULL) == FST_OK &&
        fst_start_state(&t->params, t->model, t->start, NULL) == FST_OK)
        return t;
    fst_model_free(t->model);
    free(t);
    return NULL;
}

double job_omega(const job_trajectory *trajectory)
{
    return trajectory->params.drive_omega;
}

double job_end_time(const job_trajectory *trajectory)
{
    return PERIODS * TWO_PI / trajectory->params.drive_omega;
}

void job_start(const job_trajectory *trajectory, double state[JOB_STATE_SIZE])
{
    memcpy(state, trajectory->start, sizeof trajectory->start);
}

void job_rhs(const job_trajectory *trajectory, const double state[JOB_STATE_SIZE],
             double derivative[JOB_STATE_SIZE])
{
    fst_pull_double pull;
    const fst_model *model = trajectory->model;
    fst_rhs_double(&model->world, NULL, model->world.omega, state, derivative, &pull);
}

const fst_params *job_params(const job_trajectory *trajectory)
{
    return &trajectory->params;
}

const fst_model *job_model(const job_trajectory *trajectory)
{
    return trajectory->model;
}
