/* overlay.c - painting over gray pictures, without any library: rings, lines and dots.
 *
 * The film shows each frame with a ring around the bead, its trail, and a red frame where it was lost.  Of several beads
 * each has a colour, by which rings and trails show whether names were kept.  The
 * picture shows the whole path over what stays still, red lines where frames are lost, the plate's edge if it
 * was asked for, and below it enlarged beads with their rings, from frames all over the film.
 */
#include "follow/overlay.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "io/film_file.h"

enum { QUALITY = 20, SLOWEST = 30 };

/* Gray levels: a still picture whose brightest pixel has less is shown brighter, up to this. */
#define DIM 120.0
#define SHOWN 230.0

typedef struct colour {
    int blue, green, red;
} colour;
static const colour path_colours[FST_TRACKED_BEADS] = {
    {219, 152, 52}, {60, 160, 40}, {200, 80, 180}, {40, 140, 240}};
static const colour ring_colour = {0, 210, 255}, lost_colour = {40, 40, 230}, rim_colour = {60, 200, 80};

/* ------------------------------------------------------------------ painting */

static fst_status make_canvas(follow_canvas *canvas, int width, int height, fst_error *error)
{
    canvas->width = width;
    canvas->height = height;
    canvas->pixels = calloc((size_t)width * (size_t)height, 4);
    return canvas->pixels ? FST_OK : fst_fail(error, FST_NO_MEMORY, "track", "no memory for a picture");
}

static void blend(follow_canvas *canvas, int column, int row, double part, colour c)
{
    if (column < 0 || row < 0 || column >= canvas->width || row >= canvas->height || part <= 0.0)
        return;
    unsigned char *at = canvas->pixels + 4 * ((size_t)row * (size_t)canvas->width + (size_t)column);
    const int parts[3] = {c.blue, c.green, c.red};
    for (int i = 0; i < 3; ++i)
        at[i] = (unsigned char)(at[i] + fmin(part, 1.0) * (parts[i] - at[i]) + 0.5);
}

/* A line of some width; one of no length is a dot. */
static void line(follow_canvas *canvas, double x0, double y0, double x1, double y1, double width, colour c)
{
    const double half = 0.5 * width, dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy;
    if (!(fabs(x0) + fabs(y0) + fabs(x1) + fabs(y1) < 1e6))
        return;
    for (int row = (int)floor(fmin(y0, y1) - half - 1.0); row <= (int)ceil(fmax(y0, y1) + half + 1.0); ++row)
        for (int column = (int)floor(fmin(x0, x1) - half - 1.0); column <= (int)ceil(fmax(x0, x1) + half + 1.0);
             ++column) {
            double along = square > 0.0 ? ((column - x0) * dx + (row - y0) * dy) / square : 0.0;
            along = fmax(0.0, fmin(1.0, along));
            blend(canvas, column, row, half + 0.5 - hypot(column - x0 - along * dx, row - y0 - along * dy), c);
        }
}

static void ring(follow_canvas *canvas, double x, double y, double radius, double width, colour c)
{
    const double out = radius + width;
    for (int row = (int)floor(y - out); row <= (int)ceil(y + out); ++row)
        for (int column = (int)floor(x - out); column <= (int)ceil(x + out); ++column)
            blend(canvas, column, row, 0.5 * width + 0.5 - fabs(hypot(column - x, row - y) - radius), c);
}

/* Lay a gray picture with its upper left corner at a place. */
static void lay_gray(follow_canvas *canvas, int left, int top, const unsigned char *gray, int width, int height)
{
    for (int row = 0; top + row < canvas->height && row < height; ++row)
        for (int column = 0; left + column < canvas->width && column < width; ++column)
            memset(canvas->pixels + 4 * ((size_t)(top + row) * (size_t)canvas->width + (size_t)(left + column)),
                   gray[(size_t)row * (size_t)width + (size_t)column], 3);
}

/* ------------------------------------------------------------------ beginning */

static const char *format_of(const char *path, const char *const *formats)
{
    const char *dot = strrchr(path, '.');
    for (; dot && *formats; ++formats)
        if (strcmp(dot + 1, *formats) == 0)
            return *formats;
    return NULL;
}

