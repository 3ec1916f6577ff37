/* errors.h - how well the parameters of a fit are known. */
#ifndef FST_FIT_ERRORS_H
#define FST_FIT_ERRORS_H

#include "fit/problem.h"

/* The minimum and its surroundings. */
typedef struct fit_estimate {
    double u[FIT_MOST], chi2;
    double *jacobian;               /* derivatives of the residuals there */
    double eigenvalues[FIT_MOST];   /* of the information matrix, rising */
    fit_matrix vectors, covariance; /* of the coordinates; not scaled */
} fit_estimate;

/* Look around at u.  fit_estimate_free() frees it, also on failure. */
fst_status fit_estimate_make(fit_problem *p, const double *u, fit_estimate *e, fst_error *error);
void fit_estimate_free(fit_estimate *e);

/* The inverse of J^T J; 0: some direction is not known at all. */
int fit_covariance(const double *jacobian, int m, int n, fit_matrix *covariance);

/* FST_BAD_INPUT: the numbers do not depend on a parameter, or not on a combination of some; the sentence says
 * which. */
fst_status fit_estimate_check(const fit_problem *p, const fit_estimate *e, fst_error *error);

/* The standard deviation of the own coordinate of parameter i, and the correlation of two. */
double fit_deviation(const fit_problem *p, const fit_estimate *e, int i);
double fit_correlation(const fit_problem *p, const fit_estimate *e, int i, int j);

/* How much of a number's residual the fit itself takes up, from 0 to 1. */
double fit_leverage(const fit_problem *p, const fit_estimate *e, int number);

/* The own coordinate of parameter i at which the least chi^2 over all others is `rise` above the minimum, above
 * (side 1) or below it (side -1), as a distance from the minimum; NAN where it is not reached.  Where a smaller
 * chi^2 is met on the way, *better is set to 1 and `u_better` to its place. */
fst_status fit_profile(fit_problem *p, const fit_estimate *e, int i, int side, double rise, double *end,
                       int *better, double u_better[FIT_MOST], fst_error *error);

#endif
