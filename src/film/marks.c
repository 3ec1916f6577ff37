/* marks.c - the rotation of a filmed bead at any moment, and the paint on it. */
#include "film/marks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

#define COAT 1.8 /* of what bare steel sends back */
#define BLACK 0.3
#define FADES 0.06 /* rad over which the edge of a mark fades: a pixel of a bead that is 30 pixels wide */

/* A dot: where its middle is on the bead, and its radius, rad. */
typedef struct dot {
    double middle[3], radius;
} dot;

/* The dots of each half, the northern one first: at latitudes of 50 degrees, so that its edge stays what it is. */
static const dot spots[4] = {{{0.6427876097, 0.0000000000, 0.7660444431}, 0.454},
                             {{-0.5566703992, 0.3213938048, 0.7660444431}, 0.314},
                             {{0.1663656753, 0.6208851530, -0.7660444431}, 0.454},
                             {{-0.4545194777, -0.4545194777, -0.7660444431}, 0.314}};
static const dot poles[2] = {{{0.0, 0.0, 1.0}, 0.56}, {{1.0, 0.0, 0.0}, 0.35}};

int fst_film_marks_known(const char *name)
{
    return strcmp(name, "half") == 0 || strcmp(name, "dots") == 0;
}

fst_status fst_film_marks_begin(fst_film_marks *marks, const fst_film_motion *motion, const char *name,
                                fst_error *error)
{
    const size_t rows = motion->last - motion->first + 1;
    *marks = (fst_film_marks){
        .motion = motion, .turns = malloc(rows * sizeof *marks->turns), .half = strcmp(name, "half") == 0};
    if (!marks->turns)
        return fst_fail(error, FST_NO_MEMORY, "film", "no memory for the turning of a bead");
    memcpy(marks->turns[0], motion->turn, sizeof motion->turn);
    for (size_t row = 1; row < rows; ++row) {
        memcpy(marks->turns[row], marks->turns[row - 1], sizeof motion->turn);
        fst_film_motion_roll(motion, motion->first + row - 1, 1.0, marks->turns[row]);
    }
    return FST_OK;
}

void fst_film_marks_turn(const fst_film_marks *marks, size_t row, double part, double turn[3][3])
{
    memcpy(turn, marks->turns[row], 9 * sizeof turn[0][0]);
    fst_film_motion_roll(marks->motion, marks->motion->first + row, part, turn);
}

/* How far a point is inside a dot: from 0 to 1. */
static double inside(const dot *d, const double point[3])
{
    const double along = point[0] * d->middle[0] + point[1] * d->middle[1] + point[2] * d->middle[2];
    return fmax(0.0, fmin(1.0, (d->radius - acos(fmax(-1.0, fmin(1.0, along)))) / FADES + 0.5));
}

double fst_film_marks_shade(const fst_film_marks *marks, const double turn[3][3], const double normal[3])
{
    double point[3];
    for (int k = 0; k < 3; ++k)
        point[k] = turn[0][k] * normal[0] + turn[1][k] * normal[1] + turn[2][k] * normal[2];
    if (!marks->half)
        return COAT - (COAT - BLACK) * fmin(1.0, inside(&poles[0], point) + inside(&poles[1], point));
    const double north = fmax(0.0, fmin(1.0, asin(fmax(-1.0, fmin(1.0, point[2]))) / FADES + 0.5));
    const double left_out = inside(&spots[0], point) + inside(&spots[1], point),
                 added = inside(&spots[2], point) + inside(&spots[3], point);
    return COAT - (COAT - BLACK) * (fmin(north, 1.0 - left_out) + added);
}
