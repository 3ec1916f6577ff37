/* process.c - a program: started by posix_spawn(), its three streams, waiting for whichever has something, and
 * how it ended. */
#define _GNU_SOURCE /* pipe2, posix_spawn_file_actions_addchdir_np, strsignal */

#include "host/process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/error.h"
#include "base/watch.h"

extern char **environ;

enum { WAIT = 50 /* ms */, MOST_ARGUMENTS = 48 };

/* ---------------------------------------------------------------- starting */

static int add_stream(posix_spawn_file_actions_t *actions, int from, int to, int flags)
{
    return from < 0 ? posix_spawn_file_actions_addopen(actions, to, "/dev/null", flags, 0)
                    : posix_spawn_file_actions_adddup2(actions, from, to);
}

static int add_actions(posix_spawn_file_actions_t *actions, const int streams[3], const char *directory)
{
    int failed = add_stream(actions, streams[0], STDIN_FILENO, O_RDONLY);
    for (int i = 1; i < 3 && !failed; ++i)
        failed = add_stream(actions, streams[i], i, O_WRONLY);
    if (!failed && directory)
        failed = posix_spawn_file_actions_addchdir_np(actions, directory);
    return failed;
}

/* Start a program on three descriptors, where -1 is /dev/null.  Returns 0, or an errno. */
static int spawn(const char *const *arguments, const char *directory, const int streams[3], pid_t *child)
{
    char *writable[MOST_ARGUMENTS]; /* posix_spawn() wants them so, but does not change them */
    size_t count = 0;
    while (arguments[count])
        ++count;
    memcpy(writable, arguments, (count + 1) * sizeof *writable);
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    int failed = posix_spawn_file_actions_init(&actions);
    if (failed)
        return failed;
    failed = posix_spawnattr_init(&attributes);
    if (failed) {
        (void)posix_spawn_file_actions_destroy(&actions);
        return failed;
    }
    /* The caller's thread may have blocked or ignored signals; the program must not inherit that. */
    sigset_t none, restored;
    (void)sigemptyset(&none);
    (void)sigemptyset(&restored);
    (void)sigaddset(&restored, SIGPIPE);
    (void)sigaddset(&restored, SIGXFSZ); /* a helper that ignores it could go on after its file was cut off at
                                            the limit of ulimit -f */
    (void)posix_spawnattr_setsigmask(&attributes, &none);
    (void)posix_spawnattr_setsigdefault(&attributes, &restored);
    (void)posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    failed = add_actions(&actions, streams, directory);
    if (!failed)
        failed = posix_spawnp(child, arguments[0], &actions, &attributes, writable, environ);
    (void)posix_spawnattr_destroy(&attributes);
    (void)posix_spawn_file_actions_destroy(&actions);
    return failed;
}

int fst_process_leave(const char *const *arguments)
{
    pid_t child;
    return spawn(arguments, NULL, (const int[3]){-1, -1, -1}, &child);
}

static void close_end(int *end)
{
    if (*end >= 0)
        (void)close(*end);
    *end = -1;
}

static void close_ends(int *const ends[3])
{
    for (int i = 0; i < 3; ++i)
        close_end(ends[i]);
}

/* Our ends of the streams, and the program's; where one cannot be made, none is left open.  Returns 0, or an
 * errno. */
static int open_streams(fst_process *process, const fst_program *program, int theirs[3])
{
    int in[2] = {-1, -1}, out[2] = {-1, -1}, words[2] = {-1, -1}, failed = 0;
    /* A socket instead of a pipe, because send() can be told to raise no SIGPIPE when the program ends early.
     */
    if ((program->input == FST_INPUT_FED && socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in) != 0) ||
        (program->is_read && pipe2(out, O_CLOEXEC) != 0) || pipe2(words, O_CLOEXEC) != 0)
        failed = errno;
    process->input = in[0];
    process->output = out[0];
    process->words = words[0];
    theirs[0] = in[1];
    theirs[1] = out[1];
    theirs[2] = words[1];
    if (failed) {
        close_ends((int *const[3]){&process->input, &process->output, &process->words});
        close_ends((int *const[3]){&theirs[0], &theirs[1], &theirs[2]});
    }
    return failed;
}

