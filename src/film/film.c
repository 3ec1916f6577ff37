/* film.c - fst_film(): a trajectory as a film, frame by frame.
 *
 *  samples --> cast.c ----> frame.h --> cairo_module.c --> ffmpeg --> film_file.c --> OUT.mp4, OUT.gif
 *  (a table    where all    what is     pixels               |        is it      renamed into
 *   or list)   is at t      drawn                            |        whole?     its place
 *                                                            `--> or OUT/frame-00001.png, ...
 *
 * Frame i shows the moment i/(fps seconds_per_turn) turns of the drive after the first one.  Frames are painted
 * in order and given away at once, so memory does not grow with the film.  If ffmpeg is missing, the frames are
 * kept in a folder beside the place of the film, and the error names that folder.
 */
#include "base/constants.h"
#include "base/error.h"
#include "base/number.h"
#include "base/watch.h"
#include "io/ffmpeg.h"
#include "io/film_file.h"
#include "film/layout.h"
#include "host/module.h"
#include "host/whole_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    OPTIONS_COOKIE = 0x46494c4d,
    USUAL_SIZE = 720,
    LEAST_SIZE = 160,
    GREATEST_SIZE = 4096,
    MOST_FRAMES = 1000000,
    FRAME_PATH = 4160,
    QUALITY = 20 /* of x264 */
};

fst_film_options fst_default_film_options(void)
{
    return (fst_film_options){.cookie = OPTIONS_COOKIE,
                              .width = USUAL_SIZE,
                              .height = USUAL_SIZE,
                              .fps = 30.0,
                              .from = NAN,
                              .to = NAN,
                              .seconds_per_turn = 1.0};
}

/* A film being made. */
typedef struct film {
    const fst_film_options *options;
    const fst_film_module_table *module;
    fst_film_canvas *canvas;
    fst_film_look look;
    fst_film_cast cast;
    fst_process process;
    char folder[4096]; /* the folder for the frames; "": they go to ffmpeg */
    double *trail;     /* of each bead: the x of all its points, then their y or heights, then their shades */
    size_t trail_room; /* points of a trail */
    int frames;
} film;

static fst_status load_module(const fst_film_module_table **module, fst_error *error)
{
    int found;
    *module = fst_module_table(FST_CAIRO_MODULE, FST_FILM_MODULE_SYMBOL, &found);
    if (!*module)
        return fst_fail(
            error, FST_UNAVAILABLE, "film",
            "this festoon cannot paint films (%s cannot be loaded): install libcairo2-dev and build "
            "festoon again",
            FST_CAIRO_MODULE);
    if (strcmp((*module)->version, fst_version()) != 0)
        return fst_fail(error, FST_UNAVAILABLE, "film",
                        "%s belongs to festoon %s, not to %s: install festoon again", FST_CAIRO_MODULE,
                        (*module)->version, fst_version());
    return FST_OK;
}

static fst_status check(const fst_film_options *options, fst_error *error)
{
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_film",
                        "the options were not made by fst_default_film_options()");
    if (options->width < LEAST_SIZE || options->height < LEAST_SIZE || options->width > GREATEST_SIZE ||
        options->height > GREATEST_SIZE || options->width % 2 || options->height % 2)
        return fst_fail(error, FST_BAD_INPUT, "fst_film_options.width",
                        "a size of %d x %d: width and height are even numbers from %d to %d", options->width,
                        options->height, LEAST_SIZE, GREATEST_SIZE);
    if (!(options->fps >= 1.0 && options->fps <= 120.0))
        return fst_fail(error, FST_BAD_INPUT, "fst_film_options.fps", "%g frames a second: take 1 to 120",
                        options->fps);
    if (!(options->seconds_per_turn > 0.0 && options->seconds_per_turn <= 60.0))
        return fst_fail(error, FST_BAD_INPUT, "fst_film_options.seconds_per_turn",
                        "%g s for a turn of the magnet: take more than 0, at most 60",
                        options->seconds_per_turn);
    return FST_OK;
}

/* ------------------------------------------------------------------ frames */

/* The trail of a bead: the samples up to now, at most as far back as two turns about the axis, which the beads of a list
 * share out, so that the picture stays clear. */
