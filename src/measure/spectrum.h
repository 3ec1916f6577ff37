/* spectrum.h - the strongest line in a series of places or radii. */
#ifndef FST_MEASURE_SPECTRUM_H
#define FST_MEASURE_SPECTRUM_H

#include <festoon/festoon.h>

/* A series over time; `im` may be NULL.  Its times may have gaps and be uneven. */
typedef struct measure_series {
    const double *t, *re, *im;
    size_t count;
    double fps; /* the rate of the grid on which it lies, more or less */
} measure_series;

typedef struct measure_line {
    double frequency; /* Hz; with an imaginary part of either sign, otherwise positive */
    double power;     /* over the mean power of a line; 1 for noise */
    double limit;     /* the power that noise alone exceeds once in a thousand series */
} measure_line;

/* The sum of the series times exp(-2 pi i f t): its real and its imaginary part. */
void measure_wave(const measure_series *series, double frequency, double sum[2]);

/* Find the strongest line at frequencies from `least` in magnitude up to half the frame rate.  FST_NO_MEMORY is
 * the only failure. */
fst_status measure_strongest_line(const measure_series *series, double least, measure_line *line,
                                  fst_error *error);

#endif
