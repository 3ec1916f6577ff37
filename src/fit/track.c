/* track.c - parameters from one good film: the places of the bead, frame by frame, against the model's
 * path.
 *
 * What a table says of a film in three numbers, the track says in hundreds of places.  Beside the parameters a
 * few numbers are unknown of which nobody wants to know: the centre of the picture, the angle of the magnet and
 * the place on the orbit at the beginning, the exact frequency of the drive, the camera's tilt where there is
 * one, and, if they are known only roughly, the exposure and the scale.  They are sought together.
 *
 *      track --> measure --> three numbers --> a fit of a table --> start
 *        |                                                            |
 *        '--> first 15 %, 40 %, all of the frames: <------------------'   phases that drift apart are caught early
 *             least squares of places
 *
 * The noise of the places is taken from what is left over; where that is not white (neighbouring frames err
 * alike), all errors grow accordingly.
 */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/order.h"
#include "base/watch.h"
#include "fit/path.h"
#include "fit/report.h"

/* The unknowns behind the parameters. */
enum { DRIVE, CENTRE_X, CENTRE_Y, TURN, PHASE, EXPOSURE, SCALE, TILT_X, TILT_Y, NUISANCES };

/* Lengths of a step of these unknowns; residuals are in units of NOISE. */
static const double unit_of[NUISANCES] = {1e-3, 1e-3, 1e-3, 1.0, 0.1, 1e-3, 1e-2, 1e-2, 1e-2};
#define NOISE 1e-4 /* m */

typedef struct film_fit {
    fit_space space;
    const fst_minpack *minpack;
    const fst_progress *outer; /* the caller's; NULL: nobody is told */
    fst_progress progress;     /* ours, told by all parts of the search */
    double rounds;             /* over all frames so far */
    int frames, used;          /* all; those of the present window */
    double *t;
    double complex *z;
    double *weight;       /* 0: left out */
    double complex *slip; /* as measured, m/s */
    double *slip_error;   /* NAN: it was not */
    double drive, sense, turn, phase;
    double complex centre;
    double exposure[2];             /* and its error; 0: exact */
    double scale_error;             /* relative, of all lengths of the film; 0: none */
    double complex tilt;            /* what it does: z becomes (1 + |tilt|) z + tilt conj(z) on the plate */
    int nuisances, slot[NUISANCES]; /* how many are sought, and which unknown each is; -1: it is held */
    fst_orbit orbit;                /* the latest that was found, its path, and where */
    fit_path path;
    double path_at[FIT_MOST], path_drive; /* 0: none yet */
    double found_drive, drive_error;      /* Hz, as reported */
} film_fit;

/* ------------------------------------------------------------------ progress */

enum { FRAMES_UNASKED = 128 }; /* frames between two questions: some milliseconds */

/* Where the parts of the work end: measuring the track, fitting the three numbers of the film. */
static const double MEASURED = 0.05, ROUGHLY_FITTED = 0.3;

/* How many rounds the search takes is not known: the reported share of the work approaches 1. */
static fst_status tell_rounds(void *user, double fraction, const char *what, fst_error *error)
{
    const film_fit *f = user;
    (void)fraction;
    (void)what;
    const double done = f->rounds / (f->rounds + 30.0);
    return fst_tell(f->outer, ROUGHLY_FITTED + (1.0 - ROUGHLY_FITTED) * done, "search", error);
}

static fst_status ask_at(const film_fit *f, int frame, fst_error *error)
{
    return frame % FRAMES_UNASKED == 0 ? fst_tell(&f->progress, 0.0, NULL, error) : FST_OK;
}

/* ------------------------------------------------------------------ the model's places */

/* The nuisance parameter k at the unknowns. */
static double nuisance(const film_fit *f, const double *v, int k)
{
    const double start[NUISANCES] = {f->drive, creal(f->centre), cimag(f->centre),
                                     f->turn,  f->phase,         f->exposure[0],
                                     0.0,      creal(f->tilt),   cimag(f->tilt)};
    const double step = f->slot[k] >= 0 ? v[f->space.count + f->slot[k]] * unit_of[k] : 0.0;
    return k == DRIVE ? start[k] * (1.0 + step) : start[k] + step;
}

