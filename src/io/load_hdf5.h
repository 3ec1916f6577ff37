/* load_hdf5.h - finding the module for HDF5. */
#ifndef FST_IO_LOAD_HDF5_H
#define FST_IO_LOAD_HDF5_H

#include "io/hdf5_module.h"

/* Load the module, which is found along the RUNPATH of this library and stays loaded.  FST_UNAVAILABLE: this
 * build has none; `path` is the file that needs it, for the message. */
fst_status fst_load_hdf5_module(const fst_hdf5_module_table **module, const char *path, fst_error *error);

/* Load the module, and a file as a whole: so no read can fail while HDF5 works, which could not stand that. The
 * caller frees the bytes. */
fst_status fst_load_hdf5_file(const fst_hdf5_module_table **module, const char *path, char **bytes,
                              size_t *size, fst_error *error);

/* Whether a file begins as every HDF5 file that HDF5 itself made. */
fst_status fst_look_for_hdf5(const char *path, int *is_hdf5, fst_error *error);

#endif
