#include "ensemble/final_states.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"

typedef struct crew {
    const fst_lane_engine *engine;
    void *batch;
    fst_lane_view view;
    fst_flow *const *flows;
    const double *t_end;
    double (*ends)[FST_STATE_SIZE];
    int count, next, at_work;
    int index[FST_MOST_LANES]; /* of the flow in a lane */
} crew;

/* The next flow takes a lane; without one the lane idles. */
static void occupy(crew *c, int lane)
{
    if (c->next == c->count) {
        c->engine->release(c->batch, lane);
        return;
    }
    const int i = c->next++;
    c->index[lane] = i;
    c->at_work += 1;
    c->engine->load(c->batch, lane, c->flows[i], c->t_end[i]);
}

static void finish(crew *c, int lane)
{
    const int index = c->index[lane];
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        c->ends[index][i] = c->view.end[i * c->engine->width + lane];
    c->engine->extract_clock(c->batch, lane, c->flows[index]);
    c->at_work -= 1;
    occupy(c, lane);
}

/* One try in every lane. */
static fst_status step(crew *c, fst_error *error)
{
    const fst_lane_tries tries = c->engine->try_steps(c->batch);
    for (int l = 0; tries.failed && l < c->engine->width; ++l)
        if (tries.failed & 1u << l) {
            fst_flow *flow = c->flows[c->index[l]];
            c->engine->extract(c->batch, l, &flow->step);
            c->engine->extract_clock(c->batch, l, flow);
            return fst_flow_fail(flow, error);
        }
    c->engine->advance(c->batch, tries.accepted & ~tries.landed);
    for (int l = 0; tries.landed && l < c->engine->width; ++l)
        if (tries.landed & 1u << l)
            finish(c, l);
    return FST_OK;
}

fst_status fst_final_states(const fst_lane_engine *engine, fst_flow *const *flows, const double *t_end,
                            int count, double (*ends)[FST_STATE_SIZE], fst_error *error)
{
    crew c = {.engine = engine, .flows = flows, .t_end = t_end, .ends = ends, .count = count};
    c.batch = aligned_alloc(64, (engine->bytes + 63) / 64 * 64);
    if (!c.batch)
        return fst_fail(error, FST_NO_MEMORY, "fst_final_states", "out of memory");
    memset(c.batch, 0, engine->bytes);
    engine->view(c.batch, &c.view);
    for (int l = 0; l < engine->width; ++l)
        occupy(&c, l);
    fst_status status = FST_OK;
    while (status == FST_OK && c.at_work > 0)
        status = step(&c, error);
    free(c.batch);
    return status;
}
