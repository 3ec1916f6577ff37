/* film.c - one film as a problem of least squares. */
#include "fit/film.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"

enum { FRAMES_UNASKED = 128 }; /* frames between two questions: some milliseconds */

/* Lengths of a step of the unknowns. */
static const double unit_of[FIT_NUISANCES] = {1e-3, 1e-3, 1e-3, 1.0, 0.1, 1e-3, 1e-2, 1e-2, 1e-2, 1.0};

/* Relative, of the bead's radius, with which the slip was measured: callipers have 0.5 % of 5 mm, and a chain of rotations
 * may err as much, all in one way. */
#define RADIUS_ERROR 0.01

/* ------------------------------------------------------------------ frames */

fst_status fit_film_take(fit_film *f, const fst_track *track, const fst_measurement *seen, fst_error *error)
{
    const double *s = seen->stretch;
    const size_t room = track->rows + 1;
    /* A tilt that is not sure counts as zero: correcting for noise would make every radius too great. */
    if (seen->tilt_deg > 3.0 * seen->tilt_deg_error)
        f->tilt = 0.5 * (s[0] - s[2]) + s[1] * I;
    double unit;
    char one[32];
    f->scale_error = track->scale_error;
    f->rhythm = track->rhythm;
    f->t = calloc(room, sizeof *f->t);
    f->z = calloc(room, sizeof *f->z);
    f->weight = calloc(room, sizeof *f->weight);
    f->slip = calloc(room, sizeof *f->slip);
    f->slip_error = calloc(room, sizeof *f->slip_error);
    f->row = calloc(room, sizeof *f->row);
    f->slip_at = calloc(room, sizeof *f->slip_at);
    if (!f->t || !f->z || !f->weight || !f->slip || !f->slip_error || !f->row || !f->slip_at)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    (void)snprintf(one, sizeof one, "1 %s", track->length_unit);
    if (fst_parse_value(one, FST_UNIT_LENGTH, &unit, NULL) != FST_OK)
        return fst_fail(error, FST_BAD_INPUT, "fst_track_options.scale",
                        "the track is in pixels: say how long one of them is");
    for (size_t i = 0; i < track->rows; ++i) {
        if (track->flag[i] != FST_FRAME_SEEN || track->frame[i] - track->frame[0] < seen->left_out)
            continue;
        const double x = track->x[i] - seen->centre[0], y = track->y[i] - seen->centre[1];
        f->row[f->frames] = (int)i;
        f->t[f->frames] = track->t[i] - track->t[0];
        f->z[f->frames] = unit * (x + y * I);
        const fst_turning *turning = track->turning ? &track->turning[i] : NULL;
        f->slip[f->frames] = turning ? unit * (turning->slip[0] + turning->slip[1] * I) : NAN;
        f->slip_error[f->frames] = turning ? unit * turning->slip_error : NAN;
        f->weight[f->frames++] = 1.0;
    }
    if (f->frames > 1 && !track->rhythm)
        f->step = (f->t[f->frames - 1] - f->t[0]) / (f->row[f->frames - 1] - f->row[0]);
    return FST_OK;
}

void fit_film_free(fit_film *f)
{
    free(f->t);
    free(f->z);
    free(f->weight);
    free(f->slip);
    free(f->slip_error);
    free(f->row);
    free(f->slip_at);
}

fst_status fit_film_ask(const fit_film *f, int frame, fst_error *error)
{
    return frame % FRAMES_UNASKED == 0 ? fst_tell(&f->progress, 0.0, NULL, error) : FST_OK;
}

/* ------------------------------------------------------------------ what the model would show */

double fit_film_nuisance(const fit_film *f, const double *v, int k)
{
    const double start[FIT_NUISANCES] = {
        f->drive, creal(f->centre), cimag(f->centre), f->turn, f->phase, f->exposure[0],
        0.0,      creal(f->tilt),   cimag(f->tilt),   0.0};
    const double step = f->slot[k] >= 0 ? v[f->space.count + f->slot[k]] * unit_of[k] : 0.0;
    return k == FIT_DRIVE ? start[k] * (1.0 + step) : start[k] + step;
}

fst_status fit_film_path(fit_film *f, const double *v, fit_path *path, fst_error *error)
{
    fst_params params;
    fst_orbit orbit;
    fst_status status = FST_NO_CONVERGENCE;
    const double drive = fit_film_nuisance(f, v, FIT_DRIVE);
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
        status = fit_path_make(&params, &orbit, f->step, path, error);
    if (status != FST_OK)
        return status;
    f->orbit = orbit;
    f->path = *path;
    f->path_drive = drive;
    memcpy(f->path_at, v, size);
    return FST_OK;
}

/* What the model shows of a path in the laboratory, in the picture's sense. */
static double complex seen(const fit_film *f, const fit_path *path, fit_path_kind kind, const double *v, int i)
{
    const double complex z =
        fit_path_at(path, kind, fit_film_nuisance(f, v, FIT_TURN), fit_film_nuisance(f, v, FIT_PHASE),
                    fit_film_nuisance(f, v, FIT_EXPOSURE), f->t[i]);
    return f->sense > 0 ? z : conj(z);
}

double complex fit_film_on_plate(double complex tilt, double complex z)
{
    return (1.0 + cabs(tilt)) * z + tilt * conj(z);
}

static double complex tilt_of(const fit_film *f, const double *v)
{
    return fit_film_nuisance(f, v, FIT_TILT_X) + fit_film_nuisance(f, v, FIT_TILT_Y) * I;
}

/* The slip was made of the velocity as the film shows it, by its scale and tilt, and of a radius: where they are wrong, so
 * is the slip, by a part of the velocity. */
