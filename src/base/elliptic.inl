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
#define ELLIPTIC_ROOT(x) REAL_ROOT(x, REAL_RECIPROCAL_SQRT(x))

typedef struct FN(elliptic) {
    REAL mean;                        /* M */
    REAL below;                       /* a_1 - M = c_2 + c_3 + ..., to its last digit */
    REAL squares;                     /* (sum of 2^(n-1) c_n^2, n >= 2)/c_1^4, the same */
    REAL product[ELLIPTIC_STEPS + 1]; /* a_n b_n */
} FN(elliptic);

/* From a_1, a_0 b_0 = b_1^2 and c_1. */
static inline FN(elliptic) FN(elliptic_mean)(REAL a, REAL product, REAL c)
{
    FN(elliptic) e;
    REAL b = ELLIPTIC_ROOT(product), weight = R(2.0);
    e.product[0] = product;
    e.product[1] = a * b;
    a = R(0.5) * (a + b);
    const REAL quarter = R(0.25) * REAL_RECIPROCAL(a), c2 = c * c * quarter; /* quarter: 1/(4 a_2) */
    REAL share = R(1.0), shares = share, squares = share; /* c_n/c_2, their sum, that of 2^(n-2) (c_n/c_2)^2 */
    for (int n = 2; n <= ELLIPTIC_STEPS; ++n) {
        b = ELLIPTIC_ROOT(e.product[n - 1]);
        e.product[n] = a * b;
        a = R(0.5) * (a + b);
        share = share * share * c2 * (R(0.25) * REAL_RECIPROCAL(a));
        shares = shares + share;
        squares = REAL_MULADD(weight * share, share, squares);
        weight = weight + weight;
    }
    e.mean = R(0.5) * (a + ELLIPTIC_ROOT(e.product[ELLIPTIC_STEPS]));
    e.below = c2 * shares;
    e.squares = R(2.0) * squares * quarter * quarter;
    return e;
}

/* The sum of Q_n, n >= 1, from p_0, which must not be much less than b_0 nor much greater than a_0: p_n then
 * comes to M as fast as a_n does. */
static inline REAL FN(elliptic_third)(const FN(elliptic) * e, REAL p)
{
    REAL q = R(1.0), sum = R(0.0);
    for (int n = 0; n <= ELLIPTIC_STEPS; ++n) {
        const REAL p2 = p * p, twice = p2 + e->product[n]; /* 2 p p_next */
        const REAL share = R(0.5) * REAL_RECIPROCAL(p * twice);
        q = q * ((p2 - e->product[n]) * (p * share));
        sum = sum + q;
        p = twice * twice * share;
    }
    return sum;
}
