/* peaks.inl - where a quantity is greatest among the places of a step's path (ode/path.h), and whether it may
 * be greater still between them, over REAL.
 *
 * Through the best place and two others goes a parabola; with f1 and f2 the falls to these, at the distances d1
 * and d2 (of one sign where both lie on one side), and p = d1/d2, it rises above the best place by
 *
 *     (p f2 - f1/p)^2 / (4 ((1 - p) f2 + (1 - 1/p) f1)).
 *
 *                 rise
 *              . - ^ - .
 *           o          .
 *         .  best       o     f2, at d2 > 0
 *        .
 *       o                     f1, at d1 < 0
 *
 * Within the step the two are the neighbours.  At its ends they are the next two of other nodes, and only a
 * parabola that rises into the step, p f2 > f1/p, has its vertex there.  The path is not a parabola, and the
 * places within the step lie on it only roughly; r even has a corner where the bead passes the axis.  So
 * PEAK_RISES times the rise and PEAK_FALL of the fall to the neighbours are added to the best place, and a step
 * is looked at where that exceeds the record so far (a third of both is enough in tests/observe/test_extremes.c).
 */
#define PEAK_RISES 3.0
#define PEAK_FALL 0.3

typedef struct FN(peak) {
    REAL best, fall;     /* sign times the value at the best place; how far its neighbours lie lower */
    REAL rise_over, per; /* the rise is their quotient; neither is negative */
    REAL before, after;  /* the nodes between which the extreme lies */
} FN(peak);

/* The values at the path's places lie `stride` apart. */
static inline FN(peak) FN(find_peak)(const REAL *values, int stride, REAL sign)
{
    enum { LAST = FST_PATH_END };
    const REAL zero = R(0.0), one = R(1.0);
    REAL first = sign * values[stride], second = sign * values[2 * stride];
    REAL p = REAL_OF(FST_PATH_RATIO[0]), q = REAL_OF(1.0 / FST_PATH_RATIO[0]);
    FN(peak) top = {sign * values[0], zero, zero, zero, zero, REAL_OF(FST_PATH_NODE[1])};
    _Pragma("GCC unroll 16") for (int n = 1; n <= LAST; ++n)
    {
        /* The last two places both lie at the end. */
        const int at_end = n >= LAST - 1, before = at_end ? LAST - 2 : n - 1, after = at_end ? LAST : n + 1;
        const REAL value = sign * values[n * stride],
                   other = sign * values[(at_end ? LAST - 3 : after) * stride];
        const REAL_MASK higher = REAL_LESS(top.best, value);
        first = REAL_SELECT(higher, sign * values[before * stride], first);
        second = REAL_SELECT(higher, other, second);
        p = REAL_SELECT(higher, REAL_OF(FST_PATH_RATIO[n]), p);
        q = REAL_SELECT(higher, REAL_OF(1.0 / FST_PATH_RATIO[n]), q);
        top.best = REAL_SELECT(higher, value, top.best);
        top.before = REAL_SELECT(higher, REAL_OF(FST_PATH_NODE[before]), top.before);
        top.after = REAL_SELECT(higher, REAL_OF(FST_PATH_NODE[after]), top.after);
    }
    const REAL fall1 = top.best - first, fall2 = top.best - second, slope = p * fall2 - q * fall1;
    const REAL_MASK inside = REAL_LESS(p, zero);
    const REAL towards = REAL_SELECT(inside, slope, REAL_MAX(slope, zero));
    top.fall = REAL_SELECT(inside, REAL_MAX(fall1, fall2), fall1);
    top.rise_over = towards * towards;
    top.per = REAL_MAX(R(4.0) * ((one - p) * fall2 + (one - q) * fall1), zero);
    return top;
}

/* Positive where the path may have more than `record` in the step. */
static inline REAL FN(may_exceed)(const FN(peak) * top, REAL record)
{
    const REAL lacking = (record - top->best) - R(PEAK_FALL) * top->fall;
    return REAL_MAX(R(PEAK_RISES) * top->rise_over - lacking * top->per, -lacking);
}
