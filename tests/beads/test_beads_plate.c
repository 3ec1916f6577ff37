/* Several beads on the plate above the magnet: against numbers of an independent program, single beads, symmetries,
 * and the balance of energy.
 *
 * tests: beads/flow.c beads/look.c beads/select.c beads/impact.c beads/events.c beads/world.c */
#include "some_beads.h"

static const double EPS = 2.5 / 23, PERIOD = 312.5 / 30;

/* Two beads as their rolling starts at r = 0.95 and these angles say. */
static beads_world two_beads(const fst_params *params, const fst_model *model, double phi_0, double phi_1,
                             double *state)
{
    place_bead(*params, model, phi_0, bead_of(state, 0));
    place_bead(*params, model, phi_1, bead_of(state, 1));
    return paper_beads(2, model, 1.0);
}

/* 30 Hz, Phi = 3 and 183 degrees, five turns. */
static void test_apart(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS];
    const beads_world world = two_beads(&params, model, 3, 183, state);
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    const double start = beads_energy_now(flow);
    go_to(flow, 5 * PERIOD);
    CHECK_CLOSE(flow->step.y[0], -0.541044064192, 2e-12);
    CHECK_CLOSE(flow->step.y[1], 0.754309504732, 2e-12);
    CHECK_CLOSE(flow->step.y[2 * FST_BEAD_NUMBERS + BEADS_DRIVE], 0.1097335825, 1e-10);
    CHECK_CLOSE(bead_of(flow->step.y, 1)[0], 0.541044064192, 2e-12);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-13);
    free(flow);
    fst_model_free(model);
}

/* 30 Hz, Phi = 3 and 53 degrees: the pair snaps together. */
static void test_snap(void **unused)
{
    (void)unused;
    static const struct {
        fst_bead_event_kind kind;
        int first, second;
        double time;
    } expected[] = {{FST_BEAD_EVENT_LIFT, 1, -1, 18.133451},  {FST_BEAD_EVENT_TOUCH, 0, 1, 18.937630601},
                    {FST_BEAD_EVENT_LIFT, 0, -1, 19.023942},  {FST_BEAD_EVENT_LAND, 0, -1, 19.235220},
                    {FST_BEAD_EVENT_GRAZE, 0, -1, 19.503707}, {FST_BEAD_EVENT_LIFT, 0, -1, 19.515305}};
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS];
    const beads_world world = two_beads(&params, model, 3, 53, state);
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    const double start = beads_energy_now(flow);
    go_to(flow, 2 * PERIOD);
    assert_int_equal(flow->event_count, 6);
    for (int i = 0; i < 6; ++i) {
        assert_int_equal(flow->events[i].kind, expected[i].kind);
        assert_int_equal(flow->events[i].beads[0], expected[i].first);
        assert_int_equal(flow->events[i].beads[1], expected[i].second);
        CHECK_CLOSE(flow->events[i].time, expected[i].time, i == 1 ? 2e-9 : 5.1e-7);
    }
    CHECK_CLOSE(flow->events[1].speed, 0.693348445, 1e-9);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-12);
    free(flow);
    fst_model_free(model);
}

/* Numbers of a state as another: the mirror (x, v, n, W, omega) -> (M x, M v, M n, -M W, -omega), M = diag(1, -1, 1).
 */
static void mirror(const double *state, int count, double *image)
{
    static const double sign[FST_BEAD_NUMBERS] = {1, -1, 1, 1, -1, 1, 1, -1, 1, -1, 1, -1};
    for (int i = 0; i < count * FST_BEAD_NUMBERS; ++i)
        image[i] = sign[i % FST_BEAD_NUMBERS] * state[i];
}

/* Exchanged beads, the mirror, and the half turn of the magnet S2 give exchanged and mirrored motions, through a snap.
 */
