/* hdf5_driver.h - how HDF5 reaches the disk: by a driver that never tells it of a failure.
 *
 * HDF5 holds data back until a file is closed.  Where writing then fails, it cannot close the file, keeps it
 * open, and crashes over it when the program ends.  This driver notes the first failure and keeps everything
 * that comes after it in memory, where HDF5 can read it again: the file closes in peace, and the note says that
 * it is worth nothing.
 *
 *     HDF5 --> write --> disk                   until a write fails
 *                  \---> list of blocks         from then on (a few MiB: what HDF5 had held back)
 *     HDF5 <-- read  <-- disk, then the list    the newest block wins
 *
 * After a failed read HDF5 leaves objects open as well.  A file that is only read is loaded before HDF5 sees
 * it, which takes less memory than the numbers that come out of it.
 */
#ifndef FST_IO_HDF5_DRIVER_H
#define FST_IO_HDF5_DRIVER_H

#include <hdf5.h>
#include <stddef.h>
#include <sys/types.h>

typedef struct fst_hdf5_block fst_hdf5_block;

typedef struct fst_hdf5_disk {
    int descriptor; /* of the file, which stays the caller's; -1: the file is in the list */
    int reason;     /* errno of the first failure; 0: none */
    hid_t driver;   /* registered until fst_hdf5_forget(): H5Fclose() reads it after it has let it go */
    fst_hdf5_block *oldest, *newest;
} fst_hdf5_disk;

/* The greatest size in bytes of a file that is loaded: half of the memory of this computer, because the numbers
 * that come out of it need at least as much again. */
off_t fst_hdf5_most(void);

/* Load a file that is only read; 0, or an errno: EFBIG where it is larger than that.  The descriptor is not
 * used again. */
int fst_hdf5_load(fst_hdf5_disk *disk);

/* A list of access properties that leads to `disk`, which must outlive the file; negative: HDF5 has no memory.
 */
hid_t fst_hdf5_access(fst_hdf5_disk *disk);

/* Free the list of blocks and let the driver go, once the file is closed. */
void fst_hdf5_forget(fst_hdf5_disk *disk);

#endif
