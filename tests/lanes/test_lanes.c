/* Lanes: in the portable form a row has the bits of fst_run() whatever runs beside it, in the fast forms it is
 * as accurate and its bits depend on its parameters alone.
 * tests: lanes/lanes.inl lanes/lane_world.inl lanes/lane_observables.inl lanes/lane_extremes.inl
 *   lanes/engines.c study/lane_watch.c study/rows.c
 * labels: bits */
#include "physics.h"
#include "same_results.h"

#include <stdlib.h>

#include "../bench/final_states.h"

enum { JOBS = 24 };

/* Beads of all sorts: both dynamics, all materials and friction laws, short and odd windows, some beads that
 * leave the plate, one that cannot start. */
static fst_params job_params(int i)
{
    fst_params p = bead_at(0.15 + 0.04 * i, i % 5 == 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
    p.run_periods = 12.0 + 0.7 * i;
    p.run_discard = i % 7;
    p.run_rtol = i % 2 ? 1e-9 : 1e-11;
    p.model_kappa = 0.5 + 0.1 * i;
    if (i % 6 == 2) {
        p.bead_material = FST_MATERIAL_MIXED;
        p.bead_a = 1e-4;
        p.bead_b = 1e-3;
    }
    if (i % 8 == 3)
        p.plate_radius = 0.0225; /* close to the start: ejected */
    if (i == 9)
        p.friction_law = FST_FRICTION_NONE;
    if (i == 11)
        p.magnet_lines = 3;
    if (i == 13)
        p.start_r = p.model_eps = 0.2; /* a start in free rolling does not exist here */
    if (i == 17)
        p.start_spin = FST_SPIN_REST;
    if (i == 6 || i == 15) {
        p.run_until = FST_UNTIL_SETTLED;
        p.run_periods = 60;
        p.run_rtol = 1e-9;
    }
    return p;
}

typedef struct store {
    int next, count, order[JOBS];
    double discard; /* the discard of all jobs; used by one test */
    fst_run_result results[JOBS];
    fst_status statuses[JOBS];
} store;

static int next_job(void *user, fst_row_job *job)
{
    store *s = user;
    if (s->next == s->count)
        return 0;
    memset(job, 0, sizeof *job);
    job->point = s->order[s->next++];
    job->params = job_params((int)job->point);
    return 1;
}

static int job_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    store *s = user;
    assert_int_equal(status, error->code);
    s->results[job->point] = *result;
    s->statuses[job->point] = status;
    return 0;
}

/* Does all jobs in the order of multiples of `stride`, which has no common factor with their number. */
static void do_all(store *s, fst_arithmetic arithmetic, int lanes, int stride)
{
    memset(s, 0, sizeof *s);
    s->count = JOBS;
    for (int i = 0; i < JOBS; ++i)
        s->order[i] = i * stride % JOBS;
    const fst_row_work work = {s, arithmetic, lanes, next_job, job_done, NULL};
    fst_error error = {FST_OK, "", ""};
    if (fst_rows(&work, &error) != FST_OK)
        fail_msg("fst_rows: %s", error.sentence);
}

static void check_same(const store *a, const store *b)
{
    for (int i = 0; i < JOBS; ++i) {
        assert_int_equal(a->statuses[i], b->statuses[i]);
        check_same_result(i, &a->results[i], &b->results[i]);
    }
}

static void test_portable_rows_are_runs(void **state)
{
    (void)state;
    static store alone, beside;
    do_all(&alone, FST_ARITHMETIC_PORTABLE, 1, 1);
    int left = 0;
    for (int i = 0; i < JOBS; ++i) {
        const fst_params p = job_params(i);
        const fst_run_options options = fst_default_run_options();
        fst_run_result run;
        assert_int_equal(fst_run(&p, &options, &run, NULL), alone.statuses[i]);
        assert_memory_equal(run.final_state, alone.results[i].final_state, sizeof run.final_state);
        left += run.regime == FST_REGIME_EJECTED;
    }
    assert_true(left > 0);
    assert_int_equal(alone.statuses[13], FST_BAD_INPUT);
    for (int lanes = 4; lanes <= 8; lanes += 4) {
        if (!fst_lane_engine_of(FST_ARITHMETIC_PORTABLE, lanes))
            continue;
        do_all(&beside, FST_ARITHMETIC_PORTABLE, lanes, 1);
        check_same(&alone, &beside);
        do_all(&beside, FST_ARITHMETIC_PORTABLE, lanes, 7);
        check_same(&alone, &beside);
    }
}

