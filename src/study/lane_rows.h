/* lane_rows.h - the ways to do rows: in lanes, and one without neighbours. */
#ifndef FST_STUDY_LANE_ROWS_H
#define FST_STUDY_LANE_ROWS_H

#include "lanes/lanes.h"

/* fst_rows_with_images() with this engine. */
fst_status fst_lane_rows(const fst_row_work *work, const fst_row_images *images, const fst_lane_engine *engine,
                         fst_error *error);

/* Do one job without lanes (lone_run.c) and hand its result over.  *follows: `job` is now another one, which is
 * to follow at once.  Any status other than FST_OK is the answer of work->progress: nothing was handed over
 * then.  A run that fails hands over its failure. */
fst_status fst_row_alone(const fst_row_work *work, const fst_row_images *images, fst_row_job *job, int *follows,
                         fst_error *error);

#endif
