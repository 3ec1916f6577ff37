/* Stops where a contact begins to stick or to slip, a bead leaves or touches the plate, comes to rest or rolls:
 * they do not disturb the motion, come in order, each once, wherever the caller stopped before.
 * tests: ode/contact.c ode/advance.c model/disc.c */
#include "physics.h"

#include "ode/flow.h"

static const unsigned modes =
    FST_AT_LEAVE | FST_AT_TOUCH | FST_AT_STICK | FST_AT_SLIP | FST_AT_REST | FST_AT_ROLL;

enum { LEAST = 3, MOST = 400 };

static fst_flow *begun(const fst_params *p)
{
    double start[FST_STATE_SIZE];
    fst_model *model = model_of(p);
    start_of(p, model, start);
    fst_flow *flow = flow_of(model, 1e-12, start);
    fst_model_free(model);
    return flow;
}

static fst_params dry_bead(double omega)
{
    fst_params p = bead_at(omega, FST_DYNAMICS_RIGID);
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = 0.2;
    return p;
}

/* What is told is so. */
static void check_told(const fst_flow *flow, fst_stop stop)
{
    const fst_flow_info is = fst_flow_get(flow);
    assert_true(stop != FST_AT_STICK || is.sticks);
    assert_true(stop != FST_AT_SLIP || (!is.sticks && !is.flies));
    assert_true(stop != FST_AT_LEAVE || is.flies);
    assert_true(stop != FST_AT_REST || is.rests);
    assert_true(stop != FST_AT_ROLL || !is.rests);
}

/* The flow goes on to `end`; the stops on its way and their times.  Returns how many there were. */
static int stops_of(fst_flow *flow, double end, unsigned events, fst_stop *stops, double *times)
{
    double last = 0;
    for (int i = 0; i < MOST; ++i) {
        stops[i] = advance_to(flow, end, events);
        times[i] = fst_flow_get(flow).t;
        if (stops[i] == FST_AT_TIME)
            return i;
        assert_true(times[i] >= last);
        last = times[i];
        check_told(flow, stops[i]);
    }
    fail_msg("more than %d stops", MOST);
    return 0;
}

/* With and without stops: the same bits after the same work; each of `kinds` came `least` times. */
static void check_undisturbed(const fst_params *p, double end, unsigned kinds)
{
    static fst_stop stops[MOST];
    static double times[MOST];
    fst_flow *stopped = begun(p), *whole = begun(p);
    const int count = stops_of(stopped, end, modes | FST_AT_SECTION, stops, times);
    assert_int_equal(advance_to(whole, end, 0), FST_AT_TIME);
    const fst_flow_info a = fst_flow_get(stopped), b = fst_flow_get(whole);
    assert_memory_equal(a.state, b.state, sizeof a.state);
    CHECK_SAME_BITS(a.bead_angle, b.bead_angle);
    assert_true(a.rhs_calls == b.rhs_calls && a.accepted == b.accepted && a.rejected == b.rejected);
    for (unsigned kind = 1; kind <= kinds; kind *= 2) {
        int told = 0;
        for (int i = 0; i < count; ++i)
            told += stops[i] == kind;
        if ((kinds & kind) && told < LEAST)
            fail_msg("event %u was told %d times", kind, told);
    }
    fst_flow_free(stopped);
    fst_flow_free(whole);
}

static void test_undisturbed(void **unused)
{
    (void)unused;
    const unsigned slip = FST_AT_SECTION | FST_AT_STICK | FST_AT_SLIP;
    fst_params p = dry_bead(0.215);
    check_undisturbed(&p, 100, slip);
    p.friction_mu_static = 0.25;
    check_undisturbed(&p, 100, slip);
    p.friction_mu_static = NAN;
    p.contact_patch = FST_PATCH_HERTZ;
    p.contact_radius = 0.02 * p.bead_radius;
    check_undisturbed(&p, 100, FST_AT_SECTION);
    p = dry_bead(0.02);
    p.friction_rolling_resistance = 0.02;
    check_undisturbed(&p, 200, FST_AT_STICK | FST_AT_SLIP | FST_AT_REST | FST_AT_ROLL);
}

/* A disc that is held knows static friction alone: sliding friction has no part in when it lets go, and weaker
 * static friction lets go earlier. */
