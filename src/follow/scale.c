/* scale.c - the plane of each kind of scale, and its error.
 *
 *   bead          the error of its diameter
 *   two or four   a pixel at each point, along the picture's columns and rows; of two, what a tilt of the camera may do
 *   plate         how far its edge is from an ellipse: neighbours on the edge err alike, so it counts whole; and the
 *                 perspective, as far as the bead's widths do not show it
 *
 * The bead's centre is above the plate, on which all but the first of them lie.  Where the camera's distance is not
 * known, that adds what a camera of any focal length may make of it.
 */
#include "follow/scale.h"

#include <math.h>

#include "base/error.h"

#define POINT_ERROR 1.0   /* pixels: nobody points better */
#define USUAL_TILT 0.09   /* rad, of a camera that looks straight down: 5 degrees */
#define NEAREST 0.7       /* shortest lenses: a camera's distance asks for no shorter one, */
#define LONGEST_LENS 40.0 /* diagonals of the picture: and for no longer one */
#define EDGE_ERROR 0.05   /* pixels, of the edge's ellipse, besides its scatter */

int fst_film_scales_differ(const fst_film_scale *one, const fst_film_scale *other)
{
    return fabs(log(other->value / one->value)) > 2.0 * hypot(one->error, other->error);
}

static int points_of(const follow_scale *scale)
{
    return scale->kind == FOLLOW_SCALE_TWO ? 2 : scale->kind == FOLLOW_SCALE_FOUR ? 4 : 0;
}

fst_status follow_scale_check(const follow_scale *scale, const follow_still *still, fst_error *error)
{
    for (int i = 0; i < points_of(scale); ++i) {
        const double *p = scale->points[i];
        if (!(p[0] >= -1.0 && p[1] >= -1.0 && p[0] <= still->width && p[1] <= still->height))
            return fst_fail(error, FST_BAD_INPUT, "fst_film_track_options.scale",
                            "the point %g,%g is outside of the picture, which has %d x %d pixels", p[0], p[1],
                            still->width, still->height);
    }
    return FST_OK;
}

static fst_status plane_of_points(const follow_scale *scale, const follow_view *view, follow_plane *plane,
                                  fst_error *error)
{
    const double(*p)[2] = scale->points;
    if (scale->kind == FOLLOW_SCALE_FOUR)
        return follow_plane_of_rectangle(scale, plane, error);
    *plane = follow_plane_even(scale->length[0] / hypot(p[1][0] - p[0][0], p[1][1] - p[0][1]),
                               view->still->height - 1.0);
    return FST_OK;
}

/* Two points do not show how the camera is tilted.  Where they lie beside the path, the plate is nearer to the camera at one
 * of both by as much, and one pixel shorter. */
static double error_of_tilt(const follow_scale *scale, const follow_view *view, double step)
{
    const double(*p)[2] = scale->points;
    const double beside =
        step * hypot(0.5 * (p[0][0] + p[1][0]) - view->middle[0], 0.5 * (p[0][1] + p[1][1]) - view->middle[1]);
    const double nearest = step * FOLLOW_SHORTEST_LENS * hypot(view->still->width, view->still->height);
    const double distance =
        isnan(view->distance) ? sqrt(3.0) * nearest : 1e3 * view->distance; /* as error_of_height() */
    return scale->kind == FOLLOW_SCALE_TWO ? USUAL_TILT * beside / distance : 0.0;
}

/* By how much the step in the middle changes, relatively, where each point is wrong by a pixel. */
static double error_of_points(const follow_scale *scale, const follow_view *view, double step)
{
    double squares = 0.0;
    for (int i = 0; i < 2 * points_of(scale); ++i) {
        follow_scale moved = *scale;
        follow_plane plane;
        moved.points[i / 2][i % 2] += POINT_ERROR;
        if (plane_of_points(&moved, view, &plane, NULL) != FST_OK)
            return INFINITY;
        const double change = follow_plane_least_step(&plane, view->middle[0], view->middle[1]) / step - 1.0;
        squares += change * change;
    }
    return sqrt(squares);
}

