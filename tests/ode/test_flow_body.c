/* flow.inl takes any dimension and kind of number. One bead, and two beads side by side, in long double follow
 * the library's flow in double; and where the equations have two modes, the flow changes from one to the other
 * at the place that the state decides.
 * tests: ode/flow.inl ode/dop853.inl
 * labels: long-double */
#include "physics_ld.h"

#include "ode/dop853_tableau.h"
#include "ode/step_control.inl"

enum { BEADS = 2, TWO_BEADS = BEADS * FST_STATE_SIZE };

/* ------------------------------------------------------------------ beads that do not feel each other */

static void beads_rhs(const world_ld *c, int beads, long double omega, const long double *y, long double *dy)
{
    fst_pull_long_double pull;
    for (int i = 0; i < beads; ++i)
        fst_rhs_long_double(&c[i], NULL, omega, y + i * FST_STATE_SIZE, dy + i * FST_STATE_SIZE, &pull);
}

static void nothing(const void *y)
{
    (void)y;
}

/* Steps and flows of one bead, and of two. */
typedef struct beads_context {
    world_ld c[BEADS];
} beads_context;

#define STEP_DIM FST_STATE_SIZE
#define STEP_NAME(name) one_step_##name
#define STEP_CONTEXT beads_context
#define STEP_RHS(context, drive, y, dy) beads_rhs((context)->c, 1, drive, y, dy)
#include "ode/dop853.inl"

#define STEP_DIM TWO_BEADS
#define STEP_NAME(name) two_step_##name
#define STEP_CONTEXT beads_context
#define STEP_RHS(context, drive, y, dy) beads_rhs((context)->c, BEADS, drive, y, dy)
#include "ode/dop853.inl"

#define FLOW_DIM FST_STATE_SIZE
#define FLOW_TAG one_flow
#define FLOW_NAME(name) one_##name
#define FLOW_STEP(name) one_step_##name
#define FLOW_BEGIN(s) one_step_begin(s)
#define FLOW_FINISH(s) one_step_finish(s)
#define FLOW_NEXT(s, drive) one_step_next(s, drive)
#define FLOW_PROJECT(y) nothing(y)
#define FLOW_DERIVATIVE(s, y, dy) beads_rhs((s)->context.c, 1, (s)->omega, y, dy)
#define FLOW_MEMBERS
#include "ode/flow.inl"

#define FLOW_DIM TWO_BEADS
#define FLOW_TAG two_flow
#define FLOW_NAME(name) two_##name
#define FLOW_STEP(name) two_step_##name
#define FLOW_BEGIN(s) two_step_begin(s)
#define FLOW_FINISH(s) two_step_finish(s)
#define FLOW_NEXT(s, drive) two_step_next(s, drive)
#define FLOW_PROJECT(y) nothing(y)
#define FLOW_DERIVATIVE(s, y, dy) beads_rhs((s)->context.c, BEADS, (s)->omega, y, dy)
#define FLOW_MEMBERS
#include "ode/flow.inl"

