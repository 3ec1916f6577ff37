/* extremes.h - the least and the greatest of the tracked quantities over a window. */
#ifndef FST_OBSERVE_EXTREMES_H
#define FST_OBSERVE_EXTREMES_H

#include "observe/quadrature.h"

typedef struct fst_extreme {
    double least, greatest;
} fst_extreme;

/* No value was met yet. */
void fst_extremes_begin(fst_extreme extremes[FST_TRACK_COUNT]);

/* The extremes met in the flow's last step, which the quadrature took in, from its fraction `from` on. */
void fst_extremes_step(fst_extreme extremes[FST_TRACK_COUNT], const fst_quadrature *q, fst_flow *flow,
                       double from);

/* A record of an extreme (model/quantities.h), and a value that may beat it: both times the record's sign. */
double fst_extremes_record(const fst_extreme extremes[FST_TRACK_COUNT], int record);
void fst_extremes_offer(fst_extreme extremes[FST_TRACK_COUNT], int record, double value);

/* The extremes among the numbers of a run's result; `gravity` is that of the model. */
void fst_extremes_fill(const fst_extreme extremes[FST_TRACK_COUNT], double gravity, fst_run_result *result);

#endif
