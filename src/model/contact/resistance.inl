/* resistance.inl - the torque with which a plate resists rolling, over REAL: rho N against the horizontal
 * rotation, m = -rho N W_h/|W_h|, where rho = c_rr eps is its arm.
 *
 * The direction of W_h is not defined where the bead does not roll at all.  A bead that comes to rest is slowed
 * over rotations below `rest`, which is far below those of any motion, instead of being held.  It grows with a
 * resistance that is stronger than any plate's, so that the rate of slowing, on which the size of steps
 * depends, stays within bounds.
 */
typedef struct FN(resistance) {
    REAL arm;    /* rho */
    REAL rest_2; /* square of that rotation */
} FN(resistance);

static inline FN(resistance) FN(make_resistance)(const fst_params *params, const fst_groups *g)
{
    const double strong = 1e-4 * params->friction_rolling_resistance, rest = strong > 1e-6 ? strong : 1e-6;
    const FN(resistance)
        made = {REAL_OF(params->friction_rolling_resistance) * REAL_OF(g->eps), REAL_OF(rest * rest)};
    return made;
}

/* Its torque per mass at the rotation W and the load N. */
static inline void FN(resist)(const FN(resistance) * q, const REAL w[3], REAL load, REAL torque[3])
{
    const REAL size2 = SUM_2(w[0], w[0], w[1], w[1]) + q->rest_2;
    const REAL factor = -(q->arm * REAL_MAX(load, R(0.0)) * REAL_RECIPROCAL_SQRT(size2));
    torque[0] = factor * w[0];
    torque[1] = factor * w[1];
    torque[2] = R(0.0);
}

/* Its change as W and N change. */
static inline void FN(resist_change)(const FN(resistance) * q, const REAL w[3], REAL load, const REAL dw[3],
                                     REAL dload, REAL change[3])
{
    const REAL size2 = SUM_2(w[0], w[0], w[1], w[1]) + q->rest_2, inverse = REAL_RECIPROCAL_SQRT(size2);
    const REAL pressed = REAL_MAX(load, R(0.0));
    const REAL dpressed = REAL_SELECT(REAL_LESS(R(0.0), load), dload, R(0.0));
    const REAL along = SUM_2(w[0], dw[0], w[1], dw[1]) / size2;
    for (int i = 0; i < 2; ++i)
        change[i] = -(q->arm * inverse * (dpressed * w[i] + pressed * (dw[i] - along * w[i])));
    change[2] = R(0.0);
}

/* The power that it takes. */
static inline REAL FN(resistance_loss)(const FN(resistance) * q, const REAL w[3], REAL load)
{
    const REAL h2 = SUM_2(w[0], w[0], w[1], w[1]);
    return q->arm * REAL_MAX(load, R(0.0)) * h2 * REAL_RECIPROCAL_SQRT(h2 + q->rest_2);
}
