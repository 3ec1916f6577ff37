/* regress.h - least squares with a few columns over many rows. */
#ifndef FST_MEASURE_REGRESS_H
#define FST_MEASURE_REGRESS_H

#include <stddef.h>

enum { MEASURE_MOST_COLUMNS = 32 };

/* y = sum_j coefficient[j] column_j + residual, by the normal equations.  A column that others almost make up
 * is dropped: its coefficient is 0. */
typedef struct measure_regression {
    int columns;
    double normal[MEASURE_MOST_COLUMNS][MEASURE_MOST_COLUMNS], right[MEASURE_MOST_COLUMNS];
    double coefficient[MEASURE_MOST_COLUMNS];
    double inverse[MEASURE_MOST_COLUMNS][MEASURE_MOST_COLUMNS]; /* of the normal matrix; 0 in dropped rows */
    int dropped[MEASURE_MOST_COLUMNS];
} measure_regression;

void measure_regression_begin(measure_regression *fit, int columns);
void measure_regression_add(measure_regression *fit, const double *row, double y);
void measure_regression_solve(measure_regression *fit);

/* The fitted value of a row. */
double measure_regression_value(const measure_regression *fit, const double *row);

/* How a row with this residual moves the coefficients: (X'X)^-1 x e.  Their sum over all rows is zero. */
void measure_regression_influence(const measure_regression *fit, const double *row, double residual,
                                  double *influence);

#endif
