/* problem.c - the residuals of a fit.
 *
 * chi^2 is the sum of the squares of
 *
 *      (model - value)/error     of each number, the model at the frequency f + d of its row,
 *      d/error of f              of each row whose frequency has an error: d makes the sum least,
 *      e/error of the scale      where it has one: all lengths are wrong by the part e, which makes the sum least,
 *      (value - prior)/error     of each parameter of which something is known otherwise,
 *
 * and of how far a parameter lies outside its range, which holds the search within it.  The d are not sought:
 * where the model is taken as linear in d over that error, the best d is a linear function of the other
 * residuals (effective variance, with what the numbers of a row have in common).
 *
 * Where a trial has no orbit, though its row had one, the residuals grow smoothly from what they were, with the
 * distance from the parameters of that orbit: the search turns back instead of meeting a wall or a NAN.
 */
#include "fit/problem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/dot.h"
#include "base/error.h"

#define LOST_RESIDUAL 30.0 /* what a residual grows by where its motion is lost ... */
#define LOST_SLOPE 300.0   /* ... and by a unit of distance */
#define NEVER_FOUND 1000.0 /* a residual of a row that never had a motion */
#define RANGE_WEIGHT 100.0

/* ------------------------------------------------------------------ the problem */

static fst_status take_numbers(fit_problem *p, const fst_points *points, fst_error *error)
{
    p->numbers = calloc(points->count * FST_MEASURED_COUNT, sizeof *p->numbers);
    p->frequency_error = calloc(points->count, sizeof *p->frequency_error);
    double *frequencies = calloc(points->count, sizeof *frequencies);
    fst_status status = p->numbers && p->frequency_error && frequencies
                            ? FST_OK
                            : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    for (size_t i = 0; i < points->count && status == FST_OK; ++i) {
        const fst_point *row = &points->rows[i];
        frequencies[i] = row->frequency;
        p->frequency_error[i] = isfinite(row->frequency_error) ? row->frequency_error : 0.0;
        for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
            const int scaled = row->scale_error > 0.0 && fst_measured_unit((fst_measured)q) == FST_UNIT_LENGTH;
            if (isfinite(row->value[q]))
                p->numbers[p->count++] =
                    (fit_number){.row = (int)i,
                                 .what = (fst_measured)q,
                                 .value = row->value[q],
                                 .error = row->error[q],
                                 .by_scale = scaled ? row->scale_error * row->value[q] / row->error[q] : 0.0,
                                 .weight = 1.0};
        }
    }
    if (status == FST_OK)
        status = fit_rows_begin(&p->rows, &p->space, frequencies, (int)points->count, NULL, error);
    free(frequencies);
    return status;
}

static fst_status enough_numbers(const fit_problem *p, fst_error *error)
{
    const int wanted = fit_unheld(p);
    if (p->count >= wanted && p->count > 0)
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, "fst_fit",
                    "the table has %d numbers, and %d parameters are sought: measure more, seek fewer, or give "
                    "what is known otherwise",
                    p->count, wanted);
}

fst_status fit_problem_begin(fit_problem *p, const fst_params *params, const fst_points *points,
                             const fst_fit_options *options, const fst_progress *progress, fst_error *error)
{
    memset(p, 0, sizeof *p);
    fst_status status = fst_minpack_load(&p->minpack, error);
    if (status == FST_OK && !fst_lapack_present())
        status = fst_fail(
            error, FST_UNAVAILABLE, "festoon-lapack.so",
            "this festoon has no LAPACK, which orbits need: install liblapacke-dev and build festoon again");
    if (status == FST_OK)
        status = fit_space_begin(&p->space, params, options, error);
    if (status == FST_OK)
        status = take_numbers(p, points, error);
    if (status == FST_OK)
        status = enough_numbers(p, error);
    if (status != FST_OK)
        return status;
    p->rows.progress = progress;
    p->tolerance = 1e-7;
    p->most_calls = 100;
    p->values = calloc((size_t)p->rows.count, sizeof *p->values);
    p->slopes = calloc((size_t)p->rows.count * (size_t)p->space.count, sizeof *p->slopes);
    p->f = calloc((size_t)fit_residual_count(p), sizeof *p->f);
    p->common = calloc((size_t)fit_residual_count(p), sizeof *p->common);
    return p->values && p->slopes && p->f && p->common
               ? FST_OK
               : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
}

void fit_problem_free(fit_problem *p)
{
    fit_rows_free(&p->rows);
    free(p->numbers);
    free(p->frequency_error);
    free(p->values);
    free(p->slopes);
    free(p->f);
    free(p->common);
    memset(p, 0, sizeof *p);
}

int fit_used(const fit_problem *p)
{
    int used = 0;
    for (int i = 0; i < p->count; ++i)
        used += p->numbers[i].weight > 0.0;
    return used;
}

int fit_unheld(const fit_problem *p)
{
    int unheld = 0;
    for (int k = 0; k < p->space.count; ++k)
        unheld += isnan(p->space.keys[k].prior[0]);
    return unheld;
}

