/* path.c - what a figure of the bead's path shows: the curve, its colours, the arrows of the moment, the square
 * of the plate. */
#include "draw/view.h"

#include "base/error.h"
#include "draw/chart.h"
#include "draw/poles.h"

#include <string.h>

enum {
    ARROWS = 110,        /* about as many arrows as a picture can bear */
    ARROWS_ALONG = 18,   /* and as a path from side to side can */
    MOST_SAMPLES = 6000, /* more samples would only make the file larger */
    MOST_PARTS = 8       /* pieces of the path between two samples */
};

typedef struct path_data {
    const double *t, *omega, *x, *y, *vx, *vy, *n_x, *n_y, *alpha, *bead_angle, *colour;
    int turns; /* the frame does */
} path_data;

static fst_status find_columns(const fst_view *view, int from_magnet, path_data *d, fst_error *error)
{
    d->turns = from_magnet;
    const fst_status status = fst_view_columns(view, error, "t", &d->t, "omega", &d->omega, "alpha", &d->alpha,
                                               "Phi", &d->bead_angle, NULL);
    if (status != FST_OK)
        return status;
    return from_magnet ? fst_view_columns(view, error, "X", &d->x, "Y", &d->y, "vX", &d->vx, "vY", &d->vy, "nX",
                                          &d->n_x, "nY", &d->n_y, NULL)
                       : fst_view_columns(view, error, "x", &d->x, "y", &d->y, "vx", &d->vx, "vy", &d->vy,
                                          "n_x", &d->n_x, "n_y", &d->n_y, NULL);
}

/* ------------------------------------------------------------------ the square */

/* Refuse a zoom outside of everything there is: it would show an empty frame. */
static fst_status check_zoom(const fst_view *view, const path_data *d, const double *zoom, fst_error *error)
{
    const double millimetres = 1e3 * view->table->params.magnet_half_length;
    double least[2], greatest[2];
    const double *where[2] = {d->x, d->y};
    int beside = 0;
    for (int i = 0; i < 2; ++i) {
        fst_view_range(view, where[i], &least[i], &greatest[i]);
        least[i] *= millimetres;
        greatest[i] *= millimetres;
        beside = beside || zoom[2 * i] > greatest[i] || zoom[2 * i + 1] < least[i];
    }
    return beside ? fst_fail(error, FST_BAD_INPUT, "fst_figure_options.zoom",
                             "the zoom lies outside of the path, which is within %.4g,%.4g,%.4g,%.4g (mm)",
                             least[0], greatest[0], least[1], greatest[1])
                  : FST_OK;
}

/* The square of the plate that is shown, in the figure's unit: the zoom, or everything about the axis. */
static fst_status choose_box(const fst_view *view, const path_data *d, double magnet_reach,
                             const fst_figure_options *options, double box[4], fst_error *error)
{
    const double *zoom = options->zoom;
    if (!isnan(zoom[0]) && !isnan(zoom[1]) && !isnan(zoom[2]) && !isnan(zoom[3])) {
        if (!(zoom[0] < zoom[1] && zoom[2] < zoom[3]))
            return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.zoom",
                            "an empty zoom: it is x0 x1 y0 y1 in mm");
        for (int i = 0; i < 4; ++i)
            box[i] = zoom[i] / (1e3 * view->table->params.magnet_half_length) * view->length;
        return check_zoom(view, d, zoom, error);
    }
    double least, greatest, reach = 0.0;
    fst_view_range(view, d->x, &least, &greatest);
    reach = fmax(reach, fmax(-least, greatest));
    fst_view_range(view, d->y, &least, &greatest);
    reach = fmax(reach, fmax(-least, greatest));
    /* Leave room for the magnet's outline too.  Beside a magnet in tesla l means nothing. */
    const int real = fst_magnet_in_tesla(&view->table->params) && magnet_reach > 0.0;
    reach = fmax(1.12 * reach, real ? 0.0 : 1.12) * view->length;
    reach = fmax(reach, 1.05 * magnet_reach);
    box[0] = box[2] = -reach;
    box[1] = box[3] = reach;
    return FST_OK;
}

