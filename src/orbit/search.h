/* search.h - the orbit to which a start leads. */
#ifndef FST_ORBIT_SEARCH_H
#define FST_ORBIT_SEARCH_H

#include "orbit/solution.h"

/* Integrate from start.* of the family's parameters (which has no free one) for at most run.periods drive
 * periods, until returns come close and Newton's method finds the attracting orbit that they approach.  The
 * present part of the family's watch is told how far the bead was followed.  FST_NO_CONVERGENCE: there is none;
 * *outcome tells where the bead went instead, the sentence the details. */
fst_status fst_search_orbit(const fst_family *family, fst_solution *out, fst_orbit_outcome *outcome,
                            fst_error *error);

#endif
