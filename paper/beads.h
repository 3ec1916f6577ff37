/* beads.h - several beads, which the paper's last paragraph asks about: what docs/beads.md tells, as far as it is quickly
 * computed. */
#ifndef FST_PAPER_BEADS_H
#define FST_PAPER_BEADS_H

#include "paper/state.h"

#include <festoon/beads.h>

#include <stdio.h>

/* What is asked of beads. */
typedef enum {
    FST_ASK_BORDER,   /* do two come together that start `given` degrees apart? */
    FST_ASK_OPPOSITE, /* the slowest multiplier of opposition, of half a turn */
    FST_ASK_WALKER,   /* what a pair does whose impacts have the restitution `given` */
    FST_ASK_BREAKING, /* the drive at which a bar of `given` beads breaks, Hz */
    FST_ASK_COUNT
} fst_beads_question;
extern const char *const fst_beads_question_names[FST_ASK_COUNT];

typedef struct fst_beads_case {
    fst_beads_question question;
    double hertz, given;
    int reduced; /* a reduced paper has it too */
} fst_beads_case;
enum { FST_BEADS_CASES = 23 };
extern const fst_beads_case fst_beads_cases[FST_BEADS_CASES];

typedef struct fst_beads_answer {
    int done;
    fst_beads_outcome outcome; /* of runs */
    double
        value; /* the multiplier, the rate of a walker's centre over the drive's, the breaking drive; NAN: none */
    double r; /* of a walker's centre */
} fst_beads_answer;

typedef struct fst_paper_beads {
    fst_beads_answer answers[FST_BEADS_CASES];
} fst_paper_beads;

fst_status fst_paper_make_beads(fst_paper_state *paper, fst_error *error);
/* The keys of a case, as fst_paper_set() takes them. */
void fst_beads_settings(const fst_beads_case *of, char *text, size_t size);
/* The drives at which opposition gains or loses stability, between the cases beside them; returns how many. */
int fst_beads_changes(const fst_paper_beads *beads, double drives[FST_BEADS_CASES]);

/* ------------------------------------------------------------------ what is written: beads_report.c */

void fst_report_beads(FILE *out, const fst_paper_state *paper);

#endif
