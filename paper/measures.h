/* measures.h - the numbers of the statements, measured on the runs: a function for each name in the column
 * `measure` of statements.def, fst_measure_NAME(). */
#ifndef FST_PAPER_MEASURES_H
#define FST_PAPER_MEASURES_H

#include "paper/statements.h"

#define MEASURE(name) double fst_measure_##name(const fst_measuring *m)

#define CLAIM(id, group, rule, measure, ...) MEASURE(measure);
#define READING(id, rule, measure, ...) MEASURE(measure);
#include "paper/statements.def"
#undef CLAIM
#undef READING

#endif
