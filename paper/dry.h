/* dry.h - the same bead with dry friction: what the paper's experiment does where nothing is fitted but the
 * coefficient of friction. */
#ifndef FST_PAPER_DRY_H
#define FST_PAPER_DRY_H

#include "paper/statements.h"

/* The coefficient of friction that agrees best with the paper's words (the page on dry friction in docs tells
 * how it was found): the third column of the statements has it. */
#define FST_DRY_MU 0.2

enum {
    FST_DRY_MUS = 4,
    FST_DRY_DRIVES = 20,
    FST_DRY_SLOW = 11, /* of these drives, the ones that are tried from both starts */
    FST_DRY_STARTS = 2,
    FST_DRY_LAWS = FST_PAPER_DYNAMICS + FST_DRY_MUS
};
/* The coefficients and drives (Hz) of the small map; its starts are the paper's (start.spin: rolling), and at
 * rest above a pole. */
extern const double fst_dry_mus[FST_DRY_MUS], fst_dry_drives[FST_DRY_DRIVES];

typedef struct fst_paper_dry {
    fst_paper_state column; /* the paper's scans with FST_DRY_MU; only `rigid` */
    fst_paper_run map[FST_DRY_MUS][FST_DRY_DRIVES][FST_DRY_STARTS];
} fst_paper_dry;

/* What becomes of a bead.  This is told of undecided runs too: it rests on where the bead is and which way it
 * circles in the mean, not on whether the motion repeats. */
typedef enum {
    FST_OUTCOME_AGAINST, /* it circles against the magnet */
    FST_OUTCOME_WITH,    /* it goes round with the magnet: locked, swinging about it, or rolling along */
    FST_OUTCOME_EJECTED,
    FST_OUTCOME_LIFTED,
    FST_OUTCOME_OTHER, /* none of these, or not clear */
    FST_OUTCOME_COUNT
} fst_dry_outcome;
extern const char *const fst_outcome_names[FST_OUTCOME_COUNT];
fst_dry_outcome fst_outcome(const fst_run_result *result);

fst_status fst_paper_dry_begin(fst_paper_state *paper, fst_error *error);
void fst_paper_dry_free(fst_paper_state *paper);
/* The scans from paper->first_scan on and, unless `only_scans`, the map. */
fst_status fst_paper_make_dry(fst_paper_state *paper, int only_scans, fst_error *error);

/* ------------------------------------------------------------------ facts */

/* What the paper's text says of the experiment, in the order of the table, judged by the same rules as its
 * statements (`measure`, `scan` and `step` are unused). */
typedef enum {
    FST_FACT_COROTATION,
    FST_FACT_EJECTION,
    FST_FACT_ONSET,
    FST_FACT_FOUR,
    FST_FACT_MANY,
    FST_FACT_BELL,
    FST_FACT_RATE,
    FST_FACT_COUNT
} fst_dry_fact_id;
extern const fst_statement fst_dry_facts[FST_FACT_COUNT];

/* A law of the table: the two dynamics with viscous friction, then dry friction with each of fst_dry_mus. */
void fst_dry_law_name(int law, char *text, size_t size);
/* The fact under that law, NAN where its runs do not tell. */
double fst_dry_fact(const fst_paper_state *paper, int fact, int law);
/* The same of any runs, from the rolling start and from rest, at whatever drives. */
double fst_dry_fact_of(const fst_paper_run *runs, int count, int fact);

/* ------------------------------------------------------------------ what is written: dry_report.c */

void fst_report_dry(FILE *out, const fst_paper_state *paper);

#endif
