/* When marks show a motion to repeat itself for good (observe/closing.h, observe/cycle.h): of marks that are
 * made up, each but for one thing those of an orbit that has closed.
 * tests: observe/closing.c observe/cycle.c
 * labels: memcheck */
#include "physics.h"

#include "observe/cycle.h"

static const double TURN = 2.0, FURTHER = -6.25, UNTIL = 1e3;

/* What differs from mark to mark, and in the last two marks. */
typedef struct marks {
    double rtol;
    int far, near; /* so many marks 1 apart, then so many `distance` apart */
    double distance;
    double later, angle, mean; /* the last mark comes later, turned on, with another mean of r by so much */
} marks;

static const marks CLOSED = {.rtol = 1e-10, .far = 8, .near = 6, .distance = 1e-10};

static fst_mark mark_of(const marks *m, int i)
{
    const int last = i + 1 == m->far + m->near;
    fst_mark mark = {.t = {TURN * i, 0.0}, .bead_angle = FURTHER * i};
    mark.full_distance = i < m->far ? 1.0 : m->distance;
    mark.integrals[FST_Q_R] = 0.7 * TURN * i;
    if (last) {
        mark.t.high += m->later;
        mark.integrals[FST_Q_R] += 0.7 * m->later + m->mean * TURN;
        mark.bead_angle += m->angle;
    }
    return mark;
}

/* How many of the near marks it takes, or -1. */
static int known_after(const marks *m)
{
    fst_closing c;
    int known = -1;
    fst_closing_begin(&c, m->rtol);
    for (int i = 0; i < m->far + m->near; ++i) {
        const fst_mark mark = mark_of(m, i);
        if (fst_closing_add(&c, &mark, UNTIL) && known < 0)
            known = i - m->far + 1;
    }
    return known;
}

/* Whether the last mark, which differs by something, is one of an orbit that has closed. */
static int is_known_at_last(marks m)
{
    m.near = 4;
    return known_after(&m) == 4;
}

static void test_four_marks(void **unused)
{
    (void)unused;
    assert_int_equal(known_after(&CLOSED), 4);
    marks m = CLOSED;
    m.far = 3; /* the factor is not known before nine */
    m.near = 10;
    assert_int_equal(known_after(&m), 6);
}

/* Within ten limits times and angles agree, and means within a hundred: 1e-8 and 1e-7. */
static void test_what_must_agree(void **unused)
{
    (void)unused;
    static const struct {
        double later, angle, mean;
    } close[] = {{1.9e-8, 0, 0},  {-1.9e-8, 0, 0}, {0, 0.9e-8, 0},
                 {0, -0.9e-8, 0}, {0, 0, 0.9e-7},  {0, 0, -0.9e-7}},
      apart[] = {{2.1e-8, 0, 0},  {-2.1e-8, 0, 0}, {0, 1.1e-8, 0},
                 {0, -1.1e-8, 0}, {0, 0, 1.1e-7},  {0, 0, -1.1e-7}};
    for (int i = 0; i < 6; ++i) {
        marks m = CLOSED;
        m.later = close[i].later, m.angle = close[i].angle, m.mean = close[i].mean;
        assert_true(is_known_at_last(m));
        m.later = apart[i].later, m.angle = apart[i].angle, m.mean = apart[i].mean;
        assert_false(is_known_at_last(m));
    }
}

/* The limit is ten tolerances, from 1e-9 to 1e-7. */
static void test_limits(void **unused)
{
    (void)unused;
    static const double limits[][2] = {{1e-13, 1e-9}, {1e-10, 1e-9}, {1e-9, 1e-8}, {1e-8, 1e-7}, {1e-5, 1e-7}};
    for (size_t i = 0; i < sizeof limits / sizeof *limits; ++i) {
        marks m = CLOSED;
        m.rtol = limits[i][0];
        m.distance = 0.8 * limits[i][1]; /* the way that is left is a little longer */
        assert_true(is_known_at_last(m));
        m.distance = 1.1 * limits[i][1];
        assert_false(is_known_at_last(m));
    }
}

