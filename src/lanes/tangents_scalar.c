/* tangents_scalar.c - one bead and its tangent vector */
#include "lanes/tangents.h"

#include <string.h>

#include "ode/flow.h"

#include "ode/tangent_step.inl"

#define TANGENT_WIDTH 1

static void load_world(fst_world_double *to, int lane, const fst_world_double *from)
{
    (void)lane;
    *to = *from;
}

#include "lanes/tangents.inl"

const fst_tangent_engine fst_tangents_scalar = TANGENT_ENGINE;
