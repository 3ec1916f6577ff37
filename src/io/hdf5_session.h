/* hdf5_session.h - a file of HDF5 that is read: opened, asked, closed, without a word from HDF5. */
#ifndef FST_IO_HDF5_SESSION_H
#define FST_IO_HDF5_SESSION_H

#include <festoon/festoon.h>

#include "io/hdf5_driver.h"
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

typedef struct fst_hdf5_session {
    fst_hdf5_disk disk;
    hid_t access, file; /* file < 0: HDF5 cannot open it */
    fst_hdf5_told told;
} fst_hdf5_session;

/* Begin and end.  Where begin fails there is nothing to end. */
fst_status fst_hdf5_session_begin(const char *path, fst_hdf5_session *session, fst_error *error);
void fst_hdf5_session_end(fst_hdf5_session *session);

/* Samples of a field: see hdf5_map.c. */
fst_status fst_hdf5_read_map(const char *path, fst_hdf5_map *map, fst_error *error);

#endif
