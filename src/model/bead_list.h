/* bead_list.h - the beads of a list, and what it may hold. */
#ifndef FST_MODEL_BEAD_LIST_H
#define FST_MODEL_BEAD_LIST_H

#include <festoon/festoon.h>

/* What bead `bead` of a list says; NULL: the list has no such bead. */
const fst_bead_params *fst_bead_own(const fst_params *params, int bead);

/* FST_BAD_INPUT: beads come before this one (-1: it is not a bead's key), or beads of this list have no keys. */
fst_status fst_bead_may_set(fst_params *params, int bead, fst_error *error);

/* After a row of the bead was set: other forms of the same quantity say nothing any more. */
void fst_bead_was_set(fst_params *params, int bead, const fst_param_info *row);

/* The number of beads, and the numbers of each. */
fst_status fst_beads_validate(const fst_params *params, fst_error *error);

#endif
