/* gnuplot.c - running gnuplot: its figure and its words come back through pipes, and it has a time limit. */
#define _GNU_SOURCE /* pipe2, strsignal */

#include "draw/gnuplot.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/text.h"
#include "host/process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { PATIENCE = 60 /* seconds */, WORDS_SIZE = 512 };

/* The beginning of what gnuplot says, on one line. */
typedef struct last_words {
    char text[WORDS_SIZE];
    size_t kept;
} last_words;

static void keep_words(last_words *words, const char *piece, size_t size)
{
    for (size_t i = 0; i < size && words->kept + 1 < sizeof words->text; ++i) {
        const char c = (unsigned char)piece[i] < ' ' ? ' ' : piece[i];
        /* gnuplot underlines the place of an error with white space: keep one blank of it. */
        if (c != ' ' || (words->kept > 0 && words->text[words->kept - 1] != ' '))
            words->text[words->kept++] = c;
    }
    words->text[words->kept] = '\0';
}

/* Read the figure from ends[0] and gnuplot's words from ends[1], until both are closed or the
 * deadline passes. */
static void listen_to(const int ends[2], double deadline, FILE *figure, last_words *words)
{
    struct pollfd waiting[2] = {{.fd = ends[0], .events = POLLIN}, {.fd = ends[1], .events = POLLIN}};
    while (waiting[0].fd >= 0 || waiting[1].fd >= 0) {
        const double left = deadline - fst_clock_seconds();
        if (left <= 0)
            return;
        const int ready = poll(waiting, 2, 1 + (int)(1e3 * left));
        if (ready < 0 && errno != EINTR)
            return;
        for (int i = 0; i < 2 && ready > 0; ++i) {
            char piece[16384];
            if (!waiting[i].revents)
                continue;
            const ssize_t got = read(ends[i], piece, sizeof piece);
            if (got > 0 && i == 0)
                (void)fwrite(piece, 1, (size_t)got, figure); /* a failure is seen when the file is synced */
            else if (got > 0)
                keep_words(words, piece, (size_t)got);
            else if (got == 0 || errno != EINTR)
                waiting[i].fd = -1;
        }
    }
}

/* Wait for gnuplot, and end it at the deadline; 1 if it had to be ended. */
static int wait_for(pid_t child, double deadline, int *outcome)
{
    int ended = 0;
    for (;;) {
        pid_t done = waitpid(child, outcome, ended ? 0 : WNOHANG);
        if (done == child)
            return ended;
        if (done < 0 &&
            errno !=
                EINTR) { /* the caller ignores SIGCHLD, so its status is lost; the figure itself will tell */
            *outcome = 0;
            return ended;
        }
        if (!ended && fst_clock_seconds() >= deadline) {
            (void)kill(child, SIGKILL);
            ended = 1;
        } else if (!ended) {
            (void)nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
        }
    }
}

void fst_gnuplot_quote(FILE *out, const char *text)
{
    char *tame = strdup(text);
    (void)fputc('\'', out);
    if (tame)
        fst_text_tame(tame);
    for (const char *c = tame; c && *c; ++c) {
        if (*c == '\'')
            (void)fputc('\'', out);
        (void)fputc(*c, out);
    }
    (void)fputc('\'', out);
    free(tame);
}

/* What gnuplot is told before the script.  An empty name for the figure means standard output. "./" before the
 * data's name keeps gnuplot from taking it for a command ("< command"). free() it. */
static char *settings(const char *data)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    char *path = malloc(strlen(data) + sizeof "./");
    if (out && path) {
        (void)sprintf(path, "%s%s", data[0] == '/' ? "" : "./", data);
        (void)fputs("figure=''; data=", out);
        fst_gnuplot_quote(out, path);
    }
    free(path);
    if (!out || fclose(out) != 0 || size < sizeof "figure=''; data=''") {
        free(text);
        return NULL;
    }
    return text;
}

/* Start gnuplot with its outputs at the writing ends of two pipes, which are closed here. 0, or an errno. */
static int start(const char *directory, char *setting, char *script, int pipes[2][2], pid_t *child)
{
    char name[] = "gnuplot", defaults[] = "--default-settings", execute[] = "-e";
    char *const arguments[] = {name, defaults, execute, setting, script, NULL};
    const fst_process gnuplot = {"gnuplot", arguments, directory, -1, pipes[0][1], pipes[1][1]};
    const int failed = fst_process_start(&gnuplot, child);
    (void)close(pipes[0][1]);
    (void)close(pipes[1][1]);
    return failed;
}

static fst_status judge(int outcome, const char *script, const char *words, fst_error *error)
{
    if (WIFEXITED(outcome) && WEXITSTATUS(outcome) == 127 && words[0] == '\0')
        return fst_fail(error, FST_UNAVAILABLE, script,
                        "figures need gnuplot, which could not be run: install the package gnuplot-nox");
    if (WIFSIGNALED(outcome))
        return fst_fail(error, FST_IO, script, "gnuplot was ended by the signal %d (%s) %s", WTERMSIG(outcome),
                        strsignal(WTERMSIG(outcome)), words);
    if (!WIFEXITED(outcome) || WEXITSTATUS(outcome) != 0)
        return fst_fail(error, FST_IO, script, "gnuplot failed: %s", words[0] ? words : "it said nothing");
    return FST_OK;
}

static fst_status run_on(const char *directory, char *setting, char *path, const char *script, FILE *figure,
                         fst_error *error)
{
    int pipes[2][2];
    if (pipe2(pipes[0], O_CLOEXEC) != 0)
        return fst_fail(error, FST_IO, script, "no pipe to gnuplot: %s", strerror(errno));
    if (pipe2(pipes[1], O_CLOEXEC) != 0) {
        (void)close(pipes[0][0]);
        (void)close(pipes[0][1]);
        return fst_fail(error, FST_IO, script, "no pipe to gnuplot: %s", strerror(errno));
    }
    const double deadline = fst_clock_seconds() + PATIENCE;
    const int ends[2] = {pipes[0][0], pipes[1][0]};
    last_words words = {"", 0};
    pid_t child = 0;
    int outcome = 0, ended = 0;
    const int failed = start(directory, setting, path, pipes, &child);
    if (!failed)
        listen_to(ends, deadline, figure, &words);
    (void)close(ends[0]);
    (void)close(ends[1]);
    if (failed == ENOENT)
        return fst_fail(error, FST_UNAVAILABLE, script,
                        "figures need gnuplot, which is not installed: install the package gnuplot-nox");
    if (failed)
        return fst_fail(error, FST_IO, script, "cannot start gnuplot: %s", strerror(failed));
    ended = wait_for(child, deadline, &outcome);
    if (ended)
        return fst_fail(error, FST_IO, script, "gnuplot did not end within %d s", PATIENCE);
    return judge(outcome, script, words.text, error);
}

fst_status fst_gnuplot_run(const char *directory, const char *script, const char *data, FILE *figure,
                           fst_error *error)
{
    /* "./" keeps gnuplot from taking a name that begins with a minus for an option. */
    char *setting = settings(data), *path = malloc(strlen(script) + sizeof "./");
    fst_status status = FST_OK;
    if (setting && path) {
        (void)sprintf(path, "%s%s", script[0] == '/' ? "" : "./", script);
        status = run_on(directory, setting, path, script, figure, error);
    } else {
        status = fst_fail(error, FST_NO_MEMORY, script, "no memory for a file name");
    }
    free(setting);
    free(path);
    return status;
}
