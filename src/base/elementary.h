/* elementary.h - a sine and cosine whose bits are the same on every machine. */
#ifndef FST_BASE_ELEMENTARY_H
#define FST_BASE_ELEMENTARY_H

/* Sine and cosine of an angle in degrees (|degrees| < 1e15).  The C library's own functions are misrounded now
 * and then, and a compiler may compute them beforehand with other bits.  These use + - * / alone, are correct
 * within one unit in the last place, and exact at multiples of 90 degrees. */
void fst_sin_cos_degrees(double degrees, double *sine, double *cosine);

/* The same for what the numbers of a run need beside: the angle of (x, y) from -pi to pi, the angle whose sine
 * is x, and the natural logarithm of a normal number x > 0.  Correct within two units in the last place
 * (elementary.inl). */
double fst_atan2(double y, double x);
double fst_asin(double x);
double fst_log(double x);

#endif
