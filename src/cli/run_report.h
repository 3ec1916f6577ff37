/* run_report.h - the result of a run in words. */
#ifndef FST_CLI_RUN_REPORT_H
#define FST_CLI_RUN_REPORT_H

#include <stdio.h>

#include <festoon/festoon.h>

/* Print a sentence that says what the bead does, then the numbers, scaled and in the units of a laboratory
 * (`si`: in SI), then the scaled groups. */
void print_run(FILE *out, const fst_groups *groups, const fst_run_result *result, int si);

/* Print the table of a ramp, after a sentence where the bead left the plate on the way. */
void print_ramp(FILE *out, const fst_groups *groups, const fst_run_result *result, const fst_ramp_point *points,
                size_t count);

#endif
