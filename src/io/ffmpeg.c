/* ffmpeg.c - the command line of an ffmpeg that makes a film, and how it is known whether it failed. */
#include "io/ffmpeg.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"

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

fst_status fst_ffmpeg_start(fst_process *film, const fst_ffmpeg_kind *kind, const char *out, const char *name,
                            fst_error *error)
{
    spelled spelt;
    const char *arguments[MOST_ARGUMENTS];
    if (!spell(kind, out, &spelt))
        return fst_fail(error, FST_BAD_INPUT, name, "the file name is too long");
    list_arguments(kind, &spelt, arguments);
    const fst_program program = {
        .arguments = arguments, .input = FST_INPUT_FED, .purpose = "films need ffmpeg", .package = "ffmpeg"};
    *film = (fst_process){.pid = 0};
    return fst_process_start(film, &program, name, error);
}

fst_status fst_ffmpeg_end(fst_process *film, int abandon, fst_error *error)
{
    const fst_status status = fst_process_end(film, abandon, error);
    /* ffmpeg is told to report errors only, so any word is an error.  Its status does not tell: it is 0 even on
     * a full disk. */
    return status == FST_OK && !abandon && film->said[0]
               ? fst_fail(error, FST_IO, film->where, "ffmpeg failed: %s", film->said)
               : status;
}
