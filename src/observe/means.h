/* means.h - means over a window between its marks, and their errors. */
#ifndef FST_OBSERVE_MEANS_H
#define FST_OBSERVE_MEANS_H

#include "observe/window.h"

/* Means between two marks of a window: a row of a ramp, and a block of a series. */
void fst_means_between(const fst_window *w, const fst_mark *first, const fst_mark *last, fst_ramp_point *means);

/* Whether a contact with dry friction stuck all the time between the first and the latest mark of a series. */
int fst_never_slips(const fst_window *w, const fst_mark_series *series);

/* The means, errors and extremes among the numbers of a result, between the first and the latest mark of one of
 * the window's series; `params` are those of the run. */
void fst_means_fill(const fst_window *w, const fst_mark_series *series, const fst_params *params,
                    fst_run_result *result);

/* The errors of a chaotic motion: a drift within chance does not count, and they are no smaller than what the means of
 * the window's halves differ by. */
void fst_means_of_chaos(const fst_window *w, const fst_mark_series *series, const fst_params *params,
                        fst_run_result *result);

#endif
