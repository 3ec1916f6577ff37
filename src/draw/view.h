/* view.h - the part of a trajectory that a figure shows. */
#ifndef FST_DRAW_VIEW_H
#define FST_DRAW_VIEW_H

#include "draw/legend.h"

#include <festoon/festoon_tools.h>

typedef struct fst_view {
    const fst_table *table;
    size_t first, last;        /* rows shown: first <= row < last */
    double omega, first_omega; /* the drive at the last row and at the first */
    double gamma;              /* 1/s */
    fst_shown_units units;
    double length;           /* of a unit of length in the wanted unit */
    const char *length_unit; /* its name, "mm" */
    const char *title;       /* what the caller wants above the figure; NULL: nothing of his own */
    char about[256];         /* "ω = 0.215 (10.7 Hz), dynamics rigid" */
} fst_view;

/* Find the rows from options->from to options->to drive periods.  Open ends: the view begins at the discard,
 * and lasts as long as suits options->kind.  The title is options->title, or made from the scene.
 * FST_BAD_INPUT: there are no rows. */
fst_status fst_view_of(fst_view *view, const fst_table *table, const fst_figure_options *options,
                       fst_error *error);

/* A legend with the title options->title or, without one, `what`. */
fst_legend fst_view_legend(const fst_view *view, const char *what);

/* How a column is shown. */
fst_quantity fst_view_quantity(const fst_view *view, const fst_column_info *column);

/* The column called `name`.  FST_BAD_INPUT: there is none; the sentence names the nearest one. */
fst_status fst_view_column(const fst_view *view, const char *name, const double **column,
                           const fst_column_info **info, fst_error *error);

/* The same, for an option that the sentence shall name. */
fst_status fst_view_column_for(const fst_view *view, const char *option, const char *name,
                               const double **column, const fst_column_info **info, fst_error *error);

/* Several columns at once, by names that are known to exist; a NULL ends the list: fst_view_columns(view,
 * error, "t", &t, "r", &r, NULL). */
fst_status fst_view_columns(const fst_view *view, fst_error *error, ...);

/* The least and the greatest finite value of a column in the view (0, 0: no value is finite). */
void fst_view_range(const fst_view *view, const double *column, double *least, double *greatest);

/* Interpolate between two samples, `part` of the way from the first: the cubic with the positions x0, x1 and,
 * over the time step h, the velocities v0, v1 there (Hermite's; its error falls as h^4). */
double fst_view_between(double x0, double v0, double x1, double v1, double h, double part);

#endif
