/* make.c - making a database: nothing has its name until it is whole, and two commands never make two.
 *
 *  1. .NAME.HOST-PROCESS-0.part   is made, filled, synced and locked; nobody else knows of it
 *  2. .NAME.lock                  is locked: one command at a time goes through steps 3 to 5
 *  3. NAME-wal, -shm, -journal    of an earlier database are removed: SQLite would take them for the new one's
 *  4. NAME                        the file of step 1 is renamed to it, if nothing else has the name
 *  5. .NAME.lock                  is removed
 *
 * The file keeps its lock when it is renamed, so another command that finds NAME also finds that it is in use.
 * A kill at any point leaves either no file of that name or a whole, unlocked database.  The next command to
 * that name removes what steps 1 and 2 left.
 */
#define _GNU_SOURCE /* renameat2() */
#include "sweep/make.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
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

/* Copy the sound rows of another database of the same sweep, with checksums of the new one. */
static fst_status copy_rows(sqlite3 *database, const char *name, const fst_sweep_file *from, uint64_t seed,
                            fst_error *error)
{
    const int count = fst_sweep_column_count(from->grid);
    char *sql = fst_sweep_insert_sql(from->grid);
    sqlite3_stmt *insert = NULL;
    fst_sweep_rows rows;
    int more = 0;
    fst_status status = fst_sweep_rows_begin(&rows, from, error);
    if (status == FST_OK && (!sql || sqlite3_prepare_v2(database, sql, -1, &insert, NULL) != SQLITE_OK))
        status = fst_database_fail(database, name, error);
    while (status == FST_OK && (status = fst_sweep_rows_next(&rows, &more, error)) == FST_OK && more) {
        for (int i = 0; i < count; ++i)
            (void)sqlite3_bind_value(insert, i + 1, sqlite3_column_value(rows.row, i));
        (void)sqlite3_bind_int64(insert, count + 1,
                                 (sqlite3_int64)fst_sweep_row_checksum(rows.row, count, seed));
        if (sqlite3_step(insert) != SQLITE_DONE)
            status = fst_database_fail(database, name, error);
        (void)sqlite3_reset(insert);
    }
    (void)sqlite3_finalize(insert);
    fst_sweep_rows_end(&rows);
    free(sql);
    return status;
}

static fst_status write_all(sqlite3 *database, const char *name, const fst_sweep_identity *identity,
                            const fst_sweep_file *from, fst_error *error)
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
    if (status == FST_OK && from)
        status = fst_identity_read(database, name, &lines, error);
    if (status == FST_OK && from)
        status = copy_rows(database, name, from, fst_identity_checksum(&lines), error);
    if (status == FST_OK)
        status = fst_database_do(database, name, "COMMIT", error);
    fst_identity_free(&lines);
    sqlite3_free(statements);
    free(tables);
    return status;
}

static fst_status fill(const char *file, const char *name, const fst_sweep_identity *identity,
                       const fst_sweep_file *from, fst_error *error)
{
    sqlite3 *database = NULL;
    fst_status status = FST_OK;
    if (sqlite3_open_v2(file, &database, SQLITE_OPEN_READWRITE, NULL) != SQLITE_OK)
        status = fst_database_fail(database, name, error);
    if (status == FST_OK)
        status = write_all(database, name, identity, from, error);
    if (sqlite3_close(database) != SQLITE_OK && status == FST_OK)
        status = fst_fail(error, FST_IO, name, "closing the new database failed");
    return status;
}

/* Make a filled, locked and synced file beside the place; *descriptor holds the lock. */
static fst_status make_part(const char *name, const char *path, const fst_sweep_identity *identity,
                            const fst_sweep_file *from, fst_whole_file *part, int *descriptor, fst_error *error)
{
    *descriptor = -1;
    fst_status status = fst_whole_file_open(part, path, error);
    if (status != FST_OK)
        return status;
    (void)fclose(part->stream); /* SQLite opens it by its name */
    part->stream = NULL;
    status = fill(part->temporary, name, identity, from, error);
    if (status == FST_OK) {
        *descriptor = open(part->temporary, O_RDWR | O_CLOEXEC);
        if (*descriptor < 0 || fsync(*descriptor) != 0)
            status = fst_fail(error, FST_IO, name, "writing this file failed: %s", strerror(errno));
        else if (fst_lock_take(*descriptor) != FST_LOCK_MINE)
            status =
                fst_fail(error, FST_IO, name,
                         "this file cannot be locked (%s): choose one on another file system", strerror(errno));
    }
    if (status != FST_OK) {
        if (*descriptor >= 0)
            (void)close(*descriptor);
        *descriptor = -1;
        fst_whole_file_discard(part);
    }
    return status;
}

/* ------------------------------------------------------------------ one command at a time */

static char *lock_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *name = malloc(strlen(path) + 16);
    if (name)
        (void)sprintf(name, "%.*s.%.240s.lock", (int)(slash + 1 - path), path, slash + 1);
    return name;
}

static void wait_a_little(void)
{
    const struct timespec time = {0, 20000000};
    (void)nanosleep(&time, NULL);
}

/* Make the file of this name, if it is missing, and lock it.  The command that holds the lock removes the file
 * when it is done.  So the file that was locked may have lost its name meanwhile; then the next one is tried.
 */