static void test_symmetries(void **unused)
{
    (void)unused;
    static const double half_turn[FST_BEAD_NUMBERS] = {-1, -1, 1, -1, -1, 1, 1, 1, -1, -1, -1, 1};
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS], image[BEADS_NUMBERS], end[BEADS_NUMBERS];
    const beads_world world = two_beads(&params, model, 3, 53, state);
    enum { NUMBERS = 2 * FST_BEAD_NUMBERS };
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    go_to(flow, 19.1);

    memcpy(bead_of(image, 0), bead_of(state, 1), sizeof(double[FST_BEAD_NUMBERS]));
    memcpy(bead_of(image, 1), bead_of(state, 0), sizeof(double[FST_BEAD_NUMBERS]));
    beads_flow *other = begin_beads(&world, image, 1e-13);
    go_to(other, 19.1);
    for (int i = 0; i < 2; ++i)
        CHECK_CLOSE(
            greatest_difference(bead_of(other->step.y, i), bead_of(flow->step.y, 1 - i), FST_BEAD_NUMBERS), 0,
            2e-12);
    free(other);

    beads_world mirrored = world;
    mirrored.omega = -world.omega;
    mirror(state, 2, image);
    other = begin_beads(&mirrored, image, 1e-13);
    go_to(other, 19.1);
    mirror(other->step.y, 2, end);
    CHECK_CLOSE(greatest_difference(end, flow->step.y, NUMBERS), 0, 2e-12);
    free(other);

    for (int i = 0; i < NUMBERS; ++i)
        image[i] = half_turn[i % FST_BEAD_NUMBERS] * state[i];
    other = begin_beads(&world, image, 1e-13);
    go_to(other, 19.1);
    for (int i = 0; i < NUMBERS; ++i)
        CHECK_CLOSE(half_turn[i % FST_BEAD_NUMBERS] * other->step.y[i], flow->step.y[i], 2e-12);
    free(other);
    free(flow);
    fst_model_free(model);
}

/* One bead as a list of one goes the way of a single bead; so do beads that are too far apart to feel each other, of
 * different mass and size. */
static void test_single_beads(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    double one[FST_STATE_SIZE], state[BEADS_NUMBERS];
    beads_world world = paper_beads(1, model, 1.0);
    place_bead(params, model, 3, state);
    start_of(&params, model, one);
    beads_flow *flow = begin_beads(&world, state, 1e-14);
    for (int turns = 1; turns <= 20; ++turns) {
        double end[FST_STATE_SIZE];
        go_to(flow, turns * PERIOD);
        state_after(model, 1e-14, one, turns * PERIOD, end);
        CHECK_CLOSE(greatest_difference(flow->step.y, end, 2), 0, 1e-11);
        CHECK_CLOSE(greatest_difference(flow->step.y + BEADS_V, end + FST_VX, 2), 0, 1e-11);
        CHECK_CLOSE(greatest_difference(flow->step.y + BEADS_N, end + FST_NX, 6), 0, 1e-11);
        assert_true(flow->step.y[2] == 0.0);
    }
    free(flow);

    fst_params heavy = params;
    heavy.bead_mass = 0.8e-3;
    heavy.bead_radius = 3e-3;
    heavy.bead_inertia = 0.5;
    fst_model *of_heavy = model_of(&heavy);
    const fst_groups g = fst_model_groups(of_heavy);
    world = two_beads(&params, model, 3, 183, state);
    place_bead(heavy, of_heavy, 183, bead_of(state, 1));
    world.body[0].dipole = 0;
    world.body[1] = (beads_body){.radius = g.eps,
                                 .mass = 1.6,
                                 .inertia = 1.6 * 0.5 * g.eps * g.eps,
                                 .strength = 1.6 * g.kappa * g.eps * g.eps,
                                 .dipole = 1.0};
    beads_number_contacts(&world, 1.0, 1.0);
    flow = begin_beads(&world, state, 1e-13);
    go_to(flow, 5 * PERIOD);
    heavy.start_phi = 183;
    start_of(&heavy, of_heavy, one);
    state_after(of_heavy, 1e-13, one, 5 * PERIOD, one);
    CHECK_CLOSE(greatest_difference(bead_of(flow->step.y, 1), one, 2), 0, 1e-11);
    CHECK_CLOSE(greatest_difference(bead_of(flow->step.y, 1) + BEADS_N, one + FST_NX, 6), 0, 1e-10);
    free(flow);
    fst_model_free(of_heavy);
    fst_model_free(model);
}

