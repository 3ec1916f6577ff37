/* clock_fast.c - preloaded into a program, it lets the clock that never goes back run a hundred times as fast: what a
 * command does once a minute has passed, it does at once. */
#define _GNU_SOURCE
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

enum { TIMES = 100 };

static long long first;

static long long nanoseconds(const struct timespec *time)
{
    return 1000000000LL * time->tv_sec + time->tv_nsec;
}

__attribute__((constructor)) static void begin(void)
{
    struct timespec time;
    (void)syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &time);
    first = nanoseconds(&time);
}

__attribute__((visibility("default"))) int clock_gettime(clockid_t clock, struct timespec *time)
{
    const long status = syscall(SYS_clock_gettime, clock, time);
    if (status == 0 && clock == CLOCK_MONOTONIC) {
        const long long shown = first + TIMES * (nanoseconds(time) - first);
        time->tv_sec = (time_t)(shown / 1000000000LL);
        time->tv_nsec = (long)(shown % 1000000000LL);
    }
    return (int)status;
}
