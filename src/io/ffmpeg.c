/* ffmpeg.c - an ffmpeg process: starting it, handing it frames, and finding out whether it failed. */
#define _GNU_SOURCE /* pipe2, strsignal */

#include "io/ffmpeg.h"

#include "base/error.h"
#include "host/process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_ARGUMENTS = 48 };

/* The numbers of a kind of film as ffmpeg wants them. */
typedef struct spelled {
    char size[32], rate[32], quality[16], times[96], file[4096];
} spelled;

static int spell(const fst_ffmpeg_kind *kind, const char *out, spelled *words)
{
    (void)snprintf(words->size, sizeof words->size, "%dx%d", kind->width, kind->height);
    (void)snprintf(words->rate, sizeof words->rate, "%.6g", kind->fps);
    (void)snprintf(words->quality, sizeof words->quality, "%d", kind->quality);
    (void)snprintf(words->times, sizeof words->times, "setpts='(N+floor(N/%d))/(%.6g*TB)'", kind->drop - 1,
                   kind->fps);
    return snprintf(words->file, sizeof words->file, "file:%s", out) < (int)sizeof words->file;
}

/* The whole command line.  The encoders get two threads. */
static void list_arguments(const fst_ffmpeg_kind *kind, const spelled *words,
                           const char *arguments[MOST_ARGUMENTS])
{
    const char *const head[] = {"ffmpeg", "-nostdin",  "-hide_banner", "-loglevel",  "error",    "-y",
                                "-f",     "rawvideo",  "-pix_fmt",     kind->pixels, "-s",       words->size,
                                "-r",     words->rate, "-i",           "pipe:0",     "-threads", "2",
                                NULL};
    const char *const mpeg[] = {"-c:v",     "libx264", "-preset",   "veryfast",   "-crf", words->quality,
                                "-pix_fmt", "yuv420p", "-movflags", "+faststart", NULL};
    const char *const drop[] = {"-vf", words->times, "-fps_mode", "passthrough", NULL};
    static const char *const gif[] = {
        "-vf", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none", "-loop", "0", NULL};
    static const char *const png[] = {"-c:v", "png", "-frames:v", "1", NULL}, *const none[] = {NULL};
    const int is_gif = strcmp(kind->format, "gif") == 0, is_png = strcmp(kind->format, "png") == 0;
    const char *const *parts[] = {head,
                                  is_gif   ? gif
                                  : is_png ? png
                                           : mpeg,
                                  kind->drop && !is_gif ? drop : none};
    int count = 0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i)
        for (const char *const *word = parts[i]; *word; ++word)
            arguments[count++] = *word;
    arguments[count++] = "-f";
    arguments[count++] = is_png ? "image2pipe" : kind->format;
    arguments[count++] = words->file;
    arguments[count] = NULL;
}

fst_status fst_ffmpeg_start(fst_ffmpeg *film, const fst_ffmpeg_kind *kind, const char *out, const char *name,
                            fst_error *error)
{
    film->name = name;
    film->said_size = 0;
    film->said[0] = '\0';
    spelled spelt;
    const char *arguments[MOST_ARGUMENTS];
    if (!spell(kind, out, &spelt))
        return fst_fail(error, FST_BAD_INPUT, name, "the file name is too long");
    list_arguments(kind, &spelt, arguments);
    int input[2], words[2];
    /* A socket instead of a pipe, because send() can be told to raise no SIGPIPE when ffmpeg ends early. */
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input) != 0)
        return fst_fail(error, FST_IO, name, "no socket to ffmpeg: %s", strerror(errno));
    if (pipe2(words, O_CLOEXEC) != 0) {
        (void)close(input[0]);
        (void)close(input[1]);
        return fst_fail(error, FST_IO, name, "no pipe from ffmpeg: %s", strerror(errno));
    }
    /* posix_spawn() wants writable arguments, but does not change them. */
    char *writable[MOST_ARGUMENTS];
    memcpy(writable, arguments, sizeof writable);
    const fst_process ffmpeg = {"ffmpeg", writable, NULL, input[1], -1, words[1]};
    int failed = fst_process_start(&ffmpeg, &film->child);
    (void)close(input[1]);
    (void)close(words[1]);
    film->frames = input[0];
    film->words = words[0];
    if (!failed)
        return FST_OK;
    (void)close(input[0]);
    (void)close(words[0]);
    if (failed == ENOENT)
        return fst_fail(error, FST_UNAVAILABLE, name,
                        "films need ffmpeg, which is not installed: install the package ffmpeg");
    return fst_fail(error, FST_IO, name, "cannot start ffmpeg: %s", strerror(failed));
}

/* Keep the beginning of what ffmpeg says, on one line; 0 once it says no more. */
static int hear(fst_ffmpeg *film)
{
    char piece[512];
    const ssize_t got = read(film->words, piece, sizeof piece);
    for (ssize_t i = 0; i < got && film->said_size + 1 < sizeof film->said; ++i)
        film->said[film->said_size++] = (unsigned char)piece[i] < ' ' ? ' ' : piece[i];
    film->said[film->said_size] = '\0';
    return got > 0 || (got < 0 && errno == EINTR);
}

fst_status fst_ffmpeg_frame(fst_ffmpeg *film, const unsigned char *bytes, size_t size, fst_error *error)
{
    /* Read what ffmpeg says while it works: if nobody does, its pipe fills up and it waits for ever. */
    struct pollfd ends[2] = {{.fd = film->frames, .events = POLLOUT}, {.fd = film->words, .events = POLLIN}};
    while (size > 0) {
        if (poll(ends, 2, -1) < 0 && errno != EINTR)
            return fst_fail(error, FST_IO, film->name, "cannot wait for ffmpeg: %s", strerror(errno));
        if (ends[1].revents && !hear(film))
            ends[1].fd = -1;
        const ssize_t sent = ends[0].revents ? send(film->frames, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT) : 0;
        if (sent < 0 && errno != EINTR && errno != EAGAIN)
            return fst_fail(error, FST_IO, film->name, "ffmpeg takes no more frames: %s", strerror(errno));
        if (sent > 0) {
            bytes += sent;
            size -= (size_t)sent;
        }
    }
    return FST_OK;
}

fst_status fst_ffmpeg_end(fst_ffmpeg *film, int abandon, fst_error *error)
{
    const char *words = film->said;
    if (abandon)
        (void)kill(film->child, SIGKILL);
    (void)close(film->frames);
    while (hear(film))
        continue;
    (void)close(film->words);
    int outcome = 0;
    pid_t done;
    do
        done = waitpid(film->child, &outcome, 0);
    while (done < 0 && errno == EINTR);
    if (abandon)
        return FST_OK;
    /* ffmpeg is told to report errors only, so any word is an error.  Its status does not tell: it is 0 even on
     * a full disk. */
    if (done == film->child && WIFEXITED(outcome) && WEXITSTATUS(outcome) == 0 && !words[0])
        return FST_OK;
    if (done == film->child && WIFSIGNALED(outcome))
        return fst_fail(error, FST_IO, film->name, "ffmpeg was ended by the signal %d (%s) %s",
                        WTERMSIG(outcome), strsignal(WTERMSIG(outcome)), words);
    return fst_fail(error, FST_IO, film->name, "ffmpeg failed: %s", words[0] ? words : "it said nothing");
}
