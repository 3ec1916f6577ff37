/* figure_points.c - measured points over the curves of a sweep or of a branch, with chi^2. */
#include "measure/point_curves.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "draw/caption.h"
#include "draw/charts_over.h"
#include "draw/figure_branch.h"
#include "draw/figure_sweep.h"
#include "draw/legend.h"

/* Everything that is drawn. */
typedef struct drawing {
    const char *const *results, *const *tables;
    int result_count, table_count;
    fst_point_curves models[FST_CHARTS_OVER];
    fst_points points[FST_CHARTS_OVER];
    fst_points_fit fits[FST_CHARTS_OVER * FST_CHARTS_OVER]; /* of model m and table p: m * table_count + p */
    double frequency, factors[FST_MEASURED_COUNT];          /* of the wanted units, from Hz and SI */
    const char *labels[FST_MEASURED_COUNT + 1];             /* the last one: of the abscissa */
    int wanted[FST_MEASURED_COUNT], chosen;                 /* the quantities; whether by their names */
    char about[640], model_words[FST_CHARTS_OVER][128], table_words[FST_CHARTS_OVER][128];
    fst_chart *chart;
    fst_chart_panel panels[FST_MEASURED_COUNT];
} drawing;

static fst_status no_memory(fst_error *error)
{
    return fst_fail(error, FST_NO_MEMORY, "", "no memory for a figure");
}

/* Lengths in mm, or m, and Hz; or in l and gamma, which must be those of all models. */
static fst_status choose_units(drawing *d, fst_shown_units units, fst_error *error)
{
    static const char *const labels[][FST_MEASURED_COUNT + 1] = {
        {"mean r (mm)", "deviation of r (mm)", "bead frequency (Hz)", "drive frequency (Hz)"},
        {"mean r (m)", "deviation of r (m)", "bead frequency (Hz)", "drive frequency (Hz)"},
        {"mean r (ℓ)", "deviation of r (ℓ)", "mean α' (γ)", "drive ω (γ)"}};
    const fst_point_curves *first = &d->models[0];
    const int by_scales = units == FST_SHOWN_SCALED;
    for (int m = 0; by_scales && m < d->result_count; ++m)
        if (d->models[m].gamma != first->gamma || d->models[m].length != first->length)
            return fst_fail(error, FST_BAD_INPUT, d->results[m],
                            "it has another l or another gamma than %.200s: points over both have no scaled "
                            "units in common",
                            fst_file_name(d->results[0]));
    const double length = by_scales ? 1.0 / first->length : units == FST_SHOWN_SI ? 1.0 : 1e3;
    const double rate = by_scales ? FST_TWO_PI / first->gamma : 1.0;
    const double factors[] = {length, length, rate};
    memcpy(d->factors, factors, sizeof factors);
    memcpy(d->labels, labels[by_scales ? 2 : units == FST_SHOWN_SI], sizeof d->labels);
    d->frequency = rate;
    return FST_OK;
}

/* chi^2 of one table before one model, where the figure has one of either. */
static void tell_fit(const fst_points_fit *fit, const char *name, char text[128])
{
    char words[96];
    fst_plain_words(name, words, sizeof words);
    (void)snprintf(text, 128, "%s: χ² = %.4g of %d", words, fit->chi2, fit->counted);
}

/* The words of the key and of the line below the title. */
static void name_all(drawing *d)
{
    static const char *const shown[] = {"drive.frequency", "drive.omega"};
    char names[FST_CHARTS_OVER][FST_CAPTION_SIZE], same[FST_CAPTION_SIZE];
    const fst_params *scenes[FST_CHARTS_OVER];
    const char *slices[FST_CHARTS_OVER];
    const fst_points_fit *fit = &d->fits[0];
    const int alone = d->result_count == 1 && d->table_count == 1;
    for (int m = 0; m < d->result_count; ++m) {
        scenes[m] = d->models[m].scene;
        slices[m] = d->models[m].slice;
    }
    fst_caption_of_files(scenes, d->results, d->result_count, shown, 2, names, same, sizeof same);
    fst_caption_slices(slices, d->result_count, names[0], same, sizeof same);
    for (int m = 0; m < d->result_count; ++m)
        if (d->result_count > 1 && d->table_count == 1)
            tell_fit(&d->fits[m], names[m], d->model_words[m]);
        else
            fst_plain_words(d->result_count == 1 ? "model" : names[m], d->model_words[m],
                            sizeof *d->model_words);
    for (int p = 0; p < d->table_count; ++p)
        if (d->table_count > 1 && d->result_count == 1)
            tell_fit(&d->fits[p], fst_file_name(d->tables[p]), d->table_words[p]);
        else
            fst_plain_words(d->table_count == 1 ? "measured" : fst_file_name(d->tables[p]), d->table_words[p],
                            sizeof *d->table_words);
    if (alone)
        (void)snprintf(d->about, sizeof d->about, "χ² = %.4g of %d measured numbers%s", fit->chi2, fit->counted,
                       fit->counted < fit->all ? ", where there is a stable curve" : "");
    const size_t used = strlen(d->about);
    (void)snprintf(d->about + used, sizeof d->about - used, "%s%s", used && same[0] ? "; " : "", same);
}

