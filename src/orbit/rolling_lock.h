/* rolling_lock.h - families of locked beads whose contact does not slip. */
#ifndef FST_ORBIT_ROLLING_LOCK_H
#define FST_ORBIT_ROLLING_LOCK_H

#include "orbit/family.h"

/* Append to the list every family under a law whose contact can stick; under others none exist. */
fst_status fst_rolling_locks_find(const fst_setup *setup, fst_locked_list *list, fst_error *error);

#endif
