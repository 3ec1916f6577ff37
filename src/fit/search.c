/* search.c - the search of a fit: a start, the minimum, outliers; and what the stages share. */
#include "fit/search.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "fit/errors.h"
#include "fit/outliers.h"

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

double fit_aicc(double chi2, int points, int parameters)
{
    const int rest = points - parameters - 1;
    return rest > 0 ? chi2 + 2.0 * parameters + 2.0 * parameters * (parameters + 1.0) / rest : NAN;
}

/* ------------------------------------------------------------------ progress */

/* How many calls a search takes is not known beforehand: the fraction of a stage approaches its end. */
fst_status fit_stage_tell(void *user, double fraction, const char *what, fst_error *error)
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

/* Whether the model does not have the motion of a number: no orbit, or one that goes round the other way. */
static int is_stranger(const fit_problem *p, const fit_number *n)
{
    const fit_value *v = &p->values[n->row];
    return v->origin == FIT_NOTHING ||
           (n->what == FST_MEASURED_BEAD_FREQUENCY && n->value * v->value[FST_MEASURED_BEAD_FREQUENCY] < 0.0);
}

static int strangers(const fit_problem *p)
{
    int count = 0;
    for (int i = 0; i < p->count; ++i)
        count += is_stranger(p, &p->numbers[i]);
    return count;
}

/* Rows with such a number; the numbers of a row follow each other. */
static int strange_rows(const fit_problem *p)
{
    int count = 0, latest = -1;
    for (int i = 0; i < p->count; ++i)
        if (p->numbers[i].row != latest && is_stranger(p, &p->numbers[i])) {
            latest = p->numbers[i].row;
            ++count;
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
fst_status fit_mind_signs(fit_problem *p, fst_fit *fit, fst_error *error)
{
    double u[FIT_MOST] = {0.0};
    int against = 0, numbers = 0;
    const fst_status status = fit_evaluate(p, u, error);
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
    return fit_remark(fit, error,
                      "every bead_frequency has the sign of the magnet's, but the model's bead goes round "
                      "against the magnet: they were taken as given without a sign, and so as opposite to it");
}

/* Where the scene's parameters have not the motion that was measured, look for a start around them. */
fst_status fit_find_start(fit_problem *p, double *u, fst_error *error)
{
    static const double steps[] = {-0.25, 0.25, -0.5, 0.5, -1.0, 1.0};
    const double from[FIT_MOST] = {0.0};
    fst_status status = fit_evaluate(p, u, error);
    int least = status == FST_OK ? strangers(p) : 0;
    double sum = status == FST_OK ? robust_sum(p) : 0.0;
    const int tries = least ? p->space.count * (int)(sizeof steps / sizeof *steps) : 0;
    for (int i = 0; i < tries && status == FST_OK && least > 0; ++i) {
        double trial[FIT_MOST];
        memcpy(trial, from, sizeof trial);
        trial[i % p->space.count] += steps[i / p->space.count];
        status = fit_evaluate(p, trial, error);
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
        status = fit_evaluate(p, u, error);
    if (status == FST_OK && strange_rows(p) == p->rows.count)
        status =
            fst_fail(error, FST_NO_CONVERGENCE, "fst_fit",
                     "with these parameters, and with others around them, the model has no motion like "
                     "the measured one at any frequency of the table. Are these right? Slow motion of 240 "
                     "frames a second that is stored as 30 makes all of them 8 times too low. Otherwise "
                     "begin with other values in the scene, or with another start.* from which a bead goes "
                     "round");
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

fst_status fit_seek(const fst_params *params, const fst_points *points, const fst_fit_options *options,
                    fst_params *found, fst_error *error)
{
    fit_problem p;
    fst_fit unsaid = {0};
    fit_stage stage = {.outer = options->progress};
    const fst_progress progress = {&stage, fit_stage_tell};
    double u[FIT_MOST] = {0.0}, chi2;
    int too_many;
    fit_stage_begin(&stage, "search", 0.0, 1.0, 15.0);
    fst_status status = fit_problem_begin(&p, params, points, options, &progress, error);
    if (status == FST_OK)
        status = fit_mind_signs(&p, &unsaid, error);
    if (status == FST_OK)
        status = fit_search_all(&p, u, &chi2, &too_many, error);
    if (status == FST_OK)
        (void)fit_space_params(&p.space, u, found);
    fit_problem_free(&p);
    free(unsaid.remarks);
    return status;
}
