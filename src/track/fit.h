/* fit.h - the report of a fit, for the files that make one. */
#ifndef FST_TRACK_FIT_H
#define FST_TRACK_FIT_H

#include "track/fit_errors.h"

/* The own coordinate of parameter i at the minimum; its key, value and error; kappa gamma^2 with its error. */
double fit_own_value(const fit_problem *p, const fit_estimate *e, int i);
void fit_report_value(const fit_problem *p, const fit_estimate *e, int i, double deviation,
                      fst_fit_parameter *out);
void fit_report_kappa_gamma2(const fit_problem *p, const fit_estimate *e, fst_fit *fit);

#endif
