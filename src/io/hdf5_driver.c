/* hdf5_driver.c - the functions through which HDF5 reads and writes a file, made so that none of them ever
 * fails.
 *
 * HDF5 cannot stand a disk that fails.  It keeps data in memory until the file is closed; if writing fails
 * then, it cannot close the file, leaves it open, and crashes over it when the program ends.  After a failed
 * read it leaves objects open too.  So the driver hides every failure from HDF5 and tells our side:
 *
 *  writing    HDF5 --> write_file() --> disk              until a write fails: note its errno
 *                            `--------> list of blocks    all later writes, a few MiB that HDF5 held back
 *  reading    HDF5 <-- read_file() <--- disk, then blocks over it, the newest last
 *
 * HDF5 reads back what it wrote and closes the file in peace.  Afterwards the noted errno says that the file is
 * worth nothing, and whole_file.c removes it.  A file that is only read is loaded into one block before HDF5
 * sees it, so that no read can fail later.
 */
#include "io/hdf5_driver.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

/* What HDF5 wrote after a failure, kept in memory in the order of writing. */
struct fst_hdf5_block {
    fst_hdf5_block *next;
    haddr_t begin;
    size_t size;
    unsigned char bytes[];
};

/* An open file.  HDF5's own part must come first. */
typedef struct open_file {
    H5FD_t of_hdf5;
    fst_hdf5_disk *disk;
    haddr_t allocated; /* the end of the addresses that HDF5 has given out */
    haddr_t end;       /* the end of what was written */
} open_file;

static void note(fst_hdf5_disk *disk, int reason)
{
    if (disk->reason == 0)
        disk->reason = reason ? reason : EIO;
}

/* ---------------------------------------------------------------- reading and writing */

