/* cairo_module.c - festoon-cairo.so: painting one frame of a film with Cairo. */
#include <cairo.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/constants.h"
#include "base/error.h"
#include "film/cairo_words.h"

struct fst_film_canvas {
    cairo_surface_t *surface;
    cairo_t *pen;
};

/* The bead's rim, which tells whether its contact sticks or slips or it flies (fst_contact_shown), and the
 * words for it. */
static const double rims[][3] = {{0.2, 0.2, 0.2}, {0.0, 0.62, 0.45}, {0.90, 0.62, 0.0}, {0.0, 0.45, 0.70}};
static const char *const contact_words[] = {"", ": it sticks", ": it slips", ": it flies"};

/* ------------------------------------------------------------------ from above; the pen works in
 * mm, y upwards */

static void trace(cairo_t *pen, const double corners[][2], int count)
{
    cairo_new_path(pen);
    for (int i = 0; i < count; ++i)
        cairo_line_to(pen, corners[i][0], corners[i][1]);
    cairo_close_path(pen);
}

static void paint_body(cairo_t *pen, const fst_magnet_body *body)
{
    for (int pole = 0; pole < 2; ++pole) {
        const double *colour = pole == 0 ? fst_pen_north : fst_pen_south;
        trace(pen, body->poles[pole], body->pole_count[pole]);
        cairo_set_source_rgba(pen, colour[0], colour[1], colour[2], 0.22);
        cairo_fill(pen);
    }
    trace(pen, body->seen.corners, body->seen.count);
    cairo_set_source_rgb(pen, 0.6, 0.6, 0.6);
    cairo_set_line_width(pen, 0.25);
    cairo_stroke(pen);
}

static void paint_magnet(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame)
{
    for (int i = 0; i < layout->body_count; ++i) {
        cairo_save(pen);
        if (!(layout->fixed >> i & 1)) {
            cairo_translate(pen, frame->magnet_place[0], frame->magnet_place[1]);
            cairo_rotate(pen, frame->magnet_angle);
        }
        paint_body(pen, &layout->bodies[i]);
        cairo_restore(pen);
    }
}

/* Bands where a field that travels along x points up or down, as over poles of magnets under the plate: its vertical part
 * is -sin(2 pi x/length - phase) times the sign of the length. */
static void paint_wave(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame)
{
    enum { STOPS = 24 };
    const double length = fabs(layout->wave), begin = length * frame->phase / (2.0 * FST_PI);
    cairo_pattern_t *bands = cairo_pattern_create_linear(begin, 0.0, begin + length, 0.0);
    cairo_pattern_set_extend(bands, CAIRO_EXTEND_REPEAT);
    for (int k = 0; k <= STOPS; ++k) {
        const double up = (layout->wave > 0.0 ? -1.0 : 1.0) * sin(2.0 * FST_PI * k / STOPS);
        const double *colour = up > 0.0 ? fst_pen_north : fst_pen_south;
        cairo_pattern_add_color_stop_rgba(bands, (double)k / STOPS, colour[0], colour[1], colour[2],
                                          0.25 * fabs(up));
    }
    cairo_set_source(pen, bands);
    cairo_paint(pen);
    cairo_pattern_destroy(bands);
}

/* Marks on the plate, by which one sees the picture move. */
static void paint_grid(cairo_t *pen, const fst_film_layout *layout, const double centre[2])
{
    const double step = fst_round_length(0.5 * layout->reach), far = 1.5 * layout->reach;
    cairo_set_source_rgb(pen, 0.85, 0.85, 0.85);
    cairo_set_line_width(pen, layout->reach / 300.0);
    for (int k = 0; k < 2; ++k)
        for (double at = step * ceil((centre[k] - far) / step); at < centre[k] + far; at += step) {
            cairo_move_to(pen, k ? centre[0] - far : at, k ? at : centre[1] - far);
            cairo_line_to(pen, k ? centre[0] + far : at, k ? at : centre[1] + far);
            cairo_stroke(pen);
        }
}

