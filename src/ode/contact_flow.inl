/* contact_flow.inl - how dry friction changes a slip while push and load stay as they are, in closed form, over
 * REAL.
 *
 * The slip V obeys V' = A - c V/|V| with constant push A and c = (7/2) mu N; at V = 0 the contact sticks while
 * |A| <= c.  With s = |V|, measured in sigma = (integral of dt/s), the pair (s, V) obeys linear equations,
 *
 *     ds/dsigma = A.V - c s,     dV/dsigma = A s - c V,     dt/dsigma = s,
 *
 * a Lorentz boost along A times a decay, so that slips that end, that turn round, or that start from nothing
 * are all the same.  Along A, s + V_A and s - V_A just decay (or grow):
 *
 *     s + V_A = ahead e^(-(c - |A|) sigma),   s - V_A = against e^(-(c + |A|) sigma),   V across A ~ e^(-c
 * sigma)
 *
 *     t(sigma) = 1/2 [ahead E(c - |A|) + against E(c + |A|)],   E(r) = (1 - e^(-r sigma))/r
 *
 * and t(sigma) = h is one monotonic equation for sigma.  Where |A| < c the slip ends at sigma = infinity, that
 * is at t* = 1/2 [ahead/(c - |A|) + against/(c + |A|)].  Nothing here degenerates at |A| = c.
 *
 * A slip that points exactly against A, |A| >= c, passes V = 0 and comes out along A, where `ahead` would have
 * to grow from 0.  It is kept from being less than 1e-40 of the rest, which no result can tell from 0.
 *
 * Exponentials are made of + - * / alone: a polynomial on a range halved until |r sigma| <= 1/2, and as many
 * doublings of the result.  The polynomial is exact to double precision.
 */

/* E(rate) and e^(-rate sigma) for sigma > 0. */
static inline void FN(decay)(REAL rate, REAL sigma, REAL *integral, REAL *left)
{
    /* (1 - e^-z)/z = sum of (-z)^n/(n + 1)!; the next term is below 5e-17 */
    static const double terms[] = {
        1.0 / 2.0,         -1.0 / 6.0,          1.0 / 24.0,         -1.0 / 120.0,    1.0 / 720.0,
        -1.0 / 5040.0,     1.0 / 40320.0,       -1.0 / 362880.0,    1.0 / 3628800.0, -1.0 / 39916800.0,
        1.0 / 479001600.0, -1.0 / 6227020800.0, 1.0 / 87178291200.0};
    REAL z = rate * sigma, part = sigma;
    enum { MOST_HALVINGS = 1100 }; /* of any number that is finite */
    REAL_MASK large = REAL_LESS(R(0.5), REAL_ABS(z));
    for (int i = 0; REAL_ANY(large) && i < MOST_HALVINGS; ++i) {
        z = REAL_SELECT(large, R(0.5) * z, z);
        part = REAL_SELECT(large, R(0.5) * part, part);
        large = REAL_LESS(R(0.5), REAL_ABS(z));
    }
    REAL sum = REAL_OF(terms[12]);
    for (int i = 11; i >= 0; --i)
        sum = REAL_MULADD(sum, z, REAL_OF(terms[i]));
    const REAL quotient = REAL_NEGMULADD(sum, z, R(1.0));
    REAL e = part * quotient, y = REAL_NEGMULADD(z, quotient, R(1.0));
    REAL_MASK halved = REAL_LESS(part, sigma);
    for (int i = 0; REAL_ANY(halved) && i < MOST_HALVINGS; ++i) {
        e = REAL_SELECT(halved, REAL_MULADD(e, y, e), e);
        y = REAL_SELECT(halved, y * y, y);
        part = REAL_SELECT(halved, part + part, part);
        halved = REAL_LESS(part, sigma);
    }
    *integral = e;
    *left = y;
}

/* The sigma at which E(rate) is d, nearly: d ln(1 - q)/(-q) with q = rate d < 1, a little too small where |q|
 * is large.  The logarithm is taken of a root of a root ... of 1 - q, in a form that loses no digits of small
 * q. */
