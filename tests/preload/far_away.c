/* far_away.c - preloaded into the program by tests: every file seems to lie on a network file system (NFS).
 * There a lock of a whole file is a lock of all its bytes, and excludes locks of single bytes (flock(2)). */
#define _GNU_SOURCE /* F_OFD_SETLK */
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <sys/vfs.h>

__attribute__((visibility("default"))) int statfs(const char *path, struct statfs *found)
{
    (void)path;
    memset(found, 0, sizeof *found);
    found->f_type = 0x6969;
    return 0;
}

__attribute__((visibility("default"))) int flock(int descriptor, int operation)
{
    struct flock lock;
    memset(&lock, 0, sizeof lock);
    lock.l_type = operation & LOCK_UN ? F_UNLCK : operation & LOCK_SH ? F_RDLCK : F_WRLCK;
    lock.l_whence = SEEK_SET;
    return fcntl(descriptor, operation & LOCK_NB ? F_OFD_SETLK : F_OFD_SETLKW, &lock);
}
