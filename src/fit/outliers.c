/* outliers.c - numbers that nothing explains.
 *
 * A wild number drags the least squares, and what it drags hides it.  So where any number stands out, the
 * search is repeated with Cauchy's measure, which counts large residuals by their logarithm; from that minimum
 * wild numbers are seen, are left out, and the least squares of the rest are sought.  Where no number stands
 * out, which is the rule, the plain fit stays as it is, and its errors are those of theory.
 *
 * A number is left out beyond 4 standard deviations, as it would be measured against a fit without it: of 24
 * good numbers one in 600 tables loses one.  Where the errors are too small throughout, or the model is not
 * quite right, the deviations are measured by what is usual in this table.
 */
#include "fit/outliers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/order.h"

#define STANDS_OUT 4.0 /* standard deviations beyond which a number is left out ... */
#define COMES_BACK 3.5 /* ... and below which it comes back */
#define CAUCHY 2.0     /* residuals up to this count nearly by their squares */

double fit_studentised(const fit_problem *p, const fit_estimate *e, int number)
{
    double slope[FIT_MOST];
    const double r = fit_plain_residual(p, number);
    if (!(p->numbers[number].weight > 0.0)) { /* the fit does not know it */
        fit_plain_slope(p, number, slope);
        return r / sqrt(1.0 + fit_product(&e->covariance, slope, slope));
    }
    return r / sqrt(fmax(1.0 - fit_leverage(p, e, number), 1e-3));
}

double fit_error_scale(double chi2, int dof)
{
    if (dof < 1)
        return 1.0;
    /* Wilson and Hilferty: the cube root of chi^2/dof is nearly normal. */
    const double variance = 2.0 / (9.0 * dof);
    return (cbrt(chi2 / dof) - (1.0 - variance)) / sqrt(variance) > 3.09 ? sqrt(chi2 / dof) : 1.0;
}

/* What is usual for a residual here: from the median, which wild ones do not move; at least 1. */
static double usual_residual(const fit_problem *p)
{
    double *size = calloc((size_t)p->count, sizeof *size);
    if (!size)
        return 1.0;
    for (int i = 0; i < p->count; ++i)
        size[i] = fabs(fit_plain_residual(p, i));
    qsort(size, (size_t)p->count, sizeof *size, fst_ascending);
    const double median = 0.5 * (size[(p->count - 1) / 2] + size[p->count / 2]);
    const int freedom = p->count - fit_unheld(p);
    free(size);
    return fmax(1.0, freedom > 0 ? 1.4826 * median * sqrt((double)p->count / freedom) : 1.0);
}

static int any_stands_out(const fit_problem *p, const fit_estimate *e)
{
    for (int i = 0; i < p->count; ++i)
        if (p->numbers[i].weight > 0.0 && fabs(fit_studentised(p, e, i)) > STANDS_OUT)
            return 1;
    return 0;
}

/* The robust search, from the beginning, and from where the plain one ended; leaves the better of both.  A very
 * wild number drags the plain search to where hardly any motion is like the measured one, and a search from
 * there lasts long: it is left out where the one from the beginning is much better than that place. */
static fst_status search_robustly(fit_problem *p, double *u, fst_error *error)
{
    double from_start[FIT_MOST] = {0.0}, from_here[FIT_MOST], one, other;
    memcpy(from_here, u, sizeof from_here);
    p->robust = CAUCHY;
    fst_status status = fit_sum(p, u, &one, error);
    if (status == FST_OK)
        status = fit_solve(p, from_start, &other, error);
    if (status == FST_OK && other > 0.5 * one)
        status = fit_solve(p, from_here, &one, error);
    if (status == FST_OK)
        memcpy(u, one <= other ? from_here : from_start, sizeof from_here);
    p->robust = 0.0;
    return status;
}

/* Weights by the deviations, `usual` being 1; returns how many changed. */
static int weigh(fit_problem *p, const fit_estimate *e, double usual)
{
    int changed = 0;
    for (int i = 0; i < p->count; ++i) {
        const double deviation = fabs(fit_studentised(p, e, i)) / usual;
        const double limit = p->numbers[i].weight > 0.0 ? STANDS_OUT : COMES_BACK;
        const double weight = deviation > limit ? 0.0 : 1.0;
        changed += weight != p->numbers[i].weight;
        p->numbers[i].weight = weight;
    }
    return changed;
}

static fst_status weigh_at(fit_problem *p, const double *u, int first, int *changed, fst_error *error)
{
    fit_estimate e;
    fst_status status = fit_estimate_make(p, u, &e, error);
    if (status == FST_OK) {
        const int dof = fit_used(p) - fit_unheld(p);
        *changed = weigh(p, &e, first ? usual_residual(p) : fit_error_scale(e.chi2, dof));
    }
    fit_estimate_free(&e);
    return status;
}

fst_status fit_reject(fit_problem *p, double *u, double *chi2, int *too_many, fst_error *error)
{
    enum { MOST_ROUNDS = 5 };
    fit_estimate e;
    double plain[FIT_MOST];
    const double plain_chi2 = *chi2;
    int changed = 0;
    *too_many = 0;
    memcpy(plain, u, sizeof plain);
    fst_status status = fit_estimate_make(p, u, &e, error);
    const int suspicious = status == FST_OK && any_stands_out(p, &e);
    fit_estimate_free(&e);
    if (status != FST_OK || !suspicious || p->count <= fit_unheld(p) + 1)
        return status;
    status = search_robustly(p, u, error);
    for (int round = 0; round < MOST_ROUNDS && status == FST_OK; ++round) {
        status = weigh_at(p, u, round == 0, &changed, error);
        if (status != FST_OK || (round > 0 && changed == 0))
            break;
        if (p->count - fit_used(p) > (p->count > 4 ? p->count / 4 : 1) || fit_used(p) < fit_unheld(p)) {
            *too_many = 1;
            for (int i = 0; i < p->count; ++i)
                p->numbers[i].weight = 1.0;
            memcpy(u, plain, sizeof plain);
            *chi2 = plain_chi2;
            return FST_OK;
        }
        status = fit_solve(p, u, chi2, error);
    }
    return status;
}
