#include "study/quadrature.h"

#include <string.h>

#include "ode/dop853_tableau.h"
#include "ode/path_stages.h"
#include "ode/summit.inl"

static void see_stage(const fst_flow *flow, int stage, fst_seen_double *seen)
{
    const fst_bead_step_double *s = &flow->step;
    static const double node[16] = {
        [5] = DOP_C6, [6] = DOP_C7, [7] = DOP_C8,   [8] = DOP_C9,   [9] = DOP_C10, [10] = DOP_C11,
        [11] = 1.0,   [12] = 1.0,   [13] = DOP_C14, [14] = DOP_C15, [15] = DOP_C16};
    const double omega = s->omega + (s->h * node[stage]) * s->ramp;
    fst_see_double(&s->context.coefficients, omega, s->stage[stage], &s->context.pull[stage], seen);
}

static void fill_stage(fst_quadrature *q, const fst_flow *flow, int stage, double *tracked)
{
    fst_seen_double seen;
    see_stage(flow, stage, &seen);
    fst_integrands_double(&flow->step.context.coefficients, flow->step.stage[stage],
                          &flow->step.context.pull[stage], &seen, q->r_reference, q->b_reference,
                          q->stage[stage]);
    if (!tracked)
        return;
    tracked[FST_TRACK_R] = seen.r;
    tracked[FST_TRACK_B] = seen.b_norm;
    tracked[FST_TRACK_GAP] = seen.gap2;
    tracked[FST_TRACK_SLIP] = seen.slip2;
    tracked[FST_TRACK_LOAD] = seen.load;
}

/* The plane in which phi turns: (-n_z, n_alpha), scaled by r so that no direction is needed on the axis. */
static void small_phi_point(const double *y, double *x_out, double *y_out)
{
    const double r = sqrt(y[FST_X] * y[FST_X] + y[FST_Y] * y[FST_Y]);
    *x_out = -y[FST_NZ] * r;
    *y_out = y[FST_X] * y[FST_NY] - y[FST_Y] * y[FST_NX];
}

/* Follow phi over the fractions [x0, x1] of the last step, bisecting where n comes close to e_r. */
static void follow_small_phi(fst_flow *flow, fst_winding *phi, double x0, double x1, const double *state)
{
    double u, w;
    small_phi_point(state, &u, &w);
    const double middle = 0.5 * (x0 + x1);
    if (x1 - x0 > 1e-9 && fst_winding_is_doubtful(phi, u, w)) {
        double between[FST_STATE_SIZE];
        fst_flow_at(flow, middle, between);
        follow_small_phi(flow, phi, x0, middle, between);
        follow_small_phi(flow, phi, middle, x1, state);
        return;
    }
    fst_winding_advance(phi, u, w);
}

void fst_quadrature_begin(fst_quadrature *q, const fst_flow *flow)
{
    memset(q, 0, sizeof *q);
    for (int i = 0; i < FST_TRACK_COUNT; ++i) {
        q->extreme[i].least = INFINITY;
        q->extreme[i].greatest = -INFINITY;
    }
    fst_quadrature_begin_phi(q, flow->step.end);
}

void fst_quadrature_begin_phi(fst_quadrature *q, const double *state)
{
    small_phi_point(state, &q->small_phi.x, &q->small_phi.y);
    q->small_phi_start = q->small_phi;
}

int fst_quadrature_phi_is_doubtful(const fst_quadrature *q, const double *end)
{
    double u, w;
    small_phi_point(end, &u, &w);
    return fst_winding_is_doubtful(&q->small_phi, u, w);
}

void fst_quadrature_follow(fst_quadrature *q, fst_flow *flow, const double *end)
{
    q->small_phi_start = q->small_phi;
    follow_small_phi(flow, &q->small_phi, 0.0, 1.0, end);
}

void fst_quadrature_set_references(fst_quadrature *q, const fst_flow *flow)
{
    fst_seen_double seen;
    see_stage(flow, 0, &seen);
    q->r_reference = seen.r;
    q->b_reference = seen.b_norm;
}

void fst_quadrature_step(fst_quadrature *q, fst_flow *flow)
{
    static const double weight[12] = {[0] = DOP_B1, [5] = DOP_B6,  [6] = DOP_B7,   [7] = DOP_B8,
                                      [8] = DOP_B9, [9] = DOP_B10, [10] = DOP_B11, [11] = DOP_B12};
    for (int i = 0; i < FST_Q_COUNT; ++i)
        q->total[i] = fst_twofold_add(q->total[i], q->increment[i]);
    for (int i = 0; i < FST_PATH_STAGES; ++i)
        fill_stage(q, flow, FST_PATH_STAGE[i], q->tracked[i]);
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        double sum = 0.0;
        for (int j = 0; j < 12; ++j)
            if (weight[j] != 0.0)
                sum += weight[j] * q->stage[j][i];
        q->increment[i] = flow->step.h * sum;
    }
    q->has_dense = 0;
    fst_quadrature_follow(q, flow, flow->step.end);
}

