/* log.h - the files that SQLite keeps beside a database: FILE-wal, FILE-shm and FILE-journal.
 *
 * SQLite writes any log of the right name into the database, even the log of another database that was deleted
 * or replaced.  Therefore a sweep's database bears a mark of its own, and a log without that mark is refused.
 * log.c explains the scheme.
 */
#ifndef FST_SWEEP_LOG_H
#define FST_SWEEP_LOG_H

#include <festoon/festoon_tools.h>

#define FST_MARK_PREFIX "festoon-mark:"
enum { FST_MARK_SIZE = sizeof FST_MARK_PREFIX + 32 };

/* Make a new mark from random bytes. */
fst_status fst_mark_make(char mark[FST_MARK_SIZE], fst_error *error);

/* Find the first mark in some bytes; 0 if there is none. */
int fst_mark_find(const void *bytes, size_t size, char mark[FST_MARK_SIZE]);

typedef enum {
    FST_LOG_NONE, /* no log, or nothing in it that SQLite would use */
    FST_LOG_OWN,
    FST_LOG_DAMAGED, /* the file's own, but a part of it is damaged */
    FST_LOG_FOREIGN  /* the log of another database, or an older log of this one */
} fst_log_state;

/* Look at the logs beside the database `path`, which has this mark; `name` (FST_LOG_NAME_SIZE) becomes the name
 * of the log found. *reason is 0, or the errno of a read that failed, which says nothing of the log. */
enum { FST_LOG_NAME_SIZE = 4200 };
fst_log_state fst_log_look(const char *path, const char *mark, char name[FST_LOG_NAME_SIZE], int *reason);

/* Remove the logs that an earlier database of this name left behind. */
fst_status fst_log_remove(const char *path, fst_error *error);

/* Rename the logs of `path` to the names of the logs of `to`. */
void fst_log_move(const char *path, const char *to);

#endif
