/* cairo_module.c - festoon-cairo.so: painting one frame of a film with Cairo. */
#include <cairo.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/constants.h"
#include "base/error.h"
#include "film/frame.h"

struct fst_film_canvas {
    cairo_surface_t *surface;
    cairo_t *pen;
};

/* The colours of the figures (style.c): from light green to violet, and from blue over grey to vermilion. */
static const double line_palette[][4] = {{0.0, 0.659, 0.859, 0.204}, {0.2, 0.290, 0.757, 0.427},
                                         {0.4, 0.122, 0.631, 0.529}, {0.6, 0.176, 0.439, 0.557},
                                         {0.8, 0.255, 0.267, 0.529}, {1.0, 0.267, 0.004, 0.329}};
static const double diverging_palette[][4] = {{0.0, 0.071, 0.247, 0.549},
                                              {0.25, 0.310, 0.525, 0.812},
                                              {0.5, 0.741, 0.741, 0.741},
                                              {0.75, 0.910, 0.537, 0.290},
                                              {1.0, 0.690, 0.188, 0.0}};
static const double north[3] = {0.835, 0.369, 0.0}, south[3] = {0.0, 0.447, 0.698};

/* The bead's rim, which tells whether its contact sticks or slips or it flies (fst_contact_shown), and the
 * words for it. */
static const double rims[][3] = {{0.2, 0.2, 0.2}, {0.0, 0.62, 0.45}, {0.90, 0.62, 0.0}, {0.0, 0.45, 0.70}};
static const char *const contact_words[] = {"from the front", "from the front: it sticks",
                                            "from the front: it slips", "from the front: it flies"};

static void set_shade(cairo_t *pen, int both_signs, double shade)
{
    const double(*palette)[4] = both_signs ? diverging_palette : line_palette;
    int last = both_signs ? 4 : 5, i = 0;
    shade = shade > 0.0 ? (shade < 1.0 ? shade : 1.0) : 0.0;
    while (i < last - 1 && shade > palette[i + 1][0])
        ++i;
    double part = (shade - palette[i][0]) / (palette[i + 1][0] - palette[i][0]), c[3];
    for (int k = 0; k < 3; ++k)
        c[k] = palette[i][k + 1] + part * (palette[i + 1][k + 1] - palette[i][k + 1]);
    cairo_set_source_rgb(pen, c[0], c[1], c[2]);
}

static void write_at(cairo_t *pen, double x, double y, double size, const char *text)
{
    cairo_set_font_size(pen, size);
    cairo_move_to(pen, x, y);
    cairo_show_text(pen, text);
}

/* ------------------------------------------------------------------ from above; the pen works in
 * mm, y upwards */

static void trace(cairo_t *pen, const double corners[][2], int count)
{
    cairo_new_path(pen);
    for (int i = 0; i < count; ++i)
        cairo_line_to(pen, corners[i][0], corners[i][1]);
    cairo_close_path(pen);
}

static void paint_magnet(cairo_t *pen, const fst_film_layout *layout, double angle)
{
    cairo_save(pen);
    cairo_rotate(pen, angle);
    for (int i = 0; i < layout->body_count; ++i) {
        const fst_magnet_body *body = &layout->bodies[i];
        for (int pole = 0; pole < 2; ++pole) {
            const double *colour = pole == 0 ? north : south;
            trace(pen, body->poles[pole], body->pole_count[pole]);
            cairo_set_source_rgba(pen, colour[0], colour[1], colour[2], 0.22);
            cairo_fill(pen);
        }
        trace(pen, body->seen.corners, body->seen.count);
        cairo_set_source_rgb(pen, 0.6, 0.6, 0.6);
        cairo_set_line_width(pen, 0.25);
        cairo_stroke(pen);
    }
    cairo_restore(pen);
}

static void paint_trail(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame)
{
    cairo_set_line_width(pen, layout->reach / 90.0);
    cairo_set_line_cap(pen, CAIRO_LINE_CAP_ROUND);
    for (int i = 0; i + 1 < frame->trail; ++i) {
        set_shade(pen, layout->both_signs, frame->trail_shade[i]);
        cairo_move_to(pen, frame->trail_x[i], frame->trail_y[i]);
        cairo_line_to(pen, frame->trail_x[i + 1], frame->trail_y[i + 1]);
        cairo_stroke(pen);
    }
}

