/* search.h - the search of a fit, and what its stages share. */
#ifndef FST_FIT_SEARCH_H
#define FST_FIT_SEARCH_H

#include "fit/problem.h"

/* A stage of the work, whose share of the progress is known. */
typedef struct fit_stage {
    const fst_progress *outer;
    const char *what;
    double from, to, expected, latest;
    int calls;
} fit_stage;

/* tell() of an fst_progress whose user is a stage. */
fst_status fit_stage_tell(void *user, double fraction, const char *what, fst_error *error);

void fit_stage_begin(fit_stage *s, const char *what, double from, double to, double expected);

/* Take frequencies of beads that were given without a sign as opposite to the magnet's, and say so in the fit.
 */
fst_status fit_mind_signs(fit_problem *p, fst_fit *fit, fst_error *error);

/* Evaluate at u; where the model has another motion there than the measured one, look around for a better
 * start, which is left in u.  FST_NO_CONVERGENCE: there is none. */
fst_status fit_find_start(fit_problem *p, double *u, fst_error *error);

/* The whole search from the coordinates u on: a start, the minimum, outliers. */
fst_status fit_search_all(fit_problem *p, double *u, double *chi2, int *too_many, fst_error *error);

/* The parameters with which the search ends, where no more than these is wanted of a table: a start for another one. */
fst_status fit_seek(const fst_params *params, const fst_points *points, const fst_fit_options *options,
                    fst_params *found, fst_error *error);

/* Akaike's criterion with the correction for few numbers (Hurvich and Tsai 1989); NAN: too few. */
double fit_aicc(double chi2, int points, int parameters);

/* Add a line to what the fit says to people. */
fst_status fit_remark(fst_fit *fit, fst_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
