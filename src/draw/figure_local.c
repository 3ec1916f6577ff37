/* figure_local.c - the path of the moment n in the local frame (inset of the paper's Fig. 9). */
#include "draw/figure_trajectory.h"

#include "draw/style.h"
#include "draw/view.h"

enum { SIDE = 186, LEFT = 54, GAP = 44, TITLE = 32, AXIS = 54 };

/* One view of the unit sphere: the path projected on two of the local axes. */
static void write_panel(fst_figure_file *figure, const char *title, const char *label, int column, int height,
                        double left, double top)
{
    const double frame[4] = {left, left + SIDE, top, top + SIDE};
    (void)fputs("unset label\n", figure->script);
    fst_figure_place(figure, height, frame);
    fst_figure_axis_label(figure, height, FST_SIDE_BELOW, label, FST_COLOUR_BLACK, frame);
    if (left <= LEFT) /* the other panel has the same ordinate */
        fst_figure_axis_label(figure, height, FST_SIDE_LEFT, "n_z, up", FST_COLOUR_BLACK, frame);
    (void)fprintf(figure->script,
                  "set label '%s' at graph 0.5,1 center offset character 0,0.8 font ',12'\n"
                  "plot data index 'circle' using 1:2 with filledcurves closed fc rgb '#f6f6f6' notitle, \\\n"
                  "     data index 'circle' using 1:2 with lines lc rgb '#b8b8b8' lw 1 notitle, \\\n"
                  "     data index 'n' using %d:3 with lines lc rgb '%s' lw 1.8 notitle, \\\n"
                  "     data index 'n' using %d:3 every ::0::0 with points pt 7 ps 0.8 lc rgb '%s' notitle\n",
                  title, column, fst_colour_code(FST_COLOUR_BLUE), column,
                  fst_colour_code(FST_COLOUR_VERMILION));
}

static fst_legend make_legend(const fst_view *view)
{
    fst_legend legend = fst_view_legend(view, "Path of the moment n in the bead's local frame");
    fst_legend_add(&legend, FST_SAMPLE_LINE, "lc rgb '#0072b2' lw 1.8", "tip of n");
    fst_legend_add(&legend, FST_SAMPLE_POINT, "pt 7 ps 0.8 lc rgb '#d55e00'", "its beginning");
    fst_legend_add(&legend, FST_SAMPLE_LINE, "lc rgb '#b8b8b8' lw 1", "unit sphere");
    return legend;
}

static void write_data(fst_figure_file *figure, const fst_view *view, const double *n_r, const double *n_alpha,
                       const double *n_z)
{
    fst_figure_block(figure, "n", "n_r n_alpha n_z");
    for (size_t row = view->first; row < view->last; ++row)
        (void)fprintf(figure->data, "%.7g %.7g %.7g\n", n_r[row], n_alpha[row], n_z[row]);
    fst_figure_block(figure, "circle", "the unit circle, for scale");
    for (int degrees = 0; degrees <= 360; degrees += 3)
        (void)fprintf(figure->data, "%.6g %.6g\n", cos(degrees * 0.017453292519943295),
                      sin(degrees * 0.017453292519943295));
}

fst_status fst_figure_local_n(const fst_table *table, const char *out, const fst_figure_options *options,
                              fst_error *error)
{
    fst_view view;
    const double *n_r, *n_alpha, *n_z;
    fst_status status = fst_view_of(&view, table, options, error);
    if (status == FST_OK)
        status = fst_view_columns(&view, error, "n_r", &n_r, "n_alpha", &n_alpha, "n_z", &n_z, NULL);
    if (status != FST_OK)
        return status;
    const fst_legend legend = make_legend(&view);
    const int head = fst_legend_head(&legend) + TITLE;
    const fst_canvas canvas = fst_canvas_for(options->size, head + SIDE + AXIS + fst_legend_foot(&legend), 0);
    const int top = head + canvas.more / 2, height = canvas.height;
    fst_figure_file figure;
    status = fst_figure_begin(&figure, out, &canvas, error);
    if (status != FST_OK)
        return status;
    fst_figure_scene_of(&figure, &table->params);
    write_data(&figure, &view, n_r, n_alpha, n_z);
    fst_figure_panels(&figure);
    fputs("set size ratio -1\n"
          "set xrange [-1.08:1.08]\n"
          "set yrange [-1.08:1.08]\n"
          "set tics 0.5 format '%g' font ',11'\nunset key\n",
          figure.script);
    write_panel(&figure, "from outside, along −e_r", "n_α, along the circle", 2, height, LEFT, top);
    write_panel(&figure, "from the side, along e_α", "n_r, outward", 1, height, LEFT + SIDE + GAP, top);
    fst_legend_write(&figure, &legend, height);
    return fst_figure_finish(&figure, error);
}
