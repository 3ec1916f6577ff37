/* source.c - what a film or a folder of images is: frames and their times, by ffprobe. */
#define _GNU_SOURCE /* strverscmp */

#include "follow/source.h"

#include <dirent.h>
#include <fcntl.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/grow.h"
#include "base/order.h"
#include "base/watch.h"
#include "host/process.h"
#include "host/regular_file.h"

enum { MOST_FRAMES = 20000000, LINE_SIZE = 256, MOST_IMAGES = 1000000 };

/* How often a second a phone with Android took a picture.  Slow motion is stored slower than that, and its clock with
 * it.  Apple's phones store what they took with the true clock, and slow it down when it is shown. */
#define CAPTURE_TAG "com.android.capture.fps"
#define SLOW_MOTION 1.5 /* rates that differ less are those of an uneven clock */

/* ------------------------------------------------------------------ asking ffprobe */

/* What the lines of ffprobe's answer tell. */
typedef struct answer {
    follow_source *source;
    double expected; /* frames, as the head of the film says; 0: unknown */
    double unit;     /* s of a tick of its clock */
    double seconds, rate;
    double taken; /* frames a second, as the phone says; 0: it does not */
    int streams, without_time;
    int64_t *ticks;
} answer;

static double ratio(const char *text)
{
    char *end;
    const double over = strtod(text, &end);
    return *end == '/' ? over / strtod(end + 1, NULL) : over;
}

static void copy_word(char *to, size_t size, const char *text)
{
    (void)snprintf(to, size, "%s", text);
    fst_text_tame(to);
}

static fst_status take_tick(answer *a, const char *text, fst_error *error)
{
    char *end;
    const long long tick = strtoll(text, &end, 10);
    follow_source *s = a->source;
    if (s->frames == MOST_FRAMES)
        return fst_fail(error, FST_BAD_INPUT, s->path, "it has more than %d frames", MOST_FRAMES);
    if (!fst_grow(&a->ticks, (size_t)s->frames, sizeof *a->ticks))
        return fst_fail(error, FST_NO_MEMORY, s->path, "no memory for its times");
    if (end == text || *end)
        ++a->without_time;
    a->ticks[s->frames++] = tick;
    return FST_OK;
}

static fst_status take_line(answer *a, const char *line, fst_error *error)
{
    const char *value = strchr(line, '=');
    if (!value++)
        return FST_OK;
    if (strncmp(line, "best_effort_timestamp=", 22) == 0)
        return take_tick(a, value, error);
    if (strncmp(line, "codec_name=", 11) == 0) {
        ++a->streams;
        copy_word(a->source->codec, sizeof a->source->codec, value);
    } else if (strncmp(line, "time_base=", 10) == 0) {
        a->unit = ratio(value);
    } else if (strncmp(line, "nb_frames=", 10) == 0) {
        a->expected = strtod(value, NULL);
    } else if (strncmp(line, "avg_frame_rate=", 15) == 0) {
        a->rate = ratio(value);
    } else if (strncmp(line, "duration=", 9) == 0) {
        a->seconds = strtod(value, NULL);
    } else if (strncmp(line, "TAG:" CAPTURE_TAG "=", sizeof "TAG:" CAPTURE_TAG) == 0) {
        a->taken = strtod(value, NULL);
    } else if (strncmp(line, "format_name=", 12) == 0) {
        copy_word(a->source->format, sizeof a->source->format, value);
    }
    return FST_OK;
}

/* ffprobe's own words help unless they speak of the list of formats that it was given. */
static fst_status no_film(const char *path, const char *said, fst_error *error)
{
    const int listed = strstr(said, "whitelist") != NULL || !said[0];
    if (strncmp(said, FOLLOW_FILM_URL ": ", sizeof FOLLOW_FILM_URL + 1) == 0)
        said += sizeof FOLLOW_FILM_URL + 1; /* it is the path, which stands before the sentence */
    return fst_fail(
        error, FST_BAD_INPUT, path,
        "this is not a film that can be read here (mp4, mov, webm, gif, avi, mpeg), nor a folder of "
        "images%s%.200s",
        listed ? "" : ": ", listed ? "" : said);
}

