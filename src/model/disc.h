/* disc.h - a contact that is a disc: when it is held, and how it lets go (disc.c). */
#ifndef FST_MODEL_DISC_H
#define FST_MODEL_DISC_H

#include "model/model.h"

/* The square of the slowest pivoting that is not taken for rest, at the tolerance of a trajectory. */
double fst_disc_slow_2(double rtol);

/* What static friction could still take of a bead that is held in a state; negative: it lets go. */
double fst_disc_hold(const fst_world_double *c, const fst_modes_double *m, const double *state,
                     const fst_pull_double *p);

/* Its change, where it is 0, as the contact of a bead that is held changes by `by`. */
double fst_disc_hold_change(const fst_world_double *c, const fst_contact_double *at,
                            const fst_contact_double *by);

/* Whether a bead is so slow that it is to be held. */
int fst_disc_rests(const fst_world_double *c, const fst_modes_double *m, const double *state,
                   const fst_pull_double *p);

/* The slip and the rate of pivoting, W.e, with which a bead that was held begins to move. */
void fst_disc_release(const fst_world_double *c, const fst_modes_double *m, const double *state,
                      const fst_pull_double *p, double velocity[2], double *pivot);

#endif
