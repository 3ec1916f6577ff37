/* figure_local.c - the path of the moment n in the local frame (inset of the paper's Fig. 9). */
#include "draw/figure_trajectory.h"

#include "draw/style.h"
#include "draw/view.h"

enum { WIDTH = 760, HEIGHT = 460 };

/* One view of the unit sphere: the path projected on two of the local axes. */
static void write_panel(fst_figure_file *figure, double left, const char *title, const char *label, int column)
{
    (void)fprintf(figure->script,
                  "set lmargin at screen %.3f\n"
                  "set rmargin at screen %.3f\n"
                  "set title '%s' font ',12'\n"
                  "set xlabel '%s'\n"
                  "plot data index 'circle' using 1:2 with filledcurves closed fc rgb '#f6f6f6' notitle, \\\n"
                  "     data index 'circle' using 1:2 with lines lc rgb '#b8b8b8' lw 1 notitle, \\\n"
                  "     data index 'n' using %d:3 with lines lc rgb '%s' lw 1.8 notitle, \\\n"
                  "     data index 'n' using %d:3 every ::0::0 with points pt 7 ps 0.8 lc rgb '%s' notitle\n",
                  left, left + 0.40, title, label, column, fst_colour_code(FST_COLOUR_BLUE), column,
                  fst_colour_code(FST_COLOUR_VERMILION));
}

fst_status fst_figure_local_n(const fst_table *table, const char *out, const fst_figure_options *options,
                              fst_error *error)
{
    fst_view view;
    const double *n_r, *n_alpha, *n_z;
    fst_status status = fst_view_of(&view, table, options, 2.0, 16.0, error);
    if (status == FST_OK)
        status = fst_view_columns(&view, error, "n_r", &n_r, "n_alpha", &n_alpha, "n_z", &n_z, NULL);
    fst_figure_file figure;
    if (status == FST_OK)
        status = fst_figure_begin(&figure, out, WIDTH, HEIGHT, error);
    if (status != FST_OK)
        return status;

    fst_figure_block(&figure, "n", "n_r n_alpha n_z");
    for (size_t row = view.first; row < view.last; ++row)
        (void)fprintf(figure.data, "%.7g %.7g %.7g\n", n_r[row], n_alpha[row], n_z[row]);
    fst_figure_block(&figure, "circle", "the unit circle, for scale");
    for (int degrees = 0; degrees <= 360; degrees += 3)
        (void)fprintf(figure.data, "%.6g %.6g\n", cos(degrees * 0.017453292519943295),
                      sin(degrees * 0.017453292519943295));

    fputs("set multiplot title ", figure.script);
    fst_figure_quote(&figure, view.title);
    fputs(" noenhanced\n"
          "set tmargin at screen 0.82\n"
          "set bmargin at screen 0.17\n"
          "set size ratio -1\n"
          "set xrange [-1.08:1.08]\n"
          "set yrange [-1.08:1.08]\n"
          "set grid ls 101\n"
          "set tics 0.5 format '%g'\n"
          "set ylabel 'n_z, up' offset 1,0\n",
          figure.script);
    write_panel(&figure, 0.085, "from outside, along −e_r", "n_α, along the circle", 2);
    write_panel(&figure, 0.58, "from the side, along e_α", "n_r, outward", 1);
    fputs("unset multiplot\n", figure.script);
    return fst_figure_finish(&figure, error);
}
