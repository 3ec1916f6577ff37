/* magnets_json.h - the object "magnets" of paper.json. */
#ifndef FST_PAPER_MAGNETS_JSON_H
#define FST_PAPER_MAGNETS_JSON_H

#include "paper/state.h"

#include <jansson.h>

json_t *fst_paper_magnets_json(const fst_paper_state *paper);

#endif