static void set_trail(const film *f, int bead)
{
    const fst_film_motion *m = &f->cast.motions[bead];
    fst_film_bead *at = &f->cast.beads[bead];
    const int from_front = f->look.layout.view == FST_FILM_FRONT;
    const double longest = fmax(12.57 / f->cast.count, 1.0);
    size_t from = m->row;
    while (from > m->first && fabs(m->alpha[m->row] - m->alpha[from - 1]) < longest)
        --from;
    /* Skip samples closer than a pixel or so.  The skipped ones are the same in every frame, so the trail does
     * not flicker. */
    double least = 1.5 * 2.0 * f->look.layout.reach / f->look.layout.height;
    double *x = f->trail + 3 * f->trail_room * (size_t)bead, *y = x + f->trail_room, *shade = y + f->trail_room;
    int count = 0;
    for (size_t row = from; row <= m->row; ++row) {
        x[count] = m->millimetres * m->x[row];
        y[count] = from_front ? m->radius + m->millimetres * m->z[row] : m->millimetres * m->y[row];
        if (count > 0 && hypot(x[count] - x[count - 1], y[count] - y[count - 1]) < least)
            continue;
        shade[count++] = m->colour ? (m->colour[row] - m->low) / (m->high - m->low) : 0.0;
    }
    x[count] = at->place[0];
    y[count] = at->place[from_front ? 2 : 1];
    shade[count] = shade[count - 1]; /* the first row is never skipped */
    at->trail_x = x;
    at->trail_y = y;
    at->trail_shade = shade;
    at->trail = count + 1;
}

/* The middle of the beads, if the picture follows them. */
static void set_centre(const film *f, fst_film_frame *frame)
{
    for (int bead = 0; bead < frame->count && f->look.layout.follows; ++bead)
        for (int k = 0; k < 2; ++k)
            frame->centre[k] += frame->beads[bead].place[k] / frame->count;
}

static void name_frame(const film *f, int index, char path[FRAME_PATH])
{
    (void)snprintf(path, FRAME_PATH, "%s/frame-%05d.png", f->folder, index + 1);
}

static fst_status give_frame(film *f, int index, fst_error *error)
{
    if (f->folder[0]) {
        char path[FRAME_PATH];
        fst_whole_file file;
        name_frame(f, index, path);
        fst_status written = fst_whole_file_open_next(&file, path, error);
        if (written != FST_OK)
            return written;
        written = f->module->write_png(f->canvas, file.stream, error);
        if (written == FST_OK)
            return fst_whole_file_commit(&file, error);
        fst_whole_file_discard(&file);
        return written;
    }
    int stride;
    const unsigned char *pixels = f->module->pixels(f->canvas, &stride);
    fst_status status = FST_OK;
    size_t row = 4 * (size_t)f->look.layout.width;
    if ((size_t)stride == row)
        return fst_process_write(&f->process, pixels, row * (size_t)f->look.layout.height, error);
    for (int y = 0; y < f->look.layout.height && status == FST_OK; ++y)
        status = fst_process_write(&f->process, pixels + (size_t)y * (size_t)stride, row, error);
    return status;
}

