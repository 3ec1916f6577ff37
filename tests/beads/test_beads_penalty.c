/* Contacts as springs, which need no rule for loads and impacts: made stiffer and extrapolated, they lead to the motion
 * of rigid contacts.
 *
 * tests: beads/look.c beads/hold.c beads/impact.c
 * labels: numbers */
#include "some_beads.h"

#include "beads/act.h"

static const double EPS = 2.5 / 23;
enum { NUMBERS = 2 * FST_BEAD_NUMBERS };

typedef struct spring {
    double stiffness, damping; /* of a contact, over its overlap and over the rate at which that grows */
} spring;

/* The force of a contact's spring, and viscous friction while it presses. */
static void press(const beads_world *world, const spring *of, int k, beads_look *look)
{
    const beads_contact *c = &world->contact[k];
    const double load = -of->stiffness * look->gap[k] - of->damping * look->rate[k];
    double force[3], turning[3];
    if (look->gap[k] >= 0 || load <= 0)
        return;
    for (int m = 0; m < 3; ++m)
        force[m] = -load * look->u[k][m] - c->friction * look->slip[k][m];
    cross(look->u[k], force, turning);
    beads_add(look->force[c->first], 1.0, force);
    beads_add(look->torque[c->first], world->body[c->first].radius, turning);
    if (c->second < 0)
        return;
    beads_add(look->force[c->second], -1.0, force);
    beads_add(look->torque[c->second], world->body[c->second].radius, turning);
}

static void derivatives(const beads_world *world, const spring *of, const double *y, double *dy)
{
    const beads_modes open = {.gone = {0}};
    beads_look look;
    beads_look_at(world, &open, y, &look);
    for (int k = 0; k < world->contacts; ++k) {
        beads_look_at_slip(world, k, y, &look);
        press(world, of, k, &look);
    }
    beads_derivatives(world, &open, &look, y, dy);
}

/* Go on for `time` by steps of Runge and Kutta's classical method. */
static void go_soft(const beads_world *world, const spring *of, double time, int steps, double *y)
{
    static const double node[] = {0, 0.5, 0.5, 1}, weight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const double h = time / steps;
    double k[4][BEADS_DIM], stage[BEADS_DIM] = {0};
    for (int step = 0; step < steps; ++step) {
        for (int s = 0; s < 4; ++s) {
            for (int i = 0; i < NUMBERS; ++i)
                stage[i] = y[i] + (s ? h * node[s] * k[s - 1][i] : 0.0);
            derivatives(world, of, stage, k[s]);
        }
        for (int s = 0; s < 4; ++s)
            for (int i = 0; i < NUMBERS; ++i)
                y[i] += h * weight[s] * k[s][i];
    }
}

/* Errors are a x + b x^2 + ... in x, which halves from each of the three ends to the next: the stiffest comes near, and
 * extrapolated they come much nearer. */
static void check_ends(double ends[3][NUMBERS], const double *rigid, double nearness)
{
    double soft = 0, stiff = 0, extrapolated = 0;
    for (int i = 0; i < NUMBERS; ++i) {
        soft = fmax(soft, fabs(ends[0][i] - rigid[i]));
        stiff = fmax(stiff, fabs(ends[2][i] - rigid[i]));
        extrapolated = fmax(extrapolated, fabs((ends[0][i] - 6 * ends[1][i] + 8 * ends[2][i]) / 3 - rigid[i]));
    }
    CHECK_CLOSE(soft / stiff, 4, 0.4);
    CHECK_CLOSE(extrapolated / stiff, 0, nearness);
}

/* A pair on the plate, across the magnet, with friction at all three contacts: springs begin with the overlaps that carry
 * the loads, and errors are of the order of these, 1/stiffness. */
static void test_lasting(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    const beads_world world = paper_beads(2, model, 1.0);
    double state[NUMBERS] = {0}, ends[3][NUMBERS];
    const double time = 1.0;
    put_pair_across(state, EPS);
    beads_flow *flow = begin_beads(&world, state, 1e-12);
    const double held[3] = {flow->start.held[0], flow->start.held[1], flow->start.held[2]};
    go_to(flow, time);
    assert_int_equal(flow->event_count, 0);
    for (int i = 0; i < 3; ++i) {
        const double stiffness = 5e3 * (1 << i);
        const spring of = {stiffness, 2 * sqrt(stiffness)};
        memcpy(ends[i], state, sizeof state);
        for (int bead = 0; bead < 2; ++bead) {
            bead_of(ends[i], bead)[0] *= 1 - held[2] / stiffness / (2 * EPS);
            bead_of(ends[i], bead)[2] -= held[bead] / stiffness;
        }
        go_soft(&world, &of, time, 1500 << i, ends[i]);
    }
    check_ends(ends, flow->step.y, 0.05);
    free(flow);
    fst_model_free(model);
}

/* Beads that fall together, a little aside and turned, bounce from each other's springs as with a restitution of 1: errors
 * are of the order of the time that this takes, 1/sqrt(stiffness). */
static void test_bounce(void **unused)
{
    (void)unused;
    beads_world world = free_beads(2);
    double state[NUMBERS] = {0}, ends[3][NUMBERS];
    const double before = 0.2, time = 0.6;
    world.restitution = 1.0;
    for (int i = 0; i < 2; ++i) {
        double *bead = bead_of(state, i);
        bead[0] = i ? 0.2 : -0.2;
        bead[1] = i ? 0.03 : -0.01;
        bead[BEADS_V] = i ? -0.4 : 0.3;
        bead[BEADS_N] = cos(0.3);
        bead[BEADS_N + 1] = i ? sin(0.3) : -sin(0.3);
        bead[BEADS_W + 2] = i;
    }
    beads_flow *flow = begin_beads(&world, state, 1e-12);
    go_to(flow, before);
    assert_int_equal(flow->event_count, 0);
    memcpy(state, flow->step.y, sizeof state);
    go_to(flow, time);
    assert_int_equal(flow->event_count, 1);
    for (int i = 0; i < 3; ++i) {
        const spring of = {1e5 * (1 << 2 * i), 0};
        memcpy(ends[i], state, sizeof state);
        go_soft(&world, &of, time - before, 4000 << i, ends[i]);
    }
    check_ends(ends, flow->step.y, 0.05);
    free(flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_lasting), cmocka_unit_test(test_bounce)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
