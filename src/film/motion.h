/* motion.h - the motion between the samples of a trajectory, for films. */
#ifndef FST_FILM_MOTION_H
#define FST_FILM_MOTION_H

#include "film/frame.h"

#include <festoon/festoon_tools.h>

typedef struct fst_film_motion {
    const fst_table *table;
    const double *t, *drive_turns, *x, *y, *colour, *n[3], *w[3];
    const double *sticking; /* NULL: the contact only slips */
    const double *flying, *z;
    size_t first, last; /* rows shown: first <= row <= last */
    double millimetres;
    double low, high; /* the range of the colour */
    int both_signs;
    const fst_column_info *colour_info;
    size_t row;        /* the row before the present moment */
    double part;       /* how far from that row to the next, 0 to 1 */
    double turn[3][3]; /* rotation of the bead at `row`; its third axis is n */
} fst_film_motion;

/* Begin with the rows between the drive periods `from` and `to` (NAN: the beginning, the end), coloured by
 * `colour` (NULL: slip).  FST_BAD_INPUT: there are no such rows, or no such column. */
fst_status fst_film_motion_begin(fst_film_motion *motion, const fst_table *table, double from, double to,
                                 const char *colour, fst_error *error);

/* Go on to a moment, in turns of the drive; it must not be earlier than the one before. */
void fst_film_motion_to(fst_film_motion *motion, double turns);

/* Put bead, magnet and the bead's rotation at that moment into a frame. */
void fst_film_motion_frame(const fst_film_motion *motion, fst_film_frame *frame);

#endif
