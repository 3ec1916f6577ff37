/* child.c - a process, its three streams, and waiting for whichever has something. */
#define _GNU_SOURCE /* pipe2 */

#include "track/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/watch.h"
#include "host/process.h"

enum { PATIENCE = 50, MOST_ARGUMENTS = 48 }; /* ms */

static void close_end(int *end)
{
    if (*end >= 0)
        (void)close(*end);
    *end = -1;
}

static void close_pair(int pair[2])
{
    close_end(&pair[0]);
    close_end(&pair[1]);
}

/* The pipes to and from the child; where one fails, none is left open. */
static int open_pipes(int feeds, int in[2], int out[2], int words[2])
{
    in[0] = in[1] = out[0] = out[1] = words[0] = words[1] = -1;
    /* A socket instead of a pipe, because send() can be told to raise no SIGPIPE when the child ends early. */
    int failed = feeds && socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in) != 0 ? errno : 0;
    if (!failed && (pipe2(out, O_CLOEXEC) != 0 || pipe2(words, O_CLOEXEC) != 0))
        failed = errno;
    if (failed) {
        close_pair(in);
        close_pair(out);
        close_pair(words);
    }
    return failed;
}

fst_status track_child_start(track_child *child, const char *const *arguments, int input, fst_error *error)
{
    int in[2], out[2], words[2], count = 0;
    char *writable[MOST_ARGUMENTS]; /* posix_spawn() wants them so, but does not change them */
    while (arguments[count])
        ++count;
    memcpy(writable, arguments, ((size_t)count + 1) * sizeof *writable);
    child->said_size = 0;
    child->said[0] = '\0';
    child->pending_size = 0;
    int failed = open_pipes(child->feed != NULL, in, out, words);
    if (failed)
        return fst_fail(error, FST_IO, arguments[0], "no pipe to %s: %s", arguments[0], strerror(failed));
    const fst_process process = {arguments[0], writable, NULL, child->feed ? in[1] : input, out[1], words[1]};
    failed = fst_process_start(&process, &child->pid);
    close_end(&in[1]);
    close_end(&out[1]);
    close_end(&words[1]);
    child->input = in[0];
    child->output = out[0];
    child->words = words[0];
    if (!failed)
        return FST_OK;
    child->pid = 0;
    close_end(&child->input);
    close_end(&child->output);
    close_end(&child->words);
    return failed == ENOENT
               ? fst_fail(error, FST_UNAVAILABLE, "track",
                          "films are read by %s, which is not installed: install the package ffmpeg",
                          arguments[0])
               : fst_fail(error, FST_IO, "track", "cannot start %s: %s", arguments[0], strerror(failed));
}

/* Keep the beginning of what the child says. */
static void hear(track_child *child)
{
    char piece[512];
    const ssize_t got = read(child->words, piece, sizeof piece);
    for (ssize_t i = 0; i < got && child->said_size + 1 < sizeof child->said; ++i)
        child->said[child->said_size++] = (unsigned char)piece[i] < ' ' ? ' ' : piece[i];
    child->said[child->said_size] = '\0';
    if (got == 0 || (got < 0 && errno != EINTR))
        close_end(&child->words);
}

/* Hand over what is pending, or more. */
static fst_status feed(track_child *child, fst_error *error)
{
    if (child->pending_size == 0) {
        const fst_status status = child->feed(child->user, &child->pending, &child->pending_size, error);
        if (status != FST_OK)
            return status;
        if (child->pending_size == 0) {
            close_end(&child->input);
            return FST_OK;
        }
    }
    const ssize_t sent = send(child->input, child->pending, child->pending_size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
        child->pending += sent;
        child->pending_size -= (size_t)sent;
    } else if (sent < 0 && errno != EINTR && errno != EAGAIN) {
        close_end(&child->input); /* it wants no more; its output tells what came of it */
    }
    return FST_OK;
}

fst_status track_child_read(track_child *child, void *bytes, size_t size, size_t *got, fst_error *error)
{
    *got = 0;
    for (;;) {
        struct pollfd ends[3] = {{.fd = child->output, .events = POLLIN},
                                 {.fd = child->words, .events = POLLIN},
                                 {.fd = child->input, .events = POLLOUT}};
        const int ready = poll(ends, 3, PATIENCE);
        if (ready < 0 && errno != EINTR)
            return fst_fail(error, FST_IO, "track", "cannot wait for ffmpeg: %s", strerror(errno));
        if (ready <= 0) {
            const fst_status told = fst_tell(child->progress, child->fraction, NULL, error);
            if (told != FST_OK)
                return told;
            continue;
        }
        if (ends[1].revents)
            hear(child);
        if (ends[2].revents) {
            const fst_status fed = feed(child, error);
            if (fed != FST_OK)
                return fed;
        }
        if (!ends[0].revents)
            continue;
        const ssize_t length = read(child->output, bytes, size);
        if (length < 0 && (errno == EINTR || errno == EAGAIN))
            continue;
        if (length < 0)
            return fst_fail(error, FST_IO, "track", "cannot read what ffmpeg writes: %s", strerror(errno));
        *got = (size_t)length;
        return FST_OK;
    }
}

int track_child_end(track_child *child, int abandon)
{
    int outcome = 0;
    pid_t done;
    if (abandon)
        (void)kill(child->pid, SIGKILL);
    close_end(&child->input);
    close_end(&child->output);
    while (child->words >= 0)
        hear(child);
    do
        done = waitpid(child->pid, &outcome, 0);
    while (done < 0 && errno == EINTR);
    return done == child->pid && WIFEXITED(outcome) && WEXITSTATUS(outcome) == 0;
}
