/* film.c - fst_film(): a trajectory as a film, frame by frame.
 *
 *  samples --> motion.c --> frame.h --> cairo_module.c --> ffmpeg --> film_file.c --> OUT.mp4, OUT.gif
 *  (a table)   where all    what is     pixels               |        is it      renamed into
 *              is at t      drawn                            |        whole?     its place
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
#include "draw/bar.h"
#include "io/ffmpeg.h"
#include "io/film_file.h"
#include "film/motion.h"
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
    fst_film_layout layout;
    fst_film_motion motion;
    fst_process process;
    char folder[4096]; /* the folder for the frames; "": they go to ffmpeg */
    double *trail;     /* the x of all its points, then their y, then their shades */
    size_t trail_room;
    char title[192], label[128];
    char slower[48]; /* "10.7 times slower" than the motion */
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

/* ------------------------------------------------------------------ the layout */

/* The magnet: what is shown of the plate holds all of it. */
static void add_bodies(fst_film_layout *layout, const fst_params *p)
{
    layout->body_count = fst_magnet_bodies(p, 1e3, FST_BAR_OVER_LINES, layout->bodies);
    layout->high = 0.5 * FST_BAR_THICKNESS;
    layout->low = -layout->high;
    for (int i = 0; i < layout->body_count; ++i) {
        const fst_part_shape *seen = &layout->bodies[i].seen;
        layout->high = i ? fmax(layout->high, seen->high) : seen->high;
        layout->low = i ? fmin(layout->low, seen->low) : seen->low;
        for (int k = 0; k < seen->count; ++k)
            layout->reach = fmax(layout->reach, 1.05 * hypot(seen->corners[k][0], seen->corners[k][1]));
    }
}

static void set_layout(film *f, const fst_table *table)
{
    fst_params settled = table->params;
    (void)fst_params_settle(&settled, NULL); /* the caller may have changed them */
    const fst_params *p = &settled;
    const fst_film_motion *m = &f->motion;
    double reach = 0.0, omega = fst_collected(table, "omega")[m->first];
    for (size_t row = m->first; row <= m->last; ++row)
        reach = fmax(reach, fmax(fabs(m->x[row]), fabs(m->y[row])));
    double hertz = omega * p->friction_gamma / FST_TWO_PI;
    (void)snprintf(f->title, sizeof f->title, "%.3g Hz (ω = %.4g), %s", hertz, omega,
                   fst_dynamics_name((fst_dynamics)p->model_dynamics));
    (void)snprintf(f->slower, sizeof f->slower, "%.3g times slower", hertz * f->options->seconds_per_turn);
    fst_shown_units units = f->options->units;
    if (units == FST_SHOWN_AS_GIVEN)
        units = isfinite(p->drive_omega) ? FST_SHOWN_SCALED : FST_SHOWN_LAB;
    const fst_quantity colour = fst_quantity_of_column(m->colour_info, units, p);
    (void)snprintf(f->label, sizeof f->label, "%s", colour.label);
    f->layout = (fst_film_layout){
        .width = f->options->width,
        .height = f->options->height,
        .reach = fmax(1.25 * reach, 1.35) * m->millimetres,
        .depth = 1e3 * p->magnet_depth,
        .radius = 1e3 * p->bead_radius,
        .title = f->title,
        .slower = f->slower,
        .colour_label = f->label,
        .colour_low = colour.factor * m->low,
        .colour_high = colour.factor * m->high,
        .both_signs = m->both_signs,
    };
    add_bodies(&f->layout, p);
}

/* ------------------------------------------------------------------ frames */

/* The trail: the samples up to now, at most as far back as two turns of the bead about the axis. */
static void set_trail(film *f, fst_film_frame *frame)
{
    const fst_film_motion *m = &f->motion;
    const double *alpha = fst_collected(m->table, "alpha");
    size_t from = m->row;
    while (from > m->first && fabs(alpha[m->row] - alpha[from - 1]) < 12.57)
        --from;
    /* Skip samples closer than a pixel or so.  The skipped ones are the same in every frame, so the trail does
     * not flicker. */
    double least = 1.5 * 2.0 * f->layout.reach / f->layout.height;
    double *x = f->trail, *y = x + f->trail_room, *shade = y + f->trail_room;
    int count = 0;
    for (size_t row = from; row <= m->row; ++row) {
        x[count] = m->millimetres * m->x[row];
        y[count] = m->millimetres * m->y[row];
        if (count > 0 && hypot(x[count] - x[count - 1], y[count] - y[count - 1]) < least)
            continue;
        shade[count++] = (m->colour[row] - m->low) / (m->high - m->low);
    }
    x[count] = frame->x;
    y[count] = frame->y;
    shade[count] = shade[count - 1]; /* the first row is never skipped */
    frame->trail_x = x;
    frame->trail_y = y;
    frame->trail_shade = shade;
    frame->trail = count + 1;
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
    size_t row = 4 * (size_t)f->layout.width;
    if ((size_t)stride == row)
        return fst_process_write(&f->process, pixels, row * (size_t)f->layout.height, error);
    for (int y = 0; y < f->layout.height && status == FST_OK; ++y)
        status = fst_process_write(&f->process, pixels + (size_t)y * (size_t)stride, row, error);
    return status;
}

static fst_status make_frames(film *f, fst_error *error)
{
    fst_film_motion *m = &f->motion;
    const fst_film_options *o = f->options;
    double begin = m->drive_turns[m->first], turns = m->drive_turns[m->last] - begin;
    const double count = 1.0 + floor(turns * o->seconds_per_turn * o->fps + 1e-9);
    if (!(count <= MOST_FRAMES))
        return fst_fail(error, FST_BAD_INPUT, "film",
                        "%.6g frames are too many: at most %d; take a shorter part", count, MOST_FRAMES);
    f->frames = (int)count;
    for (int i = 0; i < f->frames; ++i) {
        fst_film_frame frame = {.clock = NULL};
        char clock[64];
        double now = begin + i / (o->fps * o->seconds_per_turn);
        fst_film_motion_to(m, now);
        fst_film_motion_frame(m, &frame);
        set_trail(f, &frame);
        double t = m->t[m->row] + m->part * (m->t[m->row + 1] - m->t[m->row]);
        (void)snprintf(clock, sizeof clock, "t = %.4f s, turn %.2f", t / m->table->params.friction_gamma, now);
        frame.clock = clock;
        f->module->paint(f->canvas, &f->layout, &frame);
        fst_status status = give_frame(f, i, error);
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
    const fst_ffmpeg_kind kind = {.width = f->layout.width,
                                  .height = f->layout.height,
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

fst_status fst_film(const fst_table *table, const char *out, const fst_film_options *options, fst_error *error)
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
        status =
            fst_film_motion_begin(&f.motion, table, f.options->from, f.options->to, f.options->colour, error);
    if (status == FST_OK) {
        set_layout(&f, table);
        f.trail_room = f.motion.last - f.motion.first + 3;
        f.trail = malloc(3 * f.trail_room * sizeof *f.trail);
        status = f.trail ? f.module->open(&f.layout, &f.canvas, error)
                         : fst_fail(error, FST_NO_MEMORY, "film", "no memory for the trail");
    }
    if (status == FST_OK)
        status = produce(&f, out, error);
    if (f.canvas)
        f.module->close(f.canvas);
    free(f.trail);
    fst_c_locale_leave(locale);
    return status;
}
