/* make.h - making a sweep's database: whole, locked, and under its name only when nothing else has it. */
#ifndef FST_SWEEP_MAKE_H
#define FST_SWEEP_MAKE_H

#include "sweep/file.h"

/* Make a database without rows at `path` (from the root on) unless there is one.  *descriptor is then open on
 * it and holds its lock; -1 where another command was faster. */
fst_status fst_sweep_make(const char *name, const char *path, const fst_sweep_identity *identity,
                          int *descriptor, fst_error *error);

/* Replace a damaged database, whose lock the caller holds, by a new one with its sound rows; the damaged one is
 * kept as FILE.damaged.  It is closed also on failure.  *descriptor becomes that of the new file and its lock.
 */
fst_status fst_sweep_repair(fst_sweep_file *damaged, const fst_sweep_identity *identity, int *descriptor,
                            fst_error *error);

/* Remove what commands that were killed while they made the database left beside it. */
void fst_sweep_tidy(const char *path);

/* Whether a file is there that is not empty. */
int fst_sweep_is_made(const char *path);

#endif
