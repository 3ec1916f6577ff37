/* compensated.h - numbers kept as the unevaluated sum of two doubles. */
#ifndef FST_BASE_COMPENSATED_H
#define FST_BASE_COMPENSATED_H

#include <math.h>

#include "base/real_double.h"

#include "base/twofold.inl"

typedef fst_twofold_double fst_twofold;

static inline fst_twofold fst_twofold_add(fst_twofold a, double x)
{
    return fst_twofold_add_double(a, x);
}

static inline double fst_twofold_difference(fst_twofold a, fst_twofold b)
{
    return fst_twofold_difference_double(a, b);
}

/* a x, to about twice the precision of a double. */
static inline fst_twofold fst_twofold_times(fst_twofold a, double x)
{
    const double high = a.high * x, error = fma(a.high, x, -high) + a.low * x;
    const fst_twofold result = {high + error, error - ((high + error) - high)};
    return result;
}

#endif