/* A mark that could not be compared with the one before, or a motion that is to be seen again: the factor takes
 * nine marks after it. */
static void test_breaks(void **unused)
{
    (void)unused;
    for (int forgotten = 0; forgotten < 2; ++forgotten) {
        fst_closing c;
        fst_closing_begin(&c, 1e-10);
        marks m = {.rtol = 1e-10, .far = 9, .near = 20, .distance = 1e-10};
        int known = -1;
        for (int i = 0; i < m.far + m.near && known < 0; ++i) {
            fst_mark mark = mark_of(&m, i);
            if (i == m.far && forgotten)
                fst_closing_forget(&c);
            else if (i == m.far)
                mark.full_distance = NAN;
            if (fst_closing_add(&c, &mark, 0.0)) /* no mark is left: the way is the last distance */
                known = i - m.far;
        }
        assert_int_equal(known, forgotten ? 8 : 9);
    }
}

static int holds(const double *distances, int count)
{
    fst_closing c;
    fst_closing_begin(&c, 1e-10);
    for (int i = 0; i < count; ++i)
        fst_closing_go_on(&c, distances[i]);
    return fst_closing_holds(&c);
}

/* Later marks stay together unless they lie ten limits apart, or five distances in a row have risen, beyond
 * what the errors of the steps explain. */
static void test_holding(void **unused)
{
    (void)unused;
    assert_true(holds((const double[]){1e-10, 1e-10, 1e-10, 1e-10, 1e-10, 9e-9}, 6));
    assert_false(holds((const double[]){1e-10, 1e-10, 1e-10, 1e-10, 1e-10, 1.1e-8}, 6));
    assert_false(holds((const double[]){1e-10, 1e-10, 1e-10, 1e-10, 1e-10}, 5));
    assert_true(holds((const double[]){2e-10, 1e-10, 2e-10, 3e-10, 4e-10, 5e-10}, 6));
    assert_false(holds((const double[]){0.9e-10, 1e-10, 2e-10, 3e-10, 4e-10, 5e-10}, 6));
    assert_true(holds((const double[]){1e-12, 2e-12, 3e-12, 4e-12, 5e-12, 0.9e-11}, 6));
    assert_false(holds((const double[]){1e-12, 2e-12, 3e-12, 4e-12, 5e-12, 1.1e-11}, 6));
}

/* Distances that fall by a factor rho each from 1 on, down to errors of the steps of half the limit, while the
 * states go on by `creep` from mark to mark: how many marks repeat before the motion is known, or -1. */
static int known_on_floor(int floored, double rho, double creep)
{
    fst_closing c;
    fst_mark mark = {.full_distance = 1.0};
    int repeats = 0;
    fst_closing_begin(&c, 1e-10);
    c.floored = floored;
    for (int i = 0; i < 4000; ++i) {
        mark.t = (fst_twofold){TURN * i, 0.0};
        mark.state[FST_X] = creep * i;
        repeats += mark.full_distance < c.limit;
        if (fst_closing_add(&c, &mark, 1e6))
            return repeats;
        mark.full_distance = fmax(mark.full_distance * rho, (0.4 + 0.1 * (i % 3)) * c.limit);
    }
    return -1;
}

/* Where the errors of the steps end the fall, the last power of ten of it says how far what cannot be seen has
 * fallen since: to the limit by 1/(1 - rho).  A state that goes on creeping has not closed. */
static void test_floor(void **unused)
{
    (void)unused;
    static const double factors[] = {0.8, 0.9, 0.95, 0.99};
    for (int i = 0; i < 4; ++i) {
        const double rho = factors[i], least = 1.0 + log(1.0 - rho) / log(rho);
        assert_int_equal(known_on_floor(0, rho, 0.0), -1);
        CHECK_CLOSE(known_on_floor(1, rho, 0.0), fmax(least, 16.0), 2.0 + 0.05 * least);
        assert_int_equal(known_on_floor(1, rho, 0.1e-9), -1);
    }
    /* states that creep by 0.02 limits are allowed where no more than 25 marks lie between them */
    assert_true(known_on_floor(1, 0.8, 0.02e-9) == 16 && known_on_floor(1, 0.99, 0.02e-9) == -1);
}

