/* journal.c - the journal of a sweep: an SQLite database that one thread of one process fills, row by row.
 *
 * A row on its way from a worker to the disk:
 *
 *  worker ends a run
 *     |  fst_workers_take()                 sweep.c
 *     v
 *  fst_journal_add()      INSERT, within an open transaction: a kill loses the row
 *     |  every 256 rows, or 0.5 s after the last commit
 *     v
 *  fst_journal_commit()   COMMIT: SQLite appends the changed pages to FILE-wal and syncs it.  From here on
 *     |                   the row survives a kill and a loss of power.
 *     |  once the log has 1000 pages, and at the end
 *     v
 *  empty_log()            the pages are copied into FILE and synced, and FILE-wal is cut to length zero
 *
 * What this file adds to SQLite:
 *
 * - One writer.  Before anything is read the process takes a lock of the kernel on the file (lock.c), so that
 * two sweeps never write one file; SQLite's own locks would let them take turns.
 *
 * - Its own log only.  SQLite believes any log of the right name.  So every database bears a random mark, every
 * transaction writes the page with it (the table `seal`), and a log is checked before SQLite sees it (log.c).
 *
 * - An empty log to begin with.  A process that was killed while it committed leaves pages behind the end of the
 * log.  Shorter transactions after it would overwrite some of them, and the rest would look like damage.
 *
 * - Rows that are checked.  When a sweep is continued, every row is read against its checksum.  If one is
 * damaged, check_rows() replaces the database by a new one with the sound rows (make.c), keeps the damaged file
 * under another name, and the lost points are computed again.
 *
 * - The name that was given.  After each commit check_place() looks whether the name still leads to this file.
 * If the file was renamed, the sweep ends and says where its rows are; if it was deleted or replaced, its rows
 * are saved beside it first (rescue()).
 *
 * On a network file system a rollback journal takes the place of the write-ahead log, with the same promises.
 * docs/sweeps.md lists the promises; docs/inside/reliability.md says how they are attacked.
 */
#include "sweep/journal.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/error.h"
#include "host/file_system.h"
#include "host/whole_file.h"
#include "sweep/columns.h"
#include "sweep/file.h"
#include "sweep/lock.h"
#include "sweep/make.h"
#include "sweep/refined.h"
#include "sweep/sweep.h"

struct fst_journal {
    fst_sweep_file file;
    int descriptor; /* holds the lock; closed after SQLite's own, because closing any descriptor ends SQLite's
                       locks */
    sqlite3_stmt *insert, *next, *state, *value;
    const fst_grid *grid;
    char *path; /* the name that the user gave */
    int in_transaction;
    int log_pages; /* pages in the log after the last commit */
    int64_t lost;
    int repaired;
    int is_away; /* the file lost its name, and the caller was told */
};

/* ------------------------------------------------------------------ opening */

static int note_log(void *user, sqlite3 *database, const char *name, int pages)
{
    (void)database;
    (void)name;
    ((fst_journal *)user)->log_pages = pages;
    return SQLITE_OK;
}

enum { PATIENCE = 5000 };

/* Write the log's pages into the file and cut the log to length zero.  A log that starts over without being cut
 * would keep old frames behind its end, among which damage could not be told.  A reader that is busy for longer than
 * these milliseconds puts this off. */
static void empty_log(fst_journal *journal, int patience)
{
    sqlite3 *database = journal->file.database;
    (void)sqlite3_busy_timeout(database, patience);
    if (sqlite3_wal_checkpoint_v2(database, NULL, SQLITE_CHECKPOINT_TRUNCATE, NULL, NULL) == SQLITE_OK)
        journal->log_pages = 0;
    (void)sqlite3_busy_timeout(database, PATIENCE);
}