/* How far from the axis a magnet of poles reaches. */
static double reach_of_magnet(const fst_path_picture *picture)
{
    double reach = 0.0;
    for (const fst_picture_line *line = picture->lines; line < picture->lines + picture->line_count; ++line)
        for (size_t i = 0; i < line->count && !line->is_ground; ++i)
            if (isfinite(line->x[i]))
                reach = fmax(reach, hypot(line->x[i], line->y[i]));
    return reach;
}

/* The magnet where it is when the path begins; 0: no memory. */
static int put_magnet(fst_path_picture *picture, const fst_view *view, const path_data *d)
{
    const fst_params *p = &view->table->params;
    const double turned = d->turns ? 0.0 : d->alpha[view->first] - d->bead_angle[view->first];
    if (p->magnet_shape != FST_MAGNET_LINES)
        return fst_magnet_lines(p, view->length, turned, d->turns ? "below the plate" : "when the path begins",
                                picture->lines, &picture->line_count, &picture->memory);
    picture->line_count = 1;
    return fst_magnet_outline(p, view->length, turned,
                              d->turns ? "outline of the magnet's lines"
                              : p->drive_waveform != FST_WAVEFORM_STEADY
                                  ? "outline of the magnet's lines at the beginning"
                                  : "outline of the magnet's lines at the beginning; it turns anticlockwise",
                              &picture->lines[0], &picture->memory);
}

static int is_within(const double box[4], double x, double y)
{
    return x >= box[0] && x <= box[1] && y >= box[2] && y <= box[3];
}

/* ------------------------------------------------------------------ curve and arrows */

/* Velocities as they are seen: from a turning magnet, those of a bead at rest turn the other way. */
static double seen_vx(const path_data *d, size_t row)
{
    return d->vx[row] + (d->turns ? d->omega[row] * d->y[row] : 0.0);
}

static double seen_vy(const path_data *d, size_t row)
{
    return d->vy[row] - (d->turns ? d->omega[row] * d->x[row] : 0.0);
}

/* Where samples are few, join them by smooth curves through their velocities; where they are many, skip some.
 */
static void put_path(fst_path_picture *picture, const fst_view *view, const path_data *d, double factor)
{
    const size_t rows = view->last - view->first, stride = rows / MOST_SAMPLES + 1;
    size_t parts = MOST_SAMPLES / rows;
    parts = parts < 1 ? 1 : parts > MOST_PARTS ? MOST_PARTS : parts;
    for (size_t row = view->first; row < view->last; row += stride) {
        const size_t next = row + 1 < view->last ? row + 1 : row;
        const double h = d->t[next] - d->t[row];
        for (size_t i = 0; i < (next > row ? parts : 1); ++i) {
            const double part = (double)i / (double)parts;
            const double x =
                fst_view_between(d->x[row], seen_vx(d, row), d->x[next], seen_vx(d, next), h, part);
            const double y =
                fst_view_between(d->y[row], seen_vy(d, row), d->y[next], seen_vy(d, next), h, part);
            const double colour = d->colour[row] + part * (d->colour[next] - d->colour[row]);
            picture->x[picture->count] = x * view->length;
            picture->y[picture->count] = y * view->length;
            picture->colour[picture->count++] = factor * colour;
        }
    }
}

/* Arrows of the moment's horizontal part, each as long as that part.  A zoom has as many arrows per length of
 * path as the picture can bear. */
static void put_arrows(fst_path_picture *picture, const fst_view *view, const path_data *d)
{
    const double *box = picture->box;
    size_t inside = 0;
    double x_before = 0.0, y_before = 0.0, length = 0.0;
    for (size_t row = view->first; row < view->last; ++row) {
        double x = d->x[row] * view->length, y = d->y[row] * view->length;
        if (is_within(box, x, y)) {
            length += inside ? hypot(x - x_before, y - y_before) : 0.0;
            ++inside;
        }
        x_before = x;
        y_before = y;
    }
    /* A path that is short in the picture would vanish below so many. */
    const double fitting = 1.0 + ARROWS_ALONG * length / (box[1] - box[0]);
    const size_t stride = inside / (fitting < ARROWS ? (size_t)fitting : ARROWS) + 1;
    const double scale = FST_LONGEST_ARROW * (box[1] - box[0]);
    for (size_t row = view->first; row < view->last; row += stride) {
        double *to = picture->arrows + 4 * picture->arrow_count++;
        to[0] = d->x[row] * view->length;
        to[1] = d->y[row] * view->length;
        to[2] = scale * d->n_x[row];
        to[3] = scale * d->n_y[row];
    }
}

