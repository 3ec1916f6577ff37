/* errors.c - how well the parameters of a fit are known.
 *
 * Two answers.  The covariance matrix is the inverse of J^T J at the minimum: a parabola put under chi^2.  The
 * profile's interval of a parameter asks chi^2 itself: the parameter is held at a value, all others are sought
 * anew, and where chi^2 has risen by 1 the interval ends.
 *
 *      chi^2 |  \  parabola       the profile is steeper on one side: an interval from -0.8 to +1.2 sigma
 *         +1 |---\.----------./
 *            |    '\        /
 *          0 |      '-.__.-'
 *
 * The others are sought by Newton's steps with the derivatives at the minimum, which serve as far as the
 * interval reaches; no further derivative is computed.
 */
#include "fit/errors.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/dot.h"
#include "base/error.h"

/* Eigenvalues and eigenvectors of J^T J. */
static void find_information(const double *jacobian, int m, int n, double values[FIT_MOST], fit_matrix *vectors)
{
    fit_matrix information = {.size = n};
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
            for (int i = 0; i < m; ++i)
                information.a[a][b] += jacobian[i + m * a] * jacobian[i + m * b];
    fit_eigen(&information, values, vectors);
    for (int k = 0; k < n; ++k) /* rounding may leave nothing, or less, of what is not known at all */
        values[k] = fmax(values[k], 1e-18 * values[n - 1] + 1e-200);
}

static int is_distinct(const double *eigenvalues, int n)
{
    return eigenvalues[0] > 1e-9 * eigenvalues[n - 1] && eigenvalues[0] > 1e-4;
}

int fit_covariance(const double *jacobian, int m, int n, fit_matrix *covariance)
{
    double values[FIT_MOST];
    fit_matrix vectors;
    find_information(jacobian, m, n, values, &vectors);
    fit_inverse(n, values, &vectors, covariance);
    return is_distinct(values, n);
}

fst_status fit_estimate_make(fit_problem *p, const double *u, fit_estimate *e, fst_error *error)
{
    const int m = fit_residual_count(p), n = p->space.count;
    memset(e, 0, sizeof *e);
    memcpy(e->u, u, (size_t)n * sizeof *u);
    e->jacobian = calloc((size_t)m * (size_t)n, sizeof *e->jacobian);
    if (!e->jacobian)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    fst_status status = fit_sum(p, u, &e->chi2, error);
    if (status == FST_OK)
        status = fit_derivatives(p, u, e->jacobian, error);
    if (status != FST_OK)
        return status;
    find_information(e->jacobian, m, n, e->eigenvalues, &e->vectors);
    fit_inverse(n, e->eigenvalues, &e->vectors, &e->covariance);
    return FST_OK;
}

void fit_estimate_free(fit_estimate *e)
{
    free(e->jacobian);
    e->jacobian = NULL;
}

/* ------------------------------------------------------------------ what cannot be known */

fst_status fit_estimate_check(const fit_problem *p, const fit_estimate *e, fst_error *error)
{
    const int n = p->space.count;
    if (is_distinct(e->eigenvalues, n))
        return FST_OK;
    double q[FIT_MOST], greatest = 0.0;
    for (int i = 0; i < n; ++i) {
        double c[FIT_MOST];
        fit_space_own(&p->space, i, c);
        q[i] = 0.0;
        for (int k = 0; k < n; ++k)
            q[i] += c[k] * e->vectors.a[k][0];
        greatest = fmax(greatest, fabs(q[i]));
    }
    char names[512] = "", changes[512] = "";
    int found = 0;
    for (int i = 0; i < n; ++i) {
        if (fabs(q[i]) < 0.05 * greatest)
            continue;
        const char *key = p->space.keys[i].info->key;
        const size_t used = strlen(names), told = strlen(changes);
        (void)snprintf(names + used, sizeof names - used, "%s%s", found ? ", " : "", key);
        (void)snprintf(changes + told, sizeof changes - told, "%s%s %s by %.3g %%", found ? ", " : "", key,
                       q[i] > 0 ? "up" : "down", fabs(q[i]) / greatest);
        ++found;
    }
    if (found == 1)
        return fst_fail(error, FST_BAD_INPUT, "fst_fit",
                        "the model's numbers do not depend on %s here, so the table says nothing about it: "
                        "leave it out of the parameters that are sought",
                        names);
    return fst_fail(error, FST_BAD_INPUT, "fst_fit",
                    "the table cannot tell these parameters apart: %s. Changing %s at the same time changes no "
                    "number. Seek one fewer of them, or give what is known otherwise of one",
                    names, changes);
}

/* ------------------------------------------------------------------ the parabola */

double fit_deviation(const fit_problem *p, const fit_estimate *e, int i)
{
    double c[FIT_MOST];
    fit_space_own(&p->space, i, c);
    return sqrt(fit_product(&e->covariance, c, c));
}

double fit_correlation(const fit_problem *p, const fit_estimate *e, int i, int j)
{
    double a[FIT_MOST], b[FIT_MOST];
    if (i == j)
        return 1.0;
    fit_space_own(&p->space, i, a);
    fit_space_own(&p->space, j, b);
    return fit_product(&e->covariance, a, b) / (fit_deviation(p, e, i) * fit_deviation(p, e, j));
}

