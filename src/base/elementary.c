/* elementary.c - elementary functions from + - * / and square roots alone, so that every machine gives the same
 * bits. */
#include "base/elementary.h"

#include <math.h>

#include "base/constants.h"

/* Taylor's series for |x| <= pi/4; the first term left out is below 2^-64 of the result. */
static double sine_series(double x)
{
    static const double c[] = {-1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
                               -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
    const double x2 = x * x;
    double sum = 0.0;
    for (int i = 7; i >= 0; --i)
        sum = (sum + c[i]) * x2;
    return x + x * sum;
}

static double cosine_series(double x)
{
    static const double c[] = {1.0 / 24,        -1.0 / 720,         1.0 / 40320,         -1.0 / 3628800,
                               1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
    const double x2 = x * x;
    double sum = 0.0;
    for (int i = 6; i >= 0; --i)
        sum = (sum + c[i]) * x2;
    return 1.0 - (0.5 * x2 - x2 * sum);
}

void fst_sin_cos_degrees(double degrees, double *sine, double *cosine)
{
    /* Take off whole turns and then quarter turns; for whole degrees this is exact.  Then |rest| <= 45. */
    double rest = degrees - 360.0 * (double)(long long)(degrees / 360.0);
    const int quarters = (int)(rest / 90.0 + (rest < 0 ? -0.5 : 0.5));
    rest -= 90.0 * quarters;
    const double radians = rest * 0.017453292519943295769;
    const double s = sine_series(radians), c = cosine_series(radians);
    switch (((quarters % 4) + 4) % 4) {
    case 0:
        *sine = s, *cosine = c;
        break;
    case 1:
        *sine = c, *cosine = -s;
        break;
    case 2:
        *sine = -s, *cosine = -c;
        break;
    default:
        *sine = -c, *cosine = s;
    }
}

/* atan(i/8), i from 0 to 8. */
static const double EIGHTHS[] = {0.0,
                                 0.12435499454676144,
                                 0.24497866312686414,
                                 0.35877067027057225,
                                 0.4636476090008061,
                                 0.5585993153435624,
                                 0.6435011087932844,
                                 0.7188299996216245,
                                 0.7853981633974483};

/* The angle of (x, y), 0 <= y <= x: that of the nearest eighth, and Taylor's series for the rest z <= 1/16. */
static double angle_below_45(double y, double x)
{
    static const double c[] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15};
    const int i = (int)(8.0 * (y / x) + 0.5);
    const double eighths = i / 8.0, z = (y - eighths * x) / (x + eighths * y), z2 = z * z;
    double sum = 0.0;
    for (int k = 6; k >= 0; --k)
        sum = (sum + c[k]) * z2;
    return EIGHTHS[i] + (z + z * sum);
}

double fst_atan2(double y, double x)
{
    if (isnan(x) || isnan(y))
        return x + y;
    const double across = fabs(y), along = fabs(x);
    double angle = 0.0;
    if (across > along)
        angle = 0.5 * FST_PI - angle_below_45(along, across);
    else if (along > 0)
        angle = angle_below_45(across, along);
    if (signbit(x))
        angle = FST_PI - angle;
    return copysign(angle, y);
}

double fst_asin(double x)
{
    return fst_atan2(x, sqrt((1.0 - x) * (1.0 + x)));
}

/* x = m 2^k with m within sqrt(2) of 1, and log m = 2 atanh(s), s = (m - 1)/(m + 1), by its series: s < 0.172.
 * log 2 is in two parts, of which the first has so few digits that k times it is exact. */
double fst_log(double x)
{
    static const double log2_high = 0x1.62e42feep-1, log2_low = 1.9082149292705877e-10;
    int k;
    double m = frexp(x, &k);
    if (m < 0.70710678118654752440) {
        m *= 2.0;
        --k;
    }
    const double s = (m - 1.0) / (m + 1.0), s2 = s * s;
    double sum = 0.0;
    for (int n = 23; n >= 3; n -= 2)
        sum = (sum + 1.0 / n) * s2;
    return k * log2_high + (2.0 * s + (2.0 * s * sum + k * log2_low));
}
