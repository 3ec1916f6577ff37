/* chart.c - a chart (festoon/charts.h): its memory, and how it is written as a gnuplot script with its data. */
#include "draw/chart.h"

#include "draw/legend.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEFT = 66,    /* pixels about the panels */
    NUMBERS = 30, /* for an axis' label and gaps, without its numbers */
    LINE = 16,    /* for one more line of a label */
    RIGHT = 22,
    RIGHT_ORDINATE = 64,
    SECOND_ABSCISSA = 60,
    FOOT = 54,
    GAP = 20,           /* between panels: the lowest number of one must not touch the highest of the next */
    INSET_CLEAR = 14,   /* of the panel's tics */
    INSET_NUMBERS = 40, /* beside an inset */
    LEAST_HEIGHT = 110,
    USUAL_HEIGHT = 190,
    LONE_HEIGHT = 270
};

static const double LETTER = 7.4; /* width of a digit */

/* Lengths of a chart in pixels. */
typedef struct layout {
    int left, right, top, panel, height;
    fst_legend legend;
} layout;

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
                if (curve->x_spread)
                    (void)fprintf(figure->data, " %.9g %.9g", curve->x[i] - curve->x_spread[i],
                                  curve->x[i] + curve->x_spread[i]);
                if (curve->spread)
                    (void)fprintf(figure->data, " %.9g %.9g", curve->y[i] - curve->spread[i],
                                  curve->y[i] + curve->spread[i]);
                (void)fputc('\n', figure->data);
            } else if (i > 0 && is_shown(curve, i - 1)) {
                (void)fputc('\n', figure->data);
            }
        }
        if (curve->count == 0 || !is_shown(curve, 0))
            (void)fputs(curve->x_spread ? "nan nan nan nan nan nan\n"
                        : curve->spread ? "nan nan nan nan\n"
                                        : "nan nan\n",
                        figure->data);
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

/* The range of one coordinate of some curves, where an end of the wanted one is left to them (NAN).  Curves of
 * the other ordinate do not count. */
static void range_of(const fst_chart_curve *curves, int count, int abscissa, int right, double *low,
                     double *high)
{
    double least = INFINITY, greatest = -INFINITY;
    for (int c = 0; c < count; ++c)
        for (size_t i = 0; i < curves[c].count && curves[c].right == right; ++i) {
            const double value = abscissa ? curves[c].x[i] : curves[c].y[i];
            const double bar =
                !abscissa && curves[c].spread && isfinite(curves[c].spread[i]) ? curves[c].spread[i] : 0.0;
            if (isfinite(value)) {
                least = fmin(least, value - bar);
                greatest = fmax(greatest, value + bar);
            }
        }
    *low = isfinite(*low) ? *low : least;
    *high = isfinite(*high) ? *high : greatest;
}

/* The range of the left ordinate: the panel's, or one about values that are equal but for rounding, or tiny and nearly
 * equal, whose tics gnuplot would number with more digits than there is room for; 0: gnuplot finds one beyond this. */
static int range_of_values(const fst_chart_panel *panel, double *low, double *high)
{
    *low = panel->low;
    *high = panel->high;
    if (isfinite(*low) && isfinite(*high))
        return 1;
    *low = *high = NAN;
    range_of(panel->curves, panel->curve_count, 0, 0, low, high);
    const double greatest = fmax(fabs(*low), fabs(*high)), span = *high - *low;
    if (!isfinite(greatest) || (span > 1e-5 * greatest && (greatest > 1e-3 || span > 0.5 * greatest)))
        return 0;
    const double more = greatest > 0.0 ? 0.2 * greatest : 1.0;
    *low = *low > 0.0 && greatest < 1e-3 ? 0.0 : *low - more;
    *high = *high < 0.0 && greatest < 1e-3 ? 0.0 : *high + more;
    return 1;
}

/* The same with free room below the values for signs of the right ordinate, which has no label. */
static int own_range(const fst_chart_panel *panel, double *low, double *high)
{
    const int own = range_of_values(panel, low, high);
    double lowest = NAN, highest = NAN;
    range_of(panel->curves, panel->curve_count, 0, 1, &lowest, &highest);
    if (panel->right_label || !(highest > 0.0))
        return own;
    if (!(*low <= *high))
        *low = 0.0, *high = 1.0; /* there are signs alone */
    const double room = highest + lowest;
    *high += own ? 0.0 : 0.05 * (*high - *low);
    *low -= room / (1.0 - room) * (*high - *low);
    return 1;
}

