/* camera.c - fst_camera_film(): a trajectory as a camera over the plate films it, with the truth beside.
 *
 *  trajectory --> camera_paint.c --> ffmpeg --> FILM.mp4, FILM.mov, FILM.gif   (or images
 * FOLDER/frame-00001.pgm)
 *             `-> where it was   ------------> truth.csv
 *
 * Frame k begins k/fps after the first moment that is filmed.  The truth has the same rows as the film has
 * frames; a frame that was lost is in neither.
 */
#include "base/constants.h"
#include "base/error.h"
#include "base/number.h"
#include "base/watch.h"
#include "film/camera_paint.h"
#include "film/cast.h"
#include "host/whole_file.h"
#include "io/ffmpeg.h"
#include "io/film_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    OPTIONS_COOKIE = 0x43414d52,
    LEAST_SIZE = 64,
    GREATEST_SIZE = 4096,
    MOST_FRAMES = 1000000,
    FRAME_PATH = 4160,
    USUAL_PLATE = 120 /* mm; 1.5 of it are 180 mm, from where a phone sees just the plate */
};

fst_camera_options fst_default_camera_options(void)
{
    return (fst_camera_options){.cookie = OPTIONS_COOKIE,
                                .width = 1280,
                                .height = 720,
                                .fps = 240.0,
                                .stored_fps = NAN,
                                .from = NAN,
                                .to = NAN,
                                .exposure = 1e-3,
                                .readout = 3e-3,
                                .noise = 2.0,
                                .uneven = 0.2,
                                .tilt = 5.0,
                                .side = -90.0,
                                .distance = NAN,
                                .plate = NAN,
                                .quality = 23,
                                .seed = 1};
}

/* A film being taken. */
typedef struct camera {
    const fst_camera_options *options;
    fst_camera_paint paint;
    fst_film_cast cast;
    fst_camera_motion *motions; /* of each bead */
    fst_film_marks *marks;      /* of each bead; NULL: they have none */
    fst_process process;
    char folder[4096]; /* the folder of images; "": the frames go to ffmpeg */
    unsigned char *pixels;
    fst_whole_file truth;
    double begin, distance; /* s; mm */
    int moments, frames;    /* moments at which a frame was taken, and how many of the frames were kept */
} camera;

/* ------------------------------------------------------------------ what is asked for */

/* One number of the options and the range that it may have. */
typedef struct bounds {
    const char *where;
    double value, least, most;
    const char *unit;
} bounds;

static fst_status check(const fst_camera_options *o, fst_error *error)
{
    const double stored = isnan(o->stored_fps) ? o->fps : o->stored_fps;
    const bounds rows[] = {
        {"fst_camera_options.fps", o->fps, 1.0, 10000.0, " frames a second"},
        {"fst_camera_options.stored_fps", stored, 1.0, 10000.0, " frames a second"},
        {"fst_camera_options.exposure", o->exposure, 0.0, 1.0, " s"},
        {"fst_camera_options.readout", o->readout, 0.0, 1.0, " s"},
        {"fst_camera_options.noise", o->noise, 0.0, 100.0, " gray levels"},
        {"fst_camera_options.uneven", o->uneven, 0.0, 0.9, ""},
        {"fst_camera_options.flicker", o->flicker, 0.0, 0.9, ""},
        {"fst_camera_options.tilt", o->tilt, 0.0, 60.0, " degrees"},
        {"fst_camera_options.side", o->side, -360.0, 360.0, " degrees"},
        {"fst_camera_options.quality", o->quality, 0.0, 51.0, ""},
    };
    if (o->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_camera_film",
                        "the options were not made by fst_default_camera_options()");
    if (o->width < LEAST_SIZE || o->height < LEAST_SIZE || o->width > GREATEST_SIZE ||
        o->height > GREATEST_SIZE || o->width % 2 || o->height % 2)
        return fst_fail(error, FST_BAD_INPUT, "fst_camera_options.width",
                        "a size of %d x %d: width and height are even numbers from %d to %d", o->width,
                        o->height, LEAST_SIZE, GREATEST_SIZE);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        if (!(rows[i].value >= rows[i].least && rows[i].value <= rows[i].most))
            return fst_fail(error, FST_BAD_INPUT, rows[i].where, "%g%s: take %g to %g", rows[i].value,
                            rows[i].unit, rows[i].least, rows[i].most);
    if (!(o->exposure * o->fps <= 1.0))
        return fst_fail(error, FST_BAD_INPUT, "fst_camera_options.exposure",
                        "%g s is longer than a frame lasts, which is %g s", o->exposure, 1.0 / o->fps);
    if (o->marks && !fst_film_marks_known(o->marks))
        return fst_fail(error, FST_BAD_INPUT, "fst_camera_options.marks",
                        "\"%.40s\" are not marks that a bead can have: half or dots", o->marks);
    if (!(o->drop == 0 || (o->drop >= 2 && o->drop <= MOST_FRAMES)))
        return fst_fail(error, FST_BAD_INPUT, "fst_camera_options.drop",
                        "%d: a whole number from 2, or 0 to lose no frame", o->drop);
    return FST_OK;
}

