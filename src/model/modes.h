/* modes.h - which modes a bead has in a state: the one answer to "sticks or slips, rests or rolls?" (modes.c).
 */
#ifndef FST_MODEL_MODES_H
#define FST_MODEL_MODES_H

#include "model/model.h"

/* The motion of a bead that is put down on the plate in a state, where a slip or a rotation below the
 * tolerance counts as nothing.  Lags are zero, and the state is not moved. */
fst_motion_double fst_motion_at(const fst_world_double *c, const double state[FST_STATE_SIZE], double rtol);

/* The mode of its contact, whose rolling has its mode; in flight only where the bead may fly. */
int fst_contact_mode_at(const fst_world_double *c, const fst_modes_double *m, const double *y,
                        const fst_pull_double *p, double rtol);

/* The mode of a contact that lets go: slip, if friction falls at once, so that the slip has an acceleration to
 * begin with. */
int fst_released_mode(const fst_world_double *c);

/* Stick, if static friction can hold a contact without slip in this state and these modes; else how it is let
 * go. */
int fst_held_mode(const fst_world_double *c, const fst_modes_double *m, const double *y);

/* The greatest rotation W_h that is nothing at a tolerance, and what the resistance of the plate could still
 * take of the balance of a bead that does not roll; negative, it cannot be held. */
double fst_rotation_of_rest(const fst_world_double *c, double rtol);
double fst_resistance_left(const fst_world_double *c, const fst_contact_double *at);

/* The load, less what it may fall short of 0 before a bead leaves the plate: negative, it does. */
double fst_load_left(const fst_world_double *c, const fst_pull_double *p);

#endif
