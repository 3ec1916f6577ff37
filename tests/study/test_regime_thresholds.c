/* Every threshold by which a regime is decided, with a case just on either side. The runs are made up: their
 * marks hold what a real run would have left, so that one number at a time decides.
 * tests: study/regime.c study/drift.c
 * labels: memcheck */
#include <stdio.h>
#include <stdlib.h>

#include "physics.h"
#include "study/drift.h"
#include "study/regime.h"

enum { BLOCKS = FST_MARKS - 1 }; /* as many as a long run keeps */

/* What a made-up run looks like.  The beginning is a librating or a turning bead with nothing special. */
typedef struct made_up {
    int turns, crossings, blocks;
    double rtol, speed_at_end, activity[2]; /* activity in both halves of the window */
    double phi_range;
    double half[2], full[2]; /* distances of returns: in the middle of the window, at its end */
    double alpha_dot, alpha_dot_error;
    double growth;     /* exponent times duration */
    double chance;     /* the part of the exponent's error that is chance, times duration */
    double r_rise;     /* steady rise of <r> over the blocks */
    double r_scatter;  /* alternating part of <r> from block to block */
    double r_slow;     /* slow swing of <r>, two cycles in the window */
    double alpha_rise; /* steady rise of <alpha'> over the blocks, for a turning bead */
    double swing[2];   /* delta r in the first block and in the last */
    int without_friction, on_axis;
    int64_t periods;         /* number of whole drive periods, if it differs from the number of blocks */
    double full_before_last; /* the full distance of the mark before the last, if not 0 */
    double kappa;
} made_up;

static const made_up LIBRATING = {.blocks = BLOCKS,
                                  .rtol = 1e-10,
                                  .speed_at_end = 0.1,
                                  .activity = {0.1, 0.1},
                                  .phi_range = 0.5,
                                  .alpha_dot = 0.3,
                                  .growth = -1.0,
                                  .swing = {0.1, 0.1},
                                  .kappa = 1.5};
static const made_up TURNING = {.turns = 1,
                                .crossings = 65,
                                .blocks = BLOCKS,
                                .rtol = 1e-10,
                                .speed_at_end = 0.1,
                                .activity = {0.1, 0.1},
                                .phi_range = 100,
                                .half = {0.5, 0.5},
                                .full = {0.2, 0.2},
                                .alpha_dot = -0.05,
                                .alpha_dot_error = 1e-6,
                                .growth = -1.0,
                                .swing = {0.1, 0.1},
                                .kappa = 1.5};

static void fill_marks(fst_mark_series *series, const made_up *m, double from, double step)
{
    fst_marks_begin(series);
    double r_integral = 0.0, r2_integral = 0.0, alpha_rise = 0.0;
    for (int i = 0; i <= m->blocks; ++i) {
        fst_mark mark;
        memset(&mark, 0, sizeof mark);
        mark.t.high = from + i * step;
        mark.omega = 0.3;
        mark.integrals[FST_Q_R] = r_integral;
        mark.integrals[FST_Q_R2] = r2_integral;
        mark.bead_angle = (m->turns ? m->alpha_dot - 0.3 : 0.0) * mark.t.high + alpha_rise;
        const int late = 2 * i > m->blocks;
        mark.half_distance = m->half[2 * i >= m->blocks + 2];
        mark.full_distance = m->full[2 * i >= m->blocks + 2];
        mark.activity = m->activity[late];
        fst_marks_offer(series, &mark);
        const double part = (double)i / (m->blocks - 1);
        const double r = 1.0 + m->r_rise * (part - 0.5) + (i % 2 ? m->r_scatter : -m->r_scatter) +
                         m->r_slow * sin(2 * TWO_PI * part);
        const double swing = m->swing[0] * pow(m->swing[1] / m->swing[0], part);
        r_integral += r * step;
        alpha_rise += m->alpha_rise * (part - 0.5) * step;
        r2_integral += ((r - 1.0) * (r - 1.0) + swing * swing) * step;
    }
}

