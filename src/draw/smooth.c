/* smooth.c - cubics through points in the plane, over the length of their chords.
 *
 * Branches and orbits are computed at points that suit the computation, which are few where the curve is easy
 * to follow; straight pieces between them look like corners of the physics.  The slope at a point is that of
 * the parabola through it and its neighbours, over the length of the chords, so that the curve follows folds
 * too. */
#include "draw/smooth.h"

#include <math.h>

enum {
    PARTS = 8,    /* the most pieces of the smooth curve between two points */
    ENOUGH = 1600 /* about as many points as the smooth curves need */
};

typedef struct curve {
    const double *x, *y;
    size_t count;
    double wide, tall;
} curve;

/* The length of the chord from point i to the next. */
static double chord(const curve *c, size_t i)
{
    return hypot((c->x[i + 1] - c->x[i]) / c->wide, (c->y[i + 1] - c->y[i]) / c->tall);
}

/* The slope, over the length of the chords, of one coordinate at point i. */
static double slope(const curve *c, const double *values, size_t i)
{
    const size_t last = c->count - 1;
    if (c->count == 2)
        return (values[1] - values[0]) / chord(c, 0);
    const size_t middle = i == 0 ? 1 : i == last ? last - 1 : i; /* of the parabola */
    const double before = chord(c, middle - 1), after = chord(c, middle);
    const double rise = (values[middle] - values[middle - 1]) / before;
    const double next = (values[middle + 1] - values[middle]) / after;
    if (i == middle)
        return (rise * after + next * before) / (before + after);
    const double bend = (next - rise) / (before + after);
    return i < middle ? rise - bend * before : next + bend * after;
}

/* Whether a chord is so much longer than those beside it that a cubic would bulge out of its ends' ranges. */
static int is_leap(const curve *c, size_t i)
{
    const double before = i > 0 ? chord(c, i - 1) : 0.0, after = i + 2 < c->count ? chord(c, i + 1) : 0.0;
    return c->count > 2 && chord(c, i) > 4.0 * fmax(before, after);
}

size_t fst_smooth(const double *x, const double *y, size_t count, int parts, double wide, double tall,
                  double *to_x, double *to_y)
{
    const curve c = {x, y, count, wide > 0 ? wide : 1.0, tall > 0 ? tall : 1.0};
    size_t used = 0;
    int repeated = 0; /* a point given twice has no chord */
    for (size_t i = 0; i + 1 < count; ++i)
        repeated = repeated || !(chord(&c, i) > 0.0);
    for (size_t i = 0; i + 1 < count; ++i) {
        const double h = chord(&c, i);
        const int leap = is_leap(&c, i);
        for (int k = 0; k < (repeated ? 1 : parts); ++k, ++used) {
            const double s = (double)k / parts, t = 1.0 - s;
            to_x[used] = x[i];
            to_y[used] = y[i];
            if (leap) {
                to_x[used] = t * x[i] + s * x[i + 1];
                to_y[used] = t * y[i] + s * y[i + 1];
            }
            if (k == 0 || leap)
                continue;
            to_x[used] = t * t * ((1.0 + 2.0 * s) * x[i] + s * h * slope(&c, x, i)) +
                         s * s * ((1.0 + 2.0 * t) * x[i + 1] - t * h * slope(&c, x, i + 1));
            to_y[used] = t * t * ((1.0 + 2.0 * s) * y[i] + s * h * slope(&c, y, i)) +
                         s * s * ((1.0 + 2.0 * t) * y[i + 1] - t * h * slope(&c, y, i + 1));
        }
    }
    if (count > 0) {
        to_x[used] = x[count - 1];
        to_y[used++] = y[count - 1];
    }
    return used;
}

/* ------------------------------------------------------------------ columns */

int fst_columns_make(fst_chart *chart, fst_columns *c, size_t capacity)
{
    c->x = fst_chart_keep(chart, (capacity + 1) * sizeof *c->x);
    c->y = fst_chart_keep(chart, (capacity + 1) * sizeof *c->y);
    c->count = 0;
    return c->x && c->y;
}

void fst_columns_put(fst_columns *c, double x, double y)
{
    c->x[c->count] = x;
    c->y[c->count++] = y;
}

/* Keep points that are given twice once; returns how many are left of the piece. */
static size_t without_twins(double *x, double *y, size_t count, double wide, double tall)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i)
        if (kept == 0 || fabs(x[i] - x[kept - 1]) > 1e-9 * wide || fabs(y[i] - y[kept - 1]) > 1e-9 * tall) {
            x[kept] = x[i];
            y[kept++] = y[i];
        }
    return kept;
}

/* Whether an ordinate grows by orders of magnitude: cubics would swing, and go through its logarithm. */
static int grows_much(const double *y, size_t count)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        low = fmin(low, y[i]);
        high = fmax(high, y[i]);
    }
    return low > 0.0 && high > 100.0 * low;
}

/* Put a smooth curve through a piece. */
static void put_smooth(fst_columns *to, double *x, double *y, size_t count, int parts, double wide, double tall)
{
    const int by_logarithm = grows_much(y, count);
    if (by_logarithm) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < count; ++i) {
            y[i] = log(y[i]);
            low = fmin(low, y[i]);
            high = fmax(high, y[i]);
        }
        tall = high - low;
    }
    count = without_twins(x, y, count, wide, tall);
    const size_t made = fst_smooth(x, y, count, parts, wide, tall, to->x + to->count, to->y + to->count);
    for (size_t i = 0; by_logarithm && i < made; ++i)
        to->y[to->count + i] = exp(to->y[to->count + i]);
    to->count += made;
}

int fst_columns_smoothen(fst_chart *chart, fst_columns *c)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    fst_columns smooth = {NULL, NULL, 0};
    if (c->count < 3)
        return 1;
    const size_t wanted = 1 + ENOUGH / c->count;
    const int parts = wanted < PARTS ? (int)wanted : PARTS;
    if (!fst_columns_make(chart, &smooth, PARTS * c->count))
        return 0;
    for (size_t i = 0; i < c->count; ++i) {
        low[0] = fmin(low[0], c->x[i]);
        high[0] = fmax(high[0], c->x[i]);
        low[1] = fmin(low[1], c->y[i]);
        high[1] = fmax(high[1], c->y[i]);
    }
    for (size_t i = 0; i < c->count;) {
        size_t last = i;
        while (last < c->count && isfinite(c->x[last]) && isfinite(c->y[last]))
            ++last;
        if (last > i)
            put_smooth(&smooth, c->x + i, c->y + i, last - i, parts, high[0] - low[0], high[1] - low[1]);
        fst_columns_put(&smooth, NAN, NAN);
        i = last + 1;
    }
    *c = smooth;
    return 1;
}
