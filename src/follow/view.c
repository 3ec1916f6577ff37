/* view.c - a camera from the plane that it sees, and its lines of sight. */
#include "follow/view.h"

#include <math.h>
#include <string.h>

#include "base/dot.h"

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double normalise(double v[3])
{
    const double length = sqrt(fst_dot(v, v, 3));
    for (int i = 0; i < 3; ++i)
        v[i] /= length;
    return length;
}

/* The columns of the inverse of a matrix, but for a factor. */
static void invert(const double m[3][3], double columns[3][3])
{
    for (int k = 0; k < 3; ++k)
        cross(m[(k + 1) % 3], m[(k + 2) % 3], columns[k]);
}

/* The camera of a known focal length: the plane's axes x and y and its origin, as the camera sees them, are the
 * columns of the homography from the plane to the picture. */
static int place_camera(follow_camera *c, double columns[3][3])
{
    double seen[3][3];
    for (int k = 0; k < 3; ++k) {
        seen[k][2] = columns[k][2];
        for (int i = 0; i < 2; ++i)
            seen[k][i] = (columns[k][i] - c->middle[i] * columns[k][2]) / c->focal;
    }
    const double ahead = seen[2][2] < 0.0 ? -1.0 : 1.0;
    const double scale =
        0.5 * ahead * (sqrt(fst_dot(seen[0], seen[0], 3)) + sqrt(fst_dot(seen[1], seen[1], 3)));
    if (!(fabs(scale) > 0.0))
        return 0;
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i)
            seen[k][i] /= scale;
    double x[3], y[3], z[3];
    memcpy(x, seen[0], sizeof x);
    (void)normalise(x);
    cross(x, seen[1], z);
    (void)normalise(z);
    cross(z, x, y);
    for (int i = 0; i < 3; ++i) {
        c->axes[i][0] = x[i];
        c->axes[i][1] = y[i];
        c->axes[i][2] = z[i];
    }
    c->place[0] = -fst_dot(x, seen[2], 3);
    c->place[1] = -fst_dot(y, seen[2], 3);
    c->place[2] = -fst_dot(z, seen[2], 3);
    return isfinite(c->place[0] + c->place[1] + c->place[2]) && c->place[2] > 0.0;
}

int follow_camera_find(const follow_plane *plane, int width, int height, double distance, follow_camera *camera)
{
    enum { REPEATS = 20 };
    double columns[3][3];
    *camera = (follow_camera){.middle = {0.5 * (width - 1), 0.5 * (height - 1)}};
    camera->focal = distance / follow_plane_step(plane, camera->middle[0], camera->middle[1]);
    invert(plane->m, columns);
    for (int repeat = 0; repeat < REPEATS;
         ++repeat) { /* the longer the lens, the farther away it seems to be */
        double to[3] = {0.0, 0.0, 0.0};
        if (!place_camera(camera, columns))
            return 0;
        follow_plane_map(plane, camera->middle[0], camera->middle[1], &to[0], &to[1]);
        for (int i = 0; i < 3; ++i)
            to[i] -= camera->place[i];
        camera->focal *= distance / sqrt(fst_dot(to, to, 3));
    }
    return place_camera(camera, columns);
}

double follow_camera_view(const follow_camera *camera, double column, double row, double radius,
                          double view[3][3])
{
    const double ray[3] = {(column - camera->middle[0]) / camera->focal,
                           (row - camera->middle[1]) / camera->focal, 1.0};
    double right[3], up[3], to[3];
    for (int i = 0; i < 3; ++i)
        to[i] = -(ray[0] * camera->axes[0][i] + ray[1] * camera->axes[1][i] + ray[2] * camera->axes[2][i]);
    const double depth = -camera->place[2] / -to[2]; /* along the camera's axis, down to z = 0 */
    (void)normalise(to);
    const double along = fst_dot(camera->axes[0], to, 3);
    for (int i = 0; i < 3; ++i)
        right[i] = camera->axes[0][i] - along * to[i];
    (void)normalise(right);
    cross(to, right, up);
    for (int i = 0; i < 3; ++i) {
        view[i][0] = right[i];
        view[i][1] = up[i];
        view[i][2] = to[i];
    }
    return camera->focal * radius / fabs(depth);
}