/* ------------------------------------------------------------------ residuals */

/* How the residual of a number grows where its row has lost its motion. */
static double lost_residual(const fit_problem *p, const fit_number *n)
{
    const fit_row *row = &p->rows.rows[n->row];
    if (row->last.origin == FIT_NOTHING)
        return NEVER_FOUND;
    double distance = 0.0;
    for (int k = 0; k < p->space.count; ++k)
        distance = hypot(distance, p->at[k] - row->at[k]);
    const double was = (row->last.value[n->what] - n->value) / n->error;
    return copysign(fabs(was) + LOST_RESIDUAL + LOST_SLOPE * distance, was);
}

static double number_residual(const fit_problem *p, const fit_number *n)
{
    const fit_value *v = &p->values[n->row];
    return v->origin == FIT_NOTHING ? lost_residual(p, n) : (v->value[n->what] - n->value) / n->error;
}

/* Error of a number with those of its frequency and of the scale, over its own. */
static double widening(const fit_problem *p, const fit_number *n)
{
    return hypot(hypot(1.0, n->by_frequency * p->frequency_error[n->row] / n->error), n->by_scale);
}

double fit_plain_residual(const fit_problem *p, int number)
{
    const fit_number *n = &p->numbers[number];
    return number_residual(p, n) / widening(p, n);
}

void fit_plain_slope(const fit_problem *p, int number, double slope[FIT_MOST])
{
    const fit_number *n = &p->numbers[number];
    for (int k = 0; k < p->space.count; ++k)
        slope[k] = p->slopes[n->row * p->space.count + k][n->what] / (n->error * widening(p, n));
}

/* Turn the residuals f of the numbers into weighted ones, whose squares are summed, at the best d of each row.
 * The map is linear, so it serves the derivatives too. */
static void join_rows(const fit_problem *p, double *f)
{
    double *d = f + p->count;
    for (int i = 0; i < p->rows.count; ++i) {
        double product = 0.0, square = 0.0;
        for (int k = 0; k < p->count && p->frequency_error[i] > 0.0; ++k) {
            const fit_number *n = &p->numbers[k];
            const double slope = n->row == i ? n->by_frequency * p->frequency_error[i] / n->error : 0.0;
            product += n->weight * f[k] * slope;
            square += n->weight * slope * slope;
        }
        d[i] = -product / (square + 1.0);
    }
    for (int k = 0; k < p->count; ++k) {
        const fit_number *n = &p->numbers[k];
        const double slope = n->by_frequency * p->frequency_error[n->row] / n->error;
        f[k] = sqrt(n->weight) * (f[k] + slope * d[n->row]);
    }
}

/* The same for the scale, whose deviation all lengths share: F becomes (1 + G G^T)^(-1/2) F, where G is what one
 * deviation does to the residuals F.  The sum of squares is then the least over all deviations, each with its own
 * square. */
static void join_all(const fit_problem *p, double *f)
{
    const int all = p->count + p->rows.count;
    join_rows(p, f);
    for (int k = 0; k < p->count; ++k)
        p->common[k] = p->numbers[k].by_scale;
    join_rows(p, p->common);
    const double square = fst_dot(p->common, p->common, all);
    if (!(square > 0.0))
        return;
    const double part = fst_dot(p->common, f, all) / square * (1.0 - 1.0 / sqrt(1.0 + square));
    for (int k = 0; k < all; ++k)
        f[k] -= part * p->common[k];
}

/* The robust form: a residual r counts by c^2 log(1 + (r/c)^2) (Cauchy's), and its derivative accordingly. */
static double tamed(double r, double c)
{
    return copysign(c * sqrt(log1p((r / c) * (r / c))), r);
}

static double taming(double r, double c)
{
    const double f = tamed(r, c);
    return f == 0.0 ? 1.0 : r / (1.0 + (r / c) * (r / c)) / f;
}

static void space_residuals(const fit_problem *p, const double *u, double *f)
{
    const fit_space *space = &p->space;
    for (int k = 0; k < space->count; ++k) {
        const fit_key *key = &space->keys[k];
        const double value = fit_space_value(space, u, k);
        f[k] = isnan(key->prior[0]) ? 0.0 : (value - key->prior[0]) / key->prior[1];
        const double inside = fmin(fmax(value, key->info->least), key->info->greatest);
        f[space->count + k] = value == inside     ? 0.0
                              : key->scale == 0.0 ? RANGE_WEIGHT * log(value / inside)
                                                  : RANGE_WEIGHT * (value - inside) / key->scale;
    }
}

fst_status fit_evaluate(fit_problem *p, const double *u, fst_error *error)
{
    if (!p->is_evaluated || memcmp(u, p->at, (size_t)p->space.count * sizeof *u) != 0) {
        const fst_status status = fit_rows_values(&p->rows, u, p->values, error);
        p->is_evaluated = status == FST_OK;
        if (status != FST_OK)
            return status;
        memcpy(p->at, u, (size_t)p->space.count * sizeof *u);
    }
    return FST_OK;
}

