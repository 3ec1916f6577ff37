/* figure_groups.c - the groups of several beads as a chart over the turns of the magnet: how far apart the beads are,
 * which of them touch, and what they load the plate with. */
#include "draw/figure_beads.h"

#include "base/error.h"
#include "draw/chart.h"
#include "draw/style.h"

#include <math.h>
#include <string.h>

enum {
    PAIRS = FST_BEADS_MOST * (FST_BEADS_MOST - 1) / 2,
    FEW_PAIRS = 6,       /* so many have a curve each; of more, each bead's nearest has */
    MOST_POINTS = 6000,  /* of a curve */
    USUAL_HEIGHT = 170,  /* of a panel */
    HEIGHT_OF_PAIR = 17, /* of the panel of contacts */
    NAME_SIZE = 44
};

/* A chart being made. */
typedef struct series {
    const fst_beads_table *table;
    size_t first, last, step, points; /* rows shown, every step-th */
    double length;                    /* l in the figure's unit */
    fst_chart *chart;
    double *x; /* turns of the rows shown */
    int pair_count, pairs[PAIRS][2];
    const char *names[PAIRS];
} series;

/* Other colours than those of the beads, which are four at most where pairs have curves. */
static fst_colour colour_of_pair(const series *s, int pair)
{
    static const fst_colour colours[FEW_PAIRS] = {FST_COLOUR_BLACK, FST_COLOUR_WINE,   FST_COLOUR_INDIGO,
                                                  FST_COLOUR_ROSE,  FST_COLOUR_ORANGE, FST_COLOUR_TEAL};
    return s->pair_count > FEW_PAIRS ? FST_COLOUR_BLACK : colours[pair];
}

/* Between the surfaces of two beads; 0 where they touch. */
static double gap(const series *s, size_t row, int a, int b)
{
    const double *one = fst_beads_table_state(s->table, row, a),
                 *other = fst_beads_table_state(s->table, row, b);
    const double centres =
        sqrt((one[0] - other[0]) * (one[0] - other[0]) + (one[1] - other[1]) * (one[1] - other[1]) +
             (one[2] - other[2]) * (one[2] - other[2]));
    return s->length * (centres - s->table->radii[a] - s->table->radii[b]);
}

static double nearest_gap(const series *s, size_t row, int bead)
{
    double least = INFINITY;
    for (int other = 0; other < s->table->count; ++other)
        least = other == bead ? least : fmin(least, gap(s, row, bead, other));
    return least;
}

static fst_status no_memory(fst_error *error)
{
    return fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
}

/* ------------------------------------------------------------------ distances */

static int put_gaps(series *s, fst_chart_panel *panel, const char *unit)
{
    const int by_pair = s->pair_count <= FEW_PAIRS, count = by_pair ? s->pair_count : s->table->count;
    fst_chart_curve *curves = fst_chart_keep(s->chart, (size_t)count * sizeof *curves);
    char label[96], symbols[32];
    double greatest = 0.0;
    fst_unit_symbols(unit, symbols, sizeof symbols);
    (void)snprintf(label, sizeof label, by_pair ? "gap (%s)" : "gap to the nearest (%s)", symbols);
    panel->left_label = fst_chart_text(s->chart, label);
    for (int i = 0; i < count && curves; ++i) {
        double *y = fst_chart_keep(s->chart, s->points * sizeof *y);
        char name[NAME_SIZE];
        (void)snprintf(name, sizeof name, "bead %d", i + 1);
        if (!y)
            return 0;
        for (size_t k = 0; k < s->points; ++k) {
            const size_t row = s->first + k * s->step;
            y[k] = by_pair ? gap(s, row, s->pairs[i][0], s->pairs[i][1]) : nearest_gap(s, row, i);
            greatest = fmax(greatest, y[k]);
        }
        curves[i] = (fst_chart_curve){.title = by_pair ? s->names[i] : fst_chart_text(s->chart, name),
                                      .x = s->x,
                                      .y = y,
                                      .count = s->points,
                                      .colour = by_pair ? colour_of_pair(s, i) : fst_bead_colour(i)};
    }
    panel->low = -0.05 * greatest; /* the line of a contact lies on no axis */
    panel->high = 1.05 * greatest;
    panel->curves = curves;
    panel->curve_count = count;
    return curves && panel->left_label;
}

