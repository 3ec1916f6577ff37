/* integrals.inl - time integrals along a trajectory, with the integrator's own stages, over REAL: one run is
 * this over double, lanes are this over wide values.  The including file brings the bodies of the model,
 * base/twofold.inl and path.inl.
 *
 * The method makes a step from the derivatives at its stages:  y1 = y0 + h sum(b_j k_j).  Any quantity q that
 * can be read off the state at a stage is integrated by the same weights,
 *
 *     Q1 = Q0 + h sum(b_j q(stage j)),
 *
 * as if Q were one more component of the state with the derivative q.  It costs no evaluation of the field: the
 * stages and the magnet's pull at them are there already.
 *
 *     y0 o----x--x-x----------x-x-------x------o y1      the places of a step (ode/path.h)
 *        q    q  q q          q q       q      q         the integrands there
 *
 * Squares of deviations are integrated from a reference value near the mean: of <(r - r0)^2> - <r - r0>^2 few
 * digits are lost, where <r^2> - <r>^2 would lose them all for an orbit that is nearly round.
 */

#undef SUMMED
#if KNOWS_DRY
#define SUMMED FST_Q_COUNT
#else
#define SUMMED FST_Q_OTHERS
#endif

/* The integrals of one trajectory, or of one in each lane.  Members are REALs only: lanes are copied as
 * numbers. */
typedef struct FN(integrals) {
    FN(twofold) total[FST_Q_COUNT]; /* up to the start of the last step */
    REAL increment[FST_Q_COUNT];    /* and over it */
    REAL r_reference, b_reference;  /* r and |B| when the window began: deviations are taken from them */
    REAL integrands[FST_PATH_PLACES][FST_Q_COUNT];  /* at the places of the last step */
    REAL tracked[FST_PATH_PLACES][FST_TRACK_COUNT]; /* quantities whose extremes are looked for, there */
} FN(integrals);

/* A new step follows where `mask` holds: the increments belong to the past. */
static inline void FN(add_increments)(FN(integrals) * q, REAL_MASK mask)
{
    for (int i = 0; i < SUMMED; ++i) {
        const FN(twofold) sum = FN(twofold_add)(q->total[i], q->increment[i]);
        q->total[i].low = REAL_SELECT(mask, sum.low, q->total[i].low);
        q->total[i].high = REAL_SELECT(mask, sum.high, q->total[i].high);
    }
}

/* Look at one place of the step, where the drive is `omega`.  The references become the values there where
 * `renew` holds, which makes sense at the first place only. */
static inline void FN(look_at_place)(FN(integrals) * q, const FN(bead_step) * s, REAL omega, int place,
                                     REAL_MASK renew)
{
    const FN(world) *c = FST_WORLD(s);
    const FN(modes) *m = FST_MODES(s);
    const REAL *state = FST_PATH_STATE(s, place);
    const FN(pull) *pull = FST_PATH_PULL(s, place);
    FN(seen) seen;
    FN(see)(c, m, omega, state, pull, &seen);
    if (place == 0) {
        q->r_reference = REAL_SELECT(renew, seen.r, q->r_reference);
        q->b_reference = REAL_SELECT(renew, seen.b_norm, q->b_reference);
    }
    FN(integrands)(c, m, state, pull, &seen, q->r_reference, q->b_reference, q->integrands[place]);
#if KNOWS_DRY
    FN(pace_integrands)(s, place, FST_Q_COUNT, q->integrands[place]);
#endif
    q->tracked[place][FST_TRACK_R] = seen.r;
    q->tracked[place][FST_TRACK_B] = seen.b_norm;
    q->tracked[place][FST_TRACK_GAP] = seen.gap2;
    q->tracked[place][FST_TRACK_SLIP] = seen.slip2;
    q->tracked[place][FST_TRACK_LOAD] = seen.load;
}

/* The step's increments from the integrands at its places, where `mask` holds. */
static inline void FN(integrate_step)(FN(integrals) * q, const FN(bead_step) * s, REAL_MASK mask)
{
    for (int i = 0; i < SUMMED; ++i)
        q->increment[i] =
            REAL_SELECT(mask, FN(path_integral)(s, &q->integrands[0][i], FST_Q_COUNT), q->increment[i]);
}

/* The plane in which phi = atan2(n_alpha, -n_z) turns: both times r, so that no direction is needed on the
 * axis. */
static inline void FN(moment_angle_point)(const REAL *y, REAL *u, REAL *w)
{
    *u = -y[FST_NZ] * REAL_SQRT(y[FST_X] * y[FST_X] + y[FST_Y] * y[FST_Y]);
    *w = y[FST_X] * y[FST_NY] - y[FST_Y] * y[FST_NX];
}

/* Does a point that moves from a to b, nearly straight and evenly, pass the origin so closely that a rule with
 * few places does not resolve how its direction turns?
 *
 *        a o-----------+-------o b        the way, w long
 *            `  .      | b0   /
 *        |a|      `  . |   /   |b|
 *                      0
 *
 * Its distance from the origin is the root of a square with zeros where the way, continued to complex times,
 * has them.  An ellipse through these with the ends of the step as foci has half axes whose sum is rho times
 * half the step, and a rule of order p errs by about rho^-p.  |a| + |b| is w (rho + 1/rho)/2; here (|a| +
 * |b|)^2 is taken as 2 (a^2 + b^2), which is no smaller.
 */
static inline REAL FN(passage_measure)(const REAL a[2], const REAL b[2], REAL limit2)
{
    const REAL way[2] = {b[0] - a[0], b[1] - a[1]};
    const REAL sum2 = R(2.0) * (SUM_2(a[0], a[0], a[1], a[1]) + SUM_2(b[0], b[0], b[1], b[1]));
    return limit2 * SUM_2(way[0], way[0], way[1], way[1]) - sum2;
}

/* Positive where the method's rule, of order 8, errs by more than the tolerance of the steps: rho^8 < 1/rtol,
 * or (|a| + |b|)^2 < w^2 rtol^(-1/4)/4; at loose tolerances where the direction turns by a radian. */
static inline REAL FN(passes_closely)(const REAL a[2], const REAL b[2], REAL rtol)
{
    const REAL limit2 = REAL_MAX(R(0.25) / REAL_SQRT(REAL_SQRT(rtol)), R(4.0));
    return FN(passage_measure)(a, b, limit2);
}
