/* terminal.c - signals, the progress line, and writing standard output completely or with a message. */
/* sigaltstack() is in POSIX with its extension. */
#define _XOPEN_SOURCE 700
#include "cli/terminal.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "cli/command.h"

/* When the first signal came, in ms; 0: none came.  A signal handler may touch nothing else. */
static atomic_llong first_signal = 0;

enum {
    ONE_INTERRUPTION = 250
}; /* ms; a second signal within this time is the same one: timeout(1), for example, sends it to the process and
      to its group */

/* Where memory runs out, some libraries end the program (HDF5, the run-time library of Fortran), crash (HDF5,
 * fontconfig) or raise SIGINT (OpenBLAS, where it gets no threads), and nothing that they answer tells it before.
 * Then this is the last that is done. */
static void break_down(int unused)
{
    static const char sentence[] =
        "festoon: a library that this command uses broke down, mostly because memory ran out\n";
    (void)unused;
    (void)!write(STDERR_FILENO, sentence, sizeof sentence - 1);
    _exit(1);
}

/* A signal that the program sends itself comes from a library. */
static void note_signal(int number, siginfo_t *from, void *unused)
{
    (void)unused;
    if (from->si_pid == getpid())
        break_down(0);
    struct timespec time = {0, 0};
    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    long long now = 1000LL * time.tv_sec + time.tv_nsec / 1000000 + 1, first = 0;
    if (atomic_compare_exchange_strong(&first_signal, &first, now) || now - first < ONE_INTERRUPTION)
        return;
    (void)signal(number, SIG_DFL);
    (void)raise(number);
}

/* If the caller closed a standard stream, the next file that is opened would take its place, and messages would
 * end up in that file.  So the place is taken here, in the wrong direction, so that writing still fails. */
static void keep_descriptor(int descriptor, int flags)
{
    if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF)
        (void)open("/dev/null", flags);
}

void terminal_prepare(void)
{
    keep_descriptor(STDIN_FILENO, O_WRONLY);
    keep_descriptor(STDOUT_FILENO, O_RDONLY);
    keep_descriptor(STDERR_FILENO, O_RDONLY);
    /* The first signal is noted.  Another one, a quarter of a second later or more, ends the
     * program at once. */
    struct sigaction action = {.sa_sigaction = note_signal, .sa_flags = SA_SIGINFO};
    (void)sigemptyset(&action.sa_mask);
    (void)sigaction(SIGINT, &action, NULL);
    (void)sigaction(SIGTERM, &action, NULL);
    /* A terminal that goes away ends a command in the same way, unless nohup(1) started it. */
    struct sigaction before;
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
        (void)sigaction(SIGHUP, &action, NULL);
    /* A closed pipe, or a file that exceeds the limit of ulimit -f, makes a write fail, with a message and
     * status 1, instead of ending the program by a signal. */
    struct sigaction ignore = {.sa_handler = SIG_IGN};
    (void)sigemptyset(&ignore.sa_mask);
    (void)sigaction(SIGPIPE, &ignore, NULL);
    (void)sigaction(SIGXFSZ, &ignore, NULL);
}

/* ---------------------------------------------------------------- libraries that break down */

static atomic_int at_work;

static void look_at_end(void)
{
    if (atomic_load(&at_work))
        break_down(0);
}

void terminal_work_begins(void)
{
    atomic_store(&at_work, atexit(look_at_end) == 0);
#ifdef NDEBUG /* a build for debugging shows where it breaks */
    static const int numbers[] = {SIGSEGV, SIGBUS, SIGABRT};
    static char stack[16384];
    struct sigaction action = {.sa_handler = break_down, .sa_flags = (int)(SA_ONSTACK | SA_RESETHAND)}, before;
    const stack_t aside = {.ss_sp = stack, .ss_size = sizeof stack};
    (void)sigemptyset(&action.sa_mask);
    (void)sigaltstack(&aside, NULL);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i)
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            (void)sigaction(numbers[i], &action, NULL);
#endif
}

void terminal_work_ends(void)
{
    atomic_store(&at_work, 0);
}

int interrupted(void)
{
    return atomic_load(&first_signal) != 0;
}

