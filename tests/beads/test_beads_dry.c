/* Several beads under dry friction, in modes: against single beads, exact solutions and a regularised law; symmetries,
 * what is kept, and paradoxes.
 *
 * tests: beads/hold.c beads/linear.c beads/select.c beads/impact.c beads/events.c beads/flow.c beads/run.c beads/setup.c
 * labels: numbers */
#include "beads/hold.h"
#include "beads/impact.h"
#include "beads/select.h"
#include "some_beads.h"

static const double EPS = 2.5 / 23;

static fst_params dry_params(double frequency, double mu)
{
    fst_params params = fst_default_params();
    params.friction_law = FST_FRICTION_COULOMB;
    params.friction_mu = mu;
    params.drive_frequency = frequency;
    return params;
}

static beads_world with_friction(beads_world world, double mu, double pair_mu)
{
    world.plate_mu = mu;
    world.pair_mu = pair_mu;
    beads_number_contacts(&world, 0.0, 0.0);
    return world;
}

/* Two beads as their rolling starts at r = 0.95 and Phi = 3 and 53 degrees say, at 30 Hz: they snap at t = 13.45. */
static beads_world two_beads(const fst_model *model, double *state)
{
    const fst_params params = dry_params(30, 0.2);
    place_bead(params, model, 3, bead_of(state, 0));
    place_bead(params, model, 53, bead_of(state, 1));
    return with_friction(paper_beads(2, model, 0.0), 0.2, 0.2);
}

/* One bead as a list of one goes the way of a single bead, through captures and releases. */
static void check_single(double frequency, double mu, int spin)
{
    fst_params params = dry_params(frequency, mu);
    params.start_spin = spin;
    fst_model *model = model_of(&params);
    double one[FST_STATE_SIZE], state[BEADS_NUMBERS];
    const beads_world world = with_friction(paper_beads(1, model, 0.0), mu, 0.0);
    place_bead(params, model, 3, state);
    start_of(&params, model, one);
    beads_flow *flow = begin_beads(&world, state, 1e-14);
    const double start = beads_energy_now(flow), period = 312.5 / frequency;
    for (int turns = 1; turns <= 20; ++turns) {
        double end[FST_STATE_SIZE];
        go_to(flow, turns * period);
        state_after(model, 1e-14, one, turns * period, end);
        CHECK_CLOSE(greatest_difference(flow->step.y, end, 2), 0, 1e-11);
        CHECK_CLOSE(greatest_difference(flow->step.y + BEADS_V, end + FST_VX, 2), 0, 1e-11);
        CHECK_CLOSE(greatest_difference(flow->step.y + BEADS_N, end + FST_NX, 6), 0, 1e-11);
    }
    assert_true(flow->counts[FST_BEAD_EVENT_STICK] >= 20 && flow->counts[FST_BEAD_EVENT_SLIP] >= 20);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-12);
    free(flow);
    fst_model_free(model);
}

static void test_single(void **unused)
{
    (void)unused;
    check_single(19.9, 0.3, FST_SPIN_REST);
    check_single(30, 0.2, FST_SPIN_ROLLING);
}

/* Two beads that do not feel each other go each its own way. */
static void test_far(void **unused)
{
    (void)unused;
    fst_params params = dry_params(30, 0.2);
    fst_model *model = model_of(&params);
    double one[FST_STATE_SIZE], state[BEADS_NUMBERS];
    beads_world world = two_beads(model, state);
    world.body[0].dipole = world.body[1].dipole = 0.0;
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    go_to(flow, 50.0);
    for (int i = 0; i < 2; ++i) {
        const double *bead = bead_of(flow->step.y, i);
        params.start_phi = i ? 53 : 3;
        start_of(&params, model, one);
        state_after(model, 1e-13, one, 50.0, one);
        CHECK_CLOSE(greatest_difference(bead, one, 2), 0, 1e-11);
        CHECK_CLOSE(greatest_difference(bead + BEADS_N, one + FST_NX, 6), 0, 1e-11);
    }
    free(flow);
    fst_model_free(model);
}

