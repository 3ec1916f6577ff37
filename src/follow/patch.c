/* patch.c - the face of the bead in each frame, as levels on a grid that moves along with it. */
#include "follow/turning.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/dot.h"
#include "base/error.h"
#include "base/grow.h"

enum { RAYS = 64, ALONG = 24, INSIDE = 4, REPEATS = 4 };

#define INNER 0.84 /* radii between which the outline is looked for */
#define OUTER 1.25
#define SOFT 0.5            /* pixels by which a ray may be off before it counts less */
#define LEAST_CONTRAST 12.0 /* gray levels */
#define MOST_OFF                                                                                               \
    0.12 /* between the width that is seen and the one that is expected: what the outline leaves unsure */
#define EDGE 1.25 /* in radii: a little of the plate shows where the outline is */

fst_status follow_turning_begin(follow_turning *turning, double diameter, fst_error *error)
{
    *turning = (follow_turning){.radius = 0.5 * diameter};
    turning->grid = malloc(FOLLOW_MOST_POINTS * sizeof *turning->grid);
    turning->even = malloc(4 * FOLLOW_MOST_POINTS * sizeof *turning->even);
    turning->facing = malloc(FOLLOW_MOST_POINTS * sizeof *turning->facing);
    turning->map = malloc(FOLLOW_MOST_POINTS * sizeof *turning->map);
    turning->slopes = calloc(FOLLOW_MOST_POINTS, sizeof *turning->slopes);
    turning->light = malloc(FOLLOW_MOST_POINTS * sizeof *turning->light);
    turning->used = malloc(FOLLOW_MOST_POINTS);
    if (!follow_sphere_begin(&turning->sphere) || !follow_sphere_begin(&turning->rest) || !turning->grid ||
        !turning->even || !turning->facing || !turning->light || !turning->slopes || !turning->map ||
        !turning->used)
        return fst_fail(error, FST_NO_MEMORY, "track", "no memory for the turning of a bead");
    for (int k = 0; k < FOLLOW_MOST_POINTS; ++k)
        turning->map[k] = -1;
    turning->marked = turning->even + FOLLOW_MOST_POINTS;
    turning->spread = turning->marked + FOLLOW_MOST_POINTS;
    turning->sigma = turning->spread + FOLLOW_MOST_POINTS;
    for (int k = 0; k < FOLLOW_MOST_POINTS; ++k) {
        const double half = 0.5 * (FOLLOW_FACE - 1), right = (k % FOLLOW_FACE - half) / FOLLOW_PER_RADIUS,
                     up = (half - (double)(k / FOLLOW_FACE)) / FOLLOW_PER_RADIUS;
        if (hypot(right, up) > EDGE)
            continue;
        turning->map[k] = (short)turning->points;
        turning->grid[turning->points][0] = right;
        turning->grid[turning->points++][1] = up;
    }
    return FST_OK;
}

int follow_turning_point(double right, double up, const follow_turning *turning)
{
    const double half = 0.5 * (FOLLOW_FACE - 1);
    const int i = (int)floor(right * FOLLOW_PER_RADIUS + half + 0.5),
              j = (int)floor(half - up * FOLLOW_PER_RADIUS + 0.5);
    return i >= 0 && j >= 0 && i < FOLLOW_FACE && j < FOLLOW_FACE ? turning->map[j * FOLLOW_FACE + i] : -1;
}

void follow_turning_end(follow_turning *turning)
{
    free(turning->grid);
    free(turning->even);
    free(turning->facing);
    free(turning->light);
    free(turning->slopes);
    free(turning->map);
    free(turning->used);
    free(turning->levels);
    free(turning->turns);
    free(turning->sphere.nodes);
    free(turning->rest.nodes);
    *turning = (follow_turning){.count = 0};
}

/* The level at a place between pixels. */
static double level_at(const unsigned char *pixels, int width, int height, double column, double row)
{
    const double x = fmax(0.0, fmin(width - 1.001, column)), y = fmax(0.0, fmin(height - 1.001, row));
    const int i = (int)x, j = (int)y;
    const unsigned char *at = pixels + (size_t)j * (size_t)width + i;
    const double p = x - i, q = y - j;
    return (1.0 - q) * ((1.0 - p) * at[0] + p * at[1]) + q * ((1.0 - p) * at[width] + p * at[width + 1]);
}

/* A frame, how much brighter each row of it is, and the picture without the bead. */
typedef struct picture {
    const unsigned char *pixels;
    const float *gains;
    const follow_still *still;
} picture;

/* The level of the plate behind the bead. */
static double plate_at(const picture *p, double column, double row)
{
    const int i = (int)fmax(0.0, fmin(p->still->width - 1, column + 0.5)),
              j = (int)fmax(0.0, fmin(p->still->height - 1, row + 0.5));
    return (double)(p->gains[j] * p->still->level[(size_t)j * (size_t)p->still->width + (size_t)i]);
}

/* How far out the outline is on a ray from a centre, in pixels, and how much it stands out: what lies between the level
 * inside and that of the plate is covered in part. */
