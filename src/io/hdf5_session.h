/* hdf5_session.h - a file of HDF5 that is read: opened, asked, closed, without a word from HDF5. */
#ifndef FST_IO_HDF5_SESSION_H
#define FST_IO_HDF5_SESSION_H

#include <festoon/festoon.h>

#include "io/hdf5_driver.h"
#include "io/hdf5_module.h"

typedef struct fst_hdf5_session {
    fst_hdf5_disk disk;
    hid_t access, file; /* file < 0: HDF5 cannot open it */
    H5E_auto2_t told;   /* how HDF5 told of its errors before */
    void *told_data;
} fst_hdf5_session;

/* Begin and end.  Where begin fails there is nothing to end. */
fst_status fst_hdf5_session_begin(const char *path, fst_hdf5_session *session, fst_error *error);
void fst_hdf5_session_end(fst_hdf5_session *session);

/* Samples of a field: see hdf5_map.c. */
fst_status fst_hdf5_read_map(const char *path, fst_hdf5_map *map, fst_error *error);

#endif