/* The stable pieces, or the others, of one model as a curve with gaps. */
static int put_model(drawing *d, int m, int quantity, int stable, int *named, fst_chart_curve *curve)
{
    const fst_point_curves *p = &d->models[m];
    const size_t room = 3 * p->count[quantity] + 1;
    double *x = fst_chart_keep(d->chart, 2 * room * sizeof *x), *y = x + room;
    size_t count = 0;
    const fst_curve_piece *before = NULL;
    for (size_t i = 0; x && i < p->count[quantity]; ++i) {
        const fst_curve_piece *here = &p->list[quantity][i];
        if (here->stable != stable)
            continue;
        const int joined = before && before->x[1] == here->x[0] && before->y[1] == here->y[0];
        if (before && !joined)
            x[count] = y[count] = NAN, ++count; /* a gap */
        /* A run alone is one point. */
        const int ends = here->x[0] == here->x[1] && here->y[0] == here->y[1] ? 1 : 2;
        for (int end = joined; end < ends; ++end, ++count) {
            x[count] = d->frequency * here->x[end];
            y[count] = d->factors[quantity] * here->y[end];
        }
        before = here;
    }
    *curve = (fst_chart_curve){
        .title = stable                ? d->model_words[m]
                 : d->result_count > 1 ? (*named ? NULL : "unstable")
                                       : "model, unstable",
        .x = x,
        .y = y,
        .count = count,
        .colour = !stable && d->result_count == 1 ? FST_COLOUR_GREY : fst_chart_colour(m),
        .style = stable ? p->is_sweep ? FST_CURVE_LINE_POINTS : FST_CURVE_LINE : FST_CURVE_DASHED};
    *named |= !stable && count;
    return x != NULL;
}

static int has_special(const fst_point_curves *models, int count, int type)
{
    for (int m = 0; m < count; ++m)
        for (size_t i = 0; i < models[m].special_count; ++i)
            if ((int)models[m].specials[i].type == type)
                return 1;
    return 0;
}

/* The special points of one model, those of a type after the other; returns how many curves there are, -1: no memory. */
static int put_specials(drawing *d, int m, int quantity, fst_chart_curve *curves)
{
    const fst_point_curves *p = &d->models[m];
    int count = 0;
    for (int type = 0; type < FST_SPECIAL_COUNT; ++type) {
        double *x = fst_chart_keep(d->chart, 2 * (p->special_count + 1) * sizeof *x), *y = x + p->special_count;
        size_t found = 0;
        for (size_t i = 0; x && i < p->special_count; ++i)
            if ((int)p->specials[i].type == type && isfinite(p->specials[i].y[quantity])) {
                x[found] = d->frequency * p->specials[i].x;
                y[found++] = d->factors[quantity] * p->specials[i].y[quantity];
            }
        if (!x)
            return -1;
        if (found == 0)
            continue;
        curves[count] = fst_special_curve((fst_special_type)type);
        curves[count].x = x;
        curves[count].y = y;
        curves[count].count = found;
        if (d->result_count > 1)
            curves[count].colour = fst_chart_colour(m);
        if (has_special(d->models, m, type))
            curves[count].title = NULL; /* the key names a sign once */
        ++count;
    }
    return count;
}

/* The runs of one model that are no motion, as signs at the lower edge, `level` lines higher because other models may have
 * signs at the same place.  Returns as put_specials() does. */
