/* wide.h - bodies (*.inl) compiled over 4 or 8 doubles side by side, one trajectory in each lane.
 *
 * The file that includes this defines FST_LANES (4: AVX2, 8: AVX-512) and, for the fast form, FST_FUSED.  It is
 * compiled with the flags of its instruction set, and no wide value leaves it.  + - * / are the compiler's
 * vector operations; the rest is here.  The portable form does the operations of real_double.h and so has its
 * bits, lane by lane.  The fast form fuses a multiplication with an addition where a body says REAL_MULADD, and
 * computes reciprocal square roots from the processor's estimate.
 */
#ifndef FST_BASE_WIDE_H
#define FST_BASE_WIDE_H

#include <immintrin.h>

#include "base/real_scalar.h"
#include "base/sums.h"

/* The portable form keeps the products and quotients of real_scalar.h. */
#include "base/real_anew.h"

typedef double fst_wide __attribute__((vector_size(8 * FST_LANES), may_alias));
typedef long long fst_wide_bits __attribute__((vector_size(8 * FST_LANES), may_alias));
typedef unsigned long long fst_wide_unsigned __attribute__((vector_size(8 * FST_LANES), may_alias));

static inline fst_wide fst_wide_of(double x)
{
    return x - (fst_wide){0};
}

#if FST_LANES == 8
#define WIDE_NATIVE(x) ((__m512d)(x))
#define WIDE_OPERATION(name) _mm512_##name##_pd

typedef __mmask8 fst_wide_mask;
#define WIDE_LESS(a, b) _mm512_cmp_pd_mask(WIDE_NATIVE(a), WIDE_NATIVE(b), _CMP_LT_OQ)
#define WIDE_LESS_EQUAL(a, b) _mm512_cmp_pd_mask(WIDE_NATIVE(a), WIDE_NATIVE(b), _CMP_LE_OQ)

static inline fst_wide fst_wide_select(fst_wide_mask mask, fst_wide yes, fst_wide no)
{
    return (fst_wide)_mm512_mask_blend_pd(mask, WIDE_NATIVE(no), WIDE_NATIVE(yes));
}

static inline fst_wide_mask fst_wide_mask_of(unsigned lanes)
{
    return (fst_wide_mask)lanes;
}

static inline unsigned fst_wide_lanes_of(fst_wide_mask mask)
{
    return mask;
}
#else
#define WIDE_NATIVE(x) ((__m256d)(x))
#define WIDE_OPERATION(name) _mm256_##name##_pd

typedef __m256d fst_wide_mask;
#define WIDE_LESS(a, b) _mm256_cmp_pd(WIDE_NATIVE(a), WIDE_NATIVE(b), _CMP_LT_OQ)
#define WIDE_LESS_EQUAL(a, b) _mm256_cmp_pd(WIDE_NATIVE(a), WIDE_NATIVE(b), _CMP_LE_OQ)

static inline fst_wide fst_wide_select(fst_wide_mask mask, fst_wide yes, fst_wide no)
{
    return (fst_wide)_mm256_blendv_pd(WIDE_NATIVE(no), WIDE_NATIVE(yes), mask);
}

static inline fst_wide_mask fst_wide_mask_of(unsigned lanes)
{
    const fst_wide_bits bit = {1, 2, 4, 8};
    return (fst_wide_mask)((bit & (long long)lanes) != 0);
}

static inline unsigned fst_wide_lanes_of(fst_wide_mask mask)
{
    return (unsigned)_mm256_movemask_pd(mask);
}
#endif

