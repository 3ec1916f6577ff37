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
/* The shortest focal length of a camera, in diagonals of its picture: 18 mm on a film of 43 mm. */
#define SHORTEST 0.42

void follow_sizes_add(follow_sizes *sizes, double column, double row, double width)
{
    const double terms[3] = {1.0, column - sizes->middle[0], row - sizes->middle[1]};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            sizes->sum[i][j] += terms[i] * terms[j];
        sizes->right[i] += terms[i] * width;
    }
    sizes->count += 1.0;
}

void follow_plate_horizon(const follow_sizes *sizes, const follow_ellipse *rim, int width, int height,
                          double horizon[2])
{
    double a[9], b[3];
    horizon[0] = horizon[1] = 0.0;
    memcpy(a, sizes->sum, sizeof a);
    memcpy(b, sizes->right, sizeof b);
    if (sizes->count < LEAST_COUNT || !follow_solve(a, b, 3))
        return;
    /* From the middle of the sizes to the middle of the ellipse. */
    const double here =
        b[0] + b[1] * (rim->centre[0] - sizes->middle[0]) + b[2] * (rim->centre[1] - sizes->middle[1]);
    const double across[2] = {-sin(rim->angle), cos(rim->angle)}; /* along the shorter axis */
    const double flat = fmin(1.0, rim->axes[1] / rim->axes[0]);
    const double most = sqrt(1.0 / (flat * flat) - 1.0) / (SHORTEST * hypot(width, height));
    const double slope = fmax(-most, fmin(most, (b[1] * across[0] + b[2] * across[1]) / here));
    horizon[0] = slope * across[0];
    horizon[1] = slope * across[1];
}
