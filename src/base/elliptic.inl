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

/* Both functions take two integrals at once: each step waits for the one before, and the other integral's fill
 * the time.  From a_1, a_0 b_0 = b_1^2 and c_1. */
static inline __attribute__((always_inline)) void FN(elliptic_means)(const REAL first[2], const REAL product[2],
                                                                     const REAL c[2], FN(elliptic) e[2])
{
    enum { last = ELLIPTIC_STEPS + 2 };      /* M = a_last */
    REAL of[2][last + 1], upto[2][last + 1]; /* a_n; a_2 a_3 ... a_n: one division serves all 1/a_n */
    for (int k = 0; k < 2; ++k) {
        of[k][1] = first[k];
        upto[k][1] = R(1.0);
        e[k].product[0] = product[k];
    }
    for (int n = 1; n < last; ++n)
        for (int k = 0; k < 2; ++k) {
            const REAL a = of[k][n], b = REAL_SQRT(e[k].product[n - 1]);
            if (n <= ELLIPTIC_STEPS)
                e[k].product[n] = a * b;
            of[k][n + 1] = R(0.5) * (a + b);
            upto[k][n + 1] = upto[k][n] * of[k][n + 1];
        }
    for (int k = 0; k < 2; ++k) {
        REAL per_all = REAL_RECIPROCAL(upto[k][last]), per[last + 1];
        for (int n = last; n > 1; --n) {
            per[n] = per_all * upto[k][n - 1];
            per_all = per_all * of[k][n];
        }
        e[k].mean = of[k][last];
        e[k].per_mean = per[last];
        const REAL quarter = R(0.25) * per[2], c2 = c[k] * c[k] * quarter, quarter2 = R(0.25) * c2;
        /* c_n/c_2, their sum, and that of 2^(n-2) (c_n/c_2)^2 */
        REAL share = R(1.0), shares = share, squares = share, weight = R(2.0);
        for (int n = 3; n < last; ++n) {
            share = (share * share) * (quarter2 * per[n]);
            shares = shares + share;
            squares = REAL_MULADD(weight * share, share, squares);
            weight = weight + weight;
        }
        e[k].below = c2 * shares;
        e[k].squares = R(2.0) * squares * (quarter * quarter);
    }
}

/* The sum of Q_n, n >= 1, from p_0, which must not be much less than b_0 nor much greater than a_0: p_n then
 * comes to M as fast as a_n does.  After the first step p_n/p_1 and the sum are kept as fractions, so that one
 * division serves all steps. */
static inline __attribute__((always_inline)) void FN(elliptic_thirds)(const FN(elliptic) e[2], const REAL p[2],
                                                                      REAL sum[2])
{
    REAL first[2], scale[2], over[2], under[2], plus[2][ELLIPTIC_STEPS + 1], minus[2][ELLIPTIC_STEPS + 1];
    for (int k = 0; k < 2; ++k) {
        const REAL p2 = p[k] * p[k], twice = p2 + e[k].product[0], inverse = REAL_RECIPROCAL(p[k] * twice);
        const REAL per_p1 = R(2.0) * (p2 * inverse);
        first[k] = R(0.5) * (p2 - e[k].product[0]) * (p[k] * inverse); /* Q_1 */
        scale[k] = per_p1 * per_p1;
        over[k] = under[k] = R(1.0);
    }
    for (int n = 1; n <= ELLIPTIC_STEPS; ++n)
        for (int k = 0; k < 2; ++k) {
            const REAL over2 = over[k] * over[k];
            const REAL mean2 = (under[k] * under[k]) * (e[k].product[n] * scale[k]);
            under[k] = R(2.0) * (over[k] * under[k]);
            over[k] = plus[k][n] = over2 + mean2;
            minus[k][n] = over2 - mean2;
        }
    for (int k = 0; k < 2; ++k) {
        REAL numerator = R(0.0), denominator = R(1.0); /* of (Q_(n+1) + Q_(n+2) + ...)/Q_n */
        for (int n = ELLIPTIC_STEPS; n >= 1; --n) {
            numerator = minus[k][n] * (denominator + numerator);
            denominator = R(2.0) * (plus[k][n] * denominator);
        }
        sum[k] = first[k] * (R(1.0) + numerator * REAL_RECIPROCAL(denominator));
    }
}
