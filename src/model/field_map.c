/* field_map.c - making splines of the samples of a measured field.
 *
 * Along one axis, a spline of degree 7 through n samples has n + 6 coefficients: those of the nodes from -3 to
 * n + 2.  At node j it has the value
 *
 *     (c[j-3] + 120 c[j-2] + 1191 c[j-1] + 2416 c[j] + 1191 c[j+1] + 120 c[j+2] + c[j+3])/5040
 *
 * Six equations are left over.  "Not a knot": the seventh derivative does not jump at the three nodes next to
 * either end, so that the first four cells, and the last four, share one polynomial and the error falls with
 * the eighth power of the spacing up to the ends (de Boor, A Practical Guide to Splines, chapter IV).  The jump
 * at node q is the eighth difference of c[q-4] to c[q+4].
 *
 *     row   0  1  2   3  4  5 ...   n+2   n+3 n+4 n+5
 *           |jumps|   |samples        |   |  jumps  |
 *
 * All entries lie within 8 columns of the diagonal: a band, which is factored once for each axis.  Along two
 * axes, rows are solved first, then columns of what they gave.
 */
#include "model/field_map.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"

struct fst_field_map {
    atomic_int owners;
    fst_field_map_facts facts;
    int plane_count;
    fst_map_plane *planes;
    double *coefficients;        /* of all planes */
    struct fst_charges *charges; /* of a smoothed map, and what frees them */
    void (*free_charges)(struct fst_charges *charges);
};

static const char PLACE[] = "fst_field_map_new";

/* ------------------------------------------------------------------ the band of one axis */

enum { REACH = 8, BAND_ROWS = 3 * REACH + 1 };

/* Of a spline at the nodes within its reach, times 5040. */
static const double AT_NODES[7] = {1, 120, 1191, 2416, 1191, 120, 1};

/* Element (row, column) is at values[column * BAND_ROWS + 2 * REACH + row - column]; exchanging rows lets the
 * upper triangle grow to twice the reach. */
typedef struct band {
    int size;
    int *pivots;
    double *values;
} band;

static double *element(const band *b, int row, int column)
{
    return &b->values[column * BAND_ROWS + 2 * REACH + row - column];
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

static void fill_band(band *b, int samples)
{
    static const double difference[9] = {1, -8, 28, -56, 70, -56, 28, -8, 1};
    for (int j = 0; j < samples; ++j)
        for (int k = 0; k < 7; ++k)
            *element(b, j + FST_SPLINE_BEYOND, j + k) = AT_NODES[k] / 5040.0;
    for (int end = 0; end < 2; ++end)
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 9; ++k)
                *element(b, end ? samples + 3 + i : i, (end ? samples - 5 : 0) + i + k) = difference[k];
}

/* Gauss's elimination with exchange of rows; the matrix is never singular for 8 samples and more. */
static void factor_band(band *b)
{
    for (int k = 0; k < b->size; ++k) {
        const int last_row = least(k + REACH, b->size - 1), last_column = least(k + 2 * REACH, b->size - 1);
        int pivot = k;
        for (int i = k + 1; i <= last_row; ++i)
            if (fabs(*element(b, i, k)) > fabs(*element(b, pivot, k)))
                pivot = i;
        b->pivots[k] = pivot;
        for (int j = k; j <= last_column && pivot != k; ++j) {
            const double kept = *element(b, k, j);
            *element(b, k, j) = *element(b, pivot, j);
            *element(b, pivot, j) = kept;
        }
        for (int i = k + 1; i <= last_row; ++i) {
            const double factor = *element(b, i, k) /= *element(b, k, k);
            for (int j = k + 1; j <= last_column && factor != 0; ++j)
                *element(b, i, j) -= factor * *element(b, k, j);
        }
    }
}

/* Solve for the numbers at values[0], values[step], ..., which the solution replaces. */
static void solve_band(const band *b, double *values, size_t step)
{
    for (int k = 0; k < b->size; ++k) {
        double *here = &values[(size_t)k * step], *pivot = &values[(size_t)b->pivots[k] * step];
        const double kept = *pivot;
        *pivot = *here;
        *here = kept;
        for (int i = k + 1; i <= least(k + REACH, b->size - 1); ++i)
            values[(size_t)i * step] -= *element(b, i, k) * kept;
    }
    for (int k = b->size - 1; k >= 0; --k) {
        const double value = values[(size_t)k * step] /= *element(b, k, k);
        for (int i = k > 2 * REACH ? k - 2 * REACH : 0; i < k; ++i)
            values[(size_t)i * step] -= *element(b, i, k) * value;
    }
}

