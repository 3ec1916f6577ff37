/* fit.c - from measured points to parameters: the stages of a fit, one after the other. */
#include "fit/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/dot.h"
#include "base/error.h"
#include "fit/curve.h"
#include "fit/outliers.h"

#define FIT_COOKIE 0x66697431u

/* A model whose chi^2/dof is beyond the square of this does not fit: where its chi^2 rises means nothing, and takes long. */
#define NO_FIT 3.0

fst_fit_options fst_default_fit_options(void)
{
    return (fst_fit_options){.cookie = FIT_COOKIE, .seed = 1, .drive = NAN, .exposure = NAN};
}

int fst_fit_present(void)
{
    const fst_minpack *minpack;
    return fst_minpack_load(&minpack, NULL) == FST_OK;
}

void fst_fit_free(fst_fit *fit)
{
    free(fit->outliers);
    free(fit->numbers);
    free(fit->curve);
    free(fit->remarks);
    memset(fit, 0, sizeof *fit);
}

/* ------------------------------------------------------------------ the report */

static fst_status say_interval(fst_fit *fit, const fst_fit_parameter *p, fst_error *error)
{
    if (fit->error_scale > NO_FIT)
        return FST_OK;
    const int low = isnan(p->interval[0]), high = isnan(p->interval[1]);
    if (isnan(p->error))
        return fit_remark(
            fit, error,
            "%s: the table hardly says more than its order of magnitude, so no standard deviation is given",
            p->key);
    if (!low && !high)
        return FST_OK;
    return fit_remark(fit, error,
                      "%s: its interval has no %s end: chi^2 does not rise enough before the parameter's range "
                      "ends or the motion becomes another one",
                      p->key,
                      low && high ? "lower or upper"
                      : low       ? "lower"
                                  : "upper");
}

double fit_own_value(const fit_problem *p, const fit_estimate *e, int i)
{
    double c[FIT_MOST];
    fit_space_own(&p->space, i, c);
    return fst_dot(c, e->u, p->space.count);
}

void fit_report_value(const fit_problem *p, const fit_estimate *e, int i, double deviation,
                      fst_fit_parameter *out)
{
    const fit_key *key = &p->space.keys[i];
    const double q = fit_own_value(p, e, i);
    *out = (fst_fit_parameter){.unit = key->info->unit,
                               .value = fit_space_at(&p->space, i, q),
                               .interval = {NAN, NAN},
                               .bootstrap_error = NAN};
    (void)snprintf(out->key, sizeof out->key, "%s", key->info->key);
    memcpy(out->prior, key->prior, sizeof out->prior);
    out->error = deviation < 1.0 || key->scale != 0.0 ? deviation * fit_space_slope(&p->space, i, q) : NAN;
}

/* Where chi^2 is not a parabola, one standard deviation is what its rise to 1, or half of what its rise to 4, says: whichever
 * is more.  Where these agree with the curvature within a fifth, that is taken, for it has no noise. */
#define NO_PARABOLA 1.2

/* Value, error, interval of a parameter; *better where the minimum turned out to be none. */
static fst_status report_parameter(fit_problem *p, const fit_estimate *e, int i, fst_fit *fit, int *better,
                                   double u_better[FIT_MOST], fst_error *error)
{
    const fit_key *key = &p->space.keys[i];
    fst_fit_parameter *out = &fit->parameters[i];
    const double q = fit_own_value(p, e, i);
    fit_report_value(p, e, i, fit->error_scale * fit_deviation(p, e, i), out);
    const double rise = fit->error_scale * fit->error_scale;
    double widest = 0.0;
    if (fit->error_scale > NO_FIT)
        return FST_OK;
    for (int side = -1; side <= 1; side += 2) {
        double end, far;
        fst_status status = fit_profile(p, e, i, side, rise, &end, better, u_better, error);
        if (status == FST_OK)
            status = fit_profile(p, e, i, side, 4.0 * rise, &far, better, u_better, error);
        if (status != FST_OK)
            return status;
        const double at = fit_space_at(&p->space, i, q + end);
        const double twice = fit_space_at(&p->space, i, q + far) - out->value;
        out->interval[side > 0] = at >= key->info->least && at <= key->info->greatest ? at : NAN;
        widest = fmax(widest, fmax(fabs(at - out->value), 0.5 * fabs(twice)));
    }
    if (widest > NO_PARABOLA * out->error) {
        fit->widened = fmax(fit->widened, widest / out->error);
        out->error = widest;
    }
    return FST_OK;
}

