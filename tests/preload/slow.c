/* slow.c - preloaded, it gives a program a tenth of the time: a child process stops the program and lets it go
 * on, over and over. Used by hand through tests/slowly, to see that no test depends on speed. */
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
    (void)setpgid(0, 0); /* must not receive signals of the terminal */
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