/* A coil as a ring, in either view. */
static void paint_coils(cairo_t *pen, const fst_film_layout *layout, fst_film_view view)
{
    for (int i = 0; i < layout->coil_count; ++i) {
        const fst_coil *coil = &layout->coils[i];
        const double *n = coil->axis, across = hypot(n[0], n[1]), size = hypot(across, n[2]);
        const double u[3] = {across > 0.0 ? -n[1] / across : 1.0, across > 0.0 ? n[0] / across : 0.0, 0.0};
        const double v[3] = {-n[2] * u[1] / size, n[2] * u[0] / size, (n[0] * u[1] - n[1] * u[0]) / size};
        cairo_new_path(pen);
        for (int k = 0; k <= 72; ++k) {
            const double c = cos(2.0 * FST_PI * k / 72), s = sin(2.0 * FST_PI * k / 72);
            double at[3];
            for (int j = 0; j < 3; ++j)
                at[j] = 1e3 * (coil->centre[j] + coil->radius * (c * u[j] + s * v[j]));
            cairo_line_to(pen, at[0], view == FST_FILM_ABOVE ? at[1] : at[2] - layout->depth);
        }
        cairo_set_source_rgb(pen, 0.72, 0.45, 0.20);
        cairo_set_line_width(pen, layout->reach / 60.0);
        cairo_stroke(pen);
    }
}

static void paint_trail(cairo_t *pen, const fst_film_layout *layout, const fst_film_bead *bead, double sign)
{
    cairo_set_line_width(pen, layout->reach / (bead->colour ? 130.0 : 90.0));
    cairo_set_line_cap(pen, CAIRO_LINE_CAP_ROUND);
    for (int i = 0; i + 1 < bead->trail; ++i) {
        if (bead->colour)
            cairo_set_source_rgb(pen, bead->colour[0], bead->colour[1], bead->colour[2]);
        else
            fst_pen_shade(pen, layout->both_signs, bead->trail_shade[i]);
        cairo_move_to(pen, sign * bead->trail_x[i], sign * bead->trail_y[i]);
        cairo_line_to(pen, sign * bead->trail_x[i + 1], sign * bead->trail_y[i + 1]);
        cairo_stroke(pen);
    }
}

/* What a picture from the front is multiplied by to show z downwards: it is turned about y by half a turn. */
static double sign_of(const fst_film_layout *layout, fst_film_view view)
{
    return view == FST_FILM_FRONT && layout->upside_down ? -1.0 : 1.0;
}

/* A place as a view shows it, and how far it lies towards the viewer. */
static void seen_from(fst_film_view view, double sign, const double v[3], double *x, double *y, double *towards)
{
    *x = sign * v[0];
    *y = view == FST_FILM_ABOVE ? v[1] : sign * v[2];
    *towards = view == FST_FILM_ABOVE ? v[2] : -v[1];
}

/* A vector of the bead's body. */
static void seen(const double turn[3][3], const double body[3], fst_film_view view, double sign, double *x,
                 double *y, double *towards)
{
    double v[3];
    for (int i = 0; i < 3; ++i)
        v[i] = turn[i][0] * body[0] + turn[i][1] * body[1] + turn[i][2] * body[2];
    seen_from(view, sign, v, x, y, towards);
}

/* The poles as caps, the equator as a line, and marks at places without symmetry; each is drawn where it faces
 * the viewer. */