static void write_ordinates(FILE *script, const fst_chart_panel *panel)
{
    double low, high;
    if (own_range(panel, &low, &high))
        (void)fprintf(script, "set yrange [%.9g:%.9g]\n", low, high);
    else
        (void)fputs("set autoscale y\n", script);
    (void)fprintf(script, "set ytics %s\n", panel->tics ? panel->tics : "auto");
    (void)fputs(panel->right_label ? "set y2tics nomirror\nset autoscale y2\n" : "unset y2tics\n", script);
    if (panel->right_low < panel->right_high)
        (void)fprintf(script, "set y2range [%.9g:%.9g]\n", panel->right_low, panel->right_high);
}

static void write_abscissas(fst_figure_file *figure, const fst_chart *chart, int top, int bottom)
{
    FILE *script = figure->script;
    (void)fputs(bottom ? "set format x '%g'\n" : "set format x ''\n", script);
    if (chart->x_tics)
        write_tics(script, chart->x_tics, bottom);
    int second = top && chart->x2_label;
    if (second)
        (void)fprintf(script, "set x2range [%.9g:%.9g]\nset x2tics nomirror out\n",
                      chart->x_low * chart->x2_factor, chart->x_high * chart->x2_factor);
    else
        (void)fputs("unset x2tics\n", script);
    if (second && chart->x_logarithmic)
        fst_figure_logarithmic(figure, "x2", chart->x_low * chart->x2_factor, chart->x_high * chart->x2_factor);
}

/* The labels of a panel's axes. */
static void write_labels(fst_figure_file *figure, const fst_chart *chart, const fst_chart_panel *panel,
                         int height, const double frame[4])
{
    fst_figure_axis_label(figure, height, FST_SIDE_LEFT, panel->left_label, panel->left_colour, frame);
    if (panel->right_label)
        fst_figure_axis_label(figure, height, FST_SIDE_RIGHT, panel->right_label, panel->right_colour, frame);
    if (panel == chart->panels && chart->x2_label)
        fst_figure_axis_label(figure, height, FST_SIDE_ABOVE, chart->x2_label, FST_COLOUR_BLACK, frame);
    if (panel == chart->panels + chart->panel_count - 1)
        fst_figure_axis_label(figure, height, FST_SIDE_BELOW, chart->x_label, FST_COLOUR_BLACK, frame);
}

/* How many marks have a text: where there are several, letters tell them apart. */
static int texts_of_marks(const fst_chart *chart)
{
    int count = 0;
    for (int m = 0; m < chart->mark_count; ++m)
        count += chart->marks[m].text != NULL;
    return count;
}

static void write_marks(fst_figure_file *figure, const fst_chart *chart, int top)
{
    const int lettered = top && texts_of_marks(chart) > 1;
    char letter = 'a';
    (void)fputs("unset arrow\nunset label\n", figure->script);
    for (int m = 0; m < chart->mark_count; ++m) {
        const fst_chart_mark *mark = &chart->marks[m];
        (void)fprintf(figure->script,
                      "set arrow from first %.9g,graph 0 to first %.9g,graph 1 nohead lc rgb '#777777' dt 3 "
                      "lw 1.4 back\n",
                      mark->x, mark->x);
        if (lettered && mark->text)
            (void)fprintf(figure->script,
                          "set label '%c' at first %.9g,graph 0.955 left offset character 0.3,0 textcolor rgb "
                          "'#555555' font ',12'\n",
                          letter++, mark->x);
    }
}

