/* beads_cycle.h - periodic orbits of several beads, or of one in three dimensions, in the turning frame. */
#ifndef FST_ORBIT_BEADS_CYCLE_H
#define FST_ORBIT_BEADS_CYCLE_H

#include "beads/manifold.h"
#include "orbit/lapack.h"

/* What the state after the period is: the first one; that with the two beads exchanged; its image under S2. */
typedef enum { BEADS_CLOSES, BEADS_EXCHANGES, BEADS_IMAGES } beads_closing;

typedef struct beads_cycle {
    beads_closing closing;
    double state[BEADS_NUMBERS];
    beads_modes modes;    /* which stay all the way */
    double period;        /* of the map: half of the orbit's, unless it just closes */
    double residual;      /* greatest component of the map's defect, in the units of manifold.h */
    double trivial_error; /* how well the flow direction is mapped onto itself */
    int iterations, size; /* of Newton's method; number of multipliers */
    double re[BEADS_NUMBERS], im[BEADS_NUMBERS]; /* multipliers of the map, the largest first */
    double mean_r[FST_BEADS_MOST];               /* over the map */
    double turned[FST_BEADS_MOST];               /* by so much about the axis, in the turning frame */
    double power[BEADS_R];                       /* means of the drive's power and of the losses */
} beads_cycle;

/* Newton's method from cycle->state, ->modes, ->period and ->closing; then the multipliers.  FST_NO_CONVERGENCE: the
 * guess was not good enough (its residual is above `most`), the beads stand still, or a contact opens or closes on the
 * way. */
fst_status beads_cycle_correct(const fst_lapack *lapack, const beads_world *world, double rtol, double most,
                               beads_cycle *cycle, fst_error *error);

#endif
