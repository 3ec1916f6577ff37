/* beads_curve.h - follows an equilibrium or a periodic motion of beads over one parameter; the caller keeps the points. */
#ifndef FST_ORBIT_BEADS_CURVE_H
#define FST_ORBIT_BEADS_CURVE_H

#include "orbit/beads_lock.h"

/* A point of the curve; `way`: its direction there. */
typedef struct beads_node {
    beads_lock lock;
    double value, way[BEADS_NUMBERS + 1];
} beads_node;

typedef struct beads_curve {
    const fst_lapack *lapack;
    const beads_repeat *repeat; /* NULL: equilibria are followed */
    beads_free_world over;
    int count; /* of beads */
    double low, high, longest,
        share; /* the range, and the longest step, in units and as a share of the range */
    /* Who keeps points, in the order in which they are found, and special points. */
    void *user;
    fst_status (*keep)(void *user, const beads_world *world, const beads_node *at, fst_error *error);
    fst_status (*keep_special)(void *user, fst_special_type type, const beads_world *world,
                               const beads_node *at, fst_error *error);
    void (*reverse)(void *user); /* the order of the points of this curve */
    fst_branch_end ends[2];      /* against the parameter, and along it */
    beads_world world;           /* at the latest value */
    beads_node here, next, middle;
} beads_curve;

/* Follow the curve both ways from the equilibrium `start` at a value, first against the parameter. */
fst_status beads_curve_follow(beads_curve *curve, double value, const beads_lock *start, fst_error *error);

#endif
