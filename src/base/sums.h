/* sums.h - sums of products, in one order for every kind of number: ((a1 b1 + a2 b2) + a3 b3) + ...
 *
 * Do not reorder: this order defines the published bits.  Each product is added by REAL_MULADD(a, b, sum),
 * which lanes with fused operations round once.
 */
#ifndef FST_BASE_SUMS_H
#define FST_BASE_SUMS_H

#define ADD_1(sum, a, b) REAL_MULADD(a, b, sum)
#define ADD_2(sum, a, b, ...) ADD_1(REAL_MULADD(a, b, sum), __VA_ARGS__)
#define ADD_3(sum, a, b, ...) ADD_2(REAL_MULADD(a, b, sum), __VA_ARGS__)
#define ADD_4(sum, a, b, ...) ADD_3(REAL_MULADD(a, b, sum), __VA_ARGS__)
#define ADD_5(sum, a, b, ...) ADD_4(REAL_MULADD(a, b, sum), __VA_ARGS__)
#define ADD_6(sum, a, b, ...) ADD_5(REAL_MULADD(a, b, sum), __VA_ARGS__)
#define ADD_7(sum, a, b, ...) ADD_6(REAL_MULADD(a, b, sum), __VA_ARGS__)
#define ADD_8(sum, a, b, ...) ADD_7(REAL_MULADD(a, b, sum), __VA_ARGS__)
#define ADD_9(sum, a, b, ...) ADD_8(REAL_MULADD(a, b, sum), __VA_ARGS__)
#define ADD_10(sum, a, b, ...) ADD_9(REAL_MULADD(a, b, sum), __VA_ARGS__)
#define ADD_11(sum, a, b, ...) ADD_10(REAL_MULADD(a, b, sum), __VA_ARGS__)

#define SUM_1(a, b) ((a) * (b))
#define SUM_2(a, b, ...) ADD_1((a) * (b), __VA_ARGS__)
#define SUM_3(a, b, ...) ADD_2((a) * (b), __VA_ARGS__)
#define SUM_4(a, b, ...) ADD_3((a) * (b), __VA_ARGS__)
#define SUM_5(a, b, ...) ADD_4((a) * (b), __VA_ARGS__)
#define SUM_6(a, b, ...) ADD_5((a) * (b), __VA_ARGS__)
#define SUM_7(a, b, ...) ADD_6((a) * (b), __VA_ARGS__)
#define SUM_8(a, b, ...) ADD_7((a) * (b), __VA_ARGS__)
#define SUM_9(a, b, ...) ADD_8((a) * (b), __VA_ARGS__)
#define SUM_10(a, b, ...) ADD_9((a) * (b), __VA_ARGS__)
#define SUM_11(a, b, ...) ADD_10((a) * (b), __VA_ARGS__)
#define SUM_12(a, b, ...) ADD_11((a) * (b), __VA_ARGS__)

#endif
