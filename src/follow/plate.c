/* plate.c - perspective, from how the bead's width changes.
 *
 * An ellipse alone does not tell which side of the plate is nearer.  The bead does: it looks wider there.  Its
 * width is as the inverse of its distance along the camera's axis, and over a plane that inverse is a linear
 * function of column and row.  Divided by this function, pixels are a plane up to a stretch, which the ellipse
 * then gives.  The tilt that the ellipse shows limits how strong the perspective can be.
 */
#include "follow/plate.h"

#include <math.h>
#include <string.h>

#define LEAST_COUNT 50.0
#define ALIKE 4.0 /* frames that err alike */

void follow_sizes_add(follow_sizes *sizes, double column, double row, double width)
{
    const double terms[3] = {1.0, column - sizes->middle[0], row - sizes->middle[1]};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            sizes->sum[i][j] += terms[i] * terms[j];
        sizes->right[i] += terms[i] * width;
    }
    sizes->squares += width * width;
    sizes->count += 1.0;
}

/* The variance of a slope along a direction: what the widths scatter by about the straight line, through the
 * inverse of the normal equations; neighbouring frames err alike, so that a few are worth one. */
static double variance_of_slope(const follow_sizes *sizes, const double fitted[3], const double along[2])
{
    double a[9], b[3] = {0.0, along[0], along[1]}, left = sizes->squares;
    for (int i = 0; i < 3; ++i)
        left -= fitted[i] * sizes->right[i];
    memcpy(a, sizes->sum, sizeof a);
    if (!follow_solve(a, b, 3))
        return INFINITY;
    return ALIKE * fmax(0.0, left) / sizes->count * (along[0] * b[1] + along[1] * b[2]);
}

void follow_plate_horizon(const follow_sizes *sizes, const follow_ellipse *rim, int width, int height,
                          double horizon[2], double spread[2])
{
    double a[9], b[3];
    const double across[2] = {-sin(rim->angle), cos(rim->angle)}; /* along the shorter axis */
    const double flat = fmin(1.0, rim->axes[1] / rim->axes[0]);
    const double most = sqrt(1.0 / (flat * flat) - 1.0) / (FOLLOW_SHORTEST_LENS * hypot(width, height));
    double slope = 0.0, doubt = most / sqrt(3.0); /* anything up to the most, to either side */
    memcpy(a, sizes->sum, sizeof a);
    memcpy(b, sizes->right, sizeof b);
    if (sizes->count >= LEAST_COUNT && follow_solve(a, b, 3)) {
        /* From the middle of the sizes to the middle of the ellipse. */
        const double here =
            b[0] + b[1] * (rim->centre[0] - sizes->middle[0]) + b[2] * (rim->centre[1] - sizes->middle[1]);
        slope = fmax(-most, fmin(most, (b[1] * across[0] + b[2] * across[1]) / here));
        doubt = fmin(doubt, sqrt(variance_of_slope(sizes, b, across)) / fabs(here));
    }
    for (int i = 0; i < 2; ++i) {
        horizon[i] = slope * across[i];
        spread[i] = doubt * across[i];
    }
}
