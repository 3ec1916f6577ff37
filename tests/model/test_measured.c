/* A measured field through the public functions: splines through samples of the five lines converge to them
 * with the eighth power of the spacing, runs over them are runs over the lines, steps keep their order 8 across
 * cells, lanes have the bits of the scalar form, and where the map ends the run ends with a sentence.
 * tests: model/field_map.c model/source/grid.inl */
#include "few_rows.h"
#include "measured_field.h"

#include "study/lane_rows.h"

/* The slope of log2(values) over halvings of the spacing, by least squares. */
static double order_of(const double *errors, int count)
{
    double slope = 0.0, weight = 0.0;
    for (int i = 0; i < count; ++i) {
        const double x = i - 0.5 * (count - 1);
        slope -= x * log2(errors[i]);
        weight += x * x;
    }
    return slope / weight;
}

/* ------------------------------------------------------------------ the field */

/* Cells of l/5, l/10, l/20 and l/40; 1 mm of the default magnet is l/23. */
enum { SPACINGS = 4 };
static const int CELLS[SPACINGS] = {5, 10, 20, 40};

static void test_order_of_splines(void **unused)
{
    (void)unused;
    const fst_params lines = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_model *exact = model_of(&lines);
    double of_field[SPACINGS] = {0}, of_slope[SPACINGS] = {0}, at_edge[SPACINGS] = {0};
    for (int s = 0; s < SPACINGS; ++s) {
        fst_field_map *map = map_of_model(&lines, 1.0 / CELLS[s], 2 * CELLS[s], 0.0);
        const fst_params p = over_map(&lines, map);
        fst_model *measured = model_of(&p);
        uint64_t seed = 3;
        for (int trial = 0; trial < 2000; ++trial) {
            double b[2][3], g[2][3][3];
            const double x = uniform(&seed, -2, 2), y = uniform(&seed, -2, 2);
            fst_field(exact, x, y, b[0], g[0]);
            fst_field(measured, x, y, b[1], g[1]);
            const double off = greatest_difference(b[0], b[1], 3);
            if (fabs(x) > 1.6 || fabs(y) > 1.6)
                at_edge[s] = fmax(at_edge[s], off);
            else
                of_field[s] = fmax(of_field[s], off);
            for (int i = 0; i < 3; ++i)
                of_slope[s] = fmax(of_slope[s], greatest_difference(g[0][i], g[1][i], 2));
        }
        fst_model_free(measured);
        fst_field_map_free(map);
    }
    /* The coarser the grid, the more the higher orders add. */
    CHECK_WITHIN(order_of(of_field + 1, 3), 7.7, 9.2);
    CHECK_WITHIN(order_of(of_field + 2, 2), 7.7, 8.4);
    CHECK_WITHIN(order_of(at_edge + 1, 3), 7.0, 9.0);
    CHECK_WITHIN(order_of(of_slope + 1, 3), 6.5, 8.0);
    CHECK_WITHIN(of_field[3], 0.0, 1e-9);
    fst_model_free(exact);
}

static void test_curl(void **unused)
{
    (void)unused;
    const fst_params lines = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_field_map *clean = map_of_model(&lines, 0.05, 40, 0.0), *noisy = map_of_model(&lines, 0.05, 40, 0.01);
    const fst_field_map_facts facts = fst_field_map_describe(clean);
    CHECK_CLOSE(facts.curl, 0.0, 1e-7);
    CHECK_CLOSE(facts.radius, 2.0 * 0.023, 1e-15);
    CHECK_WITHIN(facts.greatest, 0.04, 0.05); /* |B| rises to 4.6 B0 */
    CHECK_WITHIN(fst_field_map_describe(noisy).curl, 0.01, 1.0);
    fst_field_map_free(clean);
    fst_field_map_free(noisy);
}

/* ------------------------------------------------------------------ motion */

/* A run over the map is the run over the lines, to the error of the splines. */
static void test_runs(void **unused)
{
    (void)unused;
    fst_params lines = bead_at(0.5, FST_DYNAMICS_RIGID);
    lines.run_periods = 40;
    lines.run_discard = 20;
    const fst_run_result exact = run_of(&lines);
    double off[3];
    for (int s = 0; s < 3; ++s) {
        fst_field_map *map = map_of_model(&lines, 1.0 / CELLS[s], 2 * CELLS[s], 0.0);
        const fst_params p = over_map(&lines, map);
        const fst_run_result r = run_of(&p);
        assert_int_equal(r.regime, exact.regime);
        off[s] = fabs(r.mean_r - exact.mean_r);
        CHECK_CLOSE(r.mean_drive_power / r.mean_friction_power,
                    exact.mean_drive_power / exact.mean_friction_power, 1e-9);
        fst_field_map_free(map);
    }
    CHECK_WITHIN(order_of(off, 3), 6.0, 11.0);
    CHECK_CLOSE(off[2], 0.0, 1e-7);
}

