/* table.c - Table 1 of the paper: the numbers of festoons. */
#include "paper/statements.h"
#include "paper/runs.h"

const fst_table1_row fst_table1[FST_TABLE1_ROWS] = {
    {0.21, 3.98, 4, 1}, {0.25, 5.03, 5, 1}, {0.2845, 5.99, 6, 1}, {0.352, 13.98, 14, 2}, {0.405, 14.96, 15, 2}};

double fst_table1_deviation(const fst_paper_state *paper, int row, fst_dynamics dynamics)
{
    double festoons = paper->scans[FST_SCAN_TABLE][dynamics][row].result.festoons;
    return fabs(festoons / fst_table1[row].published - 1.0);
}

fst_verdict fst_table1_verdict(const fst_paper_state *paper, int row, fst_dynamics dynamics)
{
    fst_symmetry symmetry = paper->scans[FST_SCAN_TABLE][dynamics][row].result.symmetry;
    fst_symmetry published = fst_table1[row].published_a == 1 ? FST_SYMMETRY_S1 : FST_SYMMETRY_S2;
    double deviation = fst_table1_deviation(paper, row, dynamics);
    if (symmetry != published || !(deviation <= 0.05))
        return FST_VERDICT_NOT;
    return deviation <= 0.012 ? FST_VERDICT_REPRODUCED : FST_VERDICT_CLOSE;
}
