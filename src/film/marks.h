/* marks.h - marks on a filmed bead, by which its turning can be seen.
 *
 * Marks are black paint on a coat that is lighter than steel.  The pattern is fixed to the bead, whose third axis is its magnetic
 * moment n:
 *
 *   half   the northern half is black, but for two dots that are left out; two black dots are on the southern half
 *   dots   a large black dot on the north pole, and a smaller one on the equator
 */
#ifndef FST_FILM_MARKS_H
#define FST_FILM_MARKS_H

#include "film/motion.h"

typedef struct fst_film_marks {
    const fst_film_motion *motion;
    double (*turns)[3][3]; /* the rotation of the bead at each row that is filmed */
    int half;
} fst_film_marks;

/* Whether there are such marks. */
int fst_film_marks_known(const char *name);

/* Integrate the rotation over all rows.  Free `turns` in any case.  FST_NO_MEMORY. */
fst_status fst_film_marks_begin(fst_film_marks *marks, const fst_film_motion *motion, const char *name,
                                fst_error *error);

/* The rotation of the bead at a part of the way from a row to the next; rows count from the first that is filmed. */
void fst_film_marks_turn(const fst_film_marks *marks, size_t row, double part, double turn[3][3]);

/* Which part of the light that bare steel sends back comes from a point of the bead: a unit vector in the
 * laboratory, where the bead is turned by `turn`. */
double fst_film_marks_shade(const fst_film_marks *marks, const double turn[3][3], const double normal[3]);

#endif
