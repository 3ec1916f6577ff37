/* Slow ramps of the drive: what each piece shows, and how a ramp waits for the motion to settle.
 * tests: study/ramp.c study/ramp_wait.c
 * labels: numbers */
#include "physics.h"

#include "base/constants.h"

enum { PIECES = 12 };

typedef struct ramp {
    int count;
    fst_ramp_point points[PIECES];
} ramp;

static fst_status keep_point(void *user, const fst_ramp_point *point, fst_error *error)
{
    (void)error;
    ramp *r = user;
    assert_true(r->count < PIECES);
    r->points[r->count++] = *point;
    return FST_OK;
}

static fst_run_result run_ramp_waiting(double from, double to, double periods, double wait, ramp *r)
{
    fst_params p = bead_at(from, FST_DYNAMICS_RIGID);
    p.run_periods = periods;
    p.run_discard = 100;
    fst_run_options options = fst_default_run_options();
    options.ramp_from = from;
    options.ramp_to = to;
    options.ramp_points = PIECES;
    options.ramp_wait = wait;
    options.sink.user = r;
    options.sink.ramp_point = keep_point;
    r->count = 0;
    fst_run_result result;
    assert_int_equal(fst_run(&p, &options, &result, NULL), FST_OK);
    return result;
}

static fst_run_result run_ramp(double from, double to, double periods, ramp *r)
{
    return run_ramp_waiting(from, to, periods, fst_default_run_options().ramp_wait, r);
}

/* A slow ramp through counter-rotation, where one attractor exists (besides its conjugate): each piece has the
 * means of a run at its drive, upwards and downwards. */
static void test_ramp_up_and_down(void **unused)
{
    (void)unused;
    ramp up, down;
    const fst_run_result end = run_ramp(0.32, 0.44, 1000, &up);
    CHECK_CLOSE(end.omega, 0.44, 1e-12);
    assert_true(end.periods > 1000); /* including the periods spent waiting */
    CHECK_CLOSE(run_ramp(0.44, 0.32, 1000, &down).omega, 0.32, 1e-12);
    assert_int_equal(up.count, PIECES);
    assert_int_equal(down.count, PIECES);
    for (int i = 0; i < PIECES; ++i) {
        const fst_ramp_point *a = &up.points[i], *b = &down.points[PIECES - 1 - i];
        CHECK_CLOSE(a->omega, 0.32 + 0.12 * (i + 0.5) / PIECES, 1e-12);
        assert_true(a->settled && b->settled);
        CHECK_CLOSE(a->frequency_hz, a->omega * 312.5 / TWO_PI, 1e-12);
        CHECK_CLOSE(a->mean_r, b->mean_r, 3e-4);
        CHECK_CLOSE(a->mean_alpha_dot, b->mean_alpha_dot, 1e-4);
        CHECK_CLOSE(a->mean_phi_dot + a->mean_alpha_dot, a->omega, 1e-4);
        if (i == 4) {
            const fst_params p = bead_at(a->omega, FST_DYNAMICS_RIGID);
            const fst_run_result still = run_of(&p);
            CHECK_CLOSE(a->mean_r, still.mean_r, 3e-4);
            CHECK_CLOSE(a->std_r, still.std_r, 3e-4);
            CHECK_CLOSE(a->mean_alpha_dot, still.mean_alpha_dot, 3e-5);
        }
    }
}

/* A ramp from a drive to the same drive is a run at that drive: the bits of the motion, and the means of each
 * piece. */
static void test_ramp_at_constant_drive(void **unused)
{
    (void)unused;
    ramp r;
    const fst_run_result ramped = run_ramp(0.405, 0.405, 250, &r);
    fst_params p = bead_at(0.405, FST_DYNAMICS_RIGID);
    p.run_periods = 250;
    p.run_discard = 100;
    const fst_run_result still = run_of(&p);
    assert_memory_equal(ramped.final_state, still.final_state, sizeof still.final_state);
    const fst_run_result almost = run_ramp_waiting(0.405, 0.405 * (1 + 1e-12), 250, 0.0, &r);
    CHECK_CLOSE(greatest_difference(almost.final_state, still.final_state, FST_STATE_SIZE), 0, 1e-7);
    assert_int_equal(r.count, PIECES);
    CHECK_CLOSE(r.points[PIECES - 1].mean_r, still.mean_r, 1e-8);
}

/* Up and down across the loss of counter-rotation the bead remembers where it came from: between 0.095 and
 * 0.165 it is bound to the magnet, above 0.19 it counter-rotates, whichever way it came. */
static void test_ramp_through_the_transition(void **unused)
{
    (void)unused;
    ramp up, down;
    (void)run_ramp(0.10, 0.30, 800, &up);
    (void)run_ramp(0.30, 0.10, 800, &down);
    assert_int_equal(up.count, PIECES);
    assert_int_equal(down.count, PIECES);
    CHECK_CLOSE(up.points[0].mean_alpha_dot, up.points[0].omega, 1e-3);
    CHECK_CLOSE(down.points[PIECES - 1].mean_alpha_dot, down.points[PIECES - 1].omega, 1e-3);
    CHECK_WITHIN(up.points[PIECES - 1].mean_alpha_dot, -0.07, -0.05);
    CHECK_WITHIN(down.points[0].mean_alpha_dot, -0.07, -0.05);
}

