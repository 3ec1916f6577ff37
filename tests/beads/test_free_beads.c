/* Beads without magnet and plate: motions with exact solutions, forces of rings, and what no contact may change.
 *
 * Angles of a dimer in a plane: th1, th2 of the moments, psi of the axis, all in space; beta = th1 + th2 - 2 psi,
 * delta = th1 - th2, and q = chi/(eps^2 d^3).
 * tests: beads/flow.c beads/look.c beads/linear.c beads/impact.c beads/events.c beads/world.c */
#include "some_beads.h"

static const double EPS = 2.5 / 23;

/* A touching dimer along x whose moments have the angles th1, th2. */
static void dimer(double th1, double th2, double *state)
{
    memset(state, 0, 2 * FST_BEAD_NUMBERS * sizeof *state);
    bead_of(state, 0)[0] = -EPS;
    bead_of(state, 1)[0] = EPS;
    bead_of(state, 0)[BEADS_N] = cos(th1);
    bead_of(state, 0)[BEADS_N + 1] = sin(th1);
    bead_of(state, 1)[BEADS_N] = cos(th2);
    bead_of(state, 1)[BEADS_N + 1] = sin(th2);
}

/* delta'' = -(5/2) q sin delta and, without friction, beta'' = -(21/2) q sin beta: after a period of a pendulum of
 * the amplitude 0.8 everything is as it was, and half way through it is opposite. */
static void test_periods(void **unused)
{
    (void)unused;
    static const struct {
        double th1, th2, period;
    } cases[] = {{0.4, -0.4, 1.2933677528}, {0.4, 0.4, 0.6310988422}};
    const beads_world world = free_beads(2);
    for (int i = 0; i < 2; ++i) {
        double state[2 * FST_BEAD_NUMBERS];
        dimer(cases[i].th1, cases[i].th2, state);
        beads_flow *flow = begin_beads(&world, state, 1e-13);
        go_to(flow, cases[i].period / 2);
        for (int bead = 0; bead < 2; ++bead)
            CHECK_CLOSE(bead_of(flow->step.y, bead)[BEADS_W + 2], 0, 1e-8);
        go_to(flow, cases[i].period);
        CHECK_CLOSE(greatest_difference(flow->step.y, state, 2 * FST_BEAD_NUMBERS), 0, 2e-9);
        free(flow);
    }
}

/* With friction between the beads beta'' + 7 gamma_b beta' + (21/2) q sin beta = 0 relaxes to beta = 0, and from
 * rest psi = -(change of beta)/7. */
static void test_relaxation(void **unused)
{
    (void)unused;
    double state[2 * FST_BEAD_NUMBERS];
    beads_world world = free_beads(2);
    beads_number_contacts(&world, 0.0, 1.0);
    dimer(0.4, 0.4, state);
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    go_to(flow, 20.0);
    const double *n = bead_of(flow->step.y, 0) + BEADS_N;
    double axis[3];
    beads_way(&world, flow->step.y, 0, 1, axis);
    CHECK_CLOSE(atan2(axis[1], axis[0]), 0.8 / 7, 1e-11);
    CHECK_CLOSE(atan2(n[1], n[0]), 0.8 / 7, 1e-11);
    free(flow);
}

/* The contact force is (chi/d^4) (3/2) (cos delta + 3 cos beta) - (d/2) psi'^2, psi' being the rate at which the axis
 * turns; so at rest the pair parts beyond 109.471 degrees of beta. */
static void test_contact_force(void **unused)
{
    (void)unused;
    const beads_world world = free_beads(2);
    const double d = 2 * EPS, degree = TURN / 360;
    for (double beta = 0; beta < 180; beta += 7)
        for (double delta = 0, turning = 0; delta < 90; delta += 40, turning += 2) {
            double state[2 * FST_BEAD_NUMBERS];
            const double force = CHI / pow(d, 4) * 1.5 * (cos(delta * degree) + 3 * cos(beta * degree)) -
                                 d / 2 * turning * turning;
            dimer((beta + delta) / 2 * degree, (beta - delta) / 2 * degree, state);
            for (int i = 0; i < 2; ++i)
                bead_of(state, i)[BEADS_V + 1] = turning * bead_of(state, i)[0];
            beads_flow *flow = begin_beads(&world, state, 1e-10);
            assert_int_equal(flow->modes.contact[2], force > 0 ? BEADS_PRESSING : BEADS_OPEN);
            CHECK_CLOSE(flow->start.held[2], force > 0 ? force : 0, 1e-14);
            free(flow);
        }
    double state[2 * FST_BEAD_NUMBERS];
    for (int over = 0; over < 2; ++over) {
        dimer((over ? 54.7357 : 54.7355) * degree, (over ? 54.7357 : 54.7355) * degree, state);
        beads_flow *flow = begin_beads(&world, state, 1e-10);
        assert_int_equal(flow->modes.contact[2], over ? BEADS_OPEN : BEADS_PRESSING);
        free(flow);
    }
}

