/* quadrature.c - the integrals of one trajectory, step by step and within a step.
 *
 * Who integrates the mean of r?  fst_quadrature_step() adds what each step contributes to the integral of r,
 * and of all other quantities, by the scheme that integrals.inl explains; marks.c notes the integrals at
 * moments; means.c divides the difference of two marks by the time between them.
 *
 *     total (two doubles)                      increment
 *     ---------------------------------------|===========================|
 *     start of the run            start of the last step         its end
 *
 * A mark mostly falls within a step.  The method's dense output is a polynomial over the step made of the
 * derivatives at all its stages; with the integrands in place of the derivatives the same polynomial
 * interpolates the increments, as accurately as it does the state.  It takes the integrands at three further
 * places, which are made only when they are asked for.
 *
 * phi is counted, not integrated: whole turns, changed where the path crosses a half-axis of its plane, and the
 * angle of the last point (base/winding.h).  Where n comes close to e_r the plane's origin is near, and the
 * straight line from one step's end to the next may pass it on the other side than the path: the step is then
 * bisected.
 */
#include "observe/quadrature.h"
#include "observe/passages.h"

#include <string.h>

static void see_place(const fst_flow *flow, int place, fst_seen_double *seen)
{
    const fst_bead_step_double *s = &flow->step;
    fst_see_double(FST_WORLD(s), FST_MODES(s), fst_flow_drive_at_place(flow, place), FST_PATH_STATE(s, place),
                   FST_PATH_PULL(s, place), seen);
}

/* ------------------------------------------------------------------ phi */

/* Follow phi over the fractions [x0, x1] of the last step, bisecting where n comes close to e_r. */
static void follow_moment_angle(fst_flow *flow, fst_winding *angle, double x0, double x1, const double *state)
{
    double u, w;
    fst_moment_angle_point_double(state, &u, &w);
    const double middle = 0.5 * (x0 + x1);
    if (x1 - x0 > 1e-9 && fst_winding_is_doubtful(angle, u, w)) {
        double between[FST_STATE_SIZE];
        fst_flow_at(flow, middle, between);
        follow_moment_angle(flow, angle, x0, middle, between);
        follow_moment_angle(flow, angle, middle, x1, state);
        return;
    }
    fst_winding_advance(angle, u, w);
}

void fst_quadrature_begin_moment_angle(fst_quadrature *q, const double *state)
{
    fst_moment_angle_point_double(state, &q->moment_angle.x, &q->moment_angle.y);
    q->moment_angle_start = q->moment_angle;
}

void fst_quadrature_follow(fst_quadrature *q, fst_flow *flow, const double *end)
{
    q->moment_angle_start = q->moment_angle;
    follow_moment_angle(flow, &q->moment_angle, 0.0, 1.0, end);
}

/* ------------------------------------------------------------------ integrals */

void fst_quadrature_begin(fst_quadrature *q, const fst_flow *flow)
{
    memset(q, 0, sizeof *q);
    fst_quadrature_begin_moment_angle(q, flow->step.end);
}

void fst_quadrature_set_references(fst_quadrature *q, const fst_flow *flow)
{
    fst_seen_double seen;
    see_place(flow, 0, &seen);
    q->sums.r_reference = seen.r;
    q->sums.b_reference = seen.b_norm;
}

void fst_quadrature_resolve(fst_quadrature *q, fst_flow *flow)
{
    if (q->is_resolved || !q->passages)
        return;
    fst_passages_integrate(flow, q->passages, 1.0, q->sums.r_reference, q->sums.increment);
    q->is_resolved = 1;
}

void fst_quadrature_look_for_passages(fst_quadrature *q, const fst_flow *flow)
{
    q->passages = fst_passages_of(flow);
    q->is_resolved = 0;
}

void fst_quadrature_step(fst_quadrature *q, fst_flow *flow, int renew)
{
    const fst_bead_step_double *s = &flow->step;
    fst_add_increments_double(&q->sums, 1);
    for (int place = 0; place < FST_PATH_PLACES; ++place)
        fst_look_at_place_double(&q->sums, s, fst_flow_drive_at_place(flow, place), place, renew);
    fst_integrate_step_double(&q->sums, s, 1);
    q->has_dense = 0;
    fst_quadrature_follow(q, flow, flow->step.end);
    fst_quadrature_look_for_passages(q, flow);
    if (!renew)
        fst_quadrature_resolve(q, flow);
}

/* The dense output of the increments, unless it is there. */
static void make_dense(fst_quadrature *q, fst_flow *flow)
{
    const fst_bead_step_double *s = &flow->step;
    if (q->has_dense)
        return;
    fst_flow_make_dense(flow);
    for (int place = FST_PATH_PLACES; place < FST_DENSE_PLACES; ++place) {
        fst_seen_double seen;
        see_place(flow, place, &seen);
        fst_integrands_double(FST_WORLD(s), FST_MODES(s), FST_PATH_STATE(s, place), FST_PATH_PULL(s, place),
                              &seen, q->sums.r_reference, q->sums.b_reference,
                              q->between[place - FST_PATH_PLACES]);
        fst_pace_integrands_double(s, place, FST_Q_COUNT, q->between[place - FST_PATH_PLACES]);
    }
    fst_path_dense_double(s, FST_Q_COUNT, q->sums.increment, &q->sums.integrands[0][0], &q->between[0][0],
                          &q->dense[0][0]);
    q->has_dense = 1;
}

void fst_quadrature_at(fst_quadrature *q, fst_flow *flow, double x, double integrals[FST_Q_COUNT],
                       double *moment_angle)
{
    double part[FST_Q_COUNT];
    fst_quadrature_resolve(q, flow);
    if (x == 1.0) {
        memcpy(part, q->sums.increment, sizeof part);
        *moment_angle = fst_winding_angle(&q->moment_angle);
    } else {
        make_dense(q, flow);
        fst_bead_evaluate_dense_double(FST_Q_COUNT, &q->dense[0][0], FST_Q_COUNT, x, part);
        if (q->passages)
            fst_passages_integrate(flow, q->passages, x, q->sums.r_reference, part);
        fst_winding angle = q->moment_angle_start;
        double state[FST_STATE_SIZE];
        fst_flow_at(flow, x, state);
        follow_moment_angle(flow, &angle, 0.0, x, state);
        *moment_angle = fst_winding_angle(&angle);
    }
    for (int i = 0; i < FST_Q_COUNT; ++i)
        integrals[i] = fst_twofold_add(q->sums.total[i], part[i]).high;
    if (!q->lacks_part)
        return;
    for (int i = 0; i < FST_Q_COUNT; ++i)
        integrals[i] += q->left_out[i];
    *moment_angle += q->left_out_moment_angle;
}