static int put_gaps(drawing *d, int m, int level, int *named, fst_chart_curve *curves)
{
    const fst_point_curves *p = &d->models[m];
    int count = 0,
        nameless = d->result_count > 1 && p->count[FST_MEASURED_MEAN_R] == 0; /* no curve has its name */
    for (int gap = 0; gap < FST_SWEEP_GAPS; ++gap) {
        double *x = fst_chart_keep(d->chart, 2 * (p->gap_count + 1) * sizeof *x), *y = x + p->gap_count;
        size_t found = 0;
        if (!x)
            return -1;
        for (size_t i = 0; i < p->gap_count; ++i)
            if (p->gaps[i].gap == gap) {
                x[found] = d->frequency * p->gaps[i].x;
                y[found++] = FST_SWEEP_EDGE + 0.04 * level;
            }
        if (found == 0)
            continue;
        fst_chart_curve *here = &curves[count++];
        *here = fst_sweep_sign("regime", gap);
        here->x = x;
        here->y = y;
        here->count = found;
        if (d->result_count > 1)
            here->colour = fst_chart_colour(m);
        if (nameless) {
            char words[192];
            (void)snprintf(words, sizeof words, "%s: %s", d->model_words[m], here->title);
            here->title = fst_chart_text(d->chart, words);
            nameless = 0;
        } else if (*named & 2 << gap) {
            here->title = NULL; /* the key names a sign once */
        } else {
            *named |= 2 << gap;
        }
    }
    return count;
}

/* What one table has of a quantity, with its errors. */
static int put_points(drawing *d, int p, int quantity, fst_chart_curve *curve)
{
    static const int signs[] = {7, 5, 9, 13, 11, 15}; /* discs, squares, triangles, ... of gnuplot */
    const fst_points *points = &d->points[p];
    double *x = fst_chart_keep(d->chart, 3 * (points->count + 1) * sizeof *x);
    double *y = x + points->count, *spread = y + points->count;
    size_t count = 0;
    for (size_t i = 0; x && i < points->count; ++i)
        if (isfinite(points->rows[i].value[quantity])) {
            x[count] = d->frequency * points->rows[i].frequency;
            y[count] = d->factors[quantity] * points->rows[i].value[quantity];
            spread[count++] = d->factors[quantity] * points->rows[i].error[quantity];
        }
    *curve = (fst_chart_curve){.title = d->table_words[p],
                               .x = x,
                               .y = y,
                               .spread = spread,
                               .count = count,
                               .colour = fst_chart_colour(d->result_count + p),
                               .sign = signs[p % (int)(sizeof signs / sizeof *signs)],
                               .style = FST_CURVE_ERRORS};
    return x != NULL;
}

/* A panel of one quantity, if a table has it. */
static int put_panel(drawing *d, int quantity, int *named)
{
    fst_chart_curve *curves =
        fst_chart_keep(d->chart, (3 + FST_SPECIAL_COUNT + FST_SWEEP_GAPS) * FST_CHARTS_OVER * sizeof *curves);
    fst_chart_panel *panel = &d->panels[d->chart->panel_count];
    int good = curves != NULL, count = 0, level = 0, known = 0;
    size_t measured = 0;
    for (int m = 0; m < d->result_count && good; ++m)
        for (int stable = 1; stable >= 0 && good; --stable)
            good = put_model(d, m, quantity, stable, named, &curves[count++]);
    for (int m = 0; m < d->result_count && good; ++m) {
        known |= d->models[m].is_sweep || d->models[m].count[quantity] > 0;
        const int specials = put_specials(d, m, quantity, &curves[count]);
        good = specials >= 0;
        count += good ? specials : 0;
    }
    for (int m = 0; m < d->result_count && good; ++m) {
        const int gaps = put_gaps(d, m, level, named, &curves[count]);
        good = gaps >= 0;
        count += good ? gaps : 0;
        level += gaps > 0;
    }
    for (int p = 0; p < d->table_count && good; ++p) {
        good = put_points(d, p, quantity, &curves[count]);
        measured += curves[count++].count;
    }
    *panel = (fst_chart_panel){.left_label = d->labels[quantity],
                               .low = NAN,
                               .high = NAN,
                               .right_high = 1.0,
                               .curves = curves,
                               .curve_count = count};
    d->chart->panel_count += measured > 0 && known; /* a branch has not all quantities */
    return good;
}

/* From the first frequency of a curve or a point to the last one. */
static void choose_range(drawing *d)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < d->chart->panel_count; ++i)
        for (int c = 0; c < d->panels[i].curve_count; ++c)
            for (size_t k = 0; k < d->panels[i].curves[c].count; ++k) {
                low = fmin(low, d->panels[i].curves[c].x[k]); /* not NAN, which is a gap */
                high = fmax(high, d->panels[i].curves[c].x[k]);
            }
    const double margin = 0.02 * (high - low) + 1e-3 * d->frequency;
    d->chart->x_low = low - margin;
    d->chart->x_high = high + margin;
}

