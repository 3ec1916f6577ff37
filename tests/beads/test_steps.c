/* Time stepping of many beads: pairs that are near, the sum over all pairs, conserved quantities, the order of the
 * error, and the exact method's motion.
 *
 * tests: beads/steps.c beads/sweeps.c beads/near.c beads/dipoles.c beads/act.c */
#include "beads/steps.h"

#include "some_beads.h"

static const double EPS = 2.5 / 23;

/* Numbers from -1 to 1, the same ones always. */
static double any_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 4503599627370496.0 - 1.0;
}

/* Beads in a box of half width `wide`, with any directions and velocities. */
static void scatter(int count, double wide, double flat, uint64_t seed, double *state)
{
    for (int i = 0; i < FST_BEAD_NUMBERS * count; ++i)
        state[i] = any_number(&seed);
    for (int i = 0; i < count; ++i) {
        double *bead = bead_of(state, i), *n = bead + BEADS_N;
        const double norm = sqrt(beads_dot(n, n));
        for (int m = 0; m < 3; ++m) {
            bead[m] *= m == 2 ? flat : wide;
            n[m] /= norm;
        }
    }
}

static beads_steps *begin_steps(const beads_world *world, const double *state, double h)
{
    beads_steps *s = malloc(sizeof *s);
    fst_error error = {FST_OK, "", ""};
    assert_non_null(s);
    if (beads_steps_begin(s, world, state, h, &error) != FST_OK)
        fail_msg("beads_steps_begin: %s", error.sentence);
    return s;
}

static void make_steps(beads_steps *s, int64_t count)
{
    fst_error error = {FST_OK, "", ""};
    for (int64_t i = 0; i < count; ++i)
        if (beads_step(s, &error) != FST_OK)
            fail_msg("beads_step: %s", error.sentence);
}

static void end_steps(beads_steps *s)
{
    beads_steps_free(s);
    free(s);
}

/* Cells find the pairs that a look at all pairs finds, in their order, in boxes and layers dense and thin, of beads of
 * different sizes, over a plate and without. */
static void test_near(void **unused)
{
    (void)unused;
    enum { COUNT = 300 };
    static double state[FST_BEAD_NUMBERS * COUNT];
    static int gone[COUNT];
    beads_two *pairs = NULL;
    int64_t found = 0;
    for (int round = 0; round < 40; ++round) {
        static beads_world world;
        world = free_beads(COUNT);
        world.plate = round % 2 ? NAN : 0.3;
        scatter(COUNT, 0.2 * (1 + round % 7), round % 3 ? 0.0 : 0.5, (uint64_t)round, state);
        for (int i = 0; i < COUNT; ++i) {
            world.body[i].radius *= 0.3 + 0.7 * fabs(state[FST_BEAD_NUMBERS * i + BEADS_V]);
            gone[i] = i % 17 == round % 17;
        }
        const double within = 0.05 * (round % 5);
        int count, next = 0;
        assert_int_equal(beads_find_near(&world, gone, state, within, &pairs, &count, NULL), FST_OK);
        for (int i = 0; i < COUNT; ++i)
            for (int j = i + 1; j < COUNT; ++j) {
                double d[3];
                beads_way(&world, state, i, j, d);
                if (gone[i] || gone[j] ||
                    !(sqrt(beads_dot(d, d)) < world.body[i].radius + world.body[j].radius + within))
                    continue;
                assert_true(next < count);
                assert_int_equal(pairs[next].first, i);
                assert_int_equal(pairs[next++].second, j);
            }
        assert_int_equal(next, count);
        found += count;
    }
    assert_true(found > 10000);
    free(pairs);
}

