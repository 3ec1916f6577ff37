/* groups.h - which beads hang together, and what such a group is. */
#ifndef FST_BEADS_GROUPS_H
#define FST_BEADS_GROUPS_H

#include "beads/flow.h"

/* The groups of beads whose gaps never exceeded a tenth of their diameters since flow->widest was set to 0. */
int beads_group(const beads_flow *flow, fst_bead_group groups[FST_BEADS_MOST]);

/* The contact of two beads. */
int beads_pair_number(const beads_world *world, int one, int other);

#endif
