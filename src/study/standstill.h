/* standstill.h - is a state of rest stable? */
#ifndef FST_STUDY_STANDSTILL_H
#define FST_STUDY_STANDSTILL_H

#include "model/model.h"

/* The greatest rate at which small deviations from a state of rest grow or, if it is negative, die out: the
 * greatest real part of an eigenvalue of the Jacobian there, across |n|, which stays 1. */
double fst_rest_rate(const fst_model *model, const double state[FST_STATE_SIZE]);

#endif
