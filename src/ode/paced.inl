/* paced.inl - steps under a law with modes, over REAL: how good one is, how long it takes, and whether it may
 * be the last of its mode.  The reasons are in pace.c and contact.c; lanes ask the same questions of all their
 * steps at once.  The including file brings bead_step.inl and path.inl.
 */
#ifndef PACED_LEAST_DIGITS
#define PACED_LEAST_DIGITS 0.03    /* relative error of V or W_h that a step may make */
#define PACED_LEAST_FALL 1e-12     /* below this slip, or the tolerance, rounding may end it: */
#define PACED_ROUNDING 2e-15       /* of a slip, over the speeds whose difference it is */
#define PACED_GREATEST_CREEP 0.005 /* a slip below this that changes by no more than this part in a step */
#define PACED_CREEPS 0.125         /* may creep */
#define PACED_TIGHTER 10.0         /* while a contact sticks, the tolerance is smaller by this factor, */
#define PACED_TIGHTEST 1e-13       /* but not below this */
#endif

/* ------------------------------------------------------------------ how good a step is */

/* The embedded errors of the slip and of W_h in a step, as dop853.inl has them for the whole state. */
static inline void FN(contact_errors)(const FN(bead_step) * s, REAL *of_slip, REAL *of_roll)
{
    static const int slot[8] = {0, 5, 6, 7, 8, 9, 10, 11};
    const REAL fifth[8] = {DOP_E5_1, DOP_E5_6, DOP_E5_7, DOP_E5_8, DOP_E5_9, DOP_E5_10, DOP_E5_11, DOP_E5_12};
    REAL error[FST_STATE_SIZE], slip[2];
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        error[i] = R(0.0);
    for (int i = FST_VX; i < FST_STATE_SIZE; ++i)
        if (i < FST_NX || i >= FST_WX)
            for (int j = 0; j < 8; ++j)
                error[i] += s->h * fifth[j] * s->k[slot[j]][i];
    FN(slip)(FST_WORLD(s), error, slip);
    *of_slip = FN(norm_2)(slip);
    *of_roll = FN(norm_2)(error + FST_WX);
}

/* Where the plate resists rolling (ode/rest.c), the mask of a bead that rolls, in a time of its own. */
static inline REAL_MASK FN(rolls_in_theta)(const FN(bead_step) * s)
{
    const FN(modes) *m = FST_MODES(s);
    const REAL mode = REAL_SELECT(FN(in_flight)(m), R(1.0), m->rolling);
    return FN(is_moving)(HAS(FST_WORLD(s)->kinds, resists) ? mode : R(1.0));
}

/* The error of a step over its tolerance, where a contact sticks.  Friction then takes no power, so that nothing damps
 * what errors of steps do to the energy and to other swings: they add up, and the next slip does not undo them. */
static inline REAL FN(lasting_error)(const FN(bead_step) * s, REAL rtol, REAL error)
{
    const REAL room = REAL_MAX(rtol / R(PACED_TIGHTEST), R(1.0));
    const REAL tighter = REAL_SELECT(REAL_LESS(room, R(PACED_TIGHTER)), room, R(PACED_TIGHTER));
    return error * REAL_SELECT(REAL_LESS(R(0.5), FN(sticks)(FST_WORLD(s), FST_MODES(s))), tighter, R(1.0));
}

/* The error of a step over its tolerance, from `error`, that of the whole state: a slip keeps some digits, and
 * so does a rotation that a plate resists. */
static inline REAL FN(paced_error)(const FN(bead_step) * s, REAL error)
{
    const FN(world) *c = FST_WORLD(s);
    const FN(modes) *m = FST_MODES(s);
    const REAL_MASK slips = FN(is_moving)(m->contact), rolls = FN(rolls_in_theta)(s);
    REAL start[2], end[2], slip_error, roll_error;
    if (!REAL_ANY(slips) && !REAL_ANY(rolls))
        return error;
    FN(contact_errors)(s, &slip_error, &roll_error);
    FN(slip)(c, s->y, start);
    FN(slip)(c, s->end, end);
    const REAL first = FN(contact_motion_2)(c, m, start, s->y[FST_WZ]);
    const REAL last = FN(contact_motion_2)(c, m, end, s->end[FST_WZ]);
    const REAL least = REAL_SELECT(REAL_LESS(last, first), last, first);
    const REAL of_slip = slip_error / (R(PACED_LEAST_DIGITS) * REAL_SQRT(least));
    const REAL with_slip = REAL_SELECT(slips, REAL_MAX(of_slip, error), error);
    if (!REAL_ANY(rolls))
        return with_slip;
    const REAL w1 = FN(norm_2)(s->y + FST_WX), w2 = FN(norm_2)(s->end + FST_WX);
    const REAL of_roll = roll_error / (R(PACED_LEAST_DIGITS) * REAL_SELECT(REAL_LESS(w2, w1), w2, w1));
    return REAL_SELECT(rolls, REAL_MAX(of_roll, with_slip), with_slip);
}

/* ------------------------------------------------------------------ how long it takes */

/* The mask of a step that measures its own time. */
static inline REAL_MASK FN(measures_time)(const FN(bead_step) * s)
{
    const REAL slips = REAL_SELECT(FN(is_moving)(FST_MODES(s)->contact), R(1.0), R(0.0));
    return REAL_LESS(R(0.5), REAL_SELECT(FN(rolls_in_theta)(s), R(1.0), slips));
}

static inline REAL FN(paced_time)(const FN(bead_step) * s)
{
    return REAL_SELECT(FN(measures_time)(s), s->end[FST_STEP_TIME], s->h);
}

/* ------------------------------------------------------------------ whether its mode ends */

/* Whether a slip is so small, and has changed so little in a step, that it may creep (ode/creep.c). */
static inline REAL_MASK FN(slip_may_creep)(const FN(bead_step) * s)
{
    REAL before[2], after[2];
    FN(slip)(FST_WORLD(s), s->y, before);
    FN(slip)(FST_WORLD(s), s->end, after);
    const REAL size = FN(norm_2)(after), change = REAL_ABS(size - FN(norm_2)(before));
    const REAL small = REAL_SELECT(REAL_LESS(size, R(PACED_GREATEST_CREEP)), R(PACED_CREEPS) * size, R(0.0));
    return REAL_LESS(change, small);
}

/* Whether a slip is nearly nothing at the end of a step.  It may fall so slowly, because the push is nearly as
 * strong as friction, that rounding of the velocities keeps it as it is. */
static inline REAL_MASK FN(slip_is_over)(const FN(bead_step) * s, REAL rtol)
{
    const REAL *y = s->y, eps = FST_WORLD(s)->eps;
    REAL before[2], after[2];
    FN(slip)(FST_WORLD(s), y, before);
    FN(slip)(FST_WORLD(s), s->end, after);
    const REAL speeds =
        REAL_ABS(y[FST_VX]) + REAL_ABS(y[FST_VY]) + eps * (REAL_ABS(y[FST_WX]) + REAL_ABS(y[FST_WY]));
    const REAL size = FN(norm_2)(after), change = REAL_ABS(size - FN(norm_2)(before));
    const REAL slow = REAL_MAX(rtol, R(PACED_LEAST_FALL)), captured = FN(captured)(rtol);
    const REAL stays = REAL_SELECT(REAL_LESS_EQUAL(change, R(PACED_ROUNDING) * speeds), slow, R(0.0));
    const REAL far = REAL_SELECT(REAL_LESS(size, stays), R(0.0), R(1.0));
    return REAL_LESS_EQUAL(REAL_SELECT(REAL_LESS(captured, size), far, R(0.0)), R(0.5));
}