static fst_status report_parameters(fit_problem *p, fit_estimate *e, fst_fit *fit, fst_error *error)
{
    for (int round = 0; round < 2; ++round) {
        int better = 0;
        double u[FIT_MOST] = {0.0}, chi2;
        for (int i = 0; i < p->space.count; ++i) {
            const fst_status status = report_parameter(p, e, i, fit, &better, u, error);
            if (status != FST_OK)
                return status;
        }
        if (!better || round > 0)
            break;
        fit_estimate_free(e);
        fst_status status = fit_solve(p, u, &chi2, error);
        if (status == FST_OK)
            status = fit_estimate_make(p, u, e, error);
        if (status != FST_OK)
            return status;
    }
    if (fit->widened > 1.0 && fit_remark(fit, error,
                                         "chi^2 is not a parabola within two standard deviations: errors are "
                                         "those by which it has risen to 4, halved, "
                                         "and up to %.3g times those of its curvature; quote the intervals",
                                         fit->widened) != FST_OK)
        return FST_NO_MEMORY;
    for (int i = 0; i < p->space.count; ++i) {
        const fst_status status = say_interval(fit, &fit->parameters[i], error);
        if (status != FST_OK)
            return status;
        for (int j = 0; j < p->space.count; ++j)
            fit->correlation[i][j] = fit_correlation(p, e, i, j);
    }
    return FST_OK;
}

/* Whether a parameter is the strength of a part of the magnet, of which B0 is but the unit. */
static int is_strength(const fit_key *key)
{
    const fst_unit unit = key->info->unit;
    return strncmp(key->info->key, "magnet.parts[", 13) == 0 &&
           (unit == FST_UNIT_FIELD || unit == FST_UNIT_MOMENT);
}

/* kappa gamma^2, by the change of its logarithm along each coordinate: a product of powers, along which it changes much
 * more than by rounding or not at all.  NAN where nothing changes it, or where it does not say how strong the magnet is. */
fst_status fit_report_kappa_gamma2(const fit_problem *p, const fit_estimate *e, fst_fit *fit, fst_error *error)
{
    const double step = 1e-6;
    double slope[FIT_MOST] = {0.0};
    int moves = 0, blind = 0;
    fst_status status = fit_kappa_gamma2(&fit->params, &fit->kappa_gamma2, error);
    for (int k = 0; k < p->space.count && status == FST_OK; ++k) {
        double u[FIT_MOST], there;
        fst_params moved;
        memcpy(u, e->u, sizeof u);
        u[k] += step;
        (void)fit_space_params(&p->space, u, &moved);
        status = fit_kappa_gamma2(&moved, &there, error);
        slope[k] = log(there / fit->kappa_gamma2) / step;
        moves |= fabs(slope[k]) > 1e-6;
        blind |= is_strength(&p->space.keys[k]);
    }
    fit->kappa_gamma2_error =
        fit->kappa_gamma2 * fit->error_scale * fit->widened * sqrt(fit_product(&e->covariance, slope, slope));
    if (!moves || blind)
        fit->kappa_gamma2 = fit->kappa_gamma2_error = NAN;
    return status;
}

static fst_status report_numbers(fit_problem *p, const fit_estimate *e, const fst_points *points, fst_fit *fit,
                                 fst_error *error)
{
    fit->numbers = calloc((size_t)p->count, sizeof *fit->numbers);
    fit->outliers = calloc((size_t)p->count, sizeof *fit->outliers);
    if (!fit->numbers || !fit->outliers)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    const fst_status status = fit_evaluate(p, e->u, error);
    for (int i = 0; i < p->count && status == FST_OK; ++i) {
        const fit_number *n = &p->numbers[i];
        const double expected = p->values[n->row].value[n->what];
        const double deviation = fit_studentised(p, e, i);
        fit->numbers[fit->number_count++] = (fst_fit_number){
            (size_t)n->row, n->what, n->value, expected, -fit_plain_residual(p, i), n->weight > 0.0};
        if (n->weight > 0.0)
            continue;
        fit->outliers[fit->outlier_count++] = (fst_fit_outlier){
            points->rows[n->row].line, points->column[n->what], n->what, n->value, expected, -deviation};
    }
    return status;
}

