/* smooth.h - curves of a chart as columns of numbers, and smooth ones through their points. */
#ifndef FST_DRAW_SMOOTH_H
#define FST_DRAW_SMOOTH_H

#include "draw/chart.h"

/* A curve as two columns of numbers; both are NAN in its gaps. */
typedef struct fst_columns {
    double *x, *y;
    size_t count;
} fst_columns;

/* Empty columns with room for `capacity` points, which the chart owns; 0: no memory. */
int fst_columns_make(fst_chart *chart, fst_columns *c, size_t capacity);
void fst_columns_put(fst_columns *c, double x, double y);

/* Put a smooth curve through each piece.  0: no memory. */
int fst_columns_smoothen(fst_chart *chart, fst_columns *c);

#endif
