/* medium.h - what a medium does to a bead. */
#ifndef FST_MODEL_MEDIUM_H
#define FST_MODEL_MEDIUM_H

#include <festoon/festoon.h>

/* Per mass of the bead, scaled. */
typedef struct fst_medium {
    double displaced, added; /* mass of the medium in the bead's place, and of what moves along */
    double drag, fast_drag;  /* the force -(drag + fast_drag |v|) v */
    double spin_drag;        /* the rate at which W decays */
} fst_medium;

/* Of settled parameters. */
fst_medium fst_medium_of(const fst_params *params, const fst_groups *g);

#endif
