/* curve_end.h - where a curve ends, and why: a type for the program, a sentence for people. */
#ifndef FST_ORBIT_CURVE_END_H
#define FST_ORBIT_CURVE_END_H

#include <festoon/festoon.h>

/* Beyond these nothing is followed or looked for: orbits of a longer period run into an equilibrium, and at a
 * greater radius the field is a ten-thousandth of that under the bead. */
#define FST_LONGEST_PERIOD 400.0
#define FST_LARGEST_RADIUS 8.0

typedef struct fst_curve_end {
    fst_end_type type; /* FST_END_NONE: it goes on */
    char reason[sizeof((fst_branch_end *)0)->reason];
} fst_curve_end;

/* The curve ends here, for this reason. */
void fst_curve_end_set(fst_curve_end *end, fst_end_type type, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
