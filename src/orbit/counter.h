/* counter.h - the family of counter-rotating orbits. */
#ifndef FST_ORBIT_COUNTER_H
#define FST_ORBIT_COUNTER_H

#include "orbit/tracer.h"

/* Find counter-rotating orbits in the range, and follow the branches on which they lie. */
fst_status fst_follow_counter(fst_tracer *t, fst_error *error);

#endif
