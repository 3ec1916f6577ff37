/* figure_path.c - the bead's path over the plate (the paper's Figs. 7, 8, 9). */
#include "draw/figure_trajectory.h"

#include "base/error.h"
#include "draw/style.h"
#include "draw/view.h"

#include <string.h>

enum {
    WIDTH = 690, /* width of the figure, and of the square of plate in it, in pixels */
    HEIGHT = 705,
    SIDE = 510,
    LEFT = 70,
    TOP = 45,
    ARROWS = 170,        /* about as many arrows as a picture can bear */
    MOST_SAMPLES = 6000, /* more samples would only make the file larger */
    MOST_PARTS = 8       /* pieces of the path between two samples */
};

/* What a colour means, for the columns that people look at most.  Others are labelled by name and unit. */
static const struct {
    const char *column, *label;
} colour_labels[] = {
    {"n_z", "n_z"},
    {"slip", "slip |V| of the contact point (ℓγ), in proportion to friction"},
    {"sticking", "contact: 1 sticks, 0 slips"},
    {"z", "height over the plate (ℓ)"},
    {"friction_use", "friction over what static friction could take, |f|/(μ_s N)"},
    {"angle", "angle between n and B (degrees)"},
    {"B", "|B| (B_0)"},
    {"r", "r (ℓ)"},
};

typedef struct path_columns {
    const double *t, *x, *y, *vx, *vy, *n_x, *n_y, *n_alpha, *n_z, *alpha, *bead_angle, *colour;
    const fst_column_info *colour_info;
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
    return status;
}

/* ------------------------------------------------------------------ frame */

/* Refuse a zoom outside of everything there is: it would show an empty frame. */
static fst_status check_zoom(const fst_view *view, const path_columns *columns, const double *zoom,
                             fst_error *error)
{
    double least[2], greatest[2];
    const double *where[2] = {columns->x, columns->y};
    int beside = 0;
    for (int i = 0; i < 2; ++i) {
        fst_view_range(view, where[i], &least[i], &greatest[i]);
        least[i] *= view->millimetres;
        greatest[i] *= view->millimetres;
        beside = beside || zoom[2 * i] > greatest[i] || zoom[2 * i + 1] < least[i];
    }
    return beside ? fst_fail(error, FST_BAD_INPUT, "fst_figure_options.zoom",
                             "the zoom lies outside of the path, which is within %.4g,%.4g,%.4g,%.4g (mm)",
                             least[0], greatest[0], least[1], greatest[1])
                  : FST_OK;
}

/* The square of the plate that is shown, in mm: the zoom, or everything about the axis. */
static fst_status choose_box(const fst_view *view, const path_columns *columns,
                             const fst_figure_options *options, double box[4], fst_error *error)
{
    const double *zoom = options->zoom;
    if (!isnan(zoom[0]) && !isnan(zoom[1]) && !isnan(zoom[2]) && !isnan(zoom[3])) {
        if (!(zoom[0] < zoom[1] && zoom[2] < zoom[3]))
            return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.zoom",
                            "an empty zoom: it is x0 x1 y0 y1 in mm");
        memcpy(box, zoom, 4 * sizeof *box);
        return check_zoom(view, columns, zoom, error);
    }
    double least, greatest, reach = 0.0;
    fst_view_range(view, columns->x, &least, &greatest);
    reach = fmax(reach, fmax(-least, greatest));
    fst_view_range(view, columns->y, &least, &greatest);
    reach = fmax(reach, fmax(-least, greatest));
    /* Leave room for the magnet's outline too. */
    reach = fmax(1.12 * reach, 1.12) * view->millimetres;
    box[0] = box[2] = -reach;
    box[1] = box[3] = reach;
    return FST_OK;
}

/* Of a magnet that is another source than the bar of lines the figure does not know the outline. */
static int has_outline(const fst_view *view)
{
    return view->table->params.magnet_shape == FST_MAGNET_LINES;
}

