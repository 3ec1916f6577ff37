/* errors.c - means, and the errors that they have.
 *
 * Every number here is, to first order, a sum over the frames: a frame with the residual e moves the
 * coefficients of the regression by (X'X)^-1 x e (its influence).  Influences are added up turn by turn, and
 * the turns are drawn again and again, with repetition and in blocks of neighbours (circular block bootstrap):
 * the scatter of the sums is the error. Residuals of one turn hang together, because they are not all noise of
 * pixels; whole turns hang together much less, and blocks of 1, 2 and 4 turns show how much.  The greatest of
 * the three errors is told, but none less than the covariance of the regression.  Of 3 to 8 turns the scatter says
 * little: there that covariance is widened by how residuals of neighbouring frames hang together.
 *
 * The tilt enters <r> as a systematic part: it stretches the plate by what the second harmonic in alpha says,
 * and that has an error of its own, which near zero has the distribution of a length: it is never negative.
 */
#include "measure/work.h"

#include <stdlib.h>
#include <string.h>

#include "base/chance.h"
#include "base/constants.h"
#include "base/dot.h"
#include "base/error.h"
#include "base/festoons.h"

enum { LEAST_TURNS = 3, MANY_TURNS = 8, DRAWS = 800, LAST_REPEATED = 8 };

/* What of the variance of r may be hidden before there is none. */
#define MOST_HIDDEN 0.5

/* What has an error. */
enum { R0, VARIANCE, BEAD, F0, TILT_C, TILT_S, CENTRE_X, CENTRE_Y, QUANTITIES };

typedef struct turn_sums {
    size_t count;
    double repeated; /* the variance of errors of places that each turn repeats, which turns do not tell */
    double (*sum)[QUANTITIES]; /* influences, turn by turn */
} turn_sums;

/* ---------------------------------------------------------------- influences */

/* The influence of a row on all quantities, of its residuals in r and alpha. */
static void influence_of(const measure_work *work, size_t i, double influence[QUANTITIES])
{
    double row[MEASURE_MOST_COLUMNS], moved[MEASURE_MOST_COLUMNS];
    const int n = measure_radial_row(work, i, row), first = n - MEASURE_GEOMETRY;
    const double *c = work->radial.coefficient;
    measure_regression_influence(&work->radial, row, work->r_off[i], moved);
    influence[R0] = moved[0];
    influence[VARIANCE] = 0.0;
    for (int k = 1; k < first; ++k)
        influence[VARIANCE] += c[k] * moved[k] * work->gain;
    influence[F0] = moved[first + MEASURE_SLOPE] * work->gain; /* the noise did not grow with the line */
    influence[TILT_C] = moved[first + MEASURE_TILT_C];
    influence[TILT_S] = moved[first + MEASURE_TILT_S];
    influence[CENTRE_X] = moved[first + MEASURE_CENTRE_X];
    influence[CENTRE_Y] = moved[first + MEASURE_CENTRE_Y];
    const int m = measure_angular_row(work, i, row);
    measure_regression_influence(&work->angular, row, work->a_off[i], moved);
    influence[BEAD] = moved[m - 1];
}

/* Residuals of neighbouring frames: what of their variance is motion that the model lacks, because noise of
 * pixels is new in every frame.  The mean product of neighbours, 0 where it is no more than chance. */
static double slow_variance(const measure_work *work, double *pairs)
{
    const double square = fst_dot(work->r_off, work->r_off, (int)work->count);
    double sum = 0.0;
    *pairs = 0.0;
    for (size_t i = 0; i + 1 < work->count; ++i)
        if (measure_neighbours(work, i)) {
            sum += work->r_off[i] * work->r_off[i + 1];
            *pairs += 1.0;
        }
    const double mean = *pairs > 0 ? sum / *pairs : 0.0, variance = square / (double)work->count;
    return *pairs > 0 && mean > 3.0 * variance / sqrt(*pairs) ? mean : 0.0;
}