static void test_fast_rows_depend_on_nothing_else(void **state)
{
    (void)state;
    static store portable, first, second;
    do_all(&portable, FST_ARITHMETIC_PORTABLE, 0, 1);
    for (int form = FST_ARITHMETIC_AVX2; form <= FST_ARITHMETIC_AVX512; ++form) {
        if (!fst_lane_engine_of((fst_arithmetic)form, 0))
            continue;
        do_all(&first, (fst_arithmetic)form, 0, 1);
        do_all(&second, (fst_arithmetic)form, 0, 11);
        check_same(&first, &second);
        for (int i = 0; i < JOBS; ++i) {
            const fst_run_result *a = &first.results[i], *b = &portable.results[i];
            assert_int_equal(a->regime, b->regime);
            /* Two runs of one tolerance agree so far; some of these motions are chaotic for a while. */
            if (b->regime == FST_REGIME_COUNTER_ROTATING) {
                assert_true(fabs(a->mean_r - b->mean_r) < 1e-6);
                assert_true(fabs(a->max_b - b->max_b) < 1e-5);
                assert_true(fabs(a->mean_friction_power - b->mean_friction_power) < 1e-6);
            }
        }
    }
}

typedef struct range {
    double r[2], b[2], load[2], slip[2], angle[2];
} range;

static void widen(double bounds[2], double value)
{
    bounds[0] = value < bounds[0] ? value : bounds[0];
    bounds[1] = value > bounds[1] ? value : bounds[1];
}

static fst_status take_sample(void *user, const fst_sample *sample, fst_error *error)
{
    (void)error;
    range *seen = user;
    widen(seen->r, sample->seen.r);
    widen(seen->b, sample->seen.b_norm);
    widen(seen->load, sample->seen.load);
    widen(seen->slip, sample->seen.slip_norm);
    widen(seen->angle, sample->seen.angle * 360.0 / TWO_PI);
    return FST_OK;
}

static int one_job(void *user, fst_row_job *job)
{
    store *s = user;
    if (s->next++ > 0)
        return 0;
    memset(job, 0, sizeof *job);
    job->params = bead_at(s->order[0] / 1e6, FST_DYNAMICS_FARAGO2020);
    job->params.run_periods = 24;
    job->params.run_discard = s->discard;
    job->params.run_rtol = 1e-10;
    return 1;
}

/* The range of the samples is narrower than the true one by up to (a dt)^2/8 of it, where a is the greatest
 * rate: 50 rad a period and 20000 samples a period give 1e-6. The trajectories differ by much less than 1e-7.
 */
static void check_range(const double sampled[2], double unit, double least, double greatest)
{
    const double low = sampled[0] / unit, high = sampled[1] / unit;
    assert_true(least < low + 1e-7 * high && least > low - 1e-6 * high);
    assert_true(greatest > high - 1e-7 * high && greatest < high + 1e-6 * high);
}

/* The extremes that are located in lanes, against those of a finely sampled trajectory. */
static void test_extremes_are_those_of_the_path(void **state)
{
    (void)state;
    static const int millionths_of_omega[] = {926563, 1079688, 1178125, 346875, 1066667};
    static store s;
    for (size_t i = 0; i < sizeof millionths_of_omega / sizeof *millionths_of_omega; ++i) {
        fst_row_job job;
        memset(&s, 0, sizeof s);
        s.order[0] = millionths_of_omega[i];
        s.discard = i < 4 ? 10.0 : 0.5; /* the extremes of the last job lie at the beginning of its window */
        assert_int_equal(one_job(&s, &job), 1);
        range seen = {{INFINITY, -INFINITY},
                      {INFINITY, -INFINITY},
                      {INFINITY, -INFINITY},
                      {INFINITY, -INFINITY},
                      {INFINITY, -INFINITY}};
        fst_run_options options = fst_default_run_options();
        fst_run_result run;
        job.params.run_samples = 20000;
        options.sample_from = job.params.run_discard;
        options.sink.user = &seen;
        options.sink.sample = take_sample;
        assert_int_equal(fst_run(&job.params, &options, &run, NULL), FST_OK);
        fst_model *model = model_of(&job.params);
        const double gravity = fst_model_groups(model).gravity;
        fst_model_free(model);
        for (int form = FST_ARITHMETIC_PORTABLE; form <= FST_ARITHMETIC_AVX512; ++form) {
            if (!fst_lane_engine_of((fst_arithmetic)form, 0))
                continue;
            const fst_row_work work = {&s, (fst_arithmetic)form, 0, one_job, job_done, NULL};
            s.next = 0;
            assert_int_equal(fst_rows(&work, NULL), FST_OK);
            const fst_run_result *row = &s.results[0];
            check_range(seen.r, 1.0, row->min_r, row->max_r);
            check_range(seen.b, 1.0, row->min_b, row->max_b);
            check_range(seen.load, gravity, row->min_load_weights, row->max_load_weights);
            check_range(seen.slip, 1.0, seen.slip[0], row->max_slip);
            check_range(seen.angle, 1.0, seen.angle[0], row->max_angle_deg);
        }
    }
}

