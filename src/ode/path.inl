/* path.inl - integrals over a step by the values at its places, over REAL; see path.h.  The including file
 * brings bead_step.inl.
 */
#include "ode/path.h"

/* The integral over the step of a quantity whose values at the path's places lie `stride` apart, by the
 * method's own weights.  Do not reorder: the sum runs over the stages in their order, which defines the
 * published bits. */
static inline __attribute__((always_inline)) REAL FN(path_integral)(const FN(bead_step) * s, const REAL *values,
                                                                    int stride)
{
    enum { TERMS = 8 };
    const REAL weight[TERMS] = {DOP_B1, DOP_B6, DOP_B7, DOP_B8, DOP_B9, DOP_B10, DOP_B11, DOP_B12};
    static const int place[TERMS] = {0, 3, 1, 2, 5, 4, 6, 7}; /* of the stages 1, 6, 7, ... 12 */
    REAL sum = R(0.0);
    for (int j = 0; j < TERMS; ++j)
        sum = REAL_MULADD(weight[j], values[place[j] * stride], sum);
    return s->h * sum;
}

#if KNOWS_DRY
/* What integrates to time integrals: the integrands q times dt/dtheta at a place, under a law with modes. */
static inline void FN(pace_integrands)(const FN(bead_step) * s, int place, int dim, REAL *q)
{
    if (FST_WORLD(s)->kinds.modes)
        for (int i = 0; i < dim; ++i)
            q[i] = FST_PATH_PACE(s, place) * q[i];
}
#endif

/* The dense output of the integrals over the step of `dim` quantities: coefficients for evaluate_dense(), from
 * the quantities at the path's places and at those that the dense output adds. */
static inline void FN(path_dense)(const FN(bead_step) * s, int dim, const REAL *increments, const REAL *path,
                                  const REAL *added, REAL *coefficients)
{
    enum { STAGES = 16, MOST = 32 };
    REAL zero[MOST], stage[STAGES * MOST];
    for (int i = 0; i < dim; ++i)
        zero[i] = R(0.0);
    for (int i = 0; i < STAGES * dim; ++i)
        stage[i] = R(0.0);
    for (int place = 0; place < FST_DENSE_PLACES; ++place)
        for (int i = 0; i < dim; ++i)
            stage[FST_PATH_STAGE_[place] * dim + i] =
                place < FST_PATH_PLACES ? path[place * dim + i] : added[(place - FST_PATH_PLACES) * dim + i];
    FN(bead_dense_coefficients)(dim, s->h, zero, increments, stage, dim, coefficients);
}

/* Greatest component of |d(state)/dt| at the end of the step. */
static inline REAL FN(step_speed)(const FN(bead_step) * s)
{
    const REAL *slope = FST_PATH_SLOPE(s, FST_PATH_END);
    REAL speed = REAL_ABS(slope[0]);
    for (int i = 1; i < FST_STATE_SIZE; ++i)
        speed = REAL_MAX(REAL_ABS(slope[i]), speed);
#if KNOWS_DRY
    if (HAS(FST_WORLD(s)->kinds, modes)) /* the slopes are those by theta */
        speed = speed / FST_PATH_PACE(s, FST_PATH_END);
#endif
    return speed;
}
