/* curve.h - the fitted model between and beside the frequencies of the table. */
#ifndef FST_FIT_CURVE_H
#define FST_FIT_CURVE_H

#include "fit/errors.h"

/* The model at `count` frequencies from `from` to `to`, with how it changes along each coordinate:
 * slopes[i * parameters + k][what].  Values are NAN where there is no orbit.  free() both. */
typedef struct fit_curve {
    int count;
    fst_fit_curve_point *points;
    double (*slopes)[FST_MEASURED_COUNT];
} fit_curve;

/* `scale` multiplies the uncertainty of the parameters, which makes the points' spread. */
fst_status fit_curve_make(const fit_problem *p, const fit_estimate *e, double scale, double from, double to,
                          int count, fit_curve *curve, fst_error *error);
void fit_curve_free(fit_curve *curve);

/* The range of frequencies of the table, widened by a part of it on both sides; the sign stays. */
void fit_frequency_range(const fit_problem *p, double widened, double *from, double *to);

#endif
