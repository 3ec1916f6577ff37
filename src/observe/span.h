/* span.h - when a window begins and ends, and whether anybody asks before its end. */
#ifndef FST_OBSERVE_SPAN_H
#define FST_OBSERVE_SPAN_H

typedef struct fst_span {
    double from, until;
    /* Nothing is asked of the window before `until`: marks that will not be kept are then taken without
     * integrals, or not at all. */
    int asked_at_end;
    int states_only; /* nothing but states is observed: marks have no integrals, and there are no extremes */
} fst_span;

#endif
