/* make.h - making a sweep's database: whole, locked, and under its name only if nothing else has that name. */
#ifndef FST_SWEEP_MAKE_H
#define FST_SWEEP_MAKE_H

#include "sweep/file.h"

/* Make a database without rows at `path`, an absolute path, unless there is one. *descriptor is then open on it
 * and holds its lock; it is -1 where another command was faster, or is making it, which fails in the `last`
 * attempt. */
fst_status fst_sweep_make(const char *name, const char *path, const fst_sweep_identity *identity, int last,
                          int *descriptor, fst_error *error);

/* Replace a damaged database, whose lock the caller holds, by a new one with its sound rows.  The damaged one
 * is closed, also on failure, and kept as FILE.damaged. *descriptor becomes the new file's, and holds its lock.
 */
fst_status fst_sweep_repair(fst_sweep_file *damaged, const fst_sweep_identity *identity, int *descriptor,
                            fst_error *error);

/* Remove what commands left beside the database when they were killed while they made it. */
void fst_sweep_tidy(const char *path);

/* Whether there is a file that is not empty. */
int fst_sweep_is_made(const char *path);

#endif
