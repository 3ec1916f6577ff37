/* rows.h - the model at the frequencies of a table: an orbit each, followed as the parameters change. */
#ifndef FST_FIT_ROWS_H
#define FST_FIT_ROWS_H

#include "fit/space.h"

/* How a value was found. */
typedef enum { FIT_NOTHING, FIT_ORBIT, FIT_RUN } fit_origin;

/* What the model says at one frequency; SI units, the bead's frequency with the sign of the table. */
typedef struct fit_value {
    fit_origin origin;
    double value[FST_MEASURED_COUNT];
    fst_orbit orbit; /* of FIT_ORBIT */
} fit_value;

/* One frequency. */
typedef struct fit_row {
    double frequency;
    fit_value last; /* the latest that was kept, at the coordinates `at` ... */
    double at[FIT_MOST];
    /* ... and how the orbit changes along each coordinate there, by which the next one is guessed */
    int has_slopes;
    double state_slope[FIT_MOST][FST_STATE_SIZE], period_slope[FIT_MOST];
} fit_row;

typedef struct fit_rows {
    const fit_space *space;
    fit_row *rows;
    int count;
    const fst_progress *progress; /* told that it goes on, by a fraction of each call */
} fit_rows;

fst_status fit_rows_begin(fit_rows *rows, const fit_space *space, const double *frequencies, int count,
                          const fst_progress *progress, fst_error *error);
void fit_rows_free(fit_rows *rows);

/* The model at u in every row, into values[row].  Nothing is remembered. */
fst_status fit_rows_values(const fit_rows *rows, const double *u, fit_value *values, fst_error *error);

/* Remember the values as those at u. */
void fit_rows_keep(fit_rows *rows, const double *u, const fit_value *values);

/* derivative[row * space->count + i][what] = d value/d u_i at the kept values. */
fst_status fit_rows_slopes(fit_rows *rows, double (*derivative)[FST_MEASURED_COUNT], fst_error *error);

/* by_frequency[row][what] = d value/d frequency, 1/Hz times the unit of the value. */
fst_status fit_rows_by_frequency(const fit_rows *rows, double (*by_frequency)[FST_MEASURED_COUNT],
                                 fst_error *error);

#endif
