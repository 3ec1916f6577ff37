/* curve_end.h - why a curve ends: a type for the program, a sentence for people. */
#ifndef FST_ORBIT_CURVE_END_H
#define FST_ORBIT_CURVE_END_H

#include <festoon/festoon.h>

typedef struct fst_curve_end {
    fst_end_type type; /* FST_END_NONE: it goes on */
    char reason[sizeof((fst_branch_end *)0)->reason];
} fst_curve_end;

/* The curve ends here, for this reason. */
void fst_curve_end_set(fst_curve_end *end, fst_end_type type, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