static fst_status sum_turns(const measure_work *work, double slow, double pairs, turn_sums *turns,
                            fst_error *error)
{
    const double rate = fabs(work->bead), from = work->t[0];
    turns->count = (size_t)floor(measure_duration(work) * rate);
    turns->sum = calloc(turns->count + 1, sizeof *turns->sum);
    if (!turns->sum)
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for %zu turns", turns->count);
    for (size_t i = 0; i < work->count; ++i) {
        double influence[QUANTITIES];
        size_t turn = (size_t)((work->t[i] - from) * rate);
        turn = turn < turns->count ? turn : turns->count - (turns->count > 0);
        influence_of(work, i, influence);
        if (slow > 0 && i + 1 < work->count && measure_neighbours(work, i))
            influence[VARIANCE] += (work->r_off[i] * work->r_off[i + 1] - slow) / pairs;
        for (int q = 0; q < QUANTITIES; ++q)
            turns->sum[turn][q] += influence[q];
    }
    return FST_OK;
}

/* ---------------------------------------------------------------- drawing turns again */

/* Standard deviations of the sums over turns drawn in blocks of `length`, and the covariance of two of them. */
static void draw(const turn_sums *turns, size_t length, double variance[QUANTITIES], double *covariance,
                 int one, int other)
{
    uint64_t state = 1;
    double mean[QUANTITIES] = {0}, square[QUANTITIES] = {0}, product = 0.0;
    for (int d = 0; d < DRAWS; ++d) {
        double sum[QUANTITIES] = {0};
        for (size_t drawn = 0; drawn < turns->count; drawn += length) {
            const size_t from = (size_t)(fst_draw(&state) % turns->count);
            for (size_t k = 0; k < length && drawn + k < turns->count; ++k)
                for (int q = 0; q < QUANTITIES; ++q)
                    sum[q] += turns->sum[(from + k) % turns->count][q];
        }
        for (int q = 0; q < QUANTITIES; ++q) {
            mean[q] += sum[q] / DRAWS;
            square[q] += sum[q] * sum[q] / DRAWS;
        }
        product += sum[one] * sum[other] / DRAWS;
    }
    for (int q = 0; q < QUANTITIES; ++q)
        variance[q] = square[q] - mean[q] * mean[q];
    *covariance = product - mean[one] * mean[other];
}

/* The variance of what a model leaves over. */
static double left_over(const measure_work *work, const double *off, const measure_regression *model)
{
    double square = 0.0;
    for (size_t i = 0; i < work->count; ++i)
        square += off[i] * off[i] / (double)(work->count - (size_t)model->columns);
    return square;
}

/* The variances that noise which is new in every frame gives: turns are few, and the scatter of few is
 * uncertain, but errors are not less than this.  Of very few turns the scatter says little: there the noise is
 * widened by how its neighbours hang together. */
static void white_variances(const measure_work *work, int few, double variance[QUANTITIES])
{
    const measure_regression *r = &work->radial, *a = &work->angular;
    const int first = r->columns - MEASURE_GEOMETRY, last = a->columns - 1;
    const int columns[QUANTITIES] = {[R0] = 0,
                                     [F0] = first + MEASURE_SLOPE,
                                     [TILT_C] = first + MEASURE_TILT_C,
                                     [TILT_S] = first + MEASURE_TILT_S,
                                     [CENTRE_X] = first + MEASURE_CENTRE_X,
                                     [CENTRE_Y] = first + MEASURE_CENTRE_Y};
    const double square_r =
        left_over(work, work->r_off, r) * (few ? measure_hanging_together(work, work->r_off) : 1.0);
    const double square_a =
        left_over(work, work->a_off, a) * (few ? measure_hanging_together(work, work->a_off) : 1.0);
    for (int q = 0; q < QUANTITIES; ++q)
        variance[q] = square_r * r->inverse[columns[q]][columns[q]];
    variance[F0] *= work->gain * work->gain;
    variance[BEAD] = square_a * a->inverse[last][last];
    variance[VARIANCE] = 0.0;
    for (int i = 1; i < first; ++i)
        for (int j = 1; j < first; ++j)
            variance[VARIANCE] +=
                square_r * work->gain * work->gain * r->coefficient[i] * r->inverse[i][j] * r->coefficient[j];
}

