/* chart.c - writing a chart (chart.h) as a gnuplot script with its data. */
#include "draw/chart.h"

#include <math.h>

enum { USUAL_WIDTH = 720, PANEL_HEIGHT = 260, HEAD_HEIGHT = 112, FOOT_HEIGHT = 62 };

/* ------------------------------------------------------------------ data */

static int is_shown(const fst_chart_curve *curve, size_t i)
{
    return isfinite(curve->x[i]) && isfinite(curve->y[i]) && (!curve->spread || isfinite(curve->spread[i]));
}

/* Write the curves as data blocks "NAMEi-curvej". */
static void write_blocks(fst_figure_file *figure, const char *name, int number, const fst_chart_curve *curves,
                         int count)
{
    for (int c = 0; c < count; ++c) {
        const fst_chart_curve *curve = &curves[c];
        char block[32];
        (void)snprintf(block, sizeof block, "%s%d-curve%d", name, number, c + 1);
        fst_figure_block(figure, block, curve->title ? curve->title : "x y");
        for (size_t i = 0; i < curve->count; ++i) {
            /* gnuplot breaks a line at an empty line, but steps over a missing value. */
            if (is_shown(curve, i)) {
                (void)fprintf(figure->data, "%.9g %.9g", curve->x[i], curve->y[i]);
                if (curve->spread)
                    (void)fprintf(figure->data, " %.9g %.9g", curve->y[i] - curve->spread[i],
                                  curve->y[i] + curve->spread[i]);
                (void)fputc('\n', figure->data);
            } else if (i > 0 && is_shown(curve, i - 1)) {
                (void)fputc('\n', figure->data);
            }
        }
        if (curve->count == 0 || !is_shown(curve, 0))
            (void)fputs(curve->spread ? "nan nan nan nan\n" : "nan nan\n", figure->data);
    }
}

