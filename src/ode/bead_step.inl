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
 *
 * The step's own time.  Under a law with modes a step is measured not in time t but in theta, with dt = pace
 * dtheta, and the pace follows from the state (model/contact/coulomb.inl).  The derivatives at the stages are
 * then those by theta, and time is a number of the motion like others: it is 0 at the start of the step, its
 * derivative is the pace, and at the end it is how long the step took.  Height and climb of a bead in the air
 * (ode/flight.c) are two more.  Under other laws theta is t, and a motion has the numbers of a state alone.
 */
#include "ode/dop853_tableau.h"

typedef struct FN(bead) {
    FN(world) world;
    FN(pull) pull[16]; /* at the stages */
#if KNOWS_DRY
    FN(modes) modes; /* of the motion: constant within a step */
#endif
#ifdef STEP_OUTSIDE
    fst_outside_state *outside; /* what a caller adds (outside.h); NULL: nothing */
#endif
} FN(bead);

#undef MODES_OF
#undef BEAD_NUMBERS
#if KNOWS_DRY
#define MODES_OF(bead) (&(bead)->modes)
#ifdef REAL_IS_SCALAR
#define BEAD_NUMBERS FST_NUMBERS
#define STEP_FEWER FST_STATE_SIZE
#ifdef STEP_OUTSIDE /* which asks for the time */
#define STEP_TAKES_ALL(s) ((s)->context.world.kinds.modes || (s)->context.outside)
#else
#define STEP_TAKES_ALL(s) ((s)->context.world.kinds.modes)
#endif
#else
#define BEAD_NUMBERS (FST_STEP_TIME + 1) /* no bead flies in lanes */
#endif
#else
#define MODES_OF(bead) ((const FN(modes) *)NULL)
#define BEAD_NUMBERS FST_STATE_SIZE
#endif

/* The derivatives by theta of the numbers y, where the drive is `drive`; the magnet's pull is left in `p`. */
static inline void FN(bead_rhs)(const FN(bead) * bead, REAL drive, const REAL *y, REAL *k, FN(pull) * p)
{
    const FN(world) *c = &bead->world;
#ifdef STEP_OUTSIDE
    if (bead->outside) {
        fst_outside_rhs(bead, drive, y, k, p);
        return;
    }
#endif
    FN(rhs)(c, MODES_OF(bead), drive, y, k, p);
#if KNOWS_DRY
    if (!c->kinds.modes)
        return;
    const REAL pace = k[FST_STEP_TIME] = FN(pace)(c, &bead->modes, y);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        k[i] = pace * k[i];
#endif
#if KNOWS_DRY && defined REAL_IS_SCALAR
    const int flies = FN(in_flight)(&bead->modes);
    k[FST_HEIGHT] = flies ? pace * y[FST_CLIMB] : R(0.0);
    k[FST_CLIMB] = flies ? pace * (p->force[2] - c->gravity) : R(0.0);
#endif
}

#define STEP_DIM BEAD_NUMBERS
#define STEP_JUDGED FST_STATE_SIZE
#define STEP_NAME(name) FN(bead_##name)
#define STEP_CONTEXT FN(bead)
#ifdef REAL_FORCES_AHEAD
#define STEP_KNOWN(i) ((i) < FST_VX || ((i) >= FST_NX && (i) < FST_WX) || (i) == FST_STEP_TIME)
#define STEP_SLOWED(known, k)                                                                                  \
    _Pragma("GCC unroll 32") for (int i = 0; i < FST_STATE_SIZE; ++i) if (STEP_KNOWN(i) == (known))(k)[i] =    \
        (k)[FST_STEP_TIME] * (k)[i]

/* The derivatives by theta that follow from the state at a stage alone: those of the place, of n and of time.
 */
static inline void FN(known_derivatives)(FN(bead) * bead, REAL drive, const REAL *y, REAL *k)
{
    FN(kinematics)(drive, y, k);
#if KNOWS_DRY
    if (bead->world.kinds.modes) {
        k[FST_STEP_TIME] = FN(pace)(&bead->world, &bead->modes, y);
        STEP_SLOWED(1, k);
    }
#else
    (void)bead;
#endif
}

/* Turn the other derivatives, which are by the time, into those by theta. */
static inline void FN(slow_others)(const FN(bead) * bead, REAL *k)
{
#if KNOWS_DRY
    if (bead->world.kinds.modes)
        STEP_SLOWED(0, k);
#else
    (void)bead, (void)k;
#endif
}

#define STEP_KINEMATICS(s, drive, j)                                                                           \
    FN(known_derivatives)(&(s)->context, drive, (s)->stage[(j)-1], (s)->k[(j)-1])
#define STEP_FORCES(s, j)                                                                                      \
    FN(magnetic_pull)                                                                                          \
    (&(s)->context.world, MODES_OF(&(s)->context), (s)->stage[(j)-1], &(s)->context.pull[(j)-1])
#define STEP_DYNAMICS(s, drive, j)                                                                             \
    do {                                                                                                       \
        FN(dynamics)                                                                                           \
        (&(s)->context.world, MODES_OF(&(s)->context), drive, (s)->stage[(j)-1], &(s)->context.pull[(j)-1],    \
         (s)->k[(j)-1]);                                                                                       \
        FN(slow_others)(&(s)->context, (s)->k[(j)-1]);                                                         \
    } while (0)
