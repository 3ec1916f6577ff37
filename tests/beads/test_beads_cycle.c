/* Periodic orbits of beads: two opposite each other against numbers of an independent program, a single bead against the
 * solver of single beads, multipliers against the motion itself.
 *
 * tests: orbit/beads_cycle.c beads/manifold.c
 * labels: slow numbers */
#include "some_beads.h"

#include "orbit/beads_cycle.h"

static const fst_lapack *lapack(void)
{
    const fst_lapack *found;
    fst_error error;
    assert_int_equal(fst_lapack_load(&found, &error), FST_OK);
    return found;
}

/* A guess: the motion after `turns` of the drive, and the time between the last two passages of bead 0 through X = 0. */
static void guess(const beads_world *world, const double *start, double turns, beads_cycle *cycle)
{
    const double turn = TURN / world->omega;
    double before = 0.0;
    fst_error error;
    beads_flow *flow = begin_beads(world, start, 1e-11);
    memset(cycle, 0, sizeof *cycle);
    while (flow->t.high < turns * turn) {
        const double x = flow->step.y[0], t = flow->t.high;
        assert_int_equal(beads_go(flow, turns * turn, &error), FST_OK);
        if (x * flow->step.y[0] < 0) {
            const double at = t + (flow->t.high - t) * x / (x - flow->step.y[0]);
            cycle->period = at - before;
            before = at;
        }
    }
    memcpy(cycle->state, flow->step.y, (size_t)(FST_BEAD_NUMBERS * world->count) * sizeof(double));
    cycle->modes = flow->modes;
    free(flow);
}

static void correct(const beads_world *world, double rtol, beads_cycle *cycle)
{
    fst_error error = {FST_OK, "", ""};
    if (beads_cycle_correct(lapack(), world, rtol, INFINITY, cycle, &error) != FST_OK)
        fail_msg("beads_cycle_correct: %s", error.sentence);
}

/* Two beads that circle opposite each other. */
static beads_world opposite(const fst_params *params, const fst_model *model, double *state)
{
    place_bead(*params, model, 3, bead_of(state, 0));
    place_bead(*params, model, 183, bead_of(state, 1));
    return paper_beads(2, model, 1.0);
}

/* Beads that are not quite opposite come nearer to that by the slowest multiplier with each half turn. */
static void check_slowest(const beads_world *world, const beads_cycle *cycle)
{
    enum { HALVES = 40 };
    double state[2 * FST_BEAD_NUMBERS], apart[2];
    memcpy(state, cycle->state, sizeof state);
    for (int k = 0; k < FST_BEAD_NUMBERS; k += 3) { /* bead 1 is turned a little about the axis */
        double *v = bead_of(state, 1) + k, x = v[0];
        v[0] = cos(1e-6) * x - sin(1e-6) * v[1];
        v[1] = sin(1e-6) * x + cos(1e-6) * v[1];
    }
    beads_flow *flow = begin_beads(world, state, 1e-13);
    for (int k = 0; k < 2; ++k) {
        go_to(flow, (k + 1) * HALVES * cycle->period);
        const double *y = flow->step.y; /* the two would cancel */
        apart[k] = hypot(y[0] + y[FST_BEAD_NUMBERS], y[1] + y[FST_BEAD_NUMBERS + 1]);
    }
    free(flow);
    CHECK_CLOSE(log(apart[1] / apart[0]) / HALVES, log(fabs(cycle->re[0])), 1e-7);
}

static void test_opposite_pair(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS];
    const beads_world world = opposite(&params, model, state);
    beads_cycle *cycle = malloc(sizeof *cycle);
    guess(&world, state, 20, cycle);
    cycle->closing = BEADS_EXCHANGES;
    correct(&world, 1e-13, cycle);
    CHECK_CLOSE(cycle->mean_r[0], 0.92580221093, 5e-12);
    CHECK_CLOSE(cycle->mean_r[1], 0.92580221093, 5e-12);
    CHECK_CLOSE(1 + cycle->turned[0] / cycle->period / world.omega, -0.13233987620, 5e-12);
    assert_int_equal(cycle->size, 17);
    CHECK_CLOSE(cycle->re[0], -0.9991387,
                5e-8); /* the angle between the beads, which exchanging them reverses */
    CHECK_CLOSE(cycle->im[0], 0, 0);
    CHECK_CLOSE(cycle->trivial_error, 0, 1e-10);
    CHECK_CLOSE(cycle->power[BEADS_PLATE] + cycle->power[BEADS_PAIR], cycle->power[BEADS_DRIVE], 1e-13);
    check_slowest(&world, cycle);
    free(cycle);
    fst_model_free(model);
}