/* Exchanged beads, and the mirror Y -> -Y with the drive reversed, give exchanged and mirrored motions through a snap. */
static void test_symmetries(void **unused)
{
    (void)unused;
    static const double sign[FST_BEAD_NUMBERS] = {1, -1, 1, 1, -1, 1, 1, -1, 1, -1, 1, -1};
    const fst_params params = dry_params(30, 0.2);
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS], image[BEADS_NUMBERS];
    beads_world world = two_beads(model, state);
    enum { NUMBERS = 2 * FST_BEAD_NUMBERS };
    beads_flow *flow = begin_beads(&world, state, 1e-13);
    const double start = beads_energy_now(flow);
    go_to(flow, 14.2);
    assert_true(flow->counts[FST_BEAD_EVENT_TOUCH] == 1 && flow->counts[FST_BEAD_EVENT_STICK] >= 7);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-11);

    memcpy(bead_of(image, 0), bead_of(state, 1), sizeof(double[FST_BEAD_NUMBERS]));
    memcpy(bead_of(image, 1), bead_of(state, 0), sizeof(double[FST_BEAD_NUMBERS]));
    beads_flow *other = begin_beads(&world, image, 1e-13);
    go_to(other, 14.2);
    for (int i = 0; i < 2; ++i)
        CHECK_CLOSE(
            greatest_difference(bead_of(other->step.y, i), bead_of(flow->step.y, 1 - i), FST_BEAD_NUMBERS), 0,
            1e-10);
    free(other);

    world.omega = -world.omega;
    for (int i = 0; i < NUMBERS; ++i)
        image[i] = sign[i % FST_BEAD_NUMBERS] * state[i];
    other = begin_beads(&world, image, 1e-13);
    go_to(other, 14.2);
    for (int i = 0; i < NUMBERS; ++i)
        CHECK_CLOSE(sign[i % FST_BEAD_NUMBERS] * other->step.y[i], flow->step.y[i], 1e-10);
    free(other);
    free(flow);
    fst_model_free(model);
}

/* A walker whose pair slips and sticks, lifts and lands: energy is where the integrals say, and slips that friction can
 * just not stop take no endless steps. */
static void test_walker(void **unused)
{
    (void)unused;
    const fst_params params = dry_params(30, 0.1);
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS];
    place_bead(params, model, 3, bead_of(state, 0));
    place_bead(params, model, 40, bead_of(state, 1));
    const beads_world world = with_friction(paper_beads(2, model, 0.0), 0.1, 0.1);
    for (int i = 0; i < 2; ++i) {
        beads_flow *flow = begin_beads(&world, state, i ? 1e-11 : 1e-13);
        const double start = beads_energy_now(flow);
        go_to(flow, 7 * 312.5 / 30);
        assert_true(flow->counts[FST_BEAD_EVENT_STICK] > 50 && flow->counts[FST_BEAD_EVENT_TOUCH] > 10);
        CHECK_CLOSE(beads_residual(flow, start), 0, i ? 1e-11 : 1e-12);
        assert_true(flow->accepted < 60000);
        free(flow);
    }
    fst_model_free(model);
}

/* Five beads fall together in space, collide, slip and stick: momentum and angular momentum stay, energy goes where it
 * is told, and neither a contact nor an impact gives any. */
static void test_what_is_kept(void **unused)
{
    (void)unused;
    beads_world world = with_friction(free_beads(5), 0.0, 0.3);
    world.restitution = 0.4;
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
    while (flow->t.high < 5.0) {
        if (beads_go(flow, 5.0, &error) != FST_OK)
            fail_msg("beads_go: %s", error.sentence);
        const double now = bead_of(flow->step.y, 5)[BEADS_PAIR];
        assert_true(now >= loss - 1e-15 && flow->impacts >= impacts - 1e-14 &&
                    flow->start.power[BEADS_PAIR] >= -1e-13);
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
    assert_true(flow->counts[FST_BEAD_EVENT_TOUCH] >= 4 && flow->counts[FST_BEAD_EVENT_STICK] >= 4);
    CHECK_CLOSE(greatest_difference(after, before, 6), 0, 1e-13);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-12);
    free(flow);
}

/* A dimer on its side, thrown across its axis, slides until both beads roll, as each would alone:
 * t = 2 V/(7 mu g), v_end = (5/7) V, and the heat of each is V^2/7. */
