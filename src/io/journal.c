#include "io/journal.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/error.h"
#include "base/whole_file.h"
#include "io/database.h"
#include "io/file_system.h"
#include "io/sweep_columns.h"

struct fst_journal {
    sqlite3 *database;
    sqlite3_stmt *insert, *next, *state;
    const fst_grid *grid;
    char *path;
    int in_transaction;
};

/* ------------------------------------------------------------------ identity */

enum { IDENTITY_SIZE = 16 };

/* Key and value of each line of the table `festoon`. */
typedef struct identity_line {
    char key[24];
    char *value;
} identity_line;

static char *format_text(const char *format, ...) __attribute__((format(printf, 1, 2)));
static char *format_text(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    char *text = sqlite3_vmprintf(format, values), *copy = text ? strdup(text) : NULL;
    va_end(values);
    sqlite3_free(text);
    return copy;
}

/* All lines that must agree for a sweep to go on; the first is the scene.  Returns their number. */
static int identity_lines(const fst_sweep_identity *identity, identity_line lines[IDENTITY_SIZE])
{
    static const char *const carry[] = {"no", "up", "down"};
    int count = 0;
#define LINE(name, text)                                                                                       \
    (void)snprintf(lines[count].key, sizeof lines[count].key, "%s", name), lines[count++].value = (text)
    LINE("scene", fst_scene_text(fst_grid_base(identity->grid), 0));
    LINE("axes", format_text("%d", fst_grid_axis_count(identity->grid)));
    for (int i = 0; i < fst_grid_axis_count(identity->grid); ++i) {
        char name[24];
        (void)snprintf(name, sizeof name, "axis_%d", i + 1);
        LINE(name, strdup(fst_grid_axis_text(identity->grid, i)));
    }
    LINE("seed", format_text("%llu", (unsigned long long)identity->seed));
    LINE("carry", strdup(carry[identity->carry]));
    LINE("arithmetic", strdup(fst_arithmetic_name(identity->arithmetic)));
    LINE("fingerprint", format_text("%016llx", (unsigned long long)identity->fingerprint));
    LINE("results_version", format_text("%d", FST_RESULTS_VERSION));
#undef LINE
    return count;
}

static void free_lines(identity_line *lines, int count)
{
    for (int i = 0; i < count; ++i)
        free(lines[i].value);
}

uint64_t fst_journal_identity_hash(const fst_sweep_identity *identity)
{
    identity_line lines[IDENTITY_SIZE];
    const int count = identity_lines(identity, lines);
    uint64_t hash = 0xcbf29ce484222325u; /* FNV-1a */
    for (int i = 0; i < count; ++i)
        for (const char *c = lines[i].value ? lines[i].value : ""; *c; ++c)
            hash = (hash ^ (unsigned char)*c) * 0x100000001b3u;
    free_lines(lines, count);
    return hash;
}

/* Which parameter differs between the scene of the file and the wanted one. */
static fst_status fail_scene(const char *path, const char *there, const fst_params *wanted, fst_error *error)
{
    fst_params made = fst_default_params();
    if (fst_scene_parse(there, strlen(there), path, &made, NULL) == FST_OK)
        for (int i = 0; i < fst_param_count(); ++i) {
            char before[64], now[64];
            (void)fst_params_get(&made, i, before, sizeof before);
            (void)fst_params_get(wanted, i, now, sizeof now);
            if (strcmp(before, now) != 0)
                return fst_fail(
                    error, FST_BAD_INPUT, path,
                    "this sweep was made with %s = %s, not %s; it was left untouched: choose another file, "
                    "or the same parameters to go on with it",
                    fst_param_at(i)->key, before[0] ? before : "(not given)", now[0] ? now : "(not given)");
        }
    return fst_fail(error, FST_BAD_INPUT, path,
                    "this sweep was made from another scene; it was left untouched");
}

static fst_status compare_identity(const fst_journal *journal, const fst_sweep_identity *identity,
                                   fst_error *error)
{
    identity_line lines[IDENTITY_SIZE];
    const int count = identity_lines(identity, lines);
    fst_status status = FST_OK;
    for (int i = 0; i < count && status == FST_OK; ++i) {
        char *there = fst_database_text(journal->database, lines[i].key);
        if (!lines[i].value)
            status = fst_fail(error, FST_NO_MEMORY, journal->path, "out of memory");
        else if (!there)
            status = fst_fail(error, FST_BAD_INPUT, journal->path,
                              "this sweep does not say its %s; it was left untouched: choose another file",
                              lines[i].key);
        else if (strcmp(there, lines[i].value) != 0 && i == 0)
            status = fail_scene(journal->path, there, fst_grid_base(identity->grid), error);
        else if (strcmp(there, lines[i].value) != 0)
            status = fst_fail(
                error, FST_BAD_INPUT, journal->path,
                "this sweep was made with %s %.120s, not %.120s; it was left untouched: choose another "
                "file, or the same options to go on with it",
                lines[i].key, there, lines[i].value);
        free(there);
    }
    free_lines(lines, count);
    return status;
}