/* A vector of the bead's body as seen along the third axis of `turn`; `view` is 0 from above, 1 from the front
 * (along y, with z upwards). */
static void seen(const double turn[3][3], const double body[3], int view, double *x, double *y, double *towards)
{
    double v[3];
    for (int i = 0; i < 3; ++i)
        v[i] = turn[i][0] * body[0] + turn[i][1] * body[1] + turn[i][2] * body[2];
    *x = v[0];
    *y = view == 0 ? v[1] : v[2];
    *towards = view == 0 ? v[2] : -v[1];
}

/* The poles as caps, the equator as a line, and marks at places without symmetry; each is drawn where it faces
 * the viewer. */
static void paint_marks(cairo_t *pen, const double turn[3][3], double radius, int view)
{
    static const double marks[][3] = {{0.85, 0.0, 0.527}, {-0.5, 0.7, 0.51},   {0.1, -0.9, 0.424},
                                      {0.6, 0.62, -0.5},  {-0.8, -0.2, -0.57}, {0.3, -0.75, -0.59}};
    double x, y, towards;
    cairo_set_source_rgba(pen, 0.15, 0.15, 0.15, 0.8);
    cairo_set_line_width(pen, 0.07 * radius);
    int drawing = 0;
    for (int i = 0; i <= 72; ++i) {
        double angle = 2.0 * FST_PI * i / 72, body[3] = {cos(angle), sin(angle), 0.0};
        seen(turn, body, view, &x, &y, &towards);
        if (towards <= 0.0)
            drawing = 0;
        else if (drawing)
            cairo_line_to(pen, radius * x, radius * y);
        else {
            cairo_move_to(pen, radius * x, radius * y);
            drawing = 1;
        }
    }
    cairo_stroke(pen);
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; ++i) {
        seen(turn, marks[i], view, &x, &y, &towards);
        if (towards <= 0.05)
            continue;
        cairo_arc(pen, radius * x, radius * y, 0.08 * radius, 0.0, 2.0 * FST_PI);
        cairo_fill(pen);
    }
    for (int sign = 1; sign >= -1; sign -= 2) {
        double body[3] = {0.0, 0.0, sign};
        seen(turn, body, view, &x, &y, &towards);
        if (towards <= 0.0)
            continue;
        const double *colour = sign > 0 ? north : south;
        cairo_save(pen);
        cairo_translate(pen, radius * x, radius * y);
        cairo_rotate(pen, atan2(y, x));
        cairo_scale(pen, fmax(towards, 0.15), 1.0); /* a cap seen from its side is an ellipse */
        cairo_arc(pen, 0.0, 0.0, 0.3 * radius, 0.0, 2.0 * FST_PI);
        cairo_restore(pen);
        cairo_set_source_rgb(pen, colour[0], colour[1], colour[2]);
        cairo_fill(pen);
    }
}

static void paint_bead(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame, int view)
{
    double radius = layout->radius;
    cairo_pattern_t *shade = cairo_pattern_create_radial(-0.35 * radius, 0.35 * radius, 0.05 * radius,
                                                         -0.1 * radius, 0.1 * radius, 1.15 * radius);
    cairo_pattern_add_color_stop_rgb(shade, 0.0, 1.0, 1.0, 1.0);
    cairo_pattern_add_color_stop_rgb(shade, 0.5, 0.82, 0.83, 0.85);
    cairo_pattern_add_color_stop_rgb(shade, 1.0, 0.40, 0.41, 0.44);
    cairo_arc(pen, 0.0, 0.0, radius, 0.0, 2.0 * FST_PI);
    cairo_set_source(pen, shade);
    cairo_fill_preserve(pen);
    cairo_pattern_destroy(shade);
    cairo_save(pen);
    cairo_clip(pen);
    paint_marks(pen, frame->turn, radius, view);
    cairo_restore(pen);
    const double *rim = rims[frame->contact];
    cairo_arc(pen, 0.0, 0.0, radius, 0.0, 2.0 * FST_PI);
    cairo_set_source_rgb(pen, rim[0], rim[1], rim[2]);
    cairo_set_line_width(pen, (frame->contact == FST_CONTACT_UNTOLD ? 0.05 : 0.16) * radius);
    cairo_stroke(pen);
}

