/* point_curves.c - curves of sweeps and branches as straight pieces, and chi^2 of measured points before them.
 *
 * A curve is made of straight pieces between neighbouring rows of a sweep with the same regime, or along the
 * smooth curve of a branch, whose points are few.  A row alone in its regime is a piece without length.  What was measured is
 * compared with stable states alone: no bead stays on others.
 */
#include "measure/point_curves.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/number.h"
#include "draw/figure_branch.h"
#include "draw/figure_sweep.h"

static fst_status make_room(fst_point_curves *p, size_t room, fst_error *error)
{
    for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
        p->list[q] = malloc((room + 1) * sizeof *p->list[q]);
        if (!p->list[q])
            return fst_fail(error, FST_NO_MEMORY, "", "no memory for %zu pieces of curves", room);
    }
    return FST_OK;
}

void fst_point_curves_free(fst_point_curves *p)
{
    for (int q = 0; q < FST_MEASURED_COUNT; ++q)
        free(p->list[q]);
    free(p->specials);
    free(p->gaps);
    free(p->scene);
}

static void add_piece(fst_point_curves *p, int quantity, const double x[2], double from, double to, int stable)
{
    if (isfinite(from) && isfinite(to))
        p->list[quantity][p->count[quantity]++] = (fst_curve_piece){{x[0], x[1]}, {from, to}, stable};
}

/* ---------------------------------------------------------------- curves of a sweep and of a branch */

/* How a value of the varied parameter becomes Hz; 0: it is not a drive. */
static double to_hertz(const char *key, double gamma)
{
    return strcmp(key, "drive.frequency") == 0 ? 1.0
           : strcmp(key, "drive.omega") == 0   ? gamma / FST_TWO_PI
                                               : 0.0;
}

static fst_status no_drive(const char *path, const char *key, const char *only, fst_error *error)
{
    return fst_fail(
        error, FST_BAD_INPUT, path,
        "points lie over the drive, but this varies %s: vary drive.frequency or drive.omega alone%s", key,
        only);
}

/* The slice of a sweep over the drive that is asked for, and how its values become Hz; FST_BAD_INPUT: there is no such one. */
static fst_status find_slice(const fst_grid *grid, const char *path, const fst_sweep_figure *options,
                             int used[FST_AXIS_LIMIT], fst_sweep_slice *slice, fst_params *scene, double *hertz,
                             fst_error *error)
{
    const fst_sweep_figure figure = fst_sweep_figure_of(grid, options, used);
    if (fst_grid_points(grid) < 2)
        return fst_fail(error, FST_BAD_INPUT, path, "this sweep has one point: there is no curve to compare");
    fst_status status = fst_sweep_cut(grid, path, &figure, FST_SHOWN_AS_GIVEN, slice, error);
    if (status == FST_OK && fst_grid_params(grid, slice->start, scene, NULL) != FST_OK)
        *scene = *fst_grid_base(grid);
    for (int i = 0; i < slice->varied && status == FST_OK; ++i) {
        const char *key = fst_grid_key(grid, slice->axes[i].index);
        *hertz = to_hertz(key, scene->friction_gamma);
        if (*hertz == 0.0)
            status = no_drive(path, key, ", or take a value of the others by fst_sweep_figure.at", error);
    }
    return status;
}

typedef struct sweep_row {
    double x, regime, value[FST_MEASURED_COUNT];
    int computed;
} sweep_row;

static int by_x(const void *a, const void *b)
{
    const double p = ((const sweep_row *)a)->x, q = ((const sweep_row *)b)->x;
    return (p > q) - (p < q);
}

/* Join neighbouring rows of one regime; runs without a motion are apart. */
static void join_rows(const sweep_row *rows, size_t count, fst_point_curves *p)
{
    for (size_t i = 0, before = 0; i < count; ++i) {
        const int gap = fst_sweep_gap("regime", rows[i].regime, rows[i].computed);
        const size_t next = i + 1 < count && fst_sweep_joins("regime", rows[i].regime, rows[i + 1].regime);
        const size_t end = i + next;
        if (gap >= 0)
            p->gaps[p->gap_count++] = (fst_curve_gap){rows[i].x, gap};
        for (int q = 0; q < FST_MEASURED_COUNT && gap < 0 && (next || !before); ++q)
            add_piece(p, q, (double[]){rows[i].x, rows[end].x}, rows[i].value[q], rows[end].value[q], 1);
        before = next;
    }
}

