/* geometry.c - centre and tilt of a path, how fast the bead goes round, and the festoons.
 *
 * A camera that looks aslant shrinks the plate along one direction, and nobody knows where the axis of the
 * magnet is in the picture.  Both show in r over alpha: a wrong centre adds cos(alpha) and sin(alpha), a tilt r
 * cos(2 alpha) and r sin(2 alpha).  The festoons do neither: they oscillate with time, with f_r and its
 * multiples, whatever alpha is. So one regression tells them apart:
 *
 *   r = r0 + sum over k of (a_k cos + b_k sin)(2 pi k f0 t)
 *          + d_x cos(alpha) + d_y sin(alpha) + r u cos(2 alpha) + r v sin(2 alpha) + (change of f0)
 *
 * and Gauss-Newton's method moves centre and tilt until d, u and v vanish.  The ellipse of second moments would
 * not do: festoons have second moments too.
 *
 * r0 is then the mean over time of r itself, whatever frames are lost and wherever the film begins and ends.
 */
#include "measure/work.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/dot.h"
#include "base/error.h"
#include "base/watch.h"
#include "measure/spectrum.h"

enum { LEAST_ROWS = 16, MOST_ROUNDS = 60, LEAST_TURNS = 3 };

/* A line is small beside another one where it has no more than this part of its amplitude. */
#define HIDDEN (1.0 / 3.0)

/* ---------------------------------------------------------------- memory */

fst_status measure_work_begin(measure_work *work, fst_track *track, fst_error *error)
{
    *work = (measure_work){.track = track, .stretch = {1.0, 0.0, 1.0}, .gain = 1.0};
    work->row = malloc((track->rows + 1) * sizeof *work->row);
    work->t = malloc(9 * (track->rows + 1) * sizeof *work->t);
    if (!work->row || !work->t) {
        measure_work_free(work);
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for a track of %zu frames", track->rows);
    }
    double **const parts[] = {&work->x,     &work->y,     &work->r,      &work->alpha,
                              &work->r_off, &work->a_off, &work->scratch};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i)
        *parts[i] = work->t + (i + 1) * (track->rows + 1);
    work->fps = isfinite(track->fps) ? track->fps : 1.0;
    measure_work_take(work);
    return FST_OK;
}

void measure_work_free(measure_work *work)
{
    free(work->row);
    free(work->t);
    *work = (measure_work){.track = NULL};
}

void measure_work_take(measure_work *work)
{
    const fst_track *track = work->track;
    const int timed = isfinite(track->fps);
    work->count = 0;
    for (size_t i = work->first; i < track->rows; ++i) {
        if (track->flag[i] != FST_FRAME_SEEN)
            continue;
        work->row[work->count] = i;
        work->t[work->count] = timed ? track->t[i] : (double)(track->frame[i] - track->frame[0]);
        work->x[work->count] = track->x[i];
        work->y[work->count] = track->y[i];
        ++work->count;
    }
    const double middle = work->count > 0 ? 0.5 * (work->t[0] + work->t[work->count - 1]) : 0.0;
    for (size_t i = 0; i < work->count; ++i)
        work->t[i] -= middle;
}

double measure_duration(const measure_work *work)
{
    return work->t[work->count - 1] - work->t[0];
}

/* ---------------------------------------------------------------- the rows of the models */

/* 1, and cosine and sine of the harmonics that are fitted.  Returns the number of columns. */
static int harmonic_row(const measure_work *work, size_t i, double *row)
{
    int n = 0;
    row[n++] = 1.0;
    if (!(work->f0 > 0))
        return n;
    const double angle = FST_TWO_PI * work->f0 * work->t[i], c1 = cos(angle), s1 = sin(angle);
    double c = 1.0, s = 0.0;
    for (int k = 1; k <= work->harmonics; ++k) {
        const double turned = c * c1 - s * s1;
        s = s * c1 + c * s1;
        c = turned;
        if (work->skipped[k - 1])
            continue;
        row[n++] = c;
        row[n++] = s;
    }
    return n;
}

int measure_radial_row(const measure_work *work, size_t i, double *row)
{
    int n = harmonic_row(work, i, row);
    double slope = 0.0;
    for (int k = 1, at = 1; k <= work->harmonics && work->f0 > 0; ++k)
        if (!work->skipped[k - 1]) {
            slope +=
                k * (work->radial.coefficient[at + 1] * row[at] - work->radial.coefficient[at] * row[at + 1]);
            at += 2;
        }
    const double c = cos(work->alpha[i]), s = sin(work->alpha[i]);
    row[n++] = c;
    row[n++] = s;
    row[n++] = work->r[i] * (c * c - s * s);
    row[n++] = work->r[i] * 2 * c * s;
    row[n++] = FST_TWO_PI * work->t[i] * slope; /* by f0 */
    return n;
}

