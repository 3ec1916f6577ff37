/* fit.h - measured points, and the parameters of the model that follow from them; festoon_tools.h includes it.
 *
 * A point is what was measured at one frequency of the drive: the mean distance of the bead from the axis, its
 * deviation, and how often the bead goes round in a second.  docs/fit.md explains how parameters are found.
 */
#ifndef FESTOON_FIT_H
#define FESTOON_FIT_H

#include <festoon/festoon.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ the table of points */

/* What may be measured at a frequency of the drive. */
typedef enum {
    FST_MEASURED_MEAN_R,         /* <r>, m */
    FST_MEASURED_STD_R,          /* delta r, m */
    FST_MEASURED_BEAD_FREQUENCY, /* turns a second, Hz; negative where the bead goes round against the magnet,
                                    which turns counter-clockwise where its frequency is positive */
    FST_MEASURED_COUNT
} fst_measured;

/* The name of its column: "mean_r", "std_r", "bead_frequency". */
FST_API const char *fst_measured_name(fst_measured what);
/* FST_UNIT_LENGTH or FST_UNIT_FREQUENCY */
FST_API fst_unit fst_measured_unit(fst_measured what);

/* A row of the table, in SI units; NAN: an empty cell, or no such column. */
typedef struct fst_point {
    double frequency, frequency_error; /* of the drive, Hz; the error is NAN where it is not known */
    double value[FST_MEASURED_COUNT], error[FST_MEASURED_COUNT]; /* both or neither; errors are positive */
    int line;                                                    /* in the file, from 1 */
} fst_point;

/* Begin with {0}; free with fst_points_free(). */
typedef struct fst_points {
    fst_point *rows;
    size_t count;
    int column[FST_MEASURED_COUNT]; /* the number of the column of a quantity in the file, from 1; 0: none */
} fst_points;
FST_API void fst_points_free(fst_points *points);

/* Read a table with a line of column names with units, `frequency [Hz]`, `mean_r [mm]`, `mean_r_error [mm]`,
 * and so on, and optionally `frequency_error [Hz]`, in any order and with any units of their kinds.  Columns
 * are separated by commas, semicolons or tabs; without commas between them, numbers may have decimal commas.
 * Lines that begin with
 * '#' and empty lines are stepped over.  FST_BAD_INPUT: error->where is "FILE:LINE", the sentence names the
 * column. */
FST_API fst_status fst_points_read(const char *path, fst_points *points, fst_error *error);

/* Write such a table, in mm and Hz, whole or not at all; fst_points_read() gets the same numbers from it. */
FST_API fst_status fst_points_write(const char *path, const fst_points *points, fst_error *error);

#ifdef __cplusplus
}
#endif

#endif
