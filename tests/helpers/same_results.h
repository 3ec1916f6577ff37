/* same_results.h - two results of runs that must be the same to the bit. */
#ifndef FST_TESTS_SAME_RESULTS_H
#define FST_TESTS_SAME_RESULTS_H

#include <string.h>

#include <festoon/festoon.h>

#include "numeric.h"

/* Fails unless two results agree in every bit; the message names `job`. */
static inline void check_same_result(int job, const fst_run_result *a, const fst_run_result *b)
{
    for (int k = 0; k < fst_result_count(); ++k)
        if (memcmp((const char *)a + fst_result_at(k)->offset, (const char *)b + fst_result_at(k)->offset,
                   sizeof(double)) != 0)
            fail_msg("job %d: %s differs", job, fst_result_at(k)->name);
    assert_memory_equal(a->final_state, b->final_state, sizeof a->final_state);
    assert_int_equal(a->regime, b->regime);
    assert_int_equal(a->symmetry, b->symmetry);
    assert_string_equal(a->reason, b->reason);
    assert_int_equal(a->rhs_calls, b->rhs_calls);
    assert_int_equal(a->accepted, b->accepted);
    assert_int_equal(a->rejected, b->rejected);
    assert_int_equal(a->returns, b->returns);
}

#endif