void fst_quadrature_at(fst_quadrature *q, fst_flow *flow, double x, double integrals[FST_Q_COUNT], double *phi)
{
    double part[FST_Q_COUNT];
    if (x == 1.0) {
        memcpy(part, q->increment, sizeof part);
        *phi = fst_winding_angle(&q->small_phi);
    } else {
        if (!q->has_dense) {
            static const double zero[FST_Q_COUNT];
            fst_flow_make_dense(flow);
            for (int stage = 13; stage < 16; ++stage)
                fill_stage(q, flow, stage, NULL);
            fst_bead_dense_coefficients_double(FST_Q_COUNT, flow->step.h, zero, q->increment, &q->stage[0][0],
                                               FST_Q_COUNT, &q->dense[0][0]);
            q->has_dense = 1;
        }
        fst_bead_evaluate_dense_double(FST_Q_COUNT, &q->dense[0][0], FST_Q_COUNT, x, part);
        fst_winding small_phi = q->small_phi_start;
        double state[FST_STATE_SIZE];
        fst_flow_at(flow, x, state);
        follow_small_phi(flow, &small_phi, 0.0, x, state);
        *phi = fst_winding_angle(&small_phi);
    }
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        const fst_twofold sum = fst_twofold_add(q->total[i], part[i]);
        integrals[i] = sum.high;
    }
}

/* ------------------------------------------------------------------ extremes */

/* A tracked quantity at the fraction x of the last step; what it does not look at, of the state and of the
 * magnet's pull, is not made. */
static double tracked_at(fst_flow *flow, double x, const void *what)
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    const int which = *(const int *)what;
    const int first = which == FST_TRACK_SLIP ? FST_VX : FST_X;
    const int count = which == FST_TRACK_R || which == FST_TRACK_B ? 2 : FST_STATE_SIZE - first;
    double state[FST_STATE_SIZE] = {0.0}, unused[3];
    fst_pull_double p = {.strength = 0.0};
    fst_seen_double seen;
    fst_flow_make_dense(flow);
    fst_bead_evaluate_dense_double(count, &flow->step.dense[0][first], FST_STATE_SIZE, x, state + first);
    switch (which) {
    case FST_TRACK_R:
        fst_see_double(c, 0.0, state, &p, &seen);
        return seen.r;
    case FST_TRACK_B:
        fst_field_along_double(c, state[FST_X], state[FST_Y], state + FST_NX, p.b, unused);
        fst_see_double(c, 0.0, state, &p, &seen);
        return seen.b_norm;
    case FST_TRACK_GAP:
        (void)fst_renormalise_double(state);
        fst_field_along_double(c, state[FST_X], state[FST_Y], state + FST_NX, p.b, unused);
        fst_see_double(c, 0.0, state, &p, &seen);
        return seen.gap2;
    case FST_TRACK_SLIP:
        fst_see_double(c, 0.0, state, &p, &seen);
        return seen.slip2;
    default:
        (void)fst_renormalise_double(state);
        fst_magnetic_pull_double(c, state, &p);
        fst_see_double(c, 0.0, state, &p, &seen);
        return seen.load;
    }
}

/* The greatest sign * value of one quantity in the last step, if it may beat the record. */
static double best_in_step(const fst_quadrature *q, fst_flow *flow, int which, double sign, double record)
{
    const double end =
        sign * q->tracked[FST_PATH_STAGES - 1][which]; /* the end lies on the trajectory exactly */
    if (end > record)
        record = end;
    const fst_summit_double top = fst_find_summit_double(&q->tracked[0][which], FST_TRACK_COUNT, sign);
    if (!(fst_may_exceed_double(&top, record) > 0.0))
        return record;
    double value;
    (void)fst_flow_extreme(flow, tracked_at, &which, sign, top.before, top.after, &value);
    return sign * value > record ? sign * value : record;
}

/* The same from the fraction `from` on, looked for between all stages. */
static double best_in_rest(const fst_quadrature *q, fst_flow *flow, int which, double sign, double record,
                           double from)
{
    double best = fmax(sign * q->tracked[FST_PATH_STAGES - 1][which], sign * tracked_at(flow, from, &which));
    for (int n = 1; n < FST_PATH_STAGES - 1; ++n) {
        const double before = fmax(FST_PATH_NODE[n - 1], from), after = FST_PATH_NODE[n + 1];
        double value;
        if (!(before < after))
            continue;
        (void)fst_flow_extreme(flow, tracked_at, &which, sign, before, after, &value);
        best = fmax(best, sign * value);
    }
    return fmax(record, best);
}

static double best_from(const fst_quadrature *q, fst_flow *flow, int which, double sign, double record,
                        double from)
{
    return from > 0.0 ? best_in_rest(q, flow, which, sign, record, from)
                      : best_in_step(q, flow, which, sign, record);
}

void fst_quadrature_track(fst_quadrature *q, fst_flow *flow, double from)
{
    for (int i = 0; i < FST_TRACK_COUNT; ++i) {
        fst_extreme *e = &q->extreme[i];
        const int has_least = i != FST_TRACK_GAP && i != FST_TRACK_SLIP;
        e->greatest = best_from(q, flow, i, 1.0, e->greatest, from);
        if (has_least)
            e->least = -best_from(q, flow, i, -1.0, -e->least, from);
    }
}
