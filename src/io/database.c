#include "io/database.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "io/file_system.h"
#include "io/regular_file.h"

fst_status fst_database_fail(sqlite3 *database, const char *path, fst_error *error)
{
    const int code = database ? sqlite3_errcode(database) : SQLITE_NOMEM;
    const char *detail = database ? sqlite3_errmsg(database) : "out of memory";
    switch (code & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this sweep database is damaged (%s); nothing was changed: keep it, restore a copy, or choose "
            "another file. What is readable, sqlite3's .recover saves",
            detail);
    case SQLITE_FULL:
        return fst_fail(
            error, FST_IO, path,
            "the disk is full; every row committed so far is safe: make room and give the same command "
            "again");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
        return fst_fail(
            error, FST_IO, path,
            "no permission to write this database or beside it (%s); every row committed so far is safe",
            detail);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        return fst_fail(error, FST_IO, path,
                        "another program is writing this database: wait for it, or end it");
    case SQLITE_NOMEM:
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    default:
        return fst_fail(error, FST_IO, path, "the database failed: %s; every row committed so far is safe",
                        detail);
    }
}

fst_status fst_database_is_sweep(const char *path, fst_error *error)
{
    unsigned char head[100];
    int descriptor;
    const fst_status status = fst_open_regular(path, &descriptor, error);
    if (status != FST_OK)
        return status;
    size_t have = 0;
    for (ssize_t got = 1; got > 0 && have<sizeof head; have += got> 0 ? (size_t)got : 0)
        got = read(descriptor, head + have, sizeof head - have);
    (void)close(descriptor);
    const uint32_t id = have < sizeof head ? 0
                                           : (uint32_t)head[68] << 24 | (uint32_t)head[69] << 16 |
                                                 (uint32_t)head[70] << 8 | head[71];
    if (have < sizeof head || memcmp(head, "SQLite format 3", 16) != 0 || id != FST_SWEEP_APPLICATION_ID)
        return fst_fail(error, FST_BAD_INPUT, path,
                        "this is no database of festoon sweep; it was left untouched: choose another name");
    return FST_OK;
}

static fst_status open_checked(const char *path, int flags, sqlite3 **database, fst_error *error)
{
    if (sqlite3_open_v2(path, database, flags, NULL) != SQLITE_OK)
        return fst_database_fail(*database, path, error);
    (void)sqlite3_extended_result_codes(*database, 1);
    (void)sqlite3_busy_timeout(*database, 5000);
    /* Without memory that processes share, a log can be read by one alone. */
    if (fst_on_network(path))
        (void)sqlite3_exec(*database, "PRAGMA locking_mode = EXCLUSIVE", NULL, NULL, NULL);
    sqlite3_stmt *check = NULL;
    int sound = 0, code = sqlite3_prepare_v2(*database, "PRAGMA quick_check(1)", -1, &check, NULL);
    if (code == SQLITE_OK && sqlite3_step(check) == SQLITE_ROW)
        sound = strcmp((const char *)sqlite3_column_text(check, 0), "ok") == 0 ? 1 : -1;
    char finding[200] = "";
    if (sound < 0)
        (void)snprintf(finding, sizeof finding, "%.199s", (const char *)sqlite3_column_text(check, 0));
    (void)sqlite3_finalize(check);
    if (sound < 0)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this sweep database is damaged (%s); nothing was changed: keep it, restore a copy, or choose "
            "another file. What is readable, sqlite3's .recover saves",
            finding);
    return sound ? FST_OK : fst_database_fail(*database, path, error);
}

fst_status fst_database_open(const char *path, int writable, sqlite3 **database, fst_error *error)
{
    *database = NULL;
    fst_status status = fst_database_is_sweep(path, error);
    if (status != FST_OK)
        return status;
    /* Readers too ask for writing, so that the log beside the file is tidied up; SQLite does with less. */
    status = open_checked(path, SQLITE_OPEN_READWRITE, database, error);
    if (status == FST_IO && !writable) {
        /* In a directory where nothing may be written, a database in WAL mode opens only as one that never
         * changes. */
        (void)sqlite3_close(*database);
        char *address = sqlite3_mprintf("file:%s?immutable=1", path);
        status = address ? open_checked(address, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, database, error)
                         : fst_fail(error, FST_NO_MEMORY, path, "out of memory");
        sqlite3_free(address);
    }
    if (status != FST_OK) {
        (void)sqlite3_close(*database);
        *database = NULL;
    }
    return status;
}

fst_status fst_database_do(sqlite3 *database, const char *path, const char *statements, fst_error *error)
{
    return sqlite3_exec(database, statements, NULL, NULL, NULL) == SQLITE_OK
               ? FST_OK
               : fst_database_fail(database, path, error);
}

char *fst_database_text(sqlite3 *database, const char *key)
{
    sqlite3_stmt *query = NULL;
    char *text = NULL;
    if (sqlite3_prepare_v2(database, "SELECT value FROM festoon WHERE key = ?", -1, &query, NULL) ==
            SQLITE_OK &&
        sqlite3_bind_text(query, 1, key, -1, SQLITE_STATIC) == SQLITE_OK && sqlite3_step(query) == SQLITE_ROW &&
        sqlite3_column_text(query, 0))
        text = strdup((const char *)sqlite3_column_text(query, 0));
    (void)sqlite3_finalize(query);
    return text;
}
