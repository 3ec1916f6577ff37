/* lone_run.h - a row without neighbours. */
#ifndef FST_STUDY_LONE_RUN_H
#define FST_STUDY_LONE_RUN_H

#include <festoon/festoon.h>

/* Do one job and hand its result over.  *follows: `job` is now another one, which is to follow at once.  Any
 * status other than FST_OK is the answer of work->progress: nothing was handed over then.  A run that fails
 * hands over its failure. */
fst_status fst_row_alone(const fst_row_work *work, const fst_row_images *images, fst_row_job *job, int *follows,
                         fst_error *error);

#endif
