/* Which steps are searched for extremes: no step that holds a new extreme may be passed over.
 * tests: observe/extremes.c observe/peaks.inl */
#include "physics.h"

#include "observe/extremes.h"

#include "ode/dop853_tableau.h"
#include "observe/peaks.inl"

static void test_nodes(void **state)
{
    (void)state;
    static const double nodes[FST_DENSE_PLACES] = {0.0,     DOP_C7, DOP_C8, DOP_C6,  DOP_C10, DOP_C9,
                                                   DOP_C11, 1.0,    1.0,    DOP_C14, DOP_C15, DOP_C16};
    for (int i = 0; i < FST_DENSE_PLACES; ++i)
        assert_true(FST_PATH_NODE[i] == nodes[i]);
    for (int i = 0; i < FST_PATH_PLACES; ++i) {
        const int at_end = i >= 7,
                  first = i == 0   ? 1
                          : at_end ? 6
                                   : i - 1,
                  second = i == 0   ? 2
                           : at_end ? 5
                                    : i + 1;
        CHECK_CLOSE(FST_PATH_RATIO[i], (nodes[first] - nodes[i]) / (nodes[second] - nodes[i]), 1e-14);
    }
}

/* For a parabola the estimated rise is exact, between the nodes and just within either end. If its top lies
 * outside the step the rise is zero. */
static void test_parabolas(void **state)
{
    (void)state;
    for (int i = -400; i <= 1400; ++i) {
        const double top = i / 1000.0;
        double values[FST_PATH_PLACES];
        for (int j = 0; j < FST_PATH_PLACES; ++j)
            values[j] = 5.0 - 3.0 * (FST_PATH_NODE[j] - top) * (FST_PATH_NODE[j] - top);
        const double peak = top < 0.0 ? values[0] : top > 1.0 ? values[8] : 5.0;
        const fst_peak_double s = fst_find_peak_double(values, 1, 1.0);
        CHECK_CLOSE(s.best + s.rise_over / s.per, peak, 1e-12);
        if (top > 0.0 && top < 1.0)
            assert_true(s.before < top && top < s.after);
        assert_true(fst_may_exceed_double(&s, peak - 1e-12) > 0.0);
        /* The margins are no wider than stated, so that no needless steps are searched. */
        const double bound = s.best + PEAK_RISES * (s.rise_over / s.per) + PEAK_FALL * s.fall;
        assert_true(fst_may_exceed_double(&s, bound + 1e-12) <= 0.0);
    }
}

static const double EQUAL[FST_PATH_PLACES] = {2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0};

static void test_constants(void **state)
{
    (void)state;
    const fst_peak_double s = fst_find_peak_double(EQUAL, 1, -1.0);
    assert_true(fst_may_exceed_double(&s, -2.0) <= 0.0);
    assert_true(fst_may_exceed_double(&s, -2.0 - 1e-15) > 0.0);
    assert_true(fst_may_exceed_double(&s, -INFINITY) > 0.0);
}

static double track(const fst_flow *flow, const double *y, const fst_pull_double *p, int which)
{
    fst_seen_double seen;
    fst_see_double(fst_flow_world(flow), fst_flow_modes(flow), 0.0, y, p, &seen);
    const double tracked[FST_TRACK_COUNT] = {seen.r, seen.b_norm, seen.gap2, seen.slip2, seen.load};
    return tracked[which];
}

/* Samples of the dense output of one step. */
enum { SAMPLES = 64 };

typedef struct watched {
    double least[FST_TRACK_COUNT], greatest[FST_TRACK_COUNT];
} watched;

/* The peak of a parabola through three values at equal distances, of which the second is greatest. */
static double peak_of(double a, double b, double c)
{
    const double bend = (b - a) + (b - c), slope = c - a;
    return bend > 0 ? b + slope * slope / (8.0 * bend) : b;
}

static void sample_step(fst_flow *flow, watched *w)
{
    double values[FST_TRACK_COUNT][SAMPLES + 1];
    for (int i = 0; i <= SAMPLES; ++i) {
        double y[FST_NUMBERS] = {0};
        fst_pull_double p;
        fst_flow_at(flow, (double)i / SAMPLES, y);
        fst_pull_at_double(fst_flow_world(flow), y, fst_flow_world(flow)->height, &p);
        for (int j = 0; j < FST_TRACK_COUNT; ++j)
            values[j][i] = track(flow, y, &p, j);
    }
    for (int j = 0; j < FST_TRACK_COUNT; ++j)
        for (int i = 0; i <= SAMPLES; ++i) {
            const double *v = &values[j][i];
            double high = *v, low = *v;
            if (i > 0 && i < SAMPLES && v[0] >= v[-1] && v[0] >= v[1])
                high = peak_of(v[-1], v[0], v[1]);
            if (i > 0 && i < SAMPLES && v[0] <= v[-1] && v[0] <= v[1])
                low = -peak_of(-v[-1], -v[0], -v[1]);
            w->greatest[j] = high > w->greatest[j] ? high : w->greatest[j];
            w->least[j] = low < w->least[j] ? low : w->least[j];
        }
}

