/* dry_carry.h - tangent vectors carried along a motion with dry friction, through its changes of mode. */
#ifndef FST_ORBIT_DRY_CARRY_H
#define FST_ORBIT_DRY_CARRY_H

#include "orbit/family.h"

/* What fst_carry() does, under the laws whose contact can stick. */
fst_status fst_dry_carry(const fst_setup *setup, double tolerance, double duration, double y[FST_STATE_SIZE],
                         double tangent[FST_STATE_SIZE][FST_COLUMNS], fst_error *error);

/* The coefficients with the mode of dry friction that a bead in this state has: it slips, or sticks. */
void fst_dry_coefficients(const fst_setup *setup, const double *y, fst_coefficients_double *out);

/* Whether the plate can stop the slip for good: after that, two directions of the state are lost. */
static inline int fst_setup_is_dry(const fst_setup *setup)
{
    return setup->model.coefficients.kinds.dry;
}

#endif
