/* figure_points.c - measured points over the curves of a sweep or of a branch, with chi^2.
 *
 * A curve is made of straight pieces between neighbouring rows of a sweep with the same regime, or along the
 * smooth curve of a branch, whose points are few.  What was measured is compared with stable states alone: no bead stays on
 * others.
 */
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/number.h"
#include "draw/caption.h"
#include "draw/charts_over.h"
#include "draw/figure_branch.h"
#include "draw/legend.h"

/* A straight piece of a curve, of one quantity, in Hz and SI. */
typedef struct piece {
    double x[2], y[2];
    int stable;
} piece;

typedef struct pieces {
    piece *list[FST_MEASURED_COUNT];
    size_t count[FST_MEASURED_COUNT], room;
    double length, gamma; /* m and 1/s: the units of the file's numbers */
    fst_params *scene;    /* NULL: the file does not say */
} pieces;

static fst_status make_room(pieces *p, size_t room, fst_error *error)
{
    p->room = room;
    for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
        p->list[q] = malloc((room + 1) * sizeof *p->list[q]);
        if (!p->list[q])
            return fst_fail(error, FST_NO_MEMORY, "", "no memory for %zu pieces of curves", room);
    }
    return FST_OK;
}

static void free_pieces(pieces *p)
{
    for (int q = 0; q < FST_MEASURED_COUNT; ++q)
        free(p->list[q]);
    free(p->scene);
}

static void add_piece(pieces *p, int quantity, const double x[2], double from, double to, int stable)
{
    if (isfinite(from) && isfinite(to))
        p->list[quantity][p->count[quantity]++] = (piece){{x[0], x[1]}, {from, to}, stable};
}

/* ---------------------------------------------------------------- curves of a sweep and of a branch */

/* How a value of the varied parameter becomes Hz; 0: it is no drive. */
static double to_hertz(const char *key, double gamma)
{
    return strcmp(key, "drive.frequency") == 0 ? 1.0
           : strcmp(key, "drive.omega") == 0   ? gamma / FST_TWO_PI
                                               : 0.0;
}

static fst_status no_drive(const char *path, const char *key, fst_error *error)
{
    return fst_fail(error, FST_BAD_INPUT, path,
                    "points lie over the drive, but this varies %s: vary drive.frequency or drive.omega alone",
                    key);
}

/* The axis of a sweep that varies; FST_BAD_INPUT: more than one, or not the drive, or a unit varies. */
static fst_status find_axis(const fst_grid *grid, const char *path, int *axis, double *hertz, fst_error *error)
{
    *axis = -1;
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        if (fst_grid_axis_points(grid, i) < 2)
            continue;
        *hertz = to_hertz(fst_grid_key(grid, i), fst_grid_base(grid)->friction_gamma);
        if (*axis >= 0 || *hertz == 0.0)
            return no_drive(path, fst_grid_key(grid, i), error);
        *axis = i;
    }
    return *axis >= 0
               ? FST_OK
               : fst_fail(error, FST_BAD_INPUT, path, "this sweep has one point: there is no curve to compare");
}

typedef struct sweep_row {
    double x, regime, value[FST_MEASURED_COUNT];
} sweep_row;

/* Locked and librating beads are of one curve. */
static double kind_of(double regime)
{
    return regime == FST_REGIME_LIBRATING ? FST_REGIME_LOCKED : regime;
}

static int by_x(const void *a, const void *b)
{
    const double p = ((const sweep_row *)a)->x, q = ((const sweep_row *)b)->x;
    return (p > q) - (p < q);
}

