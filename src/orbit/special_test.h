/* special_test.h - functions of a solution that vanish at special points, and where they vanish. */
#ifndef FST_ORBIT_SPECIAL_TEST_H
#define FST_ORBIT_SPECIAL_TEST_H

#include "orbit/node.h"

/* FOLD: the tangent's part along the parameter.  MINUS: the product of (1 + multiplier), zero where a
 * multiplier of an orbit is -1.  PLUS: the product of (multiplier - 1), or of the eigenvalues of an
 * equilibrium.  PAIR: how far the complex pair nearest to the border of stability is from it.  ORIGIN: the
 * least distance of an orbit from the axis, with its sign. */
enum { FST_TEST_FOLD, FST_TEST_MINUS, FST_TEST_PLUS, FST_TEST_PAIR, FST_TEST_ORIGIN, FST_TEST_COUNT };

/* NAN where the test has no meaning. */
double fst_test_value(const fst_node *node, int test);

/* Whether something happens between two neighbours that this test sees. */
int fst_test_changes(const fst_node *a, const fst_node *b, int test);

/* The frequency of an equilibrium's critical pair, or the angle of the pair of multipliers nearest to the unit
 * circle; NAN: there is no pair. */
double fst_pair_frequency(const fst_solution *s);

/* How many multipliers (eigenvalues) are unstable, and how many complex pairs of them. */
int fst_count_unstable(const fst_solution *s);
int fst_count_unstable_pairs(const fst_solution *s);

/* The place between a and b where a test vanishes. */
fst_status fst_locate_special(const fst_family *family, const fst_node *a, const fst_node *b, int test,
                              fst_node *out, fst_error *error);

/* The parameter's value where two curves of equilibria meet, more exactly than the place `at` that was located.
 */
double fst_pitchfork_value(const fst_family *family, const fst_node *a, const fst_node *b, const fst_node *at);

#endif
