/* path.inl - integrals over a step and the drive at its points, over REAL; see path.h.
 *
 * The including file brings bead_step.inl.  Values at the points of a path lie `stride` numbers apart, in the
 * order of the points: what is integrated looks the same to one run and to lanes.
 */
#include "ode/path.h"

/* The drive at a point. */
static inline REAL FN(point_omega)(const FN(bead_step) * s, int point)
{
    return s->omega + (s->h * REAL_OF(FST_POINT_NODE[point])) * s->ramp;
}

/* The mean over a step of what has these values at its points, by the method's weights.  Do not reorder: the
 * sum runs over the stages in their order, and this order defines the published bits. */
static inline __attribute__((always_inline)) REAL FN(path_mean)(const REAL *values, int stride)
{
    const REAL weight[] = {DOP_B1, DOP_B6, DOP_B7, DOP_B8, DOP_B9, DOP_B10, DOP_B11, DOP_B12};
    static const int point[] = {0, 3, 1, 2, 5, 4, 6, 7}; /* the stages 1, 6, 7, ... 12 */
    REAL sum = R(0.0);
    for (int j = 0; j < 8; ++j)
        sum = REAL_MULADD(weight[j], values[point[j] * stride], sum);
    return sum;
}

/* Coefficients of the dense output of `dim` integrals, from `before` at the start of the step to `after` at its
 * end, of the integrands at all FST_DENSE_POINTS. */
static inline void FN(path_dense)(int dim, REAL h, const REAL *before, const REAL *after, const REAL *values,
                                  REAL *dense)
{
    static const int point[16] = {[0] = 0,  [5] = 3,  [6] = 1,  [7] = 2,  [8] = 5,   [9] = 4,
                                  [10] = 6, [11] = 7, [12] = 8, [13] = 9, [14] = 10, [15] = 11};
    FN(bead_dense_coefficients)(dim, h, before, after, values, point, dim, dense);
}
