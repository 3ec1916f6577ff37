/* clock_ahead.c - preloaded into a program, it sets the time of day an hour ahead of the clock by which the
 * kernel waits: so a program sees it that read the time just before it was set back. */
#define _GNU_SOURCE
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

__attribute__((visibility("default"))) int clock_gettime(clockid_t clock, struct timespec *time)
{
    const long status = syscall(SYS_clock_gettime, clock, time);
    if (status == 0 && clock == CLOCK_REALTIME)
        time->tv_sec += 3600;
    return (int)status;
}
