/* elliptic.inl - complete elliptic integrals by the arithmetic-geometric mean, over REAL.
 *
 * Gauss: from a_0, b_0 > 0 let a_{n+1} = (a_n + b_n)/2, b_{n+1} = sqrt(a_n b_n), c_{n+1} = (a_n - b_n)/2, where
 * c_{n+1} = c_n^2/(4 a_{n+1}) too.  Both means have the limit M, c_n goes to zero, quadratically, and with
 * k'^2 = b_0^2/a_0^2
 *
 *     K(k) = (pi/2) a_0/M,     E(k)/K(k) = 1 - (sum of 2^(n-1) c_n^2, n >= 0)/a_0^2.
 *
 * The third kind has a sequence of its own (Bartky's transformation; DLMF 19.8.7): from p_0 = a_0 sqrt(1 -
 * alpha^2) and Q_0 = 1
 *
 *     p_{n+1} = (p_n + a_n b_n/p_n)/2,     Q_{n+1} = Q_n (p_n^2 - a_n b_n)/(p_n^2 + a_n b_n)/2,
 *     Pi(alpha^2, k)/K(k) = 1 + (alpha^2/(1 - alpha^2)) (sum of Q_n, n >= 0)/2.
 *
 * The caller makes the first step itself, because there it knows c_1 without a cancellation, and often has the
 * first terms of the sums cancel against others by hand: then what is left keeps all its digits, however small
 * the modulus is.  The number of steps is fixed, so that all lanes make the same.  It serves a ratio b_0/a_0
 * down to 1e-14.  + - * / and square roots alone: the same bits everywhere.
 */
#define ELLIPTIC_STEPS 6

typedef struct FN(elliptic) {
    REAL mean, per_mean;              /* M, 1/M */
    REAL below;                       /* a_1 - M = c_2 + c_3 + ..., to its last digit */
    REAL squares;                     /* (sum of 2^(n-1) c_n^2, n >= 2)/c_1^4, the same */
    REAL product[ELLIPTIC_STEPS + 1]; /* a_n b_n */
} FN(elliptic);

/* From a_1, a_0 b_0 = b_1^2 and c_1. */
static inline FN(elliptic) FN(elliptic_mean)(REAL a, REAL product, REAL c)
{
    enum { last = ELLIPTIC_STEPS + 2 }; /* M = a_last */
    FN(elliptic) e;
    REAL of[last + 1], upto[last + 1]; /* a_n; a_2 a_3 ... a_n: one division serves all 1/a_n */
    e.product[0] = product;
    upto[1] = R(1.0);
    for (int n = 1; n < last; ++n) {
        const REAL b = REAL_SQRT(e.product[n - 1]);
        if (n <= ELLIPTIC_STEPS)
            e.product[n] = a * b;
        of[n + 1] = a = R(0.5) * (a + b);
        upto[n + 1] = upto[n] * a;
    }
    REAL per_all = REAL_RECIPROCAL(upto[last]), per[last + 1];
    for (int n = last; n > 1; --n) {
        per[n] = per_all * upto[n - 1];
        per_all = per_all * of[n];
    }
    e.mean = a;
    e.per_mean = per[last];
    const REAL quarter = R(0.25) * per[2], c2 = c * c * quarter, quarter2 = R(0.25) * c2;
    REAL share = R(1.0), shares = share, squares = share; /* c_n/c_2, their sum, that of 2^(n-2) (c_n/c_2)^2 */
    REAL weight = R(2.0);
    for (int n = 3; n < last; ++n) {
        share = (share * share) * (quarter2 * per[n]);
        shares = shares + share;
        squares = REAL_MULADD(weight * share, share, squares);
        weight = weight + weight;
    }
    e.below = c2 * shares;
    e.squares = R(2.0) * squares * (quarter * quarter);
    return e;
}

/* The sum of Q_n, n >= 1, from p_0, which must not be much less than b_0 nor much greater than a_0: p_n then
 * comes to M as fast as a_n does.  After the first step p_n/p_1 and the sum are kept as fractions, so that one
 * division serves all steps. */
static inline REAL FN(elliptic_third)(const FN(elliptic) * e, REAL p)
{
    const REAL p2 = p * p, twice = p2 + e->product[0], inverse = REAL_RECIPROCAL(p * twice);
    const REAL first = R(0.5) * (p2 - e->product[0]) * (p * inverse); /* Q_1 */
    const REAL per_p1 = R(2.0) * (p2 * inverse), scale = per_p1 * per_p1;
    REAL over = R(1.0), under = R(1.0), plus[ELLIPTIC_STEPS + 1], minus[ELLIPTIC_STEPS + 1];
    for (int n = 1; n <= ELLIPTIC_STEPS; ++n) {
        const REAL over2 = over * over, mean2 = (under * under) * (e->product[n] * scale);
        under = R(2.0) * (over * under);
        over = plus[n] = over2 + mean2;
        minus[n] = over2 - mean2;
    }
    REAL numerator = R(0.0), denominator = R(1.0); /* of (Q_(n+1) + Q_(n+2) + ...)/Q_n */
    for (int n = ELLIPTIC_STEPS; n >= 1; --n) {
        numerator = minus[n] * (denominator + numerator);
        denominator = R(2.0) * (plus[n] * denominator);
    }
    return first * (R(1.0) + numerator * REAL_RECIPROCAL(denominator));
}
