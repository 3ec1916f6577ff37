/* cholesky.h - Cholesky's factors of small symmetric matrices, by rows. */
#ifndef FST_MODEL_CHOLESKY_H
#define FST_MODEL_CHOLESKY_H

#include <math.h>

/* The upper half of a (n x n by rows) becomes R, R'R = a; returns log det a, or NAN. */
static inline double factor(int n, double *a)
{
    double log_det = 0.0;
    for (int i = 0; i < n; ++i) {
        double *row = &a[(size_t)i * (size_t)n];
        for (int k = 0; k < i; ++k) {
            const double *above = &a[(size_t)k * (size_t)n], f = above[i];
            for (int j = i; j < n; ++j)
                row[j] -= f * above[j];
        }
        if (!(row[i] > 0))
            return NAN;
        log_det += log(row[i]);
        const double scale = 1.0 / sqrt(row[i]);
        for (int j = i; j < n; ++j)
            row[j] *= scale;
    }
    return log_det;
}

/* Each of `many` x becomes R'^-1 x; the first `from` numbers of all are zero. */
static inline void solve_lower(int n, const double *r, double *x, int many, int from)
{
    for (int k = from; k < n; ++k) {
        const double *row = &r[(size_t)k * (size_t)n];
        for (int m = 0; m < many; ++m) {
            double *to = &x[m * n];
            const double f = to[k] /= row[k];
            for (int j = k + 1; j < n; ++j)
                to[j] -= f * row[j];
        }
    }
}

/* x becomes R^-1 x. */
static inline void solve_upper(int n, const double *r, double *x)
{
    for (int i = n - 1; i >= 0; --i) {
        const double *row = &r[(size_t)i * (size_t)n];
        for (int j = i + 1; j < n; ++j)
            x[i] -= row[j] * x[j];
        x[i] /= row[i];
    }
}

static inline double dot(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

#endif
