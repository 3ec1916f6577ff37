/* make.c - making a database: nothing has its name until it is whole, and two commands never make two.
 *
 *  1. .NAME.festoon.part          is made, locked, filled and synced; of several commands one has the lock
 *  2. NAME-wal, -shm, -journal    of an earlier database are removed: SQLite would take them for the new one's
 *  3. NAME                        the file of step 1 is renamed to it, if nothing else has the name
 *
 * The file keeps its lock when it is renamed, so another command that finds NAME also finds that it is in use.
 * A kill at any point leaves either no file of that name or a whole, unlocked database.  The next command to
 * that name begins step 1 anew, or removes the unfinished file.
 */
#define _GNU_SOURCE /* renameat2() */
#include "sweep/make.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "host/whole_file.h"
#include "sweep/columns.h"
#include "sweep/lock.h"

int fst_sweep_is_made(const char *path)
{
    struct stat there;
    return stat(path, &there) == 0 && !(S_ISREG(there.st_mode) && there.st_size == 0);
}

/* ------------------------------------------------------------------ filling */

/* Whether the row of a point there has this checksum. */
static fst_status compare_sum(sqlite3 *database, const char *name, int64_t point, sqlite3_int64 sum, int *same,
                              fst_error *error)
{
    sqlite3_stmt *query = NULL;
    int code = sqlite3_prepare_v2(database, "SELECT checksum FROM rows WHERE point = ?", -1, &query, NULL);
    if (code == SQLITE_OK && (code = sqlite3_bind_int64(query, 1, point)) == SQLITE_OK)
        code = sqlite3_step(query);
    *same = code == SQLITE_ROW && sqlite3_column_int64(query, 0) == sum;
    const fst_status status = code == SQLITE_ROW ? FST_OK : fst_database_fail(database, name, error);
    (void)sqlite3_finalize(query);
    return status;
}

/* Copy the row that was read last, with a checksum of the new database; *same is 0 where there is another one. */
static fst_status copy_row(const fst_sweep_rows *rows, sqlite3_stmt *insert, const char *name, uint64_t seed,
                           int *same, fst_error *error)
{
    sqlite3 *database = sqlite3_db_handle(insert);
    const int count = fst_sweep_column_count(rows->file->grid);
    const sqlite3_int64 sum = (sqlite3_int64)fst_sweep_row_checksum(rows->row, count, seed);
    int code = SQLITE_OK;
    *same = 1;
    for (int i = 0; i < count && code == SQLITE_OK; ++i)
        code = sqlite3_bind_value(insert, i + 1, sqlite3_column_value(rows->row, i));
    (void)sqlite3_bind_int64(insert, count + 1, sum);
    fst_status status = FST_OK;
    if (code != SQLITE_OK || sqlite3_step(insert) != SQLITE_DONE)
        status = fst_database_fail(database, name, error);
    else if (sqlite3_changes(database) == 0)
        status = compare_sum(database, name, rows->next - 1, sum, same, error);
    (void)sqlite3_reset(insert);
    return status;
}

fst_status fst_sweep_copy_rows(fst_sweep_rows *rows, sqlite3 *database, const char *name, uint64_t seed,
                               int64_t *differs, fst_error *error)
{
    char *sql = fst_sweep_insert_sql(rows->file->grid);
    sqlite3_stmt *insert = NULL;
    int more = 0, same = 1;
    fst_status status = FST_OK;
    *differs = -1;
    if (!sql || sqlite3_prepare_v2(database, sql, -1, &insert, NULL) != SQLITE_OK)
        status = fst_database_fail(database, name, error);
    while (status == FST_OK && (status = fst_sweep_rows_next(rows, &more, error)) == FST_OK && more) {
        status = copy_row(rows, insert, name, seed, &same, error);
        *differs = same ? *differs : rows->next - 1;
    }
    (void)sqlite3_finalize(insert);
    free(sql);
    return status;
}