/* The sum over all pairs: that of the pairs one by one; it has no force and no moment of force in all. */
static void test_dipoles(void **unused)
{
    (void)unused;
    enum { COUNT = 301, NUMBERS = BEADS_DIPOLE_IN + BEADS_DIPOLE_OUT };
    static double numbers[NUMBERS][COUNT], by_pairs[BEADS_DIPOLE_OUT][COUNT], state[FST_BEAD_NUMBERS * COUNT];
    beads_dipoles d = {.count = COUNT};
    double sum[BEADS_DIPOLE_OUT] = {0}, scale = 0.0;
    scatter(COUNT, 3.0, 3.0, 7, state);
    for (int q = 0; q < NUMBERS; ++q)
        *(q < BEADS_DIPOLE_IN ? &d.in[q] : &d.out[q - BEADS_DIPOLE_IN]) = numbers[q];
    for (int i = 0; i < COUNT; ++i) {
        const double *bead = bead_of(state, i);
        for (int m = 0; m < 3; ++m) {
            d.in[m][i] = bead[m];
            d.in[3 + m][i] = bead[BEADS_N + m];
        }
        d.in[6][i] = 1.0 + 0.5 * bead[BEADS_V];
    }
    for (int i = 0; i < COUNT; ++i)
        for (int j = i + 1; j < COUNT; ++j) {
            double way[3], force[3], on_i[3], on_j[3];
            for (int m = 0; m < 3; ++m)
                way[m] = d.in[m][j] - d.in[m][i];
            const double distance = sqrt(beads_dot(way, way));
            const double u[3] = {way[0] / distance, way[1] / distance, way[2] / distance};
            beads_dipoles_of(bead_of(state, i) + BEADS_N, bead_of(state, j) + BEADS_N, u, 1 / distance,
                             d.in[6][i] * d.in[6][j], force, on_i, on_j);
            for (int m = 0; m < 3; ++m) {
                by_pairs[m][j] += force[m];
                by_pairs[m][i] -= force[m];
                by_pairs[3 + m][i] += on_i[m];
                by_pairs[3 + m][j] += on_j[m];
            }
        }
    beads_sum_dipoles(&d);
    for (int i = 0; i < COUNT; ++i) {
        const double f[3] = {d.out[0][i], d.out[1][i], d.out[2][i]},
                     x[3] = {d.in[0][i], d.in[1][i], d.in[2][i]};
        double turning[3];
        fst_cross_double(x, f, turning);
        for (int m = 0; m < 3; ++m) {
            sum[m] += f[m];
            sum[3 + m] += turning[m] + d.out[3 + m][i];
            scale = fmax(scale, fabs(f[m]));
        }
    }
    for (int q = 0; q < BEADS_DIPOLE_OUT; ++q) {
        CHECK_CLOSE(greatest_difference(d.out[q], by_pairs[q], COUNT) / scale, 0, 1e-13);
        CHECK_CLOSE(sum[q] / scale, 0, 1e-12);
    }
}

/* Momentum and angular momentum of a cloud without plate and magnet, which falls together: all contacts are between
 * beads. */
static void test_momentum(void **unused)
{
    (void)unused;
    enum { COUNT = 12 };
    double state[FST_BEAD_NUMBERS * COUNT], before[6], after[6];
    beads_world world = free_beads(COUNT);
    beads_number_contacts(&world, 0.0, 1.0);
    world.restitution = 0.4;
    scatter(COUNT, 0.5, 0.5, 12, state);
    for (int i = 0; i < COUNT; ++i) {
        double *bead = bead_of(state, i);
        bead[0] = 0.6 * (i % 3);
        bead[1] = 0.6 * (i / 3 % 2);
        bead[2] = 0.6 * (i / 6);
        for (int m = 0; m < 3; ++m)
            bead[BEADS_V + m] *= 0.1;
    }
    beads_steps *s = begin_steps(&world, state, 2e-3);
    for (int round = 0; round < 2; ++round) {
        double *sum = round ? after : before;
        memset(sum, 0, 6 * sizeof *sum);
        for (int i = 0; i < COUNT; ++i) {
            const double *bead = bead_of(s->y, i);
            double moment[3];
            fst_cross_double(bead, bead + BEADS_V, moment);
            for (int m = 0; m < 3; ++m) {
                sum[m] += bead[BEADS_V + m];
                sum[3 + m] += moment[m] + world.body[i].inertia * bead[BEADS_W + m];
            }
        }
        if (!round)
            make_steps(s, 5000);
    }
    assert_true(s->counts[FST_BEAD_EVENT_TOUCH] > 10);
    assert_true(s->impacts > 0 && s->work[BEADS_PAIR] > 0);
    CHECK_CLOSE(greatest_difference(before, after, 6), 0, 1e-12);
    end_steps(s);
}

