/* Preloaded, a program gets a tenth of the time: a child of it stops it and lets it go on, over and over.  By
 * hand, to see that no test depends on speed: tests/slowly. */
#define _GNU_SOURCE
#include <signal.h>
#include <time.h>
#include <unistd.h>

enum { WORK = 2000000, REST = 18000000 }; /* ns */

static void pass(long nanoseconds)
{
    const struct timespec time = {0, nanoseconds};
    (void)nanosleep(&time, NULL);
}

__attribute__((constructor)) static void begin(void)
{
    const pid_t slowed = getpid();
    if (fork() != 0)
        return;
    (void)setpgid(0, 0); /* signals of the terminal are not for this one */
    for (int descriptor = 0; descriptor < 1024; ++descriptor)
        (void)close(descriptor);
    while (getppid() == slowed) {
        (void)kill(slowed, SIGSTOP);
        pass(REST);
        (void)kill(slowed, SIGCONT);
        pass(WORK);
    }
    _exit(0);
}
