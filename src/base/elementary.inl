/* elementary.inl - logarithm and arctangent over REAL, by + - * / and the bits of a number alone.
 *
 * Lanes need them, the C library's differ from machine to machine, and a magnet's field needs them of ratios
 * whose parts are known better than the ratio.
 *
 *     log(p/q):       p/q = 2^k p/(2^k q) with the ratio of the rest between 2/3 and 3/2, and then
 *                     log(p/q) = k log 2 + 2 artanh(s),  s = (p - q)/(p + q),  |s| <= 1/5;
 *     atan2(y, x):    of t = least(|x|, |y|)/greatest(|x|, |y|) the arctangent nearest to it of 0, 1/2 and 1 is
 *                     taken off:  atan(t) = atan(T) + atan((t - T)/(1 + t T)),  |(t - T)/(1 + t T)| < 0.2361.
 *
 * Of the series that remain the leading term is added last.  The others are, for doubles, the polynomials of
 * degree 7 in the square that come nearest to them (Chebyshev's, made with 60 digits: within 1e-18 of
 * artanh(s)/s and 7e-18 of atan(t)/t), and for long double the series themselves.
 */
#ifdef REAL_BITS
static const double FN(artanh_rest)[] = {0.3333333333333333,  0.2000000000000397,  0.14285714283637968,
                                         0.11111111524175794, 0.09090868813151469, 0.07694433902806859,
                                         0.06604854121029731, 0.06804515131429249};
static const double FN(atan_rest)[] = {-0.3333333333333332,  0.1999999999997158,  -0.14285714274997233,
                                       0.11111109568616877,  -0.0909079978066757, 0.07688083097039321,
                                       -0.06575466622199681, 0.04836250825714187};
#else
static const REAL FN(artanh_rest)[] = {R(1.0) / 3,  R(1.0) / 5,  R(1.0) / 7,  R(1.0) / 9,  R(1.0) / 11,
                                       R(1.0) / 13, R(1.0) / 15, R(1.0) / 17, R(1.0) / 19, R(1.0) / 21,
                                       R(1.0) / 23, R(1.0) / 25, R(1.0) / 27, R(1.0) / 29};
static const REAL FN(atan_rest)[] = {
    -R(1.0) / 3,  R(1.0) / 5,  -R(1.0) / 7,  R(1.0) / 9,  -R(1.0) / 11, R(1.0) / 13, -R(1.0) / 15, R(1.0) / 17,
    -R(1.0) / 19, R(1.0) / 21, -R(1.0) / 23, R(1.0) / 25, -R(1.0) / 27, R(1.0) / 29, -R(1.0) / 31, R(1.0) / 33};
#endif
#define ADD_SERIES(table, x) FN(add_series)(table, (int)(sizeof(table) / sizeof *(table)), x)

/* sum of table[n] x^n */
#ifdef REAL_BITS
static inline __attribute__((always_inline)) REAL FN(add_series)(const double *table, int terms, REAL x)
#else
static inline __attribute__((always_inline)) REAL FN(add_series)(const REAL *table, int terms, REAL x)
#endif
{
    REAL sum = REAL_OF(table[terms - 1]);
    for (int n = terms - 2; n >= 0; --n)
        sum = REAL_MULADD(sum, x, REAL_OF(table[n]));
    return sum;
}

/* k and 2^k, such that p/(2^k q) lies between 2/3 and 3/2; k = 0 where p/q does so. */
static inline __attribute__((always_inline)) REAL FN(binary_exponent)(REAL p, REAL q, REAL *power)
{
#ifdef REAL_BITS
    /* Up to a factor the bits of a positive number are its logarithm, of which this is the rounded difference;
     * 2048 keeps it positive. */
    const REAL_BITS k =
        (REAL_AS_BITS(p) - REAL_AS_BITS(q) + 0x0008000000000000ULL + 0x8000000000000000ULL) >> 52;
    *power = REAL_OF_BITS((k - 1025) << 52);
    /* A number in the last bits of 2^52. */
    return REAL_OF_BITS(k | 0x4330000000000000ULL) - R(4503599627372544.0); /* 2^52 + 2048 */
#else
    int k, of_q;
    const REAL ratio = frexpl(p, &k) / frexpl(q, &of_q); /* between 1/2 and 2 */
    k = k - of_q + (ratio > R(1.5) ? 1 : ratio < R(0.75) ? -1 : 0);
    *power = ldexpl(R(1.0), k);
    return REAL_OF(k);
#endif
}

/* log(p/q) of p, q > 0 and p - q, which the caller may know better than it follows from the rounded p and q. */
static inline __attribute__((always_inline)) REAL FN(log_of_ratio)(REAL p, REAL q, REAL p_minus_q)
{
    const REAL high = R(0x1.62e42fefa38p-1), low = R(0x1.ef35793c7673007e5fp-45); /* of log 2 */
    REAL power;
    const REAL k = FN(binary_exponent)(p, q, &power), scaled = q * power;
    const REAL_MASK close = REAL_LESS(REAL_ABS(k), R(0.5));
    const REAL s = REAL_QUOTIENT(REAL_SELECT(close, p_minus_q, p - scaled), p + scaled);
    const REAL twice = s + s, s2 = s * s;
    const REAL rest = twice * (s2 * ADD_SERIES(FN(artanh_rest), s2));
    return REAL_MULADD(k, high, REAL_MULADD(k, low, rest) + twice);
}

/* The angle of the point (x, y), from -pi to pi; of the origin 0 or pi, as C has it. */
static inline __attribute__((always_inline)) REAL FN(angle)(REAL y, REAL x)
{
    const REAL zero = R(0.0), one = R(1.0);
    const REAL ax = REAL_ABS(x), ay = REAL_ABS(y);
    const REAL_MASK steep = REAL_LESS(ax, ay);
    const REAL great = REAL_SELECT(steep, ay, ax), small = REAL_SELECT(steep, ax, ay);
    /* T, atan(T) in two parts */
    const REAL_MASK middle = REAL_LESS(R(0.2360679) * great, small), upper = REAL_LESS(R(0.72) * great, small);
    const REAL step = REAL_SELECT(upper, one, REAL_SELECT(middle, R(0.5), zero));
    const REAL high =
        REAL_SELECT(upper, R(0x1.921fb54442d18p-1), REAL_SELECT(middle, R(0x1.dac670561bb4fp-2), zero));
    const REAL low =
        REAL_SELECT(upper, R(0x1.1a62633145c06e0ep-55), REAL_SELECT(middle, R(0x1.a2b7f222f65e2p-56), zero));
    const REAL over = REAL_NEGMULADD(step, great, small), under = REAL_MULADD(step, small, great);
    const REAL t = REAL_QUOTIENT(over, REAL_SELECT(REAL_LESS(zero, great), under, one)), t2 = t * t;
    const REAL bent = t * (t2 * ADD_SERIES(FN(atan_rest), t2)); /* atan(t) - t */
    /* pi/2 - and pi - */
    const REAL first = high + (t + (low + bent));
    const REAL quarter =
        REAL_SELECT(steep, R(0x1.921fb54442d18p0) - (first - R(0x1.1a62633145c06e0ep-54)), first);
    const REAL turned = R(0x1.921fb54442d18p1) - (quarter - R(0x1.1a62633145c06e0ep-53));
    const REAL above = REAL_SELECT(REAL_LESS(x, zero), turned, quarter);
    return REAL_SELECT(REAL_LESS(y, zero), -above, above);
}
#undef ADD_SERIES