/* Weak beads at low drives librate, and their regime needs an exponent. There are more of them than lanes, with
 * two lengths of window and both dynamics, which share no batch. */
enum { LIBRATING = 11 };

static int librating_job(void *user, fst_row_job *job)
{
    store *s = user;
    if (s->next == LIBRATING)
        return 0;
    memset(job, 0, sizeof *job);
    job->point = s->next++;
    job->params = fst_default_params();
    job->params.drive_frequency = 6.57 + 0.02 * (double)job->point;
    job->params.model_kappa = 0.93;
    job->params.model_dynamics = job->point % 4 == 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
    job->params.run_periods = job->point % 2 ? 36 : 40;
    job->params.run_discard = 16;
    return 1;
}

/* Exponents computed in lanes: in the portable form they have the bits of fst_run(), in other forms they agree
 * as far as the trajectories do. */
static void test_exponents(void **state)
{
    (void)state;
    static store runs, rows;
    memset(&runs, 0, sizeof runs);
    fst_row_job job;
    while (librating_job(&runs, &job)) {
        const fst_run_options options = fst_default_run_options();
        assert_int_equal(fst_run(&job.params, &options, &runs.results[job.point], NULL), FST_OK);
        assert_int_equal(runs.results[job.point].regime, FST_REGIME_LIBRATING);
    }
    for (int form = FST_ARITHMETIC_PORTABLE; form <= FST_ARITHMETIC_AVX512; ++form) {
        if (!fst_lane_engine_of((fst_arithmetic)form, 0))
            continue;
        memset(&rows, 0, sizeof rows);
        const fst_row_work work = {&rows, (fst_arithmetic)form, 0, librating_job, job_done, NULL};
        assert_int_equal(fst_rows(&work, NULL), FST_OK);
        for (int i = 0; i < LIBRATING; ++i) {
            const fst_run_result *run = &runs.results[i], *row = &rows.results[i];
            assert_int_equal(row->regime, FST_REGIME_LIBRATING);
            if (form == FST_ARITHMETIC_PORTABLE) {
                assert_true(row->largest_exponent == run->largest_exponent);
                assert_true(row->largest_exponent_error == run->largest_exponent_error);
                assert_int_equal(row->rhs_calls, run->rhs_calls);
            }
            assert_true(fabs(row->largest_exponent - run->largest_exponent) < 1e-9);
            assert_true(run->largest_exponent_error >
                        1e-6); /* the error bar is far wider than this difference */
        }
    }
}

/* Two beads with a tangent vector each, in turn in all lanes; slope[] gets the derivatives of the first two
 * lanes, or of the only one. */
static void evaluate_tangents(const fst_tangent_engine *engine, fst_model *const *models,
                              double (*y)[FST_TANGENT_DIM], double (*slope)[FST_TANGENT_DIM])
{
    double atol[FST_TANGENT_DIM], *values;
    const double *slopes;
    for (int i = 0; i < FST_TANGENT_DIM; ++i)
        atol[i] = 1e-9;
    const size_t bytes = (engine->bytes + 63) / 64 * 64;
    void *memory = aligned_alloc(64, bytes);
    assert_non_null(memory);
    memset(memory, 0, bytes);
    for (int l = 0; l < engine->width; ++l)
        engine->load(memory, l, &models[l % 2]->world, y[l % 2], 1e-9, atol);
    engine->view(memory, &values, &slopes);
    engine->evaluate(memory);
    for (int l = 0; l < 2 && l < engine->width; ++l)
        for (int i = 0; i < FST_TANGENT_DIM; ++i)
            slope[l][i] = slopes[i * engine->width + l];
    free(memory);
}

