/* departure.h - the small orbit that a bead approaches when it leaves an equilibrium in a widening spiral. */
#ifndef FST_ORBIT_DEPARTURE_H
#define FST_ORBIT_DEPARTURE_H

#include "orbit/solution.h"

/* The equilibrium at `near`, if exactly one pair of eigenvalues has a positive real part, and that is small:
 * then a bead that comes very near leaves it along the plane of that pair, whichever way it came.  The place on
 * that plane where the swings neither grow nor shrink is a guess at the orbit, *gap what is left of their
 * growth in a period.  0: there is no such equilibrium within `reach`, or no such place nearby. */
int fst_departure_guess(const fst_family *family, const double *near, double reach, fst_solution *guess,
                        double *gap);

#endif
