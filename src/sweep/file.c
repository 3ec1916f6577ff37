/* file.c - opening the database of a sweep for reading or writing, step by step, from what can be trusted
 * least.
 *
 *  head of the file     is it SQLite's, a sweep's, of this format; its mark           database.c
 *  log beside it        is it this file's; SQLite would write any log into the file   log.c
 *  table festoon        what it is a sweep of, against its checksum                   identity.c
 *  tables               exactly ours, word by word, so that nothing foreign runs      here
 *  structure            SQLite's quick_check; damage is noted and does not end this   here
 *
 * The rows follow one by one, each against its checksum (rows.c).
 */
#include "sweep/file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "host/regular_file.h"
#include "sweep/checkpoints.h"
#include "sweep/columns.h"
#include "sweep/lock.h"

/* ------------------------------------------------------------------ tables */

/* The mark is a part of the definition of this table, which SQLite keeps on the first page, and of its row on
 * the second page.  sweep/log.c says why. */
#define SEAL_TABLE "CREATE TABLE seal(one INTEGER PRIMARY KEY, mark TEXT, commits INTEGER /* %s */)"
#define IDENTITY_TABLE "CREATE TABLE festoon(key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID"
#define ROWS_TABLE "CREATE TABLE rows(%s)"

char *fst_sweep_file_tables(const fst_grid *grid, const char *mark)
{
    char *columns = fst_sweep_columns_sql(grid);
    char *made = columns ? sqlite3_mprintf(SEAL_TABLE ";" IDENTITY_TABLE ";" ROWS_TABLE
                                                      "; INSERT INTO seal VALUES(1, %Q, 0)",
                                           mark, columns, mark)
                         : NULL;
    char *copy = made ? strdup(made) : NULL;
    sqlite3_free(made);
    free(columns);
    return copy;
}

static fst_status fail_tables(const fst_sweep_file *file, fst_error *error)
{
    return fst_fail(
        error, FST_BAD_INPUT, file->name,
        "the tables of this database are not those of a sweep: it is damaged, or was changed; nothing "
        "was written: restore a copy, or choose another file");
}

/* Whether the file has exactly these tables; the last one may be missing. */
static fst_status compare_tables(const fst_sweep_file *file, char *const wanted[], int count, fst_error *error)
{
    sqlite3_stmt *query = NULL;
    int code = sqlite3_prepare_v2(file->database, "SELECT type, name, tbl_name, sql FROM sqlite_master", -1,
                                  &query, NULL);
    int found = 0, good = 1;
    while ((code == SQLITE_OK || code == SQLITE_ROW) && (code = sqlite3_step(query)) == SQLITE_ROW) {
        const char *type = (const char *)sqlite3_column_text(query, 0);
        const char *name = (const char *)sqlite3_column_text(query, 1);
        const char *table = (const char *)sqlite3_column_text(query, 2);
        const char *text = (const char *)sqlite3_column_text(query, 3);
        good = good && found < count && type && name && table && text && strcmp(type, "table") == 0 &&
               strcmp(name, table) == 0 && strcmp(text, wanted[found]) == 0;
        ++found;
    }
    const fst_status status =
        code == SQLITE_DONE ? FST_OK : fst_database_fail(file->database, file->name, error);
    (void)sqlite3_finalize(query);
    return status == FST_OK && (!good || found < count - 1) ? fail_tables(file, error) : status;
}

static fst_status check_tables(const fst_sweep_file *file, fst_error *error)
{
    char *columns = file->grid ? fst_sweep_columns_sql(file->grid) : NULL;
    char *wanted[4] = {sqlite3_mprintf(SEAL_TABLE, file->mark), sqlite3_mprintf(IDENTITY_TABLE),
                       sqlite3_mprintf(ROWS_TABLE, columns ? columns : ""),
                       sqlite3_mprintf(FST_CHECKPOINTS_TABLE)};
    const fst_status status = columns && wanted[0] && wanted[1] && wanted[2] && wanted[3]
                                  ? compare_tables(file, wanted, 4, error)
                                  : fst_fail(error, FST_NO_MEMORY, file->name, "out of memory");
    for (int i = 0; i < 4; ++i)
        sqlite3_free(wanted[i]);
    free(columns);
    return status;
}

/* ------------------------------------------------------------------ opening */

/* Look at the log beside the file.  While a sweep is at work its log changes as one reads it, and is the file's
 * own. */