/* ------------------------------------------------------------------ making */

static fst_status write_identity(sqlite3 *database, const char *path, const fst_sweep_identity *identity,
                                 fst_error *error)
{
    identity_line lines[IDENTITY_SIZE];
    int count = identity_lines(identity, lines);
    (void)snprintf(lines[count].key, sizeof lines[count].key, "version");
    lines[count++].value = strdup(fst_version());
    (void)snprintf(lines[count].key, sizeof lines[count].key, "points");
    lines[count++].value = format_text("%lld", (long long)fst_grid_points(identity->grid));
    fst_status status = FST_OK;
    for (int i = 0; i < count && status == FST_OK; ++i) {
        char *statement = sqlite3_mprintf("INSERT INTO festoon VALUES(%Q, %Q)", lines[i].key, lines[i].value);
        status = statement && lines[i].value ? fst_database_do(database, path, statement, error)
                                             : fst_fail(error, FST_NO_MEMORY, path, "out of memory");
        sqlite3_free(statement);
    }
    free_lines(lines, count);
    return status;
}

static fst_status fill_new(const char *file, const char *path, const fst_sweep_identity *identity,
                           fst_error *error)
{
    sqlite3 *database = NULL;
    fst_status status = FST_OK;
    if (sqlite3_open_v2(file, &database, SQLITE_OPEN_READWRITE, NULL) != SQLITE_OK)
        status = fst_database_fail(database, path, error);
    char *columns = fst_sweep_columns_sql(identity->grid);
    char *statements = sqlite3_mprintf("BEGIN; PRAGMA application_id = %d; PRAGMA user_version = 1;"
                                       "CREATE TABLE festoon(key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;"
                                       "CREATE TABLE rows(%s);",
                                       FST_SWEEP_APPLICATION_ID, columns ? columns : "");
    if (status == FST_OK && (!columns || !statements))
        status = fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    if (status == FST_OK)
        status = fst_database_do(database, path, statements, error);
    if (status == FST_OK)
        status = write_identity(database, path, identity, error);
    if (status == FST_OK)
        status = fst_database_do(database, path, "COMMIT", error);
    sqlite3_free(statements);
    free(columns);
    (void)sqlite3_close(database);
    return status;
}

static fst_status make(const char *path, const fst_sweep_identity *identity, fst_error *error)
{
    fst_whole_file file;
    fst_status status = fst_whole_file_open(&file, path, error);
    if (status != FST_OK)
        return status;
    (void)fclose(file.stream); /* SQLite opens it by its name */
    file.stream = NULL;
    status = fill_new(file.temporary, path, identity, error);
    if (status == FST_OK)
        return fst_whole_file_commit(&file, error);
    fst_whole_file_discard(&file);
    return status;
}

/* ------------------------------------------------------------------ opening */

static fst_status prepare(fst_journal *journal, fst_error *error)
{
    /* A database that was begun elsewhere with a log is turned into one without where it lies on a network. */
    const char *mode =
        fst_on_network(journal->path)
            ? "PRAGMA journal_mode = DELETE; PRAGMA locking_mode = NORMAL; PRAGMA synchronous = FULL"
            : "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL";
    fst_status status = fst_database_do(journal->database, journal->path, mode, error);
    char *insert = fst_sweep_insert_sql(journal->grid);
    char *state = fst_sweep_state_sql();
    if (status == FST_OK && (!insert || !state))
        status = fst_fail(error, FST_NO_MEMORY, journal->path, "out of memory");
    if (status == FST_OK &&
        (sqlite3_prepare_v2(journal->database, insert, -1, &journal->insert, NULL) != SQLITE_OK ||
         sqlite3_prepare_v2(journal->database, "SELECT point FROM rows WHERE point >= ? ORDER BY point", -1,
                            &journal->next, NULL) != SQLITE_OK ||
         sqlite3_prepare_v2(journal->database, state, -1, &journal->state, NULL) != SQLITE_OK))
        status = fst_database_fail(journal->database, journal->path, error);
    free(insert);
    free(state);
    return status;
}

