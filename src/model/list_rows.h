/* list_rows.h - the keys of vectors, which stand behind those of the magnet's parts. */
#ifndef FST_MODEL_LIST_ROWS_H
#define FST_MODEL_LIST_ROWS_H

#include <festoon/festoon.h>

/* The components of the vectors of params.def. */
#define FST_REAL(...)
#define FST_INT(...)
#define FST_CHOICE(...)
#define FST_TEXT(...)
#define FST_REALS2(...) +2
#define FST_REALS3(...) +3
enum {
    FST_LIST_ROWS = 0
#include <festoon/params.def>
};
#undef FST_REAL
#undef FST_INT
#undef FST_CHOICE
#undef FST_TEXT
#undef FST_REALS2
#undef FST_REALS3

/* Row 0 to FST_LIST_ROWS - 1. */
const fst_param_info *fst_list_row(int row);

fst_status fst_lists_validate(const fst_params *params, fst_error *error);

#endif
