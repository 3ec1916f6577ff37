/* rim.c - the plate's edge: steps of brightness along rays from the middle, and the ellipse that most rays
 * meet.
 *
 *            . * .            Every ray has its steepest steps as candidates.  Ellipses through five of them, taken
 *         *    |    *         from five rays by chance, are compared by how many rays have a candidate on them; the
 *        * ----+---- *        best one is fitted again to the steps of all these rays.
 *         *    |    *
 *            ` * '
 */
#include "follow/rim.h"

#include <math.h>
#include <stdlib.h>

#include "base/constants.h"
#include "base/chance.h"
#include "base/error.h"

enum { RAYS = 360, CANDIDATES = 6, TRIALS = 3000, REPEATS = 4 };

#define NEAR 2.0        /* pixels from an ellipse to a step of its own */
#define LEAST_SHARE 0.5 /* of the rays that must meet the edge */
#define STRONG 0.25     /* of the steepest edge: what is fainter, as a shadow, is not an edge of the plate */
#define STEP_OF_NOISE 3.0
#define LEAST_STEP 4.0 /* gray levels within four pixels */

/* The steps along one ray: how far from the middle. */
typedef struct ray {
    double way[CANDIDATES], size[CANDIDATES];
    int count;
} ray;

typedef struct rim {
    const follow_still *still;
    double middle[2];
    ray rays[RAYS];
    uint64_t chance;
} rim;

static double angle_of(int index)
{
    return FST_TWO_PI * index / RAYS;
}

/* The level between four pixels; NAN outside of the picture. */
static double level_at(const follow_still *s, double column, double row)
{
    const double i = floor(column), j = floor(row), p = column - i, q = row - j;
    if (!(i >= 0.0 && j >= 0.0 && i + 1.0 < s->width && j + 1.0 < s->height))
        return NAN;
    const float *at = s->level + (size_t)j * (size_t)s->width + (size_t)i;
    return (1.0 - q) * ((1.0 - p) * (double)at[0] + p * (double)at[1]) +
           q * ((1.0 - p) * (double)at[s->width] + p * (double)at[s->width + 1]);
}

/* How much the level changes around a place of a ray: the two pixels beyond less the two before. */
static double step_at(const rim *r, int index, double way)
{
    const double c = cos(angle_of(index)), s = sin(angle_of(index));
    double sum = 0.0;
    for (int k = 0; k < 2; ++k) {
        const double out = way + 0.5 + k, in = way - 0.5 - k;
        sum += 0.5 * (level_at(r->still, r->middle[0] + out * c, r->middle[1] + out * s) -
                      level_at(r->still, r->middle[0] + in * c, r->middle[1] + in * s));
    }
    return sum;
}

/* Put a step into its place among the steepest; the least steep of too many is dropped. */
static void keep_step(ray *to, double way, double size)
{
    if (to->count == CANDIDATES && to->size[CANDIDATES - 1] >= size)
        return;
    int at = to->count < CANDIDATES ? to->count++ : CANDIDATES - 1;
    for (; at > 0 && to->size[at - 1] < size; --at) {
        to->size[at] = to->size[at - 1];
        to->way[at] = to->way[at - 1];
    }
    to->size[at] = size;
    to->way[at] = way;
}

/* The steepest steps of a ray, to a part of a pixel by the parabola through the step and its neighbours. */
static void look_along(rim *r, int index, double within)
{
    ray *to = &r->rays[index];
    const double least = fmax(LEAST_STEP, STEP_OF_NOISE * r->still->noise / sqrt(FOLLOW_SAMPLES));
    double before = NAN, here = step_at(r, index, within), after;
    to->count = 0;
    for (double way = within; !isnan(after = step_at(r, index, way + 1.0));
         way += 1.0, before = here, here = after) {
        const double size = fabs(here);
        if (!(size >= least && size >= fabs(before) && size > fabs(after)))
            continue;
        const double bend = fabs(before) - 2.0 * size + fabs(after);
        keep_step(to, way + (bend < 0.0 ? 0.5 * (fabs(before) - fabs(after)) / bend : 0.0), size);
    }
}

/* Where a ray meets an ellipse around its origin; NAN: nowhere. */
static double meets(const rim *r, const follow_ellipse *e, int index)
{
    const double c = cos(e->angle), s = sin(e->angle), a = angle_of(index), ux = cos(a), uy = sin(a);
    const double dx = r->middle[0] - e->centre[0], dy = r->middle[1] - e->centre[1];
    const double x = (c * dx + s * dy) / e->axes[0], y = (-s * dx + c * dy) / e->axes[1];
    const double u = (c * ux + s * uy) / e->axes[0], v = (-s * ux + c * uy) / e->axes[1];
    const double p = x * u + y * v, q = u * u + v * v, root = p * p - q * (x * x + y * y - 1.0);
    return root >= 0.0 ? (-p + sqrt(root)) / q : NAN;
}

/* The step of a ray that is nearest to an ellipse; -1: none is near. */
static int step_on(const rim *r, const follow_ellipse *e, int index, double near)
{
    const double way = meets(r, e, index);
    const ray *here = &r->rays[index];
    int found = -1;
    for (int k = 0; k < here->count; ++k)
        if (fabs(here->way[k] - way) < near) {
            near = fabs(here->way[k] - way);
            found = k;
        }
    return found;
}

