/* whole_file.h - output files that appear whole or not at all.
 *
 * A file is written under a temporary name beside its place, synced, and renamed. whole_file.c explains the
 * steps, and how the leftovers of killed commands are removed.
 */
#ifndef FST_HOST_WHOLE_FILE_H
#define FST_HOST_WHOLE_FILE_H

#include <stdio.h>

#include <festoon/festoon.h>

/* A file being written: its place, and the temporary file beside it that takes the place at the end. */
typedef struct fst_whole_file {
    char *path;      /* where the file will be; a symbolic link is followed */
    char *temporary; /* the temporary file, in the same directory */
    FILE *stream;    /* open for writing on `temporary`; close it before another library writes there */
    struct fst_whole_file_hold *hold; /* the lock, and the reason of the first failed write */
} fst_whole_file;

/* Make the temporary file.  FST_BAD_INPUT where `path` is a directory, a device, a database or the like; FST_IO where
 * nothing can be written there.  The stream cannot be positioned: it only appends. */
fst_status fst_whole_file_open(fst_whole_file *file, const char *path, fst_error *error);

/* The same without looking for leftovers: where many files go into one directory, fst_whole_file_tidy() removes
 * the leftovers once, by how their names begin (".NAME"). */
fst_status fst_whole_file_open_next(fst_whole_file *file, const char *path, fst_error *error);
void fst_whole_file_tidy(const char *directory, const char *prefix);

/* Sync the directory of `path`, so that a new, changed or removed name in it survives a loss of power.  Returns
 * 0, or the errno of a failure.  It is not a failure that the directory may not be read or that its file system
 * cannot sync directories: nothing better can be done there. */
int fst_sync_directory_of(const char *path);

/* The descriptor of the temporary file, for other ways to write than the stream; do not close it. */
int fst_whole_file_descriptor(const fst_whole_file *file);

/* Write out and sync, and stay open.  Where several files belong together, call this for all of them before the
 * first is committed. */
fst_status fst_whole_file_sync(const fst_whole_file *file, fst_error *error);

/* Write out, sync, and rename to the final place.  On failure the temporary file is removed and what was in its
 * place stays; only where the directory itself cannot be synced the new file is there already.  `file` is
 * finished in either case. */
fst_status fst_whole_file_commit(fst_whole_file *file, fst_error *error);

/* Give up: remove the temporary file. */
void fst_whole_file_discard(fst_whole_file *file);

#endif
