/* results.h - the figures of a benchmark for tables.py, which makes docs/inside/performance.md's tables of them. */
#ifndef FST_BENCH_RESULTS_H
#define FST_BENCH_RESULTS_H

/* Append a cell to the file that the environment variable PERFORMANCE_TSV names: a line
 * TABLE, ROW, COLUMN, VALUE with tabulators between them.  Nothing is written where it names none. */
void result_put(const char *table, const char *row, const char *column, const char *format, double value);

/* The median of `count` numbers, which it sorts. */
double result_median(double *values, int count);

#endif