/* ------------------------------------------------------------------ the motion and the view */

static fst_camera_motion motion_of(const fst_film_motion *m)
{
    const fst_table *table = m->table;
    const double *heights = fst_collected(table, "z"), *climbs = fst_collected(table, "vz");
    return (fst_camera_motion){.t = m->t + m->first,
                               .x = m->x + m->first,
                               .y = m->y + m->first,
                               .z = heights && climbs ? heights + m->first : NULL,
                               .vx = fst_collected(table, "vx") + m->first,
                               .vy = fst_collected(table, "vy") + m->first,
                               .vz = heights && climbs ? climbs + m->first : NULL,
                               .rows = m->last - m->first + 1,
                               .bead = 1e3 * table->params.bead_radius,
                               .second = 1.0 / table->params.friction_gamma,
                               .millimetre = m->millimetres};
}

/* Paint the marks on the beads, where they are wanted. */
static fst_status begin_marks(camera *c, fst_error *error)
{
    fst_status status = FST_OK;
    if (!c->options->marks)
        return FST_OK;
    c->marks = calloc((size_t)c->cast.count, sizeof *c->marks);
    if (!c->marks)
        return fst_fail(error, FST_NO_MEMORY, "film", "no memory for the marks of a bead");
    for (int i = 0; i < c->cast.count && status == FST_OK; ++i) {
        status = fst_film_marks_begin(&c->marks[i], &c->cast.motions[i], c->options->marks, error);
        c->motions[i].marks = &c->marks[i];
    }
    return status;
}

static void end_marks(camera *c)
{
    for (int i = 0; c->marks && i < c->cast.count; ++i)
        free(c->marks[i].turns);
    free(c->marks);
}

/* The beads of a trajectory of one or, where `list` is given, of a list. */
static fst_status begin_motions(camera *c, const fst_table *table, const fst_beads_table *list,
                                fst_error *error)
{
    const fst_camera_options *o = c->options;
    if (list && list->scene.plate_shape != FST_PLATE_FLAT)
        return fst_fail(error, FST_BAD_INPUT, "plate.shape",
                        "a camera looks down on a flat plate, and plate.shape is %s: make a drawn film of it",
                        list->scene.plate_shape == FST_PLATE_NONE ? "none" : "bowl");
    fst_status status = list ? fst_film_cast_tables(&c->cast, list, o->from, o->to, error)
                             : fst_film_cast_table(&c->cast, table, o->from, o->to, error);
    if (status != FST_OK)
        return status;
    c->motions = calloc((size_t)c->cast.count, sizeof *c->motions);
    if (!c->motions)
        return fst_fail(error, FST_NO_MEMORY, "film", "no memory for the beads of a film");
    for (int i = 0; i < c->cast.count; ++i)
        c->motions[i] = motion_of(&c->cast.motions[i]);
    status = begin_marks(c, error);
    if (status != FST_OK)
        return status;
    const fst_camera_motion *m = &c->motions[0];
    c->begin = m->t[0] * m->second;
    const double seconds = m->t[m->rows - 1] * m->second - c->begin;
    const double count = 1.0 + floor((seconds - o->exposure - o->readout) * o->fps + 1e-9);
    if (!(count >= 1.0 && count <= MOST_FRAMES))
        return fst_fail(error, FST_BAD_INPUT, "fst_camera_options.from",
                        "%.6g s of motion are %.6g frames: take 1 to %d", seconds, fmax(count, 0.0),
                        MOST_FRAMES);
    c->moments = (int)count;
    c->frames = c->moments - (o->drop ? c->moments / o->drop : 0);
    return FST_OK;
}

