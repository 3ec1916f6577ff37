/* newton.h - the linear system of Newton's method, for those who close it in their own way. */
#ifndef FST_ORBIT_NEWTON_H
#define FST_ORBIT_NEWTON_H

#include "orbit/solution.h"

/* Dry friction: a slip that ends and begins is known to the tolerance, and a long orbit that repels makes more of that; a
 * disc of contact pivots by 1e-9 where it is held (model/disc.c).  So a residual may stand still as high as this. */
#define FST_RESIDUAL_OF_RESTS 1e-10

/* Whether Newton's method has nothing left to do, or has found a solution and stands still; `before` is the
 * residual an iteration earlier. */
static inline int fst_newton_is_done(const fst_family *family, const fst_solution *s, double before)
{
    const int rests = fst_family_rests(family) && s->segments > 0;
    return s->residual < 0.1 * family->residual ||
           (s->residual < (rests ? FST_RESIDUAL_OF_RESTS : family->residual) && s->residual > 0.1 * before);
}

/* The linear system of one iteration.  Columns: the states in their tangent bases, the period of an orbit, the
 * free parameter. */
typedef struct fst_newton_system {
    int size; /* unknowns with the parameter */
    int rows; /* equations without the last, which fixes the parameter or the place on the curve */
    double a[FST_UNKNOWNS][FST_UNKNOWNS], b[FST_UNKNOWNS];
    double basis[FST_SEGMENTS][FST_STATE_SIZE][FST_TANGENT_SIZE];
} fst_newton_system;

/* The equations at s; their greatest residual is left in s->residual, the chain's derivative in s->map. */
fst_status fst_newton_equations(const fst_family *family, fst_solution *s, fst_newton_system *l,
                                fst_error *error);

/* The row of the product with a direction (fst_direction_product). */
void fst_newton_row(const fst_family *family, const fst_solution *s, fst_newton_system *l,
                    const fst_direction *across, double *row);

/* A solution of the system as a direction. */
void fst_newton_direction(const fst_solution *s, fst_newton_system *l, const double *x, fst_direction *out);

#endif