static fst_status plane_of_plate(const follow_scale *scale, const follow_view *view, follow_rim *rim,
                                 follow_plane *plane, double *error_share, fst_error *error)
{
    double horizon[2], spread[2];
    if (rim->taken < 0) {
        const fst_status status = follow_rim_find(view->still, view->path, view->middle,
                                                  view->reach + 0.5 * view->look->diameter, rim, error);
        if (status != FST_OK)
            return status;
    }
    const follow_ellipse *ellipse = &rim->ellipses[rim->taken];
    const double radius = 0.5 * scale->length[0], edge = hypot(EDGE_ERROR, rim->edges[rim->taken].error) * 0.5 *
                                                         (1.0 / ellipse->axes[0] + 1.0 / ellipse->axes[1]);
    double squares = edge * edge;
    follow_plate_horizon(view->sizes, ellipse, view->still->width, view->still->height, horizon, spread);
    fst_status status = follow_plane_of_circle(ellipse, horizon, radius, plane, error);
    for (int side = -1; side <= 1 && status == FST_OK; side += 2) { /* the mean of both sides */
        const double moved[2] = {horizon[0] + side * spread[0], horizon[1] + side * spread[1]};
        follow_plane other;
        status = follow_plane_of_circle(ellipse, moved, radius, &other, error);
        const double change = follow_plane_step(&other, view->middle[0], view->middle[1]) /
                                  follow_plane_step(plane, view->middle[0], view->middle[1]) -
                              1.0;
        squares += 0.5 * change * change;
    }
    *error_share = sqrt(squares);
    return status;
}

/* A bead whose centre is above the plate is seen larger, and farther from the camera's axis, than the plate
 * under it. */
static fst_status lower_bead(const follow_view *view, double step, follow_plane *plane, fst_error *error)
{
    const double distance = 1e3 * view->distance, height = 0.5 * view->look->diameter * step;
    if (!(distance > 4.0 * height && distance < 1e6))
        return fst_fail(error, FST_BAD_INPUT, "fst_film_track_options.distance",
                        "%g mm from the camera to the plate, where the bead's centre is %.2g mm above it",
                        distance, height);
    const double focal = distance / (step * hypot(view->still->width, view->still->height));
    if (!(focal > NEAREST * FOLLOW_SHORTEST_LENS && focal < LONGEST_LENS))
        return fst_fail(
            error, FST_BAD_INPUT, "fst_film_track_options.distance",
            "with the camera %g mm from the plate its lens would have a focal length of %.2g diagonals of "
            "the picture, which is not a usual one (%.1g to %g): is the unit right?",
            distance, focal, NEAREST * FOLLOW_SHORTEST_LENS, LONGEST_LENS);
    double x, y;
    follow_plane_map(plane, view->middle[0], view->middle[1], &x, &y);
    const double factor = 1.0 - height / distance;
    for (int j = 0; j < 3; ++j) { /* shrink about the middle of the path */
        plane->m[0][j] = factor * plane->m[0][j] + (1.0 - factor) * x * plane->m[2][j];
        plane->m[1][j] = factor * plane->m[1][j] + (1.0 - factor) * y * plane->m[2][j];
    }
    return FST_OK;
}

/* Height over distance is the bead's radius in pixels over the focal length in pixels: anything from zero to that of
 * the shortest lens, and all of it is the same likely. */
static double error_of_height(const follow_view *view)
{
    return 0.5 * view->look->diameter /
           (FOLLOW_SHORTEST_LENS * hypot(view->still->width, view->still->height) * sqrt(3.0));
}

fst_status follow_scale_apply(const follow_scale *scale, const follow_view *view, follow_rim *rim,
                              follow_plane *plane, double *step, double *error_share, fst_error *error)
{
    const double wide = view->look->diameter;
    fst_status status = FST_OK;
    if (scale->kind == FOLLOW_SCALE_BEAD) {
        *plane = follow_plane_even(scale->length[0] / wide, view->still->height - 1.0);
        *error_share = view->look->diameter_error / wide;
    } else if (scale->kind == FOLLOW_SCALE_PLATE) {
        status = plane_of_plate(scale, view, rim, plane, error_share, error);
    } else {
        status = plane_of_points(scale, view, plane, error);
    }
    if (status != FST_OK)
        return status;
    const double even = follow_plane_step(plane, view->middle[0], view->middle[1]);
    *step = follow_plane_least_step(plane, view->middle[0], view->middle[1]);
    if (points_of(scale) > 0)
        *error_share = hypot(error_of_points(scale, view, *step), error_of_tilt(scale, view, *step));
    if (scale->kind != FOLLOW_SCALE_BEAD && isnan(view->distance))
        *error_share = hypot(*error_share, error_of_height(view));
    else if (scale->kind != FOLLOW_SCALE_BEAD)
        status = lower_bead(view, even, plane, error);
    *step = follow_plane_least_step(plane, view->middle[0], view->middle[1]);
    return status;
}
