/* runs.h - the computations: runs, periodic orbits, thresholds, probes.  Each fills its part of
 * the state in. */
#ifndef FST_PAPER_RUNS_H
#define FST_PAPER_RUNS_H

#include "paper/state.h"

/* Make room for everything, with all parameters set and nothing done; and free that room. */
fst_status fst_paper_begin(fst_paper_state *paper, fst_error *error);
void fst_paper_free_runs(fst_paper_state *paper);

/* All runs: how many, one of them, and all. */
int fst_paper_run_count(const fst_paper_state *paper);
fst_status fst_paper_scan_run(fst_paper_state *paper, int index, fst_error *error);
fst_status fst_paper_make_runs(fst_paper_state *paper, fst_error *error);
/* What the periodic orbits tell; then the thresholds, by bisection where the orbits do not give them. */
fst_status fst_paper_find_orbits(fst_paper_state *paper, fst_error *error);
fst_status fst_paper_find_thresholds(fst_paper_state *paper, fst_error *error);

/* The command that repeats the runs of a scan: "festoon run --set ...", with OMEGA in the place of the drive
 * where there are several.  The second one repeats a row of Table 1. */
void fst_paper_scan_command(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics, char *text,
                            size_t size);
void fst_paper_table1_command(const fst_paper_state *paper, int row, fst_dynamics dynamics, char *text,
                              size_t size);

/* ------------------------------------------------------------------ runs that settle: settle.c */

/* Make a run.  While its motion has not settled, make it again, twice as long and with all of the earlier time
 * discarded, up to eight times as long in all; `params` are then those of the last run.  `progress` and
 * `trajectory` may be NULL. */
fst_status fst_paper_run_settled(fst_params *params, const fst_progress *progress, fst_run_result *result,
                                 fst_table *trajectory, fst_error *error);
/* Make the run of a bead that rubs dry, and up to `tries` - 1 times more, each time twice as long, if it has
 * not settled.  Motions that end in rolling settle ever more slowly, so that longer runs would not help them:
 * what such a run tells stays in `result`, undecided.  So does a run whose Lyapunov exponent cannot be
 * computed. */
fst_status fst_paper_run_dry(fst_paper_run *run, int tries, const fst_progress *progress, fst_table *trajectory,
                             fst_error *error);
/* Whether its regime is decided (neither chaotic nor off the plate) and the errors of its means are small. */
int fst_paper_is_settled(const fst_run_result *result);
/* Whether it has not settled, and more time may settle it: chaos stays chaos, and a bead that left the plate
 * stays away. */
int fst_paper_may_settle(const fst_run_result *result);
/* Runs of a scan that did not settle in all this time. */
int fst_paper_unsettled(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics);

/* ------------------------------------------------------------------ periodic orbits: exact.c */

/* Fill paper->exact of the dynamics `index`; where LAPACK is missing, with the sentence that says so. */
fst_status fst_paper_find_exact(fst_paper_state *paper, int index, fst_error *error);
/* All undefined, as before the search. */
void fst_paper_exact_begin(fst_paper_exact *exact);

/* ------------------------------------------------------------------ probes: probe_parts.c */

/* Make the probes: all of them (NULL), or those of one step.  The probe of the period halving needs the
 * thresholds. */
fst_status fst_paper_make_probes(fst_paper_state *paper, const fst_paper_step *only, fst_error *error);

/* Drives and strengths of the probes. */
extern const double fst_ansatz_drives[FST_ANSATZ_DRIVES], fst_remanence_drives[FST_REMANENCE_DRIVES],
    fst_remanence_strengths[FST_REMANENCE_STRENGTHS];
extern const fst_kappa_scan fst_remanence_scan;

/* The drive of the period halving: the pitchfork of the orbits where it is known, else the line below; NAN: no
 * halving was found. */
double fst_paper_halving_drive(const fst_paper_state *paper, fst_dynamics dynamics);
/* The drive at which |<n_z>|^2, a straight line near the threshold, reaches zero. */
double fst_paper_halving_line(const fst_paper_state *paper, fst_dynamics dynamics);

#endif
