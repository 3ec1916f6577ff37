/* lane_rows.h - rows in lanes. */
#ifndef FST_STUDY_LANE_ROWS_H
#define FST_STUDY_LANE_ROWS_H

#include "lanes/lanes.h"

/* fst_rows_with_images() with this engine. */
fst_status fst_lane_rows(const fst_row_work *work, const fst_row_images *images, const fst_lane_engine *engine,
                         fst_error *error);

#endif
