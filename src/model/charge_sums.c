/* charge_sums.c - where equivalent charges lie, their field, and the sums of least squares over a map's samples. */
#include "model/charges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"

/* Sites to a depth: a finer lattice is not seen from the samples.  And how many depths a layer goes beyond the
 * samples, because magnets outside of the map are felt in it. */
static const double SITES_PER_DEPTH = 2.5, BEYOND = 2.0;

/* ------------------------------------------------------------------ sites */

typedef struct map_box {
    double middle[2], half[2], bottom, width;
} map_box;

static map_box box_of(const fst_field_map *map, double lies)
{
    const fst_field_map_facts facts = fst_field_map_describe(map);
    map_box box = {.bottom = isnan(facts.first[2]) ? lies : facts.first[2]};
    for (int axis = 0; axis < 2; ++axis) {
        box.half[axis] = 0.5 * (facts.count[axis] - 1) * facts.spacing[axis];
        box.middle[axis] = facts.first[axis] + box.half[axis];
    }
    box.width = 2.0 * fmin(box.half[0], box.half[1]);
    return box;
}

/* How many sites of a layer lie on one side of the middle. */
static int sites_along(double half, double depth)
{
    return (int)ceil((half + BEYOND * depth) * SITES_PER_DEPTH / depth);
}

/* Fill the sites, or count them where `sites` has no room yet. */
static int fill_sites(const map_box *box, double depth, charge_sites *sites)
{
    int count = 0;
    for (double d = depth; d == depth || d <= 0.5 * box->width; d *= 2.0) {
        const int nx = sites_along(box->half[0], d), ny = sites_along(box->half[1], d);
        const double step = d / SITES_PER_DEPTH;
        for (int i = 0; i < nx * ny && sites->x; ++i) {
            sites->x[count + i] = (i % nx + 0.5) * step;
            sites->y[count + i] = (i / nx + 0.5) * step;
            sites->z[count + i] = box->bottom - d;
            /* A lattice of charges of random strength, one to an area step^2, makes |B|^2 = pi/(d step)^2. */
            sites->weight[count + i] = d * step;
        }
        count += nx * ny;
    }
    return count;
}

int charge_columns(const charge_sites *sites)
{
    return sites->count + sites->offset;
}

int charge_sites_count(const fst_field_map *map, const fst_smoothing *how, double depth)
{
    const map_box box = box_of(map, how->lies);
    charge_sites none = {.x = NULL};
    return fill_sites(&box, depth, &none);
}

fst_status charge_sites_make(const fst_field_map *map, const fst_smoothing *how, double depth,
                             charge_sites *sites)
{
    const map_box box = box_of(map, how->lies);
    *sites = (charge_sites){.offset = how->probe, .depth = depth, .lies = how->lies, .unit = 100.0};
    memcpy(sites->middle, box.middle, sizeof sites->middle);
    sites->count = fill_sites(&box, depth, sites);
    sites->x = calloc(4 * (size_t)sites->count, sizeof *sites->x);
    if (!sites->x)
        return FST_NO_MEMORY;
    sites->y = sites->x + sites->count;
    sites->z = sites->y + sites->count;
    sites->weight = sites->z + sites->count;
    (void)fill_sites(&box, depth, sites);
    return FST_OK;
}

void charge_sites_free(charge_sites *sites)
{
    free(sites->x);
    sites->x = NULL;
}

/* ------------------------------------------------------------------ the field of a class */

/* B = d/r^3 and its gradient, (1 - 3 d d/r^2)/r^3, at the place d from a charge. */
static inline void look_at_charge(const double d[3], double weight, double out[CHARGE_VALUES])
{
    const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const double w = weight / (r2 * sqrt(r2)), w3 = 3.0 * w / r2;
    for (int k = 0; k < 3; ++k)
        out[k] = w * d[k];
    out[3] = w - w3 * d[0] * d[0];
    out[4] = -w3 * d[0] * d[1];
    out[5] = -w3 * d[0] * d[2];
    out[6] = w - w3 * d[1] * d[1];
    out[7] = -w3 * d[1] * d[2];
    out[8] = w - w3 * d[2] * d[2];
}

void charge_rows(const charge_sites *sites, const double place[3], int values, double *rows)
{
    const int columns = charge_columns(sites);
    const double x = place[0] - sites->middle[0], y = place[1] - sites->middle[1];
    for (int i = 0; i < sites->count; ++i) {
        double of[4][CHARGE_VALUES]; /* bit 0: the image in x; bit 1: in y */
        for (int image = 0; image < 4; ++image) {
            const double d[3] = {x + (image & 1 ? sites->x[i] : -sites->x[i]),
                                 y + (image & 2 ? sites->y[i] : -sites->y[i]), place[2] - sites->z[i]};
            look_at_charge(d, 0.5 * sites->weight[i], of[image]);
        }
        for (int v = 0; v < values; ++v) {
            const double plus = of[0][v] + of[1][v], minus = of[0][v] - of[1][v];
            const double plus_y = of[2][v] + of[3][v], minus_y = of[2][v] - of[3][v];
            const double all[CHARGE_CLASSES] = {plus + plus_y, minus + minus_y, plus - plus_y, minus - minus_y};
            for (int c = 0; c < CHARGE_CLASSES; ++c)
                rows[(c * CHARGE_VALUES + v) * columns + i] = all[c];
        }
    }
    for (int c = 0; c < CHARGE_CLASSES && sites->offset; ++c)
        for (int v = 0; v < values; ++v) /* Bz belongs to class 0, Bx to 1, By to 2 */
            rows[(c * CHARGE_VALUES + v) * columns + sites->count] =
                v < 3 && (v + 1) % 3 == c ? sites->unit : 0.0;
}