static fst_status report_fit(fit_problem *p, const fit_estimate *e, int too_many, fst_fit *fit,
                             fst_error *error)
{
    const int dof = fit_used(p) - fit_unheld(p), k = p->space.free_count;
    fit->chi2 = e->chi2;
    fit->points = fit_used(p);
    fit->dof = fit->points - k;
    fit->error_scale = fit_error_scale(e->chi2, dof);
    fit->widened = 1.0;
    fit->slip_misfit = fit->slip_chi2 = NAN;
    fit->aicc = fit_aicc(e->chi2, fit->points, k);
    if (too_many &&
        fit_remark(fit, error,
                   "more than a quarter of the numbers lie far off the model: none was left out as an outlier, "
                   "for it is the model, its friction law or the errors of the table that do not fit") !=
            FST_OK)
        return FST_NO_MEMORY;
    if (fit->error_scale > 1.0 &&
        fit_remark(fit, error,
                   "chi^2/dof = %.3g is too great for chance: the errors of the table are too small or the "
                   "model is not quite right; all errors were multiplied by %.3g",
                   e->chi2 / dof, fit->error_scale) != FST_OK)
        return FST_NO_MEMORY;
    if (fit->error_scale > NO_FIT && fit_remark(fit, error,
                                                "the model does not fit these numbers, so no intervals were "
                                                "sought: look at the figure, at the scale, the "
                                                "law of friction and the errors of the table") != FST_OK)
        return FST_NO_MEMORY;
    if (fit->dof <= 0 &&
        fit_remark(fit, error,
                   "there are as many parameters as numbers: nothing shows whether the model fits") != FST_OK)
        return FST_NO_MEMORY;
    return FST_OK;
}

static fst_status report_curve(fit_problem *p, const fit_estimate *e, int count, fst_fit *fit, fst_error *error)
{
    double from, to;
    fit_curve curve;
    if (count < 1)
        return FST_OK;
    fit_frequency_range(p, 0.08, &from, &to);
    const fst_status status = fit_curve_make(p, e, fit->error_scale, from, to, count, &curve, error);
    if (status != FST_OK)
        return status;
    fit->curve = curve.points;
    fit->curve_count = (size_t)count;
    free(curve.slopes);
    return FST_OK;
}

/* ------------------------------------------------------------------ the fit */

static fst_status report_all(fit_problem *p, fit_stage *stage, fit_estimate *e, int too_many,
                             const fst_points *points, const fst_fit_options *options, fst_fit *fit,
                             fst_error *error)
{
    fit->count = p->space.count;
    fit->free_count = p->space.free_count;
    fst_status status = report_fit(p, e, too_many, fit, error);
    fit_stage_begin(stage, "intervals", 0.4, 0.6, 20.0 * p->space.count);
    if (status == FST_OK)
        status = report_parameters(p, e, fit, error);
    if (status != FST_OK)
        return status;
    (void)fit_space_params(&p->space, e->u, &fit->params);
    status = fit_report_kappa_gamma2(p, e, fit, error);
    if (status == FST_OK)
        status = report_numbers(p, e, points, fit, error);
    fit_stage_begin(stage, "curves", 0.6, 0.7, 4.0);
    if (status == FST_OK)
        status = fit_weakest(p, e, 1, fit, error);
    if (status == FST_OK)
        status = report_curve(p, e, options->curve_points, fit, error);
    if (status == FST_OK && options->rivals)
        status = fit_rivals(p, stage, points, options, fit, error);
    if (status == FST_OK && options->bootstrap > 0)
        status = fit_bootstrap(p, e, stage, options->bootstrap, options->seed, fit, error);
    return status;
}

fst_status fst_fit_points(const fst_params *params, const fst_points *points, const fst_fit_options *options,
                          fst_fit *fit, fst_error *error)
{
    fit_problem p;
    fit_estimate e = {0};
    fit_stage stage = {.outer = options->progress};
    const fst_progress progress = {&stage, fit_stage_tell};
    double u[FIT_MOST] = {0.0}, chi2 = 0.0;
    int too_many = 0;
    memset(fit, 0, sizeof *fit);
    fit->params = *params;
    if (options->cookie != FIT_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_fit_options", "begin with fst_default_fit_options()");
    fit_stage_begin(&stage, "search", 0.0, 0.4, 15.0);
    fst_status status = fit_remark(fit, error, "%s", "");
    if (status == FST_OK)
        status = fit_problem_begin(&p, params, points, options, &progress, error);
    else
        memset(&p, 0, sizeof p);
    if (status == FST_OK)
        status = fit_mind_signs(&p, fit, error);
    if (status == FST_OK)
        status = fit_search_all(&p, u, &chi2, &too_many, error);
    if (status == FST_OK)
        status = fit_estimate_make(&p, u, &e, error);
    if (status == FST_OK)
        status = fit_estimate_check(&p, &e, error);
    if (status == FST_OK)
        status = report_all(&p, &stage, &e, too_many, points, options, fit, error);
    fit_estimate_free(&e);
    fit_problem_free(&p);
    if (status != FST_OK)
        fst_fit_free(fit);
    return status;
}
