/* regular_file.c - reading input files: whole or in pieces. */
#include "host/regular_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

/* Whether opening failed because of the name that the user gave, and not because of the machine. */
static int is_users(int reason)
{
    return reason == ENOENT || reason == EACCES || reason == EPERM || reason == ENOTDIR || reason == ELOOP ||
           reason == ENAMETOOLONG || reason == EISDIR || reason == ENXIO || reason == ENODEV ||
           reason == EINVAL;
}

fst_status fst_open_regular(const char *path, int *descriptor, fst_error *error)
{
    struct stat there;
    do
        *descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    while (*descriptor < 0 && errno == EINTR);
    if (*descriptor < 0)
        return fst_fail(error, is_users(errno) ? FST_BAD_INPUT : FST_IO, path, "cannot read this file: %s",
                        strerror(errno));
    fst_status status = FST_BAD_INPUT;
    const char *problem = NULL;
    if (fstat(*descriptor, &there) != 0) {
        problem = strerror(errno);
        status = FST_IO;
    } else if (S_ISDIR(there.st_mode)) {
        problem = "this is a directory, not a file";
    } else if (!S_ISREG(there.st_mode)) {
        problem = "this is a device or a pipe; a regular file is needed";
    }
    if (!problem)
        return FST_OK;
    (void)close(*descriptor);
    return fst_fail(error, status, path, "%s", problem);
}

/* ---------------------------------------------------------------- as one text */

/* read(2), repeated where a signal interrupts it. */
static ssize_t read_on(int descriptor, char *bytes, size_t size)
{
    ssize_t got;
    do
        got = read(descriptor, bytes, size);
    while (got < 0 && errno == EINTR);
    return got;
}

ssize_t fst_read_at(int descriptor, void *bytes, size_t size, off_t place)
{
    size_t have = 0;
    for (ssize_t got = 1; got != 0 && have < size;) {
        got = pread(descriptor, (char *)bytes + have, size - have, place + (off_t)have);
        if (got < 0 && errno != EINTR)
            return -1;
        have += got > 0 ? (size_t)got : 0;
    }
    return (ssize_t)have;
}

/* Read everything, or just enough to see that there is more than `most`.  Returns 0, or an errno. */
static int read_all(int descriptor, size_t most, char **text, size_t *size)
{
    size_t room = 1 << 16;
    *size = 0;
    *text = malloc(room + 1);
    while (*text && *size <= most) {
        const ssize_t got = read_on(descriptor, *text + *size, room - *size);
        if (got < 0)
            return errno;
        if (got == 0)
            return 0;
        *size += (size_t)got;
        if (*size < room)
            continue;
        room *= 2;
        char *longer = realloc(*text, room + 1);
        if (!longer)
            return ENOMEM;
        *text = longer;
    }
    return *text ? 0 : ENOMEM;
}

fst_status fst_read_regular(const char *path, size_t most, char **text, size_t *size, fst_error *error)
{
    int descriptor;
    *text = NULL;
    fst_status status = fst_open_regular(path, &descriptor, error);
    if (status != FST_OK)
        return status;
    const int reason = read_all(descriptor, most, text, size);
    (void)close(descriptor);
    if (reason == ENOMEM)
        status = fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    else if (reason)
        status = fst_fail(error, FST_IO, path, "reading this file failed: %s", strerror(reason));
    else if (*size > most)
        status = fst_fail(error, FST_BAD_INPUT, path, "this file is larger than %zu bytes", most);
    else
        (*text)[*size] = '\0';
    if (status != FST_OK) {
        free(*text);
        *text = NULL;
    }
    return status;
}
