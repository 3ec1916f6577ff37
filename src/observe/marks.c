/* marks.c - snapshots kept evenly over a motion whose length nobody knows.
 *
 * Errors of means and tests for drifts want some thirty marks spread evenly over the whole window.  Marks come
 * one by one, a whole return or a drive period apart, and how many will come is not known.  So every stride-th
 * one is kept; when there is no room left, every other one of the kept is dropped, and the stride doubles:
 *
 *     stride 1   0  1  2  3  4  5  6  7  8           full
 *     stride 2   0     2     4     6     8           halved ...
 *     stride 2   0     2     4     6     8     10 .. and on, at every other one
 *
 * The kept marks are then the multiples of the stride, at least half as many as there is room for, and depend
 * on nothing but how many came.  fst_marks_stride() tells the last stride before: which marks need not be made
 * at all.
 */
#include "observe/marks.h"

#include <math.h>
#include <string.h>

void fst_marks_begin(fst_mark_series *series)
{
    memset(series, 0, sizeof *series);
    series->stride = 1;
}

void fst_marks_offer(fst_mark_series *series, const fst_mark *mark)
{
    series->latest = *mark;
    const int64_t index = series->offered++;
    if (index % series->stride != 0)
        return;
    series->kept[series->count++] = *mark;
    if (series->count <= FST_MARKS)
        return;
    /* Full: keep every other one, and take only every other one from now on. */
    int kept = 0;
    for (int i = 0; i < series->count; i += 2)
        series->kept[kept++] = series->kept[i];
    series->count = kept;
    series->stride *= 2;
}

int64_t fst_marks_stride(int64_t total)
{
    int64_t stride = 1;
    while ((total - 1) / stride + 1 > FST_MARKS)
        stride *= 2;
    return stride;
}

double fst_state_distance(const double *a, const double *b)
{
    double greatest = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        const double d = fabs(a[i] - b[i]);
        greatest = d > greatest ? d : greatest;
    }
    return greatest;
}

void fst_mark_take(fst_mark *mark, fst_quadrature *q, fst_flow *flow, double x, int whole)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_motion_double at;
    memset(mark, 0, sizeof *mark);
    mark->t = fst_flow_time(flow, x);
    mark->omega = fst_drive_rate_double(&flow->drive, mark->t);
    fst_flow_motion_at(flow, x, &at);
    memcpy(mark->state, at.numbers, sizeof mark->state);
    if (!whole)
        return;
    fst_quadrature_at(q, flow, x, mark->integrals, &mark->moment_angle);
    mark->captures = flow->contact.captures;
    mark->touches = flow->contact.touches;
    mark->impacts = flow->contact.impacts;
    mark->impulse = flow->contact.impulse;
    mark->impact_loss = flow->contact.impact_loss;
    const fst_winding angle = fst_flow_bead_angle(flow, x);
    mark->bead_angle = fst_winding_angle(&angle);
    fst_pull_double p;
    fst_magnetic_pull_double(c, &at.modes, at.numbers, &p);
    mark->energy = fst_energy_double(c, &at.modes, at.numbers, &p);
}
