/* figure_sweep_axes.c - axes and keys of a sweep, converted into the units that the figure shows. */
#include "draw/figure_sweep_axes.h"

#include <festoon/beads.h>

#include "base/error.h"
#include "draw/caption.h"
#include "draw/chart.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ units */

static int varies(const fst_grid *grid, const char *key)
{
    for (int i = 0; i < fst_grid_axis_count(grid); ++i)
        if (fst_grid_axis_points(grid, i) > 1 && strcmp(fst_grid_key(grid, i), key) == 0)
            return 1;
    return 0;
}

/* The parameters that are units of axes themselves. */
static const struct {
    const char *key;
    size_t scale;
} unit_keys[] = {{"friction.gamma", offsetof(fst_scales, time)},
                 {"magnet.half_length", offsetof(fst_scales, length)}};
enum { UNIT_KEYS = sizeof unit_keys / sizeof *unit_keys };

/* The scales of the first point, of which an axis of one value may make another than the base's. */
static fst_scales first_scales(const fst_grid *grid)
{
    fst_params point;
    return fst_scales_of(fst_grid_params(grid, 0, &point, NULL) == FST_OK ? &point : fst_grid_base(grid));
}

/* The scales of the points for their axes; a length or a time that differs from point to point is NAN. */
static fst_scales scales_of(const fst_grid *grid)
{
    fst_scales scales = first_scales(grid);
    for (int i = 0; i < UNIT_KEYS; ++i)
        if (varies(grid, unit_keys[i].key))
            *(double *)((char *)&scales + unit_keys[i].scale) = NAN;
    return scales;
}

int fst_sweep_is_at(const char *text, const char *key)
{
    char name[64] = "";
    const char *equals = strchr(text, '=');
    if (equals && equals - text < (ptrdiff_t)sizeof name)
        (void)snprintf(name, sizeof name, "%.*s", (int)(equals - text), text);
    const int row = fst_param_find(name);
    return row >= 0 && row == fst_param_find(key);
}

/* Whether a figure shows one value of this axis alone. */
static int is_fixed(const char *key, const char *const *at)
{
    for (int i = 0; i < FST_AXIS_LIMIT && at[i]; ++i)
        if (fst_sweep_is_at(at[i], key))
            return 1;
    return 0;
}

fst_shown_units fst_sweep_units(const fst_grid *grid, const char *const *at)
{
    const char *keys[FST_AXIS_LIMIT];
    const fst_scales scales = scales_of(grid);
    int count = 0, same = 1;
    for (int i = 0; i < fst_grid_axis_count(grid); ++i)
        if (fst_grid_axis_points(grid, i) > 1 && !is_fixed(fst_grid_key(grid, i), at))
            keys[count++] = fst_grid_key(grid, i);
    const fst_shown_units units = fst_units_over(keys, count);
    for (int i = 0; i < count; ++i)
        same &= isfinite(fst_quantity_of_parameter(keys[i], units, &scales).factor) != 0;
    return same ? units : FST_SHOWN_AS_GIVEN;
}

/* Refuse units that would need a scale which is not the same at all points. */
static fst_status check_scale(const fst_grid *grid, const char *what, int same, fst_error *error)
{
    int i = 0;
    while (i < UNIT_KEYS - 1 && !varies(grid, unit_keys[i].key))
        ++i;
    return same ? FST_OK
                : fst_fail(error, FST_BAD_INPUT, "fst_figure_sweep.units",
                           "the sweep varies %s, a unit itself, so %s is shown in the units it was made with",
                           unit_keys[i].key, what);
}

/* Whether listed values, which rise, are spaced by a factor rather than by a difference: whose steps are more
 * alike. */
static int rises_by_factors(const fst_grid *grid, int index)
{
    const int64_t count = fst_grid_axis_points(grid, index), stride = fst_grid_axis_stride(grid, index);
    double least[2] = {INFINITY, INFINITY}, greatest[2] = {0.0, 0.0};
    const double first = fst_grid_value(grid, index, 0),
                 last = fst_grid_value(grid, index, (count - 1) * stride);
    if (count < 4 || !(first > 0.0) || last < 5.0 * first)
        return 0;
    for (int64_t i = 1; i < count; ++i) {
        const double before = fst_grid_value(grid, index, (i - 1) * stride);
        const double here = fst_grid_value(grid, index, i * stride);
        const double steps[2] = {log(here / before), here - before};
        if (!(here > before))
            return 0;
        for (int k = 0; k < 2; ++k) {
            least[k] = fmin(least[k], steps[k]);
            greatest[k] = fmax(greatest[k], steps[k]);
        }
    }
    return (greatest[0] - least[0]) / log(last / first) < (greatest[1] - least[1]) / (last - first);
}

