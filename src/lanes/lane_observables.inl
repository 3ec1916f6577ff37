/* lane_observables.inl - a part of lanes.inl: the integrals of observe/integrals.inl in lanes, and whether a
 * tracked quantity may have passed an extreme.
 */

/* Renew the references of lanes whose window has not opened.  If the integrands at the step's start are known,
 * nothing else is needed at this place. */
static void see_start(batch *b, unsigned accepted, unsigned before_window)
{
    const fst_wide_mask renew = fst_wide_mask_of(before_window);
    FN(integrals) *q = &b->sums;
    if (accepted & ~b->known) {
        FN(look_at_place)(q, &b->step, b->step.omega, 0, renew);
        return;
    }
    if (!before_window)
        return;
    q->r_reference = fst_wide_select(renew, q->tracked[0][FST_TRACK_R], q->r_reference);
    q->b_reference = fst_wide_select(renew, q->tracked[0][FST_TRACK_B], q->b_reference);
    q->integrands[0][FST_Q_R2] = fst_wide_select(renew, R(0.0), q->integrands[0][FST_Q_R2]);
    q->integrands[0][FST_Q_B2] = fst_wide_select(renew, R(0.0), q->integrands[0][FST_Q_B2]);
}

/* What a record must be beaten by: in the fast form by 1e-9 of it (and, for the squares of an
 * angle and of a slip, those of 1e-8), so that a bead at rest is not looked at for its rounding errors. */
static REAL to_beat(REAL record)
{
#ifdef FST_FUSED
    return record + REAL_MULADD(R(1e-9), REAL_ABS(record), R(1e-16));
#else
    return record;
#endif
}

/* A record may be beaten in a step as best_in_step() in observe/extremes.c has it, which decides. */
static void find_beaten(batch *b, unsigned tracked, unsigned beaten[FST_RECORD_COUNT])
{
    for (int i = 0; i < FST_RECORD_COUNT; ++i) {
        const FN(peak) top = FN(find_peak)(&b->sums.tracked[0][FST_RECORD_TRACKS[i]], FST_TRACK_COUNT,
                                           REAL_OF(fst_record_sign(i)));
        const REAL more = FN(may_exceed)(&top, to_beat(b->records[i]));
        beaten[i] = tracked & fst_wide_lanes_of(WIDE_LESS(R(0.0), more));
#ifdef FST_FUSED
        b->peak_from[i] = top.before;
        b->peak_to[i] = top.after;
        /* The end of a step lies on the trajectory; the stages within it do so but roughly, and a record that
         * one of them overshot would hide the ones to come. */
        const REAL end = REAL_OF(fst_record_sign(i)) * b->sums.tracked[FST_PATH_END][FST_RECORD_TRACKS[i]];
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
    FN(add_increments)(&b->sums, mask);
    see_start(b, accepted, accepted & ~in_window);
    for (int place = 1; place < FST_PATH_PLACES; ++place)
        FN(look_at_place)(&b->sums, &b->step, b->step.omega, place, fst_wide_mask_of(0));
    FN(integrate_step)(&b->sums, &b->step, mask);
    if (accepted & tracked)
        find_beaten(b, accepted & tracked, beaten);
    b->observed = accepted;
}