fst_status fst_process_start(fst_process *process, const fst_program *program, const char *where,
                             fst_error *error)
{
    int theirs[3];
    process->where = where;
    process->name = program->arguments[0];
    process->purpose = program->purpose;
    process->package = program->package;
    process->pid = 0;
    process->said_size = process->pending_size = 0;
    process->said[0] = '\0';
    process->deadline = fst_clock_seconds() + process->patience;
    int failed = open_streams(process, program, theirs);
    if (failed)
        return fst_fail(error, FST_IO, where, "no pipe to %s: %s", process->name, strerror(failed));
    const int input = program->input >= 0 ? program->input : theirs[0];
    failed = spawn(program->arguments, program->directory, (const int[3]){input, theirs[1], theirs[2]},
                   &process->pid);
    close_ends((int *const[3]){&theirs[0], &theirs[1], &theirs[2]});
    if (!failed)
        return FST_OK;
    process->pid = 0;
    close_ends((int *const[3]){&process->input, &process->output, &process->words});
    return failed == ENOENT
               ? fst_fail(error, FST_UNAVAILABLE, where, "%s, which is not installed: install the package %s",
                          program->purpose, program->package)
               : fst_fail(error, FST_IO, where, "cannot start %s: %s", process->name, strerror(failed));
}

/* ---------------------------------------------------------------- at work */

/* Keep the beginning of what the program says: no control characters, and one blank for several (gnuplot
 * underlines the place of an error with white space). */
static void hear(fst_process *process)
{
    char piece[512];
    const ssize_t got = read(process->words, piece, sizeof piece);
    for (ssize_t i = 0; i < got && process->said_size + 1 < sizeof process->said; ++i) {
        const char c = (unsigned char)piece[i] < ' ' ? ' ' : piece[i];
        if (c != ' ' || (process->said_size > 0 && process->said[process->said_size - 1] != ' '))
            process->said[process->said_size++] = c;
    }
    process->said[process->said_size] = '\0';
    if (got == 0 || (got < 0 && errno != EINTR))
        close_end(&process->words);
}

/* Hand over some of what is pending; a program that wants no more closes its input. */
static void hand_over(fst_process *process)
{
    const ssize_t sent =
        send(process->input, process->pending, process->pending_size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
        process->pending += sent;
        process->pending_size -= (size_t)sent;
    } else if (sent < 0 && errno != EINTR && errno != EAGAIN) {
        close_end(&process->input);
    }
}

static int is_late(const fst_process *process)
{
    return process->patience > 0 && fst_clock_seconds() >= process->deadline;
}

static fst_status fail_late(const fst_process *process, fst_error *error)
{
    return fst_fail(error, FST_IO, process->where, "%s did not end within %d s", process->name,
                    process->patience);
}

/* Wait until one of the streams has something or 50 ms have passed, and do what there is to do; *has_output
 * says whether that is to read. */
static fst_status take_turn(fst_process *process, int *has_output, fst_error *error)
{
    struct pollfd ends[3] = {{.fd = process->output, .events = POLLIN},
                             {.fd = process->words, .events = POLLIN},
                             {.fd = process->pending_size > 0 ? process->input : -1, .events = POLLOUT}};
    *has_output = 0;
    const int ready = poll(ends, 3, WAIT);
    if (ready < 0 && errno != EINTR)
        return fst_fail(error, FST_IO, process->where, "cannot wait for %s: %s", process->name,
                        strerror(errno));
    if (is_late(process))
        return fail_late(process, error);
    if (ready <= 0)
        return fst_tell(process->progress, process->fraction, NULL, error);
    if (ends[1].revents)
        hear(process);
    if (ends[2].revents)
        hand_over(process);
    *has_output = ends[0].revents != 0;
    return FST_OK;
}

