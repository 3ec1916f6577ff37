/* count_evaluations.h - forced into every file of a library that a test makes for itself: counts how often the
 * magnet's pull, and with it the right-hand side, is evaluated. */
#ifndef FST_TESTS_COUNT_EVALUATIONS_H
#define FST_TESTS_COUNT_EVALUATIONS_H

/* Of all threads together; the tests have one. */
extern long long fst_test_evaluations;

#define FST_COUNT_EVALUATION() ((void)(fst_test_evaluations += 1))

#endif
