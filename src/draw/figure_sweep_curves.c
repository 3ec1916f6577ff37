/* figure_sweep_curves.c - keys of a sweep against its one axis, in the style of the paper's Fig. 6. */
#include "draw/figure_sweep.h"

#include "base/constants.h"
#include "base/error.h"
#include "draw/chart.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 10000, MANY = 80 };

typedef struct drawing {
    const fst_sweep_table *table;
    fst_chart *chart;
    size_t points;   /* how many are drawn */
    int64_t *chosen; /* which ones */
    int *gaps;       /* what each of them is, a row of `signs`; -1: a motion, or not run */
    size_t failed;   /* points of the slice, drawn or not */
    int plain;       /* it is laid over others, of which the key says the number of failed points of none */
    int all_gaps;    /* there is no motion among them, an undecided one neither */
    double *states;  /* what became of each of them */
    double *x;
    fst_chart_curve *curves;
    fst_chart_panel *panels;
    int curve_count, panel_count;
    char about[320];
} drawing;

static int any_value(const double *values, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (isfinite(values[i]))
            return 1;
    return 0;
}

/* A key without any value gets no panel; the line below the title says so. */
static void mention_empty(drawing *d, const char *label)
{
    const size_t used = strlen(d->about);
    (void)snprintf(d->about + used, sizeof d->about - used, "%s%s",
                   strstr(d->about, "no value of: ") ? ", " : "; no value of: ", label);
}

/* The values of key k at the points that are drawn; NULL: no memory. */
static double *values_of(const drawing *d, int k)
{
    const double *all = d->table->values + (size_t)k * (size_t)fst_grid_points(d->table->grid);
    double *values = fst_chart_keep(d->chart, (d->points + 1) * sizeof *values);
    for (size_t i = 0; values && i < d->points; ++i)
        values[i] = all[d->chosen[i]];
    return values;
}

static void add_curve(drawing *d, const double *y, const char *title, fst_colour colour, fst_curve_style style)
{
    d->curves[d->curve_count++] = (fst_chart_curve){
        .title = title, .x = d->x, .y = y, .count = d->points, .colour = colour, .style = style};
}

/* Add a curve for each regime that occurs, at the heights `values`, so that the points show their regimes.  0: no
 * memory. */
static int add_regimes(drawing *d, const double *regime, const double *values)
{
    for (int r = 0; r < FST_REGIME_COUNT; ++r) {
        double *y = fst_chart_keep(d->chart, (d->points + 1) * sizeof *y);
        if (!y)
            return 0;
        for (size_t i = 0; i < d->points; ++i)
            y[i] = regime[i] == r ? values[i] : NAN;
        if (any_value(y, d->points))
            add_curve(d, y, fst_regime_name((fst_regime)r), fst_regime_colour(r), FST_CURVE_POINTS);
    }
    return 1;
}

/* Points without a motion whose values count, and gnuplot's numbers of their signs.  The last one has no regime. */
static const struct {
    const char *word;
    int sign;
} signs[FST_SWEEP_GAPS] = {{"undecided", 1}, {"ejected", 8}, {"lifted", 10},
                           {"touched", 12},  {"lost", 3},    {"failed", 2}};
enum { SIGNS = FST_SWEEP_GAPS, FAILED = FST_SWEEP_FAILED };

int fst_sweep_gap(const char *state_key, double state, int computed)
{
    const fst_sweep_names *names = fst_sweep_names_of(state_key);
    if (isnan(state))
        return computed ? FAILED : -1;
    for (int g = 0; g < FAILED; ++g)
        if (fst_name_place(signs[g].word, names->words) == (int)state)
            return g;
    return -1;
}

int fst_sweep_joins(const char *state_key, double state, double next)
{
    const int floats = strcmp(state_key, "below") == 0; /* a place goes on where its stability changes */
    return fst_sweep_gap(state_key, state, 1) < 0 && (state == next || floats);
}

fst_chart_curve fst_sweep_sign(const char *state_key, int gap)
{
    const fst_sweep_names *names = fst_sweep_names_of(state_key);
    const int place =
        fst_name_place(signs[gap].word, names->words); /* -1: rows of this kind have no such state */
    return (fst_chart_curve){.title = signs[gap].word,
                             .colour = place < 0 ? FST_COLOUR_BLACK : names->colours[place],
                             .style = FST_CURVE_OPEN_POINTS,
                             .right = 1,
                             .sign = signs[gap].sign};
}

