/* figure_sweep.c - fst_figure_sweep(): which part of a sweep is shown, which keys, and as curves or as a map. */
#include "draw/figure_sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/units.h"
#include "draw/charts_over.h"

enum {
    USUAL = 4,
    FEW = 7 /* values of an axis, which are a family of curves unless a map is asked for */
};

/* What is shown of a sweep, read from its file. */
typedef struct shown_sweep {
    fst_sweep_slice slice;
    fst_sweep_quantity quantities[FST_SWEEP_FIGURE_KEYS];
    int count, is_map;
    fst_sweep_table table;
} shown_sweep;

/* ------------------------------------------------------------------ slices */

static const fst_param_info *row_of(const fst_grid *grid, int axis)
{
    return fst_param_at(fst_param_find(fst_grid_key(grid, axis)));
}

/* Without the last digits, which rounding leaves between the ends of an axis: 0.39999999999999997 is meant as 0.4. */
static double as_meant(double value)
{
    const double digits = 12.0 - ceil(log10(fabs(value))), power = pow(10.0, digits);
    return digits >= 0.0 && digits <= 22.0 ? round(value * power) / power : value;
}

/* A value of an axis as people write it. */
static void write_value(const fst_param_info *row, double value, char *text, size_t size)
{
    size_t length;
    const char *name = row->kind == FST_KIND_CHOICE ? fst_name_at(row->names, (int)value, &length) : NULL;
    if (name)
        (void)snprintf(text, size, "%.*s", (int)length, name);
    else
        (void)fst_value_write(text, size, as_meant(value), row->unit);
}

/* The number that a text says for a key: of a choice, the place of its name. */
static fst_status read_value(const fst_grid *grid, int axis, const char *text, double *value, fst_error *error)
{
    fst_params params = *fst_grid_base(grid);
    const fst_param_info *row = row_of(grid, axis);
    char kept[64];
    const fst_status status = fst_params_set(&params, row->key, text, error);
    if (status != FST_OK)
        return status;
    (void)fst_params_get(&params, fst_param_find(row->key), kept, sizeof kept);
    if (row->kind != FST_KIND_CHOICE)
        return fst_parse_value(kept, row->unit, value, error);
    size_t length;
    for (int i = 0; *fst_name_at(row->names, i, &length); ++i)
        if (strlen(kept) == length && strncmp(kept, fst_name_at(row->names, i, &length), length) == 0)
            *value = i;
    return FST_OK;
}

/* The axis that a text "KEY=VALUE" names, and its value. */
static fst_status read_at(const fst_grid *grid, const char *text, int *axis, double *value, fst_error *error)
{
    char key[64] = "", names[512] = "", suggestion[FST_SUGGESTION_SIZE];
    const char *equals = strchr(text, '=');
    if (equals && equals - text < (ptrdiff_t)sizeof key)
        (void)snprintf(key, sizeof key, "%.*s", (int)(equals - text), text);
    *axis = -1;
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "", fst_grid_key(grid, i));
        if (fst_sweep_is_at(text, fst_grid_key(grid, i)))
            *axis = i;
    }
    if (!equals || *axis < 0)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.at",
                        equals ? "the sweep does not vary \"%.60s\"; %s" : "\"%.60s\" is not KEY=VALUE; %s",
                        equals ? key : text, fst_suggest_name(key, names, suggestion));
    return read_value(grid, *axis, equals + 1, value, error);
}

/* The place of a value on an axis; FST_BAD_INPUT: it is not there, and the sentence has the nearest. */
static fst_status find_value(const fst_grid *grid, int axis, double value, int64_t *place, fst_error *error)
{
    const int64_t stride = fst_grid_axis_stride(grid, axis);
    char wanted[64], nearest[64];
    *place = 0;
    for (int64_t i = 1; i < fst_grid_axis_points(grid, axis); ++i)
        if (fabs(fst_grid_value(grid, axis, i * stride) - value) <
            fabs(fst_grid_value(grid, axis, *place * stride) - value))
            *place = i;
    const double found = fst_grid_value(grid, axis, *place * stride);
    if (fabs(found - value) <= 1e-9 * fmax(fabs(found), fabs(value)))
        return FST_OK;
    const fst_param_info *row = row_of(grid, axis);
    write_value(row, value, wanted, sizeof wanted);
    write_value(row, found, nearest, sizeof nearest);
    return fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.at",
                    "the sweep has no points at %s = %s; the nearest value is %s", row->key, wanted, nearest);
}

