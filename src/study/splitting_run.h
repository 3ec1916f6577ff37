/* splitting_run.h - a run by the splitting method: from parameters to a job of an engine, and from what the
 * engine has summed up to a result. */
#ifndef FST_STUDY_SPLITTING_RUN_H
#define FST_STUDY_SPLITTING_RUN_H

#include "lanes/splitting.h"

typedef struct fst_splitting_run {
    const fst_params *params;
    fst_model *model;
    double period; /* of the drive */
    fst_splitting_job job;
} fst_splitting_run;

/* FST_BAD_INPUT: a setup that the method cannot do, or a start that does not exist. */
fst_status fst_splitting_begin(fst_splitting_run *run, const fst_params *params, const double *start,
                               fst_error *error);
void fst_splitting_free(fst_splitting_run *run);

/* FST_NOT_FINITE: the motion was lost in numbers that are none. */
fst_status fst_splitting_conclude(const fst_splitting_run *run, const fst_splitting_outcome *outcome,
                                  fst_run_result *result, fst_error *error);

/* fst_run() by this method; without samples and ramps. */
fst_status fst_splitting_alone(const fst_params *params, const fst_run_options *options, fst_run_result *result,
                               fst_error *error);

#endif
