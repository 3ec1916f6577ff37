/* report_parts.h - pieces of HTML for the report. */
#ifndef FST_PAPER_REPORT_PARTS_H
#define FST_PAPER_REPORT_PARTS_H

#include "paper/statements.h"

#include <stdio.h>

/* Everything up to <main>, style included, and the opening paragraphs. */
extern const char fst_report_head[], fst_report_introduction[];
/* How to read the page. */
extern const char fst_report_reading[];
/* The first chapter: what was found. */
void fst_report_findings(FILE *out, const fst_paper_state *paper);
/* The rules, then the claims in their groups, with their figures. */
fst_status fst_report_statements(FILE *out, const fst_paper_state *paper, fst_error *error);
/* The figures whose claim is `own`; the second function writes the chapter of the figures without a claim. */
fst_status fst_report_figures(FILE *out, const fst_paper_state *paper, const char *own, fst_error *error);
fst_status fst_report_other_figures(FILE *out, const fst_paper_state *paper, fst_error *error);

/* Text with <, >, & and " made safe. */
void fst_report_text(FILE *out, const char *text);

/* The same, with the subscript of "e_r" and "V_α" set low. */
void fst_report_prose(FILE *out, const char *text);

/* A command, as a line of code. */
void fst_report_code(FILE *out, const char *command);

/* The coloured word of a verdict. */
void fst_report_badge(FILE *out, fst_verdict verdict);

/* An SVG file as an image inside the page. FST_IO: it cannot be read. */
fst_status fst_report_image(FILE *out, const char *path, const char *alternative, fst_error *error);

#endif