/* The variances of all quantities, and the covariance of bead and f0; NAN with too few turns. */
static void variances(const measure_work *work, const turn_sums *turns, double variance[QUANTITIES],
                      double *covariance)
{
    double white[QUANTITIES];
    white_variances(work, turns->count < MANY_TURNS, white);
    for (int q = 0; q < QUANTITIES; ++q)
        variance[q] = turns->count < LEAST_TURNS ? NAN : white[q];
    *covariance = 0.0;
    /* Residuals are smaller than errors, by the freedom that the fit took; and turns are few. */
    const double rows = (double)work->count, n = (double)turns->count;
    const double wider = rows / (rows - work->radial.columns) * n / (n - 1.0);
    for (size_t length = 1; length <= 4 && turns->count >= LEAST_TURNS; length *= 2) {
        double found[QUANTITIES], joint;
        if (4 * length > turns->count)
            break;
        draw(turns, length, found, &joint, BEAD, F0);
        for (int q = 0; q < QUANTITIES; ++q)
            variance[q] = fmax(variance[q], wider * found[q]);
        /* Of very few turns it would be chance, by which errors of sums might vanish. */
        *covariance = length == 1 && turns->count >= MANY_TURNS ? wider * joint : *covariance;
    }
}

/* ---------------------------------------------------------------- what each turn repeats */

/* The residuals of r of a bead that goes round on one circle have harmonics of its angle: it meets the same pixels in each
 * turn.  Such errors have a second harmonic too, which is taken for a tilt, and a mean.  Of their amplitudes A_k those with
 * k from 3 to 8 are seen; of a smooth error k A_k is about the same for all, which gives that of k = 2: its variance is
 * returned, with what chance gives of so few.  NAN: the frame rate shows none of them. */
static double repeated_variance(const measure_work *work)
{
    double row[MEASURE_MOST_COLUMNS], sum = 0.0, part = 0.0;
    measure_regression fit;
    const int n = work->radial.columns, most = n + 2 * (LAST_REPEATED - 2);
    measure_regression_begin(&fit, most);
    for (size_t i = 0; i < work->count; ++i) {
        (void)measure_radial_row(work, i, row);
        for (int k = 3, at = n; at < most; ++k, at += 2) {
            row[at] = cos(k * work->alpha[i]);
            row[at + 1] = sin(k * work->alpha[i]);
        }
        measure_regression_add(&fit, row, work->r_off[i]);
    }
    measure_regression_solve(&fit);
    for (int at = n; at < most; ++at) {
        const double k = 3 + (at - n) / 2, c = fit.coefficient[at];
        sum += c * c; /* 0 where it was dropped */
        part += fit.dropped[at] ? 0.0 : 4.0 / (k * k);
    }
    return part > 0.0 ? sum / part : NAN;
}

/* Errors that each turn repeats move the mean of r, centre and tilt. */
static void add_repeated(const measure_work *work, const turn_sums *turns, double variance[QUANTITIES])
{
    const double r0 = work->radial.coefficient[0];
    for (int q = 0; q < QUANTITIES; ++q)
        variance[q] += q == R0 || q >= CENTRE_X     ? turns->repeated
                       : q == TILT_C || q == TILT_S ? turns->repeated / (r0 * r0)
                                                    : 0.0;
}

/* ---------------------------------------------------------------- what the film hides */

/* Whether the harmonic k of r cannot be seen: the film shows it in the place of another one, or of the mean, or
 * the exposure has blurred it away. */
static int is_hidden(const measure_work *work, int k)
{
    return work->skipped[k - 1] ||
           (work->exposure > 0 && measure_kept(k * work->f0, work->exposure) < MEASURE_LEAST_KEPT);
}

static int is_any_hidden(const measure_work *work)
{
    int hidden = 0;
    for (int k = 1; k <= work->harmonics && work->f0 > 0; ++k)
        hidden |= is_hidden(work, k);
    return hidden;
}

/* The size of the harmonic k, of every `by`-th that r has.  A hidden one is taken to have half of the one before
 * it: motions have a seventh to a half. */
static double size_of(const measure_work *work, int k, int by)
{
    double least;
    if (k < 1)
        return INFINITY;
    return is_hidden(work, k) ? 0.5 * size_of(work, k - by, by) : measure_line_size(work, k, &least);
}