static fst_run_result decide(const made_up *m)
{
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.run_rtol = m->rtol;
    p.model_kappa = m->kappa;
    p.friction_law = m->without_friction ? FST_FRICTION_NONE : FST_FRICTION_VISCOUS;
    fst_watched_run *run = calloc(1, sizeof *run);
    assert_non_null(run);
    assert_int_equal(fst_watched_run_begin(run, &p, NULL, NULL), FST_OK);
    const double step = TWO_PI / 0.3;
    fst_window *window = &run->window;
    window->quadrature.sums.r_reference = 1.0;
    fill_marks(&window->periods, m, 0.0, step);
    fill_marks(&window->returns.marks, m, 0.0, step);
    if (m->periods > 0)
        window->periods.offered = m->periods;
    if (m->full_before_last > 0)
        window->returns.marks.kept[m->blocks - 1].full_distance = m->full_before_last;
    run->flow->t.high = m->blocks * step;
    double *slope = FST_PATH_SLOPE(&run->flow->step, FST_PATH_END);
    memset(slope, 0, FST_STATE_SIZE * sizeof *slope);
    slope[FST_X] = m->speed_at_end;
    window->returns.crossings = m->turns ? m->crossings : 0;
    window->returns.since_break = window->returns.crossings;
    window->least_bead_angle = 0.0;
    window->greatest_bead_angle = m->phi_range;
    const fst_exponent exponent = {
        .duration = 1000.0, .value = m->growth / 1000.0, .chance = m->chance / 1000.0, .standard_error = 1e-9};
    fst_run_result result;
    memset(&result, 0, sizeof result);
    result.omega = 0.3;
    result.mean_r = m->on_axis ? 0.0 : 1.0;
    result.mean_alpha_dot = m->alpha_dot;
    result.mean_alpha_dot_error = m->alpha_dot_error;
    assert_true(fst_decide_regime(run, &exponent, &result));
    fst_watched_run_free(run);
    free(run);
    return result;
}

static void expect(const made_up *m, fst_regime regime, const char *why)
{
    const fst_run_result r = decide(m);
    if (r.regime != regime || !strstr(r.reason, why))
        fail_msg("%s (%s), expected %s (%s)", fst_regime_name(r.regime), r.reason, fst_regime_name(regime),
                 why);
}

/* Checks the regimes with one member of a made-up run just below and just above a threshold. */
#define EITHER_SIDE(base, member, below, regime_below, why_below, above, regime_above, why_above)              \
    do {                                                                                                       \
        made_up either = (base);                                                                               \
        either.member = (below);                                                                               \
        expect(&either, (regime_below), (why_below));                                                          \
        either.member = (above);                                                                               \
        expect(&either, (regime_above), (why_above));                                                          \
    } while (0)

static void test_beginnings(void **unused)
{
    (void)unused;
    expect(&LIBRATING, FST_REGIME_LIBRATING, "does not die out");
    expect(&TURNING, FST_REGIME_COUNTER_ROTATING, "does not close");
}

static void test_at_rest(void **unused)
{
    (void)unused;
    EITHER_SIDE(LIBRATING, speed_at_end, 0.9e-8, FST_REGIME_LOCKED, "at rest", 1.1e-8, FST_REGIME_LIBRATING,
                "die out");
    made_up loose = LIBRATING;
    loose.rtol = 1e-6;
    EITHER_SIDE(loose, speed_at_end, 0.9e-6, FST_REGIME_LOCKED, "at rest", 1.1e-6, FST_REGIME_LIBRATING,
                "die out");
}

static void set_activity(made_up *m, double early, double late)
{
    m->activity[0] = early;
    m->activity[1] = late;
}

/* Motion slower than 100 run.rtol is the integrator's noise. If a strong magnet holds the bead in place, so is
 * motion slower than what its torque makes of an error in n of 50 run.rtol. */