static const char *const styles[] = {[FST_CURVE_LINE] = "lines lw 2",
                                     [FST_CURVE_DASHED] = "lines dt (6,5) lw 2",
                                     [FST_CURVE_POINTS] = "points ps 0.6 pt",
                                     [FST_CURVE_OPEN_POINTS] = "points ps 0.7 lw 1.2 pt",
                                     [FST_CURVE_LINE_POINTS] = "linespoints ps 0.6 lw 2 pt",
                                     [FST_CURVE_DASHED_POINTS] = "linespoints dt (6,5) ps 0.7 lw 2 pt",
                                     [FST_CURVE_THIN] = "lines lw 0.8",
                                     [FST_CURVE_SIGNS] = "points ps 0.95 lw 1.6 pt",
                                     [FST_CURVE_ERRORS] = "yerrorbars ps 0.6 lw 1.4 pt",
                                     [FST_CURVE_OPEN_ERRORS] = "yerrorbars ps 0.8 lw 1.4 pt",
                                     [FST_CURVE_BAND] = "filledcurves fs transparent solid 0.22 noborder",
                                     [FST_CURVE_DOTS] = "points ps 0.35 pt"};

/* gnuplot's words for a curve, "lines lw 2 lc rgb '#0072b2'". */
static void style_of(const fst_chart_curve *curve, char *text, size_t size)
{
    const int open = curve->style == FST_CURVE_OPEN_POINTS || curve->style == FST_CURVE_DASHED_POINTS ||
                     curve->style == FST_CURVE_OPEN_ERRORS;
    char sign[8] = "";
    if (styles[curve->style][strlen(styles[curve->style]) - 1] == 't') /* "pt", which wants a number */
        (void)snprintf(sign, sizeof sign, " %d", curve->sign ? curve->sign : open ? 6 : 7);
    (void)snprintf(text, size, "%s%s lc rgb '%s'", styles[curve->style], sign, fst_colour_code(curve->colour));
}

static void write_curves(fst_figure_file *figure, const char *name, int number, const fst_chart_curve *curves,
                         int count)
{
    static const char *const columns[] = {"1:2", "1:2:3:4", "1:3:4", "1:2:3:4:5:6"};
    for (int c = 0; c < count; ++c) {
        const fst_chart_curve *curve = &curves[c];
        const int shape = !curve->spread ? 0 : curve->style == FST_CURVE_BAND ? 2 : curve->x_spread ? 3 : 1;
        char style[96];
        style_of(curve, style, sizeof style);
        (void)fprintf(figure->script, "%sdata index '%s%d-curve%d' using %s axes %s with %s%s notitle",
                      c ? ", \\\n     " : "plot ", name, number, c + 1, columns[shape],
                      curve->right ? "x1y2" : "x1y1", shape == 3 ? "x" : "", style);
    }
    (void)fputc('\n', figure->script);
}

/* ------------------------------------------------------------------ key */

static int has_points(const fst_chart_curve *curve)
{
    for (size_t i = 0; i < curve->count; ++i)
        if (is_shown(curve, i))
            return 1;
    return 0;
}

/* A curve without a point gets no line in the key. */
static void add_entry(fst_legend *legend, const fst_chart_curve *curve)
{
    static const fst_sample_kind samples[] = {
        [FST_CURVE_LINE] = FST_SAMPLE_LINE,
        [FST_CURVE_DASHED] = FST_SAMPLE_LINE,
        [FST_CURVE_POINTS] = FST_SAMPLE_POINT,
        [FST_CURVE_OPEN_POINTS] = FST_SAMPLE_POINT,
        [FST_CURVE_LINE_POINTS] = FST_SAMPLE_LINE_POINT,
        [FST_CURVE_DASHED_POINTS] = FST_SAMPLE_LINE_POINT,
        [FST_CURVE_THIN] = FST_SAMPLE_LINE,
        [FST_CURVE_SIGNS] = FST_SAMPLE_POINT,
        [FST_CURVE_ERRORS] = FST_SAMPLE_POINT,
        [FST_CURVE_OPEN_ERRORS] = FST_SAMPLE_POINT,
        [FST_CURVE_BAND] = FST_SAMPLE_BOX,
        [FST_CURVE_DOTS] = FST_SAMPLE_POINT,
    };
    char style[96];
    if (!curve->title || !has_points(curve))
        return;
    style_of(curve, style, sizeof style);
    fst_legend_add(legend, samples[curve->style], strchr(style, ' ') + 1, curve->title);
}