fst_status fst_sweep_axis_of(const fst_grid *grid, int index, fst_shown_units units, fst_sweep_axis *axis,
                             fst_error *error)
{
    const char *key = fst_grid_key(grid, index);
    const fst_param_info *info = fst_param_at(fst_param_find(key));
    const fst_scales scales = scales_of(grid);
    const fst_quantity quantity = fst_quantity_of_parameter(key, units, &scales);
    *axis = (fst_sweep_axis){.index = index,
                             .count = fst_grid_axis_points(grid, index),
                             .factor = quantity.factor,
                             .logarithmic = fst_grid_axis_spacing(grid, index) == FST_SPACING_LOG ||
                                            rises_by_factors(grid, index),
                             .choice = info->kind == FST_KIND_CHOICE ? info : NULL};
    memcpy(axis->label, quantity.label, sizeof axis->label);
    for (int64_t i = 0; axis->choice && i < axis->count; ++i)
        axis->swept |= 1U << (int)fst_grid_value(grid, index, i * fst_grid_axis_stride(grid, index));
    return check_scale(grid, key, isfinite(quantity.factor), error);
}

void fst_sweep_words(const char *label, char words[128])
{
    (void)snprintf(words, 128, "%s", label);
    char *unit = strstr(words, " (");
    if (unit)
        *unit = '\0';
}

/* The dynamics, and what of a point is not the default but for the axes.  A point, for in the base another form of what an
 * axis gives may stand. */
static void describe_points(const fst_grid *grid, char *text, size_t size)
{
    const char *shown[FST_AXIS_LIMIT + 1] = {"model.dynamics"};
    fst_params point;
    int count = 1;
    for (int i = 0; i < fst_grid_axis_count(grid); ++i)
        shown[count++] = fst_grid_key(grid, i);
    if (fst_grid_params(grid, 0, &point, NULL) != FST_OK)
        point = *fst_grid_base(grid);
    if (!varies(grid, "model.dynamics"))
        (void)snprintf(text, size, "dynamics %s", fst_dynamics_name((fst_dynamics)point.model_dynamics));
    fst_caption(&point, shown, count, text, size);
}

/* How many points a slice has.  Random points have no slices: all are shown. */
static int64_t slice_points(const fst_grid *grid, const fst_sweep_slice *slice)
{
    return !slice->words[0] ? fst_grid_points(grid)
                            : slice->axes[0].count * (slice->varied > 1 ? slice->axes[1].count : 1);
}

/* The number of the i-th of them. */
static int64_t slice_point(const fst_grid *grid, const fst_sweep_slice *slice, int64_t i)
{
    if (!slice->words[0])
        return i;
    const int64_t inner = slice->varied > 1 ? slice->axes[1].count : 1;
    const int64_t stride = inner > 1 ? fst_grid_axis_stride(grid, slice->axes[1].index) : 0;
    return slice->start + i / inner * fst_grid_axis_stride(grid, slice->axes[0].index) + i % inner * stride;
}

/* The points of a slice, and how many of them have a row. */
static int64_t count_points(const fst_sweep_table *table, const fst_sweep_slice *slice, int64_t *rows)
{
    const int64_t points = slice_points(table->grid, slice);
    *rows = slice->words[0] ? 0 : table->rows;
    for (int64_t i = 0; i < points && slice->words[0]; ++i)
        *rows += table->computed[slice_point(table->grid, slice, i)];
    return points;
}

/* " of 300 turns of the magnet", as long as all runs are. */
static void tell_length(const fst_grid *grid, char *about, size_t size)
{
    const fst_params *base = fst_grid_base(grid);
    const int timed = !isnan(base->run_duration);
    if (varies(grid, "run.duration") || varies(grid, "run.periods"))
        return;
    (void)snprintf(about + strlen(about), size - strlen(about), " of %s%g %s",
                   base->run_until == FST_UNTIL_SETTLED ? "at most " : "",
                   timed ? base->run_duration : base->run_periods, timed ? "s" : "turns of the magnet");
}

const char *fst_sweep_blank(const fst_sweep_table *table)
{
    return table->rows < table->wanted
               ? "no point of the sweep has a value to draw yet"
               : "no point of the sweep has a value to draw, though all are done: it is null, as the "
                 "means of an ejected bead are";
}

