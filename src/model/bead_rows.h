/* bead_rows.h - the keys of the beads of a list. */
#ifndef FST_MODEL_BEAD_ROWS_H
#define FST_MODEL_BEAD_ROWS_H

#include <festoon/festoon.h>

/* The choice of a bead that says none. */
enum { FST_BEAD_NO_CHOICE = -1 };

/* The keys of one bead: those of bead.* and start.*. */
#define FST_KEYS_OF_A_BEAD
#define FST_REAL(...) +1
#define FST_CHOICE(...) +1
#define FST_REALS3(...) +3
enum {
    FST_BEAD_FIELDS = 0
#include <festoon/params.def>
    ,
    FST_BEAD_ROWS = FST_BEAD_FIELDS * FST_BEADS_MOST
};
#undef FST_REAL
#undef FST_CHOICE
#undef FST_REALS3
#undef FST_KEYS_OF_A_BEAD

/* Row 0 to FST_BEAD_ROWS - 1, bead after bead. */
const fst_param_info *fst_bead_row(int row);

/* The key that a person may mean: "beads[1].bead.radius" of "beads[1].radius"; any other key as it is. */
void fst_bead_whole_key(const char *key, char *whole, size_t size);

/* The key of the setup that a bead's key stands for, "start.phi" of "beads[1].start.phi". */
const char *fst_bead_key_of_setup(const char *key);

/* What a bead of which nothing is said says. */
fst_bead_params fst_bead_says_nothing(void);

/* No key is `key`, which begins with "beads". */
fst_status fst_bead_unknown_key(const char *key, fst_error *error);

#endif
