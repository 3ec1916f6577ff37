/* load_hdf5.c - finding the module for HDF5, for trajectories and for maps of a field. */
#include "io/load_hdf5.h"

#include <string.h>
#include <sys/stat.h>

#include "base/error.h"
#include "host/module.h"
#include "host/regular_file.h"

fst_status fst_load_hdf5_module(const fst_hdf5_module_table **module, const char *path, fst_error *error)
{
    int found;
    *module = fst_module_table(FST_HDF5_MODULE, FST_HDF5_MODULE_SYMBOL, &found);
    fst_status status = FST_OK;
    if (!*module)
        status = fst_fail(
            error, FST_UNAVAILABLE, path,
            "this festoon has no HDF5 (%s): install libhdf5-dev and build festoon again, or give the "
            "file a name that ends in .csv",
            found ? FST_HDF5_MODULE " is not a module of festoon" : FST_HDF5_MODULE " cannot be loaded");
    else if (strcmp((*module)->version, fst_version()) != 0)
        status =
            fst_fail(error, FST_UNAVAILABLE, path, "%s belongs to festoon %s, not to %s: install festoon again",
                     FST_HDF5_MODULE, (*module)->version, fst_version());
    return status;
}

fst_status fst_load_hdf5_file(const fst_hdf5_module_table **module, const char *path, char **bytes,
                              size_t *size, fst_error *error)
{
    struct stat there;
    *bytes = NULL;
    const fst_status status = fst_load_hdf5_module(module, path, error);
    if (status != FST_OK)
        return status;
    const size_t most = (*module)->most();
    if (stat(path, &there) == 0 && there.st_size > (off_t)most)
        return fst_fail(
            error, FST_NO_MEMORY, path,
            "this HDF5 file is too large: it would be read into memory as a whole, and at most half of "
            "this computer's memory, %.1f GiB, is used for that: use a computer with more memory, or a "
            "run with fewer samples",
            (double)most / (1 << 30));
    return fst_read_regular(path, most, bytes, size, error);
}
