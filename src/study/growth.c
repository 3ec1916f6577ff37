/* growth.c - weighted means of growth, and what the differences between them say about the error. */
#include "study/growth.h"

#include <math.h>

#include "base/constants.h"
#include "base/elementary.h"

/* Windows of the time, in the order in which growth->rate has them: `count` windows of the length 1/parts, each
 * begun `hop` after the one before. */
static const struct {
    int first, count;
    double length, hop;
} GROUPS[] = {
    {0, 1, 1.0, 0.0},         {1, 2, 1.0 / 2, 1.0 / 2},    {3, 3, 1.0 / 3, 1.0 / 3},
    {6, 7, 1.0 / 4, 1.0 / 8}, {13, 15, 1.0 / 8, 1.0 / 16},
};
enum { WHOLE, HALVES, THIRDS, QUARTERS, EIGHTHS, GROUP_COUNT };

/* The share of a window's weight that lies before the fraction s of it. */
static double weight_before(double s)
{
    if (s <= 0.0)
        return 0.0;
    double sine, cosine;
    fst_sin_cos_degrees(360.0 * s, &sine, &cosine);
    return s >= 1.0 ? 1.0 : s - sine / FST_TWO_PI;
}

void fst_growth_pass(fst_growth_clock *clock, double piece)
{
    const double from = clock->passed / clock->duration, to = (clock->passed + piece) / clock->duration;
    for (int g = 0; g < GROUP_COUNT; ++g)
        for (int i = 0; i < GROUPS[g].count; ++i) {
            const double start = i * GROUPS[g].hop, length = GROUPS[g].length;
            clock->weight[GROUPS[g].first + i] =
                (weight_before((to - start) / length) - weight_before((from - start) / length)) / piece;
        }
    clock->passed += piece;
}

void fst_growth_add(fst_growth *growth, const fst_growth_clock *clock, double logarithm)
{
    for (int i = 0; i < FST_GROWTH_WINDOWS; ++i)
        if (clock->weight[i] > 0.0)
            growth->rate[i] += clock->weight[i] * logarithm;
}

/* Standard error of the whole from the scatter of a group's windows: the variance of a mean goes as the inverse
 * of its window's length. */
static double scatter(const fst_growth *growth, int group)
{
    const double *rates = growth->rate + GROUPS[group].first;
    const int n = GROUPS[group].count;
    double mean = 0.0, square = 0.0;
    for (int i = 0; i < n; ++i)
        mean += rates[i] / n;
    for (int i = 0; i < n; ++i)
        square += (rates[i] - mean) * (rates[i] - mean);
    return sqrt(square / (n - 1) * GROUPS[group].length);
}

/* Half of what the halves differ by, which is the standard error of the whole from two values.  Where the
 * thirds drift one way, and the halves differ by more than twice as much as by chance (two errors of the whole,
 * `chance`), the mean has not settled yet, and the whole difference is taken. */
static double drift(const fst_growth *growth, double chance)
{
    const double *halves = growth->rate + GROUPS[HALVES].first, *thirds = growth->rate + GROUPS[THIRDS].first;
    const double difference = fabs(halves[1] - halves[0]);
    const int one_way = (thirds[1] - thirds[0]) * (thirds[2] - thirds[1]) > 0.0;
    return (one_way && difference > 4.0 * chance ? 1.0 : 0.5) * difference;
}

fst_growth_rate fst_growth_conclude(const fst_growth *growth)
{
    const double eighths = scatter(growth, EIGHTHS);
    const double error = fmax(fmax(eighths, scatter(growth, QUARTERS)), drift(growth, eighths));
    return (fst_growth_rate){growth->rate[0], error, eighths};
}