static void test_thrown_dimer(void **unused)
{
    (void)unused;
    const double mu = 0.3, g = 0.05, v = 0.2, t = 2 * v / (7 * mu * g);
    beads_world world = free_beads(2);
    world.plate = 0.7;
    world.gravity = g;
    world = with_friction(world, mu, mu);
    double state[2 * FST_BEAD_NUMBERS] = {0};
    for (int i = 0; i < 2; ++i) {
        bead_of(state, i)[0] = i ? EPS : -EPS;
        bead_of(state, i)[BEADS_V + 1] = v;
        bead_of(state, i)[BEADS_N] = 1;
    }
    beads_flow *flow = begin_beads(&world, state, 1e-12);
    assert_int_equal(flow->modes.contact[0], BEADS_PRESSING);
    assert_int_equal(flow->modes.contact[2], BEADS_STICKING);
    CHECK_CLOSE(flow->start.held[2], 6 * CHI / pow(2 * EPS, 4), 1e-12);
    go_to(flow, t - 1e-9);
    assert_int_equal(flow->counts[FST_BEAD_EVENT_STICK], 0);
    go_to(flow, t + 1e-9);
    assert_int_equal(flow->counts[FST_BEAD_EVENT_STICK], 2);
    go_to(flow, t + 1);
    for (int i = 0; i < 2; ++i) {
        CHECK_CLOSE(bead_of(flow->step.y, i)[BEADS_V + 1], 5 * v / 7, 1e-12);
        CHECK_CLOSE(bead_of(flow->step.y, i)[1], v * t - mu * g * t * t / 2 + 5 * v / 7, 1e-10);
    }
    CHECK_CLOSE(bead_of(flow->step.y, 2)[BEADS_PLATE], 2 * v * v / 7, 1e-12);
    free(flow);
}

/* Two beads in space with opposite moments along z touch and spin alike about z: they rub, begin to circle at the rate
 * O, and roll on each other when O = (2/7) w.  The load is L - eps O^2 with L = 3 chi/d^4, so O' = (mu/eps)(L - eps O^2). */
static void test_rolling_pair(void **unused)
{
    (void)unused;
    const double mu = 0.3, load = 3 * CHI / pow(2 * EPS, 4), rate = sqrt(load / EPS), w = rate;
    const double t = atanh(2.0 / 7 * w / rate) / (mu * rate);
    const beads_world world = with_friction(free_beads(2), 0.0, mu);
    double state[2 * FST_BEAD_NUMBERS] = {0};
    for (int i = 0; i < 2; ++i) {
        bead_of(state, i)[0] = i ? EPS : -EPS;
        bead_of(state, i)[BEADS_N + 2] = i ? 1 : -1;
        bead_of(state, i)[BEADS_W + 2] = w;
    }
    beads_flow *flow = begin_beads(&world, state, 1e-12);
    CHECK_CLOSE(flow->start.held[2], load, 1e-12);
    go_to(flow, t / 2);
    CHECK_CLOSE(bead_of(flow->step.y, 0)[BEADS_W + 2], w - 2.5 * rate * tanh(mu * rate * t / 2), 1e-10);
    go_to(flow, t + 1e-9);
    assert_int_equal(flow->counts[FST_BEAD_EVENT_STICK], 1);
    CHECK_CLOSE(flow->events[0].time, t, 1e-10);
    go_to(flow, 3 * t);
    const double *bead = bead_of(flow->step.y, 0), *other = bead_of(flow->step.y, 1);
    CHECK_CLOSE(bead[BEADS_W + 2], 2 * w / 7, 1e-11);
    CHECK_CLOSE(hypot(bead[BEADS_V], bead[BEADS_V + 1]), EPS * 2 * w / 7, 1e-11);
    CHECK_CLOSE(other[BEADS_W + 2], 2 * w / 7, 1e-11);
    CHECK_CLOSE(bead_of(flow->step.y, 2)[BEADS_PAIR], 0.4 * EPS * EPS * w * w * 5 / 7, 1e-12);
    free(flow);
}

/* A bead that falls on the plate with the slip V gets p_t = min(mu p, 2 V/7) against it, p = (1 + e) |z'|. */
static void test_impact(void **unused)
{
    (void)unused;
    static const double speeds[] = {0.05, 0.4, 2.0}; /* the first stops slipping, the last does not */
    const double mu = 0.3, e = 0.5, falls = 0.3;
    beads_world world = free_beads(1);
    world.plate = 0.7;
    world.restitution = e;
    world = with_friction(world, mu, 0.0);
    for (int i = 0; i < 3; ++i) {
        double y[FST_BEAD_NUMBERS] = {0, 0, 0, speeds[i], 0, -falls, 1, 0, 0, 0, 0, 0};
        const beads_modes modes = {.gone = {0}};
        const int touching[BEADS_CONTACTS] = {1};
        const double p = fmin(mu * (1 + e) * falls, 2 * speeds[i] / 7);
        assert_true(beads_collide(&world, &modes, touching, y));
        CHECK_CLOSE(y[BEADS_V + 2], e * falls, 1e-15);
        CHECK_CLOSE(y[BEADS_V], speeds[i] - p, 1e-15);
        CHECK_CLOSE(y[BEADS_W + 1], 2.5 / EPS * p, 1e-13);
    }
}

