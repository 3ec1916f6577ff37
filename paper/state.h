/* state.h - the repetition of the paper while it is computed: what is asked for and what was found so far.
 *
 *     runs.c ---------.
 *     exact.c --------+--> fst_paper_state --> measures --> statements --> verdicts --> report
 *     probe_parts.c --+                    `-> figures, films -----------------------'
 *     dry.c ----------+
 *     magnets.c ------+
 *     beads.c --------'
 *
 * The files on the left fill the state in; everything on the right only reads it.  The paper's bead is a solid
 * sphere, so formulas in this directory have its 2/5 (0.4, 0.2, 2.5) written out: bead.inertia plays no part.
 */
#ifndef FST_PAPER_STATE_H
#define FST_PAPER_STATE_H

#include "paper/disc.h"
#include "paper/paper.h"
#include "paper/paramagnet.h"
#include "paper/probes.h"

#include <stdatomic.h>

enum { FST_PAPER_DYNAMICS = 2 }; /* rigid and farago2020; indices are those of fst_dynamics */
/* The printed equations come first wherever both are shown: they are what was published. */
extern const fst_dynamics fst_paper_order[FST_PAPER_DYNAMICS];

/* The steps of the work, in the order in which they are done. */
typedef enum {
    FST_PAPER_STEP_RUNS,
    FST_PAPER_STEP_EXACT,
    FST_PAPER_STEP_THRESHOLDS,
    FST_PAPER_STEP_HALVING,
    FST_PAPER_STEP_ANSATZ,
    FST_PAPER_STEP_SEARCH,
    FST_PAPER_STEP_BALANCES,
    FST_PAPER_STEP_REMANENCE,
    FST_PAPER_STEP_DRY,
    FST_PAPER_STEP_MAGNETS,
    FST_PAPER_STEP_BEADS,
    FST_PAPER_STEP_WAVES,
    FST_PAPER_STEP_COUNT
} fst_paper_step;

/* ------------------------------------------------------------------ runs */

/* A scan is a group of runs that differ in their drive alone. */
typedef enum {
    FST_SCAN_COMPARISON,  /* over the range of the paper's comparison with the experiment, rolling at the start
                           */
    FST_SCAN_FAST,        /* beyond the experiments, for the free-rolling formulas */
    FST_SCAN_SLOW,        /* from rest, through the loss of corotation */
    FST_SCAN_TABLE,       /* the rows of Table 1 */
    FST_SCAN_FOLD4,       /* omega = 0.215, with its trajectory */
    FST_SCAN_FOLD15,      /* omega = 0.4, with its trajectory */
    FST_SCAN_CONJUGATE,   /* omega = 0.215 from the start with all poles exchanged */
    FST_SCAN_ASYMPTOTIC,  /* far beyond all experiments */
    FST_SCAN_ANISOTROPIC, /* a bead that the field magnetises along an axis of its own, without remanence */
    FST_SCAN_COUNT,
    FST_SCAN_NONE = FST_SCAN_COUNT /* of statements that rest on no run */
} fst_scan;

typedef struct fst_paper_run {
    int done;
    fst_params params; /* set before the run is made */
    fst_run_result result;
    fst_table trajectory; /* of the scans that keep it, else empty */
} fst_paper_run;

/* ------------------------------------------------------------------ thresholds and orbits */

/* The motion changes its kind at a drive between `low` and `high`. */
typedef struct fst_paper_bracket {
    double low, high;
} fst_paper_bracket;

typedef enum {
    FST_CHANGE_HALVING,    /* S1 below, S2 above */
    FST_CHANGE_LOCKED,     /* at rest under the magnet below, swinging or gone above */
    FST_CHANGE_COROTATION, /* goes round with the magnet below, no longer above */
    FST_CHANGE_COUNT
} fst_change;

enum {
    FST_TABLE1_ROWS = 5,
    FST_MOST_FIGURES = 64,
    FST_HALVING_BELOW = 10, /* drives below the threshold of the period halving, the nearest last */
    FST_HALVING_ABOVE = 6,  /* drives above it, the nearest first */
    FST_HALVING_POINTS = FST_HALVING_BELOW + FST_HALVING_ABOVE,
    FST_HALVING_INSET = 5,   /* the drive whose r(t) the inset of the figure shows */
    FST_HALVING_SHOWN = 400, /* values of r in that inset */
    FST_ANSATZ_DRIVES = 4,
    FST_ANSATZ_STARTS = 16,
    FST_REMANENCE_DRIVES = 2,
    FST_REMANENCE_STRENGTHS = 6,
    FST_BALANCE_CASES = 3
};

/* By how much friction is raised, to see what it has to do with the end of corotation. */
#define FST_MORE_FRICTION 1.05

/* The drive at which a pattern of Table 1 closes exactly; NAN: nowhere on the stable branch. */
typedef struct fst_paper_pattern {
    double omega;
    fst_symmetry symmetry;
} fst_paper_pattern;

