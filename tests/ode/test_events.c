/* Events that begin and end within one step: a dip below zero is found wherever it lies in the step and however
 * narrow it is, and a dip that stays above zero is not reported.  The quick way to the same events finds a fall
 * through zero wherever it lies, and leaves dips to the thorough one.
 * tests: ode/events.c
 * labels: memcheck */
#include "physics.h"

#include "ode/flow.h"

/* The state function below is a parabola over X, which goes from 0 to 1 in the step. */
static struct {
    double from, to, centre, floor;
} dip;

static double parabola(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    (void)flow, (void)p;
    const double way = (state[FST_X] - dip.from) / (dip.to - dip.from) - dip.centre;
    return way * way + dip.floor;
}

static double way_at(fst_flow *flow, double x)
{
    double state[FST_STATE_SIZE];
    fst_flow_at(flow, x, state);
    return (state[FST_X] - dip.from) / (dip.to - dip.from);
}

/* A fall through zero at the centre, which is as flat at the step's start as a cube where `floor` is 1; a rise
 * where it is -1. */
static double fall(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    (void)flow, (void)p;
    const double way = (state[FST_X] - dip.from) / (dip.to - dip.from), from = dip.centre;
    if (dip.floor < 0)
        return way + from;
    return dip.floor > 0 ? from * from * from - way * way * way : from - way;
}

/* A flow whose last step has X move one way all along. */
static fst_flow *flow_one_way(fst_model **model)
{
    const fst_params p = bead_at(0.21, FST_DYNAMICS_FARAGO2020);
    const fst_run_result orbit = run_of(&p);
    *model = model_of(&p);
    fst_flow *flow = flow_of(*model, 1e-10, orbit.final_state);
    fst_error error;
    for (int i = 0; i < 7; ++i)
        assert_int_equal(fst_flow_step(flow, 100.0, &error), FST_OK);
    dip.from = flow->step.y[FST_X];
    dip.to = flow->step.end[FST_X];
    for (int i = 1; i <= 64; ++i)
        assert_true(way_at(flow, i / 64.0) > way_at(flow, (i - 1) / 64.0));
    return flow;
}

static void falls_of_any_place(void **state)
{
    (void)state;
    fst_model *model;
    fst_flow *flow = flow_one_way(&model);
    for (int k = 1; k < 400; ++k)
        for (int form = -1; form <= 1; ++form) {
            double x = -1.0;
            dip.centre = k / 320.0;
            dip.floor = form;
            const int met = fst_flow_becomes_negative(flow, fall, &x);
            assert_int_equal(met, form >= 0 && dip.centre < 1.0);
            if (met)
                CHECK_CLOSE(way_at(flow, x), dip.centre, 1e-12);
        }
    for (int k = 16; k < 304; ++k) {
        double quick = -1.0, thorough = -2.0;
        dip.centre = k / 320.0;
        dip.floor = -1e-4;
        assert_int_equal(fst_flow_becomes_negative(flow, parabola, &quick), 1);
        assert_int_equal(fst_flow_first_negative(flow, parabola, 0.0, &thorough), 1);
        CHECK_CLOSE(quick, thorough, 0.0);
    }
    fst_flow_free(flow);
    fst_model_free(model);
}

static void dips_of_any_place_and_width(void **state)
{
    (void)state;
    fst_model *model;
    fst_flow *flow = flow_one_way(&model);
    int found = 0;
    for (int k = 1; k < 320; ++k)
        for (int power = 1; power <= 4; ++power)
            for (int sign = -1; sign <= 1; sign += 2) {
                const double half_width = 0.02 * pow(10.0, 1 - power);
                double x = -1.0;
                dip.centre = k / 320.0;
                dip.floor = sign * half_width * half_width;
                const int met = fst_flow_first_negative(flow, parabola, 0.0, &x);
                if (dip.centre < half_width) /* the dip begins before the step */
                    continue;
                if (met != (sign < 0))
                    fail_msg("centre %g, half width %g: %s", dip.centre, half_width,
                             met ? "a dip above zero was taken for an event" : "the event was missed");
                if (met)
                    CHECK_CLOSE(way_at(flow, x), dip.centre - half_width, 1e-7);
                found += met;
            }
    assert_true(found > 1200);
    fst_flow_free(flow);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(dips_of_any_place_and_width),
                                       cmocka_unit_test(falls_of_any_place)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
