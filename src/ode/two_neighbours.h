/* two_neighbours.h - how the neighbours of a motion change, two at a time. */
#ifndef FST_ODE_TWO_NEIGHBOURS_H
#define FST_ODE_TWO_NEIGHBOURS_H

#include "model/model.h"

#include "model/tangent.inl"

/* Whether they can be taken so: under dry friction at a point of contact, on a plate that does not resist rolling, of a
 * bead that does not fly. */
static inline int fst_neighbours_pair(const fst_kinds *kinds)
{
    return kinds->modes && kinds->patch == FST_PATCH_POINT && !kinds->resists && !kinds->flies;
}

/* The derivatives by theta of the differences `seen` of `count` neighbours from the motion at y, which was linearised
 * and changes by f in time; each has the bits that it would have alone. */
void fst_slopes_of_two(const fst_world_double *c, double omega, const double *y,
                       const fst_linear_double *linear, const double *f, int count, double seen[][FST_NUMBERS],
                       double k[][FST_NUMBERS]);

#endif
