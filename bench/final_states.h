/* final_states.h - many trajectories to their ends, in lanes: nothing is observed on the way. */
#ifndef FST_BENCH_FINAL_STATES_H
#define FST_BENCH_FINAL_STATES_H

#include "lanes/lanes.h"

/* Take the flows[0..count[, which stand at their start, to t_end[i] each; the end states go to ends[i], and the
 * flows keep time and counters.  Models must share the integers of their worlds.  FST_STEP_UNDERFLOW,
 * FST_NOT_FINITE: of the first flow that failed. */
fst_status fst_final_states(const fst_lane_engine *engine, fst_flow *const *flows, const double *t_end,
                            int count, double (*ends)[FST_STATE_SIZE], fst_error *error);

#endif
