/* real_long_double.h - bodies (*.inl) compiled over long double: the oracle of tests and benchmarks. */
#ifndef FST_BASE_REAL_LONG_DOUBLE_H
#define FST_BASE_REAL_LONG_DOUBLE_H

#include <math.h>

#include "base/sums.h"

#define ENDS long double /* ... or each on its own */
#define ENDS_GROUPS 2
#define ENDS_OF(plus, minus)                                                                                   \
    {                                                                                                          \
        plus, minus                                                                                            \
    }
#define ENDS_SQRT(x) sqrtl(x)
#define END(sums, member, end) (sums)[end].member

#define REAL long double
#define R(literal) literal##L
#define FN(name) fst_##name##_long_double
#define REAL_SQRT(x) sqrtl(x)
#define REAL_ABS(x) fabsl(x)
#define REAL_MAX(a, b) ((a) > (b) ? (a) : (b))
#define REAL_ROUGH_RECIPROCAL(x) (R(1.0) / (x)) /* where a kind of number may save digits */
#define REAL_OVER_SQRT(a, x) ((a) / REAL_SQRT(x))
#define RHS_KIND static inline
#define REAL_RECIPROCAL_SQRT(x) (R(1.0) / REAL_SQRT(x))
#define REAL_OF(x) ((REAL)(x)) /* a number of another type */
#define REAL_MULADD(a, b, c) ((a) * (b) + (c))
#define REAL_MULSUB(a, b, c) ((a) * (b) - (c))
#define REAL_NEGMULADD(a, b, c) ((c) - (a) * (b))

#endif
