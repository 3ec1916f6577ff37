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
 * Half of Q's second derivatives by the angles are Schur's complement S of their block, so that strengths and angles
 * together have the covariance noise^2 ((M'M + ridge)^-1 + G S^-1 G'), G the change of the strengths with the angles.
 */
#include "model/charges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"
#include "model/cholesky.h"

static const char PLACE[] = "fst_field_map_smooth";

/* Noise below 1e-5 of the field is lost in the rounding of these sums, and of files. */
static const double LEAST_Q = 1e-10;

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

/* Half the second derivatives of -explained, inverted; 0 where that is not a maximum. */
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

/* chi^2 over its degrees of freedom, below which it is with the probability that z standard deviations have in a
 * normal distribution, by Wilson and Hilferty. */
static double quantile_of_chi2(double freedom, double z)
{
    const double spread = 2.0 / (9.0 * freedom), root = 1.0 - spread + z * sqrt(spread);
    return root * root * root;
}

/* Numbers of the fit: what is left of the samples, and how many unknowns they determine.  The fitted samples are H y,
 * and y = noise (1 - H)^-1/2 z with normal z, if fields are as they were taken beforehand.  What is left is (1 - H) y,
 * so that its square is noise^2 z'(1 - H) z: on the average noise^2 tr(1 - H), and spread about that nearly as chi^2
 * of tr(1 - H)^2/tr((1 - H)^2) degrees of freedom. */
static void count_freedom(const attempt *a, fst_map_fit *fit)
{
    static const double Z = 1.959963985; /* 95 % are nearer to the mean */
    const fst_charges *charges = a->charges;
    const int n = charge_columns(&charges->sites);
    double used = a->how->probe ? 3.0 : 0.0, square = a->sums->count - used;
    for (int c = 0; c < CHARGE_CLASSES; ++c) {
        used += n;
        square -= n;
        for (int k = 0; k < n; ++k) {
            memset(a->work, 0, (size_t)n * sizeof *a->work);
            a->work[k] = 1.0;
            solve_lower(n, charges->factor[c], a->work, 1, k);
            used -= a->ridge * dot(n - k, &a->work[k], &a->work[k]);
            solve_upper(n, charges->factor[c], a->work);
            square += a->ridge * a->ridge * dot(n, a->work, a->work);
        }
    }
    fit->free = a->sums->count - used;
    /* A field may be smoother than was taken beforehand: then it leaves noise^2 tr((1 - H)^2) at the least. */
    const double degrees = fit->free * fit->free / square;
    fit->bound[0] = square / fit->free * quantile_of_chi2(degrees, -Z);
    fit->bound[1] = quantile_of_chi2(degrees, Z);
    /* Q = |y - M q|^2 + ridge |q|^2 */
    const double left = a->q - a->ridge * dot(CHARGE_CLASSES * n, charges->strength, charges->strength);
    fit->rms = sqrt(fmax(left, 0.0) / a->sums->count);
}

/* How the strengths go with the angles.  The angles' covariance is noise^2 times the inverse of Schur's complement,
 * L L', whose columns are three combinations of angles that know nothing of each other, an error each.  *change: of T
 * with each of them. */
static void turn_strengths(const attempt *a, double change[3][9])
{
    const int all = CHARGE_CLASSES * charge_columns(&a->charges->sites);
    double l[9];
    memcpy(l, a->inverse, sizeof l);
    (void)factor(3, l);
    for (int j = 0; j < 3; ++j) {
        const double *along = &l[3 * j]; /* of which the first j numbers are those of a lower half: none */
        const double step = ANGLE / sqrt(dot(3 - j, along + j, along + j));
        double sides[2][9];
        for (int side = 0; side < 2; ++side) {
            double angles[3] = {a->angles[0], a->angles[1], a->angles[2]};
            for (int k = j; k < 3; ++k)
                angles[k] += (side ? step : -step) * along[k];
            rotation(angles, sides[side]);
        }
        for (int i = 0; i < 9; ++i)
            change[j][i] = 0.5 * (sides[1][i] - sides[0][i]) / step;
        solve(a, change[j], &a->charges->turning[j * all]);
    }
}

/* What the probe shows in no field, on its own axes, and how it is turned. */
static void tell_probe(const attempt *a, const double t[9], fst_map_fit *fit)
{
    const fst_charges *charges = a->charges;
    const int n = charge_columns(&charges->sites);
    const double unit = charges->sites.unit;
    double change[3][9], with_angles[3][3] = {{0}};
    turn_strengths(a, change);
    for (int k = 0; k < 3; ++k) {
        const int c = (k + 1) % 3,
                  at = c * n + n - 1; /* the class of an offset along the axis k, and its place */
        const double fitted = unit * charges->strength[at];
        const double error = unit * fit->noise / charges->factor[c][(size_t)n * (size_t)n - 1];
        for (int i = 0; i < 3; ++i) { /* T' */
            fit->offset[i] += t[3 * k + i] * fitted;
            fit->offset_error[i] = hypot(fit->offset_error[i], t[3 * k + i] * error);
            for (int j = 0; j < 3; ++j)
                with_angles[j][i] += change[j][3 * k + i] * fitted +
                                     t[3 * k + i] * unit * charges->turning[j * CHARGE_CLASSES * n + at];
        }
        fit->turned[k] = a->angles[k];
        fit->turned_error[k] = fit->noise * sqrt(a->inverse[k][k]);
    }
    for (int i = 0; i < 9; ++i)
        fit->offset_error[i % 3] = hypot(fit->offset_error[i % 3], fit->noise * with_angles[i / 3][i % 3]);
}

/* The square of what is left of a component, over its degrees of freedom, T^2. */
static double left_of(const attempt *a, const fst_map_fit *fit)
{
    return fit->rms * fit->rms * a->sums->count / fmax(fit->free, 1.0);
}

/* Whether the noise told agrees with what is left. */
static void judge_noise(fst_map_fit *fit, double left2)
{
    static const double MORE =
        1.2; /* than neighbours' differences tell of noise, which they do to a few per cent */
    fit->seen[0] = sqrt(left2);
    for (int side = 0; side < 2; ++side) {
        fit->seen[2 - side] = sqrt(left2 / fit->bound[side]);
        fit->bound[side] = isnan(fit->told) ? NAN : fit->bound[side];
    }
    const int misfit = left2 > MORE * fit->rough * fit->rough;
    fit->verdict = misfit && !(fit->chi2 < fit->bound[1]) ? FST_NOISE_MISFIT
                   : isnan(fit->told)                     ? FST_NOISE_NOT_TOLD
                   : fit->chi2 < fit->bound[0]            ? FST_NOISE_TOO_LARGE
                   : fit->chi2 < fit->bound[1]            ? FST_NOISE_AGREES
                                                          : FST_NOISE_TOO_SMALL;
}

static void conclude(attempt *a)
{
    fst_charges *charges = a->charges;
    fst_map_fit *fit = &charges->fit;
    double t[9];
    rotation(a->angles, t);
    solve(a, t, charges->strength);
    count_freedom(a, fit);
    const double left2 = left_of(a, fit);
    /* Noise that was told too small, or charges that fit badly: what is left is the error then. */
    a->noise2 = fmax(a->noise2, left2);
    fit->noise = sqrt(a->noise2);
    const double known = isnan(fit->told) ? fit->rough : fit->told;
    fit->chi2 = left2 / (known * known);
    judge_noise(fit, left2);
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
    free(charges->turning);
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
    if (whole && how->probe)
        charges->turning = calloc(3 * CHARGE_CLASSES * n, sizeof *charges->turning);
    whole = whole && (charges->turning || !how->probe);
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

/* A noise told wrong makes a fit too rough or too smooth, whose rest tells the noise less well than that of a fit
 * which is told none. */
static fst_status see_noise(const attempt *told, const fst_progress *progress, fst_error *error)
{
    fst_map_fit *fit = &told->charges->fit;
    if (fit->verdict != FST_NOISE_TOO_SMALL && fit->verdict != FST_NOISE_TOO_LARGE)
        return FST_OK;
    attempt again = *told;
    const fst_smoothing how = {NAN, told->how->probe, told->how->height, told->how->lies};
    fst_map_fit seen = {.rough = fit->rough, .told = NAN};
    double t[9];
    again.how = &how;
    const fst_status status = find_ridge(&again, progress, error);
    if (status == FST_OK && again.settled) {
        rotation(again.angles, t);
        solve(&again, t, again.charges->strength);
        count_freedom(&again, &seen);
        judge_noise(&seen, left_of(&again, &seen));
        memcpy(fit->seen, seen.seen, sizeof fit->seen);
    }
    again = *told; /* factors and strengths as they were */
    (void)try_ridge(&again, log(told->ridge));
    rotation(again.angles, t);
    solve(&again, t, again.charges->strength);
    return status;
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
        found->charges->fit.told = how->noise;
        conclude(found);
        status = see_noise(found, progress, error);
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