/* ------------------------------------------------------------------ sums over samples */

void charge_sums_free(charge_sums *sums)
{
    for (int c = 0; c < CHARGE_CLASSES; ++c)
        free(sums->normal[c]);
    free(sums->right);
    memset(sums, 0, sizeof *sums);
}

/* The sign of a component of B at a mirror image of a place, in a class. */
static double sign_of(int class, int component, int image)
{
    double sign = 1.0;
    for (int axis = 0; axis < 2; ++axis)
        if (image >> axis & 1)
            sign *= (class >> axis & 1) != (component == axis) ? -1.0 : 1.0;
    return sign;
}

/* The samples at the four images of (i, j), folded with the signs of a class: folded[a][b] of the field's
 * component a and the samples' component b.  Returns how many images are different places. */
static int fold(const fst_map_plane *plane, int i, int j, double folded[CHARGE_CLASSES][3][3])
{
    const int nx = plane->cells[0], ny = plane->cells[1];
    int images = 0;
    memset(folded, 0, CHARGE_CLASSES * sizeof *folded);
    for (int image = 0; image < 4; ++image) {
        if ((image & 1 && 2 * i == nx) || (image & 2 && 2 * j == ny))
            continue;
        double b[3];
        fst_map_sample(plane, image & 1 ? nx - i : i, image & 2 ? ny - j : j, b);
        ++images;
        for (int c = 0; c < CHARGE_CLASSES; ++c)
            for (int a = 0; a < 3; ++a)
                for (int k = 0; k < 3; ++k)
                    folded[c][a][k] += sign_of(c, a, image) * b[k];
    }
    return images;
}

static void add_sample(charge_sums *sums, const double *rows, int columns, int images,
                       double folded[CHARGE_CLASSES][3][3])
{
    for (int c = 0; c < CHARGE_CLASSES; ++c) {
        const double *x = &rows[c * CHARGE_VALUES * columns], *y = x + columns, *z = y + columns;
        for (int i = 0; i < columns; ++i) {
            double *to = &sums->normal[c][(size_t)i * (size_t)columns];
            const double xi = images * x[i], yi = images * y[i], zi = images * z[i];
            for (int j = i; j < columns; ++j)
                to[j] += xi * x[j] + yi * y[j] + zi * z[j];
        }
        for (int ab = 0; ab < 9; ++ab) {
            double *to = &sums->right[(c * 9 + ab) * columns];
            const double *row = x + ab / 3 * columns, b = folded[c][ab / 3][ab % 3];
            for (int i = 0; i < columns; ++i)
                to[i] += b * row[i];
        }
    }
}

fst_status charge_sums_make(const fst_field_map *map, const charge_sites *sites, const fst_progress *progress,
                            charge_sums *sums, fst_error *error)
{
    const int columns = charge_columns(sites);
    const fst_field_map_facts facts = fst_field_map_describe(map);
    double *rows = calloc((size_t)(CHARGE_CLASSES * CHARGE_VALUES * columns), sizeof *rows);
    memset(sums, 0, sizeof *sums);
    sums->right = calloc((size_t)(CHARGE_CLASSES * 9 * columns), sizeof *sums->right);
    fst_status status = rows && sums->right ? FST_OK : FST_NO_MEMORY;
    for (int c = 0; c < CHARGE_CLASSES && status == FST_OK; ++c) {
        sums->normal[c] = calloc((size_t)columns * (size_t)columns, sizeof **sums->normal);
        status = sums->normal[c] ? FST_OK : FST_NO_MEMORY;
    }
    const int half[2] = {(facts.count[0] + 1) / 2, (facts.count[1] + 1) / 2};
    for (int k = 0; k < facts.count[2]; ++k) {
        const fst_map_plane *plane = fst_map_plane_number(map, k);
        for (int j = 0; j < half[1] && status == FST_OK; ++j) {
            for (int i = 0; i < half[0]; ++i) {
                double folded[CHARGE_CLASSES][3][3];
                const double place[3] = {plane->first[0] + i * plane->spacing[0],
                                         plane->first[1] + j * plane->spacing[1],
                                         isnan(plane->height) ? sites->lies : plane->height};
                charge_rows(sites, place, 3, rows);
                add_sample(sums, rows, columns, fold(plane, i, j, folded), folded);
            }
            status = fst_tell(progress, (k + (j + 1.0) / half[1]) / facts.count[2], "fitting charges", error);
        }
        for (int i = 0; i < facts.count[0] * facts.count[1] && status == FST_OK; ++i) {
            double b[3];
            fst_map_sample(plane, i % facts.count[0], i / facts.count[0], b);
            sums->square += b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
            sums->count += 3.0;
        }
    }
    free(rows);
    return status;
}
