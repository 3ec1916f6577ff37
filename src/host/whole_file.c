/* whole_file.c - output files that appear whole or not at all.
 *
 * A reader of NAME sees the old file or the new one, never a part, whenever the writer is killed or the power
 * fails:
 *
 *  1. open      .NAME.HOST-PROCESS-NUMBER.part   a new file in the same directory, locked by the kernel
 *  2. write     into it; the first failure is noted, and nothing is written after it
 *  3. sync      fsync(): its bytes are on the disk ...
 *  4. rename    ... before it takes the name NAME
 *  5. sync      the directory, so that the new name is on the disk too
 *
 * Where a step fails, the temporary file is removed and NAME stays as it was.  A killed writer leaves its
 * temporary file behind, but the kernel ends its lock.  The next command that writes NAME therefore removes
 * each temporary file that it can lock, and leaves alone what another living writer holds and what another host
 * made.
 *
 * The stream that the caller writes into is one of fopencookie(): so a write that a signal interrupts goes on,
 * and the errno of the first failure is kept for the message.
 */
/* fopencookie() and realpath() are extensions of the C library. */
#define _GNU_SOURCE
#include "host/whole_file.h"

#include <festoon/festoon_tools.h>

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "host/file_lock.h"

enum {
    DECORATION = 64, /* room in a temporary name for what is added to the directory and the file's own name */
    LONGEST_NAME =
        200, /* a file name has 255 bytes at most: a long one is cut to leave room for what is added */
    BUFFER = 1 << 16
};

#define ENDING ".part"

struct fst_whole_file_hold {
    int descriptor; /* of the temporary file, which is locked */
    int reason;     /* errno of the first write that failed; 0: none did */
    char buffer[BUFFER];
};

static void forget(fst_whole_file *file)
{
    if (file->stream)
        (void)fclose(file->stream);
    if (file->hold && file->hold->descriptor >= 0)
        (void)close(file->hold->descriptor);
    free(file->hold);
    free(file->path);
    free(file->temporary);
    *file = (fst_whole_file){NULL, NULL, NULL, NULL};
}

/* The length of the directory part of a path, with the last slash. */
static size_t directory_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* ---------------------------------------------------------------- names and leftovers */

/* A hash of this host's name (FNV-1a).  Temporary names contain it, because on a network file system the locks
 * of other hosts may be invisible: their files are left alone. */
static unsigned host_number(void)
{
    char name[256] = "";
    unsigned number = 2166136261U;
    (void)gethostname(name, sizeof name - 1);
    for (const char *c = name; *c; ++c)
        number = (number ^ (unsigned char)*c) * 16777619U;
    return number;
}

/* Where in `entry` the mark "HOST-PROCESS-NUMBER.part" of a temporary file of this host begins; 0: there is no
 * such mark. */
static size_t mark_of(const char *entry)
{
    char host[16];
    const size_t length = strlen(entry);
    if (length <= strlen(ENDING) || strcmp(entry + length - strlen(ENDING), ENDING) != 0)
        return 0;
    const size_t end = length - strlen(ENDING);
    size_t mark = end;
    while (mark > 0 && entry[mark - 1] != '.')
        --mark;
    (void)snprintf(host, sizeof host, "%08x-", host_number());
    const size_t skipped = mark + strlen(host);
    const int ours = mark > 0 && skipped < end && strncmp(entry + mark, host, strlen(host)) == 0;
    return ours && strspn(entry + skipped, "0123456789-") == end - skipped ? mark : 0;
}

/* Remove a temporary file whose writer has ended.  Taking its lock first shows that, and keeps others from
 * taking the file meanwhile. */
