/* sweeps.h - the impulses of all contacts of a time step, by projected Gauss-Seidel. */
#ifndef FST_BEADS_SWEEPS_H
#define FST_BEADS_SWEEPS_H

#include "beads/world.h"

/* Velocities of a bead: of its centre, and angular. */
enum { BEADS_SPEEDS = 6 };

/* When a contact rubs that has viscous friction. */
enum { BEADS_RUBS_PRESSING, BEADS_RUBS, BEADS_RUBS_NOT };

/* A contact in reach of a step.  The plate is the body behind the last bead, and never moves. */
typedef struct beads_touch {
    int first, second;
    double u[3];      /* from the first towards the second */
    double gap, rate; /* d(gap)/dt, and the slip, at the start of the step */
    double slip[3];
    double inverse[2], arm[2], spin[2]; /* of either bead: 1/m, R, R/I */
    double ease[2];                     /* change of d(gap)/dt by a push of one; of the slip by a rub of one */
    double least;                       /* d(gap)/dt is at least this, and the push is 0 where it is more */
    double rub;             /* viscous: the rub is -rub (slip before + slip after, without this rub) */
    double mu;              /* dry: the rub is at most mu times the push, and less only without slip */
    double push, rubbed[3]; /* impulses: on the second bead along u, on the first across it */
    int closed;             /* it bears a load, or touched when it last did */
    int rubs;
    int pressed; /* it had an impulse in the last step */
} beads_touch;

/* The slip of a contact: of velocities v and W of its beads. */
void beads_touch_slip(const beads_touch *touch, const double *speeds, double slip[3], double *rate);

/* Apply the impulses that contacts have from the start, and change these and the velocities until no contact is
 * more in the wrong than `tolerance`, a speed.  Returns how far the worst one is; *sweeps grows. */
double beads_sweep(beads_touch *touches, int count, double tolerance, double *speeds, uint64_t *sweeps);

#endif