static void free_band(band *b)
{
    free(b->pivots);
    free(b->values);
}

static int make_band(band *b, int samples)
{
    b->size = samples + 2 * FST_SPLINE_BEYOND;
    b->pivots = calloc((size_t)b->size, sizeof *b->pivots);
    b->values = calloc((size_t)b->size * BAND_ROWS, sizeof *b->values);
    if (!b->pivots || !b->values)
        return 0;
    fill_band(b, samples);
    factor_band(b);
    return 1;
}

/* ------------------------------------------------------------------ a plane of splines */

static fst_status fit_plane(const band bands[2], const fst_map_plane *plane, double *coefficients,
                            const double *b, const fst_part *part, fst_error *error)
{
    const int nx = plane->cells[0] + 1, ny = plane->cells[1] + 1;
    const size_t row = (size_t)plane->stride * FST_MAP_COMPONENTS;
    fst_status status = FST_OK;
    for (int j = 0; j < ny && status == FST_OK; ++j) {
        double *to = coefficients + (size_t)(j + FST_SPLINE_BEYOND) * row;
        for (int c = 0; c < 3; ++c) {
            for (int i = 0; i < nx; ++i)
                to[(i + FST_SPLINE_BEYOND) * FST_MAP_COMPONENTS + c] =
                    b[((size_t)j * (size_t)nx + (size_t)i) * 3 + (size_t)c];
            solve_band(&bands[0], to + c, FST_MAP_COMPONENTS);
        }
        status = fst_part_tell((void *)(uintptr_t)part, 0.5 * j / ny, NULL, error);
    }
    for (int i = 0; i < plane->stride && status == FST_OK; ++i) {
        for (int c = 0; c < 3; ++c)
            solve_band(&bands[1], coefficients + (size_t)i * FST_MAP_COMPONENTS + c, row);
        status = fst_part_tell((void *)(uintptr_t)part, 0.5 + 0.5 * i / plane->stride, NULL, error);
    }
    return status;
}

/* ------------------------------------------------------------------ what is known of a map */

void fst_map_sample(const fst_map_plane *plane, int i, int j, double b[3])
{
    b[0] = b[1] = b[2] = 0.0;
    for (int l = 0; l < 7; ++l)
        for (int k = 0; k < 7; ++k)
            for (int c = 0; c < 3; ++c)
                b[c] += AT_NODES[l] / 5040.0 * (AT_NODES[k] / 5040.0) *
                        plane->coefficients[((size_t)(j + l) * (size_t)plane->stride + (size_t)(i + k)) *
                                                FST_MAP_COMPONENTS +
                                            (size_t)c];
}

/* The derivatives of the component c by x and y at a sample. */
static void slopes_at(const fst_map_plane *plane, int i, int j, int c, double slopes[2])
{
    static const double slope[7] = {-1, -56, -245, 0, 245, 56, 1};
    slopes[0] = slopes[1] = 0.0;
    for (int l = 0; l < 7; ++l)
        for (int k = 0; k < 7; ++k) {
            const double here =
                plane->coefficients[((size_t)(j + l) * (size_t)plane->stride + (size_t)(i + k)) *
                                        FST_MAP_COMPONENTS +
                                    (size_t)c];
            slopes[0] += AT_NODES[l] / 5040.0 * (slope[k] / 720.0) * here;
            slopes[1] += AT_NODES[k] / 5040.0 * (slope[l] / 720.0) * here;
        }
    slopes[0] /= plane->spacing[0];
    slopes[1] /= plane->spacing[1];
}

/* The share of curl in the derivatives of a plane. */
static double curl_of(const fst_map_plane *plane)
{
    double curl = 0.0, all = 0.0;
    for (int j = 0; j <= plane->cells[1]; ++j)
        for (int i = 0; i <= plane->cells[0]; ++i) {
            double s[3][2];
            for (int c = 0; c < 3; ++c) {
                slopes_at(plane, i, j, c, s[c]);
                all += s[c][0] * s[c][0] + s[c][1] * s[c][1];
            }
            curl += (s[0][1] - s[1][0]) * (s[0][1] - s[1][0]);
        }
    return all > 0 ? sqrt(curl / all) : 0.0;
}

fst_field_map_facts fst_field_map_describe(const fst_field_map *map)
{
    return map->facts;
}

