/* hdf5_session.c - files of HDF5 in memory, in the module festoon-hdf5.so, and HDF5 kept from printing. */
#include "io/hdf5_session.h"

#include <stdlib.h>
#include <unistd.h>

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

/* Access to a file that HDF5 keeps in memory and writes to no disk. */
static hid_t access_in_memory(void)
{
    enum { GROWTH = 1 << 20 };
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access < 0 || H5Pset_fapl_core(access, GROWTH, 0) >= 0)
        return access;
    (void)H5Pclose(access);
    return -1;
}

/* HDF5 takes two open files of one name for the same, and refuses a name that is there: so each gets a name of
 * its own, which no file can have. */
enum { NAME_SIZE = 48 };
static const char *name_of(const void *it, char name[NAME_SIZE])
{
    (void)snprintf(name, NAME_SIZE, "/dev/null/%p", it);
    return name;
}

/* ---------------------------------------------------------------- reading */

size_t fst_hdf5_most(void)
{
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? (size_t)pages / 2 * (size_t)page : (size_t)1 << 30;
}

static herr_t look_for_memory(unsigned place, const H5E_error2_t *trouble, void *found)
{
    (void)place;
    *(int *)found |= trouble->min_num == H5E_NOSPACE || trouble->min_num == H5E_CANTALLOC;
    return 0;
}

int fst_hdf5_is_starved(void)
{
    int starved = 0;
    (void)H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look_for_memory, &starved);
    return starved;
}

void fst_hdf5_session_begin(const char *bytes, size_t size, fst_hdf5_session *session)
{
    char name[NAME_SIZE];
    session->told = fst_hdf5_quiet();
    const hid_t access = access_in_memory();
    const int failed = access < 0 || H5Pset_file_image(access, (void *)bytes, size) < 0; /* which copies them */
    session->file = failed ? -1 : H5Fopen(name_of(bytes, name), H5F_ACC_RDONLY, access);
    session->starved = failed || (session->file < 0 && fst_hdf5_is_starved());
    if (access >= 0)
        (void)H5Pclose(access);
}

void fst_hdf5_session_end(fst_hdf5_session *session)
{
    if (session->file >= 0)
        (void)H5Fclose(session->file);
    fst_hdf5_as_before(session->told);
}

/* ---------------------------------------------------------------- writing */

#if H5_VERSION_GE(1, 10, 2)
#define FORMAT H5F_LIBVER_V110
#else
#define FORMAT H5F_LIBVER_LATEST
#endif

/* HDF5 grows its memory by realloc() as it would without these functions; they keep it when the file is closed,
 * because only then are its bytes complete.  (Those of H5Fget_file_image() have another first page than their
 * checksum.) */
static void *grow(void *bytes, size_t size, H5FD_file_image_op_t operation, void *image)
{
    (void)operation;
    void *grown = realloc(bytes, size);
    if (grown)
        ((fst_hdf5_image *)image)->size = size;
    return grown;
}

static herr_t keep(void *bytes, H5FD_file_image_op_t operation, void *image)
{
    (void)operation;
    ((fst_hdf5_image *)image)->bytes = bytes;
    return 0;
}

static void *same(void *image)
{
    return image;
}

static herr_t leave(void *image)
{
    (void)image;
    return 0;
}

hid_t fst_hdf5_new(fst_hdf5_image *image)
{
    H5FD_file_image_callbacks_t functions = {
        .image_realloc = grow, .image_free = keep, .udata_copy = same, .udata_free = leave, .udata = image};
    const hid_t access = access_in_memory(), root = H5Pcreate(H5P_FILE_CREATE);
    hid_t file = -1;
    char name[NAME_SIZE];
    *image = (fst_hdf5_image){NULL, 0};
    /* From this format on HDF5 keeps a checksum of everything in a file, so it notices damage instead of
     * following it. */
    if (access >= 0 && root >= 0 && H5Pset_file_image_callbacks(access, &functions) >= 0 &&
        H5Pset_libver_bounds(access, FORMAT, FORMAT) >= 0 && H5Pset_obj_track_times(root, 0) >= 0)
        file = H5Fcreate(name_of(image, name), H5F_ACC_TRUNC, root, access);
    if (root >= 0)
        (void)H5Pclose(root);
    if (access >= 0)
        (void)H5Pclose(access);
    return file;
}

size_t fst_hdf5_length(const fst_hdf5_image *image)
{
    enum { PLACE = 28 }; /* in the first block of this format */
    size_t length = 0;
    for (int i = 7; i >= 0 && image->bytes && image->size >= PLACE + 8; --i)
        length = length << 8 | image->bytes[PLACE + i];
    return length <= image->size ? length : 0;
}
