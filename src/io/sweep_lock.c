#define _GNU_SOURCE /* F_OFD_SETLK */
#include "io/sweep_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"

/* The greatest database of SQLite ends at 2^48 bytes. */
static const off_t LOCK_PLACE = (off_t)1 << 48;
static const off_t PROCESS_PLACES = ((off_t)1 << 48) + ((off_t)1 << 32); /* plus the number of the process */
static const off_t HOST_PLACES = ((off_t)1 << 48) + ((off_t)1 << 33); /* letter i: plus i * STRIDE + letter */
enum { HOST_LETTERS = 64, HOST_STRIDE = 512 };                        /* adjacent locks would merge */

static struct flock range(off_t start, off_t length)
{
    struct flock lock;
    memset(&lock, 0, sizeof lock);
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_start = start;
    lock.l_len = length;
    return lock;
}

static int lock_byte(int descriptor, off_t place)
{
    struct flock lock = range(place, 1);
    return fcntl(descriptor, F_OFD_SETLK, &lock);
}

fst_lock_state fst_lock_take(int descriptor)
{
    if (lock_byte(descriptor, LOCK_PLACE) != 0)
        return errno == EAGAIN || errno == EACCES ? FST_LOCK_TAKEN : FST_LOCK_IMPOSSIBLE;
    char host[HOST_LETTERS + 1] = "";
    (void)gethostname(host, sizeof host - 1);
    (void)lock_byte(descriptor, PROCESS_PLACES + getpid());
    for (int i = 0; host[i]; ++i)
        (void)lock_byte(descriptor, HOST_PLACES + (off_t)i * HOST_STRIDE + (unsigned char)host[i]);
    return FST_LOCK_MINE;
}

/* The first locked byte of a range, counted from its start; -1 if none. */
static off_t find_locked(int descriptor, off_t start, off_t length)
{
    struct flock lock = range(start, length);
    if (fcntl(descriptor, F_OFD_GETLK, &lock) != 0 || lock.l_type == F_UNLCK)
        return -1;
    return lock.l_start - start;
}

fst_lock_state fst_lock_look(int descriptor)
{
    return find_locked(descriptor, LOCK_PLACE, 1) < 0 ? FST_LOCK_FREE : FST_LOCK_TAKEN;
}

void fst_lock_owner(int descriptor, char owner[FST_LOCK_OWNER_SIZE])
{
    char host[HOST_LETTERS + 1] = "";
    for (int i = 0; i < HOST_LETTERS; ++i) {
        const off_t letter = find_locked(descriptor, HOST_PLACES + (off_t)i * HOST_STRIDE, 256);
        host[i] = letter > ' ' && letter < 127 ? (char)letter : '\0';
        if (!host[i])
            break;
    }
    const off_t process = find_locked(descriptor, PROCESS_PLACES, (off_t)1 << 31);
    if (process > 0)
        (void)snprintf(owner, FST_LOCK_OWNER_SIZE, "process %ld on %s", (long)process,
                       host[0] ? host : "another computer");
    else
        (void)snprintf(owner, FST_LOCK_OWNER_SIZE, "another command");
}

fst_status fst_lock_fail(int descriptor, const char *path, fst_error *error)
{
    char owner[FST_LOCK_OWNER_SIZE];
    fst_lock_owner(descriptor, owner);
    return fst_fail(error, FST_IO, path,
                    "%s is at work on this sweep; nothing was changed: wait for it, end it, or choose another "
                    "file",
                    owner);
}
