/* Equilibria of several beads: bars and arches against numbers of an independent program, eigenvalues against motions
 * that grow or decay, continua, and a single bead against the solver of single beads.
 *
 * tests: orbit/beads_lock.c beads/manifold.c orbit/lapack_module.c */
#include "some_beads.h"

#include "beads/impact.h"
#include "orbit/beads_lock.h"

static const double EPS = 2.5 / 23;

static const fst_lapack *lapack(void)
{
    const fst_lapack *found;
    fst_error error;
    assert_int_equal(fst_lapack_load(&found, &error), FST_OK);
    return found;
}

/* A guess at the arch of a bar: heights of a parabola, the ends on the plate. */
static void guess_arch(const beads_world *world, double rise, beads_lock *lock)
{
    const int count = world->count;
    memset(lock, 0, sizeof *lock);
    for (int i = 0; i < count; ++i) {
        double *bead = bead_of(lock->state, i);
        const double x = 2.0 * i / (count - 1) - 1.0;
        bead[0] = (2 * i - (count - 1)) * EPS;
        bead[2] = 2 * EPS * rise * (1 - x * x);
        bead[BEADS_V + 1] = world->omega * bead[0];
        bead[BEADS_N] = -1;
        bead[BEADS_W + 2] = world->omega;
        if (i == 0 || i == count - 1)
            lock->modes.contact[i] = BEADS_PRESSING;
    }
    for (int k = count; k < world->contacts; ++k)
        if (world->contact[k].second == world->contact[k].first + 1)
            lock->modes.contact[k] = BEADS_PRESSING;
}

static void correct(const beads_world *world, beads_lock *lock)
{
    fst_error error = {FST_OK, "", ""};
    if (beads_lock_correct(lapack(), NULL, world, lock, &error) != FST_OK)
        fail_msg("beads_lock_correct: %s", error.sentence);
}

/* Bars at 30 Hz with gamma_b = 1: heights over 2 eps, loads at the ends in weights, contact forces, power. */
static void test_arches(void **unused)
{
    (void)unused;
    static const struct {
        int count, size;
        double height[3], load, force, power;
    } cases[] = {{2, 16, {0}, 19.72219, 3.29360694, 5.53486e-5},
                 {3, 25, {0, 0.05165622}, 30.21196, 3.46217435, 1.830241e-4},
                 {5, 43, {0, 0.138695, 0.176550}, 52.84548, 0, 1.278730e-3}};
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    beads_lock *lock = malloc(sizeof *lock);
    for (int i = 0; i < 3; ++i) {
        const int count = cases[i].count;
        const beads_world world = paper_beads(count, model, 1.0);
        beads_look look;
        guess_arch(&world, 0.1, lock);
        correct(&world, lock);
        beads_look_at(&world, &lock->modes, lock->state, &look);
        assert_int_equal(lock->size, cases[i].size);
        assert_int_equal(lock->free, 0);
        assert_int_equal(lock->unstable, 0);
        for (int k = 0; k < count; ++k) {
            const int from_end = k < count - 1 - k ? k : count - 1 - k;
            CHECK_CLOSE(bead_of(lock->state, k)[2] / (2 * EPS), cases[i].height[from_end],
                        count == 5 ? 5e-7 : 5e-9);
            CHECK_CLOSE(look.held[k] / world.gravity, from_end ? 0 : cases[i].load, 5e-6);
        }
        for (int k = count; cases[i].force > 0 && k < world.contacts; ++k)
            if (lock->modes.contact[k] == BEADS_PRESSING)
                CHECK_CLOSE(look.held[k], cases[i].force, 5e-9);
        CHECK_CLOSE(look.power[BEADS_DRIVE], cases[i].power, count == 2 ? 5e-11 : 5e-10);
        CHECK_CLOSE(look.power[BEADS_PLATE] + look.power[BEADS_PAIR], look.power[BEADS_DRIVE], 1e-13);
    }
    free(lock);
    fst_model_free(model);
}

/* Held flat, a bar of three pulls its middle bead upwards with 31 weights. */
static void test_flat_bar(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    const beads_world world = paper_beads(3, model, 1.0);
    beads_lock *lock = malloc(sizeof *lock);
    beads_look look;
    guess_arch(&world, 0.0, lock);
    lock->modes.contact[1] = BEADS_PRESSING;
    correct(&world, lock);
    beads_look_at(&world, &lock->modes, lock->state, &look);
    CHECK_CLOSE(look.held[1] / world.gravity, -31, 0.5);
    free(lock);
    fst_model_free(model);
}

