/* final_states.c - many flows, one batch: as soon as one flow has landed at its end, the next takes its lane.
 */
#include "final_states.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"

typedef struct worker {
    const fst_lane_engine *engine;
    void *batch;
    fst_lane_view view;
    fst_flow *const *flows;
    const double *t_end;
    double (*ends)[FST_STATE_SIZE];
    int count, next, at_work;  /* flows in all, the next one to begin, those in lanes */
    int index[FST_MOST_LANES]; /* of the flow in a lane */
} worker;

/* The next flow takes a lane; without one the lane idles. */
static void occupy(worker *w, int lane)
{
    if (w->next == w->count) {
        w->engine->release(w->batch, lane);
        return;
    }
    const int i = w->next++;
    w->index[lane] = i;
    w->at_work += 1;
    w->engine->load(w->batch, lane, w->flows[i], w->t_end[i]);
}

static void finish(worker *w, int lane)
{
    const int index = w->index[lane];
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        w->ends[index][i] = w->view.end[i * w->engine->width + lane];
    w->engine->extract_clock(w->batch, lane, w->flows[index]);
    w->at_work -= 1;
    occupy(w, lane);
}

/* One try in every lane. */
static fst_status step(worker *w, fst_error *error)
{
    const fst_lane_tries tries = w->engine->try_steps(w->batch);
    for (int l = 0; tries.failed && l < w->engine->width; ++l)
        if (tries.failed & 1u << l) {
            fst_flow *flow = w->flows[w->index[l]];
            w->engine->extract(w->batch, l, &flow->step);
            w->engine->extract_clock(w->batch, l, flow);
            return fst_flow_fail(flow, error);
        }
    w->engine->advance(w->batch, tries.accepted & ~tries.landed);
    for (int l = 0; tries.landed && l < w->engine->width; ++l)
        if (tries.landed & 1u << l)
            finish(w, l);
    return FST_OK;
}

fst_status fst_final_states(const fst_lane_engine *engine, fst_flow *const *flows, const double *t_end,
                            int count, double (*ends)[FST_STATE_SIZE], fst_error *error)
{
    worker w = {.engine = engine, .flows = flows, .t_end = t_end, .ends = ends, .count = count};
    w.batch = aligned_alloc(64, (engine->bytes + 63) / 64 * 64);
    if (!w.batch)
        return fst_fail(error, FST_NO_MEMORY, "fst_final_states", "out of memory");
    memset(w.batch, 0, engine->bytes);
    engine->view(w.batch, &w.view);
    for (int l = 0; l < engine->width; ++l)
        occupy(&w, l);
    fst_status status = FST_OK;
    while (status == FST_OK && w.at_work > 0)
        status = step(&w, error);
    free(w.batch);
    return status;
}
