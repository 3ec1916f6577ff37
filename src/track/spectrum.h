/* spectrum.h - the strongest line in a series of places or radii. */
#ifndef FST_TRACK_SPECTRUM_H
#define FST_TRACK_SPECTRUM_H

#include <festoon/festoon.h>

/* A series over time; `im` may be NULL.  Its times may have gaps and be uneven. */
typedef struct track_series {
    const double *t, *re, *im;
    size_t count;
    double fps; /* the rate of the grid on which it lies, more or less */
} track_series;

typedef struct track_line {
    double frequency; /* Hz; with an imaginary part of either sign, otherwise positive */
    double power;     /* over the mean power of a line; 1 for noise */
    double limit;     /* the power that noise alone exceeds once in a thousand series */
} track_line;

/* Find the strongest line at frequencies from `least` in magnitude up to half the frame rate.  FST_NO_MEMORY is
 * the only failure. */
fst_status track_strongest_line(const track_series *series, double least, track_line *line, fst_error *error);

#endif