/* Without friction between beads the spin of the lifted one is free: a continuum with one direction, along which the
 * state keeps the place of its start; the bar is stable all the same, and needs no power. */
static void test_continuum(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    const beads_world world = paper_beads(3, model, 0.0);
    beads_lock *lock = malloc(sizeof *lock);
    for (int spin = 0; spin < 2; ++spin) {
        guess_arch(&world, 0.05, lock);
        bead_of(lock->state, 1)[BEADS_W] = 3.0 * spin;
        correct(&world, lock);
        const double *middle = bead_of(lock->state, 1);
        assert_int_equal(lock->free, 1);
        assert_int_equal(lock->unstable, 0);
        CHECK_CLOSE(beads_dot(middle + BEADS_N, middle + BEADS_W), -3.0 * spin, 0.05);
        int zeros = 0;
        for (int i = 0; i < lock->size; ++i)
            zeros += hypot(lock->re[i], lock->im[i]) < 1e-8;
        assert_int_equal(zeros, 1);
        beads_look look;
        beads_look_at(&world, &lock->modes, lock->state, &look);
        CHECK_CLOSE(look.power[BEADS_DRIVE], 0, 1e-14);
    }
    free(lock);
    fst_model_free(model);
}

/* The state after the time `after`, a beads_map. */
typedef struct passage {
    const beads_world *world;
    const beads_modes *modes;
    double after;
} passage;

static fst_status pass(void *user, const double *y, double *out, fst_error *error)
{
    const passage *of = user;
    double start[BEADS_NUMBERS];
    (void)error;
    memcpy(start, y, (size_t)(FST_BEAD_NUMBERS * of->world->count) * sizeof *start);
    beads_project(of->world, of->modes, start);
    beads_flow *flow = begin_beads(of->world, start, 1e-13);
    go_to(flow, of->after);
    memcpy(out, flow->step.y, (size_t)(FST_BEAD_NUMBERS * of->world->count) * sizeof *out);
    free(flow);
    return FST_OK;
}

/* Each eigenvalue's exp(lambda t) is an eigenvalue of the derivative of the motion over the time t. */
static void check_rates(const beads_world *world, const beads_lock *lock, double tolerance)
{
    enum { SIDE = BEADS_NUMBERS };
    static double matrix[SIDE * SIDE];
    double re[SIDE], im[SIDE];
    beads_manifold *manifold = malloc(sizeof *manifold);
    passage by = {world, &lock->modes, 0.2};
    fst_error error;
    beads_span(world, &lock->modes, lock->state, NULL, manifold);
    assert_int_equal(manifold->size, lock->size);
    assert_int_equal(beads_derivative(manifold, pass, &by, lock->state, 0.2 * BEADS_REACH, matrix, &error),
                     FST_OK);
    assert_int_equal(lapack()->eigen(lock->size, matrix, re, im, NULL), 0);
    for (int i = 0; i < lock->size; ++i) {
        const double size = exp(lock->re[i] * by.after), angle = lock->im[i] * by.after;
        double nearest = INFINITY;
        for (int k = 0; k < lock->size; ++k)
            nearest = fmin(nearest, hypot(re[k] - size * cos(angle), im[k] - size * sin(angle)));
        CHECK_CLOSE(nearest, 0, tolerance);
    }
    free(manifold);
}

static void test_rates_of_motion(void **unused)
{
    (void)unused;
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    beads_lock *lock = malloc(sizeof *lock);
    for (int count = 2; count <= 3; ++count) {
        const beads_world world = paper_beads(count, model, 1.0);
        guess_arch(&world, 0.05, lock);
        correct(&world, lock);
        check_rates(&world, lock, 1e-10);
    }
    free(lock);
    fst_model_free(model);
}