static void fill_legend(const fst_chart *chart, fst_legend *legend)
{
    (void)snprintf(legend->title, sizeof legend->title, "%s", chart->title);
    (void)snprintf(legend->about, sizeof legend->about, "%s", chart->about ? chart->about : "");
    for (int p = 0; p < chart->panel_count; ++p)
        for (int c = 0; c < chart->panels[p].curve_count; ++c)
            add_entry(legend, &chart->panels[p].curves[c]);
    const int several = texts_of_marks(chart) > 1;
    char letter = 'a';
    for (int m = 0; m < chart->mark_count; ++m) {
        char words[128];
        if (!chart->marks[m].text)
            continue;
        if (several)
            (void)snprintf(words, sizeof words, "%c: %s", letter++, chart->marks[m].text);
        else
            (void)snprintf(words, sizeof words, "%s", chart->marks[m].text);
        fst_legend_add(legend, FST_SAMPLE_LINE, "lc rgb '#777777' dt 3 lw 1.4", words);
    }
    if (chart->remark)
        fst_legend_add(legend, FST_SAMPLE_NONE, "", chart->remark);
}

/* Write "[low:high]"; NAN leaves an end to the data. */
static void write_range(FILE *script, const char *axis, double low, double high)
{
    (void)fprintf(script, "set %srange [", axis);
    (void)(isfinite(low) ? fprintf(script, "%.9g:", low) : fputs("*:", script));
    (void)(isfinite(high) ? fprintf(script, "%.9g]\n", high) : fputs("*]\n", script));
}

/* An axis of an inset, so many pixels long, has room for a few numbers. */
static void write_sparse_tics(FILE *script, const fst_chart_inset *inset, int abscissa, double pixels)
{
    const double parts = fmin(3.0, pixels / (abscissa ? 40.0 : 27.0));
    double low = abscissa ? inset->x_low : inset->low, high = abscissa ? inset->x_high : inset->high;
    range_of(inset->curves, inset->curve_count, abscissa, 0, &low, &high);
    if (high > low)
        (void)fprintf(script, "set %ctics %.9g\n", abscissa ? 'x' : 'y', fst_round_step((high - low) / parts));
    else
        (void)fprintf(script, "set %ctics auto\n", abscissa ? 'x' : 'y');
}

/* Where an inset lies in pixels, and the white ground below it and its numbers.  Its numbers stay clear of the
 * tics of the panel about it. */
static void place_inset(const fst_chart_inset *inset, const double panel[4], double frame[4], double ground[4])
{
    const double wide = panel[1] - panel[0], tall = panel[3] - panel[2];
    const double below = inset->x_label ? 38.0 : 20.0;
    frame[0] = panel[0] + wide * inset->left;
    frame[1] = fmin(panel[0] + wide * inset->right, panel[1] - INSET_CLEAR - 10.0);
    frame[2] = panel[3] - tall * inset->top;
    frame[3] = fmin(panel[3] - tall * inset->bottom, panel[3] - INSET_CLEAR - below);
    ground[0] = frame[0] - INSET_NUMBERS;
    ground[1] = frame[1] + 10.0;
    ground[2] = frame[2] - (inset->label ? 20.0 : 6.0);
    ground[3] = frame[3] + below;
}

