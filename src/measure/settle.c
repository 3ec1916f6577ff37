/* settle.c - where the motion of a film has settled.
 *
 * While a motion settles, its mean radius, the size and phase of its oscillation and its rate change, ever less. Whether
 * they do in a part of the film is asked by columns more in the models of r and alpha: the mean and the two strongest
 * lines times a shape in time, once slow and once quick.  Where these take off more than chance would, the part begins
 * too early.  What settles long before the quick shape does, as a bead that locks, shows by what the model of r leaves
 * over: far more in the beginning than anywhere later.
 */
#include "measure/work.h"

#include "base/constants.h"
#include "base/dot.h"

enum { LINES = 2, SHAPES = 2, PARTS = 16, MOST_PARTS = 12, LEAST_TURNS_LEFT = 4 };

/* How many standard deviations are a drift: noise alone has the first once in 10^5 films.  Once a film is known to
 * begin too early, less is suspicious. */
#define DRIFTS 4.5
#define STILL_DRIFTS 0.5
/* Of less noise than this part of a radius the films are not that show a drift: what a model of eight harmonics lacks is
 * as large. */
#define SMALL 1e-4
/* A beginning that has so many times what the model leaves over in any part later has not settled; what beats, and
 * noise, have nearly as much again later. */
#define LOUD 4.0
/* Frames in a turn of the bead: with less, multiples of the festoons' rate look like slow ones. */
#define LEAST_FRAMES 18.0

/* The shapes: a line over the film, and what falls by e in an eighth of it. */
static void shapes_at(const measure_work *work, size_t i, double shapes[SHAPES])
{
    const double at = (work->t[i] - work->t[0]) / measure_duration(work);
    shapes[0] = at - 0.5;
    shapes[1] = exp(-8.0 * at);
}

/* A row of the model of r with the columns more. */
static int drifting_radial_row(const measure_work *work, size_t i, double *row)
{
    double shapes[SHAPES];
    int n = measure_radial_row(work, i, row);
    shapes_at(work, i, shapes);
    for (int s = 0; s < SHAPES; ++s) {
        row[n++] = shapes[s];
        for (int k = 1; k <= LINES && work->f0 > 0; ++k) {
            const double angle = FST_TWO_PI * k * work->f0 * work->t[i];
            row[n++] = shapes[s] * cos(angle);
            row[n++] = shapes[s] * sin(angle);
        }
    }
    return n;
}

static int drifting_angular_row(const measure_work *work, size_t i, double *row)
{
    double shapes[SHAPES];
    const int n = measure_angular_row(work, i, row);
    shapes_at(work, i, shapes);
    row[n] = shapes[0] * shapes[0];
    row[n + 1] = shapes[1];
    return n + 2;
}

/* How many standard deviations more than by chance the columns more take off of the squares (chi^2 as a normal
 * number, by Wilson and Hilferty). */
static double drift_of(measure_work *work, int (*row_of)(const measure_work *, size_t, double *),
                       const double *off, int columns, double small)
{
    double row[MEASURE_MOST_COLUMNS];
    measure_regression fit;
    const double before = fst_dot(off, off, (int)work->count);
    measure_regression_begin(&fit, row_of(work, 0, row));
    for (size_t i = 0; i < work->count; ++i) {
        (void)row_of(work, i, row);
        measure_regression_add(&fit, row, off[i]);
    }
    measure_regression_solve(&fit);
    const double taken = fst_dot(fit.coefficient, fit.right, fit.columns), rows = (double)work->count;
    for (size_t i = 0; i < work->count; ++i) {
        (void)row_of(work, i, row);
        work->scratch[i] = off[i] - measure_regression_value(&fit, row);
    }
    const double noise = fmax((before - taken) / (rows - fit.columns), small * small) *
                         measure_hanging_together(work, work->scratch);
    const double freedom = fit.columns - columns, part = 2.0 / (9.0 * freedom);
    return (cbrt(taken / noise / freedom) - 1.0 + part) / sqrt(part);
}

/* How surely the part of the film that the work has drifts. */
static double drift(measure_work *work)
{
    const double r0 = work->radial.coefficient[0];
    /* A harmonic in the place of another one beats with it, as slowly as a drift. */
    if (4.0 * work->peak > work->fps || LEAST_FRAMES * fabs(work->bead) > work->fps)
        return 0.0;
    for (int k = 0; k < work->harmonics && work->f0 > 0; ++k)
        if (work->skipped[k])
            return 0.0;
    return fmax(drift_of(work, drifting_radial_row, work->r_off, work->radial.columns, SMALL * r0),
                drift_of(work, drifting_angular_row, work->a_off, work->angular.columns, SMALL));
}

/* Whether what the model of r leaves over is far greater in the first part of the film than in each other one: the
 * products of neighbours, to which noise and a single wild place give little. */
static int begins_loud(const measure_work *work)
{
    double sum[PARTS] = {0}, greatest = 0.0;
    const double small = SMALL * work->radial.coefficient[0];
    for (size_t i = 0; i + 1 < work->count; ++i)
        if (measure_neighbours(work, i))
            sum[i * PARTS / work->count] += work->r_off[i] * work->r_off[i + 1];
    for (int part = 1; part < PARTS; ++part)
        greatest = fmax(greatest, fabs(sum[part]));
    return sum[0] > LOUD * (greatest + small * small * (double)work->count / PARTS);
}

/* The time of a row, from the film's first one. */
static double time_of(const measure_work *work, size_t row)
{
    const fst_track *track = work->track;
    return isfinite(track->fps) ? track->t[row] - track->t[0] : (double)(track->frame[row] - track->frame[0]);
}

fst_status measure_settle(measure_work *work, fst_error *error)
{
    const double whole = measure_duration(work), begin = time_of(work, work->row[0]);
    double least = DRIFTS;
    fst_status status = FST_OK;
    for (int part = 1; status == FST_OK && (begins_loud(work) || drift(work) > least);
         ++part, least = STILL_DRIFTS) {
        const double from = whole * part / PARTS;
        if (part > MOST_PARTS || (whole - from) * fabs(work->bead) < LEAST_TURNS_LEFT) {
            work->drifts = 1;
            break;
        }
        while (time_of(work, work->first) < begin + from)
            ++work->first;
        measure_work_take(work);
        status = measure_find_motion(work, error);
    }
    return status;
}

void measure_tell_settled(const measure_work *work, fst_measurement *measured)
{
    const int timed = isfinite(work->track->fps);
    const char *unit = timed ? "s" : "frames";
    const double from = work->first > 0 ? time_of(work, work->first) : 0.0;
    if (work->drifts)
        measure_warn(
            measured,
            "the motion never settles in this film: r or its oscillation still change in its last %.3g %s, of "
            "which the numbers are, without errors; film it later, or for longer",
            measure_duration(work), unit);
    else if (work->first > 0)
        measure_warn(measured, "the motion settles first: %.4g %s are left out at the beginning, of %.4g", from,
                     unit, from + measure_duration(work));
    measured->left_out = work->track->frame[work->first] - work->track->frame[0];
    measured->settled_after_s = work->drifts || (work->first > 0 && !timed) ? NAN : from;
}
