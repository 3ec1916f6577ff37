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

/* How the paper prints a number, which decides how a value is compared with it (verdicts.c). */
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
/* The rules in words: a name, what the paper prints, when a value reproduces it, when it is close
 * ("": never). */
typedef struct fst_rule_words {
    const char *name, *kind, *reproduced, *close;
} fst_rule_words;
extern const fst_rule_words fst_rules[FST_RULE_COUNT];

/* ------------------------------------------------------------------ statements */

/* A row of statements.def, which explains the fields. */
typedef struct fst_statement {
    const char *id, *section, *text, *said;
    double published; /* for FST_RULE_SYMMETRY 1 or 2 */
    double scale;
    const char *unit; /* "" for a pure number */
    int digits;
    fst_rule rule;
    /* The measured number, NAN where there is none.  `note` is for what else the reader should know; it may
     * stay empty. */
    double (*measure)(const fst_paper_state *paper, fst_dynamics dynamics, char *note, size_t size);
    fst_scan scan;
    fst_paper_step step;
    const char *reads;
    int check; /* a check of the computation, or something beyond the paper: it does not count in the tally */
} fst_statement;

typedef struct fst_finding {
    double value[FST_PAPER_DYNAMICS];
    fst_verdict verdict[FST_PAPER_DYNAMICS];
    char note[FST_PAPER_DYNAMICS][320];
    int dry; /* whether the statement has a third column, and that is computed; if so: */
    double dry_value;
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
/* The function that measures the statement on a bead that rubs dry (dry_statements.def); NULL: it has no third
 * column. */
typedef double (*fst_measure)(const fst_paper_state *paper, fst_dynamics dynamics, char *note, size_t size);
fst_measure fst_statement_dry(const fst_statement *statement);
/* The command and what is read, of the third column. */
void fst_statement_dry_command(const fst_statement *statement, const fst_paper_state *paper, char *command,
                               size_t size);
const char *fst_statement_dry_reads(const fst_statement *statement);
/* Whether everything that the statement rests on was computed. */
int fst_statement_known(const fst_statement *statement, const fst_paper_state *paper);
/* The verdict on a value by the statement's rule. */
fst_verdict fst_statement_verdict(const fst_statement *statement, double value);
fst_finding fst_statement_check(const fst_statement *statement, const fst_paper_state *paper);
/* Add the known verdicts of the third column to `tally`; returns how many claims these are. */
int fst_paper_dry_tally(const fst_paper_state *paper, int tally[3]);
/* Add the known verdicts on the paper's claims to `tally`; returns how many claims these are. */
int fst_paper_tally(const fst_paper_state *paper, int tally[FST_PAPER_DYNAMICS][3]);
/* The criterion, and a value as people read it ("13.2 %", "S2", "none"). */
void fst_statement_criterion(const fst_statement *statement, char *text, size_t size);
void fst_statement_value(const fst_statement *statement, double value, char *text, size_t size);

#endif