static fst_status look_beside(fst_sweep_file *file, int descriptor, int locked, fst_error *error)
{
    char log[FST_LOG_NAME_SIZE];
    int reason;
    file->at_work = !locked && fst_lock_is_taken(descriptor);
    if (file->at_work) {
        file->log = FST_LOG_OWN;
        return FST_OK;
    }
    file->log = fst_log_look(file->path, file->mark, log, &reason);
    if (!locked && fst_lock_is_taken(descriptor))
        file->log = FST_LOG_OWN;
    else if (reason)
        return fst_fail(error, FST_IO, log, "reading this file failed: %s", strerror(reason));
    if (file->log != FST_LOG_FOREIGN)
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, file->name,
                    "beside this database lies the log of another database, or an older log of this one, %s; "
                    "nothing was changed: "
                    "move the log back to its database, or remove it",
                    log);
}

/* The head of the file and the log beside it are checked before SQLite sees them. */
static fst_status look_at_file(fst_sweep_file *file, int locked, fst_error *error)
{
    int descriptor;
    fst_status status = locked ? FST_OK : fst_lock_check_own(file->name, file->name, error);
    if (status != FST_OK)
        return status;
    status = fst_open_regular(file->name, &descriptor, error);
    if (status == FST_BAD_INPUT && locked && access(file->name, F_OK) != 0)
        return fst_fail(error, FST_IO, file->name, "this file was there a moment ago, and was removed");
    if (status != FST_OK)
        return status;
    status = fst_database_head(descriptor, file->name, locked, file->mark, error);
    if (status == FST_OK && !file->mark[0])
        status = fail_tables(file, error);
    if (status == FST_OK && fstat(descriptor, &file->there) != 0)
        status = fst_fail(error, FST_IO, file->name, "reading this file failed");
    if (status == FST_OK)
        status = fst_database_path(file->name, &file->path, error);
    if (status == FST_OK)
        status = look_beside(file, descriptor, locked, error);
    (void)close(descriptor);
    return status;
}

/* SQLite checks the structure.  What it finds wrong is noted, but sound rows are read all the same. */
static fst_status check_structure(fst_sweep_file *file, fst_error *error)
{
    sqlite3_stmt *check = NULL;
    int code = sqlite3_prepare_v2(file->database, "PRAGMA quick_check(1)", -1, &check, NULL);
    if (code == SQLITE_OK)
        code = sqlite3_step(check);
    const char *text = code == SQLITE_ROW ? (const char *)sqlite3_column_text(check, 0) : NULL;
    fst_status status = FST_OK;
    if (code == SQLITE_ROW && text && strcmp(text, "ok") != 0)
        (void)snprintf(file->finding, sizeof file->finding, "%.*s", (int)strcspn(text, "\n"), text);
    else if (fst_database_is_damage(code))
        (void)snprintf(file->finding, sizeof file->finding, "%.150s", sqlite3_errmsg(file->database));
    else if (code != SQLITE_ROW || !text)
        status = fst_database_fail(file->database, file->name, error);
    (void)sqlite3_finalize(check);
    return status;
}

static fst_status open_once(const char *name, int locked, fst_sweep_file *file, fst_error *error)
{
    memset(file, 0, sizeof *file);
    file->name = name;
    fst_status status = look_at_file(file, locked, error);
    if (status == FST_OK)
        status = fst_database_connect(file->path, locked, &file->database, error);
    if (status == FST_OK)
        status = fst_identity_read(file->database, name, &file->lines, error);
    if (status == FST_OK)
        status = fst_identity_grid(&file->lines, name, &file->grid, error);
    if (status == FST_OK)
        status = fst_identity_of(&file->lines, name, file->grid, &file->identity, error);
    if (status == FST_OK)
        status = check_tables(file, error);
    const char *mark = fst_identity_text(&file->lines, "mark");
    if (status == FST_OK && (!mark || strcmp(mark, file->mark) != 0))
        status = fail_tables(file, error);
    file->seed = fst_identity_checksum(&file->lines);
    if (status == FST_OK)
        status = check_structure(file, error);
    file->opened = status == FST_OK;
    return status;
}

fst_status fst_sweep_file_open(const char *name, int locked, fst_sweep_file *file, fst_error *error)
{
    fst_status status = open_once(name, locked, file, error);
    if (status != FST_BAD_INPUT && !(status == FST_OK && file->finding[0]))
        return status;
    /* SQLite reports some failed reads as damage.  A second look decides: real damage is found again. */
    fst_sweep_file_close(file);
    return open_once(name, locked, file, error);
}

void fst_sweep_file_close(fst_sweep_file *file)
{
    /* The last connection to close writes the log into the file and removes the log by its name, so the name
     * must still lead to this file. */
    const int may_tidy = file->is_left ? file->log == FST_LOG_NONE : file->log != FST_LOG_DAMAGED;
    if (file->opened && may_tidy && !file->finding[0] && fst_lock_is_there(file->path, &file->there))
        fst_database_allow_tidying(file->database);
    (void)sqlite3_close(file->database);
    fst_identity_free(&file->lines);
    fst_grid_free(file->grid);
    free(file->path);
    memset(file, 0, sizeof *file);
}