/* An arrow along an arc about the middle: the sense in which the magnet turns, anticlockwise. */
static void paint_sense(cairo_t *pen, double radius, double from, double to, double head)
{
    const double x = radius * cos(to), y = radius * sin(to);
    cairo_new_path(pen);
    cairo_arc(pen, 0.0, 0.0, radius, from, to);
    cairo_stroke(pen);
    cairo_move_to(pen, x - head * sin(to), y + head * cos(to));
    cairo_line_to(pen, x + 0.5 * head * cos(to), y + 0.5 * head * sin(to));
    cairo_line_to(pen, x - 0.5 * head * cos(to), y - 0.5 * head * sin(to));
    cairo_close_path(pen);
    cairo_fill(pen);
}

static void paint_plate(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame, double scale)
{
    cairo_save(pen);
    cairo_translate(pen, 0.5 * layout->width, 0.5 * layout->height);
    cairo_scale(pen, scale, -scale);
    if (layout->body_count) {
        paint_magnet(pen, layout, frame->magnet_angle);
        cairo_set_source_rgb(pen, 0.35, 0.35, 0.35);
        cairo_set_line_width(pen, layout->reach / 110.0);
        paint_sense(pen, 0.97 * layout->reach, 0.15 * FST_PI, 0.32 * FST_PI, layout->reach / 18.0);
    }
    cairo_new_path(pen);
    cairo_arc(pen, 0.0, 0.0, layout->reach / 120.0, 0.0, 2.0 * FST_PI);
    cairo_set_source_rgb(pen, 0.3, 0.3, 0.3);
    cairo_fill(pen);
    paint_trail(pen, layout, frame);
    cairo_translate(pen, frame->x, frame->y);
    paint_bead(pen, layout, frame, 0);
    cairo_restore(pen);
}

/* ------------------------------------------------------------------ around it, in pixels */

/* A body of the magnet from the front, its poles the paler the more they point away. */
static void paint_slab(cairo_t *pen, const fst_part_shape *body, double depth, double angle)
{
    const double c = cos(angle), s = sin(angle), *j = body->magnetisation;
    const double size = hypot(hypot(j[0], j[1]), j[2]);
    const double aside = size > 0.0 ? (j[0] * c - j[1] * s) / size : 0.0, up = size > 0.0 ? j[2] / size : 0.0;
    const int upright = fabs(up) > fabs(aside);
    const double towards = upright ? up : aside; /* right, or upwards */
    double left = INFINITY, right = -INFINITY;
    for (int k = 0; k < body->count; ++k) {
        const double x = body->corners[k][0] * c - body->corners[k][1] * s;
        left = fmin(left, x);
        right = fmax(right, x);
    }
    const double low = body->low - depth, high = body->high - depth;
    cairo_pattern_t *poles = upright ? cairo_pattern_create_linear(0.0, low, 0.0, high)
                                     : cairo_pattern_create_linear(left, 0.0, right, 0.0);
    const double *end = towards > 0.0 ? north : south, *begin = towards > 0.0 ? south : north;
    cairo_pattern_add_color_stop_rgba(poles, 0.0, begin[0], begin[1], begin[2], 0.15 + 0.4 * fabs(towards));
    cairo_pattern_add_color_stop_rgba(poles, 1.0, end[0], end[1], end[2], 0.15 + 0.4 * fabs(towards));
    cairo_rectangle(pen, left, low, right - left, high - low);
    cairo_set_source(pen, poles);
    cairo_fill(pen);
    cairo_pattern_destroy(poles);
}

