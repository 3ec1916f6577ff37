/* tangent_step.inl - the integrator's step applied to the bead and one tangent vector, over REAL; the including
 * file brings model/bodies.inl, and bead_step.inl for what follows a step.
 *
 * The state comes first, the tangent vector after it; its derivative is that of the right-hand side along it.
 */
#include "model/tangent.inl"

#define STEP_DIM (2 * FST_STATE_SIZE)
#define STEP_NAME(name) FN(tangent_##name)
#define STEP_CONTEXT FN(coefficients)
#define STEP_DERIVATIVES(s, drive, j) FN(tangent_rhs)(&(s)->context, drive, (s)->stage[(j)-1], (s)->k[(j)-1])

RHS_KIND void FN(tangent_rhs)(const FN(coefficients) * c, REAL omega, const REAL *y, REAL *dy)
{
    FN(rhs_and_tangent)(c, omega, y, y + FST_STATE_SIZE, dy, dy + FST_STATE_SIZE);
}

#include "ode/dop853.inl"