fst_status fit_residuals(fit_problem *p, const double *u, double *f, fst_error *error)
{
    const fst_status status = fit_evaluate(p, u, error);
    if (status != FST_OK)
        return status;
    for (int i = 0; i < p->count; ++i)
        f[i] = p->robust > 0.0 ? sqrt(p->numbers[i].weight) * tamed(fit_plain_residual(p, i), p->robust)
                               : number_residual(p, &p->numbers[i]);
    if (p->robust > 0.0)
        memset(f + p->count, 0, (size_t)p->rows.count * sizeof *f);
    else
        join_all(p, f);
    space_residuals(p, u, f + p->count + p->rows.count);
    return FST_OK;
}

/* ------------------------------------------------------------------ derivatives */

static void space_derivatives(const fit_problem *p, const double *u, double *jacobian)
{
    const fit_space *space = &p->space;
    const int m = fit_residual_count(p), first = p->count + p->rows.count;
    for (int k = 0; k < space->count; ++k) {
        const fit_key *key = &space->keys[k];
        double c[FIT_MOST];
        fit_space_own(space, k, c);
        const double q = fst_dot(c, u, space->count);
        const double value = fit_space_at(space, k, q), slope = fit_space_slope(space, k, q);
        const int outside = value < key->info->least || value > key->info->greatest;
        for (int j = 0; j < space->count; ++j) {
            jacobian[first + k + m * j] = isnan(key->prior[0]) ? 0.0 : c[j] * slope / key->prior[1];
            jacobian[first + space->count + k + m * j] = outside ? RANGE_WEIGHT * c[j] : 0.0;
        }
    }
}

void fit_weighted_derivatives(const fit_problem *p, double *jacobian)
{
    const int m = fit_residual_count(p), n = p->space.count;
    double raw[FIT_MOST];
    for (int j = 0; j < n; ++j) {
        double *column = jacobian + (size_t)m * (size_t)j;
        memset(column, 0, (size_t)m * sizeof *column);
        for (int i = 0; i < p->count; ++i) {
            const fit_number *number = &p->numbers[i];
            fit_plain_slope(p, i, raw);
            column[i] = p->robust > 0.0
                            ? sqrt(number->weight) * raw[j] * taming(fit_plain_residual(p, i), p->robust)
                            : raw[j] * widening(p, number);
        }
        if (!(p->robust > 0.0))
            join_all(p, column);
    }
    space_derivatives(p, p->slopes_at, jacobian);
}

fst_status fit_derivatives(fit_problem *p, const double *u, double *jacobian, fst_error *error)
{
    const size_t size = (size_t)p->space.count * sizeof *u;
    fst_status status = fit_evaluate(p, u, error);
    if (status == FST_OK && !(p->has_slopes && memcmp(u, p->slopes_at, size) == 0)) {
        p->has_slopes = 0;
        fit_rows_keep(&p->rows, u, p->values);
        status = fit_rows_slopes(&p->rows, p->slopes, error);
        memcpy(p->slopes_at, u, size);
        p->has_slopes = status == FST_OK;
    }
    if (status == FST_OK)
        fit_weighted_derivatives(p, jacobian);
    return status;
}

fst_status fit_take_frequency_slopes(fit_problem *p, fst_error *error)
{
    int wanted = 0;
    for (int i = 0; i < p->rows.count; ++i)
        wanted |= p->frequency_error[i] > 0.0;
    if (!wanted)
        return FST_OK;
    double(*slopes)[FST_MEASURED_COUNT] = calloc((size_t)p->rows.count, sizeof *slopes);
    fst_status status = slopes ? fit_rows_by_frequency(&p->rows, slopes, error)
                               : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    for (int i = 0; i < p->count && status == FST_OK; ++i)
        p->numbers[i].by_frequency = slopes[p->numbers[i].row][p->numbers[i].what];
    free(slopes);
    return status;
}

/* ------------------------------------------------------------------ the search */

static fst_status ask_residuals(void *user, const double *u, double *f, fst_error *error)
{
    return fit_residuals(user, u, f, error);
}

static fst_status ask_derivatives(void *user, const double *u, double *jacobian, fst_error *error)
{
    return fit_derivatives(user, u, jacobian, error);
}

fst_status fit_sum(fit_problem *p, const double *u, double *sum, fst_error *error)
{
    const fst_status status = fit_residuals(p, u, p->f, error);
    *sum = status == FST_OK ? fst_dot(p->f, p->f, fit_residual_count(p)) : INFINITY;
    return status;
}

fst_status fit_solve(fit_problem *p, double *u, double *chi2, fst_error *error)
{
    const fit_least_squares least = {.minpack = p->minpack,
                                     .user = p,
                                     .residuals = ask_residuals,
                                     .derivatives = ask_derivatives,
                                     .m = fit_residual_count(p),
                                     .n = p->space.count,
                                     .tolerance = p->tolerance,
                                     .most_calls = p->most_calls};
    const fst_status status = fit_least(&least, u, p->f, error);
    return status == FST_OK ? fit_sum(p, u, chi2, error) : status;
}
