/* Steps of the fast lanes: the magnet's pull to the last digits, though roots and quotients are estimated, and
 * a controller that seldom makes a step in vain.
 * tests: lanes/lanes.inl */
#include "physics.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/chance.h"
#include "lanes/lanes.h"

typedef struct lanes {
    const fst_lane_engine *engine;
    void *batch;
    fst_flow *flows[FST_MOST_LANES];
    fst_model *models[FST_MOST_LANES];
} lanes;

static void put(lanes *l, int lane, const fst_params *p, const double *start, double rtol)
{
    fst_flow_options o = fst_default_flow_options();
    o.rtol = rtol;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = rtol;
    assert_int_equal(fst_model_new(p, &l->models[lane], NULL), FST_OK);
    assert_int_equal(fst_flow_new(l->models[lane], &o, start, &l->flows[lane], NULL), FST_OK);
    l->engine->load(l->batch, lane, l->flows[lane], 1e9);
}

static int open_lanes(lanes *l, fst_arithmetic form)
{
    memset(l, 0, sizeof *l);
    l->engine = fst_lane_engine_of(form, 0);
    if (!l->engine)
        return 0;
    l->batch = aligned_alloc(64, (l->engine->bytes + 63) / 64 * 64);
    assert_non_null(l->batch);
    memset(l->batch, 0, l->engine->bytes);
    return 1;
}

static void close_lanes(lanes *l)
{
    for (int i = 0; i < l->engine->width; ++i) {
        fst_flow_free(l->flows[i]);
        fst_model_free(l->models[i]);
    }
    free(l->batch);
}

/* The error of a lane's pull at one place of its step, in the sum of what the poles of all lines add to |B|,
 * and to the gradient. */
static double pull_error(const fst_world_double *c, const double *state, const fst_pull_double *pull)
{
    fst_pull_double exact;
    fst_pull_at_double(c, state, c->height, &exact);
    double field = 0, slope = 0, worst = 0;
    for (int i = 0; i < c->kinds.pieces; ++i)
        for (int end = -1; end <= 1; end += 2) {
            const double dx = state[FST_X] + end,
                         dy = state[FST_Y] - (c->source.lines.first + i) * c->source.lines.spacing;
            const double d2 = dx * dx + dy * dy + c->height * c->height;
            field += c->source.lines.strength / d2;
            slope += 4.0 * c->source.lines.strength / (d2 * sqrt(d2));
        }
    for (int i = 0; i < 3; ++i) {
        worst = fmax(worst, fabs(pull->b[i] - exact.b[i]) / field);
        worst = fmax(worst, fabs(pull->force[i] - exact.force[i]) / (exact.strength * slope));
    }
    return worst;
}

static double unit(uint64_t *chance)
{
    return (double)(fst_draw(chance) >> 11) * 0x1p-53;
}

static double worst_pull_error(fst_arithmetic form)
{
    enum { ROUNDS = 60 };
    uint64_t chance = 7;
    double worst = 0;
    for (int round = 0; round < ROUNDS; ++round) {
        lanes l;
        if (!open_lanes(&l, form))
            return -1.0;
        fst_params p = fst_default_params();
        p.magnet_lines = round % 3 == 2 ? 4 : 5;
        for (int i = 0; i < l.engine->width; ++i) {
            const double angle = 6.28 * unit(&chance), r = 1.3 * unit(&chance);
            const double start[FST_STATE_SIZE] = {
                r * cos(angle), r * sin(angle), 0.1, -0.2, 0.6, 0, 0.8, 0.3, -0.1, 0.2};
            p.model_lambda = 0.02 + 0.3 * unit(&chance);
            p.model_h = 0.05 + 0.5 * unit(&chance);
            put(&l, i, &p, start, 1e-6);
        }
        (void)l.engine->try_steps(l.batch);
        for (int i = 0; i < l.engine->width; ++i) {
            fst_bead_step_double *step = &l.flows[i]->step;
            l.engine->extract(l.batch, i, step);
            l.engine->extract_path(l.batch, i, step);
            for (int place = 1; place < FST_PATH_PLACES; ++place)
                worst = fmax(worst, pull_error(&step->context.world, FST_PATH_STATE(step, place),
                                               FST_PATH_PULL(step, place)));
        }
        close_lanes(&l);
    }
    return worst;
}

static void test_pull(void **state)
{
    (void)state;
    for (fst_arithmetic form = FST_ARITHMETIC_PORTABLE; form <= FST_ARITHMETIC_AVX512; ++form)
        CHECK_WITHIN(worst_pull_error(form), -1.0, 8e-15);
}

/* Tries that were rejected, as a part of all, along the orbits of several omegas. */
static double rejected(fst_arithmetic form)
{
    lanes l;
    double accepted = 0, failed = 0;
    if (!open_lanes(&l, form))
        return -1.0;
    for (int i = 0; i < l.engine->width; ++i) {
        const fst_params p = bead_at(0.4 + 0.1 * i, FST_DYNAMICS_RIGID);
        double start[FST_STATE_SIZE];
        fst_model *model = model_of(&p);
        start_of(&p, model, start);
        fst_model_free(model);
        put(&l, i, &p, start, 4e-8);
    }
    for (int i = 0; i < 3000; ++i) {
        const fst_lane_tries tries = l.engine->try_steps(l.batch);
        l.engine->advance(l.batch, tries.accepted);
    }
    for (int i = 0; i < l.engine->width; ++i) {
        l.engine->extract_clock(l.batch, i, l.flows[i]);
        accepted += (double)l.flows[i]->accepted;
        failed += (double)l.flows[i]->rejected;
    }
    close_lanes(&l);
    return failed / (accepted + failed);
}

/* The simple controller of the portable form fails in a seventh of its tries. */
static void test_controller(void **state)
{
    (void)state;
    const double avx2 = rejected(FST_ARITHMETIC_AVX2), avx512 = rejected(FST_ARITHMETIC_AVX512);
    printf("rejected: portable %.4f, avx2 %.4f, avx512 %.4f\n", rejected(FST_ARITHMETIC_PORTABLE), avx2,
           avx512);
    CHECK_WITHIN(avx2, -1.0, 0.05);
    CHECK_WITHIN(avx512, -1.0, 0.05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pull), cmocka_unit_test(test_controller)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
