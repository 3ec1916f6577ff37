/* regress.h - least squares with a few columns over many rows. */
#ifndef FST_TRACK_REGRESS_H
#define FST_TRACK_REGRESS_H

#include <stddef.h>

enum { TRACK_MOST_COLUMNS = 32 };

/* y = sum_j coefficient[j] column_j + residual, by the normal equations.  A column that others almost make up
 * is dropped: its coefficient is 0. */
typedef struct track_fit {
    int columns;
    double normal[TRACK_MOST_COLUMNS][TRACK_MOST_COLUMNS], right[TRACK_MOST_COLUMNS];
    double coefficient[TRACK_MOST_COLUMNS];
    double inverse[TRACK_MOST_COLUMNS][TRACK_MOST_COLUMNS]; /* of the normal matrix; 0 in dropped rows */
    int dropped[TRACK_MOST_COLUMNS];
} track_fit;

void track_fit_begin(track_fit *fit, int columns);
void track_fit_add(track_fit *fit, const double *row, double y);
void track_fit_solve(track_fit *fit);

/* The fitted value of a row. */
double track_fit_value(const track_fit *fit, const double *row);

/* How a row with this residual moves the coefficients: (X'X)^-1 x e.  Their sum over all rows is zero. */
void track_fit_influence(const track_fit *fit, const double *row, double residual, double *influence);

/* By how much the variance of a coefficient is greater than if the other columns were not there. */
double track_fit_inflation(const track_fit *fit, int column);

#endif