static inline REAL FN(undo_decay)(REAL d, REAL rate)
{
    REAL z = REAL_MAX(-(rate * d), R((1e-15 - 1.0))), sigma = d;
    REAL_MASK large = REAL_LESS(R(0.5), REAL_ABS(z));
    while (REAL_ANY(large)) {
        const REAL factor = R(1.0) / (R(1.0) + REAL_SQRT(R(1.0) + z));
        z = REAL_SELECT(large, z * factor, z);
        sigma = REAL_SELECT(large, sigma * (factor + factor), sigma);
        large = REAL_LESS(R(0.5), REAL_ABS(z));
    }
    const REAL inverse = R(1.0) / (R(2.0) + z), w = z * inverse, w2 = w * w;
    const REAL series = REAL_MULADD(
        w2, REAL_MULADD(w2, REAL_MULADD(w2, R((1.0 / 7.0)), R((1.0 / 5.0))), R((1.0 / 3.0))), R(1.0));
    return sigma * (inverse + inverse) * series;
}

/* A slip on its way: the parts of s + V_A and s - V_A, halved, and what is left of them at sigma. */
typedef struct FN(sliding) {
    REAL ahead, against; /* at the start */
    REAL slow, fast;     /* the rates c - |A|, c + |A| */
    REAL sigma, ahead_left, against_left;
} FN(sliding);

/* The step that makes up for the time `missing`, and its `size` in terms of the faster rate.
 *
 * It inverts t(sigma) as if it had the slower of its decays alone, which never goes too far; near the solution
 * it inverts the series of t to third order, which usually is enough at once. */
static inline REAL FN(slide_step)(const FN(sliding) * q, REAL missing, REAL *size)
{
    const REAL a = q->ahead * q->ahead_left, b = q->against * q->against_left, inverse = R(1.0) / (a + b);
    const REAL d = missing * inverse, ra = q->slow * a, rb = q->fast * b;
    const REAL g = (ra + rb) * inverse, k = REAL_MULADD(q->slow, ra, q->fast * rb) * inverse;
    const REAL third = REAL_MULSUB(R(3.0) * g, g, k) * R((1.0 / 6.0));
    const REAL near = d * REAL_MULADD(d, REAL_MULADD(d, third, R(0.5) * g), R(1.0));
    *size = REAL_ABS(q->fast * d);
    const REAL_MASK far = REAL_LESS(R(0.25), *size);
    return REAL_ANY(far) ? REAL_SELECT(far, FN(undo_decay)(d, q->slow), near) : near;
}

/* The first step, from sigma = 0.  Where the faster decay may be over, the slower one has what is left of h to
 * itself: another way not to go too far. */
static inline REAL FN(slide_first)(const FN(sliding) * q, REAL h, REAL *size)
{
    const REAL step = FN(slide_step)(q, h, size);
    const REAL_MASK far = REAL_LESS(R(0.25), *size);
    if (!REAL_ANY(far))
        return step;
    const REAL rest = REAL_MAX((h - q->against / q->fast) / q->ahead, R(0.0));
    return REAL_SELECT(far, REAL_MAX(step, FN(undo_decay)(rest, q->slow)), step);
}

/* e^-z for |z| < 1e-4. */
static inline REAL FN(slight_decay)(REAL z)
{
    return R(1.0) - z * (R(1.0) - z * (R(0.5) - z * R((1.0 / 6.0))));
}

