/* outliers.h - numbers that nothing explains. */
#ifndef FST_FIT_OUTLIERS_H
#define FST_FIT_OUTLIERS_H

#include "fit/errors.h"

/* From the minimum at u: find the outliers, give them the weight 0, and search again, until the list stays the
 * same. *too_many: a quarter of the numbers would be outliers; then none is left out, for it is the model that
 * does not fit. */
fst_status fit_reject(fit_problem *p, double *u, double *chi2, int *too_many, fst_error *error);

/* Residual of a number over what it would be expected to be, by a fit without it: in standard deviations. */
double fit_studentised(const fit_problem *p, const fit_estimate *e, int number);

/* The factor by which the errors of the table must be wrong, or the model: 1, or the root of chi^2/dof where
 * chance explains so much in less than one case in a thousand. */
double fit_error_scale(double chi2, int dof);

#endif
