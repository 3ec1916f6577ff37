/* rows_file.h - a trajectory's file while it is written, of one bead or of several: CSV or HDF5, by its ending. */
#ifndef FST_IO_ROWS_FILE_H
#define FST_IO_ROWS_FILE_H

#include "host/whole_file.h"
#include "io/columns.h"
#include "io/hdf5_module.h"

typedef struct fst_rows_file {
    fst_whole_file whole;
    fst_hdf5_writer *writer; /* NULL: CSV, written to whole.stream */
    const fst_hdf5_module_table *module;
    int count;
    double *values;     /* of the next row, scaled; the file has them times `factors` */
    double *factors;    /* NULL: scaled units */
    const char **units; /* likewise */
} fst_rows_file;

/* Begin a file of zeros with its head; the columns are kept, not copied.  Where it fails, discard it. */
fst_status fst_rows_open(fst_rows_file *file, const char *path, const fst_params *scene, int of_beads,
                         const fst_column_info *const *columns, int count, fst_shown_units units,
                         fst_error *error);

/* Write file->values. */
fst_status fst_rows_append(fst_rows_file *file, fst_error *error);

/* Close it with the line of the result, which is freed, or (has_result 0) without one; it is discarded too. */
fst_status fst_rows_close(fst_rows_file *file, int has_result, char *line, int complete, fst_error *error);

/* Forget the file, and remove what a commit has not made whole. */
void fst_rows_discard(fst_rows_file *file);

#endif
