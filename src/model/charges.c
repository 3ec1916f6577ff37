/* charges.c - the fit of equivalent charges to the samples of a map, and its errors.
 *
 * Samples y = M q + noise, with strengths q that are taken as random, of one variance s^2, beforehand.  Then the
 * likeliest strengths minimise |y - M q|^2 + ridge |q|^2 (Tikhonov), ridge = noise^2/s^2, and their covariance is
 * noise^2 (M'M + ridge)^-1.  The samples themselves say which ridge, noise and depth are likely, by the evidence
 *
 *     -2 log P(y) = Q/noise^2 + N log noise^2 + log det(1 + M M'/ridge),   Q = y'y - y'M (M'M + ridge)^-1 M'y
 *
 * (MacKay, Neural Computation 4 (1992) 415; Wahba, Spline Models for Observational Data, chapter 5, says why these
 * errors cover the truth).  At the likeliest noise Q/N what is left of the samples has the size of the noise, which
 * is the principle of discrepancy.
 *
 * A probe whose axes are turned by T shows y = T'B + offset.  T y then enters in place of y: Q is a form of second
 * degree in T's nine elements, and is minimised over three angles by Newton's method; offsets are columns of M.
 */
#include "model/charges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"

static const char PLACE[] = "fst_field_map_smooth";

/* Noise below 1e-5 of the field is lost in the rounding of these sums, and of files. */
static const double LEAST_Q = 1e-10;

/* ------------------------------------------------------------------ Cholesky */

/* The upper half of a (n x n by rows) becomes R, R'R = a; returns log det a, or NAN. */
static double factor(int n, double *a)
{
    double log_det = 0.0;
    for (int i = 0; i < n; ++i) {
        double *row = &a[(size_t)i * (size_t)n];
        for (int k = 0; k < i; ++k) {
            const double *above = &a[(size_t)k * (size_t)n], f = above[i];
            for (int j = i; j < n; ++j)
                row[j] -= f * above[j];
        }
        if (!(row[i] > 0))
            return NAN;
        log_det += log(row[i]);
        const double scale = 1.0 / sqrt(row[i]);
        for (int j = i; j < n; ++j)
            row[j] *= scale;
    }
    return log_det;
}

/* Each of `many` x becomes R'^-1 x; the first `from` numbers of all are zero. */
static void solve_lower(int n, const double *r, double *x, int many, int from)
{
    for (int k = from; k < n; ++k) {
        const double *row = &r[(size_t)k * (size_t)n];
        for (int m = 0; m < many; ++m) {
            double *to = &x[m * n];
            const double f = to[k] /= row[k];
            for (int j = k + 1; j < n; ++j)
                to[j] -= f * row[j];
        }
    }
}

/* x becomes R^-1 x. */
static void solve_upper(int n, const double *r, double *x)
{
    for (int i = n - 1; i >= 0; --i) {
        const double *row = &r[(size_t)i * (size_t)n];
        for (int j = i + 1; j < n; ++j)
            x[i] -= row[j] * x[j];
        x[i] /= row[i];
    }
}