static void paint_marks(cairo_t *pen, const double turn[3][3], double radius, fst_film_view view, double sign)
{
    static const double marks[][3] = {{0.85, 0.0, 0.527}, {-0.5, 0.7, 0.51},   {0.1, -0.9, 0.424},
                                      {0.6, 0.62, -0.5},  {-0.8, -0.2, -0.57}, {0.3, -0.75, -0.59}};
    double x, y, towards;
    cairo_set_source_rgba(pen, 0.15, 0.15, 0.15, 0.8);
    cairo_set_line_width(pen, 0.07 * radius);
    int drawing = 0;
    for (int i = 0; i <= 72; ++i) {
        double angle = 2.0 * FST_PI * i / 72, body[3] = {cos(angle), sin(angle), 0.0};
        seen(turn, body, view, sign, &x, &y, &towards);
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
        seen(turn, marks[i], view, sign, &x, &y, &towards);
        if (towards <= 0.05)
            continue;
        cairo_arc(pen, radius * x, radius * y, 0.08 * radius, 0.0, 2.0 * FST_PI);
        cairo_fill(pen);
    }
    for (int pole = 1; pole >= -1; pole -= 2) {
        double body[3] = {0.0, 0.0, pole};
        seen(turn, body, view, sign, &x, &y, &towards);
        if (towards <= 0.0)
            continue;
        const double *colour = pole > 0 ? fst_pen_north : fst_pen_south;
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

/* The rim has the bead's colour, and gaps where it is in the air; or it tells what the contact does. */
static void paint_rim(cairo_t *pen, const fst_film_bead *bead)
{
    const double *rim = bead->colour ? bead->colour : rims[bead->contact], radius = bead->radius;
    const double dash = 2.0 * FST_PI * radius / 24.0;
    const int thin = !bead->colour && bead->contact == FST_CONTACT_UNTOLD;
    cairo_arc(pen, 0.0, 0.0, radius, 0.0, 2.0 * FST_PI);
    cairo_set_source_rgb(pen, rim[0], rim[1], rim[2]);
    cairo_set_line_width(pen, (thin ? 0.05 : 0.16) * radius);
    if (bead->colour && bead->flies) {
        cairo_set_line_cap(pen, CAIRO_LINE_CAP_BUTT);
        cairo_set_dash(pen, &dash, 1, 0.0);
    }
    cairo_stroke(pen);
    cairo_set_dash(pen, NULL, 0, 0.0);
}

static void paint_bead(cairo_t *pen, const fst_film_bead *bead, fst_film_view view, double sign)
{
    double radius = bead->radius;
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
    paint_marks(pen, bead->turn, radius, view, sign);
    cairo_restore(pen);
    paint_rim(pen, bead);
}

/* A dot where two beads touch. */
static void paint_touches(cairo_t *pen, const fst_film_frame *frame, fst_film_view view, double sign)
{
    for (int k = 0; k < frame->touch_count; ++k) {
        const fst_film_bead *a = &frame->beads[frame->touches[k][0]], *b = &frame->beads[frame->touches[k][1]];
        double place[3], x, y, towards;
        for (int i = 0; i < 3; ++i)
            place[i] = (b->radius * a->place[i] + a->radius * b->place[i]) / (a->radius + b->radius);
        seen_from(view, sign, place, &x, &y, &towards);
        cairo_arc(pen, x, y, 0.17 * fmin(a->radius, b->radius), 0.0, 2.0 * FST_PI);
        cairo_set_source_rgb(pen, 0.0, 0.0, 0.0);
        cairo_fill(pen);
    }
}

/* All beads, those behind others first, and their contacts. */
static void paint_beads(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame,
                        fst_film_view view)
{
    const double sign = sign_of(layout, view);
    int order[FST_BEADS_MANY];
    double near[FST_BEADS_MANY], x, y;
    for (int i = 0; i < frame->count; ++i) {
        double towards;
        int k = i;
        seen_from(view, sign, frame->beads[i].place, &x, &y, &towards);
        for (; k > 0 && near[k - 1] > towards; --k) {
            near[k] = near[k - 1];
            order[k] = order[k - 1];
        }
        near[k] = towards;
        order[k] = i;
    }
    for (int i = 0; i < frame->count; ++i) {
        const fst_film_bead *bead = &frame->beads[order[i]];
        seen_from(view, sign, bead->place, &x, &y, &near[0]);
        cairo_save(pen);
        cairo_translate(pen, x, y);
        paint_bead(pen, bead, view, sign);
        cairo_restore(pen);
    }
    paint_touches(pen, frame, view, sign);
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

/* The view from above, where the pen's origin is the middle of the picture. */
static void paint_above(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame, double reach)
{
    cairo_translate(pen, -frame->centre[0], -frame->centre[1]);
    if (layout->wave != 0.0)
        paint_wave(pen, layout, frame);
    if (layout->follows)
        paint_grid(pen, layout, frame->centre);
    paint_magnet(pen, layout, frame);
    paint_coils(pen, layout, FST_FILM_ABOVE);
    if (layout->body_count && !layout->follows) {
        cairo_set_source_rgb(pen, 0.35, 0.35, 0.35);
        cairo_set_line_width(pen, reach / 110.0);
        paint_sense(pen, 0.97 * reach, 0.15 * FST_PI, 0.32 * FST_PI, reach / 18.0);
    }
    cairo_new_path(pen);
    cairo_arc(pen, 0.0, 0.0, reach / 120.0, 0.0, 2.0 * FST_PI);
    cairo_set_source_rgb(pen, 0.3, 0.3, 0.3);
    cairo_fill(pen);
    for (int i = 0; i < frame->count && layout->view == FST_FILM_ABOVE; ++i)
        paint_trail(pen, layout, &frame->beads[i], 1.0);
    paint_beads(pen, layout, frame, FST_FILM_ABOVE);
}

/* A body of the magnet from the front, its poles the paler the more they point away. */
static void paint_slab(cairo_t *pen, const fst_part_shape *body, int is_round, double depth, double angle,
                       double sign)
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
    cairo_pattern_t *poles = upright ? cairo_pattern_create_linear(0.0, sign * low, 0.0, sign * high)
                                     : cairo_pattern_create_linear(sign * left, 0.0, sign * right, 0.0);
    const double *end = towards > 0.0 ? fst_pen_north : fst_pen_south,
                 *begin = towards > 0.0 ? fst_pen_south : fst_pen_north;
    cairo_pattern_add_color_stop_rgba(poles, 0.0, begin[0], begin[1], begin[2], 0.15 + 0.4 * fabs(towards));
    cairo_pattern_add_color_stop_rgba(poles, 1.0, end[0], end[1], end[2], 0.15 + 0.4 * fabs(towards));
    if (is_round)
        cairo_arc(pen, 0.5 * sign * (left + right), 0.5 * sign * (low + high), 0.5 * (right - left), 0.0,
                  2.0 * FST_PI);
    else
        cairo_rectangle(pen, sign * left, sign * low, sign * (right - left), sign * (high - low));
    cairo_set_source(pen, poles);
    cairo_fill(pen);
    cairo_pattern_destroy(poles);
}

static void paint_slabs(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame, double sign)
{
    for (int i = 0; i < layout->body_count; ++i) {
        const int fixed = layout->fixed >> i & 1;
        cairo_save(pen);
        if (!fixed)
            cairo_translate(pen, frame->magnet_place[0], 0.0);
        paint_slab(pen, &layout->bodies[i].seen, layout->round >> i & 1, layout->depth,
                   fixed ? 0.0 : frame->magnet_angle, sign);
        cairo_restore(pen);
    }
}

/* The plate, of a bowl its section through the axis, or the axis where there is none. */
static void paint_section(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame)
{
    const double far = frame->centre[0] + layout->reach;
    cairo_set_source_rgb(pen, 0.3, 0.3, 0.3);
    cairo_set_line_width(pen, 0.4);
    if (layout->plate == FST_PLATE_FLAT) {
        cairo_move_to(pen, frame->centre[0] - layout->reach, 0.0);
        cairo_line_to(pen, far, 0.0);
    } else if (layout->plate == FST_PLATE_BOWL) {
        cairo_new_path(pen);
        cairo_arc(pen, 0.0, layout->bowl, layout->bowl, 1.0 * FST_PI, 2.0 * FST_PI);
    } else {
        const double dash = layout->reach / 40.0;
        cairo_set_line_width(pen, layout->reach / 300.0);
        cairo_set_dash(pen, &dash, 1, 0.0);
        const double middle = sign_of(layout, FST_FILM_FRONT) * layout->middle;
        cairo_move_to(pen, 0.0, middle - 0.95 * layout->reach);
        cairo_line_to(pen, 0.0, middle + 0.95 * layout->reach);
    }
    cairo_stroke(pen);
    cairo_set_dash(pen, NULL, 0, 0.0);
}

/* The view from the front, where the pen's origin is the axis at the plate's height. */
static void paint_front(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame)
{
    const double sign = sign_of(layout, FST_FILM_FRONT);
    paint_slabs(pen, layout, frame, sign);
    paint_coils(pen, layout, FST_FILM_FRONT);
    paint_section(pen, layout, frame);
    for (int i = 0; i < frame->count && layout->view == FST_FILM_FRONT; ++i)
        paint_trail(pen, layout, &frame->beads[i], sign);
    paint_beads(pen, layout, frame, FST_FILM_FRONT);
}

static void paint_whole(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame, double scale)
{
    cairo_save(pen);
    cairo_translate(pen, 0.5 * layout->width, 0.5 * layout->height);
    cairo_scale(pen, scale, -scale);
    if (layout->view == FST_FILM_ABOVE) {
        paint_above(pen, layout, frame, layout->reach);
    } else {
        cairo_translate(pen, 0.0, -sign_of(layout, FST_FILM_FRONT) * layout->middle);
        paint_front(pen, layout, frame);
    }
    cairo_restore(pen);
}

/* ------------------------------------------------------------------ around it, in pixels */

/* The small picture: the plate from the front, the magnet's slab below it, and the beads on it; or without a plate all
 * from above. */
static void paint_small(cairo_t *pen, const fst_film_layout *layout, const fst_film_frame *frame)
{
    const int from_front = layout->view == FST_FILM_ABOVE;
    double width = 0.30 * layout->width, scale = width / (2.0 * layout->small_reach);
    double left = 12.0, up = from_front ? 2.6 * layout->radius + layout->top : layout->small_reach;
    double down = layout->depth - layout->low + 0.3 * (layout->high - layout->low);
    down = fmin(down, 0.3 * layout->height / scale - up); /* of a deep magnet the upper part */
    if (!from_front)
        down = layout->small_reach;
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
    if (from_front) {
        cairo_translate(pen, -frame->centre[0], 0.0);
        paint_front(pen, layout, frame);
    } else {
        paint_above(pen, layout, frame, layout->small_reach);
    }
    cairo_restore(pen);
    cairo_set_source_rgb(pen, 0.35, 0.35, 0.35);
    char words[64];
    const fst_contact_shown contact = frame->beads[0].contact; /* untold of several */
    (void)snprintf(words, sizeof words, "%s%s", layout->seen_as,
                   frame->count == 1 ? contact_words[contact] : "");
    fst_pen_write(pen, left + 2.0, top - 6.0, 0.024 * layout->height, words);
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

static fst_status told(cairo_status_t status, fst_error *error)
{
    return status == CAIRO_STATUS_SUCCESS
               ? FST_OK
               : fst_fail(error, status == CAIRO_STATUS_NO_MEMORY ? FST_NO_MEMORY : FST_IO, "film",
                          "a frame cannot be painted: %s", cairo_status_to_string(status));
}

/* After a failure a pen draws no more, and remembers it. */
static fst_status paint(fst_film_canvas *canvas, const fst_film_layout *layout, const fst_film_frame *frame,
                        fst_error *error)
{
    cairo_t *pen = canvas->pen;
    int side = layout->width < layout->height ? layout->width : layout->height;
    /* It is small enough for the bead to pass it without being hidden. */
    double scale = 0.84 * side / (2.0 * layout->reach);
    cairo_set_source_rgb(pen, 1.0, 1.0, 1.0);
    cairo_paint(pen);
    paint_whole(pen, layout, frame, scale);
    paint_small(pen, layout, frame);
    fst_pen_scale_bar(pen, layout, scale);
    if (layout->colour_label)
        fst_pen_colour_bar(pen, layout);
    else
        fst_pen_bead_key(pen, layout, frame);
    fst_pen_key(pen, layout);
    cairo_set_source_rgb(pen, 0.13, 0.13, 0.13);
    fst_pen_write(pen, 16.0, 14.0 + 0.028 * layout->height, 0.028 * layout->height, layout->title);
    fst_pen_write(pen, 16.0, 22.0 + 0.054 * layout->height, 0.026 * layout->height, frame->clock);
    fst_pen_write(pen, 16.0, 27.0 + 0.080 * layout->height, 0.026 * layout->height, layout->slower);
    return told(cairo_status(pen), error);
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
    return told(status == CAIRO_STATUS_WRITE_ERROR ? CAIRO_STATUS_SUCCESS : status, error);
}

FST_API extern const fst_film_module_table fst_film_module;
const fst_film_module_table fst_film_module = {FST_VERSION_STRING, open_canvas, paint, pixels,
                                               write_png,          close_canvas};