void fst_sweep_about(const fst_sweep_table *table, const fst_sweep_slice *slice, char *about, size_t size)
{
    const fst_grid *grid = table->grid;
    const size_t used = strlen(about);
    char what[200] = "";
    describe_points(grid, what, sizeof what);
    (void)snprintf(about + used, size - used, "%s%s%s", used ? "; " : "", what, what[0] ? ", " : "");
    int64_t rows;
    const int64_t points = count_points(table, slice, &rows);
    const int whole = table->refine || rows == points;
    const char *plural = rows == 1 && whole ? "" : "s";
    (void)snprintf(about + strlen(about), size - strlen(about), "%lld", (long long)rows);
    if (!whole)
        (void)snprintf(about + strlen(about), size - strlen(about), " of %lld", (long long)points);
    if (fst_grid_row_kind(grid) == FST_ROWS_OF_LEVITATION) {
        (void)snprintf(about + strlen(about), size - strlen(about), " point%s", plural);
    } else {
        (void)snprintf(about + strlen(about), size - strlen(about), " run%s", plural);
        tell_length(grid, about, size);
    }
    if (!whole)
        (void)snprintf(about + strlen(about), size - strlen(about), " (not complete)");
    if (table->carry != FST_CARRY_NO)
        (void)snprintf(about + strlen(about), size - strlen(about),
                       ", each begun where its neighbour ended, %s",
                       table->carry == FST_CARRY_UP ? "upwards" : "downwards");
    if (table->refine)
        (void)snprintf(about + strlen(about), size - strlen(about), " at %.3g %% of %lld points",
                       100.0 * (double)rows / (double)points, (long long)points);
}

/* Which of the choices that occur this one is. */
static int place_of_choice(unsigned swept, int choice)
{
    int place = 0;
    for (int i = 0; i < choice; ++i)
        if (swept >> i & 1U)
            ++place;
    return place;
}

double fst_sweep_axis_value(const fst_grid *grid, const fst_sweep_axis *axis, int64_t point)
{
    const double value = fst_grid_value(grid, axis->index, point);
    return axis->choice ? place_of_choice(axis->swept, (int)value) : axis->factor * value;
}

void fst_sweep_choice_tics(const fst_sweep_axis *axis, char *tics, size_t size)
{
    (void)snprintf(tics, size, "(");
    size_t length;
    for (int i = 0, place = 0; *fst_name_at(axis->choice->names, i, &length); ++i) {
        const size_t used = strlen(tics);
        if (!(axis->swept >> i & 1U))
            continue;
        (void)snprintf(tics + used, size - used, "%s'%.*s' %d", place ? ", " : "", (int)length,
                       fst_name_at(axis->choice->names, i, &length), place);
        ++place;
    }
    const size_t used = strlen(tics);
    (void)snprintf(tics + used, size - used, ")");
}

#define COLOUR(NAME, name, doc, colour) FST_COLOUR_##colour,
static const fst_colour regime_colours[] = {FST_REGIMES(COLOUR)}, floating_colours[] = {FST_FLOATINGS(COLOUR)},
                        outcome_colours[] = {FST_BEADS_OUTCOMES(COLOUR)};
#undef COLOUR

const fst_sweep_names *fst_sweep_names_of(const char *key)
{
    static const fst_sweep_names regimes = {FST_REGIME_COUNT, FST_WORDS(FST_REGIMES), regime_colours},
                                 floating = {FST_FLOATING_COUNT, FST_WORDS(FST_FLOATINGS), floating_colours},
                                 outcomes = {FST_BEADS_OUTCOME_COUNT, FST_WORDS(FST_BEADS_OUTCOMES),
                                             outcome_colours};
    return strcmp(key, "regime") == 0                               ? &regimes
           : strcmp(key, "outcome") == 0                            ? &outcomes
           : strcmp(key, "below") == 0 || strcmp(key, "above") == 0 ? &floating
                                                                    : NULL;
}

const char *fst_sweep_state_key(const fst_grid *grid)
{
    const fst_row_kind kind = fst_grid_row_kind(grid);
    return kind == FST_ROWS_OF_BEADS ? "outcome" : kind == FST_ROWS_OF_LEVITATION ? "below" : "regime";
}

