/* collect.h - a trajectory in memory instead of a file, for figures, films and the paper. */
#ifndef FST_IO_COLLECT_H
#define FST_IO_COLLECT_H

#include <festoon/festoon_tools.h>

/* Run `params` and keep the samples from the discard on; free the table with fst_table_free().  `progress` may
 * be NULL. */
fst_status fst_collect_run(const fst_params *params, const fst_progress *progress, fst_run_result *result,
                           fst_table *table, fst_error *error);

/* The column called `name`, which must be one of those in columns.def. */
const double *fst_collected(const fst_table *table, const char *name);

#endif