static fst_status write_all(sqlite3 *database, const char *name, const fst_sweep_identity *identity,
                            const fst_sweep_filling *filling, fst_error *error)
{
    char mark[FST_MARK_SIZE];
    fst_status status = fst_mark_make(mark, error);
    char *tables = status == FST_OK ? fst_sweep_file_tables(identity->grid, mark) : NULL;
    char *statements = sqlite3_mprintf(
        "PRAGMA journal_mode = MEMORY; PRAGMA synchronous = FULL; PRAGMA page_size = 4096;"
        "PRAGMA auto_vacuum = NONE; BEGIN; PRAGMA application_id = %d; PRAGMA user_version = %d; %s",
        FST_SWEEP_APPLICATION_ID, FST_SWEEP_FORMAT, tables ? tables : "");
    if (status == FST_OK && (!tables || !statements))
        status = fst_fail(error, FST_NO_MEMORY, name, "out of memory");
    if (status == FST_OK)
        status = fst_database_do(database, name, statements, error);
    if (status == FST_OK)
        status = fst_identity_write(database, name, identity, mark, error);
    fst_identity_lines lines = {.count = 0};
    if (status == FST_OK && filling)
        status = fst_identity_read(database, name, &lines, error);
    if (status == FST_OK && filling)
        status = filling->fill(filling->user, database, fst_identity_checksum(&lines), error);
    if (status == FST_OK)
        status = fst_database_do(database, name, "COMMIT", error);
    fst_identity_free(&lines);
    sqlite3_free(statements);
    free(tables);
    return status;
}

static fst_status fill(const char *file, const char *name, const fst_sweep_identity *identity,
                       const fst_sweep_filling *filling, fst_error *error)
{
    sqlite3 *database = NULL;
    fst_status status = FST_OK;
    if (sqlite3_open_v2(file, &database, SQLITE_OPEN_READWRITE, NULL) != SQLITE_OK)
        status = fst_database_fail(database, name, error);
    if (status == FST_OK)
        status = write_all(database, name, identity, filling, error);
    if (status == FST_IO && (sqlite3_errcode(database) & 0xff) == SQLITE_FULL)
        status = fst_fail(error, FST_IO, name,
                          "the disk is full, and nothing of the new database is left: make room and give the "
                          "same command again");
    if (sqlite3_close(database) != SQLITE_OK && status == FST_OK)
        status = fst_fail(error, FST_IO, name, "closing the new database failed");
    return status;
}

/* ------------------------------------------------------------------ the new file */

static char *part_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *name = malloc(strlen(path) + 24);
    if (name)
        (void)sprintf(name, "%.*s.%.240s.festoon.part", (int)(slash + 1 - path), path, slash + 1);
    return name;
}

/* Make the new file: locked, filled and synced.  *descriptor is -1 where another command is making it. */
static fst_status make_part(const char *name, const char *part, const fst_sweep_identity *identity,
                            const fst_sweep_filling *filling, int last, int *descriptor, fst_error *error)
{
    fst_status status = part ? fst_lock_open(name, part, 1, last, descriptor, error)
                             : fst_fail(error, FST_NO_MEMORY, name, "out of memory");
    if (status != FST_OK || *descriptor < 0)
        return status;
    if (ftruncate(*descriptor, 0) != 0)
        status = fst_fail(error, FST_IO, name, "writing this file failed: %s", strerror(errno));
    if (status == FST_OK)
        status = fill(part, name, identity, filling, error);
    if (status == FST_OK && fsync(*descriptor) != 0)
        status = fst_fail(error, FST_IO, name, "writing this file failed: %s", strerror(errno));
    return status;
}

/* Remove the new file of which nothing came, unless it has its name, and give its lock back. */
static void give_up(const char *part, int *descriptor)
{
    struct stat opened;
    if (*descriptor < 0)
        return;
    if (fstat(*descriptor, &opened) == 0 && fst_lock_is_there(part, &opened))
        (void)unlink(part);
    (void)close(*descriptor);
    *descriptor = -1;
}

void fst_sweep_tidy(const char *path)
{
    char *part = part_name(path);
    int descriptor = -1;
    if (part && access(part, F_OK) == 0 && fst_lock_open(path, part, 1, 0, &descriptor, NULL) == FST_OK)
        give_up(part, &descriptor);
    free(part);
}

