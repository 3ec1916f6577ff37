/* A resumed sweep recognises its arithmetic by a fingerprint: the portable form has one for any number of
 * lanes, and each form whose results differ in the last bits has another.
 * tests: sweep/fingerprint.c */
#include "physics.h"

#include "sweep/sweep.h"

/* 0 if this processor has no such lanes */
static uint64_t fingerprint(fst_arithmetic arithmetic, int lanes)
{
    uint64_t hash = 0;
    fst_error error = {FST_OK, "", ""};
    const fst_status status = fst_arithmetic_fingerprint(arithmetic, lanes, &hash, &error);
    if (status == FST_UNAVAILABLE)
        return 0;
    if (status != FST_OK)
        fail_msg("%s", error.sentence);
    return hash;
}

static void test_fingerprints(void **unused)
{
    (void)unused;
    const uint64_t portable = fingerprint(FST_ARITHMETIC_PORTABLE, 1);
    assert_true(portable != 0);
    for (int lanes = 4; lanes <= 8; lanes += 4) {
        const uint64_t wide = fingerprint(FST_ARITHMETIC_PORTABLE, lanes);
        assert_true(wide == 0 || wide == portable);
    }
    const uint64_t fast[] = {fingerprint(FST_ARITHMETIC_AVX2, 4), fingerprint(FST_ARITHMETIC_AVX512, 8)};
    for (int i = 0; i < 2; ++i)
        assert_true(fast[i] != portable);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fingerprints)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
