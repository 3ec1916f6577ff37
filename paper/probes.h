/* probes.h - questions of the paper that a single run cannot answer: the neighbourhood of the period halving,
 * and beads set on the corotating motion of the Appendix. */
#ifndef FST_PAPER_PROBES_H
#define FST_PAPER_PROBES_H

#include <festoon/festoon.h>

/* ------------------------------------------------------------------ the period halving */

/* The settled motion at one drive near the halving. */
typedef struct fst_halving_point {
    double omega;
    double mean_nz; /* |<n_z>| over whole returns; this and the next are NAN where the motion had not settled */
    double order;   /* the paper's p = Delta+/Delta- - 1 */
    double relaxation; /* time in 1/gamma in which the distance from the settled motion falls by a factor e;
                          NAN: not seen */
} fst_halving_point;

enum { FST_HALVING_PARTS = 80 }; /* values of r per drive period */

/* Follow the motion of `params` for `periods` drive periods.  If `r_of_t` is not NULL, it receives the last
 * `count` values of r, 1/FST_HALVING_PARTS of a drive period apart. */
fst_status fst_probe_halving(const fst_params *params, double periods, fst_halving_point *point, double *r_of_t,
                             int count, fst_error *error);

/* A straight line through points, by least squares. */
typedef struct fst_scatter {
    double n, x, y, xx, yy, xy; /* sums */
} fst_scatter;
static inline void fst_scatter_add(fst_scatter *points, double x, double y)
{
    points->n += 1.0;
    points->x += x;
    points->y += y;
    points->xx += x * x;
    points->yy += y * y;
    points->xy += x * y;
}
double fst_scatter_slope(const fst_scatter *points);
double fst_scatter_correlation(const fst_scatter *points);

/* The exponent of a power law y = factor |x - x0|^exponent, fitted to the points with y > 0 by least squares in
 * logarithms. */
double fst_power_exponent(const double *x, const double *y, int count, double x0);

/* Where the straight line through the points crosses zero. */
double fst_line_zero(const double *x, const double *y, int count);

/* ------------------------------------------------------------------ rapid corotation */

/* The state of the Appendix's corotating bead: alpha' = eps omega/(r + eps), phi = Phi + pi, the contact at
 * rest. */
void fst_ansatz_state(const fst_model *model, double r, double bead_angle, double state[FST_STATE_SIZE]);

/* Follow that bead for `periods` drive periods.  `speed` is its mean alpha' over the second half, in units of
 * the corotating motion's (1: still on it).  `survived` is when r first left [r/2, 2r], or alpha' over a drive
 * period fell under half of the corotating one, in drive periods (`periods`: never). */
fst_status fst_probe_ansatz(const fst_params *params, double r, double bead_angle, double periods,
                            double *speed, double *survived, fst_error *error);

#endif
