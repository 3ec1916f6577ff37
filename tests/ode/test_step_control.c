/* The rules by which every step of festoon grows, shrinks, lands and is given up.
 * tests: ode/step_control.inl
 * labels: memcheck */
#include "physics.h"

#include "ode/flow.h"

static fst_step_control_double control_of(double proposal)
{
    return fst_begin_control_double(proposal, INFINITY);
}

/* A step goes to the end of the way if that is at most 1 % farther than proposed. */
static void test_planning(void **state)
{
    (void)state;
    fst_step_control_double c = control_of(1.0);
    fst_plan_step_double(&c, REAL_EVERYWHERE, 1.009);
    assert_true(c.size == 1.009 && c.lands == 1.0);
    fst_plan_step_double(&c, REAL_EVERYWHERE, 1.011);
    assert_true(c.size == 1.0 && c.lands == 0.0);
    fst_plan_step_double(&c, REAL_EVERYWHERE, -0.3);
    assert_true(c.size == -0.3 && c.lands == 1.0);
    fst_plan_step_double(&c, REAL_EVERYWHERE, -INFINITY);
    assert_true(c.size == -1.0 && c.lands == 0.0);
    c.greatest = 0.25;
    fst_plan_step_double(&c, REAL_EVERYWHERE, 2.0);
    assert_true(c.size == 0.25 && c.lands == 0.0 && c.proposal == 1.0);
    /* Landing is exact, whatever the rounded sum of the steps would be. */
    const fst_twofold t = {0.1, 1e-18};
    fst_plan_step_double(&c, REAL_EVERYWHERE, 0.2);
    const fst_twofold end = fst_step_end_double(&c, t, 0.3);
    assert_true(end.high == 0.3 && end.low == 0.0);
}

/* 0.9 error^(-1/8), within a factor of 6. */
static void test_factors(void **state)
{
    (void)state;
    CHECK_CLOSE(fst_step_factor_double(1.0), 0.9, 0.0);
    CHECK_CLOSE(fst_step_factor_double(256.0), 0.45, 1e-16);
    CHECK_CLOSE(fst_step_factor_double(0.0), 6.0, 1e-15);
    CHECK_CLOSE(fst_step_factor_double(1e300), 1.0 / 6.0, 0.0);
}

/* Damped: 0.9 e^(-3/32) e_0^(1/32), where e_0 is the error of the accepted step before, 1 before the first. */
static void test_damped_factors(void **state)
{
    (void)state;
    static const double errors[] = {0.5, 0.02, 0.9, 0.3};
    fst_step_control_double damped = control_of(1.0);
    double before = 1.0;
    for (int i = 0; i < 4; ++i) {
        const double e = errors[i], factor = fst_step_factor_double(e);
        CHECK_CLOSE(fst_damped_factor_double(&damped, REAL_EVERYWHERE, factor),
                    0.9 * pow(e, -3.0 / 32.0) * pow(before, 1.0 / 32.0), 1e-15);
        before = e;
    }
}

/* A step that was shortened to land leaves a longer proposal as it was. After a failed try the next step of a
 * run must not grow; that of a tangent may. */
static void test_proposals(void **state)
{
    (void)state;
    fst_step_control_double c = control_of(1.0);
    fst_plan_step_double(&c, REAL_EVERYWHERE, 0.01);
    fst_accept_step_double(&c, REAL_EVERYWHERE, 6.0, FST_HOLD_AFTER_REJECTION);
    assert_true(c.proposal == 1.0);
    fst_plan_step_double(&c, REAL_EVERYWHERE, 10.0);
    fst_accept_step_double(&c, REAL_EVERYWHERE, 0.5, FST_HOLD_AFTER_REJECTION);
    assert_true(c.proposal == 0.5);
    for (int rule = FST_HOLD_AFTER_REJECTION; rule <= FST_GROW_AFTER_REJECTION; ++rule) {
        c = control_of(1.0);
        fst_plan_step_double(&c, REAL_EVERYWHERE, 10.0);
        assert_true(fst_reject_step_double(&c, REAL_EVERYWHERE, 2.0, 0.5, 0.0) == 0.0);
        assert_true(c.size == 0.5 && c.worst_error == 2.0 && c.rejections == 1.0);
        fst_accept_step_double(&c, REAL_EVERYWHERE, 3.0, rule);
        assert_true(c.proposal == (rule == FST_GROW_AFTER_REJECTION ? 1.5 : 0.5));
    }
}

/* A number that is not finite makes the step ten times smaller.  A step is given up where it is too small for
 * the time that it is added to, or after 402 failed tries. */
static void test_giving_up(void **state)
{
    (void)state;
    const double times[] = {1.0, 2e6};
    for (int i = 0; i < 2; ++i) {
        fst_step_control_double c = control_of(1.0);
        fst_plan_step_double(&c, REAL_EVERYWHERE, 10.0);
        int tries = 1;
        while (fst_reject_step_double(&c, REAL_EVERYWHERE, NAN, 6.0, times[i]) == 0.0)
            ++tries;
        assert_int_equal(tries, i == 0 ? 14 : 8);
        assert_true(c.worst_error == INFINITY);
    }
    fst_step_control_double c = control_of(1.0);
    fst_plan_step_double(&c, REAL_EVERYWHERE, 10.0);
    int tries = 1;
    while (fst_reject_step_double(&c, REAL_EVERYWHERE, 1.01, 0.999, 0.0) == 0.0)
        ++tries;
    assert_int_equal(tries, 402);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_planning),       cmocka_unit_test(test_factors),
        cmocka_unit_test(test_damped_factors), cmocka_unit_test(test_proposals),
        cmocka_unit_test(test_giving_up),
    };
    return cmocka_run_group_tests_name("step_control", tests, NULL, NULL);
}
