/* paramagnet.h - beads that are magnetised by the field (the paper's section "Paramagnetic bead"): identities,
 * the search for counter-rotation, and how much remanence is enough.
 */
#ifndef FST_PAPER_PARAMAGNET_H
#define FST_PAPER_PARAMAGNET_H

#include <festoon/festoon.h>

/* ------------------------------------------------------------------ one bead, followed */

typedef enum {
    FST_FATE_COUNTER,  /* circles against the magnet */
    FST_FATE_WITH,     /* circles with it, or stays with it */
    FST_FATE_STANDING, /* no circling either way to speak of */
    FST_FATE_AWAY,     /* left the plate, sideways or upwards */
    FST_FATE_COUNT
} fst_fate;

/* Follow the bead of `params` and say how it circles: the sign of the mean alpha' over the second half, where
 * its size exceeds 1e-4 omega. */
fst_status fst_fate_of(const fst_params *params, double periods, fst_fate *fate, double *mean_alpha_dot,
                       fst_error *error);

/* ------------------------------------------------------------------ the search */

/* Start `index` of the search, a point of Halton's sequence: drive 0.02 to 2 and strength a 1e-5 to 3e-2 (both
 * in logarithms), start at r 0.2 to 1.6 and any Phi, rolling or at rest. */
fst_status fst_search_params(int index, fst_dynamics dynamics, fst_params *params, fst_error *error);

/* What became of a start: beads that still circle against the magnet are followed on, up to 1024 times as long,
 * for a weakly magnetised one forgets its start slowly (see docs/paper.md for the law). */
typedef struct fst_search_entry {
    fst_fate first, last; /* after 150 drive periods, and in the end */
    double periods;       /* drive periods followed in all */
    double mean_alpha_dot;
} fst_search_entry;
fst_status fst_search_one(int index, fst_dynamics dynamics, fst_search_entry *entry, fst_error *error);

/* ------------------------------------------------------------------ the identities */

/* The time means that the paper's three identities and a fourth are about, over a window of the motion of a
 * paramagnetic bead. Over a finite window each lacks what the state's change adds; with it only the
 * integration's error is left. */
typedef enum {
    FST_BALANCE_ENERGY,  /* Eq. (tondu): <V_r^2 + V_alpha^2> = a omega <dB^2/dalpha> */
    FST_BALANCE_MOMENT,  /* Eq. (17): <r V_alpha> = a <dB^2/dalpha> */
    FST_BALANCE_KINETIC, /* <r' V_r + r alpha' V_alpha> = a omega <dB^2/dalpha> */
    FST_BALANCE_ROLLING, /* beyond the paper: (2/5) <(v x V)_z> = a <dB^2/dalpha>, see docs/paper.md; not with
                            the printed equations, which lack the term psi' n x n' of dW/dt */
    FST_BALANCE_COUNT
} fst_balance_kind;
typedef struct fst_balance {
    double friction, field, boundary; /* friction + boundary = field; boundary: change of state over the time */
} fst_balance;
typedef struct fst_balances {
    fst_balance of[FST_BALANCE_COUNT];
    double mean_alpha_dot;
    double periods; /* of the drive, in the window */
} fst_balances;
fst_status fst_paramagnet_balances(const fst_params *params, double discard, double periods,
                                   fst_balances *balances, fst_error *error);

/* The same ten times more coarsely, for long windows in which means are wanted to a few digits. */
fst_status fst_paramagnet_means(const fst_params *params, double discard, double periods,
                                fst_balances *balances, fst_error *error);

/* |friction + boundary - field| and |boundary|, over the larger of friction and field. */
double fst_balance_residual(const fst_balance *balance);
double fst_balance_boundary(const fst_balance *balance);

/* Whether <r V_alpha> and <r' V_r + r alpha' V_alpha> are those of a stationary motion: what the state's change
 * adds is under 5 %.  (The energy of a bead that the printed equations move may grow for ever: they spin it
 * up.) */
int fst_balances_settled(const fst_balances *balances);

/* ------------------------------------------------------------------ how much remanence */

/* Whether a bead counter-rotates is no monotone function of kappa: below the least value that a bisection would
 * find there may be others.  So kappa is scanned from below, at `points` values from `low` to `high` (by equal
 * factors), and the first edge met is refined by `halvings` bisections.  At each value the bead begins at
 * `starts` angles, half a turn divided evenly, and counter-rotates if it does so from one of them after
 * `periods` drive periods and still after four times as many. */
typedef struct fst_kappa_scan {
    double low, high;
    int points, halvings, starts;
    double periods;
    const fst_progress *progress; /* asked before each start; NULL: nobody */
} fst_kappa_scan;

/* `kappa` is the least with which the bead was seen to counter-rotate, NAN: none of the scan; `below` the
 * greatest tried value under it, with which it did not (NAN: the scan's first value does).  A range of kappa
 * between two values of the scan can be missed. */
typedef struct fst_least_found {
    double kappa, below;
} fst_least_found;

/* Least kappa found for the bead of `params` (material mixed, bead.a given). */
fst_status fst_least_kappa(const fst_params *params, const fst_kappa_scan *scan, fst_least_found *least,
                           fst_error *error);

#endif