static fst_status prepare(fst_journal *journal, fst_error *error)
{
    sqlite3 *database = journal->file.database;
    /* A write-ahead log is unsafe on network file systems: use a rollback journal there, also for a database
     * that was begun with a write-ahead log.  EXTRA syncs the folder after each commit: else a loss of power could bring
     * the deleted journal back, which would undo the commit. */
    const char *mode =
        fst_on_network(journal->path)
            ? "PRAGMA journal_mode = DELETE; PRAGMA locking_mode = NORMAL; PRAGMA synchronous = EXTRA"
            : "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL";
    fst_status status = fst_database_do(database, journal->path, mode, error);
    (void)sqlite3_wal_hook(database, note_log, journal);
    if (status == FST_OK)
        empty_log(journal, PATIENCE);
    char *insert = fst_sweep_insert_sql(journal->grid);
    char *state = fst_sweep_state_sql(journal->grid);
    if (status == FST_OK && (!insert || !state))
        status = fst_fail(error, FST_NO_MEMORY, journal->path, "out of memory");
    if (status == FST_OK &&
        (sqlite3_prepare_v2(database, insert, -1, &journal->insert, NULL) != SQLITE_OK ||
         sqlite3_prepare_v2(database, "SELECT point FROM rows WHERE point >= ? ORDER BY point", -1,
                            &journal->next, NULL) != SQLITE_OK ||
         sqlite3_prepare_v2(database, state, -1, &journal->state, NULL) != SQLITE_OK))
        status = fst_database_fail(database, journal->path, error);
    free(insert);
    free(state);
    return status;
}

static void finalize(fst_journal *journal)
{
    (void)sqlite3_finalize(journal->insert);
    (void)sqlite3_finalize(journal->next);
    (void)sqlite3_finalize(journal->state);
    (void)sqlite3_finalize(journal->value);
    journal->insert = journal->next = journal->state = journal->value = NULL;
}

static void release(fst_journal *journal)
{
    finalize(journal);
    fst_sweep_file_close(&journal->file);
    if (journal->descriptor >= 0)
        (void)close(journal->descriptor);
    free(journal->path);
    free(journal);
}

/* Take an existing file, if it is a sweep's; *descriptor is -1 where it cannot be had now. */
static fst_status take_existing(const char *name, const char *path, int last, int *descriptor, fst_error *error)
{
    char mark[FST_MARK_SIZE];
    fst_status status = fst_lock_open(name, path, 0, last, descriptor, error);
    if (*descriptor < 0)
        return status;
    status = fst_database_head(*descriptor, name, 1, mark, error);
    if (status == FST_OK) {
        fst_sweep_tidy(path);
    } else {
        (void)close(*descriptor);
        *descriptor = -1;
    }
    return status;
}

/* Make the file or take an existing one, and hold its lock.  It is tried for two seconds, because a command
 * that was just killed may take a moment to end. */
static fst_status take_file(const char *name, const char *path, const fst_sweep_identity *identity,
                            int *descriptor, fst_error *error)
{
    enum { TRIES = 100 };
    const struct timespec moment = {0, 20000000};
    fst_status status = FST_OK;
    *descriptor = -1;
    for (int i = 0; i < TRIES && status == FST_OK && *descriptor < 0; ++i) {
        if (i > 0)
            (void)nanosleep(&moment, NULL);
        status = fst_sweep_is_made(path)
                     ? take_existing(name, path, i == TRIES - 1, descriptor, error)
                     : fst_sweep_make(name, path, identity, NULL, i == TRIES - 1, descriptor, error);
    }
    if (status == FST_OK && *descriptor < 0)
        status =
            fst_fail(error, FST_IO, name, "other commands keep making and removing this file: try again later");
    return status;
}

/* Read every row.  Where one is damaged, replace the database by a new one that has the sound rows. */
static fst_status check_rows(fst_journal *journal, const fst_sweep_identity *identity, fst_error *error)
{
    fst_sweep_rows rows;
    int more = 0;
    fst_status status = fst_sweep_rows_begin(&rows, &journal->file, error);
    while (status == FST_OK && (status = fst_sweep_rows_next(&rows, &more, error)) == FST_OK && more)
        continue;
    const int whole = fst_sweep_rows_are_whole(&rows);
    journal->lost = rows.lost.count + rows.lost.outside;
    fst_sweep_rows_end(&rows);
    if (status != FST_OK || whole)
        return status;
    journal->repaired = 1;
    status = fst_sweep_repair(&journal->file, identity, &journal->descriptor, error);
    return status == FST_OK ? fst_sweep_file_open(journal->path, 1, &journal->file, error) : status;
}