/* Draw the bar of lines where it is when the path begins: a faint rectangle. */
static void draw_magnet(fst_figure_file *figure, const fst_view *view, const path_columns *columns)
{
    double turned = columns->alpha[view->first] - columns->bead_angle[view->first];
    double length = view->millimetres, width = 1e3 * view->table->params.magnet_width / 2.0;
    double cosine = cos(turned), sine = sin(turned);
    static const double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    fst_figure_block(figure, "magnet", "x/mm y/mm: the magnet when the path begins");
    for (int i = 0; i <= 4; ++i) {
        double along = corners[i % 4][0] * length, across = corners[i % 4][1] * width;
        (void)fprintf(figure->data, "%.6g %.6g\n", along * cosine - across * sine,
                      along * sine + across * cosine);
    }
}

static void write_frame(fst_figure_file *figure, const fst_view *view, const double box[4])
{
    FILE *script = figure->script;
    (void)fputs("set title ", script);
    fst_figure_quote(figure, view->title);
    (void)fprintf(script,
                  " noenhanced\n"
                  "set size ratio -1\n"
                  "set xrange [%.6g:%.6g]\n"
                  "set yrange [%.6g:%.6g]\n"
                  "set xlabel 'x (mm)'\n"
                  "set ylabel 'y (mm)'\n"
                  "set grid ls 101\n"
                  "set lmargin at screen %.4f\n"
                  "set rmargin at screen %.4f\n"
                  "set tmargin at screen %.4f\n"
                  "set bmargin at screen %.4f\n"
                  "set key at screen %.4f, screen %.4f left bottom Left reverse samplen 2 spacing 1.15\n",
                  box[0], box[1], box[2], box[3], LEFT / (double)WIDTH, (LEFT + SIDE) / (double)WIDTH,
                  1.0 - TOP / (double)HEIGHT, 1.0 - (TOP + SIDE) / (double)HEIGHT, LEFT / (double)WIDTH,
                  8.0 / HEIGHT);
}

/* ------------------------------------------------------------------ colour */

static void write_colour(fst_figure_file *figure, const fst_view *view, const path_columns *columns)
{
    double least, greatest;
    fst_view_range(view, columns->colour, &least, &greatest);
    int both_signs = least < 0.0 && greatest > 0.0;
    const char *name = columns->colour_info->name;
    if (!strcmp(name, "n_z")) {
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
    (void)fprintf(figure->script,
                  "set cbrange [%.9g:%.9g]\nset colorbox user origin %.4f,%.4f size %.4f,%.4f\n", least,
                  greatest, (LEFT + SIDE + 14.0) / WIDTH, 1.0 - (TOP + SIDE) / (double)HEIGHT, 16.0 / WIDTH,
                  SIDE / (double)HEIGHT);
    for (size_t i = 0; i < sizeof colour_labels / sizeof colour_labels[0]; ++i) {
        if (!strcmp(name, colour_labels[i].column)) {
            (void)fprintf(figure->script, "set cblabel '%s'\n", colour_labels[i].label);
            return;
        }
    }
    char unit[32];
    fst_unit_symbols(columns->colour_info->unit, unit, sizeof unit);
    (void)fprintf(figure->script, "set cblabel '%s (%s)' noenhanced\n", name, unit);
}

/* ------------------------------------------------------------------ data */

/* Where samples are few, join them by smooth curves through their velocities; where they are many,
 * skip some. */
static void write_path(fst_figure_file *figure, const fst_view *view, const path_columns *columns)
{
    size_t rows = view->last - view->first, stride = rows / MOST_SAMPLES + 1, parts = MOST_SAMPLES / rows;
    parts = parts < 1 ? 1 : parts > MOST_PARTS ? MOST_PARTS : parts;
    fst_figure_block(figure, "path", "x/mm y/mm colour");
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
            (void)fprintf(figure->data, "%.7g %.7g %.7g\n", x * view->millimetres, y * view->millimetres,
                          colour);
        }
    }
}

