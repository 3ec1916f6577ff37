/* quadratic.inl - a contact law of one's own: f = k N |V| V, over REAL, which is linear neither in the slip nor
 * blind to the load. */
typedef struct FN(quadratic) {
    REAL grip;
} FN(quadratic);

static inline FN(quadratic) FN(make_quadratic)(const fst_params *params, const fst_groups *g)
{
    (void)g;
    const FN(quadratic) law = {REAL_OF(params->own_grip)};
    return law;
}

/* |V|; the tiny number keeps the derivative finite at rest. */
static inline REAL FN(speed_of)(const REAL slip[2])
{
    return REAL_SQRT(slip[0] * slip[0] + slip[1] * slip[1] + R(1e-290));
}

static inline void FN(quadratic_force)(const FN(quadratic) * law, const FN(contact) * at, REAL force[2])
{
    const REAL rate = law->grip * at->load * FN(speed_of)(at->slip);
    for (int i = 0; i < 2; ++i)
        force[i] = rate * at->slip[i];
}

static inline void FN(quadratic_change)(const FN(quadratic) * law, const FN(contact) * at,
                                        const FN(contact) * by, REAL change[2])
{
    const REAL speed = FN(speed_of)(at->slip);
    const REAL faster = (at->slip[0] * by->slip[0] + at->slip[1] * by->slip[1]) / speed;
    for (int i = 0; i < 2; ++i)
        change[i] = law->grip * (at->load * (speed * by->slip[i] + faster * at->slip[i]) +
                                 by->load * (speed * at->slip[i]));
}

static inline REAL FN(quadratic_loss)(const FN(quadratic) * law, const FN(contact) * at)
{
    const REAL speed = FN(speed_of)(at->slip);
    return law->grip * at->load * (speed * speed * speed);
}
