/* weighted.inl - means of a run by the splitting method, over REAL.
 *
 * A mean is a sum over the kicks with weights that rise from 0 at the ends of the window, (x (1 - x))^4 at its
 * fraction x.  Over a motion that repeats itself n times this errs by some (2 pi n)^-5 wherever the window
 * begins and ends, so neither returns nor other events have to be located, and lanes do not wait for each
 * other.  The same over each half of the window tells whether the motion has settled.
 */
typedef struct FN(weighted) {
    REAL weight, half_weight[2];
    REAL sum[FST_MEAN_COUNT], half_sum[2][FST_HALVED_COUNT];
    REAL r_reference, b_reference;
    REAL least[FST_SPAN_COUNT], most[FST_SPAN_COUNT];
    REAL fastest[2];                        /* |d(x, n)/dt|^2 in the turning frame, over each half */
    REAL captures;                          /* kicks in which a slip ended */
    REAL x_before;                          /* X at the kick before; 0: none */
    REAL turned, turned_least, turned_most; /* crossings of X = 0 with Phi rising less those with Phi falling */
    REAL rising, falling;                   /* how many of each */
} FN(weighted);

/* One of `count` numbers. */
static inline void FN(weigh)(REAL weight, const REAL *values, int count, REAL *total, REAL *sum)
{
    *total = *total + weight;
    for (int i = 0; i < count; ++i)
        sum[i] = REAL_MULADD(weight, values[i], sum[i]);
}

/* The weight at the fraction x of a window; 0 outside. */
static inline REAL FN(window_weight)(REAL x)
{
    const REAL bump = REAL_MAX(x * (R(1.0) - x), R(0.0)), square = bump * bump;
    return square * square;
}

/* What a kick shows of the bead: `y` is the state after it. */
static inline void FN(look_at_kick)(const FN(coefficients) * c, const FN(pull) * p, const FN(kick) * did,
                                    const REAL *y, REAL *values, REAL *spans)
{
    const REAL r2 = SUM_2(y[FST_X], y[FST_X], y[FST_Y], y[FST_Y]);
    const REAL inverse_r = REAL_RECIPROCAL_SQRT(r2 + R(1e-290));
    const REAL b2 = SUM_3(p->b[0], p->b[0], p->b[1], p->b[1], p->b[2], p->b[2]);
    const REAL inverse_b = REAL_RECIPROCAL_SQRT(b2 + R(1e-290));
    const REAL *n = y + FST_NX, s0 = did->slide.speed[0], s1 = did->slide.speed[1], share = did->slide.share;
    const REAL s0_2 = s0 * s0, s1_2 = s1 * s1;
    /* While the slip decays from s0 to s1, nearly as a straight line: */
    const REAL slip = share * (R(0.5) * (s0 + s1));
    const REAL slip2 = share * (R((1.0 / 3.0)) * (s0_2 + s0 * s1 + s1_2));
    const REAL twist = REAL_MULSUB(n[0], p->b[1], n[1] * p->b[0]);
    const REAL lever = REAL_MULSUB(y[FST_X], p->force[1], y[FST_Y] * p->force[0]);
    values[FST_MEAN_R] = r2 * inverse_r;
    values[FST_MEAN_NZ] = n[2];
    values[FST_MEAN_B] = b2 * inverse_b;
    values[FST_MEAN_FRICTION_POWER] = c->law.coulomb.sliding * REAL_MAX(did->load, R(0.0)) * slip;
    values[FST_MEAN_DRIVE_POWER] = c->omega * REAL_MULADD(p->strength, twist, lever);
    values[FST_MEAN_SLIP2] = slip2;
    values[FST_MEAN_LOAD] = did->load;
    values[FST_MEAN_STICKING] = R(1.0) - share;
    spans[FST_SPAN_R] = values[FST_MEAN_R];
    spans[FST_SPAN_B] = values[FST_MEAN_B];
    spans[FST_SPAN_LOAD] = did->load;
    spans[FST_SPAN_SLIP2] = REAL_MAX(s0_2, s1_2);
    spans[FST_SPAN_GAP2] = R(0.0);
    for (int i = 0; i < 3; ++i) {
        const REAL gap = REAL_NEGMULADD(p->b[i], inverse_b, n[i]);
        spans[FST_SPAN_GAP2] = REAL_MULADD(gap, gap, spans[FST_SPAN_GAP2]);
    }
}

