/* fit.c - from measured points to parameters: the stages of a fit, one after the other. */
#include "track/fit.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "track/fit_bootstrap.h"
#include "track/fit_curve.h"
#include "track/fit_outliers.h"
#include "track/fit_rivals.h"
#include "track/fit_words.h"

#define FIT_COOKIE 0x66697431u

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

fst_status fit_remark(fst_fit *fit, fst_error *error, const char *format, ...)
{
    char line[1024];
    va_list values;
    va_start(values, format);
    (void)vsnprintf(line, sizeof line, format, values);
    va_end(values);
    const size_t before = fit->remarks ? strlen(fit->remarks) : 0;
    char *longer = realloc(fit->remarks, before + strlen(line) + 2);
    if (!longer)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    fit->remarks = longer;
    (void)snprintf(longer + before, strlen(line) + 2, "%s%s", before ? "\n" : "", line);
    return FST_OK;
}

/* ------------------------------------------------------------------ progress */

/* How many calls a search takes is not known beforehand: the fraction of a stage approaches its end. */
static fst_status tell_stage(void *user, double fraction, const char *what, fst_error *error)
{
    fit_stage *s = user;
    (void)what;
    if (!s->outer)
        return FST_OK;
    if (fraction < s->latest)
        s->calls += 1;
    s->latest = fraction;
    const double done = 1.0 - exp(-1.5 * (s->calls + fraction) / s->expected);
    return s->outer->tell(s->outer->user, s->from + done * (s->to - s->from), s->what, error);
}

void fit_stage_begin(fit_stage *s, const char *what, double from, double to, double expected)
{
    s->what = what;
    s->from = from;
    s->to = to;
    s->expected = expected;
    s->calls = 0;
    s->latest = 0.0;
}

/* ------------------------------------------------------------------ the start */

/* Numbers whose motion the model does not have: no orbit, or one that goes round the other way. */
static int strangers(const fit_problem *p)
{
    int count = 0;
    for (int i = 0; i < p->count; ++i) {
        const fit_number *n = &p->numbers[i];
        const fit_value *v = &p->values[n->row];
        count += v->origin == FIT_NOTHING || (n->what == FST_MEASURED_BEAD_FREQUENCY &&
                                              n->value * v->value[FST_MEASURED_BEAD_FREQUENCY] < 0.0);
    }
    return count;
}

static double robust_sum(const fit_problem *p)
{
    double sum = 0.0;
    for (int i = 0; i < p->count; ++i)
        sum += log1p(pow(fit_plain_residual(p, i), 2.0));
    return sum;
}

/* A table may give frequencies of beads without their sign.  Where all of them go round with the magnet, and
 * the model's orbits all go round against it, it is taken so, and said. */
static fst_status mind_signs(fit_problem *p, fst_fit *fit, fst_error *error)
{
    double u[FIT_MOST] = {0.0};
    int against = 0, numbers = 0;
    double *residuals = calloc((size_t)fit_residual_count(p), sizeof *residuals);
    fst_status status = residuals ? fit_residuals(p, u, residuals, error)
                                  : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    free(residuals);
    for (int i = 0; i < p->count && status == FST_OK; ++i) {
        const fit_number *n = &p->numbers[i];
        const fit_value *v = &p->values[n->row];
        const double drive = p->rows.rows[n->row].frequency;
        if (n->what != FST_MEASURED_BEAD_FREQUENCY)
            continue;
        if (n->value * drive <= 0.0 || (v->origin == FIT_ORBIT && v->value[n->what] * drive > 0.0))
            return FST_OK;
        numbers += 1;
        against += v->origin == FIT_ORBIT;
    }
    if (status != FST_OK || numbers == 0 || 2 * against < numbers)
        return status;
    for (int i = 0; i < p->count; ++i)
        if (p->numbers[i].what == FST_MEASURED_BEAD_FREQUENCY)
            p->numbers[i].value = -p->numbers[i].value;
    return fit_remark(
        fit, error,
        "every bead_frequency has the sign of the magnet's, but the model's bead goes round against the "
        "magnet: they were taken as given without a sign, and so as opposite to it");
}

