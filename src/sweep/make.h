/* make.h - making a sweep's database: whole, locked, and under its name only if nothing else has that name. */
#ifndef FST_SWEEP_MAKE_H
#define FST_SWEEP_MAKE_H

#include "sweep/file.h"

/* What puts rows into a new database, before it has its name; `seed` begins their checksums. */
typedef struct fst_sweep_filling {
    fst_status (*fill)(void *user, sqlite3 *database, uint64_t seed, fst_error *error);
    void *user;
} fst_sweep_filling;

/* Make a database at `path`, an absolute path, unless there is one; without rows where `filling` is NULL.
 * *descriptor is then open on it and holds its lock; it is -1 where another command was faster, or is making it,
 * which fails in the `last` attempt. */
fst_status fst_sweep_make(const char *name, const char *path, const fst_sweep_identity *identity,
                          const fst_sweep_filling *filling, int last, int *descriptor, fst_error *error);

/* Copy the sound rows of another database of the same sweep, from its first one on.  A point that has a row keeps
 * it; *differs becomes the last point whose row was another one, or -1. */
fst_status fst_sweep_copy_rows(fst_sweep_rows *rows, sqlite3 *database, const char *name, uint64_t seed,
                               int64_t *differs, fst_error *error);

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
