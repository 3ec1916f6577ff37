/* search.h - the orbit to which a start leads. */
#ifndef FST_ORBIT_SEARCH_H
#define FST_ORBIT_SEARCH_H

#include "orbit/solution.h"

/* Integrate from start.* of the family's parameters (which has no free one) for at most run.periods drive
 * periods, until returns come close and Newton's method finds the attracting orbit that they approach.  The
 * present part of the family's watch reports how far the bead was followed.  FST_NO_CONVERGENCE: there is no
 * such orbit; *outcome says where the bead went instead, the sentence has the details. */
fst_status fst_search_orbit(const fst_family *family, fst_solution *out, fst_orbit_outcome *outcome,
                            fst_error *error);

/* The equilibrium at `near`, if exactly one pair of eigenvalues has a positive real part, and that is small:
 * then a bead that comes very near leaves it along the plane of that pair, whichever way it came.  The place on
 * that plane where the swings neither grow nor shrink is a guess at the orbit, *gap the rest of their growth
 * in a period.  0: there is no such equilibrium within `reach`, or no such place nearby (departure.c).
 */
int fst_departure_guess(const fst_family *family, const double *near, double reach, fst_solution *guess,
                        double *gap);

#endif
