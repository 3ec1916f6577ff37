/* track.c - parameters from one good film: the places of the bead, frame by frame, against the model's
 * path.
 *
 * What a table says of a film in three numbers, the track says in hundreds of places.
 *
 *      track --> measure --> three numbers --> a fit of a table --> start
 *        |                                                            |
 *        '--> first 15 %, 40 %, all of the frames: <------------------'   phases that drift apart are caught early
 *             least squares of places (film.c), then of the slip too (film_slip.c)
 *
 * The noise of the places is taken from what is left over; where that is not white (neighbouring frames err
 * alike), all errors grow accordingly.
 */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/order.h"
#include "base/watch.h"
#include "fit/film.h"
#include "fit/film_slip.h"

#define NOISE 1e-4       /* m, of a place, as long as it is not measured */
#define FAR_OFF 4.0      /* scatters from frame to frame, by which places lie off a path that is not theirs */
#define WITH_MAGNET 1e-3 /* rates that differ by less, over the drive, are one */
enum { WINDOWS = 3 };

/* Where the parts of the work end: measuring the track, fitting the three numbers of the film. */
static const double MEASURED = 0.05, ROUGHLY_FITTED = 0.3;

/* How many rounds the search takes is not known: the reported share of the work approaches 1. */
static fst_status tell_rounds(void *user, double fraction, const char *what, fst_error *error)
{
    const fit_film *f = user;
    (void)fraction;
    (void)what;
    const double done = f->rounds / (f->rounds + 30.0);
    return fst_tell(f->outer, ROUGHLY_FITTED + (1.0 - ROUGHLY_FITTED) * done, "search", error);
}

/* ------------------------------------------------------------------ the start */

/* The angle of the magnet, the place on the orbit and the centre with which the first frames agree best. */
static fst_status find_phases(fit_film *f, fst_error *error)
{
    enum { PHASES = 96 };
    const double v[FIT_MOST + FIT_NUISANCES] = {0.0};
    fit_path path;
    double least = INFINITY;
    fst_status status = fit_film_path(f, v, &path, error);
    for (int k = 0; k < PHASES && status == FST_OK; ++k) {
        double complex mean_z = 0, mean_w = 0, product = 0;
        double square = 0;
        for (int i = 0; i < f->used && status == FST_OK; ++i) {
            const double complex seen = fit_film_on_plate(f->tilt, f->z[i]),
                                 z = f->sense > 0 ? seen : conj(seen);
            const double complex w =
                fit_path_at(&path, FIT_PATH_PLACE, 0.0, (double)k / PHASES, f->exposure[0], f->t[i]);
            mean_z += z / f->used;
            mean_w += w / f->used;
            product += z * conj(w);
            square += creal(z * conj(z)) + creal(w * conj(w));
            status = fit_film_ask(f, i, error);
        }
        product -= f->used * mean_z * conj(mean_w);
        square -= f->used * creal(mean_z * conj(mean_z) + mean_w * conj(mean_w));
        const double left = square - 2.0 * cabs(product);
        if (left < least) {
            const double complex centre = mean_z - cexp(I * carg(product)) * mean_w;
            least = left;
            f->turn = carg(product);
            f->phase = (double)k / PHASES;
            f->centre = f->sense > 0 ? centre : conj(centre);
        }
    }
    return status;
}

/* ------------------------------------------------------------------ the search */

/* Frames that lie far off, as the median knows it, are left out; returns how many. */
static int reject_frames(fit_film *f, const double *r)
{
    double *size = calloc((size_t)f->frames, sizeof *size);
    int rejected = 0;
    for (int i = 0; i < f->frames && size; ++i)
        size[i] = hypot(r[2 * i], r[2 * i + 1]);
    double *sorted = size ? malloc((size_t)f->frames * sizeof *sorted) : NULL;
    if (sorted) {
        memcpy(sorted, size, (size_t)f->frames * sizeof *sorted);
        /* 1.1774 is the median of a Rayleigh distribution. */
        const double limit = 6.0 * fst_median(sorted, (size_t)f->frames) / 1.1774;
        for (int i = 0; i < f->frames; ++i)
            if (size[i] > limit) {
                f->weight[i] = 0.0;
                ++rejected;
            }
    }
    free(sorted);
    free(size);
    return rejected;
}