/* What is read off the branch of periodic orbits (exact.c). */
typedef struct fst_paper_exact {
    fst_paper_pattern closed[FST_TABLE1_ROWS];
    double halving;    /* the pitchfork; NAN: none found */
    int criticality;   /* 1 supercritical, -1 subcritical */
    double fold;       /* where the counter-rotating orbit ends; NAN: beyond the range */
    double origin;     /* where it passes the axis, going down, and is a libration from there; NAN: nowhere */
    double locked_end; /* where the last locked state loses its stability, a Hopf point; NAN: not found */
    double most_s1;    /* greatest N of stable S1 orbits */
    double locked_end_rubbed; /* and with FST_MORE_FRICTION times the friction */
    double locked_minima;     /* stable locked states at the drive 0.02 */
    double damping;           /* -Re/|lambda| of the least damped swing about a pole at kappa = 0.015 */
    char missing[768];        /* why nothing of this could be computed; "": it was */
} fst_paper_exact;

/* ------------------------------------------------------------------ probes */

typedef struct fst_paper_halving {
    fst_halving_point points[FST_HALVING_POINTS];
    double r[FST_HALVING_SHOWN]; /* r(t) at points[FST_HALVING_INSET] */
} fst_paper_halving;

/* A bead set on the Appendix's corotating motion; fst_probe_ansatz() tells what the numbers are. */
typedef struct fst_paper_ansatz {
    double speed, survived;
} fst_paper_ansatz;

/* ------------------------------------------------------------------ the whole */

/* How long a part of the work took. */
enum { FST_MOST_PARTS = 16 };
typedef struct fst_paper_part {
    const char *what;
    double seconds;
} fst_paper_part;

typedef struct fst_paper_state {
    int done[FST_PAPER_STEP_COUNT]; /* which steps are done */
    int complete;                   /* all steps are, and the figures are drawn */
    const fst_paper_options *options;
    const char *directory;
    atomic_int refused;         /* the caller wants the work to end */
    fst_progress until_refused; /* the progress of all runs and searches, which end once `refused` is set */
    int counts[FST_SCAN_COUNT];
    int films;                   /* films that are made */
    int first_scan;              /* no run of the scans before this one is made */
    int drawn[FST_MOST_FIGURES]; /* by the index of the figure */
    fst_paper_run *scans[FST_SCAN_COUNT][FST_PAPER_DYNAMICS];
    fst_paper_exact exact[FST_PAPER_DYNAMICS];
    fst_paper_bracket changes[FST_CHANGE_COUNT][FST_PAPER_DYNAMICS];
    fst_paper_halving halving[FST_PAPER_DYNAMICS];
    fst_paper_ansatz ansatz[FST_PAPER_DYNAMICS][FST_ANSATZ_DRIVES][FST_ANSATZ_STARTS];
    double disc
        [FST_DISC_PLACES]; /* the least drive at which a disc goes with the magnet, stably; NAN: not found */
    fst_search_entry *search[FST_PAPER_DYNAMICS]; /* the same starts with both dynamics */
    int search_count;
    double mu;                 /* the coefficient of dry friction of all scans; 0: the paper's viscous law */
    struct fst_paper_dry *dry; /* what is computed of a bead that rubs dry (dry.h); NULL within that itself */
    struct fst_paper_magnets *magnets;                            /* the runs on real magnets (magnets.h) */
    struct fst_paper_beads *beads;                                /* several beads (beads.h); NULL: not yet */
    struct fst_paper_waves *waves;                                /* a travelling field (waves.h); the same */
    fst_balances balances[FST_PAPER_DYNAMICS][FST_BALANCE_CASES]; /* for the identities */
    fst_balances settled[FST_PAPER_DYNAMICS][FST_BALANCE_CASES];  /* over longer windows, for the means */
    fst_least_found remanence[FST_PAPER_DYNAMICS][FST_REMANENCE_DRIVES][FST_REMANENCE_STRENGTHS];
    double seconds, processor_seconds;    /* what all of it took, by the clock and on all processors together */
    fst_paper_part parts[FST_MOST_PARTS]; /* what its parts took, in their order */
    int part_count;
} fst_paper_state;

/* Whether the step is done, and the runs of `scan` with all scans that are made before it. */
int fst_paper_has(const fst_paper_state *paper, fst_paper_step step, fst_scan scan);

/* The one run of a scan that has only one. */
const fst_paper_run *fst_paper_single(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics);

/* Whether the bead circles against the magnet, regularly. */
int fst_paper_counter_rotates(const fst_paper_run *run);

/* The share of the whole progress that is done before the films are made. */
static inline double fst_paper_share(const fst_paper_state *paper)
{
    return paper->options->films ? 0.8 : 1.0;
}

#endif
