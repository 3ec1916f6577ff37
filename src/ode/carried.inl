/* carried.inl - a neighbour of a motion with dry friction, carried along a step, over REAL: what flows (neighbours.c,
 * which explains it), two_neighbours.c and lanes have in common.  The including file brings model/tangent.inl.
 */
/* The weights of the stages before in each stage of a step; in number 12, in its end.  In neighbours.c. */
extern const double fst_stage_weights[16][15];

/* The derivatives by theta of a difference d where the motion was linearised, with f and pace as it has them. */
static inline void FN(neighbour_slope)(const FN(world) * c, const FN(modes) * m, REAL omega, const REAL *y,
                                       const FN(linear) * l, const REAL *f, REAL pace, const REAL *d, REAL *k)
{
    const REAL faster = FN(pace_change)(c, m, y, d);
    FN(change_along)(c, omega, y, l, d, k);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        k[i] = pace * k[i] + faster * f[i];
    k[FST_STEP_TIME] = faster;
}

/* The `count` numbers of a difference at a stage of a step of the size h, from those at its start and from its slopes
 * at the stages before, which lie `apart`. */
static inline void FN(neighbour_at_stage)(REAL h, int stage, int count, const REAL *d, const REAL *slopes,
                                          int apart, REAL *at)
{
    REAL sum[FST_NUMBERS]; /* in registers */
    memcpy(sum, d, (size_t)count * sizeof *sum);
    for (int before = 0; before < stage; ++before) {
        const REAL weight = h * REAL_OF(fst_stage_weights[stage][before]), *slope = slopes + before * apart;
        for (int i = 0; i < count && fst_stage_weights[stage][before] != 0.0; ++i)
            sum[i] = REAL_MULADD(weight, slope[i], sum[i]);
    }
    memcpy(at, sum, (size_t)count * sizeof *sum);
}

/* Change the slip of a neighbour by an impulse of the plate: the moment about the contact stays. */
static inline void FN(change_neighbour_slip)(const FN(world) * c, const REAL change[2], REAL *d)
{
    d[FST_VX] = d[FST_VX] + c->share * change[0];
    d[FST_VY] = d[FST_VY] + c->share * change[1];
    d[FST_WX] = d[FST_WX] + c->spin_up * change[1];
    d[FST_WY] = d[FST_WY] - c->spin_up * change[0];
}
