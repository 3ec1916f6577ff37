/* left_out.h - the part of a window that nobody observes, because the motion repeats itself in it. */
#ifndef FST_OBSERVE_LEFT_OUT_H
#define FST_OBSERVE_LEFT_OUT_H

#include "observe/marks.h"
#include "observe/span.h"

typedef enum fst_left_out_state {
    FST_LEFT_OUT_NOTHING, /* observed so far */
    FST_LEFT_OUT_BEFORE,  /* the returns repeat: three more are marked, */
    FST_LEFT_OUT_MIDDLE,  /* the second of them, */
    FST_LEFT_OUT_LAST,    /* and the third */
    FST_LEFT_OUT_AWAY,    /* the motion goes on, and nobody looks */
    FST_LEFT_OUT_FIRST,   /* the first whole return after that is awaited, */
    FST_LEFT_OUT_SECOND,  /* and the next */
    FST_LEFT_OUT_DONE,    /* integrals, marks and returns are those of the whole window */
    FST_LEFT_OUT_FAILED,  /* what came back was another motion: all of it has to be observed */
    FST_LEFT_OUT_NEVER    /* all of it is observed */
} fst_left_out_state;

typedef struct fst_left_out {
    fst_left_out_state state;
    double rtol;       /* of the integration */
    double limit;      /* returns that differ by less repeat */
    fst_mark mark[4];  /* the last three whole returns before the part, and the first after it */
    int64_t crossings; /* of the section in the part */
    int64_t returns;   /* whole returns from the last mark before it to the first after it */
    int is_counted;    /* these two are known */
} fst_left_out;

/* After a whole return was offered to `marks`.  1: from the end of this step on the motion need not be observed
 * until fst_left_out_until(). */
int fst_left_out_begin(fst_left_out *part, const fst_mark_series *marks, const fst_span *span);

/* The time of the last return before the part. */
double fst_left_out_turn(const fst_left_out *part);

/* When it is to be observed again; the state is then set to FST_LEFT_OUT_FIRST. */
double fst_left_out_until(const fst_left_out *part, const fst_span *span);

/* Whether a whole return is to be marked with its integrals, whatever else says. */
static inline int fst_left_out_needs_integrals(const fst_left_out *part)
{
    return part->state == FST_LEFT_OUT_BEFORE || part->state == FST_LEFT_OUT_MIDDLE ||
           part->state == FST_LEFT_OUT_LAST || part->state == FST_LEFT_OUT_FIRST ||
           part->state == FST_LEFT_OUT_SECOND;
}

/* The crossings that lie between the last one before the part and this one, the first after it. */
int64_t fst_left_out_count(fst_left_out *part, const fst_mark *crossing);

/* The first and the second whole return after the part; with the second, both and those in the part are offered
 * to `marks`, and q adds what was left out to its integrals. */
void fst_left_out_end(fst_left_out *part, const fst_mark *crossing, fst_mark_series *marks, fst_quadrature *q);

#endif
