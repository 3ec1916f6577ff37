/* camera_paint.c - the picture of plate, table and bead, with what a camera adds. */
#include "film/camera_paint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/chance.h"
#include "base/error.h"

enum { MOST_MOMENTS = 64, SUBPIXELS = 3 };

#define WHITE 255.0
#define PLATE 0.78 /* how much light things send back: the plate, the table around it, marks and highlight */
#define TABLE 0.32
#define MARK 0.15
#define HIGHLIGHT 0.95
#define GRAIN 0.04       /* the texture of plate and table */
#define GRAIN_SIZE 2.0   /* mm */
#define MARK_RADIUS 0.03 /* in radii of the plate */
#define LAMPS 100.0      /* Hz: lamps on a mains of 50 Hz brighten twice a period */

/* ------------------------------------------------------------------ the motion */

/* Go to the row before a moment.  Returns which part of the way to the next row is behind. */
static double go_to(fst_camera_motion *motion, double seconds)
{
    const double t = seconds / motion->second;
    size_t row = motion->row;
    while (row > 0 && motion->t[row] > t)
        --row;
    while (row + 2 < motion->rows && motion->t[row + 1] <= t)
        ++row;
    motion->row = row;
    return fmax(0.0, fmin(1.0, (t - motion->t[row]) / (motion->t[row + 1] - motion->t[row])));
}

void fst_camera_motion_at(fst_camera_motion *motion, double seconds, double place[3])
{
    const double *const places[3] = {motion->x, motion->y, motion->z};
    const double *const rates[3] = {motion->vx, motion->vy, motion->vz};
    /* Hermite's cubic: it has the places and the velocities of both rows. */
    const double s = go_to(motion, seconds), q = 1.0 - s;
    const size_t row = motion->row;
    const double step = motion->t[row + 1] - motion->t[row];
    const double from = q * q * (1.0 + 2.0 * s), to = s * s * (3.0 - 2.0 * s);
    const double leave = q * q * s * step, arrive = -s * s * q * step;
    for (int i = 0; i < 3; ++i)
        place[i] = places[i] ? motion->millimetre * (from * places[i][row] + to * places[i][row + 1] +
                                                     leave * rates[i][row] + arrive * rates[i][row + 1])
                             : 0.0;
    place[2] += motion->bead;
}

/* ------------------------------------------------------------------ chance */

/* A number between 0 and 1 that belongs to a node of a grid. */
static double grain_at(int64_t i, int64_t j)
{
    uint64_t state = (uint64_t)i * 0x9e3779b97f4a7c15ULL ^ (uint64_t)j * 0xc2b2ae3d27d4eb4fULL;
    return (double)(fst_draw(&state) >> 11) / 9007199254740992.0;
}

/* Almost normal, with deviation 1: the sum of four numbers of 16 bits each. */
static double noise(uint64_t *state)
{
    const uint64_t word = fst_draw(state);
    const double sum = (double)(word & 0xffff) + (double)(word >> 16 & 0xffff) + (double)(word >> 32 & 0xffff) +
                       (double)(word >> 48);
    return (sum - 2.0 * 65535.0) / (65536.0 * sqrt(1.0 / 3.0));
}

/* ------------------------------------------------------------------ the still picture */

static double grain(double x, double y)
{
    const double u = x / GRAIN_SIZE, v = y / GRAIN_SIZE, i = floor(u), j = floor(v), p = u - i, q = v - j;
    const int64_t a = (int64_t)i, b = (int64_t)j;
    return (1.0 - q) * ((1.0 - p) * grain_at(a, b) + p * grain_at(a + 1, b)) +
           q * ((1.0 - p) * grain_at(a, b + 1) + p * grain_at(a + 1, b + 1)) - 0.5;
}

/* How much light the place (x, y) of the plate, or of the table beyond its edge, sends back. */
static double reflects(const fst_camera_paint *paint, double x, double y)
{
    if (hypot(fabs(x) - paint->marks, fabs(y) - paint->marks) < MARK_RADIUS * paint->plate)
        return MARK;
    return (hypot(x, y) < paint->plate ? PLATE : TABLE) * (1.0 + 2.0 * GRAIN * grain(x, y));
}

