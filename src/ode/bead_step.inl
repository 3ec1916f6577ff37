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
 * then those by theta.  The pace is kept at every stage too: its integral over the step is the time that
 * passes.  Under other laws theta is t, and none of this is done.
 *
 * Flight.  A bead in the air (ode/flight.c) has a height and a climb besides.  They are no part of the state,
 * but are carried through the stages by the same weights, and the source is raised to each stage's height.
 */
#include "ode/dop853_tableau.h"

#if KNOWS_DRY
/* The method's weights as a table; all lanes share it. */
#ifdef REAL_IS_SCALAR
static const REAL FN(stage_weights)[16][15] = DOP_WEIGHTS;
#else
#pragma push_macro("R")
#undef R
#define R(literal) literal
static const double FN(stage_weights)[16][15] = DOP_WEIGHTS;
#pragma pop_macro("R")
#endif
#endif

#ifdef REAL_IS_SCALAR
typedef struct FN(flight) {
    fst_params params; /* of which the source of another height is made */
    fst_groups groups;
    REAL start[2];                        /* height and climb at the start of a step */
    REAL height[16], climb[16], lift[16]; /* z, z' and z'' at its stages */
} FN(flight);
#endif

typedef struct FN(bead) {
    FN(coefficients) coefficients;
    FN(pull) pull[16]; /* at the stages */
#if KNOWS_DRY
    REAL pace[16]; /* and dt/dtheta, under a law with modes */
#endif
#ifdef REAL_IS_SCALAR
    FN(flight) flight;
#endif
} FN(bead);

/* ------------------------------------------------------------------ the step's own time */

#if KNOWS_DRY
/* The time since the start of a step of the size h (in theta) at one of its stages, by the method's own
 * weights.
 */
static inline REAL FN(stage_time)(const FN(bead) * bead, REAL h, int stage)
{
    REAL sum = R(0.0);
    for (int i = 0; i < 15 && i < stage; ++i)
        sum += REAL_OF(FN(stage_weights)[stage][i]) * bead->pace[i];
    return h * sum;
}

/* What the law needs to know about the time at a stage. */
static inline void FN(lean_at_stage)(FN(bead) * bead, REAL h, int stage)
{
    FN(coefficients) *c = &bead->coefficients;
    if (c->kinds.paced && REAL_ANY(FN(coulomb_begins)(&c->law.coulomb)))
        FN(lag_at)(&c->law.coulomb.lag, FN(stage_time)(bead, h, stage));
    if (HAS(c->kinds, resists) && REAL_ANY(FN(starts_to_roll)(&c->resistance)))
        FN(lag_at)(&c->resistance.lag, FN(stage_time)(bead, h, stage));
}
#endif

#define STEP_DIM FST_STATE_SIZE
#define STEP_NAME(name) FN(bead_##name)
#define STEP_CONTEXT FN(bead)
#ifdef REAL_FORCES_AHEAD
#define STEP_KNOWN(i) ((i) < FST_VX || ((i) >= FST_NX && (i) < FST_WX)) /* the place and n */
#define STEP_SLOWED(bead, known, stage, k)                                                                     \
    _Pragma("GCC unroll 32") for (int i = 0; i < FST_STATE_SIZE; ++i) if (STEP_KNOWN(i) == (known))(k)[i] =    \
        (bead)->pace[stage] * (k)[i]

/* The derivatives by theta that follow from the state at a stage alone, and the pace there. */
static inline void FN(known_derivatives)(FN(bead) * bead, REAL h, REAL drive, const REAL *y, int stage, REAL *k)
{
    FN(kinematics)(drive, y, k);
#if KNOWS_DRY
    FN(lean_at_stage)(bead, h, stage);
    if (bead->coefficients.kinds.paced) {
        bead->pace[stage] = FN(pace)(&bead->coefficients, y);
        STEP_SLOWED(bead, 1, stage, k);
    }
#else
    (void)bead, (void)h, (void)stage;
#endif
}

/* The others, of which the derivatives by the time are there. */
static inline void FN(slow_others)(const FN(bead) * bead, int stage, REAL *k)
{
#if KNOWS_DRY
    if (bead->coefficients.kinds.paced)
        STEP_SLOWED(bead, 0, stage, k);
#else
    (void)bead, (void)stage, (void)k;
#endif
}

