/* hold.h - what closed contacts do to their bodies: loads and friction. */
#ifndef FST_BEADS_HOLD_H
#define FST_BEADS_HOLD_H

#include "beads/look.h"

/* A contact has at most three ties: it does not close, and does not slip either way. */
enum { BEADS_TIES = 3 * BEADS_CONTACTS };

/* A condition on the bodies i and j of a contact, and the force x push on i, -x push on j that meets it by its size x:
 *
 *     along.(a_i - a_j) + (u x along).(R_i W_i' + R_j W_j') = what is wanted
 *
 * The force makes the torques R_i u x push and R_j u x push. */
typedef struct beads_tie {
    int contact;
    double along[3], push[3];
} beads_tie;

/* The ties of contact k that its velocities meet: its gap's, and of one that `sticks` two across it; pushes are along.
 * Returns how many. */
int beads_tie_contact(const beads_look *look, int k, int sticks, beads_tie *ties);

/* What the force of one tie does to the condition of another. */
double beads_coupling(const beads_world *world, const beads_look *look, const beads_tie *of,
                      const beads_tie *by);

/* The acceleration of the slip of contact k under the forces found. */
void beads_slip_change(const beads_world *world, const beads_look *look, int k, double change[3]);

/* The matrix of couplings of so many ties. */
void beads_couple(const beads_world *world, const beads_look *look, const beads_tie *ties, int count,
                  double *matrix);

/* Find the loads and the friction of the closed contacts, and add them to the forces of the look. */
void beads_hold(const beads_world *world, const beads_modes *modes, const int *closed, int count,
                beads_look *look);

#endif