double fit_leverage(const fit_problem *p, const fit_estimate *e, int number)
{
    double slope[FIT_MOST];
    fit_plain_slope(p, number, slope);
    return p->numbers[number].weight * fit_product(&e->covariance, slope, slope);
}

/* ------------------------------------------------------------------ the profile */

/* A motion that was there at the minimum is lost. */
static int is_lost(const fit_problem *p)
{
    for (int i = 0; i < p->rows.count; ++i)
        if (p->values[i].origin == FIT_NOTHING)
            return 1;
    return 0;
}

/* Where the search for an end stands. */
typedef struct profile {
    double c[FIT_MOST], cs[FIT_MOST], along; /* the direction, the covariance times it, and their product */
    double inside, lost;                     /* known to lie inside; known to have lost the motion */
} profile;

/* One Newton's step at u, of which the residuals are known, towards the least chi^2 where the own coordinate
 * c.(u - e->u) is q; returns by how much it expects to lower chi^2. */
static double constrained_step(const fit_problem *p, const fit_estimate *e, const profile *w, double q,
                               double *u)
{
    const int m = fit_residual_count(p), n = p->space.count;
    double slope[FIT_MOST], step[FIT_MOST], gap = q, change = 0.0;
    for (int k = 0; k < n; ++k)
        slope[k] = fst_dot(e->jacobian + (size_t)m * (size_t)k, p->f, m);
    for (int k = 0; k < n; ++k) {
        step[k] = -fst_dot(e->covariance.a[k], slope, n);
        gap -= w->c[k] * (u[k] - e->u[k] + step[k]);
    }
    for (int k = 0; k < n; ++k)
        step[k] += w->cs[k] * gap / w->along;
    for (int i = 0; i < m; ++i) {
        double df = 0.0;
        for (int k = 0; k < n; ++k)
            df += e->jacobian[i + m * k] * step[k];
        change += df * df;
    }
    for (int k = 0; k < n; ++k)
        u[k] += step[k];
    return change;
}

/* The least chi^2 where the own coordinate is q away from the minimum's; INFINITY where a motion is lost.  u is
 * the guess, and becomes the place. */
static fst_status constrained_minimum(fit_problem *p, const fit_estimate *e, const profile *w, double q,
                                      double *u, double enough, double *chi2, fst_error *error)
{
    enum { MOST_STEPS = 6 };
    double best[FIT_MOST], here;
    fst_status status = FST_OK;
    *chi2 = INFINITY;
    memcpy(best, u, sizeof best);
    for (int i = 0; i < MOST_STEPS && status == FST_OK; ++i) {
        status = fit_sum(p, u, &here, error);
        if (status != FST_OK || is_lost(p) || here >= *chi2)
            break;
        *chi2 = here;
        memcpy(best, u, sizeof best);
        if (constrained_step(p, e, w, q, u) < enough)
            break;
    }
    memcpy(u, best, sizeof best);
    return status;
}

static void begin_profile(const fit_problem *p, const fit_estimate *e, int i, profile *w)
{
    *w = (profile){.inside = 0.0, .lost = INFINITY};
    fit_space_own(&p->space, i, w->c);
    for (int k = 0; k < p->space.count; ++k)
        w->cs[k] = fst_dot(e->covariance.a[k], w->c, p->space.count);
    w->along = fst_dot(w->c, w->cs, p->space.count);
}

fst_status fit_profile(fit_problem *p, const fit_estimate *e, int i, int side, double rise, double *end,
                       int *better, double u_better[FIT_MOST], fst_error *error)
{
    enum { MOST_TRIES = 10 };
    profile w;
    begin_profile(p, e, i, &w);
    const double farthest = 10.0 * sqrt(w.along * rise);
    double q = sqrt(w.along * rise);
    *end = NAN;
    for (int tries = 0; tries < MOST_TRIES; ++tries) {
        double u[FIT_MOST] = {0.0}, chi2;
        for (int k = 0; k < p->space.count; ++k)
            u[k] = e->u[k] + side * q * w.cs[k] / w.along;
        const fst_status status = constrained_minimum(p, e, &w, side * q, u, 0.01 * rise, &chi2, error);
        if (status != FST_OK)
            return status;
        if (chi2 < e->chi2 - 0.02 * rise) {
            *better = 1;
            memcpy(u_better, u, sizeof u);
        }
        if (chi2 == INFINITY) {
            w.lost = fmin(w.lost, q);
            q = 0.5 * (w.inside + q);
        } else {
            const double reached = sqrt(fmax(chi2 - e->chi2, 0.0) / rise);
            if (fabs(reached - 1.0) < 0.03) {
                *end = side * q / reached;
                return FST_OK;
            }
            if (reached < 1.0)
                w.inside = fmax(w.inside, q);
            q *= reached > 0.4 ? 1.0 / reached : 2.5;
            q = q < w.lost ? q : 0.5 * (w.inside + w.lost);
        }
        if (q > farthest || w.lost - w.inside < 0.02 * w.lost)
            return FST_OK;
    }
    return FST_OK;
}
