/* dry_json.h - what dry friction says, for programs: the object "dry" of paper.json. */
#ifndef FST_PAPER_DRY_JSON_H
#define FST_PAPER_DRY_JSON_H

#include "paper/state.h"

#include <jansson.h>

/* null where nothing of it was computed */
json_t *fst_paper_dry_json(const fst_paper_state *paper);

#endif
