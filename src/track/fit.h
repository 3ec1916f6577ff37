/* fit.h - the stages of a fit, for the files that take part in one. */
#ifndef FST_TRACK_FIT_H
#define FST_TRACK_FIT_H

#include "track/fit_errors.h"

/* A stage of the work, whose share of the progress is known. */
typedef struct fit_stage {
    const fst_progress *outer;
    const char *what;
    double from, to, expected, latest;
    int calls;
} fit_stage;

void fit_stage_begin(fit_stage *s, const char *what, double from, double to, double expected);

/* Evaluate at u; where the model has another motion there than the measured one, look around for a better
 * start, which is left in u.  FST_NO_CONVERGENCE: there is none. */
fst_status fit_find_start(fit_problem *p, double *u, fst_error *error);

/* The whole search from the coordinates u on: a start, the minimum, outliers. */
fst_status fit_search_all(fit_problem *p, double *u, double *chi2, int *too_many, fst_error *error);

/* Akaike's criterion with the correction for few numbers (Hurvich and Tsai 1989); NAN: too few. */
double fit_aicc(double chi2, int points, int parameters);

/* The own coordinate of parameter i at the minimum; its key, value and error; kappa gamma^2 with its error. */
double fit_own_value(const fit_problem *p, const fit_estimate *e, int i);
void fit_report_value(const fit_problem *p, const fit_estimate *e, int i, double deviation,
                      fst_fit_parameter *out);
void fit_report_kappa_gamma2(const fit_problem *p, const fit_estimate *e, fst_fit *fit);

/* Add a line to what the fit says to people. */
fst_status fit_remark(fst_fit *fit, fst_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
