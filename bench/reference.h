/* reference.h - a trajectory in long double: what errors are measured against. */
#ifndef FST_BENCH_REFERENCE_H
#define FST_BENCH_REFERENCE_H

#include <festoon/festoon.h>

/* The state at t_end from `state` at 0, by the same method of order 8 in long double (64 bits of precision on
 * x86) with the tolerance `tolerance`; rounded to double.  Returns 0 if the step size underflowed. */
int reference_state(const fst_params *params, const fst_groups *groups, const double state[FST_STATE_SIZE],
                    long double t_end, long double tolerance, double end[FST_STATE_SIZE]);

#endif
