/* database.c - connecting to a sweep's database with SQLite, without trust in what the file contains; SQLite's
 * errors as festoon's. */
/* realpath() is an X/Open function. */
#define _XOPEN_SOURCE 700
#include "sweep/database.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "host/file_system.h"
#include "host/regular_file.h"

/* A file cannot be opened, or not for writing: the system's error number says which of many reasons it is. */
static fst_status fail_open(sqlite3 *database, const char *path, const char *detail, fst_error *error)
{
    const int reason = database ? sqlite3_system_errno(database) : 0;
    if (reason == EMFILE || reason == ENFILE)
        return fst_fail(
            error, FST_IO, path,
            "too many files are open (%s), and a database needs a few more: raise the limit (ulimit -n), "
            "or close some; every row committed so far is safe",
            strerror(reason));
    if (reason != 0 && reason != EACCES && reason != EPERM && reason != EROFS && reason != ENOENT)
        return fst_fail(
            error, FST_IO, path,
            "this database, or a file beside it, cannot be opened (%s: %s); every row committed so far "
            "is safe",
            detail, strerror(reason));
    return fst_fail(
        error, FST_IO, path,
        "no permission to write this database or beside it (%s); every row committed so far is safe", detail);
}

/* SQLite does not say why a write failed, but a limit of the size of files is known to us. */
static fst_status fail_otherwise(sqlite3 *database, const char *path, const char *detail, fst_error *error)
{
    struct rlimit limit;
    if (sqlite3_extended_errcode(database) == SQLITE_IOERR_WRITE && getrlimit(RLIMIT_FSIZE, &limit) == 0 &&
        limit.rlim_cur != RLIM_INFINITY)
        return fst_fail(
            error, FST_IO, path,
            "the database failed: %s; every row committed so far is safe; files may have %llu bytes at most "
            "here: raise this limit (ulimit -f) and give the same command again",
            detail, (unsigned long long)limit.rlim_cur);
    return fst_fail(error, FST_IO, path, "the database failed: %s; every row committed so far is safe", detail);
}

fst_status fst_database_fail(sqlite3 *database, const char *path, fst_error *error)
{
    const int code = database ? sqlite3_errcode(database) : SQLITE_NOMEM;
    const char *detail = database ? sqlite3_errmsg(database) : "out of memory";
    switch (code & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this sweep database is damaged (%s); nothing was changed: restore a copy, or choose another file",
            detail);
    case SQLITE_FULL:
        return fst_fail(
            error, FST_IO, path,
            "the disk is full; every row committed so far is safe: make room and give the same command "
            "again");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
        return fail_open(database, path, detail, error);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        return fst_fail(error, FST_IO, path,
                        "another program, or another call of this process, is writing this database: wait for "
                        "it, or end it");
    case SQLITE_NOMEM:
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    default:
        return fail_otherwise(database, path, detail, error);
    }
}

int fst_database_is_damage(int code)
{
    return (code & 0xff) == SQLITE_CORRUPT || (code & 0xff) == SQLITE_NOTADB || code == SQLITE_IOERR_SHORT_READ;
}

/* The names of the files that SQLite keeps beside a database are longer than its own: FILE-journal, FILE-wal,
 * FILE-shm.  A new database is filled under a temporary name (make.c), which is longer still. */
static fst_status check_length(const char *path, const char *absolute, int is_new, fst_error *error)
{
    enum {
        LONGEST_PATH = 511, /* SQLite's limit: MAX_PATHNAME of its os_unix.c without the zero behind it */
        LONGER = sizeof "-journal" - 1,
        LONGER_NEW = 64
    };
    const char *name = strrchr(absolute, '/') + 1;
    char *folder = strndup(absolute, (size_t)(name - absolute));
    const long longest = folder ? pathconf(folder, _PC_NAME_MAX) : -1;
    const int needed = is_new ? LONGER_NEW : LONGER;
    free(folder);
    if (longest > 0 && (long)strlen(name) + LONGER > longest)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this name of %zu bytes is too long for a database: names end at %ld bytes in this folder, "
            "and SQLite needs %d of them for its files beside it (NAME-journal): choose one of at most "
            "%ld",
            strlen(name), longest, LONGER, longest - LONGER);
    if (strlen(absolute) + (size_t)needed > LONGEST_PATH)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this path, which has %zu bytes from the root on, is too long for SQLite, whose paths end at "
            "%d bytes and need %d of them for files beside the database: choose a folder with a shorter "
            "path",
            strlen(absolute), LONGEST_PATH, needed);
    return FST_OK;
}

