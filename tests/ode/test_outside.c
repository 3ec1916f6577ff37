/* test_outside.c - a field, a force and a torque of the caller's own (fst_flow_options.outside): a magnet's part that
 * is given so moves the bead as the built-in one does; constant forces and torques, laws of energy, time and phase
 * are as by hand; a failure is told, and the flow may go on; nothing else changes a bit.
 *
 * tests: ode/outside.c ode/trajectory.c
 * labels: bits */
#include <string.h>

#include "keys.h"

static fst_flow *flow_with(const fst_model *model, const fst_outside *outside, const double *state)
{
    fst_flow_options o = fst_default_flow_options();
    fst_error error;
    fst_flow *flow = NULL;
    o.rtol = 1e-12;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = 1e-12;
    o.outside = outside;
    if (fst_flow_new(model, &o, state, &flow, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return flow;
}

static fst_flow_info go_to(fst_flow *flow, double t)
{
    fst_stop stop;
    fst_error error;
    if (fst_flow_next(flow, t, 0, &stop, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
    return fst_flow_get(flow);
}

/* ---------------------------------------------------------------- a part of the magnet */

/* The field of another model. */
static fst_status of_model(void *user, double t, double phase, const double *state, fst_action *action,
                           fst_error *error)
{
    (void)t, (void)phase, (void)error;
    fst_field(user, state[FST_X], state[FST_Y], action->field, action->gradient);
    return FST_OK;
}

static void two_dipoles(fst_params *params, int first, int second, const char *material)
{
    *params = fst_default_params();
    set(params, "magnet.shape", "parts");
    params->magnet_part_count = 0;
    for (int i = 0; i < 2; ++i) {
        if (!(i ? second : first))
            continue;
        fst_magnet_part part = {.kind = FST_PART_DIPOLE};
        part.centre[0] = i ? -0.02 : 0.023;
        part.centre[1] = i ? 0.004 : 0.0;
        part.moment[i ? 0 : 2] = i ? 0.4 : 0.7;
        part.moment[1] = 0.1;
        params->magnet_parts[params->magnet_part_count++] = part;
    }
    set(params, "bead.material", material);
    if (strcmp(material, "hard") != 0)
        set(params, "bead.a", "0.002");
    if (strcmp(material, "mixed") == 0)
        set(params, "bead.b", "0.001");
}

/* Two dipoles of the magnet, or one and the other from outside: the same motion. */
static void a_part_from_outside(void **unused)
{
    (void)unused;
    static const char *const materials[] = {"hard", "paramagnetic", "mixed"};
    for (int m = 0; m < 3; ++m) {
        fst_params both, one, other;
        fst_error error;
        double state[FST_STATE_SIZE];
        two_dipoles(&both, 1, 1, materials[m]);
        two_dipoles(&one, 1, 0, materials[m]);
        two_dipoles(&other, 0, 1, materials[m]);
        fst_model *whole = model_of(&both), *part = model_of(&one), *rest = model_of(&other);
        assert_int_equal(fst_start_state(&both, whole, state, &error), FST_OK);
        const fst_outside outside = {rest, of_model};
        fst_flow *built_in = flow_with(whole, NULL, state), *with = flow_with(part, &outside, state);
        double moved = 0.0;
        for (int k = 1; k <= 20; ++k) {
            const fst_flow_info a = go_to(built_in, k), b = go_to(with, k);
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                CHECK_CLOSE(a.state[i], b.state[i], 1e-8);
            CHECK_CLOSE(a.bead_angle, b.bead_angle, 1e-8);
            moved = fmax(moved, fabs(a.state[FST_X] - state[FST_X]) + fabs(a.state[FST_Y] - state[FST_Y]));
        }
        assert_true(moved > 0.1);
        fst_flow_free(built_in);
        fst_flow_free(with);
        fst_model_free(whole);
        fst_model_free(part);
        fst_model_free(rest);
    }
}

/* An action that is nothing leaves every bit as it is. */
static fst_status nothing(void *user, double t, double phase, const double *state, fst_action *action,
                          fst_error *error)
{
    (void)t, (void)phase, (void)state, (void)action, (void)error;
    ++*(int *)user;
    return FST_OK;
}

static void nothing_changes_nothing(void **unused)
{
    (void)unused;
    const fst_params params = fst_default_params();
    fst_model *model = model_of(&params);
    double state[FST_STATE_SIZE];
    fst_error error;
    int calls = 0;
    assert_int_equal(fst_start_state(&params, model, state, &error), FST_OK);
    const fst_outside outside = {&calls, nothing};
    fst_flow *plain = flow_with(model, NULL, state), *with = flow_with(model, &outside, state);
    const fst_flow_info a = go_to(plain, 50.0), b = go_to(with, 50.0);
    assert_memory_equal(a.state, b.state, sizeof a.state);
    assert_int_equal(a.accepted, b.accepted);
    assert_int_equal(a.rhs_calls, b.rhs_calls);
    assert_true(calls >= (int)b.rhs_calls);
    fst_flow_free(plain);
    fst_flow_free(with);
    fst_model_free(model);
}

/* ---------------------------------------------------------------- by hand */

/* A bead without moment on a frictionless plate: only what is from outside acts. */
static fst_model *inert(fst_params *params)
{
    *params = fst_default_params();
    set(params, "bead.material", "paramagnetic");
    set(params, "bead.a", "0");
    set(params, "friction.law", "none");
    return model_of(params);
}

/* A force along the laboratory's x that grows with time, and a torque about the vertical. */
static fst_status by_hand(void *user, double t, double phase, const double *state, fst_action *action,
                          fst_error *error)
{
    (void)user, (void)state, (void)error;
    action->force[0] = 0.02 * t * cos(phase);
    action->force[1] = -0.02 * t * sin(phase);
    action->torque[2] = 3e-4;
    return FST_OK;
}

static void time_and_phase(void **unused)
{
    (void)unused;
    fst_params params;
    fst_model *model = inert(&params);
    const fst_groups g = fst_model_groups(model);
    const fst_outside outside = {NULL, by_hand};
    const double state[FST_STATE_SIZE] = {0.3, 0.2, 0, 0, 0, 0, 1, 0, 0, 0};
    fst_flow *flow = flow_with(model, &outside, state);
    for (int k = 1; k <= 12; ++k) {
        const double t = 0.9 * k, x = 0.3 + 0.02 * t * t * t / 6, y = 0.2;
        const fst_flow_info at = go_to(flow, t);
        CHECK_CLOSE(hypot(at.state[FST_X], at.state[FST_Y]), hypot(x, y), 1e-11);
        CHECK_CLOSE(cos(at.alpha), cos(atan2(y, x)), 1e-10);
        CHECK_CLOSE(sin(at.alpha), sin(atan2(y, x)), 1e-10);
        CHECK_CLOSE(at.state[FST_WZ], 3e-4 * t / (g.inertia * g.eps * g.eps), 1e-10);
    }
    const fst_flow_info back = go_to(flow, 0.0);
    CHECK_CLOSE(back.state[FST_X], 0.3, 1e-9);
    CHECK_CLOSE(back.state[FST_VX], 0.0, 1e-9);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* A spring along one of the magnet's axes: its potential turns with the magnet. */
static fst_status spring(void *user, double t, double phase, const double *state, fst_action *action,
                         fst_error *error)
{
    (void)t, (void)phase, (void)error;
    action->force[0] = -*(const double *)user * (state[FST_X] - 0.4);
    return FST_OK;
}

/* Without friction, E + U - omega L_z is conserved: all potentials turn with the magnet. */
static double jacobi(const fst_model *model, const double *y, double stiffness)
{
    const fst_groups g = fst_model_groups(model);
    const double l_z = y[FST_X] * y[FST_VY] - y[FST_Y] * y[FST_VX] + g.inertia * g.eps * g.eps * y[FST_WZ];
    const double off = y[FST_X] - 0.4;
    return fst_observe(model, y).energy + 0.5 * stiffness * off * off - g.omega * l_z;
}

static void energy_is_kept(void **unused)
{
    (void)unused;
    fst_params params = fst_default_params();
    set(&params, "friction.law", "none");
    fst_model *model = model_of(&params);
    double state[FST_STATE_SIZE], stiffness = 0.05;
    fst_error error;
    assert_int_equal(fst_start_state(&params, model, state, &error), FST_OK);
    const fst_outside outside = {&stiffness, spring};
    fst_flow *flow = flow_with(model, &outside, state);
    const double at_start = jacobi(model, state, stiffness);
    double without = 0.0;
    for (int k = 1; k <= 40; ++k) {
        const fst_flow_info at = go_to(flow, 5.0 * k);
        CHECK_CLOSE(jacobi(model, at.state, stiffness), at_start, 1e-9);
        without = fmax(without, fabs(jacobi(model, at.state, 0.0) - jacobi(model, state, 0.0)));
    }
    assert_true(without > 1e-4); /* the spring took part in it */
    fst_flow_free(flow);
    fst_model_free(model);
}

/* The vertical force takes from the load, and at some time lifts the bead. */
static fst_status lifting(void *user, double t, double phase, const double *state, fst_action *action,
                          fst_error *error)
{
    (void)phase, (void)state, (void)error;
    action->force[2] = *(const double *)user * t;
    return FST_OK;
}

static void a_bead_is_lifted(void **unused)
{
    (void)unused;
    fst_params params;
    fst_model *model = inert(&params);
    double rate = fst_model_groups(model).gravity / 7.5;
    const fst_outside outside = {&rate, lifting};
    const double state[FST_STATE_SIZE] = {0.3, 0.2, 0, 0, 0, 0, 1, 0, 0, 0};
    fst_flow *flow = flow_with(model, &outside, state);
    fst_stop stop;
    fst_error error;
    assert_int_equal(fst_flow_next(flow, 20.0, FST_AT_LIFT_OFF, &stop, &error), FST_OK);
    assert_int_equal(stop, FST_AT_LIFT_OFF);
    CHECK_CLOSE(fst_flow_get(flow).t, 7.5, 1e-10);
    fst_flow_free(flow);
    fst_model_free(model);
}

/* ---------------------------------------------------------------- what goes wrong */

typedef struct trouble {
    fst_status status; /* of calls later than `from`; FST_OK: a NAN instead */
    double from;
    int silent;
} trouble;

static fst_status troubled(void *user, double t, double phase, const double *state, fst_action *action,
                           fst_error *error)
{
    const trouble *of = user;
    (void)phase, (void)state;
    if (t <= of->from)
        return FST_OK;
    action->field[1] = of->status == FST_OK ? NAN : 0.0;
    if (of->status != FST_OK && !of->silent) {
        strcpy(error->where, "my table");
        strcpy(error->sentence, "it ends here");
    }
    return of->status;
}

static void failures_are_told(void **unused)
{
    (void)unused;
    fst_params params;
    fst_model *model = inert(&params);
    const double state[FST_STATE_SIZE] = {0.3, 0.2, 0.1, 0, 0, 0, 1, 0, 0, 0};
    static const struct {
        trouble of;
        fst_status status;
        const char *sentence;
    } cases[] = {{{FST_IO, 3.0, 0}, FST_IO, "it ends here"},
                 {{FST_INTERRUPTED, 3.0, 1}, FST_INTERRUPTED, "the function that acts on the bead ended with"},
                 {{FST_OK, 3.0, 0}, FST_NOT_FINITE, "gave a number that is not finite at t = 3"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        trouble of = cases[i].of;
        const fst_outside outside = {&of, troubled};
        fst_flow *flow = flow_with(model, &outside, state);
        fst_stop stop;
        fst_error error;
        assert_int_equal(fst_flow_next(flow, 10.0, 0, &stop, &error), cases[i].status);
        CHECK_CONTAINS(error.sentence, cases[i].sentence);
        const fst_flow_info at = fst_flow_get(flow);
        assert_true(at.t <= 3.0 && isfinite(at.state[FST_X]));
        assert_int_equal(fst_flow_next(flow, 10.0, 0, &stop, &error), cases[i].status);
        of.from = INFINITY; /* the trouble is over: the flow goes on from where it was */
        const fst_flow_info end = go_to(flow, 10.0);
        CHECK_CLOSE(hypot(end.state[FST_X], end.state[FST_Y]), hypot(1.3, 0.2), 1e-10);
        fst_flow_free(flow);
        of.from = -1.0;
        fst_flow_options o = fst_default_flow_options();
        o.outside = &outside;
        of.status = cases[i].of.status;
        assert_int_equal(fst_flow_new(model, &o, state, &flow, &error), cases[i].status);
        assert_null(flow);
        CHECK_CONTAINS(error.sentence, cases[i].of.status == FST_OK ? "not finite" : cases[i].sentence);
    }
    fst_model_free(model);
}

static void what_it_does_not_go_with(void **unused)
{
    (void)unused;
    static const char *const laws[] = {"coulomb", "rolling"};
    const double state[FST_STATE_SIZE] = {0.3, 0.2, 0, 0, 0, 0, 1, 0, 0, 0};
    int calls = 0;
    const fst_outside outside = {&calls, nothing}, hollow = {NULL, NULL};
    fst_flow_options o = fst_default_flow_options();
    fst_flow *flow;
    fst_error error;
    for (int i = 0; i < 2; ++i) {
        fst_params params = fst_default_params();
        set(&params, "friction.law", laws[i]);
        fst_model *model = model_of(&params);
        o.outside = &outside;
        assert_int_equal(fst_flow_new(model, &o, state, &flow, &error), FST_BAD_INPUT);
        CHECK_CONTAINS(error.sentence, "friction.law viscous or none");
        fst_model_free(model);
    }
    const fst_params params = fst_default_params();
    fst_model *model = model_of(&params);
    o.outside = &hollow;
    assert_int_equal(fst_flow_new(model, &o, state, &flow, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "no function");
    assert_int_equal(calls, 0);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_part_from_outside),      cmocka_unit_test(nothing_changes_nothing),
        cmocka_unit_test(time_and_phase),           cmocka_unit_test(energy_is_kept),
        cmocka_unit_test(a_bead_is_lifted),         cmocka_unit_test(failures_are_told),
        cmocka_unit_test(what_it_does_not_go_with),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
