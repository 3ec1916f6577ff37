/* camera_view.c - a pinhole camera over the plate. */
#include "film/camera_view.h"

#include <math.h>

#include "base/dot.h"

/* `v`, turned by `angle` about the horizontal unit vector at the polar angle `axis`. */
static void tip(double v[3], double axis, double angle)
{
    const double a[3] = {cos(axis), sin(axis), 0.0}, c = cos(angle), s = sin(angle), along = fst_dot(a, v, 3);
    const double w[3] = {a[1] * v[2], -a[0] * v[2], a[0] * v[1] - a[1] * v[0]};
    for (int i = 0; i < 3; ++i)
        v[i] = c * v[i] + s * w[i] + (1.0 - c) * along * a[i];
}

fst_camera_view fst_camera_view_make(int width, int height, double distance, double tilt, double side,
                                     double reach)
{
    const int least = width < height ? width : height;
    fst_camera_view view = {.right = {1.0, 0.0, 0.0},
                            .up = {0.0, 1.0, 0.0},
                            .ahead = {0.0, 0.0, -1.0},
                            .focal = 0.5 * least * distance / reach,
                            .middle = {0.5 * (width - 1), 0.5 * (height - 1)}};
    double *const vectors[3] = {view.right, view.up, view.ahead};
    for (int i = 0; i < 3; ++i) /* the quarter turn puts the pinhole on that side of the plate */
        tip(vectors[i], side + 1.5707963267948966, tilt);
    for (int i = 0; i < 3; ++i)
        view.place[i] = -distance * view.ahead[i];
    return view;
}

void fst_camera_view_project(const fst_camera_view *view, const double place[3], double seen[2])
{
    double d[3];
    for (int i = 0; i < 3; ++i)
        d[i] = place[i] - view->place[i];
    const double scale = view->focal / fst_dot(d, view->ahead, 3);
    seen[0] = view->middle[0] + scale * fst_dot(d, view->right, 3);
    seen[1] = view->middle[1] - scale * fst_dot(d, view->up, 3);
}

void fst_camera_view_ray(const fst_camera_view *view, double column, double row, double direction[3])
{
    double length = 0.0;
    for (int i = 0; i < 3; ++i) {
        direction[i] = view->focal * view->ahead[i] + (column - view->middle[0]) * view->right[i] -
                       (row - view->middle[1]) * view->up[i];
        length += direction[i] * direction[i];
    }
    length = sqrt(length);
    for (int i = 0; i < 3; ++i)
        direction[i] /= length;
}