/* Two beads, moments along the axis, fall from the distance 1 and bounce. */
static void test_axial_fall(void **unused)
{
    (void)unused;
    double state[2 * FST_BEAD_NUMBERS];
    beads_world world = free_beads(2);
    world.restitution = 0.5;
    dimer(0, 0, state);
    bead_of(state, 0)[0] = -0.5;
    bead_of(state, 1)[0] = 0.5;
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    const double start = beads_energy_now(flow);
    go_to(flow, 7.6);
    assert_true(flow->counts[FST_BEAD_EVENT_TOUCH] >= 2);
    CHECK_CLOSE(flow->events[0].time, 7.40074790844, 1e-10);
    CHECK_CLOSE(flow->events[0].speed, 0.97875695860, 1e-10);
    CHECK_CLOSE(flow->events[1].time, 7.5892800467, 1e-9);
    CHECK_CLOSE(flow->events[1].speed, 0.97875695860 / 2, 1e-10);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-12);
    go_to(flow, 9.0); /* the bounces have ended, and the pair is at rest */
    assert_int_equal(flow->modes.contact[2], BEADS_PRESSING);
    CHECK_CLOSE(flow->impacts, start - beads_energy_now(flow), 1e-12);
    free(flow);
}

/* Rings: energy, and the contact force 3 |U|/(N d). */
static void test_rings(void **unused)
{
    (void)unused;
    static const struct {
        int count;
        double energy, force;
    } cases[] = {{4, -0.81148378, 2.79961905}, {6, -1.49038362, 3.42788232}};
    for (int i = 0; i < 2; ++i) {
        const int count = cases[i].count;
        const beads_world world = free_beads(count);
        double state[BEADS_NUMBERS] = {0};
        for (int k = 0; k < count; ++k) {
            const double angle = TURN * k / count, radius = EPS / sin(TURN / 2 / count);
            bead_of(state, k)[0] = radius * cos(angle);
            bead_of(state, k)[1] = radius * sin(angle);
            bead_of(state, k)[BEADS_N] = -sin(angle);
            bead_of(state, k)[BEADS_N + 1] = cos(angle);
        }
        beads_flow *flow = begin_beads(&world, state, 1e-10);
        CHECK_CLOSE(beads_energy_now(flow), cases[i].energy, 5e-9);
        int closed = 0;
        for (int k = count; k < world.contacts; ++k)
            if (flow->modes.contact[k] == BEADS_PRESSING) {
                ++closed;
                CHECK_CLOSE(flow->start.held[k], cases[i].force, 5e-9);
                CHECK_CLOSE(flow->start.held[k], -3 * cases[i].energy / (count * 2 * EPS), 2e-7);
            }
        assert_int_equal(closed, count);
        free(flow);
    }
}

/* A flat hexagon of seven beads has twelve contacts in the plane's eleven directions of change: loads are not unique,
 * accelerations are. */
static void test_redundant_contacts(void **unused)
{
    (void)unused;
    beads_world world = free_beads(7);
    world.plate = 0.5;
    world.gravity = 4.3676e-3;
    beads_number_contacts(&world, 1.0, 1.0);
    double state[BEADS_NUMBERS] = {0}, turned[BEADS_NUMBERS] = {0};
    for (int k = 0; k < 7; ++k) {
        const double angle = TURN * k / 6, radius = k < 6 ? 2 * EPS : 0;
        double *bead = bead_of(state, k);
        bead[0] = radius * cos(angle);
        bead[1] = radius * sin(angle);
        bead[BEADS_N] = k < 6 ? -sin(angle) : 0;
        bead[BEADS_N + 1] = k < 6 ? cos(angle) : 0;
        bead[BEADS_N + 2] = k < 6 ? 0 : 1;
        memcpy(bead_of(turned, (k + 3) % 7), bead, FST_BEAD_NUMBERS * sizeof *bead);
    }
    beads_flow *flow = begin_beads(&world, state, 1e-10), *other = begin_beads(&world, turned, 1e-10);
    assert_int_equal(flow->start.unique, 0);
    for (int k = 0; k < 7; ++k)
        for (int m = 0; m < 3; ++m)
            CHECK_CLOSE(flow->start.force[k][m], other->start.force[(k + 3) % 7][m], 1e-11);
    for (int k = 0; k < world.contacts; ++k)
        if (flow->modes.contact[k] != BEADS_OPEN)
            CHECK_CLOSE(beads_bend_of_gap(&world, &flow->start, k), 0, 1e-11);
    free(other);
    free(flow);
}