/* A random state of a leaning pair: bead 0 on the plate, both touching, velocities that keep both contacts closed. */
static void leaning_pair(unsigned *seed, const beads_world *world, double *y)
{
    double numbers[2 * FST_BEAD_NUMBERS];
    for (int i = 0; i < 2 * FST_BEAD_NUMBERS; ++i) {
        *seed = *seed * 1664525u + 1013904223u;
        numbers[i] = 2.0 * (*seed >> 8) / 16777216.0 - 1.0;
    }
    memcpy(y, numbers, sizeof numbers);
    y[0] = y[1] = y[2] = 0;
    bead_of(y, 1)[2] = fabs(numbers[2]);
    const double *up = bead_of(y, 1), size = sqrt(dot(up, up));
    for (int m = 0; m < 3; ++m)
        bead_of(y, 1)[m] *= 2 * EPS / size;
    for (int i = 0; i < 2; ++i)
        for (int m = 0; m < 3; ++m)
            bead_of(y, i)[BEADS_V + m] *= 0.3;
    const beads_modes modes = {.contact = {BEADS_PRESSING, BEADS_OPEN, BEADS_PRESSING}};
    beads_project(world, &modes, y);
}

/* Friction of a usual strength leaves one motion of a leaning pair; where both coefficients are large, often several, or
 * none. */
static void test_painleve(void **unused)
{
    (void)unused;
    enum { STATES = 3000 };
    static const double mus[] = {0.3, 3.0};
    for (int strong = 0; strong < 2; ++strong) {
        beads_world world = free_beads(2);
        unsigned seed = 1;
        int none = 0, several = 0;
        world.plate = 0.7;
        world.gravity = 4.4e-3;
        world.still = 1e-13;
        world = with_friction(world, mus[strong], mus[strong]);
        for (int i = 0; i < STATES; ++i) {
            double y[2 * FST_BEAD_NUMBERS];
            const int touching[BEADS_CONTACTS] = {1, 0, 1};
            beads_modes modes = {.gone = {0}};
            leaning_pair(&seed, &world, y);
            beads_close(&world, y, touching, &modes);
            if (!beads_select(&world, y, touching, &modes))
                ++none;
            else
                several += beads_is_one_of_several(&world, y, touching, &modes);
        }
        if (strong)
            assert_true(none > 0 && several > 0);
        else
            assert_true(none == 0 && several == 0);
    }
}

/* A flat hexagon of seven beads on a smooth plate, of which the middle one spins: more conditions than directions, and
 * contacts that slip.  Loads are one choice of many; gaps stay, and the motion keeps the balance of energy. */
static void test_redundant(void **unused)
{
    (void)unused;
    beads_world world = free_beads(7);
    world.plate = 0.5;
    world.gravity = 4.3676e-3;
    world = with_friction(world, 0.0, 0.02);
    double state[BEADS_NUMBERS] = {0};
    for (int k = 0; k < 7; ++k) {
        const double angle = TURN * k / 6, radius = k < 6 ? 2 * EPS : 0;
        double *bead = bead_of(state, k);
        bead[0] = radius * cos(angle);
        bead[1] = radius * sin(angle);
        bead[BEADS_N] = k < 6 ? -sin(angle) : 0;
        bead[BEADS_N + 1] = k < 6 ? cos(angle) : 0;
        bead[BEADS_N + 2] = k < 6 ? 0 : 1;
    }
    bead_of(state, 6)[BEADS_W + 2] = 1.0;
    beads_flow *flow = begin_beads(&world, state, 1e-10);
    const double start = beads_energy_now(flow);
    assert_int_equal(flow->start.unique, 0);
    for (int k = 0; k < world.contacts; ++k)
        if (flow->modes.contact[k] != BEADS_OPEN)
            CHECK_CLOSE(beads_bend_of_gap(&world, &flow->start, k), 0, 1e-9);
    go_to(flow, 0.01);
    CHECK_CLOSE(beads_residual(flow, start), 0, 1e-11);
    assert_true(bead_of(flow->step.y, 7)[BEADS_PAIR] > 0);
    free(flow);
}

