/* splitting.h - the steps of the splitting method over double. */
#ifndef FST_ODE_SPLITTING_H
#define FST_ODE_SPLITTING_H

#include "model/model.h"

#include "ode/splitting.inl"

#endif
