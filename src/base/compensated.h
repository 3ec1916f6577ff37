/* compensated.h - numbers kept as the unevaluated sum of two doubles. */
#ifndef FST_BASE_COMPENSATED_H
#define FST_BASE_COMPENSATED_H

#include <math.h>

typedef struct fst_twofold {
    double high, low;
} fst_twofold;

/* a + x, without loss (Knuth's two-sum, then the low parts). */
static inline fst_twofold fst_twofold_add(fst_twofold a, double x)
{
    const double sum = a.high + x, part = sum - a.high;
    const double error = (a.high - (sum - part)) + (x - part);
    const double low = a.low + error, high = sum + low;
    const fst_twofold result = {high, low - (high - sum)};
    return result;
}

/* a - b, rounded to one double. */
static inline double fst_twofold_difference(fst_twofold a, fst_twofold b)
{
    return (a.high - b.high) + (a.low - b.low);
}

/* a x, to about twice the precision of a double. */
static inline fst_twofold fst_twofold_times(fst_twofold a, double x)
{
    const double high = a.high * x, error = fma(a.high, x, -high) + a.low * x;
    const fst_twofold result = {high + error, error - ((high + error) - high)};
    return result;
}

#endif