static void remove_if_abandoned(int directory, const char *entry)
{
    struct stat there;
    const int descriptor = openat(directory, entry, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
        return;
    if (fstat(descriptor, &there) == 0 && S_ISREG(there.st_mode) &&
        fst_lock_byte(descriptor, FST_LOCK_WRITING, 0) == 0)
        (void)unlinkat(directory, entry, 0);
    (void)close(descriptor);
}

/* Remove the temporary files whose writers have ended and whose names begin with `prefix`.  With `whole` the
 * mark must follow the prefix at once. */
static void remove_leftovers(const char *place, const char *prefix, int whole)
{
    DIR *directory = opendir(place);
    if (!directory)
        return;
    for (const struct dirent *entry = readdir(directory); entry; entry = readdir(directory)) {
        const size_t mark = strncmp(entry->d_name, prefix, strlen(prefix)) == 0 ? mark_of(entry->d_name) : 0;
        if (mark > 0 && (!whole || mark == strlen(prefix)))
            remove_if_abandoned(dirfd(directory), entry->d_name);
    }
    (void)closedir(directory);
}

void fst_whole_file_tidy(const char *directory, const char *prefix)
{
    remove_leftovers(directory, prefix, 0);
}

/* The directory of `path`; free() it. */
static char *directory_of(const char *path)
{
    const size_t length = directory_length(path);
    return length ? strndup(path, length) : strdup(".");
}

enum { PREFIX_SIZE = LONGEST_NAME + 3 };

/* How the names of temporary files of `path` begin: ".NAME.". */
static void begin_name(const char *path, char prefix[PREFIX_SIZE])
{
    (void)snprintf(prefix, PREFIX_SIZE, ".%.*s.", LONGEST_NAME, path + directory_length(path));
}

static void tidy_beside(const char *path)
{
    char prefix[PREFIX_SIZE], *place = directory_of(path);
    begin_name(path, prefix);
    if (place)
        remove_leftovers(place, prefix, 1);
    free(place);
}

/* Make and lock a new file at file->temporary; -1: errno tells why.  Between the two steps another command may
 * have taken the file for a leftover and removed it.  Then it has no name any more, and the caller tries the
 * next name. */
static int create_locked(const fst_whole_file *file)
{
    struct stat here;
    const int descriptor = open(file->temporary, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0)
        return -1;
    /* On a file system without locks this fails.  There no other command can lock it either, so nobody takes it
     * for a leftover. */
    (void)fst_lock_byte(descriptor, FST_LOCK_WRITING, 1);
    if (fstat(descriptor, &here) == 0 && here.st_nlink > 0)
        return descriptor;
    (void)close(descriptor);
    errno = EEXIST;
    return -1;
}

/* A new file ".NAME.HOST-PROCESS-NUMBER.part" in the directory of file->path. */
static int create_temporary(fst_whole_file *file, int tidy)
{
    const size_t start = directory_length(file->path), size = strlen(file->path) + DECORATION;
    char prefix[PREFIX_SIZE];
    begin_name(file->path, prefix);
    if (tidy)
        tidy_beside(file->path);
    file->temporary = malloc(size);
    if (!file->temporary) {
        errno = ENOMEM;
        return -1;
    }
    int descriptor = -1;
    for (int attempt = 0; attempt < 100 && descriptor < 0; ++attempt) {
        (void)snprintf(file->temporary, size, "%.*s%s%08x-%ld-%d" ENDING, (int)start, file->path, prefix,
                       host_number(), (long)getpid(), attempt);
        descriptor = create_locked(file);
        if (descriptor < 0 && errno != EEXIST)
            break;
    }
    return descriptor;
}

/* ---------------------------------------------------------------- the stream */

/* Write everything, or as much as there is room for.  A signal may interrupt a write, and a full disk takes a
 * part of one. */
static ssize_t write_on(void *cookie, const char *bytes, size_t size)
{
    struct fst_whole_file_hold *hold = cookie;
    size_t written = 0;
    while (written < size && hold->reason == 0) {
        const ssize_t got = write(hold->descriptor, bytes + written, size - written);
        if (got > 0)
            written += (size_t)got;
        else if (got == 0 || errno != EINTR)
            hold->reason = got == 0 ? ENOSPC : errno;
    }
    if (written < size)
        errno = hold->reason;
    return (ssize_t)written;
}

static FILE *open_stream(struct fst_whole_file_hold *hold)
{
    FILE *stream = fopencookie(hold, "w", (cookie_io_functions_t){.write = write_on});
    if (stream)
        (void)setvbuf(stream, hold->buffer, _IOFBF, BUFFER);
    return stream;
}

static fst_status fail_open(fst_whole_file *file, const char *path, int reason, fst_error *error)
{
    if (file->hold && file->hold->descriptor >= 0)
        (void)unlink(file->temporary);
    forget(file);
    if (reason == ENOMEM)
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    return fst_fail(error, FST_IO, path, "cannot write here: %s", strerror(reason));
}

/* Whether a file is a database of SQLite, such as a sweep's, which nobody means to replace by something else. */
static int is_database(const char *path)
{
    char head[16] = "";
    FILE *file = fopen(path, "rb");
    const size_t size = file ? fread(head, 1, sizeof head, file) : 0;
    if (file)
        (void)fclose(file);
    return size == sizeof head && memcmp(head, "SQLite format 3", sizeof head) == 0;
}

static fst_status open_file(fst_whole_file *file, const char *path, int tidy, fst_error *error)
{
    *file = (fst_whole_file){NULL, NULL, NULL, NULL};
    if (path[0] == '\0')
        return fst_fail(error, FST_BAD_INPUT, "output", "the name of the output file is empty");
    struct stat there, link;
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode))
        return fst_fail(error, FST_BAD_INPUT, path, "this is %s: give the name of a file to write",
                        S_ISDIR(there.st_mode) ? "a directory" : "no regular file");
    if (is_database(path))
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "this is a database, as of a sweep, and would be lost: choose another name, or remove it");
    if (lstat(path, &link) == 0 && S_ISLNK(link.st_mode))
        file->path = realpath(path, NULL);
    if (!file->path)
        file->path = strdup(path);
    file->hold = calloc(1, sizeof *file->hold);
    if (file->hold)
        file->hold->descriptor = -1;
    if (!file->path || !file->hold)
        return fail_open(file, path, ENOMEM, error);
    file->hold->descriptor = create_temporary(file, tidy);
    if (file->hold->descriptor >= 0)
        file->stream = open_stream(file->hold);
    return file->stream ? FST_OK : fail_open(file, path, errno, error);
}