/* Three beads, each with its own radius, mass, inertia and moment, snap, bounce and rub for twenty turns: the energy is
 * where the integrals say. */
static void test_energy_of_unlike_beads(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS];
    beads_world world = paper_beads(3, model, 1.0);
    for (int i = 0; i < 3; ++i) {
        const double size = 1 + 0.15 * i, mass = size * size * size;
        place_bead(params, model, 3 + 100 * i, bead_of(state, i));
        world.body[i].radius *= size;
        world.body[i].mass = mass;
        world.body[i].inertia *= (1 - 0.1 * i) * mass * size * size;
        world.body[i].strength *= mass;
        world.body[i].dipole *= mass;
    }
    world.restitution = 0.3;
    beads_number_contacts(&world, 1.0, 0.5);
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    const double start = beads_energy_now(flow);
    go_to(flow, 20 * PERIOD);
    assert_true(flow->counts[FST_BEAD_EVENT_TOUCH] > 3 && flow->counts[FST_BEAD_EVENT_LIFT] > 3);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-12);
    free(flow);
    fst_model_free(model);
}

/* ------------------------------------------------------------------ no magnet, or an even field */

static double even_field;
static void field_upward(const void *unused, double x, double y, double z, double b[3], fst_gradient_double *g)
{
    (void)unused, (void)x, (void)y, (void)z;
    memset(g, 0, sizeof *g);
    b[0] = b[1] = 0;
    b[2] = even_field;
}

/* Two beads on a plate in such a field. */
static beads_world dimer_in_even_field(void)
{
    beads_world world = free_beads(2);
    world.plate = 0.5;
    world.gravity = 9.81 / (0.023 * 312.5 * 312.5);
    world.field = field_upward;
    world.body[0].strength = world.body[1].strength = 1.5 * EPS * EPS;
    beads_number_contacts(&world, 1.0, 1.0);
    return world;
}

/* They touch, with the axis at the angle `lean` over the plate and the moments at the angle `moments`. */
static void lay_dimer(double lean, double moments, double *state)
{
    memset(state, 0, 2 * FST_BEAD_NUMBERS * sizeof *state);
    bead_of(state, 1)[0] = 2 * EPS * cos(lean);
    bead_of(state, 1)[2] = 2 * EPS * sin(lean);
    for (int i = 0; i < 2; ++i) {
        bead_of(state, i)[BEADS_N] = cos(moments);
        bead_of(state, i)[BEADS_N + 2] = sin(moments);
    }
}

/* A stack of three, upright: loads. */
static void test_stack(void **unused)
{
    (void)unused;
    beads_world world = free_beads(3);
    double state[BEADS_NUMBERS] = {0};
    world.plate = 0.5;
    world.gravity = 9.81 / (0.023 * 312.5 * 312.5);
    beads_number_contacts(&world, 1.0, 1.0);
    for (int i = 0; i < 3; ++i) {
        bead_of(state, i)[2] = 2 * EPS * i;
        bead_of(state, i)[BEADS_N + 2] = 1;
    }
    beads_flow *flow = begin_beads(&world, state, 1e-10);
    CHECK_CLOSE(flow->start.held[0], 3 * world.gravity, 1e-14);
    CHECK_CLOSE(flow->start.held[3], 3.55672727, 5e-9); /* beads 0 and 1 */
    CHECK_CLOSE(flow->start.held[5], 3.55235969, 5e-9); /* beads 1 and 2 */
    free(flow);
}

