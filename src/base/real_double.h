/* real_double.h - bodies (*.inl) compiled over double.
 *
 * A body is written once over REAL, FN() and R() and includes no header of its own: the file that includes it
 * says for which kind of number it is compiled.  This is the portable form: only + - * / sqrt, and no fused
 * multiply-add, so that its bits are the same on every machine.  The lanes of an instruction set have wide.h
 * instead.
 */
#ifndef FST_BASE_REAL_DOUBLE_H
#define FST_BASE_REAL_DOUBLE_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/real_scalar.h"
#include "base/sums.h"
#ifdef __SSE2__
#include <emmintrin.h>
#endif

/* The two ends of a line of dipoles, computed side by side: two doubles fit into one of a processor's basic
 * registers. */
typedef double fst_two_doubles __attribute__((vector_size(16)));

static inline fst_two_doubles fst_sqrt_two_doubles(fst_two_doubles x)
{
#ifdef __SSE2__
    return (fst_two_doubles)_mm_sqrt_pd((__m128d)x);
#else
    return (fst_two_doubles){sqrt(x[0]), sqrt(x[1])};
#endif
}

#define ENDS fst_two_doubles /* both ends in one register */
#define ENDS_GROUPS 1
#define ENDS_OF(plus, minus)                                                                                   \
    {                                                                                                          \
        {                                                                                                      \
            plus, minus                                                                                        \
        }                                                                                                      \
    }
#define ENDS_SQRT(x) fst_sqrt_two_doubles(x)
#define END(sums, member, end) (sums)[0].member[end]

static inline uint64_t fst_bits_of_double(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double fst_double_of_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

#define REAL_PAIR fst_two_doubles /* two numbers that are stored at once */
#define REAL_BITS uint64_t        /* a double as the computer stores it: sign, exponent, fraction */
#define REAL_AS_BITS(x) fst_bits_of_double(x)
#define REAL_OF_BITS(bits) fst_double_of_bits(bits)

#define REAL double
#define R(literal) literal
#define FN(name) fst_##name##_double
#define REAL_SQRT(x) sqrt(x)
#define REAL_ABS(x) fabs(x)

#endif