/* Phi passes pi/2 or -pi/2 between two kicks. */
static inline void FN(count_crossing)(FN(weighted) * w, const REAL *y, REAL inside)
{
    const REAL x = y[FST_X];
    const REAL crossed = REAL_SELECT(REAL_LESS(x * w->x_before, R(0.0)), inside, R(0.0));
    const REAL rises = REAL_SELECT(REAL_LESS(x * y[FST_Y], R(0.0)), crossed, R(0.0)); /* e.g. X < 0 < Y */
    const REAL falls = crossed - rises;
    w->rising = w->rising + rises;
    w->falling = w->falling + falls;
    w->turned = w->turned + (rises - falls);
    w->turned_most = REAL_MAX(w->turned_most, w->turned);
    w->turned_least = -REAL_MAX(-w->turned_least, -w->turned);
    w->x_before = REAL_SELECT(REAL_LESS(R(0.5), inside), x, w->x_before);
}

/* Observe a kick from `before` to `y` at the fraction x of the window; outside it, and where a lane is `alive`
 * no more (0), nothing is added. */
static inline void FN(weighted_add)(FN(weighted) * w, const FN(coefficients) * c, const FN(pull) * p,
                                    const FN(kick) * did, const REAL *before, const REAL *y, REAL x, REAL alive)
{
    REAL values[FST_MEAN_COUNT], spans[FST_SPAN_COUNT], slope[FST_STATE_SIZE];
    const REAL weight = alive * FN(window_weight)(x);
    const REAL inside = REAL_SELECT(REAL_LESS(R(0.0), weight), R(1.0), R(0.0));
    FN(look_at_kick)(c, p, did, y, values, spans);
    const REAL_MASK first = REAL_LESS(w->weight, R(1e-300));
    w->r_reference = REAL_SELECT(first, values[FST_MEAN_R], w->r_reference);
    w->b_reference = REAL_SELECT(first, values[FST_MEAN_B], w->b_reference);
    const REAL dr = values[FST_MEAN_R] - w->r_reference, db = values[FST_MEAN_B] - w->b_reference;
    values[FST_MEAN_R2] = dr * dr;
    values[FST_MEAN_B2] = db * db;
    /* of the mean of both velocities, which is that at the time of the kick */
    const REAL v[2] = {R(0.5) * (before[FST_VX] + y[FST_VX]), R(0.5) * (before[FST_VY] + y[FST_VY])};
    const REAL r2 = REAL_MULADD(values[FST_MEAN_R], values[FST_MEAN_R], R(1e-290));
    values[FST_MEAN_ALPHA_DOT] = REAL_MULSUB(y[FST_X], v[1], y[FST_Y] * v[0]) / r2;
    FN(weigh)(weight, values, FST_MEAN_COUNT, &w->weight, w->sum);
    const REAL_MASK counts = REAL_LESS(R(0.5), inside);
    FN(kinematics)(c->omega, y, slope);
    const REAL speed2 = SUM_5(slope[FST_X], slope[FST_X], slope[FST_Y], slope[FST_Y], slope[FST_NX],
                              slope[FST_NX], slope[FST_NY], slope[FST_NY], slope[FST_NZ], slope[FST_NZ]);
    const REAL middle = x - R(0.5);
    for (int i = 0; i < 2; ++i) {
        const REAL part = alive * FN(window_weight)(R(2.0) * (i == 0 ? x : middle));
        FN(weigh)(part, values, FST_HALVED_COUNT, &w->half_weight[i], w->half_sum[i]);
        const REAL_MASK here = REAL_LESS(R(0.0), part);
        w->fastest[i] = REAL_SELECT(here, REAL_MAX(w->fastest[i], speed2), w->fastest[i]);
    }
    for (int i = 0; i < FST_SPAN_COUNT; ++i) {
        w->most[i] = REAL_SELECT(counts, REAL_MAX(w->most[i], spans[i]), w->most[i]);
        w->least[i] = REAL_SELECT(counts, -REAL_MAX(-w->least[i], -spans[i]), w->least[i]);
    }
    /* A contact that rests slips for a rounding's time. */
    const REAL ended = REAL_SELECT(REAL_LESS(did->slide.share, R(1.0)), inside, R(0.0));
    w->captures = w->captures + REAL_SELECT(REAL_LESS(R(1e-9), did->slide.share), ended, R(0.0));
    FN(count_crossing)(w, y, inside);
}
