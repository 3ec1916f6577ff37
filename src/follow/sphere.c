/* sphere.c - the surface of the bead in a cubic grid, and the axis of its marks. */
#include "follow/sphere.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/dot.h"

enum { NODES = FOLLOW_SPHERE_CELLS + 1, ALL = NODES * NODES * NODES, POINTS = 4000, SETTLES = 30 };

#define HALF_CELLS                                                                                             \
    (0.5 * (FOLLOW_SPHERE_CELLS - 1)) /* of the sphere's diameter: half a cell is left on each side */
#define BAND 0.35                     /* sine of the latitudes, around the edge of a half, that tell its axis */
#define SPOT 0.7                      /* cosine of the angle around the middle of a spot within which it lies */
#define LEAST_HALF 0.3                /* of the surface that is dark where a half is painted */

int follow_sphere_begin(follow_sphere *sphere)
{
    sphere->nodes = calloc(ALL, sizeof *sphere->nodes);
    return sphere->nodes != NULL;
}

void follow_sphere_clear(follow_sphere *sphere)
{
    memset(sphere->nodes, 0, ALL * sizeof *sphere->nodes);
}

/* The first node of the cell of a point, and where in the cell the point is. */
static int cell_of(const double point[3], double part[3])
{
    int first = 0;
    for (int i = 0; i < 3; ++i) {
        const double at = (point[i] + 1.0) * HALF_CELLS + 0.5;
        const int cell = (int)fmax(0.0, fmin(FOLLOW_SPHERE_CELLS - 1, at));
        part[i] = at - cell;
        first = first * NODES + cell;
    }
    return first;
}

static int corner_of(int first, int k)
{
    return first + (k >> 2) * NODES * NODES + (k >> 1 & 1) * NODES + (k & 1);
}

void follow_sphere_add(follow_sphere *sphere, const double point[3], double value, double weight)
{
    double part[3];
    const int first = cell_of(point, part);
    for (int k = 0; k < 8; ++k) {
        const double w = weight * (k & 4 ? part[0] : 1.0 - part[0]) * (k & 2 ? part[1] : 1.0 - part[1]) *
                         (k & 1 ? part[2] : 1.0 - part[2]);
        follow_node *node = &sphere->nodes[corner_of(first, k)];
        node->sum += (float)(w * value);
        node->weight += (float)w;
    }
}

void follow_sphere_sharpen(follow_sphere *sphere, const follow_sphere *rest)
{
    for (int k = 0; k < ALL; ++k)
        if (rest->nodes[k].weight > 0.0F)
            sphere->nodes[k].sum += rest->nodes[k].sum * (sphere->nodes[k].weight / rest->nodes[k].weight);
}

int follow_sphere_at(const follow_sphere *sphere, const double point[3], double *value, double slope[3])
{
    double part[3], sum = 0.0, weight = 0.0, sums[3] = {0.0, 0.0, 0.0}, weights[3] = {0.0, 0.0, 0.0};
    const int first = cell_of(point, part);
    for (int k = 0; k < 8; ++k) {
        const double f[3] = {k & 4 ? part[0] : 1.0 - part[0], k & 2 ? part[1] : 1.0 - part[1],
                             k & 1 ? part[2] : 1.0 - part[2]};
        const follow_node *node = &sphere->nodes[corner_of(first, k)];
        const double of[3] = {k & 4 ? f[1] * f[2] : -f[1] * f[2], k & 2 ? f[0] * f[2] : -f[0] * f[2],
                              k & 1 ? f[0] * f[1] : -f[0] * f[1]};
        const double s = (double)node->sum, w = (double)node->weight;
        sum += f[0] * f[1] * f[2] * s;
        weight += f[0] * f[1] * f[2] * w;
        for (int i = 0; i < 3; ++i) {
            sums[i] += of[i] * s;
            weights[i] += of[i] * w;
        }
    }
    if (!(weight > 0.0))
        return 0;
    *value = sum / weight;
    for (int i = 0; i < 3 && slope; ++i)
        slope[i] = HALF_CELLS * (sums[i] - *value * weights[i]) / weight;
    return 1;
}

/* ------------------------------------------------------------------ the axis */

/* Points that lie evenly on the sphere: a spiral by the golden angle. */
static void spiral(int k, double point[3])
{
    const double z = 1.0 - (2.0 * k + 1.0) / POINTS, across = sqrt(1.0 - z * z),
                 angle = 2.39996322972865332 * k;
    point[0] = across * cos(angle);
    point[1] = across * sin(angle);
    point[2] = z;
}

/* Find which points of the spiral are marks, and how many were not seen.  Returns the dark share of the others, NAN where
 * there is none. */