/* ------------------------------------------------------------------ contacts */

/* In a row: turns of the magnet, or periods of a drive that does not turn it steadily. */
static double period_at(const series *s, size_t row)
{
    return fst_drive_periods(&s->table->scene, s->table->t[row], s->table->drive_turns[row]);
}

/* The turns between a row and the one before, where contacts are taken to change; the ends stay within what is shown. */
static double turns_before(const series *s, size_t row)
{
    return row == s->first  ? period_at(s, row)
           : row == s->last ? period_at(s, row - 1)
                            : 0.5 * (period_at(s, row - 1) + period_at(s, row));
}

/* Bars at the height `level` while a pair touches; 0: no memory. */
static int put_bars(series *s, int pair, double level, fst_chart_curve *curve)
{
    size_t changes = 0, count = 0;
    for (int pass = 0; pass < 2; ++pass) {
        double *x = pass ? fst_chart_keep(s->chart, 4 * changes * sizeof *x + 1) : NULL;
        double *y = x ? x + 2 * changes : NULL;
        int touched = 0;
        if (pass && !x)
            return 0;
        for (size_t row = s->first; row <= s->last; ++row) {
            const int touches = row < s->last && fst_beads_touch_in(s->table, row, s->pairs[pair]);
            if (touches == touched)
                continue;
            changes += !pass;
            for (int k = 0; pass && k < (touched ? 2 : 1); ++k) {
                x[count] = k ? NAN : turns_before(s, row);
                y[count++] = level;
            }
            touched = touches;
        }
        *curve = (fst_chart_curve){.x = x, .y = y, .count = count, .colour = colour_of_pair(s, pair)};
    }
    return 1;
}

/* A row for each pair that ever touches; *count: how many. */
static int put_contacts(series *s, fst_chart_panel *panel, int *count)
{
    fst_chart_curve *curves = fst_chart_keep(s->chart, PAIRS * sizeof *curves);
    char *tics = fst_chart_keep(s->chart, PAIRS * NAME_SIZE + 2);
    if (!curves || !tics)
        return 0;
    *count = 0;
    for (int pair = 0; pair < s->pair_count; ++pair) {
        if (!put_bars(s, pair, *count + 1.0, &curves[*count]))
            return 0;
        if (curves[*count].count == 0)
            continue;
        (void)snprintf(tics + strlen(tics), NAME_SIZE, "%s'%d–%d' %d", *count ? ", " : "(",
                       s->pairs[pair][0] + 1, s->pairs[pair][1] + 1, *count + 1);
        ++*count;
    }
    (void)strcat(tics, *count ? ")" : "");
    *panel = (fst_chart_panel){.left_label = "beads that touch",
                               .low = 0.4,
                               .high = *count + 0.6,
                               .tics = tics,
                               .curves = curves,
                               .curve_count = *count};
    return 1;
}

/* ------------------------------------------------------------------ loads */