/* A bar's power at so many steps a turn: two or three beads that lie across the axis and turn with the magnet. */
static double bar_power(const beads_world *world, int steps_a_turn)
{
    double state[BEADS_NUMBERS] = {0};
    for (int i = 0; i < world->count; ++i) {
        double *bead = bead_of(state, i);
        bead[0] = (2 * EPS + 1e-10) * (i - 0.5 * (world->count - 1));
        bead[2] = world->count == 3 && i == 1 ? 0.05 * 2 * EPS : 0.0;
        bead[BEADS_V + 1] = world->omega * bead[0];
        bead[BEADS_N] = 1.0;
        bead[BEADS_W + 2] = world->omega;
    }
    beads_steps *s = begin_steps(world, state, TURN / (world->omega * steps_a_turn));
    make_steps(s, 150 * steps_a_turn);
    const double before = s->work[BEADS_PLATE] + s->work[BEADS_PAIR];
    make_steps(s, 10 * steps_a_turn);
    const double power = (s->work[BEADS_PLATE] + s->work[BEADS_PAIR] - before) / (10 * steps_a_turn * s->h);
    assert_true(s->deepest <
                1e-8); /* rates that the solver leaves add up: 1e-6 of what forces change in a step */
    end_steps(s);
    return power;
}

/* Where contacts last, halving the step quarters the error: bars at 30 Hz. */
static void test_bars(void **unused)
{
    (void)unused;
    static const double power[] = {0, 0, 5.53486e-5, 1.830241e-4};
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    for (int count = 2; count <= 3; ++count) {
        const beads_world world = paper_beads(count, model, 1.0);
        const double coarse = bar_power(&world, 1000), fine = bar_power(&world, 2000);
        CHECK_CLOSE(fine / power[count], 1, 2e-4);
        CHECK_CLOSE((4 * fine - coarse) / 3 / power[count], 1, 3e-6);
    }
    fst_model_free(model);
}

/* A dimer falls together along its axis: from d = 1 it touches at 7.40074790844 with the speed 0.97875695860; at
 * e_n = 0.5 it touches again at 7.5892800467.  Errors are of the order of the step. */
static void test_fall(void **unused)
{
    (void)unused;
    static const double times[] = {7.40074790844, 7.5892800467};
    double state[2 * FST_BEAD_NUMBERS] = {0};
    beads_world world = free_beads(2);
    world.restitution = 0.5;
    for (int i = 0; i < 2; ++i) {
        bead_of(state, i)[0] = i;
        bead_of(state, i)[BEADS_N] = 1.0;
    }
    for (double h = 2e-4; h > 0.5e-4; h /= 2) {
        beads_steps *s = begin_steps(&world, state, h);
        make_steps(s, (int64_t)(8.0 / h));
        assert_true(s->counts[FST_BEAD_EVENT_TOUCH] >= 2);
        for (int k = 0, e = 0; k < 2; ++k, ++e) {
            while (s->events[e].kind != FST_BEAD_EVENT_TOUCH)
                ++e;
            CHECK_CLOSE(s->events[e].time, times[k], (k ? 4 : 1.5) * h);
            CHECK_CLOSE(s->events[e].speed, k ? 0.5 * 0.97875695860 : 0.97875695860, 20 * h);
        }
        assert_true(s->deepest < 1e-12);
        end_steps(s);
    }
}

/* A ring of N beads whose moments follow it holds itself by forces of 3 |U|/(N d). */
static void test_rings(void **unused)
{
    (void)unused;
    static const double force[] = {[4] = 2.79961905, [6] = 3.42788232};
    for (int count = 4; count <= 6; count += 2) {
        double state[BEADS_NUMBERS] = {0};
        const beads_world world = free_beads(count);
        const double radius = EPS / sin(TURN / 2 / count);
        for (int i = 0; i < count; ++i) {
            double *bead = bead_of(state, i);
            bead[0] = radius * cos(TURN * i / count);
            bead[1] = radius * sin(TURN * i / count);
            bead[BEADS_N] = -sin(TURN * i / count);
            bead[BEADS_N + 1] = cos(TURN * i / count);
        }
        beads_steps *s = begin_steps(&world, state, 1e-3);
        make_steps(s, 1000);
        assert_int_equal(s->touch_count, count);
        for (int c = 0; c < count; ++c)
            CHECK_CLOSE(s->touches[c].push / s->h, force[count], 1e-6);
        CHECK_CLOSE(greatest_difference(s->y, state, FST_BEAD_NUMBERS * count), 0, 1e-6);
        end_steps(s);
    }
}

