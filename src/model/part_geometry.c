/* part_geometry.c - where the parts of a magnet are: as an outline seen from above, and beside a place. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "model/model.h"
#include "model/waveform.h"

/* Half the extent of a part along a direction of the magnet's frame, a unit vector. */
static double reach(const fst_magnet_part *part, const double direction[3])
{
    double axes[3][3], along[3];
    fst_set_axes_double(part->rotation, axes);
    for (int a = 0; a < 3; ++a)
        along[a] = fabs(axes[a][0] * direction[0] + axes[a][1] * direction[1] + axes[a][2] * direction[2]);
    switch (part->kind) {
    case FST_PART_CUBOID:
        return 0.5 * (part->size[0] * along[0] + part->size[1] * along[1] + part->size[2] * along[2]);
    case FST_PART_CYLINDER:
        return 0.5 * (part->size[0] * hypot(along[0], along[1]) + part->size[1] * along[2]);
    case FST_PART_SPHERE:
        return 0.5 * part->size[0];
    default:
        return 0.0;
    }
}

/* From the part's own axes to the magnet's, from its centre. */
static void outwards(const fst_magnet_part *part, double axes[3][3], const double own[3], double place[3])
{
    for (int i = 0; i < 3; ++i)
        place[i] = part->centre[i] + axes[0][i] * own[0] + axes[1][i] * own[1] + axes[2][i] * own[2];
}

/* ------------------------------------------------------------------ seen from above */

/* Points of which the convex hull is the part; of a sphere, one circle. */
static int rim_points(const fst_magnet_part *part, double axes[3][3], double points[FST_OUTLINE_MOST][3])
{
    const int round = part->kind == FST_PART_CYLINDER || part->kind == FST_PART_SPHERE;
    const int rims = part->kind == FST_PART_SPHERE ? 1 : 2, around = round ? FST_OUTLINE_MOST / rims : 4;
    for (int i = 0; i < rims * around; ++i) {
        const double angle = FST_TWO_PI * (i % around) / around;
        double own[3];
        if (round) {
            own[0] = 0.5 * part->size[0] * cos(angle);
            own[1] = 0.5 * part->size[0] * sin(angle);
            own[2] = (i < around ? 0.5 : -0.5) * part->size[1]; /* of a sphere 0 */
        } else {
            own[0] = (i & 1 ? 0.5 : -0.5) * part->size[0];
            own[1] = (i & 2 ? 0.5 : -0.5) * part->size[1];
            own[2] = (i & 4 ? 0.5 : -0.5) * part->size[2];
        }
        outwards(part, axes, own, points[i]);
    }
    return rims * around;
}

static int compare_points(const void *a, const void *b)
{
    const double *p = a, *q = b;
    if (p[0] != q[0])
        return p[0] < q[0] ? -1 : 1;
    return p[1] < q[1] ? -1 : p[1] > q[1];
}