static double dot(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

/* ------------------------------------------------------------------ the probe's angles */

/* The rotation by a vector of angles (Rodrigues). */
static void rotation(const double angles[3], double t[9])
{
    const double angle = sqrt(dot(3, angles, angles)), x = angles[0], y = angles[1], z = angles[2];
    const double s = angle > 0 ? sin(angle) / angle : 1.0, half = sin(0.5 * angle);
    const double c = angle > 0 ? 2.0 * half * half / (angle * angle) : 0.5;
    const double cross[9] = {0, -z, y, z, 0, -x, -y, x, 0};
    for (int i = 0; i < 9; ++i)
        t[i] = (i % 4 ? 0.0 : 1.0 - c * angle * angle) + s * cross[i] + c * angles[i / 3] * angles[i % 3];
}

/* The form T' H T at these angles, H 9 x 9. */
static double explained(const double *h, const double angles[3])
{
    double t[9], sum = 0.0;
    rotation(angles, t);
    for (int i = 0; i < 9; ++i)
        sum += t[i] * dot(9, &h[9 * i], t);
    return sum;
}

static const double ANGLE = 1e-3; /* rad: differences of a form of second degree are exact to its square */

static double shifted(const double *h, const double angles[3], int i, double by_i, int k, double by_k)
{
    double at[3] = {angles[0], angles[1], angles[2]};
    at[i] += by_i * ANGLE;
    at[k] += by_k * ANGLE;
    return explained(h, at);
}

/* Half the second derivatives of -explained, inverted; 0 where that is no maximum. */
static int curvature(const double *h, const double angles[3], double slope[3], double inverse[3][3])
{
    double r[9], here = explained(h, angles);
    for (int i = 0; i < 3; ++i) {
        const double more = shifted(h, angles, i, 1, i, 0), less = shifted(h, angles, i, -1, i, 0);
        slope[i] = 0.25 * (more - less) / ANGLE;
        r[4 * i] = -0.5 * (more - 2.0 * here + less) / (ANGLE * ANGLE);
        for (int k = 0; k < i; ++k)
            r[3 * k + i] = r[3 * i + k] = -0.125 *
                                          (shifted(h, angles, i, 1, k, 1) - shifted(h, angles, i, 1, k, -1) -
                                           shifted(h, angles, i, -1, k, 1) + shifted(h, angles, i, -1, k, -1)) /
                                          (ANGLE * ANGLE);
    }
    if (isnan(factor(3, r)))
        return 0;
    for (int i = 0; i < 3; ++i) {
        memset(inverse[i], 0, sizeof inverse[i]);
        inverse[i][i] = 1.0;
        solve_lower(3, r, inverse[i], 1, 0);
        solve_upper(3, r, inverse[i]);
    }
    return 1;
}

/* Newton's method; the angles stay where there is no maximum. */
static int find_angles(const double *h, double angles[3], double inverse[3][3])
{
    enum { MOST_STEPS = 12 };
    for (int step = 0; step < MOST_STEPS; ++step) {
        double slope[3], change = 0.0;
        if (!curvature(h, angles, slope, inverse))
            return 0;
        for (int i = 0; i < 3; ++i) {
            const double by = dot(3, inverse[i], slope);
            angles[i] += by;
            change = fmax(change, fabs(by));
        }
        if (!(change < 0.5)) /* rad: nothing like a small error of a probe */
            return 0;
        if (change < 1e-9)
            return curvature(h, angles, slope, inverse);
    }
    return 0;
}

/* ------------------------------------------------------------------ the evidence of a ridge */

typedef struct attempt {
    const charge_sums *sums;
    const fst_smoothing *how;
    fst_charges *charges;
    double *work;                      /* for nine right-hand sides of a class */
    double evidence, q, noise2, ridge; /* evidence: -2 log P, the smaller the likelier */
    double angles[3], inverse[3][3];
    int settled; /* whether angles were found, where they are wanted */
} attempt;

/* Factor the normal matrices with this ridge, and judge it. */
static double try_ridge(attempt *a, double log_ridge)
{
    const int n = charge_columns(&a->charges->sites);
    const double ridge = exp(log_ridge);
    double h[81] = {0}, log_det = 0.0;
    for (int c = 0; c < CHARGE_CLASSES; ++c) {
        double *r = a->charges->factor[c];
        memcpy(r, a->sums->normal[c], (size_t)n * (size_t)n * sizeof *r);
        for (int i = 0; i < n; ++i)
            r[(size_t)i * (size_t)n + (size_t)i] += ridge;
        log_det += factor(n, r) - n * log_ridge;
        memcpy(a->work, &a->sums->right[c * 9 * n], 9 * (size_t)n * sizeof *a->work);
        solve_lower(n, r, a->work, 9, 0);
        for (int i = 0; i < 9; ++i)
            for (int k = 0; k <= i; ++k)
                h[9 * i + k] += dot(n, &a->work[i * n], &a->work[k * n]);
    }
    for (int i = 0; i < 9; ++i)
        for (int k = i + 1; k < 9; ++k)
            h[9 * i + k] = h[9 * k + i];
    a->settled = !a->how->probe || find_angles(h, a->angles, a->inverse);
    a->ridge = ridge;
    a->q = fmax(a->sums->square - explained(h, a->angles), LEAST_Q * a->sums->square);
    a->noise2 = isnan(a->how->noise) ? a->q / a->sums->count : a->how->noise * a->how->noise;
    a->evidence = a->q / a->noise2 + a->sums->count * log(a->noise2) + log_det;
    return isfinite(a->evidence) ? a->evidence : INFINITY;
}

/* The likeliest ridge, by golden sections. */
static fst_status find_ridge(attempt *a, const fst_progress *progress, fst_error *error)
{
    const int n = charge_columns(&a->charges->sites);
    const double golden = 0.5 * (sqrt(5.0) - 1.0);
    double mean = 0.0;
    for (int c = 0; c < CHARGE_CLASSES; ++c)
        for (int i = 0; i < a->charges->sites.count; ++i)
            mean +=
                a->sums->normal[c][(size_t)i * (size_t)(n + 1)] / (CHARGE_CLASSES * a->charges->sites.count);
    double low = log(1e-13 * mean), high = log(10.0 * mean);
    double at[2] = {high - golden * (high - low), low + golden * (high - low)};
    double value[2] = {try_ridge(a, at[0]), try_ridge(a, at[1])};
    fst_status status = FST_OK;
    while (high - low > 0.1 && status == FST_OK) {
        const int right = value[1] < value[0]; /* which of the two stays within */
        *(right ? &low : &high) = at[!right];
        at[!right] = at[right];
        value[!right] = value[right];
        at[right] = right ? low + golden * (high - low) : high - golden * (high - low);
        value[right] = try_ridge(a, at[right]);
        status = fst_tell(progress, 1.0, "fitting charges", error);
    }
    (void)try_ridge(a, 0.5 * (low + high));
    return status;
}

/* ------------------------------------------------------------------ the solution */

/* Solve for the strengths that belong to the matrix T of the samples. */
static void solve(const attempt *a, const double t[9], double *strength)
{
    const int n = charge_columns(&a->charges->sites);
    for (int c = 0; c < CHARGE_CLASSES; ++c) {
        double *x = &strength[c * n];
        memset(x, 0, (size_t)n * sizeof *x);
        for (int ab = 0; ab < 9; ++ab)
            for (int i = 0; i < n; ++i)
                x[i] += t[ab] * a->sums->right[(c * 9 + ab) * n + i];
        solve_lower(n, a->charges->factor[c], x, 1, 0);
        solve_upper(n, a->charges->factor[c], x);
    }
}

/* Numbers of the fit: what is left of the samples, and how many unknowns they determine. */
static void count_freedom(const attempt *a, fst_map_fit *fit)
{
    const fst_charges *charges = a->charges;
    const int n = charge_columns(&charges->sites);
    double used = a->how->probe ? 3.0 : 0.0;
    for (int c = 0; c < CHARGE_CLASSES; ++c) {
        used += n;
        for (int k = 0; k < n; ++k) {
            memset(a->work, 0, (size_t)n * sizeof *a->work);
            a->work[k] = 1.0;
            solve_lower(n, charges->factor[c], a->work, 1, k);
            used -= a->ridge * dot(n - k, &a->work[k], &a->work[k]);
        }
    }
    fit->free = a->sums->count - used;
    /* Q = |y - M q|^2 + ridge |q|^2 */
    const double left = a->q - a->ridge * dot(CHARGE_CLASSES * n, charges->strength, charges->strength);
    fit->rms = sqrt(fmax(left, 0.0) / a->sums->count);
}

/* What the probe shows in no field, on its own axes, and how it is turned.  The angles are three of hundreds of
 * unknowns: their errors add next to nothing to the others. */
static void tell_probe(const attempt *a, const double t[9], fst_map_fit *fit)
{
    const fst_charges *charges = a->charges;
    const int n = charge_columns(&charges->sites);
    const double unit = charges->sites.unit;
    for (int k = 0; k < 3; ++k) {
        const int c = (k + 1) % 3; /* the class of an offset along the axis k */
        const double fitted = unit * charges->strength[c * n + n - 1];
        const double error = unit * fit->noise / charges->factor[c][(size_t)n * (size_t)n - 1];
        for (int i = 0; i < 3; ++i) { /* T' */
            fit->offset[i] += t[3 * k + i] * fitted;
            fit->offset_error[i] = hypot(fit->offset_error[i], t[3 * k + i] * error);
        }
        fit->turned[k] = a->angles[k];
        fit->turned_error[k] = fit->noise * sqrt(a->inverse[k][k]);
    }
}

static void conclude(attempt *a)
{
    fst_charges *charges = a->charges;
    fst_map_fit *fit = &charges->fit;
    double t[9];
    rotation(a->angles, t);
    solve(a, t, charges->strength);
    count_freedom(a, fit);
    const double left2 = fit->rms * fit->rms * a->sums->count / fmax(fit->free, 1.0);
    /* Noise that was told too small, or charges that fit badly: what is left is the error then. */
    a->noise2 = fmax(a->noise2, left2);
    fit->noise = sqrt(a->noise2);
    const double known = isnan(a->how->noise) ? fit->rough : a->how->noise;
    fit->chi2 = left2 / (known * known);
    fit->charges = CHARGE_CLASSES * charges->sites.count;
    fit->depth = charges->sites.depth;
    if (a->how->probe)
        tell_probe(a, t, fit);
}

/* ------------------------------------------------------------------ the fit */

void fst_charges_free(fst_charges *charges)
{
    if (!charges)
        return;
    charge_sites_free(&charges->sites);
    for (int c = 0; c < CHARGE_CLASSES; ++c)
        free(charges->factor[c]);
    free(charges->strength);
    free(charges);
}

static fst_charges *new_charges(const fst_field_map *map, const fst_smoothing *how, double depth)
{
    fst_charges *charges = calloc(1, sizeof *charges);
    int whole = charges && charge_sites_make(map, how, depth, &charges->sites) == FST_OK;
    const size_t n = whole ? (size_t)charge_columns(&charges->sites) : 0;
    if (whole)
        charges->strength = calloc(CHARGE_CLASSES * n, sizeof *charges->strength);
    whole = whole && charges->strength;
    for (int c = 0; c < CHARGE_CLASSES && whole; ++c) {
        charges->factor[c] = calloc(n * n, sizeof **charges->factor);
        whole = charges->factor[c] != NULL;
    }
    if (whole)
        return charges;
    fst_charges_free(charges);
    return NULL;
}

/* The noise by sixth differences along x and y, of which a smooth field has nearly none. */
static double rough_noise(const fst_field_map *map)
{
    static const double difference[7] = {1, -6, 15, -20, 15, -6, 1};
    const fst_field_map_facts facts = fst_field_map_describe(map);
    double sum = 0.0, count = 0.0;
    for (int k = 0; k < facts.count[2]; ++k)
        for (int axis = 0; axis < 2; ++axis)
            for (int j = 0; j < facts.count[1] - (axis ? 6 : 0); ++j)
                for (int i = 0; i < facts.count[0] - (axis ? 0 : 6); ++i) {
                    double b[3], d[3] = {0};
                    for (int m = 0; m < 7; ++m) {
                        fst_map_sample(fst_map_plane_number(map, k), axis ? i : i + m, axis ? j + m : j, b);
                        for (int c = 0; c < 3; ++c)
                            d[c] += difference[m] * b[c];
                    }
                    sum += dot(3, d, d) / 924.0; /* 924: the sum of the squares of the weights */
                    count += 3.0;
                }
    return sqrt(sum / count);
}

/* Fit charges at one depth.  *found: what became of it. */
static fst_status fit_at(const fst_field_map *map, const fst_smoothing *how, double depth, attempt *found,
                         const fst_progress *progress, fst_error *error)
{
    charge_sums sums = {.right = NULL};
    *found = (attempt){.how = how, .charges = new_charges(map, how, depth), .sums = &sums};
    const size_t n = found->charges ? (size_t)charge_columns(&found->charges->sites) : 0;
    found->work = calloc(9 * n, sizeof *found->work);
    fst_status status = found->charges && found->work
                            ? charge_sums_make(map, &found->charges->sites, progress, &sums, error)
                            : FST_NO_MEMORY;
    if (status == FST_OK)
        status = find_ridge(found, progress, error);
    if (status == FST_OK && found->settled) {
        found->charges->fit.rough = rough_noise(map);
        conclude(found);
    }
    charge_sums_free(&sums);
    free(found->work);
    if (status == FST_NO_MEMORY)
        (void)fst_fail(error, FST_NO_MEMORY, PLACE, "no memory for charges %g mm below the map", 1e3 * depth);
    return status;
}

/* From deep charges to shallow ones, each time by the square root of 2, until the evidence falls.  The first depth
 * beyond the likeliest is taken: magnets have edges, which charges of one strength everywhere do not expect, and
 * slightly shallow charges tell errors that cover these too (tests/model/test_smoothed.c). */
fst_status fst_charges_fit(const fst_field_map *map, const fst_smoothing *how, const fst_progress *progress,
                           fst_charges **out, fst_error *error)
{
    enum { MOST_DEPTHS = 8, MOST_COLUMNS = 1000 }; /* seconds for each ridge that is tried */
    const fst_field_map_facts facts = fst_field_map_describe(map);
    const double step = fmin(facts.spacing[0], facts.spacing[1]);
    double depth = fmin((facts.count[0] - 1) * facts.spacing[0], (facts.count[1] - 1) * facts.spacing[1]) / 3.0;
    double evidence = INFINITY;
    attempt now = {.evidence = INFINITY};
    fst_status status = FST_OK;
    *out = NULL;
    for (int i = 0; i < MOST_DEPTHS && status == FST_OK && depth >= step; ++i, depth *= sqrt(0.5)) {
        const fst_part part = {progress, (double)i / MOST_DEPTHS, (i + 1.0) / MOST_DEPTHS, NULL};
        const fst_progress told = {(void *)(uintptr_t)&part, fst_part_tell};
        if (charge_sites_count(map, how, depth) > MOST_COLUMNS)
            break;
        fst_charges_free(now.charges);
        status = fit_at(map, how, depth, &now, &told, error);
        if (now.evidence > evidence)
            break;
        evidence = now.settled ? now.evidence : INFINITY;
    }
    if (status == FST_OK && !now.charges)
        status =
            fst_fail(error, FST_BAD_INPUT, PLACE,
                     "the map of %d x %d samples is so long and narrow that too many charges would have to lie "
                     "below it: smooth a part that is less so",
                     facts.count[0], facts.count[1]);
    else if (status == FST_OK && !now.settled)
        status = fst_fail(error, FST_BAD_INPUT, PLACE,
                          "the map does not tell how the probe was turned: its field has too little shape, or "
                          "columns or axes are exchanged");
    if (status == FST_OK)
        *out = now.charges;
    else
        fst_charges_free(now.charges);
    return status;
}

/* ------------------------------------------------------------------ the field of the charges */

double *fst_charges_room(const fst_charges *charges)
{
    return calloc((size_t)(CHARGE_CLASSES * CHARGE_VALUES * charge_columns(&charges->sites)), sizeof(double));
}

void fst_charges_look(const fst_charges *charges, const double place[3], int values, double *room, double *out,
                      double *covariance)
{
    const int n = charge_columns(&charges->sites);
    for (int i = 0; i < values * values && covariance; ++i)
        covariance[i] = 0.0;
    charge_rows(&charges->sites, place, values, room);
    for (int v = 0; v < values; ++v)
        out[v] = 0.0;
    for (int c = 0; c < CHARGE_CLASSES; ++c) {
        double *rows = &room[c * CHARGE_VALUES * n];
        for (int v = 0; v < values; ++v) {
            if (charges->sites.offset)
                rows[v * n + n - 1] = 0.0; /* the probe's, and not the field's */
            out[v] += dot(n, &rows[v * n], &charges->strength[c * n]);
        }
        if (covariance)
            solve_lower(n, charges->factor[c], rows, values, 0);
        for (int i = 0; i < values * values && covariance; ++i)
            covariance[i] +=
                charges->fit.noise * charges->fit.noise * dot(n, &rows[i / values * n], &rows[i % values * n]);
    }
}
