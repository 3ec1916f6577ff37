/* figure_path.c - the bead's path over the plate (the paper's Figs. 7, 8, 9). */
#include "draw/figure_trajectory.h"

#include "base/error.h"
#include "draw/poles.h"
#include "draw/style.h"
#include "draw/view.h"

#include <string.h>

enum {
    SIDE = 400, /* of the square of plate in the figure, in pixels */
    LEFT = 58,
    AXIS = 54,  /* below the square, for its numbers and label */
    SCALE = 64, /* for the scale of colours */
    INSET = 190,
    ARROWS = 110,        /* about as many arrows as a picture can bear */
    ARROWS_ALONG = 18,   /* and as a path from side to side can */
    MOST_SAMPLES = 6000, /* more samples would only make the file larger */
    MOST_PARTS = 8       /* pieces of the path between two samples */
};

static const double LONGEST_ARROW = 0.07; /* of a horizontal moment, in sides of the square */

typedef struct path_columns {
    const double *t, *x, *y, *vx, *vy, *n_x, *n_y, *n_alpha, *n_z, *alpha, *bead_angle, *colour;
    const fst_column_info *colour_info;
    fst_quantity shown; /* how the colour is shown */
} path_columns;

static fst_status find_columns(const fst_view *view, const char *colour, path_columns *columns,
                               fst_error *error)
{
    fst_status status = fst_view_columns(view, error, "t", &columns->t, "x", &columns->x, "y", &columns->y,
                                         "vx", &columns->vx, "vy", &columns->vy, "n_x", &columns->n_x, "n_y",
                                         &columns->n_y, "n_alpha", &columns->n_alpha, "n_z", &columns->n_z,
                                         "alpha", &columns->alpha, "Phi", &columns->bead_angle, NULL);
    if (status == FST_OK)
        status = fst_view_column(view, colour ? colour : "n_z", &columns->colour, &columns->colour_info, error);
    if (status == FST_OK)
        columns->shown = fst_view_quantity(view, columns->colour_info);
    return status;
}

/* ------------------------------------------------------------------ frame */

/* Refuse a zoom outside of everything there is: it would show an empty frame. */
static fst_status check_zoom(const fst_view *view, const path_columns *columns, const double *zoom,
                             fst_error *error)
{
    const double millimetres = 1e3 * view->table->params.magnet_half_length;
    double least[2], greatest[2];
    const double *where[2] = {columns->x, columns->y};
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
static fst_status choose_box(const fst_view *view, const path_columns *columns, double magnet_reach,
                             const fst_figure_options *options, double box[4], fst_error *error)
{
    const double *zoom = options->zoom;
    if (!isnan(zoom[0]) && !isnan(zoom[1]) && !isnan(zoom[2]) && !isnan(zoom[3])) {
        if (!(zoom[0] < zoom[1] && zoom[2] < zoom[3]))
            return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.zoom",
                            "an empty zoom: it is x0 x1 y0 y1 in mm");
        for (int i = 0; i < 4; ++i)
            box[i] = zoom[i] / (1e3 * view->table->params.magnet_half_length) * view->length;
        return check_zoom(view, columns, zoom, error);
    }
    double least, greatest, reach = 0.0;
    fst_view_range(view, columns->x, &least, &greatest);
    reach = fmax(reach, fmax(-least, greatest));
    fst_view_range(view, columns->y, &least, &greatest);
    reach = fmax(reach, fmax(-least, greatest));
    /* Leave room for the magnet's outline too.  Beside a magnet in tesla l means nothing. */
    const int real = fst_magnet_in_tesla(&view->table->params) && magnet_reach > 0.0;
    reach = fmax(1.12 * reach, real ? 0.0 : 1.12) * view->length;
    reach = fmax(reach, 1.05 * magnet_reach);
    box[0] = box[2] = -reach;
    box[1] = box[3] = reach;
    return FST_OK;
}

/* The magnet where it is when the path begins: of lines of dipoles their faint outline, else the poles. */
typedef struct path_magnet {
    fst_magnet_body bodies[FST_PARTS_MAX];
    int count, bar, poles;
    double reach; /* how far from the axis it reaches, in the figure's unit */
} path_magnet;

