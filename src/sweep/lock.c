/* lock.c - one sweep at a time on a database, and which process it is, told by the positions of locked bytes.
 *
 *      2^48 + FST_LOCK_SWEEP          the lock itself
 *      2^48 + 2^32 + 512 i + letter   letter i of "process 123 on HOST": only the position of the byte counts
 *
 * A second command that finds the first byte locked asks the kernel where the next locked bytes are, and so
 * reads that text.  Nothing is written to the disk, and the kernel removes it all when the process ends.
 */
#include "sweep/lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "host/file_lock.h"

/* Places are counted as in host/file_lock.h.  Letters lie wide apart, because adjacent locks would merge. */
static const off_t TEXT_PLACE = (off_t)1 << 32;
enum { STRIDE = 512, OWNER_SIZE = 96 };

/* 0, or -1 and errno.  The text is spelled from its end, so that nobody reads a part of it. */
static int take(int descriptor)
{
    char host[65] = "", text[OWNER_SIZE];
    if (fst_lock_byte(descriptor, FST_LOCK_SWEEP, 0) != 0)
        return -1;
    (void)gethostname(host, sizeof host - 1);
    const int length = snprintf(text, sizeof text, "process %ld on %s", (long)getpid(), host);
    for (int i = length - 1; i >= 0; --i)
        (void)fst_lock_byte(descriptor, TEXT_PLACE + (off_t)i * STRIDE + (unsigned char)text[i], 0);
    return 0;
}

int fst_lock_is_taken(int descriptor)
{
    return fst_locked_byte(descriptor, FST_LOCK_SWEEP, 1) >= 0;
}

static void name_owner(int descriptor, char owner[OWNER_SIZE])
{
    int length = 0;
    for (; length + 1 < OWNER_SIZE; ++length) {
        const off_t letter = fst_locked_byte(descriptor, TEXT_PLACE + (off_t)length * STRIDE, 256);
        if (letter < ' ' || letter > '~')
            break;
        owner[length] = (char)letter;
    }
    owner[length] = '\0';
    if (length == 0)
        (void)snprintf(owner, OWNER_SIZE, "another command");
}

/* ------------------------------------------------------------------ a file and its lock */

static fst_status fail_own(const char *name, fst_error *error)
{
    return fst_fail(error, FST_IO, name,
                    "this process is itself at work on this sweep, in another call; nothing was changed: wait "
                    "until that call has ended, or read the file in another process");
}

fst_status fst_lock_check_own(const char *path, const char *name, fst_error *error)
{
    struct stat there;
    return stat(path, &there) == 0 && fst_holds_lock(&there, FST_LOCK_SWEEP) ? fail_own(name, error) : FST_OK;
}

static fst_status fail_taken(int descriptor, const char *name, fst_error *error)
{
    char owner[OWNER_SIZE];
    name_owner(descriptor, owner);
    return fst_fail(error, FST_IO, name,
                    "%s is at work on this sweep; nothing was changed: wait for it, end it, or choose another "
                    "file",
                    owner);
}

static fst_status fail_open(const char *name, int is_new, fst_error *error)
{
    if (is_new)
        return fst_fail(error, FST_IO, name, "cannot write here: %s", strerror(errno));
    if (errno == EISDIR)
        return fst_fail(error, FST_BAD_INPUT, name, "this is a directory, not a file");
    if (errno == EACCES || errno == EPERM || errno == EROFS)
        return fst_fail(error, FST_IO, name, "no permission to write this database (%s)", strerror(errno));
    return fst_fail(error, FST_IO, name, "this database cannot be opened: %s", strerror(errno));
}

int fst_lock_is_there(const char *path, const struct stat *opened)
{
    struct stat there;
    return stat(path, &there) == 0 && there.st_dev == opened->st_dev && there.st_ino == opened->st_ino;
}

/* Take the lock of an open file; *mine is 0 where another command has it, and the file may still be closed. */
static fst_status take_lock(const char *name, int *descriptor, const struct stat *opened, int last, int *mine,
                            fst_error *error)
{
    *mine = take(*descriptor) == 0;
    if (*mine)
        return FST_OK;
    if (errno != EAGAIN && errno != EACCES)
        return fst_fail(error, FST_IO, name,
                        "this file cannot be locked (%s): choose one on another file system", strerror(errno));
    /* Another thread may have locked the file since we looked.  Then ours stays open: closing it would end the
     * locks of that thread. */
    if (fst_holds_lock(opened, FST_LOCK_SWEEP)) {
        *descriptor = -1;
        return fail_own(name, error);
    }
    return last ? fail_taken(*descriptor, name, error) : FST_OK;
}

fst_status fst_lock_open(const char *name, const char *path, int is_new, int last, int *descriptor,
                         fst_error *error)
{
    struct stat opened;
    int mine = 0;
    *descriptor = -1;
    fst_status status = fst_lock_check_own(path, name, error);
    if (status != FST_OK)
        return status;
    const int flags = is_new ? O_CREAT | O_NOFOLLOW : O_NOCTTY;
    int found = open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC | flags, 0666);
    if (found < 0)
        return errno == ENOENT && !is_new ? FST_OK : fail_open(name, is_new, error);
    if (fstat(found, &opened) != 0 || !S_ISREG(opened.st_mode))
        status = fst_fail(error, FST_BAD_INPUT, name, "this is a device or a pipe; a regular file is needed");
    else
        status = take_lock(name, &found, &opened, last, &mine, error);
    if (status == FST_OK && mine && fst_lock_is_there(path, &opened))
        *descriptor = found;
    else if (found >= 0)
        (void)close(found);
    return status;
}