fst_status follow_overlay_begin(follow_overlay *overlay, const follow_still *still, const follow_look *look,
                                double fps, int total, int beads, const char *film, const char *picture,
                                fst_error *error)
{
    static const char *const films[] = {"mp4", "mov", NULL}, *const pictures[] = {"png", NULL};
    *overlay = (follow_overlay){.film_path = film, .picture_path = picture, .total = total, .beads = beads};
    overlay->crop_scale = fmin(8.0, fmax(0.25, FOLLOW_CROP_SIZE / (2.2 * look->diameter)));
    for (int i = 0; i < beads * FOLLOW_TRAIL; ++i)
        overlay->trail[i / FOLLOW_TRAIL][i % FOLLOW_TRAIL].column = NAN;
    if (film && !(overlay->format = format_of(film, films)))
        return fst_fail(error, FST_BAD_INPUT, film, "the name of an overlay film ends in .mp4 or .mov");
    if (picture && !format_of(picture, pictures))
        return fst_fail(error, FST_BAD_INPUT, picture, "the name of the picture ends in .png");
    fst_status status = picture ? fst_whole_file_open(&overlay->picture, picture, error) : FST_OK;
    if (!film || status != FST_OK)
        return status;
    /* The encoder wants even sizes. */
    status = make_canvas(&overlay->canvas, still->width & ~1, still->height & ~1, error);
    if (status == FST_OK)
        status = fst_whole_file_open(&overlay->film, film, error);
    if (status != FST_OK)
        return status;
    const fst_ffmpeg_kind kind = {.width = overlay->canvas.width,
                                  .height = overlay->canvas.height,
                                  .fps = fmin(fmax(fps, 1.0), SLOWEST), /* slow enough for the eye */
                                  .format = overlay->format,
                                  .pixels = "bgr0",
                                  .quality = QUALITY};
    status = fst_ffmpeg_start(&overlay->process, &kind, overlay->film.temporary, film, error);
    overlay->started = status == FST_OK;
    return status;
}

/* ------------------------------------------------------------------ frames */

/* Keep an enlarged piece of a frame around the bead. */
static void keep_crop(follow_overlay *o, const follow_still *still, const unsigned char *frame,
                      const follow_place *place)
{
    unsigned char *to = o->crops[o->crop_count];
    for (int row = 0; row < FOLLOW_CROP_SIZE; ++row)
        for (int column = 0; column < FOLLOW_CROP_SIZE; ++column) {
            const int x =
                (int)floor(place->column + (column + 0.5 - 0.5 * FOLLOW_CROP_SIZE) / o->crop_scale + 0.5);
            const int y = (int)floor(place->row + (row + 0.5 - 0.5 * FOLLOW_CROP_SIZE) / o->crop_scale + 0.5);
            const int inside = x >= 0 && y >= 0 && x < still->width && y < still->height;
            to[row * FOLLOW_CROP_SIZE + column] =
                inside ? frame[(size_t)y * (size_t)still->width + (size_t)x] : 0;
        }
    ++o->crop_count;
}

static void paint_frame(follow_overlay *o, const follow_still *still, const unsigned char *frame, int index,
                        const follow_look *look, const follow_place *places)
{
    follow_canvas *canvas = &o->canvas;
    int seen = 0;
    lay_gray(canvas, 0, 0, frame, still->width, still->height);
    for (int k = 1; k < o->beads * FOLLOW_TRAIL; ++k) {
        const follow_place *trail = o->trail[k / FOLLOW_TRAIL], *a = &trail[(index + k) % FOLLOW_TRAIL],
                           *b = &trail[(index + k + 1) % FOLLOW_TRAIL];
        if (k % FOLLOW_TRAIL > 0 && !isnan(a->column) && !isnan(b->column))
            line(canvas, a->column, a->row, b->column, b->row, 1.5, path_colours[k / FOLLOW_TRAIL]);
    }
    for (int bead = 0; bead < o->beads; ++bead) {
        const follow_place *place = &places[bead];
        const colour c = o->beads > 1 ? path_colours[bead] : ring_colour;
        if (isnan(place->column))
            continue;
        ++seen;
        ring(canvas, place->column, place->row, 0.5 * look->diameter + 1.5, 1.5, c);
        line(canvas, place->column, place->row, place->column, place->row, 3.0, c);
    }
    if (seen == o->beads)
        return;
    const double right = canvas->width - 1.0, bottom = canvas->height - 1.0, thick = 12.0;
    line(canvas, 0.0, 0.0, right, 0.0, thick, lost_colour);
    line(canvas, 0.0, bottom, right, bottom, thick, lost_colour);
    line(canvas, 0.0, 0.0, 0.0, bottom, thick, lost_colour);
    line(canvas, right, 0.0, right, bottom, thick, lost_colour);
}