/* The state at t = 30 in steps of a given size. */
static void end_state(const fst_model *model, const double *start, double step, double *end)
{
    fst_flow_options options = fst_default_flow_options();
    options.rtol = 1e-2; /* so loose that only the bound on the step counts */
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        options.atol[i] = 1e-2;
    options.first_step = options.greatest_step = step;
    fst_flow *flow;
    fst_stop stop;
    assert_int_equal(fst_flow_new(model, &options, start, &flow, NULL), FST_OK);
    assert_int_equal(fst_flow_next(flow, 30.0, 0, &stop, NULL), FST_OK);
    const fst_flow_info info = fst_flow_get(flow);
    memcpy(end, info.state, sizeof info.state);
    assert_int_equal(info.rejected, 0);
    fst_flow_free(flow);
}

/* Steps do not know where cells end: what that costs is below their own error, which falls with the eighth
 * power of their size. */
static void test_order_of_steps(void **unused)
{
    (void)unused;
    const fst_params lines = bead_at(0.3, FST_DYNAMICS_RIGID);
    fst_field_map *map = map_of_model(&lines, 1.0 / 23, 46, 0.0);
    const fst_params p = over_map(&lines, map);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], exact[FST_STATE_SIZE], end[FST_STATE_SIZE], off[3];
    start_of(&p, model, start);
    end_state(model, start, 30.0 / 3000, exact);
    for (int i = 0; i < 3; ++i) {
        end_state(model, start, 30.0 / (60 << i), end);
        off[i] = greatest_difference(end, exact, FST_STATE_SIZE);
    }
    CHECK_WITHIN(order_of(off, 3), 7.3, 9.5);
    fst_model_free(model);
    fst_field_map_free(map);
}

/* Without friction the Jacobi integral E - omega L_z stays over a map of noise, which has a curl. */
static void test_noise_keeps_energy(void **unused)
{
    (void)unused;
    fst_params lines = frictionless_bead(FST_DYNAMICS_RIGID);
    fst_field_map *map = map_of_model(&lines, 0.1, 25, 0.1);
    const fst_params p = over_map(&lines, map);
    fst_model *model = model_of(&p);
    double start[FST_STATE_SIZE], jacobi[2];
    start_of(&p, model, start);
    const fst_groups g = fst_model_groups(model);
    fst_flow *flow = flow_of(model, 1e-12, start);
    fst_stop stop;
    for (int i = 0; i < 2; ++i) {
        const fst_flow_info info = fst_flow_get(flow);
        const double *y = info.state;
        jacobi[i] = fst_observe(model, y).energy -
                    g.omega * (y[FST_X] * y[FST_VY] - y[FST_Y] * y[FST_VX] + 0.4 * g.eps * g.eps * y[FST_WZ]);
        if (i == 0)
            assert_int_equal(fst_flow_next(flow, 60.0, 0, &stop, NULL), FST_OK);
    }
    CHECK_CLOSE(jacobi[1], jacobi[0], 1e-10);
    CHECK_WITHIN(fst_field_map_describe(map).curl, 0.03, 1.0);
    fst_flow_free(flow);
    fst_model_free(model);
    fst_field_map_free(map);
}

/* ------------------------------------------------------------------ lanes */

enum { JOBS = 12 };

/* `with` is the bead over the map. */
static void fill(const void *with, int row, fst_row_job *job)
{
    job->params = *(const fst_params *)with;
    job->params.drive_omega = 0.4 + 0.02 * row;
    job->params.run_periods = 16;
    job->params.run_discard = 4;
    if (row % 4 == 1)
        job->params.friction_law = FST_FRICTION_COULOMB;
    if (row % 5 == 2)
        job->params.magnet_shape = FST_MAGNET_LINES;
    if (row == 6) {                         /* thrown off the map */
        job->params.plate_gravity = 1000.0; /* so heavy that noise does not lift it */
        job->has_start = 1;
        job->start[FST_X] = 1.8;
        job->start[FST_VX] = 20.0;
        job->start[FST_NX] = 1.0;
    }
}