/* The view from the front: the plate, the magnet's slab below it, and the bead on it. */
static void paint_side(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame)
{
    double width = 0.30 * layout->width, scale = width / (2.0 * layout->reach);
    double left = 12.0, up = 2.6 * layout->radius;
    double down = layout->depth - layout->low + 0.3 * (layout->high - layout->low);
    down = fmin(down, 0.3 * layout->height / scale - up); /* of a deep magnet the upper part */
    double height = scale * (up + down), top = layout->height - height - 12.0;
    cairo_rectangle(pen, left, top, width, height);
    cairo_set_source_rgba(pen, 1.0, 1.0, 1.0, 0.9);
    cairo_fill_preserve(pen);
    cairo_set_source_rgb(pen, 0.75, 0.75, 0.75);
    cairo_set_line_width(pen, 1.0);
    cairo_stroke(pen);
    cairo_save(pen);
    cairo_rectangle(pen, left, top, width, height);
    cairo_clip(pen);
    cairo_translate(pen, left + 0.5 * width, top + scale * up);
    cairo_scale(pen, scale, -scale);
    for (int i = 0; i < layout->body_count; ++i)
        paint_slab(pen, &layout->bodies[i].seen, layout->depth, frame->magnet_angle);
    cairo_move_to(pen, -layout->reach, 0.0);
    cairo_line_to(pen, layout->reach, 0.0);
    cairo_set_source_rgb(pen, 0.3, 0.3, 0.3);
    cairo_set_line_width(pen, 0.4);
    cairo_stroke(pen);
    cairo_translate(pen, frame->x, layout->radius + frame->z);
    paint_bead(pen, layout, frame, 1);
    cairo_restore(pen);
    cairo_set_source_rgb(pen, 0.35, 0.35, 0.35);
    write_at(pen, left + 2.0, top - 6.0, 0.024 * layout->height, contact_words[frame->contact]);
}

static void paint_scale_bar(cairo_t *pen, const fst_film_layout *layout, double scale)
{
    /* The greatest 1, 2 or 5 times a power of ten that takes up to a sixth of the width. */
    static const double steps[] = {1.0, 2.0, 5.0};
    const double most = layout->width / (6.0 * scale), power = pow(10.0, floor(log10(most)));
    double millimetres = power;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i)
        if (steps[i] * power <= most)
            millimetres = steps[i] * power;
    double length = millimetres * scale, x = layout->width - 24.0 - length, y = layout->height - 24.0;
    char words[32];
    cairo_text_extents_t extents;
    cairo_set_source_rgb(pen, 0.13, 0.13, 0.13);
    cairo_set_line_width(pen, 3.0);
    cairo_move_to(pen, x, y);
    cairo_line_to(pen, x + length, y);
    cairo_stroke(pen);
    (void)snprintf(words, sizeof words, "%g mm", millimetres);
    cairo_set_font_size(pen, 0.026 * layout->height);
    cairo_text_extents(pen, words, &extents);
    write_at(pen, layout->width - 24.0 - fmax(length, extents.x_advance), y - 8.0, 0.026 * layout->height,
             words);
}

/* What the colours of the poles mean, and the arrow. */
static void paint_key(cairo_t *pen, const fst_film_layout *layout)
{
    const double size = 0.024 * layout->height, x = 0.34 * layout->width, dot = 0.38 * size;
    const char *const words[2] = {"north pole", "south pole"};
    double y = layout->height - 14.0 - (layout->body_count ? 1.5 * size : 0.0), at = x;
    for (int i = 0; i < 2; ++i) {
        const double *colour = i == 0 ? north : south;
        cairo_text_extents_t extents;
        cairo_arc(pen, at + dot, y - 0.36 * size, dot, 0.0, 2.0 * FST_PI);
        cairo_set_source_rgb(pen, colour[0], colour[1], colour[2]);
        cairo_fill(pen);
        cairo_set_source_rgb(pen, 0.35, 0.35, 0.35);
        write_at(pen, at + 3.0 * dot, y, size, words[i]);
        cairo_text_extents(pen, words[i], &extents);
        at += 4.5 * dot + extents.x_advance;
    }
    if (!layout->body_count)
        return;
    write_at(pen, x, y + 1.5 * size, size, "arrow: the magnet turns so");
}

