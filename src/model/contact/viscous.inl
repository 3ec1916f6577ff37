/* viscous.inl - the contact law `viscous`: f = V, over REAL (paper, section Modelling: friction -m gamma V; the
 * rate gamma is the unit of rates). */
typedef struct FN(viscous) {
    REAL rate; /* in gamma: 1 */
} FN(viscous);

static inline FN(viscous) FN(make_viscous)(const fst_params *params, const fst_groups *g)
{
    (void)params, (void)g;
    const FN(viscous) law = {R(1.0)};
    return law;
}

static inline void FN(viscous_force)(const FN(viscous) * law, const FN(contact) * at, REAL force[2])
{
    for (int i = 0; i < 2; ++i)
        force[i] = law->rate * at->slip[i];
}

static inline void FN(viscous_change)(const FN(viscous) * law, const FN(contact) * at, const FN(contact) * by,
                                      REAL change[2])
{
    (void)at;
    for (int i = 0; i < 2; ++i)
        change[i] = law->rate * by->slip[i];
}

static inline REAL FN(viscous_loss)(const FN(viscous) * law, const FN(contact) * at)
{
    return law->rate * SUM_2(at->slip[0], at->slip[0], at->slip[1], at->slip[1]);
}
