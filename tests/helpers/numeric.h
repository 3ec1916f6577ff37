/* numeric.h - cmocka, and comparisons of doubles, which its version 1.1.5 lacks. */
#ifndef FST_TESTS_NUMERIC_H
#define FST_TESTS_NUMERIC_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* Fail unless |actual - expected| <= tolerance (absolute); prints both. */
#define CHECK_CLOSE(actual, expected, tolerance)                                                               \
    do {                                                                                                       \
        const double check_actual = (actual), check_expected = (expected), check_tolerance = (tolerance);      \
        if (!(fabs(check_actual - check_expected) <= check_tolerance))                                         \
            fail_msg("%s = %.17g, expected %.17g within %.3g (off by %.3g)", #actual, check_actual,            \
                     check_expected, check_tolerance, check_actual - check_expected);                          \
    } while (0)

/* Fail unless the two doubles have the same bits. */
#define CHECK_SAME_BITS(actual, expected)                                                                      \
    do {                                                                                                       \
        const double check_actual = (actual), check_expected = (expected);                                     \
        if (memcmp(&check_actual, &check_expected, sizeof check_actual) != 0)                                  \
            fail_msg("%s = %.17g, expected the bits of %.17g", #actual, check_actual, check_expected);         \
    } while (0)

/* Fail unless `text` contains `part`; prints both. */
#define CHECK_CONTAINS(text, part)                                                                             \
    do {                                                                                                       \
        if (!strstr((text), (part)))                                                                           \
            fail_msg("\"%s\" lacks \"%s\"", (text), (part));                                                   \
    } while (0)

#endif