/* Which of these the points are that are drawn; the key of their states is the one behind `count` others.  0: no memory. */
static int note_gaps(drawing *d, const fst_sweep_slice *slice, int count)
{
    const fst_grid *grid = d->table->grid;
    const double *all = d->table->values + (size_t)count * (size_t)fst_grid_points(grid);
    const double *states = d->states = values_of(d, count);
    d->gaps = fst_chart_keep(d->chart, (d->points + 1) * sizeof *d->gaps);
    d->all_gaps = d->points > 0;
    for (int64_t i = 0; i < slice->axes[0].count; ++i) {
        const int64_t point = slice->start + i * fst_grid_axis_stride(grid, slice->axes[0].index);
        d->failed += d->table->computed[point] && isnan(all[point]);
    }
    for (size_t i = 0; states && d->gaps && i < d->points; ++i) {
        d->gaps[i] = fst_sweep_gap(fst_sweep_state_key(grid), states[i], d->table->computed[d->chosen[i]]);
        d->all_gaps &= d->gaps[i] > FST_SWEEP_UNDECIDED;
    }
    return states && d->gaps;
}

/* Add signs at the lower edge of a panel for points without a value; unless names or colours tell what a point is, for those
 * with one too.  0: no memory. */
static int add_signs(drawing *d, const double *values, int told)
{
    char failed[48] = "failed";
    if (!d->plain)
        (void)snprintf(failed, sizeof failed, "failed: %zu point%s", d->failed, d->failed == 1 ? "" : "s");
    for (int g = 0; g < SIGNS; ++g) {
        double *y = fst_chart_keep(d->chart, (d->points + 1) * sizeof *y);
        fst_chart_curve sign = fst_sweep_sign(fst_sweep_state_key(d->table->grid), g);
        sign.title = fst_chart_text(d->chart, g == FAILED ? failed : sign.title);
        if (!y || !sign.title)
            return 0;
        for (size_t i = 0; i < d->points; ++i)
            y[i] = d->gaps[i] == g && !(told && isfinite(values[i])) ? FST_SWEEP_EDGE : NAN;
        sign.x = d->x;
        sign.y = y;
        sign.count = d->points;
        if (any_value(y, d->points))
            d->curves[d->curve_count++] = sign;
    }
    return 1;
}

/* Take away distances that are far beyond those of the motions, of which most runs must be, as of a bead that is on its
 * way out: its sign tells it, and the scale is that of the motions. */
static void hide_outliers(const drawing *d, const char *key, double *values)
{
    double low = INFINITY, high = -INFINITY;
    size_t decided = 0;
    for (size_t i = 0; i < d->points; ++i)
        if (d->gaps[i] < 0 && isfinite(values[i])) {
            low = fmin(low, values[i]);
            high = fmax(high, values[i]);
            ++decided;
        }
    const double wider = 2.0 * fmax(high - low, 0.5 * fmax(fabs(low), fabs(high)));
    const int told = 2 * decided > d->points && strcmp(key, "mean_r") == 0;
    for (size_t i = 0; i < d->points && told; ++i)
        if (d->gaps[i] >= 0 && !(values[i] >= low - wider && values[i] <= high + wider))
            values[i] = NAN;
}

/* Add a curve whose lines join neighbours of one state.  0: no memory. */
static int add_line(drawing *d, const double *values, fst_curve_style style)
{
    const char *key = fst_sweep_state_key(d->table->grid);
    double *x = fst_chart_keep(d->chart, (4 * d->points + 1) * sizeof *x), *y = x ? x + 2 * d->points : NULL;
    size_t count = 0;
    for (size_t i = 0; x && i < d->points; ++i) {
        x[count] = d->x[i];
        y[count++] = values[i];
        if (i + 1 < d->points && !fst_sweep_joins(key, d->states[i], d->states[i + 1]))
            x[count] = y[count] = NAN, ++count;
    }
    add_curve(d, y, NULL, FST_COLOUR_BLUE, style);
    d->curves[d->curve_count - 1].x = x;
    d->curves[d->curve_count - 1].count = count;
    return x != NULL;
}

