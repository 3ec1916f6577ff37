/* tangent_step.inl - the integrator's step applied to the bead and one tangent vector, over REAL; the including
 * file brings the bodies coefficients.inl, field.inl, rhs.inl and jacobian.inl, and bead_step.inl for what
 * follows a step.
 *
 * The state comes first, the tangent vector after it; its derivative is the Jacobian times it.
 */
#define STEP_DIM (2 * FST_STATE_SIZE)
#define STEP_NAME(name) FN(tangent_##name)
#define STEP_CONTEXT FN(coefficients)
#define STEP_DERIVATIVES(s, drive, j) FN(tangent_rhs)(&(s)->context, drive, (s)->stage[(j)-1], (s)->k[(j)-1])

static inline void FN(tangent_rhs)(const FN(coefficients) * c, REAL omega, const REAL *y, REAL *dy)
{
    FN(pull) p;
    REAL jacobian[FST_STATE_SIZE][FST_STATE_SIZE];
    FN(rhs)(c, omega, y, dy, &p);
    FN(jacobian)(c, omega, y, jacobian);
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        REAL sum = R(0.0);
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            sum = REAL_MULADD(jacobian[i][k], y[FST_STATE_SIZE + k], sum);
        dy[FST_STATE_SIZE + i] = sum;
    }
}

#include "ode/dop853.inl"
