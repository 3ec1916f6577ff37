/* database.h - SQLite's errors as festoon's, and connections to a sweep's database that trust nothing in it. */
#ifndef FST_SWEEP_DATABASE_H
#define FST_SWEEP_DATABASE_H

#include <festoon/festoon_tools.h>
#include <sqlite3.h>

#include "sweep/log.h"

#define FST_SWEEP_APPLICATION_ID 0x66657374 /* "fest" */
#define FST_SWEEP_FORMAT 2                  /* user_version: 2 has marks and checksums, 1 had none */

/* Fill in `error` from the last failure on `database`. */
fst_status fst_database_fail(sqlite3 *database, const char *path, fst_error *error);

/* Whether a code of SQLite says that the file is not what it should be, rather than that reading failed. */
int fst_database_is_damage(int code);

/* The path of a file that exists or is to be made, from the root on, through symbolic links: SQLite gives no
 * meaning of its own to such a name.  To be freed. */
fst_status fst_database_path(const char *path, char **absolute, fst_error *error);

/* Whether a file begins as every database of SQLite does. */
int fst_database_begins(int descriptor);

/* Whether the first bytes of a file are those of a sweep's database (SQLite itself would touch the journal of a
 * foreign one); FST_BAD_INPUT if not, or if it is of an older format.  `writable`: a sweep is to be written
 * there, of which the advice speaks.  `mark` is that of the database, or empty where it cannot be found. */
fst_status fst_database_head(int descriptor, const char *path, int writable, char mark[FST_MARK_SIZE],
                             fst_error *error);

/* Connect to a database, for reading only or for writing too.  Only the file and its log are read; a log is not
 * written into the file unless fst_database_allow_tidying() was called. */
fst_status fst_database_connect(const char *path, int writable, sqlite3 **database, fst_error *error);
void fst_database_allow_tidying(sqlite3 *database);

/* Run statements without results. */
fst_status fst_database_do(sqlite3 *database, const char *path, const char *statements, fst_error *error);

#endif