/* ------------------------------------------------------------------ a regularised law */

/* f = -mu N V/(|V| + v): coefficients of the modes that depend on the slips of the moment. */
static void regularised(const beads_world *exact, const beads_modes *modes, double v, const double *y,
                        double *dy)
{
    static beads_world world;
    beads_look look;
    world = *exact;
    beads_look_at_gaps(&world, modes, y, &look);
    for (int k = 0; k < world.contacts; ++k) {
        if (modes->contact[k] == BEADS_OPEN)
            continue;
        beads_look_at_slip(&world, k, y, &look);
        const double speed = sqrt(dot(look.slip[k], look.slip[k]));
        world.contact[k].mu *= speed / (speed + v);
    }
    beads_look_at(&world, modes, y, &look);
    look.pace = 1.0;
    beads_derivatives(&world, modes, &look, y, dy);
}

/* Steps of Runge and Kutta's classical method. */
static void step_regularised(const beads_world *world, const beads_modes *modes, double v, double h, double *y)
{
    enum { NUMBERS = 2 * FST_BEAD_NUMBERS };
    double k[4][BEADS_DIM], stage[BEADS_DIM] = {0};
    static const double node[] = {0, 0.5, 0.5, 1}, weight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    for (int s = 0; s < 4; ++s) {
        for (int i = 0; i < NUMBERS; ++i)
            stage[i] = y[i] + (s ? h * node[s] * k[s - 1][i] : 0.0);
        regularised(world, modes, v, stage, k[s]);
    }
    for (int s = 0; s < 4; ++s)
        for (int i = 0; i < NUMBERS; ++i)
            y[i] += h * weight[s] * k[s][i];
    beads_project(world, modes, y);
}

/* A pair that lies on the plate across the magnet, slips and sticks: regularised laws at three speeds, extrapolated, come to
 * the motion in modes. */
static void test_regularised(void **unused)
{
    (void)unused;
    enum { NUMBERS = 2 * FST_BEAD_NUMBERS };
    const fst_params params = dry_params(30, 0.2);
    fst_model *model = model_of(&params);
    beads_world world = with_friction(paper_beads(2, model, 0.0), 0.2, 0.1);
    double state[NUMBERS] = {0}, ends[3][NUMBERS], time = 0.4;
    put_pair_across(state, EPS);
    beads_flow *flow = begin_beads(&world, state, 1e-12);
    assert_true(flow->modes.contact[0] && flow->modes.contact[1] && flow->modes.contact[2]);
    go_to(flow, time);
    assert_true(flow->counts[FST_BEAD_EVENT_STICK] >= 1 && flow->counts[FST_BEAD_EVENT_LIFT] == 0);
    const beads_modes modes = {.contact = {BEADS_PRESSING, BEADS_PRESSING, BEADS_PRESSING}};
    for (int i = 0; i < 3; ++i) {
        const int steps = 8000;
        memcpy(ends[i], state, sizeof state);
        for (int s = 0; s < steps; ++s)
            step_regularised(&world, &modes, 4e-4 / (1 << i), time / steps, ends[i]);
    }
    double slow = 0, fast = 0, near = 0; /* errors with the smallest and the greatest speed, and extrapolated */
    for (int i = 0; i < NUMBERS; ++i) {
        const double extrapolated = (ends[0][i] - 6 * ends[1][i] + 8 * ends[2][i]) / 3;
        slow = fmax(slow, fabs(ends[2][i] - flow->step.y[i]));
        fast = fmax(fast, fabs(ends[0][i] - flow->step.y[i]));
        near = fmax(near, fabs(extrapolated - flow->step.y[i]));
    }
    assert_true(slow < 2e-3 && fast > 3.5 * slow && near < slow / 5);
    free(flow);
    fst_model_free(model);
}

/* ------------------------------------------------------------------ runs */

static void two_of(double apart, double mu, fst_params beads[2])
{
    for (int i = 0; i < 2; ++i) {
        beads[i] = dry_params(30, mu);
        beads[i].start_phi = 3 + apart * i;
        beads[i].run_periods = 10;
        beads[i].run_discard = 5;
    }
}