#define WIDE_SQRT(x) ((fst_wide)WIDE_OPERATION(sqrt)(WIDE_NATIVE(x)))
#define WIDE_MAX(a, b) ((fst_wide)WIDE_OPERATION(max)(WIDE_NATIVE(a), WIDE_NATIVE(b)))
#define WIDE_MULADD(a, b, c) ((fst_wide)WIDE_OPERATION(fmadd)(WIDE_NATIVE(a), WIDE_NATIVE(b), WIDE_NATIVE(c)))
#define WIDE_MULSUB(a, b, c) ((fst_wide)WIDE_OPERATION(fmsub)(WIDE_NATIVE(a), WIDE_NATIVE(b), WIDE_NATIVE(c)))
#define WIDE_NEGMULADD(a, b, c)                                                                                \
    ((fst_wide)WIDE_OPERATION(fnmadd)(WIDE_NATIVE(a), WIDE_NATIVE(b), WIDE_NATIVE(c)))

static inline fst_wide fst_wide_add_where(fst_wide_mask mask, fst_wide a, fst_wide b)
{
    return fst_wide_select(mask, a + b, a);
}

static inline fst_wide fst_wide_abs(fst_wide x)
{
    return (fst_wide)((fst_wide_bits)x & 0x7fffffffffffffffLL);
}

#ifdef FST_FUSED
/* y (1 + e/2 + 3 e^2/8 + 5 e^3/16) with e = 1 - x y^2: the next terms of the series leave 0.27 e^4 of an
 * estimate y of 1/sqrt(x). */
static inline fst_wide fst_wide_improve(fst_wide x, fst_wide y)
{
    const fst_wide e = WIDE_NEGMULADD(x * y, y, fst_wide_of(1.0));
    const fst_wide series =
        WIDE_MULADD(e, WIDE_MULADD(e, fst_wide_of(0.3125), fst_wide_of(0.375)), fst_wide_of(0.5));
    return WIDE_MULADD(y * e, series, y);
}

#if FST_LANES == 4
/* 1/sqrt(x) to 3.5 %, from the number's exponent.  The instruction that estimates 4 floats is not used: its
 * bits differ between makes of processor. */
static inline fst_wide fst_wide_guess_reciprocal_sqrt(fst_wide x)
{
    const fst_wide_bits bits = 0x5fe6eb50c7b537a9LL - ((fst_wide_bits)_mm256_srli_epi64((__m256i)x, 1));
    return (fst_wide)bits;
}
#endif

static inline fst_wide fst_wide_reciprocal_sqrt(fst_wide x)
{
#if FST_LANES == 8
    /* Correct to 2^-14, by definition of the instruction. */
    return fst_wide_improve(x, (fst_wide)_mm512_rsqrt14_pd(WIDE_NATIVE(x)));
#else
    return fst_wide_improve(x, fst_wide_improve(x, fst_wide_guess_reciprocal_sqrt(x)));
#endif
}

/* An estimate of 1/sqrt(x) for fst_wide_inverse_fifth(). */
static inline fst_wide fst_wide_estimate_reciprocal_sqrt(fst_wide x)
{
#if FST_LANES == 8
    return (fst_wide)_mm512_rsqrt14_pd(WIDE_NATIVE(x));
#else
    /* A guess from the exponent, whose t = x y^2 lies within [0.8699, 0.9861], and the quadratic in t that is
     * closest to 1/sqrt(t) there: to 2e-5.  No instruction that estimates is used: their bits differ between
     * makes of processor. */
    const fst_wide_bits bits = 0x5fe5eb50c7b537a9LL - ((fst_wide_bits)_mm256_srli_epi64((__m256i)x, 1));
    const fst_wide y = (fst_wide)bits, t = (x * y) * y;
    const fst_wide linear = WIDE_MULADD(t, fst_wide_of(0.4532913144151125), fst_wide_of(-1.4016407290732658));
    return y * WIDE_MULADD(t, linear, fst_wide_of(1.9484233829085937));
#endif
}

/* x^(-5/2) = y^5 (1 - e)^(-5/2) with e = 1 - x y^2 and an estimate y of 1/sqrt(x), for x between 1e-30 and
 * 1e30: one series for root, quotient and power. */
