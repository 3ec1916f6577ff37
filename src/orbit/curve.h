/* curve.h - curves of equilibria or orbits over a parameter, point by point, with the special points between.
 */
#ifndef FST_ORBIT_CURVE_H
#define FST_ORBIT_CURVE_H

#include "orbit/describe.h"

/* A point of a curve: a corrected solution with its spectrum, and what it looks like. */
typedef struct fst_node {
    fst_solution s;
    fst_branch_point seen;
    double closest; /* of an orbit: see describe.h */
    double length;  /* along the curve, from the node before */
} fst_node;

/* What a curve reports; `switched` tells whether a branch is to be followed from there. */
typedef struct fst_curve_sink {
    void *user;
    fst_status (*node)(void *user, const fst_node *node, fst_error *error);
    fst_status (*special)(void *user, fst_special_type type, const fst_node *at, int criticality,
                          const fst_node *born, fst_error *error);
} fst_curve_sink;

typedef struct fst_curve {
    const fst_family *family;
    double from, to; /* of the parameter */
    double longest_step;
    int follow; /* look for the branches born at special points */
    fst_curve_sink sink;
    char reason[192]; /* why the curve ended */
} fst_curve;

/* Spectrum and description of a corrected solution. */
fst_status fst_node_make(const fst_family *family, const fst_solution *s, fst_node *node, fst_error *error);

/* The curve on from `start` (corrected, with its tangent; its sign is the way), until it leaves the range,
 * ends, or cannot be followed: curve->reason.  `start` itself is not reported.  Fails only where the sink does,
 * where memory or parameters do, or with what the family's watch answers. */
fst_status fst_curve_follow(fst_curve *curve, const fst_node *start, int sign, fst_error *error);

/* ---- special points, special.c */

/* Tests that change sign between two nodes where something happens. */
enum { FST_TEST_FOLD, FST_TEST_MINUS, FST_TEST_PLUS, FST_TEST_PAIR, FST_TEST_ORIGIN, FST_TEST_COUNT };
double fst_test_value(const fst_node *node, int test);

/* Report every special point between two successive nodes; *ends is set where the curve runs into a state of
 * higher symmetry (a symmetric orbit, an equilibrium) and would only come back on itself. */
fst_status fst_specials_between(fst_curve *curve, const fst_node *a, const fst_node *b, int *ends,
                                fst_error *error);

/* Where a curve of orbits could not be followed beyond b: report the Hopf point on which it shrinks, if that is
 * why. */
fst_status fst_look_for_hopf_end(fst_curve *curve, const fst_node *a, const fst_node *b, fst_error *error);

/* A guess at the fraction x of the way from a to b: the cubic with their tangents. */
void fst_solution_between(const fst_node *a, const fst_node *b, double x, fst_solution *s);

/* The solution there, corrected across the way. */
fst_status fst_node_between(const fst_family *family, const fst_node *a, const fst_node *b, double x,
                            fst_node *out, fst_error *error);

/* The place between a and b where a test vanishes. */
fst_status fst_locate_special(const fst_family *family, const fst_node *a, const fst_node *b, int test,
                              fst_node *out, fst_error *error);

/* ---- the branches that leave, switching.c */

/* From a multiplier -1 (a symmetric orbit loses its symmetry, or the period doubles): a point of the new
 * branch. */
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
