/* elementary.h - a sine and cosine whose bits are the same on every machine. */
#ifndef FST_BASE_ELEMENTARY_H
#define FST_BASE_ELEMENTARY_H

/* sin and cos of an angle in degrees (|degrees| < 1e15), by + - * / alone: glibc's are misrounded now and then,
 * and a compiler may fold them.  Within one unit in the last place; exact at multiples of 90 degrees. */
void fst_sin_cos_degrees(double degrees, double *sine, double *cosine);

#endif
