/* light.c - what is learnt of all frames: the light on each point of the face, and the surface of the bead. */
#include "follow/pose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/dot.h"
#include "base/order.h"
#include "base/turn.h"

enum { SHARPENED = 2 }; /* times */

#define LEAST_PART 0.35  /* of the usual spread: a point that changes less is a highlight */
#define STEEP 4.0        /* the twist, over the height of n */
#define TWIST 0.02       /* rad, by which it is tried */
#define LEAST_SIGMA 2e-3 /* of the plate's level */
#define BESIDE 0.2       /* radii around a highlight that it may reach */

double follow_light_begin(follow_turning *t)
{
    double parts[FOLLOW_MOST_POINTS], bright = 0.0;
    size_t inner = 0;
    memset(t->view, 0, sizeof t->view);
    for (int i = 0; i < t->count; ++i) {
        bright += t->turns[i].bright / t->count;
        for (int j = 0; j < 9; ++j)
            t->view[j / 3][j % 3] += t->turns[i].view[j / 3][j % 3] / t->count;
    }
    for (int k = 0; k < t->points; ++k) {
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < t->count; ++i) {
            const double level = follow_seen(t, &t->turns[i], k);
            sum += level / t->count;
            squares += level * level / t->count;
        }
        t->even[k] = t->marked[k] = sum;
        t->spread[k] = sqrt(fmax(0.0, squares - sum * sum));
        t->used[k] = hypot(t->grid[k][0], t->grid[k][1]) < FOLLOW_INNER;
        if (t->used[k])
            parts[inner++] = t->spread[k] / fmax(1e-3, sum);
    }
    const double usual = fst_median(parts, inner);
    inner = 0;
    for (int k = 0; k < t->points; ++k) {
        const int seen_well = t->used[k];
        for (int i = 0; i < t->points && seen_well; ++i) /* a highlight, or beside one */
            if (hypot(t->grid[i][0], t->grid[i][1]) < FOLLOW_INNER &&
                t->spread[i] < LEAST_PART * usual * t->even[i] &&
                hypot(t->grid[k][0] - t->grid[i][0], t->grid[k][1] - t->grid[i][1]) < BESIDE)
                t->used[k] = 0;
        if (seen_well)
            parts[inner++] = t->spread[k];
    }
    const double spread = fst_median(parts, inner);
    for (int k = 0; k < t->points; ++k)
        t->sigma[k] = fmax(0.3 * spread, 0.5 / bright);
    return spread * bright;
}

void follow_light_learn(follow_turning *t)
{
    double(*sums)[5] = calloc((size_t)t->points, sizeof *sums);
    for (int i = 0; sums && i < t->count; ++i) {
        const follow_turn *f = &t->turns[i];
        if (!f->good)
            continue;
        follow_face(t, f);
        for (int k = 0; k < t->points; ++k) {
            double point[3], a;
            follow_on_bead(f->pose.turn, t->facing[k], point);
            if (!follow_sphere_at(&t->sphere, point, &a, NULL))
                continue;
            const double level = follow_seen(t, f, k) / f->pose.gain - (t->light[k][0] - t->even[k]) -
                                 a * (t->light[k][1] - t->marked[k]),
                         terms[5] = {1.0, a, a * a, level, level * a};
            for (int j = 0; j < 5; ++j)
                sums[k][j] += terms[j];
        }
    }
    for (int k = 0; sums && k < t->points; ++k) {
        const double *s = sums[k], spread = s[0] * s[2] - s[1] * s[1];
        if (!(s[0] > 20.0) || !(spread > 0.01 * s[0] * s[2]))
            continue;
        t->marked[k] = fmax(0.0, (s[0] * s[4] - s[1] * s[3]) / spread);
        t->even[k] = (s[3] - t->marked[k] * s[1]) / s[0];
    }
    for (int k = 0; sums && k < t->points; ++k) /* from now on the outline tells where the centre is */
        t->used[k] |= hypot(t->grid[k][0], t->grid[k][1]) >= FOLLOW_INNER;
    follow_slopes(t);
    free(sums);
}

void follow_surface_learn(follow_turning *t)
{
    follow_sphere_clear(&t->sphere);
    for (int time = 0; time <= SHARPENED; ++time) {
        follow_sphere_clear(&t->rest);
        for (int i = 0; i < t->count; ++i)
            if (t->turns[i].good) {
                follow_face(t, &t->turns[i]);
                (time == 0 ? follow_show : follow_show_rest)(t, &t->turns[i]);
            }
        follow_sphere_sharpen(&t->sphere, &t->rest);
    }
}

void follow_centre(follow_turning *t)
{
    double mean[2] = {0.0, 0.0};
    for (int i = 0; i < t->count; ++i)
        for (int k = 0; k < 2; ++k)
            mean[k] += t->turns[i].shift[k] / t->count;
    for (int i = 0; i < t->count; ++i)
        for (int k = 0; k < 2; ++k)
            t->turns[i].shift[k] -= mean[k];
}

double follow_explain(follow_turning *t)
{
    double left = 0.0, all = 0.0, squares[FOLLOW_MOST_POINTS] = {0.0};
    int counts[FOLLOW_MOST_POINTS] = {0};
    for (int i = 0; i < t->count; ++i) {
        const follow_turn *f = &t->turns[i];
        follow_face(t, f);
        for (int k = 0; k < t->points; ++k) {
            double point[3], a;
            follow_on_bead(f->pose.turn, t->facing[k], point);
            if (!t->used[k] || !follow_sphere_at(&t->sphere, point, &a, NULL))
                continue;
            const double off = follow_seen(t, f, k) - f->pose.gain * (t->light[k][0] + t->light[k][1] * a);
            squares[k] += off * off;
            left += off * off;
            all += t->spread[k] * t->spread[k];
            ++counts[k];
        }
    }
    for (int k = 0; k < t->points; ++k)
        if (counts[k] > 0)
            t->sigma[k] = fmax(sqrt(squares[k] / counts[k]), LEAST_SIGMA);
    return all > 0.0 ? 1.0 - left / all : 0.0;
}

/* Turn the bead about n, one way where n points up and the other way where it points down.  Returns which part is explained. */
static double twist(follow_turning *t, const double axis[3], double angle)
{
    for (int i = 0; i < t->count; ++i) {
        double n[3];
        for (int k = 0; k < 3; ++k)
            n[k] = fst_dot(t->turns[i].pose.turn[k], axis, 3);
        const double part = angle * tanh(STEEP * n[2]);
        fst_turn_by(t->turns[i].pose.turn, (const double[3]){part * n[0], part * n[1], part * n[2]});
    }
    follow_surface_learn(t);
    return follow_explain(t);
}

int follow_untwist(follow_turning *t)
{
    double axis[3], by = 0.0;
    if (!follow_sphere_axis(&t->sphere, axis))
        return 0;
    const double middle = twist(t, axis, 0.0), less = twist(t, axis, -TWIST),
                 more = twist(t, axis, 2.0 * TWIST), bend = 2.0 * middle - less - more;
    if (bend > 0.0)
        by = fmax(-3.0, fmin(3.0, 0.5 * (more - less) / bend));
    (void)twist(t, axis, (by - 1.0) * TWIST);
    return fabs(by) > 0.1;
}
