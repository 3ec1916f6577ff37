/* closing.h - does a motion repeat itself?  The marks at which it came back to where it was. */
#ifndef FST_OBSERVE_CLOSING_H
#define FST_OBSERVE_CLOSING_H

#include "observe/marks.h"

enum { FST_CLOSING_PAST = 8 }; /* marks back, which show the factor by which they come closer */

typedef struct fst_closing {
    double rtol;      /* of the integration */
    double limit;     /* states that differ by less are the same */
    int approached;   /* states that differed by far more have been seen */
    int count;        /* marks in a row that repeat; from the second on they are kept */
    fst_mark mark[3]; /* the latest of these, the last one last */
    int known;        /* the first so many of the distances of the latest marks, the last one first */
    double distances[FST_CLOSING_PAST + 1];
    int floored;     /* the errors of the steps may end the fall of the distances: dry friction's kinks */
    double far_at;   /* when they were last more than ten limits */
    int64_t repeats; /* marks in a row that repeat, */
    double
        since; /* the first of them at this time; the states at the last two whose number is a power of two */
    double stood[2][FST_STATE_SIZE];
} fst_closing;

void fst_closing_begin(fst_closing *c, double rtol);

/* What repeats, and how fast it came closer, has to be seen again. */
void fst_closing_forget(fst_closing *c);

/* The state at `mark` was so far from the nearest that it might have come back to. */
void fst_closing_see(fst_closing *c, const fst_mark *mark, double distance);

/* The motion came back to a section at `mark`, full_distance from where it was before.  1: it has settled on a
 * closed orbit; `until`: when the run ends if it has not. */
int fst_closing_add(fst_closing *c, const fst_mark *mark, double until);

/* Whether the next mark is to have its integrals. */
static inline int fst_closing_needs_integrals(const fst_closing *c)
{
    return c->count > 0;
}

/* The time from one mark to the next. */
double fst_closing_turn(const fst_closing *c);

/* How far the states at the marks still have to go, from the factor by which they come closer or came. */
double fst_closing_way(const fst_closing *c, double until);

/* A later mark of the motion that is known lies so far from the one before. */
void fst_closing_go_on(fst_closing *c, double distance);

/* Whether these marks stay together: there were enough of them, they are close, and they do not part. */
int fst_closing_holds(const fst_closing *c);

#endif
