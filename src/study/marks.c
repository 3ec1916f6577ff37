#include "study/marks.h"

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
    /* Full: keep every other one, and from now on every other of those to come. */
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

void fst_mark_take(fst_mark *mark, fst_quadrature *q, fst_flow *flow, double x, int whole)
{
    memset(mark, 0, sizeof *mark);
    mark->t = fst_flow_time(flow, x);
    if (x == 1.0)
        memcpy(mark->state, flow->step.end, sizeof mark->state);
    else
        fst_flow_at(flow, x, mark->state);
    if (!whole)
        return;
    fst_quadrature_at(q, flow, x, mark->integrals, &mark->small_phi);
    const fst_winding phi = fst_flow_phi(flow, x);
    mark->big_phi = fst_winding_angle(&phi);
    fst_pull_double p;
    fst_magnetic_pull_double(&flow->step.context.coefficients, mark->state, &p);
    mark->energy = fst_energy_double(&flow->step.context.coefficients, mark->state, &p);
}
