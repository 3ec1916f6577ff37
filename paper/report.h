/* report.h - what is written: paper.json, report.html, and the summary for a terminal. */
#ifndef FST_PAPER_REPORT_H
#define FST_PAPER_REPORT_H

#include "paper/state.h"
#include "paper/statements.h"

fst_status fst_paper_write_json(const fst_paper_state *paper, fst_error *error);
/* One statement as it stands in paper.json; free() it, NULL: no memory. */
char *fst_paper_statement_json(const fst_paper_state *paper, const fst_statement *statement);

fst_status fst_paper_write_report(const fst_paper_state *paper, fst_error *error);

/* Table 1 beside the two dynamics, and how many statements got which verdict; free() it, NULL: no memory. */
char *fst_paper_summary(const fst_paper_state *paper);

#endif