/* The steps of all rays that lie on an ellipse; returns how many, their places in `points`. */
static int on_ellipse(const rim *r, const follow_ellipse *e, double near, double *points)
{
    int count = 0;
    for (int i = 0; i < RAYS; ++i) {
        const int k = step_on(r, e, i, near);
        if (k < 0)
            continue;
        points[2 * count] = r->middle[0] + r->rays[i].way[k] * cos(angle_of(i));
        points[2 * count + 1] = r->middle[1] + r->rays[i].way[k] * sin(angle_of(i));
        ++count;
    }
    return count;
}

/* Take the steps on an ellipse away, and say of them what a person is told. */
static fst_plate_edge take_steps(rim *r, const follow_ellipse *e)
{
    fst_plate_edge edge = {.diameter = {2.0 * e->axes[0], 2.0 * e->axes[1]}};
    int count = 0, near = 0;
    double squares = 0.0;
    for (int i = 0; i < RAYS; ++i) {
        const int k = step_on(r, e, i, NEAR);
        if (k < 0)
            continue;
        ray *here = &r->rays[i];
        const double off = here->way[k] - meets(r, e, i);
        if (fabs(off) < 0.5 * NEAR) {
            squares += off * off;
            ++near;
        }
        edge.contrast += here->size[k];
        ++count;
        for (int j = k + 1; j < here->count; ++j) {
            here->way[j - 1] = here->way[j];
            here->size[j - 1] = here->size[j];
        }
        --here->count;
    }
    edge.share = (double)count / RAYS;
    edge.contrast /= count > 0 ? count : 1;
    edge.error = near > 0 ? sqrt(squares / near) : 0.0;
    return edge;
}

/* An ellipse through the steps of five rays. */
static int try_five(rim *r, follow_ellipse *e)
{
    double points[10];
    for (int i = 0; i < 5; ++i) {
        /* From each fifth of the circle one, so that they stand well apart. */
        const int index = (int)(fst_draw(&r->chance) % (RAYS / 5)) + i * (RAYS / 5);
        const ray *from = &r->rays[index];
        if (from->count == 0)
            return 0;
        const double way = from->way[fst_draw(&r->chance) % (uint64_t)from->count];
        points[2 * i] = r->middle[0] + way * cos(angle_of(index));
        points[2 * i + 1] = r->middle[1] + way * sin(angle_of(index));
    }
    return follow_ellipse_fit(points, 5, e) && e->axes[1] > 0.3 * e->axes[0];
}

/* The ellipse that most rays meet, fitted to their steps; returns how many. */
static int find_ellipse(rim *r, follow_ellipse *found)
{
    double points[2 * RAYS];
    int most = 0;
    for (int trial = 0; trial < TRIALS; ++trial) {
        follow_ellipse e;
        if (!try_five(r, &e))
            continue;
        const int count = on_ellipse(r, &e, NEAR, points);
        if (count > most) {
            most = count;
            *found = e;
        }
    }
    for (int repeat = 0; repeat < REPEATS && most >= 5; ++repeat) {
        follow_ellipse e;
        const int count = on_ellipse(r, found, repeat ? 0.5 * NEAR : NEAR, points);
        if (!follow_ellipse_fit(points, count, &e))
            break;
        *found = e;
        most = count;
    }
    return most;
}

/* Put an edge into its place, the steepest first. */
static void keep_edge(follow_rim *rim_found, const follow_ellipse *ellipse, fst_plate_edge edge)
{
    int at = rim_found->count++;
    for (; at > 0 && rim_found->edges[at - 1].contrast < edge.contrast; --at) {
        rim_found->edges[at] = rim_found->edges[at - 1];
        rim_found->ellipses[at] = rim_found->ellipses[at - 1];
    }
    rim_found->edges[at] = edge;
    rim_found->ellipses[at] = *ellipse;
}

/* The outermost edge that is not faint. */
static int outermost(const follow_rim *rim_found)
{
    int best = 0;
    for (int i = 1; i < rim_found->count; ++i)
        if (rim_found->edges[i].contrast >= STRONG * rim_found->edges[0].contrast &&
            rim_found->edges[i].diameter[0] > rim_found->edges[best].diameter[0])
            best = i;
    return best;
}

fst_status follow_rim_find(const follow_still *still, const char *path, const double middle[2], double within,
                           follow_rim *rim_found, fst_error *error)
{
    rim *r = malloc(sizeof *r);
    *rim_found = (follow_rim){.taken = -1};
    if (!r)
        return fst_fail(error, FST_NO_MEMORY, path, "no memory for the edge of the plate");
    *r = (rim){.still = still, .middle = {middle[0], middle[1]}, .chance = 1};
    for (int i = 0; i < RAYS; ++i)
        look_along(r, i, within);
    follow_ellipse e;
    while (rim_found->count < FST_PLATE_EDGES && find_ellipse(r, &e) >= LEAST_SHARE * RAYS)
        keep_edge(rim_found, &e, take_steps(r, &e));
    free(r);
    if (rim_found->count == 0)
        return fst_fail(error, FST_BAD_INPUT, path,
                        "the edge of the plate was not found: it must stand out from what is beyond it, and at "
                        "least half of it must be in the picture; give two points or four instead");
    rim_found->taken = outermost(rim_found);
    return FST_OK;
}
