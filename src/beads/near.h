/* near.h - which beads are near each other. */
#ifndef FST_BEADS_NEAR_H
#define FST_BEADS_NEAR_H

#include "beads/world.h"

typedef struct beads_two {
    int first, second;
} beads_two;

/* The pairs whose gap is less than `within`, by their first and then by their second bead; gone beads are near none.
 * *pairs is a list of base/grow.h, NULL or that of an earlier call. */
fst_status beads_find_near(const beads_world *world, const int *gone, const double *y, double within,
                           beads_two **pairs, int *count, fst_error *error);

#endif