static fst_status open_taken(fst_journal *journal, const fst_sweep_identity *identity, fst_error *error)
{
    struct stat locked;
    fst_status status = fst_sweep_file_open(journal->path, 1, &journal->file, error);
    if (status == FST_OK &&
        (fstat(journal->descriptor, &locked) != 0 || locked.st_ino != journal->file.there.st_ino ||
         locked.st_dev != journal->file.there.st_dev))
        status = fst_fail(error, FST_IO, journal->path, "this file was replaced a moment ago: try again");
    if (status == FST_OK)
        status = fst_identity_compare(&journal->file.lines, journal->path, identity, NULL, error);
    if (status == FST_OK)
        status = check_rows(journal, identity, error);
    if (status == FST_OK)
        status = prepare(journal, error);
    return status;
}

fst_status fst_journal_open(const char *path, const fst_sweep_identity *identity, fst_journal **journal,
                            fst_error *error)
{
    *journal = NULL;
    fst_journal *made = calloc(1, sizeof *made);
    if (!made || !(made->path = strdup(path))) {
        free(made);
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    }
    made->grid = identity->grid;
    made->descriptor = -1;
    char *absolute = NULL;
    fst_status status = fst_database_path(path, &absolute, error);
    if (status == FST_OK)
        status = take_file(path, absolute, identity, &made->descriptor, error);
    free(absolute);
    if (status == FST_OK)
        status = open_taken(made, identity, error);
    if (status != FST_OK) {
        release(made);
        return status;
    }
    *journal = made;
    return FST_OK;
}

int fst_journal_repaired(const fst_journal *journal, int64_t *lost)
{
    *lost = journal->lost;
    return journal->repaired;
}

/* ------------------------------------------------------------------ rows */

struct sqlite3 *fst_journal_database(const fst_journal *journal)
{
    return journal->file.database;
}

const char *fst_journal_path(const fst_journal *journal)
{
    return journal->path;
}

fst_status fst_journal_begin(fst_journal *journal, fst_error *error)
{
    if (journal->in_transaction)
        return FST_OK;
    fst_status status = fst_database_do(journal->file.database, journal->path, "BEGIN IMMEDIATE", error);
    if (status != FST_OK)
        return status;
    journal->in_transaction = 1;
    /* Each transaction writes the page that bears the mark: so the log can be recognised as this file's. */
    return fst_database_do(journal->file.database, journal->path, "UPDATE seal SET commits = commits + 1",
                           error);
}

fst_status fst_journal_add(fst_journal *journal, const fst_sweep_record *record, fst_error *error)
{
    const fst_status begun = fst_journal_begin(journal, error);
    if (begun != FST_OK)
        return begun;
    const int bound = fst_sweep_bind(journal->insert, journal->grid, journal->file.seed, record);
    const int code = bound == SQLITE_OK ? sqlite3_step(journal->insert) : bound;
    const fst_status status =
        code == SQLITE_DONE ? FST_OK : fst_database_fail(journal->file.database, journal->path, error);
    (void)sqlite3_reset(journal->insert);
    return status;
}

/* ------------------------------------------------------------------ refining */

static fst_status note_refining(fst_journal *journal, const fst_refining *refining, fst_error *error)
{
    fst_refining noted;
    const fst_status status = fst_refining_read(&journal->file.lines, journal->path, &noted, error);
    if (status != FST_OK || (noted.levels == refining->levels && noted.step == refining->step &&
                             strcmp(noted.key, refining->key) == 0))
        return status;
    const fst_status begun = fst_journal_begin(journal, error);
    if (begun != FST_OK)
        return begun;
    const fst_status written =
        fst_refining_write(journal->file.database, journal->path, &journal->file.lines, refining, error);
    return written == FST_OK ? fst_journal_commit(journal, error) : written;
}

fst_status fst_journal_refine(fst_journal *journal, const fst_refining *refining, fst_error *error)
{
    const fst_status status = note_refining(journal, refining, error);
    if (status != FST_OK || refining->levels == 0)
        return status;
    char *select = sqlite3_mprintf("SELECT \"%w\" FROM rows WHERE point = ?", refining->key);
    const int code =
        select ? sqlite3_prepare_v2(journal->file.database, select, -1, &journal->value, NULL) : SQLITE_NOMEM;
    sqlite3_free(select);
    return code == SQLITE_OK ? FST_OK : fst_database_fail(journal->file.database, journal->path, error);
}

