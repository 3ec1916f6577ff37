/* simulation.h - what fst_run() has besides the run that it watches: samples, progress, and a ramp. */
#ifndef FST_STUDY_SIMULATION_H
#define FST_STUDY_SIMULATION_H

#include "study/ramp.h"
#include "study/watched_run.h"

/* Of the progress that a run reports, the steps' part; the rest is that of an exponent, if one is needed. */
#define FST_RUN_SHARE 0.7

typedef struct fst_simulation {
    fst_watched_run run;
    const fst_run_options *options;
    int64_t next_sample;
    fst_ramp ramp;
} fst_simulation;

/* Every sample that falls into the last step, up to its fraction `until`; at the start, which no step has led
 * to, the one there. */
fst_status fst_simulation_samples(fst_simulation *s, double until, fst_error *error);

/* One step towards t_limit, with its samples, what it means for a ramp, and progress. */
fst_status fst_simulation_step(fst_simulation *s, double t_limit, fst_error *error);

/* Steps up to a time, landing on it. */
fst_status fst_simulation_until(fst_simulation *s, double t, fst_error *error);

/* The ramp of a run at the end of its discard, waiting half way through each piece (ramp_wait.c). */
fst_status fst_simulation_ramp_with_waiting(fst_simulation *s, fst_error *error);

#endif
