/* growth.h - an exponential rate and its error, from the logarithms by which something grew in pieces of time.
 *
 * The logarithm of a length grows as  log(length) = rate t + B(t):  B is bounded where the motion is regular
 * (the directions that are followed stand at angles that change along the orbit, and two of them may turn
 * around each other), and wanders where it is chaotic.  A plain mean over a time T is off by (B(T) - B(0))/T,
 * which the scatter of blocks does not show.  Here the growth is weighted by a window that rises from zero and
 * falls back to it,
 *
 *     w(s) = 1 - cos(2 pi s),  0 < s < 1,
 *
 * so that a swing of m cycles within the window leaves 1/m^2 of that error.  The price is an error larger by
 * sqrt(3/2) where the motion is chaotic.  The error comes from the same means over parts of the time; see
 * growth.c.
 */
#ifndef FST_STUDY_GROWTH_H
#define FST_STUDY_GROWTH_H

/* The parts over which means are taken beside the whole: halves, thirds, overlapping quarters and eighths. */
enum { FST_GROWTH_WINDOWS = 1 + 2 + 3 + 7 + 15 };

/* The time over which means are taken, and how much of it has passed. */
typedef struct fst_growth_clock {
    double duration, passed;
    double
        weight[FST_GROWTH_WINDOWS]; /* of the piece last passed, in each window; their sum over the pieces is 1
                                     */
} fst_growth_clock;

/* One quantity that grows. */
typedef struct fst_growth {
    double rate[FST_GROWTH_WINDOWS]; /* weighted means, complete when the clock has passed its duration */
} fst_growth;

typedef struct fst_growth_rate {
    double value, error;
    double chance; /* standard error as if the rate were the same all the time; the error is no less */
} fst_growth_rate;

/* The clock passes a piece of the time; then each quantity adds what its logarithm grew by meanwhile. */
void fst_growth_pass(fst_growth_clock *clock, double piece);
void fst_growth_add(fst_growth *growth, const fst_growth_clock *clock, double logarithm);

/* The rate over the whole time.  The error is seen from differences between parts of the time.  It does not see
 * a drift of the length that is spread evenly over the time, as from a direction that still turns into its
 * place: where that can happen, the caller adds an error for it. */
fst_growth_rate fst_growth_conclude(const fst_growth *growth);

#endif