/* Where a file that is to be made will lie: the path of its folder from the root on, and its name. */
static fst_status path_of_new(const char *path, char **absolute, fst_error *error)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    char *folder = slash == path ? strdup("/") : slash ? strndup(path, (size_t)(slash - path)) : strdup(".");
    char *found = folder ? realpath(folder, NULL) : NULL;
    const int reason = errno;
    free(folder);
    if (!found)
        return fst_fail(error, FST_IO, path, "cannot write here: %s", strerror(reason));
    const size_t size = strlen(found) + strlen(name) + 2;
    *absolute = malloc(size);
    if (*absolute)
        (void)snprintf(*absolute, size, "%s/%s", found[1] ? found : "", name);
    free(found);
    struct stat there;
    fst_status status = *absolute ? FST_OK : fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    if (status == FST_OK && !name[0])
        status = fst_fail(error, FST_BAD_INPUT, path, "this is not a name of a file");
    else if (status == FST_OK && lstat(*absolute, &there) == 0 && S_ISLNK(there.st_mode))
        status = fst_fail(error, FST_BAD_INPUT, path, "this symbolic link leads to nothing that can be read");
    return status;
}

fst_status fst_database_path(const char *path, char **absolute, fst_error *error)
{
    *absolute = realpath(path, NULL);
    const int is_new = !*absolute;
    fst_status status = is_new ? path_of_new(path, absolute, error) : FST_OK;
    if (status == FST_OK)
        status = check_length(path, *absolute, is_new, error);
    if (status != FST_OK) {
        free(*absolute);
        *absolute = NULL;
    }
    return status;
}

static uint32_t number_at(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static const char SIGNATURE[16] = "SQLite format 3"; /* with the zero behind it */

static fst_status unreadable(const char *path, fst_error *error)
{
    return fst_fail(error, FST_IO, path, "reading this file failed: %s", strerror(errno));
}

fst_status fst_database_begins(int descriptor, const char *path, int *begins, fst_error *error)
{
    char bytes[sizeof SIGNATURE];
    const ssize_t got = fst_read_at(descriptor, bytes, sizeof bytes, 0);
    *begins = got == (ssize_t)sizeof bytes && memcmp(bytes, SIGNATURE, sizeof bytes) == 0;
    return got < 0 ? unreadable(path, error) : FST_OK;
}

fst_status fst_database_head(int descriptor, const char *path, int writable, char mark[FST_MARK_SIZE],
                             fst_error *error)
{
    enum { USER_VERSION = 60, APPLICATION = 68, HEAD = 100 };
    unsigned char page[4096] = {0};
    const char *advice = writable ? "it was left untouched: choose another name"
                                  : "give the name of a file that fst_sweep() made";
    const ssize_t have = fst_read_at(descriptor, page, sizeof page, 0);
    if (have < 0)
        return unreadable(path, error);
    mark[0] = '\0';
    if (have < HEAD || memcmp(page, SIGNATURE, sizeof SIGNATURE) != 0)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this is not a database of a sweep, or its beginning is damaged: a sweep's file begins with "
            "\"%s\"; %s",
            SIGNATURE, advice);
    if (number_at(page + APPLICATION) != FST_SWEEP_APPLICATION_ID)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this is a database of SQLite, but not that of a sweep: another program made it, or its "
            "beginning is damaged; %s",
            advice);
    const uint32_t format = number_at(page + USER_VERSION);
    if (format == 1)
        return fst_fail(error, FST_BAD_INPUT, path,
                        "this sweep was made by an older festoon, whose rows have no checksums; it was left "
                        "untouched: use that festoon to export it%s",
                        writable ? ", or choose another file" : "");
    if (format != FST_SWEEP_FORMAT)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this sweep database is of format %lu, and this festoon knows format %d: it was made by "
            "a newer festoon, or is damaged; it was left untouched",
            (unsigned long)format, FST_SWEEP_FORMAT);
    (void)fst_mark_find(page, (size_t)have, mark);
    return FST_OK;
}