/* The light that falls where a pixel looks: less to the right, and less away from the middle. */
static double light(const fst_camera_paint *paint, double column, double row)
{
    const double across = column / paint->width, u = 2.0 * across - 1.0, v = 2.0 * row / paint->height - 1.0;
    return 1.0 - paint->uneven * (0.5 * across + 0.25 * (u * u + v * v));
}

static double still_at(const fst_camera_paint *paint, int column, int row)
{
    double sum = 0.0;
    for (int k = 0; k < SUBPIXELS * SUBPIXELS; ++k) {
        double d[3];
        const double across = (k % SUBPIXELS + 0.5) / SUBPIXELS - 0.5,
                     down = (k / SUBPIXELS + 0.5) / SUBPIXELS - 0.5;
        fst_camera_view_ray(&paint->view, column + across, row + down, d);
        const double way = -paint->view.place[2] / d[2];
        sum += reflects(paint, paint->view.place[0] + way * d[0], paint->view.place[1] + way * d[1]);
    }
    return WHITE * light(paint, column, row) * sum / (SUBPIXELS * SUBPIXELS);
}

fst_status fst_camera_paint_begin(fst_camera_paint *paint, fst_error *error)
{
    const size_t width = (size_t)paint->width, height = (size_t)paint->height;
    paint->still = malloc(width * height * sizeof *paint->still);
    paint->row = malloc(width * sizeof *paint->row);
    if (!paint->still || !paint->row)
        return fst_fail(error, FST_NO_MEMORY, "film", "no memory for frames of %d x %d pixels", paint->width,
                        paint->height);
    for (int row = 0; row < paint->height; ++row)
        for (int column = 0; column < paint->width; ++column)
            paint->still[(size_t)row * width + (size_t)column] = (float)still_at(paint, column, row);
    return FST_OK;
}

void fst_camera_paint_end(fst_camera_paint *paint)
{
    free(paint->still);
    free(paint->row);
}

/* ------------------------------------------------------------------ the bead */

/* When a row begins to be exposed. */
static double begin_of_row(const fst_camera_paint *paint, double seconds, double row)
{
    return seconds + paint->readout * row / paint->height;
}

/* Where the bead is at a moment, and, where it has marks, how it is turned. */
typedef struct moment {
    double place[3], turn[3][3];
} moment;

static moment moment_at(fst_camera_motion *motion, double seconds)
{
    moment at;
    fst_camera_motion_at(motion, seconds, at.place);
    if (motion->marks) {
        const double part = go_to(motion, seconds);
        fst_film_marks_turn(motion->marks, motion->row, part, at.turn);
    }
    return at;
}

/* How much of what a pixel sees along `ray` is bead, and how much light the bead sends back there: a dark ball
 * of steel, lit from the left above, with a highlight almost as bright as the plate. */
static double bead_along(const fst_camera_paint *paint, const fst_camera_motion *bead, const moment *at,
                         const double ray[3], double *shade)
{
    const double radius = bead->bead, *centre = at->place;
    static const double lamp[3] = {-0.4, 0.5, 0.768};
    double way = 0.0, off[3], normal[3], squared = 0.0, towards = 0.0, mirror = 0.0, between = 0.0;
    for (int i = 0; i < 3; ++i)
        way += (centre[i] - paint->view.place[i]) * ray[i];
    for (int i = 0; i < 3; ++i) {
        off[i] = paint->view.place[i] + way * ray[i] - centre[i];
        squared += off[i] * off[i];
    }
    const double inside = (radius - sqrt(squared)) * paint->view.focal / way; /* pixels from the outline */
    const double part = fmax(0.0, fmin(1.0, inside + 0.5));
    const double front = sqrt(fmax(0.0, radius * radius - squared));
    for (int i = 0; i < 3; ++i) {
        normal[i] = (off[i] - front * ray[i]) / radius;
        towards += normal[i] * lamp[i];
        mirror += normal[i] * (lamp[i] - ray[i]);
        between += (lamp[i] - ray[i]) * (lamp[i] - ray[i]);
    }
    *shade = mirror > 0.975 * sqrt(between) ? HIGHLIGHT : 0.10 + 0.25 * fmax(0.0, towards);
    if (bead->marks && *shade < HIGHLIGHT) /* paint is as glossy as steel */
        *shade *= fst_film_marks_shade(bead->marks, at->turn, normal);
    return part;
}

