/* real_two.h - bodies (*.inl) compiled over two doubles side by side, in a register that every processor has.
 *
 * The operations are those of real_double.h, so that each of the two has the bits that it would have alone.
 */
#ifndef FST_BASE_REAL_TWO_H
#define FST_BASE_REAL_TWO_H

#include "base/real_double.h"

#include "base/real_anew.h"

typedef long long fst_two_masks __attribute__((vector_size(16)));
typedef unsigned long long fst_two_bits __attribute__((vector_size(16)));

static inline fst_two_doubles fst_two_of(double x)
{
    return (fst_two_doubles){x, x};
}

static inline fst_two_doubles fst_two_select(fst_two_masks mask, fst_two_doubles yes, fst_two_doubles no)
{
    return (fst_two_doubles)((mask & (fst_two_masks)yes) | (~mask & (fst_two_masks)no));
}

#define FST_LANES 2

#define ENDS fst_two_doubles /* each end on its own */
#define ENDS_GROUPS 2
#define ENDS_OF(plus, minus)                                                                                   \
    {                                                                                                          \
        plus, minus                                                                                            \
    }
#define ENDS_SQRT(x) fst_sqrt_two_doubles(x)
#define END(sums, member, end) (sums)[end].member

#define RHS_KIND static inline
#define REAL_BITS fst_two_bits
#define REAL_AS_BITS(x) ((fst_two_bits)(x))
#define REAL_OF_BITS(bits) ((fst_two_doubles)(bits))

#define REAL fst_two_doubles
#define R(literal) fst_two_of(literal)
#define REAL_OF(x) fst_two_of((double)(x))
#define FN(name) fst_##name##_two
#define REAL_SQRT(x) fst_sqrt_two_doubles(x)
#define REAL_ABS(x) ((fst_two_doubles)((fst_two_bits)(x)&0x7fffffffffffffffULL))
#define REAL_MAX(a, b) fst_two_select((a) > (b), a, b)
#define REAL_MASK fst_two_masks
#define REAL_LESS(a, b) ((a) < (b))
#define REAL_LESS_EQUAL(a, b) ((a) <= (b))
#define REAL_ANY(mask) (((mask)[0] | (mask)[1]) != 0)
#define REAL_SELECT(mask, yes, no) fst_two_select(mask, yes, no)

#endif
