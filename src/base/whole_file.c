/* realpath() is an X/Open function. */
#define _XOPEN_SOURCE 700
#include "base/whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

/* Room in a temporary name beside the directory and the file's own name. */
#define DECORATION 48

static void forget(fst_whole_file *file)
{
    free(file->path);
    free(file->temporary);
    *file = (fst_whole_file){NULL, NULL, NULL};
}

/* A new file ".NAME.PROCESS-NUMBER.part" in the directory of file->path. */
static int create_temporary(fst_whole_file *file)
{
    const char *slash = strrchr(file->path, '/');
    const char *name = slash ? slash + 1 : file->path;
    size_t size = strlen(file->path) + DECORATION;
    file->temporary = malloc(size);
    if (!file->temporary) {
        errno = ENOMEM;
        return -1;
    }
    int descriptor = -1;
    for (int attempt = 0; attempt < 100 && descriptor < 0; attempt++) {
        /* File names end at 255 bytes; a long one is cut to leave room for the decoration. */
        (void)snprintf(file->temporary, size, "%.*s.%.200s.%ld-%d.part", (int)(name - file->path), file->path,
                       name, (long)getpid(), attempt);
        descriptor = open(file->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno != EEXIST)
            break;
    }
    return descriptor;
}

fst_status fst_whole_file_open(fst_whole_file *file, const char *path, fst_error *error)
{
    *file = (fst_whole_file){NULL, NULL, NULL};
    if (path[0] == '\0')
        return fst_fail(error, FST_BAD_INPUT, "output", "the name of the output file is empty");
    struct stat there;
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode))
        return fst_fail(error, FST_BAD_INPUT, path, "this is %s: give the name of a file to write",
                        S_ISDIR(there.st_mode) ? "a directory" : "no regular file");
    file->path = realpath(path, NULL);
    if (!file->path)
        file->path = strdup(path);
    if (!file->path)
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    int descriptor = create_temporary(file);
    if (descriptor >= 0)
        file->stream = fdopen(descriptor, "w");
    if (!file->stream) {
        fst_fail(error, FST_IO, path, "cannot write here: %s", strerror(errno));
        if (descriptor >= 0) {
            (void)close(descriptor);
            (void)unlink(file->temporary);
        }
        forget(file);
        return FST_IO;
    }
    return FST_OK;
}

/* Make sure that what was written to `path` (a file, or the entries of a directory) is on the disk. */
static int sync_path(const char *path, int flags)
{
    int descriptor = open(path, flags | O_CLOEXEC);
    if (descriptor < 0)
        return -1;
    int failed = fsync(descriptor);
    int reason = errno;
    (void)close(descriptor);
    errno = reason;
    return failed;
}

/* The rename itself is only safe once the directory is synced; some file systems cannot do that, and
 * then nothing better is to be had. */
static void sync_directory_of(char *path)
{
    char *slash = strrchr(path, '/');
    if (!slash) {
        (void)sync_path(".", O_RDONLY | O_DIRECTORY);
        return;
    }
    char after = slash[1];
    slash[1] = '\0';
    (void)sync_path(path, O_RDONLY | O_DIRECTORY);
    slash[1] = after;
}

fst_status fst_whole_file_commit(fst_whole_file *file, fst_error *error)
{
    int failed = 0;
    if (file->stream) {
        failed = ferror(file->stream);
        failed = fclose(file->stream) != 0 || failed;
        file->stream = NULL;
    }
    failed = failed || sync_path(file->temporary, O_RDONLY) != 0 || rename(file->temporary, file->path) != 0;
    if (failed) {
        fst_fail(error, FST_IO, file->path, "writing this file failed: %s", strerror(errno));
        (void)unlink(file->temporary);
    } else {
        sync_directory_of(file->path);
    }
    forget(file);
    return failed ? FST_IO : FST_OK;
}

void fst_whole_file_discard(fst_whole_file *file)
{
    if (file->stream)
        (void)fclose(file->stream);
    if (file->temporary)
        (void)unlink(file->temporary);
    forget(file);
}
