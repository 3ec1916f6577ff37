/* lock.h - who works on a sweep's database: one command at a time.
 *
 * The lock is of the kernel, on an open file (F_OFD_SETLK): it ends with the process, however that ends,
 * follows the file when it is renamed, and leaves nothing behind.  It lies on bytes that no database reaches,
 * far from those that SQLite locks.  The positions of further locked bytes spell the number of the process and
 * the name of its computer, so that another command can say who is at work; nothing is written for it.
 */
#ifndef FST_SWEEP_LOCK_H
#define FST_SWEEP_LOCK_H

#include <festoon/festoon_tools.h>

typedef enum {
    FST_LOCK_FREE,
    FST_LOCK_MINE,
    FST_LOCK_TAKEN,     /* by another command, or another sweep of this process */
    FST_LOCK_IMPOSSIBLE /* this file system has no locks; errno tells more */
} fst_lock_state;

/* Take the lock of an open file, which must be open for writing; closing the descriptor gives it back. */
fst_lock_state fst_lock_take(int descriptor);

/* Whether the file of a descriptor is locked: FST_LOCK_FREE or FST_LOCK_TAKEN. */
fst_lock_state fst_lock_look(int descriptor);

enum { FST_LOCK_OWNER_SIZE = 96 };

/* "process 123 on HOST", or what is known of it. */
void fst_lock_owner(int descriptor, char owner[FST_LOCK_OWNER_SIZE]);

/* A sweep of this very process on the file.  SQLite's own locks (F_SETLK) are those of a process: all of them
 * end as soon as any descriptor of the file is closed in it, whatever it was opened for, and then other
 * programs write into a database that is being written.  So this function, which opens nothing, comes before
 * any opening: FST_IO with a sentence where this process is at work on the file, which must not be opened then.
 */
fst_status fst_lock_check_own(const char *path, const char *name, fst_error *error);

/* The same of a descriptor that found the lock taken, because another thread opened the file at the same time:
 * 1 if that thread has the lock, with a sentence in `error`; closing the descriptor would then do the harm. */
int fst_lock_is_own(int descriptor, const char *name, fst_error *error);

/* FST_IO: who is at work on `path`, the file of the descriptor. */
fst_status fst_lock_fail(int descriptor, const char *path, fst_error *error);

#endif