static void write_data(fst_figure_file *figure, const fst_chart *chart)
{
    for (int p = 0; p < chart->panel_count; ++p) {
        const fst_chart_panel *panel = &chart->panels[p];
        write_blocks(figure, "panel", p + 1, panel->curves, panel->curve_count);
        if (panel->inset)
            write_blocks(figure, "inset", p + 1, panel->inset->curves, panel->inset->curve_count);
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

/* The tics of the abscissa; only the panel at the bottom shows their numbers. */
static void write_tics(FILE *script, const char *tics, int named)
{
    int in_name = 0;
    (void)fputs("set xtics ", script);
    for (const char *c = tics; *c; ++c) {
        in_name ^= *c == '\'';
        if (named || !in_name || *c == '\'')
            (void)fputc(*c, script);
    }
    (void)fputc('\n', script);
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
    if (panel->right_low < panel->right_high)
        (void)fprintf(script, "set y2range [%.9g:%.9g]\n", panel->right_low, panel->right_high);
    write_label(figure, "x", bottom ? chart->x_label : NULL, FST_COLOUR_BLACK);
    (void)fputs(bottom ? "set format x '%g'\n" : "set format x ''\n", script);
    if (chart->x_tics)
        write_tics(script, chart->x_tics, bottom);
    int second = top && chart->x2_label;
    write_label(figure, "x2", second ? chart->x2_label : NULL, FST_COLOUR_BLACK);
    if (second)
        (void)fprintf(script, "set x2range [%.9g:%.9g]\nset x2tics nomirror out\n",
                      chart->x_low * chart->x2_factor, chart->x_high * chart->x2_factor);
    else
        (void)fputs("unset x2tics\n", script);
    if (second && chart->x_logarithmic)
        fst_figure_logarithmic(figure, "x2", chart->x_low * chart->x2_factor, chart->x_high * chart->x2_factor);
    if (panel->key)
        (void)fprintf(script, "set key %s samplen 2.5 spacing 1.15\n", panel->key);
    else
        (void)fputs("unset key\n", script);
}

static void write_marks(fst_figure_file *figure, const fst_chart *chart, int top)
{
    (void)fputs("unset arrow\nunset label\n", figure->script);
    for (int m = 0; m < chart->mark_count; ++m) {
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

static void write_curves(fst_figure_file *figure, const char *name, int number, const fst_chart_curve *curves,
                         int count)
{
    static const char *const styles[] = {[FST_CURVE_LINE] = "lines lw 2",
                                         [FST_CURVE_DASHED] = "lines dt (6,5) lw 2",
                                         [FST_CURVE_POINTS] = "points pt 7 ps 0.6",
                                         [FST_CURVE_OPEN_POINTS] = "points pt 6 ps 0.7 lw 1.2",
                                         [FST_CURVE_LINE_POINTS] = "linespoints pt 7 ps 0.6 lw 2",
                                         [FST_CURVE_DASHED_POINTS] = "linespoints dt (6,5) pt 6 ps 0.7 lw 2",
                                         [FST_CURVE_ERRORS] = "yerrorbars pt 7 ps 0.6 lw 1.4",
                                         [FST_CURVE_OPEN_ERRORS] = "yerrorbars pt 6 ps 0.8 lw 1.4",
                                         [FST_CURVE_BAND] = "filledcurves fs transparent solid 0.22 noborder"};
    static const char *const columns[] = {"1:2", "1:2:3:4", "1:3:4"};
    for (int c = 0; c < count; ++c) {
        const fst_chart_curve *curve = &curves[c];
        (void)fprintf(figure->script, "%sdata index '%s%d-curve%d' using %s axes %s with %s lc rgb '%s' ",
                      c ? ", \\\n     " : "plot ", name, number, c + 1,
                      columns[!curve->spread                   ? 0
                              : curve->style == FST_CURVE_BAND ? 2
                                                               : 1],
                      curve->right ? "x1y2" : "x1y1", styles[curve->style], fst_colour_code(curve->colour));
        if (curve->title) {
            (void)fputs("title ", figure->script);
            fst_figure_quote(figure, curve->title);
        } else {
            (void)fputs("notitle", figure->script);
        }
    }
    (void)fputc('\n', figure->script);
}

/* Write "[low:high]"; NAN leaves an end to the data. */
static void write_range(FILE *script, const char *axis, double low, double high)
{
    (void)fprintf(script, "set %srange [", axis);
    (void)(isfinite(low) ? fprintf(script, "%.9g:", low) : fputs("*:", script));
    (void)(isfinite(high) ? fprintf(script, "%.9g]\n", high) : fputs("*]\n", script));
}

/* Draw the inset of a panel whose frame is given in parts of the screen. */
static void write_inset(fst_figure_file *figure, const fst_chart_inset *inset, int number,
                        const double frame[4])
{
    FILE *script = figure->script;
    double wide = frame[1] - frame[0], tall = frame[3] - frame[2];
    double left = frame[0] + wide * inset->left, right = frame[0] + wide * inset->right;
    double bottom = frame[2] + tall * inset->bottom, top = frame[2] + tall * inset->top;
    (void)fprintf(
        script,
        "unset arrow\nunset label\nunset key\nunset x2tics\nunset x2label\nunset y2tics\nunset y2label\n"
        "set object 99 rectangle from graph 0,0 to graph 1,1 behind fc rgb 'white' fs solid noborder\n"
        "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
        "set bmargin at screen %.4f\nset tmargin at screen %.4f\n"
        "set tics font ',11'\nset format x '%%g'\nset xtics auto\n",
        left, right, bottom, top);
    write_range(script, "x", inset->x_low, inset->x_high);
    write_range(script, "y", inset->low, inset->high);
    write_label(figure, "x", inset->x_label, FST_COLOUR_BLACK);
    write_label(figure, "y", inset->label, FST_COLOUR_BLACK);
    (void)fputs("set xlabel font ',12' offset 0,0.4\nset ylabel font ',12' offset 1,0\n", script);
    for (int i = 0; i < inset->label_count; ++i) {
        (void)fputs("set label ", script);
        fst_figure_quote(figure, inset->labels[i].text);
        (void)fprintf(script, " at first %.9g,%.9g font ',12' front\n", inset->labels[i].x, inset->labels[i].y);
    }
    write_curves(figure, "inset", number, inset->curves, inset->curve_count);
    (void)fputs("unset label\nunset object 99\nset tics font ''\nset xlabel font '' offset 0,0\n"
                "set ylabel font '' offset 0,0\n",
                script);
}

static void write_panel(fst_figure_file *figure, const fst_chart *chart, int p, const double frame[4])
{
    const fst_chart_panel *panel = &chart->panels[p];
    (void)fprintf(figure->script,
                  "set xrange [%.9g:%.9g]\n"
                  "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
                  "set bmargin at screen %.4f\nset tmargin at screen %.4f\n",
                  chart->x_low, chart->x_high, frame[0], frame[1], frame[2], frame[3]);
    write_axes(figure, chart, panel, p == 0, p + 1 == chart->panel_count);
    write_marks(figure, chart, p == 0);
    write_curves(figure, "panel", p + 1, panel->curves, panel->curve_count);
    if (panel->inset)
        write_inset(figure, panel->inset, p + 1, frame);
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
    for (int p = 0; p < chart->panel_count; ++p)
        two = two || chart->panels[p].right_label;
    FILE *script = figure.script;
    (void)fputs("set multiplot title ", script);
    fst_figure_quote(&figure, chart->title);
    (void)fputs(" noenhanced\nset grid ls 101\n", script);
    if (chart->square)
        (void)fputs("set size ratio -1\n", script);
    if (chart->x_logarithmic)
        fst_figure_logarithmic(&figure, "x", chart->x_low, chart->x_high);
    double head = (chart->x2_label ? HEAD_HEIGHT : HEAD_HEIGHT - 70) / (double)height;
    double each = (1.0 - head - FOOT_HEIGHT / (double)height) / chart->panel_count;
    for (int p = 0; p < chart->panel_count; ++p) {
        double top = 1.0 - head - p * each;
        const double frame[4] = {104.0 / width, 1.0 - (two ? 108.0 : 24.0) / width,
                                 top - each + (p + 1 < chart->panel_count ? 16.0 / height : 0.0), top};
        write_panel(&figure, chart, p, frame);
    }
    (void)fputs("unset multiplot\n", script);
    return fst_figure_finish(&figure, error);
}
