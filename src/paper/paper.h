/* paper.h - the paper and its repetition, as the files of fst_paper() share them.
 *
 * What is repeated stands in four tables: the runs (runs.c), the rows of Table 1 (table.c), the
 * statements (statements.c) and the figures (figures.c).  A new comparison is a new row.
 */
#ifndef FST_PAPER_PAPER_H
#define FST_PAPER_PAPER_H

#include "paper/paramagnet.h"
#include "paper/probes.h"

#include <stdatomic.h>
#include <festoon/festoon_tools.h>

/* ------------------------------------------------------------------ runs */

enum { FST_PAPER_DYNAMICS = 2 }; /* rigid and farago2020; indices are those of fst_dynamics */

/* The work in the order in which it is done. */
typedef enum {
    FST_STEP_RUNS,
    FST_STEP_EXACT,
    FST_STEP_THRESHOLDS,
    FST_STEP_HALVING,
    FST_STEP_ANSATZ,
    FST_STEP_SEARCH,
    FST_STEP_BALANCES,
    FST_STEP_REMANENCE,
    FST_STEP_COUNT
} fst_paper_step;

/* What the runs of one group have in common. */
typedef enum {
    FST_SCAN_COMPARISON,  /* the range of the paper's Fig. comparison, from the rolling start */
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

/* A drive at which the motion changes its kind, by a branch or by bisection: between `low` and `high`. */
typedef struct fst_paper_bracket {
    double low, high;
} fst_paper_bracket;

typedef enum {
    FST_CHANGE_HALVING,    /* S1 below, S2 above */
    FST_CHANGE_LOCKED,     /* at rest under the magnet below, swinging or gone above */
    FST_CHANGE_COROTATION, /* goes round with the magnet below, no longer above */
    FST_CHANGE_COUNT
} fst_change;

/* ------------------------------------------------------------------ verdicts */

typedef enum { FST_VERDICT_REPRODUCED, FST_VERDICT_CLOSE, FST_VERDICT_NOT } fst_verdict;

/* "reproduced", "close", "not reproduced" */
const char *fst_verdict_name(fst_verdict verdict);

/* ------------------------------------------------------------------ probes */

enum {
    FST_TABLE1_ROWS = 5,
    FST_MOST_FIGURES = 64,
    FST_HALVING_BELOW = 10, /* drives under the threshold, the nearest last */
    FST_HALVING_ABOVE = 6,  /* and over it, the nearest first */
    FST_HALVING_POINTS = FST_HALVING_BELOW + FST_HALVING_ABOVE,
    FST_HALVING_INSET = 5,   /* the drive whose r(t) the figure's inset shows, */
    FST_HALVING_SHOWN = 400, /* in so many values */
    FST_ANSATZ_DRIVES = 4,
    FST_ANSATZ_STARTS = 16,
    FST_REMANENCE_DRIVES = 2,
    FST_REMANENCE_STRENGTHS = 6,
    FST_BALANCE_CASES = 3
};

/* The drive at which a pattern of Table 1 closes exactly; NAN: nowhere on the stable branch. */
typedef struct fst_paper_pattern {
    double omega;
    fst_symmetry symmetry;
} fst_paper_pattern;

/* Read off the branch of periodic orbits (exact.c). */
typedef struct fst_paper_exact {
    fst_paper_pattern closed[FST_TABLE1_ROWS];
    double halving;    /* the pitchfork; NAN: none found */
    int criticality;   /* 1 supercritical, -1 subcritical */
    double fold;       /* where the counter-rotating orbit ends; NAN: beyond the range */
    double origin;     /* where it passes the axis, going down, and is a libration from there; NAN: nowhere */
    double locked_end; /* where the last locked state loses its stability, a Hopf point; NAN: not found */
    double most_s1;    /* greatest N of stable S1 orbits */
    double locked_minima; /* stable locked states at the drive 0.02 */
    double damping;       /* -Re/|lambda| of the least damped swing about a pole at kappa = 0.015 */
    char missing[768];    /* why there is none of this, else "" */
} fst_paper_exact;

typedef struct fst_paper_halving {
    fst_halving_point points[FST_HALVING_POINTS];
    double r[FST_HALVING_SHOWN]; /* r(t) at points[FST_HALVING_INSET] */
} fst_paper_halving;

/* Beads set on the Appendix's corotating motion. */
typedef struct fst_paper_ansatz {
    double speed, survived; /* fst_probe_ansatz() */
} fst_paper_ansatz;

/* ------------------------------------------------------------------ the whole */

/* How long a part of the work took. */
enum { FST_MOST_PARTS = 16 };
typedef struct fst_paper_part {
    const char *what;
    double seconds;
} fst_paper_part;

typedef struct fst_paper_state {
    int done[FST_STEP_COUNT]; /* which steps are */
    int complete;             /* all of them, and the figures */
    const fst_paper_options *options;
    const char *directory;
    atomic_int refused;    /* the caller wants no more of it; */
    fst_progress patience; /* long computations ask, from any thread, and end with FST_INTERRUPTED */
    int counts[FST_SCAN_COUNT];
    int films;                   /* that are made */
    int first_scan;              /* runs of the scans before this one are not made */
    int drawn[FST_MOST_FIGURES]; /* by the index of the figure */
    fst_paper_run *scans[FST_SCAN_COUNT][FST_PAPER_DYNAMICS];
    fst_paper_exact exact[FST_PAPER_DYNAMICS];
    fst_paper_bracket changes[FST_CHANGE_COUNT][FST_PAPER_DYNAMICS];
    fst_paper_halving halving[FST_PAPER_DYNAMICS];
    fst_paper_ansatz ansatz[FST_PAPER_DYNAMICS][FST_ANSATZ_DRIVES][FST_ANSATZ_STARTS];
    fst_search_entry *search[FST_PAPER_DYNAMICS]; /* the same starts with both dynamics */
    int search_count;
    fst_balances balances[FST_PAPER_DYNAMICS][FST_BALANCE_CASES]; /* for the identities, */
    fst_balances settled[FST_PAPER_DYNAMICS][FST_BALANCE_CASES];  /* and over longer windows, for the means */
    fst_least_found remanence[FST_PAPER_DYNAMICS][FST_REMANENCE_DRIVES][FST_REMANENCE_STRENGTHS];
    double seconds, processor_seconds;    /* the time that all took, on the clock and on all processors, */
    fst_paper_part parts[FST_MOST_PARTS]; /* and its parts in their order */
    int part_count;
} fst_paper_state;

/* A part of the work, done on all processors; its progress goes from `from` to `to`. */
typedef struct fst_paper_stage {
    const char *what; /* for the progress */
    double from, to;
    int count;
    fst_paper_step step; /* that is done with it */
    fst_status (*piece)(fst_paper_state *paper, int index, fst_error *error);
} fst_paper_stage;
fst_status fst_paper_do(fst_paper_state *paper, const fst_paper_stage *stage, fst_error *error);

/* Note that `what` took the time since `began` of fst_clock_seconds() (again: added). */
void fst_paper_note_time(fst_paper_state *paper, const char *what, double began);

/* Is the step done, and are the runs of `scan` and of the scans that are made before it? */
int fst_paper_has(const fst_paper_state *paper, fst_paper_step step, fst_scan scan);

/* Make a run; while its motion has not settled, again and twice as long with all of it discarded, up to eight
 * times as long.  `params` are then those of the last one.  The progress and the trajectory may be NULL. */
fst_status fst_paper_run_settled(fst_params *params, const fst_progress *progress, fst_run_result *result,
                                 fst_table *trajectory, fst_error *error);
/* Its regime is decided, and the errors of its means are small.  (Neither chaotic nor off the plate.) */
int fst_paper_is_settled(const fst_run_result *result);
/* It has not settled, and more time may settle it: chaos stays chaos, and what left the plate is gone. */
int fst_paper_may_settle(const fst_run_result *result);
/* Runs of a scan that did not settle in all this time. */
int fst_paper_unsettled(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics);

/* Fill paper->exact of the dynamics `index`; where LAPACK is missing, with the sentence that says so. */
fst_status fst_paper_find_exact(fst_paper_state *paper, int index, fst_error *error);
/* All undefined, as before the search. */
void fst_paper_exact_begin(fst_paper_exact *exact);

/* Room for everything, with all parameters set and nothing done; then all runs, which the rest only reads. */
fst_status fst_paper_begin(fst_paper_state *paper, fst_error *error);
fst_status fst_paper_make_runs(fst_paper_state *paper, fst_error *error);
/* What the periodic orbits tell; then the thresholds, by bisection (where the orbits do not give them). */
fst_status fst_paper_find_orbits(fst_paper_state *paper, fst_error *error);
fst_status fst_paper_find_thresholds(fst_paper_state *paper, fst_error *error);
void fst_paper_free_runs(fst_paper_state *paper);

/* Make the probes (stages.c), all or those of one step; the halving's needs the thresholds. */
fst_status fst_paper_make_probes(fst_paper_state *paper, const fst_paper_step *only, fst_error *error);
/* Drives and strengths of the probes. */
extern const double fst_ansatz_drives[FST_ANSATZ_DRIVES], fst_remanence_drives[FST_REMANENCE_DRIVES],
    fst_remanence_strengths[FST_REMANENCE_STRENGTHS];
extern const fst_kappa_scan fst_remanence_scan;
/* The drive of the period halving: the pitchfork of the orbits where it is known, else where |<n_z>|^2, a
 * straight line near the threshold, reaches zero (fst_paper_halving_line); NAN: no halving was found. */
double fst_paper_halving_drive(const fst_paper_state *paper, fst_dynamics dynamics);
double fst_paper_halving_line(const fst_paper_state *paper, fst_dynamics dynamics);

/* The one run of a scan that has only one. */
const fst_paper_run *fst_paper_single(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics);

/* The command that repeats the runs of a scan: "festoon run --set ...", with OMEGA standing for the
 * drive where there are several. */
void fst_paper_scan_command(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics, char *text,
                            size_t size);

/* That of one row of Table 1. */
void fst_paper_table1_command(const fst_paper_state *paper, int row, fst_dynamics dynamics, char *text,
                              size_t size);

/* Does the bead circle against the magnet, regularly? */
int fst_paper_counter_rotates(const fst_paper_run *run);

/* ------------------------------------------------------------------ Table 1 */

typedef struct fst_table1_row {
    double omega, published;
    int count;       /* festoons of the pattern that the paper means */
    int published_a; /* 1: S1, 2: S2 */
} fst_table1_row;
extern const fst_table1_row fst_table1[FST_TABLE1_ROWS];

/* |N - published|/published, and the verdict on N and on the symmetry together. */
double fst_table1_deviation(const fst_paper_state *paper, int row, fst_dynamics dynamics);
fst_verdict fst_table1_verdict(const fst_paper_state *paper, int row, fst_dynamics dynamics);
/* The criterion in words. */
#define FST_TABLE1_CRITERION                                                                                   \
    "reproduced: N within 1.2 % and the same symmetry; close: N within 5 % and the same symmetry"

/* Table 1 beside the two dynamics, and how many statements came out how, as text for a terminal; free() it. */
char *fst_paper_summary(const fst_paper_state *paper);

/* ------------------------------------------------------------------ statements */

/* How the paper prints what it says, which decides how a value is held against it (verdicts.c). */
typedef enum {
    FST_RULE_NUMBER,
    FST_RULE_AT_MOST,
    FST_RULE_MAGNITUDE,
    FST_RULE_SMALL,
    FST_RULE_NOTABLE,
    FST_RULE_MOSTLY,
    FST_RULE_EXACT,
    FST_RULE_NEVER,
    FST_RULE_SYMMETRY,
    FST_RULE_COUNT
} fst_rule;
/* The rules in words: a name, what is printed, when it is reproduced, when close ("": never). */
typedef struct fst_rule_words {
    const char *name, *kind, *reproduced, *close;
} fst_rule_words;
extern const fst_rule_words fst_rules[FST_RULE_COUNT];

/* A row of statements.def, which tells what the fields are. */
typedef struct fst_statement {
    const char *id, *section, *text, *said;
    double published; /* for FST_RULE_SYMMETRY 1 or 2 */
    double scale;
    const char *unit; /* "" for a pure number */
    int digits;
    fst_rule rule;
    /* The number, NAN where there is none; `note` is for what else the reader should know (may stay empty). */
    double (*measure)(const fst_paper_state *paper, fst_dynamics dynamics, char *note, size_t size);
    fst_scan scan;
    fst_paper_step step;
    const char *reads;
    int check; /* of the computation or beyond the paper: no claim of the paper's, so left out of the tally */
} fst_statement;

typedef struct fst_finding {
    double value[FST_PAPER_DYNAMICS];
    fst_verdict verdict[FST_PAPER_DYNAMICS];
    char note[FST_PAPER_DYNAMICS][320];
} fst_finding;

int fst_statement_count(void);
const fst_statement *fst_statement_at(int index);
/* The command that gives the statement's number again, and how the number is read off the JSON that it prints:
 * an expression in its keys. */
void fst_statement_command(const fst_statement *statement, const fst_paper_state *paper, fst_dynamics dynamics,
                           char *command, size_t size);
const char *fst_statement_reads(const fst_statement *statement, fst_dynamics dynamics);
/* Is all there that the statement rests on? */
int fst_statement_known(const fst_statement *statement, const fst_paper_state *paper);
/* The verdict that a value earns by the statement's rule. */
fst_verdict fst_statement_verdict(const fst_statement *statement, double value);
fst_finding fst_statement_check(const fst_statement *statement, const fst_paper_state *paper);
/* Add the verdicts on the paper's claims that are known to `tally`; how many claims those are. */
int fst_paper_tally(const fst_paper_state *paper, int tally[FST_PAPER_DYNAMICS][3]);
/* The criterion, and a value as people read it ("13.2 %", "S2", "none"). */
void fst_statement_criterion(const fst_statement *statement, char *text, size_t size);
void fst_statement_value(const fst_statement *statement, double value, char *text, size_t size);

/* ------------------------------------------------------------------ figures */

typedef struct fst_paper_figure {
    const char *name;   /* "f4" */
    const char *source; /* the paper's figure or section */
    const char *title, *caption;
    int each;               /* one figure for each dynamics */
    const char *statements; /* ids that decide the verdict, '|' between them; NULL: no verdict */
    fst_scan scan;          /* the runs that it shows */
    fst_status (*draw)(const fst_paper_state *paper, const struct fst_paper_figure *figure, const char *out,
                       fst_error *error);
    fst_figure_kind kind; /* of figures of a trajectory, and the next two also */
    fst_paper_step step;  /* after which it can be drawn */
    const char *colour;
    int zoomed;            /* the upper right corner only */
    int plain;             /* without arrows */
    int inset;             /* with the path of the moment */
    fst_dynamics dynamics; /* which one of `each` */
    char file[48];         /* "f4-rigid" */
} fst_paper_figure;

/* The figures, those of `each` dynamics counted one by one. */
int fst_paper_figure_count(void);
fst_paper_figure fst_paper_figure_at(int index);
/* The worst verdict on the figure's statements; 0 where the figure has none. */
int fst_paper_figure_verdict(const fst_paper_state *paper, const fst_paper_figure *figure,
                             fst_dynamics dynamics, fst_verdict *verdict);
/* The command lines that draw it again. */
void fst_paper_figure_command(const fst_paper_state *paper, const fst_paper_figure *figure, char *text,
                              size_t size);
/* Draw every figure that can be drawn and was not; the progress goes from `from` to `to`. */
fst_status fst_paper_draw_figures(fst_paper_state *paper, double from, double to, fst_error *error);
/* Figures of curves over the drive (charts.c); see fst_paper_figure.draw. */
fst_status fst_paper_draw_radius(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                 fst_error *error);
fst_status fst_paper_draw_comparison(const fst_paper_state *paper, const fst_paper_figure *figure,
                                     const char *out, fst_error *error);
fst_status fst_paper_draw_dotal(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                fst_error *error);
fst_status fst_paper_draw_test(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                               fst_error *error);
fst_status fst_paper_draw_evolution(const fst_paper_state *paper, const fst_paper_figure *figure,
                                    const char *out, fst_error *error);

/* Figures of the probes, the sketch and the camera's (probe_charts.c). */
fst_status fst_paper_draw_supercritical(const fst_paper_state *paper, const fst_paper_figure *figure,
                                        const char *out, fst_error *error);
fst_status fst_paper_draw_remanence(const fst_paper_state *paper, const fst_paper_figure *figure,
                                    const char *out, fst_error *error);
fst_status fst_paper_draw_sketch(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                 fst_error *error);
fst_status fst_paper_draw_camera(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                 fst_error *error);

/* The supplement's two films, beside the figures; paper->films counts those that are made, in this order. */
enum { FST_FILM_COUNT = 2 };
extern const char *const fst_film_names[FST_FILM_COUNT];
fst_status fst_paper_make_films(fst_paper_state *paper, fst_error *error);

/* ------------------------------------------------------------------ what is written */

/* Arithmetic, compiler and machine in words. */
void fst_paper_machine(char *text, size_t size);

/* DIRECTORY/NAME; free() it, NULL: no memory. */
char *fst_paper_path(const fst_paper_state *paper, const char *name, const char *ending);

fst_status fst_paper_write_json(const fst_paper_state *paper, fst_error *error);
/* One statement as it stands in paper.json; free() it, NULL: no memory. */
char *fst_paper_statement_json(const fst_paper_state *paper, const fst_statement *statement);
fst_status fst_paper_write_report(const fst_paper_state *paper, fst_error *error);

#endif
