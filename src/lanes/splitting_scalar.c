/* splitting_scalar.c - one run by the splitting method */
#include "lanes/splitting.h"

#include <string.h>

#include "observe/weighted.inl"

#define SPLITTING_WIDTH 1

static void load_coefficients(fst_coefficients_double *to, int lane, const fst_coefficients_double *from)
{
    (void)lane;
    *to = *from;
}

#include "lanes/splitting_lanes.inl"

const fst_splitting_engine fst_splitting_scalar = SPLITTING_ENGINE;