/* Whether cycles are a libration: of this greatest speed, Phi going on by `further` in each. */
static int librates(double rtol, double distance, double speed, double further)
{
    fst_cycle c;
    int settles = 0;
    fst_cycle_begin(&c, rtol);
    for (int i = 0; i < 14; ++i) {
        const marks m = {.rtol = rtol, .far = 8, .near = 6, .distance = distance};
        c.latest = mark_of(&m, i);
        c.latest.bead_angle = further * i;
        settles = fst_cycle_settles(&c, UNTIL, speed);
    }
    return settles;
}

/* The motion is larger than 1e-5 and than a thousand times the way that is left, and Phi does not turn. */
static void test_cycles(void **unused)
{
    (void)unused;
    const double of_size = TWO_PI / TURN;
    assert_true(librates(1e-10, 1e-10, 0.1, 0.0));
    assert_true(librates(1e-10, 1e-10, 1.1e-5 * of_size, 0.0));
    assert_false(librates(1e-10, 1e-10, 0.9e-5 * of_size, 0.0));
    assert_true(
        librates(1e-7, 1e-8, 3e-5 * of_size, 0.0)); /* the factor is 0.1 at the first, and the way 1.1e-8 */
    assert_false(librates(1e-7, 5e-8, 3e-5 * of_size, 0.0));
    assert_false(librates(1e-10, 1e-10, 0.1, TWO_PI));
    assert_true(librates(1e-10, 1e-10, 0.1, 0.2));
}

/* The states at maxima of r are not compared with those from before the bead turned. */
static void test_watching(void **unused)
{
    (void)unused;
    fst_cycle c;
    fst_cycle_begin(&c, 1e-10);
    fst_cycle_watch(&c, 1);
    c.seen = 5;
    c.since = 2;
    fst_cycle_watch(&c, 1);
    assert_true(c.seen == 5 && c.since == 2);
    fst_cycle_watch(&c, 0);
    fst_cycle_watch(&c, 1);
    assert_true(c.seen == 0 && c.since == -1);
}

/* A cycle may have several maxima of r: in the turning frame a bead on an orbit of symmetry S1 passes two, of
 * which each comes back after a whole return. */
static void test_several_maxima(void **unused)
{
    (void)unused;
    fst_params p = bead_at(0.2151, FST_DYNAMICS_RIGID);
    const fst_run_result settled = run_of(&p);
    fst_model *model = model_of(&p);
    fst_flow *flow = flow_of(model, 1e-10, settled.final_state);
    fst_quadrature q;
    fst_cycle c;
    int cycles = 0;
    double before = 0.0;
    fst_quadrature_begin(&q, flow);
    fst_cycle_begin(&c, 1e-10);
    fst_cycle_watch(&c, 1);
    while (flow->t.high < 6.5 * settled.period) {
        assert_int_equal(fst_flow_step(flow, 6.5 * settled.period, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
        if (!fst_cycle_step(&c, &q, flow))
            continue;
        cycles += 1;
        (void)fst_closing_add(&c.closing, &c.latest, UNTIL);
        if (cycles > 1)
            CHECK_CLOSE(c.latest.t.high - before, settled.period, 1e-7);
        before = c.latest.t.high;
    }
    assert_true(settled.symmetry == FST_SYMMETRY_S1 && cycles >= 5 && cycles <= 6);
    assert_int_equal(c.closing.count, 4); /* nothing was forgotten between them */
    fst_flow_free(flow);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_four_marks),     cmocka_unit_test(test_what_must_agree),
        cmocka_unit_test(test_limits),         cmocka_unit_test(test_breaks),
        cmocka_unit_test(test_holding),        cmocka_unit_test(test_floor),
        cmocka_unit_test(test_cycles),         cmocka_unit_test(test_watching),
        cmocka_unit_test(test_several_maxima),
    };
    return cmocka_run_group_tests_name("closing", tests, NULL, NULL);
}