static void find_magnet(const fst_view *view, path_magnet *magnet)
{
    const fst_params *p = &view->table->params;
    magnet->count = fst_magnet_bodies(p, view->length / p->magnet_half_length, 1.0, magnet->bodies);
    magnet->bar = p->magnet_shape == FST_MAGNET_LINES;
    for (int i = 0; i < magnet->count && !magnet->bar; ++i)
        for (int k = 0; k < magnet->bodies[i].seen.count; ++k)
            magnet->reach = fmax(magnet->reach, hypot(magnet->bodies[i].seen.corners[k][0],
                                                      magnet->bodies[i].seen.corners[k][1]));
}

static void write_magnet(fst_figure_file *figure, const fst_view *view, const path_columns *columns,
                         path_magnet *magnet)
{
    const double turned = columns->alpha[view->first] - columns->bead_angle[view->first];
    const double cosine = cos(turned), sine = sin(turned);
    const fst_part_shape *seen = &magnet->bodies[0].seen;
    if (!magnet->bar)
        magnet->poles = fst_figure_write_poles(figure, magnet->bodies, magnet->count, turned);
    else
        fst_figure_block(figure, "magnet", "x y: the outline of the magnet's lines when the path begins");
    for (int i = 0; magnet->bar && i <= seen->count; ++i) {
        const double *corner = seen->corners[i % seen->count];
        (void)fprintf(figure->data, "%.6g %.6g\n", corner[0] * cosine - corner[1] * sine,
                      corner[0] * sine + corner[1] * cosine);
    }
}

/* Where the parts of the figure lie, in pixels from above. */
typedef struct path_layout {
    int top, scale, inset, height;
} path_layout;

static path_layout lay_out(const fst_legend *legend, int with_inset)
{
    path_layout l = {.top = fst_legend_head(legend) + 6};
    l.scale = l.top + SIDE + AXIS;
    l.inset = l.scale + SCALE;
    l.height = l.inset + (with_inset ? INSET : 0) + fst_legend_foot(legend);
    return l;
}

static void write_frame(fst_figure_file *figure, const fst_view *view, const path_layout *l,
                        const double box[4])
{
    const double frame[4] = {LEFT, LEFT + SIDE, l->top, l->top + SIDE};
    char unit[16], label[40];
    fst_figure_place(figure, l->height, frame);
    (void)fprintf(figure->script,
                  "set size ratio -1\nset xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\nunset key\n", box[0],
                  box[1], box[2], box[3]);
    fst_unit_symbols(view->length_unit, unit, sizeof unit);
    (void)snprintf(label, sizeof label, "x (%s)", unit);
    fst_figure_axis_label(figure, l->height, FST_SIDE_BELOW, label, FST_COLOUR_BLACK, frame);
    label[0] = 'y';
    fst_figure_axis_label(figure, l->height, FST_SIDE_LEFT, label, FST_COLOUR_BLACK, frame);
}

/* ------------------------------------------------------------------ colour */

static void write_colour(fst_figure_file *figure, const fst_view *view, const path_columns *columns,
                         const path_layout *l)
{
    double least, greatest;
    fst_view_range(view, columns->colour, &least, &greatest);
    least *= columns->shown.factor;
    greatest *= columns->shown.factor;
    int both_signs = least < 0.0 && greatest > 0.0;
    if (!strcmp(columns->colour_info->name, "n_z")) {
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
        double span = fmax(fabs(least) * 1e-3, 1e-12);
        least -= span;
        greatest += span;
    }
    fst_figure_palette(figure, both_signs ? FST_PALETTE_DIVERGING : FST_PALETTE_LINE);
    (void)fprintf(figure->script, "set cbrange [%.9g:%.9g]\n", least, greatest);
    fst_figure_colour_scale(figure, l->height, columns->shown.label,
                            (const double[4]){LEFT, LEFT + SIDE, l->scale, l->scale + 12});
}