/* How places scatter from frame to frame, by fourth differences, of which no smooth path is left; m. */
static double jitter_of(const fit_film *f)
{
    double *sizes = malloc((size_t)f->frames * sizeof *sizes);
    size_t count = 0;
    for (int i = 4; i < f->frames && sizes; ++i) {
        const double complex *z = f->z + i;
        if (f->t[i] - f->t[i - 4] < 4.5 * (f->t[f->frames - 1] - f->t[0]) / (f->frames - 1)) /* no gap */
            sizes[count++] = cabs(z[0] - 4.0 * z[-1] + 6.0 * z[-2] - 4.0 * z[-3] + z[-4]);
    }
    const double middle = count > 16 ? fst_median(sizes, count) : NAN;
    free(sizes);
    return middle / (1.1774 * sqrt(70.0)); /* the median of a Rayleigh distribution; the binomials' squares */
}

/* Where places lie half as far from the path that was found as they do from its middle, or farther, the motion is another
 * one, of which errors would say nothing: one the other way round is no nearer than a point. */
static fst_status check_path(const fit_film *f, const double *r, fst_error *error)
{
    double off = 0.0, size = 0.0;
    for (int i = 0; i < f->used; ++i)
        if (f->weight[i] > 0.0) {
            off += pow(f->noise * hypot(r[2 * i], r[2 * i + 1]), 2.0);
            size += pow(cabs(f->z[i]), 2.0);
        }
    if (off < 0.25 * size)
        return FST_OK;
    return fst_fail(
        error, FST_NO_CONVERGENCE, "fst_fit",
        "the model has no path like the film's: the nearest that was found is %.2g times as far from the "
        "places as the middle of the film is. Look at the drive, the frames a second and the scale, or begin "
        "with other values in the scene",
        sqrt(off / size));
}

/* The same where it is known why: the bead goes round another way than its festoons tell. */
static fst_status blame_sense(const fit_film *f, fst_error *error)
{
    return fst_fail(
        error, FST_BAD_INPUT, "fst_fit_options.drive",
        "the model has no path like the film's, and the festoons say that the bead goes round %s the magnet, "
        "which contradicts the sense in the film: it is mirrored, or the drive has the other sign; try %.6g Hz",
        f->contrary < 0 ? "against" : "with", -f->sense * f->drive);
}

/* Windows that grow, from the unknowns v; *left: by how much places then lie off the path, in units of the noise. */
static fst_status grow(fit_film *f, const double *windows, double *v, double *left, fst_error *error)
{
    const double whole = f->t[f->frames - 1] - f->t[0];
    double squares = 0.0;
    f->used = f->frames;
    double *r = calloc((size_t)fit_film_residual_count(f), sizeof *r);
    fst_status status = r ? FST_OK : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    for (int w = 0; w < WINDOWS && status == FST_OK; ++w) {
        for (f->used = 0; f->used < f->frames && f->t[f->used] - f->t[0] <= windows[w] * whole;)
            f->used += 1;
        if (w == 0)
            status = find_phases(f, error);
        if (status == FST_OK)
            status = fit_film_solve(f, v, NULL, error);
        if (status == FST_OK)
            status = fit_film_residuals(f, v, r, error);
        if (status == FST_OK && f->contrary != 0) /* then it will hardly become nearer */
            status = check_path(f, r, error);
    }
    for (int i = 0; i < 2 * f->used && r; ++i)
        squares += r[i] * r[i];
    *left = sqrt(squares / (2.0 * f->used));
    free(r);
    return status;
}

/* From a first window that was too short, or too long, the growth may follow a path that is not the film's, which places
 * far off betray: then other windows are tried, and the nearer path is kept. */