static double find_marks(const follow_sphere *sphere, signed char *dark, int *unseen)
{
    double values[POINTS], low = INFINITY, high = -INFINITY;
    int count = 0;
    *unseen = 0;
    for (int k = 0; k < POINTS; ++k) {
        double point[3];
        spiral(k, point);
        values[k] = NAN;
        if (!follow_sphere_at(sphere, point, &values[k], NULL)) {
            ++*unseen;
            continue;
        }
        low = fmin(low, values[k]);
        high = fmax(high, values[k]);
    }
    double middle = 0.5 * (low + high);
    for (int repeat = 0; repeat < SETTLES; ++repeat) { /* half-way between the means of both sides */
        double sums[2] = {0.0, 0.0};
        int counts[2] = {0, 0};
        for (int k = 0; k < POINTS; ++k)
            if (!isnan(values[k])) {
                sums[values[k] < middle] += values[k];
                ++counts[values[k] < middle];
            }
        if (counts[0] == 0 || counts[1] == 0)
            return NAN;
        middle = 0.5 * (sums[0] / counts[0] + sums[1] / counts[1]);
    }
    for (int k = 0; k < POINTS; ++k) {
        dark[k] = (signed char)(isnan(values[k]) ? 0 : values[k] < middle ? 1 : -1);
        count += dark[k] > 0;
    }
    return (double)count / (POINTS - *unseen);
}

static void normalise(double v[3])
{
    const double length = sqrt(fst_dot(v, v, 3));
    for (int i = 0; i < 3; ++i)
        v[i] /= length;
}

/* The middle of a half.  Where the axis is off by an angle e, the band around its equator has a moment across the axis of
 * 2 pi e, while that along it is 2 pi BAND^2: dots outside of the band change neither. */
static void centre_half(const signed char *dark, double axis[3])
{
    for (int repeat = 0; repeat < SETTLES; ++repeat) {
        double moment[3] = {0.0, 0.0, 0.0};
        for (int k = 0; k < POINTS; ++k) {
            double point[3];
            spiral(k, point);
            if (fabs(fst_dot(point, axis, 3)) < BAND)
                for (int i = 0; i < 3; ++i)
                    moment[i] += dark[k] * point[i];
        }
        const double along = fst_dot(moment, axis, 3);
        if (!(along > 0.0))
            return;
        for (int i = 0; i < 3; ++i)
            axis[i] += BAND * BAND * (moment[i] / along - axis[i]);
        normalise(axis);
    }
}

/* The middle of the spot around a place: `spot` is the sign of its points. */
static double centre_spot(const signed char *dark, int spot, double axis[3])
{
    double found = 0.0;
    for (int repeat = 0; repeat < SETTLES; ++repeat) {
        double sum[3] = {0.0, 0.0, 0.0};
        found = 0.0;
        for (int k = 0; k < POINTS; ++k) {
            double point[3];
            spiral(k, point);
            if (dark[k] != spot || fst_dot(point, axis, 3) < SPOT)
                continue;
            ++found;
            for (int i = 0; i < 3; ++i)
                sum[i] += point[i];
        }
        if (!(found > 0.0))
            return 0.0;
        memcpy(axis, sum, sizeof sum);
        normalise(axis);
    }
    return found;
}

int follow_sphere_is_half(const follow_sphere *sphere)
{
    signed char dark[POINTS];
    int unseen;
    const double share = find_marks(sphere, dark, &unseen);
    return unseen < POINTS / 3 && share > LEAST_HALF && share < 1.0 - LEAST_HALF;
}

int follow_sphere_axis(const follow_sphere *sphere, double axis[3])
{
    enum { STARTS = 25 };
    signed char dark[POINTS];
    int unseen;
    const double share = find_marks(sphere, dark, &unseen);
    if (isnan(share) || unseen >= POINTS / 50)
        return 0;
    if (share > LEAST_HALF && share < 1.0 - LEAST_HALF) {
        double sum[3] = {0.0, 0.0, 0.0};
        for (int k = 0; k < POINTS; ++k) {
            double point[3];
            spiral(k, point);
            for (int i = 0; i < 3; ++i)
                sum[i] += dark[k] * point[i];
        }
        memcpy(axis, sum, sizeof sum);
        normalise(axis);
        centre_half(dark, axis);
        return 1;
    }
    double most = 0.0;
    for (int k = 0; k < STARTS; ++k) {
        double start[3];
        spiral(POINTS / STARTS * k, start);
        const double found = centre_spot(dark, share < 0.5 ? 1 : -1, start);
        if (found > most) {
            most = found;
            memcpy(axis, start, sizeof start);
        }
    }
    return most > 0.0;
}