static void test_lanes(void **unused)
{
    (void)unused;
    static few_rows alone, four, eight, fast;
    const fst_params lines = bead_at(0.5, FST_DYNAMICS_RIGID);
    fst_field_map *map = map_of_model(&lines, 0.1, 21, 0.01);
    const fst_params measured = over_map(&lines, map);
    alone = (few_rows){.count = JOBS, .fill = fill, .with = &measured};
    four = eight = fast = alone;
    do_few_rows(&alone, FST_ARITHMETIC_PORTABLE, 1);
    assert_int_equal(alone.results[6].regime, FST_REGIME_UNDECIDED);
    CHECK_CONTAINS(alone.results[6].reason, "left the disc that the map");
    if (fst_best_arithmetic() >= FST_ARITHMETIC_AVX2) {
        do_few_rows(&four, FST_ARITHMETIC_PORTABLE, 4);
        do_few_rows(&fast, FST_ARITHMETIC_AVX2, 4);
    }
    if (fst_best_arithmetic() >= FST_ARITHMETIC_AVX512)
        do_few_rows(&eight, FST_ARITHMETIC_PORTABLE, 8);
    for (int i = 0; i < JOBS; ++i) {
        const fst_run_result *one = &alone.results[i];
        for (int k = 0; k < FST_STATE_SIZE; ++k) {
            if (fst_best_arithmetic() >= FST_ARITHMETIC_AVX2)
                CHECK_SAME_BITS(four.results[i].final_state[k], one->final_state[k]);
            if (fst_best_arithmetic() >= FST_ARITHMETIC_AVX512)
                CHECK_SAME_BITS(eight.results[i].final_state[k], one->final_state[k]);
            if (fst_best_arithmetic() >= FST_ARITHMETIC_AVX2 && i != 6)
                CHECK_CLOSE(fast.results[i].final_state[k], one->final_state[k], 1e-5);
        }
    }
    fst_field_map_free(map);
}

/* ------------------------------------------------------------------ owners, ends, refusals */

/* A model keeps its map, because others may free theirs. */
static void test_owners(void **unused)
{
    (void)unused;
    const fst_params lines = bead_at(0.5, FST_DYNAMICS_RIGID);
    fst_field_map *map = map_of_model(&lines, 0.1, 20, 0.0), *shared = fst_field_map_share(map);
    const fst_params p = over_map(&lines, map);
    fst_model *model = model_of(&p);
    double before[3], after[3], g[3][3];
    fst_field(model, 0.3, 0.4, before, g);
    fst_field_map_free(map);
    fst_field_map_free(shared);
    fst_field(model, 0.3, 0.4, after, g);
    for (int i = 0; i < 3; ++i)
        CHECK_SAME_BITS(after[i], before[i]);
    fst_model_free(model);
    fst_field_map_free(NULL);
}

static void says(const fst_params *p, const char *sentence)
{
    fst_model *model;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_model_new(p, &model, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, sentence);
}

static void test_refusals(void **unused)
{
    (void)unused;
    const fst_params lines = bead_at(0.5, FST_DYNAMICS_RIGID);
    fst_field_map *map = map_of_model(&lines, 0.1, 20, 0.0);
    fst_params p = over_map(&lines, map);
    fst_error error;
    p.magnet_depth += 1e-3;
    says(&p, "was taken at 18.7 mm");
    p = over_map(&lines, map);
    p.friction_law = FST_FRICTION_COULOMB;
    p.impact_restitution = 0.5;
    says(&p, "a bead that flies");
    p = over_map(&lines, NULL);
    says(&p, "needs the map");
    assert_int_equal(fst_params_set(&p, "magnet.file", "some.csv", &error), FST_OK);
    says(&p, "some.csv has not been read");
    p = over_map(&lines, map);
    p.start_r = 2.5;
    fst_model *model = model_of(&p);
    double state[FST_STATE_SIZE];
    assert_int_equal(fst_start_state(&p, model, state, &error), FST_BAD_INPUT);
    fst_model_free(model);
    fst_field_map_free(map);

    double b[3 * 8 * 8] = {0.0};
    const fst_field_samples good = {{8, 8, 1}, {-1, -1, NAN}, {0.3, 0.3, 0}, b};
    const struct {
        int axis, count;
        double first, spacing, value;
        const char *sentence;
    } cases[] = {{0, 7, -1, 0.3, 0, "at least 8"},    {1, 8, 1, 0.3, 0, "surround the axis"},
                 {1, 8, -1, -0.3, 0, "not positive"}, {0, 8, NAN, 0.3, 0, "the place of the map along x"},
                 {2, 0, 0, 0, 0, "at least 1"},       {0, 8, -1, 0.3, INFINITY, "a number of at most"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        fst_field_samples samples = good;
        samples.count[cases[i].axis] = cases[i].count;
        samples.first[cases[i].axis] = cases[i].first;
        samples.spacing[cases[i].axis] = cases[i].spacing;
        b[100] = cases[i].value;
        assert_int_equal(fst_field_map_new(&samples, NULL, &map, &error), FST_BAD_INPUT);
        assert_null(map);
        CHECK_CONTAINS(error.sentence, cases[i].sentence);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_of_splines),
        cmocka_unit_test(test_curl),
        cmocka_unit_test(test_runs),
        cmocka_unit_test(test_order_of_steps),
        cmocka_unit_test(test_noise_keeps_energy),
        cmocka_unit_test(test_lanes),
        cmocka_unit_test(test_owners),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests_name("measured", tests, NULL, NULL);
}
