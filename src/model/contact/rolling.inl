/* rolling.inl - the contact law `rolling`: f = A/k, by which a contact at rest stays at rest (V' = 0), over
 * REAL.  It is dry friction of any strength; what it takes from a slip is not defined, so a run begins without
 * one (ode/contact.c).
 */
typedef struct FN(rolling) {
    REAL nothing; /* a struct needs a member */
} FN(rolling);

static inline FN(rolling) FN(make_rolling)(const fst_params *params, const fst_groups *g)
{
    (void)params, (void)g;
    const FN(rolling) law = {R(0.0)};
    return law;
}

static inline void FN(rolling_force)(const FN(rolling) * law, const FN(contact) * at, REAL force[2])
{
    (void)law;
    for (int i = 0; i < 2; ++i)
        force[i] = at->share * at->push[i];
}

static inline void FN(rolling_change)(const FN(rolling) * law, const FN(contact) * at, const FN(contact) * by,
                                      REAL change[2])
{
    (void)law;
    for (int i = 0; i < 2; ++i)
        change[i] = at->share * by->push[i];
}

static inline REAL FN(rolling_loss)(const FN(rolling) * law, const FN(contact) * at)
{
    (void)law, (void)at;
    return R(0.0);
}
