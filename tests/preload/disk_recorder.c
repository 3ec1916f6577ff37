/* disk_recorder.c - preloaded into the program by tests: what it asks of the file system below one folder is
 * written down, in order, so that a test can build the states in which a loss of power may leave the disk.
 *
 * $DISK_FOLDER is the folder (its real path), $DISK_LOG the file to write to.  Each entry is a line, for W with
 * bytes behind it:
 *
 *     C inode path            a new, empty file            U path            unlinked
 *     W inode offset size     written                      R from, to        renamed (two lines)
 *     T inode size            truncated                    L from, to        linked (two lines)
 *     S inode                 synced                       D path            a folder was synced
 *
 * Maps of memory (SQLite's -shm) are not recorded: they are made anew by the first to open a database.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define VISIBLE __attribute__((visibility("default")))
/* The C library's function of this name. */
#define NEXT(name) ((__typeof__(&name))next(#name))

static pthread_mutex_t order = PTHREAD_MUTEX_INITIALIZER;

static void *next(const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    if (!found)
        abort();
    return found;
}

static int is_watched(const char *path)
{
    const char *folder = getenv("DISK_FOLDER");
    const size_t length = folder ? strlen(folder) : 0;
    return length > 0 && strncmp(path, folder, length) == 0 && (path[length] == '/' || path[length] == '\0');
}

static int is_watched_file(int descriptor, char path[4096])
{
    char link[40];
    (void)snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, 4095);
    path[length > 0 ? length : 0] = '\0';
    return is_watched(path);
}

static unsigned long inode_of(int descriptor)
{
    struct stat there;
    return fstat(descriptor, &there) == 0 ? (unsigned long)there.st_ino : 0;
}

static void put(const char *entry, const void *bytes, size_t size)
{
    static int log = -1;
    if (log < 0)
        log = NEXT(open)(getenv("DISK_LOG"), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (NEXT(write)(log, entry, strlen(entry)) < 0 || (size > 0 && NEXT(write)(log, bytes, size) < 0))
        abort();
}

/* Calls are made and recorded one at a time: begin(), the call, and its end by record() or finish(). */
static void begin(void)
{
    (void)pthread_mutex_lock(&order);
}

static int finish(int answer)
{
    const int reason = errno;
    (void)pthread_mutex_unlock(&order);
    errno = reason;
    return answer;
}

/* Ends a call that answered `failed`: adds an entry if it succeeded and its path is watched. */
__attribute__((format(printf, 3, 4))) static int record(int failed, const char *watched, const char *format,
                                                        ...)
{
    const int reason = errno;
    char entry[9000];
    va_list values;
    if (failed == 0 && is_watched(watched)) {
        va_start(values, format);
        (void)vsnprintf(entry, sizeof entry, format, values);
        va_end(values);
        put(entry, NULL, 0);
    }
    errno = reason;
    return finish(failed);
}

static int open_recorded(const char *path, int flags, mode_t mode)
{
    if (!(flags & O_CREAT) || !is_watched(path))
        return NEXT(open)(path, flags, mode);
    begin();
    const int is_new = access(path, F_OK) != 0;
    const int descriptor = NEXT(open)(path, flags, mode);
    if (descriptor < 0 || !is_new)
        return finish(descriptor);
    (void)record(0, path, "C %lu %s\n", inode_of(descriptor), path);
    return descriptor;
}

static mode_t mode_of(int flags, va_list more)
{
    return flags & O_CREAT ? va_arg(more, mode_t) : 0;
}

VISIBLE int open(const char *path, int flags, ...)
{
    va_list more;
    va_start(more, flags);
    const mode_t mode = mode_of(flags, more);
    va_end(more);
    return open_recorded(path, flags, mode);
}

VISIBLE int open64(const char *path, int flags, ...)
{
    va_list more;
    va_start(more, flags);
    const mode_t mode = mode_of(flags, more);
    va_end(more);
    return open_recorded(path, flags, mode);
}

static ssize_t pwrite_recorded(int descriptor, const void *bytes, size_t size, off_t place)
{
    char path[4096], entry[100];
    if (!is_watched_file(descriptor, path))
        return NEXT(pwrite)(descriptor, bytes, size, place);
    begin();
    const ssize_t done = NEXT(pwrite)(descriptor, bytes, size, place);
    if (done > 0) {
        (void)snprintf(entry, sizeof entry, "W %lu %lld %zd\n", inode_of(descriptor), (long long)place, done);
        put(entry, bytes, (size_t)done);
    }
    (void)finish(0);
    return done;
}

VISIBLE ssize_t pwrite(int descriptor, const void *bytes, size_t size, off_t place)
{
    return pwrite_recorded(descriptor, bytes, size, place);
}

VISIBLE ssize_t pwrite64(int descriptor, const void *bytes, size_t size, off_t place)
{
    return pwrite_recorded(descriptor, bytes, size, place);
}

/* Streams call write(2) inside the C library, which a preloaded function cannot see; no watched file is a
 * stream. */
VISIBLE ssize_t write(int descriptor, const void *bytes, size_t size)
{
    char path[4096];
    if (is_watched_file(descriptor, path))
        abort();
    return NEXT(write)(descriptor, bytes, size);
}

static int truncate_recorded(int descriptor, off_t size)
{
    char path[4096];
    (void)is_watched_file(descriptor, path);
    begin();
    return record(NEXT(ftruncate)(descriptor, size), path, "T %lu %lld\n", inode_of(descriptor),
                  (long long)size);
}

VISIBLE int ftruncate(int descriptor, off_t size)
{
    return truncate_recorded(descriptor, size);
}

VISIBLE int ftruncate64(int descriptor, off_t size)
{
    return truncate_recorded(descriptor, size);
}

static int sync_recorded(int descriptor, int (*sync)(int))
{
    char path[4096];
    struct stat there = {.st_mode = 0};
    (void)is_watched_file(descriptor, path);
    begin();
    const int failed = sync(descriptor);
    if (!failed && fstat(descriptor, &there) == 0 && S_ISDIR(there.st_mode))
        return record(failed, path, "D %s\n", path);
    return record(failed, path, "S %lu\n", (unsigned long)there.st_ino);
}

VISIBLE int fsync(int descriptor)
{
    return sync_recorded(descriptor, NEXT(fsync));
}

VISIBLE int fdatasync(int descriptor)
{
    return sync_recorded(descriptor, NEXT(fdatasync));
}

VISIBLE int unlink(const char *path)
{
    begin();
    return record(NEXT(unlink)(path), path, "U %s\n", path);
}

VISIBLE int rename(const char *from, const char *to)
{
    begin();
    return record(NEXT(rename)(from, to), to, "R %s\n%s\n", from, to);
}

VISIBLE int renameat2(int from_folder, const char *from, int to_folder, const char *to, unsigned int flags)
{
    begin();
    return record(NEXT(renameat2)(from_folder, from, to_folder, to, flags), to, "R %s\n%s\n", from, to);
}

VISIBLE int link(const char *from, const char *to)
{
    begin();
    return record(NEXT(link)(from, to), to, "L %s\n%s\n", from, to);
}
