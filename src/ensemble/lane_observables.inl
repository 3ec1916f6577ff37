/* lane_observables.inl - a part of lanes.inl: integrands at the points of a step's path (ode/path.h), their
 * integrals, and whether a tracked quantity may have passed an extreme.
 */
/* fst_twofold_add() of the last increments, in the lanes of `mask`. */
static void add_increments(batch *b, fst_wide_mask mask)
{
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        const FN(twofold) total = {b->total_high[i], b->total_low[i]};
        const FN(twofold) sum = FN(twofold_add)(total, b->increment[i]);
        b->total_low[i] = fst_wide_select(mask, sum.low, b->total_low[i]);
        b->total_high[i] = fst_wide_select(mask, sum.high, b->total_high[i]);
    }
}

static void see_point(batch *b, int n, fst_wide_mask renew)
{
    const FN(bead_step) *s = &b->step;
    const FN(coefficients) *c = &s->context.coefficients;
    const REAL *state = FST_POINT_STATE(s, n);
    const FN(pull) *pull = FST_POINT_PULL(s, n);
    FN(seen) seen;
    FN(see)(c, s->omega, state, pull, &seen); /* the drive does not change in lanes */
    if (n == 0) {
        b->r_reference = fst_wide_select(renew, seen.r, b->r_reference);
        b->b_reference = fst_wide_select(renew, seen.b_norm, b->b_reference);
    }
    FN(integrands)(c, state, pull, &seen, b->r_reference, b->b_reference, b->integrands[n]);
    b->tracked[n][FST_TRACK_R] = seen.r;
    b->tracked[n][FST_TRACK_B] = seen.b_norm;
    b->tracked[n][FST_TRACK_GAP] = seen.gap2;
    b->tracked[n][FST_TRACK_SLIP] = seen.slip2;
    b->tracked[n][FST_TRACK_LOAD] = seen.load;
}

/* The references of the lanes before their window are renewed; where the integrands at the start of the step
 * are known, that is all there is to do for this point. */
static void see_start(batch *b, unsigned accepted, unsigned before_window)
{
    const fst_wide_mask renew = fst_wide_mask_of(before_window);
    if (accepted & ~b->known) {
        see_point(b, 0, renew);
        return;
    }
    if (!before_window)
        return;
    REAL *q = b->integrands[0];
    b->r_reference = fst_wide_select(renew, b->tracked[0][FST_TRACK_R], b->r_reference);
    b->b_reference = fst_wide_select(renew, b->tracked[0][FST_TRACK_B], b->b_reference);
    q[FST_Q_R2] = fst_wide_select(renew, R(0.0), q[FST_Q_R2]);
    q[FST_Q_B2] = fst_wide_select(renew, R(0.0), q[FST_Q_B2]);
}

static void integrate(batch *b, fst_wide_mask mask)
{
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        const REAL mean = FN(path_mean)(&b->integrands[0][i], FST_Q_COUNT);
        b->increment[i] = fst_wide_select(mask, b->step.h * mean, b->increment[i]);
    }
}

/* What a value must exceed to count as a new record.  In the fast form that is a little more than the record:
 * 1e-9 of it, and 1e-16 for the squares of an angle and of a slip, so that a bead at rest is not searched for
 * extremes of its rounding errors. */
static REAL to_beat(REAL record)
{
#ifdef FST_FUSED
    return record + REAL_MULADD(R(1e-9), REAL_ABS(record), R(1e-16));
#else
    return record;
#endif
}

/* A record may be beaten in a step as best_in_step() of the quadrature has it, which decides. */
static void find_beaten(batch *b, unsigned tracked, unsigned beaten[FST_RECORD_COUNT])
{
    for (int i = 0; i < FST_RECORD_COUNT; ++i) {
        const FN(peak) top =
            FN(find_peak)(&b->tracked[0][FST_RECORD_TRACKS[i]], FST_TRACK_COUNT, REAL_OF(fst_record_sign(i)));
        const REAL more = FN(may_exceed)(&top, to_beat(b->records[i]));
        beaten[i] = tracked & fst_wide_lanes_of(WIDE_LESS(R(0.0), more));
#ifdef FST_FUSED
        b->peak_from[i] = top.before;
        b->peak_to[i] = top.after;
        /* The end of a step lies on the trajectory; the points within it do so only roughly, and a record that
         * one of them overshot would hide the ones to come. */
        const REAL end = REAL_OF(fst_record_sign(i)) * b->tracked[FST_END_POINT][FST_RECORD_TRACKS[i]];
        const fst_wide_mask counts = fst_wide_mask_of(tracked);
        b->records[i] = fst_wide_select(counts, REAL_MAX(end, b->records[i]), b->records[i]);
#endif
    }
}

static void observe(void *memory, unsigned accepted, unsigned in_window, unsigned tracked,
                    unsigned beaten[FST_RECORD_COUNT])
{
    batch *b = memory;
    const fst_wide_mask mask = fst_wide_mask_of(accepted);
    add_increments(b, mask);
    see_start(b, accepted, accepted & ~in_window);
    for (int n = 1; n < FST_PATH_POINTS; ++n)
        see_point(b, n, fst_wide_mask_of(0));
    integrate(b, mask);
    if (accepted & tracked)
        find_beaten(b, accepted & tracked, beaten);
    b->observed = accepted;
}
