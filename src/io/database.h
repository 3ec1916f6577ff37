/* database.h - SQLite's errors as festoon's, and the checks before a sweep's file is opened. */
#ifndef FST_IO_DATABASE_H
#define FST_IO_DATABASE_H

#include <festoon/festoon_tools.h>
#include <sqlite3.h>

#define FST_SWEEP_APPLICATION_ID 0x66657374 /* "fest" */

/* Fill in `error` from the last failure on `database`. */
fst_status fst_database_fail(sqlite3 *database, const char *path, fst_error *error);

/* Whether the first bytes of a file are those of a sweep's database (SQLite itself would touch the journal of a
 * foreign one); FST_BAD_INPUT if not. */
fst_status fst_database_is_sweep(const char *path, fst_error *error);

/* Open a file that is a sweep's database by its first bytes, for reading only or for writing too.
 * FST_BAD_INPUT: missing, a directory, another kind of file, structurally damaged. */
fst_status fst_database_open(const char *path, int writable, sqlite3 **database, fst_error *error);

/* Run statements without results. */
fst_status fst_database_do(sqlite3 *database, const char *path, const char *statements, fst_error *error);

/* A text of the table `festoon`, or NULL; to be freed. */
char *fst_database_text(sqlite3 *database, const char *key);

#endif
