/* real_scalar.h - what real_double.h and real_long_double.h have in common.  The file that includes this
 * defines REAL, R() and REAL_SQRT(). */
#ifndef FST_BASE_REAL_SCALAR_H
#define FST_BASE_REAL_SCALAR_H

#define REAL_IS_SCALAR /* a number, not a lane of numbers each */
#define REAL_MAX(a, b) ((a) > (b) ? (a) : (b))
#define REAL_MASK int /* whether a comparison holds */
#define REAL_LESS(a, b) ((a) < (b))
#define REAL_LESS_EQUAL(a, b) ((a) <= (b))
#define REAL_EVERYWHERE 1     /* the mask of all lanes */
#define REAL_ANY(mask) (mask) /* whether a mask holds in some lane */
#define REAL_SELECT(mask, yes, no) ((mask) ? (yes) : (no))
#define REAL_ROUGH_RECIPROCAL(x) (R(1.0) / (x)) /* lanes may compute this to fewer digits */
#define REAL_OVER_SQRT(a, x) ((a) / REAL_SQRT(x))
#define RHS_KIND static inline
#define REAL_RECIPROCAL_SQRT(x) (R(1.0) / REAL_SQRT(x))
#define REAL_ROOT(x, inverse) REAL_SQRT(x) /* lanes may make it of its inverse */
#define REAL_RECIPROCAL(x) (R(1.0) / (x))
#define REAL_QUOTIENT(a, b) ((a) / (b))
#define REAL_OF(x) ((REAL)(x)) /* from a number of another type */
#define REAL_MULADD(a, b, c) ((a) * (b) + (c))
#define REAL_MULSUB(a, b, c) ((a) * (b) - (c))
#define REAL_NEGMULADD(a, b, c) ((c) - (a) * (b))

#endif