/* A run tells a paradox, and ends there; a run without one has the balance of its energy. */
static void test_runs(void **unused)
{
    (void)unused;
    const fst_beads_options options = fst_default_beads_options();
    fst_beads_result result;
    fst_error error = {FST_OK, "", ""};
    fst_params beads[2];
    two_of(180, 0.2, beads);
    assert_int_equal(fst_beads_run(beads, 2, &options, &result, &error), FST_OK);
    assert_true(isnan(result.paradox.time));
    assert_int_equal(result.outcome, FST_BEADS_APART);
    assert_true(result.counts[FST_BEAD_EVENT_STICK] > 0 && result.plate_power > 0 && result.pair_power == 0);
    CHECK_CLOSE(result.energy_residual, 0, 1e-9);
    fst_beads_free(&result);

    two_of(30, 3.0, beads);
    assert_int_equal(fst_beads_run(beads, 2, &options, &result, &error), FST_OK);
    assert_int_equal(result.outcome, FST_BEADS_UNDECIDED);
    assert_non_null(strstr(result.reason, "paradox"));
    assert_true(result.paradox.time > 0 && result.paradox.motions == 2 && result.paradox.touch_count >= 2);
    fst_beads_free(&result);
}

typedef struct watched {
    fst_model *model;
    double start[FST_STATE_SIZE], worst;
    int count;
} watched;

static fst_status compare_sample(void *user, const fst_beads_sample *sample, fst_error *error)
{
    watched *w = user;
    double alone[FST_STATE_SIZE];
    (void)error;
    if (sample->t > 0) {
        state_after(w->model, 1e-13, w->start, sample->t, alone);
        w->worst = fmax(w->worst, greatest_difference(sample->states, alone, 2));
        w->worst = fmax(w->worst, greatest_difference(sample->states + BEADS_N, alone + FST_NX, 3));
    }
    ++w->count;
    return FST_OK;
}

/* Each sample is the motion at the sample's time, also within steps that a dying slip measures by another time. */
static void test_samples(void **unused)
{
    (void)unused;
    fst_params bead = dry_params(10.7, 0.2);
    bead.run_periods = 3;
    bead.run_discard = 1;
    bead.run_rtol = 1e-12;
    bead.run_samples = 32;
    watched w = {.model = model_of(&bead)};
    start_of(&bead, w.model, w.start);
    fst_beads_options options = fst_default_beads_options();
    options.sample = compare_sample;
    options.user = &w;
    fst_beads_result result;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_beads_run(&bead, 1, &options, &result, &error), FST_OK);
    assert_true(w.count == 97 && result.counts[FST_BEAD_EVENT_STICK] > 3);
    CHECK_CLOSE(w.worst, 0, 1e-10);
    fst_beads_free(&result);
    fst_model_free(w.model);
}

static void check_refused(const fst_params *beads, const fst_beads_options *options, const char *key)
{
    fst_beads_result result;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_beads_run(beads, 2, options, &result, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, key));
}

static void test_refused(void **unused)
{
    (void)unused;
    fst_beads_options options = fst_default_beads_options();
    fst_params beads[2];
    two_of(180, 0.2, beads);
    options.pair_mu = -0.1;
    check_refused(beads, &options, "contact.pair_mu = -0.1 must not be negative");
    options = fst_default_beads_options();
    options.pair_rate = 3;
    check_refused(beads, &options, "contact.pair_rate is of viscous friction");
    options = fst_default_beads_options();
    beads[0].friction_mu_static = beads[1].friction_mu_static = 0.3;
    check_refused(beads, &options, "friction.mu_static");
    two_of(180, 0.2, beads);
    beads[0].friction_rolling_resistance = beads[1].friction_rolling_resistance = 1e-3;
    check_refused(beads, &options, "friction.rolling_resistance");
    two_of(180, 0.2, beads);
    beads[0].friction_law = beads[1].friction_law = FST_FRICTION_VISCOUS;
    options.pair_mu = 0.1;
    check_refused(beads, &options, "no effect without dry friction");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_single),       cmocka_unit_test(test_far),
        cmocka_unit_test(test_walker),       cmocka_unit_test(test_symmetries),
        cmocka_unit_test(test_what_is_kept), cmocka_unit_test(test_thrown_dimer),
        cmocka_unit_test(test_rolling_pair), cmocka_unit_test(test_impact),
        cmocka_unit_test(test_painleve),     cmocka_unit_test(test_regularised),
        cmocka_unit_test(test_redundant),    cmocka_unit_test(test_runs),
        cmocka_unit_test(test_samples),      cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
