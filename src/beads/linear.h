/* linear.h - small systems of linear equations, as contacts make them. */
#ifndef FST_BEADS_LINEAR_H
#define FST_BEADS_LINEAR_H

/* Solve matrix x = right for x, in place; both are overwritten.  Where the matrix is singular, but the equations do not
 * contradict each other, x is one solution of many and *unique becomes 0.  0: none was found. */
int beads_solve_any(int count, double *matrix, double *right, int *unique);

/* The same for a symmetric matrix without negative eigenvalues. */
int beads_solve_symmetric(int count, double *matrix, double *right, int *unique);

#endif
