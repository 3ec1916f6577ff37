/* database.h - connections to a sweep's database that trust nothing in it, and SQLite's errors as festoon's. */
#ifndef FST_SWEEP_DATABASE_H
#define FST_SWEEP_DATABASE_H

#include <festoon/festoon_tools.h>
#include <sqlite3.h>

#include "sweep/log.h"

#define FST_SWEEP_APPLICATION_ID 0x66657374 /* "fest" */
#define FST_SWEEP_FORMAT 2                  /* user_version: 2 has marks and checksums, 1 had none */

/* Fill in `error` from the last failure on `database`. */
fst_status fst_database_fail(sqlite3 *database, const char *path, fst_error *error);

/* Whether a code of SQLite means that the file is damaged, rather than that reading it failed. */
int fst_database_is_damage(int code);

/* The absolute path of a file that exists or is to be made, with symbolic links resolved; SQLite takes such a
 * name as it is.  The caller frees it. */
fst_status fst_database_path(const char *path, char **absolute, fst_error *error);

/* Whether a file begins as every database of SQLite does.  FST_IO: reading it failed. */
fst_status fst_database_begins(int descriptor, const char *path, int *begins, fst_error *error);

/* Check the first bytes of a file before SQLite sees it, because SQLite would change the journal of a foreign
 * database.  FST_BAD_INPUT: no database of a sweep, or one of an older format.  `writable` says that a sweep is
 * to be written there, which changes the advice in the sentence.  `mark` becomes the mark of the database, or
 * empty where there is none. */
fst_status fst_database_head(int descriptor, const char *path, int writable, char mark[FST_MARK_SIZE],
                             fst_error *error);

/* Connect to a database for reading, or for writing too.  Only the file and its log are read; the log is not
 * written into the file unless fst_database_allow_tidying() was called. */
fst_status fst_database_connect(const char *path, int writable, sqlite3 **database, fst_error *error);
void fst_database_allow_tidying(sqlite3 *database);

/* Run statements without results. */
fst_status fst_database_do(sqlite3 *database, const char *path, const char *statements, fst_error *error);

#endif
