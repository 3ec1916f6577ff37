/* Verdicts at their borders: for each rule a value just inside and just outside "reproduced" and "close". The
 * rules are printed in docs/paper.md.
 * tests: paper/verdicts.c paper/statements.c paper/settle.c */
#include "numeric.h"

#include "paper/runs.h"
#include "paper/statements.h"

/* A value on either side of a border of a rule. */
typedef struct border {
    fst_rule rule;
    double published, scale, inside, outside;
    fst_verdict verdict, beyond;
} border;

#define YES FST_VERDICT_REPRODUCED
#define NEARLY FST_VERDICT_CLOSE
#define NO FST_VERDICT_NOT

static const border borders[] = {
    /* A printed number: half a unit of its last digit; ten units, and at most a fifth of it. */
    {FST_RULE_NUMBER, 41.0, 1.0, 41.499, 41.501, YES, NEARLY},
    {FST_RULE_NUMBER, 41.0, 1.0, 40.501, 40.499, YES, NEARLY},
    {FST_RULE_NUMBER, 0.2904, 1e-4, 0.29139, 0.29141, NEARLY, NO},
    {FST_RULE_NUMBER, 0.2904, 1e-4, 0.28941, 0.28939, NEARLY, NO},
    {FST_RULE_NUMBER, 41.0, 1.0, 49.19, 49.21, NEARLY, NO},
    {FST_RULE_NUMBER, 41.0, 1.0, 32.81, 32.79, NEARLY, NO},
    /* A limit: the same distances above it, and no bound below. */
    {FST_RULE_AT_MOST, 4.0, 1.0, 4.499, 4.501, YES, NEARLY},
    {FST_RULE_AT_MOST, 4.0, 1.0, 4.799, 4.801, NEARLY, NO},
    {FST_RULE_AT_MOST, 4.0, 1.0, -100.0, 4.501, YES, NEARLY},
    {FST_RULE_AT_MOST, 100.0, 1.0, 109.99, 110.01, NEARLY, NO},
    /* An order of magnitude: within half an order; within one. */
    {FST_RULE_MAGNITUDE, 100.0, 1.0, 316.2, 316.3, YES, NEARLY},
    {FST_RULE_MAGNITUDE, 100.0, 1.0, 31.63, 31.62, YES, NEARLY},
    {FST_RULE_MAGNITUDE, 100.0, 1.0, 999.9, 1000.1, NEARLY, NO},
    {FST_RULE_MAGNITUDE, 100.0, 1.0, 10.001, 9.999, NEARLY, NO},
    /* Shares of the natural scale. */
    {FST_RULE_SMALL, 90.0, 45.0, 94.499, 94.501, YES, NEARLY},
    {FST_RULE_SMALL, 90.0, 45.0, 85.501, 85.499, YES, NEARLY},
    {FST_RULE_SMALL, 90.0, 45.0, 103.49, 103.51, NEARLY, NO},
    {FST_RULE_NOTABLE, 0.0, 100.0, 10.001, 9.999, YES, NEARLY},
    {FST_RULE_NOTABLE, 0.0, 100.0, 3.001, 2.999, NEARLY, NO},
    {FST_RULE_MOSTLY, 0.0, 100.0, 50.001, 49.999, YES, NEARLY},
    {FST_RULE_MOSTLY, 0.0, 100.0, 25.001, 24.999, NEARLY, NO},
    {FST_RULE_EXACT, 1.0, 1.0, 1.000000999, 1.000001001, YES, NEARLY},
    {FST_RULE_EXACT, 1.0, 1.0, 1.000999, 1.001001, NEARLY, NO},
    {FST_RULE_EXACT, 0.0, 10.0, 9.99e-6, 1.001e-5, YES, NEARLY},
    /* One exception is too many. */
    {FST_RULE_NEVER, 0.0, 1.0, 0.0, 1.0, YES, NO},
    {FST_RULE_SYMMETRY, 2.0, 1.0, 2.0, 1.0, YES, NO},
    {FST_RULE_SEVERAL, 0.0, 1.0, 2.0, 1.0, YES, NO},
    {FST_RULE_SEVERAL, 0.0, 1.0, 5.0, 0.0, YES, NO},
};

static fst_verdict verdict_of(const border *b, double value)
{
    const fst_statement statement = {.rule = b->rule, .published = b->published, .scale = b->scale};
    return fst_statement_verdict(&statement, value);
}

static void each_border_lies_where_it_is_printed(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof borders / sizeof borders[0]; ++i) {
        const border *b = &borders[i];
        if (verdict_of(b, b->inside) != b->verdict || verdict_of(b, b->outside) != b->beyond)
            fail_msg("border %zu, rule %d: %g is %s, %g is %s", i, (int)b->rule, b->inside,
                     fst_verdict_name(verdict_of(b, b->inside)), b->outside,
                     fst_verdict_name(verdict_of(b, b->outside)));
    }
}