fst_status fst_whole_file_open(fst_whole_file *file, const char *path, fst_error *error)
{
    return open_file(file, path, 1, error);
}

fst_status fst_whole_file_open_next(fst_whole_file *file, const char *path, fst_error *error)
{
    return open_file(file, path, 0, error);
}

int fst_whole_file_descriptor(const fst_whole_file *file)
{
    return file->hold->descriptor;
}

/* ---------------------------------------------------------------- to the disk */

/* 0, or errno. */
static int sync_descriptor(int descriptor)
{
    int failed;
    do
        failed = fsync(descriptor) != 0 ? errno : 0;
    while (failed == EINTR);
    return failed;
}

int fst_sync_directory_of(const char *path)
{
    char *place = directory_of(path);
    const int descriptor = place ? open(place, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    free(place);
    if (descriptor < 0)
        return 0;
    const int reason = sync_descriptor(descriptor);
    (void)close(descriptor);
    return reason == EINVAL || reason == ENOSYS || reason == EOPNOTSUPP || reason == EBADF ? 0 : reason;
}

/* Whether the temporary name still leads to the file that was written: a program that removes old files may
 * have removed it. */
static int is_ours(const fst_whole_file *file)
{
    struct stat held, named;
    return fstat(file->hold->descriptor, &held) == 0 && lstat(file->temporary, &named) == 0 &&
           held.st_dev == named.st_dev && held.st_ino == named.st_ino;
}

/* Remove the temporary file, if it is still the one of that name: once it has been renamed, another thread may
 * be writing a new one. */
static void remove_ours(const fst_whole_file *file)
{
    if (is_ours(file))
        (void)unlink(file->temporary);
}

/* 0, or errno. */
static int flush_and_sync(const fst_whole_file *file)
{
    const int failed = file->stream && (fflush(file->stream) != 0 || ferror(file->stream));
    if (file->hold->reason || failed)
        return file->hold->reason ? file->hold->reason : EIO;
    return sync_descriptor(file->hold->descriptor);
}

static fst_status fail_write(const fst_whole_file *file, int reason, fst_error *error)
{
    return fst_fail(error, FST_IO, file->path, "writing this file failed: %s", strerror(reason));
}

fst_status fst_whole_file_sync(const fst_whole_file *file, fst_error *error)
{
    const int reason = flush_and_sync(file);
    return reason ? fail_write(file, reason, error) : FST_OK;
}

fst_status fst_whole_file_commit(fst_whole_file *file, fst_error *error)
{
    fst_status status = FST_OK;
    int reason = flush_and_sync(file);
    if (reason == 0 && !is_ours(file))
        status = fst_fail(error, FST_IO, file->path,
                          "the temporary file %s, or its directory, was removed while it was written",
                          file->temporary);
    else if (reason == 0 && rename(file->temporary, file->path) != 0)
        reason = errno;
    if (reason != 0)
        status = fail_write(file, reason, error);
    if (status != FST_OK) {
        remove_ours(file);
    } else if ((reason = fst_sync_directory_of(file->path)) != 0) {
        status = fst_fail(
            error, FST_IO, file->path,
            "this file is complete, but a loss of power may undo it: its directory cannot be synced: %s",
            strerror(reason));
    }
    forget(file);
    return status;
}

void fst_whole_file_discard(fst_whole_file *file)
{
    if (file->temporary)
        remove_ours(file);
    forget(file);
}

fst_status fst_file_write(const char *path, const char *text, size_t size, fst_error *error)
{
    fst_whole_file file;
    const fst_status status = fst_whole_file_open(&file, path, error);
    if (status != FST_OK)
        return status;
    if (text) {
        (void)fwrite(text, 1, size, file.stream); /* a failure is noted, and told by the next line */
        return fst_whole_file_commit(&file, error);
    }
    fst_whole_file_discard(&file);
    return FST_OK;
}
