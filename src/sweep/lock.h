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

typedef enum {
    FST_LOCK_FREE,
    FST_LOCK_MINE,
    FST_LOCK_TAKEN,     /* another command has it, or another sweep of this process */
    FST_LOCK_IMPOSSIBLE /* this file system has no locks; errno tells more */
} fst_lock_state;

/* Take the lock of an open file, which must be open for writing.  Closing the descriptor gives it back. */
fst_lock_state fst_lock_take(int descriptor);

/* Whether the file of a descriptor is locked: FST_LOCK_FREE or FST_LOCK_TAKEN. */
fst_lock_state fst_lock_look(int descriptor);

enum { FST_LOCK_OWNER_SIZE = 96 };

/* "process 123 on HOST", or as much of it as is known. */
void fst_lock_owner(int descriptor, char owner[FST_LOCK_OWNER_SIZE]);

/* Whether this very process has a sweep at work on the file.  SQLite's own locks (F_SETLK) belong to a process:
 * all of them end as soon as the process closes any descriptor of the file, whatever that was opened for, and
 * then other programs may write into a database that is being written.  So call this, which opens nothing,
 * before the file is opened.  FST_IO with a sentence: this process is at work on the file, which must not be
 * opened. */
fst_status fst_lock_check_own(const char *path, const char *name, fst_error *error);

/* The same for a descriptor that found the lock taken, because another thread opened the file at the same time.
 * 1: that thread has the lock, and `error` says so; the descriptor must stay open, because closing it would end
 * SQLite's locks. */
int fst_lock_is_own(int descriptor, const char *name, fst_error *error);

/* FST_IO with a sentence that says who is at work on `path`, the file of the descriptor. */
fst_status fst_lock_fail(int descriptor, const char *path, fst_error *error);

#endif
