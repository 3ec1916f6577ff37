/* groups.h - which beads hang together, and what such a group is. */
#ifndef FST_BEADS_GROUPS_H
#define FST_BEADS_GROUPS_H

#include "beads/near.h"

/* The bonds of a state: pairs whose gap is less than a tenth of their distance in touch.  *bonds is to be freed. */
fst_status beads_find_bonds(const beads_world *world, const int *gone, const double *y, beads_two **bonds,
                            int *count, fst_error *error);

/* Keep those of the bonds that are still there.  Returns how many there are. */
int beads_keep_bonds(const beads_world *world, const int *gone, const double *y, beads_two *bonds, int count);

/* The groups that these bonds make.  `groups` and `members` have room for as many as there are beads. */
int beads_group(int count, const int *gone, const beads_two *bonds, int bond_count, fst_bead_group *groups,
                int *members);

#endif
