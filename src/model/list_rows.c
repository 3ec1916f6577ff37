/* list_rows.c - the keys of vectors: start.position[0], ... */
#include "model/list_rows.h"

#include "model/params.h"

#define ELEMENT(group, name, i, unit, initial, least, greatest, doc)                                           \
    FST_PARAM_ROW(#group "." #name "[" #i "]", REAL, unit, NULL, initial, least, greatest, doc,                \
                  group##_##name[i]),

static const fst_param_info rows[] = {
#define FST_REAL(...)
#define FST_INT(...)
#define FST_CHOICE(...)
#define FST_TEXT(...)
#define FST_REALS2(group, name, ...) ELEMENT(group, name, 0, __VA_ARGS__) ELEMENT(group, name, 1, __VA_ARGS__)
#define FST_REALS3(group, name, ...) FST_REALS2(group, name, __VA_ARGS__) ELEMENT(group, name, 2, __VA_ARGS__)
#include <festoon/params.def>
#undef FST_REAL
#undef FST_INT
#undef FST_CHOICE
#undef FST_TEXT
#undef FST_REALS2
#undef FST_REALS3
};

const fst_param_info *fst_list_row(int row)
{
    return &rows[row];
}

fst_status fst_lists_validate(const fst_params *params, fst_error *error)
{
    fst_status status = FST_OK;
    for (int i = 0; i < FST_LIST_ROWS && status == FST_OK; ++i)
        status = fst_param_validate(params, &rows[i], error);
    return status;
}
