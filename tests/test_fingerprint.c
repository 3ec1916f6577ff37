/* The fingerprint by which a resumed sweep knows its arithmetic: that of the portable form whatever the number
 * of lanes, and another one for each form whose results differ in their last bits. */
#include "physics.h"

#include "sweep/sweep.h"

/* 0 where this processor has no such lanes. */
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
