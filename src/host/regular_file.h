/* regular_file.h - opening and reading input files. */
#ifndef FST_HOST_REGULAR_FILE_H
#define FST_HOST_REGULAR_FILE_H

#include <sys/types.h>

#include <festoon/festoon.h>

/* Open a regular file for reading.  FST_BAD_INPUT: the file is missing, or it is a directory, a pipe or a
 * device, which could block or have effects.  FST_IO: the disk or the system failed, so that nothing is known
 * of the file. */
fst_status fst_open_regular(const char *path, int *descriptor, fst_error *error);

/* Read a regular file of at most `most` bytes into a new text, with a zero behind it.  FST_BAD_INPUT: as above,
 * or it is larger; FST_IO: it could not be read. */
fst_status fst_read_regular(const char *path, size_t most, char **text, size_t *size, fst_error *error);

/* Read from a place of a file until `size` bytes are read or the file ends; a signal that interrupts does not
 * end it.  Returns the number of bytes, or -1 and errno. */
ssize_t fst_read_at(int descriptor, void *bytes, size_t size, off_t place);

#endif
