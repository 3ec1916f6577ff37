/* outcomes.h - what became of the points of a sweep, and what they cost. */
#ifndef FST_SWEEP_OUTCOMES_H
#define FST_SWEEP_OUTCOMES_H

#include <festoon/festoon_tools.h>

#include "sweep/bead_columns.h"

/* Count these rows, which are of one kind. */
void fst_outcomes_add(fst_row_kind kind, const fst_sweep_record *rows, int count, fst_sweep_counts *counts);

#endif