/* Ask ffprobe for `entries`, and take its answer line by line. */
static fst_status ask(answer *a, const char *entries, const fst_progress *progress, fst_error *error)
{
    const char *const arguments[] = {"ffprobe",
                                     "-hide_banner",
                                     "-loglevel",
                                     "error",
                                     "-protocol_whitelist",
                                     FOLLOW_PROTOCOLS,
                                     "-format_whitelist",
                                     FOLLOW_FORMATS,
                                     "-select_streams",
                                     "v:0",
                                     "-show_entries",
                                     entries,
                                     "-of",
                                     "default=nw=1",
                                     "-i",
                                     FOLLOW_FILM_URL,
                                     NULL};
    const fst_program program = {.arguments = arguments,
                                 .input = a->source->descriptor,
                                 .is_read = 1,
                                 .purpose = "films are read by ffprobe",
                                 .package = "ffmpeg"};
    fst_process child = {.progress = progress};
    char line[LINE_SIZE], piece[8192];
    size_t length = 0, got = 1;
    fst_status status = fst_process_start(&child, &program, "track", error);
    if (status != FST_OK)
        return status;
    while (status == FST_OK && got > 0) {
        status = fst_process_read(&child, piece, sizeof piece, &got, error);
        for (size_t i = 0; i < got && status == FST_OK; ++i) {
            if (piece[i] != '\n') {
                if (length + 1 < sizeof line)
                    line[length++] = piece[i];
                continue;
            }
            line[length] = '\0';
            length = 0;
            status = take_line(a, line, error);
        }
        child.fraction = a->expected > 0.0 ? fmin(1.0, a->source->frames / a->expected) : 0.0;
        if (status == FST_OK)
            status = fst_tell(progress, child.fraction, NULL, error);
    }
    const int well = fst_process_end(&child, status != FST_OK, NULL) == FST_OK;
    if (status == FST_OK && !well && a->source->frames == 0 && a->streams == 0)
        return no_film(a->source->path, child.said, error);
    return status;
}

/* ------------------------------------------------------------------ times */

static fst_status make_times(follow_source *s, const answer *a, double fps, fst_error *error)
{
    s->times = malloc((size_t)(s->frames ? s->frames : 1) * sizeof *s->times);
    if (!s->times)
        return fst_fail(error, FST_NO_MEMORY, s->path, "no memory for its times");
    if (isnan(fps) && (!a || a->without_time || !(a->unit > 0.0)))
        return fst_fail(error, FST_BAD_INPUT, s->path,
                        "%s no clock: say how many frames a second were taken (fps)",
                        a ? "this film has" : "images have");
    for (int i = 0; i < s->frames; ++i) {
        s->times[i] = isnan(fps) ? (double)a->ticks[i] * a->unit : i / fps;
        if (i > 0 && !(s->times[i] > s->times[i - 1]))
            return fst_fail(error, FST_BAD_INPUT, s->path,
                            "its clock goes wrong: frame %d is not later than frame %d; give the frames a "
                            "second (fps) instead",
                            i, i - 1);
    }
    return FST_OK;
}

/* The time from a frame to the next one, where none is missing: by the mean, because a coarse clock rounds. */
static fst_status usual_step(const follow_source *s, double *step, fst_error *error)
{
    const int count = s->frames - 1;
    double *room = malloc((size_t)count * sizeof *room), steps = 0.0;
    if (!room)
        return fst_fail(error, FST_NO_MEMORY, s->path, "no memory for its times");
    for (int i = 0; i < count; ++i)
        room[i] = s->times[i + 1] - s->times[i];
    const double usual = fst_median(room, (size_t)count);
    for (int i = 0; i < count; ++i)
        steps += fmax(1.0, floor(room[i] / usual + 0.5));
    *step = (s->times[count] - s->times[0]) / steps;
    free(room);
    return FST_OK;
}

/* Slow motion, and time lapse: give each frame the time at which it was taken. */
static fst_status undo_slow_motion(follow_source *s, double taken, fst_error *error)
{
    double step = 0.0;
    if (!(taken > 0.0 && taken <= 1e6) || s->frames < 2)
        return FST_OK;
    const fst_status status = usual_step(s, &step, error);
    const double slower = taken * step;
    if (status != FST_OK || (slower < SLOW_MOTION && slower > 1.0 / SLOW_MOTION))
        return status;
    for (int i = 0; i < s->frames; ++i)
        s->times[i] /= slower;
    s->tick /= slower;
    s->taken_fps = taken;
    s->stored_fps = 1.0 / step;
    return FST_OK;
}

static fst_status open_film(follow_source *s, double fps, const fst_progress *progress, fst_error *error)
{
    answer a = {.source = s};
    fst_status status = fst_open_regular(s->path, &s->descriptor, error);
    if (status == FST_OK)
        status = ask(&a,
                     "stream=codec_name,time_base,nb_frames,avg_frame_rate:format=format_name,duration:"
                     "format_tags=" CAPTURE_TAG,
                     NULL, error);
    if (status == FST_OK && a.streams == 0)
        status = fst_fail(error, FST_BAD_INPUT, s->path, "there are no pictures in this file");
    s->tick = a.unit;
    s->announced = a.expected > 0.0 && a.expected < MOST_FRAMES ? (int)a.expected : 0;
    if (!(a.expected > 0.0))
        a.expected = a.rate * a.seconds > 0.0 ? a.rate * a.seconds : 0.0;
    if (status == FST_OK)
        status = ask(&a, "frame=best_effort_timestamp", progress, error);
    if (status == FST_OK && s->frames == 0)
        status = fst_fail(error, FST_BAD_INPUT, s->path, "none of its pictures can be decoded");
    if (status == FST_OK)
        status = make_times(s, &a, fps, error);
    if (status == FST_OK && isnan(fps))
        status = undo_slow_motion(s, a.taken, error);
    free(a.ticks);
    return status;
}