/* A panel for one key, whose points have the colours of their regimes where these are given.  0: no memory. */
static int add_panel(drawing *d, const fst_sweep_quantity *quantity, const double *values, const double *regime,
                     fst_curve_style style)
{
    char tics[256];
    fst_chart_panel *panel = &d->panels[d->panel_count++];
    const int names = fst_sweep_result_tics(quantity->key, tics, sizeof tics), first = d->curve_count;
    const int empty = !any_value(values, d->points); /* there are signs alone */
    *panel = (fst_chart_panel){.left_label = fst_chart_text(d->chart, quantity->label),
                               .low = names ? -0.5 : NAN,
                               .high = names ? names - 0.5 : NAN,
                               .right_high = 1.0,
                               .tics = names   ? fst_chart_text(d->chart, tics)
                                       : empty ? "('' 0)"
                                               : NULL,
                               .curves = &d->curves[first]};
    if (!panel->left_label || (names && !panel->tics) || (regime && !add_regimes(d, regime, values)))
        return 0;
    if (!regime && !add_line(d, values, names ? FST_CURVE_POINTS : style))
        return 0;
    if (!add_signs(d, values, regime || names))
        return 0;
    panel->curve_count = d->curve_count - first;
    return 1;
}

/* One panel for each key.  The regime, where it is asked for beside other keys, has no panel: it colours the
 * points of all panels; where these are plain it has one if it was asked for.  (A colour that means a regime in one panel must not mean anything else in
 * the next.)  0: no memory. */
static int add_panels(drawing *d, const fst_sweep_quantity *quantities, int count, int plain)
{
    const fst_curve_style style = plain && d->points <= MANY ? FST_CURVE_LINE_POINTS : FST_CURVE_POINTS;
    const double *regime = NULL;
    for (int k = 1; k < count && !plain; ++k)
        if (strcmp(quantities[k].key, "regime") == 0 && !(regime = values_of(d, k)))
            return 0;
    for (int k = 0; k < count; ++k) {
        if (strcmp(quantities[k].key, "regime") == 0 && k > 0 && !(plain && quantities[k].asked))
            continue;
        double *values = values_of(d, k);
        if (!values)
            return 0;
        if (!fst_sweep_names_of(quantities[k].key))
            hide_outliers(d, quantities[k].key, values);
        if (!any_value(values, d->points) && !(plain && d->all_gaps))
            mention_empty(d, quantities[k].label);
        else if (!add_panel(d, &quantities[k], values, regime, style))
            return 0;
    }
    return 1;
}

/* Set the abscissa and its range: from the least value to the greatest, or half a unit beyond for a choice. */
static void lay_abscissa(drawing *d, const fst_sweep_axis *axis)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < d->points; ++i) {
        d->x[i] = fst_sweep_axis_value(d->table->grid, axis, d->chosen[i]);
        low = fmin(low, d->x[i]);
        high = fmax(high, d->x[i]);
    }
    const double wider = axis->choice ? 0.5 : low < high ? 0.0 : 0.1 * fabs(low);
    d->chart->x_low = low - wider;
    d->chart->x_high = high + wider;
}

/* The scaled angular velocity of a drive of 1 Hz, at the friction rate of these points; 0 for other axes. */
static double scale_of_drive(const fst_grid *grid, const fst_sweep_axis *axis, int64_t start)
{
    fst_params point;
    if (fst_grid_params(grid, start, &point, NULL) != FST_OK)
        return 0.0;
    const char *key = fst_grid_key(grid, axis->index);
    const double factor = FST_TWO_PI / point.friction_gamma;
    const int in_hertz = strcmp(key, "drive.frequency") == 0
                             ? axis->factor == 1.0
                             : strcmp(key, "drive.omega") == 0 && axis->factor != 1.0;
    return in_hertz ? factor : 0.0;
}

/* A point and where it stands on the axis. */
typedef struct stand {
    double x;
    int64_t point;
} stand;

static int by_place(const void *a, const void *b)
{
    const stand *one = a, *other = b;
    return one->x != other->x ? (one->x > other->x) - (one->x < other->x)
                              : (one->point > other->point) - (one->point < other->point);
}

/* Choose which points of a slice are drawn.  They are sorted along the axis, because a random axis or a list has them in any
 * order.  A refined sweep has only those that were computed.  Of many points each n-th is taken, at most MOST_POINTS, because a
 * figure shows no more.  Returns n; 0: no memory. */
