/* lane_extremes.inl - a part of lanes.inl, the fast form only: the extremes of tracked quantities (r, |B|, the
 * load...) within steps, located as many at a time as there are lanes.
 *
 * A step that may hold a new extreme of a run seldom has company: in the same moment the other lanes hold none.
 * So it is copied aside, with the name of the quantity, until there are as many as lanes; then all are located
 * at once:
 *
 *               lane 0  lane 1  lane 2  lane 3
 *     moment 1     .       r       .       .    --.     waiting, place 0: r, of lane 1
 *     moment 2     .       .       .      load  --+-->           place 1: load, of lane 3
 *     moment 3    |B|      .       .       r    --'              place 2: |B|, of lane 0
 *                                                                place 3: r, of lane 3  ---> locate()
 */
typedef struct waiting {
    FN(bead_step) step;
    REAL weight[FST_TRACK_COUNT]; /* the sign of the quantity that is looked at, 0 for the others */
    REAL from, to;                /* the fractions of the step between which its extreme lies */
} waiting;

static void set_aside(const void *memory, int lane, int record, void *to_memory, int place)
{
    const batch *b = memory;
    waiting *to = to_memory;
    const FN(bead_step) *from = &b->step;
    move_world(FST_WORLD(&to->step), place, FST_WORLD(from), lane);
#if KNOWS_DRY
    move_modes(FST_MODES(&to->step), place, FST_MODES(from), lane);
#endif
    to->step.h[place] = from->h[lane];
    to->step.omega[place] = from->omega[lane];
    for (int i = 0; i < BEAD_NUMBERS; ++i) {
        to->step.y[i][place] = from->y[i][lane];
        to->step.end[i][place] = from->end[i][lane];
        for (int n = 0; n < FST_PATH_PLACES; ++n)
            FST_PATH_SLOPE(&to->step, n)[i][place] = FST_PATH_SLOPE(from, n)[i][lane];
    }
    to->from[place] = b->peak_from[record][lane];
    to->to[place] = b->peak_to[record][lane];
    for (int i = 0; i < FST_TRACK_COUNT; ++i)
        to->weight[i][place] = i == FST_RECORD_TRACKS[record] ? fst_record_sign(record) : 0.0;
}

/* Sign times the quantity in each place at the fraction x of its step. */
static __attribute__((noinline)) REAL look(const waiting *s, REAL x)
{
    REAL state[BEAD_NUMBERS];
    FN(pull) p;
    FN(seen) seen;
    const FN(world) *c = FST_WORLD(&s->step);
    const FN(modes) *m = FST_MODES(&s->step);
    FN(bead_evaluate_dense)(BEAD_NUMBERS, &s->step.dense[0][0], FST_DENSE_ROW(&s->step), x, state);
    (void)FN(renormalise)(state);
    FN(magnetic_pull)(c, m, state, &p);
    FN(see)(c, m, s->step.omega, state, &p, &seen);
    return SUM_5(s->weight[FST_TRACK_R], seen.r, s->weight[FST_TRACK_B], seen.b_norm, s->weight[FST_TRACK_GAP],
                 seen.gap2, s->weight[FST_TRACK_SLIP], seen.slip2, s->weight[FST_TRACK_LOAD], seen.load);
}

/* Four parabolas, each through three points of the dense output: the bracket's ends and middle, then around the
 * vertex of the one before, four times closer each time. */
static void locate(void *memory, double *values)
{
    waiting *s = memory;
    const REAL half = R(0.5), zero = R(0.0);
    FN(bead_make_dense)(&s->step);
    REAL middle = half * (s->from + s->to), reach = half * (s->to - s->from), best = R(-INFINITY);
    for (int round = 0; round < 4; ++round) {
        const REAL low = look(s, middle - reach), centre = look(s, middle), high = look(s, middle + reach);
        best = REAL_MAX(best, REAL_MAX(centre, REAL_MAX(low, high)));
        const REAL slope = half * (high - low), bend = (high - centre) - (centre - low);
        const fst_wide_mask curved = WIDE_LESS(bend, zero);
        const REAL raw = -(slope / fst_wide_select(curved, bend, R(-1.0)));
        const REAL at = REAL_MAX(R(-1.0), -REAL_MAX(R(-1.0), -raw));
        const REAL towards = fst_wide_select(WIDE_LESS(low, high), R(1.0), R(-1.0));
        const REAL to = fst_wide_select(curved, at, towards);
        const REAL inside = fst_wide_select(curved, centre + half * (slope * at), best);
        const fst_wide_mask vertex = WIDE_LESS(REAL_ABS(raw), R(1.0));
        if (round == 3)
            best = fst_wide_select(vertex, REAL_MAX(best, inside), best);
        const REAL next = reach * R(0.25), from = s->from + next, until = s->to - next;
        middle = REAL_MAX(from, -REAL_MAX(-until, -(middle + to * reach)));
        reach = next;
    }
    memcpy(values, &best, sizeof best);
}
