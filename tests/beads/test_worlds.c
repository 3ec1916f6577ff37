/* A bead in a medium, in a bowl, and without a plate above or below a tilted turning magnet: exact motions, numbers of
 * an independent program in the laboratory's frame, and the balance of energy.
 *
 * tests: model/worlds.c beads/world.c beads/look.c beads/events.c */
#include <complex.h>

#include "levitators.h"
#include "some_beads.h"

static const double EPS = 2.5 / 23;

/* One bead at rest in space, without a magnet. */
static beads_world one_bead(double *state)
{
    beads_world world = free_beads(1);
    memset(state, 0, FST_BEAD_NUMBERS * sizeof *state);
    state[BEADS_N] = 1.0;
    return world;
}

/* Linear drag and spin drag are exponentials, quadratic drag alone v0/(1 + c_q v0 t), also seen from a turning frame. */
static void test_drags(void **unused)
{
    (void)unused;
    double state[FST_BEAD_NUMBERS];
    beads_world world = one_bead(state);
    world.omega = 0.7;
    world.body[0].added = 0.25;
    world.body[0].drag = 0.3 * 1.25;
    world.body[0].spin_drag = 0.2 * world.body[0].inertia;
    state[BEADS_V] = 0.5;
    state[BEADS_V + 2] = -0.25;
    state[BEADS_W + 1] = 2.0;
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    const double start = beads_energy_now(flow);
    go_to(flow, 3.0);
    const double turned[2] = {cos(0.7 * 3), -sin(0.7 * 3)};
    for (int m = 0; m < 2; ++m) {
        CHECK_CLOSE(flow->step.y[BEADS_V + m], 0.5 * exp(-0.9) * turned[m], 1e-12);
        CHECK_CLOSE(flow->step.y[m], 0.5 / 0.3 * (1 - exp(-0.9)) * turned[m], 1e-12);
    }
    CHECK_CLOSE(flow->step.y[BEADS_V + 2], -0.25 * exp(-0.9), 1e-12);
    CHECK_CLOSE(flow->step.y[BEADS_W + 1], 2 * exp(-0.6) * turned[0], 1e-12);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-13);
    free(flow);

    world.body[0] = (beads_body){.radius = EPS, .mass = 1, .inertia = 1, .fast_drag = 0.8};
    beads_number_contacts(&world, 0.0, 0.0);
    flow = begin_beads(&world, state, 1e-13);
    go_to(flow, 3.0);
    const double v0 = sqrt(0.25 + 0.0625), v = v0 / (1 + 0.8 * v0 * 3);
    CHECK_CLOSE(sqrt(dot(flow->step.y + BEADS_V, flow->step.y + BEADS_V)), v, 1e-12);
    free(flow);
}

/* A heavy bead sinks with g (m - m_f)/(m + m_added), and ends at the weight over the drag. */
static void test_buoyancy(void **unused)
{
    (void)unused;
    double state[FST_BEAD_NUMBERS];
    beads_world world = one_bead(state);
    world.gravity = 0.01;
    world.body[0].displaced = 0.4;
    world.body[0].added = 0.2;
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    const double start = beads_energy_now(flow);
    go_to(flow, 5.0);
    CHECK_CLOSE(flow->step.y[BEADS_V + 2], -0.01 * 0.6 / 1.2 * 5, 1e-14);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-14);
    free(flow);
    world.body[0].drag = 0.5;
    flow = begin_beads(&world, state, 1e-13);
    go_to(flow, 100.0);
    CHECK_CLOSE(flow->step.y[BEADS_V + 2], -0.01 * 0.6 / 0.5, 1e-14);
    free(flow);
}

/* ------------------------------------------------------------------ a bowl */

static beads_world in_bowl(double friction, double *state)
{
    beads_world world = one_bead(state);
    world.plate = 0.0;
    world.bowl = 2.0;
    world.gravity = 0.02;
    beads_number_contacts(&world, friction, 0.0);
    return world;
}