static size_t choose_points(drawing *d, const fst_sweep_slice *slice)
{
    const fst_grid *grid = d->table->grid;
    const int64_t stride = fst_grid_axis_stride(grid, slice->axes[0].index), count = slice->axes[0].count;
    size_t seen = 0;
    stand *stands = fst_chart_keep(d->chart, (size_t)(count + 1) * sizeof *stands);
    d->chosen = fst_chart_keep(d->chart, (size_t)(count + 1) * sizeof *d->chosen);
    if (!d->chosen || !stands)
        return 0;
    for (int64_t i = 0; i < count; ++i) {
        const int64_t point = slice->start + i * stride;
        if (!d->table->refine || d->table->computed[point])
            stands[seen++] = (stand){fst_sweep_axis_value(grid, &slice->axes[0], point), point};
    }
    qsort(stands, seen, sizeof *stands, by_place);
    const size_t step = seen > MOST_POINTS ? (seen + MOST_POINTS - 1) / MOST_POINTS : 1;
    for (size_t i = 0; i < seen; i += step)
        d->chosen[d->points++] = stands[i].point;
    return step;
}

/* Title, the line below it and the abscissas.  0: no memory. */
static int dress(drawing *d, const fst_sweep_axis *axis, int64_t start)
{
    char words[128], title[192], tics[512];
    const double scale = scale_of_drive(d->table->grid, axis, start);
    fst_sweep_words(axis->label, words);
    (void)snprintf(title, sizeof title, "Sweep over the %s", words);
    if (axis->choice)
        fst_sweep_choice_tics(axis, tics, sizeof tics);
    fst_chart *chart = d->chart;
    chart->title = fst_chart_text(chart, title);
    chart->about = fst_chart_text(chart, d->about);
    chart->scene = fst_chart_scene(chart, fst_grid_base(d->table->grid));
    chart->x_label = fst_chart_text(chart, axis->label);
    chart->x_tics = axis->choice ? fst_chart_text(chart, tics) : NULL;
    chart->x_logarithmic = axis->logarithmic;
    chart->x2_label = scale > 0 ? "drive ω (γ)" : NULL;
    chart->x2_factor = scale;
    chart->panels = d->panels;
    chart->panel_count = d->panel_count;
    return chart->title && chart->about && chart->x_label && (!axis->choice || chart->x_tics);
}

/* FST_NO_MEMORY needs no sentence yet. */
static fst_status fill(drawing *d, const fst_sweep_quantity *quantities, int count,
                       const fst_sweep_slice *slice, int plain)
{
    d->plain = plain;
    const size_t step = choose_points(d, slice);
    d->x = fst_chart_keep(d->chart, (d->points + 1) * sizeof *d->x);
    d->curves = fst_chart_keep(d->chart, (size_t)(count * (FST_REGIME_COUNT + SIGNS)) * sizeof *d->curves);
    d->panels = fst_chart_keep(d->chart, (size_t)count * sizeof *d->panels);
    if (step == 0 || !d->x || !d->curves || !d->panels)
        return FST_NO_MEMORY;
    if (!note_gaps(d, slice, count))
        return FST_NO_MEMORY;
    lay_abscissa(d, &slice->axes[0]);
    fst_sweep_about(d->table, slice->whole ? slice->whole : slice, d->about, sizeof d->about);
    size_t used = strlen(d->about);
    if (slice->words[0])
        used += (size_t)snprintf(d->about + used, sizeof d->about - used, "; at %s", slice->words);
    if (step > 1 && used < sizeof d->about)
        (void)snprintf(d->about + used, sizeof d->about - used, "; drawn: one point of %zu", step);
    return add_panels(d, quantities, count, plain) && dress(d, &slice->axes[0], slice->start) ? FST_OK
                                                                                              : FST_NO_MEMORY;
}

fst_status fst_sweep_curves(const fst_sweep_table *table, const fst_sweep_quantity *quantities, int count,
                            const fst_sweep_slice *slice, int plain, fst_chart **chart, fst_error *error)
{
    drawing d = {.table = table, .chart = fst_chart_new()};
    *chart = d.chart;
    const fst_status status = d.chart ? fill(&d, quantities, count, slice, plain) : FST_NO_MEMORY;
    if (status == FST_OK && d.panel_count > 0)
        return FST_OK;
    fst_chart_free(d.chart);
    *chart = NULL;
    return status == FST_OK ? fst_fail(error, FST_BAD_INPUT, "fst_figure_sweep", "%s", fst_sweep_blank(table))
                            : fst_fail(error, FST_NO_MEMORY, "fst_figure_sweep", "no memory for a figure");
}
