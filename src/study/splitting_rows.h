/* splitting_rows.h - rows whose jobs choose their method. */
#ifndef FST_STUDY_SPLITTING_ROWS_H
#define FST_STUDY_SPLITTING_ROWS_H

#include "lanes/splitting.h"

/* Does the jobs of run.method events of a source; ends when that has no next one. */
typedef fst_status fst_event_rows(const fst_row_work *work, const fst_row_images *images, void *user,
                                  fst_error *error);

/* Do jobs of either method: those of splitting side by side by `engine`, the others by `by_events`. */
fst_status fst_rows_by_method(const fst_row_work *work, const fst_row_images *images,
                              const fst_splitting_engine *engine, fst_event_rows *by_events, void *user,
                              fst_error *error);

#endif
