/* steps.h - the motion of many beads by equal steps. */
#ifndef FST_BEADS_STEPS_H
#define FST_BEADS_STEPS_H

#include "beads/dipoles.h"
#include "beads/near.h"
#include "beads/sweeps.h"

typedef struct beads_steps {
    beads_world world;
    double h;
    int64_t steps;
    double *y;                     /* twelve numbers a bead */
    int *gone;                     /* it has left the plate and is no longer computed */
    double *ejected;               /* when, or NAN */
    double *turned;                /* angle of each bead about the axis, in the turning frame, unwrapped */
    double *r, *load, *height;     /* integrals over time, of each bead */
    double work[BEADS_R], impacts; /* as those of a beads_flow */
    double carried;
    beads_touch *touches; /* of the last step, plate first, each kind by its first and then its second bead */
    int touch_count, touch_room;
    double residual, deepest; /* the greatest so far */
    uint64_t sweeps;
    int64_t counts[FST_BEAD_EVENTS];
    fst_bead_event *events; /* room for FST_BEADS_EVENTS */
    int event_count;
    /* what the steps use */
    double *numbers; /* all arrays of doubles */
    double *speeds, *after,
        *started; /* velocities before and after; where beads started the step, in the plane */
    beads_dipoles dipoles;
    int *present; /* beads that are not gone */
    int present_count;
    beads_touch *before; /* the list of the step before */
    int before_count;
    beads_two *near;
    int near_count;
    double within, moved; /* the gap up to which `near` was made, and how much less gaps may be since */
    double half_turn[2];  /* cosine and sine of omega h/2 */
} beads_steps;

/* Begin at the state with steps of the length h; contacts with gaps below BEADS_TOUCH have pressed.  Free it in
 * either case. */
fst_status beads_steps_begin(beads_steps *s, const beads_world *world, const double *state, double h,
                             fst_error *error);
void beads_steps_free(beads_steps *s);

/* One step. */
fst_status beads_step(beads_steps *s, fst_error *error);

/* The energy now, less what was there and has come and gone by the integrals: of the order of h. */
double beads_steps_residual(const beads_steps *s, double energy_at_start);

#endif
