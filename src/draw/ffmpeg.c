#define _GNU_SOURCE /* pipe2, strsignal */

#include "draw/ffmpeg.h"

#include "base/error.h"
#include "draw/process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

enum { WORDS_SIZE = 512, MOST_ARGUMENTS = 40 };

fst_status fst_ffmpeg_start(fst_ffmpeg *film, int width, int height, double fps, const char *format,
                            const char *out, fst_error *error)
{
    /* posix_spawn wants writable words, and touches none of them. */
    char size[32], rate[32], file[4096], kind[8];
    (void)snprintf(size, sizeof size, "%dx%d", width, height);
    (void)snprintf(rate, sizeof rate, "%.6g", fps);
    (void)snprintf(kind, sizeof kind, "%s", format);
    if (snprintf(file, sizeof file, "file:%s", out) >= (int)sizeof file)
        return fst_fail(error, FST_BAD_INPUT, out, "the file name is too long");
    static const char *const mp4[] = {"-c:v",     "libx264", "-preset",   "veryfast",   "-crf", "20",
                                      "-pix_fmt", "yuv420p", "-movflags", "+faststart", NULL};
    static const char *const gif[] = {
        "-vf", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none", "-loop", "0", NULL};
    const char *arguments[MOST_ARGUMENTS] = {
        "ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y", "-f",     "rawvideo", "-pix_fmt",
        "bgr0",   "-s",       size,           "-r",        rate,    "-i", "pipe:0", "-threads", "2"};
    int count = 18;
    for (const char *const *word = strcmp(format, "gif") ? mp4 : gif; *word; word++)
        arguments[count++] = *word;
    arguments[count++] = "-f";
    arguments[count++] = kind;
    arguments[count] = file;
    int input[2], words[2];
    /* A socket, because send() can be told to raise no SIGPIPE when ffmpeg dies. */
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input) != 0)
        return fst_fail(error, FST_IO, out, "no socket to ffmpeg: %s", strerror(errno));
    if (pipe2(words, O_CLOEXEC) != 0) {
        (void)close(input[0]);
        (void)close(input[1]);
        return fst_fail(error, FST_IO, out, "no pipe from ffmpeg: %s", strerror(errno));
    }
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
        return fst_fail(error, FST_UNAVAILABLE, out,
                        "films need ffmpeg, which is not installed: install the package ffmpeg");
    return fst_fail(error, FST_IO, out, "cannot start ffmpeg: %s", strerror(failed));
}

fst_status fst_ffmpeg_frame(fst_ffmpeg *film, const unsigned char *bytes, size_t size, fst_error *error)
{
    while (size > 0) {
        ssize_t sent = send(film->frames, bytes, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent <= 0)
            return fst_fail(error, FST_IO, "ffmpeg", "it takes no more frames: %s", strerror(errno));
        bytes += sent;
        size -= (size_t)sent;
    }
    return FST_OK;
}

/* Its last words on one line. */
static void listen_to(int input, char *words, size_t size)
{
    size_t kept = 0;
    for (;;) {
        char piece[512];
        ssize_t got = read(input, piece, sizeof piece);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        for (ssize_t i = 0; i < got && kept + 1 < size; i++)
            words[kept++] = (unsigned char)piece[i] < ' ' ? ' ' : piece[i];
    }
    words[kept] = '\0';
}

fst_status fst_ffmpeg_end(fst_ffmpeg *film, int abandon, fst_error *error)
{
    char words[WORDS_SIZE];
    if (abandon)
        (void)kill(film->child, SIGKILL);
    (void)close(film->frames);
    listen_to(film->words, words, sizeof words);
    (void)close(film->words);
    int outcome = 0;
    pid_t done;
    do
        done = waitpid(film->child, &outcome, 0);
    while (done < 0 && errno == EINTR);
    if (abandon)
        return FST_OK;
    /* Told to speak of errors only, it is silent when all is well; its status is 0 even on a full disk. */
    if (done == film->child && WIFEXITED(outcome) && WEXITSTATUS(outcome) == 0 && !words[0])
        return FST_OK;
    if (done == film->child && WIFSIGNALED(outcome))
        return fst_fail(error, FST_IO, "ffmpeg", "it was ended by the signal %d (%s) %s", WTERMSIG(outcome),
                        strsignal(WTERMSIG(outcome)), words);
    return fst_fail(error, FST_IO, "ffmpeg", "it failed: %s", words[0] ? words : "it said nothing");
}
