/* hdf5_session.h - files of HDF5 in memory: one that is read, and one that is written; without a word from
 * HDF5.
 *
 * HDF5 cannot stand a disk that fails: it keeps data back until a file is closed, and where writing fails then,
 * it leaves the file open and crashes over it at the end of the program.  So it never sees a disk.  A file that
 * is read is loaded as a whole first; one that is written grows in memory (HDF5's own driver, H5FD_CORE), and
 * its bytes are handed over at the end.
 */
#ifndef FST_IO_HDF5_SESSION_H
#define FST_IO_HDF5_SESSION_H

#include <festoon/festoon.h>
#include <hdf5.h>
#include <stdio.h>

#include "io/hdf5_module.h"

/* HDF5 prints its errors unless told not to; the caller's setting is restored.  The first time, HDF5 is also
 * told to do nothing at the end of the program: we close what we open, and HDF5 would print and crash there
 * over objects that it failed to close in a damaged file. */
typedef struct fst_hdf5_told {
    H5E_auto2_t function;
    void *data;
} fst_hdf5_told;
fst_hdf5_told fst_hdf5_quiet(void);
void fst_hdf5_as_before(fst_hdf5_told before);

/* Close a type and a space of data, as far as they could be opened. */
void fst_hdf5_close(hid_t type, hid_t space);

size_t fst_hdf5_most(void);

typedef struct fst_hdf5_session {
    hid_t file;  /* negative: HDF5 cannot open it */
    int starved; /* because it got no memory */
    fst_hdf5_told told;
} fst_hdf5_session;

/* Whether HDF5 says of its last failure that it got no memory. */
int fst_hdf5_is_starved(void);

/* Open the bytes of a file, and close them. */
void fst_hdf5_session_begin(const char *bytes, size_t size, fst_hdf5_session *session);
void fst_hdf5_session_end(fst_hdf5_session *session);

/* The bytes of a file that was made in memory, once it is closed. */
typedef struct fst_hdf5_image {
    unsigned char *bytes; /* free() them */
    size_t size;          /* of the memory */
} fst_hdf5_image;

/* A new file, which is put into `image` when it is closed; negative: HDF5 cannot make it. */
hid_t fst_hdf5_new(fst_hdf5_image *image);

/* How many of the bytes are the file; 0: they are not a file. */
size_t fst_hdf5_length(const fst_hdf5_image *image);

/* Samples of a field: see hdf5_map.c. */
fst_status fst_hdf5_read_map(const char *path, const char *bytes, size_t size, fst_hdf5_map *map,
                             fst_error *error);

#endif
