/* dipoles.h - the forces of dipoles on each other: of one pair, and of all pairs of many beads. */
#ifndef FST_BEADS_DIPOLES_H
#define FST_BEADS_DIPOLES_H

#include <string.h>

#include "beads/world.h"

/* Numbers by name, so that compilers keep them in registers. */
typedef struct beads_vector {
    double x, y, z;
} beads_vector;

static inline double beads_inner(beads_vector a, beads_vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline beads_vector beads_outer(beads_vector a, beads_vector b)
{
    return (beads_vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* a u - n, times `by` */
static inline beads_vector beads_field_of(double by, double a, beads_vector u, beads_vector n)
{
    return (beads_vector){by * (a * u.x - n.x), by * (a * u.y - n.y), by * (a * u.z - n.z)};
}

/* The force on the dipole m of the dipole n, and the torques on both.  u is the direction from n to m, nearness
 * 1/|d|, chi the product of the dipoles' strengths; n feels the opposite force.  (Pairs of uniform spheres are point
 * dipoles exactly: Edwards et al., Am. J. Phys. 85 (2017) 130.) */
static inline __attribute__((always_inline)) void beads_dipole_pair(beads_vector n, beads_vector m,
                                                                    beads_vector u, double nearness, double chi,
                                                                    beads_vector *force, beads_vector *on_n,
                                                                    beads_vector *on_m)
{
    const double cubed = chi * nearness * nearness * nearness, fourth = 3.0 * cubed * nearness;
    const double nu = beads_inner(n, u), mu = beads_inner(m, u), along = beads_inner(n, m) - 5.0 * nu * mu;
    force->x = fourth * (nu * m.x + mu * n.x + along * u.x);
    force->y = fourth * (nu * m.y + mu * n.y + along * u.y);
    force->z = fourth * (nu * m.z + mu * n.z + along * u.z);
    *on_m = beads_outer(m, beads_field_of(cubed, 3.0 * nu, u, n)); /* the fields, each where the other is */
    *on_n = beads_outer(n, beads_field_of(cubed, 3.0 * mu, u, m));
}

/* The same of one pair, whose vectors are arrays. */
static inline void beads_dipoles_of(const double n[3], const double m[3], const double u[3], double nearness,
                                    double chi, double force[3], double on_n[3], double on_m[3])
{
    beads_vector f, t, s;
    beads_dipole_pair((beads_vector){n[0], n[1], n[2]}, (beads_vector){m[0], m[1], m[2]},
                      (beads_vector){u[0], u[1], u[2]}, nearness, chi, &f, &t, &s);
    memcpy(force, &f, sizeof f);
    memcpy(on_n, &t, sizeof t);
    memcpy(on_m, &s, sizeof s);
}

/* Many dipoles, number by number: places, directions and strengths; forces and torques. */
enum { BEADS_DIPOLE_IN = 7, BEADS_DIPOLE_OUT = 6 };
typedef struct beads_dipoles {
    int count;
    double *in[BEADS_DIPOLE_IN], *out[BEADS_DIPOLE_OUT];
} beads_dipoles;

/* The exact sum over all pairs, each looked at once, in one order: the same bits on every processor. */
void beads_sum_dipoles(const beads_dipoles *dipoles);

#endif
