#include "draw/chart.h"

#include <math.h>

enum { USUAL_WIDTH = 720, PANEL_HEIGHT = 260, HEAD_HEIGHT = 112, FOOT_HEIGHT = 62 };

/* ------------------------------------------------------------------ data */

static void write_data(fst_figure_file *figure, const fst_chart *chart)
{
    for (int p = 0; p < chart->panel_count; p++) {
        for (int c = 0; c < chart->panels[p].curve_count; c++) {
            const fst_chart_curve *curve = &chart->panels[p].curves[c];
            char name[32];
            (void)snprintf(name, sizeof name, "panel%d-curve%d", p + 1, c + 1);
            fst_figure_block(figure, name, curve->title ? curve->title : "x y");
            for (size_t i = 0; i < curve->count; i++) {
                /* gnuplot breaks a line at an empty line, and steps over a missing value. */
                if (isfinite(curve->x[i]) && isfinite(curve->y[i]))
                    (void)fprintf(figure->data, "%.9g %.9g\n", curve->x[i], curve->y[i]);
                else if (i > 0 && isfinite(curve->x[i - 1]) && isfinite(curve->y[i - 1]))
                    (void)fputc('\n', figure->data);
            }
            if (curve->count == 0 || !isfinite(curve->y[0]))
                (void)fputs("nan nan\n", figure->data);
        }
    }
}

/* ------------------------------------------------------------------ script */

static void write_label(fst_figure_file *figure, const char *axis, const char *text, fst_colour colour)
{
    if (!text) {
        (void)fprintf(figure->script, "unset %slabel\n", axis);
        return;
    }
    (void)fprintf(figure->script, "set %slabel ", axis);
    fst_figure_quote(figure, text);
    (void)fprintf(figure->script, " textcolor rgb '%s'\n", fst_colour_code(colour));
}

static void write_axes(fst_figure_file *figure, const fst_chart *chart, const fst_chart_panel *panel, int top,
                       int bottom)
{
    FILE *script = figure->script;
    write_label(figure, "y", panel->left_label, panel->left_colour);
    if (isfinite(panel->low) && isfinite(panel->high))
        (void)fprintf(script, "set yrange [%.9g:%.9g]\n", panel->low, panel->high);
    else
        (void)fputs("set autoscale y\n", script);
    write_label(figure, "y2", panel->right_label, panel->right_colour);
    (void)fputs(panel->right_label ? "set y2tics nomirror\nset autoscale y2\n" : "unset y2tics\n", script);
    write_label(figure, "x", bottom ? chart->x_label : NULL, FST_COLOUR_BLACK);
    (void)fputs(bottom ? "set format x '%g'\n" : "set format x ''\n", script);
    if (chart->x_tics)
        (void)fprintf(script, "set xtics %s\n", chart->x_tics);
    int second = top && chart->x2_label;
    write_label(figure, "x2", second ? chart->x2_label : NULL, FST_COLOUR_BLACK);
    if (second)
        (void)fprintf(script, "set x2range [%.9g:%.9g]\nset x2tics nomirror out\n",
                      chart->x_low * chart->x2_factor, chart->x_high * chart->x2_factor);
    else
        (void)fputs("unset x2tics\n", script);
    if (panel->key)
        (void)fprintf(script, "set key %s samplen 2.5 spacing 1.15\n", panel->key);
    else
        (void)fputs("unset key\n", script);
}

static void write_marks(fst_figure_file *figure, const fst_chart *chart, int top)
{
    (void)fputs("unset arrow\nunset label\n", figure->script);
    for (int m = 0; m < chart->mark_count; m++) {
        const fst_chart_mark *mark = &chart->marks[m];
        (void)fprintf(figure->script,
                      "set arrow from first %.9g,graph 0 to first %.9g,graph 1 nohead lc rgb '#9a9a9a' dt 3 "
                      "lw 1.2 back\n",
                      mark->x, mark->x);
        if (top && mark->text) {
            (void)fputs("set label ", figure->script);
            fst_figure_quote(figure, mark->text);
            (void)fprintf(figure->script,
                          " at first %.9g,graph 0.95 left offset character 0.4,0 noenhanced textcolor rgb "
                          "'#666666' font ',11'\n",
                          mark->x);
        }
    }
}

static void write_curves(fst_figure_file *figure, const fst_chart_panel *panel, int number)
{
    static const char *const styles[] = {[FST_CURVE_LINE] = "lines lw 2",
                                         [FST_CURVE_DASHED] = "lines dt (6,5) lw 2",
                                         [FST_CURVE_POINTS] = "points pt 7 ps 0.6",
                                         [FST_CURVE_OPEN_POINTS] = "points pt 6 ps 0.7 lw 1.2"};
    for (int c = 0; c < panel->curve_count; c++) {
        const fst_chart_curve *curve = &panel->curves[c];
        (void)fprintf(figure->script, "%sdata index 'panel%d-curve%d' using 1:2 axes %s with %s lc rgb '%s' ",
                      c ? ", \\\n     " : "plot ", number, c + 1, curve->right ? "x1y2" : "x1y1",
                      styles[curve->style], fst_colour_code(curve->colour));
        if (curve->title) {
            (void)fputs("title ", figure->script);
            fst_figure_quote(figure, curve->title);
        } else {
            (void)fputs("notitle", figure->script);
        }
    }
    (void)fputc('\n', figure->script);
}

fst_status fst_figure_chart(const char *out, const fst_chart *chart, fst_error *error)
{
    int width = chart->width ? chart->width : USUAL_WIDTH;
    int height = chart->height ? chart->height : HEAD_HEIGHT + FOOT_HEIGHT + PANEL_HEIGHT * chart->panel_count;
    fst_figure_file figure;
    fst_status status = fst_figure_begin(&figure, out, width, height, error);
    if (status != FST_OK)
        return status;
    write_data(&figure, chart);

    int two = 0;
    for (int p = 0; p < chart->panel_count; p++)
        two = two || chart->panels[p].right_label;
    FILE *script = figure.script;
    (void)fputs("set multiplot title ", script);
    fst_figure_quote(&figure, chart->title);
    (void)fprintf(script,
                  " noenhanced\n"
                  "set grid ls 101\n"
                  "set xrange [%.9g:%.9g]\n"
                  "set lmargin at screen %.4f\n"
                  "set rmargin at screen %.4f\n",
                  chart->x_low, chart->x_high, 104.0 / width, 1.0 - (two ? 92.0 : 24.0) / width);
    if (chart->square)
        (void)fputs("set size ratio -1\n", script);
    double head = (chart->x2_label ? HEAD_HEIGHT : HEAD_HEIGHT - 70) / (double)height;
    double each = (1.0 - head - FOOT_HEIGHT / (double)height) / chart->panel_count;
    for (int p = 0; p < chart->panel_count; p++) {
        const fst_chart_panel *panel = &chart->panels[p];
        double top = 1.0 - head - p * each;
        (void)fprintf(script, "set tmargin at screen %.4f\nset bmargin at screen %.4f\n", top,
                      top - each + (p + 1 < chart->panel_count ? 16.0 / height : 0.0));
        write_axes(&figure, chart, panel, p == 0, p + 1 == chart->panel_count);
        write_marks(&figure, chart, p == 0);
        write_curves(&figure, panel, p + 1);
    }
    (void)fputs("unset multiplot\n", script);
    return fst_figure_finish(&figure, error);
}
