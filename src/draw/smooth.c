/* smooth.c - cubics through points in the plane, over the length of their chords.
 *
 * Branches and orbits are computed at points that suit the computation, which are few where the curve is easy
 * to follow; straight pieces between them look like corners of the physics.  The slope at a point is that of
 * the parabola through it and its neighbours, over the length of the chords, so that the curve follows folds
 * too. */
#include <festoon/festoon_tools.h>

#include <math.h>

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
