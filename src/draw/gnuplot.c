#define _GNU_SOURCE /* pipe2 */

#include "draw/gnuplot.h"

#include "base/error.h"
#include "draw/process.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { PATIENCE_MS = 60000, WORDS_SIZE = 512 };

static long long milliseconds(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (long long)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

/* Read until the other end closes or the deadline passes; keep the beginning, on one line. */
static void listen_to(int input, long long deadline, char *words, size_t size)
{
    size_t kept = 0;
    for (;;) {
        long long left = deadline - milliseconds();
        struct pollfd waiting = {.fd = input, .events = POLLIN};
        if (left <= 0)
            break;
        int ready = poll(&waiting, 1, (int)left);
        if (ready < 0 && errno == EINTR)
            continue;
        if (ready <= 0)
            break;
        char piece[1024];
        ssize_t got = read(input, piece, sizeof piece);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        for (ssize_t i = 0; i < got && kept + 1 < size; i++) {
            char c = (unsigned char)piece[i] < ' ' ? ' ' : piece[i];
            /* gnuplot underlines the error's place with white space: one blank says enough. */
            if (c != ' ' || (kept > 0 && words[kept - 1] != ' '))
                words[kept++] = c;
        }
    }
    words[kept] = '\0';
}

/* Wait for the child, and end it at the deadline; 1 if it had to be ended. */
static int wait_for(pid_t child, long long deadline, int *outcome)
{
    int ended = 0;
    for (;;) {
        pid_t done = waitpid(child, outcome, ended ? 0 : WNOHANG);
        if (done == child)
            return ended;
        if (done < 0 && errno != EINTR) { /* the caller ignores SIGCHLD: the figure itself will tell */
            *outcome = 0;
            return ended;
        }
        if (!ended && milliseconds() >= deadline) {
            (void)kill(child, SIGKILL);
            ended = 1;
        } else if (!ended) {
            (void)nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
        }
    }
}

fst_status fst_gnuplot_run(const char *directory, const char *script, const char *figure, fst_error *error)
{
    /* Quotes in the name are doubled; "./" keeps a script that begins with a minus from being an option. */
    char setting[2 * PATH_MAX], file[PATH_MAX];
    size_t used = (size_t)snprintf(setting, sizeof setting, "figure='");
    for (const char *c = figure; *c && used + 4 < sizeof setting; c++) {
        if (*c == '\'')
            setting[used++] = '\'';
        setting[used++] = *c;
    }
    (void)memcpy(setting + used, "'", 2);
    if (used + 4 >= sizeof setting || snprintf(file, sizeof file, "./%s", script) >= (int)sizeof file)
        return fst_fail(error, FST_BAD_INPUT, script, "the file name is too long");
    char name[] = "gnuplot", defaults[] = "--default-settings", execute[] = "-e";
    char *const arguments[] = {name, defaults, execute, setting, file, NULL};

    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return fst_fail(error, FST_IO, script, "no pipe to gnuplot: %s", strerror(errno));
    long long deadline = milliseconds() + PATIENCE_MS;
    pid_t child = 0;
    const fst_process gnuplot = {"gnuplot", arguments, directory, -1, ends[1], ends[1]};
    int failed = fst_process_start(&gnuplot, &child);
    (void)close(ends[1]);
    if (failed) {
        (void)close(ends[0]);
        if (failed == ENOENT)
            return fst_fail(error, FST_UNAVAILABLE, script,
                            "figures need gnuplot, which is not installed: install the package gnuplot-nox");
        return fst_fail(error, FST_IO, script, "cannot start gnuplot: %s", strerror(failed));
    }
    char words[WORDS_SIZE];
    listen_to(ends[0], deadline, words, sizeof words);
    (void)close(ends[0]);
    int outcome = 0;
    if (wait_for(child, deadline, &outcome))
        return fst_fail(error, FST_IO, script, "gnuplot did not end within %d s", PATIENCE_MS / 1000);
    if (WIFEXITED(outcome) && WEXITSTATUS(outcome) == 127 && words[0] == '\0')
        return fst_fail(error, FST_UNAVAILABLE, script,
                        "figures need gnuplot, which could not be run: install the package gnuplot-nox");
    if (!WIFEXITED(outcome) || WEXITSTATUS(outcome) != 0)
        return fst_fail(error, FST_IO, script, "gnuplot failed: %s", words[0] ? words : "it said nothing");
    return FST_OK;
}
