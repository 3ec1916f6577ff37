/* figure_path.c - the bead's path over the plate (the paper's Figs. 7, 8, 9), drawn by gnuplot. */
#include "draw/figure_trajectory.h"

#include "draw/poles.h"
#include "draw/style.h"
#include "draw/view.h"

#include <string.h>

enum {
    SIDE = 400, /* of the square of plate in the figure, in pixels */
    LEFT = 58,
    AXIS = 54,  /* below the square, for its numbers and label */
    SCALE = 64, /* for the scale of colours */
    INSET = 190
};

/* Where the parts of the figure lie, in pixels from above. */
typedef struct path_layout {
    int top, scale, inset, height;
} path_layout;

static path_layout lay_out(const fst_legend *legend, int more, int with_inset)
{
    path_layout l = {.top = fst_legend_head(legend) + 6 + more / 2};
    l.scale = l.top + SIDE + AXIS;
    l.inset = l.scale + SCALE;
    l.height = l.inset + (with_inset ? INSET : 0) + fst_legend_foot(legend) + more - more / 2;
    return l;
}

static void write_frame(fst_figure_file *figure, const fst_path_picture *picture, const path_layout *l)
{
    const double frame[4] = {LEFT, LEFT + SIDE, l->top, l->top + SIDE}, *box = picture->box;
    fst_figure_place(figure, l->height, frame);
    (void)fprintf(figure->script,
                  "set size ratio -1\nset xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\nunset key\n", box[0],
                  box[1], box[2], box[3]);
    fst_figure_axis_label(figure, l->height, FST_SIDE_BELOW, picture->x_label, FST_COLOUR_BLACK, frame);
    fst_figure_axis_label(figure, l->height, FST_SIDE_LEFT, picture->y_label, FST_COLOUR_BLACK, frame);
    fst_figure_palette(figure, picture->colours.palette);
    (void)fprintf(figure->script, "set cbrange [%.9g:%.9g]\n", picture->colours.low, picture->colours.high);
    fst_figure_colour_scale(figure, l->height, picture->colour_label,
                            (const double[4]){LEFT, LEFT + SIDE, l->scale, l->scale + 12});
}

static void write_data(fst_figure_file *figure, const fst_path_picture *picture)
{
    fst_figure_write_lines(figure, picture->lines, picture->line_count);
    fst_figure_block(figure, "path", "x y colour");
    for (size_t i = 0; i < picture->count; ++i)
        (void)fprintf(figure->data, "%.7g %.7g %.9g\n", picture->x[i], picture->y[i], picture->colour[i]);
    if (picture->arrow_count)
        fst_figure_block(figure, "moment", "x y dx dy: the horizontal part of n");
    for (const double *at = picture->arrows; at < picture->arrows + 4 * picture->arrow_count; at += 4)
        (void)fprintf(figure->data, "%.6g %.6g %.5g %.5g\n", at[0], at[1], at[2], at[3]);
}

/* Draw the moment in the local frame, seen from outside along -e_r, below the path. */
static void write_inset(fst_figure_file *figure, const fst_view *view, const path_layout *l)
{
    const double frame[4] = {LEFT, LEFT + INSET - 50, l->inset + 4, l->inset + INSET - 46};
    const double *n_alpha = NULL, *n_z = NULL;
    if (fst_view_columns(view, NULL, "n_alpha", &n_alpha, "n_z", &n_z, NULL) != FST_OK)
        return;
    fst_figure_block(figure, "local", "n_alpha n_z: the moment in the local frame");
    for (size_t row = view->first; row < view->last; ++row)
        (void)fprintf(figure->data, "%.6g %.6g\n", n_alpha[row], n_z[row]);
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

/* ------------------------------------------------------------------ the figure */

static fst_legend make_legend(const fst_view *view, const fst_path_picture *picture)
{
    fst_legend legend = fst_view_legend(view, picture->title);
    (void)snprintf(legend.about, sizeof legend.about, "%s", picture->about);
    fst_legend_add_lines(&legend, picture->lines, picture->line_count);
    if (picture->begins_inside)
        fst_legend_add(&legend, FST_SAMPLE_POINT, "pt 6 ps 1 lw 2 lc rgb '#222222'",
                       "the bead at the beginning");
    if (picture->arrow_count) {
        fst_legend_add(&legend, FST_SAMPLE_ARROW, "lc rgb '#8a8a8a' lw 0.8",
                       "horizontal part of the moment n; so long where n is horizontal");
        legend.entries[legend.count - 1].length = FST_LONGEST_ARROW * SIDE;
    }
    return legend;
}

static void write_plots(fst_figure_file *figure, const fst_path_picture *picture)
{
    fputs("plot \\\n", figure->script);
    fst_figure_plot_lines(figure->script, picture->lines, picture->line_count);
    if (picture->arrow_count)
        fputs("     data index 'moment' using 1:2:3:4 with vectors head filled size screen 0.010,18 lc rgb "
              "'#8a8a8a' lw 0.8 notitle, \\\n",
              figure->script);
    fputs("     data index 'path' using 1:2:3 with lines lc palette lw 2.2 notitle, \\\n"
          "     data index 'path' using 1:2 every ::0::0 with points pt 6 ps 1 lw 2 lc rgb '#222222' notitle\n",
          figure->script);
}

static fst_status draw(const fst_view *view, const fst_path_picture *picture, const char *out,
                       const fst_figure_options *options, fst_error *error)
{
    const fst_legend legend = make_legend(view, picture);
    const path_layout usual = lay_out(&legend, 0, options->inset);
    const fst_canvas canvas = fst_canvas_for(options->size, usual.height, 0);
    const path_layout l = lay_out(&legend, canvas.more, options->inset);
    fst_figure_file figure;
    const fst_status status = fst_figure_begin(&figure, out, &canvas, error);
    if (status != FST_OK)
        return status;
    fst_figure_scene_of(&figure, &view->table->params);
    write_data(&figure, picture);
    fst_figure_panels(&figure);
    write_frame(&figure, picture, &l);
    write_plots(&figure, picture);
    if (options->inset)
        write_inset(&figure, view, &l);
    fst_legend_write(&figure, &legend, l.height);
    return fst_figure_finish(&figure, error);
}

fst_status fst_figure_path(const fst_table *table, const char *out, const fst_figure_options *options,
                           fst_error *error)
{
    fst_view view;
    fst_path_picture picture;
    fst_status status = fst_view_of(&view, table, options, error);
    if (status != FST_OK)
        return status;
    status = fst_path_picture_of(table, options, &picture, error);
    if (status == FST_OK)
        status = draw(&view, &picture, out, options, error);
    fst_path_picture_free(&picture);
    return status;
}
