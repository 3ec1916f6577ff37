/* hdf5_session.c - files of HDF5 that are read, in the module festoon-hdf5.so, and HDF5 kept from printing. */
#include "io/hdf5_session.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"

fst_hdf5_told fst_hdf5_quiet(void)
{
    fst_hdf5_told before = {NULL, NULL};
    (void)H5dont_atexit();
    (void)H5Eget_auto2(H5E_DEFAULT, &before.function, &before.data);
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    return before;
}

void fst_hdf5_as_before(fst_hdf5_told before)
{
    (void)H5Eset_auto2(H5E_DEFAULT, before.function, before.data);
}

void fst_hdf5_close(hid_t type, hid_t space)
{
    if (type >= 0)
        (void)H5Tclose(type);
    if (space >= 0)
        (void)H5Sclose(space);
}

/* The whole file in memory. */
static fst_status load(const char *path, fst_hdf5_disk *disk, fst_error *error)
{
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    *disk = (fst_hdf5_disk){.descriptor = descriptor};
    const int reason = descriptor < 0 ? errno : fst_hdf5_load(disk);
    if (descriptor >= 0)
        (void)close(descriptor);
    if (!reason)
        return FST_OK;
    fst_hdf5_forget(disk);
    if (reason == EFBIG)
        return fst_fail(
            error, FST_NO_MEMORY, path,
            "this HDF5 file is too large: it would be read into memory as a whole, and at most half of "
            "this computer's memory, %.1f GiB, is used for that: use a computer with more memory, or a "
            "run with fewer samples",
            (double)fst_hdf5_most() / (1 << 30));
    if (reason == ENOMEM)
        return fst_fail(error, FST_NO_MEMORY, path, "no memory for this file");
    return fst_fail(error, FST_IO, path, "reading this file failed: %s", strerror(reason));
}

fst_status fst_hdf5_session_begin(const char *path, fst_hdf5_session *session, fst_error *error)
{
    const fst_status status = load(path, &session->disk, error);
    if (status != FST_OK)
        return status;
    session->told = fst_hdf5_quiet();
    session->access = fst_hdf5_access(&session->disk);
    session->file = session->access >= 0 ? H5Fopen(path, H5F_ACC_RDONLY, session->access) : -1;
    return FST_OK;
}

void fst_hdf5_session_end(fst_hdf5_session *session)
{
    if (session->file >= 0)
        (void)H5Fclose(session->file);
    if (session->access >= 0)
        (void)H5Pclose(session->access);
    fst_hdf5_as_before(session->told);
    fst_hdf5_forget(&session->disk);
}
