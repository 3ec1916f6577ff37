/* impact.h - velocities after an impact, and states put back to where closed contacts lie. */
#ifndef FST_BEADS_IMPACT_H
#define FST_BEADS_IMPACT_H

#include "beads/look.h"

/* Contacts with a smaller gap take part in an impact, and may be closed. */
#define BEADS_TOUCH 1e-9

/* Change the velocities of `y` by the impulses of the contacts `touching`. 0: they were not found. */
int beads_collide(const beads_world *world, const beads_modes *modes, const int *touching, double *y);

/* Put gaps and their rates to 0 at closed contacts, slips where they stick, and moments to unit length. */
void beads_project(const beads_world *world, const beads_modes *modes, double *y);

#endif