int fst_field_map_doubt(const fst_field_map *map, char *sentence, size_t size)
{
    const double curl = map->facts.curl;
    if (!(curl > 1e-3))
        return 0;
    return snprintf(sentence, size, "the map of magnet.file has a curl of %.2g: %s", curl,
                    curl > 0.1 ? "a magnet's field has none: much noise, or columns or axes exchanged?"
                               : "smoothing fits a field without curl");
}

static double radius_of(const fst_field_samples *s)
{
    double radius = INFINITY;
    for (int axis = 0; axis < 2; ++axis) {
        const double last = s->first[axis] + (s->count[axis] - 1) * s->spacing[axis];
        radius = fmin(radius, fmin(-s->first[axis], last));
    }
    return radius;
}

/* ------------------------------------------------------------------ making a map */

/* More samples than any hall probe takes; coefficients then fill 1 GiB. */
#define MOST_SAMPLES 32000000

/* T: no magnet is as strong, but a map in wrong units may be. */
static const double STRONGEST = 1e3;

static fst_status check_samples(const fst_field_samples *s, fst_error *error)
{
    static const char axes[] = "xyz";
    double all = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const int needed = axis < 2 ? FST_SPLINE_NODES : 1, spaced = axis < 2 || s->count[2] > 1;
        if (s->count[axis] < needed)
            return fst_fail(error, FST_BAD_INPUT, PLACE,
                            "the map has %d sample%s along %c: splines of degree 7 need at least %d",
                            s->count[axis], s->count[axis] == 1 ? "" : "s", axes[axis], needed);
        all *= s->count[axis];
        if (spaced && !isfinite(s->first[axis]))
            return fst_fail(error, FST_BAD_INPUT, PLACE, "the place of the map along %c is %g", axes[axis],
                            s->first[axis]);
        if (spaced && !(s->spacing[axis] > 0 && isfinite(s->spacing[axis])))
            return fst_fail(error, FST_BAD_INPUT, PLACE,
                            "the spacing of the map along %c is %g m, not positive", axes[axis],
                            s->spacing[axis]);
    }
    if (all > MOST_SAMPLES)
        return fst_fail(error, FST_BAD_INPUT, PLACE, "the map has %.0f samples, more than %d", all,
                        MOST_SAMPLES);
    for (size_t i = 0; i < 3 * (size_t)all; ++i)
        if (!(fabs(s->b[i]) <= STRONGEST))
            return fst_fail(error, FST_BAD_INPUT, PLACE,
                            "the component %c of sample %zu of the map is %g T: a number of at most %g is "
                            "expected",
                            axes[i % 3], i / 3 + 1, s->b[i], STRONGEST);
    if (!(radius_of(s) > 0))
        return fst_fail(error, FST_BAD_INPUT, PLACE,
                        "the map does not surround the axis of rotation x = y = 0: the places of a map are in "
                        "the magnet's frame, whose origin is that axis");
    return FST_OK;
}

static void tell_facts(fst_field_map *map, const fst_field_samples *s)
{
    fst_field_map_facts *facts = &map->facts;
    double greatest = 0.0;
    const size_t all = (size_t)s->count[0] * (size_t)s->count[1] * (size_t)s->count[2];
    for (size_t i = 0; i < all; ++i)
        greatest = fmax(greatest, s->b[3 * i] * s->b[3 * i] + s->b[3 * i + 1] * s->b[3 * i + 1] +
                                      s->b[3 * i + 2] * s->b[3 * i + 2]);
    memcpy(facts->count, s->count, sizeof facts->count);
    memcpy(facts->first, s->first, sizeof facts->first);
    memcpy(facts->spacing, s->spacing, sizeof facts->spacing);
    facts->greatest = sqrt(greatest);
    facts->radius = radius_of(s);
    for (int i = 0; i < map->plane_count; ++i)
        facts->curl = fmax(facts->curl, curl_of(&map->planes[i]));
}