static fst_status find_path(fit_film *f, double *v, fst_error *error)
{
    static const double windows[][WINDOWS] = {{0.15, 0.4, 1.0}, {0.25, 0.5, 1.0}, {0.08, 0.3, 1.0}};
    const double enough = FAR_OFF * jitter_of(f) / f->noise;
    const size_t size = (size_t)fit_film_unknowns(f) * sizeof *v;
    double least = INFINITY, start[FIT_MOST + FIT_NUISANCES], tried[FIT_MOST + FIT_NUISANCES];
    double turn = 0.0, phase = 0.0;
    double complex centre = 0.0;
    memcpy(start, v, size);
    fst_status status = FST_OK;
    for (size_t way = 0; way < sizeof windows / sizeof *windows && status == FST_OK && !(least <= enough);
         ++way) {
        double left = INFINITY;
        memcpy(tried, start, size);
        status = grow(f, windows[way], tried, &left, error);
        if (status == FST_OK && !(left >= least)) {
            least = left;
            turn = f->turn;
            phase = f->phase;
            centre = f->centre;
            memcpy(v, tried, size);
        }
    }
    f->turn = turn;
    f->phase = phase;
    f->centre = centre;
    return status;
}

/* The path, then once more without the frames that lie far off. */
static fst_status search(fit_film *f, double *v, int *rejected, fst_error *error)
{
    fst_status status = find_path(f, v, error);
    double *r = calloc((size_t)fit_film_residual_count(f), sizeof *r);
    if (!r)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    if (status == FST_OK)
        status = fit_film_residuals(f, v, r, error);
    *rejected = status == FST_OK ? reject_frames(f, r) : 0;
    if (status == FST_OK && *rejected > 0)
        status = fit_film_solve(f, v, r, error);
    if (status == FST_OK)
        status = check_path(f, r, error);
    free(r);
    return status == FST_NO_CONVERGENCE && f->contrary != 0 ? blame_sense(f, error) : status;
}

/* ------------------------------------------------------------------ the report */

/* The covariance of the parameters' coordinates among all unknowns, scaled by what is left over. */
static fst_status estimate(fit_film *f, const double *v, fit_estimate *e, double *left, double *scatter,
                           fst_error *error)
{
    const int m = fit_film_residual_count(f), n = fit_film_unknowns(f);
    fit_matrix covariance;
    double *jacobian = calloc((size_t)m * (size_t)(n + 1), sizeof *jacobian),
           *r = jacobian + (size_t)m * (size_t)n;
    fst_status status = jacobian ? fit_film_residuals(f, v, r, error)
                                 : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    if (status == FST_OK)
        status = fit_film_derivatives(f, v, jacobian, error);
    int kept = 0;
    double sum = 0.0;
    for (int i = 0; i < f->used && status == FST_OK; ++i) {
        kept += f->weight[i] > 0.0;
        sum += r[2 * i] * r[2 * i] + r[2 * i + 1] * r[2 * i + 1];
    }
    const double variance = sum / fmax(2.0 * kept - n, 1.0);
    *scatter = status == FST_OK ? sqrt(variance * fit_film_redness(r, f->used)) : NAN;
    for (int i = 0; i < 2 * f->used && status == FST_OK; ++i)
        for (int k = 0; k < n; ++k)
            jacobian[i + m * k] /= *scatter;
    if (status == FST_OK && !fit_covariance(jacobian, m, n, &covariance))
        status = fst_fail(error, FST_BAD_INPUT, "fst_fit",
                          "the track cannot tell the parameters that are sought apart: seek fewer, or give "
                          "what is known otherwise");
    if (status == FST_OK) {
        const int k = f->space.count + f->slot[FIT_DRIVE];
        double off[FIT_MOST];
        memcpy(off, v, (size_t)n * sizeof *v);
        off[k] += sqrt(covariance.a[k][k]);
        f->found_drive = f->sense * fit_film_nuisance(f, v, FIT_DRIVE);
        f->drive_error = fit_film_nuisance(f, off, FIT_DRIVE) - fit_film_nuisance(f, v, FIT_DRIVE);
        covariance.size = f->space.count;
        e->covariance = covariance;
        memcpy(e->u, v, (size_t)f->space.count * sizeof *v);
    }
    *left = f->noise * sqrt(variance);
    free(jacobian);
    return status;
}

