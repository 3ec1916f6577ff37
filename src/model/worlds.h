/* worlds.h - which surroundings a setup asks for. */
#ifndef FST_MODEL_WORLDS_H
#define FST_MODEL_WORLDS_H

#include <festoon/festoon.h>

/* Whether the parameters say anything that stands still in the laboratory or travels, and what: its key; NULL: all
 * turns with the magnet, or looks the same from everywhere around the axis. */
const char *fst_stands_still(const fst_params *params);

/* FST_BAD_INPUT: the bead needs three dimensions (fst_key_of_world()). */
fst_status fst_check_no_world(const fst_params *params, fst_error *error);

#endif