static fst_status take_sweep(const char *path, pieces *p, fst_error *error)
{
    static const char *const keys[] = {"mean_r", "std_r", "mean_alpha_dot", "regime"};
    fst_sweep_table table;
    int axis = 0;
    double hertz = 0.0;
    fst_status status = fst_sweep_read(path, keys, 4, &table, error);
    if (status != FST_OK)
        return status;
    const size_t count = (size_t)fst_grid_points(table.grid);
    const fst_params *base = fst_grid_base(table.grid);
    p->length = base->magnet_half_length;
    p->gamma = base->friction_gamma;
    const double factors[] = {p->length, p->length, p->gamma / FST_TWO_PI};
    sweep_row *rows = malloc((count + 1) * sizeof *rows);
    p->scene = malloc(sizeof *p->scene);
    if (p->scene && fst_grid_params(table.grid, 0, p->scene, NULL) != FST_OK)
        *p->scene = *base;
    status = rows && p->scene ? find_axis(table.grid, path, &axis, &hertz, error)
                              : fst_fail(error, FST_NO_MEMORY, path, "no memory for %zu rows", count);
    if (status == FST_OK)
        status = make_room(p, count, error);
    for (size_t i = 0; i < count && status == FST_OK; ++i) {
        rows[i].x = hertz * fst_grid_value(table.grid, axis, (int64_t)i);
        rows[i].regime = kind_of(table.values[3 * count + i]);
        for (size_t q = 0; q < FST_MEASURED_COUNT; ++q)
            rows[i].value[q] = factors[q] * table.values[q * count + i];
    }
    if (status == FST_OK)
        qsort(rows, count, sizeof *rows, by_x);
    for (size_t i = 0; i + 1 < count && status == FST_OK; ++i) {
        const double x[2] = {rows[i].x, rows[i + 1].x};
        for (int q = 0; q < FST_MEASURED_COUNT; ++q)
            if (rows[i].regime == rows[i + 1].regime)
                add_piece(p, q, x, rows[i].value[q], rows[i + 1].value[q], 1);
    }
    free(rows);
    fst_sweep_table_free(&table);
    return status;
}

enum { MOST_SOLVED = 500 }; /* orbits at measured drives, each in about 10 ms */

static fst_status take_curves(const fst_branch *b, double hertz, pieces *p, fst_error *error)
{
    const double factors[] = {b->half_length, b->gamma / FST_TWO_PI};
    fst_columns curves[4]; /* the stable and the other states of each quantity */
    fst_chart *owner = fst_chart_new();
    size_t room = 0;
    int good = owner != NULL;
    for (int i = 0; i < 4 && good; ++i) {
        good = fst_branch_curve(owner, b, i < 2 ? "mean_r" : "mean_alpha_dot", i % 2 == 0, &curves[i]);
        room += good ? curves[i].count : 0;
    }
    const fst_status status = good ? make_room(p, room, error)
                                   : fst_fail(error, FST_NO_MEMORY, "", "no memory for the curves of a branch");
    for (int i = 0; i < 4 && status == FST_OK; ++i)
        for (size_t k = 0; k + 1 < curves[i].count; ++k)
            add_piece(p, i < 2 ? FST_MEASURED_MEAN_R : FST_MEASURED_BEAD_FREQUENCY,
                      (double[]){hertz * curves[i].x[k], hertz * curves[i].x[k + 1]},
                      factors[i / 2] * curves[i].y[k], factors[i / 2] * curves[i].y[k + 1], i % 2 == 0);
    fst_chart_free(owner);
    return status;
}

/* The orbit of the scene at a drive between two neighbouring points of a branch; 0: none was found there. */
static int solve_between(const fst_branch *b, const fst_branch_point *p, double value, fst_branch_point *found)
{
    const fst_branch_point *q = p + 1;
    const double s = (value - p->value) / (q->value - p->value),
                 about = p->mean_r + s * (q->mean_r - p->mean_r);
    fst_orbit orbit, guess = {.outcome = FST_ORBIT_FOUND, .symmetry = p->symmetry, .turns = p->turns};
    fst_params params = *b->scene;
    char text[40];
    guess.means.period = p->period + s * (q->period - p->period);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        guess.state[i] = p->state[i] + s * (q->state[i] - p->state[i]);
    (void)fst_number_write(text, sizeof text, value);
    if (fst_params_set(&params, b->key, text, NULL) != FST_OK ||
        fst_orbit_near(&params, &guess, 1e-12, NULL, &orbit, NULL) != FST_OK)
        return 0;
    *found = p->stable ? *p : *q;
    found->value = value;
    found->mean_r = orbit.means.mean_r;
    found->mean_alpha_dot = orbit.means.mean_alpha_dot;
    found->period = orbit.means.period;
    memcpy(found->state, orbit.state, sizeof found->state);
    return fabs(found->mean_r - about) <= 0.5 * fabs(q->mean_r - p->mean_r) + 0.01; /* else of another branch */
}

