/* row_errors.h - how wrong the numbers of rows are. */
#ifndef FST_BENCH_ROW_ERRORS_H
#define FST_BENCH_ROW_ERRORS_H

#include <festoon/festoon.h>

/* Differences from the same rows of a reference, divided by the number where it is greater than 1: the greatest
 * ones, and the key of the worst mean and extreme. */
typedef struct row_errors {
    double states; /* final states, never divided */
    double means, extremes,
        period; /* mean_*, std_*, rms_*, the terms of Eqs. (12)-(14); min_*, max_*; period */
    const char *worst_mean, *worst_extreme;
    int regimes; /* rows with another regime */
} row_errors;

row_errors row_errors_of(const fst_run_result *rows, const fst_run_result *references, int count);

#endif
