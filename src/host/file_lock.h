/* file_lock.h - locks of the kernel on bytes far behind the end of any file.
 *
 * A lock belongs to an open file (F_OFD_SETLK): it ends when the last descriptor of it is closed, hence with
 * the process, however that ends, and it follows the file when it is renamed.  One byte is locked instead of
 * the file as a whole (flock()), because network file systems make a lock of all bytes of the latter, which
 * would shut out SQLite's own locks, and the further ones of a sweep (sweep/lock.c).
 */
#ifndef FST_HOST_FILE_LOCK_H
#define FST_HOST_FILE_LOCK_H

#include <sys/types.h>

/* The greatest database of SQLite ends at 2^48 bytes; places are counted from there.  A file that is being
 * written is locked at the one, a sweep at the other and at places of its own (sweep/lock.c). */
enum { FST_LOCK_SWEEP = 0, FST_LOCK_WRITING = 1 << 20 };

/* Lock a byte of a file that is open for writing; with `wait`, until it is free.  0, or -1 and errno: EAGAIN or
 * EACCES where another open file has the lock. */
int fst_lock_byte(int descriptor, off_t place, int wait);

/* Whether this process holds the lock of a byte of a file, which is not opened for it: /proc tells.  0 where
 * that is not to be found out. */
int fst_holds_lock(const char *path, off_t place);

/* The first place locked by another open file, counted from `place`; -1: none of the `count` places is. */
off_t fst_locked_byte(int descriptor, off_t place, off_t count);

#endif
