/* rhs_lanes.h - the right-hand side in lanes on its own. */
#ifndef FST_BENCH_RHS_LANES_H
#define FST_BENCH_RHS_LANES_H

#include <festoon/festoon.h>

/* Evaluate the right-hand side of the model at a state in all lanes of a form, `times` times.  Each is
 * rhs_lanes.c compiled for a form of lanes (src/lanes). */
typedef void rhs_lanes(const fst_params *params, const fst_groups *groups, const double *state, int times);
rhs_lanes rhs_lanes_portable4, rhs_lanes_avx2, rhs_lanes_portable8, rhs_lanes_avx512;

#endif
