/* Preloaded, the clock of the day is an hour ahead of the one by which the kernel waits: what a program sees
 * that read the clock just before it was set back. */
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
