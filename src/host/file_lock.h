/* file_lock.h - locks of the kernel on single bytes far behind the end of any file.
 *
 * A lock belongs to an open file (F_OFD_SETLK).  It ends when the last descriptor of that open file is closed,
 * and so with the process, however the process ends; and it follows the file when the file is renamed.
 *
 * Single bytes are locked, not the file as a whole (flock()): a network file system turns a lock of the whole
 * file into a lock of all its bytes, which would shut out SQLite's own locks and the further locks of a sweep
 * (sweep/lock.c).
 */
#ifndef FST_HOST_FILE_LOCK_H
#define FST_HOST_FILE_LOCK_H

#include <sys/stat.h>
#include <sys/types.h>

/* Places are counted from 2^48, where the greatest possible database of SQLite ends.  A file that is being
 * written has a lock at FST_LOCK_WRITING, a sweep one at FST_LOCK_SWEEP and more at places of its own
 * (sweep/lock.c). */
enum { FST_LOCK_SWEEP = 0, FST_LOCK_WRITING = 1 << 20 };

/* Lock a byte of a file that is open for writing; with `wait`, wait until it is free.  Returns 0, or -1 and
 * errno: EAGAIN or EACCES where another open file has the lock. */
int fst_lock_byte(int descriptor, off_t place, int wait);

/* Whether this process holds the lock of a byte of a file, which is not opened for that: /proc tells.  0 where
 * that is not to be found out. */
int fst_holds_lock(const struct stat *file, off_t place);

/* The first place that another open file has locked, counted from `place`; -1: none of the `count` places is
 * locked. */
off_t fst_locked_byte(int descriptor, off_t place, off_t count);

#endif