/* Thirty beads on the plate, close together: nothing sinks in by more than the solver leaves, the energy closes to the
 * order of the step, every contact takes energy, and the order of the beads in the list does not matter. */
static void test_crowd(void **unused)
{
    (void)unused;
    enum { COUNT = 30 };
    static double state[FST_BEAD_NUMBERS * COUNT], other[FST_BEAD_NUMBERS * COUNT];
    const fst_params params = at_30_hz();
    fst_model *model = model_of(&params);
    static beads_world world;
    world = paper_beads(COUNT, model, 1.0);
    double residual[2];
    for (int i = 0; i < COUNT; ++i) {
        double *bead = bead_of(state, i);
        bead[0] = 3 * EPS * (i % 6 - 2.5);
        bead[1] = 3 * EPS * (i / 6 - 2.0);
        bead[BEADS_N] = cos(2.4 * i);
        bead[BEADS_N + 1] = sin(2.4 * i);
        memcpy(bead_of(other, (7 * i + 3) % COUNT), bead, FST_BEAD_NUMBERS * sizeof *bead);
    }
    for (int fine = 0; fine < 2; ++fine) {
        const int steps_a_turn = fine ? 4000 : 1000;
        beads_steps *s = begin_steps(&world, state, TURN / (world.omega * steps_a_turn));
        const double energy = beads_energy(&world, s->gone, s->y);
        make_steps(s, steps_a_turn / 4);
        residual[fine] = fabs(beads_steps_residual(s, energy));
        assert_true(s->counts[FST_BEAD_EVENT_TOUCH] > 10);
        assert_true(s->work[BEADS_PLATE] > 0 && s->work[BEADS_PAIR] > 0 && s->impacts > 0);
        assert_true(s->deepest < 1e-9 && s->residual < 1e-7);
        end_steps(s);
    }
    beads_steps *one = begin_steps(&world, state, 1e-3), *two = begin_steps(&world, other, 1e-3);
    while (one->counts[FST_BEAD_EVENT_TOUCH] < 12)
        make_steps(one, 1);
    make_steps(two, one->steps);
    for (int i = 0; i < COUNT; ++i)
        CHECK_CLOSE(greatest_difference(bead_of(one->y, i), bead_of(two->y, (7 * i + 3) % COUNT), 6), 0, 1e-8);
    end_steps(one);
    end_steps(two);
    assert_true(residual[0] < 0.05 && residual[1] < 0.5 * residual[0]);
    fst_model_free(model);
}

/* Dry friction: a bead pushed without spin slides until its slip ends at (2/7) v/(mu g), and then rolls at 5/7 of its
 * speed for ever. */
static void test_dry(void **unused)
{
    (void)unused;
    double state[FST_BEAD_NUMBERS] = {0};
    beads_world world = free_beads(1);
    world.plate = 0.0;
    world.gravity = 10.0;
    world.plate_mu = 0.2;
    state[BEADS_V] = 1.0;
    state[BEADS_N] = 1.0;
    const double stops = 2.0 / 7 / (0.2 * 10.0);
    for (double h = 1e-3; h > 2e-4; h /= 2) {
        beads_steps *s = begin_steps(&world, state, h);
        const double energy = beads_energy(&world, s->gone, s->y);
        make_steps(s, (int64_t)(0.5 * stops / h));
        CHECK_CLOSE(s->y[BEADS_V], 1.0 - 0.2 * 10.0 * (double)s->steps * h, 1e-12);
        make_steps(s, (int64_t)(2 * stops / h));
        CHECK_CLOSE(s->y[BEADS_V], 5.0 / 7, 1e-9);
        CHECK_CLOSE(EPS * s->y[BEADS_W + 1], 5.0 / 7, 1e-9);
        CHECK_CLOSE(s->y[0], stops - 0.2 * 10.0 * stops * stops / 2 + 5.0 / 7 * ((double)s->steps * h - stops),
                    h);
        CHECK_CLOSE(s->work[BEADS_PLATE], 1.0 / 7, 1e-8);
        CHECK_CLOSE(beads_steps_residual(s, energy), 0, 1e-8);
        end_steps(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_near),  cmocka_unit_test(test_dipoles), cmocka_unit_test(test_momentum),
        cmocka_unit_test(test_bars),  cmocka_unit_test(test_fall),    cmocka_unit_test(test_rings),
        cmocka_unit_test(test_crowd), cmocka_unit_test(test_dry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
