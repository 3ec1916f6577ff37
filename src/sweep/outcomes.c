/* outcomes.c - what became of the points of a sweep, and what they cost.  The measure is how often the equations of motion
 * were evaluated: unlike seconds it depends on the points alone, not on lanes, threads and neighbours. */
#include "sweep/outcomes.h"

void fst_outcomes_add(fst_row_kind kind, const fst_sweep_record *rows, int count, fst_sweep_counts *counts)
{
    counts->kind = kind;
    for (const fst_sweep_record *row = rows; row < rows + count && kind != FST_ROWS_OF_LEVITATION; ++row) {
        const int failed = row->status != FST_OK, beads = kind == FST_ROWS_OF_BEADS;
        const int place = failed  ? FST_SWEEP_OUTCOMES - 1
                          : beads ? row->beads.outcome
                                  : (int)row->result.regime;
        fst_sweep_outcome *outcome = &counts->outcomes[place];
        outcome->points += 1;
        if (failed)
            continue; /* what it took is not known */
        outcome->rhs_calls += beads ? row->beads.rhs_calls : (int64_t)row->result.rhs_calls;
        outcome->periods += beads ? row->beads.periods : row->result.periods;
    }
}

const char *fst_sweep_outcome_name(fst_row_kind kind, int place)
{
    return place == FST_SWEEP_OUTCOMES - 1 ? "failed"
           : kind == FST_ROWS_OF_BEADS     ? fst_beads_outcome_name((fst_beads_outcome)place)
                                           : fst_regime_name((fst_regime)place);
}
