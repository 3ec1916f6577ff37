/* surface.h - solutions over two free parameters: a surface, on which special points lie along curves. */
#ifndef FST_ORBIT_SURFACE_H
#define FST_ORBIT_SURFACE_H

#include "orbit/solution.h"

/* The same setups over the first parameter (with the second as it stands in first.params) and over the second.
 */
typedef struct fst_surface {
    fst_family first, second;
} fst_surface;

/* A direction in the space of states, period and both parameters. */
typedef struct fst_heading {
    fst_direction d; /* d.value: the first parameter */
    double second;
} fst_heading;

/* A point of the surface. */
typedef struct fst_place {
    fst_solution s; /* s.value: the first parameter; its spectrum is filled in */
    double second;
    fst_heading plane[2]; /* an orthonormal basis of the tangent plane */
    double
        shadow; /* area of the plane's shadow on the plane of the parameters, with its sign: zero on a fold */
    int iterations;
} fst_place;

double fst_heading_product(const fst_surface *surface, const fst_solution *of, const fst_heading *a,
                           const fst_heading *b);
void fst_heading_between(const fst_place *from, const fst_place *to, fst_heading *out);

/* out = a u + b v */
void fst_heading_combine(fst_heading *out, double a, const fst_heading *u, double b, const fst_heading *v);

/* Newton's method onto the surface, corrections perpendicular to both headings.  place->plane is then spanned
 * by the directions dual to them, in this order.  FST_NO_CONVERGENCE: the guess was not good enough. */
fst_status fst_place_correct(const fst_surface *surface, fst_place *place, const fst_heading across[2],
                             fst_error *error);

void fst_place_move(fst_place *place, const fst_heading *heading, double length);

/* The setup's families with the second parameter at a place. */
fst_family fst_surface_first(const fst_surface *surface, double second);

#endif
