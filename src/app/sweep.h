/* sweep.h - what the sweep's files share. */
#ifndef FST_APP_SWEEP_H
#define FST_APP_SWEEP_H

#include "io/journal.h"

/* A hash of a short fixed run: machines and builds on which it differs compute other bits. */
fst_status fst_arithmetic_fingerprint(fst_arithmetic arithmetic, int lanes, uint64_t *fingerprint,
                                      fst_error *error);

#endif
