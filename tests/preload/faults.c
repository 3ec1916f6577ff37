/* faults.c - preloaded into the program by tests: disks, and memory, that fail at a chosen moment.
 *
 *   FESTOON_FAULT=PROGRAM:CALL:ERROR:AT   in the process PROGRAM the AT-th CALL fails with the number ERROR
 *   FESTOON_FAULT_UNDER=DIR               only calls on regular files in this directory count
 *   FESTOON_FAULT_FIRED=FILE              made when the fault has happened; for "count" the numbers of calls go there
 *
 * CALL: write (write and pwrite), read (read and pread), fsync, rename, close, open (of new files), truncate,
 * memory (malloc, calloc, realloc and the aligned ones, wherever they are called, but not by pixman and
 * fontconfig), once; "room": AT bytes can be written, then every write fails, as on a full disk; "short": every
 * write takes at most AT bytes; "interrupted": every second write, read and fsync fails with EINTR; "vanish":
 * before the AT-th write or fsync the directory is renamed to DIR.gone; "kill": the process kills itself there;
 * "count": nothing fails.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define PUBLIC __attribute__((visibility("default")))

enum { WRITE, READ, FSYNC, RENAME, CLOSE, OPEN, TRUNCATE, MEMORY, CALLS };
static const char *const names[CALLS] = {"write", "read", "fsync",    "rename",
                                         "close", "open", "truncate", "memory"};

static atomic_long calls[CALLS], written, moments, odd;
static char wanted[32], under[4000];
static int error_number, active;
static long at;

/* The next definition of a function; POSIX lets dlsym() return it as a pointer to data. */
#define NEXT(result, function, name, ...)                                                                      \
    result (*function)(__VA_ARGS__);                                                                           \
    *(void **)&function = dlsym(RTLD_NEXT, name)

static void tell(const char *text)
{
    NEXT(int, next_open, "open", const char *, int, ...);
    NEXT(ssize_t, next_write, "write", int, const void *, size_t);
    NEXT(int, next_close, "close", int);
    const char *path = getenv("FESTOON_FAULT_FIRED");
    const int file = path ? next_open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666) : -1;
    if (file < 0)
        return;
    (void)!next_write(file, text, strlen(text));
    (void)next_close(file);
}

__attribute__((constructor)) static void begin(void)
{
    char program[64] = "";
    const char *text = getenv("FESTOON_FAULT"), *place = getenv("FESTOON_FAULT_UNDER");
    if (!text || !place || sscanf(text, "%63[^:]:%31[^:]:%d:%ld", program, wanted, &error_number, &at) != 4)
        return;
    (void)snprintf(under, sizeof under, "%s/", place);
    active = strcmp(program, program_invocation_short_name) == 0;
}

__attribute__((destructor)) static void end(void)
{
    char line[256] = "";
    if (!active || strcmp(wanted, "count") != 0)
        return;
    for (int i = 0; i < CALLS; ++i)
        (void)snprintf(line + strlen(line), sizeof line - strlen(line), "%s=%ld ", names[i],
                       atomic_load(&calls[i]));
    (void)snprintf(line + strlen(line), sizeof line - strlen(line), "bytes=%ld\n", atomic_load(&written));
    tell(line);
}

static int is_wanted(const char *call)
{
    return strcmp(wanted, call) == 0;
}

static int lies_there(const char *path)
{
    return strncmp(path, under, strlen(under)) == 0;
}

static int is_there(int descriptor)
{
    struct stat found;
    char link[64], path[4096];
    if (!active || fstat(descriptor, &found) != 0 || !S_ISREG(found.st_mode))
        return 0;
    (void)snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0)
        return 0;
    path[length] = '\0';
    return lies_there(path);
}

/* A directory that goes away, or a process that dies, before a write or a sync. */
static void moment(void)
{
    char place[4000], gone[4096];
    if ((!is_wanted("vanish") && !is_wanted("kill")) || atomic_fetch_add(&moments, 1) + 1 != at)
        return;
    tell("fired\n");
    if (is_wanted("kill"))
        (void)raise(SIGKILL);
    NEXT(int, next, "rename", const char *, const char *);
    (void)snprintf(place, sizeof place, "%.*s", (int)strlen(under) - 1, under);
    (void)snprintf(gone, sizeof gone, "%s.gone", place);
    (void)next(place, gone);
}

/* Counts a call; 1 if it is the one to fail, with errno set. */
static int fails(int call)
{
    const long number = atomic_fetch_add(&calls[call], 1) + 1;
    if (call == WRITE || call == FSYNC)
        moment();
    if (is_wanted("interrupted") && (call == WRITE || call == READ || call == FSYNC) &&
        atomic_fetch_add(&odd, 1) % 2 == 0) {
        errno = EINTR;
        return 1;
    }
    if (!is_wanted(names[call]) || number != at)
        return 0;
    tell("fired\n");
    errno = error_number;
    return 1;
}

/* How many of `size` bytes a write may take; -1 for none, with errno set. */
static ssize_t room_for(size_t size)
{
    if (fails(WRITE))
        return -1;
    if (is_wanted("short"))
        return (ssize_t)size < at ? (ssize_t)size : at;
    const long before = atomic_fetch_add(&written, (long)size);
    if (!is_wanted("room") || before + (long)size <= at)
        return (ssize_t)size;
    tell("fired\n");
    if (before < at)
        return at - before;
    errno = error_number;
    return -1;
}

