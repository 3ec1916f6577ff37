/* part_rows.h - the keys of a magnet's parts, and whether parts can be what they say. */
#ifndef FST_MODEL_PART_ROWS_H
#define FST_MODEL_PART_ROWS_H

#include <festoon/festoon.h>

/* The keys of one part: its kind, sixteen numbers, and its motion. */
enum { FST_PART_FIELDS = 18, FST_PART_ROWS = FST_PART_FIELDS * FST_PARTS_MAX };

/* Row 0 to FST_PART_ROWS - 1, part after part. */
const fst_param_info *fst_part_row(int row);

/* Whether a part of this kind has the number of this row. */
int fst_part_has(int kind, int row);

/* FST_BAD_INPUT: the magnet has no such part, or a part of its kind no such number. */
fst_status fst_part_may_set(const fst_params *params, int row, fst_error *error);

/* After the row was set: a kind begins a part, or takes from one what the kind does not have. */
void fst_part_was_set(fst_params *params, int row);

/* No key of params.def or of a part is `key`, which begins with "magnet.parts". */
fst_status fst_part_unknown_key(const char *key, fst_error *error);

/* One part: its numbers, and that it lies below the plate. */
fst_status fst_part_check(const fst_params *params, int part, fst_error *error);

/* The number of parts, and fst_params_check_part() of each; parts that take no part in the field may lie
 * anywhere. */
fst_status fst_parts_validate(const fst_params *params, fst_error *error);

#endif