/* The columns and rows of a frame between which the bead is seen. */
static void surround(const fst_camera_paint *paint, fst_camera_motion *motion, double seconds, int low[2],
                     int high[2])
{
    enum { LOOKS = 12 };
    const int size[2] = {paint->width, paint->height};
    double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY}, margin = 0.0;
    for (int k = 0; k <= LOOKS; ++k) {
        double centre[3], seen[2], up[2];
        fst_camera_motion_at(motion, seconds + (paint->readout + paint->exposure) * k / LOOKS, centre);
        fst_camera_view_project(&paint->view, centre, seen);
        for (int i = 0; i < 3; ++i) /* half as much again as the radius covers what perspective adds to it */
            centre[i] += 1.5 * motion->bead * paint->view.up[i];
        fst_camera_view_project(&paint->view, centre, up);
        margin = fmax(margin, hypot(up[0] - seen[0], up[1] - seen[1]) + 3.0);
        for (int i = 0; i < 2; ++i) {
            least[i] = fmin(least[i], seen[i]);
            most[i] = fmax(most[i], seen[i]);
        }
    }
    for (int i = 0; i < 2; ++i) {
        low[i] = (int)fmax(0.0, fmin(size[i], least[i] - margin));
        high[i] = (int)fmax(0.0, fmin(size[i], most[i] + margin));
    }
}

/* The moments at which the bead of a row is looked at: two for each pixel that it moves. */
static int moments(const fst_camera_paint *paint, fst_camera_motion *motion, double seconds)
{
    double from[3], to[3], seen[2][2];
    fst_camera_motion_at(motion, seconds, from);
    fst_camera_motion_at(motion, seconds + paint->exposure, to);
    fst_camera_view_project(&paint->view, from, seen[0]);
    fst_camera_view_project(&paint->view, to, seen[1]);
    const double way = hypot(seen[1][0] - seen[0][0], seen[1][1] - seen[0][1]);
    return (int)fmin(MOST_MOMENTS, 4.0 + ceil(2.0 * way));
}

/* Lay the bead over a row, between two columns. */
static void paint_bead_row(const fst_camera_paint *paint, fst_camera_motion *motion, double seconds, int row,
                           const int columns[2], int count)
{
    moment places[MOST_MOMENTS];
    const double begin = begin_of_row(paint, seconds, row);
    for (int k = 0; k < count; ++k)
        places[k] = moment_at(motion, begin + paint->exposure * (k + 0.5) / count);
    for (int column = columns[0]; column < columns[1]; ++column) {
        double ray[3], covered = 0.0, sent = 0.0;
        fst_camera_view_ray(&paint->view, column, row, ray);
        for (int k = 0; k < count; ++k) {
            double shade;
            const double part = bead_along(paint, motion, &places[k], ray, &shade);
            covered += part;
            sent += part * shade;
        }
        paint->row[column] = (float)((1.0 - covered / count) * paint->row[column] +
                                     WHITE * light(paint, column, row) * sent / count);
    }
}

/* The brightness of the lamps on the mean over an exposure. */
static double lamps(const fst_camera_paint *paint, double begin)
{
    const double half = FST_PI * LAMPS * paint->exposure;
    const double kept = half > 1e-6 ? sin(half) / half : 1.0;
    return 1.0 + paint->flicker * kept * sin(FST_TWO_PI * LAMPS * (begin + 0.5 * paint->exposure));
}

/* A bead of a frame: its motion, how many moments are looked at, and between which columns and rows it is seen. */
typedef struct seen_bead {
    fst_camera_motion *motion;
    int moments, low[2], high[2];
    double far; /* its distance from the camera */
} seen_bead;