static inline fst_wide fst_wide_inverse_fifth(fst_wide x, fst_wide y)
{
    const fst_wide one = fst_wide_of(1.0), first = fst_wide_of(2.5);
    const fst_wide y2 = y * y, e = WIDE_NEGMULADD(x, y2, one);
#if FST_LANES == 8
    /* |e| < 1.23e-4.  Beyond 105/16 e^3 there is 9.02 e^4, whose best approximation by e^2 is added to 35/8 and
     * leaves 3.4e-16. */
    const fst_wide second = fst_wide_of(4.375 + 1.1135e-7);
#else
    /* |e| < 4e-5: the next term, 9.02 e^4, is below rounding. */
    const fst_wide second = fst_wide_of(4.375);
#endif
    const fst_wide rest = WIDE_MULADD(e, fst_wide_of(6.5625), second);
    const fst_wide series = WIDE_MULADD(e, WIDE_MULADD(e, rest, first), one);
    return ((y2 * y2) * y) * series;
}

/* 1/x = y^2/(1 - e) of the same y and e. */
static inline fst_wide fst_wide_inverse(fst_wide x, fst_wide y)
{
    const fst_wide one = fst_wide_of(1.0), y2 = y * y, e = WIDE_NEGMULADD(x, y2, one);
    const fst_wide rest = WIDE_MULADD(e, e, e); /* e + e^2 + e^3; e^4 < 2.3e-16 */
    return WIDE_MULADD(y2, WIDE_MULADD(e, rest, e), y2);
}

/* 1/x */
static inline fst_wide fst_wide_reciprocal(fst_wide x)
{
#if FST_LANES == 8
    const fst_wide y = (fst_wide)_mm512_rcp14_pd(WIDE_NATIVE(x)); /* to 2^-14 */
    const fst_wide e = WIDE_NEGMULADD(x, y, fst_wide_of(1.0)), rest = WIDE_MULADD(e, e, e);
    return WIDE_MULADD(y, WIDE_MULADD(e, rest, e), y); /* y/(1 - e) */
#else
    return 1.0 / x; /* there is no estimate that all processors share */
#endif
}

/* a/b */
static inline fst_wide fst_wide_quotient(fst_wide a, fst_wide b)
{
#if FST_LANES == 8
    const fst_wide inverse = fst_wide_reciprocal(b), quotient = a * inverse;
    return WIDE_MULADD(WIDE_NEGMULADD(quotient, b, a), inverse, quotient);
#else
    return a / b;
#endif
}

/* 1/x to 1e-8 (AVX-512) or 1.4e-5, which is enough to scale errors. */
static inline fst_wide fst_wide_rough_reciprocal(fst_wide x)
{
#if FST_LANES == 8
    const fst_wide y = (fst_wide)_mm512_rcp14_pd(WIDE_NATIVE(x));
    return y * WIDE_NEGMULADD(x, y, fst_wide_of(2.0));
#else
    /* A guess from the exponent, with t = x y within [0.8710, 0.9399], and a quadratic for 1/t. */
    const fst_wide y = (fst_wide)(0x7fdbdf73aabb2400LL - (fst_wide_bits)x), t = x * y;
    const fst_wide linear = WIDE_MULADD(t, fst_wide_of(1.3486176218075614), fst_wide_of(-3.663285359697002));
    return y * WIDE_MULADD(t, linear, fst_wide_of(3.315694663561601));
#endif
}

/* 1/sqrt(x) to about 1e-4, which is enough to choose a step size.  It is short because nothing else can be
 * computed until the next step size is known. */
static inline fst_wide fst_wide_rough_reciprocal_sqrt(fst_wide x)
{
#if FST_LANES == 8
    return (fst_wide)_mm512_rsqrt14_pd(WIDE_NATIVE(x));
#else
    return fst_wide_improve(x, fst_wide_guess_reciprocal_sqrt(x));
#endif
}

/* x^(-1/8) by three reciprocal roots. */
static inline fst_wide fst_wide_inverse_eighth_root(fst_wide x)
{
    const fst_wide half = fst_wide_rough_reciprocal_sqrt(x);
    const fst_wide quarter = half * fst_wide_rough_reciprocal_sqrt(half);
    return quarter * fst_wide_rough_reciprocal_sqrt(quarter);
}