static void what_is_unknown_earns_nothing(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof borders / sizeof borders[0]; ++i)
        assert_int_equal(verdict_of(&borders[i], NAN), FST_VERDICT_NOT);
}

/* Table 1: N within 1.2 % with the published symmetry; within 5 %. */
static void table_one(void **state)
{
    (void)state;
    static const struct {
        double factor;
        fst_symmetry symmetry;
        fst_verdict verdict;
    } cases[] = {
        {1.0119, FST_SYMMETRY_S1, YES},    {0.9881, FST_SYMMETRY_S1, YES},    {1.0121, FST_SYMMETRY_S1, NEARLY},
        {0.9879, FST_SYMMETRY_S1, NEARLY}, {1.0499, FST_SYMMETRY_S1, NEARLY}, {1.0501, FST_SYMMETRY_S1, NO},
        {1.0, FST_SYMMETRY_S2, NO},        {1.0, FST_SYMMETRY_NONE, NO},      {NAN, FST_SYMMETRY_S1, NO},
    };
    fst_paper_run run = {.done = 1};
    fst_paper_state paper = {.counts = {[FST_SCAN_TABLE] = 1}};
    paper.scans[FST_SCAN_TABLE][FST_DYNAMICS_RIGID] = &run;
    assert_int_equal(fst_table1[0].published_a, 1);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        run.result.festoons = cases[i].factor * fst_table1[0].published;
        run.result.symmetry = cases[i].symmetry;
        assert_int_equal(fst_table1_verdict(&paper, 0, FST_DYNAMICS_RIGID), cases[i].verdict);
    }
}

/* ------------------------------------------------------------------ motions that have not settled */

static fst_run_result a_result(fst_regime regime, double r_error, double alpha_error)
{
    fst_run_result result = {.regime = regime};
    result.omega = 0.4;
    result.mean_r = 0.9;
    result.mean_alpha_dot = -0.05;
    result.mean_r_error = r_error;
    result.mean_alpha_dot_error = alpha_error;
    return result;
}

static void a_mean_counts_when_it_is_known(void **state)
{
    (void)state;
    static const struct {
        fst_regime regime;
        double r_error, alpha_error;
        int settled;
    } cases[] = {
        {FST_REGIME_COUNTER_ROTATING, 1e-9, 1e-9, 1},
        {FST_REGIME_COUNTER_ROTATING, 0.89e-3, 4.9e-5, 1},
        {FST_REGIME_COUNTER_ROTATING, 0.91e-3, 0, 0},
        {FST_REGIME_COUNTER_ROTATING, 0, 5.1e-5, 0},
        {FST_REGIME_LIBRATING, 1e-9, 1e-9, 1},
        {FST_REGIME_LOCKED, NAN, NAN, 1},
        {FST_REGIME_UNDECIDED, 1e-9, 1e-9, 0},
        {FST_REGIME_CHAOTIC, 1e-9, 1e-9, 0},
        {FST_REGIME_EJECTED, NAN, NAN, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        const fst_run_result result = a_result(cases[i].regime, cases[i].r_error, cases[i].alpha_error);
        assert_int_equal(fst_paper_is_settled(&result), cases[i].settled);
    }
}

/* Next to the Hopf point of the locked states swings die out so slowly that a run of the usual length decides
 * nothing. It is prolonged, and if that does not help it has no means. */
static void what_has_not_settled_is_prolonged(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    params.drive_omega = 0.152;
    params.drive_frequency = NAN;
    params.start_spin = FST_SPIN_REST;
    params.run_periods = 60;
    params.run_discard = 30;
    params.run_rtol = 1e-8;
    const double before = params.run_periods;
    fst_run_result result;
    assert_int_equal(fst_paper_run_settled(&params, NULL, &result, NULL, NULL), FST_OK);
    assert_true(params.run_periods >= 2.0 * before && params.run_discard == 0.5 * params.run_periods);
    if (result.regime == FST_REGIME_UNDECIDED)
        assert_true(params.run_periods == 8.0 * before && isnan(result.mean_r) && isfinite(result.omega));
    else
        assert_true(fst_paper_is_settled(&result) && isfinite(result.mean_r));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_border_lies_where_it_is_printed),
        cmocka_unit_test(what_is_unknown_earns_nothing),
        cmocka_unit_test(table_one),
        cmocka_unit_test(a_mean_counts_when_it_is_known),
        cmocka_unit_test(what_has_not_settled_is_prolonged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