int measure_angular_row(const measure_work *work, size_t i, double *row)
{
    int n = harmonic_row(work, i, row);
    const double turned = FST_TWO_PI * work->bead * work->t[i];
    /* A shutter that rolls shows some sides of a circle later than others: over a part of a turn that looks like a rate. */
    if (work->rolls) {
        row[n++] = cos(turned);
        row[n++] = sin(turned);
    }
    row[n++] = FST_TWO_PI * work->t[i];
    return n;
}

double measure_folded(double frequency, double fps)
{
    return fabs(frequency - fps * round(frequency / fps));
}

int measure_stands(const measure_work *work, double frequency)
{
    const double apart = 1.5 / measure_duration(work), here = measure_folded(frequency, work->fps);
    if (here < apart || 0.5 * (work->fps - apart) < here)
        return 1;
    int stands = 0;
    for (int turns = 1; turns <= 2 && frequency > 0.5 * work->fps; ++turns)
        stands |= fabs(here - measure_folded(turns * work->bead, work->fps)) < apart;
    return stands;
}

/* Choose the harmonics: not more than the rows allow, and none that the frame rate hides, or maps onto another one.
 */
static void choose_harmonics(measure_work *work)
{
    const double apart = 1.5 / measure_duration(work);
    work->harmonics = MEASURE_HARMONICS;
    while (work->harmonics > 1 && (size_t)(4 * (2 * work->harmonics + 1 + MEASURE_GEOMETRY)) > work->count)
        --work->harmonics;
    for (int k = 1; k <= work->harmonics; ++k) {
        const double here = measure_folded(k * work->f0, work->fps);
        work->skipped[k - 1] = measure_stands(work, k * work->f0);
        for (int j = 1; j < k; ++j)
            if (fabs(here - measure_folded(j * work->f0, work->fps)) < apart)
                work->skipped[k - 1] = 1 + j;
    }
}

/* ---------------------------------------------------------------- one round */

/* The circle through the places, by least squares of x^2 + y^2 = 2 a x + 2 b y + c (Kasa). */
static void circle(measure_work *work)
{
    measure_regression fit;
    double mean[2] = {0, 0};
    for (size_t i = 0; i < work->count; ++i) {
        mean[0] += work->x[i] / (double)work->count;
        mean[1] += work->y[i] / (double)work->count;
    }
    measure_regression_begin(&fit, 3);
    for (size_t i = 0; i < work->count; ++i) {
        const double x = work->x[i] - mean[0], y = work->y[i] - mean[1];
        const double row[3] = {1.0, 2 * x, 2 * y};
        measure_regression_add(&fit, row, x * x + y * y);
    }
    measure_regression_solve(&fit);
    work->centre[0] = mean[0] + fit.coefficient[1];
    work->centre[1] = mean[1] + fit.coefficient[2];
}

/* The angle of a row's place about the present centre; its r is kept. */
static double angle_of(measure_work *work, size_t i)
{
    const double x = work->x[i] - work->centre[0], y = work->y[i] - work->centre[1];
    const double px = work->stretch[0] * x + work->stretch[1] * y;
    const double py = work->stretch[1] * x + work->stretch[2] * y;
    work->r[i] = sqrt(px * px + py * py);
    return atan2(py, px);
}

/* r and alpha of a row; alpha is unwrapped along the present model of it. */
static void place_row(measure_work *work, size_t i)
{
    double row[MEASURE_MOST_COLUMNS];
    const double angle = angle_of(work, i);
    (void)measure_angular_row(work, i, row);
    const double expected = measure_regression_value(&work->angular, row);
    work->alpha[i] = angle + FST_TWO_PI * round((expected - angle) / FST_TWO_PI);
}

/* r and alpha of all rows, alpha unwrapped from place to place.  0: a step is too large for that. */
static int follow(measure_work *work)
{
    double row[MEASURE_MOST_COLUMNS];
    for (size_t i = 0; i < work->count; ++i)
        work->alpha[i] = angle_of(work, i);
    (void)measure_angular_row(work, work->count / 2, row);
    return measure_follow(work, measure_regression_value(&work->angular, row));
}

static void place_rows(measure_work *work)
{
    work->followed = follow(work);
    for (size_t i = 0; i < work->count && !work->followed; ++i)
        place_row(work, i);
}

