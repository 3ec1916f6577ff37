/* report.h - what a fit tells of its minimum, for the files that find it out. */
#ifndef FST_FIT_REPORT_H
#define FST_FIT_REPORT_H

#include "fit/errors.h"
#include "fit/search.h"

/* The own coordinate of parameter i at the minimum; its key, value and error; kappa gamma^2 with its error, NAN where
 * it was not measured. */
double fit_own_value(const fit_problem *p, const fit_estimate *e, int i);
void fit_report_value(const fit_problem *p, const fit_estimate *e, int i, double deviation,
                      fst_fit_parameter *out);
fst_status fit_report_kappa_gamma2(const fit_problem *p, const fit_estimate *e, fst_fit *fit, fst_error *error);

/* fit->weakest: the weakest direction, and, if `helpers`, which further number of a table would help most. */
fst_status fit_weakest(const fit_problem *p, const fit_estimate *e, int helpers, fst_fit *fit,
                       fst_error *error);

/* The same numbers by other laws, into fit->rivals.  FST_INTERRUPTED, FST_NO_MEMORY; a rival that fails
 * otherwise is listed as not fitted. */
fst_status fit_rivals(const fit_problem *p, fit_stage *stage, const fst_points *points,
                      const fst_fit_options *options, fst_fit *fit, fst_error *error);

/* Draw the used numbers anew, fit, again and again; fills in fit->bootstrap_count and the parameters' errors.
 */
fst_status fit_bootstrap(fit_problem *p, const fit_estimate *e, fit_stage *stage, int samples, uint64_t seed,
                         fst_fit *fit, fst_error *error);

#endif