fst_status follow_overlay_frame(follow_overlay *overlay, const follow_still *still, const unsigned char *frame,
                                int index, const follow_look *look, const follow_place *places,
                                fst_error *error)
{
    const int64_t due = (int64_t)overlay->total * (2 * overlay->crop_count + 1) / (2 * FOLLOW_CROPS);
    const follow_place *place = &places[overlay->crop_count % overlay->beads]; /* each bead has its turn */
    if (overlay->picture_path && overlay->crop_count < FOLLOW_CROPS && index >= due && !isnan(place->column))
        keep_crop(overlay, still, frame, place);
    if (!overlay->film_path)
        return FST_OK;
    for (int bead = 0; bead < overlay->beads; ++bead)
        overlay->trail[bead][index % FOLLOW_TRAIL] = places[bead];
    paint_frame(overlay, still, frame, index, look, places);
    ++overlay->frames;
    return fst_process_write(&overlay->process, overlay->canvas.pixels,
                             4 * (size_t)overlay->canvas.width * (size_t)overlay->canvas.height, error);
}

/* ------------------------------------------------------------------ the picture */

static void paint_rim(follow_canvas *canvas, const follow_ellipse *rim)
{
    enum { PIECES = 180 };
    double before[2] = {0.0, 0.0};
    for (int i = 0; i <= PIECES; ++i) {
        double at[2];
        follow_ellipse_point(rim, FST_TWO_PI * i / PIECES, at);
        if (i > 0)
            line(canvas, before[0], before[1], at[0], at[1], 1.5, rim_colour);
        memcpy(before, at, sizeof before);
    }
}

static void paint_path(follow_canvas *canvas, const double *columns, const double *rows, int count, colour c)
{
    int last = -1;
    for (int i = 0; i < count; ++i) {
        if (isnan(columns[i]))
            continue;
        if (last >= 0 && last < i - 1)
            line(canvas, columns[last], rows[last], columns[i], rows[i], 1.0, lost_colour);
        last = i;
    }
    for (int i = 0; i < count; ++i)
        if (!isnan(columns[i]))
            line(canvas, columns[i], rows[i], columns[i], rows[i], 1.6, c);
}

/* The pieces in a row below the picture, each with a ring of the bead's size and a cross at its centre. */
static void paint_crops(const follow_overlay *o, follow_canvas *canvas, const follow_look *look, int top,
                        double stretch)
{
    unsigned char crop[FOLLOW_CROP_SIZE * FOLLOW_CROP_SIZE];
    for (int k = 0; k < o->crop_count; ++k) {
        const int left = k * (FOLLOW_CROP_SIZE + 4);
        for (int i = 0; i < FOLLOW_CROP_SIZE * FOLLOW_CROP_SIZE; ++i)
            crop[i] = (unsigned char)fmin(255.0, stretch * o->crops[k][i]);
        lay_gray(canvas, left, top, crop, FOLLOW_CROP_SIZE, FOLLOW_CROP_SIZE);
        const double x = left + 0.5 * FOLLOW_CROP_SIZE - 0.5, y = top + 0.5 * FOLLOW_CROP_SIZE - 0.5;
        ring(canvas, x, y, 0.5 * look->diameter * o->crop_scale, 1.2, ring_colour);
        line(canvas, x - 5.0, y, x + 5.0, y, 1.2, ring_colour);
        line(canvas, x, y - 5.0, x, y + 5.0, 1.2, ring_colour);
    }
}