static void test_two_beads_are_one_and_one(void **state)
{
    (void)state;
    const long double tolerance = 1e-15L, t_end = 40;
    static two_type two;
    double starts[BEADS][FST_STATE_SIZE], ends[BEADS][FST_STATE_SIZE];
    two.rtol = tolerance;
    for (int b = 0; b < BEADS; ++b) {
        fst_params p = bead_at(0.8, b == 0 ? FST_DYNAMICS_RIGID : FST_DYNAMICS_FARAGO2020);
        p.model_kappa = 1.0 + 0.5 * b;
        fst_model *model = model_of(&p);
        start_of(&p, model, starts[b]);
        two.step.context.c[b] = world_of(&p);
        two.drive.omega = two.step.context.c[b].omega;
        fst_flow *flow = flow_of(model, 1e-13, starts[b]);
        fst_stop stop;
        assert_int_equal(fst_flow_next(flow, (double)t_end, 0, &stop, NULL), FST_OK);
        const fst_flow_info info = fst_flow_get(flow);
        memcpy(ends[b], info.state, sizeof info.state);
        fst_flow_free(flow);
        fst_model_free(model);
    }
    for (int i = 0; i < TWO_BEADS; ++i) {
        two.step.y[i] = starts[i / FST_STATE_SIZE][i % FST_STATE_SIZE];
        two.atol[i] = tolerance;
    }
    two_begin(&two, 0, 0);
    while (two.t.high < t_end)
        assert_true(two_go(&two, t_end));
    assert_true(two.t.high == t_end && two.t.low == 0);
    for (int b = 0; b < BEADS; ++b) {
        static one_type one;
        memset(&one, 0, sizeof one);
        one.rtol = tolerance;
        one.step.context.c[0] = two.step.context.c[b];
        one.drive.omega = two.drive.omega;
        for (int i = 0; i < FST_STATE_SIZE; ++i) {
            one.step.y[i] = starts[b][i];
            one.atol[i] = tolerance;
        }
        one_begin(&one, 0, 0);
        while (one.t.high < t_end)
            assert_true(one_go(&one, t_end));
        for (int i = 0; i < FST_STATE_SIZE; ++i) {
            CHECK_CLOSE_LD(two.step.end[b * FST_STATE_SIZE + i], one.step.end[i], 1e-12);
            CHECK_CLOSE_LD(one.step.end[i], ends[b][i], 1e-9);
        }
    }
}

/* ------------------------------------------------------------------ a spring that is stiffer on one side */

/* y'' = -k y, where k is 1 in one mode and 4 in the other; the mode changes at y = 0. */
typedef struct spring_context {
    int mode;
} spring_context;

static void spring_rhs(const spring_context *c, const long double *y, long double *dy)
{
    dy[0] = y[1];
    dy[1] = c->mode ? -4 * y[0] : -y[0];
}

#define STEP_DIM 2
#define STEP_NAME(name) spring_step_##name
#define STEP_CONTEXT spring_context
#define STEP_RHS(context, drive, y, dy) ((void)(drive), spring_rhs(context, y, dy))
#include "ode/dop853.inl"

#define FLOW_DIM 2
#define FLOW_TAG spring_flow
#define FLOW_NAME(name) spring_##name
#define FLOW_STEP(name) spring_step_##name
#define FLOW_BEGIN(s) spring_step_begin(s)
#define FLOW_FINISH(s) spring_step_finish(s)
#define FLOW_NEXT(s, drive) spring_step_next(s, drive)
#define FLOW_PROJECT(y) nothing(y)
#define FLOW_DERIVATIVE(s, y, dy) spring_rhs(&(s)->context, y, dy)
#define FLOW_MEMBERS
#include "ode/flow.inl"

/* The fraction of the last step at which y passes zero, by bisection. */
static long double zero_of(spring_type *flow)
{
    long double lo = 0, hi = 1, state[2];
    for (int i = 0; i < 70; ++i) {
        const long double x = (lo + hi) / 2;
        spring_state_at(flow, x, state);
        if ((state[0] > 0) == (flow->step.end[0] > 0))
            hi = x;
        else
            lo = x;
    }
    return hi;
}

/* Half an oscillation takes pi in one mode and pi/2 in the other, and the speed at the passage through zero is
 * kept. */
static void test_modes(void **state)
{
    (void)state;
    const long double pi = 3.14159265358979323846264L;
    spring_type flow = {.rtol = 1e-15L, .atol = {1e-15L, 1e-15L}, .step = {.y = {1, 0}}};
    spring_begin(&flow, 0, 0);
    for (int passages = 0; passages < 20;) {
        assert_true(spring_go(&flow, INFINITY));
        const int mode = flow.step.end[0] < 0;
        if (mode == flow.step.context.mode)
            continue;
        spring_cut(&flow, zero_of(&flow));
        flow.step.context.mode = mode;
        spring_restart(&flow);
        const long double expected = pi / 2 + (passages / 2) * (pi + pi / 2) + (passages % 2) * (pi / 2);
        CHECK_CLOSE_LD(flow.t.high, expected, 2e-13);
        CHECK_CLOSE_LD(fabsl(flow.step.y[1]), 1, 2e-13);
        ++passages;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_beads_are_one_and_one),
        cmocka_unit_test(test_modes),
    };
    return cmocka_run_group_tests_name("flow_body", tests, NULL, NULL);
}