/* ------------------------------------------------------------------ all of it */

fst_colour_range fst_colours_between(const char *name, double least, double greatest)
{
    int both_signs = least < 0.0 && greatest > 0.0;
    if (strcmp(name, "n_z") == 0) {
        both_signs = 1;
        least = -1.0;
        greatest = 1.0;
    } else if (both_signs) {
        greatest = fmax(greatest, -least);
        least = -greatest;
    } else if (least >= 0.0 && least < 0.25 * greatest) {
        least = 0.0;
    }
    if (!(greatest > least)) {
        const double span = fmax(fabs(least) * 1e-3, 1e-12);
        least -= span;
        greatest += span;
    }
    return (fst_colour_range){both_signs ? FST_PALETTE_DIVERGING : FST_PALETTE_LINE, least, greatest};
}

static void put_words(fst_path_picture *picture, const fst_view *view, int from_magnet)
{
    char unit[16];
    fst_unit_symbols(view->length_unit, unit, sizeof unit);
    (void)snprintf(picture->title, sizeof picture->title, "%s",
                   from_magnet ? "Path of the bead as seen from the magnet"
                               : "Path of the bead over the plate, from above");
    memcpy(picture->about, view->about, sizeof picture->about);
    if (view->table->params.magnet_shape == FST_MAGNET_GRID && !view->table->params.magnet_map) {
        const size_t used = strlen(picture->about);
        (void)snprintf(picture->about + used, sizeof picture->about - used,
                       "; without the poles of %.60s, which is not there", view->table->params.magnet_file);
    }
    (void)snprintf(picture->x_label, sizeof picture->x_label, "%s (%s)",
                   from_magnet ? "X, along the magnet" : "x", unit);
    (void)snprintf(picture->y_label, sizeof picture->y_label, "%s (%s)", from_magnet ? "Y" : "y", unit);
}

static int make_room(fst_path_picture *picture, size_t rows)
{
    const size_t points = rows * (MOST_SAMPLES / rows < MOST_PARTS ? MOST_SAMPLES / rows + 1 : MOST_PARTS);
    double *memory = fst_keep(&picture->memory, (3 * points + 4 * rows) * sizeof *memory);
    if (!memory)
        return 0;
    picture->x = memory;
    picture->y = memory + points;
    picture->colour = memory + 2 * points;
    picture->arrows = memory + 3 * points;
    return 1;
}

fst_status fst_path_picture_of(const fst_table *table, const fst_figure_options *options,
                               fst_path_picture *picture, fst_error *error)
{
    fst_view view;
    path_data d;
    const fst_column_info *info;
    double least, greatest;
    *picture = (fst_path_picture){.count = 0};
    fst_status status = fst_view_of(&view, table, options, error);
    if (status == FST_OK)
        status = find_columns(&view, options->from_magnet, &d, error);
    if (status == FST_OK)
        status = fst_view_column(&view, options->colour ? options->colour : "n_z", &d.colour, &info, error);
    if (status == FST_OK && !(make_room(picture, view.last - view.first) && put_magnet(picture, &view, &d)))
        status = fst_fail(error, FST_NO_MEMORY, "fst_path_picture_of", "out of memory");
    if (status == FST_OK)
        status = choose_box(&view, &d, reach_of_magnet(picture), options, picture->box, error);
    if (status != FST_OK)
        return status;
    const fst_quantity shown = fst_view_quantity(&view, info);
    memcpy(picture->colour_label, shown.label, sizeof picture->colour_label);
    fst_view_range(&view, d.colour, &least, &greatest);
    picture->colours = fst_colours_between(info->name, shown.factor * least, shown.factor * greatest);
    picture->begins_inside =
        is_within(picture->box, view.length * d.x[view.first], view.length * d.y[view.first]);
    put_words(picture, &view, options->from_magnet);
    put_path(picture, &view, &d, shown.factor);
    if (options->arrows)
        put_arrows(picture, &view, &d);
    return FST_OK;
}

void fst_path_picture_free(fst_path_picture *picture)
{
    fst_keep_free(picture->memory);
    *picture = (fst_path_picture){.count = 0};
}
