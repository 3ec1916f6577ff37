/* resistance.inl - the torque with which a plate resists rolling, over REAL: rho N against the horizontal
 * rotation W_h, where rho = c_rr eps is its arm.
 *
 * Like friction it is set-valued: a bead that does not roll, W_h = 0, gets any torque up to rho N, just what it
 * needs.  With the balance T = (tau + eps e x f)_h of the torque per mass that the magnet and the plate's force
 * exert about the middle of a bead that does not roll,
 *
 *     mode    while                 m
 *     rolls   W_h != 0              -rho N W_h/|W_h|
 *     rests   |T| <= rho N          -T:  W_h stays 0
 *     starts  just released         -rho N u, u near T/|T| (lag.inl)
 *
 * This goes beside slip and stick of the contact (coulomb.inl): a bead that neither rolls nor slips is at rest,
 * though it may pivot about the vertical; one that slips and rests is pushed over the plate without rolling.
 */
typedef struct FN(resistance) {
    REAL arm;     /* rho */
    REAL usual_2; /* square of a usual rotation, of the pace */
} FN(resistance);

static inline FN(resistance) FN(make_resistance)(const fst_params *params, const fst_groups *g)
{
    const FN(resistance) made = {
        .arm = REAL_OF(params->friction_rolling_resistance) * REAL_OF(g->eps),
        .usual_2 = R(0.0025),
    };
    return made;
}

static inline REAL_MASK FN(rests)(const FN(modes) * m)
{
    return FN(is_mode)(m->rolling, FST_ROLL_RESTS);
}

/* Whether a bead (in some lane) does not just roll: what only the other modes need is not computed else. */
static inline int FN(resist_asks_balance)(const FN(modes) * m)
{
    return REAL_ANY(REAL_LESS(R(0.5), m->rolling));
}

/* Its torque per mass at the rotation W, the load N and the balance T. */
static inline void FN(resist)(const FN(resistance) * q, const FN(modes) * m, REAL time, const REAL w[3],
                              REAL load, const REAL balance[2], REAL torque[3])
{
    const REAL inverse = REAL_RECIPROCAL_SQRT(SUM_2(w[0], w[0], w[1], w[1]) + R(1e-290));
    const REAL most = q->arm * REAL_MAX(load, R(0.0)), factor = -(most * inverse);
    torque[0] = factor * w[0];
    torque[1] = factor * w[1];
    torque[2] = R(0.0);
    if (!FN(resist_asks_balance)(m))
        return;
    const REAL_MASK rolls = FN(is_moving)(m->rolling), rests = FN(rests)(m);
    REAL u[2];
    FN(lag_direction)(&m->start, time, balance, w, u);
    for (int i = 0; i < 2; ++i) {
        const REAL starting = -(most * u[i]);
        torque[i] = REAL_SELECT(rests, -balance[i], REAL_SELECT(rolls, torque[i], starting));
    }
}

/* Its change as W, N and T change. */
static inline void FN(resist_change)(const FN(resistance) * q, const FN(modes) * m, REAL time, const REAL w[3],
                                     REAL load, const REAL balance[2], const REAL dw[3], REAL dload,
                                     const REAL dbalance[2], REAL change[3])
{
    const REAL inverse = REAL_RECIPROCAL_SQRT(SUM_2(w[0], w[0], w[1], w[1]) + R(1e-290));
    const REAL most = q->arm * REAL_MAX(load, R(0.0));
    const REAL dmost = q->arm * REAL_SELECT(REAL_LESS(R(0.0), load), dload, R(0.0));
    const REAL u[2] = {w[0] * inverse, w[1] * inverse};
    const REAL turning = most * inverse * SUM_2(u[0], dw[1], -u[1], dw[0]);
    change[0] = turning * u[1] - dmost * u[0];
    change[1] = -(dmost * u[1] + turning * u[0]);
    change[2] = R(0.0);
    if (!FN(resist_asks_balance)(m))
        return;
    const REAL_MASK rolls = FN(is_moving)(m->rolling), rests = FN(rests)(m);
    REAL starting[2];
    FN(lag_change)(&m->start, time, balance, w, dbalance, dw, most, dmost, starting);
    for (int i = 0; i < 2; ++i)
        change[i] = REAL_SELECT(rests, -dbalance[i], REAL_SELECT(rolls, change[i], -starting[i]));
}

/* The power that it takes. */
static inline REAL FN(resistance_loss)(const FN(resistance) * q, const REAL w[3], REAL load)
{
    return q->arm * REAL_MAX(load, R(0.0)) * REAL_SQRT(SUM_2(w[0], w[0], w[1], w[1]));
}

/* dt/dtheta of a bead that rolls, and its change along dw: as that of a slip (coulomb.inl), so that a rotation
 * that dies in a finite time decays exponentially. */
static inline REAL FN(resistance_pace)(const FN(resistance) * q, REAL mode, const REAL w[3])
{
    const REAL w2 = SUM_2(w[0], w[0], w[1], w[1]), pace = REAL_SQRT(w2 / (w2 + q->usual_2));
    return REAL_SELECT(FN(is_moving)(mode), pace, R(1.0));
}

static inline REAL FN(resistance_pace_change)(const FN(resistance) * q, REAL mode, const REAL w[3],
                                              const REAL dw[3])
{
    const REAL w2 = SUM_2(w[0], w[0], w[1], w[1]), whole = w2 + q->usual_2;
    const REAL by =
        SUM_2(w[0], dw[0], w[1], dw[1]) * q->usual_2 * REAL_RECIPROCAL_SQRT((w2 + R(1e-290)) * whole) / whole;
    return REAL_SELECT(FN(is_moving)(mode), by, R(0.0));
}
