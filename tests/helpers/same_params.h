/* same_params.h - comparing parameters field by field: a fst_params has padding between its fields. */
#ifndef FST_TESTS_SAME_PARAMS_H
#define FST_TESTS_SAME_PARAMS_H

#include "numeric.h"

#include <festoon/festoon.h>

/* Fail unless every field has the same bits. */
static inline void check_same_params(const fst_params *actual, const fst_params *expected)
{
    assert_int_equal(actual->magnet_part_count, expected->magnet_part_count);
    assert_int_equal(actual->bead_count, expected->bead_count);
    for (int i = 0; i < fst_params_row_count(expected); i++) {
        const fst_param_info *info = fst_param_at(i);
        const size_t size = info->kind == FST_KIND_REAL   ? sizeof(double)
                            : info->kind == FST_KIND_TEXT ? (size_t)info->greatest + 1
                                                          : sizeof(int);
        if (memcmp((const char *)actual + info->offset, (const char *)expected + info->offset, size) != 0)
            fail_msg("%s differs", info->key);
    }
}

#endif
