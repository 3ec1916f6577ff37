/* Real magnets in lanes: neighbouring lanes see a part from places where its field is computed in other ways,
 * and each has what it would have alone.  Runs over blocks, turned blocks, dipoles and blocks seen from afar
 * have the bits of single runs in the portable form; the fast forms make the same motion.
 * tests: lanes/tangents.inl lanes/tangents_scalar.c ode/tangent_step.inl */
#include "few_rows.h"
#include "physics.h"

#include <stdlib.h>

#include "lanes/engines.h"
#include "lanes/tangents.h"
#include "model/model.h"

/* ---------------------------------------------------------------- single evaluations */

/* A disc magnetised across and along, and one that is turned; `scale` tells the models of two lanes apart. */
static fst_params magnet_of_cylinders(double scale)
{
    static const fst_magnet_part parts[] = {
        {FST_PART_CYLINDER, {0.004, 0, -0.004}, {0.02, 0.008, FST_PART_TURNING}, {0.3, -0.5, 0.8}, {0}, {0}, 0},
        {FST_PART_CYLINDER,
         {-0.02, 0.01, -0.006},
         {0.01, 0.02, FST_PART_TURNING},
         {0, 0, 1.1},
         {0},
         {80, 1, 2, -0.5},
         0},
    };
    fst_params p = bead_at(0.31, FST_DYNAMICS_RIGID);
    p.magnet_shape = FST_MAGNET_PARTS;
    p.magnet_part_count = 2;
    memcpy(p.magnet_parts, parts, sizeof parts);
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 3; ++k)
            p.magnet_parts[i].size[k] *= scale;
    return p;
}

/* Where the beads are, in l: on the first part's axis, next to it, over its rim, beside it, far and farther. */
static const double PLACES[][2] = {
    {0.16, 0},   {0.16, 1e-9}, {0.56, 0}, {0.3, 0.2}, {1.5, -0.7}, {6, 4},    {40, -30},     {0, 0},
    {-0.8, 0.4}, {0.16, 0.41}, {-3, 0.1}, {400, 300}, {0.7, -0.2}, {-0.2, 0}, {0.16, -0.38}, {2.2, 2.1}};
enum { BEADS = sizeof PLACES / sizeof *PLACES };

typedef struct slopes {
    double of[BEADS][FST_TANGENT_DIM];
} slopes;

/* All beads through the lanes of an engine, a batch after the other. */
static void evaluate(const fst_tangent_engine *engine, fst_model *const models[2], double (*y)[FST_TANGENT_DIM],
                     slopes *to)
{
    double atol[FST_TANGENT_DIM], *values;
    const double *found;
    for (int i = 0; i < FST_TANGENT_DIM; ++i)
        atol[i] = 1e-9;
    const size_t bytes = (engine->bytes + 63) / 64 * 64;
    void *memory = aligned_alloc(64, bytes);
    assert_non_null(memory);
    memset(memory, 0, bytes);
    for (int first = 0; first < BEADS; first += engine->width) {
        for (int l = 0; l < engine->width; ++l) {
            const int bead = first + l;
            engine->load(memory, l, &models[bead % 2]->world, y[bead], 1e-9, atol);
        }
        engine->view(memory, &values, &found);
        engine->evaluate(memory);
        for (int l = 0; l < engine->width; ++l)
            for (int i = 0; i < FST_TANGENT_DIM; ++i)
                to->of[first + l][i] = found[i * engine->width + l];
    }
    free(memory);
}

static void test_cylinders(void **unused)
{
    (void)unused;
    const fst_params params[2] = {magnet_of_cylinders(1), magnet_of_cylinders(0.9)};
    fst_model *const models[2] = {model_of(&params[0]), model_of(&params[1])};
    double y[BEADS][FST_TANGENT_DIM];
    static slopes alone, beside;
    uint64_t seed = 17;
    for (int bead = 0; bead < BEADS; ++bead) {
        random_state(&seed, y[bead]);
        random_state(&seed, y[bead] + FST_STATE_SIZE);
        memcpy(y[bead], PLACES[bead], sizeof PLACES[bead]);
    }
    evaluate(&fst_tangents_scalar, models, y, &alone);
    for (int form = FST_ARITHMETIC_PORTABLE; form <= FST_ARITHMETIC_AVX512; ++form) {
        const fst_lane_engine *engine = fst_lane_engine_of((fst_arithmetic)form, 0);
        if (!engine)
            continue;
        evaluate(&engine->tangents, models, y, &beside);
        if (!engine->fused)
            assert_memory_equal(&beside, &alone, sizeof alone);
        for (int bead = 0; bead < BEADS; ++bead)
            for (int i = 0; i < FST_TANGENT_DIM; ++i)
                CHECK_CLOSE(beside.of[bead][i], alone.of[bead][i], 1e-11 * fmax(1, fabs(alone.of[bead][i])));
    }
    fst_model_free(models[0]);
    fst_model_free(models[1]);
}