static fst_status write_picture(const follow_overlay *o, const follow_canvas *canvas, fst_error *error)
{
    const fst_ffmpeg_kind kind = {
        .width = canvas->width, .height = canvas->height, .fps = 1.0, .format = "png", .pixels = "bgr0"};
    fst_process process;
    fst_status status = fst_ffmpeg_start(&process, &kind, o->picture.temporary, o->picture_path, error);
    if (status != FST_OK)
        return status;
    status =
        fst_process_write(&process, canvas->pixels, 4 * (size_t)canvas->width * (size_t)canvas->height, error);
    const fst_status ended = fst_ffmpeg_end(&process, status != FST_OK && status != FST_IO, error);
    status = status == FST_OK || ended != FST_OK ? ended : status;
    return status == FST_OK ? fst_whole_file_sync(&o->picture, error) : status;
}

static fst_status make_picture(const follow_overlay *o, const follow_still *still, const follow_look *look,
                               double *const *columns, double *const *rows, int count,
                               const follow_ellipse *rim, fst_error *error)
{
    follow_canvas canvas;
    const size_t size = (size_t)still->width * (size_t)still->height;
    const int strip = FOLLOW_CROPS * (FOLLOW_CROP_SIZE + 4);
    unsigned char *gray = malloc(size);
    fst_status status = gray ? FST_OK : fst_fail(error, FST_NO_MEMORY, "track", "no memory for a picture");
    if (status == FST_OK)
        status = make_canvas(&canvas, still->width > strip ? still->width : strip,
                             still->height + FOLLOW_CROP_SIZE + 4, error);
    if (status != FST_OK) {
        free(gray);
        return status;
    }
    double bright = 1.0;
    for (size_t i = 0; i < size; ++i)
        bright = fmax(bright, (double)still->level[i]);
    const double stretch = bright < DIM ? SHOWN / bright : 1.0;
    for (size_t i = 0; i < size; ++i)
        gray[i] = (unsigned char)fmin(255.0, stretch * (double)still->level[i] + 0.5);
    lay_gray(&canvas, 0, 0, gray, still->width, still->height);
    free(gray);
    if (rim)
        paint_rim(&canvas, rim);
    for (int bead = 0; bead < o->beads; ++bead)
        paint_path(&canvas, columns[bead], rows[bead], count, path_colours[bead]);
    paint_crops(o, &canvas, look, still->height + 4, stretch);
    status = write_picture(o, &canvas, error);
    free(canvas.pixels);
    return status;
}

/* ------------------------------------------------------------------ the end */

fst_status follow_overlay_finish(follow_overlay *overlay, const follow_still *still, const follow_look *look,
                                 double *const *columns, double *const *rows, int count,
                                 const follow_ellipse *rim, fst_error *error)
{
    fst_status status = FST_OK;
    if (overlay->started) {
        overlay->started = 0;
        status = fst_ffmpeg_end(&overlay->process, 0, error);
        if (status == FST_OK)
            status = fst_film_file_check(overlay->film.temporary, overlay->format, overlay->frames,
                                         overlay->film_path, error);
        if (status == FST_OK)
            status = fst_whole_file_sync(&overlay->film, error);
    }
    if (status == FST_OK && overlay->picture_path)
        status = make_picture(overlay, still, look, columns, rows, count, rim, error);
    return status;
}

fst_status follow_overlay_commit(follow_overlay *overlay, fst_error *error)
{
    fst_whole_file *const files[2] = {&overlay->film, &overlay->picture};
    fst_status status = FST_OK;
    for (int i = 0; i < 2 && status == FST_OK; ++i) {
        if (!files[i]->stream)
            continue;
        status = fst_whole_file_commit(files[i], error);
        files[i]->stream = NULL;
    }
    return status;
}

void follow_overlay_free(follow_overlay *overlay)
{
    if (overlay->started)
        (void)fst_ffmpeg_end(&overlay->process, 1, NULL);
    if (overlay->film.stream)
        fst_whole_file_discard(&overlay->film);
    if (overlay->picture.stream)
        fst_whole_file_discard(&overlay->picture);
    free(overlay->canvas.pixels);
    *overlay = (follow_overlay){.frames = 0};
}
