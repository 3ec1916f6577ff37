/* manifold.h - the directions in which beads can move, and derivatives along them. */
#ifndef FST_BEADS_MANIFOLD_H
#define FST_BEADS_MANIFOLD_H

#include "beads/flow.h"

/* A basis of the directions that keep moments of unit length and closed contacts closed.  It is orthonormal where each
 * number counts in a unit of its own: the radius, 1 of a moment, and these times the drive's rate. */
typedef struct beads_manifold {
    int numbers, size; /* of a state, and of the basis */
    double unit[BEADS_NUMBERS];
    double basis[BEADS_NUMBERS][BEADS_NUMBERS]; /* one vector after the other */
} beads_manifold;

/* The units of numbers. */
void beads_units(const beads_world *world, double *unit);

/* Span it at y.  `first`, unless it is NULL, is a direction within it, along which the first vector then lies. */
void beads_span(const beads_world *world, const beads_modes *modes, const double *y, const double *first,
                beads_manifold *manifold);

/* The components of v in the basis, and the vector of components. */
void beads_components(const beads_manifold *manifold, const double *v, double *components);
void beads_vector(const beads_manifold *manifold, const double *components, double *v);

/* A map of states, of `numbers` numbers, to as many. */
typedef fst_status beads_map(void *user, const double *y, double *out, fst_error *error);

/* The map's derivative in the basis, by rows, from values up to 4 `reach` away. */
fst_status beads_derivative(const beads_manifold *manifold, beads_map *map, void *user, const double *y,
                            double reach, double *matrix, fst_error *error);

/* Over this part of the units all that acts on beads changes little: for `reach`. */
#define BEADS_REACH 0.02

#endif
