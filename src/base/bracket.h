/* bracket.h - the zero of a function between two places, by false position with Illinois' rule: a place that
 * stays for a second time counts half, so that both close in. */
#ifndef FST_BASE_BRACKET_H
#define FST_BASE_BRACKET_H

typedef struct fst_bracket {
    double lo, hi;     /* places, in any order ... */
    double f_lo, f_hi; /* ... with values of opposite signs, those that count half halved */
    int side;          /* which place moved last: -1 lo, 1 hi, 0 none yet */
} fst_bracket;

/* Where to look next; the middle where rounding leaves no place between. */
static inline double fst_bracket_next(const fst_bracket *b)
{
    const double x = (b->lo * b->f_hi - b->hi * b->f_lo) / (b->f_hi - b->f_lo);
    return (x - b->lo) * (b->hi - x) > 0 ? x : 0.5 * (b->lo + b->hi);
}

/* The value there. */
static inline void fst_bracket_take(fst_bracket *b, double x, double f)
{
    if ((f < 0) == (b->f_lo < 0)) {
        b->lo = x;
        b->f_lo = f;
        b->f_hi *= b->side < 0 ? 0.5 : 1.0;
        b->side = -1;
    } else {
        b->hi = x;
        b->f_hi = f;
        b->f_lo *= b->side > 0 ? 0.5 : 1.0;
        b->side = 1;
    }
}

#endif
