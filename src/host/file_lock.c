/* file_lock.c - locks of the kernel on single bytes, by F_OFD_SETLK. */
#define _GNU_SOURCE /* F_OFD_SETLK */
#include "host/file_lock.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

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

/* Whether a descriptor of this process, given as text, holds the lock of a byte.  /proc is asked and not the
 * descriptor, which another thread may close at any moment.  A line there:
 *
 *     lock:	1: OFDLCK ADVISORY  WRITE -1 fe:00:1234 281474976710656 281474976710656
 */
static int descriptor_holds(const char *number, off_t place)
{
    char path[64], line[256];
    int holds = 0;
    (void)snprintf(path, sizeof path, "/proc/self/fdinfo/%.20s", number);
    FILE *in = fopen(path, "re");
    while (in && !holds && fgets(line, sizeof line, in)) {
        long long first = -1;
        holds = strncmp(line, "lock:", 5) == 0 && strstr(line, " OFDLCK ") &&
                sscanf(line, "lock: %*s %*s %*s %*s %*s %*s %lld", &first) == 1 && first == FIRST_PLACE + place;
    }
    if (in)
        (void)fclose(in);
    return holds;
}

int fst_holds_lock(const struct stat *file, off_t place)
{
    char link[64];
    struct stat found;
    int holds = 0;
    DIR *descriptors = opendir("/proc/self/fd");
    for (const struct dirent *entry = descriptors ? readdir(descriptors) : NULL; entry && !holds;
         entry = readdir(descriptors)) {
        (void)snprintf(link, sizeof link, "/proc/self/fd/%.20s", entry->d_name);
        holds = stat(link, &found) == 0 && found.st_dev == file->st_dev && found.st_ino == file->st_ino &&
                descriptor_holds(entry->d_name, place);
    }
    if (descriptors)
        (void)closedir(descriptors);
    return holds;
}
