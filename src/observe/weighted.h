/* weighted.h - the numbers that a run by the splitting method is observed by (weighted.inl). */
#ifndef FST_OBSERVE_WEIGHTED_H
#define FST_OBSERVE_WEIGHTED_H

/* Quantities whose weighted means are taken. */
enum {
    FST_MEAN_R,
    FST_MEAN_R2, /* R2, B2: squared deviations from the values at the beginning of the window */
    FST_MEAN_ALPHA_DOT,
    FST_MEAN_NZ,
    FST_MEAN_B,
    FST_MEAN_B2,
    FST_MEAN_FRICTION_POWER,
    FST_MEAN_DRIVE_POWER,
    FST_MEAN_SLIP2,
    FST_MEAN_LOAD,
    FST_MEAN_STICKING,
    FST_MEAN_COUNT,
    FST_HALVED_COUNT = FST_MEAN_B /* of these the means over either half of the window, too */
};

/* Quantities of which the least and the greatest value are kept. */
enum { FST_SPAN_R, FST_SPAN_B, FST_SPAN_LOAD, FST_SPAN_SLIP2, FST_SPAN_GAP2, FST_SPAN_COUNT };

#endif
