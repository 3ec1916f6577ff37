/* hdf5_module.h - what festoon-hdf5.so offers.  HDF5 takes long to load, so the module is loaded only for a
 * trajectory that needs it. */
#ifndef FST_IO_HDF5_MODULE_H
#define FST_IO_HDF5_MODULE_H

#include <festoon/festoon_tools.h>
#include <stdio.h>

typedef struct fst_hdf5_writer fst_hdf5_writer;

/* A map of a field as its file has it: places along x, y, z (NULL: not told) and B of each sample, x fastest,
 * with their units. */
enum { FST_HDF5_UNIT_SIZE = 32 };
#define FST_HDF5_MAP_LIMIT 32000000u
typedef struct fst_hdf5_map {
    size_t count[3];
    double *places[3], *b;
    char units[4][FST_HDF5_UNIT_SIZE]; /* of x, y, z, B; "": not told */
} fst_hdf5_map;

/* The module's one symbol is a table of this type, named FST_HDF5_MODULE_SYMBOL. */
#define FST_HDF5_MODULE_SYMBOL "fst_hdf5_module"
typedef struct fst_hdf5_module_table {
    const char *version; /* FST_VERSION_STRING at the module's build; a module of another version is refused */

    /* The greatest size in bytes of a file, read or written: half of this computer's memory, because the
     * numbers that come out of it need at least as much again. */
    size_t (*most)(void);

    /* Begin a trajectory, which is made in memory; `name` stands for it in messages.  The name and the columns
     * are kept, not copied.  Where `texts` is not NULL, each row has a text in a column of this name. */
    fst_status (*create)(const char *name, const fst_column_info *const *columns, int count, const char *texts,
                         const char *scene, fst_hdf5_writer **writer, fst_error *error);
    fst_status (*row)(fst_hdf5_writer *writer, const double *values, const char *text, fst_error *error);
    /* Add the last rows and the attributes `result` (JSON or NULL) and `complete`, and write the file to a
     * stream, whose failures are the caller's to find.  The writer is gone afterwards, also on failure. */
    fst_status (*finish)(fst_hdf5_writer *writer, const char *result, int complete, FILE *out,
                         fst_error *error);
    void (*abandon)(fst_hdf5_writer *writer);

    /* Read all columns of the file with these bytes.  Where none of those from `needed` on is there, their data
     * are zeros.  `result` is that of finish(), NULL: not wanted.  The caller frees data[i],
     * `scene` and `result`, also on failure where they are not NULL. */
    fst_status (*read)(const char *path, const char *bytes, size_t size, const fst_column_info *const *columns,
                       int needed, int count, double **data, size_t *rows, char **scene, char **result,
                       int *complete, fst_error *error);

    /* Read a map of a field.  The caller frees its places and b, also on failure. */
    fst_status (*read_map)(const char *path, const char *bytes, size_t size, fst_hdf5_map *map,
                           fst_error *error);
} fst_hdf5_module_table;

#endif
