/* fit_rivals.h - the same numbers by other laws of friction and other equations of motion. */
#ifndef FST_TRACK_FIT_RIVALS_H
#define FST_TRACK_FIT_RIVALS_H

#include "track/fit_search.h"

/* Fill in the rivals of a fit that is otherwise reported. */
fst_status fit_rivals(const fit_problem *p, fit_stage *stage, const fst_points *points,
                      const fst_fit_options *options, fst_fit *fit, fst_error *error);

#endif
