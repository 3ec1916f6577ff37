/* regular_file.h - opening and reading input files. */
#ifndef FST_HOST_REGULAR_FILE_H
#define FST_HOST_REGULAR_FILE_H

#include <stdio.h>
#include <sys/types.h>

#include <festoon/festoon.h>

/* Open a regular file for reading, and nothing that could block or have effects: a directory, a pipe or a
 * device is FST_BAD_INPUT, and so is a missing file.  FST_IO: the disk or the system failed, which says nothing
 * of the file. */
fst_status fst_open_regular(const char *path, int *descriptor, fst_error *error);

/* Read a regular file of at most `most` bytes into a new text with a zero behind it.  FST_BAD_INPUT: as above,
 * or it is larger; FST_IO: it could not be read. */
fst_status fst_read_regular(const char *path, size_t most, char **text, size_t *size, fst_error *error);

/* Read from a place of a file until `size` bytes are there or it ends, again where a signal interrupted it: the
 * number of bytes, or -1 and errno. */
ssize_t fst_read_at(int descriptor, void *bytes, size_t size, off_t place);

/* A stream on a descriptor, which stays the caller's, that goes on where a signal interrupted a read.  Where a
 * read fails, *reason becomes its errno, else it stays 0; NULL: no memory. */
FILE *fst_regular_stream(int descriptor, int *reason);

#endif