fst_status fst_journal_value(fst_journal *journal, int64_t point, int *there, double *value, fst_error *error)
{
    (void)sqlite3_bind_int64(journal->value, 1, point);
    const int code = sqlite3_step(journal->value);
    *there = code == SQLITE_ROW;
    *value = *there ? fst_sweep_number(journal->value, 0) : NAN;
    const fst_status status = code == SQLITE_ROW || code == SQLITE_DONE
                                  ? FST_OK
                                  : fst_database_fail(journal->file.database, journal->path, error);
    (void)sqlite3_reset(journal->value);
    return status;
}

/* ------------------------------------------------------------------ is it still there? */

/* Where the open file is now, according to the kernel. */
static void find_file(const fst_journal *journal, char *place, size_t size)
{
    char link[40];
    (void)snprintf(link, sizeof link, "/proc/self/fd/%d", journal->descriptor);
    const ssize_t length = readlink(link, place, size - 1);
    place[length > 0 ? length : 0] = '\0';
}

/* The file has no name any more: save its rows as FILE.rescued, or FILE.rescued-2 and so on, if its folder
 * still exists. */
static fst_status rescue(fst_journal *journal, fst_error *error)
{
    enum { MOST = 1000 };
    char ending[24] = ".rescued", *to = NULL;
    struct stat there;
    int is_free = 0, saved = 0;
    for (int i = 2; i < MOST && !is_free; ++i) {
        sqlite3_free(to);
        to = sqlite3_mprintf("%s%s", journal->file.path, ending);
        is_free = to && lstat(to, &there) != 0;
        if (!is_free)
            (void)snprintf(ending, sizeof ending, ".rescued-%d", i);
    }
    char *statement = is_free ? sqlite3_mprintf("VACUUM INTO %Q", to) : NULL;
    if (statement)
        saved = sqlite3_exec(journal->file.database, statement, NULL, NULL, NULL) == SQLITE_OK;
    if (saved)
        (void)fst_sync_directory_of(to);
    sqlite3_free(statement);
    sqlite3_free(to);
    return saved ? fst_fail(error, FST_IO, journal->path,
                            "this file was deleted or replaced while the sweep ran; its rows were saved as "
                            "%s%s, which the same command goes on with under its old name",
                            journal->path, ending)
                 : fst_fail(error, FST_IO, journal->path,
                            "this file was deleted or replaced while the sweep ran, and its rows could not be "
                            "saved beside it; they are lost");
}

/* FST_IO where the name no longer leads to this file, so that committed rows are in a file without a name or
 * with another one. */
static fst_status check_place(fst_journal *journal, fst_error *error)
{
    struct stat mine;
    if (journal->is_away || fst_lock_is_there(journal->file.path, &journal->file.there))
        return FST_OK;
    journal->is_away = 1;
    (void)sqlite3_wal_checkpoint_v2(journal->file.database, NULL, SQLITE_CHECKPOINT_TRUNCATE, NULL, NULL);
    if (fstat(journal->descriptor, &mine) != 0 || mine.st_nlink == 0)
        return rescue(journal, error);
    char place[300];
    find_file(journal, place, sizeof place);
    return fst_fail(error, FST_IO, journal->path,
                    "this file was renamed or replaced while the sweep ran; its rows are in %s: give that file "
                    "its old name to go on with it",
                    place[0] ? place : "the renamed file");
}

/* ------------------------------------------------------------------ committing */

enum { LOG_PAGES = 1000 };

fst_status fst_journal_commit(fst_journal *journal, fst_error *error)
{
    if (!journal->in_transaction)
        return FST_OK;
    const fst_status status = fst_database_do(journal->file.database, journal->path, "COMMIT", error);
    journal->in_transaction = status != FST_OK && !sqlite3_get_autocommit(journal->file.database);
    if (status == FST_OK && journal->log_pages >= LOG_PAGES)
        empty_log(journal, 0);
    return status == FST_OK ? check_place(journal, error) : status;
}

