/* matrix.h - the few operations on small symmetric matrices that a fit needs. */
#ifndef FST_FIT_MATRIX_H
#define FST_FIT_MATRIX_H

enum { FIT_MOST = 16 }; /* the most parameters of a fit, nuisance parameters included */

/* A matrix of at most FIT_MOST rows. */
typedef struct fit_matrix {
    int size;
    double a[FIT_MOST][FIT_MOST];
} fit_matrix;

/* Eigenvalues of a symmetric matrix, rising, and its orthonormal eigenvectors: vectors->a[i][k] is component i
 * of vector k.  By Jacobi's rotations, which keep the digits of small eigenvalues. */
void fit_eigen(const fit_matrix *symmetric, double values[FIT_MOST], fit_matrix *vectors);

/* The inverse of a symmetric positive matrix from its eigenvalues and eigenvectors. */
void fit_inverse(int size, const double values[FIT_MOST], const fit_matrix *vectors, fit_matrix *inverse);

/* sum of a_i m_ij b_j */
double fit_product(const fit_matrix *m, const double *a, const double *b);

#endif