/* ------------------------------------------------------------------ data */

/* Where samples are few, join them by smooth curves through their velocities; where they are many,
 * skip some. */
static void write_path(fst_figure_file *figure, const fst_view *view, const path_columns *columns)
{
    size_t rows = view->last - view->first, stride = rows / MOST_SAMPLES + 1, parts = MOST_SAMPLES / rows;
    parts = parts < 1 ? 1 : parts > MOST_PARTS ? MOST_PARTS : parts;
    fst_figure_block(figure, "path", "x y colour");
    for (size_t row = view->first; row < view->last; row += stride) {
        size_t next = row + 1 < view->last ? row + 1 : row;
        double h = columns->t[next] - columns->t[row];
        for (size_t i = 0; i < (next > row ? parts : 1); ++i) {
            double part = (double)i / (double)parts;
            double x = fst_view_between(columns->x[row], columns->vx[row], columns->x[next], columns->vx[next],
                                        h, part);
            double y = fst_view_between(columns->y[row], columns->vy[row], columns->y[next], columns->vy[next],
                                        h, part);
            double colour = columns->colour[row] + part * (columns->colour[next] - columns->colour[row]);
            (void)fprintf(figure->data, "%.7g %.7g %.9g\n", x * view->length, y * view->length,
                          columns->shown.factor * colour);
        }
    }
}

/* Draw the moment in the local frame, seen from outside along -e_r, below the path. */
static void write_inset(fst_figure_file *figure, const fst_view *view, const path_columns *columns,
                        const path_layout *l)
{
    const double frame[4] = {LEFT, LEFT + INSET - 50, l->inset + 4, l->inset + INSET - 46};
    fst_figure_block(figure, "local", "n_alpha n_z: the moment in the local frame");
    for (size_t row = view->first; row < view->last; ++row)
        (void)fprintf(figure->data, "%.6g %.6g\n", columns->n_alpha[row], columns->n_z[row]);
    (void)fputs("unset colorbox\nunset label\n", figure->script);
    fst_figure_place(figure, l->height, frame);
    fst_figure_axis_label(figure, l->height, FST_SIDE_BELOW, "n_α", FST_COLOUR_BLACK, frame);
    fst_figure_axis_label(figure, l->height, FST_SIDE_LEFT, "n_z", FST_COLOUR_BLACK, frame);
    (void)fprintf(figure->script,
                  "set xrange [-1.1:1.1]\nset yrange [-1.1:1.1]\nset tics 1 font ',11' format '%%g'\n"
                  "set object 2 circle at 0,0 size 1 front fs empty border lc rgb '#b8b8b8'\n"
                  "set label 'The moment n in the local frame,' at graph 1.15,0.85 font ',12'\n"
                  "set label 'seen from outside along −e_r.' at graph 1.15,0.72 font ',12'\n"
                  "set label 'Grey: the unit sphere''s outline.' at graph 1.15,0.59 font ',12'\n"
                  "plot data index 'local' using 1:2 with lines lc rgb '%s' lw 1.6 notitle\n",
                  fst_colour_code(FST_COLOUR_BLUE));
}

static int is_within(const double box[4], double x, double y)
{
    return x >= box[0] && x <= box[1] && y >= box[2] && y <= box[3];
}

/* Arrows of the moment's horizontal part, each as long as that part.  A zoom has as many arrows per length of
 * path as the picture can bear. */