/* Add to the words of a slice that an axis has this value there. */
static void tell_value(const fst_grid *grid, int axis, int64_t place, char *words, size_t size)
{
    const size_t used = strlen(words);
    char text[64];
    write_value(row_of(grid, axis), fst_grid_value(grid, axis, place * fst_grid_axis_stride(grid, axis)), text,
                sizeof text);
    (void)snprintf(words + used, size - used, "%s%s %s", used ? ", " : "", fst_grid_key(grid, axis), text);
}

static int is_random(const fst_grid *grid)
{
    for (int i = 0; i < fst_grid_axis_count(grid); ++i)
        for (int j = 0; j < i; ++j)
            if (fst_grid_axis_points(grid, i) > 1 && fst_grid_axis_points(grid, j) > 1 &&
                fst_grid_axis_stride(grid, i) == fst_grid_axis_stride(grid, j))
                return 1;
    return 0;
}

fst_status fst_sweep_cut(const fst_grid *grid, const char *path, const fst_sweep_figure *options,
                         fst_shown_units units, fst_sweep_slice *slice, fst_error *error)
{
    int fixed[FST_AXIS_LIMIT] = {0};
    *slice = (fst_sweep_slice){.varied = 0};
    fst_status status = FST_OK;
    for (int i = 0; i < FST_AXIS_LIMIT && options->at[i] && status == FST_OK; ++i) {
        int axis = 0;
        int64_t place = 0;
        double value;
        status = is_random(grid) ? fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.at",
                                            "random points have no slices: use fst_sweep_export()")
                                 : read_at(grid, options->at[i], &axis, &value, error);
        if (status == FST_OK)
            status = find_value(grid, axis, value, &place, error);
        if (status == FST_OK && fixed[axis]++)
            status = fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.at", "%s is given twice",
                              fst_grid_key(grid, axis));
        if (status != FST_OK || fst_grid_axis_points(grid, axis) < 2)
            continue;
        slice->start += place * fst_grid_axis_stride(grid, axis);
        tell_value(grid, axis, place, slice->words, sizeof slice->words);
    }
    for (int i = 0; i < fst_grid_axis_count(grid) && status == FST_OK; ++i)
        if (fst_grid_axis_points(grid, i) > 1 && !fixed[i])
            status = fst_sweep_axis_of(grid, i, units, &slice->axes[slice->varied++], error);
    if (status == FST_OK && (slice->varied < 1 || slice->varied > 2))
        status = fst_fail(error, FST_BAD_INPUT, path,
                          "a figure shows a sweep over one or two axes, and there are %d: fst_sweep_figure.at "
                          "takes those points where another axis has a value",
                          slice->varied);
    return status;
}

fst_sweep_figure fst_sweep_figure_of(const fst_grid *grid, const fst_sweep_figure *of, int used[FST_AXIS_LIMIT])
{
    fst_sweep_figure figure = *of;
    int count = 0;
    memset(figure.at, 0, sizeof figure.at);
    for (int i = 0; i < FST_AXIS_LIMIT && of->at[i]; ++i)
        for (int axis = 0; axis < fst_grid_axis_count(grid); ++axis)
            if (fst_sweep_is_at(of->at[i], fst_grid_key(grid, axis))) {
                figure.at[count++] = of->at[i];
                used[i] = 1;
            }
    return figure;
}

fst_status fst_sweep_check_used(const fst_sweep_figure *figure, const int used[FST_AXIS_LIMIT],
                                fst_error *error)
{
    for (int i = 0; i < FST_AXIS_LIMIT && figure->at[i]; ++i)
        if (!used[i])
            return fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.at",
                            "no sweep of these varies what \"%.80s\" says", figure->at[i]);
    return FST_OK;
}

/* ------------------------------------------------------------------ keys */