static void paint_colour_bar(cairo_t *pen, const fst_film_layout *layout)
{
    enum { STEPS = 64 };
    double width = 0.3 * layout->width, x = layout->width - width - 24.0, y = 16.0,
           size = 0.024 * layout->height;
    for (int i = 0; i < STEPS; ++i) {
        set_shade(pen, layout->both_signs, (i + 0.5) / STEPS);
        cairo_rectangle(pen, x + i * width / STEPS, y, width / STEPS + 1.0, 10.0);
        cairo_fill(pen);
    }
    char low[32], high[32];
    cairo_text_extents_t extents;
    /* Three digits, but 6020 and not 6.02e+03. */
    (void)snprintf(low, sizeof low, fabs(layout->colour_low) < 1000.0 ? "%.3g" : "%.0f", layout->colour_low);
    (void)snprintf(high, sizeof high, fabs(layout->colour_high) < 1000.0 ? "%.3g" : "%.0f",
                   layout->colour_high);
    cairo_set_source_rgb(pen, 0.13, 0.13, 0.13);
    write_at(pen, x, y + 14.0 + size, size, low);
    cairo_text_extents(pen, high, &extents);
    write_at(pen, x + width - extents.x_advance, y + 14.0 + size, size, high);
    cairo_text_extents(pen, layout->colour_label, &extents);
    write_at(pen, x + width - extents.x_advance, y + 17.0 + 2.0 * size, size, layout->colour_label);
}

/* ------------------------------------------------------------------ the table */

static void close_canvas(fst_film_canvas *canvas)
{
    if (!canvas)
        return;
    cairo_destroy(canvas->pen);
    cairo_surface_destroy(canvas->surface);
    free(canvas);
}

static fst_status open_canvas(const fst_film_layout *layout, fst_film_canvas **out, fst_error *error)
{
    fst_film_canvas *canvas = malloc(sizeof *canvas);
    if (!canvas)
        return fst_fail(error, FST_NO_MEMORY, "film", "no memory for a frame");
    canvas->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, layout->width, layout->height);
    canvas->pen = cairo_create(canvas->surface);
    if (cairo_status(canvas->pen) != CAIRO_STATUS_SUCCESS) {
        close_canvas(canvas);
        return fst_fail(error, FST_NO_MEMORY, "film", "no memory for frames of %d x %d pixels", layout->width,
                        layout->height);
    }
    cairo_select_font_face(canvas->pen, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    *out = canvas;
    return FST_OK;
}

static void paint(fst_film_canvas *canvas, const fst_film_layout *layout, const fst_film_frame *frame)
{
    cairo_t *pen = canvas->pen;
    int side = layout->width < layout->height ? layout->width : layout->height;
    /* It is small enough for the bead to pass it without being hidden. */
    double scale = 0.84 * side / (2.0 * layout->reach);
    cairo_set_source_rgb(pen, 1.0, 1.0, 1.0);
    cairo_paint(pen);
    paint_plate(pen, layout, frame, scale);
    paint_side(pen, layout, frame);
    paint_scale_bar(pen, layout, scale);
    paint_colour_bar(pen, layout);
    paint_key(pen, layout);
    cairo_set_source_rgb(pen, 0.13, 0.13, 0.13);
    write_at(pen, 16.0, 14.0 + 0.028 * layout->height, 0.028 * layout->height, layout->title);
    write_at(pen, 16.0, 22.0 + 0.054 * layout->height, 0.026 * layout->height, frame->clock);
    write_at(pen, 16.0, 27.0 + 0.080 * layout->height, 0.026 * layout->height, layout->slower);
}

static const unsigned char *pixels(fst_film_canvas *canvas, int *stride)
{
    cairo_surface_flush(canvas->surface);
    *stride = cairo_image_surface_get_stride(canvas->surface);
    return cairo_image_surface_get_data(canvas->surface);
}

static cairo_status_t write_bytes(void *out, const unsigned char *bytes, unsigned size)
{
    return fwrite(bytes, 1, size, out) == size ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static fst_status write_png(fst_film_canvas *canvas, FILE *out, fst_error *error)
{
    const cairo_status_t status = cairo_surface_write_to_png_stream(canvas->surface, write_bytes, out);
    if (status == CAIRO_STATUS_SUCCESS || status == CAIRO_STATUS_WRITE_ERROR)
        return FST_OK;
    return fst_fail(error, status == CAIRO_STATUS_NO_MEMORY ? FST_NO_MEMORY : FST_IO, "film",
                    "a frame cannot be painted: %s", cairo_status_to_string(status));
}

FST_API extern const fst_film_module_table fst_film_module;
const fst_film_module_table fst_film_module = {FST_VERSION_STRING, open_canvas, paint, pixels,
                                               write_png,          close_canvas};
