/* bootstrap.c - errors from the numbers themselves: as many numbers as were fitted are drawn from them,
 * some twice and some not at all, and are fitted; how much the parameters then differ is their error, whatever
 * the table says of the errors of the numbers (Efron and Tibshirani, An Introduction to the Bootstrap, chapter
 * 9). */
#include "fit/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/chance.h"
#include "base/error.h"
#include "base/order.h"

/* Draw weights; returns how many different numbers were drawn. */
static int draw(fit_problem *p, const int *used, int count, uint64_t *state)
{
    int different = 0;
    for (int i = 0; i < p->count; ++i)
        p->numbers[i].weight = 0.0;
    for (int i = 0; i < count; ++i)
        p->numbers[used[fst_draw(state) % (uint64_t)count]].weight += 1.0;
    for (int i = 0; i < p->count; ++i)
        different += p->numbers[i].weight > 0.0;
    return different;
}

/* The value below which a part of the sorted values lies. */
static double quantile(const double *sorted, int count, double part)
{
    const double at = part * (count - 1);
    const int below = (int)at;
    return below + 1 < count ? sorted[below] + (at - below) * (sorted[below + 1] - sorted[below])
                             : sorted[count - 1];
}

static void conclude(const fit_problem *p, double *values, int samples, fst_fit *fit)
{
    const double tail = 0.15866; /* of a normal distribution beyond one standard deviation */
    for (int i = 0; i < p->space.count; ++i) {
        double *mine = values + (size_t)i * (size_t)samples;
        qsort(mine, (size_t)fit->bootstrap_count, sizeof *mine, fst_ascending);
        fit->parameters[i].bootstrap_error = 0.5 * (quantile(mine, fit->bootstrap_count, 1.0 - tail) -
                                                    quantile(mine, fit->bootstrap_count, tail));
    }
}

/* The least squares of the weighted numbers, from the minimum of all: Newton's steps with the derivatives
 * there, which need no further ones.  0 in *found where they do not settle. */
static fst_status refit(fit_problem *p, double *u, int *found, fst_error *error)
{
    enum { MOST_STEPS = 8 };
    const int m = fit_residual_count(p), n = p->space.count;
    double *jacobian = calloc((size_t)m * (size_t)n, sizeof *jacobian);
    fst_status status = jacobian ? FST_OK : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    fit_matrix covariance;
    *found = 0;
    if (status == FST_OK) {
        fit_weighted_derivatives(p, jacobian);
        *found = -fit_covariance(jacobian, m, n, &covariance);
    }
    for (int i = 0; i < MOST_STEPS && status == FST_OK && *found < 0; ++i) {
        double gain = 0.0, step[FIT_MOST];
        status = fit_residuals(p, u, p->f, error);
        for (int k = 0; k < n; ++k) {
            step[k] = 0.0;
            for (int j = 0; j < n; ++j)
                for (int r = 0; r < m; ++r)
                    step[k] -= covariance.a[k][j] * jacobian[r + m * j] * p->f[r];
        }
        for (int r = 0; r < m; ++r) {
            double change = 0.0;
            for (int k = 0; k < n; ++k)
                change += jacobian[r + m * k] * step[k];
            gain += change * change;
        }
        for (int k = 0; k < n; ++k)
            u[k] += step[k];
        *found = gain < 1e-3 ? 1 : *found;
    }
    *found = *found > 0;
    free(jacobian);
    return status;
}

fst_status fit_bootstrap(fit_problem *p, const fit_estimate *e, fit_stage *stage, int samples, uint64_t seed,
                         fst_fit *fit, fst_error *error)
{
    double *values = calloc((size_t)samples * (size_t)p->space.count, sizeof *values);
    double *weights = calloc((size_t)p->count, sizeof *weights);
    int *used = calloc((size_t)p->count, sizeof *used), count = 0;
    fst_status status =
        values && weights && used ? FST_OK : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    for (int i = 0; i < p->count && status == FST_OK; ++i) {
        weights[i] = p->numbers[i].weight;
        if (weights[i] > 0.0)
            used[count++] = i;
    }
    for (int s = 0; s < samples && status == FST_OK; ++s) {
        double u[FIT_MOST];
        int found;
        memcpy(u, e->u, sizeof u);
        fit_stage_begin(stage, "bootstrap", 0.9 + 0.1 * s / samples, 0.9 + 0.1 * (s + 1) / samples, 4.0);
        if (draw(p, used, count, &seed) <= fit_unheld(p))
            continue;
        status = refit(p, u, &found, error);
        for (int i = 0; i < p->space.count && status == FST_OK && found; ++i)
            values[(size_t)i * (size_t)samples + (size_t)fit->bootstrap_count] =
                fit_space_value(&p->space, u, i);
        fit->bootstrap_count += status == FST_OK && found;
    }
    for (int i = 0; i < p->count && weights; ++i)
        p->numbers[i].weight = weights[i];
    if (status == FST_OK && fit->bootstrap_count > 1)
        conclude(p, values, samples, fit);
    free(values);
    free(weights);
    free(used);
    return status;
}
