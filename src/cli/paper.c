/* paper.c - festoon paper: the published results beside those of this program; paper/ does it. */
#include "cli/command.h"

static const option options[] = {
    {"output", 'o', "DIR", "the directory for paper.json, the figures and report.html; made if missing"},
    {"reduced", '\0', NULL, "fewer points and shorter runs, for a quick look"},
    {"films", '\0', NULL, "make the supplement's two films as well (takes a minute more)"},
    {"statements", '\0', NULL,
     "compute nothing: print the paper's statements and what decides each verdict (Markdown)"},
    {"only", '\0', "ID", "compute one statement alone and print it as JSON; paper.json has the names"},
    {"dry-maps", EXPERT, NULL,
     "compute only the large maps with dry friction, into DIR (many minutes; the same command goes on)"},
    {"starts", EXPERT, "N", "starts of the search for a paramagnetic bead that counter-rotates (240)"},
    {NULL, '\0', NULL, NULL},
};

const command paper_command = {
    .name = "paper",
    .synopsis = "-o DIR [--reduced] [--films] | --only ID | --statements",
    .summary = "Compute what the paper shows, and report it beside the published numbers",
    .details = "",
    .options = options,
    .has_helpers = 1,
    .program = "festoon-paper",
};