#define STEP_FORCES_AND_DYNAMICS(s, next, drive, j)                                                            \
    do {                                                                                                       \
        FN(pull_and_dynamics)                                                                                  \
        (&(s)->context.world, MODES_OF(&(s)->context), (s)->stage[(next)-1], &(s)->context.pull[(next)-1],     \
         drive, (s)->stage[(j)-1], &(s)->context.pull[(j)-1], (s)->k[(j)-1]);                                  \
        FN(slow_others)(&(s)->context, (s)->k[(j)-1]);                                                         \
    } while (0)
#else
#define STEP_DERIVATIVES(s, drive, j)                                                                          \
    FN(bead_rhs)                                                                                               \
    (&(s)->context, STEP_DRIVE(s, drive, (s)->stage[(j)-1]), (s)->stage[(j)-1], (s)->k[(j)-1],                 \
     &(s)->context.pull[(j)-1])
#endif

/* The drive where a motion has the numbers y: `by_theta` is what it is where theta is the time.  On a ramp
 * under a law with modes it follows the step's own time.  (Lanes have no ramps.) */
#undef STEP_DRIVE
#ifdef REAL_IS_SCALAR
#define STEP_DRIVE(s, by_theta, y)                                                                             \
    ((s)->context.world.kinds.modes && (s)->ramp != R(0.0) ? (s)->omega + (s)->ramp * (y)[FST_STEP_TIME]       \
                                                           : (by_theta))
#else
#define STEP_DRIVE(s, by_theta, y) (by_theta)
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

/* Take the slip, which rounding brings in, out of a state that rolls: where `mask` holds. */
static inline void FN(stop_slip)(const FN(world) * c, REAL_MASK mask, REAL *y)
{
    y[FST_VX] = REAL_SELECT(mask, c->eps * y[FST_WY], y[FST_VX]);
    y[FST_VY] = REAL_SELECT(mask, -(c->eps * y[FST_WX]), y[FST_VY]);
}

#ifdef REAL_IS_SCALAR
/* Take the rotation out of a state that does not roll, which keeps its slip. */
static inline void FN(stop_rolling)(const FN(world) * c, REAL *y)
{
    y[FST_VX] -= c->eps * y[FST_WY];
    y[FST_VY] += c->eps * y[FST_WX];
    y[FST_WX] = y[FST_WY] = R(0.0);
}

/* Change the slip by an impulse of the plate: the moment about the contact stays what it was. */
static inline void FN(set_slip)(const FN(world) * c, REAL *y, const REAL slip[2])
{
    REAL before[2];
    FN(slip)(c, y, before);
    const REAL change[2] = {slip[0] - before[0], slip[1] - before[1]};
    y[FST_VX] += c->share * change[0];
    y[FST_VY] += c->share * change[1];
    y[FST_WX] += c->spin_up * change[1];
    y[FST_WY] -= c->spin_up * change[0];
    if (slip[0] == R(0.0) && slip[1] == R(0.0))
        FN(stop_slip)(c, REAL_EVERYWHERE, y);
}
#endif

/* Take out of a state what its modes do not allow: the slip and, on a disc, the pivoting of a contact that
 * sticks, and the rotation of a bead that rests. */
static inline void FN(stop_what_is_held)(const FN(world) * c, const FN(modes) * m, REAL *y)
{
#ifdef REAL_IS_SCALAR
    if (c->kinds.resists && FN(rests)(m))
        FN(stop_rolling)(c, y);
#endif
    const REAL_MASK sticks = REAL_LESS(R(0.5), FN(sticks)(c, m));
    if (!HAS(c->kinds, dry) || !REAL_ANY(sticks))
        return;
    FN(stop_slip)(c, sticks, y);
    if (HAS(c->kinds, patch))
        y[FST_WZ] = REAL_SELECT(sticks, R(0.0), y[FST_WZ]);
}

/* Evaluate stage `j` of the step, counted from 1, where the drive is `by_theta` if theta is the time. */
static inline void FN(evaluate_stage)(FN(bead_step) * s, REAL by_theta, int j)
{
    const REAL *y = s->stage[j - 1];
    FN(bead_rhs)(&s->context, STEP_DRIVE(s, by_theta, y), y, s->k[j - 1], &s->context.pull[j - 1]);
}

/* The end of an accepted step: n is renormalised, and stage 13, the first of the next step, is evaluated. */
static inline REAL FN(finish_step)(FN(bead_step) * s)
{
    const REAL drift = FN(renormalise)(s->end);
#if KNOWS_DRY
    FN(stop_what_is_held)(&s->context.world, &s->context.modes, s->end);
#endif
    for (int i = 0; i < BEAD_NUMBERS; ++i)
        s->stage[12][i] = s->end[i];
    FN(evaluate_stage)(s, s->omega + s->h * s->ramp, 13);
    return drift;
}

/* Make the end of the last step the start of the next, in the lanes of `mask`. */
static inline void FN(next_step_where)(FN(bead_step) * s, REAL_MASK mask)
{
    for (int i = 0; i < BEAD_NUMBERS; ++i) {
        s->y[i] = s->stage[0][i] = REAL_SELECT(mask, s->end[i], s->y[i]);
        s->k[0][i] = REAL_SELECT(mask, s->k[12][i], s->k[0][i]);
    }
#if KNOWS_DRY
    s->y[FST_STEP_TIME] = s->stage[0][FST_STEP_TIME] = R(0.0);
#endif
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
#if KNOWS_DRY
    s->y[FST_STEP_TIME] = R(0.0);
#endif
    for (int i = 0; i < BEAD_NUMBERS; ++i)
        s->stage[0][i] = s->y[i];
    FN(evaluate_stage)(s, s->omega, 1);
}