/* ------------------------------------------------------------------ images */

static int by_name(const void *a, const void *b)
{
    return strverscmp(*(char *const *)a, *(char *const *)b); /* frame-2 comes before frame-10 */
}

/* How ffmpeg reads images that begin with these bytes; NULL: they are not images that it can tell apart in a
 * pipe. */
static const char *demuxer_of(const unsigned char head[4], size_t size)
{
    if (size == 4 && memcmp(head, "\x89PNG", 4) == 0)
        return "png_pipe";
    if (size == 4 && memcmp(head, "\xff\xd8\xff", 3) == 0)
        return "jpeg_pipe";
    if (size == 4 && memcmp(head, "BM", 2) == 0)
        return "bmp_pipe";
    if (size == 4 && head[0] == 'P' && head[1] == '5')
        return "pgm_pipe";
    if (size == 4 && head[0] == 'P' && head[1] == '6')
        return "ppm_pipe";
    return NULL;
}

/* The kind of a file of the folder; NULL: no image. */
static const char *kind_of(int folder, const char *name)
{
    unsigned char head[4];
    struct stat about;
    if (fstatat(folder, name, &about, 0) != 0 || !S_ISREG(about.st_mode))
        return NULL;
    const int file = openat(folder, name, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return NULL;
    const ssize_t got = fst_read_at(file, head, sizeof head, 0);
    (void)close(file);
    return got < 0 ? NULL : demuxer_of(head, (size_t)got);
}

static fst_status add_image(follow_source *s, int folder, const char *name, fst_error *error)
{
    const char *kind = kind_of(folder, name);
    if (!kind) {
        ++s->skipped;
        return FST_OK;
    }
    if (s->demuxer && strcmp(s->demuxer, kind) != 0)
        return fst_fail(error, FST_BAD_INPUT, s->path,
                        "its images are of more than one kind (%.4s and %.4s): leave those of one film there",
                        s->demuxer, kind);
    s->demuxer = kind;
    if (s->image_count == MOST_IMAGES)
        return fst_fail(error, FST_BAD_INPUT, s->path, "it has more than %d images", MOST_IMAGES);
    if (!fst_grow(&s->images, (size_t)s->image_count, sizeof *s->images))
        return fst_fail(error, FST_NO_MEMORY, s->path, "no memory for the names of its images");
    s->images[s->image_count] = strdup(name);
    return s->images[s->image_count++] ? FST_OK
                                       : fst_fail(error, FST_NO_MEMORY, s->path, "no memory for a name");
}

static fst_status open_folder(follow_source *s, double fps, fst_error *error)
{
    DIR *folder = opendir(s->path);
    fst_status status = FST_OK;
    if (!folder)
        return fst_fail(error, FST_BAD_INPUT, s->path, "this folder cannot be read: %s", strerror(errno));
    for (struct dirent *entry; status == FST_OK && (entry = readdir(folder)) != NULL;)
        if (entry->d_name[0] != '.')
            status = add_image(s, dirfd(folder), entry->d_name, error);
    (void)closedir(folder);
    if (status == FST_OK && s->image_count == 0)
        status = fst_fail(error, FST_BAD_INPUT, s->path,
                          "there are no images in this folder (PNG, JPEG, BMP, PGM, PPM)");
    if (status != FST_OK)
        return status;
    qsort(s->images, (size_t)s->image_count, sizeof *s->images, by_name);
    s->frames = s->image_count;
    (void)snprintf(s->format, sizeof s->format, "images");
    (void)snprintf(s->codec, sizeof s->codec, "%.3s", s->demuxer);
    return make_times(s, NULL, fps, error);
}

fst_status follow_source_open(follow_source *source, const char *path, double fps, const fst_progress *progress,
                              fst_error *error)
{
    struct stat about;
    *source = (follow_source){.path = path, .descriptor = -1};
    if (!isnan(fps) && !(fps > 0.0 && fps <= 1e6))
        return fst_fail(error, FST_BAD_INPUT, "fst_film_track_options.fps",
                        "%g frames a second: more than 0, at most 1e6", fps);
    if (stat(path, &about) == 0 && S_ISDIR(about.st_mode))
        return open_folder(source, fps, error);
    return open_film(source, fps, progress, error);
}

void follow_source_close(follow_source *source)
{
    for (int i = 0; i < source->image_count; ++i)
        free(source->images[i]);
    free(source->images);
    free(source->times);
    if (source->descriptor >= 0)
        (void)close(source->descriptor);
    *source = (follow_source){.descriptor = -1};
}
