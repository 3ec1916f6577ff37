/* fit_bootstrap.h - errors from the numbers themselves. */
#ifndef FST_TRACK_FIT_BOOTSTRAP_H
#define FST_TRACK_FIT_BOOTSTRAP_H

#include "track/fit_search.h"
#include "track/fit_errors.h"

/* Draw the used numbers anew, fit, again and again; fills in fit->bootstrap_count and the parameters' errors.
 */
fst_status fit_bootstrap(fit_problem *p, const fit_estimate *e, fit_stage *stage, int samples, uint64_t seed,
                         fst_fit *fit, fst_error *error);

#endif