static fst_status draw(drawing *d, const fst_sweep_figure *options, const char *out, fst_error *error)
{
    int good = (d->chart = fst_chart_new()) != NULL, named = 0;
    if (!good)
        return no_memory(error);
    name_all(d);
    *d->chart = (fst_chart){.title = "Measured points over the computed curves",
                            .about = d->about[0] ? d->about : NULL,
                            .x_label = d->labels[FST_MEASURED_COUNT],
                            .panels = d->panels};
    for (int q = 0; q < FST_MEASURED_COUNT && good; ++q)
        if (d->wanted[q])
            good = put_panel(d, q, &named);
    choose_range(d);
    const fst_status status = good && d->chart->panel_count == 0
                                  ? fst_fail(error, FST_BAD_INPUT, d->results[0],
                                             "a branch has none of the measured quantities that are asked for")
                              : good ? fst_figure_chart_as(out, d->chart, options->title, options->size, error)
                                     : no_memory(error);
    fst_chart_free(d->chart);
    return status;
}

/* The quantities that are asked for, also by what a branch calls the bead's frequency; all, unless there are some. */
static fst_status choose_quantities(drawing *d, const char *const *keys, fst_error *error)
{
    static const char *const names = &FST_MEASURED_QUANTITIES(FST_ROW_WORD) "|mean_alpha_dot"[1];
    char suggestion[FST_SUGGESTION_SIZE];
    for (int i = 0; i < FST_SWEEP_FIGURE_KEYS && keys[i]; ++i, d->chosen = 1) {
        const int place = fst_name_place(keys[i], names);
        if (place < 0)
            return fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.keys",
                            "tables of measured points have no \"%.60s\"; %s", keys[i],
                            fst_suggest_name(keys[i], names, suggestion));
        d->wanted[place < FST_MEASURED_COUNT ? place : FST_MEASURED_BEAD_FREQUENCY] = 1;
    }
    for (int q = 0; q < FST_MEASURED_COUNT && !d->chosen; ++q)
        d->wanted[q] = 1;
    return FST_OK;
}

static fst_status read_all(drawing *d, const fst_sweep_figure *options, fst_error *error)
{
    int used[FST_AXIS_LIMIT] = {0};
    fst_status status = FST_OK;
    for (int p = 0; p < d->table_count && status == FST_OK; ++p)
        status = fst_points_read(d->tables[p], &d->points[p], error);
    for (int m = 0; m < d->result_count && status == FST_OK; ++m)
        status = fst_point_curves_read(d->results[m], d->points, d->table_count, options, used, &d->models[m],
                                       error);
    if (status == FST_OK)
        status = fst_sweep_check_used(options, used, error);
    for (int i = 0; i < d->result_count * d->table_count && status == FST_OK; ++i) {
        const int p = i % d->table_count;
        d->fits[i] = fst_point_curves_fit(&d->models[i / d->table_count], &d->points[p], d->wanted);
        if (d->fits[i].all == 0)
            status = fst_fail(error, FST_BAD_INPUT, d->tables[p], "this table has no measured number%s",
                              d->chosen ? " of what is asked for" : "");
    }
    return status;
}

fst_status fst_figure_points(const char *const *results, int result_count, const char *const *tables,
                             int table_count, const fst_sweep_figure *options, const char *out,
                             fst_points_fit *fits, fst_error *error)
{
    const fst_sweep_figure usual = {.kind = FST_FIGURE_PATH};
    options = options ? options : &usual;
    if (result_count < 1 || result_count > FST_CHARTS_OVER || table_count < 1 || table_count > FST_CHARTS_OVER)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_points",
                        "%d tables of points over %d files: 1 to %d of either are expected", table_count,
                        result_count, FST_CHARTS_OVER);
    drawing *d = calloc(1, sizeof *d);
    if (!d)
        return no_memory(error);
    d->results = results;
    d->tables = tables;
    d->result_count = result_count;
    d->table_count = table_count;
    fst_status status = choose_quantities(d, options->keys, error);
    if (status == FST_OK)
        status = read_all(d, options, error);
    if (status == FST_OK)
        status = choose_units(d, options->units, error);
    if (status == FST_OK)
        status = draw(d, options, out, error);
    if (status == FST_OK && fits)
        memcpy(fits, d->fits, (size_t)(result_count * table_count) * sizeof *fits);
    for (int m = 0; m < result_count; ++m)
        fst_point_curves_free(&d->models[m]);
    for (int p = 0; p < table_count; ++p)
        fst_points_free(&d->points[p]);
    free(d);
    return status;
}