static fst_status make_frames(film *f, fst_error *error)
{
    const fst_film_motion *m = &f->cast.motions[0];
    const fst_film_options *o = f->options;
    double begin = m->clock[m->first], periods = m->clock[m->last] - begin;
    const double count = 1.0 + floor(periods * o->seconds_per_turn * o->fps + 1e-9);
    if (!(count <= MOST_FRAMES))
        return fst_fail(error, FST_BAD_INPUT, "film",
                        "%.6g frames are too many: at most %d; take a shorter part", count, MOST_FRAMES);
    f->frames = (int)count;
    for (int i = 0; i < f->frames; ++i) {
        fst_film_frame frame = {.clock = NULL};
        char clock[64];
        double now = begin + i / (o->fps * o->seconds_per_turn);
        fst_film_cast_to(&f->cast, now, &frame);
        for (int bead = 0; bead < f->cast.count; ++bead)
            set_trail(f, bead);
        set_centre(f, &frame);
        double t = fst_film_motion_at(m, m->t);
        (void)snprintf(clock, sizeof clock, "t = %.4f s, turn %.2f", t / f->cast.params.friction_gamma, now);
        frame.clock = clock;
        fst_status status = f->module->paint(f->canvas, &f->look.layout, &frame, error);
        if (status == FST_OK)
            status = give_frame(f, i, error);
        if (status == FST_OK)
            status = fst_tell(o->progress, (i + 1.0) / f->frames, "frames", error);
        if (status != FST_OK)
            return status;
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ where they go */

/* Remove the further frames of an earlier, longer film: they would be shown after this one's. */
static fst_status remove_further_frames(const film *f, fst_error *error)
{
    char path[FRAME_PATH];
    for (int index = f->frames;; ++index) {
        name_frame(f, index, path);
        if (unlink(path) == 0)
            continue;
        return errno == ENOENT ? FST_OK
                               : fst_fail(error, FST_IO, path,
                                          "cannot remove this frame of an earlier film: %s", strerror(errno));
    }
}

static fst_status frames_into_folder(film *f, const char *folder, fst_error *error)
{
    struct stat there;
    if (snprintf(f->folder, sizeof f->folder, "%s", folder) >= (int)sizeof f->folder)
        return fst_fail(error, FST_BAD_INPUT, folder, "the name is too long");
    if (mkdir(folder, 0777) != 0 && !(errno == EEXIST && stat(folder, &there) == 0 && S_ISDIR(there.st_mode)))
        return fst_fail(error, errno == EEXIST ? FST_BAD_INPUT : FST_IO, folder,
                        "cannot make this folder for the frames: %s", strerror(errno));
    fst_whole_file_tidy(folder, ".frame-");
    fst_status status = make_frames(f, error);
    return status == FST_OK ? remove_further_frames(f, error) : status;
}

static fst_status frames_into_process(film *f, const char *out, const char *format, fst_error *error)
{
    fst_whole_file file;
    fst_status status = fst_whole_file_open(&file, out, error);
    if (status != FST_OK)
        return status;
    const fst_ffmpeg_kind kind = {.width = f->look.layout.width,
                                  .height = f->look.layout.height,
                                  .fps = f->options->fps,
                                  .format = format,
                                  .pixels = "bgr0",
                                  .quality = QUALITY};
    status = fst_ffmpeg_start(&f->process, &kind, file.temporary, out, error);
    if (status == FST_OK) {
        status = make_frames(f, error);
        /* Where ffmpeg failed, its own words say more than that it took no more frames. */
        fst_status ended = fst_ffmpeg_end(&f->process, status != FST_OK && status != FST_IO, error);
        if (status == FST_OK)
            status = ended;
        if (status == FST_OK)
            status = fst_film_file_check(file.temporary, format, f->frames, out, error);
    }
    if (status == FST_OK)
        return fst_whole_file_commit(&file, error);
    fst_whole_file_discard(&file);
    return status;
}

static const char *format_of(const char *out)
{
    size_t length = strlen(out);
    const char *ending = length > 4 ? out + length - 4 : "";
    return !strcmp(ending, ".mp4") ? "mp4" : !strcmp(ending, ".gif") ? "gif" : NULL;
}

static fst_status produce(film *f, const char *out, fst_error *error)
{
    const char *format = format_of(out);
    if (!format)
        return frames_into_folder(f, out, error);
    const fst_status status = frames_into_process(f, out, format, error);
    return status == FST_UNAVAILABLE
               ? fst_fail(
                     error, FST_UNAVAILABLE, out,
                     "films need ffmpeg, which is not installed: install the package ffmpeg, or name a folder, "
                     "which gets the frames as pictures")
               : status;
}

/* Make the film of a trajectory of one bead or, where `list` is given, of a list. */
static fst_status make(const fst_table *table, const fst_beads_table *list, const char *out,
                       const fst_film_options *options, fst_error *error)
{
    fst_film_options defaults = fst_default_film_options();
    film f = {.options = options ? options : &defaults};
    const char *name = strrchr(out, '/') ? strrchr(out, '/') + 1 : out;
    fst_status status = check(f.options, error);
    if (status == FST_OK && strrchr(name, '.') && !format_of(out))
        return fst_fail(
            error, FST_BAD_INPUT, out,
            "a film's name ends in .mp4 or .gif; a name without an ending is a folder of PNG frames");
    fst_c_locale locale = fst_c_locale_enter();
    if (status == FST_OK)
        status = load_module(&f.module, error);
    if (status == FST_OK)
        status = list ? fst_film_cast_list(&f.cast, list, f.options, error)
                      : fst_film_cast_one(&f.cast, table, f.options, error);
    if (status == FST_OK) {
        fst_film_look_at(&f.look, &f.cast, f.options);
        f.trail_room = f.cast.motions[0].last - f.cast.motions[0].first + 3;
        f.trail = malloc((size_t)f.cast.count * 3 * f.trail_room * sizeof *f.trail);
        status = f.trail ? f.module->open(&f.look.layout, &f.canvas, error)
                         : fst_fail(error, FST_NO_MEMORY, "film", "no memory for the trail");
    }
    if (status == FST_OK)
        status = produce(&f, out, error);
    if (f.canvas)
        f.module->close(f.canvas);
    free(f.trail);
    fst_film_cast_free(&f.cast);
    fst_c_locale_leave(locale);
    return status;
}

fst_status fst_film(const fst_table *table, const char *out, const fst_film_options *options, fst_error *error)
{
    return make(table, NULL, out, options, error);
}

fst_status fst_film_beads(const fst_beads_table *table, const char *out, const fst_film_options *options,
                          fst_error *error)
{
    return make(NULL, table, out, options, error);
}