static void test_noise(void **unused)
{
    (void)unused;
    made_up m = LIBRATING;
    m.rtol = 1e-9;
    set_activity(&m, 0.95e-7, 0.95e-7);
    expect(&m, FST_REGIME_LOCKED, "noise");
    set_activity(&m, 1.05e-7, 1.05e-7);
    expect(&m, FST_REGIME_LIBRATING, "die out");
    m.rtol = 1e-10;
    m.kappa = 1e4;
    m.phi_range = 0.95e-9;
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], b[3], gradient[3][3];
    start_of(&p, model, start);
    fst_field(model, start[FST_X], start[FST_Y], b, gradient);
    fst_model_free(model);
    const double floor_of_torque = 50e-10 * 2.5 * 1e4 * sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    set_activity(&m, 0.95 * floor_of_torque, 0.95 * floor_of_torque);
    expect(&m, FST_REGIME_LOCKED, "noise");
    set_activity(&m, 1.05 * floor_of_torque, 1.05 * floor_of_torque);
    expect(&m, FST_REGIME_LIBRATING, "die out");
    set_activity(&m, 0.95 * floor_of_torque, 0.95 * floor_of_torque);
    m.phi_range = 1.05e-9;
    expect(&m, FST_REGIME_LIBRATING, "die out");
    /* at a looser tolerance the place of the bead is noisier too */
    m.rtol = 1e-6;
    set_activity(&m, 0.95e4 * floor_of_torque, 0.95e4 * floor_of_torque);
    EITHER_SIDE(m, phi_range, 0.95e-6, FST_REGIME_LOCKED, "noise", 1.05e-6, FST_REGIME_LIBRATING, "die out");
}

/* Noise that is as fast as librations are decides nothing. */
static void test_loose_steps(void **unused)
{
    (void)unused;
    made_up m = LIBRATING;
    m.rtol = 0.99e-4;
    set_activity(&m, 0.9e-2, 0.9e-2);
    expect(&m, FST_REGIME_LOCKED, "noise");
    m.rtol = 1.01e-4;
    expect(&m, FST_REGIME_UNDECIDED, "take run.rtol <= 0.0001");
    set_activity(&m, 1.1e-2, 1.1e-2); /* faster than the noise */
    expect(&m, FST_REGIME_LIBRATING, "die out");
    m.speed_at_end = 0.9e-4; /* at rest, as nearly as the steps can be */
    expect(&m, FST_REGIME_LOCKED, "at rest");
}

static void test_dies_out(void **unused)
{
    (void)unused;
    made_up m = LIBRATING;
    set_activity(&m, 0.1, 0.0951);
    expect(&m, FST_REGIME_LIBRATING, "die out");
    set_activity(&m, 0.1, 0.0949);
    expect(&m, FST_REGIME_UNDECIDED, "dying out");
}

static void test_closed(void **unused)
{
    (void)unused;
    made_up m = TURNING;
    m.half[0] = 0.9e-6;
    m.full[0] = m.full[1] = 1e-3;
    EITHER_SIDE(m, half[1], 0.95e-6, FST_REGIME_COUNTER_ROTATING, "symmetry S2", 1.05e-6,
                FST_REGIME_COUNTER_ROTATING, "does not close");
    m = TURNING;
    m.full[0] = 1e-6;
    EITHER_SIDE(m, full[1], 0.95e-6, FST_REGIME_COUNTER_ROTATING, "closed orbit: ", 1.05e-6,
                FST_REGIME_COUNTER_ROTATING, "does not close");
    /* S1 only if the half distance has stopped changing */
    m.full[1] = 0.5e-6;
    EITHER_SIDE(m, half[0], 0.5 * 1.009, FST_REGIME_COUNTER_ROTATING, "closed orbit: ", 0.5 * 1.011,
                FST_REGIME_COUNTER_ROTATING, "still closing");
}

static void test_relaxing(void **unused)
{
    (void)unused;
    made_up m = TURNING;
    m.half[0] = 1.1;
    m.growth = 100.0;
    EITHER_SIDE(m, full[1], 0.95e-2, FST_REGIME_COUNTER_ROTATING, "still closing", 1.05e-2, FST_REGIME_CHAOTIC,
                "exponent");
}

static void test_one_way(void **unused)
{
    (void)unused;
    made_up m = TURNING;
    m.alpha_dot_error = 0.01;
    EITHER_SIDE(m, alpha_dot, -0.0245, FST_REGIME_UNDECIDED, "neither way", -0.0255,
                FST_REGIME_COUNTER_ROTATING, "does not close");
    EITHER_SIDE(m, alpha_dot, 0.0245, FST_REGIME_UNDECIDED, "neither way", 0.0255, FST_REGIME_COROTATING,
                "does not close");
}