/* Without friction a bead goes round as a conical pendulum, w^2 = g/(rho cos theta), at any height. */
static void test_conical_pendulum(void **unused)
{
    (void)unused;
    double state[FST_BEAD_NUMBERS];
    const beads_world world = in_bowl(0.0, state);
    const double rho = 2.0 - EPS, theta = 1.0, w = sqrt(0.02 / (rho * cos(theta)));
    state[0] = rho * sin(theta);
    state[2] = rho * (1 - cos(theta));
    state[BEADS_V + 1] = w * state[0];
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    go_to(flow, 100.0);
    CHECK_CLOSE(flow->step.y[0], state[0] * cos(100 * w), 1e-11);
    CHECK_CLOSE(flow->step.y[1], state[0] * sin(100 * w), 1e-11);
    CHECK_CLOSE(flow->step.y[2], state[2], 1e-12);
    CHECK_CLOSE(flow->step.y[FST_BEAD_NUMBERS + BEADS_HEIGHT], 100 * state[2], 1e-10);
    CHECK_CLOSE(flow->start.held[0], 0.02 / cos(theta), 1e-12);
    free(flow);
}

/* x + i y of a bead that rolls near the bottom with the spin S from rest: (M + beta) w^2 + beta eps S w/rho = g/rho. */
static double complex rolled(double moved, double spin, double x0, double t)
{
    const double rho = 2.0 - EPS, half = -0.4 * EPS * spin / (2 * rho * (moved + 0.4));
    const double root = sqrt(half * half + 0.02 / (rho * (moved + 0.4))), up = half + root, down = half - root;
    return x0 * (down * cexp(I * up * t) - up * cexp(I * down * t)) / (down - up);
}

/* Where a bead ends at small slips: friction c is rolling but for terms of 1/c and their squares. */
static double complex end_in_bowl(double friction, double added, double spin, double *spin_left)
{
    double state[FST_BEAD_NUMBERS];
    beads_world world = in_bowl(friction, state);
    world.body[0].added = added;
    beads_number_contacts(&world, friction, 0.0);
    const double rho = 2.0 - EPS;
    state[0] = 0.002;
    state[2] = rho - sqrt(rho * rho - state[0] * state[0]);
    state[BEADS_W] = -spin * state[0] / rho;
    state[BEADS_W + 2] = spin * (rho - state[2]) / rho;
    beads_flow *flow = begin_beads(&world, state, 1e-11);
    go_to(flow, 100.0);
    const double *y = flow->step.y, e[3] = {-y[0] / rho, -y[1] / rho, (rho - y[2]) / rho};
    *spin_left = dot(e, y + BEADS_W);
    const double complex end = y[0] + I * y[1];
    free(flow);
    return end;
}

static void test_rolling_in_a_bowl(void **unused)
{
    (void)unused;
    static const struct {
        double added, spin;
    } cases[] = {{0, 0}, {0.5, 0}, {0, 3}, {0.5, -2}};
    for (int i = 0; i < 4; ++i) {
        double spin[2];
        const double complex one = end_in_bowl(50, cases[i].added, cases[i].spin, &spin[0]);
        const double complex two = end_in_bowl(100, cases[i].added, cases[i].spin, &spin[1]);
        const double complex exact = rolled(1 + cases[i].added, cases[i].spin, 0.002, 100);
        CHECK_CLOSE(cabs(2 * two - one - exact), 0, 2e-4 * 0.002);
        CHECK_CLOSE(2 * spin[1] - spin[0], cases[i].spin, 1e-6);
    }
}

/* A bead falls into a bowl beside its middle and bounces. */
static void test_fall_into_a_bowl(void **unused)
{
    (void)unused;
    double state[FST_BEAD_NUMBERS];
    beads_world world = in_bowl(1.0, state);
    world.restitution = 0.7;
    world.body[0].fast_drag = 0.1;
    const double rho = 2.0 - EPS, wall = rho - sqrt(rho * rho - 1.0);
    state[0] = 1.0;
    state[2] = wall + 0.2;
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    const double start = beads_energy_now(flow);
    go_to(flow, 400.0);
    assert_int_equal(flow->events[0].kind, FST_BEAD_EVENT_LAND);
    assert_int_equal(flow->modes.contact[0], BEADS_PRESSING);
    const double *y = flow->step.y, d[3] = {y[0], y[1], y[2] - rho};
    CHECK_CLOSE(sqrt(dot(d, d)), rho, 1e-13);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-12);
    free(flow);
}

/* ------------------------------------------------------------------ no plate */