/* The keys that are shown unless others are asked for; returns how many. */
static int choose_keys(const fst_grid *grid, int is_map, const char *keys[USUAL])
{
    const fst_row_kind kind = fst_grid_row_kind(grid);
    static const char *const curves[][USUAL] = {
        [FST_ROWS_OF_RUNS] = {"mean_r", "std_r", "mean_alpha_dot", "regime"},
        [FST_ROWS_OF_BEADS] = {"outcome", "mean_r", "centre_rate", "axis_rate"},
        [FST_ROWS_OF_WORLDS] = {"mean_r", "mean_alpha_dot", "regime"},
        [FST_ROWS_OF_LEVITATION] = {"below_height_mm", "below_growth_per_s", "above_height_mm",
                                    "above_growth_per_s"}};
    int count = 0;
    for (; count < USUAL && curves[kind][count] && !is_map; ++count)
        keys[count] = curves[kind][count];
    if (kind == FST_ROWS_OF_WORLDS && fst_grid_base(grid)->drive_waveform == FST_WAVEFORM_WAVE && !is_map) {
        keys[0] = "mean_velocity"; /* it travels, and r grows for ever */
        keys[1] = "regime";
        return 2;
    }
    if (is_map)
        keys[count++] = kind == FST_ROWS_OF_LEVITATION ? "below"
                        : kind == FST_ROWS_OF_BEADS    ? "outcome"
                                                       : "regime";
    return count;
}

/* A map shows one key over two axes.  Unless it is asked for, an axis of few values makes a family of curves, but for keys
 * whose values are names, as the first of several beads and of levitation is, and where points are random. */
static int wants_map(const fst_grid *grid, const fst_sweep_figure *options, const fst_sweep_slice *slice)
{
    if (slice->varied < 2)
        return 0;
    if (options->kind == FST_FIGURE_CURVES || options->kind == FST_FIGURE_MAP)
        return options->kind == FST_FIGURE_MAP;
    const fst_row_kind rows = fst_grid_row_kind(grid);
    const int64_t fewest =
        slice->axes[0].count < slice->axes[1].count ? slice->axes[0].count : slice->axes[1].count;
    return fewest > FEW || is_random(grid) || rows == FST_ROWS_OF_BEADS || rows == FST_ROWS_OF_LEVITATION ||
           (options->keys[0] && fst_sweep_names_of(options->keys[0]));
}

static fst_status choose_quantities(const fst_grid *grid, const fst_sweep_figure *options,
                                    fst_shown_units units, shown_sweep *s, const char **keys, fst_error *error)
{
    while (s->count < FST_SWEEP_FIGURE_KEYS && options->keys[s->count]) {
        keys[s->count] = options->keys[s->count];
        ++s->count;
    }
    if (s->is_map && s->count > 1)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.keys", "a map shows one key, not %d", s->count);
    if (s->count == 0)
        s->count = choose_keys(grid, s->is_map, keys);
    for (int i = 0; i < s->count; ++i) {
        s->quantities[i] = fst_sweep_quantity_of(grid, keys[i], units);
        s->quantities[i].asked = options->keys[0] != NULL;
    }
    return FST_OK;
}

static fst_status read_sweep(const char *path, const fst_sweep_figure *options, shown_sweep *s,
                             fst_error *error)
{
    const char *keys[FST_SWEEP_FIGURE_KEYS + USUAL];
    fst_grid *grid;
    *s = (shown_sweep){.count = 0};
    if (options->kind != FST_FIGURE_PATH && options->kind != FST_FIGURE_CURVES &&
        options->kind != FST_FIGURE_MAP)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.kind",
                        "this kind of figure is of trajectories; a sweep has curves and map");
    fst_status status = fst_sweep_read_grid(path, &grid, error);
    if (status != FST_OK)
        return status;
    const fst_shown_units units =
        options->units != FST_SHOWN_AS_GIVEN ? options->units : fst_sweep_units(grid, options->at);
    status = fst_sweep_cut(grid, path, options, units, &s->slice, error);
    if (status == FST_OK) {
        s->is_map = wants_map(grid, options, &s->slice);
        status = choose_quantities(grid, options, units, s, keys, error);
    }
    keys[s->count] = fst_sweep_state_key(grid);
    if (status == FST_OK && options->kind == FST_FIGURE_MAP && !s->is_map)
        status = fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.kind", "a map needs a sweep over two axes");
    if (status == FST_OK && !s->is_map && is_random(grid))
        status = fst_fail(error, FST_BAD_INPUT, path, "random points make no curves: use fst_sweep_export()");
    fst_grid_free(grid);
    if (status != FST_OK)
        return status;
    status = s->is_map ? fst_sweep_read_filled(path, keys, s->count, &s->table, error)
                       : fst_sweep_read(path, keys, s->count + 1, &s->table, error);
    return status == FST_OK ? fst_sweep_convert(&s->table, &s->slice, s->quantities, s->count, error) : status;
}

