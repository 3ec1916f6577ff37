/* paramagnet.h - beads that are magnetised by the field (the paper's section VI, "Paramagnetic bead"): the
 * search for counter-rotation, the identities, and how much remanence is enough. */
#ifndef FST_PAPER_PARAMAGNET_H
#define FST_PAPER_PARAMAGNET_H

#include <festoon/festoon.h>

/* ------------------------------------------------------------------ one bead, followed */

typedef enum {
    FST_FATE_COUNTER,  /* circles against the magnet */
    FST_FATE_WITH,     /* circles with it, or stays with it */
    FST_FATE_STANDING, /* no circling worth the name in either direction */
    FST_FATE_AWAY,     /* left the plate, sideways or upwards */
    FST_FATE_COUNT
} fst_fate;

/* Follow the bead of `params` and say how it circles: by the sign of the mean alpha' over the second half,
 * where its size exceeds 1e-4 omega. */
fst_status fst_fate_of(const fst_params *params, double periods, fst_fate *fate, double *mean_alpha_dot,
                       fst_error *error);

/* ------------------------------------------------------------------ the search */

/* Start number `index` of the search, a point of Halton's sequence: drive 0.02 to 2 and strength a 1e-5 to 3e-2
 * (both spaced by equal factors), start at r 0.2 to 1.6 and any Phi, rolling or at rest. */
fst_status fst_search_params(int index, fst_dynamics dynamics, fst_params *params, fst_error *error);

/* How a start ended.  A bead that still circles against the magnet is followed on, up to 1024 times as long,
 * because a weakly magnetised bead forgets its start slowly (docs/paper.md has the law). */
typedef struct fst_search_entry {
    fst_fate first, last; /* after 150 drive periods, and in the end */
    double periods;       /* drive periods followed in all */
    double mean_alpha_dot;
} fst_search_entry;
fst_status fst_search_one(int index, fst_dynamics dynamics, fst_search_entry *entry, fst_error *error);

/* ------------------------------------------------------------------ the identities */

/* The time means of the paper's three identities and of a fourth, over a window of the motion of a paramagnetic
 * bead on a viscous plate, where V is the friction force (another law: FST_BAD_INPUT).  Over a finite window
 * each identity has one more term, from the change of the state; with it only the error of the integration
 * remains. */
typedef enum {
    FST_BALANCE_ENERGY,  /* Eq. (16): <V_r^2 + V_alpha^2> = a omega <dB^2/dalpha> */
    FST_BALANCE_MOMENT,  /* Eq. (17): <r V_alpha> = a <dB^2/dalpha> */
    FST_BALANCE_KINETIC, /* <r' V_r + r alpha' V_alpha> = a omega <dB^2/dalpha> */
    FST_BALANCE_ROLLING, /* beyond the paper: (2/5) <(v x V)_z> = a <dB^2/dalpha>, see docs/paper.md; not with
                            the printed equations, which lack the term psi' n x n' of dW/dt */
    FST_BALANCE_COUNT
} fst_balance_kind;
typedef struct fst_balance {
    double friction, field,
        boundary; /* friction + boundary = field; boundary comes from the change of the state over the window */
} fst_balance;
typedef struct fst_balances {
    fst_balance of[FST_BALANCE_COUNT];
    double mean_alpha_dot;
    double periods; /* drive periods in the window */
} fst_balances;
fst_status fst_paramagnet_balances(const fst_params *params, double discard, double periods,
                                   fst_balances *balances, fst_error *error);

/* The same with ten times fewer panels, for long windows in which a few digits of the means are enough. */
fst_status fst_paramagnet_means(const fst_params *params, double discard, double periods,
                                fst_balances *balances, fst_error *error);

/* |friction + boundary - field| and |boundary|, over the larger of friction and field. */
double fst_balance_residual(const fst_balance *balance);
double fst_balance_boundary(const fst_balance *balance);

/* Whether <r V_alpha> and <r' V_r + r alpha' V_alpha> are the means of a stationary motion: the term from the
 * change of the state is under 5 %.  (By the printed equations the energy of a bead may grow for ever, because
 * they spin it up.) */
int fst_balances_settled(const fst_balances *balances);

/* ------------------------------------------------------------------ how much remanence */

/* A bead may counter-rotate at one kappa, not at a greater one, and again at a still greater one.  A bisection
 * would find one such edge and miss others below it.  So kappa is scanned from below, at `points` values from
 * `low` to `high` (by equal factors), and the first edge is refined by `halvings` bisections.  At each kappa
 * the bead starts at `starts` angles, which divide half a turn evenly; it counter-rotates if from one of them
 * it does so after `periods` drive periods and still after four times as many. */
typedef struct fst_kappa_scan {
    double low, high;
    int points, halvings, starts;
    double periods;
    const fst_progress *progress; /* told before each start; NULL: nobody */
} fst_kappa_scan;

/* `kappa` is the least value with which the bead was seen to counter-rotate (NAN: there is none in the scan);
 * `below` is the greatest value under it with which it did not (NAN: it already did with the first).  A range
 * of kappa between two values of the scan can be missed. */
typedef struct fst_least_found {
    double kappa, below;
} fst_least_found;

/* The least kappa found for the bead of `params` (material mixed, bead.a given). */
fst_status fst_least_kappa(const fst_params *params, const fst_kappa_scan *scan, fst_least_found *least,
                           fst_error *error);

#endif
