/* branch_list.h - the growing lists of a branch, and which of its branches passes through a state. */
#ifndef FST_ORBIT_BRANCH_LIST_H
#define FST_ORBIT_BRANCH_LIST_H

#include "orbit/curve_end.h"

/* One more point, special point or end, at the end of its list.  FST_NO_MEMORY. */
fst_status fst_branch_add_point(fst_branch *out, const fst_branch_point *seen, int branch, fst_error *error);
fst_status fst_branch_add_special(fst_branch *out, const fst_special *special, fst_error *error);
fst_status fst_branch_add_end(fst_branch *out, int branch, int family, double value, const fst_curve_end *why,
                              fst_error *error);

/* The points from index `first` on in the opposite order. */
void fst_branch_reverse(fst_branch *out, size_t first);

/* Where in the list a special point is already, met again on a curve that closes, or on a conjugate; -1: nowhere. */
int fst_branch_find_special(const fst_branch *out, const fst_special *special, double scale);

/* The branch, other than that of the last point, which holds the same orbit at the same value; -1: none does. */
int fst_branch_of_last(const fst_branch *out);

/* The branch on which an orbit lies, by its numbers, for its first state may be any; -1: on none.  With S2 its image counts
 * as the same orbit. */
int fst_branch_of_orbit(const fst_branch *out, const fst_branch_point *seen, int has_s2);

/* The branch on which an equilibrium lies, the nearest if there are several; -1: on none. */
int fst_branch_of_state(const fst_branch *out, double value, const double *state);

/* Note for every end on which branch the images of its states under S2 lie. */
void fst_branch_find_images(fst_branch *out);

#endif