/* Draw the inset of a panel whose frame is given in pixels.  Its labels stand above and below it. */
static void write_inset(fst_figure_file *figure, const fst_chart_inset *inset, int number,
                        const double panel[4], int height)
{
    FILE *script = figure->script;
    double frame[4], ground[4];
    place_inset(inset, panel, frame, ground);
    (void)fprintf(script,
                  "unset arrow\nunset label\nunset key\nunset x2tics\nunset y2tics\n"
                  "set object 99 rectangle from screen %.5f,%.5f to screen %.5f,%.5f behind noclip fc rgb "
                  "'white' fs solid noborder\nset tics font ',11' scale 0.5\nset format x '%%g'\n",
                  fst_figure_across(figure, ground[0]), 1.0 - ground[3] / height,
                  fst_figure_across(figure, ground[1]), 1.0 - ground[2] / height);
    write_sparse_tics(script, inset, 1, frame[1] - frame[0]);
    write_sparse_tics(script, inset, 0, frame[3] - frame[2]);
    fst_figure_place(figure, height, frame);
    write_range(script, "x", inset->x_low, inset->x_high);
    write_range(script, "y", inset->low, inset->high);
    if (inset->label) {
        (void)fputs("set label ", script);
        fst_figure_quote(figure, inset->label);
        (void)fputs(" at graph 0.5,1 center offset character 0,0.7 font ',11'\n", script);
    }
    if (inset->x_label) {
        (void)fputs("set label ", script);
        fst_figure_quote(figure, inset->x_label);
        (void)fputs(" at graph 0.5,0 center offset character 0,-1.9 font ',11'\n", script);
    }
    for (int i = 0; i < inset->label_count; ++i) {
        (void)fputs("set label ", script);
        fst_figure_quote(figure, inset->labels[i].text);
        (void)fprintf(script, " at first %.9g,%.9g center font ',12' front\n", inset->labels[i].x,
                      inset->labels[i].y);
    }
    write_curves(figure, "inset", number, inset->curves, inset->curve_count);
    (void)fputs("unset label\nunset object 99\nset tics font ',12' scale 1\nset xtics auto\n", script);
}

static void write_panel(fst_figure_file *figure, const fst_chart *chart, const layout *l, int p)
{
    const fst_chart_panel *panel = &chart->panels[p];
    const double top = l->top + p * (l->panel + GAP);
    const double frame[4] = {l->left, FST_FIGURE_WIDTH - l->right, top, top + l->panel};
    (void)fprintf(figure->script, "set xrange [%.9g:%.9g]\n", chart->x_low, chart->x_high);
    fst_figure_place(figure, l->height, frame);
    write_ordinates(figure->script, panel);
    write_abscissas(figure, chart, p == 0, p + 1 == chart->panel_count);
    write_marks(figure, chart, p == 0);
    write_labels(figure, chart, panel, l->height, frame);
    write_curves(figure, "panel", p + 1, panel->curves, panel->curve_count);
    if (panel->inset)
        write_inset(figure, panel->inset, p + 1, frame, l->height);
}

/* About how many letters the widest number of an ordinate has. */
static int number_letters(const fst_chart_panel *panel)
{
    double low, high;
    if (!own_range(panel, &low, &high))
        range_of(panel->curves, panel->curve_count, 0, 0, &low, &high);
    const double greatest = fmax(fabs(low), fabs(high));
    if (!(high > low) || !isfinite(greatest))
        return 0;
    if (greatest < 1e-3)
        return 7 + (low < 0.0); /* a digit times a power of ten */
    const double step = fst_round_step((high - low) / 6.0);
    const int whole = greatest >= 10.0 ? 1 + (int)floor(log10(greatest)) : 1;
    const int decimals = step < 1.0 ? 1 + (int)ceil(-log10(step) - 1e-9) : 0;
    return whole + decimals + (low < 0.0);
}

/* Letters of the longest word of tics. */
static int longest_word(const char *tics)
{
    int longest = 0, length = 0, in_word = 0;
    for (const char *c = tics; *c; ++c) {
        in_word ^= *c == '\'';
        length = in_word ? length + ((*c & 0xc0) != 0x80) : 0; /* bytes that begin a letter */
        longest = length > longest ? length : longest;
    }
    return longest;
}

static layout lay_out(const fst_chart *chart)
{
    layout l = {.left = LEFT, .right = RIGHT};
    int labels = 1; /* the most lines of a label */
    fill_legend(chart, &l.legend);
    l.panel = chart->height ? chart->height : chart->panel_count > 1 ? USUAL_HEIGHT : LONE_HEIGHT;
    for (int p = 0; p < chart->panel_count; ++p) {
        const int lines = fst_lines_of(chart->panels[p].left_label, l.panel);
        labels = lines > labels ? lines : labels;
        const int beside = NUMBERS + (int)(LETTER * number_letters(&chart->panels[p]));
        l.left = beside > l.left ? beside : l.left;
        if (chart->panels[p].right_label)
            l.right = RIGHT_ORDINATE;
    }
    l.left += (labels - 1) * LINE;
    for (int p = 0; p < chart->panel_count; ++p)
        if (chart->panels[p].tics) { /* these are words */
            const int beside = NUMBERS + (int)(LETTER * longest_word(chart->panels[p].tics));
            l.left = beside > l.left ? beside : l.left;
        }
    if (chart->square)
        l.panel = FST_FIGURE_WIDTH - l.left - l.right;
    const int foot = FOOT + LINE * (fst_lines_of(chart->x_label, FST_FIGURE_WIDTH - l.left - l.right) - 1);
    l.top = fst_legend_head(&l.legend) + (chart->x2_label ? SECOND_ABSCISSA : GAP);
    l.height = l.top + chart->panel_count * (l.panel + GAP) - GAP + foot + fst_legend_foot(&l.legend);
    return l;
}