/* The world of a model without plate and gravity, with drags per second. */
static beads_world levitation(const fst_model *model, double drag, double spin_drag)
{
    const fst_groups g = fst_model_groups(model);
    beads_world world = paper_beads(1, model, 0.0);
    world.plate = NAN;
    world.clearance = beads_model_clearance;
    world.gravity = 0.0;
    world.body[0].radius = g.eps;
    world.body[0].inertia = g.inertia * g.eps * g.eps;
    world.body[0].drag = drag * g.time_unit;
    world.body[0].spin_drag = spin_drag * g.time_unit * world.body[0].inertia;
    return world;
}

/* At rest on the axis with n upwards, `height` mm over the magnet. */
static beads_flow *let_go(const beads_world *world, const fst_model *model, double height)
{
    double state[FST_BEAD_NUMBERS] = {0};
    state[2] = 1e-3 * height / fst_model_groups(model).length_unit;
    state[BEADS_N + 2] = 1.0;
    return begin_beads(world, state, 1e-10);
}

/* The places where the bead comes to rest in the turning frame. */
static void test_levitation(void **unused)
{
    (void)unused;
    static const struct {
        double weight, height, tilt, circle;
    } cases[] = {{0, 23.772, NAN, NAN}, {-1, 25.056, 6.35, 0.210}, {1, 23.021, NAN, NAN}};
    const fst_params p = rotor_and_floater("5 deg");
    fst_model *model = model_of(&p);
    const fst_groups g = fst_model_groups(model);
    for (int i = 0; i < 3; ++i) {
        beads_world world = levitation(model, 10, 10);
        world.gravity = cases[i].weight * g.gravity;
        beads_flow *flow = let_go(&world, model, cases[i].height);
        const double start = beads_energy_now(flow);
        go_to(flow, 3 / g.time_unit);
        world.body[0].drag *= 0.1; /* with weaker damping, to where that puts it */
        world.body[0].spin_drag *= 0.1;
        beads_flow *slow = begin_beads(&world, flow->step.y, 1e-10);
        go_to(slow, 20 / g.time_unit);
        const double *y = slow->step.y, mm = 1e3 * g.length_unit;
        CHECK_CLOSE(y[2] * mm, cases[i].height, 5.1e-4);
        if (!isnan(cases[i].tilt)) {
            CHECK_CLOSE(acos(y[BEADS_N + 2]) * 360 / TURN, cases[i].tilt, 5.1e-3);
            CHECK_CLOSE(hypot(y[0], y[1]) * mm, cases[i].circle, 5.1e-4);
        }
        CHECK_CLOSE(beads_residual(flow, start), 0, 1e-9 * fabs(flow->step.y[FST_BEAD_NUMBERS + BEADS_DRIVE]));
        free(slow);
        free(flow);
    }
    fst_model_free(model);
}

/* Let go at rest below, n upwards: with drags of 3/s it is lost or touches; with 10/s it stays. */
static void test_how_it_ends(void **unused)
{
    (void)unused;
    const fst_params p = rotor_and_floater("5 deg");
    fst_model *model = model_of(&p);
    const fst_groups g = fst_model_groups(model);
    for (int stays = 0; stays < 2; ++stays) {
        beads_world world = levitation(model, stays ? 10 : 3, stays ? 10 : 3);
        world.gravity = -g.gravity;
        beads_flow *flow = let_go(&world, model, 25.056);
        go_to(flow, 5 / g.time_unit);
        assert_int_equal(flow->modes.gone[0], !stays);
        if (!stays) {
            const double *y = flow->step.y, mm = 1e3 * g.length_unit, r = sqrt(dot(y, y)) * mm;
            int at_magnet;
            (void)beads_way_out(&world, 0, y, &at_magnet);
            CHECK_CLOSE(r, at_magnet ? 9.5 + 6.35 : g.plate_radius * mm, 1e-9);
        }
        free(flow);
    }
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_drags),
        cmocka_unit_test(test_buoyancy),
        cmocka_unit_test(test_conical_pendulum),
        cmocka_unit_test(test_rolling_in_a_bowl),
        cmocka_unit_test(test_fall_into_a_bowl),
        cmocka_unit_test(test_levitation),
        cmocka_unit_test(test_how_it_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