/* The orbit at another drive, from that at the present one; the greatest multiplier's size less 1. */
static double growth_at(beads_world *world, double frequency, beads_cycle *cycle)
{
    const double before = world->omega;
    world->omega = frequency * TURN / 312.5;
    cycle->period *= before / world->omega;
    for (int i = 0; i < 2 * FST_BEAD_NUMBERS; ++i)
        if (i % FST_BEAD_NUMBERS >= BEADS_W || (i % FST_BEAD_NUMBERS) / 3 == 1)
            cycle->state[i] *= world->omega / before;
    correct(world, 1e-11, cycle);
    return hypot(cycle->re[0], cycle->im[0]) - 1;
}

/* The opposite pair is unstable below 17.0207 Hz and between 24.750 and 27.237 Hz. */
static void test_windows(void **unused)
{
    (void)unused;
    static const struct {
        double below, above, at, digits;
    } cases[] = {{27.5, 27.0, 27.237, 5e-4}, {24.6, 24.9, 24.750, 5e-4}, {17.1, 16.9, 17.0207, 5e-5}};
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    double state[BEADS_NUMBERS];
    beads_world world = opposite(&params, model, state);
    beads_cycle *cycle = malloc(sizeof *cycle);
    guess(&world, state, 20, cycle);
    cycle->closing = BEADS_EXCHANGES;
    double frequency = 30;
    for (int i = 0; i < 3; ++i) {
        double from = cases[i].below, to = cases[i].above;
        for (; fabs(frequency - from) > 2.5; frequency += from > frequency ? 2.5 : -2.5)
            (void)growth_at(&world, frequency, cycle);
        double at_from = growth_at(&world, from, cycle), at_to = growth_at(&world, to, cycle);
        assert_true(at_from < 0 && at_to > 0);
        for (int k = 0; k < 12 && fabs(to - from) > 1e-4; ++k) {
            const double next = to - at_to * (to - from) / (at_to - at_from);
            from = to;
            at_from = at_to;
            at_to = growth_at(&world, next, cycle);
            to = next;
        }
        CHECK_CLOSE(to, cases[i].at, cases[i].digits);
        frequency = to;
    }
    free(cycle);
    fst_model_free(model);
}

/* One bead as a list of one: the orbit and the multipliers that the solver of single beads finds. */
static void test_single_bead(void **unused)
{
    (void)unused;
    fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    fst_orbit orbit;
    fst_error error;
    double state[BEADS_NUMBERS];
    place_bead(params, model, 3, state);
    const beads_world world = paper_beads(1, model, 1.0);
    beads_cycle *cycle = malloc(sizeof *cycle);
    guess(&world, state, 20, cycle);
    cycle->closing = BEADS_IMAGES;
    correct(&world, 1e-13, cycle);
    params.start_phi = 3;
    assert_int_equal(fst_orbit_find(&params, NULL, &orbit, &error), FST_OK);
    assert_int_equal(orbit.symmetry, FST_SYMMETRY_S2);
    CHECK_CLOSE(2 * cycle->period, orbit.means.period, 1e-10);
    CHECK_CLOSE(cycle->mean_r[0], orbit.means.mean_r, 1e-11);
    CHECK_CLOSE(world.omega + cycle->turned[0] / cycle->period, orbit.means.mean_alpha_dot, 1e-11);
    assert_int_equal(cycle->size, FST_MULTIPLIER_COUNT);
    for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i) {
        double nearest = INFINITY;
        for (int k = 0; k < FST_MULTIPLIER_COUNT; ++k)
            nearest = fmin(nearest,
                           hypot(cycle->re[i] - orbit.multiplier_re[k], cycle->im[i] - orbit.multiplier_im[k]));
        CHECK_CLOSE(nearest, 0, 1e-9);
    }
    free(cycle);
    fst_model_free(model);
}

/* A pair that snaps together on the way is refused. */
static void test_contacts_that_change(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    fst_error error;
    beads_cycle *cycle = calloc(1, sizeof *cycle);
    place_bead(params, model, 3, bead_of(cycle->state, 0));
    place_bead(params, model, 53, bead_of(cycle->state, 1));
    const beads_world world = paper_beads(2, model, 1.0);
    cycle->modes.contact[0] = cycle->modes.contact[1] = BEADS_PRESSING;
    cycle->period = 2 * TURN / world.omega;
    assert_int_equal(beads_cycle_correct(lapack(), &world, 1e-12, INFINITY, cycle, &error), FST_NO_CONVERGENCE);
    assert_non_null(strstr(error.sentence, "open and close"));
    free(cycle);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_opposite_pair), cmocka_unit_test(test_windows),
                                       cmocka_unit_test(test_single_bead),
                                       cmocka_unit_test(test_contacts_that_change)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
