/* regress.c - least squares by Cholesky's decomposition of the normal matrix.
 *
 * The columns are of order one (cosines, or radii scaled by their mean), so the normal equations lose at most
 * half of the digits, and the noise of a track needs far fewer.
 */
#include "measure/regress.h"

#include <math.h>
#include <string.h>

#include "base/dot.h"

#define LEAST_PIVOT 1e-7 /* what of a column must be left when the columns before it are taken off */

void measure_regression_begin(measure_regression *fit, int columns)
{
    memset(fit, 0, sizeof *fit);
    fit->columns = columns;
}

void measure_regression_add(measure_regression *fit, const double *row, double y)
{
    for (int i = 0; i < fit->columns; ++i) {
        fit->right[i] += row[i] * y;
        for (int j = 0; j <= i; ++j)
            fit->normal[i][j] += row[i] * row[j];
    }
}

/* Decompose the normal matrix into L L', with empty rows for columns that are dropped. */
static void decompose(measure_regression *fit, double lower[MEASURE_MOST_COLUMNS][MEASURE_MOST_COLUMNS])
{
    for (int i = 0; i < fit->columns; ++i) {
        for (int j = 0; j <= i; ++j) {
            double sum = fit->normal[i][j];
            for (int k = 0; k < j; ++k)
                sum -= lower[i][k] * lower[j][k];
            if (j < i) {
                lower[i][j] = fit->dropped[j] ? 0.0 : sum / lower[j][j];
                continue;
            }
            fit->dropped[i] = !(sum > LEAST_PIVOT * fit->normal[i][i]);
            lower[i][i] = fit->dropped[i] ? 1.0 : sqrt(sum);
            for (int k = 0; k < i && fit->dropped[i]; ++k)
                lower[i][k] = 0.0;
        }
    }
}

void measure_regression_solve(measure_regression *fit)
{
    double lower[MEASURE_MOST_COLUMNS][MEASURE_MOST_COLUMNS];
    const int n = fit->columns;
    memset(lower, 0, sizeof lower);
    decompose(fit, lower);
    for (int column = 0; column < n; ++column) { /* of the inverse */
        double x[MEASURE_MOST_COLUMNS];
        for (int i = 0; i < n; ++i) {
            double sum = i == column && !fit->dropped[i] ? 1.0 : 0.0;
            for (int k = 0; k < i; ++k)
                sum -= lower[i][k] * x[k];
            x[i] = fit->dropped[i] ? 0.0 : sum / lower[i][i];
        }
        for (int i = n - 1; i >= 0; --i) {
            double sum = x[i];
            for (int k = i + 1; k < n; ++k)
                sum -= lower[k][i] * x[k];
            x[i] = fit->dropped[i] ? 0.0 : sum / lower[i][i];
            fit->inverse[i][column] = x[i];
        }
    }
    for (int i = 0; i < n; ++i)
        fit->coefficient[i] = fst_dot(fit->inverse[i], fit->right, n);
}

double measure_regression_value(const measure_regression *fit, const double *row)
{
    return fst_dot(fit->coefficient, row, fit->columns);
}

void measure_regression_influence(const measure_regression *fit, const double *row, double residual,
                                  double *influence)
{
    for (int i = 0; i < fit->columns; ++i) {
        influence[i] = fst_dot(fit->inverse[i], row, fit->columns) * residual;
    }
}