static fst_status fit_planes(fst_field_map *map, const fst_field_samples *s, const band bands[2],
                             const fst_progress *progress, fst_error *error)
{
    const int stride = s->count[0] + 2 * FST_SPLINE_BEYOND, rows = s->count[1] + 2 * FST_SPLINE_BEYOND;
    const size_t size = (size_t)stride * (size_t)rows * FST_MAP_COMPONENTS;
    for (int i = 0; i < map->plane_count; ++i) {
        double *coefficients = map->coefficients + (size_t)i * size;
        fst_map_plane *plane = &map->planes[i];
        plane->coefficients = coefficients;
        plane->stride = stride;
        for (int axis = 0; axis < 2; ++axis) {
            plane->cells[axis] = s->count[axis] - 1;
            plane->first[axis] = s->first[axis];
            plane->spacing[axis] = s->spacing[axis];
        }
        plane->height = map->plane_count > 1 ? s->first[2] + i * s->spacing[2] : s->first[2];
        const fst_part part = {progress, (double)i / map->plane_count, (i + 1.0) / map->plane_count, NULL};
        const fst_status status =
            fit_plane(bands, plane, coefficients,
                      s->b + (size_t)i * 3 * (size_t)s->count[0] * (size_t)s->count[1], &part, error);
        if (status != FST_OK)
            return status;
    }
    tell_facts(map, s);
    return FST_OK;
}

fst_status fst_field_map_new(const fst_field_samples *samples, const fst_progress *progress,
                             fst_field_map **out, fst_error *error)
{
    *out = NULL;
    fst_status status = check_samples(samples, error);
    if (status != FST_OK)
        return status;
    band bands[2] = {{0, NULL, NULL}, {0, NULL, NULL}};
    fst_field_map *map = calloc(1, sizeof *map);
    if (map) {
        atomic_init(&map->owners, 1);
        map->plane_count = samples->count[2];
        map->planes = calloc((size_t)map->plane_count, sizeof *map->planes);
        map->coefficients =
            calloc((size_t)map->plane_count * (size_t)(samples->count[0] + 2 * FST_SPLINE_BEYOND) *
                       (size_t)(samples->count[1] + 2 * FST_SPLINE_BEYOND),
                   FST_MAP_COMPONENTS * sizeof *map->coefficients);
    }
    if (!map || !map->planes || !map->coefficients || !make_band(&bands[0], samples->count[0]) ||
        !make_band(&bands[1], samples->count[1]))
        status = fst_fail(error, FST_NO_MEMORY, PLACE, "no memory for a map of %d x %d x %d samples",
                          samples->count[0], samples->count[1], samples->count[2]);
    if (status == FST_OK)
        status = fit_planes(map, samples, bands, progress, error);
    for (int axis = 0; axis < 2; ++axis)
        free_band(&bands[axis]);
    if (status == FST_OK)
        *out = map;
    else
        fst_field_map_free(map);
    return status;
}

fst_field_map *fst_field_map_share(const fst_field_map *map)
{
    fst_field_map *owned = (fst_field_map *)(uintptr_t)map; /* the count of owners is all that changes */
    if (owned)
        atomic_fetch_add(&owned->owners, 1);
    return owned;
}

void fst_field_map_free(fst_field_map *map)
{
    if (!map || atomic_fetch_sub(&map->owners, 1) > 1)
        return;
    if (map->charges)
        map->free_charges(map->charges);
    free(map->planes);
    free(map->coefficients);
    free(map);
}

/* ------------------------------------------------------------------ planes and heights */

/* The plane whose height is nearest. */
static const fst_map_plane *nearest_plane(const fst_field_map *map, double height)
{
    const fst_map_plane *nearest = &map->planes[0];
    for (int i = 1; i < map->plane_count; ++i)
        if (fabs(map->planes[i].height - height) < fabs(nearest->height - height))
            nearest = &map->planes[i];
    return nearest;
}

const fst_map_plane *fst_map_plane_at(const fst_field_map *map, double height)
{
    const fst_map_plane *plane = nearest_plane(map, height);
    /* As exact as the place of a probe is known: a thousandth of the way to the next sample. */
    const double same = 1e-3 * fmin(plane->spacing[0], plane->spacing[1]);
    return isnan(plane->height) || fabs(plane->height - height) <= same ? plane : NULL;
}

double fst_map_nearest_height(const fst_field_map *map, double height)
{
    return nearest_plane(map, height)->height;
}

const fst_map_plane *fst_map_plane_number(const fst_field_map *map, int number)
{
    return &map->planes[number];
}

void fst_map_own_charges(fst_field_map *map, struct fst_charges *charges,
                         void (*free_charges)(struct fst_charges *charges), const fst_map_fit *fit)
{
    map->charges = charges;
    map->free_charges = free_charges;
    map->facts.fit = *fit;
}

const struct fst_charges *fst_map_charges(const fst_field_map *map)
{
    return map->charges;
}
