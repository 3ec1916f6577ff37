/* marks.c - the rotation of a filmed bead at any moment, and the paint on it. */
#include "film/marks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

#define BLACK 0.35 /* of what bare steel sends back */
#define FADES 0.06 /* rad over which the edge of a mark fades: a pixel of a bead that is 30 pixels wide */

/* A dot: where its middle is on the bead, and its radius, rad. */
typedef struct dot {
    double middle[3], radius;
} dot;

/* The dots of a half are opposite to each other, so that one of them is always in view, and far from its edge. */
static const dot spots[2] = {{{0.8191520443, 0.0, 0.5735764364}, 0.32},
                             {{-0.6634139482, 0.5566703993, -0.5}, 0.32}};
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
    const dot *dots = marks->half ? spots : poles;
    const double north = fmax(0.0, fmin(1.0, asin(fmax(-1.0, fmin(1.0, point[2]))) / FADES + 0.5));
    const double one = inside(&dots[0], point), other = inside(&dots[1], point);
    const double painted = marks->half ? fmin(north, 1.0 - one) + other : one + other;
    return 1.0 - (1.0 - BLACK) * fmin(1.0, painted);
}