/* Where the scene's parameters have not the motion that was measured, look for a start around them. */
fst_status fit_find_start(fit_problem *p, double *u, fst_error *error)
{
    static const double steps[] = {-0.25, 0.25, -0.5, 0.5, -1.0, 1.0};
    const int m = fit_residual_count(p);
    double *f = calloc((size_t)m, sizeof *f), from[FIT_MOST] = {0.0};
    fst_status status =
        f ? fit_residuals(p, u, f, error) : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    int least = status == FST_OK ? strangers(p) : 0;
    double sum = status == FST_OK ? robust_sum(p) : 0.0;
    const int tries = least ? p->space.count * (int)(sizeof steps / sizeof *steps) : 0;
    for (int i = 0; i < tries && status == FST_OK && least > 0; ++i) {
        double trial[FIT_MOST];
        memcpy(trial, from, sizeof trial);
        trial[i % p->space.count] += steps[i / p->space.count];
        status = fit_residuals(p, trial, f, error);
        if (status != FST_OK)
            break;
        const int there = strangers(p);
        if (there < least || (there == least && robust_sum(p) < sum)) {
            least = there;
            sum = robust_sum(p);
            memcpy(u, trial, sizeof trial);
        }
    }
    if (status == FST_OK)
        status = fit_residuals(p, u, f, error);
    if (status == FST_OK && strangers(p) == p->count)
        status = fst_fail(
            error, FST_NO_CONVERGENCE, "fst_fit",
            "with these parameters, and with others around them, the model has no motion like the "
            "measured one at any frequency of the table. Begin with other values in the scene, or with "
            "another start.* from which a bead goes round");
    free(f);
    return status;
}

/* ------------------------------------------------------------------ the search */

/* Search from other places too, where what was found does not fit. */
static fst_status search_around(fit_problem *p, double *u, double *chi2, fst_error *error)
{
    double centre[FIT_MOST];
    memcpy(centre, u, sizeof centre);
    for (int i = 0; i < 2 * p->space.count; ++i) {
        double trial[FIT_MOST], other;
        memcpy(trial, centre, sizeof trial);
        trial[i / 2] += i % 2 ? 0.4 : -0.4;
        const fst_status status = fit_solve(p, trial, &other, error);
        if (status != FST_OK)
            return status;
        if (other < *chi2) {
            *chi2 = other;
            memcpy(u, trial, sizeof trial);
        }
    }
    return FST_OK;
}

static fst_status check_distinct(fit_problem *p, const double *u, fst_error *error)
{
    fit_estimate e;
    fst_status status = fit_estimate_make(p, u, &e, error);
    if (status == FST_OK)
        status = fit_estimate_check(p, &e, error);
    fit_estimate_free(&e);
    return status;
}

fst_status fit_search_all(fit_problem *p, double *u, double *chi2, int *too_many, fst_error *error)
{
    fst_status status = fit_find_start(p, u, error);
    if (status == FST_OK && strangers(p) == 0) /* what cannot be found need not be sought */
        status = check_distinct(p, u, error);
    if (status == FST_OK)
        status = fit_solve(p, u, chi2, error);
    if (status == FST_OK)
        status = fit_take_frequency_slopes(p, error);
    if (status == FST_OK)
        status = fit_solve(p, u, chi2, error);
    if (status == FST_OK)
        status = fit_reject(p, u, chi2, too_many, error);
    const int dof = fit_used(p) - fit_unheld(p);
    if (status == FST_OK && *chi2 > 25.0 * (dof > 0 ? dof : 1)) {
        for (int i = 0; i < p->count; ++i)
            p->numbers[i].weight = 1.0;
        status = search_around(p, u, chi2, error);
        if (status == FST_OK)
            status = fit_reject(p, u, chi2, too_many, error);
    }
    return status;
}

/* ------------------------------------------------------------------ the report */

static fst_status say_interval(fst_fit *fit, const fst_fit_parameter *p, fst_error *error)
{
    const int low = isnan(p->interval[0]), high = isnan(p->interval[1]);
    if (isnan(p->error))
        return fit_remark(
            fit, error,
            "%s: the table hardly says more than its order of magnitude, so no standard deviation is given",
            p->key);
    if (!low && !high)
        return FST_OK;
    return fit_remark(
        fit, error,
        "%s: its interval has no %s end: chi^2 does not rise enough before the parameter's range ends or the "
        "motion becomes another one",
        p->key,
        low && high ? "lower or upper"
        : low       ? "lower"
                    : "upper");
}