static fst_status lock_making(const char *lock, const char *name, int *descriptor, fst_error *error)
{
    enum { TRIES = 500 };
    for (int i = 0; i < TRIES; ++i) {
        struct stat opened;
        *descriptor = open(lock, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (*descriptor < 0)
            return fst_fail(error, FST_IO, name, "cannot write here: %s", strerror(errno));
        const fst_lock_state state = fst_lock_take(*descriptor);
        if (state == FST_LOCK_MINE && fstat(*descriptor, &opened) == 0 &&
            fst_sweep_file_is_there(lock, &opened))
            return FST_OK;
        fst_status status = FST_OK;
        if (state == FST_LOCK_IMPOSSIBLE)
            status =
                fst_fail(error, FST_IO, name,
                         "this file cannot be locked (%s): choose one on another file system", strerror(errno));
        else if (state == FST_LOCK_TAKEN && i == TRIES - 1)
            status = fst_lock_fail(*descriptor, name, error);
        (void)close(*descriptor);
        *descriptor = -1;
        if (status != FST_OK)
            return status;
        if (state == FST_LOCK_TAKEN)
            wait_a_little();
    }
    return fst_fail(error, FST_IO, name, "other commands keep making and removing this file: try again later");
}

void fst_sweep_tidy(const char *path)
{
    struct stat opened;
    char *lock = lock_name(path);
    const int descriptor = lock ? open(lock, O_RDWR | O_CLOEXEC | O_NOFOLLOW) : -1;
    if (descriptor >= 0) {
        if (fst_lock_take(descriptor) == FST_LOCK_MINE && fstat(descriptor, &opened) == 0 &&
            fst_sweep_file_is_there(lock, &opened))
            (void)unlink(lock);
        (void)close(descriptor);
    }
    free(lock);
    fst_whole_file_tidy_beside(path);
}

/* Rename a file unless something other than an empty file has the new name. */
static int rename_if_free(const char *from, const char *to)
{
    struct stat there;
    if (stat(to, &there) == 0)
        return S_ISREG(there.st_mode) && there.st_size == 0 ? rename(from, to) : (errno = EEXIST, -1);
    if (renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0)
        return 0;
    if (errno == EEXIST)
        return -1;
    /* A file system without that call has links, or is too simple for two commands at once. */
    if (link(from, to) == 0) {
        (void)unlink(from);
        return 0;
    }
    return errno == EEXIST ? -1 : rename(from, to);
}

/* Steps 3 and 4, with the lock held. *made is 0 where another command was faster. */
static fst_status give_name(const char *name, const char *path, const fst_whole_file *part, int *made,
                            fst_error *error)
{
    *made = 0;
    if (fst_sweep_is_made(path))
        return FST_OK;
    fst_status status = fst_log_remove(path, error);
    if (status != FST_OK)
        return status;
    (void)fst_sync_directory_of(path);
    *made = rename_if_free(part->temporary, path) == 0;
    if (!*made && errno != EEXIST)
        return fst_fail(error, FST_IO, name, "writing this file failed: %s", strerror(errno));
    const int reason = fst_sync_directory_of(path);
    return reason ? fst_fail(error, FST_IO, name, "its directory cannot be synced: %s", strerror(reason))
                  : FST_OK;
}

fst_status fst_sweep_make(const char *name, const char *path, const fst_sweep_identity *identity,
                          int *descriptor, fst_error *error)
{
    fst_whole_file part;
    int lock = -1, made = 0;
    fst_status status = make_part(name, path, identity, NULL, &part, descriptor, error);
    if (status != FST_OK)
        return status;
    char *locked = lock_name(path);
    status = locked ? lock_making(locked, name, &lock, error)
                    : fst_fail(error, FST_NO_MEMORY, name, "out of memory");
    if (status == FST_OK) {
        status = give_name(name, path, &part, &made, error);
        (void)unlink(locked);
        (void)close(lock);
    }
    free(locked);
    fst_whole_file_discard(&part); /* removes nothing where the file has its name */
    if (!made) {
        (void)close(*descriptor);
        *descriptor = -1;
    }
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

fst_status fst_sweep_repair(fst_sweep_file *damaged, const fst_sweep_identity *identity, int *descriptor,
                            fst_error *error)
{
    fst_whole_file part;
    int repaired = -1;
    const char *name = damaged->name;
    char *path = strdup(damaged->path);
    fst_status status = path ? make_part(name, path, identity, damaged, &part, &repaired, error)
                             : fst_fail(error, FST_NO_MEMORY, name, "out of memory");
    fst_sweep_file_close(damaged);
    if (status == FST_OK) {
        status = keep_damaged(name, path, error);
        if (status == FST_OK && rename(part.temporary, path) != 0)
            status = fst_fail(error, FST_IO, name, "writing this file failed: %s", strerror(errno));
        (void)fst_sync_directory_of(path);
        fst_whole_file_discard(&part);
    }
    if (status == FST_OK) {
        (void)close(*descriptor);
        *descriptor = repaired;
    } else if (repaired >= 0) {
        (void)close(repaired);
    }
    free(path);
    return status;
}