static void test_least_numbers(void **unused)
{
    (void)unused;
    EITHER_SIDE(TURNING, crossings, 63, FST_REGIME_UNDECIDED, "run longer", 64, FST_REGIME_COUNTER_ROTATING,
                "does not close");
    made_up free_bead = TURNING;
    free_bead.without_friction = 1;
    expect(&free_bead, FST_REGIME_UNDECIDED, "without friction nothing holds");
    made_up closed = TURNING;
    closed.half[0] = closed.half[1] = 1e-9;
    EITHER_SIDE(closed, crossings, 5, FST_REGIME_UNDECIDED, "irregularly", 6, FST_REGIME_COUNTER_ROTATING,
                "S2");
    EITHER_SIDE(LIBRATING, blocks, 3, FST_REGIME_UNDECIDED, "too short", 4, FST_REGIME_LIBRATING, "die out");
}

static void test_growth(void **unused)
{
    (void)unused;
    EITHER_SIDE(TURNING, growth, 1.9, FST_REGIME_COUNTER_ROTATING, "does not close", 2.1, FST_REGIME_UNDECIDED,
                "cannot be told");
    EITHER_SIDE(TURNING, growth, 9.9, FST_REGIME_UNDECIDED, "cannot be told", 10.1, FST_REGIME_CHAOTIC,
                "exponent");
    made_up free_bead = LIBRATING;
    free_bead.without_friction = 1;
    free_bead.phi_range = 0.1;
    EITHER_SIDE(free_bead, growth, 3.9, FST_REGIME_LIBRATING, "die out", 4.1, FST_REGIME_UNDECIDED,
                "cannot be told");
}

/* However much neighbours part, it is chaos only if the exponent exceeds three of its chance errors. */
static void test_significant(void **unused)
{
    (void)unused;
    made_up m = TURNING;
    m.chance = 10.0;
    EITHER_SIDE(m, growth, 29.5, FST_REGIME_UNDECIDED, "cannot be told", 30.5, FST_REGIME_CHAOTIC, "positive");
    m = LIBRATING;
    m.chance = 10.0;
    EITHER_SIDE(m, growth, 29.5, FST_REGIME_UNDECIDED, "cannot be told", 30.5, FST_REGIME_CHAOTIC, "positive");
    m.on_axis = 1; /* which neighbours leave, however regular the motion is */
    m.growth = 100.0;
    expect(&m, FST_REGIME_UNDECIDED, "the bead stays on the axis");
    m.growth = -1.0;
    expect(&m, FST_REGIME_LIBRATING, "Phi stays within");
}

/* A rise of <r> below 1e-4 is not a drift; a larger one is, if it exceeds 5 standard errors of the scatter. For a
 * line through 32 values that alternate by s, the change over all of them has the error s sqrt(12/30)
 * 32/sqrt(32^2 - 1). */
static void test_drift(void **unused)
{
    (void)unused;
    EITHER_SIDE(TURNING, r_rise, 0.9e-4, FST_REGIME_COUNTER_ROTATING, "does not close", 1.1e-4,
                FST_REGIME_UNDECIDED, "still drifts: <r>");
    made_up m = TURNING;
    m.r_scatter = 0.004;
    const double error = 0.004 * sqrt(12.0 / 29.0);
    EITHER_SIDE(m, r_rise, 4.6 * error, FST_REGIME_COUNTER_ROTATING, "does not close", 5.4 * error,
                FST_REGIME_UNDECIDED, "still drifts: <r>");
    /* <alpha'> may change by 1e-4 of the drive */
    EITHER_SIDE(TURNING, alpha_rise, 0.9 * 0.3e-4, FST_REGIME_COUNTER_ROTATING, "does not close", 1.1 * 0.3e-4,
                FST_REGIME_UNDECIDED, "still drifts: <alpha'>");
    /* a closed orbit can drift as well */
    m = TURNING;
    m.half[0] = m.half[1] = 1e-9;
    EITHER_SIDE(m, r_rise, 0.9e-4, FST_REGIME_COUNTER_ROTATING, "S2", 1.1e-4, FST_REGIME_UNDECIDED,
                "still drifts: <r>");
    /* in a bounded motion the means over whole drive periods contain a changing part of the swing: a tenth of
     * the swing is not a drift */
    EITHER_SIDE(LIBRATING, r_rise, 0.9e-2, FST_REGIME_LIBRATING, "die out", 1.1e-2, FST_REGIME_UNDECIDED,
                "still drifts: <r>");
    m = LIBRATING;
    set_activity(&m, 0.1, 0.0999);
    m.swing[0] = 1e-4;
    EITHER_SIDE(m, swing[1], 0.915e-4, FST_REGIME_LIBRATING, "die out", 0.895e-4, FST_REGIME_UNDECIDED,
                "delta r changed");
    /* a swing of 1e-7 of <r> is rounding, and allows no conclusion */
    m.swing[0] = 1.0e-7;
    EITHER_SIDE(m, swing[1], 0.82e-7, FST_REGIME_LIBRATING, "die out", 1.3e-7, FST_REGIME_UNDECIDED,
                "delta r changed");
}