/* The derivative of a tangent vector is the Jacobian times the vector, in every form, material, friction law
 * and dynamics, for the paper's number of lines and for others; portable lanes have the bits of the scalar
 * engine. */
static void test_tangents(void **state)
{
    (void)state;
    static const int numbers[] = {5, 1, 4};
    uint64_t seed = 41;
    for (int which = 0; which < 3 * CASES; ++which) {
        fst_params p = params_of_case(which % CASES);
        p.magnet_lines = numbers[which / CASES];
        fst_params stronger = p;
        stronger.model_kappa *= 2.0;
        fst_model *const models[2] = {model_of(&p), model_of(&stronger)};
        double y[2][FST_TANGENT_DIM], scalar[2][FST_TANGENT_DIM], slope[2][FST_TANGENT_DIM];
        double expected[2][FST_TANGENT_DIM] = {{0.0}, {0.0}}, jacobian[FST_STATE_SIZE][FST_STATE_SIZE];
        for (int l = 0; l < 2; ++l) {
            random_state(&seed, y[l]);
            random_state(&seed, y[l] + FST_STATE_SIZE);
            fst_rhs(models[l], y[l], expected[l]);
            fst_jacobian(models[l], y[l], jacobian, NULL);
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                for (int k = 0; k < FST_STATE_SIZE; ++k)
                    expected[l][FST_STATE_SIZE + i] += jacobian[i][k] * y[l][FST_STATE_SIZE + k];
        }
        for (int l = 0; l < 2; ++l) {
            evaluate_tangents(&fst_tangents_scalar, &models[l], &y[l], &scalar[l]);
            assert_true(greatest_difference(scalar[l], expected[l], FST_TANGENT_DIM) < 1e-11);
        }
        for (int form = FST_ARITHMETIC_PORTABLE; form <= FST_ARITHMETIC_AVX512; ++form) {
            const fst_lane_engine *engine = fst_lane_engine_of((fst_arithmetic)form, 0);
            if (!engine)
                continue;
            evaluate_tangents(&engine->tangents, models, y, slope);
            if (!engine->fused)
                assert_memory_equal(slope, scalar, sizeof slope);
            assert_true(greatest_difference(slope[0], expected[0], FST_TANGENT_DIM) < 1e-11);
            assert_true(greatest_difference(slope[1], expected[1], FST_TANGENT_DIM) < 1e-11);
        }
        fst_model_free(models[0]);
        fst_model_free(models[1]);
    }
}

static void test_no_such_engine(void **state)
{
    (void)state;
    const fst_row_work work = {NULL, FST_ARITHMETIC_AVX512, 4, next_job, job_done, NULL};
    fst_error error;
    assert_int_equal(fst_rows(&work, &error), FST_UNAVAILABLE);
    assert_string_equal(fst_arithmetic_name(FST_ARITHMETIC_AVX2), "avx2");
}

/* Final states at the tightest tolerance: portable lanes have the bits of a flow, fast ones agree to rounding.
 */
static void test_final_states(void **state)
{
    (void)state;
    enum { COUNT = 13 };
    fst_model *models[COUNT];
    fst_flow *flows[COUNT];
    double t_end[COUNT], start[FST_STATE_SIZE], expected[COUNT][FST_STATE_SIZE], ends[COUNT][FST_STATE_SIZE];
    for (int i = 0; i < COUNT; ++i) {
        const fst_params p = bead_at(0.36 + 0.06 * i, FST_DYNAMICS_RIGID);
        models[i] = model_of(&p);
        start_of(&p, models[i], start);
        t_end[i] = (2.0 + 0.1 * i) * TWO_PI / p.drive_omega;
        state_after(models[i], 1e-14, start, t_end[i], expected[i]);
    }
    for (int form = FST_ARITHMETIC_PORTABLE; form <= FST_ARITHMETIC_AVX512; ++form) {
        const fst_lane_engine *engine = fst_lane_engine_of((fst_arithmetic)form, 0);
        if (!engine)
            continue;
        for (int i = 0; i < COUNT; ++i) {
            const fst_params p = bead_at(0.36 + 0.06 * i, FST_DYNAMICS_RIGID);
            start_of(&p, models[i], start);
            flows[i] = flow_of(models[i], 1e-14, start);
        }
        assert_int_equal(fst_final_states(engine, flows, t_end, COUNT, ends, NULL), FST_OK);
        for (int i = 0; i < COUNT; ++i) {
            if (!engine->fused)
                assert_memory_equal(ends[i], expected[i], sizeof ends[i]);
            else
                assert_true(greatest_difference(ends[i], expected[i], FST_STATE_SIZE) < 2e-13);
            fst_flow_free(flows[i]);
        }
    }
    for (int i = 0; i < COUNT; ++i)
        fst_model_free(models[i]);
}

