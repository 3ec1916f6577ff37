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
    int index[FST_MOST_LANES]; /* of the flow in a lane, or -1 */
} crew;

/* The next flow takes a lane; without one the lane idles with steps of size 0. */
static void occupy(crew *c, int lane)
{
    c->index[lane] = -1;
    c->view.h[lane] = 0.0;
    if (c->next == c->count)
        return;
    const int i = c->next++;
    c->index[lane] = i;
    c->at_work += 1;
    c->engine->load(c->batch, lane, c->flows[i]);
    fst_flow_plan(c->flows[i], c->t_end[i]);
}

static void finish(crew *c, int lane)
{
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        c->ends[c->index[lane]][i] = c->view.end[i * c->engine->width + lane];
    c->at_work -= 1;
    occupy(c, lane);
}

/* One try in every lane. */
static fst_status step(crew *c, fst_error *error)
{
    const int width = c->engine->width;
    unsigned go_on = 0, over = 0;
    for (int l = 0; l < width; ++l)
        c->view.h[l] = c->index[l] >= 0 ? c->flows[c->index[l]]->attempt : 0.0;
    const unsigned within = c->engine->try_steps(c->batch);
    for (int l = 0; l < width; ++l) {
        if (c->index[l] < 0)
            continue;
        fst_flow *flow = c->flows[c->index[l]];
        const double t_end = c->t_end[c->index[l]];
        const double e = isfinite(c->view.error[l]) ? c->view.error[l] : INFINITY;
        flow->rhs_calls += 11;
        if (within & 1u << l) {
            fst_flow_accept(flow, e, c->view.factor[l], c->view.drift[l], t_end);
            if (flow->t.high >= t_end) {
                over |= 1u << l;
            } else {
                go_on |= 1u << l;
                fst_flow_plan(flow, t_end);
            }
        } else if (!fst_flow_reject(flow, e, c->view.factor[l])) {
            c->engine->extract(c->batch, l, &flow->step);
            return fst_flow_fail(flow, error);
        }
    }
    c->engine->advance(c->batch, go_on);
    for (int l = 0; l < width; ++l)
        if (over & 1u << l)
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
