/* node.h - a point of a curve of solutions, and points between two neighbours. */
#ifndef FST_ORBIT_NODE_H
#define FST_ORBIT_NODE_H

#include "orbit/describe.h"

/* A corrected solution with its spectrum, and what it looks like. */
typedef struct fst_node {
    fst_solution s;
    fst_branch_point seen;
    double closest;  /* of an orbit: see describe.h */
    int captures;    /* likewise, and flights */
    double shortest; /* likewise */
    int floats;      /* an equilibrium under dry friction that would need the plate to pull */
    double length;   /* along the curve, from the node before */
} fst_node;

/* Spectrum and description of a corrected solution. */
fst_status fst_node_make(const fst_family *family, const fst_solution *s, fst_node *node, fst_error *error);

/* The solution `length` along the tangent of a node; the tangent there goes the same way. */
fst_status fst_node_ahead(const fst_family *family, const fst_node *from, double length, fst_node *out,
                          fst_error *error);

/* A guess at the solution a fraction x of the way from a to b: the cubic through both with their tangents. */
void fst_solution_between(const fst_node *a, const fst_node *b, double x, fst_solution *s);

/* The solution there, corrected across the way. */
fst_status fst_node_between(const fst_family *family, const fst_node *a, const fst_node *b, double x,
                            fst_node *out, fst_error *error);

#endif
