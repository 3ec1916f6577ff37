/* twofold.inl - a number kept as the unevaluated sum of two, over REAL: times and integrals, to which small
 * amounts are added many times over, so lose no digits. */
typedef struct FN(twofold) {
    REAL high, low;
} FN(twofold);

/* a + x, without loss (Knuth's two-sum, then the low parts). */
static inline FN(twofold) FN(twofold_add)(FN(twofold) a, REAL x)
{
    const REAL sum = a.high + x, part = sum - a.high;
    const REAL error = (a.high - (sum - part)) + (x - part);
    const REAL low = a.low + error, high = sum + low;
    const FN(twofold) result = {high, low - (high - sum)};
    return result;
}

/* a - b, rounded to one REAL. */
static inline REAL FN(twofold_difference)(FN(twofold) a, FN(twofold) b)
{
    return (a.high - b.high) + (a.low - b.low);
}
