/* bead_step.inl - the integrator's step applied to the bead, over REAL; the including file brings
 * model/bodies.inl first.
 *
 * What one step leaves for the next, and for what observes it:
 *
 *     begin_steps()            try_step()                   finish_step()           next_step()
 *     first stage at s->y ---> stages 2 to 12, s->end ----> n of unit length, ----> the end is the start:
 *                              (as often as it takes)       stage 13 at the end     stage 13 becomes stage 1
 *
 * The magnet's pull is kept at every stage, because integrals and events need it there (path.h).
 */
#include "ode/dop853_tableau.h"

typedef struct FN(bead) {
    FN(coefficients) coefficients;
    FN(pull) pull[16]; /* at the stages */
} FN(bead);

#define STEP_DIM FST_STATE_SIZE
#define STEP_NAME(name) FN(bead_##name)
#define STEP_CONTEXT FN(bead)
#ifdef REAL_FORCES_AHEAD
#define STEP_KNOWN(i) ((i) < FST_VX || ((i) >= FST_NX && (i) < FST_WX)) /* the place and n */
#define STEP_KINEMATICS(s, drive, j) FN(kinematics)(drive, (s)->stage[(j)-1], (s)->k[(j)-1])
#define STEP_FORCES(s, j)                                                                                      \
    FN(magnetic_pull)(&(s)->context.coefficients, (s)->stage[(j)-1], &(s)->context.pull[(j)-1])
#define STEP_DYNAMICS(s, drive, j)                                                                             \
    FN(dynamics)(&(s)->context.coefficients, drive, (s)->stage[(j)-1], &(s)->context.pull[(j)-1], (s)->k[(j)-1])
#define STEP_FORCES_AND_DYNAMICS(s, next, drive, j)                                                            \
    FN(pull_and_dynamics)                                                                                      \
    (&(s)->context.coefficients, (s)->stage[(next)-1], &(s)->context.pull[(next)-1], drive, (s)->stage[(j)-1], \
     &(s)->context.pull[(j)-1], (s)->k[(j)-1])
#else
#define STEP_DERIVATIVES(s, drive, j)                                                                          \
    FN(rhs)(&(s)->context.coefficients, drive, (s)->stage[(j)-1], (s)->k[(j)-1], &(s)->context.pull[(j)-1])
#endif

#include "ode/dop853.inl"

/* Put the end's n back on the unit sphere; returns how far off it was, | |n| - 1 |. */
static inline REAL FN(renormalise)(REAL *y)
{
    REAL *n = y + FST_NX;
    const REAL norm2 = SUM_3(n[0], n[0], n[1], n[1], n[2], n[2]);
#ifdef REAL_FAST_RECIPROCAL_SQRT
    const REAL inverse = REAL_FAST_RECIPROCAL_SQRT(norm2), norm = norm2 * inverse;
    for (int i = 0; i < 3; ++i)
        n[i] = n[i] * inverse;
#else
    const REAL norm = REAL_SQRT(norm2);
    for (int i = 0; i < 3; ++i)
        n[i] = n[i] / norm;
#endif
    return REAL_ABS(norm - R(1.0));
}

/* The end of an accepted step: n is renormalised, and stage 13, the first of the next step, is evaluated. */
static inline REAL FN(finish_step)(FN(bead_step) * s)
{
    const REAL drift = FN(renormalise)(s->end);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        s->stage[12][i] = s->end[i];
    FN(rhs)(&s->context.coefficients, s->omega + s->h * s->ramp, s->end, s->k[12], &s->context.pull[12]);
    return drift;
}

/* Make the end of the last step the start of the next, in the lanes of `mask`. */
static inline void FN(next_step_where)(FN(bead_step) * s, REAL_MASK mask)
{
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        s->y[i] = s->stage[0][i] = REAL_SELECT(mask, s->end[i], s->y[i]);
        s->k[0][i] = REAL_SELECT(mask, s->k[12][i], s->k[0][i]);
    }
    /* A pull has no members but REALs. */
    REAL *to = (REAL *)&s->context.pull[0];
    const REAL *from = (const REAL *)&s->context.pull[12];
    for (size_t i = 0; i < sizeof(FN(pull)) / sizeof(REAL); ++i)
        to[i] = REAL_SELECT(mask, from[i], to[i]);
}

/* The same in all lanes, where the drive is now `omega`. */
static inline void FN(next_step)(FN(bead_step) * s, REAL omega)
{
    s->omega = omega;
    FN(next_step_where)(s, REAL_EVERYWHERE);
}

/* First stage of a trajectory that starts at s->y. */
static inline void FN(begin_steps)(FN(bead_step) * s)
{
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        s->stage[0][i] = s->y[i];
    FN(rhs)(&s->context.coefficients, s->omega, s->y, s->k[0], &s->context.pull[0]);
}