/* A dimer on the plate in an even vertical field b has tilted moments, sin a = k b d^3/(3 chi); one of its beads has no
 * load at b = 0.026787862913. */
static void test_dimer_in_even_field(void **unused)
{
    (void)unused;
    const double k = 1.5 * EPS * EPS, d = 2 * EPS, b = 0.026787862913;
    const beads_world world = dimer_in_even_field();
    for (int side = -1; side <= 1; ++side) {
        even_field = b * (1 + 1e-6 * side);
        double state[BEADS_NUMBERS];
        lay_dimer(0.0, asin(k * even_field * d * d * d / (3 * CHI)), state);
        beads_flow *flow = begin_beads(&world, state, 1e-10);
        const double least = fmin(flow->start.held[0], flow->start.held[1]);
        CHECK_CLOSE(flow->start.torque[0][1], 0, 1e-15);
        if (side)
            assert_int_equal(least == 0.0, side > 0);
        else
            CHECK_CLOSE(least / world.gravity, 0, 1e-10);
        free(flow);
    }
}

/* Beyond that it leans: with the axis at the angle s over the plate and the moments at a, the energy is
 * -(3 chi/d^3) cos^2(a - s) - 2 k b sin a + g d sin s, and least where k b cos a = eps g cos s and
 * (3 chi/d^3) sin 2(a - s) = 2 eps g cos s.  It stands from b = 0.026822922741 on. */
static void test_leaning_dimer(void **unused)
{
    (void)unused;
    static const double degrees[] = {0, 20, 50, 80, 89.999};
    const beads_world world = dimer_in_even_field();
    const double k = 1.5 * EPS * EPS, d = 2 * EPS, stiff = 3 * CHI / (d * d * d), g = world.gravity;
    for (int i = 0; i < 5; ++i) {
        const double lean = degrees[i] * TURN / 360;
        const double moments = lean + 0.5 * asin(2 * EPS * g * cos(lean) / stiff);
        double state[BEADS_NUMBERS];
        even_field = EPS * g * cos(lean) / (k * cos(moments));
        if (i == 0)
            CHECK_CLOSE(even_field, 0.026787862913, 1e-12);
        if (i == 4)
            CHECK_CLOSE(even_field, 0.026822922741, 1e-12);
        lay_dimer(lean, moments, state);
        beads_flow *flow = begin_beads(&world, state, 1e-10);
        CHECK_CLOSE(flow->start.held[0], 2 * g, 1e-13);
        assert_true(flow->start.held[2] > 3);
        for (int bead = 0; bead < 2; ++bead)
            for (int m = 0; m < 3; ++m) {
                CHECK_CLOSE(flow->start.force[bead][m], 0, 1e-14);
                CHECK_CLOSE(flow->start.torque[bead][m], 0, 1e-15);
            }
        free(flow);
    }
}

/* ------------------------------------------------------------------ bars and walkers */

/* A straight bar along the magnet that turns with it. */
static beads_world bar(int count, const fst_model *model, double *state)
{
    const beads_world world = paper_beads(count, model, 1.0);
    memset(state, 0, BEADS_NUMBERS * sizeof *state);
    for (int i = 0; i < count; ++i) {
        double *bead = bead_of(state, i);
        bead[0] = (2 * i - (count - 1)) * EPS;
        bead[BEADS_V + 1] = world.omega * bead[0];
        bead[BEADS_N] = -1;
        bead[BEADS_W + 2] = world.omega;
    }
    return world;
}

/* Bars at 30 Hz with gamma_b = 1.  Of three and more only the ends touch the plate: the bar is an arch.  Of three and
 * five beads: heights over 2 eps, load at the ends in weights, least contact force, power. */
