/* look.h - what a world does to beads at one instant: forces, torques, contacts, powers. */
#ifndef FST_BEADS_LOOK_H
#define FST_BEADS_LOOK_H

#include "beads/world.h"

/* The states of a contact (select.h says which one holds).  A pressing contact has a normal force, its load,
 * and the whole friction; a grazing one has no load and a share of the friction, 0 to 1; both stay closed. */
enum { BEADS_OPEN, BEADS_PRESSING, BEADS_GRAZING };

/* What changes at events only. */
typedef struct beads_modes {
    unsigned char contact[BEADS_CONTACTS];
    int gone[FST_BEADS_MOST]; /* the bead has left the plate and is no longer computed */
} beads_modes;

typedef struct beads_look {
    double force[FST_BEADS_MOST][3], torque[FST_BEADS_MOST][3]; /* all of them, contacts included */
    double gap[BEADS_CONTACTS], rate[BEADS_CONTACTS];           /* of each contact, and d(gap)/dt */
    double u[BEADS_CONTACTS][3];    /* from the bead `first` towards its partner; towards the plate: down */
    double turn[BEADS_CONTACTS];    /* of a pair: |v_t|^2/|d|, the part of gap'' that velocities make */
    double slip[BEADS_CONTACTS][3]; /* of closed contacts */
    double held[BEADS_CONTACTS];    /* load of a pressing contact, share of the friction of a grazing one */
    double power[BEADS_R];          /* BEADS_DRIVE, BEADS_PLATE, BEADS_PAIR */
    int unique;   /* the loads follow from the motion; 0: more contacts than directions, one choice of many */
    int solvable; /* there are loads and shares that keep the closed contacts closed */
} beads_look;

void beads_look_at(const beads_world *world, const beads_modes *modes, const double *y, beads_look *look);

/* Gaps, their rates and directions alone. */
void beads_look_at_gaps(const beads_world *world, const beads_modes *modes, const double *y, beads_look *look);

/* gap'' of a contact under the forces found. */
double beads_bend_of_gap(const beads_world *world, const beads_look *look, int contact);

/* Whether two beads, or bead and plate, can meet: there is a plate, and no bead is gone. */
int beads_can_meet(const beads_world *world, const beads_modes *modes, int contact);

/* What a push of one along contact s, from its second body to the first, does to gap'' of contact r. */
double beads_coupling(const beads_world *world, int r, const double u[3], int s, const double d[3]);

#endif
