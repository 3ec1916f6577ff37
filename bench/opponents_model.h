/* opponents_model.h - the model of a job's trajectory, for festoon's own solvers. */
#ifndef FST_BENCH_OPPONENTS_MODEL_H
#define FST_BENCH_OPPONENTS_MODEL_H

#include <festoon/festoon.h>

#include "opponents_job.h"

const fst_params *job_params(const job_trajectory *trajectory);
const fst_model *job_model(const job_trajectory *trajectory);

#endif