/* Put the orbits at a measured drive among the points of a branch, whose cubics are some micrometres off. */
static void refine(fst_branch *b, double value, int *most)
{
    fst_branch_point found;
    for (size_t i = 0; i + 1 < b->point_count && *most > 0; ++i) {
        const fst_branch_point *p = &b->points[i], *q = p + 1;
        if (p->branch != q->branch || !(p->stable || q->stable) || p->turns != q->turns ||
            p->symmetry != q->symmetry || !((value - p->value) * (value - q->value) < 0.0))
            continue;
        *most -= 1;
        fst_branch_point *longer =
            solve_between(b, p, value, &found) ? realloc(b->points, (b->point_count + 1) * sizeof *p) : NULL;
        if (!longer)
            continue; /* the cubics are there */
        b->points = longer;
        memmove(&longer[i + 2], &longer[i + 1], (b->point_count++ - i - 1) * sizeof *longer);
        longer[++i] = found;
    }
}

static fst_status take_branch(const char *path, const fst_points *tables, int table_count, pieces *p,
                              fst_error *error)
{
    fst_branch branch;
    fst_status status = fst_branch_read(path, &branch, error);
    if (status != FST_OK)
        return status;
    const double hertz = to_hertz(branch.key, branch.gamma);
    if (hertz == 0.0 || branch.second_key[0])
        status = no_drive(path, branch.second_key[0] ? branch.second_key : branch.key, error);
    else if (isnan(branch.gamma) || isnan(branch.half_length))
        status = fst_fail(error, FST_BAD_INPUT, path,
                          "this branch does not say by which length and rate it is scaled: "
                          "follow it again");
    const int orbits = branch.kind == FST_BRANCH_COUNTER || branch.kind == FST_BRANCH_ALL;
    int most = orbits && branch.scene ? MOST_SOLVED : 0;
    for (int t = 0; t < table_count && status == FST_OK; ++t)
        for (size_t i = 0; i < tables[t].count && most > 0; ++i)
            refine(&branch, tables[t].rows[i].frequency / hertz, &most);
    if (status == FST_OK)
        status = take_curves(&branch, hertz, p, error);
    p->length = branch.half_length;
    p->gamma = branch.gamma;
    p->scene = branch.scene;
    branch.scene = NULL;
    fst_branch_free(&branch);
    return status;
}

/* ---------------------------------------------------------------- chi^2 */

static int covers(const piece *here, double x)
{
    return x >= fmin(here->x[0], here->x[1]) && x <= fmax(here->x[0], here->x[1]) && here->x[0] != here->x[1];
}

/* The stable piece at a frequency that is nearest to a value; NULL: there is none. */
static const piece *nearest_piece(const pieces *p, int quantity, double x, double value)
{
    const piece *best = NULL;
    double nearest = INFINITY;
    for (size_t i = 0; i < p->count[quantity]; ++i) {
        const piece *here = &p->list[quantity][i];
        if (!here->stable || !covers(here, x))
            continue;
        const double y = here->y[0] + (x - here->x[0]) / (here->x[1] - here->x[0]) * (here->y[1] - here->y[0]);
        if (fabs(y - value) < nearest) {
            best = here;
            nearest = fabs(y - value);
        }
    }
    return best;
}

/* Sums over lengths that one scale makes wrong alike, by s of its errors: chi^2 is least over s, as a fit has it. */
typedef struct scaled {
    double product, square;
} scaled;

