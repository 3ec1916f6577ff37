/* select.h - which touching contacts press, graze or open. */
#ifndef FST_BEADS_SELECT_H
#define FST_BEADS_SELECT_H

#include "beads/look.h"

/* Of so many contacts all states are tried before it is said that none is consistent; of more only likely ones. */
enum { BEADS_MOST_TRIED = 10 };

/* Choose for each of the contacts `touching` (a flag each; closed or not, their gaps are 0 and stay so unless
 * they open), beginning with the modes as they are.  0: no choice is consistent, and the modes are as before. */
int beads_select(const beads_world *world, const double *y, const int *touching, beads_modes *modes);

/* The same after the load of contact k, which pressed, or its share of friction, when it grazed, left its
 * bounds. */
int beads_release(const beads_world *world, const double *y, const int *touching, int k, int rises,
                  beads_modes *modes);

/* Close the contacts that touch and are open: each presses, or sticks if its dry friction may hold it. */
void beads_close(const beads_world *world, const double *y, const int *touching, beads_modes *modes);

/* Whether no contact is in the wrong. */
int beads_is_consistent(const beads_world *world, const double *y, const int *touching,
                        const beads_modes *modes);

/* Whether another consistent choice has other accelerations; asked of a few contacts only. */
int beads_is_one_of_several(const beads_world *world, const double *y, const int *touching,
                            const beads_modes *modes);

#endif