static double outline(const picture *p, double radius, double column, double row, double angle, double *weight)
{
    const double c = cos(angle), s = sin(angle), from = INNER * radius, step = (OUTER - INNER) * radius / ALONG;
    double inside = 0.0, sum = 0.0, plate = 0.0;
    for (int k = 0; k < INSIDE; ++k) {
        const double r = from - step * k;
        inside += level_at(p->pixels, p->still->width, p->still->height, column + c * r, row - s * r) / INSIDE;
    }
    for (int k = 0; k < ALONG; ++k) {
        const double r = from + step * (k + 0.5), x = column + c * r, y = row - s * r,
                     behind = plate_at(p, x, y);
        sum += step * (behind - level_at(p->pixels, p->still->width, p->still->height, x, y));
        plate += behind / ALONG;
    }
    const double contrast = plate - inside;
    *weight = fabs(contrast) > LEAST_CONTRAST ? contrast * contrast : 0.0;
    return from + (*weight > 0.0 ? sum / contrast : 0.0);
}

/* The centre of the bead by its outline.  The centre of what is darker than the plate depends on where the marks are. */
static void centre(const picture *p, double radius, double *column, double *row)
{
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        double out[RAYS], weights[RAYS], move[3] = {0.0, 0.0, radius};
        for (int k = 0; k < RAYS; ++k)
            out[k] = outline(p, radius, *column, *row, FST_TWO_PI * k / RAYS, &weights[k]);
        for (int again = 0; again < REPEATS; ++again) {
            double a[9] = {0.0}, b[3] = {0.0, 0.0, 0.0};
            for (int k = 0; k < RAYS; ++k) {
                const double terms[3] = {cos(FST_TWO_PI * k / RAYS), sin(FST_TWO_PI * k / RAYS), 1.0};
                const double off = out[k] - fst_dot(terms, move, 3),
                             part = 1.0 / (1.0 + off * off / (SOFT * SOFT));
                for (int i = 0; i < 3; ++i) {
                    b[i] += weights[k] * part * part * terms[i] * out[k];
                    for (int j = 0; j < 3; ++j)
                        a[3 * i + j] += weights[k] * part * part * terms[i] * terms[j];
                }
            }
            if (!follow_solve(a, b, 3))
                return;
            memcpy(move, b, sizeof move);
        }
        if (!(hypot(move[0], move[1]) < 0.3 * radius))
            return;
        *column += move[0];
        *row -= move[1];
    }
}

fst_status follow_turning_take(follow_turning *turning, const follow_still *still, const unsigned char *pixels,
                               const float *gains, follow_place *place, int frame, double time,
                               fst_error *error)
{
    const size_t points = (size_t)turning->points;
    if (isnan(place->column) || place->twin)
        return FST_OK;
    if (turning->count == turning->capacity) {
        const int capacity = turning->capacity ? 2 * turning->capacity : 256;
        if (!fst_resize(&turning->turns, (size_t)capacity, sizeof *turning->turns) ||
            !fst_resize(&turning->levels, (size_t)capacity, points))
            return fst_fail(error, FST_NO_MEMORY, "track", "no memory for the turning of %d frames", capacity);
        turning->capacity = capacity;
    }
    const picture shown = {pixels, gains, still};
    centre(&shown, turning->radius, &place->column, &place->row);
    unsigned char *levels = turning->levels + points * (size_t)turning->count;
    double bright = 0.0;
    for (size_t k = 0; k < points; ++k) {
        const double column = place->column + turning->radius * turning->grid[k][0],
                     row = place->row - turning->radius * turning->grid[k][1];
        levels[k] = (unsigned char)(level_at(pixels, still->width, still->height, column, row) + 0.5);
        bright += plate_at(&shown, column, row);
    }
    turning->turns[turning->count++] = (follow_turn){.frame = frame,
                                                     .time = time,
                                                     .column = place->column,
                                                     .row = place->row,
                                                     .bright = fmax(32.0, bright / (double)points)};
    return FST_OK;
}

fst_status follow_turning_place(follow_turning *turning, const follow_still *still, const follow_plane *plane,
                                double radius, double distance, fst_error *error)
{
    follow_camera camera;
    double sum = 0.0;
    turning->millimetres = radius;
    if (!follow_camera_find(plane, still->width, still->height, distance, &camera))
        return fst_fail(error, FST_BAD_INPUT, "fst_film_track_options.scale",
                        "no camera sees the plate in this way from %.6g mm", distance);
    for (int i = 0; i < turning->count; ++i) {
        follow_turn *t = &turning->turns[i];
        const double column = t->column + turning->radius * t->shift[0],
                     row = t->row - turning->radius * t->shift[1];
        follow_plane_map(plane, column, row, &t->place[0], &t->place[1]);
        t->shrink = turning->radius / follow_camera_view(&camera, column, row, radius, t->view);
        t->close = radius * t->view[2][2] / camera.place[2];
        sum += t->shrink;
    }
    if (!(fabs(sum / turning->count - 1.0) < MOST_OFF))
        return fst_fail(error, FST_BAD_INPUT, "fst_film_track_options.turning",
                        "by the scale a bead of %.4g mm is %.3g pixels wide, but the bead of the film is %.3g "
                        "pixels wide: give its diameter, and check the scale%s",
                        2.0 * radius, 2.0 * turning->radius * turning->count / sum, 2.0 * turning->radius,
                        sum < turning->count ? "; a light bead may be taken for no more than its dark dots"
                                             : "");
    return FST_OK;
}
