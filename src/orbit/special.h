/* special.h - what happens between two neighbouring points of a curve, and the branches that are born there. */
#ifndef FST_ORBIT_SPECIAL_H
#define FST_ORBIT_SPECIAL_H

#include "orbit/curve_end.h"
#include "orbit/node.h"

/* Where a curve's points and special points go; `born`: a point of the branch that leaves there, or NULL. */
typedef struct fst_curve_sink {
    void *user;
    int follow; /* give a point of the branch that is born at each special point */
    fst_status (*node)(void *user, const fst_node *node, fst_error *error);
    /* NULL: nobody asks */
    fst_status (*special)(void *user, fst_special_type type, const fst_node *at, int criticality,
                          const fst_node *born, fst_error *error);
} fst_curve_sink;

/* Report every special point between two successive nodes; *end is filled in where the curve runs into a state
 * of higher symmetry (a symmetric orbit, an equilibrium) and would only come back on itself; FST_END_LOST where what changed has no place between the two, which then may
 * lie on two curves. */
fst_status fst_specials_between(const fst_family *family, const fst_curve_sink *sink, const fst_node *a,
                                const fst_node *b, fst_curve_end *end, fst_error *error);

/* Where a curve of orbits could not be followed beyond b: report the Hopf point on which it shrinks, if that is
 * why. */
fst_status fst_look_for_hopf_end(const fst_family *family, const fst_curve_sink *sink, const fst_node *a,
                                 const fst_node *b, fst_curve_end *end, fst_error *error);

/* The first point of the branch that is born at a special point (switching.c): at a multiplier -1, where a
 * symmetric orbit loses its symmetry, or the period doubles; */
fst_status fst_switch_at_minus_one(const fst_family *family, const fst_node *at, fst_node *born,
                                   fst_error *error);

/* at an equilibrium with a pair of eigenvalues on the imaginary axis, of about this frequency: a small orbit;
 */
fst_status fst_switch_at_hopf(const fst_family *family, const fst_node *at, double frequency, fst_node *born,
                              fst_error *error);

/* at an equilibrium with a simple eigenvalue 0 that is not a fold: a point of the other branch. */
fst_status fst_switch_at_pitchfork(const fst_family *family, const fst_node *at, fst_node *born,
                                   fst_error *error);

#endif