#undef REAL_RECIPROCAL_SQRT
#undef REAL_MULADD
#undef REAL_MULSUB
#undef REAL_NEGMULADD
#undef REAL_ROUGH_RECIPROCAL
#undef REAL_OVER_SQRT
#undef REAL_ROOT
#undef REAL_RECIPROCAL
#undef REAL_QUOTIENT
#define REAL_MULADD(a, b, c) WIDE_MULADD(a, b, c)
#define REAL_MULSUB(a, b, c) WIDE_MULSUB(a, b, c)
#define REAL_NEGMULADD(a, b, c) WIDE_NEGMULADD(a, b, c)
#define REAL_RECIPROCAL_SQRT(x) fst_wide_reciprocal_sqrt(x)
#define REAL_FAST_RECIPROCAL_SQRT(x)                                                                           \
    fst_wide_reciprocal_sqrt(x) /* this form computes it without a root and a quotient */
#define REAL_ROOT(x, inverse) ((x) * (inverse))
#define REAL_RECIPROCAL(x) fst_wide_reciprocal(x)
#define REAL_QUOTIENT(a, b) fst_wide_quotient(a, b)
#define REAL_ESTIMATE_RECIPROCAL_SQRT(x) fst_wide_estimate_reciprocal_sqrt(x)
#define REAL_DIVIDER_IS_FREE (FST_LANES == 4)
#define REAL_FEW_REGISTERS (FST_LANES == 4)
#define REAL_INVERSE_FIFTH(x, estimate) fst_wide_inverse_fifth(x, estimate)
#define REAL_INVERSE(x, estimate) fst_wide_inverse(x, estimate)
#define REAL_ROUGH_RECIPROCAL(x) fst_wide_rough_reciprocal(x)
#define REAL_OVER_SQRT(a, x) ((a)*fst_wide_rough_reciprocal_sqrt(x)) /* to four digits */
#define REAL_INVERSE_EIGHTH_ROOT(x) fst_wide_inverse_eighth_root(x)
#endif

/* A right-hand side is long and called thirteen times a step, so it is not inlined.  noipa also keeps gcc from
 * looking into it: gcc would find numbers that the call leaves unchanged and keep them on the stack, more of
 * them than fit into the first cache. */
#ifdef __clang__
#define RHS_KIND static __attribute__((noinline))
#else
#define RHS_KIND static __attribute__((noipa))
#endif

#ifdef FST_FUSED
#define REAL_FORCES_AHEAD /* forces first, then the stages' sums */
#endif

#define ENDS fst_wide /* the registers are full: each end on its own */
#define ENDS_GROUPS 2
#define ENDS_OF(plus, minus)                                                                                   \
    {                                                                                                          \
        plus, minus                                                                                            \
    }
#define ENDS_SQRT(x) WIDE_SQRT(x)
#define END(sums, member, end) (sums)[end].member

#define REAL_BITS fst_wide_unsigned
#define REAL_AS_BITS(x) ((fst_wide_unsigned)(x))
#define REAL_OF_BITS(bits) ((fst_wide)(bits))

#define REAL fst_wide
#define R(literal) fst_wide_of(literal)
#define REAL_OF(x) fst_wide_of((double)(x))
#define FN(name) fst_##name##_wide
#define REAL_SQRT(x) WIDE_SQRT(x)
#define REAL_ABS(x) fst_wide_abs(x)
#define REAL_MAX(a, b) WIDE_MAX(a, b)
#define REAL_MASK fst_wide_mask
#define REAL_LESS(a, b) WIDE_LESS(a, b)
#define REAL_LESS_EQUAL(a, b) WIDE_LESS_EQUAL(a, b)
#define REAL_EVERYWHERE fst_wide_mask_of((1u << FST_LANES) - 1u)
#define REAL_ANY(mask) (fst_wide_lanes_of(mask) != 0)
#define REAL_SELECT(mask, yes, no) fst_wide_select(mask, yes, no)

#endif
