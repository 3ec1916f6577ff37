/* switching.h - the first point of the branch that is born at a special point. */
#ifndef FST_ORBIT_SWITCHING_H
#define FST_ORBIT_SWITCHING_H

#include "orbit/node.h"

/* From a multiplier -1 (a symmetric orbit loses its symmetry, or the period doubles). */
fst_status fst_switch_at_minus_one(const fst_family *family, const fst_node *at, fst_node *born,
                                   fst_error *error);

/* From an equilibrium with a pair of eigenvalues on the imaginary axis, of about this frequency: a small orbit.
 */
fst_status fst_switch_at_hopf(const fst_family *family, const fst_node *at, double frequency, fst_node *born,
                              fst_error *error);

/* From an equilibrium with a simple eigenvalue 0 that is no fold: a point of the other branch. */
fst_status fst_switch_at_pitchfork(const fst_family *family, const fst_node *at, fst_node *born,
                                   fst_error *error);

#endif