/* ------------------------------------------------------------------ connecting */

/* SQLite must run nothing that the file contains: no triggers, views, functions of its schema,
 * or extensions. */
static void distrust(sqlite3 *database)
{
    (void)sqlite3_extended_result_codes(database, 1);
    (void)sqlite3_busy_timeout(database, 5000);
    (void)sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    (void)sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
    (void)sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, NULL);
    (void)sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, NULL);
    (void)sqlite3_db_config(database, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, NULL);
    (void)sqlite3_limit(database, SQLITE_LIMIT_LENGTH, 1 << 26);
    (void)sqlite3_wal_autocheckpoint(database, 0);
    (void)sqlite3_exec(database, "PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0", NULL, NULL, NULL);
}

void fst_database_allow_tidying(sqlite3 *database)
{
    (void)sqlite3_db_config(database, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 0, NULL);
}

/* With `exclusive` this connection alone reads the log, so that SQLite needs no memory that processes share. */
static fst_status connect_by(const char *name, int flags, const char *system, int exclusive, const char *path,
                             sqlite3 **database, fst_error *error)
{
    if (sqlite3_open_v2(name, database, flags, system) != SQLITE_OK)
        return fst_database_fail(*database, path, error);
    distrust(*database);
    if (exclusive)
        (void)sqlite3_exec(*database, "PRAGMA locking_mode = EXCLUSIVE", NULL, NULL, NULL);
    return fst_database_do(*database, path, "SELECT count(*) FROM sqlite_master", error);
}

/* A path as an address (URI) in which every byte but "/" is escaped, so that none has a meaning of its own. */
static char *immutable_address(const char *path)
{
    char *address = malloc(3 * strlen(path) + 32);
    if (!address)
        return NULL;
    char *at = address + sprintf(address, "file:");
    for (; *path; ++path)
        at += *path == '/' ? sprintf(at, "/") : sprintf(at, "%%%02x", (unsigned)(unsigned char)*path);
    (void)sprintf(at, "?immutable=1");
    return address;
}

/* Where nothing may be written, SQLite can make neither its locks nor its shared memory.  Then a database with
 * a log is read without locks, and one without a log as a file that never changes. */
static fst_status connect_unwritable(const char *path, sqlite3 **database, fst_error *error)
{
    char log[FST_LOG_NAME_SIZE];
    struct stat there;
    (void)snprintf(log, sizeof log, "%s-wal", path);
    if (stat(log, &there) == 0 && there.st_size > 0)
        return connect_by(path, SQLITE_OPEN_READONLY, "unix-none", 1, path, database, error);
    char *address = immutable_address(path);
    const fst_status status =
        address ? connect_by(address, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, NULL, 0, path, database, error)
                : fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    free(address);
    return status;
}

fst_status fst_database_connect(const char *path, int writable, sqlite3 **database, fst_error *error)
{
    *database = NULL;
    /* Readers ask for writing too, so that SQLite can move the log into the file; where that is not allowed, it
     * opens the file for reading only. */
    fst_status status =
        connect_by(path, SQLITE_OPEN_READWRITE, NULL, fst_on_network(path), path, database, error);
    if (status == FST_IO && !writable) {
        (void)sqlite3_close(*database);
        *database = NULL;
        status = connect_unwritable(path, database, error);
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
