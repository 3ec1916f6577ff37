/* tangent_step.inl - the integrator's step applied to the bead and one tangent vector, over REAL.
 *
 * A tangent vector is an infinitesimal difference of two states; it changes by the derivative of the right-hand
 * side along it.  Both are integrated as one state of twice the length, the bead's state first, so that the
 * tangent belongs to exactly the trajectory that was computed.  The including file brings
 * model/bodies.inl.
 */
#include "model/tangent.inl"

#undef TANGENT_WORLD
#define TANGENT_WORLD(step) (&(step)->context) /* what never changes along it */
#define STEP_DIM (2 * FST_STATE_SIZE)
#define STEP_NAME(name) FN(tangent_##name)
#define STEP_CONTEXT FN(world)
#define STEP_RHS(c, drive, y, dy) FN(tangent_rhs)(c, drive, y, dy)

RHS_KIND void FN(tangent_rhs)(const FN(world) * c, REAL omega, const REAL *y, REAL *dy)
{
    FN(rhs_and_tangent)
    (c, NULL, omega, y, y + FST_STATE_SIZE, dy, dy + FST_STATE_SIZE); /* laws without modes */
}

#include "ode/dop853.inl"
