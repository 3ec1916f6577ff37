/* look.h - what a world does to beads at one instant: forces, torques, contacts, powers. */
#ifndef FST_BEADS_LOOK_H
#define FST_BEADS_LOOK_H

#include "beads/world.h"

/* The states of a contact (select.h says which one holds); all but an open one stay closed.  A pressing contact has a
 * normal force, its load, and the whole friction; a grazing one has no load and a share of viscous friction, 0 to 1.
 * Under dry friction a pressing contact slips; a sticking one has what friction it needs for that; one that begins
 * slips where it is pushed. */
enum { BEADS_OPEN, BEADS_PRESSING, BEADS_GRAZING, BEADS_STICKING, BEADS_BEGINNING };

/* What changes at events only. */
typedef struct beads_modes {
    unsigned char contact[BEADS_CONTACTS];
    int gone[FST_BEADS_MOST]; /* the bead has left the plate and is no longer computed */
} beads_modes;

typedef struct beads_look {
    double force[FST_BEADS_MOST][3], torque[FST_BEADS_MOST][3]; /* all of them, contacts included */
    double gap[BEADS_CONTACTS], rate[BEADS_CONTACTS];           /* of each contact, and d(gap)/dt */
    double u[BEADS_CONTACTS][3];       /* from the bead `first` towards its partner; towards the plate: down */
    double turning[BEADS_CONTACTS][3]; /* u' */
    double drift[BEADS_CONTACTS][3]; /* what velocities add to the accelerations of gap (against u) and slip */
    double slip[BEADS_CONTACTS][3];  /* of closed contacts */
    double held[BEADS_CONTACTS];     /* load, or share of the friction of a grazing contact */
    double friction[BEADS_CONTACTS][3]; /* on the first body */
    double way[BEADS_CONTACTS][3];      /* against which dry friction of a slip acts, of unit length */
    double pace;                        /* time over that in which steps are measured */
    double power[BEADS_R];              /* BEADS_DRIVE, BEADS_PLATE, BEADS_PAIR, BEADS_MEDIUM */
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

/* The slip of a contact, whose gap is known to the look. */
void beads_look_at_slip(const beads_world *world, int contact, const double *y, beads_look *look);

/* The normal force of a contact. */
static inline double beads_load(const beads_modes *modes, const beads_look *look, int contact)
{
    const int mode = modes->contact[contact];
    return mode == BEADS_OPEN || mode == BEADS_GRAZING ? 0.0 : look->held[contact];
}

#endif
