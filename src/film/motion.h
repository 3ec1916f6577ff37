/* motion.h - the motion between the samples of a trajectory, for films. */
#ifndef FST_FILM_MOTION_H
#define FST_FILM_MOTION_H

#include "film/frame.h"

#include <festoon/festoon_tools.h>

typedef struct fst_film_motion {
    const fst_table *table;
    const double *clock; /* in drive periods */
    const double *t, *drive_turns, *x, *y, *alpha, *n[3], *w[3];
    const double *colour;   /* NULL: there is none */
    const double *sticking; /* NULL: the contact only slips */
    const double *flying, *z;
    double radius;      /* mm */
    size_t first, last; /* rows shown: first <= row <= last */
    double millimetres;
    double low, high; /* the range of the colour */
    int both_signs;
    const fst_column_info *colour_info;
    size_t row;        /* the row before the present moment */
    double part;       /* how far from that row to the next, 0 to 1 */
    double turn[3][3]; /* rotation of the bead at `row`; its third axis is n */
} fst_film_motion;

/* The rows first <= row < end between the moments `from` and `to` (NAN: the beginning, the end) of a clock.
 * FST_BAD_INPUT: they are less than two. */
fst_status fst_film_rows(const double *clock, size_t rows, double from, double to, size_t *first, size_t *end,
                         fst_error *error);

/* Begin with the rows between the drive periods `from` and `to`, coloured by `colour` (NULL: by nothing); `clock` tells
 * the periods of each row (NULL: they are turns of the magnet).  FST_BAD_INPUT: there are no such rows, or no such
 * column. */
fst_status fst_film_motion_begin(fst_film_motion *motion, const fst_table *table, const double *clock,
                                 double from, double to, const char *colour, fst_error *error);

/* Go on to a moment, in drive periods; it must not be earlier than the one before. */
void fst_film_motion_to(fst_film_motion *motion, double periods);

/* Turn the bead from a row by `part` of the way to the next. */
void fst_film_motion_roll(const fst_film_motion *motion, size_t row, double part, double turn[3][3]);

/* What a column of numbers is at that moment. */
double fst_film_motion_at(const fst_film_motion *motion, const double *column);

/* Put the bead as it is at that moment into `bead`. */
void fst_film_motion_bead(const fst_film_motion *motion, fst_film_bead *bead);

#endif
