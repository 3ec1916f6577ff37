/* dry_json.h - what dry friction says, for programs: the object "dry" of paper.json. */
#ifndef FST_PAPER_DRY_JSON_H
#define FST_PAPER_DRY_JSON_H

#include "paper/state.h"

#include <jansson.h>

/* null where nothing of it was computed */
json_t *fst_paper_dry_json(const fst_paper_state *paper);
/* A run of either chapter: drive, start, outcome, means. */
json_t *fst_paper_dry_run_json(const fst_paper_run *run);

#endif
