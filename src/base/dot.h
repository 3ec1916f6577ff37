/* dot.h - the scalar product of two vectors. */
#ifndef FST_BASE_DOT_H
#define FST_BASE_DOT_H

static inline double fst_dot(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

#endif
