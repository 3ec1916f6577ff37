/* splitting.c - what begins and ends a run by the splitting method, for engines of every width. */
#include "lanes/splitting.h"

#include <string.h>

#include "base/constants.h"
#include "base/elementary.h"

static fst_stride_double make_stride(double omega, double h)
{
    fst_stride_double stride = {h, 1.0, 0.0};
    fst_sin_cos_degrees(omega * h * FST_DEGREES, &stride.sine, &stride.cosine);
    return stride;
}

void fst_splitting_prepare(fst_splitting_job *job)
{
    job->half = make_stride(job->coefficients->omega, 0.5 * job->h);
    job->whole = make_stride(job->coefficients->omega, job->h);
    memcpy(job->first, job->start, sizeof job->first);
    fst_drift_double(&job->half, job->first);
}

void fst_splitting_outcome_of(const fst_splitting_engine *engine, const void *memory, int lane,
                              const fst_splitting_job *job, fst_splitting_outcome *outcome)
{
    engine->outcome(memory, lane, outcome);
    if (outcome->end == FST_SPLITTING_EJECTED || outcome->end == FST_SPLITTING_LIFTED) {
        outcome->step += 0.5; /* it ended at a kick */
        return;
    }
    const fst_stride_double back = {-job->half.h, job->half.cosine, -job->half.sine};
    fst_drift_double(&back, outcome->state);
}
