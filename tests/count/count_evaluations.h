/* count_evaluations.h - included by force into every file of a library that a test builds for itself; it counts
 * the evaluations of the magnet's pull, and so of the right-hand side. */
#ifndef FST_TESTS_COUNT_EVALUATIONS_H
#define FST_TESTS_COUNT_EVALUATIONS_H

/* Counts all threads together; the tests have one. */
extern long long fst_test_evaluations;

#define FST_COUNT_EVALUATION() ((void)(fst_test_evaluations += 1))

#endif
