/* splitting_lanes.inl - the engine of runs by the splitting method, over REAL.
 *
 * Lanes whose runs are over make steps like the others, of which nothing is kept.  The including file
 * brings the bodies of ode/splitting.inl and load_coefficients(), and defines SPLITTING_WIDTH.
 */
typedef struct splitting {
    FN(coefficients) coefficients;
    FN(stride) whole;                  /* a step */
    REAL y[FST_STATE_SIZE];            /* at the next kick */
    REAL step, steps, discard, window; /* steps made; in all; before the window; 1/those in it */
    REAL plate_2;
    REAL end; /* fst_splitting_end */
    FN(weighted) sums;
} splitting;

_Static_assert(sizeof(FN(weighted)) == sizeof(fst_splitting_sums) / sizeof(double) * sizeof(REAL),
               "the sums of a lane are those of its outcome");

static double *splitting_lane(void *reals)
{
    return reals;
}

static void load_stride(FN(stride) * to, int lane, const fst_stride_double *from)
{
    splitting_lane(&to->h)[lane] = from->h;
    splitting_lane(&to->cosine)[lane] = from->cosine;
    splitting_lane(&to->sine)[lane] = from->sine;
}

static void load_splitting(void *memory, int lane, const fst_splitting_job *job)
{
    splitting *s = memory;
    load_coefficients(&s->coefficients, lane, job->coefficients);
    load_stride(&s->whole, lane, &job->whole);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        splitting_lane(s->y)[i * SPLITTING_WIDTH + lane] = job->first[i];
    splitting_lane(&s->step)[lane] = 0.0;
    splitting_lane(&s->steps)[lane] = job->steps;
    splitting_lane(&s->discard)[lane] = job->discard;
    splitting_lane(&s->window)[lane] = 1.0 / fmax(job->steps - job->discard, 1.0);
    splitting_lane(&s->plate_2)[lane] = job->plate_radius * job->plate_radius;
    splitting_lane(&s->end)[lane] = FST_SPLITTING_ON_ITS_WAY;
    fst_splitting_sums empty;
    memset(&empty, 0, sizeof empty);
    for (int i = 0; i < FST_SPAN_COUNT; ++i) {
        empty.least[i] = 1e300;
        empty.most[i] = -1e300;
    }
    double *sums = splitting_lane(&s->sums);
    const double *numbers = (const double *)&empty;
    for (size_t i = 0; i < sizeof empty / sizeof(double); ++i)
        sums[i * SPLITTING_WIDTH + (size_t)lane] = numbers[i];
}

static REAL alive_lanes(const splitting *s)
{
    return REAL_SELECT(REAL_LESS(s->end, R(0.5)), R(1.0), R(0.0));
}

/* Lanes that have just lost the plate; 0 does not pass for a number that is none. */
static REAL stop_lost(splitting *s, const FN(pull) * p)
{
    const REAL alive = alive_lanes(s);
    const REAL r2 = SUM_2(s->y[FST_X], s->y[FST_X], s->y[FST_Y], s->y[FST_Y]);
    const REAL on_plate = REAL_SELECT(REAL_LESS(r2, s->plate_2), R(1.0), R(0.0));
    const REAL pressed = REAL_SELECT(REAL_LESS(R(0.0), FN(load)(&s->coefficients, p->force)), R(1.0), R(0.0));
    const REAL_MASK lifted = REAL_LESS(R(0.5), alive * (R(1.0) - pressed));
    if (REAL_ANY(lifted))
        s->end = REAL_SELECT(lifted, R(FST_SPLITTING_LIFTED), s->end);
    const REAL_MASK ejected = REAL_LESS(R(0.5), alive * (R(1.0) - on_plate));
    if (REAL_ANY(ejected))
        s->end = REAL_SELECT(ejected, R(FST_SPLITTING_EJECTED), s->end);
    return alive * (pressed * on_plate);
}

static void make_step(splitting *s)
{
    FN(pull) p;
    FN(kick) did;
    REAL before[FST_STATE_SIZE];
    FN(magnetic_pull)(&s->coefficients, s->y, &p);
    const REAL alive = stop_lost(s, &p);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        before[i] = s->y[i];
    FN(kick_by)(&s->coefficients, &p, s->whole.h, s->y, &did);
    const REAL x = (s->step + R(0.5) - s->discard) * s->window;
    if (REAL_ANY(REAL_LESS(R(0.0), alive * x)))
        FN(weighted_add)(&s->sums, &s->coefficients, &p, &did, before, s->y, x, alive);
    FN(drift)(&s->whole, s->y);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        s->y[i] = REAL_SELECT(REAL_LESS(R(0.5), alive), s->y[i], before[i]);
    s->step = s->step + alive;
    const REAL_MASK over = REAL_LESS_EQUAL(s->steps, REAL_SELECT(REAL_LESS(R(0.5), alive), s->step, R(-1.0)));
    s->end = REAL_SELECT(over, R(FST_SPLITTING_DONE), s->end);
}

static unsigned go_on_splitting(void *memory, int count)
{
    splitting *s = memory;
    unsigned over = 0;
    for (int i = 0; i < count && REAL_ANY(REAL_LESS(s->end, R(0.5))); ++i)
        make_step(s);
    for (int l = 0; l < SPLITTING_WIDTH; ++l)
        over |= splitting_lane(&s->end)[l] > 0.5 ? 1u << l : 0u;
    return over;
}

static void splitting_outcome(const void *memory, int lane, fst_splitting_outcome *outcome)
{
    splitting *s = (splitting *)(uintptr_t)memory;
    outcome->end = (fst_splitting_end)(int)splitting_lane(&s->end)[lane];
    outcome->step = splitting_lane(&s->step)[lane];
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        outcome->state[i] = splitting_lane(s->y)[i * SPLITTING_WIDTH + lane];
    const double *sums = splitting_lane(&s->sums);
    double *numbers = (double *)&outcome->sums;
    for (size_t i = 0; i < sizeof outcome->sums / sizeof(double); ++i)
        numbers[i] = sums[i * SPLITTING_WIDTH + (size_t)lane];
}

#define SPLITTING_ENGINE                                                                                       \
    {                                                                                                          \
        .width = SPLITTING_WIDTH, .bytes = sizeof(splitting), .load = load_splitting,                          \
        .go_on = go_on_splitting, .outcome = splitting_outcome,                                                \
    }