static void release(fst_journal *journal)
{
    (void)sqlite3_finalize(journal->insert);
    (void)sqlite3_finalize(journal->next);
    (void)sqlite3_finalize(journal->state);
    (void)sqlite3_close(journal->database);
    free(journal->path);
    free(journal);
}

fst_status fst_journal_open(const char *path, const fst_sweep_identity *identity, fst_journal **journal,
                            fst_error *error)
{
    *journal = NULL;
    struct stat there;
    fst_status status = FST_OK;
    if (stat(path, &there) != 0 || (S_ISREG(there.st_mode) && there.st_size == 0))
        status = make(path, identity, error);
    if (status != FST_OK)
        return status;
    fst_journal *made = calloc(1, sizeof *made);
    if (!made || !(made->path = strdup(path))) {
        free(made);
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    }
    made->grid = identity->grid;
    status = fst_database_open(path, 1, &made->database, error);
    if (status == FST_OK)
        status = compare_identity(made, identity, error);
    if (status == FST_OK)
        status = prepare(made, error);
    if (status != FST_OK) {
        release(made);
        return status;
    }
    *journal = made;
    return FST_OK;
}

/* ------------------------------------------------------------------ rows */

struct sqlite3 *fst_journal_database(const fst_journal *journal)
{
    return journal->database;
}

const char *fst_journal_path(const fst_journal *journal)
{
    return journal->path;
}

fst_status fst_journal_begin(fst_journal *journal, fst_error *error)
{
    if (journal->in_transaction)
        return FST_OK;
    const fst_status status = fst_database_do(journal->database, journal->path, "BEGIN IMMEDIATE", error);
    journal->in_transaction = status == FST_OK;
    return status;
}

fst_status fst_journal_add(fst_journal *journal, const fst_sweep_record *record, fst_error *error)
{
    const fst_status begun = fst_journal_begin(journal, error);
    if (begun != FST_OK)
        return begun;
    fst_sweep_bind(journal->insert, journal->grid, record);
    const int code = sqlite3_step(journal->insert);
    const fst_status status =
        code == SQLITE_DONE ? FST_OK : fst_database_fail(journal->database, journal->path, error);
    (void)sqlite3_reset(journal->insert);
    return status;
}

fst_status fst_journal_commit(fst_journal *journal, fst_error *error)
{
    if (!journal->in_transaction)
        return FST_OK;
    const fst_status status = fst_database_do(journal->database, journal->path, "COMMIT", error);
    journal->in_transaction = status != FST_OK && !sqlite3_get_autocommit(journal->database);
    return status;
}

fst_status fst_journal_count(fst_journal *journal, int64_t *rows, fst_error *error)
{
    sqlite3_stmt *query = NULL;
    fst_status status = FST_OK;
    if (sqlite3_prepare_v2(journal->database, "SELECT count(*) FROM rows", -1, &query, NULL) == SQLITE_OK &&
        sqlite3_step(query) == SQLITE_ROW)
        *rows = sqlite3_column_int64(query, 0);
    else
        status = fst_database_fail(journal->database, journal->path, error);
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
        while (*next < there && *next < end && *found < room)
            points[(*found)++] = (*next)++;
        if (*next == there && *next < end) {
            ++*next;
            code = sqlite3_step(journal->next);
        }
    }
    const fst_status status = code == SQLITE_ROW || code == SQLITE_DONE
                                  ? FST_OK
                                  : fst_database_fail(journal->database, journal->path, error);
    (void)sqlite3_reset(journal->next);
    return status;
}

fst_status fst_journal_end_state(fst_journal *journal, int64_t point, int *there, int *usable,
                                 double state[FST_STATE_SIZE], fst_error *error)
{
    (void)sqlite3_bind_int64(journal->state, 1, point);
    const int code = sqlite3_step(journal->state);
    *there = code == SQLITE_ROW;
    *usable = 0;
    if (*there) {
        *usable = sqlite3_column_int(journal->state, 0);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            state[i] = sqlite3_column_double(journal->state, 1 + i);
    }
    const fst_status status = code == SQLITE_ROW || code == SQLITE_DONE
                                  ? FST_OK
                                  : fst_database_fail(journal->database, journal->path, error);
    (void)sqlite3_reset(journal->state);
    return status;
}

fst_status fst_journal_close(fst_journal *journal, fst_error *error)
{
    if (!journal)
        return FST_OK;
    fst_status status = fst_journal_commit(journal, error);
    /* Where the checkpoint fails (a full disk), the rows are safe in the log beside the file. */
    if (status == FST_OK)
        (void)sqlite3_wal_checkpoint_v2(journal->database, NULL, SQLITE_CHECKPOINT_TRUNCATE, NULL, NULL);
    release(journal);
    return status;
}
