/* bracket.h - an interval in which a function changes its sign, narrowed by the Illinois rule: regula falsi
 * that halves the value at an end which stays, and bisects now and then.
 *
 *     while (...) { x = fst_bracket_next(&b); ... f(x) ...; fst_bracket_narrow(&b, x, f); }
 */
#ifndef FST_BASE_BRACKET_H
#define FST_BASE_BRACKET_H

typedef struct fst_bracket {
    double low, high, f_low, f_high; /* the values differ in sign */
    int side, tries;                 /* 0 at the beginning */
} fst_bracket;

/* Where to look next: within the bracket. */
static inline double fst_bracket_next(fst_bracket *b)
{
    const double middle = 0.5 * (b->low + b->high);
    const double x = (b->low * b->f_high - b->high * b->f_low) / (b->f_high - b->f_low);
    const int inside = b->low < b->high ? x > b->low && x < b->high : x > b->high && x < b->low;
    return ++b->tries % 6 == 0 || !inside ? middle : x;
}

/* The function has the value f at x. */
static inline void fst_bracket_narrow(fst_bracket *b, double x, double f)
{
    if ((f < 0) == (b->f_low < 0)) {
        b->low = x, b->f_low = f;
        b->f_high *= b->side < 0 ? 0.5 : 1.0;
        b->side = -1;
    } else {
        b->high = x, b->f_high = f;
        b->f_low *= b->side > 0 ? 0.5 : 1.0;
        b->side = 1;
    }
}

#endif