/* What hidden harmonics add to the variances.  One that looks like the mean of r, or like a tilt, moves these by
 * its size, and the slope of alpha likewise; one in the place of another moves that one's size and frequency. */
static void add_hidden(const measure_work *work, double variance[QUANTITIES])
{
    const int by = work->skipped[0] || measure_has_line(work, 1) ? 1 : 2; /* r may have the even ones alone */
    const double r0 = work->radial.coefficient[0], slope = 0.6 / measure_duration(work);
    double least, weight = 0.0;
    for (int k = 1; k <= work->harmonics; ++k)
        weight += pow(k * measure_line_size(work, k, &least), 2);
    for (int k = by; k <= work->harmonics; k += by) {
        if (!is_hidden(work, k))
            continue;
        const double size = size_of(work, k, by), square = 0.5 * size * size;
        const int place = work->skipped[k - 1] - 1;
        const double with = place > 0 ? measure_line_size(work, place, &least) : 0.0;
        variance[VARIANCE] += 0.25 * pow(size * (size + sqrt(2.0) * with), 2);
        variance[F0] += with > 0 ? square * pow(place * with / weight * slope, 2) : 0.0;
        if (place != 0)
            continue;
        for (int q = 0; q < QUANTITIES; ++q)
            variance[q] += q == F0 || q == VARIANCE   ? 0.0
                           : q == R0 || q >= CENTRE_X ? square
                           : q == BEAD                ? square * pow(slope / r0, 2)
                                                      : square / (r0 * r0);
    }
}

/* ---------------------------------------------------------------- tilt */

/* The angle of a tilt that stretches the plate by (1 + w)/(1 - w). */
static double tilt_of(double w)
{
    return acos(fmin(1.0, fmax(0.0, (1.0 - w) / (1.0 + w)))) * 180.0 / FST_PI;
}

/* The variance that white noise gives the same sum. */
static double white_sum(const measure_work *work, const double along[2])
{
    const measure_regression *fit = &work->radial;
    const int tilt = fit->columns - MEASURE_GEOMETRY + MEASURE_TILT_C, columns[3] = {0, tilt, tilt + 1};
    const double r0 = fit->coefficient[0], weights[3] = {1.0, r0 * along[0], r0 * along[1]};
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            sum += weights[i] * weights[j] * fit->inverse[columns[i]][columns[j]];
    return left_over(work, work->r_off, fit) * measure_hanging_together(work, work->r_off) * sum;
}

/* Tilt with its error, and the factor that lengths get for it.  Returns the relative error of lengths. */
static double take_tilt(const measure_work *work, const turn_sums *turns, const double variance[QUANTITIES],
                        double *factor, double *of_r0, fst_measurement *measured)
{
    const double *m = work->stretch;
    const double half = 0.5 * (m[0] - m[2]), apart = sqrt(half * half + m[1] * m[1]);
    const double most = 0.5 * (m[0] + m[2]) + apart, w = (most - 1.0) / (most + 1.0);
    const double sigma = sqrt(0.5 * (variance[TILT_C] + variance[TILT_S]));
    *factor = 1.0;
    *of_r0 = NAN;
    if (isnan(sigma)) {
        measured->tilt_deg = tilt_of(w);
        return NAN;
    }
    const double sure = sqrt(fmax(0.0, w * w - 2.0 * sigma * sigma));
    *factor = (1.0 + sure) / (1.0 + w);
    measured->tilt_deg = tilt_of(sure);
    measured->tilt_deg_error = tilt_of(sure + sigma) - measured->tilt_deg;
    /* Downwards over up to three errors, because the angle of a small tilt grows as a root. */
    for (int k = 1; k <= 3; ++k)
        measured->tilt_deg_error =
            fmax(measured->tilt_deg_error, (measured->tilt_deg - tilt_of(fmax(0.0, sure - k * sigma))) / k);
    if (w < 3.0 * sigma)
        return sigma;
    /* A tilt that is there: its part along the known direction, together with that of r0. */
    double square = 0.0;
    const double along[2] = {-half / apart, -m[1] / apart}, r0 = work->radial.coefficient[0];
    for (size_t i = 0; i < turns->count; ++i) {
        const double sum =
            turns->sum[i][R0] + r0 * (along[0] * turns->sum[i][TILT_C] + along[1] * turns->sum[i][TILT_S]);
        square += sum * sum;
    }
    *of_r0 = turns->count < MANY_TURNS ? fmax(square, white_sum(work, along)) : square;
    *of_r0 += 2.0 * turns->repeated;
    return sigma;
}