double complex fit_film_slip(const fit_film *f, const fit_path *path, const double *v, int i)
{
    const double complex slip = seen(f, path, FIT_PATH_SLIP, v, i), u = seen(f, path, FIT_PATH_VELOCITY, v, i),
                         tilt = tilt_of(f, v);
    const double wide = 1.0 + cabs(tilt), scale = 1.0 + fit_film_nuisance(f, v, FIT_SCALE);
    const double complex shown = (wide * u - tilt * conj(u)) / (wide * wide - creal(tilt * conj(tilt))) / scale;
    return shown - (u - slip) / (1.0 + fit_film_nuisance(f, v, FIT_RADIUS));
}

/* ------------------------------------------------------------------ residuals */

int fit_film_residual_count(const fit_film *f)
{
    return 2 * (f->used + f->slips) + f->space.count + 3;
}

static void put(double complex miss, double *r)
{
    r[0] = creal(miss);
    r[1] = cimag(miss);
}

/* What is known beforehand: of the parameters, the exposure, the scale and the radius. */
static void add_priors(const fit_film *f, const double *v, double *r)
{
    for (int k = 0; k < f->space.count; ++k) {
        const fit_key *key = &f->space.keys[k];
        r[k] = isnan(key->prior[0]) ? 0.0 : (fit_space_value(&f->space, v, k) - key->prior[0]) / key->prior[1];
    }
    r += f->space.count;
    r[0] = f->slot[FIT_EXPOSURE] >= 0
               ? (fit_film_nuisance(f, v, FIT_EXPOSURE) - f->exposure[0]) / f->exposure[1]
               : 0.0;
    r[1] = f->slot[FIT_SCALE] >= 0 ? fit_film_nuisance(f, v, FIT_SCALE) / f->scale_error : 0.0;
    r[2] = fit_film_nuisance(f, v, FIT_RADIUS) / RADIUS_ERROR;
}

fst_status fit_film_residuals(fit_film *f, const double *v, double *r, fst_error *error)
{
    fit_path path;
    fst_status status = fit_film_path(f, v, &path, error);
    f->rounds += 1.0;
    if (status != FST_OK)
        return status;
    const double complex tilt = tilt_of(f, v), centre = fit_film_nuisance(f, v, FIT_CENTRE_X) +
                                                        fit_film_nuisance(f, v, FIT_CENTRE_Y) * I;
    const double scale = 1.0 + fit_film_nuisance(f, v, FIT_SCALE);
    for (int i = 0; i < f->used; ++i) {
        if ((status = fit_film_ask(f, i, error)) != FST_OK)
            return status;
        const double complex place = seen(f, &path, FIT_PATH_PLACE, v, i) + centre;
        put((place - scale * fit_film_on_plate(tilt, f->z[i])) * (f->weight[i] / f->noise), r + 2 * i);
    }
    for (int k = 0; k < f->slips; ++k) {
        const int i = f->slip_at[k];
        put((fit_film_slip(f, &path, v, i) - f->slip[i]) / (f->slip_scale * f->slip_error[i]),
            r + 2 * (f->used + k));
    }
    add_priors(f, v, r + 2 * (f->used + f->slips));
    return FST_OK;
}

fst_status fit_film_derivatives(fit_film *f, const double *v, double *jacobian, fst_error *error)
{
    const int m = fit_film_residual_count(f), n = fit_film_unknowns(f);
    const double step = 2e-5;
    double *r = calloc((size_t)m, sizeof *r), moved[FIT_MOST + FIT_NUISANCES];
    fst_status status =
        r ? fit_film_residuals(f, v, r, error) : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    const fst_orbit here = f->orbit;
    const fit_path path = f->path;
    const double drive = f->path_drive;
    for (int k = 0; k < n && status == FST_OK; ++k) {
        double *column = jacobian + (size_t)m * (size_t)k;
        memcpy(moved, v, (size_t)n * sizeof *v);
        moved[k] += step;
        status = fit_film_residuals(f, moved, column, error);
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
    fit_film *f = user;
    const fst_status status = fit_film_residuals(f, v, r, error);
    for (int i = 0; i < fit_film_residual_count(f) && status == FST_NO_CONVERGENCE; ++i)
        r[i] = 1e3; /* no such orbit: the search turns back */
    return status == FST_NO_CONVERGENCE ? FST_OK : status;
}

static fst_status ask_derivatives(void *user, const double *v, double *jacobian, fst_error *error)
{
    return fit_film_derivatives(user, v, jacobian, error);
}

fst_status fit_film_solve(fit_film *f, double *v, double *r, fst_error *error)
{
    const fit_least_squares least = {.minpack = f->minpack,
                                     .user = f,
                                     .residuals = ask_residuals,
                                     .derivatives = ask_derivatives,
                                     .m = fit_film_residual_count(f),
                                     .n = fit_film_unknowns(f),
                                     .tolerance = 1e-6,
                                     .most_calls = 60};
    double *room = r ? NULL : calloc((size_t)least.m, sizeof *room);
    const fst_status status = r || room ? fit_least(&least, v, r ? r : room, error)
                                        : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    free(room);
    return status;
}

double fit_film_redness(const double *r, int count)
{
    enum { LAGS = 60 };
    double zero = 0.0, sum = 1.0;
    for (int i = 0; i < 2 * count; ++i)
        zero += r[i] * r[i];
    for (int lag = 1; lag < LAGS && lag < count / 4; ++lag) {
        double product = 0.0;
        for (int i = 0; i + 2 * lag < 2 * count; ++i)
            product += r[i] * r[i + 2 * lag];
        if (product < 2.0 * zero / sqrt(2.0 * count)) /* no more than chance */
            break;
        sum += 2.0 * product / zero;
    }
    return sum;
}