static fst_status take_sweep(const char *path, const fst_sweep_figure *options, int used[FST_AXIS_LIMIT],
                             fst_point_curves *p, fst_error *error)
{
    static const char *const keys[] = {"mean_r", "std_r", "mean_alpha_dot", "regime"};
    fst_sweep_table table;
    fst_sweep_slice slice;
    double hertz = 0.0;
    fst_status status = fst_sweep_read(path, keys, 4, &table, error);
    if (status != FST_OK)
        return status;
    const size_t all = (size_t)fst_grid_points(table.grid);
    p->is_sweep = 1;
    p->gaps = malloc((all + 1) * sizeof *p->gaps);
    p->scene = malloc(sizeof *p->scene);
    sweep_row *rows = malloc((all + 1) * sizeof *rows);
    status = rows && p->gaps && p->scene
                 ? find_slice(table.grid, path, options, used, &slice, p->scene, &hertz, error)
                 : fst_fail(error, FST_NO_MEMORY, path, "no memory for %zu rows", all);
    const size_t count = status == FST_OK ? (size_t)slice.axes[0].count : 0;
    if (status == FST_OK)
        status = make_room(p, count, error);
    for (size_t i = 0; i < count && status == FST_OK; ++i) {
        const int64_t point = slice.start + (int64_t)i * fst_grid_axis_stride(table.grid, slice.axes[0].index);
        const double factors[] = {p->scene->magnet_half_length, p->scene->magnet_half_length,
                                  p->scene->friction_gamma / FST_TWO_PI};
        rows[i].x = hertz * fst_grid_value(table.grid, slice.axes[0].index, point);
        rows[i].regime = table.values[3 * all + (size_t)point];
        rows[i].computed = table.computed[point];
        for (size_t q = 0; q < FST_MEASURED_COUNT; ++q)
            rows[i].value[q] = factors[q] * table.values[q * all + (size_t)point];
    }
    if (status == FST_OK) {
        p->length = p->scene->magnet_half_length;
        p->gamma = p->scene->friction_gamma;
        memcpy(p->slice, slice.words, sizeof p->slice);
        qsort(rows, count, sizeof *rows, by_x);
        join_rows(rows, count, p);
    }
    free(rows);
    fst_sweep_table_free(&table);
    return status;
}

enum { MOST_SOLVED = 500 }; /* orbits at measured drives, each in about 10 ms */

static fst_status take_curves(const fst_branch *b, double hertz, fst_point_curves *p, fst_error *error)
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
            if (curves[i].x[k] != curves[i].x[k + 1] || curves[i].y[k] != curves[i].y[k + 1])
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

static fst_status take_specials(const fst_branch *b, double hertz, fst_point_curves *p, fst_error *error)
{
    p->specials = malloc((b->special_count + 1) * sizeof *p->specials);
    if (!p->specials)
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for the special points of a branch");
    for (size_t i = 0; i < b->special_count; ++i) {
        const fst_special *s = &b->specials[i];
        fst_curve_special *here = &p->specials[p->special_count++];
        *here = (fst_curve_special){.type = s->type, .x = hertz * s->value};
        here->y[FST_MEASURED_MEAN_R] = b->half_length * s->at.mean_r;
        here->y[FST_MEASURED_STD_R] = NAN;
        here->y[FST_MEASURED_BEAD_FREQUENCY] = b->gamma / FST_TWO_PI * s->at.mean_alpha_dot;
    }
    return FST_OK;
}

static fst_status take_branch(const char *path, const fst_points *tables, int table_count, fst_point_curves *p,
                              fst_error *error)
{
    fst_branch branch;
    fst_status status = fst_branch_read(path, &branch, error);
    if (status != FST_OK)
        return status;
    const double hertz = to_hertz(branch.key, branch.gamma);
    if (hertz == 0.0 || branch.second_key[0])
        status = no_drive(path, branch.second_key[0] ? branch.second_key : branch.key, "", error);
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
    if (status == FST_OK)
        status = take_specials(&branch, hertz, p, error);
    p->length = branch.half_length;
    p->gamma = branch.gamma;
    p->scene = branch.scene;
    branch.scene = NULL;
    fst_branch_free(&branch);
    return status;
}

/* ---------------------------------------------------------------- chi^2 */

static const double ROUNDING =
    1e-9; /* drives that differ less are one: a sweep may be over omega, or in steps */

static int is_run(const fst_curve_piece *here)
{
    return here->x[0] == here->x[1] && here->y[0] == here->y[1];
}