static fst_status put_loads(series *s, fst_shown_units units, fst_chart_panel *panel, fst_error *error)
{
    const int beads = s->table->count;
    fst_chart_curve *curves = fst_chart_keep(s->chart, (size_t)beads * sizeof *curves);
    double mass = NAN, least = INFINITY;
    for (int bead = 0; bead < beads; ++bead) {
        fst_params alone;
        const fst_status status = fst_params_of_bead(&s->table->scene, bead, &alone, error);
        double *y = fst_chart_keep(s->chart, s->points * sizeof *y);
        char name[NAME_SIZE];
        (void)snprintf(name, sizeof name, "bead %d", bead + 1);
        const char *title = fst_chart_text(s->chart, name);
        if (status != FST_OK || !y || !title || !curves)
            return status == FST_OK ? no_memory(error) : status;
        mass = bead ? mass : fst_bead_mass(&alone); /* forces are per mass of the first bead */
        const fst_quantity shown =
            fst_quantity_of_column(&(fst_column_info){"load", "l gamma^2", ""}, units, &alone);
        const double factor = shown.factor * mass / fst_bead_mass(&alone);
        panel->left_label = fst_chart_text(s->chart, shown.label);
        for (size_t k = 0; k < s->points; ++k) {
            const size_t row = s->first + k * s->step;
            y[k] = NAN; /* in the air */
            for (size_t i = s->table->first[row]; i < s->table->first[row + 1]; ++i)
                if (s->table->touches[i].beads[0] == bead && s->table->touches[i].beads[1] < 0)
                    y[k] = factor * s->table->touches[i].force;
            least = fmin(least, y[k]);
        }
        curves[bead] = (fst_chart_curve){
            .title = title, .x = s->x, .y = y, .count = s->points, .colour = fst_bead_colour(bead)};
    }
    panel->low = panel->high = NAN;
    panel->curves = curves;
    panel->curve_count = isfinite(least) ? beads : 0; /* without a plate there are none */
    return panel->left_label ? FST_OK : no_memory(error);
}

/* ------------------------------------------------------------------ the chart */

/* The rows from options->from to options->to turns. */
static fst_status choose_rows(series *s, const fst_figure_options *options, fst_error *error)
{
    const fst_beads_table *table = s->table;
    const double slack = 1e-9; /* samples lie on their turn except for rounding */
    s->last = table->rows;
    while (s->first < s->last && period_at(s, s->first) < options->from - slack)
        ++s->first;
    while (s->last > s->first && period_at(s, s->last - 1) > options->to + slack)
        --s->last;
    if (s->last - s->first < 2)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.from",
                        "fewer than two samples there: the trajectory covers the drive periods %.6g to %.6g",
                        table->rows ? period_at(s, 0) : 0.0, table->rows ? period_at(s, table->rows - 1) : 0.0);
    if (!(period_at(s, s->last - 1) > period_at(s, s->first)))
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a figure of groups is over turns of the magnet, which does not turn here");
    s->step = 1 + (s->last - s->first - 1) / MOST_POINTS;
    s->points = 1 + (s->last - s->first - 1) / s->step;
    s->x = fst_chart_keep(s->chart, s->points * sizeof *s->x);
    for (size_t k = 0; k < s->points && s->x; ++k)
        s->x[k] = period_at(s, s->first + k * s->step);
    return s->x ? FST_OK : no_memory(error);
}

static int name_pairs(series *s)
{
    for (int a = 0; a < s->table->count; ++a)
        for (int b = a + 1; b < s->table->count; ++b) {
            char name[NAME_SIZE];
            (void)snprintf(name, sizeof name, "beads %d and %d", a + 1, b + 1);
            s->pairs[s->pair_count][0] = a;
            s->pairs[s->pair_count][1] = b;
            if (!(s->names[s->pair_count++] = fst_chart_text(s->chart, name)))
                return 0;
        }
    return 1;
}

/* Beads that touch at the end, directly or by others, as "at the end together: 1+2+3; apart: 4". */
static void tell_end(const series *s, char *text, size_t size)
{
    int group[FST_BEADS_MOST], together = 0;
    char list[2][64] = {"", ""};
    for (int i = 0; i < s->table->count; ++i)
        group[i] = i;
    for (int pair = 0; pair < s->pair_count; ++pair)
        if (fst_beads_touch_in(s->table, s->last - 1, s->pairs[pair])) {
            const int from = group[s->pairs[pair][1]], to = group[s->pairs[pair][0]];
            for (int i = 0; i < s->table->count; ++i)
                group[i] = group[i] == from ? to : group[i];
        }
    for (int i = 0; i < s->table->count; ++i) {
        int members = 0, before = 0;
        for (int k = 0; k < s->table->count; ++k)
            members += group[k] == group[i];
        for (int k = 0; k < i; ++k)
            before += group[k] == group[i];
        char *to = list[members == 1];
        const size_t used = strlen(to);
        for (int k = i; k < s->table->count && !before; ++k)
            if (group[k] == group[i])
                (void)snprintf(to + strlen(to), sizeof list[0] - strlen(to), "%s%d",
                               k > i  ? "+"
                               : used ? ", "
                                      : "",
                               k + 1);
        together = together || members > 1;
    }
    (void)snprintf(text, size, "; at the end %s%s%s%s", together ? "together: " : "", list[0],
                   list[1][0] ? together ? "; apart: " : "apart: " : "", list[1]);
}