/* Find the beads of a frame, the farthest first, which nearer ones cover. */
static void find_beads(const fst_camera_paint *paint, fst_camera_motion *motions, int count, double seconds,
                       seen_bead *beads)
{
    for (int i = 0; i < count; ++i) {
        seen_bead bead = {.motion = &motions[i], .moments = moments(paint, &motions[i], seconds)};
        double place[3];
        fst_camera_motion_at(bead.motion, seconds, place);
        for (int k = 0; k < 3; ++k)
            bead.far += (place[k] - paint->view.place[k]) * (place[k] - paint->view.place[k]);
        surround(paint, bead.motion, seconds, bead.low, bead.high);
        int k = i;
        for (; k > 0 && beads[k - 1].far < bead.far; --k)
            beads[k] = beads[k - 1];
        beads[k] = bead;
    }
}

void fst_camera_paint_frame(const fst_camera_paint *paint, fst_camera_motion *motions, int count,
                            double seconds, uint64_t index, unsigned char *pixels)
{
    const size_t width = (size_t)paint->width;
    seen_bead beads[FST_BEADS_MANY];
    uint64_t chance = paint->seed * 0xd1342543de82ef95ULL + index;
    chance = fst_draw(&chance);
    find_beads(paint, motions, count, seconds, beads);
    for (int row = 0; row < paint->height; ++row) {
        const double bright = lamps(paint, begin_of_row(paint, seconds, row));
        for (size_t i = 0; i < width; ++i)
            paint->row[i] = paint->still[(size_t)row * width + i];
        for (const seen_bead *b = beads; b < beads + count; ++b)
            if (row >= b->low[1] && row < b->high[1])
                paint_bead_row(paint, b->motion, seconds, row, (const int[2]){b->low[0], b->high[0]},
                               b->moments);
        for (size_t i = 0; i < width; ++i) {
            const double level =
                bright * paint->row[i] + (paint->noise > 0.0 ? paint->noise * noise(&chance) : 0.0);
            pixels[(size_t)row * width + i] = (unsigned char)(fmax(0.0, fmin(WHITE, level)) + 0.5);
        }
    }
}

void fst_camera_paint_truth(const fst_camera_paint *paint, fst_camera_motion *motion, double seconds,
                            double place[3], double seen[2])
{
    enum { REPEATS = 4 }; /* the row depends on the place, and the place on the time of the row */
    seen[1] = 0.5 * paint->height;
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        const double begin = begin_of_row(paint, seconds, seen[1]);
        double mean[3] = {0.0, 0.0, 0.0}, at[3];
        for (int k = 0; k < MOST_MOMENTS; ++k) {
            fst_camera_motion_at(motion, begin + paint->exposure * (k + 0.5) / MOST_MOMENTS, at);
            for (int i = 0; i < 3; ++i)
                mean[i] += at[i] / MOST_MOMENTS;
        }
        fst_camera_view_project(&paint->view, mean, seen);
        memcpy(place, mean, sizeof mean);
    }
}

void fst_camera_paint_turning(const fst_camera_paint *paint, fst_camera_motion *motion, double seconds,
                              const double seen[2], double n[3], double w[3], double slip[2])
{
    const double at = begin_of_row(paint, seconds, seen[1]) + 0.5 * paint->exposure;
    const double part = go_to(motion, at), rate = 1.0 / motion->second;
    const double *const *of = motion->marks->motion->w, *const velocities[2] = {motion->vx, motion->vy};
    const size_t row = motion->row, first = motion->marks->motion->first;
    double turn[3][3];
    fst_film_marks_turn(motion->marks, row, part, turn);
    for (int i = 0; i < 3; ++i) {
        n[i] = turn[i][2];
        w[i] = rate * (of[i][first + row] + part * (of[i][first + row + 1] - of[i][first + row]));
    }
    for (int i = 0; i < 2; ++i)
        slip[i] = rate * motion->millimetre *
                  (velocities[i][row] + part * (velocities[i][row + 1] - velocities[i][row]));
    slip[0] -= motion->bead * w[1]; /* W x e = (W_y, -W_x, 0) */
    slip[1] += motion->bead * w[0];
}
