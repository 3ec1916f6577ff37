/* point_curves.h - the curves of a sweep or of a branch over the drive, with which measured points are compared. */
#ifndef FST_MEASURE_POINT_CURVES_H
#define FST_MEASURE_POINT_CURVES_H

#include <festoon/festoon_tools.h>

/* A straight piece of a curve, of one quantity, in Hz and SI; with equal ends a run that no line joins to others. */
typedef struct fst_curve_piece {
    double x[2], y[2];
    int stable;
} fst_curve_piece;

/* A special point of a branch; NAN: it has none of this quantity. */
typedef struct fst_curve_special {
    fst_special_type type;
    double x, y[FST_MEASURED_COUNT];
} fst_curve_special;

/* A run of a sweep that is no model: undecided, ejected, failed, ... (fst_sweep_gap()). */
typedef struct fst_curve_gap {
    double x;
    int gap;
} fst_curve_gap;

typedef struct fst_point_curves {
    int is_sweep; /* else a branch */
    fst_curve_piece *list[FST_MEASURED_COUNT];
    size_t count[FST_MEASURED_COUNT];
    fst_curve_special *specials;
    size_t special_count;
    fst_curve_gap *gaps;
    size_t gap_count;
    double length, gamma; /* m and 1/s: the units of the file's numbers */
    fst_params *scene;    /* NULL: the file does not say */
    char slice[192];      /* of a sweep over more axes, their values, "friction.mu 0.2" */
} fst_point_curves;

/* Read the curves of a file into an empty struct, which fst_point_curves_free() frees, also after a failure.  A branch has
 * the orbits at the drives of the tables among its points; of a sweep the slice is read that the options have
 * (fst_sweep_figure_of()). */
fst_status fst_point_curves_read(const char *path, const fst_points *tables, int table_count,
                                 const fst_sweep_figure *options, int used[FST_AXIS_LIMIT],
                                 fst_point_curves *curves, fst_error *error);
void fst_point_curves_free(fst_point_curves *curves);

/* chi^2 of a table before the curves, over the quantities that are `wanted`. */
fst_points_fit fst_point_curves_fit(const fst_point_curves *curves, const fst_points *points,
                                    const int wanted[FST_MEASURED_COUNT]);

#endif
