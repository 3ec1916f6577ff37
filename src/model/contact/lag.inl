/* lag.inl - a motion against friction that has just begun: its direction, over REAL.
 *
 * A velocity v of two components obeys v' = a - c v/|v|, with a push a and a resistance of the strength c that
 * is set-valued at v = 0: the slip of a contact under dry friction, or the rotation of a bead under rolling
 * resistance.  Where |a| grows past c the motion begins with no speed and hardly any acceleration.  Its
 * direction u follows a at the rate |a|/|v|, without bound, so that it cannot be integrated; but just therefore
 * it is known.  It lags behind a by an angle that is |v| times
 *
 *     lean = (rate at which a turns in space)/(2 |a| - c)
 *
 * and a correction in proportion to |v|; `lean` is given as a polynomial in the time since the release
 * (ode/onset.c).  Of a slip that creeps, which may be larger, the correction has a rate, and one in proportion to
 * |v|^2 follows.
 */
typedef struct FN(lag) {
    REAL slip;    /* how the angle over |v| grows with |v|, */
    REAL faster;  /* how that changes in time, */
    REAL curve;   /* and with |v| */
    REAL lean[3]; /* the polynomial in the time since the release */
    REAL since;   /* that time at the start of the step */
} FN(lag);

/* `lean` at a time after the start of the step. */
static inline REAL FN(lean_at)(const FN(lag) * q, REAL time)
{
    const REAL *p = q->lean, since = q->since + time;
    return REAL_MULADD(since, REAL_MULADD(since, p[2], p[1]), p[0]);
}

/* How the tangent of the angle over |v| grows with |v|, at that time, but for `curve`. */
static inline REAL FN(lag_slope)(const FN(lag) * q, REAL time)
{
    return REAL_MULADD(q->since + time, q->faster, q->slip);
}

/* The direction u of the velocity v under the push a, at a time after the start of the step. */
static inline void FN(lag_direction)(const FN(lag) * q, REAL time, const REAL a[2], const REAL v[2], REAL u[2])
{
    const REAL inverse_a = REAL_RECIPROCAL_SQRT(SUM_2(a[0], a[0], a[1], a[1]) + R(1e-290));
    const REAL ahead[2] = {a[0] * inverse_a, a[1] * inverse_a}; /* a/|a|, and u as it lags behind */
    const REAL along = SUM_2(v[0], ahead[0], v[1], ahead[1]);
    const REAL slope = REAL_MULADD(q->curve, along, FN(lag_slope)(q, time));
    const REAL lag = along * REAL_MULADD(slope, along, FN(lean_at)(q, time));
    const REAL inverse_u = REAL_RECIPROCAL_SQRT(R(1.0) + lag * lag);
    u[0] = (ahead[0] + lag * ahead[1]) * inverse_u;
    u[1] = (ahead[1] - lag * ahead[0]) * inverse_u;
}

/* The change of a force `dry` u as v, a and `dry` change: the direction of a turns, and u lags behind by
 * another speed.  `lean` is that of the release. */
static inline void FN(lag_change)(const FN(lag) * q, REAL time, const REAL a[2], const REAL v[2],
                                  const REAL da[2], const REAL dv[2], REAL dry, REAL ddry, REAL change[2])
{
    const REAL inverse_a = REAL_RECIPROCAL_SQRT(SUM_2(a[0], a[0], a[1], a[1]) + R(1e-290));
    const REAL ahead[2] = {a[0] * inverse_a, a[1] * inverse_a};
    const REAL turned = SUM_2(ahead[0], da[1], -ahead[1], da[0]) * inverse_a; /* angle of a */
    const REAL along = SUM_2(v[0], ahead[0], v[1], ahead[1]), across = SUM_2(ahead[0], v[1], -ahead[1], v[0]);
    const REAL dalong = SUM_2(dv[0], ahead[0], dv[1], ahead[1]) + across * turned;
    const REAL lean = FN(lean_at)(q, time), slope = FN(lag_slope)(q, time), bend = q->curve * along;
    const REAL lag = along * REAL_MULADD(slope + bend, along, lean);
    const REAL dlag = dalong * REAL_MULADD(R(2.0) * slope + R(3.0) * bend, along, lean);
    const REAL inverse_u = REAL_RECIPROCAL_SQRT(R(1.0) + lag * lag);
    const REAL u[2] = {(ahead[0] + lag * ahead[1]) * inverse_u, (ahead[1] - lag * ahead[0]) * inverse_u};
    const REAL turning = dry * (turned - dlag * inverse_u * inverse_u); /* the lag is the tangent of an angle */
    change[0] = ddry * u[0] - turning * u[1];
    change[1] = ddry * u[1] + turning * u[0];
}
