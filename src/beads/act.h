/* act.h - what acts on one bead without touch, and where two bodies meet: for every method the same. */
#ifndef FST_BEADS_ACT_H
#define FST_BEADS_ACT_H

#include "beads/world.h"

/* Add what magnet, gravity and medium do to bead i: force, torque, and powers, that of the drive over its rate. */
void beads_act_on_bead(const beads_world *world, int i, const double *y, double force[3], double torque[3],
                       double *power);

/* Where bead i meets bead j, or the plate (j = -1): the direction u from it to the other, the gap, and the curvature c in
 * gap'' = u.(a_j - a_i) + c |v_t|^2; of two beads that is 1/distance. */
void beads_meet(const beads_world *world, int i, int j, const double *y, double u[3], double *gap,
                double *curve);

/* The slip of a contact: its first body's velocity over the second's is v, and R W + R' W' is `turning`. */
static inline void beads_slip(const double u[3], const double v[3], const double turning[3], double slip[3])
{
    const double along = beads_dot(v, u);
    double of_turn[3];
    fst_cross_double(turning, u, of_turn);
    for (int m = 0; m < 3; ++m)
        slip[m] = v[m] - along * u[m] + of_turn[m];
}

static inline void beads_add(double to[3], double factor, const double v[3])
{
    for (int k = 0; k < 3; ++k)
        to[k] += factor * v[k];
}

#endif
