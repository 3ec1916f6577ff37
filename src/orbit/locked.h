/* locked.h - every family of equilibria. */
#ifndef FST_ORBIT_LOCKED_H
#define FST_ORBIT_LOCKED_H

#include "orbit/tracer.h"

/* Find equilibria at several values in the range, and follow each unless a branch passes through it already. */
fst_status fst_follow_locked(fst_tracer *t, fst_error *error);

#endif