double fit_own_value(const fit_problem *p, const fit_estimate *e, int i)
{
    double c[FIT_MOST], q = 0.0;
    fit_space_own(&p->space, i, c);
    for (int k = 0; k < p->space.count; ++k)
        q += c[k] * e->u[k];
    return q;
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

/* Value, error, interval of a parameter; *better where the minimum turned out to be none. */
static fst_status report_parameter(fit_problem *p, const fit_estimate *e, int i, fst_fit *fit, int *better,
                                   double u_better[FIT_MOST], fst_error *error)
{
    const fit_key *key = &p->space.keys[i];
    fst_fit_parameter *out = &fit->parameters[i];
    const double q = fit_own_value(p, e, i);
    fit_report_value(p, e, i, fit->error_scale * fit_deviation(p, e, i), out);
    const double rise = fit->error_scale * fit->error_scale;
    for (int side = -1; side <= 1; side += 2) {
        double end;
        const fst_status status = fit_profile(p, e, i, side, rise, &end, better, u_better, error);
        if (status != FST_OK)
            return status;
        const double at = fit_space_at(&p->space, i, q + end);
        out->interval[side > 0] = at >= key->info->least && at <= key->info->greatest ? at : NAN;
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
    for (int i = 0; i < p->space.count; ++i) {
        const fst_status status = say_interval(fit, &fit->parameters[i], error);
        if (status != FST_OK)
            return status;
        for (int j = 0; j < p->space.count; ++j)
            fit->correlation[i][j] = fit_correlation(p, e, i, j);
    }
    return FST_OK;
}

/* kappa gamma^2, by the change of its logarithm along each coordinate. */
void fit_report_kappa_gamma2(const fit_problem *p, const fit_estimate *e, fst_fit *fit)
{
    const double step = 1e-6;
    double slope[FIT_MOST] = {0.0};
    fit->kappa_gamma2 = fit_kappa_gamma2(&fit->params);
    for (int k = 0; k < p->space.count; ++k) {
        double u[FIT_MOST];
        fst_params moved;
        memcpy(u, e->u, sizeof u);
        u[k] += step;
        (void)fit_space_params(&p->space, u, &moved);
        slope[k] = log(fit_kappa_gamma2(&moved) / fit->kappa_gamma2) / step;
    }
    fit->kappa_gamma2_error =
        fit->kappa_gamma2 * fit->error_scale * sqrt(fit_product(&e->covariance, slope, slope));
}

static fst_status report_numbers(fit_problem *p, const fit_estimate *e, const fst_points *points, fst_fit *fit,
                                 fst_error *error)
{
    fit->numbers = calloc((size_t)p->count, sizeof *fit->numbers);
    fit->outliers = calloc((size_t)p->count, sizeof *fit->outliers);
    if (!fit->numbers || !fit->outliers)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    double *f = calloc((size_t)fit_residual_count(p), sizeof *f);
    const fst_status status =
        f ? fit_residuals(p, e->u, f, error) : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    free(f);
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
    fit->aicc = fit_aicc(e->chi2, fit->points, k);
    if (too_many &&
        fit_remark(fit, error,
                   "more than a quarter of the numbers lie far off the model: none was left out as an outlier, "
                   "for it is the model, its friction law or the errors of the table that do not fit") !=
            FST_OK)
        return FST_NO_MEMORY;
    if (fit->error_scale > 1.0 &&
        fit_remark(fit, error,
                   "chi^2/dof = %.3g is too great for chance: the errors of the table are too "
                   "small or the model is not quite right; all errors were multiplied by %.3g",
                   e->chi2 / dof, fit->error_scale) != FST_OK)
        return FST_NO_MEMORY;
    if (fit->dof <= 0 &&
        fit_remark(fit, error,
                   "there are as many parameters as numbers: nothing shows whether the model fits") != FST_OK)
        return FST_NO_MEMORY;
    return FST_OK;
}

double fit_aicc(double chi2, int points, int parameters)
{
    const int rest = points - parameters - 1;
    return rest > 0 ? chi2 + 2.0 * parameters + 2.0 * parameters * (parameters + 1.0) / rest : NAN;
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
    fit_report_kappa_gamma2(p, e, fit);
    status = report_numbers(p, e, points, fit, error);
    fit_stage_begin(stage, "curves", 0.6, 0.7, 4.0);
    if (status == FST_OK)
        status = fit_weakest(p, e, fit->error_scale, fit->weakest, sizeof fit->weakest, error);
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
    const fst_progress progress = {&stage, tell_stage};
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
        status = mind_signs(&p, fit, error);
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
