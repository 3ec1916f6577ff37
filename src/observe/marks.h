/* marks.h - snapshots along a motion, thinned so that their number stays bounded however long it lasts. */
#ifndef FST_OBSERVE_MARKS_H
#define FST_OBSERVE_MARKS_H

#include "observe/quadrature.h"

/* A snapshot: everything added up until one moment. */
typedef struct fst_mark {
    fst_twofold t;
    double omega; /* drive */
    double integrals[FST_Q_COUNT];
    double bead_angle;   /* unwrapped Phi */
    double moment_angle; /* unwrapped phi */
    double energy;       /* kinetic and magnetic, per mass */
    double state[FST_STATE_SIZE];
    double half_distance; /* marks of returns: from the state half a return ago, its image under S2 */
    double full_distance; /* marks of returns: from the state a whole return ago */
    int64_t captures;     /* slips that have come to rest */
    int64_t touches;      /* steps in which the contact nearly let go */
    int64_t impacts;      /* of a bead that flies; the impulses that held it up, and the energy they took */
    double impulse, impact_loss;
    double activity; /* marks of periods: greatest speed in the turning frame since the mark before */
} fst_mark;

enum { FST_MARKS = 32 };

/* The first mark, every stride-th one after it, and the latest. */
typedef struct fst_mark_series {
    fst_mark kept[FST_MARKS + 1];
    int count;
    int64_t stride, offered;
    fst_mark latest;
} fst_mark_series;

void fst_marks_begin(fst_mark_series *series);

/* When `total` marks have been offered, those are kept whose index is a multiple of this. */
int64_t fst_marks_stride(int64_t total);

/* Offer the next mark of an evenly spaced series. */
void fst_marks_offer(fst_mark_series *series, const fst_mark *mark);

/* Whether the next mark that comes would be kept; else it may pass without being made. */
static inline int fst_marks_keeps_next(const fst_mark_series *series)
{
    return series->offered % series->stride == 0;
}

static inline void fst_marks_pass(fst_mark_series *series)
{
    series->offered += 1;
}

/* Greatest difference of two states, each vector against its own scale being of order one in scaled units. */
double fst_state_distance(const double *a, const double *b);

static inline double fst_time_between(const fst_mark *first, const fst_mark *last)
{
    return fst_twofold_difference(last->t, first->t);
}

/* The mean of an integrand between two marks. */
static inline double fst_mean_between(const fst_mark *first, const fst_mark *last, int which)
{
    return (last->integrals[which] - first->integrals[which]) / fst_time_between(first, last);
}

/* Snapshot at the fraction x of the flow's last step; `whole`: else without integrals, angles and energy. */
void fst_mark_take(fst_mark *mark, fst_quadrature *q, fst_flow *flow, double x, int whole);

#endif