/* Read what the disk has, which may be less than `size`: the number of bytes, or -1. */
static ssize_t read_disk(const fst_hdf5_disk *disk, haddr_t begin, size_t size, unsigned char *bytes)
{
    size_t done = 0;
    while (done < size) {
        const ssize_t got = pread(disk->descriptor, bytes + done, size - done, (off_t)(begin + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return -1;
        if (got == 0)
            break;
        done += (size_t)got;
    }
    return (ssize_t)done;
}

/* Copy a block over what was read, where the two overlap. */
static void lay_over(const fst_hdf5_block *block, haddr_t begin, size_t size, unsigned char *bytes)
{
    const haddr_t from = block->begin > begin ? block->begin : begin;
    const haddr_t block_end = block->begin + block->size,
                  end = block_end < begin + size ? block_end : begin + size;
    if (from < end)
        memcpy(bytes + (from - begin), block->bytes + (from - block->begin), (size_t)(end - from));
}

static herr_t read_file(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t begin, size_t size, void *bytes)
{
    fst_hdf5_disk *disk = ((open_file *)file)->disk;
    (void)type;
    (void)transfer;
    memset(bytes, 0, size); /* behind the end of the file there are zeros */
    if (disk->descriptor >= 0 && read_disk(disk, begin, size, bytes) < 0)
        note(disk, errno);
    for (const fst_hdf5_block *block = disk->oldest; block; block = block->next)
        lay_over(block, begin, size, bytes);
    return 0;
}

static int keep_block(fst_hdf5_disk *disk, haddr_t begin, size_t size, const void *bytes)
{
    fst_hdf5_block *block = malloc(sizeof *block + size);
    if (!block)
        return -1;
    *block = (fst_hdf5_block){NULL, begin, size};
    memcpy(block->bytes, bytes, size);
    if (disk->newest)
        disk->newest->next = block;
    else
        disk->oldest = block;
    disk->newest = block;
    return 0;
}

static herr_t write_file(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t begin, size_t size,
                         const void *bytes)
{
    open_file *f = (open_file *)file;
    const unsigned char *at = bytes;
    (void)type;
    (void)transfer;
    for (size_t left = size; left > 0 && f->disk->reason == 0;) {
        const ssize_t got = pwrite(f->disk->descriptor, at, left, (off_t)(begin + (size - left)));
        if (got > 0) {
            at += got;
            left -= (size_t)got;
        } else if (got == 0 || errno != EINTR) {
            note(f->disk, got == 0 ? ENOSPC : errno);
        }
    }
    if (begin + size > f->end)
        f->end = begin + size;
    return f->disk->reason ? keep_block(f->disk, begin, size, bytes) : 0;
}

off_t fst_hdf5_most(void)
{
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? (off_t)pages / 2 * page : (off_t)1 << 30;
}

int fst_hdf5_load(fst_hdf5_disk *disk)
{
    struct stat there;
    if (fstat(disk->descriptor, &there) != 0)
        return errno;
    if (there.st_size > fst_hdf5_most())
        return EFBIG;
    fst_hdf5_block *block = malloc(sizeof *block + (size_t)there.st_size);
    if (!block)
        return ENOMEM;
    *block = (fst_hdf5_block){NULL, 0, (size_t)there.st_size};
    disk->oldest = disk->newest = block;
    const ssize_t got = read_disk(disk, 0, block->size, block->bytes);
    if (got < 0)
        return errno;
    block->size = (size_t)got; /* the file may have become shorter meanwhile */
    disk->descriptor = -1;
    return 0;
}

/* Give the file the length that HDF5 has allocated. */
static herr_t set_length(H5FD_t *file, hid_t transfer, hbool_t closing)
{
    open_file *f = (open_file *)file;
    (void)transfer;
    (void)closing;
    while (f->disk->reason == 0 && f->end != f->allocated &&
           ftruncate(f->disk->descriptor, (off_t)f->allocated) != 0)
        if (errno != EINTR)
            note(f->disk, errno);
    f->end = f->allocated;
    return 0;
}

/* ---------------------------------------------------------------- opening */

static H5FD_t *open_disk(const char *name, unsigned flags, hid_t access, haddr_t most)
{
    struct stat there;
    fst_hdf5_disk *const *disk = H5Pget_driver_info(access);
    (void)name;
    (void)flags;
    (void)most;
    if (!disk)
        return NULL;
    if ((*disk)->descriptor < 0)
        there.st_size = (off_t)(*disk)->oldest->size;
    else if (fstat((*disk)->descriptor, &there) != 0)
        return NULL;
    open_file *file = calloc(1, sizeof *file);
    if (!file)
        return NULL;
    file->disk = *disk;
    file->end = (haddr_t)there.st_size;
    return &file->of_hdf5;
}

static herr_t close_disk(H5FD_t *file)
{
    free(file);
    return 0;
}

static herr_t query(const H5FD_t *file, unsigned long *flags)
{
    (void)file;
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
    return 0;
}

static haddr_t get_allocated(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return ((const open_file *)file)->allocated;
}

static herr_t set_allocated(H5FD_t *file, H5FD_mem_t type, haddr_t end)
{
    (void)type;
    ((open_file *)file)->allocated = end;
    return 0;
}

static haddr_t get_end(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return ((const open_file *)file)->end;
}

static const H5FD_class_t driver = {
#ifdef H5FD_CLASS_VERSION
    .version = H5FD_CLASS_VERSION,
    .value = (H5FD_class_value_t)512, /* HDF5 leaves the numbers from 512 on to drivers that are not registered
                                         with it */
#endif
    .name = "festoon",
    .maxaddr = (haddr_t)INT64_MAX,
    .fc_degree = H5F_CLOSE_WEAK,
    .fapl_size = sizeof(fst_hdf5_disk *),
    .open = open_disk,
    .close = close_disk,
    .query = query,
    .get_eoa = get_allocated,
    .set_eoa = set_allocated,
    .get_eof = get_end,
    .read = read_file,
    .write = write_file,
    .truncate = set_length,
    .fl_map = H5FD_FLMAP_DICHOTOMY,
};

hid_t fst_hdf5_access(fst_hdf5_disk *disk)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS), id = H5FDregister(&driver);
    const int failed = access < 0 || id < 0 || H5Pset_driver(access, id, &disk) < 0;
    disk->driver = id;
    if (failed && access >= 0)
        (void)H5Pclose(access);
    return failed ? -1 : access;
}

void fst_hdf5_forget(fst_hdf5_disk *disk)
{
    if (disk->driver > 0)
        (void)H5FDunregister(disk->driver);
    disk->driver = 0;
    while (disk->oldest) {
        fst_hdf5_block *next = disk->oldest->next;
        free(disk->oldest);
        disk->oldest = next;
    }
    disk->newest = NULL;
}