/* Without friction a wide libration must be observed for longer. */
static void test_wide_without_friction(void **unused)
{
    (void)unused;
    made_up m = LIBRATING;
    EITHER_SIDE(m, phi_range, 0.29, FST_REGIME_LIBRATING, "die out", 0.31, FST_REGIME_LIBRATING, "die out");
    m.without_friction = 1;
    EITHER_SIDE(m, phi_range, 0.29, FST_REGIME_LIBRATING, "die out", 0.31, FST_REGIME_UNDECIDED,
                "nothing damps");
    made_up chaotic = m;
    chaotic.growth = 50.0;
    EITHER_SIDE(chaotic, periods, 100, FST_REGIME_UNDECIDED, "nothing holds", 101, FST_REGIME_CHAOTIC,
                "positive");
    m.phi_range = 0.31;
    EITHER_SIDE(m, periods, 100, FST_REGIME_UNDECIDED, "nothing damps", 101, FST_REGIME_LIBRATING, "die out");
}

/* A single close return does not make a closing orbit. */
static void test_chance_return(void **unused)
{
    (void)unused;
    made_up m = TURNING;
    m.half[0] = 1.1;
    m.full[1] = 0.9e-2;
    expect(&m, FST_REGIME_COUNTER_ROTATING, "still closing");
    m.full_before_last = 0.2;
    expect(&m, FST_REGIME_COUNTER_ROTATING, "does not close");
}

/* For s sin over two cycles, the line through it changes by 3 s/pi, which removes 6/(4 pi^2) of the variance.
 * The rest changes its sign 5 times, and hides a drift of 12 sqrt(2)/pi * 0.92 s/sqrt(2)/6. Both together, 1.54
 * s, exceed 2 % of <r> for s above 0.013. A line that changes as much counts by itself as well, even if the
 * scatter could explain it. */
static void test_hidden_drift(void **unused)
{
    (void)unused;
    EITHER_SIDE(TURNING, r_slow, 0.0125, FST_REGIME_COUNTER_ROTATING, "does not close", 0.0145,
                FST_REGIME_UNDECIDED, "may still drift: <r>");
    made_up m = TURNING;
    m.r_scatter = 0.01;
    EITHER_SIDE(m, r_rise, 0.017, FST_REGIME_COUNTER_ROTATING, "does not close", 0.020, FST_REGIME_UNDECIDED,
                "may still drift: <r>");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_beginnings),
        cmocka_unit_test(test_at_rest),
        cmocka_unit_test(test_noise),
        cmocka_unit_test(test_loose_steps),
        cmocka_unit_test(test_dies_out),
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_relaxing),
        cmocka_unit_test(test_one_way),
        cmocka_unit_test(test_least_numbers),
        cmocka_unit_test(test_growth),
        cmocka_unit_test(test_drift),
        cmocka_unit_test(test_hidden_drift),
        cmocka_unit_test(test_wide_without_friction),
        cmocka_unit_test(test_chance_return),
        cmocka_unit_test(test_significant),
    };
    return cmocka_run_group_tests_name("thresholds of regimes", tests, NULL, NULL);
}