static void test_bars(void **unused)
{
    (void)unused;
    static const struct {
        int count;
        double height[3], load, force, power;
    } cases[] = {{2, {0}, 19.72219, 3.29360694, 5.53486e-5},
                 {3, {0, 0.05165622}, 30.21196, 3.46217435, 1.830241e-4},
                 {5, {0, 0.138695, 0.176550}, 52.84548, 0, 1.278730e-3}};
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    for (int i = 0; i < 3; ++i) {
        const int count = cases[i].count;
        double state[BEADS_NUMBERS], before[BEADS_INTEGRALS];
        const beads_world world = bar(count, model, state);
        beads_flow *flow = begin_beads(&world, state, 1e-12);
        go_to(flow, (count == 5 ? 190 : 60) * PERIOD);
        const double *integral = bead_of(flow->step.y, count), impacts = flow->impacts;
        memcpy(before, integral, sizeof before);
        go_to(flow, (count == 5 ? 200 : 70) * PERIOD);
        CHECK_CLOSE(flow->impacts, impacts, 1e-15);
        for (int k = 0; k < count; ++k) {
            const int from_end = k < count - 1 - k ? k : count - 1 - k;
            CHECK_CLOSE(bead_of(flow->step.y, k)[2] / (2 * EPS), cases[i].height[from_end],
                        count == 5 ? 5e-7 : 5e-9);
            CHECK_CLOSE((integral[BEADS_LOAD + k] - before[BEADS_LOAD + k]) / (10 * PERIOD * world.gravity),
                        from_end ? 0 : cases[i].load, 5e-6);
        }
        for (int k = count; cases[i].force > 0 && k < world.contacts; ++k)
            if (flow->modes.contact[k] == BEADS_PRESSING)
                CHECK_CLOSE(flow->start.held[k], cases[i].force, 5e-9);
        const double plate = integral[BEADS_PLATE] - before[BEADS_PLATE];
        const double pair = integral[BEADS_PAIR] - before[BEADS_PAIR];
        CHECK_CLOSE((plate + pair) / (10 * PERIOD), cases[i].power, count == 2 ? 5e-11 : 5e-10);
        CHECK_CLOSE((integral[BEADS_DRIVE] - before[BEADS_DRIVE]) / (10 * PERIOD), cases[i].power,
                    count == 2 ? 5e-11 : 5e-10);
        free(flow);
    }
    fst_model_free(model);
}

typedef struct walk {
    double time, axis[3], integral[BEADS_INTEGRALS], impacts;
} walk;

/* A flow as another was; it is not to be moved. */
static void copy_flow(const beads_flow *from, beads_flow *to)
{
    *to = *from;
    to->step.context.world = &to->world;
    to->step.context.modes = &to->modes;
}

static double centre(const beads_flow *flow, int axis)
{
    return bead_of((double *)flow->step.y, 0)[axis] + bead_of((double *)flow->step.y, 1)[axis];
}

/* Where the pair's centre next passes the angle pi/2 of the turning frame: the step that passes it is made again and
 * again, each time as long as brings its end nearer. */
static walk next_return(beads_flow *flow)
{
    static beads_flow kept, probe;
    fst_error error;
    do {
        copy_flow(flow, &kept);
        assert_int_equal(beads_go(flow, 1e9, &error), FST_OK);
    } while (!(centre(&kept, 0) < 0 && centre(flow, 0) >= 0 && centre(flow, 1) > 0));
    double low = kept.t.high, high = flow->t.high, f_low = centre(&kept, 0), f_high = centre(flow, 0);
    copy_flow(&kept, &probe);
    for (int i = 0; i < 60 && high - low > 1e-12; ++i) {
        const double t = i % 3 == 2 ? 0.5 * (low + high) : low - f_low * (high - low) / (f_high - f_low);
        copy_flow(&kept, &probe);
        assert_int_equal(beads_go_to(&probe, t, &error), FST_OK);
        const double f = centre(&probe, 0);
        *(f < 0 ? &low : &high) = t;
        *(f < 0 ? &f_low : &f_high) = f;
    }
    walk at = {.time = probe.t.high, .impacts = probe.impacts};
    beads_way(&probe.world, probe.step.y, 0, 1, at.axis);
    memcpy(at.integral, bead_of(probe.step.y, 2), sizeof at.integral);
    return at;
}