/* Beads of all sorts, low and high drives: 0 to 41. */
static fst_params bead_of(int i)
{
    fst_params p =
        bead_at(0.02 * pow(60.0, (i % 14) / 13.0), i % 3 == 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
    p.model_kappa = 0.2 + 0.35 * (i % 7);
    if (i % 4 == 2) {
        p.bead_material = i % 8 == 2 ? FST_MATERIAL_MIXED : FST_MATERIAL_PARAMAGNETIC;
        p.bead_a = 1e-3;
        p.bead_b = 2e-3;
    }
    return p;
}

/* The tolerance is the accuracy of the trajectory; the parabolas through the samples are accurate to 1e-10. */
static void check_extreme(double met, double sampled, double tolerance)
{
    const double scale = fabs(sampled) > 1.0 ? fabs(sampled) : 1.0;
    CHECK_WITHIN(met, sampled - (2.0 * tolerance + 1e-10) * scale, INFINITY);
}

/* Returns whether the bead stayed on the plate long enough for a window. */
static int check_bead(int which, double tolerance)
{
    const fst_params p = bead_of(which);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE];
    start_of(&p, model, start);
    fst_flow *flow = flow_of(model, tolerance, start);
    fst_quadrature q;
    fst_extreme extremes[FST_TRACK_COUNT];
    watched w;
    for (int i = 0; i < FST_TRACK_COUNT; ++i) {
        w.least[i] = INFINITY;
        w.greatest[i] = -INFINITY;
    }
    fst_quadrature_begin(&q, flow);
    fst_extremes_begin(extremes);
    const double period = TWO_PI / fst_model_groups(model).omega;
    while (flow->t.high < 10.0 * period && hypot(flow->step.end[FST_X], flow->step.end[FST_Y]) < 2.0) {
        assert_int_equal(fst_flow_step(flow, INFINITY, NULL), FST_OK);
        fst_quadrature_step(&q, flow, 0);
        if (flow->t.high < 2.0 * period)
            continue;
        fst_extremes_step(extremes, &q, flow, 0.0);
        sample_step(flow, &w);
    }
    for (int i = 0; i < FST_TRACK_COUNT; ++i) {
        check_extreme(extremes[i].greatest, w.greatest[i], tolerance);
        if (i != FST_TRACK_GAP && i != FST_TRACK_SLIP)
            check_extreme(-extremes[i].least, -w.least[i], tolerance);
    }
    fst_flow_free(flow);
    fst_model_free(model);
    return w.greatest[FST_TRACK_R] > 0.0;
}

/* How much room the margins leave: with a third of both, still no extreme is missed. Without the rise, or with
 * only three times the greater fall at an end of a step, some are missed, by 1e-6 of the extreme and more. */
static void test_none_is_left_out(void **state)
{
    (void)state;
    static const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
    int stayed = 0;
    for (int i = 0; i < 42; ++i)
        for (size_t j = 0; j < sizeof tolerances / sizeof *tolerances; ++j)
            stayed += check_bead(i, tolerances[j]);
    assert_int_equal(stayed, 5 * 41); /* one bead leaves the plate at once */
}

/* The end of a step lies on the trajectory, so that no extreme may fall short of the value there, not even by a
 * bit. */
static void test_the_end_of_a_step_counts(void **state)
{
    (void)state;
    for (int which = 0; which < 14; ++which) {
        const fst_params p = bead_of(which);
        fst_model *model = model_of(&p);
        double start[FST_STATE_SIZE];
        start_of(&p, model, start);
        fst_flow *flow = flow_of(model, 1e-8, start);
        fst_quadrature q;
        fst_extreme extremes[FST_TRACK_COUNT];
        fst_quadrature_begin(&q, flow);
        for (int step = 0; step < 50; ++step) {
            assert_int_equal(fst_flow_step(flow, INFINITY, NULL), FST_OK);
            fst_quadrature_step(&q, flow, 0);
            for (int i = 0; i < FST_TRACK_COUNT; ++i)
                extremes[i] = (fst_extreme){INFINITY, -INFINITY};
            fst_extremes_step(extremes, &q, flow, 0.0);
            for (int i = 0; i < FST_TRACK_COUNT; ++i) {
                const double end = q.sums.tracked[FST_PATH_END][i];
                assert_true(extremes[i].greatest >= end);
                if (i != FST_TRACK_GAP && i != FST_TRACK_SLIP)
                    assert_true(extremes[i].least <= end);
            }
        }
        fst_flow_free(flow);
        fst_model_free(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nodes),
        cmocka_unit_test(test_parabolas),
        cmocka_unit_test(test_constants),
        cmocka_unit_test(test_the_end_of_a_step_counts),
        cmocka_unit_test(test_none_is_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