/* A piece with two half returns holds no whole return to take means over, and must not divide by zero. */
static void test_ramp_in_short_pieces(void **unused)
{
    (void)unused;
    for (double turns = 6; turns < 14; turns += 0.5) {
        fst_params p = bead_at(0.40, FST_DYNAMICS_RIGID);
        p.run_discard = 20;
        p.run_periods = 20 + turns;
        fst_run_options options = fst_default_run_options();
        ramp r = {.count = 0};
        options.ramp_from = 0.40;
        options.ramp_to = 0.39;
        options.ramp_points = PIECES;
        options.ramp_wait = 0;
        options.sink.user = &r;
        options.sink.ramp_point = keep_point;
        fst_run_result result;
        assert_int_equal(fst_run(&p, &options, &result, NULL), FST_OK);
        assert_int_equal(r.count, PIECES);
        CHECK_CLOSE(result.omega, 0.39, 1e-12);
        for (int i = 0; i < PIECES; ++i) {
            CHECK_WITHIN(r.points[i].mean_r, 0.5, 1.5);
            CHECK_WITHIN(r.points[i].mean_alpha_dot, -0.4, 0.4);
            assert_true(isfinite(r.points[i].std_r) && isfinite(r.points[i].mean_phi_dot) &&
                        isfinite(r.points[i].mean_nz));
            assert_false(r.points[i].settled);
        }
        assert_non_null(strstr(result.reason, "leaves it late"));
    }
}

/* The ramp waits where the symmetric orbit loses its stability: <n_z> departs from zero, and returns to it,
 * within a piece and a half of the period halving, and beyond has the value of the branch. */
static void test_ramp_through_the_period_halving(void **unused)
{
    (void)unused;
    enum { FINE = 12 };
    for (int dynamics = 0; dynamics < 2; ++dynamics)
        for (int down = 0; down < 2; ++down) {
            const double halving = dynamics ? 0.289726 : 0.268853, width = 0.004;
            const double low = halving - 7.2 * width, high = low + FINE * width;
            fst_params p = bead_at(low, (fst_dynamics)dynamics);
            fst_run_options options = fst_default_run_options();
            ramp r = {.count = 0};
            options.ramp_from = down ? high : low;
            options.ramp_to = down ? low : high;
            options.ramp_points = FINE;
            options.sink.user = &r;
            options.sink.ramp_point = keep_point;
            fst_run_result result;
            assert_int_equal(fst_run(&p, &options, &result, NULL), FST_OK);
            assert_int_equal(r.count, FINE);
            int settled = 0;
            for (int i = 0; i < FINE; ++i) {
                const double beyond = r.points[i].omega - halving;
                settled += r.points[i].settled;
                if (beyond > 1.5 * width)
                    CHECK_WITHIN(fabs(r.points[i].mean_nz), 0, 1e-6);
                if (beyond < -1.5 * width)
                    CHECK_WITHIN(fabs(r.points[i].mean_nz), 0.05, 0.3);
                if (beyond < -1.5 * width && i % 3 == 0) {
                    const fst_params still = bead_at(r.points[i].omega, (fst_dynamics)dynamics);
                    const fst_run_result settled_there = run_of(&still);
                    CHECK_WITHIN(fabs(r.points[i].mean_nz) - fabs(settled_there.mean_nz), -2e-5, 2e-5);
                    CHECK_WITHIN(r.points[i].mean_r - settled_there.mean_r, -1e-5, 1e-5);
                }
            }
            assert_true(settled >= FINE - 2);
            CHECK_CLOSE(result.omega, down ? low : high, 1e-12);
        }
}

/* A steady ramp lags behind the settled orbits of a waiting one; on both, the drive's angle is the integral of
 * its rate. */
static void test_steady_ramp(void **unused)
{
    (void)unused;
    ramp r;
    const fst_run_result end = run_ramp_waiting(0.32, 0.44, 1000, 0.0, &r);
    CHECK_CLOSE(end.omega, 0.44, 1e-12);
    CHECK_CLOSE(end.periods, 1000, 1e-6);
    for (int i = 0; i < PIECES; ++i)
        CHECK_CLOSE(r.points[i].omega, 0.32 + 0.12 * (i + 0.5) / PIECES, 2e-4);
}

/* The bits of a ramp's end, as the version before the heart was made anew has them: how long a ramp lasts is
 * rounded in one way only.  festoon run --set run.rtol=1e-7 --set run.periods=12 --set run.discard=3 --ramp 10.7Hz:11Hz
 * --ramp-points 6 --ramp-wait 0 --json */
static void test_bits_of_a_ramp(void **unused)
{
    (void)unused;
    ramp r = {.count = 0};
    fst_params p = fst_default_params();
    p.run_rtol = 1e-7;
    p.run_periods = 12;
    p.run_discard = 3;
    fst_run_options options = fst_default_run_options();
    options.ramp_from = 10.7 * (FST_TWO_PI / p.friction_gamma);
    options.ramp_to = 11.0 * (FST_TWO_PI / p.friction_gamma);
    options.ramp_points = 6;
    options.ramp_wait = 0;
    options.sink.user = &r;
    options.sink.ramp_point = keep_point;
    fst_run_result end;
    assert_int_equal(fst_run(&p, &options, &end, NULL), FST_OK);
    CHECK_SAME_BITS(end.end_time, 346.83341229165774);
    CHECK_SAME_BITS(end.final_state[FST_X], -0.13070932472073127);
    CHECK_SAME_BITS(end.final_state[FST_WZ], 0.023962164915161607);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ramp_up_and_down),
        cmocka_unit_test(test_ramp_at_constant_drive),
        cmocka_unit_test(test_ramp_through_the_transition),
        cmocka_unit_test(test_ramp_in_short_pieces),
        cmocka_unit_test(test_ramp_through_the_period_halving),
        cmocka_unit_test(test_steady_ramp),
        cmocka_unit_test(test_bits_of_a_ramp),
    };
    return cmocka_run_group_tests_name("ramps", tests, NULL, NULL);
}