/* How far from the axis the camera must see, and the radius of the greatest bead. */
static void find_reach(const camera *c, double *reach, double *radius)
{
    *radius = 0.0;
    for (int i = 0; i < c->cast.count; ++i)
        *radius = fmax(*radius, c->motions[i].bead);
    *reach = 4.0 * *radius;
    for (int i = 0; i < c->cast.count; ++i) {
        const fst_camera_motion *m = &c->motions[i];
        for (size_t row = 0; row < m->rows; ++row)
            *reach = fmax(*reach, m->millimetre * hypot(m->x[row], m->y[row]));
    }
}

static fst_status begin_view(camera *c, fst_error *error)
{
    const fst_camera_options *o = c->options;
    double reach, radius;
    find_reach(c, &reach, &radius);
    const double plate = isnan(o->plate) ? fmax(USUAL_PLATE, 10.0 * ceil(0.32 * reach)) : 1e3 * o->plate;
    const double distance = isnan(o->distance) ? 1.5 * plate : 1e3 * o->distance;
    if (!(plate >= 2.0 * (reach + radius) && plate <= 1e5))
        return fst_fail(error, FST_BAD_INPUT, "fst_camera_options.plate",
                        "%g mm: the bead needs a plate of %.3g mm or more", plate,
                        ceil(2.0 * (reach + radius)));
    if (!(distance >= 0.75 * plate && distance <= 1e6))
        return fst_fail(error, FST_BAD_INPUT, "fst_camera_options.distance",
                        "%g mm: the camera sees the whole plate from %.3g mm or more", distance, 0.75 * plate);
    c->distance = distance;
    c->paint =
        (fst_camera_paint){/* A margin of a sixth leaves room for the near edge of a plate that is tilted. */
                           .view = fst_camera_view_make(o->width, o->height, distance, o->tilt * FST_PI / 180.0,
                                                        o->side * FST_PI / 180.0, 0.5 * plate / 0.84),
                           .width = o->width,
                           .height = o->height,
                           .plate = 0.5 * plate,
                           .marks = 0.5 * floor(0.6 * plate),
                           .exposure = o->exposure,
                           .readout = o->readout,
                           .noise = o->noise,
                           .flicker = o->flicker,
                           .uneven = o->uneven,
                           .seed = o->seed};
    return fst_camera_paint_begin(&c->paint, error);
}

static void tell_facts(const camera *c, fst_camera_facts *facts)
{
    static const int corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const double half = c->paint.marks;
    *facts = (fst_camera_facts){.frames = c->frames,
                                .lost = c->moments - c->frames,
                                .plate = 2e-3 * c->paint.plate,
                                .distance = 1e-3 * c->distance,
                                .square = 2e-3 * half,
                                .scale = 1e-3 * c->distance / c->paint.view.focal};
    for (int i = 0; i < 4; ++i)
        fst_camera_view_project(&c->paint.view,
                                (const double[3]){corners[i][0] * half, corners[i][1] * half, 0.0},
                                facts->marks[i]);
}

/* ------------------------------------------------------------------ frames */

static void name_frame(const camera *c, int index, char path[FRAME_PATH])
{
    (void)snprintf(path, FRAME_PATH, "%s/frame-%05d.pgm", c->folder, index + 1);
}

static fst_status give_frame(camera *c, int index, fst_error *error)
{
    const size_t size = (size_t)c->paint.width * (size_t)c->paint.height;
    if (!c->folder[0])
        return fst_process_write(&c->process, c->pixels, size, error);
    char path[FRAME_PATH];
    fst_whole_file file;
    name_frame(c, index, path);
    fst_status status = fst_whole_file_open_next(&file, path, error);
    if (status != FST_OK)
        return status;
    /* A failed write is seen when the file is committed. */
    (void)fprintf(file.stream, "P5\n%d %d\n255\n", c->paint.width, c->paint.height);
    (void)fwrite(c->pixels, 1, size, file.stream);
    return fst_whole_file_commit(&file, error);
}