/* A single bead that is locked on the plate, as the solver of single beads finds it. */
static void test_single_bead(void **unused)
{
    (void)unused;
    fst_params params = fst_default_params();
    fst_locked_list list;
    fst_error error;
    params.drive_frequency = 5;
    fst_model *model = model_of(&params);
    const beads_world world = paper_beads(1, model, 1.0);
    beads_lock *lock = malloc(sizeof *lock);
    assert_int_equal(fst_locked_find(&params, NULL, &list, &error), FST_OK);
    assert_true(list.count > 0);
    for (size_t s = 0; s < list.count && s < 5; ++s) {
        const fst_locked *single = &list.states[s];
        memset(lock, 0, sizeof *lock);
        lock->modes.contact[0] = BEADS_PRESSING;
        memcpy(lock->state, single->state + FST_X, 2 * sizeof(double));
        memcpy(lock->state + BEADS_V, single->state + FST_VX, 2 * sizeof(double));
        memcpy(lock->state + BEADS_N, single->state + FST_NX, 6 * sizeof(double));
        lock->state[0] += 1e-4;
        correct(&world, lock);
        CHECK_CLOSE(greatest_difference(lock->state, single->state, 2), 0, 1e-10);
        assert_int_equal(lock->size, FST_EIGENVALUE_COUNT);
        assert_int_equal(lock->unstable == 0, single->stable);
        for (int i = 0; i < FST_EIGENVALUE_COUNT; ++i) {
            double nearest = INFINITY;
            for (int k = 0; k < FST_EIGENVALUE_COUNT; ++k)
                nearest = fmin(nearest, hypot(lock->re[i] - single->eigenvalue_re[k],
                                              lock->im[i] - single->eigenvalue_im[k]));
            CHECK_CLOSE(nearest, 0, 1e-8);
        }
    }
    fst_locked_free(&list);
    free(lock);
    fst_model_free(model);
}

/* In a bowl too the rates are those of the motion. */
static void test_bowl(void **unused)
{
    (void)unused;
    fst_params params = fst_default_params();
    fst_locked_list list;
    fst_error error;
    params.drive_frequency = 5;
    fst_model *model = model_of(&params);
    beads_world world = paper_beads(1, model, 1.0);
    world.bowl = 4.0;
    world.gravity *= 50; /* the magnet alone would lift it where the bowl is steep */
    beads_lock *lock = calloc(1, sizeof *lock);
    assert_int_equal(fst_locked_find(&params, NULL, &list, &error), FST_OK);
    size_t off_axis = 0;
    while (off_axis < list.count && list.states[off_axis].r < 0.2)
        ++off_axis;
    assert_true(off_axis < list.count);
    const double *single = list.states[off_axis].state;
    lock->modes.contact[0] = BEADS_PRESSING;
    memcpy(lock->state, single + FST_X, 2 * sizeof(double));
    memcpy(lock->state + BEADS_V, single + FST_VX, 2 * sizeof(double));
    memcpy(lock->state + BEADS_N, single + FST_NX, 6 * sizeof(double));
    correct(&world, lock);
    int which;
    assert_true(lock->state[2] > 1e-3);
    assert_true(beads_lock_least_force(&world, lock, &which) > 0 && which == 0);
    check_rates(&world, lock, 1e-10);
    fst_locked_free(&list);
    free(lock);
    fst_model_free(model);
}

/* ------------------------------------------------------------------ levitation, in units of a metre and a second */

static const double TILT = 5 * TURN / 360, ROTOR = 0.0095, FLOATER = 0.00635, REMANENCE = 1.2, DENSITY = 7500;

static double moment_of(double radius)
{
    return REMANENCE / (2e-7 * TURN) * (2 * TURN / 3) * radius * radius * radius;
}

/* The field of a dipole along (cos TILT, 0, sin TILT) at the origin. */
static void field_of_rotor(const void *unused, double x, double y, double z, double b[3],
                           fst_gradient_double *g)
{
    (void)unused;
    const double m[3] = {cos(TILT), 0, sin(TILT)}, r[3] = {x, y, z}, d2 = beads_dot(r, r), d = sqrt(d2);
    const double k = 1e-7 * moment_of(ROTOR) / (d2 * d2 * d), mr = beads_dot(m, r);
    double all[3][3];
    for (int i = 0; i < 3; ++i) {
        b[i] = k * (3 * mr * r[i] - d2 * m[i]);
        for (int j = 0; j < 3; ++j)
            all[i][j] = 3 * k * (m[j] * r[i] + m[i] * r[j] + (i == j) * mr - 5 * mr * r[i] * r[j] / d2);
    }
    *g = (fst_gradient_double){
        .xx = all[0][0], .yy = all[1][1], .xy = all[0][1], .xz = all[0][2], .yz = all[1][2], .yx = all[0][1]};
}

/* A sphere of 12.7 mm about a turning one of 19 mm, with these damping rates; a guess at its place. */
static beads_world floater(double gravity, double frequency, double drag, double spin_drag, beads_lock *lock)
{
    const double inertia = 0.4 * FLOATER * FLOATER;
    beads_world world = free_beads(1);
    world.body[0] = (beads_body){.radius = FLOATER,
                                 .mass = 1.0,
                                 .inertia = inertia,
                                 .strength = moment_of(FLOATER) / (DENSITY * (2 * TURN / 3) * pow(FLOATER, 3)),
                                 .drag = drag,
                                 .spin_drag = spin_drag * inertia};
    world.omega = frequency * TURN;
    world.field = field_of_rotor;
    world.gravity = gravity;
    memset(lock, 0, sizeof *lock);
    double *x = lock->state, *n = x + BEADS_N, *w = x + BEADS_W;
    x[2] = 0.0236;
    n[0] = 0.1;
    n[2] = sqrt(1 - n[0] * n[0]);
    for (int k = 0; k < 3; ++k) /* no spin about n */
        w[k] = world.omega * ((k == 2) - n[2] * n[k]);
    return world;
}