/* ---------------------------------------------------------------- the numbers */

/* The root of a variance: rounding may leave it a little below zero, and what is unknown stays NAN. */
static double error_of(double variance)
{
    return variance < 0.0 ? 0.0 : sqrt(variance);
}

static void take_radius(const measure_work *work, const turn_sums *turns, const double variance[QUANTITIES],
                        double slow, fst_measurement *measured)
{
    const int harmonics = work->radial.columns - MEASURE_GEOMETRY;
    const double *c = work->radial.coefficient;
    double factor, of_r0, waves = slow;
    const double systematic = take_tilt(work, turns, variance, &factor, &of_r0, measured);
    const double square = left_over(work, work->r_off, &work->radial), noise = fmax(0.0, square - slow);
    /* Noise alone gives coefficients too: their expected squares are taken off. */
    for (int k = 1; k < harmonics; ++k)
        waves += 0.5 * (c[k] * c[k] - square * work->gain * work->gain * work->radial.inverse[k][k]);
    measured->noise = sqrt(noise);
    measured->mean_r = factor * (c[0] - noise / (2.0 * c[0])); /* noise across the radius lengthens it */
    measured->mean_r_error = sqrt(isfinite(of_r0) ? fmax(of_r0, variance[R0])
                                                  : variance[R0] + c[0] * c[0] * systematic * systematic);
    measured->std_r = factor * sqrt(fmax(0.0, waves));
    /* The error of a root: by its slope where the variance is far from zero, else what the upper end gives. */
    const double spread = sqrt(variance[VARIANCE]), upper = sqrt(fmax(0.0, waves) + spread);
    measured->std_r_error =
        waves > 2.0 * spread ? spread / (2.0 * sqrt(waves)) : upper - measured->std_r / factor;
    if (harmonics == 1 && isfinite(spread)) { /* no line was found: one of this size would not have been */
        measured->std_r_error = fmax(
            measured->std_r_error, sqrt(2.0 * square * (log((double)work->count) + 6.9) / (double)work->count));
        /* What hangs together without a line may be errors of places, which compression makes too. */
        measured->std_r_error = hypot(fmax(measured->std_r_error, measured->std_r), work->unsure);
    }
    measured->std_r_error = sqrt(measured->std_r_error * measured->std_r_error +
                                 measured->std_r * measured->std_r * systematic * systematic);
    if (spread > MOST_HIDDEN * waves && is_any_hidden(work)) {
        measure_warn(
            measured,
            "%.5g frames a second, or the exposure, hide too much of the festoons: there is no delta r; film "
            "at 120 or 240 frames a second, with 1/500 s or less",
            work->fps);
        measured->std_r = measured->std_r_error = NAN;
    }
}

