/* whole_file.h - output files that appear whole or not at all. */
#ifndef FST_BASE_WHOLE_FILE_H
#define FST_BASE_WHOLE_FILE_H

#include <stdio.h>

#include <festoon/festoon.h>

/* A file being written: its place, and the temporary file beside it that takes the place when done. */
typedef struct fst_whole_file {
    char *path;      /* where it will be; a symbolic link is followed */
    char *temporary; /* a new file in the same directory */
    FILE *stream;    /* open for writing on `temporary`; whoever writes by other means closes it at once */
} fst_whole_file;

/* Make the temporary file.  FST_BAD_INPUT where `path` is a directory, a device or the like; FST_IO where
 * nothing can be written there. */
fst_status fst_whole_file_open(fst_whole_file *file, const char *path, fst_error *error);

/* Write out, sync, and rename to the final place.  On failure the temporary file is removed.  `file` is
 * finished either way. */
fst_status fst_whole_file_commit(fst_whole_file *file, fst_error *error);

/* Give up: remove the temporary file. */
void fst_whole_file_discard(fst_whole_file *file);

#endif