fst_status fst_process_write(fst_process *process, const unsigned char *bytes, size_t size, fst_error *error)
{
    fst_status status = FST_OK;
    int has_output;
    process->pending = bytes;
    process->pending_size = size;
    while (status == FST_OK && process->pending_size > 0 && process->input >= 0)
        status = take_turn(process, &has_output, error);
    if (status == FST_OK && process->pending_size > 0)
        status = fst_fail(error, FST_IO, process->where, "%s takes no more bytes", process->name);
    process->pending_size = 0;
    return status;
}

/* Get more for the program's standard input where it has taken everything. */
static fst_status feed(fst_process *process, fst_error *error)
{
    if (!process->feed || process->input < 0 || process->pending_size > 0)
        return FST_OK;
    const fst_status status = process->feed(process->user, &process->pending, &process->pending_size, error);
    if (status == FST_OK && process->pending_size == 0)
        close_end(&process->input);
    return status;
}

fst_status fst_process_read(fst_process *process, void *bytes, size_t size, size_t *got, fst_error *error)
{
    *got = 0;
    for (;;) {
        int has_output = 0;
        fst_status status = feed(process, error);
        if (status == FST_OK)
            status = take_turn(process, &has_output, error);
        if (status != FST_OK)
            return status;
        const ssize_t length = has_output ? read(process->output, bytes, size) : -1;
        if (length >= 0) {
            *got = (size_t)length;
            return FST_OK;
        }
        if (has_output && errno != EINTR && errno != EAGAIN)
            return fst_fail(error, FST_IO, process->where, "cannot read what %s writes: %s", process->name,
                            strerror(errno));
    }
}

/* ---------------------------------------------------------------- the end */

/* Wait until the program has ended, or end it when its time is over; 1: its time is over. */
static int wait_for(const fst_process *process, int *outcome)
{
    int ended = 0;
    for (;;) {
        const pid_t done = waitpid(process->pid, outcome, process->patience > 0 && !ended ? WNOHANG : 0);
        if (done == process->pid)
            return ended;
        if (done < 0 &&
            errno != EINTR) { /* the caller ignores SIGCHLD, so its status is lost: its work will tell */
            *outcome = 0;
            return ended;
        }
        if (!ended && is_late(process)) {
            (void)kill(process->pid, SIGKILL);
            ended = 1;
        } else if (!ended) {
            (void)nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
        }
    }
}

static fst_status judge(const fst_process *process, int outcome, fst_error *error)
{
    const char *name = process->name, *said = process->said;
    if (WIFSIGNALED(outcome))
        return fst_fail(error, FST_IO, process->where, "%s was ended by the signal %d (%s) %s", name,
                        WTERMSIG(outcome), strsignal(WTERMSIG(outcome)), said);
    if (WIFEXITED(outcome) && WEXITSTATUS(outcome) == 127 && !said[0])
        return fst_fail(error, FST_UNAVAILABLE, process->where,
                        "%s, which could not be run: install the package %s", process->purpose,
                        process->package);
    if (!WIFEXITED(outcome) || WEXITSTATUS(outcome) != 0)
        return fst_fail(error, FST_IO, process->where, "%s failed: %s", name,
                        said[0] ? said : "it said nothing");
    return FST_OK;
}

fst_status fst_process_end(fst_process *process, int abandon, fst_error *error)
{
    int outcome = 0, has_output;
    process->progress = NULL;
    if (abandon)
        (void)kill(process->pid, SIGKILL);
    close_end(&process->input);
    close_end(&process->output);
    while (!abandon && process->words >= 0 && take_turn(process, &has_output, NULL) == FST_OK)
        continue;
    close_end(&process->words);
    const int is_over = wait_for(process, &outcome);
    if (abandon)
        return FST_OK;
    return is_over ? fail_late(process, error) : judge(process, outcome, error);
}
