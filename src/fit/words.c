/* words.c - what a fit knows least, in words, and which measurement would help most.
 *
 * The weakest direction is the one along which parameters can change together the farthest, in per cent, before
 * chi^2 has risen by 1.  Which measurement would shorten it is asked of the model: one more number at each of
 * some frequencies, measured as well as those of the table, with the derivatives that the model has there.
 */
#include "fit/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/units.h"
#include "fit/curve.h"

enum { CANDIDATES = 9 };

/* The weakest direction as a step of the coordinates that raises chi^2 by 1, and the same in own coordinates.
 */
static void find_direction(const fit_problem *p, const fit_estimate *e, double u[FIT_MOST], double q[FIT_MOST])
{
    const int n = p->space.count;
    fit_matrix own = {.size = n}, vectors;
    double values[FIT_MOST], c[FIT_MOST][FIT_MOST];
    for (int i = 0; i < n; ++i)
        fit_space_own(&p->space, i, c[i]);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            own.a[i][j] = fit_product(&e->covariance, c[i], c[j]);
    fit_eigen(&own, values, &vectors);
    for (int i = 0; i < n; ++i)
        q[i] = sqrt(fmax(values[n - 1], 0.0)) * vectors.a[i][n - 1];
    /* q = C u with C the identity but for kappa's row. */
    memcpy(u, q, (size_t)n * sizeof *u);
    if (p->space.kappa >= 0)
        u[p->space.kappa] = q[p->space.kappa] + 2.0 * q[p->space.gamma];
}

static double greatest_of(const double *q, int count)
{
    double greatest = 0.0;
    for (int i = 0; i < count; ++i)
        greatest = fmax(greatest, fabs(q[i]));
    return greatest;
}

/* "friction.gamma up by 9 % with model.kappa down by 17 %" */
static void say_direction(const fit_problem *p, const double *q, double scale, char *text, size_t size)
{
    const double greatest = greatest_of(q, p->space.count);
    int first = 1;
    text[0] = '\0';
    for (int i = 0; i < p->space.count; ++i) {
        const fit_key *key = &p->space.keys[i];
        const size_t used = strlen(text);
        if (fabs(q[i]) < 0.03 * greatest)
            continue;
        char change[64];
        if (key->scale == 0.0)
            (void)snprintf(change, sizeof change, "%.2g %%", 100.0 * scale * fabs(q[i]));
        else
            (void)snprintf(change, sizeof change, "%.2g", scale * fabs(q[i]) * key->scale);
        (void)snprintf(text + used, size - used, "%s%s %s by %s", first ? "" : " with ", key->info->key,
                       q[i] > 0 ? "up" : "down", change);
        first = 0;
    }
}

/* The middle of the errors of a quantity in the table; NAN: it is not there. */
static double usual_error(const fit_problem *p, fst_measured what)
{
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < p->count; ++i)
        if (p->numbers[i].what == what && p->numbers[i].weight > 0.0) {
            sum += log(p->numbers[i].error);
            ++count;
        }
    return count ? exp(sum / count) : NAN;
}

/* The number that would tell most about a direction. */
typedef struct candidate {
    double gain, frequency, error; /* chi^2 that the number would add along the direction */
    fst_measured what;
} candidate;

static fst_status find_candidate(const fit_problem *p, const fit_estimate *e, const double *u, candidate *best,
                                 fst_error *error)
{
    double from, to;
    fit_curve curve;
    fit_frequency_range(p, 0.25, &from, &to);
    const fst_status status = fit_curve_make(p, e, 1.0, from, to, CANDIDATES, &curve, error);
    for (int i = 0; i < CANDIDATES && status == FST_OK; ++i)
        for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
            double change = 0.0, known = usual_error(p, (fst_measured)q);
            for (int k = 0; k < p->space.count; ++k)
                change += curve.slopes[i * p->space.count + k][q] * u[k];
            const double gain = change * change / (known * known);
            if (gain > best->gain && isfinite(curve.points[i].value[q]))
                *best = (candidate){gain, curve.points[i].frequency, known, (fst_measured)q};
        }
    if (status == FST_OK)
        fit_curve_free(&curve);
    return status;
}

static void say_candidate(const candidate *best, char *text, size_t size)
{
    char error[64];
    int power;
    const char *unit = fst_unit_customary(fst_measured_unit(best->what), &power);
    (void)snprintf(error, sizeof error, "%.2g %s", pow(10.0, power) * best->error, unit);
    const double left = 100.0 / sqrt(1.0 + best->gain);
    (void)snprintf(text, size,
                   " Of numbers like those of the table, %s near %.3g Hz (to %s) would help most: it would "
                   "leave %.0f %% of this uncertainty%s.",
                   fst_measured_name(best->what), best->frequency, error, left,
                   left > 80 ? ", so that a measurement of another kind is needed" : "");
}

/* What other experiments would tell. */
static void say_other(const fit_problem *p, const double *q, char *text, size_t size)
{
    const double greatest = greatest_of(q, p->space.count);
    int friction = 0;
    const char *geometry = NULL;
    for (int i = 0; i < p->space.count; ++i) {
        const char *key = p->space.keys[i].info->key;
        if (fabs(q[i]) < 0.2 * greatest)
            continue;
        friction |= strncmp(key, "friction.", 9) == 0 || strcmp(key, "model.kappa") == 0;
        if (strncmp(key, "magnet.", 7) == 0 || strncmp(key, "bead.", 5) == 0)
            geometry = key;
    }
    (void)snprintf(text, size, "%s%s%s%s",
                   friction
                       ? " What breaks it: the locking frequency, up to which the bead follows the magnet, and "
                         "how quickly the swings after a knock decay, measure friction in other ways."
                       : "",
                   geometry ? " " : "", geometry ? geometry : "",
                   geometry ? " can be measured by other means and be given with its error." : "");
}

fst_status fit_weakest(const fit_problem *p, const fit_estimate *e, int helpers, fst_fit *fit, fst_error *error)
{
    double u[FIT_MOST] = {0.0}, q[FIT_MOST] = {0.0};
    char direction[400], help[400] = "", other[400];
    candidate best = {0};
    find_direction(p, e, u, q);
    say_direction(p, q, fit->error_scale, direction, sizeof direction);
    const fst_status status = helpers ? find_candidate(p, e, u, &best, error) : FST_OK;
    if (status != FST_OK)
        return status;
    if (best.gain > 0.0)
        say_candidate(&best, help, sizeof help);
    say_other(p, q, other, sizeof other);
    (void)snprintf(fit->weakest, sizeof fit->weakest,
                   "Known least: %s fits nearly as well (one standard deviation).%s%s", direction, help, other);
    return FST_OK;
}
