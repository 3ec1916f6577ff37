/* parts_field.h - how long a magnet's field takes in lanes. */
#ifndef FST_BENCH_PARTS_FIELD_H
#define FST_BENCH_PARTS_FIELD_H

#include <festoon/festoon.h>

/* Seconds that B and G u take at one place, as a right-hand side asks for them: the least of `rounds` rounds
 * over the same places.  Each is parts_field.c compiled for a form of lanes (ROW: name, instruction set). */
#define PARTS_FIELD_FORMS(ROW)                                                                                 \
    ROW(portable4, "avx2")                                                                                     \
    ROW(avx2, "avx2")                                                                                          \
    ROW(portable8, "avx512dq")                                                                                 \
    ROW(avx512, "avx512dq")
#define DECLARE(name, instructions)                                                                            \
    double parts_field_##name(const fst_params *params, const fst_groups *groups, int rounds);
PARTS_FIELD_FORMS(DECLARE)
#undef DECLARE

double parts_now(void); /* seconds */

#endif
