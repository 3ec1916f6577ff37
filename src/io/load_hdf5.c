/* load_hdf5.c - finding the module for HDF5, for trajectories and for maps of a field. */
#include "io/load_hdf5.h"

#include <string.h>

#include "base/error.h"
#include "host/module.h"

fst_status fst_load_hdf5_module(const fst_hdf5_module_table **module, const char *path, fst_error *error)
{
    int found;
    *module = fst_module_table(FST_HDF5_MODULE, FST_HDF5_MODULE_SYMBOL, &found);
    fst_status status = FST_OK;
    if (!*module)
        status =
            fst_fail(error, FST_UNAVAILABLE, path,
                     "this festoon has no HDF5 (%s): install libhdf5-dev and build festoon again, or give the "
                     "file a name that ends in .csv",
                     found ? FST_HDF5_MODULE " is no module of festoon" : FST_HDF5_MODULE " cannot be loaded");
    else if (strcmp((*module)->version, fst_version()) != 0)
        status =
            fst_fail(error, FST_UNAVAILABLE, path, "%s belongs to festoon %s, not to %s: install festoon again",
                     FST_HDF5_MODULE, (*module)->version, fst_version());
    return status;
}
