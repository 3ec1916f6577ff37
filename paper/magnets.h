/* magnets.h - the paper's experiment with real magnets of the outline of its bar in the place of the five lines
 * that model it. */
#ifndef FST_PAPER_MAGNETS_H
#define FST_PAPER_MAGNETS_H

#include "paper/dry.h"

enum {
    FST_MAGNETS = 4,     /* the five lines, then the real ones */
    FST_MAGNET_LAWS = 2, /* viscous with the paper's rate, and dry with FST_DRY_MU; both `rigid` */
    FST_MAGNET_ROLLING = 15,
    FST_MAGNET_RESTING = 9,
    FST_MAGNET_RUNS = FST_MAGNET_ROLLING + FST_MAGNET_RESTING
};

/* A magnet and the field that it has over the plate. */
typedef struct fst_shown_magnet {
    const char *id, *name, *about;
    int part_count;           /* 0: the five lines */
    fst_magnet_part parts[2]; /* with a remanence of 1 T in their direction */
} fst_shown_magnet;
extern const fst_shown_magnet fst_shown_magnets[FST_MAGNETS];

/* Of the bead that is set on them, T, and the strength kappa that the paper fitted to the five lines. */
#define FST_MAGNET_BEAD 1.2
#define FST_MAGNET_KAPPA 1.5

typedef struct fst_magnet_column {
    double remanence;          /* T: the one that gives the greatest |B| of the five lines; NAN for these */
    double apart, apart_plate; /* between the maxima of |B|, mm: at the bead's centre, on the plate */
    fst_paper_run runs[FST_MAGNET_LAWS][FST_MAGNET_RUNS];
} fst_magnet_column;

typedef struct fst_paper_magnets {
    double greatest; /* |B| of the five lines at the bead's centre, T */
    fst_magnet_column of[FST_MAGNETS];
} fst_paper_magnets;

/* The drive of a run, Hz: the runs from the rolling start first. */
double fst_magnet_drive(int run);

fst_status fst_paper_magnets_begin(fst_paper_state *paper, fst_error *error);
void fst_paper_magnets_free(fst_paper_state *paper);
fst_status fst_paper_make_magnets(fst_paper_state *paper, fst_error *error);
/* Whether everything of this chapter is there. */
int fst_paper_has_magnets(const fst_paper_state *paper);

/* The parameters of a run with the magnet: `start` is 0 for the rolling start, 1 for the one at rest. */
fst_status fst_magnet_params(const fst_paper_state *paper, int magnet, int law, double hertz, int start,
                             fst_params *params, fst_error *error);

/* ------------------------------------------------------------------ facts: magnets_facts.c */

/* What the paper tells of field and experiment, judged by the rules of the statements. */
enum {
    FST_MAGNET_STILL_FACTS = 2, /* of the field alone, into which no motion enters */
    FST_MAGNET_FIELD_FACTS = 4, /* these and two more that are not in the chapter on dry friction */
    FST_MAGNET_FACTS = FST_MAGNET_FIELD_FACTS + 6
};
const fst_statement *fst_magnet_fact_about(int fact);
/* The fact with that magnet under that law, NAN where no run shows it. */
double fst_magnet_fact(const fst_paper_state *paper, int fact, int magnet, int law);
const char *fst_magnet_law_name(int law);

/* ------------------------------------------------------------------ what is written: magnets_report.c */

void fst_report_magnets(FILE *out, const fst_paper_state *paper);

#endif
