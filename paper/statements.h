/* statements.h - what the paper says, and whether the runs say the same.
 *
 * A statement is a row of statements.def: the paper's words and number, the function that measures the same
 * number on the runs, and the rule by which the two are compared.  A rule gives a verdict.
 */
#ifndef FST_PAPER_STATEMENTS_H
#define FST_PAPER_STATEMENTS_H

#include "paper/state.h"

typedef enum { FST_VERDICT_REPRODUCED, FST_VERDICT_CLOSE, FST_VERDICT_NOT } fst_verdict;

/* "reproduced", "close", "not reproduced" */
const char *fst_verdict_name(fst_verdict verdict);

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

/* ------------------------------------------------------------------ rules */

/* How the paper prints a number, which decides how a value is compared with it: a row of rules.def each. */
typedef enum {
#define RULE(name, ...) FST_RULE_##name,
#include "paper/rules.def"
#undef RULE
    FST_RULE_COUNT
} fst_rule;
/* How a value is held against the published one. */
typedef enum {
    FST_HELD_EQUAL,    /* it is the same */
    FST_HELD_WITHIN,   /* it is off by no more than the room */
    FST_HELD_UP_TO,    /* it exceeds the published one by no more than the room */
    FST_HELD_AT_LEAST, /* it is no less than the room, whatever was published */
    FST_HELD_ORDERS    /* their decimal logarithms are no further apart than the room */
} fst_held;
/* A row of rules.def, which explains the fields. */
typedef struct fst_rule_words {
    const char *name, *kind, *reproduced, *close;
    fst_held held;
    double room[2];
    int has_borders;
} fst_rule_words;
extern const fst_rule_words fst_rules[FST_RULE_COUNT];

/* ------------------------------------------------------------------ statements */

/* The parts of the report, in their order. */
typedef enum {
    FST_GROUP_ERROR,      /* what the equations contradict */
    FST_GROUP_EXPERIMENT, /* what was seen, held against the model */
    FST_GROUP_READING,    /* claims with two readings */
    FST_GROUP_ARITHMETIC, /* numbers that follow from given ones */
    FST_GROUP_MODEL,      /* what the model does and what the paper concludes from it */
    FST_GROUP_COUNT
} fst_group;
/* A word for programs, a title, and a sentence. */
typedef struct fst_group_words {
    const char *name, *title, *about;
} fst_group_words;
extern const fst_group_words fst_groups_of_statements[FST_GROUP_COUNT];

/* On what a number is measured, and room for a note: what else the reader should know; it may stay empty. */
typedef struct fst_measuring {
    const fst_paper_state *paper;
    fst_dynamics dynamics;
    char *note;
    size_t size;
} fst_measuring;
/* The measured number, NAN where there is none. */
typedef double (*fst_measure)(const fst_measuring *m);

/* A CLAIM of statements.def, which explains the fields. */
typedef struct fst_statement {
    const char *id;
    fst_group group;
    fst_rule rule;
    fst_measure measure;
    fst_scan scan;
    fst_paper_step step;
    double published; /* for FST_RULE_SYMMETRY 1 or 2 */
    double scale;
    const char *unit; /* "" for a pure number */
    int digits;
    int check; /* a check of the computation, or something beyond the paper: it does not count in the tally */
    int still; /* no motion enters: both dynamics have one number, which counts once */
    int rubs;  /* it has a third column: a bead that rubs dry is asked as well */
    const char *section, *said, *text, *reads;
} fst_statement;

typedef struct fst_finding {
    double value[FST_PAPER_DYNAMICS];
    fst_verdict verdict[FST_PAPER_DYNAMICS];
    char note[FST_PAPER_DYNAMICS][320];
    int undecided[FST_PAPER_DYNAMICS]; /* there is no value since runs had not settled */
    int dry; /* whether the statement has a third column, and that is computed; if so: */
    double dry_value;
    int dry_undecided;
    fst_verdict dry_verdict;
    char dry_note[320];
} fst_finding;

int fst_statement_count(void);
const fst_statement *fst_statement_at(int index);
/* The command that computes the statement's number again, and how to read the number off the JSON that it
 * prints: an expression in its keys. */
void fst_statement_command(const fst_statement *statement, const fst_paper_state *paper, fst_dynamics dynamics,
                           char *command, size_t size);
const char *fst_statement_reads(const fst_statement *statement, fst_dynamics dynamics);
/* The statement with this id; NULL: there is none. */
const fst_statement *fst_statement_named(const char *id);
/* The command and what is read, of the third column. */
void fst_statement_dry_command(const fst_statement *statement, const fst_paper_state *paper, char *command,
                               size_t size);
const char *fst_statement_dry_reads(const fst_statement *statement);
/* Whether everything that the statement rests on was computed. */
int fst_statement_known(const fst_statement *statement, const fst_paper_state *paper);
/* The verdict on a value by the statement's rule. */
fst_verdict fst_statement_verdict(const fst_statement *statement, double value);
fst_finding fst_statement_check(const fst_statement *statement, const fst_paper_state *paper);
/* The second reading of a statement, a READING of statements.def; NULL: it has one reading. */
typedef struct fst_reading {
    fst_statement second; /* with the claim's runs */
    const char *id, *first, *words, *chosen;
} fst_reading;
const fst_reading *fst_statement_reading(const fst_statement *statement);
fst_finding fst_reading_check(const fst_reading *reading, const fst_statement *statement,
                              const fst_paper_state *paper);
/* Add the known verdicts of the third column to `tally`; returns how many claims these are. */
int fst_paper_dry_tally(const fst_paper_state *paper, int tally[3]);
/* How many claims of the paper got which verdict: by each dynamics, and, of claims into which no motion enters,
 * by both at once. */
typedef struct fst_tally {
    int moving, still; /* how many claims these are */
    int of[FST_PAPER_DYNAMICS][3], once[3];
    int undecided; /* verdicts, of the third kind, on values that are undecided */
} fst_tally;
/* Of the claims of one group, or of all: FST_GROUP_COUNT. */
fst_tally fst_paper_tally(const fst_paper_state *paper, fst_group group);
void fst_tally_add(fst_tally *all, const fst_tally *more);
/* How far a value is from the nearest border of its verdict, as a share of the distance that the border allows;
 * NAN: the rule has no distances.  `border` receives that border. */
double fst_statement_margin(const fst_statement *statement, double value, double *border);
/* A verdict with less margin than this hangs by a hair. */
#define FST_HAIR 0.1
/* The criterion, what is printed in the paper, and a value as people read it ("13.2 %", "S2", "none"). */
void fst_statement_criterion(const fst_statement *statement, char *text, size_t size);
void fst_statement_published(const fst_statement *statement, char *text, size_t size);
void fst_statement_value(const fst_statement *statement, double value, char *text, size_t size);

#endif