PUBLIC ssize_t write(int file, const void *bytes, size_t size)
{
    NEXT(ssize_t, next, "write", int, const void *, size_t);
    const ssize_t taken = is_there(file) ? room_for(size) : (ssize_t)size;
    return taken < 0 ? -1 : next(file, bytes, (size_t)taken);
}

PUBLIC ssize_t pwrite(int file, const void *bytes, size_t size, off_t place)
{
    NEXT(ssize_t, next, "pwrite", int, const void *, size_t, off_t);
    const ssize_t taken = is_there(file) ? room_for(size) : (ssize_t)size;
    return taken < 0 ? -1 : next(file, bytes, (size_t)taken, place);
}

PUBLIC ssize_t pwrite64(int file, const void *bytes, size_t size, off64_t place)
{
    return pwrite(file, bytes, size, (off_t)place);
}

PUBLIC ssize_t read(int file, void *bytes, size_t size)
{
    NEXT(ssize_t, next, "read", int, void *, size_t);
    return is_there(file) && fails(READ) ? -1 : next(file, bytes, size);
}

PUBLIC ssize_t pread(int file, void *bytes, size_t size, off_t place)
{
    NEXT(ssize_t, next, "pread", int, void *, size_t, off_t);
    return is_there(file) && fails(READ) ? -1 : next(file, bytes, size, place);
}

PUBLIC ssize_t pread64(int file, void *bytes, size_t size, off64_t place)
{
    return pread(file, bytes, size, (off_t)place);
}

PUBLIC int fsync(int file)
{
    NEXT(int, next, "fsync", int);
    struct stat found;
    const int directory = active && fstat(file, &found) == 0 && S_ISDIR(found.st_mode);
    return (directory || is_there(file)) && fails(FSYNC) ? -1 : next(file);
}

PUBLIC int fdatasync(int file)
{
    NEXT(int, next, "fdatasync", int);
    return is_there(file) && fails(FSYNC) ? -1 : next(file);
}

PUBLIC int ftruncate(int file, off_t size)
{
    NEXT(int, next, "ftruncate", int, off_t);
    return is_there(file) && fails(TRUNCATE) ? -1 : next(file, size);
}

PUBLIC int ftruncate64(int file, off64_t size)
{
    return ftruncate(file, (off_t)size);
}

/* Linux closes the descriptor whatever close() answers. */
PUBLIC int close(int file)
{
    NEXT(int, next, "close", int);
    const int failed = is_there(file) && fails(CLOSE), reason = errno, closed = next(file);
    if (failed)
        errno = reason;
    return failed ? -1 : closed;
}

PUBLIC int rename(const char *from, const char *to)
{
    NEXT(int, next, "rename", const char *, const char *);
    return active && lies_there(to) && fails(RENAME) ? -1 : next(from, to);
}

PUBLIC int open(const char *path, int flags, ...)
{
    NEXT(int, next, "open", const char *, int, ...);
    va_list more;
    va_start(more, flags);
    const unsigned mode = flags & O_CREAT ? va_arg(more, unsigned) : 0;
    va_end(more);
    return active && flags & O_CREAT && lies_there(path) && fails(OPEN) ? -1 : next(path, flags, mode);
}

PUBLIC int open64(const char *path, int flags, ...)
{
    va_list more;
    va_start(more, flags);
    const unsigned mode = flags & O_CREAT ? va_arg(more, unsigned) : 0;
    va_end(more);
    return open(path, flags | O_LARGEFILE, mode);
}

/* ---------------------------------------------------------------- memory */

/* glibc's own names of what is replaced here: dlsym() could not tell them without memory. */
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);

/* Whether a library works that says to nobody that it got no memory: pixman leaves out letters, and fontconfig a file
 * of its settings, so that another font is taken (docs/inside/reliability.md).  Nobody above them can mend that. */
static int is_silent_library(void)
{
    enum { DEEPEST = 100 };
    void *callers[DEEPEST];
    const int count = backtrace(callers, DEEPEST);
    for (int i = 0; i < count; ++i) {
        Dl_info found;
        if (dladdr(callers[i], &found) != 0 &&
            (strstr(found.dli_fname, "libpixman") || strstr(found.dli_fname, "libfontconfig")))
            return 1;
    }
    return 0;
}

static int starves(void)
{
    if (!active)
        return 0;
    const long number = atomic_fetch_add(&calls[MEMORY], 1) + 1;
    if (!is_wanted("memory") || number != at || is_silent_library())
        return 0;
    tell("fired\n");
    errno = ENOMEM;
    return 1;
}

PUBLIC void *malloc(size_t size)
{
    return starves() ? NULL : __libc_malloc(size);
}

PUBLIC void *calloc(size_t count, size_t size)
{
    return starves() ? NULL : __libc_calloc(count, size);
}

PUBLIC void *realloc(void *old, size_t size)
{
    return starves() ? NULL : __libc_realloc(old, size);
}

PUBLIC void *memalign(size_t alignment, size_t size)
{
    return starves() ? NULL : __libc_memalign(alignment, size);
}

PUBLIC void *aligned_alloc(size_t alignment, size_t size)
{
    return memalign(alignment, size);
}

PUBLIC int posix_memalign(void **memory, size_t alignment, size_t size)
{
    const int before = errno;
    void *made = memalign(alignment, size);
    if (made)
        *memory = made;
    errno = before;
    return made ? 0 : ENOMEM;
}

/* For a test that is itself the program: count the allocations anew, and let the AT-th fail; 0: none.  Returns how
 * many there were. */
PUBLIC long faults_arm(long number)
{
    const long before = atomic_exchange(&calls[MEMORY], 0);
    at = number;
    return before;
}
