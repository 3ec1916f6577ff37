/* regular_file.h - opening input files. */
#ifndef FST_IO_REGULAR_FILE_H
#define FST_IO_REGULAR_FILE_H

#include <festoon/festoon.h>

/* Open a regular file for reading, and nothing that could block or have effects: a directory, a pipe or a
 * device is FST_BAD_INPUT, and so is a missing file. */
fst_status fst_open_regular(const char *path, int *descriptor, fst_error *error);

#endif
