/* real_long_double.h - bodies (*.inl) compiled over long double: the oracle of tests and benchmarks. */
#ifndef FST_BASE_REAL_LONG_DOUBLE_H
#define FST_BASE_REAL_LONG_DOUBLE_H

#include <math.h>

#include "base/real_scalar.h"
#include "base/sums.h"

#define ENDS long double /* each end on its own */
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

#endif