static int covers(const fst_curve_piece *here, double x)
{
    const double low = fmin(here->x[0], here->x[1]), high = fmax(here->x[0], here->x[1]);
    const int run = is_run(here), wide = high - low > 1e3 * ROUNDING * fabs(x); /* else it may be steep */
    const double off = run || wide ? ROUNDING * fabs(x) : 0.0;
    return x >= low - off && x <= high + off && (run || low < high);
}

static double slope_of(const fst_curve_piece *here)
{
    return is_run(here) ? 0.0 : (here->y[1] - here->y[0]) / (here->x[1] - here->x[0]);
}

/* The stable piece at a frequency that is nearest to a value; NULL: there is none. */
static const fst_curve_piece *nearest_piece(const fst_point_curves *p, int quantity, double x, double value)
{
    const fst_curve_piece *best = NULL;
    double nearest = INFINITY;
    for (size_t i = 0; i < p->count[quantity]; ++i) {
        const fst_curve_piece *here = &p->list[quantity][i];
        if (!here->stable || !covers(here, x))
            continue;
        const double y = here->y[0] + slope_of(here) * (x - here->x[0]);
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
static double part_of_chi2(const fst_curve_piece *at, const fst_point *point, int quantity, scaled *by_scale)
{
    const double slope = slope_of(at);
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
static void tell_left_out(const fst_point_curves *p, const fst_point *point, int quantity, fst_points_fit *fit)
{
    const size_t used = strlen(fit->left_out), size = sizeof fit->left_out - used;
    const double x = point->frequency;
    double low = INFINITY, high = -INFINITY;
    int unstable = 0;
    for (size_t i = 0; i < p->count[quantity]; ++i) {
        const fst_curve_piece *here = &p->list[quantity][i];
        low = fmin(low, fmin(here->x[0], here->x[1]));
        high = fmax(high, fmax(here->x[0], here->x[1]));
        unstable = unstable || covers(here, x);
    }
    const fst_curve_gap *run = NULL;
    for (size_t i = 0; i < p->gap_count && !run; ++i)
        run = fabs(p->gaps[i].x - x) <= ROUNDING * fabs(x) ? &p->gaps[i] : NULL;
    char why[96] = "the curve has a gap there";
    if (run)
        (void)snprintf(why, sizeof why, "the run there %s%s", run->gap == FST_SWEEP_FAILED ? "" : "is ",
                       fst_sweep_sign("regime", run->gap).title);
    else if (low > high)
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

static void add_chi2(const fst_point_curves *p, const fst_points *points, int quantity, scaled *by_scale,
                     fst_points_fit *fit)
{
    int none = 0;
    for (size_t i = 0; i < points->count; ++i) {
        const fst_point *point = &points->rows[i];
        if (isnan(point->value[quantity]))
            continue;
        const fst_curve_piece *at = nearest_piece(p, quantity, point->frequency, point->value[quantity]);
        ++fit->all;
        if (at) {
            ++fit->counted;
            fit->chi2 += part_of_chi2(at, point, quantity, by_scale);
        } else if (p->is_sweep || p->count[quantity] > 0) {
            tell_left_out(p, point, quantity, fit);
        } else if (none++ == 0) {
            const size_t used = strlen(fit->left_out);
            (void)snprintf(fit->left_out + used, sizeof fit->left_out - used, "a branch has no %s\n",
                           fst_measured_name((fst_measured)quantity));
        }
    }
}

/* chi^2 of a table before a model. */
fst_points_fit fst_point_curves_fit(const fst_point_curves *p, const fst_points *points,
                                    const int wanted[FST_MEASURED_COUNT])
{
    fst_points_fit found = {.counted = 0};
    scaled by_scale = {0.0, 0.0};
    for (int q = 0; q < FST_MEASURED_COUNT; ++q)
        if (wanted[q])
            add_chi2(p, points, q, &by_scale, &found);
    found.chi2 -= by_scale.product * by_scale.product / (1.0 + by_scale.square);
    return found;
}

fst_status fst_point_curves_read(const char *path, const fst_points *tables, int table_count,
                                 const fst_sweep_figure *options, int used[FST_AXIS_LIMIT],
                                 fst_point_curves *curves, fst_error *error)
{
    int is_sweep = 0;
    const fst_status status = fst_is_sweep(path, &is_sweep, error);
    if (status != FST_OK)
        return status;
    return is_sweep ? take_sweep(path, options, used, curves, error)
                    : take_branch(path, tables, table_count, curves, error);
}