/* The part of one measured number in chi^2: the error of the frequency counts by the curve's slope. */
static double part_of_chi2(const piece *at, const fst_point *point, int quantity, scaled *by_scale)
{
    const double slope = (at->y[1] - at->y[0]) / (at->x[1] - at->x[0]);
    const double y = at->y[0] + slope * (point->frequency - at->x[0]);
    const double along = isfinite(point->frequency_error) ? slope * point->frequency_error : 0.0;
    const double off = point->value[quantity] - y, error = point->error[quantity];
    const double variance = error * error + along * along;
    if (point->scale_error > 0.0 && fst_measured_unit((fst_measured)quantity) == FST_UNIT_LENGTH) {
        const double step = point->scale_error * point->value[quantity];
        by_scale->product += off * step / variance;
        by_scale->square += step * step / variance;
    }
    return off * off / variance;
}

/* Say which measured number has no part in chi^2, and why. */
static void tell_left_out(const pieces *p, const fst_point *point, int quantity, fst_points_fit *fit)
{
    const size_t used = strlen(fit->left_out), size = sizeof fit->left_out - used;
    const double x = point->frequency;
    double low = INFINITY, high = -INFINITY;
    int unstable = 0;
    for (size_t i = 0; i < p->count[quantity]; ++i) {
        const piece *here = &p->list[quantity][i];
        low = fmin(low, fmin(here->x[0], here->x[1]));
        high = fmax(high, fmax(here->x[0], here->x[1]));
        unstable = unstable || covers(here, x);
    }
    char why[96] = "the curve has a gap there";
    if (low > high)
        (void)snprintf(why, sizeof why, "the file has no curve of it");
    else if (unstable)
        (void)snprintf(why, sizeof why, "all states there are unstable");
    else if (x < low || x > high)
        (void)snprintf(why, sizeof why, "the curve reaches from %.6g Hz to %.6g Hz", low, high);
    if (size > 192)
        (void)snprintf(fit->left_out + used, size, "line %d (%.6g Hz), %s: %s\n", point->line, x,
                       fst_measured_name((fst_measured)quantity), why);
    else if (!strstr(fit->left_out, "others"))
        (void)snprintf(fit->left_out + used, size, "and others\n");
}

static void add_chi2(const pieces *p, const fst_points *points, int quantity, scaled *by_scale,
                     fst_points_fit *fit)
{
    for (size_t i = 0; i < points->count; ++i) {
        const fst_point *point = &points->rows[i];
        if (isnan(point->value[quantity]))
            continue;
        const piece *at = nearest_piece(p, quantity, point->frequency, point->value[quantity]);
        ++fit->all;
        if (at) {
            ++fit->counted;
            fit->chi2 += part_of_chi2(at, point, quantity, by_scale);
        } else {
            tell_left_out(p, point, quantity, fit);
        }
    }
}

/* ---------------------------------------------------------------- the figure */

