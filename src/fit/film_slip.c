/* film_slip.c - the measured slip of one film beside its places.
 *
 * Each slip was made of a window of frames, so those of neighbouring frames have errors in common: frames are taken
 * that are farther apart than half a window, whose errors are correlated by -0.12 if rotations err independently.
 * Places and slip are independent witnesses.  If the places fit much worse as soon as the slip is fitted too, then one
 * of them is wrong, or the law is, and the places alone are believed.  If the slip fits worse than its errors allow, it
 * counts less.
 */
#include "fit/film_slip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "fit/outliers.h"

enum { APART = FST_TURNING_WINDOW / 2 + 1, LEAST_FRAMES = 8, ROUNDS = 3 };

static int is_measured(const fit_film *f, int i)
{
    return f->slip_error[i] > 0.0 && isfinite(creal(f->slip[i]) + cimag(f->slip[i]));
}

/* As many frames as are independent: all frames together have 2 J + 1 numbers in J harmonics. */
static void choose(fit_film *f)
{
    const int rows = f->row[f->frames - 1], most = 2 * f->rhythm + 1;
    const int apart = f->rhythm ? rows / (most > LEAST_FRAMES ? most : LEAST_FRAMES) : 0;
    int next = 0;
    for (int i = 0; i < f->frames; ++i)
        if (f->weight[i] > 0.0 && is_measured(f, i) && f->row[i] >= next) {
            f->slip_at[f->slips++] = i;
            next = f->row[i] + (apart > APART ? apart : APART);
        }
}

static double sum_of_squares(const double *r, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += r[i] * r[i];
    return sum;
}

/* By how much the stated errors of the slip have to be multiplied: where they are too small for what is left, or where what
 * is left is alike from one frame to the next. */
static double widening(const fit_film *f, const double *slips)
{
    const int count = 2 * f->slips;
    const double chi2 = sum_of_squares(slips, count) * f->slip_scale * f->slip_scale,
                 alike = fit_film_redness(slips, f->slips);
    return fmax(fit_error_scale(chi2, count), alike > 1.0 ? sqrt(chi2 / count * alike) : 1.0);
}

/* The minimum of both, r being room for residuals; `rise` is how much more of the places' is left there. */
static fst_status seek(fit_film *f, double *v, double *r, double *rise, fst_error *error)
{
    fst_status status = fit_film_residuals(f, v, r, error);
    const double alone = sum_of_squares(r, 2 * f->used);
    for (int round = 0; round < ROUNDS && status == FST_OK; ++round) {
        status = fit_film_solve(f, v, r, error);
        const double wider = widening(f, r + 2 * f->used);
        if (fabs(wider / f->slip_scale - 1.0) < 0.01)
            break;
        f->slip_scale = wider;
    }
    *rise = sum_of_squares(r, 2 * f->used) - alone;
    return status;
}

fst_status fit_slip_join(fit_film *f, double *v, double scatter, fst_error *error)
{
    const int unknowns = fit_film_unknowns(f);
    const double noise = f->noise;
    double alone[FIT_MOST], rise = 0.0;
    choose(f);
    if (f->slips < LEAST_FRAMES || unknowns == FIT_MOST) {
        f->slips = 0;
        return FST_OK;
    }
    memcpy(alone, v, sizeof alone);
    f->noise = noise * scatter;
    f->slot[FIT_RADIUS] = f->nuisances++;
    v[unknowns] = 0.0;
    double *r = calloc((size_t)fit_film_residual_count(f), sizeof *r);
    const fst_status status =
        r ? seek(f, v, r, &rise, error) : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    free(r);
    if (fit_error_scale(rise, unknowns) > 1.0) {
        memcpy(v, alone, sizeof alone);
        f->noise = noise;
        f->slips = 0;
        f->slot[FIT_RADIUS] = -1;
        --f->nuisances;
    }
    return status;
}

/* How far the model's slip in a frame is from the measured one, m/s. */
static double complex miss(const fit_film *f, const fit_path *path, const double *v, int i)
{
    return fit_film_slip(f, path, v, i) - f->slip[i];
}

fst_status fit_slip_report(fit_film *f, const double *v, fst_fit *fit, fst_error *error)
{
    fit_path path;
    fst_status status = fit_film_path(f, v, &path, error);
    double sum = 0.0, size = 0.0, off = 0.0;
    fit->slip_misfit = fit->slip_chi2 = NAN;
    for (int i = 0; i < f->frames && status == FST_OK; ++i) {
        if (!is_measured(f, i))
            continue;
        const double left = cabs(miss(f, &path, v, i));
        sum += 0.5 * pow(left / f->slip_error[i], 2.0);
        size += pow(cabs(f->slip[i]), 2.0);
        off += left * left;
        fit->slip_frames += 1;
    }
    if (status != FST_OK || fit->slip_frames == 0)
        return status;
    fit->slip_misfit = sqrt(sum / fit->slip_frames);
    fit->slip_fitted = f->slips;
    if (f->slips > 0)
        fit->slip_chi2 = 0.0;
    for (int k = 0; k < f->slips; ++k)
        fit->slip_chi2 += pow(cabs(miss(f, &path, v, f->slip_at[k])) / f->slip_error[f->slip_at[k]], 2.0);
    status = fit_remark(fit, error,
                        "slip, measured in %d frames: the model's is %.3g standard deviations off, %.3g %% of "
                        "it; where another friction law is nearer to 1, take that",
                        fit->slip_frames, fit->slip_misfit, 100.0 * sqrt(off / size));
    if (status != FST_OK)
        return status;
    if (f->slips == 0)
        return fit_remark(fit, error, "%s",
                          fit->slip_frames < LEAST_FRAMES
                              ? "the slip was not fitted: too few frames have it"
                              : "the slip was not fitted, because it contradicts the places; the friction law, "
                                "the scale or the bead's diameter is wrong");
    return fit_remark(fit, error,
                      "the slip was fitted in %d of these frames, far enough apart to err independently: chi^2 "
                      "= %.4g of %d numbers%s",
                      f->slips, fit->slip_chi2, 2 * f->slips,
                      f->slip_scale > 1.0
                          ? "; these are too large for chance, or alike, so that the errors were widened"
                          : "");
}
