/* linear.h - small systems of linear equations, as contacts make them. */
#ifndef FST_BEADS_LINEAR_H
#define FST_BEADS_LINEAR_H

/* Solve matrix x = right for x, in place; both are overwritten.  0: the matrix is singular. */
int beads_solve(int count, double *matrix, double *right);

/* The same for a symmetric matrix without negative eigenvalues.  Where it is singular, but the equations
 * do not contradict each other, x is one solution of many and *unique becomes 0. */
int beads_solve_symmetric(int count, double *matrix, double *right, int *unique);

#endif