static void test_a_held_disc_lets_go(void **unused)
{
    (void)unused;
    static const double sliding[] = {0.2, 0.4, 0.2}, holding[] = {0.4, 0.4, 0.2};
    fst_flow_info at[3];
    for (int i = 0; i < 3; ++i) {
        fst_params p = dry_bead(0.04);
        p.friction_mu = sliding[i];
        p.friction_mu_static = holding[i];
        p.contact_patch = FST_PATCH_HERTZ;
        p.contact_radius = 2e-4;
        fst_flow *flow = begun(&p);
        assert_true(fst_flow_get(flow).sticks);
        assert_int_equal(advance_to(flow, 60, FST_AT_SLIP), FST_AT_SLIP);
        at[i] = fst_flow_get(flow);
        fst_flow_free(flow);
    }
    CHECK_CLOSE(at[0].t, at[1].t, 1e-9);
    CHECK_CLOSE(greatest_difference(at[0].state, at[1].state, FST_STATE_SIZE), 0, 1e-9);
    assert_true(at[2].t > 0 && at[2].t < 0.9 * at[0].t);
}

/* A caller who lands just on an event is told of it, then or by the next call, and of each only once. */
static void test_landing_on_events(void **unused)
{
    (void)unused;
    const fst_params p = dry_bead(0.225);
    static fst_stop stops[MOST];
    static double times[MOST];
    fst_flow *flow = begun(&p);
    const int count = stops_of(flow, 60, modes, stops, times);
    assert_true(count >= 8);
    fst_flow_free(flow);
    flow = begun(&p);
    int at_once = 0;
    for (int i = 0; i < count; ++i) {
        fst_stop stop = advance_to(flow, times[i], modes);
        at_once += stop != FST_AT_TIME;
        if (stop == FST_AT_TIME) {
            assert_true(fst_flow_get(flow).t == times[i]);
            stop = advance_to(flow, times[i] + 1e-6, modes);
        }
        assert_int_equal(stop, stops[i]);
        CHECK_CLOSE(fst_flow_get(flow).t, times[i], 1e-9);
    }
    assert_int_equal(advance_to(flow, 60, modes), FST_AT_TIME);
    assert_true(at_once > 0);
    fst_flow_free(flow);
}

/* An event that nobody asked for has not begun at the end of the way, where another one is asked for. */
static void test_what_was_not_asked_for(void **unused)
{
    (void)unused;
    const fst_params p = dry_bead(0.215);
    fst_flow *sticks = begun(&p), *lands = begun(&p), *asks = begun(&p);
    assert_int_equal(advance_to(sticks, 60, FST_AT_STICK), FST_AT_STICK);
    const double t = fst_flow_get(sticks).t;
    assert_int_equal(advance_to(lands, t, 0), FST_AT_TIME);
    assert_int_equal(advance_to(asks, t, FST_AT_LEAVE | FST_AT_TOUCH), FST_AT_TIME);
    const fst_flow_info a = fst_flow_get(lands), b = fst_flow_get(asks);
    assert_memory_equal(a.state, b.state, sizeof a.state);
    assert_int_equal(a.sticks, b.sticks);
    fst_flow_free(sticks);
    fst_flow_free(lands);
    fst_flow_free(asks);
}

/* Time does not run back to before a stop; and after that is refused the motion goes on. */
static void test_no_way_back(void **unused)
{
    (void)unused;
    const fst_params p = dry_bead(0.215);
    fst_flow *flow = begun(&p), *whole = begun(&p);
    fst_stop stop;
    assert_int_equal(advance_to(flow, 60, FST_AT_STICK), FST_AT_STICK);
    assert_int_equal(fst_flow_next(flow, 0.1, modes, &stop, NULL), FST_BAD_INPUT);
    assert_int_equal(advance_to(flow, 60, 0), FST_AT_TIME);
    assert_int_equal(advance_to(whole, 60, 0), FST_AT_TIME);
    const fst_flow_info a = fst_flow_get(flow), b = fst_flow_get(whole);
    assert_memory_equal(a.state, b.state, sizeof a.state);
    fst_flow_free(flow);
    fst_flow_free(whole);
}

/* Laws without modes have no such events. */
static void test_laws_without_modes(void **unused)
{
    (void)unused;
    static const fst_friction_law laws[] = {FST_FRICTION_VISCOUS, FST_FRICTION_NONE, FST_FRICTION_ROLLING};
    for (int i = 0; i < 3; ++i) {
        fst_params p = bead_at(0.215, FST_DYNAMICS_RIGID);
        p.friction_law = (int)laws[i];
        fst_flow *flow = begun(&p);
        assert_int_equal(advance_to(flow, 30, modes), FST_AT_TIME);
        const fst_flow_info info = fst_flow_get(flow);
        assert_int_equal(info.sticks, laws[i] == FST_FRICTION_ROLLING);
        assert_true(!info.flies && !info.rests);
        fst_flow_free(flow);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_undisturbed),       cmocka_unit_test(test_a_held_disc_lets_go),
        cmocka_unit_test(test_landing_on_events), cmocka_unit_test(test_what_was_not_asked_for),
        cmocka_unit_test(test_no_way_back),       cmocka_unit_test(test_laws_without_modes),
    };
    return cmocka_run_group_tests_name("dry_stops", tests, NULL, NULL);
}