fst_status fst_journal_count(fst_journal *journal, int64_t *rows, fst_error *error)
{
    sqlite3_stmt *query = NULL;
    fst_status status = FST_OK;
    if (sqlite3_prepare_v2(journal->file.database, "SELECT count(*) FROM rows", -1, &query, NULL) ==
            SQLITE_OK &&
        sqlite3_step(query) == SQLITE_ROW)
        *rows = sqlite3_column_int64(query, 0);
    else
        status = fst_database_fail(journal->file.database, journal->path, error);
    (void)sqlite3_finalize(query);
    return status;
}

fst_status fst_journal_all_failed(fst_journal *journal, char *reason, size_t size, fst_error *error)
{
    static const char asked[] =
        "SELECT status || ': ' || reason FROM rows "
        "WHERE NOT EXISTS (SELECT 1 FROM rows WHERE status = 'done') ORDER BY point LIMIT 1";
    sqlite3_stmt *query = NULL;
    int code = sqlite3_prepare_v2(journal->file.database, asked, -1, &query, NULL);
    reason[0] = '\0';
    if (code == SQLITE_OK)
        code = sqlite3_step(query);
    if (code == SQLITE_ROW && sqlite3_column_text(query, 0))
        (void)snprintf(reason, size, "%s", (const char *)sqlite3_column_text(query, 0));
    const fst_status status = code == SQLITE_ROW || code == SQLITE_DONE
                                  ? FST_OK
                                  : fst_database_fail(journal->file.database, journal->path, error);
    (void)sqlite3_finalize(query);
    return status;
}

fst_status fst_journal_missing(fst_journal *journal, int64_t *next, int64_t *points, int room, int *found,
                               fst_error *error)
{
    const int64_t end = fst_grid_points(journal->grid);
    *found = 0;
    (void)sqlite3_bind_int64(journal->next, 1, *next);
    int code = sqlite3_step(journal->next);
    while (*next < end && *found < room && (code == SQLITE_ROW || code == SQLITE_DONE)) {
        const int64_t there = code == SQLITE_ROW ? sqlite3_column_int64(journal->next, 0) : end;
        for (; *next < there && *next < end && *found < room; ++*next)
            if (fst_sweep_has_point(&journal->file.identity, *next))
                points[(*found)++] = *next;
        if (*next == there && *next < end) {
            ++*next;
            code = sqlite3_step(journal->next);
        }
    }
    const fst_status status = code == SQLITE_ROW || code == SQLITE_DONE
                                  ? FST_OK
                                  : fst_database_fail(journal->file.database, journal->path, error);
    (void)sqlite3_reset(journal->next);
    return status;
}

fst_status fst_journal_end_state(fst_journal *journal, int64_t point, int *there, int *usable,
                                 double state[FST_BEAD_NUMBERS], fst_error *error)
{
    fst_params params = fst_default_params();
    (void)fst_grid_params(journal->grid, point, &params, NULL); /* where this fails, the row did */
    (void)sqlite3_bind_int64(journal->state, 1, point);
    (void)sqlite3_bind_double(journal->state, 2, params.run_periods);
    const int code = sqlite3_step(journal->state);
    *there = code == SQLITE_ROW;
    *usable = 0;
    if (*there) {
        *usable = sqlite3_column_int(journal->state, 0);
        for (int i = 0; i + 1 < sqlite3_column_count(journal->state); ++i)
            state[i] = fst_sweep_number(journal->state, 1 + i);
    }
    const fst_status status = code == SQLITE_ROW || code == SQLITE_DONE
                                  ? FST_OK
                                  : fst_database_fail(journal->file.database, journal->path, error);
    (void)sqlite3_reset(journal->state);
    return status;
}

fst_status fst_journal_close(fst_journal *journal, fst_error *error)
{
    if (!journal)
        return FST_OK;
    fst_status status = fst_journal_commit(journal, error);
    if (status == FST_OK)
        status = check_place(journal, error);
    /* If this fails (a full disk), the rows are still safe in the log beside the file. */
    if (status == FST_OK)
        (void)sqlite3_wal_checkpoint_v2(journal->file.database, NULL, SQLITE_CHECKPOINT_TRUNCATE, NULL, NULL);
    release(journal);
    return status;
}