/* ---------------------------------------------------------------- whole runs */

enum { JOBS = 9 };

/* Magnets of three kinds, which cannot share a batch: a bar, a row of turned blocks of which the outer ones are
 * farther away than ten of their half diagonals from some beads, and a block with a sphere and a dipole. */
static fst_params job_params(int i)
{
    fst_params p = bead_at(0.2 + 0.02 * i, i & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
    p.run_periods = 0.5 + 0.05 * i;
    p.run_discard = 0;
    p.run_rtol = 1e-10;
    p.magnet_shape = FST_MAGNET_PARTS;
    fst_magnet_part *part = p.magnet_parts;
    if (i % 3 == 0) {
        p.magnet_part_count = 1;
        part[0] = (fst_magnet_part){.kind = FST_PART_CUBOID, .size = {56e-3, 40e-3, 9e-3}, .remanence = {0.3}};
    } else if (i % 3 == 1) {
        p.magnet_part_count = 4;
        for (int k = 0; k < 4; ++k)
            part[k] = (fst_magnet_part){.kind = FST_PART_CUBOID,
                                        .centre = {(k - 1.5) * 15e-3, 2e-3 * k, -3e-3},
                                        .size = {4e-3, 3e-3, 5e-3},
                                        .remanence = {1.2, 0.1, 0.5},
                                        .rotation = {30.0 * k, 0.3, -1.0, 0.5}};
    } else {
        p.magnet_part_count = 3;
        part[0] = (fst_magnet_part){.kind = FST_PART_CUBOID, .size = {30e-3, 20e-3, 9e-3}, .remanence = {0.4}};
        part[1] = (fst_magnet_part){
            .kind = FST_PART_SPHERE, .centre = {15e-3, 5e-3, 0}, .size = {8e-3}, .remanence = {0, 0, 1.1}};
        part[2] =
            (fst_magnet_part){.kind = FST_PART_DIPOLE, .centre = {-20e-3, 0, 0}, .moment = {0.2, 0.1, -0.3}};
    }
    return p;
}

static void fill(const void *unused, int row, fst_row_job *job)
{
    (void)unused;
    job->params = job_params(row);
}

static void single_runs(fst_run_result results[JOBS])
{
    int moved = 0;
    for (int i = 0; i < JOBS; ++i) {
        const fst_params p = job_params(i);
        const fst_run_options options = fst_default_run_options();
        assert_int_equal(fst_run(&p, &options, &results[i], NULL), FST_OK);
        moved += results[i].accepted > 10;
    }
    assert_true(moved > JOBS / 2);
}

static void test_portable_lanes(void **unused)
{
    (void)unused;
    static fst_run_result alone[JOBS];
    static few_rows beside = {.count = JOBS, .fill = fill};
    single_runs(alone);
    for (int lanes = 4; lanes <= 8; lanes += 4) {
        if (!fst_lane_engine_of(FST_ARITHMETIC_PORTABLE, lanes))
            continue;
        do_few_rows(&beside, FST_ARITHMETIC_PORTABLE, lanes);
        for (int i = 0; i < JOBS; ++i) {
            assert_memory_equal(beside.results[i].final_state, alone[i].final_state,
                                sizeof alone[i].final_state);
        }
    }
}

static void test_fast_lanes(void **unused)
{
    (void)unused;
    static fst_run_result alone[JOBS];
    static few_rows fast = {.count = JOBS, .fill = fill};
    single_runs(alone);
    for (int form = FST_ARITHMETIC_AVX2; form <= FST_ARITHMETIC_AVX512; ++form) {
        if (!fst_lane_engine_of((fst_arithmetic)form, 0))
            continue;
        do_few_rows(&fast, (fst_arithmetic)form, 0);
        for (int i = 0; i < JOBS; ++i) {
            assert_int_equal(fast.results[i].regime, alone[i].regime);
            for (int k = 0; k < FST_STATE_SIZE; ++k)
                CHECK_CLOSE(fast.results[i].final_state[k], alone[i].final_state[k], 1e-6);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_cylinders), cmocka_unit_test(test_portable_lanes),
                                       cmocka_unit_test(test_fast_lanes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