static void take_rates(const measure_work *work, const measure_drive *drive, const double variance[QUANTITIES],
                       double covariance, fst_measurement *measured)
{
    const double bead = fabs(work->bead);
    if (drive->bead_folded)
        return;
    measured->bead_frequency_hz = drive->relative * bead;
    measured->bead_frequency_hz_error = sqrt(variance[BEAD]);
    if (drive->motion == FST_MOTION_LOCKED) {
        measured->drive_from_track_hz = bead;
        measured->drive_from_track_hz_error = measured->bead_frequency_hz_error;
        return;
    }
    if (drive->motion != FST_MOTION_TURNING || drive->folded)
        return;
    /* f_drive = f0 + f_bead (with its sign against the magnet); N = a |1 - f_drive/f_bead|. */
    const double a = drive->symmetry, sign = drive->relative, magnet = work->f0 + sign * bead;
    const double turning = sign * (work->bead > 0 ? 1.0 : -1.0); /* covariance is with the filmed sense */
    const double joint = covariance * turning;
    measured->radial_frequency_hz = a * work->f0;
    measured->radial_frequency_hz_error = a * sqrt(variance[F0]);
    measured->drive_from_track_hz = magnet;
    measured->drive_from_track_hz_error = error_of(variance[F0] + variance[BEAD] + 2.0 * joint);
    measured->festoons = fst_festoons_a_lap(drive->symmetry, magnet, sign * bead);
    const double by_f0 = a / bead, by_bead = -sign * a * work->f0 / (bead * bead); /* by sign*bead */
    measured->festoons_error = error_of(by_f0 * by_f0 * variance[F0] + by_bead * by_bead * variance[BEAD] +
                                        2.0 * by_f0 * by_bead * joint);
    /* Without a clock of its own the film gives ratios alone: |f_bead| = f_drive/(N/a + sign). */
    if (drive->clock_follows) {
        measured->bead_frequency_hz_error =
            bead * measured->festoons_error / fabs(measured->festoons + sign * a);
        measured->radial_frequency_hz_error = a * measured->bead_frequency_hz_error;
    }
}

/* Keep what was fitted to r. */
static void keep_waves(const measure_work *work, fst_measurement *measured)
{
    const double *c = work->radial.coefficient + 1;
    const fst_track *track = work->track;
    const size_t first = work->row[0];
    measured->wave_mean = work->radial.coefficient[0];
    measured->wave_hz = work->f0;
    measured->wave_origin =
        (isfinite(track->fps) ? track->t[first] : (double)(track->frame[first] - track->frame[0])) - work->t[0];
    for (int k = 0; k < work->harmonics && work->f0 > 0; ++k)
        if (!work->skipped[k]) {
            measured->wave_cos[k] = *c++;
            measured->wave_sin[k] = *c++;
        }
}

fst_status measure_find_errors(const measure_work *work, const measure_drive *drive, fst_measurement *measured,
                               fst_error *error)
{
    turn_sums turns;
    double variance[QUANTITIES], covariance, pairs;
    const double slow = slow_variance(work, &pairs);
    const fst_status status = sum_turns(work, slow, pairs, &turns, error);
    if (status != FST_OK)
        return status;
    variances(work, &turns, variance, &covariance);
    turns.repeated = work->f0 > 0 ? 0.0 : repeated_variance(work);
    add_repeated(work, &turns, variance);
    if (work->f0 > 0)
        add_hidden(work, variance);
    /* Rates of cameras, as 239.76 and 240, are too near for a short film to choose between. */
    if (drive->clock_wrong || (drive->clock_set && turns.count < MANY_TURNS))
        variance[BEAD] = variance[F0] = NAN;
    /* A drift too small to be seen is mostly a slope, which moves the rate by as much as chance does. */
    variance[BEAD] *= work->first > 0 ? 2.0 : 1.0;
    for (int q = 0; q < QUANTITIES; ++q)
        if (drive->standing || work->drifts || isinf(variance[R0]))
            variance[q] = NAN;
    take_radius(work, &turns, variance, slow, measured);
    /* Of a bead that need not librate at all, compression makes lines of its own. */
    if (drive->motion == FST_MOTION_LOCKED && measured->std_r < MEASURE_OF_PIXELS * measured->mean_r)
        measured->std_r_error = fmax(measured->std_r_error, measured->std_r);
    take_rates(work, drive, variance, covariance, measured);
    for (int i = 0; i < 2; ++i) {
        measured->centre[i] = work->centre[i];
        measured->centre_error[i] = sqrt(variance[CENTRE_X + i]);
    }
    memcpy(measured->stretch, work->stretch, sizeof measured->stretch);
    measured->filmed_sense = work->bead > 0 ? 1 : -1;
    keep_waves(work, measured);
    measured->turns = measure_duration(work) * fabs(work->bead);
    if (turns.count < LEAST_TURNS)
        measure_warn(measured,
                     "the bead makes %.3g turns in this film: errors need at least %d; film it for longer",
                     measured->turns, LEAST_TURNS);
    free(turns.sum);
    return FST_OK;
}
