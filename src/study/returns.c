/* returns.c - how the bead comes back to the section X = 0. */
#include "study/run_state.h"

#include <string.h>

static int sign_of(double x)
{
    return (x > 0) - (x < 0);
}

/* Greatest difference of two states, each vector against its own scale being of order one in scaled units. */
static double distance(const double *a, const double *b)
{
    double greatest = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        const double d = fabs(a[i] - b[i]);
        greatest = d > greatest ? d : greatest;
    }
    return greatest;
}

/* Alternating halves in one direction are what regular turning looks like. */
static void judge_alternation(fst_returns *r, int half, int direction)
{
    if (r->crossings > 0 && (half == r->last_half || direction != r->last_direction)) {
        r->irregular = 1;
        r->since_break = 0;
    }
    r->last_half = half;
    r->last_direction = direction;
    r->crossings += 1;
    r->since_break += 1;
}

void fst_returns_begin(fst_run_state *run)
{
    const int side = sign_of(run->flow->step.y[FST_X]);
    run->returns.side = side ? side : run->returns.side;
}

/* Whether a return that ends by the end of the flow's last step is needed whole: it may be kept, or be the last
 * of a regular turning (turns_regularly() asks for no more than two returns' time after it). */
static int is_needed(const fst_run_state *run)
{
    const fst_mark_series *marks = &run->section_marks;
    if (!run->sparse_marks || marks->offered % marks->stride == 0)
        return 1;
    const double turning = fst_twofold_difference(run->flow->t, marks->kept[0].t);
    return (run->t_end - run->flow->t.high) * (double)marks->offered <= 2.01 * turning;
}

int fst_returns_need_integrals(const fst_run_state *run)
{
    return run->returns.crossings % 2 == 0 && is_needed(run);
}

void fst_returns_step(fst_run_state *run)
{
    fst_returns *r = &run->returns;
    const double *start = run->flow->step.y, *end = run->flow->step.end;
    if (!r->side)
        r->side = sign_of(start[FST_X]);
    const int side = sign_of(end[FST_X]), before = r->side;
    if (!side || side == before)
        return;
    r->side = side;
    if (!before || !run->in_window)
        return;
    const double f_start = start[FST_X] != 0.0 && sign_of(start[FST_X]) == before ? start[FST_X] : 0.0;
    const double x =
        f_start == 0.0 ? 0.0 : fst_flow_locate(run->flow, fst_section_function, 0.0, 1.0, f_start, end[FST_X]);
    const fst_twofold discard = {run->t_discard, 0.0};
    if (fst_twofold_difference(fst_flow_time(run->flow, x), discard) < 0)
        return;
    fst_mark mark;
    const int whole = !run->sparse_marks || fst_returns_need_integrals(run);
    fst_mark_take(&mark, &run->q, run->flow, x, whole);
    const int half = sign_of(mark.state[FST_Y]);
    judge_alternation(r, half, half > 0 ? -side : side);
    double image[FST_STATE_SIZE];
    if (half > 0)
        memcpy(image, mark.state, sizeof image);
    else
        fst_apply_s2(mark.state, image);
    mark.half_distance = r->since_break > 1 ? distance(image, r->section[0]) : NAN;
    mark.full_distance = r->since_break > 2 ? distance(image, r->section[1]) : NAN;
    if (run->is_waiting)
        fst_ramp_crossing(run, &mark, image);
    memcpy(r->section[1], r->section[0], sizeof image);
    memcpy(r->section[0], image, sizeof image);
    if (r->crossings % 2 == 1)
        fst_marks_offer(&run->section_marks, &mark);
    if (run->piece_returns == 0)
        run->piece_first = mark;
    if (run->piece_returns % 2 == 0)
        run->piece_last = mark;
    run->piece_returns += 1;
}