int fst_sweep_result_tics(const char *key, char *tics, size_t size)
{
    const fst_sweep_names *names = fst_sweep_names_of(key);
    if (!names && strcmp(key, "symmetry") != 0)
        return 0;
    const int count = names ? names->count : FST_SYMMETRY_COUNT;
    (void)snprintf(tics, size, "(");
    for (int i = 0; i < count; ++i) {
        const char *name = names ? NULL : fst_symmetry_name((fst_symmetry)i);
        size_t length = 4;
        const char *word = names ? fst_name_at(names->words, i, &length) : name ? name : "none";
        if (name)
            length = strlen(name);
        const size_t used = strlen(tics);
        (void)snprintf(tics + used, size - used, "%s'%.*s' %d", i ? ", " : "", (int)length, word, i);
    }
    (void)snprintf(tics + strlen(tics), size - strlen(tics), ")");
    return count;
}

static int occurs(const fst_chart_panel *panel, int place)
{
    for (int c = 0; c < panel->curve_count; ++c)
        for (size_t i = 0; i < panel->curves[c].count && !panel->curves[c].right; ++i)
            if (fabs(panel->curves[c].y[i] - place) < 0.5)
                return 1;
    return 0;
}

static void trim_words(fst_chart *chart, fst_chart_panel *panel)
{
    char tics[256] = "";
    double low = NAN, high = NAN;
    for (const char *word = strchr(panel->tics, '\''), *end; word; word = strchr(end + 1, '\'')) {
        end = strchr(word + 1, '\'');
        const int place = atoi(end + 1);
        const size_t used = strlen(tics);
        if (!occurs(panel, place))
            continue;
        (void)snprintf(tics + used, sizeof tics - used, "%s%.*s %d", used ? ", " : "(", (int)(end + 1 - word),
                       word, place);
        low = fmin(low, place - 0.5);
        high = fmax(high, place + 0.5);
    }
    (void)snprintf(tics + strlen(tics), sizeof tics - strlen(tics), ")");
    const char *kept = isfinite(low) ? fst_chart_text(chart, tics) : NULL;
    if (!kept)
        return; /* signs alone, or no memory */
    panel->tics = kept;
    panel->low = low;
    panel->high = high;
}

void fst_sweep_trim_words(fst_chart *chart)
{
    const size_t count = (size_t)chart->panel_count;
    fst_chart_panel *panels = fst_chart_keep(chart, (count + 1) * sizeof *panels);
    if (!panels)
        return;
    memcpy(panels, chart->panels, count * sizeof *panels);
    chart->panels = panels;
    for (size_t p = 0; p < count; ++p)
        if (panels[p].tics && isfinite(panels[p].low))
            trim_words(chart, &panels[p]);
}

fst_sweep_quantity fst_sweep_quantity_of(const fst_grid *grid, const char *key, fst_shown_units units)
{
    const fst_scales scales = first_scales(grid);
    const char *unit = fst_sweep_key_unit(grid, key), *name;
    (void)fst_number_shown(key, unit, units, &scales, &name);
    fst_sweep_quantity quantity = {
        .key = key, .unit = unit, .units = name == unit ? FST_SHOWN_SCALED : units}; /* without counterpart */
    memcpy(quantity.label, fst_quantity_of_result(key, unit, units, &scales).label, sizeof quantity.label);
    return quantity;
}

fst_status fst_sweep_convert(const fst_sweep_table *table, const fst_sweep_slice *slice,
                             const fst_sweep_quantity *quantities, int count, fst_error *error)
{
    const int64_t all = fst_grid_points(table->grid), points = slice_points(table->grid, slice);
    int converted = 0;
    for (int k = 0; k < count; ++k)
        converted |= quantities[k].units != FST_SHOWN_SCALED;
    for (int64_t i = 0; i < points && converted; ++i) {
        const int64_t point = slice_point(table->grid, slice, i);
        fst_params params;
        const fst_status status = fst_grid_params(table->grid, point, &params, error);
        if (status != FST_OK)
            return status;
        const fst_scales scales = fst_scales_of(&params);
        for (int k = 0; k < count; ++k) {
            const fst_sweep_quantity *q = &quantities[k];
            const char *name;
            const double factor = fst_number_shown(q->key, q->unit, q->units, &scales, &name);
            table->values[k * all + point] *= q->units != FST_SHOWN_SCALED && name == q->unit ? NAN : factor;
        }
    }
    return FST_OK;
}

fst_colour fst_regime_colour(int regime)
{
    return regime_colours[regime];
}

fst_look fst_regime_look(fst_regime regime)
{
    if ((unsigned)regime >= FST_REGIME_COUNT)
        return (fst_look){NULL, NULL};
    return (fst_look){fst_regime_name(regime), fst_colour_code(fst_regime_colour((int)regime))};
}
