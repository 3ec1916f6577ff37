/* paper.h - the paper and its repetition, as the files of fst_paper() share them.
 *
 * What is repeated stands in four tables: the runs (paper_runs.c), the rows of Table 1 (paper_table.c), the
 * statements (paper_statements.c) and the figures (paper_figures.c).  A new comparison is a new row.
 */
#ifndef FST_APP_PAPER_H
#define FST_APP_PAPER_H

#include "app/paramagnet.h"
#include "app/paper_probes.h"

#include <festoon/festoon_tools.h>

/* ------------------------------------------------------------------ runs */

enum { FST_PAPER_DYNAMICS = 2 }; /* rigid and farago2020; indices are those of fst_dynamics */

/* What the runs of one group have in common. */
typedef enum {
    FST_SCAN_COMPARISON, /* the range of the paper's Fig. comparison, from the rolling start */
    FST_SCAN_FAST,       /* beyond the experiments, for the free-rolling formulas */
    FST_SCAN_SLOW,       /* from rest, through the loss of corotation */
    FST_SCAN_TABLE,      /* the rows of Table 1 */
    FST_SCAN_FOLD4,      /* omega = 0.215, with its trajectory */
    FST_SCAN_FOLD15,     /* omega = 0.4, with its trajectory */
    FST_SCAN_CONJUGATE,  /* omega = 0.215 from the start with all poles exchanged */
    FST_SCAN_ASYMPTOTIC, /* far beyond all experiments */
    FST_SCAN_COUNT
} fst_scan;

typedef struct fst_paper_run {
    fst_params params;
    fst_run_result result;
    fst_table trajectory; /* of the scans that keep it, else empty */
} fst_paper_run;

/* A drive at which the motion changes its kind, by bisection: between `low` and `high`. */
typedef struct fst_paper_bracket {
    double low, high;
} fst_paper_bracket;

typedef enum {
    FST_CHANGE_HALVING,    /* S1 below, S2 above */
    FST_CHANGE_COROTATION, /* goes round with the magnet below, no longer above */
    FST_CHANGE_COUNT
} fst_change;

/* ------------------------------------------------------------------ verdicts */

typedef enum { FST_VERDICT_REPRODUCED, FST_VERDICT_CLOSE, FST_VERDICT_NOT } fst_verdict;

/* "reproduced", "close", "not reproduced" */
const char *fst_verdict_name(fst_verdict verdict);

/* ------------------------------------------------------------------ probes */

enum {
    FST_HALVING_BELOW = 8, /* drives under the threshold, the nearest last */
    FST_HALVING_ABOVE = 6, /* and over it, the nearest first */
    FST_HALVING_POINTS = FST_HALVING_BELOW + FST_HALVING_ABOVE,
    FST_HALVING_SHOWN = 400, /* values of r(t) in the figure's inset */
    FST_ANSATZ_DRIVES = 4,
    FST_ANSATZ_STARTS = 16,
    FST_REMANENCE_DRIVES = 2,
    FST_REMANENCE_STRENGTHS = 6,
    FST_BALANCE_CASES = 3
};

typedef struct fst_paper_halving {
    fst_halving_point points[FST_HALVING_POINTS];
    double r[FST_HALVING_SHOWN]; /* r(t) at points[0], where p is large */
} fst_paper_halving;

/* Beads set on the Appendix's corotating motion. */
typedef struct fst_paper_ansatz {
    double speed, survived; /* fst_probe_ansatz() */
} fst_paper_ansatz;

/* ------------------------------------------------------------------ the whole */

typedef struct fst_paper_state {
    const fst_paper_options *options;
    const char *directory;
    int counts[FST_SCAN_COUNT];
    fst_paper_run *scans[FST_SCAN_COUNT][FST_PAPER_DYNAMICS];
    fst_paper_bracket changes[FST_CHANGE_COUNT][FST_PAPER_DYNAMICS];
    fst_paper_halving halving[FST_PAPER_DYNAMICS];
    fst_paper_ansatz ansatz[FST_PAPER_DYNAMICS][FST_ANSATZ_DRIVES][FST_ANSATZ_STARTS];
    fst_search_entry *search; /* the same for both dynamics: a paramagnetic bead has no magnetic axis to turn */
    int search_count;
    fst_balance balances[FST_BALANCE_CASES][FST_BALANCE_COUNT];
    double remanence[FST_REMANENCE_DRIVES][FST_REMANENCE_STRENGTHS]; /* least kappa, dynamics rigid */
    double seconds;                                                  /* the time that all took */
} fst_paper_state;

/* A part of the work, done on all processors; its progress goes from `from` to `to`. */
typedef struct fst_paper_stage {
    const char *what; /* for the progress */
    double from, to;
    int count;
    fst_status (*piece)(fst_paper_state *paper, int index, fst_error *error);
} fst_paper_stage;
fst_status fst_paper_do(fst_paper_state *paper, const fst_paper_stage *stage, fst_error *error);