/* Draw the moment in the local frame, seen from outside along -e_r, in the middle of the picture. */
static void write_inset(fst_figure_file *figure, const fst_view *view, const path_columns *columns)
{
    static const double side = 0.36; /* in parts of the square of plate */
    double middle_x = (LEFT + 0.5 * SIDE) / WIDTH, middle_y = 1.0 - (TOP + 0.5 * SIDE) / HEIGHT;
    double wide = 0.5 * side * SIDE / WIDTH, tall = 0.5 * side * SIDE / HEIGHT;
    fst_figure_block(figure, "local", "n_alpha n_z: the moment in the local frame");
    for (size_t row = view->first; row < view->last; ++row)
        (void)fprintf(figure->data, "%.6g %.6g\n", columns->n_alpha[row], columns->n_z[row]);
    (void)fprintf(figure->script,
                  "unset title\nunset colorbox\nunset key\n"
                  "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
                  "set bmargin at screen %.4f\nset tmargin at screen %.4f\n"
                  "set xrange [-1.1:1.1]\nset yrange [-1.1:1.1]\nset tics 1 font ',11' format '%%g'\n"
                  "set xlabel 'n_α' font ',12' offset 0,0.8\nset ylabel 'n_z' font ',12' offset 1.5,0\n"
                  "set object 1 rectangle from graph 0,0 to graph 1,1 behind fc rgb 'white' fs solid noborder\n"
                  "set object 2 circle at 0,0 size 1 front fs empty border lc rgb '#b8b8b8'\n"
                  "plot data index 'local' using 1:2 with lines lc rgb '%s' lw 1.6 notitle\n"
                  "unset multiplot\n",
                  middle_x - wide, middle_x + wide, middle_y - tall, middle_y + tall,
                  fst_colour_code(FST_COLOUR_BLUE));
}

/* Arrows of the moment's horizontal part, each as long as that part.  A zoom has as many arrows per length of
 * path as the picture can bear. */
static void write_arrows(fst_figure_file *figure, const fst_view *view, const path_columns *columns,
                         const double box[4])
{
    size_t inside = 0;
    for (size_t row = view->first; row < view->last; ++row) {
        double x = columns->x[row] * view->millimetres, y = columns->y[row] * view->millimetres;
        inside += x >= box[0] && x <= box[1] && y >= box[2] && y <= box[3];
    }
    size_t stride = inside / ARROWS + 1;
    double scale = 0.07 * (box[1] - box[0]);
    fst_figure_block(figure, "moment", "x/mm y/mm dx dy: the horizontal part of n");
    for (size_t row = view->first; row < view->last; row += stride)
        (void)fprintf(figure->data, "%.6g %.6g %.5g %.5g\n", columns->x[row] * view->millimetres,
                      columns->y[row] * view->millimetres, scale * columns->n_x[row],
                      scale * columns->n_y[row]);
}

/* ------------------------------------------------------------------ the figure */

fst_status fst_figure_path(const fst_table *table, const char *out, const fst_figure_options *options,
                           fst_error *error)
{
    fst_view view;
    path_columns columns = {0};
    double box[4] = {0};
    fst_status status = fst_view_of(&view, table, options, 2.0, 30.0, error);
    if (status == FST_OK)
        status = find_columns(&view, options->colour, &columns, error);
    if (status == FST_OK)
        status = choose_box(&view, &columns, options, box, error);
    fst_figure_file figure;
    if (status == FST_OK)
        status = fst_figure_begin(&figure, out, WIDTH, HEIGHT, error);
    if (status != FST_OK)
        return status;

    if (has_outline(&view))
        draw_magnet(&figure, &view, &columns);
    write_path(&figure, &view, &columns);
    if (options->inset)
        (void)fputs("set multiplot\n", figure.script);
    write_frame(&figure, &view, box);
    write_colour(&figure, &view, &columns);
    fputs("plot \\\n", figure.script);
    if (has_outline(&view))
        fputs("     data index 'magnet' using 1:2 with filledcurves closed fc rgb '#f4f4f4' notitle, \\\n"
              "     data index 'magnet' using 1:2 with lines lc rgb '#c4c4c4' lw 1 title 'magnet when the path "
              "begins (turns anticlockwise)', \\\n",
              figure.script);
    if (options->arrows) {
        write_arrows(&figure, &view, &columns, box);
        fputs("     data index 'moment' using 1:2:3:4 with vectors head filled size screen 0.007,18 lc rgb "
              "'#8a8a8a' lw 0.8 title 'horizontal part of the moment n', \\\n",
              figure.script);
    }
    fputs("     data index 'path' using 1:2:3 with lines lc palette lw 2.2 notitle, \\\n"
          "     data index 'path' using 1:2 every ::0::0 with points pt 6 ps 1 lw 2 lc rgb '#222222' title "
          "'the bead then'\n",
          figure.script);
    if (options->inset)
        write_inset(&figure, &view, &columns);
    return fst_figure_finish(&figure, error);
}
