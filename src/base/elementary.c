/* elementary.c - elementary functions from + - * / and square roots alone, so that every machine gives the same
 * bits. */
#include "base/elementary.h"

#include <math.h>

#include "base/real_double.h"

#include "base/elementary.inl"

/* c[0] x + c[1] x^2 + ... */
static double series(const double *c, int terms, double x)
{
    double sum = 0.0;
    for (int i = terms - 1; i >= 0; --i)
        sum = (sum + c[i]) * x;
    return sum;
}

void fst_sin_cos_degrees(double degrees, double *sine, double *cosine)
{
    /* Taylor's series for |x| <= pi/4; the first terms left out are below 2^-64 of the results. */
    static const double of_sine[] = {
        -1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
        -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
    static const double of_cosine[] = {1.0 / 24,        -1.0 / 720,         1.0 / 40320,         -1.0 / 3628800,
                                       1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
    /* Take off whole turns and then quarter turns; for whole degrees this is exact.  Then |rest| <= 45. */
    double rest = degrees - 360.0 * (double)(long long)(degrees / 360.0);
    const int quarters = (int)(rest / 90.0 + (rest < 0 ? -0.5 : 0.5));
    rest -= 90.0 * quarters;
    const double x = rest * 0.017453292519943295769, x2 = x * x;
    const double s = x + x * series(of_sine, 8, x2), c = 1.0 - (0.5 * x2 - x2 * series(of_cosine, 7, x2));
    const double turned[] = {s, c, -s, -c, s}; /* the sine of the angle, then a quarter turn further on */
    const int quarter = ((quarters % 4) + 4) % 4;
    *sine = turned[quarter];
    *cosine = turned[quarter + 1];
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
