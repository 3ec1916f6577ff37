/* select.h - which touching contacts press, graze or open. */
#ifndef FST_BEADS_SELECT_H
#define FST_BEADS_SELECT_H

#include "beads/look.h"

/* Choose for each of the contacts `touching` (a flag each; closed or not, their gaps are 0 and stay so unless
 * they open), beginning with the modes as they are.  0: no choice is consistent, and the modes are as before. */
int beads_select(const beads_world *world, const double *y, const int *touching, beads_modes *modes);

/* The same after the load of contact k, which pressed, or its share of friction, when it grazed, left its
 * bounds. */
int beads_release(const beads_world *world, const double *y, const int *touching, int k, int rises,
                  beads_modes *modes);

#endif