/* ------------------------------------------------------------------ curves */

/* A curve for each value of the axis that has fewer, over the other. */
static fst_status family_of(const shown_sweep *s, fst_chart **chart, fst_error *error)
{
    fst_chart *charts[FST_CHARTS_OVER] = {NULL};
    char names[FST_CHARTS_OVER][64];
    const int fewer = s->slice.axes[0].count < s->slice.axes[1].count ? 0 : 1;
    const fst_sweep_axis *one = &s->slice.axes[fewer];
    fst_sweep_slice slice = s->slice;
    slice.varied = 1;
    slice.whole = &s->slice;
    slice.axes[0] = s->slice.axes[1 - fewer];
    if (one->count > FST_CHARTS_OVER)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.kind",
                        "%lld curves in one figure are too many, %d are the most: a map shows them",
                        (long long)one->count, FST_CHARTS_OVER);
    fst_status status = FST_OK;
    int count = 0;
    for (int64_t i = 0; i < one->count && status == FST_OK; ++i) {
        fst_error why = {.where = ""};
        slice.start = s->slice.start + i * fst_grid_axis_stride(s->table.grid, one->index);
        names[count][0] = '\0';
        tell_value(s->table.grid, one->index, i, names[count], sizeof names[count]);
        status = fst_sweep_curves(&s->table, s->quantities, s->count, &slice, 1, &charts[count], &why);
        if (status == FST_OK)
            ++count;
        else if (status == FST_BAD_INPUT && (count > 0 || i + 1 < one->count))
            status = FST_OK; /* no point of this curve has a value */
        else if (error)
            *error = why;
    }
    const char *words[FST_CHARTS_OVER];
    for (int i = 0; i < count; ++i)
        words[i] = names[i];
    if (status == FST_OK)
        status = fst_charts_over(charts, words, count, "", chart, error);
    for (int i = 0; i < count; ++i)
        fst_chart_free(charts[i]);
    return status;
}

fst_status fst_chart_of_sweep(const char *path, const fst_sweep_figure *options, fst_chart **chart,
                              fst_sweep_slice *slice, fst_error *error)
{
    shown_sweep s;
    *chart = NULL;
    fst_status status = read_sweep(path, options, &s, error);
    if (status == FST_OK && (s.is_map || s.slice.varied > 1))
        status =
            fst_fail(error, FST_BAD_INPUT, path,
                     "a sweep over two axes makes no curve: fst_sweep_figure.at takes those points where one "
                     "axis has a value");
    if (status == FST_OK)
        status = fst_sweep_curves(&s.table, s.quantities, s.count, &s.slice, 1, chart, error);
    *slice = s.slice;
    fst_sweep_table_free(&s.table);
    return status;
}

fst_status fst_figure_sweep(const char *path, const fst_sweep_figure *options, const char *out,
                            fst_error *error)
{
    const fst_sweep_figure usual = {.kind = FST_FIGURE_PATH};
    shown_sweep s;
    options = options ? options : &usual;
    fst_status status = read_sweep(path, options, &s, error);
    if (status == FST_OK && s.is_map) {
        status = fst_figure_sweep_map(&s.table, &s.quantities[0], &s.slice, options, out, error);
    } else if (status == FST_OK) {
        fst_chart *chart = NULL;
        status = s.slice.varied > 1
                     ? family_of(&s, &chart, error)
                     : fst_sweep_curves(&s.table, s.quantities, s.count, &s.slice, 0, &chart, error);
        if (status == FST_OK)
            fst_sweep_trim_words(chart);
        if (status == FST_OK)
            status = fst_figure_chart_as(out, chart, options->title, options->size, error);
        fst_chart_free(chart);
    }
    fst_sweep_table_free(&s.table);
    return status;
}
