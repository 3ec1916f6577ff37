/* lock.h - who works on a sweep's database: one command at a time.
 *
 * The kernel keeps the lock for an open file (F_OFD_SETLK).  It ends with the process, however the process
 * ends, follows the file when the file is renamed, and leaves nothing behind.  The locked bytes lie behind the
 * end of any database, far from the bytes that SQLite locks.  lock.c says how another command learns who holds
 * the lock.
 */
#ifndef FST_SWEEP_LOCK_H
#define FST_SWEEP_LOCK_H

#include <festoon/festoon_tools.h>
#include <sys/stat.h>

/* Open a file for writing, or make it (`is_new`), and take its lock; closing the descriptor gives it back.
 * *descriptor is -1 where the file is missing, has lost its name meanwhile, or is another command's.  FST_IO,
 * with a sentence: this process has the lock, or, in the `last` attempt, another one, and which; the file
 * system has no locks; no permission. */
fst_status fst_lock_open(const char *name, const char *path, int is_new, int last, int *descriptor,
                         fst_error *error);

/* Whether the path still leads to the file that was opened. */
int fst_lock_is_there(const char *path, const struct stat *opened);

/* Whether another open file has the lock. */
int fst_lock_is_taken(int descriptor);

/* Whether this very process has a sweep at work on the file.  SQLite's own locks (F_SETLK) belong to a process:
 * all of them end as soon as the process closes any descriptor of the file, whatever that was opened for, and
 * then other programs may write into a database that is being written.  So call this, which opens nothing,
 * before the file is opened.  FST_IO with a sentence: this process is at work on the file, which must not be
 * opened. */
fst_status fst_lock_check_own(const char *path, const char *name, fst_error *error);

#endif
