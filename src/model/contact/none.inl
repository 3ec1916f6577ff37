/* none.inl - the contact law `none`: a frictionless plate, over REAL. */
typedef struct FN(none) {
    REAL nothing; /* a struct needs a member */
} FN(none);

static inline FN(none) FN(make_none)(const fst_params *params, const fst_groups *g)
{
    (void)params, (void)g;
    const FN(none) law = {R(0.0)};
    return law;
}

static inline void FN(none_force)(const FN(none) * law, const FN(contact) * at, REAL force[2])
{
    (void)law, (void)at;
    force[0] = force[1] = R(0.0);
}

static inline void FN(none_change)(const FN(none) * law, const FN(contact) * at, const FN(contact) * by,
                                   REAL change[2])
{
    (void)law, (void)at, (void)by;
    change[0] = change[1] = R(0.0);
}

static inline REAL FN(none_loss)(const FN(none) * law, const FN(contact) * at)
{
    (void)law, (void)at;
    return R(0.0);
}
