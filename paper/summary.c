/* summary.c - what `festoon paper` prints on a terminal. */
#include "paper/dry.h"
#include "paper/report.h"

#include <stdio.h>
#include <stdlib.h>

static void put_row(FILE *out, const fst_paper_state *paper, int row)
{
    const fst_table1_row *published = &fst_table1[row];
    (void)fprintf(out, "  %-8g %6.2f (S%d)", published->omega, published->published, published->published_a);
    for (int i = 0; i < FST_PAPER_DYNAMICS; ++i) {
        const fst_run_result *result = &paper->scans[FST_SCAN_TABLE][fst_paper_order[i]][row].result;
        const char *symmetry = fst_symmetry_name(result->symmetry);
        (void)fprintf(out, "   %8.4f (%s) %-15s", result->festoons, symmetry ? symmetry : "--",
                      fst_verdict_name(fst_table1_verdict(paper, row, fst_paper_order[i])));
    }
    (void)fputc('\n', out);
}

char *fst_paper_summary(const fst_paper_state *paper)
{
    fst_printed text;
    FILE *out = fst_print_begin(&text);
    if (!out)
        return NULL;
    (void)fprintf(out, "Table 1, number of festoons N (%s)\n\n", FST_TABLE1_CRITERION);
    (void)fprintf(out, "  %-8s %-11s   %-29s   %s\n", "omega", "published", "farago2020", "rigid");
    for (int row = 0; row < FST_TABLE1_ROWS; ++row)
        put_row(out, paper, row);
    const fst_tally tally = fst_paper_tally(paper, FST_GROUP_COUNT);
    const int *printed = tally.of[FST_DYNAMICS_FARAGO2020], *rigid = tally.of[FST_DYNAMICS_RIGID];
    (void)fprintf(
        out, "\n%d statements about motions: farago2020 %d reproduced, %d close, %d not; rigid %d, %d, %d\n",
        tally.moving, printed[0], printed[1], printed[2], rigid[0], rigid[1], rigid[2]);
    (void)fprintf(out, "%d statements into which no motion enters: %d reproduced, %d close, %d not\n",
                  tally.still, tally.once[0], tally.once[1], tally.once[2]);
    int dry[3] = {0};
    const int about_motion = fst_paper_dry_tally(paper, dry);
    if (about_motion > 0)
        (void)fprintf(out, "%d of the first with dry friction, mu = %g: %d, %d, %d\n", about_motion, FST_DRY_MU,
                      dry[0], dry[1], dry[2]);
    return fst_print_end(&text);
}