/* Steps 2 and 3, with the lock held. */
static fst_status give_name(const char *name, const char *path, const char *part, fst_error *error)
{
    struct stat there;
    fst_status status = fst_log_remove(path, error);
    if (status != FST_OK)
        return status;
    (void)fst_sync_directory_of(path);
    /* Another program may have made a file of that name just now.  An empty one is replaced. */
    int failed = stat(path, &there) == 0 ? (errno = EEXIST, -1)
                                         : renameat2(AT_FDCWD, part, AT_FDCWD, path, RENAME_NOREPLACE);
    if (failed && !fst_sweep_is_made(path))
        failed = rename(part, path);
    if (failed)
        return fst_fail(error, FST_IO, name, "writing this file failed: %s", strerror(errno));
    const int reason = fst_sync_directory_of(path);
    return reason ? fst_fail(error, FST_IO, name, "its directory cannot be synced: %s", strerror(reason))
                  : FST_OK;
}

fst_status fst_sweep_make(const char *name, const char *path, const fst_sweep_identity *identity,
                          const fst_sweep_filling *filling, int last, int *descriptor, fst_error *error)
{
    char *part = part_name(path);
    fst_status status = make_part(name, part, identity, filling, last, descriptor, error);
    const int is_faster = *descriptor >= 0 && fst_sweep_is_made(path); /* another command was */
    if (status == FST_OK && *descriptor >= 0 && !is_faster)
        status = give_name(name, path, part, error);
    if (status != FST_OK || is_faster)
        give_up(part, descriptor);
    free(part);
    return status;
}

/* ------------------------------------------------------------------ repairing */

/* Keep a damaged file as FILE.damaged, or FILE.damaged-2 and so on, with its logs. */
static fst_status keep_damaged(const char *name, const char *path, fst_error *error)
{
    enum { MOST = 1000 };
    char *kept = malloc(strlen(path) + 24);
    if (!kept)
        return fst_fail(error, FST_NO_MEMORY, name, "out of memory");
    int failed = -1;
    for (int i = 1; i < MOST && failed; ++i) {
        (void)sprintf(kept, i == 1 ? "%s.damaged" : "%s.damaged-%d", path, i);
        failed = link(path, kept);
        if (failed && errno != EEXIST)
            failed = renameat2(AT_FDCWD, path, AT_FDCWD, kept, RENAME_NOREPLACE);
        if (failed && errno != EEXIST)
            break;
    }
    const int reason = errno;
    if (!failed)
        fst_log_move(path, kept);
    free(kept);
    return failed ? fst_fail(error, FST_IO, name, "the damaged file cannot be kept as %s.damaged: %s", name,
                             strerror(reason))
                  : FST_OK;
}

static fst_status fill_from(void *user, sqlite3 *database, uint64_t seed, fst_error *error)
{
    const fst_sweep_file *damaged = user;
    fst_sweep_rows rows;
    int64_t differs;
    fst_status status = fst_sweep_rows_begin(&rows, damaged, error);
    if (status == FST_OK)
        status = fst_sweep_copy_rows(&rows, database, damaged->name, seed, &differs, error);
    fst_sweep_rows_end(&rows);
    return status;
}

fst_status fst_sweep_repair(fst_sweep_file *damaged, const fst_sweep_identity *identity, int *descriptor,
                            fst_error *error)
{
    int repaired = -1;
    const char *name = damaged->name;
    char *path = strdup(damaged->path), *part = path ? part_name(path) : NULL;
    const fst_sweep_filling sound = {fill_from, damaged};
    fst_status status = make_part(name, part, identity, &sound, 1, &repaired, error);
    fst_sweep_file_close(damaged);
    if (status == FST_OK)
        status = keep_damaged(name, path, error);
    if (status == FST_OK && rename(part, path) != 0)
        status = fst_fail(error, FST_IO, name, "writing this file failed: %s", strerror(errno));
    if (status == FST_OK) {
        (void)fst_sync_directory_of(path);
        (void)close(*descriptor);
        *descriptor = repaired;
    } else {
        give_up(part, &repaired);
    }
    free(path);
    free(part);
    return status;
}