static fst_status find_path(film_fit *f, const double *v, fit_path *path, fst_error *error)
{
    fst_params params;
    fst_orbit orbit;
    fst_status status = FST_NO_CONVERGENCE;
    const double drive = nuisance(f, v, DRIVE);
    const size_t size = (size_t)f->space.count * sizeof *v;
    if (f->path_drive == drive && memcmp(f->path_at, v, size) == 0) {
        *path = f->path;
        return FST_OK;
    }
    (void)fit_space_params(&f->space, v, &params);
    params.drive_frequency = drive;
    params.drive_omega = NAN;
    if (f->orbit.means.period > 0.0)
        status = fst_orbit_near(&params, &f->orbit, 1e-11, &f->progress, &orbit, error);
    if (status != FST_OK && status != FST_INTERRUPTED && status != FST_NO_MEMORY)
        status = fst_orbit_find(&params, &f->progress, &orbit, error);
    if (status == FST_OK)
        status = fit_path_make(&params, &orbit, path, error);
    if (status != FST_OK)
        return status;
    f->orbit = orbit;
    f->path = *path;
    f->path_drive = drive;
    memcpy(f->path_at, v, size);
    return FST_OK;
}

static double complex place(const film_fit *f, const fit_path *path, const double *v, int i)
{
    const double complex z = fit_path_at(path, nuisance(f, v, DRIVE), nuisance(f, v, TURN),
                                         nuisance(f, v, PHASE), nuisance(f, v, EXPOSURE), f->t[i]);
    return (f->sense > 0 ? z : conj(z)) + nuisance(f, v, CENTRE_X) + nuisance(f, v, CENTRE_Y) * I;
}

/* A place of the film on the plate. */
static double complex on_plate(double complex tilt, double complex z)
{
    return (1.0 + cabs(tilt)) * z + tilt * conj(z);
}

/* Residuals: two a frame; then the priors of the parameters, of the exposure and of the scale. */
static int residual_count(const film_fit *f)
{
    return 2 * f->used + f->space.count + 2;
}

static fst_status residuals(film_fit *f, const double *v, double *r, fst_error *error)
{
    fit_path path;
    fst_status status = find_path(f, v, &path, error);
    f->rounds += 1.0;
    if (status != FST_OK)
        return status;
    const double complex tilt = nuisance(f, v, TILT_X) + nuisance(f, v, TILT_Y) * I;
    const double scale = 1.0 + nuisance(f, v, SCALE);
    for (int i = 0; i < f->used; ++i) {
        if ((status = ask_at(f, i, error)) != FST_OK)
            return status;
        const double complex miss =
            (place(f, &path, v, i) - scale * on_plate(tilt, f->z[i])) * (f->weight[i] / NOISE);
        r[2 * i] = creal(miss);
        r[2 * i + 1] = cimag(miss);
    }
    for (int k = 0; k < f->space.count; ++k) {
        const fit_key *key = &f->space.keys[k];
        r[2 * f->used + k] =
            isnan(key->prior[0]) ? 0.0 : (fit_space_value(&f->space, v, k) - key->prior[0]) / key->prior[1];
    }
    r[2 * f->used + f->space.count] =
        f->slot[EXPOSURE] >= 0 ? (nuisance(f, v, EXPOSURE) - f->exposure[0]) / f->exposure[1] : 0.0;
    r[2 * f->used + f->space.count + 1] = f->slot[SCALE] >= 0 ? nuisance(f, v, SCALE) / f->scale_error : 0.0;
    return FST_OK;
}

static fst_status derivatives(film_fit *f, const double *v, double *jacobian, fst_error *error)
{
    const int m = residual_count(f), n = f->space.count + f->nuisances;
    const double step = 2e-5;
    double *r = calloc((size_t)m, sizeof *r), moved[FIT_MOST + NUISANCES];
    fst_status status =
        r ? residuals(f, v, r, error) : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    const fst_orbit here = f->orbit;
    const fit_path path = f->path;
    const double drive = f->path_drive;
    for (int k = 0; k < n && status == FST_OK; ++k) {
        double *column = jacobian + (size_t)m * (size_t)k;
        memcpy(moved, v, (size_t)n * sizeof *v);
        moved[k] += step;
        status = residuals(f, moved, column, error);
        for (int i = 0; i < m; ++i)
            column[i] = (column[i] - r[i]) / step;
        f->orbit = here;
        f->path = path;
        f->path_drive = drive;
        memcpy(f->path_at, v, (size_t)f->space.count * sizeof *v);
    }
    free(r);
    return status;
}

