/* coil_rows.h - the keys of coils, which stand behind those of the magnet's parts. */
#ifndef FST_MODEL_COIL_ROWS_H
#define FST_MODEL_COIL_ROWS_H

#include <festoon/festoon.h>

enum { FST_COIL_FIELDS = 12, FST_COIL_ROWS = FST_COIL_FIELDS * FST_COILS_MAX };

/* Row 0 to FST_COIL_ROWS - 1, coil after coil. */
const fst_param_info *fst_coil_row(int row);

/* FST_BAD_INPUT: there are fewer coils than come before this one. */
fst_status fst_coil_may_set(const fst_params *params, int coil, fst_error *error);

/* No key is `key`, which begins with "coils". */
fst_status fst_coil_unknown_key(const char *key, fst_error *error);

/* The number of coils, and whether each can be. */
fst_status fst_coils_validate(const fst_params *params, fst_error *error);

#endif