void measure_place_row(measure_work *work, size_t at, size_t i)
{
    const size_t known = work->row[0]; /* its time here says where the times of the work begin */
    const fst_track *track = work->track;
    work->t[at] = work->t[0] + (isfinite(track->fps) ? track->t[i] - track->t[known]
                                                     : (double)(track->frame[i] - track->frame[known]));
    work->x[at] = track->x[i];
    work->y[at] = track->y[i];
    place_row(work, at);
}

/* Fit the model with the rows of `row_of` to y; `off` becomes what is left over. */
static void fit_model(const measure_work *work, int (*row_of)(const measure_work *, size_t, double *),
                      const double *y, double *off, measure_regression *model)
{
    double row[MEASURE_MOST_COLUMNS];
    measure_regression fit; /* rows of r need the coefficients that are known so far */
    measure_regression_begin(&fit, row_of(work, 0, row));
    for (size_t i = 0; i < work->count; ++i) {
        (void)row_of(work, i, row);
        measure_regression_add(&fit, row, y[i]);
    }
    measure_regression_solve(&fit);
    for (size_t i = 0; i < work->count; ++i) {
        (void)row_of(work, i, row);
        off[i] = y[i] - measure_regression_value(&fit, row);
    }
    *model = fit;
}

/* The slope of the model of alpha is the bead's rate. */
static void fit_angular(measure_work *work)
{
    fit_model(work, measure_angular_row, work->alpha, work->a_off, &work->angular);
    work->bead = work->angular.coefficient[work->angular.columns - 1];
}

static void fit_radial(measure_work *work)
{
    fit_model(work, measure_radial_row, work->r, work->r_off, &work->radial);
}

/* Take (I - S) M, S = (u, v; v, -u), as the new matrix; made symmetric by leaving out the rotation that it
 * holds, and scaled so that the direction that the camera does not shrink keeps its length. */
static void stretch_by(double m[3], double u, double v)
{
    const double a = (1 - u) * m[0] - v * m[1], b = (1 - u) * m[1] - v * m[2];
    const double c = -v * m[0] + (1 + u) * m[1], d = -v * m[1] + (1 + u) * m[2];
    const double xx = a * a + c * c, xy = a * b + c * d, yy = b * b + d * d; /* its transpose times itself */
    const double root = fabs(a * d - b * c), scale = sqrt(xx + yy + 2 * root);
    const double p = (xx + root) / scale, q = xy / scale, r = (yy + root) / scale; /* the square root of that */
    const double least = 0.5 * (p + r) - sqrt(0.25 * (p - r) * (p - r) + q * q);
    m[0] = p / least;
    m[1] = q / least;
    m[2] = r / least;
}

/* Move centre and tilt by what the regression found.  Returns the size of the move, over r. */
static double move(measure_work *work)
{
    const int n = work->radial.columns;
    const double *found = work->radial.coefficient + n - MEASURE_GEOMETRY, *m = work->stretch;
    const double det = m[0] * m[2] - m[1] * m[1], r0 = work->radial.coefficient[0];
    double dx = found[MEASURE_CENTRE_X], dy = found[MEASURE_CENTRE_Y];
    const double far = sqrt(dx * dx + dy * dy) / (0.3 * fabs(r0));
    if (far > 1.0) { /* too far for a linear step */
        dx /= far;
        dy /= far;
    }
    work->centre[0] += (m[2] * dx - m[1] * dy) / det;
    work->centre[1] += (m[0] * dy - m[1] * dx) / det;
    double u = found[MEASURE_TILT_C], v = found[MEASURE_TILT_S];
    const double size = sqrt(u * u + v * v), most = 0.1;
    if (size > most) {
        u *= most / size;
        v *= most / size;
    }
    stretch_by(work->stretch, u, v);
    if (work->f0 > 0)
        work->f0 += found[MEASURE_SLOPE];
    return fmax(fabs(dx) + fabs(dy), r0 * size) / r0;
}

/* Where the harmonic k stands among the columns of the model of r. */
static int place_of_line(const measure_work *work, int k)
{
    int at = 1;
    for (int j = 1; j < k; ++j)
        at += work->skipped[j - 1] ? 0 : 2;
    return at;
}

double measure_line_size(const measure_work *work, int k, double *least)
{
    *least = INFINITY;
    if (work->skipped[k - 1])
        return 0.0;
    const int at = place_of_line(work, k);
    const double square = fst_dot(work->r_off, work->r_off, (int)work->count);
    const double variance = square / (double)(work->count - (size_t)work->radial.columns);
    const double *c = work->radial.coefficient + at;
    *least = 5.0 * sqrt(variance * (work->radial.inverse[at][at] + work->radial.inverse[at + 1][at + 1]));
    return sqrt(c[0] * c[0] + c[1] * c[1]);
}

