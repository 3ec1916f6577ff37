/* space.h - the unknowns of a fit: keys of parameters, and the coordinates in which they are sought. */
#ifndef FST_FIT_SPACE_H
#define FST_FIT_SPACE_H

#include <festoon/fit.h>

#include "fit/matrix.h"

/* One parameter.  value = start exp(q), or start + scale q where it may be zero or negative; q is its own
 * coordinate. */
typedef struct fit_key {
    const fst_param_info *info;
    double start, scale; /* scale 0: a logarithm */
    double prior[2];     /* NAN: none was given */
} fit_key;

typedef struct fit_space {
    fst_params base;
    int count, free_count; /* free parameters first, then given ones */
    fit_key keys[FIT_MOST];
    /* Where kappa and gamma are both sought: their indices.  The coordinate of kappa is then that of kappa
     * gamma^2, which the data know ten times better than either. */
    int kappa, gamma; /* else -1 */
} fit_space;

fst_status fit_space_begin(fit_space *space, const fst_params *params, const fst_fit_options *options,
                           fst_error *error);

/* The parameters at the coordinates u.  Values outside of their ranges are brought to the range's end; returns
 * how far outside they lay, in coordinates. */
double fit_space_params(const fit_space *space, const double *u, fst_params *params);

/* The value of parameter i at u, and its own coordinate as a sum over u: q_i = sum of c_k u_k. */
double fit_space_value(const fit_space *space, const double *u, int i);
void fit_space_own(const fit_space *space, int i, double c[FIT_MOST]);

/* The value of parameter i where its own coordinate is q, and d value/dq there. */
double fit_space_at(const fit_space *space, int i, double q);
double fit_space_slope(const fit_space *space, int i, double q);

/* kappa gamma^2 in 1/s^2, mu B0/(m R^2), of a setup; NAN where there is no model of it.  Fails where memory runs out. */
fst_status fit_kappa_gamma2(const fst_params *params, double *value, fst_error *error);

#endif