static fst_status ask_residuals(void *user, const double *v, double *r, fst_error *error)
{
    film_fit *f = user;
    const fst_status status = residuals(f, v, r, error);
    for (int i = 0; i < residual_count(f) && status == FST_NO_CONVERGENCE; ++i)
        r[i] = 1e3; /* no such orbit: the search turns back */
    return status == FST_NO_CONVERGENCE ? FST_OK : status;
}

static fst_status ask_derivatives(void *user, const double *v, double *jacobian, fst_error *error)
{
    return derivatives(user, v, jacobian, error);
}

static fst_status solve(film_fit *f, double *v, fst_error *error)
{
    const fit_least_squares least = {.minpack = f->minpack,
                                     .user = f,
                                     .residuals = ask_residuals,
                                     .derivatives = ask_derivatives,
                                     .m = residual_count(f),
                                     .n = f->space.count + f->nuisances,
                                     .tolerance = 1e-6,
                                     .most_calls = 60};
    double *r = calloc((size_t)least.m, sizeof *r);
    const fst_status status =
        r ? fit_least(&least, v, r, error) : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    free(r);
    return status;
}

/* ------------------------------------------------------------------ the start */

/* The angle of the magnet, the place on the orbit and the centre with which the first frames agree best. */
static fst_status find_phases(film_fit *f, fst_error *error)
{
    enum { PHASES = 96 };
    const double v[FIT_MOST + NUISANCES] = {0.0};
    fit_path path;
    double least = INFINITY;
    fst_status status = find_path(f, v, &path, error);
    for (int k = 0; k < PHASES && status == FST_OK; ++k) {
        double complex mean_z = 0, mean_w = 0, product = 0;
        double square = 0;
        for (int i = 0; i < f->used && status == FST_OK; ++i) {
            const double complex seen = on_plate(f->tilt, f->z[i]), z = f->sense > 0 ? seen : conj(seen);
            const double complex w =
                fit_path_at(&path, f->drive, 0.0, (double)k / PHASES, f->exposure[0], f->t[i]);
            mean_z += z / f->used;
            mean_w += w / f->used;
            product += z * conj(w);
            square += creal(z * conj(z)) + creal(w * conj(w));
            status = ask_at(f, i, error);
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

static fst_status take_frames(film_fit *f, const fst_track *track, const fst_measurement *seen,
                              fst_error *error)
{
    const double *s = seen->stretch;
    /* A tilt that is not sure counts as zero: correcting for noise would make every radius too great. */
    if (seen->tilt_deg > 3.0 * seen->tilt_deg_error)
        f->tilt = 0.5 * (s[0] - s[2]) + s[1] * I;
    double unit;
    char one[32];
    f->scale_error = track->scale_error;
    f->t = calloc(track->rows + 1, sizeof *f->t);
    f->z = calloc(track->rows + 1, sizeof *f->z);
    f->weight = calloc(track->rows + 1, sizeof *f->weight);
    f->slip = calloc(track->rows + 1, sizeof *f->slip);
    f->slip_error = calloc(track->rows + 1, sizeof *f->slip_error);
    if (!f->t || !f->z || !f->weight || !f->slip || !f->slip_error)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    (void)snprintf(one, sizeof one, "1 %s", track->length_unit);
    if (fst_parse_value(one, FST_UNIT_LENGTH, &unit, NULL) != FST_OK)
        return fst_fail(error, FST_BAD_INPUT, "fst_track.length_unit",
                        "the track is in pixels: say how long one of them is");
    for (size_t i = 0; i < track->rows; ++i) {
        if (track->flag[i] != FST_FRAME_SEEN || track->t[i] - track->t[0] < seen->settled_after_s)
            continue;
        const double x = track->x[i] - seen->centre[0], y = track->y[i] - seen->centre[1];
        f->t[f->frames] = track->t[i] - track->t[0];
        f->z[f->frames] = unit * (x + y * I);
        const fst_turning *turning = track->turning ? &track->turning[i] : NULL;
        f->slip[f->frames] = turning ? unit * (turning->slip[0] + turning->slip[1] * I) : NAN;
        f->slip_error[f->frames] = turning ? unit * turning->slip_error : NAN;
        f->weight[f->frames++] = 1.0;
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ the search */

/* Frames that lie far off, as the median knows it, are left out; returns how many. */
static int reject_frames(film_fit *f, const double *r)
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

/* Windows that grow, then once more without the frames that lie far off. */
static fst_status search(film_fit *f, double *v, int *rejected, fst_error *error)
{
    static const double windows[] = {0.15, 0.4, 1.0};
    const double whole = f->t[f->frames - 1] - f->t[0];
    fst_status status = FST_OK;
    for (int w = 0; w < 3 && status == FST_OK; ++w) {
        for (f->used = 0; f->used < f->frames && f->t[f->used] - f->t[0] <= windows[w] * whole;)
            f->used += 1;
        if (w == 0)
            status = find_phases(f, error);
        if (status == FST_OK)
            status = solve(f, v, error);
    }
    double *r = calloc((size_t)residual_count(f), sizeof *r);
    if (!r)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    if (status == FST_OK)
        status = residuals(f, v, r, error);
    *rejected = status == FST_OK ? reject_frames(f, r) : 0;
    if (status == FST_OK && *rejected > 0)
        status = solve(f, v, error);
    free(r);
    return status;
}

/* ------------------------------------------------------------------ the report */

/* How much the variance of a mean exceeds that of white noise: residuals of neighbouring frames may be alike.
 */
static double redness(const film_fit *f, const double *r)
{
    enum { LAGS = 60 };
    double zero = 0.0, sum = 1.0;
    for (int i = 0; i < 2 * f->used; ++i)
        zero += r[i] * r[i];
    for (int lag = 1; lag < LAGS && lag < f->used / 4; ++lag) {
        double product = 0.0;
        for (int i = 0; i + 2 * lag < 2 * f->used; ++i)
            product += r[i] * r[i + 2 * lag];
        if (product < 2.0 * zero / sqrt(2.0 * f->used)) /* no more than chance */
            break;
        sum += 2.0 * product / zero;
    }
    return sum;
}

/* The covariance of the parameters' coordinates among all unknowns, scaled by what is left over. */
static fst_status estimate(film_fit *f, const double *v, fit_estimate *e, double *left, fst_error *error)
{
    const int m = residual_count(f), n = f->space.count + f->nuisances;
    fit_matrix covariance;
    double *jacobian = calloc((size_t)m * (size_t)(n + 1), sizeof *jacobian),
           *r = jacobian + (size_t)m * (size_t)n;
    fst_status status =
        jacobian ? residuals(f, v, r, error) : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    if (status == FST_OK)
        status = derivatives(f, v, jacobian, error);
    int kept = 0;
    double sum = 0.0;
    for (int i = 0; i < f->used && status == FST_OK; ++i) {
        kept += f->weight[i] > 0.0;
        sum += r[2 * i] * r[2 * i] + r[2 * i + 1] * r[2 * i + 1];
    }
    const double variance = sum / fmax(2.0 * kept - n, 1.0);
    const double scatter = status == FST_OK ? sqrt(variance * redness(f, r)) : NAN;
    for (int i = 0; i < 2 * f->used && status == FST_OK; ++i)
        for (int k = 0; k < n; ++k)
            jacobian[i + m * k] /= scatter;
    if (status == FST_OK && !fit_covariance(jacobian, m, n, &covariance))
        status = fst_fail(error, FST_BAD_INPUT, "fst_fit",
                          "the track cannot tell the parameters that are sought apart: seek fewer, or give "
                          "what is known otherwise");
    if (status == FST_OK) {
        const int k = f->space.count + f->slot[DRIVE];
        f->found_drive = f->sense * nuisance(f, v, DRIVE);
        f->drive_error = f->drive * unit_of[DRIVE] * sqrt(covariance.a[k][k]);
        covariance.size = f->space.count;
        e->covariance = covariance;
        memcpy(e->u, v, (size_t)f->space.count * sizeof *v);
    }
    *left = NOISE * sqrt(variance);
    free(jacobian);
    return status;
}

/* How places scatter from frame to frame, by fourth differences, of which no smooth path is left; m. */
static double jitter_of(const film_fit *f)
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

/* What a person should doubt: what measure said of the track, and places that are farther from the path than their noise. */
static fst_status doubt(const film_fit *f, const fst_measurement *seen, double left, fst_fit *fit,
                        fst_error *error)
{
    fst_status status = FST_OK;
    const double jitter = jitter_of(f);
    for (int i = 0; i < seen->warning_count && status == FST_OK; ++i)
        status = fit_remark(fit, error, "%s", seen->warnings[i]);
    if (status == FST_OK && left > 4.0 * jitter)
        status = fit_remark(fit, error,
                            "places lie %.3g times as far from the model's path as they scatter from frame to "
                            "frame: the path is "
                            "another one, and the errors do not tell by how much the parameters are wrong; "
                            "look at the scale, the "
                            "drive, the exposure and the friction law",
                            left / jitter);
    return status;
}

/* How well the slip that the path implies agrees with what the bead's marks showed: a law of friction may find the places
 * and yet have the wrong slip. */
static fst_status judge_slip(film_fit *f, const double *v, fst_fit *fit, fst_error *error)
{
    fit_path path;
    fst_status status = find_path(f, v, &path, error);
    double sum = 0.0, size = 0.0, off = 0.0;
    fit->slip_misfit = NAN;
    for (int i = 0; i < f->frames && status == FST_OK; ++i) {
        if (!(f->slip_error[i] > 0.0) || !isfinite(creal(f->slip[i]) + cimag(f->slip[i])))
            continue;
        const double complex model = fit_path_slip_at(&path, nuisance(f, v, DRIVE), nuisance(f, v, TURN),
                                                      nuisance(f, v, PHASE), f->t[i]);
        const double miss = cabs((f->sense > 0 ? model : conj(model)) - f->slip[i]);
        sum += 0.5 * pow(miss / f->slip_error[i], 2.0);
        size += pow(cabs(f->slip[i]), 2.0);
        off += miss * miss;
        fit->slip_frames += 1;
    }
    if (status != FST_OK || fit->slip_frames == 0)
        return status;
    fit->slip_misfit = sqrt(sum / fit->slip_frames);
    return fit_remark(fit, error,
                      "slip, measured in %d frames and not fitted: the model's is %.3g standard deviations "
                      "off, %.3g %% of it; "
                      "where another friction law is nearer to 1, take that",
                      fit->slip_frames, fit->slip_misfit, 100.0 * sqrt(off / size));
}

static fst_status report(film_fit *f, const fit_estimate *e, double left, int rejected, fst_fit *fit,
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
static fst_status begin(film_fit *f, const fst_params *params, const fst_measurement *seen,
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
    f->exposure[0] = isfinite(options->exposure) ? options->exposure : 0.0;
    f->exposure[1] = options->exposure_error;
    for (int k = 0; k < NUISANCES; ++k) {
        const int held = (k == EXPOSURE && !(f->exposure[1] > 0.0)) ||
                         (k == SCALE && !(f->scale_error > 0.0)) || (k >= TILT_X && f->tilt == 0.0);
        f->slot[k] = held ? -1 : f->nuisances++;
    }
    f->outer = options->progress;
    f->progress = (fst_progress){f, tell_rounds};
    status = fit_space_begin(&f->space, &start, options, error);
    if (status == FST_OK && f->space.count + f->nuisances > FIT_MOST)
        status = fst_fail(error, FST_BAD_INPUT, "fst_fit_options.free", "there are more than %d parameters",
                          FIT_MOST - f->nuisances);
    return status;
}

fst_status fst_fit_track(const fst_params *params, fst_track *track, const fst_fit_options *options,
                         fst_fit *fit, fst_error *error)
{
    film_fit f;
    fit_estimate e;
    fst_measurement seen;
    fst_measure_options how = fst_default_measure_options();
    double v[FIT_MOST + NUISANCES] = {0.0}, left = NAN;
    int rejected = 0;
    memset(&f, 0, sizeof f);
    memset(&e, 0, sizeof e);
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
        status = take_frames(&f, track, &seen, error);
    if (status == FST_OK)
        status = begin(&f, params, &seen, options, error);
    if (status == FST_OK && f.frames < 4 * (f.space.count + f.nuisances))
        status =
            fst_fail(error, FST_BAD_INPUT, "fst_track", "it has %d places of the bead, too few for %d unknowns",
                     f.frames, f.space.count + f.nuisances);
    if (status == FST_OK)
        status = search(&f, v, &rejected, error);
    if (status == FST_OK)
        status = estimate(&f, v, &e, &left, error);
    if (status == FST_OK)
        status = report(&f, &e, left, rejected, fit, error);
    if (status == FST_OK)
        status = judge_slip(&f, v, fit, error);
    if (status == FST_OK)
        status = doubt(&f, &seen, left, fit, error);
    free(f.t);
    free(f.z);
    free(f.weight);
    free(f.slip);
    free(f.slip_error);
    if (status != FST_OK)
        fst_fit_free(fit);
    return status;
}
