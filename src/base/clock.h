/* clock.h - a clock that only runs forward.  (The time of day does not: it may be set back by hours.) */
#ifndef FST_BASE_CLOCK_H
#define FST_BASE_CLOCK_H

#include <time.h>

/* Seconds since some fixed moment: only differences mean something. */
static inline double fst_clock_seconds(void)
{
    struct timespec time = {0, 0};
    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

#endif