static double now(void)
{
    struct timespec time = {0, 0};
    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int silent;

void progress_silence(void)
{
    silent = 1;
}

void progress_begin(progress_line *line)
{
    line->in_place = isatty(STDERR_FILENO);
    line->started = now();
    line->shown = line->started;
}

static void show_time_left(double seconds)
{
    if (seconds < 600.0)
        (void)fprintf(stderr, "  %.0f s left", seconds);
    else if (seconds < 36000.0)
        (void)fprintf(stderr, "  %.0f min left", seconds / 60.0);
    else if (seconds < 200000.0)
        (void)fprintf(stderr, "  %.0f h left", seconds / 3600.0);
    else
        (void)fprintf(stderr, "  %.3g days left", seconds / 86400.0);
}

fst_status progress_show_left(progress_line *line, double fraction, double seconds_left, const char *what,
                              fst_error *error)
{
    if (interrupted())
        return fail(error, FST_INTERRUPTED, "", "interrupted after %.3g %% of the way", 100.0 * fraction);
    const double time = now(), passed = time - line->started;
    if (silent || time - line->shown < (line->in_place ? 0.2 : 30.0) || (!line->in_place && passed < 60.0))
        return FST_OK;
    line->shown = time;
    (void)fprintf(stderr, line->in_place ? "\r\033[K%5.1f %%" : "%5.1f %%", 100.0 * fraction);
    if (!line->in_place)
        (void)fprintf(stderr, "  after %.0f s", passed);
    if (isfinite(seconds_left))
        show_time_left(seconds_left);
    if (what)
        (void)fprintf(stderr, "  %.60s", what);
    if (!line->in_place)
        (void)fputc('\n', stderr);
    (void)fflush(stderr);
    return FST_OK;
}

fst_status progress_show(progress_line *line, double fraction, const char *what, fst_error *error)
{
    const double passed = now() - line->started;
    return progress_show_left(line, fraction, fraction > 0.0 ? passed * (1.0 - fraction) / fraction : INFINITY,
                              what, error);
}

fst_status progress_tell(void *line, double fraction, const char *what, fst_error *error)
{
    return progress_show(line, fraction, what, error);
}

void progress_end(progress_line *line)
{
    if (line->in_place && line->shown > line->started)
        (void)fputs("\r\033[K", stderr);
}

int read_standard_input(char *text, size_t most, size_t *size)
{
    enum { LOOK = 100 }; /* ms: a signal that comes just before read() would not end it */
    *size = 0;
    while (*size < most && !interrupted()) {
        struct pollfd input = {.fd = STDIN_FILENO, .events = POLLIN};
        if (poll(&input, 1, LOOK) <= 0)
            continue;
        const ssize_t got = read(STDIN_FILENO, text + *size, most - *size);
        if (got == 0)
            return 0;
        if (got < 0 && errno != EINTR)
            return errno;
        *size += got > 0 ? (size_t)got : 0;
    }
    return 0;
}

/* Write everything: 0, or errno. -1: the reader, such as head(1), took a part and wants no more, which is no
 * failure. */
static int write_all(const char *text, size_t size, int *some)
{
    while (size > 0) {
        ssize_t written = write(STDOUT_FILENO, text, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0 && errno == EPIPE && *some)
            return -1;
        if (written <= 0)
            return written < 0 ? errno : ENOSPC;
        *some = 1;
        text += written;
        size -= (size_t)written;
    }
    return 0;
}

/* Some file systems report a full disk only when the file is closed. */
static int end_standard_output(int reason)
{
    const int failed = close(STDOUT_FILENO) != 0 ? errno : 0;
    return reason > 0 ? reason : reason < 0 ? 0 : failed == EINTR ? 0 : failed;
}

int write_standard_output(const char *text, size_t size)
{
    int some = 0;
    return end_standard_output(write_all(text, size, &some));
}

FILE *spool_open(void)
{
    const char *folder = getenv("TMPDIR");
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/festoon-XXXXXX", folder && folder[0] ? folder : "/tmp");
    const int descriptor = length < (int)sizeof path ? mkstemp(path) : -1;
    if (descriptor < 0)
        return NULL;
    (void)unlink(path); /* the file exists as long as it is open */
    FILE *spool = fdopen(descriptor, "w+");
    if (!spool)
        (void)close(descriptor);
    return spool;
}

int spool_to_standard_output(FILE *spool)
{
    char piece[65536];
    size_t size;
    int reason = 0, some = 0;
    rewind(spool);
    while (reason == 0 && (size = fread(piece, 1, sizeof piece, spool)) > 0)
        reason = write_all(piece, size, &some);
    if (reason == 0 && ferror(spool))
        reason = EIO;
    return end_standard_output(reason);
}

/* ------------------------------------------------------------------ standard output of a command that fails */

static int is_kept;

void output_keep(void)
{
    is_kept = 1;
}

int output_is_kept(void)
{
    return is_kept;
}
