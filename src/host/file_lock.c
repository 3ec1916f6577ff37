/* file_lock.c - locks of the kernel on single bytes, by F_OFD_SETLK. */
#define _GNU_SOURCE /* F_OFD_SETLK */
#include "host/file_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>

static const off_t FIRST_PLACE = (off_t)1 << 48;

static struct flock range(off_t place, off_t count)
{
    struct flock lock;
    memset(&lock, 0, sizeof lock);
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_start = FIRST_PLACE + place;
    lock.l_len = count;
    return lock;
}

int fst_lock_byte(int descriptor, off_t place, int wait)
{
    struct flock lock = range(place, 1);
    int failed;
    do
        failed = fcntl(descriptor, wait ? F_OFD_SETLKW : F_OFD_SETLK, &lock);
    while (failed && errno == EINTR);
    return failed;
}

off_t fst_locked_byte(int descriptor, off_t place, off_t count)
{
    struct flock lock = range(place, count);
    if (fcntl(descriptor, F_OFD_GETLK, &lock) != 0 || lock.l_type == F_UNLCK)
        return -1;
    return lock.l_start - FIRST_PLACE - place;
}