/* Find the sigma with t(sigma) = h, in the lanes in which the slip does not end. */
static inline void FN(slide)(FN(sliding) * q, REAL h, REAL_MASK ends)
{
    enum { MOST_STEPS = 200 };
    const REAL enough = R(5e-5); /* the next term of the series is of its fourth power */
    REAL size, open = REAL_SELECT(ends, R(0.0), R(1.0));
    q->sigma = R(0.0);
    q->ahead_left = q->against_left = R(1.0);
    /* Where the slip ends there is nothing to look for: h = 0 keeps such a lane from asking for the long way.
     */
    const REAL span = REAL_SELECT(ends, R(0.0), h);
    REAL step = FN(slide_first)(q, span, &size);
    for (int i = 0; i < MOST_STEPS; ++i) {
        /* A last small step needs no new exponentials. */
        const REAL_MASK last = REAL_LESS_EQUAL(size, enough * open);
        const REAL y1 = q->ahead_left * FN(slight_decay)(q->slow * step);
        const REAL y2 = q->against_left * FN(slight_decay)(q->fast * step);
        q->ahead_left = REAL_SELECT(last, y1, q->ahead_left);
        q->against_left = REAL_SELECT(last, y2, q->against_left);
        open = REAL_SELECT(last, R(0.0), open);
        const REAL_MASK busy = REAL_LESS(R(0.5), open);
        if (!REAL_ANY(busy))
            return;
        REAL e1, e2, left1, left2;
        q->sigma = REAL_SELECT(busy, q->sigma + step, q->sigma);
        FN(decay)(q->slow, q->sigma, &e1, &left1);
        FN(decay)(q->fast, q->sigma, &e2, &left2);
        q->ahead_left = REAL_SELECT(busy, left1, q->ahead_left);
        q->against_left = REAL_SELECT(busy, left2, q->against_left);
        const REAL missing = REAL_SELECT(busy, span - REAL_MULADD(q->ahead, e1, q->against * e2), R(0.0));
        const REAL_MASK met = REAL_LESS_EQUAL(REAL_ABS(missing), R(2e-16) * span);
        step = FN(slide_step)(q, missing, &size);
        step = REAL_SELECT(met, R(0.0), step);
        size = REAL_SELECT(met, R(0.0), size);
    }
}

/* A slip before and after a time. */
typedef struct FN(slide_result) {
    REAL end[2], speed[2]; /* V at the end; |V| at the start and the end */
    REAL share;            /* of the time, in which the contact slips */
} FN(slide_result);

/* The slip after the time h under the push A and the friction c = (7/2) mu N >= 0. */
static inline void FN(contact_flow)(const REAL push[2], REAL c, REAL h, const REAL slip[2],
                                    FN(slide_result) * result)
{
    const REAL a2 = SUM_2(push[0], push[0], push[1], push[1]);
    const REAL_MASK pushed = REAL_LESS(R(1e-280), a2);
    const REAL inverse_a = REAL_RECIPROCAL_SQRT(REAL_SELECT(pushed, a2, R(1.0))), a = a2 * inverse_a;
    const REAL p[2] = {REAL_SELECT(pushed, push[0] * inverse_a, R(1.0)),
                       REAL_SELECT(pushed, push[1] * inverse_a, R(0.0))};
    const REAL s = REAL_SQRT(SUM_2(slip[0], slip[0], slip[1], slip[1]));
    const REAL along = SUM_2(slip[0], p[0], slip[1], p[1]), across = REAL_MULSUB(p[0], slip[1], p[1] * slip[0]);
    const REAL greater = s + REAL_ABS(along), lesser = across * across / REAL_MAX(greater, R(1e-290));
    const REAL_MASK forward = REAL_LESS_EQUAL(R(0.0), along);
    FN(sliding) q;
    q.slow = c - a;
    q.fast = REAL_MAX(c + a, R(1e-290));
    q.ahead = R(0.5) * REAL_SELECT(forward, greater, lesser);
    q.against = R(0.5) * REAL_SELECT(forward, lesser, greater);
    const REAL floor = REAL_MULADD(R(1e-40), REAL_MULADD(h, q.fast, s), R(1e-250));
    q.ahead = REAL_MAX(q.ahead, floor);
    /* t* <= h, multiplied by both rates */
    const REAL_MASK holds = REAL_LESS(R(0.0), q.slow);
    const REAL needed = REAL_MULADD(q.ahead, q.fast, q.against * q.slow), had = h * (q.slow * q.fast);
    const REAL_MASK ends = REAL_LESS_EQUAL(REAL_SELECT(holds, needed, R(1.0)), REAL_SELECT(holds, had, R(0.0)));
    FN(slide)(&q, h, ends);
    const REAL left = q.ahead * q.ahead_left, right = q.against * q.against_left;
    const REAL end_along = left - right, end_across = across * REAL_SQRT(q.ahead_left * q.against_left);
    result->end[0] = REAL_SELECT(ends, R(0.0), REAL_MULSUB(end_along, p[0], end_across * p[1]));
    result->end[1] = REAL_SELECT(ends, R(0.0), REAL_MULADD(end_along, p[1], end_across * p[0]));
    result->speed[0] = s;
    result->speed[1] = REAL_SELECT(ends, R(0.0), left + right);
    result->share = REAL_SELECT(ends, needed / REAL_SELECT(ends, had, R(1.0)), R(1.0));
}