static void write_arrows(fst_figure_file *figure, const fst_view *view, const path_columns *columns,
                         const double box[4])
{
    size_t inside = 0;
    double x_before = 0.0, y_before = 0.0, length = 0.0;
    for (size_t row = view->first; row < view->last; ++row) {
        double x = columns->x[row] * view->length, y = columns->y[row] * view->length;
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
    double scale = LONGEST_ARROW * (box[1] - box[0]);
    fst_figure_block(figure, "moment", "x y dx dy: the horizontal part of n");
    for (size_t row = view->first; row < view->last; row += stride)
        (void)fprintf(figure->data, "%.6g %.6g %.5g %.5g\n", columns->x[row] * view->length,
                      columns->y[row] * view->length, scale * columns->n_x[row], scale * columns->n_y[row]);
}

/* ------------------------------------------------------------------ the figure */

static fst_legend make_legend(const fst_view *view, const fst_figure_options *options,
                              const path_columns *columns, const double box[4], const path_magnet *magnet)
{
    fst_legend legend = fst_view_legend(view, "Path of the bead over the plate, from above");
    if (!magnet->bar)
        fst_legend_add_poles(&legend, magnet->bodies, magnet->count, "when the path begins");
    else
        fst_legend_add(&legend, FST_SAMPLE_LINE, "lc rgb '#b4b4b4' lw 1",
                       "outline of the magnet's lines at the beginning; it turns anticlockwise");
    if (is_within(box, view->length * columns->x[view->first], view->length * columns->y[view->first]))
        fst_legend_add(&legend, FST_SAMPLE_POINT, "pt 6 ps 1 lw 2 lc rgb '#222222'",
                       "the bead at the beginning");
    if (options->arrows) {
        fst_legend_add(&legend, FST_SAMPLE_ARROW, "lc rgb '#8a8a8a' lw 0.8",
                       "horizontal part of the moment n; so long where n is horizontal");
        legend.entries[legend.count - 1].length = LONGEST_ARROW * SIDE;
    }
    return legend;
}

static void write_plots(fst_figure_file *figure, const path_magnet *magnet, const fst_figure_options *options)
{
    fputs("plot \\\n", figure->script);
    fst_figure_plot_poles(figure->script, magnet->poles);
    if (magnet->bar)
        fputs("     data index 'magnet' using 1:2 with filledcurves closed fc rgb '#f4f4f4' notitle, \\\n"
              "     data index 'magnet' using 1:2 with lines lc rgb '#b4b4b4' lw 1 notitle, \\\n",
              figure->script);
    if (options->arrows)
        fputs("     data index 'moment' using 1:2:3:4 with vectors head filled size screen 0.010,18 lc rgb "
              "'#8a8a8a' lw 0.8 notitle, \\\n",
              figure->script);
    fputs("     data index 'path' using 1:2:3 with lines lc palette lw 2.2 notitle, \\\n"
          "     data index 'path' using 1:2 every ::0::0 with points pt 6 ps 1 lw 2 lc rgb '#222222' notitle\n",
          figure->script);
}

fst_status fst_figure_path(const fst_table *table, const char *out, const fst_figure_options *options,
                           fst_error *error)
{
    fst_view view;
    path_columns columns = {0};
    double box[4] = {0};
    fst_figure_options asked = *options;
    if (asked.units == FST_SHOWN_AS_GIVEN)
        asked.units = FST_SHOWN_LAB;
    fst_status status = fst_view_of(&view, table, &asked, 2.0, 30.0, error);
    if (status == FST_OK)
        status = find_columns(&view, options->colour, &columns, error);
    path_magnet magnet = {.count = 0};
    if (status == FST_OK)
        find_magnet(&view, &magnet);
    if (status == FST_OK)
        status = choose_box(&view, &columns, magnet.reach, options, box, error);
    if (status != FST_OK)
        return status;
    const fst_legend legend = make_legend(&view, options, &columns, box, &magnet);
    const path_layout l = lay_out(&legend, options->inset);
    fst_figure_file figure;
    status = fst_figure_begin(&figure, out, FST_FIGURE_WIDTH, l.height, error);
    if (status != FST_OK)
        return status;
    write_magnet(&figure, &view, &columns, &magnet);
    write_path(&figure, &view, &columns);
    fst_figure_panels(&figure);
    write_frame(&figure, &view, &l, box);
    write_colour(&figure, &view, &columns, &l);
    if (options->arrows)
        write_arrows(&figure, &view, &columns, box);
    write_plots(&figure, &magnet, options);
    if (options->inset)
        write_inset(&figure, &view, &columns, &l);
    fst_legend_write(&figure, &legend, l.height);
    return fst_figure_finish(&figure, error);
}