#define STEP_KINEMATICS(s, drive, j)                                                                           \
    FN(known_derivatives)(&(s)->context, (s)->h, drive, (s)->stage[(j)-1], (j)-1, (s)->k[(j)-1])
#define STEP_FORCES(s, j)                                                                                      \
    FN(magnetic_pull)(&(s)->context.coefficients, (s)->stage[(j)-1], &(s)->context.pull[(j)-1])
#define STEP_DYNAMICS(s, drive, j)                                                                             \
    do {                                                                                                       \
        FN(dynamics)                                                                                           \
        (&(s)->context.coefficients, drive, (s)->stage[(j)-1], &(s)->context.pull[(j)-1], (s)->k[(j)-1]);      \
        FN(slow_others)(&(s)->context, (j)-1, (s)->k[(j)-1]);                                                  \
    } while (0)
#define STEP_FORCES_AND_DYNAMICS(s, next, drive, j)                                                            \
    do {                                                                                                       \
        FN(pull_and_dynamics)                                                                                  \
        (&(s)->context.coefficients, (s)->stage[(next)-1], &(s)->context.pull[(next)-1], drive,                \
         (s)->stage[(j)-1], &(s)->context.pull[(j)-1], (s)->k[(j)-1]);                                         \
        FN(slow_others)(&(s)->context, (j)-1, (s)->k[(j)-1]);                                                  \
    } while (0)
#elif defined REAL_IS_SCALAR
/* Whether the bead is in the air, and the source as it is for a bead that is z over the plate. */
static inline int FN(is_in_flight)(const FN(coefficients) * c)
{
    return c->kinds.flies && FN(in_flight)(c);
}

static inline void FN(raise_source)(FN(bead) * bead, REAL z)
{
    fst_groups groups = bead->flight.groups;
    groups.h = (double)(REAL_OF(groups.h) + z);
    bead->coefficients.source =
        FN(make_source_numbers)(&bead->coefficients.kinds, &bead->flight.params, &groups);
}

/* Height and climb at a stage of a step of the size h. */
static inline void FN(rise)(FN(bead) * bead, REAL h, int stage)
{
    FN(flight) *flight = &bead->flight;
    REAL height = R(0.0), climb = R(0.0);
    for (int i = 0; i < 15 && i < stage; ++i) {
        height += FN(stage_weights)[stage][i] * flight->climb[i];
        climb += FN(stage_weights)[stage][i] * flight->lift[i];
    }
    flight->height[stage] = flight->start[0] + h * height;
    flight->climb[stage] = flight->start[1] + h * climb;
    FN(raise_source)(bead, flight->height[stage]);
}

/* The derivative of the state `y` by theta at a stage of a step of the size h. */
static inline void FN(paced_rhs)(FN(bead) * bead, REAL h, REAL drive, const REAL *y, int stage, REAL *k)
{
    FN(coefficients) *c = &bead->coefficients;
    if (FN(is_in_flight)(c))
        FN(rise)(bead, h, stage);
    FN(lean_at_stage)(bead, h, stage);
    FN(rhs)(c, drive, y, k, &bead->pull[stage]);
    if (!c->kinds.paced)
        return;
    bead->flight.lift[stage] = bead->pull[stage].force[2] - c->gravity;
    const REAL pace = bead->pace[stage] = FN(pace)(c, y);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        k[i] = pace * k[i];
}

/* The drive there: `drive` is what it is where theta is t. */
static inline REAL FN(stage_drive)(const FN(bead) * bead, REAL h, REAL omega, REAL ramp, REAL drive, int stage)
{
    return bead->coefficients.kinds.paced && ramp != R(0.0) ? omega + ramp * FN(stage_time)(bead, h, stage)
                                                            : drive;
}

#define STEP_DERIVATIVES(s, drive, j)                                                                          \
    FN(paced_rhs)                                                                                              \
    (&(s)->context, (s)->h, FN(stage_drive)(&(s)->context, (s)->h, (s)->omega, (s)->ramp, drive, (j)-1),       \
     (s)->stage[(j)-1], (j)-1, (s)->k[(j)-1])
#else
#define STEP_DERIVATIVES(s, drive, j)                                                                          \
    FN(paced_rhs)(&(s)->context, (s)->h, drive, (s)->stage[(j)-1], (j)-1, (s)->k[(j)-1])
#endif