/* The names of the columns, with the number of the bead behind those of several. */
static void write_names(camera *c)
{
    static const char *const units[12][2] = {
        {"x", "mm"},     {"y", "mm"},     {"u", "px"},        {"v", "px"}, /* then those of a bead with marks */
        {"nx", "1"},     {"ny", "1"},     {"nz", "1"},        {"wx", "rad/s"},
        {"wy", "rad/s"}, {"wz", "rad/s"}, {"slip_x", "mm/s"}, {"slip_y", "mm/s"}};
    (void)fprintf(c->truth.stream, "frame,t [s]");
    for (int i = 0; i < c->cast.count; ++i)
        for (int k = 0; k < (c->marks ? 12 : 4); ++k) {
            char number[16] = "";
            if (c->cast.count > 1)
                (void)snprintf(number, sizeof number, "_%d", i);
            (void)fprintf(c->truth.stream, ",%s%s [%s]", units[k][0], number, units[k][1]);
        }
    (void)fputc('\n', c->truth.stream);
}

static void write_truth(camera *c, int index, double seconds)
{
    if (!c->truth.stream)
        return;
    (void)fprintf(c->truth.stream, "%d,%.9f", index, seconds - c->begin);
    for (int i = 0; i < c->cast.count; ++i) {
        double place[3], seen[2], n[3], w[3], slip[2];
        fst_camera_paint_truth(&c->paint, &c->motions[i], seconds, place, seen);
        (void)fprintf(c->truth.stream, ",%.6f,%.6f,%.4f,%.4f", place[0], place[1], seen[0],
                      c->paint.height - 1 - seen[1]);
        if (!c->marks)
            continue;
        fst_camera_paint_turning(&c->paint, &c->motions[i], seconds, seen, n, w, slip);
        (void)fprintf(c->truth.stream, ",%.6f,%.6f,%.6f,%.4f,%.4f,%.4f,%.4f,%.4f", n[0], n[1], n[2], w[0], w[1],
                      w[2], slip[0], slip[1]);
    }
    (void)fputc('\n', c->truth.stream);
}