static fst_status put_panels(series *s, fst_shown_units units, const char *unit, fst_error *error)
{
    fst_chart_panel *panels = fst_chart_keep(s->chart, 3 * sizeof *panels), *next = panels;
    int touching = 0;
    if (!panels || !put_gaps(s, next++, unit) || !put_contacts(s, next, &touching))
        return no_memory(error);
    next += touching > 0;
    const fst_status status = put_loads(s, units, next, error);
    if (status != FST_OK)
        return status;
    next += next->curve_count > 0;
    if (!touching)
        s->chart->remark = "no two beads touch";
    s->chart->height = (int)fmax(USUAL_HEIGHT, HEIGHT_OF_PAIR * touching);
    s->chart->panels = panels;
    s->chart->panel_count = (int)(next - panels);
    return FST_OK;
}

fst_status fst_chart_of_groups(const fst_beads_table *table, const fst_figure_options *options,
                               fst_chart *chart, fst_error *error)
{
    fst_table whole;
    fst_figure_part part;
    series s = {.table = table, .chart = chart};
    const char *unit;
    char title[96], about[400];
    if (table->count < 2)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a figure of groups is of several beads, and this trajectory is of one");
    if (table->count > FST_BEADS_MOST)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a trajectory of more than %d beads tells no contacts of pairs: there is its path",
                        FST_BEADS_MOST);
    fst_status status = fst_beads_table_alone(table, 0, 0, table->rows, &whole, error);
    if (status == FST_OK)
        status = choose_rows(&s, options, error);
    fst_figure_options shown = *options;
    shown.from = s.x ? s.x[0] : NAN; /* not the discard */
    if (status == FST_OK)
        status = fst_figure_part_of(&whole, &shown, &part, error);
    fst_table_free(&whole);
    if (status == FST_OK && !name_pairs(&s))
        status = no_memory(error);
    if (status != FST_OK)
        return status;
    const fst_scales scales = fst_scales_of(&table->scene);
    s.length = fst_unit_shown("l", part.units, &scales, &unit);
    const int told = table->outcome < FST_BEADS_OUTCOME_COUNT;
    status = put_panels(&s, part.units, unit, error);
    if (status != FST_OK)
        return status;
    (void)snprintf(title, sizeof title, "Groups of %d beads%s", table->count,
                   told ? ": " : " over the turns of the magnet");
    if (told)
        (void)strcat(title, fst_beads_outcome_name(table->outcome));
    (void)snprintf(about, sizeof about, "%.200s", part.about);
    if (told && options->title)
        (void)snprintf(about + strlen(about), sizeof about - strlen(about), ", outcome %s",
                       fst_beads_outcome_name(table->outcome));
    tell_end(&s, about + strlen(about), sizeof about - strlen(about));
    chart->title = fst_chart_text(chart, options->title ? options->title : title);
    chart->about = fst_chart_text(chart, about);
    chart->scene = fst_chart_scene(chart, &table->scene);
    chart->x_label =
        table->scene.drive_waveform == FST_WAVEFORM_STEADY ? "turns of the magnet" : "periods of the drive";
    chart->x_low = s.x[0];
    chart->x_high = s.x[s.points - 1];
    return chart->title && chart->about ? FST_OK : no_memory(error);
}