/* The same on the canvas of the wanted size, in which the panels share what is more; a square has its side. */
static layout lay_out_on(const fst_chart *chart, fst_canvas *canvas)
{
    layout l = lay_out(chart);
    const int panels = chart->panel_count ? chart->panel_count : 1;
    *canvas = fst_canvas_for(chart->size, l.height, chart->square ? 0 : panels * (l.panel - LEAST_HEIGHT));
    if (chart->square) {
        l.top += canvas->more / 2;
    } else if (canvas->more) {
        fst_chart sized = *chart;
        sized.height = l.panel + canvas->more / panels;
        l = lay_out(&sized); /* a label may need more lines */
    }
    l.height = canvas->height;
    return l;
}

fst_status fst_figure_chart(const char *out, const fst_chart *chart, fst_error *error)
{
    fst_canvas canvas;
    const layout l = lay_out_on(chart, &canvas);
    fst_figure_file figure;
    fst_status status = fst_figure_begin(&figure, out, &canvas, error);
    if (status != FST_OK)
        return status;
    fst_figure_scene(&figure, chart->scene);
    write_data(&figure, chart);
    fst_figure_panels(&figure);
    if (chart->square)
        (void)fputs("set size ratio -1\n", figure.script);
    if (chart->x_logarithmic)
        fst_figure_logarithmic(&figure, "x", chart->x_low, chart->x_high);
    for (int p = 0; p < chart->panel_count; ++p)
        write_panel(&figure, chart, &l, p);
    fst_legend_write(&figure, &l.legend, l.height);
    return fst_figure_finish(&figure, error);
}

fst_status fst_figure_chart_as(const char *out, fst_chart *chart, const char *title, const double size[2],
                               fst_error *error)
{
    chart->title = title ? title : chart->title;
    memcpy(chart->size, size, sizeof chart->size);
    return fst_figure_chart(out, chart, error);
}

/* ------------------------------------------------------------------ memory */

typedef struct block {
    struct block *next;
    double room[]; /* of the alignment of a number */
} block;

fst_chart *fst_chart_new(void)
{
    return calloc(1, sizeof(fst_chart));
}

void *fst_keep(void **memory, size_t size)
{
    block *made = calloc(1, sizeof *made + size);
    if (!made)
        return NULL;
    made->next = *memory;
    *memory = made;
    return made->room;
}

void fst_keep_free(void *memory)
{
    for (block *each = memory, *next; each; each = next) {
        next = each->next;
        free(each);
    }
}

void *fst_chart_keep(fst_chart *chart, size_t size)
{
    return fst_keep(&chart->memory, size);
}

const char *fst_chart_text(fst_chart *chart, const char *text)
{
    const size_t size = strlen(text) + 1;
    char *copy = fst_chart_keep(chart, size);
    return copy ? memcpy(copy, text, size) : NULL;
}

const char *fst_chart_scene(fst_chart *chart, const fst_params *params)
{
    char *scene = fst_scene_text(params, 0);
    const char *copy = scene ? fst_chart_text(chart, scene) : NULL;
    free(scene);
    return copy;
}

void fst_chart_adopt(fst_chart *chart, fst_chart *other)
{
    block *last = other->memory;
    while (last && last->next)
        last = last->next;
    if (!last)
        return;
    last->next = chart->memory;
    chart->memory = other->memory;
    other->memory = NULL;
}

void fst_chart_free(fst_chart *chart)
{
    fst_keep_free(chart ? chart->memory : NULL);
    free(chart);
}