/* Make all runs; the rest of the paper only reads them. */
fst_status fst_paper_make_runs(fst_paper_state *paper, fst_error *error);
void fst_paper_free_runs(fst_paper_state *paper);

/* Make the probes, for which the runs must be there (paper_stages.c). */
fst_status fst_paper_make_probes(fst_paper_state *paper, fst_error *error);
/* Drives and strengths of the probes. */
extern const double fst_ansatz_drives[FST_ANSATZ_DRIVES], fst_remanence_drives[FST_REMANENCE_DRIVES],
    fst_remanence_strengths[FST_REMANENCE_STRENGTHS];
/* The drive at which |<n_z>|^2, a straight line near the threshold, reaches zero; NAN: no halving was found. */
double fst_paper_halving_drive(const fst_paper_state *paper, fst_dynamics dynamics);

/* The one run of a scan that has only one. */
const fst_paper_run *fst_paper_single(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics);

/* The command that repeats the runs of a scan: "festoon run --set ...", with OMEGA standing for the
 * drive where there are several. */
void fst_paper_scan_command(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics, char *text,
                            size_t size);

/* Does the bead circle against the magnet, regularly? */
int fst_paper_counter_rotates(const fst_paper_run *run);

/* ------------------------------------------------------------------ Table 1 */

enum { FST_TABLE1_ROWS = 5 };

typedef struct fst_table1_row {
    double omega, published;
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

/* How a number is held against what was published. */
typedef enum { FST_TEST_WITHIN, FST_TEST_AT_MOST, FST_TEST_AT_LEAST, FST_TEST_SYMMETRY } fst_test;

typedef struct fst_statement {
    const char *id;
    const char *section; /* of the paper */
    const char *text;    /* what the paper says, in our words */
    const char *said;    /* the published value in words; NULL: the number says it */
    double published;    /* for FST_TEST_SYMMETRY 1 or 2 */
    const char *unit;    /* "" for a pure number */
    int digits;          /* after the point */
    fst_test test;
    double reproduced, close; /* bounds: of the distance for FST_TEST_WITHIN, else of the value */
    /* The number, NAN where there is none; `note` is for what else the reader should know (may stay empty). */
    double (*measure)(const fst_paper_state *paper, fst_dynamics dynamics, char *note, size_t size);
    fst_scan scan;       /* the runs that it comes from */
    const char *command; /* instead of the scan's command; NULL: that one */
} fst_statement;

typedef struct fst_finding {
    double value[FST_PAPER_DYNAMICS];
    fst_verdict verdict[FST_PAPER_DYNAMICS];
    char note[FST_PAPER_DYNAMICS][320];
} fst_finding;

int fst_statement_count(void);
const fst_statement *fst_statement_at(int index);
fst_finding fst_statement_check(const fst_statement *statement, const fst_paper_state *paper);
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
    const char *colour;
    int zoomed;            /* the upper right corner only */
    int plain;             /* without arrows */
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
fst_status fst_paper_draw_figures(fst_paper_state *paper, fst_error *error);
/* Figures of curves over the drive (paper_charts.c); see fst_paper_figure.draw. */
fst_status fst_paper_draw_comparison(const fst_paper_state *paper, const fst_paper_figure *figure,
                                     const char *out, fst_error *error);
fst_status fst_paper_draw_dotal(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                fst_error *error);
fst_status fst_paper_draw_test(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                               fst_error *error);
fst_status fst_paper_draw_evolution(const fst_paper_state *paper, const fst_paper_figure *figure,
                                    const char *out, fst_error *error);

/* Figures of the experiment and of the probes (paper_probe_charts.c). */
fst_status fst_paper_draw_radius(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                 fst_error *error);
fst_status fst_paper_draw_supercritical(const fst_paper_state *paper, const fst_paper_figure *figure,
                                        const char *out, fst_error *error);
fst_status fst_paper_draw_remanence(const fst_paper_state *paper, const fst_paper_figure *figure,
                                    const char *out, fst_error *error);
fst_status fst_paper_draw_sketch(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                 fst_error *error);
fst_status fst_paper_draw_camera(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                 fst_error *error);

/* The supplement's two films, beside the figures. */
fst_status fst_paper_make_films(fst_paper_state *paper, fst_error *error);

/* ------------------------------------------------------------------ what is written */

/* DIRECTORY/NAME; free() it, NULL: no memory. */
char *fst_paper_path(const fst_paper_state *paper, const char *name, const char *ending);

fst_status fst_paper_write_json(const fst_paper_state *paper, fst_error *error);
fst_status fst_paper_write_report(const fst_paper_state *paper, fst_error *error);

#endif