/* Everything that is drawn. */
typedef struct drawing {
    const char *const *results, *const *tables;
    int result_count, table_count;
    pieces models[FST_CHARTS_OVER];
    fst_points points[FST_CHARTS_OVER];
    fst_points_fit fits[FST_CHARTS_OVER * FST_CHARTS_OVER]; /* of model m and table p: m * table_count + p */
    double frequency, factors[FST_MEASURED_COUNT];          /* of the wanted units, from Hz and SI */
    const char *labels[FST_MEASURED_COUNT + 1];             /* the last one: of the abscissa */
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
    const pieces *first = &d->models[0];
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
    const fst_points_fit *fit = &d->fits[0];
    const int alone = d->result_count == 1 && d->table_count == 1;
    for (int m = 0; m < d->result_count; ++m)
        scenes[m] = d->models[m].scene;
    fst_caption_of_files(scenes, d->results, d->result_count, shown, 2, names, same, sizeof same);
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
    const pieces *p = &d->models[m];
    const size_t room = 3 * p->count[quantity] + 1;
    double *x = fst_chart_keep(d->chart, 2 * room * sizeof *x), *y = x + room;
    size_t count = 0;
    const piece *before = NULL;
    for (size_t i = 0; x && i < p->count[quantity]; ++i) {
        const piece *here = &p->list[quantity][i];
        if (here->stable != stable)
            continue;
        const int joined = before && before->x[1] == here->x[0] && before->y[1] == here->y[0];
        if (before && !joined)
            x[count] = y[count] = NAN, ++count; /* a gap */
        for (int end = joined; end < 2; ++end, ++count) {
            x[count] = d->frequency * here->x[end];
            y[count] = d->factors[quantity] * here->y[end];
        }
        before = here;
    }
    *curve =
        (fst_chart_curve){.title = stable                ? d->model_words[m]
                                   : d->result_count > 1 ? (*named ? NULL : "unstable")
                                                         : "model, unstable",
                          .x = x,
                          .y = y,
                          .count = count,
                          .colour = !stable && d->result_count == 1 ? FST_COLOUR_GREY : fst_chart_colour(m),
                          .style = stable ? FST_CURVE_LINE : FST_CURVE_DASHED};
    *named |= !stable && count;
    return x != NULL;
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
    fst_chart_curve *curves = fst_chart_keep(d->chart, 3 * FST_CHARTS_OVER * sizeof *curves);
    fst_chart_panel *panel = &d->panels[d->chart->panel_count];
    int good = curves != NULL, count = 0;
    size_t measured = 0;
    for (int m = 0; m < d->result_count && good; ++m)
        for (int stable = 1; stable >= 0 && good; --stable)
            good = put_model(d, m, quantity, stable, named, &curves[count++]);
    for (int p = 0; p < d->table_count && good; ++p) {
        good = put_points(d, p, quantity, &curves[count]);
        measured += curves[count++].count;
    }
    *panel = (fst_chart_panel){
        .left_label = d->labels[quantity], .low = NAN, .high = NAN, .curves = curves, .curve_count = count};
    d->chart->panel_count += measured > 0;
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
        good = put_panel(d, q, &named);
    choose_range(d);
    const fst_status status =
        good ? fst_figure_chart_as(out, d->chart, options->title, options->size, error) : no_memory(error);
    fst_chart_free(d->chart);
    return status;
}

/* chi^2 of a table before a model. */
static fst_points_fit fit_of(const pieces *p, const fst_points *points)
{
    fst_points_fit found = {.counted = 0};
    scaled by_scale = {0.0, 0.0};
    for (int q = 0; q < FST_MEASURED_COUNT; ++q)
        add_chi2(p, points, q, &by_scale, &found);
    found.chi2 -= by_scale.product * by_scale.product / (1.0 + by_scale.square);
    return found;
}

static fst_status read_all(drawing *d, fst_error *error)
{
    fst_status status = FST_OK;
    for (int p = 0; p < d->table_count && status == FST_OK; ++p)
        status = fst_points_read(d->tables[p], &d->points[p], error);
    for (int m = 0; m < d->result_count && status == FST_OK; ++m) {
        int is_sweep = 0;
        status = fst_is_sweep(d->results[m], &is_sweep, error);
        if (status == FST_OK)
            status = is_sweep ? take_sweep(d->results[m], &d->models[m], error)
                              : take_branch(d->results[m], d->points, d->table_count, &d->models[m], error);
    }
    for (int i = 0; i < d->result_count * d->table_count && status == FST_OK; ++i) {
        const int p = i % d->table_count;
        d->fits[i] = fit_of(&d->models[i / d->table_count], &d->points[p]);
        if (d->fits[i].all == 0)
            status = fst_fail(error, FST_BAD_INPUT, d->tables[p], "this table has no measured number");
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
    fst_status status = read_all(d, error);
    if (status == FST_OK)
        status = choose_units(d, options->units, error);
    if (status == FST_OK)
        status = draw(d, options, out, error);
    if (status == FST_OK && fits)
        memcpy(fits, d->fits, (size_t)(result_count * table_count) * sizeof *fits);
    for (int m = 0; m < result_count; ++m)
        free_pieces(&d->models[m]);
    for (int p = 0; p < table_count; ++p)
        fst_points_free(&d->points[p]);
    free(d);
    return status;
}
