/* elementary.c - elementary functions from + - * / and square roots alone, so that every machine gives the same
 * bits. */
#include "base/elementary.h"

#include <math.h>

#include "base/real_double.h"

#include "base/elementary.inl"

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

double fst_atan2(double y, double x)
{
    if (isnan(x) || isnan(y))
        return x + y;
    return copysign(fst_angle_double(fabs(y), x), y);
}

double fst_asin(double x)
{
    return fst_atan2(x, sqrt((1.0 - x) * (1.0 + x)));
}

double fst_log(double x)
{
    return fst_log_of_ratio_double(x, 1.0, x - 1.0);
}
