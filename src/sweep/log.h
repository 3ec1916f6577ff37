/* log.h - the files that SQLite keeps beside a database, FILE-wal, FILE-shm and FILE-journal.
 *
 * SQLite writes whatever a log of the right name says into the database, be the log another database's: one
 * that was deleted, or replaced by a copy.  Therefore a sweep's database bears a mark of its own, 16 random
 * bytes as text, on its first two pages, and every transaction writes one of these; a log without the mark is
 * not its own.
 */
#ifndef FST_SWEEP_LOG_H
#define FST_SWEEP_LOG_H

#include <festoon/festoon_tools.h>

#define FST_MARK_PREFIX "festoon-mark:"
enum { FST_MARK_SIZE = sizeof FST_MARK_PREFIX + 32 };

/* A new mark. */
fst_status fst_mark_make(char mark[FST_MARK_SIZE], fst_error *error);

/* The first mark in some bytes; 0 if there is none. */
int fst_mark_find(const void *bytes, size_t size, char mark[FST_MARK_SIZE]);

typedef enum {
    FST_LOG_NONE, /* no log, or nothing in it that SQLite would use */
    FST_LOG_OWN,
    FST_LOG_DAMAGED, /* its own, but some of it cannot be used any more */
    FST_LOG_FOREIGN  /* another database's, or from an earlier time of this one */
} fst_log_state;

/* What lies beside the database `path` of this mark; `name` (FST_LOG_NAME_SIZE) is the file found.  *reason is
 * the errno of a read that failed, which says nothing of the log, or 0. */
enum { FST_LOG_NAME_SIZE = 4200 };
fst_log_state fst_log_look(const char *path, const char *mark, char name[FST_LOG_NAME_SIZE], int *reason);

/* Remove what an earlier database of this name left. */
fst_status fst_log_remove(const char *path, fst_error *error);

/* Rename the logs of `path` to those of `to`. */
void fst_log_move(const char *path, const char *to);

#endif