static fst_status take_frames(camera *c, fst_error *error)
{
    const fst_camera_options *o = c->options;
    int index = 0;
    for (int k = 0; k < c->moments; ++k) {
        const double seconds = c->begin + k / o->fps;
        if (o->drop && (k + 1) % o->drop == 0)
            continue;
        fst_camera_paint_frame(&c->paint, c->motions, c->cast.count, seconds, (uint64_t)k, c->pixels);
        write_truth(c, index, seconds);
        fst_status status = give_frame(c, index++, error);
        if (status == FST_OK)
            status = fst_tell(o->progress, (k + 1.0) / c->moments, "frames", error);
        if (status != FST_OK)
            return status;
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ where they go */

static const char *format_of(const char *out)
{
    static const char *const formats[] = {"mp4", "mov", "gif"};
    const size_t length = strlen(out);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i)
        if (length > 4 && out[length - 4] == '.' && strcmp(out + length - 3, formats[i]) == 0)
            return formats[i];
    return NULL;
}

/* Remove the further frames of an earlier, longer film: they would be taken for this one's. */
static fst_status remove_further_frames(const camera *c, fst_error *error)
{
    char path[FRAME_PATH];
    for (int index = c->frames;; ++index) {
        name_frame(c, index, path);
        if (unlink(path) != 0)
            return errno == ENOENT
                       ? FST_OK
                       : fst_fail(error, FST_IO, path, "cannot remove this frame of an earlier film: %s",
                                  strerror(errno));
    }
}

static fst_status film_into_folder(camera *c, const char *folder, fst_error *error)
{
    struct stat there;
    if (snprintf(c->folder, sizeof c->folder, "%s", folder) >= (int)sizeof c->folder)
        return fst_fail(error, FST_BAD_INPUT, folder, "the name is too long");
    if (mkdir(folder, 0777) != 0 && !(errno == EEXIST && stat(folder, &there) == 0 && S_ISDIR(there.st_mode)))
        return fst_fail(error, errno == EEXIST ? FST_BAD_INPUT : FST_IO, folder,
                        "cannot make this folder for the frames: %s", strerror(errno));
    fst_whole_file_tidy(folder, ".frame-");
    const fst_status status = take_frames(c, error);
    return status == FST_OK ? remove_further_frames(c, error) : status;
}

static fst_status film_into_file(camera *c, const char *out, const char *format, fst_error *error)
{
    const fst_camera_options *o = c->options;
    const fst_ffmpeg_kind kind = {.width = o->width,
                                  .height = o->height,
                                  .fps = isnan(o->stored_fps) ? o->fps : o->stored_fps,
                                  .format = format,
                                  .pixels = "gray",
                                  .quality = o->quality,
                                  .drop = o->drop};
    fst_whole_file file;
    fst_status status = fst_whole_file_open(&file, out, error);
    if (status != FST_OK)
        return status;
    status = fst_ffmpeg_start(&c->process, &kind, file.temporary, out, error);
    if (status == FST_OK) {
        status = take_frames(c, error);
        /* Where ffmpeg failed, its own words say more than that it took no more frames. */
        const fst_status ended = fst_ffmpeg_end(&c->process, status != FST_OK && status != FST_IO, error);
        status = status == FST_OK || ended != FST_OK ? ended : status;
    }
    if (status == FST_OK)
        status = fst_film_file_check(file.temporary, format, c->frames, out, error);
    if (status == FST_OK && c->truth.stream)
        status = fst_whole_file_sync(&c->truth, error);
    if (status == FST_OK)
        return fst_whole_file_commit(&file, error);
    fst_whole_file_discard(&file);
    return status;
}

static fst_status film_with_truth(camera *c, const char *out, const char *truth, fst_error *error)
{
    fst_status status = truth ? fst_whole_file_open(&c->truth, truth, error) : FST_OK;
    if (status != FST_OK)
        return status;
    if (truth)
        write_names(c);
    const char *format = format_of(out);
    status = format ? film_into_file(c, out, format, error) : film_into_folder(c, out, error);
    if (truth && status == FST_OK)
        return fst_whole_file_commit(&c->truth, error);
    if (truth)
        fst_whole_file_discard(&c->truth);
    return status;
}

static fst_status take(const fst_table *table, const fst_beads_table *list, const char *out, const char *truth,
                       const fst_camera_options *options, fst_camera_facts *facts, fst_error *error)
{
    const fst_camera_options defaults = fst_default_camera_options();
    camera c = {.options = options ? options : &defaults};
    const char *name = strrchr(out, '/') ? strrchr(out, '/') + 1 : out;
    fst_status status = check(c.options, error);
    if (status == FST_OK && strrchr(name, '.') && !format_of(out))
        return fst_fail(error, FST_BAD_INPUT, out,
                        "the name of a camera's film ends in .mp4, .mov or .gif; a name without an ending is a "
                        "folder of images");
    if (status == FST_OK)
        status = begin_motions(&c, table, list, error);
    const fst_c_locale locale = fst_c_locale_enter();
    if (status == FST_OK)
        status = begin_view(&c, error);
    if (status == FST_OK) {
        c.pixels = malloc((size_t)c.paint.width * (size_t)c.paint.height);
        status = c.pixels ? film_with_truth(&c, out, truth, error)
                          : fst_fail(error, FST_NO_MEMORY, "film", "no memory for a frame");
    }
    if (status == FST_OK && facts)
        tell_facts(&c, facts);
    fst_camera_paint_end(&c.paint);
    free(c.pixels);
    end_marks(&c);
    free(c.motions);
    fst_film_cast_free(&c.cast);
    fst_c_locale_leave(locale);
    return status;
}

fst_status fst_camera_film(const fst_table *table, const char *out, const char *truth,
                           const fst_camera_options *options, fst_camera_facts *facts, fst_error *error)
{
    return take(table, NULL, out, truth, options, facts, error);
}

fst_status fst_camera_film_beads(const fst_beads_table *table, const char *out, const char *truth,
                                 const fst_camera_options *options, fst_camera_facts *facts, fst_error *error)
{
    return take(NULL, table, out, truth, options, facts, error);
}
