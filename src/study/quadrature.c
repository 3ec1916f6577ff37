#include "study/quadrature.h"

#include <string.h>

#include "ode/peak.inl"

static void see_point(const fst_flow *flow, int point, fst_seen_double *seen)
{
    const fst_bead_step_double *s = &flow->step;
    fst_see_double(&s->context.coefficients, fst_point_omega_double(s, point), FST_POINT_STATE(s, point),
                   FST_POINT_PULL(s, point), seen);
}

static void fill_point(fst_quadrature *q, const fst_flow *flow, int point, double *tracked)
{
    const fst_bead_step_double *s = &flow->step;
    fst_seen_double seen;
    see_point(flow, point, &seen);
    fst_integrands_double(&s->context.coefficients, FST_POINT_STATE(s, point), FST_POINT_PULL(s, point), &seen,
                          q->r_reference, q->b_reference, q->integrands[point]);
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
    see_point(flow, FST_START_POINT, &seen);
    q->r_reference = seen.r;
    q->b_reference = seen.b_norm;
}

void fst_quadrature_step(fst_quadrature *q, fst_flow *flow)
{
    for (int i = 0; i < FST_Q_COUNT; ++i)
        q->total[i] = fst_twofold_add(q->total[i], q->increment[i]);
    for (int point = 0; point < FST_PATH_POINTS; ++point)
        fill_point(q, flow, point, q->tracked[point]);
    for (int i = 0; i < FST_Q_COUNT; ++i)
        q->increment[i] = flow->step.h * fst_path_mean_double(&q->integrands[0][i], FST_Q_COUNT);
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
            for (int point = FST_PATH_POINTS; point < FST_DENSE_POINTS; ++point)
                fill_point(q, flow, point, NULL);
            fst_path_dense_double(FST_Q_COUNT, flow->step.h, zero, q->increment, &q->integrands[0][0],
                                  &q->dense[0][0]);
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
    const double end = sign * q->tracked[FST_END_POINT][which]; /* the end lies on the trajectory exactly */
    if (end > record)
        record = end;
    const fst_peak_double top = fst_find_peak_double(&q->tracked[0][which], FST_TRACK_COUNT, sign);
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
    double best = fmax(sign * q->tracked[FST_END_POINT][which], sign * tracked_at(flow, from, &which));
    for (int n = 1; n < FST_END_POINT; ++n) {
        const double before = fmax(FST_POINT_NODE[n - 1], from), after = FST_POINT_NODE[n + 1];
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