#ifndef REAL_IS_SCALAR
/* The derivative of the state `y` by theta at a stage of a step of the size h. */
static inline void FN(paced_rhs)(FN(bead) * bead, REAL h, REAL drive, const REAL *y, int stage, REAL *k)
{
#if KNOWS_DRY
    FN(lean_at_stage)(bead, h, stage);
#else
    (void)h;
#endif
    FN(rhs)(&bead->coefficients, drive, y, k, &bead->pull[stage]);
#if KNOWS_DRY
    if (!bead->coefficients.kinds.paced)
        return;
    const REAL pace = bead->pace[stage] = FN(pace)(&bead->coefficients, y);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        k[i] = pace * k[i];
#endif
}
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
static inline void FN(stop_slip)(const FN(coefficients) * c, REAL_MASK mask, REAL *y)
{
    y[FST_VX] = REAL_SELECT(mask, c->eps * y[FST_WY], y[FST_VX]);
    y[FST_VY] = REAL_SELECT(mask, -(c->eps * y[FST_WX]), y[FST_VY]);
}

#ifdef REAL_IS_SCALAR
/* Take the rotation out of a state that does not roll, which keeps its slip. */
static inline void FN(stop_rolling)(const FN(coefficients) * c, REAL *y)
{
    y[FST_VX] -= c->eps * y[FST_WY];
    y[FST_VY] += c->eps * y[FST_WX];
    y[FST_WX] = y[FST_WY] = R(0.0);
}

/* Change the slip by an impulse of the plate: the moment about the contact stays what it was. */
static inline void FN(set_slip)(const FN(coefficients) * c, REAL *y, const REAL slip[2])
{
    REAL before[2];
    FN(slip)(c, y, before);
    const REAL change[2] = {slip[0] - before[0], slip[1] - before[1]};
    y[FST_VX] += R(2.0) / R(7.0) * change[0];
    y[FST_VY] += R(2.0) / R(7.0) * change[1];
    y[FST_WX] += R(5.0) / (R(7.0) * c->eps) * change[1];
    y[FST_WY] -= R(5.0) / (R(7.0) * c->eps) * change[0];
    if (slip[0] == R(0.0) && slip[1] == R(0.0))
        FN(stop_slip)(c, REAL_EVERYWHERE, y);
}
#endif

/* Take the slip out of a state that rolls by its law, and of a bead that is held on a disc the pivoting. */
static inline void FN(stop_contact)(const FN(coefficients) * c, REAL *y)
{
    const REAL_MASK sticks = REAL_LESS(R(0.5), FN(sticks)(c));
    if (!REAL_ANY(sticks))
        return;
    FN(stop_slip)(c, sticks, y);
    if (HAS(c->kinds, patch))
        y[FST_WZ] = REAL_SELECT(sticks, R(0.0), y[FST_WZ]);
}

/* The end of an accepted step: n is renormalised, and stage 13, the first of the next step, is evaluated. */
static inline REAL FN(finish_step)(FN(bead_step) * s)
{
    const REAL drift = FN(renormalise)(s->end);
#ifdef REAL_IS_SCALAR
    if (s->context.coefficients.kinds.resists && FN(rests)(&s->context.coefficients.resistance))
        FN(stop_rolling)(&s->context.coefficients, s->end);
#endif
#if KNOWS_DRY
    if (HAS(s->context.coefficients.kinds, dry))
        FN(stop_contact)(&s->context.coefficients, s->end);
#endif
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        s->stage[12][i] = s->end[i];
#ifdef REAL_IS_SCALAR
    const REAL drive = FN(stage_drive)(&s->context, s->h, s->omega, s->ramp, s->omega + s->h * s->ramp, 12);
#else
    const REAL drive = s->omega + s->h * s->ramp;
#endif
    FN(paced_rhs)(&s->context, s->h, drive, s->end, 12, s->k[12]);
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
#if KNOWS_DRY
    s->context.pace[0] = REAL_SELECT(mask, s->context.pace[12], s->context.pace[0]);
#endif
#ifdef REAL_IS_SCALAR
    if (FN(is_in_flight)(&s->context.coefficients)) {
        FN(flight) *flight = &s->context.flight;
        flight->start[0] = flight->height[0] = flight->height[12];
        flight->start[1] = flight->climb[0] = flight->climb[12];
        flight->lift[0] = flight->lift[12];
    }
#endif
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
    FN(paced_rhs)(&s->context, R(0.0), s->omega, s->y, 0, s->k[0]);
}