static double turns_left(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* The convex hull by Andrew's monotone chain: the lower side from left to right, then the upper one back. */
static int convex_hull(double points[FST_OUTLINE_MOST][3], int count, double size,
                       double hull[FST_OUTLINE_MOST][2])
{
    double chain[2 * FST_OUTLINE_MOST][2];
    const double flat = 1e-12 * size * size; /* three points in a line, but for rounding */
    int length = 0;
    qsort(points, (size_t)count, sizeof points[0], compare_points);
    for (int side = 0; side < 2; ++side) {
        const int least = side ? length + 1 : 2;
        for (int k = side; k < count; ++k) {
            const double *next = points[side ? count - 1 - k : k];
            while (length >= least && turns_left(chain[length - 2], chain[length - 1], next) <= flat)
                --length;
            memcpy(chain[length++], next, sizeof chain[0]); /* seen from above */
        }
    }
    --length; /* the first point again */
    length = length < FST_OUTLINE_MOST ? length : FST_OUTLINE_MOST;
    memcpy(hull, chain, (size_t)length * sizeof chain[0]);
    return length;
}

fst_part_shape fst_part_seen(const fst_magnet_part *part)
{
    static const double up[3] = {0, 0, 1};
    const double *strength = part->kind == FST_PART_DIPOLE ? part->moment : part->remanence;
    double axes[3][3], points[FST_OUTLINE_MOST][3];
    fst_part_shape shape;
    memset(&shape, 0, sizeof shape);
    static const double upright[4] = {0, 0, 0, 1};
    fst_set_axes_double(part->rotation, axes);
    for (int i = 0; i < 3; ++i)
        shape.magnetisation[i] = axes[0][i] * strength[0] + axes[1][i] * strength[1] + axes[2][i] * strength[2];
    shape.low = part->centre[2] - reach(part, up);
    shape.high = part->centre[2] + reach(part, up);
    if (part->kind == FST_PART_SPHERE)
        fst_set_axes_double(upright, axes); /* however it is turned, it looks the same */
    if (part->kind != FST_PART_DIPOLE) {
        const double size = fmax(part->size[0], fmax(part->size[1], part->size[2]));
        shape.count = convex_hull(points, rim_points(part, axes, points), size, shape.corners);
    }
    return shape;
}

/* ------------------------------------------------------------------ a place and the parts */

static double beyond(double coordinate, double half)
{
    return fmax(fabs(coordinate) - half, 0.0);
}

/* A place on the part's own axes, from its centre. */
static void inwards(const fst_magnet_part *part, double axes[3][3], const double place[3], double own[3])
{
    for (int a = 0; a < 3; ++a) {
        own[a] = 0.0;
        for (int i = 0; i < 3; ++i)
            own[a] += axes[a][i] * (place[i] - part->centre[i]);
    }
}

double fst_part_distance(const fst_magnet_part *part, const double place[3])
{
    double axes[3][3], d[3];
    fst_set_axes_double(part->rotation, axes);
    inwards(part, axes, place, d);
    const double *size = part->size;
    switch (part->kind) {
    case FST_PART_CUBOID:
        return hypot(hypot(beyond(d[0], 0.5 * size[0]), beyond(d[1], 0.5 * size[1])),
                     beyond(d[2], 0.5 * size[2]));
    case FST_PART_CYLINDER:
        return hypot(beyond(hypot(d[0], d[1]), 0.5 * size[0]), beyond(d[2], 0.5 * size[1]));
    case FST_PART_SPHERE:
        return beyond(hypot(hypot(d[0], d[1]), d[2]), 0.5 * size[0]);
    default:
        return hypot(hypot(d[0], d[1]), d[2]);
    }
}

/* ------------------------------------------------------------------ two parts */

enum { LOOKED_AT = 3 }; /* degrees of the magnet's turn */

static double thickness(const fst_magnet_part *part)
{
    const double *size = part->size;
    return part->kind == FST_PART_SPHERE     ? size[0]
           : part->kind == FST_PART_CYLINDER ? fmin(size[0], size[1])
                                             : fmin(size[0], fmin(size[1], size[2]));
}

/* Shorten a vector of some components to a length. */
static void shorten(double *v, int count, double most)
{
    const double length = count == 1   ? fabs(v[0])
                          : count == 2 ? hypot(v[0], v[1])
                                       : hypot(hypot(v[0], v[1]), v[2]);
    for (int i = 0; i < count && length > most; ++i)
        v[i] *= most / length;
}

/* Move a place to the nearest one within a part, `depth` below its surface at least. */
static void move_within(const fst_magnet_part *part, double depth, double place[3])
{
    double axes[3][3], own[3];
    fst_set_axes_double(part->rotation, axes);
    inwards(part, axes, place, own);
    for (int a = 0; a < 3 && part->kind == FST_PART_CUBOID; ++a)
        shorten(&own[a], 1, 0.5 * part->size[a] - depth);
    if (part->kind != FST_PART_CUBOID)
        shorten(own, part->kind == FST_PART_SPHERE ? 3 : 2, 0.5 * part->size[0] - depth);
    if (part->kind == FST_PART_CYLINDER)
        shorten(&own[2], 1, 0.5 * part->size[1] - depth);
    outwards(part, axes, own, place);
}

/* Whether a plane across the way between a place in one part and one in the other has them on its two sides. */
static int are_apart(const fst_magnet_part *one, const fst_magnet_part *other, const double way[3],
                     double length)
{
    double along[3], gap = 0.0;
    for (int i = 0; i < 3; ++i) {
        along[i] = way[i] / length;
        gap += along[i] * (one->centre[i] - other->centre[i]);
    }
    return gap > reach(one, along) + reach(other, along);
}

/* A place goes to and fro between the two, whose cores are convex: it comes as near to both as there is one.  A place in the
 * core of one that is nearer to the core of the other than that lies below the surface is within both. */
int fst_parts_overlap(const fst_magnet_part *one, const fst_magnet_part *other)
{
    enum { ROUNDS = 1000 };
    if (one->kind == FST_PART_DIPOLE || other->kind == FST_PART_DIPOLE)
        return 0;
    const double depth = 5e-4 * fmin(thickness(one), thickness(other));
    double place[3], from[3];
    memcpy(place, one->centre, sizeof place);
    for (int i = 0; i < ROUNDS; ++i) {
        move_within(other, depth, place);
        memcpy(from, place, sizeof from);
        move_within(one, depth, place);
        const double way[3] = {place[0] - from[0], place[1] - from[1], place[2] - from[2]};
        const double length = hypot(hypot(way[0], way[1]), way[2]);
        if (length < depth)
            return 1;
        if (are_apart(one, other, way, length))
            return 0;
    }
    return 0;
}

/* A part that has turned with the magnet: its rotation (cos, sin k) of half angles, times that about z. */
static fst_magnet_part turned(const fst_magnet_part *part, double degrees)
{
    fst_magnet_part now = *part;
    const double *k = part->rotation + 1, half = 0.5 * FST_TWO_PI / 360.0,
                 size = hypot(hypot(k[0], k[1]), k[2]);
    const double c = cos(half * degrees), s = sin(half * degrees);
    const double w = cos(half * part->rotation[0]),
                 v = part->rotation[0] == 0.0 ? 0.0 : sin(half * part->rotation[0]) / size;
    const double x = v * k[0], y = v * k[1], z = v * k[2];
    const double axis[3] = {c * x - s * y, c * y + s * x, c * z + s * w},
                 sine = hypot(hypot(axis[0], axis[1]), axis[2]);
    now.centre[0] = (c * c - s * s) * part->centre[0] - 2.0 * c * s * part->centre[1];
    now.centre[1] = (c * c - s * s) * part->centre[1] + 2.0 * c * s * part->centre[0];
    now.rotation[0] = sine > 0.0 ? 2.0 * atan2(sine, c * w - s * z) * 360.0 / FST_TWO_PI : 0.0;
    memcpy(now.rotation + 1, sine > 0.0 ? axis : k, sizeof axis);
    return now;
}

/* The least and the greatest angle of the magnet, in degrees, of those in a turn about 0. */
static void turns_from_to(const fst_params *p, double turn[2])
{
    const fst_groups units = {.time_unit = 1.0, .length_unit = 1.0};
    const int kind = p->drive_waveform;
    fst_waveform wave;
    turn[1] = kind == FST_WAVEFORM_OSCILLATING                            ? p->drive_amplitude
              : kind == FST_WAVEFORM_STEADY || kind == FST_WAVEFORM_CHIRP ? 180.0
                                                                          : 0.0;
    turn[0] = -turn[1];
    if (kind == FST_WAVEFORM_TABLE && fst_make_waveform(p, &units, &wave, NULL) == FST_OK) {
        turn[0] = INFINITY;
        turn[1] = -INFINITY;
        for (int i = 0; i < wave.count; ++i) {
            turn[0] = fmin(turn[0], wave.angles[i] * 360.0 / FST_TWO_PI);
            turn[1] = fmax(turn[1], wave.angles[i] * 360.0 / FST_TWO_PI);
        }
    }
    const int whole = !(turn[1] - turn[0] < 360.0);
    const double half = whole ? 180.0 : 0.5 * (turn[1] - turn[0]);
    const double middle = whole ? 0.0 : remainder(0.5 * turn[0] + 0.5 * turn[1], 360.0);
    turn[0] = middle - half;
    turn[1] = middle + half;
}

/* Whether a part that turns meets one that stands still, and by how many degrees the magnet has turned then.  What is
 * round about the axis does at any angle or at none. */
static int meet_in_a_turn(const double turn[2], const fst_magnet_part *one, const fst_magnet_part *other,
                          double *angle)
{
    static const double up[3] = {0, 0, 1};
    const fst_magnet_part *moving = one->motion == FST_PART_TURNING ? one : other,
                          *still = moving == one ? other : one;
    if (moving->motion == still->motion ||
        fabs(one->centre[2] - other->centre[2]) > reach(one, up) + reach(other, up))
        return 0;
    for (int i = 0; i <= 2 * (int)ceil(fmax(-turn[0], turn[1]) / LOOKED_AT); ++i) {
        *angle = fmax(turn[0], fmin((i % 2 ? -LOOKED_AT : LOOKED_AT) * ((i + 1) / 2), turn[1]));
        const fst_magnet_part now = turned(moving, *angle);
        if (fst_parts_overlap(&now, still))
            return 1;
    }
    return 0;
}

/* Whether a part lies wholly within another one. */
static int lies_within(const fst_magnet_part *inner, const fst_magnet_part *outer)
{
    const double slack = 5e-4 * fmin(thickness(inner), thickness(outer));
    double axes[3][3], points[FST_OUTLINE_MOST][3], place[3];
    if (inner->kind == FST_PART_SPHERE) {
        memcpy(place, inner->centre, sizeof place);
        move_within(outer, 0.5 * inner->size[0] - slack, place);
        return hypot(hypot(place[0] - inner->centre[0], place[1] - inner->centre[1]),
                     place[2] - inner->centre[2]) < slack;
    }
    fst_set_axes_double(inner->rotation, axes);
    int within = 1;
    for (int i = rim_points(inner, axes, points) - 1; i >= 0; --i)
        within &= fst_part_distance(outer, points[i]) < slack;
    return within;
}

/* Whether what one adds to the magnetisation the other takes away. */
static int cancel(const fst_magnet_part *one, const fst_magnet_part *other)
{
    const fst_part_shape a = fst_part_seen(one), b = fst_part_seen(other);
    const double *m = a.magnetisation, *n = b.magnetisation;
    return hypot(hypot(m[0] + n[0], m[1] + n[1]), m[2] + n[2]) < 1e-6 * hypot(hypot(m[0], m[1]), m[2]);
}

/* Whether the parts in which one is a hole contain its surface together, which is seen on rims.  Between them it may
 * still reach beyond: nothing is said of what is not sure. */
static int lies_in_bodies(const fst_params *p, const fst_magnet_part *hole)
{
    const double slack = 5e-4 * thickness(hole);
    double axes[5][3], points[FST_OUTLINE_MOST][3];
    int within = 1;
    fst_set_axes_double(hole->rotation, axes);
    memcpy(axes[3], axes[0], 2 * sizeof axes[0]);
    for (int turn = 0; turn < (hole->kind == FST_PART_SPHERE ? 3 : 1);
         ++turn) /* a sphere's circle, about each axis */
        for (int i = rim_points(hole, &axes[turn], points) - 1; i >= 0 && within; --i) {
            within = 0;
            for (int b = 0; b < p->magnet_part_count && !within; ++b)
                within = fst_part_distance(&p->magnet_parts[b], points[i]) < slack &&
                         cancel(hole, &p->magnet_parts[b]);
        }
    return within;
}

/* Whether a part lies in a hole, which others made for it in the magnet's part `of`, or is itself such a hole. */
static int lies_in_hole(const fst_params *p, int part, int of)
{
    for (int h = 0; h < p->magnet_part_count; ++h) {
        const fst_magnet_part *hole = &p->magnet_parts[h];
        if (h != part && h != of && cancel(hole, &p->magnet_parts[of]) &&
            lies_within(hole, &p->magnet_parts[of]) && lies_within(&p->magnet_parts[part], hole))
            return 1;
    }
    return 0;
}

/* Whether two parts, of which one is in a place of the other, may be there: one is a hole in the other, or fills one. */
static int may_overlap(const fst_params *p, int a, int b)
{
    const fst_magnet_part *one = &p->magnet_parts[a], *other = &p->magnet_parts[b];
    if (cancel(one, other) && (lies_in_bodies(p, one) || lies_in_bodies(p, other)))
        return 1;
    if (lies_in_hole(p, a, b) || lies_in_hole(p, b, a))
        return 1;
    for (int c = 0; c < p->magnet_part_count; ++c) /* the hole that one fills is the other */
        if (c != a && c != b &&
            ((cancel(one, &p->magnet_parts[c]) && lies_within(one, &p->magnet_parts[c]) &&
              lies_within(other, one)) ||
             (cancel(other, &p->magnet_parts[c]) && lies_within(other, &p->magnet_parts[c]) &&
              lies_within(one, other))))
            return 1;
    return 0;
}

/* The first two parts that meet while the magnet turns. */
static int meet(const fst_params *p, char *sentence, size_t size)
{
    double angle, turn[2];
    turns_from_to(p, turn);
    for (int a = 0; a < p->magnet_part_count && p->magnet_shape == FST_MAGNET_PARTS; ++a)
        for (int b = a + 1; b < p->magnet_part_count; ++b)
            if (!may_overlap(p, a, b) &&
                meet_in_a_turn(turn, &p->magnet_parts[a], &p->magnet_parts[b], &angle)) {
                (void)snprintf(sentence, size,
                               "magnet.parts[%d] and magnet.parts[%d], of which one turns and the other stands "
                               "still, meet "
                               "where the magnet has turned by %.4g degrees (looked at every %d)",
                               a, b, angle, LOOKED_AT);
                return 1;
            }
    return 0;
}

int fst_parts_contradiction(const fst_params *p, char *sentence, size_t size)
{
    int pairs = 0, first[2] = {0, 0};
    char others[48] = "";
    for (int a = 0; a < p->magnet_part_count && p->magnet_shape == FST_MAGNET_PARTS; ++a)
        for (int b = a + 1; b < p->magnet_part_count; ++b)
            if (fst_parts_overlap(&p->magnet_parts[a], &p->magnet_parts[b]) && !may_overlap(p, a, b) &&
                ++pairs == 1) {
                first[0] = a;
                first[1] = b;
            }
    if (pairs == 0)
        return meet(p, sentence, size);
    if (pairs > 1)
        (void)snprintf(others, sizeof others, " (as %d other pair%s)", pairs - 1, pairs > 2 ? "s do" : " does");
    if (cancel(&p->magnet_parts[first[0]], &p->magnet_parts[first[1]]))
        (void)snprintf(
            sentence, size,
            "magnet.parts[%d] and magnet.parts[%d] make a hole that reaches beyond its body: there it is a "
            "magnet of its own",
            first[0], first[1]);
    else
        (void)snprintf(
            sentence, size,
            "magnet.parts[%d] and magnet.parts[%d] overlap%s: where both are their magnetisations add",
            first[0], first[1], others);
    return 1;
}

int fst_part_touched(const fst_params *params, const double place[3], double radius)
{
    for (int i = 0; i < params->magnet_part_count; ++i)
        if (fst_part_distance(&params->magnet_parts[i], place) <= radius)
            return i;
    return -1;
}
