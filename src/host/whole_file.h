/* whole_file.h - output files that appear whole or not at all.
 *
 * A file is written under another name beside its place, synced, and renamed.  A command that is killed leaves
 * that other file, ".NAME.HOST-PROCESS-NUMBER.part".  As long as its writer lives, the kernel holds a lock on
 * it, which dies with the writer; the next command that writes NAME removes each such file of this host that
 * nobody has locked, and never one that is being written.
 */
#ifndef FST_HOST_WHOLE_FILE_H
#define FST_HOST_WHOLE_FILE_H

#include <stdio.h>

#include <festoon/festoon.h>

/* A file being written: its place, and the temporary file beside it that takes the place when done. */
typedef struct fst_whole_file {
    char *path;      /* where it will be; a symbolic link is followed */
    char *temporary; /* a new file in the same directory */
    FILE *stream;    /* open for writing on `temporary`; a writer by other means closes it first */
    struct fst_whole_file_hold *hold; /* keeps the lock, and the reason of the first failed write */
} fst_whole_file;

/* Make the temporary file.  FST_BAD_INPUT where `path` is a directory, a device or the like; FST_IO where
 * nothing can be written there.  The stream has no position: it only goes on. */
fst_status fst_whole_file_open(fst_whole_file *file, const char *path, fst_error *error);

/* The same without looking for leftovers, where many files go into one directory: tidy that once.  The second
 * one removes the leftovers whose names begin with `prefix` (".NAME"). */
fst_status fst_whole_file_open_next(fst_whole_file *file, const char *path, fst_error *error);
void fst_whole_file_tidy(const char *directory, const char *prefix);

/* Make safe a change of names in the directory of `path`; 0, or the errno of a failure.  Directories that may
 * not be read, and file systems that cannot sync one, leave nothing better to be had, and are no failure. */
int fst_sync_directory_of(const char *path);

/* Remove the leftovers of `path` without writing it. */
void fst_whole_file_tidy_beside(const char *path);

/* The temporary file's descriptor, for writers other than the stream; it stays the file's. */
int fst_whole_file_descriptor(const fst_whole_file *file);

/* Write out and sync, and stay open: where several files belong together, all of them are on the disk before
 * the first one takes its place. */
fst_status fst_whole_file_sync(const fst_whole_file *file, fst_error *error);

/* Write out, sync, and rename to the final place.  On failure the temporary file is removed, and what was in
 * its place stays; only where the directory itself cannot be synced the new file is there already.  `file` is
 * finished either way. */
fst_status fst_whole_file_commit(fst_whole_file *file, fst_error *error);

/* Give up: remove the temporary file. */
void fst_whole_file_discard(fst_whole_file *file);

#endif
