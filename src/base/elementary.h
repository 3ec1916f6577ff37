/* elementary.h - a sine and cosine whose bits are the same on every machine. */
#ifndef FST_BASE_ELEMENTARY_H
#define FST_BASE_ELEMENTARY_H

/* Sine and cosine of an angle in degrees (|degrees| < 1e15).  The C library's own functions are misrounded now
 * and then, and a compiler may compute them beforehand with other bits.  These use + - * / alone, are correct
 * within one unit in the last place, and exact at multiples of 90 degrees. */
void fst_sin_cos_degrees(double degrees, double *sine, double *cosine);

#endif