int measure_has_line(const measure_work *work, int k)
{
    double least;
    return measure_line_size(work, k, &least) > least;
}

int measure_may_hide_line(const measure_work *work, int k, int behind)
{
    double hidden, least;
    const double seen = measure_line_size(work, behind, &least);
    (void)measure_line_size(work, k, &hidden);
    return hidden > HIDDEN * seen;
}

int measure_line_is_blended(const measure_work *work)
{
    double least;
    const double small = HIDDEN * measure_line_size(work, 2, &least);
    for (int k = 3; k <= work->harmonics; ++k)
        if (work->skipped[k - 1] == 2)
            return measure_line_size(work, 1, &least) < small;
    return 0;
}

/* The amplitude in the rows from first to last, by correlation: the model's line with what the model leaves there. */
static double line_between(const measure_work *work, int k, size_t first, size_t last)
{
    double row[MEASURE_MOST_COLUMNS], sums[2] = {0, 0};
    const int at = place_of_line(work, k);
    const double *c = work->radial.coefficient + at;
    for (size_t i = first; i < last; ++i) {
        (void)measure_radial_row(work, i, row);
        const double value = work->r_off[i] + c[0] * row[at] + c[1] * row[at + 1];
        sums[0] += row[at] * value;
        sums[1] += row[at + 1] * value;
    }
    return 2.0 * sqrt(sums[0] * sums[0] + sums[1] * sums[1]) / (double)(last - first);
}

int measure_line_dies(const measure_work *work, int k)
{
    const size_t third = work->count / 3;
    return !work->skipped[k - 1] && third > 0 &&
           line_between(work, k, work->count - third, work->count) < 0.5 * line_between(work, k, 0, third);
}

/* ---------------------------------------------------------------- what is left over */

int measure_neighbours(const measure_work *work, size_t i)
{
    return work->t[i + 1] - work->t[i] < 1.5 / work->fps;
}

double measure_hanging_together(const measure_work *work, const double *off)
{
    double sum = 0.0, pairs = 0.0;
    for (size_t i = 0; i + 1 < work->count; ++i)
        if (measure_neighbours(work, i)) {
            sum += off[i] * off[i + 1];
            pairs += 1.0;
        }
    const double square = fst_dot(off, off, (int)work->count) / (double)work->count;
    const double rho = pairs > 0 && square > 0 ? sum / pairs / square : 0.0;
    return rho * sqrt(pairs) > 3.0 ? (1.0 + rho) / (1.0 - fmin(rho, 0.98)) : 1.0;
}

/* ---------------------------------------------------------------- the motion */

/* Start: the centre of the circle, and the strongest line of the places as complex numbers. */
static fst_status begin_motion(measure_work *work, fst_error *error)
{
    circle(work);
    for (size_t i = 0; i < work->count; ++i) {
        work->r_off[i] = work->x[i] - work->centre[0];
        work->a_off[i] = work->y[i] - work->centre[1];
    }
    const measure_series places = {work->t, work->r_off, work->a_off, work->count, work->fps};
    measure_line line;
    const fst_status status = measure_strongest_line(&places, 0.4 / measure_duration(work), &line, error);
    if (status != FST_OK)
        return status;
    if (!(line.power > line.limit))
        return fst_fail(
            error, FST_NO_CONVERGENCE, "",
            "the bead does not go round: its places scatter about one point, as those of a resting bead do");
    work->bead = line.frequency;
    measure_regression_begin(&work->angular, 1);
    if (follow(work))
        work->bead = (work->alpha[work->count - 1] - work->alpha[0]) / (FST_TWO_PI * measure_duration(work));
    if (fabs(work->bead) * measure_duration(work) < 0.9)
        return fst_fail(error, FST_NO_CONVERGENCE, "",
                        "the bead rests, or makes less than one turn in the film (%.2g turns): film it for at "
                        "least ten turns",
                        fabs(work->bead) * measure_duration(work));
    double sum[2];
    measure_wave(&places, work->bead, sum);
    measure_regression_begin(&work->angular, 2);
    work->angular.coefficient[0] = atan2(sum[1], sum[0]);
    work->angular.coefficient[1] = work->bead;
    return FST_OK;
}