/* At 200 Hz and 5 degrees: distance, tilt and circle (mm) of an independent program. */
static void test_levitation(void **unused)
{
    (void)unused;
    static const struct {
        double gravity, distance, tilt, circle;
    } cases[] = {{0, 23.772, 0, 0}, {-9.81, 25.056, 6.35, 0.210}, {9.81, 23.021, 0, 0}};
    beads_lock *lock = malloc(sizeof *lock);
    for (int i = 0; i < 3; ++i) {
        beads_world world = floater(cases[i].gravity, 200, 1, 1, lock);
        const double *x = lock->state, *n = x + BEADS_N;
        correct(&world, lock);
        CHECK_CLOSE(1e3 * x[2], cases[i].distance, 6e-4);
        if (cases[i].tilt > 0) {
            CHECK_CLOSE(asin(hypot(n[0], n[1])) * 360 / TURN, cases[i].tilt, 6e-3);
            CHECK_CLOSE(1e3 * hypot(x[0], x[1]), cases[i].circle, 6e-4);
        }
        CHECK_CLOSE(beads_dot(n, x + BEADS_W) / world.omega, 0, 1e-12);
        assert_int_equal(lock->size, 11);
        assert_int_equal(lock->free, 0);
        CHECK_CLOSE(lock->re[0], -0.5, 0.05);

        world =
            floater(cases[i].gravity, 200, 0, 0, lock); /* the spin is free then, and all rates are imaginary */
        correct(&world, lock);
        assert_int_equal(lock->free, 1);
        assert_int_equal(lock->unstable, 0);
        for (int k = 0; k < lock->size; ++k)
            CHECK_CLOSE(lock->re[k], 0, 1e-9);
    }
    /* Drag of rotation alone makes it unstable; a hundredth of it for the place suffices against that. */
    beads_world world = floater(-9.81, 200, 0, 1, lock);
    correct(&world, lock);
    CHECK_CLOSE(lock->re[0], 0.0046, 1e-4);
    world = floater(-9.81, 200, 0.01, 1, lock);
    correct(&world, lock);
    assert_int_equal(lock->unstable, 0);
    free(lock);
}

static fst_status world_at(void *gravity, double frequency, beads_world *world, fst_error *error)
{
    (void)error;
    beads_lock *unused = malloc(sizeof *unused);
    *world = floater(*(double *)gravity, frequency, 1, 1, unused);
    free(unused);
    return FST_OK;
}

/* Below the magnet it flies from 162.1 Hz: there the curve over the frequency turns back, and stability is lost. */
static void test_fold(void **unused)
{
    (void)unused;
    double gravity = -9.81, value = 200, way[BEADS_NUMBERS + 1] = {0}, least = value;
    const beads_free_world over = {world_at, &gravity, 200};
    beads_lock *lock = malloc(sizeof *lock);
    fst_error error;
    const beads_world world = floater(gravity, 200, 1, 1, lock);
    correct(&world, lock);
    way[FST_BEAD_NUMBERS] = -1;
    assert_int_equal(beads_lock_across(lapack(), NULL, &over, &value, lock, way, &error), FST_OK);
    int was_stable = 1;
    for (int i = 0; i < 400 && (way[FST_BEAD_NUMBERS] < 0 || was_stable); ++i) {
        was_stable = lock->unstable == 0;
        for (int k = 0; k < FST_BEAD_NUMBERS; ++k)
            lock->state[k] += 0.01 * way[k];
        value += 0.01 * way[FST_BEAD_NUMBERS] * over.scale;
        assert_int_equal(beads_lock_across(lapack(), NULL, &over, &value, lock, way, &error), FST_OK);
        least = fmin(least, value);
    }
    CHECK_CLOSE(least, 162.1, 0.1);
    assert_true(lock->unstable > 0);
    free(lock);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_arches),      cmocka_unit_test(test_flat_bar),
        cmocka_unit_test(test_continuum),   cmocka_unit_test(test_rates_of_motion),
        cmocka_unit_test(test_single_bead), cmocka_unit_test(test_levitation),
        cmocka_unit_test(test_fold),        cmocka_unit_test(test_bowl)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