/* The walker at 30 Hz: return of the centre's angle, powers by place, radius, and its axis, which turns with the
 * magnet. */
static void test_walker(void **unused)
{
    (void)unused;
    enum { RETURNS = 40 };
    static const struct {
        int integral;
        double mean;
    } means[] = {{BEADS_DRIVE, 5.0949300e-3}, {BEADS_PLATE, 2.0803862e-3}, {BEADS_PAIR, 3.869493e-4}};
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS];
    const beads_world world = two_beads(&params, model, 3, 40, state);
    beads_flow *flow = begin_beads(&world, state, 1e-11);
    const double energy = beads_energy_now(flow);
    go_to(flow, 300 * PERIOD);
    const walk first = next_return(flow);
    walk last = first;
    for (int i = 0; i < RETURNS; ++i) {
        last = next_return(flow);
        CHECK_CLOSE(beads_turned_by(first.axis, last.axis), 0, 1e-6);
    }
    const double time = last.time - first.time;
    CHECK_CLOSE(time / RETURNS, 9.29084295, 2e-8);
    CHECK_CLOSE(1 - TURN * RETURNS / (time * world.omega), -0.1211756265, 2e-9);
    for (int i = 0; i < 3; ++i)
        CHECK_CLOSE((last.integral[means[i].integral] - first.integral[means[i].integral]) / time,
                    means[i].mean, 2e-10);
    CHECK_CLOSE((last.impacts - first.impacts) / time, 2.6275946e-3, 2e-10);
    for (int i = 0; i < 2; ++i)
        CHECK_CLOSE((last.integral[BEADS_R + i] - first.integral[BEADS_R + i]) / time, 0.6086857726, 2e-9);
    CHECK_CLOSE(beads_residual(flow, energy), 0, 1e-9);
    free(flow);
    fst_model_free(model);
}

/* A bead that passes the plate's edge is gone; the other goes on as if it had been alone all the time, but for the pull
 * of the first. */
static void test_ejected(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS], alone[BEADS_NUMBERS];
    beads_world world = two_beads(&params, model, 3, 183, state), single = paper_beads(1, model, 1.0);
    for (int i = 0; i < 2; ++i)
        world.body[i].dipole = 0;
    world.plate_radius = single.plate_radius = 2.0;
    memcpy(alone, bead_of(state, 1), sizeof(double[FST_BEAD_NUMBERS]));
    bead_of(state, 0)[0] = 1.9;
    bead_of(state, 0)[BEADS_V] = 3.0;
    beads_flow *flow = begin_beads(&world, state, 1e-13), *other = begin_beads(&single, alone, 1e-13);
    const double start = beads_energy_now(flow);
    go_to(flow, 3 * PERIOD);
    go_to(other, 3 * PERIOD);
    assert_true(flow->ejected[0] > 0 && flow->ejected[0] < PERIOD && isnan(flow->ejected[1]));
    CHECK_CLOSE(hypot(flow->step.y[0], flow->step.y[1]), 2.0, 1e-13);
    CHECK_CLOSE(greatest_difference(bead_of(flow->step.y, 1), other->step.y, FST_BEAD_NUMBERS), 0, 1e-11);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-12);
    free(other);
    free(flow);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_apart),
        cmocka_unit_test(test_snap),
        cmocka_unit_test(test_symmetries),
        cmocka_unit_test(test_single_beads),
        cmocka_unit_test(test_stack),
        cmocka_unit_test(test_dimer_in_even_field),
        cmocka_unit_test(test_leaning_dimer),
        cmocka_unit_test(test_bars),
        cmocka_unit_test(test_walker),
        cmocka_unit_test(test_ejected),
        cmocka_unit_test(test_energy_of_unlike_beads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
