/* bracket.h - the zero of a function between two places of opposite sign, by false position.
 *
 * The Illinois rule makes both places close in: where one place stays for the second time in a row, its value
 * is halved before the next step.
 */
#ifndef FST_BASE_BRACKET_H
#define FST_BASE_BRACKET_H

typedef struct fst_bracket {
    double lo, hi;     /* two places, in any order ... */
    double f_lo, f_hi; /* ... and the values there, of opposite signs; halved where the rule says so */
    int side;          /* which place moved last: -1 lo, 1 hi, 0 none yet */
} fst_bracket;

/* The next place to evaluate the function: the zero of the straight line through both values, or the middle
 * where rounding puts that zero outside. */
static inline double fst_bracket_next(const fst_bracket *b)
{
    const double x = (b->lo * b->f_hi - b->hi * b->f_lo) / (b->f_hi - b->f_lo);
    return (x - b->lo) * (b->hi - x) > 0 ? x : 0.5 * (b->lo + b->hi);
}

/* Take the value `f` at the place `x`, which replaces the end whose value has the same sign. */
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
