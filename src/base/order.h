/* order.h - numbers in order: for qsort(), and their median. */
#ifndef FST_BASE_ORDER_H
#define FST_BASE_ORDER_H

#include <stdlib.h>

/* For qsort() of doubles: rising. */
static inline int fst_ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts the values, and returns the one in the middle (the upper one of two); 0 of none. */
static inline double fst_median(double *values, size_t count)
{
    qsort(values, count, sizeof *values, fst_ascending);
    return count > 0 ? values[count / 2] : 0.0;
}

#endif