/* Rounds until centre and tilt move no more, with the harmonics of work->f0, or without any. */
fst_status measure_refine_motion(measure_work *work, fst_error *error)
{
    work->radial = (measure_regression){.columns = 0};
    if (work->f0 > 0)
        choose_harmonics(work);
    work->rolls = !(work->f0 > 0) && fabs(work->bead) * measure_duration(work) > LEAST_TURNS;
    double row[MEASURE_MOST_COLUMNS];
    /* The model of alpha so far has other columns: keep its line, drop the rest. */
    const double phase = work->angular.coefficient[0], rate = work->bead;
    measure_regression_begin(&work->angular, measure_angular_row(work, 0, row));
    work->angular.coefficient[0] = phase;
    work->angular.coefficient[work->angular.columns - 1] = rate;
    for (int round = 0; round < MOST_ROUNDS; ++round) {
        /* How many rounds there will be is not known: some forty are usual. */
        const fst_status told = fst_tell(work->progress, work->rounds / (work->rounds + 10.0), NULL, error);
        if (told != FST_OK)
            return told;
        work->rounds += 1.0;
        place_rows(work);
        fit_angular(work);
        fit_radial(work);
        const double moved = move(work);
        const double wide = work->stretch[0] + work->stretch[2];
        if (!isfinite(moved) || wide > 8.0)
            return fst_fail(error, FST_NO_CONVERGENCE, "",
                            "these places lie on no circle, seen straight or aslant: is it one bead that was "
                            "followed, and does it circle?");
        if (moved < 1e-9 && round > 2)
            break;
    }
    return FST_OK;
}

/* Whether the radii are those of a circle but for rounding errors, in which no line means anything. */
static int is_exact_circle(const measure_work *work)
{
    double off = 0.0, all = 0.0;
    for (size_t i = 0; i < work->count; ++i) {
        off += work->r_off[i] * work->r_off[i];
        all += work->r[i] * work->r[i];
    }
    return off < 1e-26 * all;
}

double measure_least_line(const measure_work *work)
{
    return fmax(0.6 * fabs(work->bead), 2.0 / measure_duration(work));
}

/* Whether a line of this frequency in r comes once more in each turn of the bead, but for the film's length. */
static int repeats_each_turn(const measure_work *work, double line)
{
    const double apart = 1.5 / measure_duration(work), bead = fabs(work->bead);
    for (int k = 1; k * bead < work->fps; ++k)
        if (fabs(measure_folded(k * bead, work->fps) - line) < apart)
            return 1;
    return 0;
}

/* Look for the line of the festoons in what a model without them leaves of r.  A bead that goes round on one circle meets
 * the same pixels in each turn, and the errors of its places are the same: a line that is as small as these, and repeats with
 * the turns, tells of no festoons, and beside it the tilt could not be told. */
static fst_status find_peak(measure_work *work, fst_error *error)
{
    work->peak = work->unsure = 0.0;
    if (is_exact_circle(work))
        return FST_OK;
    const measure_series radii = {work->t, work->r_off, NULL, work->count, work->fps};
    measure_line line;
    const fst_status status = measure_strongest_line(&radii, measure_least_line(work), &line, error);
    if (status != FST_OK || !(line.power > line.limit))
        return status;
    double sum[2];
    measure_wave(&radii, line.frequency, sum);
    const double size = 2.0 * sqrt(fst_dot(sum, sum, 2)) / (double)work->count;
    if (size < MEASURE_OF_PIXELS * work->radial.coefficient[0] && repeats_each_turn(work, line.frequency))
        work->unsure = size;
    else
        work->peak = line.frequency;
    return status;
}

/* Residuals of r without the festoons, at the centre and tilt that were found with them. */
static void hide_festoons(measure_work *work)
{
    const double f0 = work->f0;
    work->f0 = 0.0;
    work->radial = (measure_regression){.columns = 0};
    fit_radial(work);
    work->f0 = f0;
}

fst_status measure_find_motion(measure_work *work, fst_error *error)
{
    if (work->count < LEAST_ROWS)
        return fst_fail(error, FST_NO_CONVERGENCE, "", "%zu places of the bead: at least %d are needed",
                        work->count, LEAST_ROWS);
    fst_status status = begin_motion(work, error);
    work->f0 = 0.0;
    if (status == FST_OK)
        status = measure_refine_motion(work, error);
    /* Where the festoons were found, centre and tilt are known better, and show the line better. */
    for (int again = 0; again < 2 && status == FST_OK; ++again) {
        if (again > 0)
            hide_festoons(work);
        status = find_peak(work, error);
        work->f0 = 0.5 * work->peak;
        if (status == FST_OK)
            status = measure_refine_motion(work, error);
        work->half = status == FST_OK && work->peak > 0 && measure_has_line(work, 1);
    }
    return status;
}
