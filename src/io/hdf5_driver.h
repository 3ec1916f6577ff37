/* hdf5_driver.h - how HDF5 reaches the disk: by a driver that never tells HDF5 of a failure.
 *
 * hdf5_driver.c explains why and how.  A file that is only read is loaded as a whole, which takes less memory
 * than the numbers that come out of it.
 */
#ifndef FST_IO_HDF5_DRIVER_H
#define FST_IO_HDF5_DRIVER_H

#include <hdf5.h>
#include <stddef.h>
#include <sys/types.h>

typedef struct fst_hdf5_block fst_hdf5_block;

typedef struct fst_hdf5_disk {
    int descriptor; /* the file's descriptor, which stays the caller's; -1: the file is in the list */
    int reason;     /* errno of the first failure; 0: none */
    hid_t driver;   /* registered until fst_hdf5_forget(), because H5Fclose() still reads it after it has closed
                       the file */
    fst_hdf5_block *oldest, *newest;
} fst_hdf5_disk;

/* The greatest size in bytes of a file that is loaded: half of this computer's memory, because the numbers that
 * come out of it need at least as much again. */
off_t fst_hdf5_most(void);

/* Load a file that is only read.  Returns 0, or an errno: EFBIG where the file is larger than that.  The
 * descriptor is not used again. */
int fst_hdf5_load(fst_hdf5_disk *disk);

/* HDF5's access properties for `disk`, which must outlive the file; negative: HDF5 has no memory. */
hid_t fst_hdf5_access(fst_hdf5_disk *disk);

/* Free the list of blocks and unregister the driver, once the file is closed. */
void fst_hdf5_forget(fst_hdf5_disk *disk);

#endif