/* What a person should doubt: what measure said of the track, and places that are farther from the path than their noise. */
static fst_status doubt(const fit_film *f, const fst_measurement *seen, double left, fst_fit *fit,
                        fst_error *error)
{
    fst_status status = FST_OK;
    const double jitter = jitter_of(f);
    for (int i = 0; i < seen->warning_count && status == FST_OK; ++i)
        status = fit_remark(fit, error, "%s", seen->warnings[i]);
    if (status == FST_OK && left > FAR_OFF * jitter)
        status = fit_remark(fit, error,
                            "places lie %.3g times as far from the model's path as they scatter from frame to "
                            "frame: the path is "
                            "another one, and the errors do not tell by how much the parameters are wrong; "
                            "look at the scale, the "
                            "drive, the exposure and the friction law",
                            left / jitter);
    return status;
}

static fst_status report(fit_film *f, const fit_estimate *e, double left, int rejected, fst_fit *fit,
                         fst_error *error)
{
    fit_problem p;
    memset(&p, 0, sizeof p);
    p.space = f->space;
    fit->count = f->space.count;
    fit->free_count = f->space.free_count;
    fit->error_scale = fit->widened = 1.0;
    fit->points = 2 * (f->frames - rejected);
    fit->dof = fit->points - fit->free_count;
    fit->chi2 = fit->points - f->space.count - f->nuisances; /* the noise is measured by it */
    fit->aicc = NAN;
    fit->drive = f->found_drive;
    fit->drive_error = f->drive_error;
    (void)fit_space_params(&f->space, e->u, &fit->params);
    for (int i = 0; i < fit->count; ++i) {
        const double deviation = fit_deviation(&p, e, i);
        fit_report_value(&p, e, i, deviation, &fit->parameters[i]);
        for (int side = 0; side < 2; ++side)
            fit->parameters[i].interval[side] =
                fit_space_at(&f->space, i, fit_own_value(&p, e, i) + (side ? deviation : -deviation));
        for (int j = 0; j < fit->count; ++j)
            fit->correlation[i][j] = fit_correlation(&p, e, i, j);
    }
    fst_status status = fit_report_kappa_gamma2(&p, e, fit, error);
    if (status == FST_OK)
        status = fit_weakest(&p, e, 0, fit, error);
    return status != FST_OK ? status
                            : fit_remark(fit, error,
                                         "%d frames, %d of them left out; places scatter by %.3g mm about the "
                                         "path (this scatter, with what neighbouring frames have in common, "
                                         "makes the errors; the intervals are those of the parabola)",
                                         f->frames, rejected, 1e3 * left);
}

/* The frequency of the drive, the scene's or the film's own, and parameters to begin with. */
static fst_status begin(fit_film *f, const fst_params *params, const fst_measurement *seen,
                        const fst_fit_options *options, fst_error *error)
{
    fst_params start = *params;
    fst_fit_options roughly = *options;
    fst_point row;
    const double drive = isfinite(options->drive) ? options->drive : seen->drive_from_track_hz;
    if (!isfinite(drive))
        return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.drive",
                        "the track does not tell how the magnet turned: say it");
    fst_status status = fst_point_of(seen, drive, &row, error); /* the film as a table of one row */
    if (status != FST_OK)
        return status;
    row.frequency = drive;
    row.frequency_error = NAN;
    row.line = 1;
    const fst_points points = {.rows = &row, .count = 1};
    fst_part part = {options->progress, MEASURED, ROUGHLY_FITTED, NULL};
    const fst_progress progress = {&part, fst_part_tell};
    roughly.progress = &progress;
    status = fit_seek(params, &points, &roughly, &start, error);
    if (status == FST_INTERRUPTED || status == FST_UNAVAILABLE || status == FST_NO_MEMORY)
        return status;
    f->drive = fabs(drive);
    f->sense = drive < 0 ? -1.0 : 1.0;
    if (seen->bead_frequency_hz * seen->filmed_sense * f->sense < 0.0)
        f->contrary = seen->bead_frequency_hz < 0.0 ? -1 : 1;
    f->exposure[0] = isfinite(options->exposure) ? options->exposure : 0.0;
    f->exposure[1] = options->exposure_error;
    for (int k = 0; k < FIT_NUISANCES; ++k) {
        const int held = (k == FIT_EXPOSURE && !(f->exposure[1] > 0.0)) ||
                         (k == FIT_SCALE && !(f->scale_error > 0.0)) ||
                         ((k == FIT_TILT_X || k == FIT_TILT_Y) && f->tilt == 0.0) ||
                         k == FIT_RADIUS; /* nothing depends on it before the slip is fitted */
        f->slot[k] = held ? -1 : f->nuisances++;
    }
    f->outer = options->progress;
    f->progress = (fst_progress){f, tell_rounds};
    status = fit_space_begin(&f->space, &start, options, error);
    if (status == FST_OK && fit_film_unknowns(f) > FIT_MOST)
        status = fst_fail(error, FST_BAD_INPUT, "fst_fit_options.free", "there are more than %d parameters",
                          FIT_MOST - f->nuisances);
    return status;
}

