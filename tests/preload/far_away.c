/* far_away.c - preloaded into the program by tests: every file seems to lie on a network file system (NFS). */
#include <string.h>
#include <sys/vfs.h>

__attribute__((visibility("default"))) int statfs(const char *path, struct statfs *found)
{
    (void)path;
    memset(found, 0, sizeof *found);
    found->f_type = 0x6969;
    return 0;
}
