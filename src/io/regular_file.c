#include "io/regular_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

fst_status fst_open_regular(const char *path, int *descriptor, fst_error *error)
{
    struct stat there;
    *descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (*descriptor < 0)
        return fst_fail(error, FST_BAD_INPUT, path, "cannot read this file: %s", strerror(errno));
    const char *problem = NULL;
    if (fstat(*descriptor, &there) != 0)
        problem = strerror(errno);
    else if (S_ISDIR(there.st_mode))
        problem = "this is a directory, not a file";
    else if (!S_ISREG(there.st_mode))
        problem = "this is a device or a pipe; a regular file is needed";
    if (!problem)
        return FST_OK;
    (void)close(*descriptor);
    return fst_fail(error, FST_BAD_INPUT, path, "%s", problem);
}