/* Say why there is no orbit, if the bead of the film goes round with the magnet. */
static fst_status tell_of_lock(const fst_measurement *seen, const fst_fit_options *options, fst_error *error)
{
    const double drive = isfinite(options->drive) ? options->drive : seen->drive_from_track_hz;
    if (!(fabs(seen->bead_frequency_hz - drive) < WITH_MAGNET * fabs(drive)))
        return FST_NO_CONVERGENCE;
    return fst_fail(
        error, FST_NO_CONVERGENCE, "fst_track",
        "in this film the bead is locked to the magnet (%.6g Hz), and a bead that stands still on the magnet's "
        "axes has no orbit to fit: film it at a faster drive, where it swings about the magnet or circles at "
        "another rate",
        drive);
}

fst_status fst_fit_track(const fst_params *params, fst_track *track, const fst_fit_options *options,
                         fst_fit *fit, fst_error *error)
{
    fit_film f;
    fit_estimate e;
    fst_measurement seen;
    fst_measure_options how = fst_default_measure_options();
    double v[FIT_MOST + FIT_NUISANCES] = {0.0}, left = NAN, scatter = NAN;
    int rejected = 0;
    memset(&f, 0, sizeof f);
    memset(&e, 0, sizeof e);
    memset(&seen, 0, sizeof seen);
    seen.bead_frequency_hz = NAN;
    f.noise = NOISE;
    f.slip_scale = 1.0;
    memset(fit, 0, sizeof *fit);
    fit->params = *params;
    fit->drive_given = options->drive;
    fst_part part = {options->progress, 0.0, MEASURED, "measure"};
    const fst_progress progress = {&part, fst_part_tell};
    how.drive = options->drive;
    how.progress = &progress;
    fst_status status = fit_remark(fit, error, "%s", "");
    if (status == FST_OK)
        status = fst_minpack_load(&f.minpack, error);
    if (status == FST_OK)
        status = fst_measure_track(track, &how, &seen, error);
    if (status == FST_OK)
        status = fit_film_take(&f, track, &seen, error);
    if (status == FST_OK)
        status = begin(&f, params, &seen, options, error);
    if (status == FST_OK && f.frames < 4 * fit_film_unknowns(&f))
        status =
            fst_fail(error, FST_BAD_INPUT, "fst_track", "it has %d places of the bead, too few for %d unknowns",
                     f.frames, fit_film_unknowns(&f));
    if (status == FST_OK)
        status = search(&f, v, &rejected, error);
    if (status == FST_OK)
        status = estimate(&f, v, &e, &left, &scatter, error);
    if (status == FST_OK)
        status = fit_slip_join(&f, v, scatter, error);
    if (status == FST_OK && f.slips > 0)
        status = estimate(&f, v, &e, &left, &scatter, error);
    if (status == FST_OK)
        status = report(&f, &e, left, rejected, fit, error);
    if (status == FST_OK)
        status = fit_slip_report(&f, v, fit, error);
    if (status == FST_OK)
        status = doubt(&f, &seen, left, fit, error);
    if (status == FST_NO_CONVERGENCE)
        status = tell_of_lock(&seen, options, error);
    fit_film_free(&f);
    if (status != FST_OK)
        fst_fit_free(fit);
    return status;
}