/* Five beads in a loose ring fall together and collide, with restitution and friction: momentum and angular momentum
 * stay, energy goes where it is told, no contact gives energy. */
static void test_what_is_kept(void **unused)
{
    (void)unused;
    beads_world world = free_beads(5);
    world.restitution = 0.4;
    beads_number_contacts(&world, 0.0, 1.0);
    double state[BEADS_NUMBERS] = {0}, before[6] = {0}, after[6] = {0}, moment[3];
    for (int k = 0; k < 5; ++k) {
        double *bead = bead_of(state, k);
        for (int m = 0; m < 3; ++m) {
            bead[m] = m < 2 ? 0.3 * sin(TURN * (k / 5.0 + m / 4.0)) + 0.03 * sin(7 * k + m) : 0.1 * cos(2 * k);
            bead[BEADS_V + m] = 0.02 * cos(2 + 5 * k + 2.3 * m);
            bead[BEADS_N + m] = sin(3 + 4 * k + 1.3 * m);
            bead[BEADS_W + m] = cos(4 + 3 * k + 2.7 * m);
        }
        const double norm = sqrt(dot(bead + BEADS_N, bead + BEADS_N));
        for (int m = 0; m < 3; ++m)
            bead[BEADS_N + m] /= norm;
    }
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    const double start = beads_energy_now(flow);
    double loss = 0, impacts = 0;
    fst_error error;
    while (flow->t.high < 6.0) {
        if (beads_go(flow, 6.0, &error) != FST_OK)
            fail_msg("beads_go: %s", error.sentence);
        const double now = bead_of(flow->step.y, 5)[BEADS_PAIR];
        assert_true(now >= loss - 1e-15 && flow->impacts >= impacts - 1e-14);
        for (int k = 0; k < world.contacts; ++k)
            if (flow->modes.contact[k] != BEADS_OPEN)
                assert_true(dot(flow->start.friction[k], flow->start.slip[k]) <= 0);
        loss = now;
        impacts = flow->impacts;
    }
    for (int k = 0; k < 5; ++k)
        for (int m = 0; m < 2; ++m) {
            double *bead = bead_of(m ? flow->step.y : state, k), *sum = m ? after : before;
            cross(bead, bead + BEADS_V, moment);
            for (int i = 0; i < 3; ++i) {
                sum[i] += bead[BEADS_V + i];
                sum[3 + i] += moment[i] + 0.4 * EPS * EPS * bead[BEADS_W + i];
            }
        }
    assert_true(flow->counts[FST_BEAD_EVENT_TOUCH] >= 4);
    CHECK_CLOSE(greatest_difference(after, before, 6), 0, 1e-13);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-12);
    free(flow);
}

/* A bead at the speed V against a touching pair: ((1 + e)/3, (1 + e)/3, (1 - 2 e)/3) V. */
static void test_no_cradle(void **unused)
{
    (void)unused;
    for (double e = 0; e <= 1; e += 0.25) {
        beads_world world = free_beads(3);
        double state[BEADS_NUMBERS] = {0};
        world.restitution = e;
        for (int k = 0; k < 3; ++k) {
            world.body[k].dipole = 0;
            bead_of(state, k)[0] = 2 * EPS * k + (k == 2 ? 0.1 : 0);
            bead_of(state, k)[BEADS_N] = 1;
        }
        bead_of(state, 2)[BEADS_V] = -0.5;
        beads_flow *flow = begin_beads(&world, state, 1e-12);
        const double start = beads_energy_now(flow);
        go_to(flow, 0.21);
        CHECK_CLOSE(bead_of(flow->step.y, 0)[BEADS_V], -0.5 * (1 + e) / 3, 1e-13);
        CHECK_CLOSE(bead_of(flow->step.y, 1)[BEADS_V], -0.5 * (1 + e) / 3, 1e-13);
        CHECK_CLOSE(bead_of(flow->step.y, 2)[BEADS_V], -0.5 * (1 - 2 * e) / 3, 1e-13);
        CHECK_CLOSE(flow->impacts, (1 - e * e) * 0.25 / 3, 1e-14);
        CHECK_CLOSE(beads_residual(flow, start), 0, 1e-15);
        free(flow);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_periods),       cmocka_unit_test(test_relaxation),
        cmocka_unit_test(test_contact_force), cmocka_unit_test(test_axial_fall),
        cmocka_unit_test(test_rings),         cmocka_unit_test(test_redundant_contacts),
        cmocka_unit_test(test_what_is_kept),  cmocka_unit_test(test_no_cradle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