/* ------------------------------------------------------------------ beads that graze the edge, or all but lift
 * off */

enum { GRAZING = 48 };

typedef struct grazing {
    int next;
    fst_params params[GRAZING];
    fst_run_result results[GRAZING];
} grazing;

static int next_grazing(void *user, fst_row_job *job)
{
    grazing *g = user;
    if (g->next == GRAZING)
        return 0;
    memset(job, 0, sizeof *job);
    job->point = g->next++;
    job->params = g->params[job->point];
    return 1;
}

static int grazing_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                        const fst_error *error)
{
    grazing *g = user;
    if (status != FST_OK)
        fail_msg("%s", error->sentence);
    g->results[job->point] = *result;
    return 0;
}

/* A weak bead, observed from its start on, so heavy that it stays on the plate. */
static fst_params weak_bead(int i, int fast)
{
    const double omega = fast ? 0.6 + 0.3 * (i % 6) : 0.2 + 0.05 * (i % 6);
    fst_params p = bead_at(omega, i & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
    p.model_kappa = 0.01 + (fast ? 0.004 : 0.002) * i;
    p.start_r = 0.7 + 0.05 * (i % 5);
    p.start_phi = 37.0 * i;
    p.start_spin = FST_SPIN_REST;
    p.run_periods = 5.0;
    p.run_discard = 0.0;
    p.plate_gravity = 200.0;
    p.plate_radius = 10.0;
    return p;
}

/* The same motion with an edge or a weight such that the bead passes the edge, or loses its load, by `by`, or
 * just does not (by < 0). It does so for less time than lies between two stages of a step. */
static fst_params grazing_bead(int i)
{
    fst_params p = weak_bead(i / 4, i & 2);
    const fst_run_result seen = run_of(&p);
    const double by = i & 1 ? 1e-6 : -1e-6;
    if (i & 2 && seen.min_load_weights < 1.0)
        p.plate_gravity *= 1.0 - seen.min_load_weights - 0.1 * by;
    else
        p.plate_radius = fmax(seen.max_r - by, p.start_r + 1e-6) * p.magnet_half_length;
    return p;
}

static void test_grazing_is_seen_in_lanes(void **state)
{
    (void)state;
    static grazing g;
    fst_run_result alone[GRAZING];
    int left = 0, lifted = 0;
    for (int i = 0; i < GRAZING; ++i) {
        g.params[i] = grazing_bead(i);
        alone[i] = run_of(&g.params[i]);
        left += alone[i].regime == FST_REGIME_EJECTED;
        lifted += alone[i].regime == FST_REGIME_LIFTED;
        if (!(i & 1))
            assert_true(alone[i].regime != FST_REGIME_LIFTED && alone[i].regime != FST_REGIME_EJECTED);
    }
    print_message("%d ejected, %d lifted\n", left, lifted);
    assert_true(left >= 8 && lifted >= 8);
    for (int lanes = 4; lanes <= 8; lanes += 4) {
        if (!fst_lane_engine_of(FST_ARITHMETIC_PORTABLE, lanes))
            continue;
        g.next = 0;
        const fst_row_work work = {&g, FST_ARITHMETIC_PORTABLE, lanes, next_grazing, grazing_done, NULL};
        fst_error error;
        assert_int_equal(fst_rows(&work, &error), FST_OK);
        for (int i = 0; i < GRAZING; ++i) {
            if (g.results[i].regime != alone[i].regime)
                fail_msg("bead %d: regime %d alone, %d in %d lanes", i, alone[i].regime, g.results[i].regime,
                         lanes);
            assert_memory_equal(g.results[i].final_state, alone[i].final_state, sizeof alone[i].final_state);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_portable_rows_are_runs),
        cmocka_unit_test(test_fast_rows_depend_on_nothing_else),
        cmocka_unit_test(test_extremes_are_those_of_the_path),
        cmocka_unit_test(test_exponents),
        cmocka_unit_test(test_tangents),
        cmocka_unit_test(test_no_such_engine),
        cmocka_unit_test(test_final_states),
        cmocka_unit_test(test_grazing_is_seen_in_lanes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
