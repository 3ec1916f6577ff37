/* onset.c - how a slip begins: its direction, from which onset (contact.c) follows the bead while it is slow.
 *
 * Let delta be the angle by which V lags behind A, B the rate at which A turns in space, s = |V|, a = |A|, and
 * c = (7/2) mu N.  In a slip
 *
 *     s' = a cos(delta) - c,        delta' = B - (a/s) sin(delta)
 *
 * At a release s = 0, a = c, and a - c then grows from 0 at some rate k: s = k t^2/2.  (A bead may also be put
 * down at rest where a > c.)  Of all solutions one is bounded, and a bead that was at rest follows that one.
 * With delta = s e it is, to orders in s and t,
 *
 *     s' e + s e' = B - a e + O(s^2):       e = lean + lean_slip s + O(s^2, s t),
 *     lean(t) = B/(2 a - c),                lean_slip = -lean'/(3 a - 2 c)
 *
 * lean(t) is known where the slip begins, with two derivatives, from states a little before and after on the
 * motion that begins there.  What is left out is of the order s t^3 in delta, of t^6 in the impulse of the
 * plate, and of t^7 in the place and the direction of the bead afterwards, for slip mends its own direction:
 * s^(7/2).  With the first value of `lean` alone it would be s^(5/2).
 */
#include "ode/flow.h"

#include "model/tangent.inl"

static const double APART = 1e-3; /* of the states before and after, in 1/gamma */

/* `lean` in a state of this motion; *across: 3 a - 2 c there. */
static double lean_in(const fst_flow *flow, double omega, const double *state, double *across)
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    fst_linear_double l;
    double dy[FST_STATE_SIZE], force[3], turning[3], twist[3], torque[3];
    fst_linearise_double(c, omega, state, &l, dy);
    fst_contact_double by;
    fst_pull_change_double(c, &l, state, dy, force, turning);
    by.load = -force[2];
    fst_cross_double(dy + FST_NX, l.at.b, twist);
    fst_cross_double(state + FST_NX, turning, torque);
    fst_dry_change_double(c, &l, state, dy, force, twist, torque, &by);
    const double *a = l.contact.push, size2 = a[0] * a[0] + a[1] * a[1], size = sqrt(size2);
    const double turns = omega + (a[0] * by.push[1] - a[1] * by.push[0]) / size2;
    const double mu = fst_coulomb_mu_double(&c->law.coulomb, 0.0);
    const double excess = size - 3.5 * mu * fst_coulomb_load_double(&l.contact);
    *across = size + 2.0 * excess;
    return turns / (size + excess);
}

/* The states APART before (0) and after (1) the given one, to the second order in time. */
static void states_around(const fst_flow *flow, double omega, const double *state,
                          double around[2][FST_STATE_SIZE])
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    double slope[FST_STATE_SIZE], slopes[2][FST_STATE_SIZE];
    fst_pull_double unused;
    fst_rhs_double(c, omega, state, slope, &unused);
    for (int side = 0; side < 2; ++side) {
        const double time = side ? APART : -APART;
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            around[side][i] = state[i] + time * slope[i];
        fst_rhs_double(c, omega + time * flow->step.ramp, around[side], slopes[side], &unused);
    }
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            around[side][i] += 0.25 * APART * (slopes[1][i] - slopes[0][i]); /* y'' APART^2/2 */
}

void fst_contact_begin_onset(fst_flow *flow, const double *state)
{
    fst_coulomb_double *law = &flow->step.context.coefficients.law.coulomb;
    const double omega = fst_flow_omega(flow, flow->t), turn = APART * flow->step.ramp;
    double around[2][FST_STATE_SIZE], across;
    law->mode = FST_MODE_ONSET;
    law->lean = law->lean_slip = law->since = 0.0;
    states_around(flow, omega, state, around);
    const double before = lean_in(flow, omega - turn, around[0], &across),
                 after = lean_in(flow, omega + turn, around[1], &across);
    law->lean = law->lean_then[0] = lean_in(flow, omega, state, &across);
    law->lean_then[1] = (after - before) / (2.0 * APART);
    law->lean_then[2] = 0.5 * (after - 2.0 * law->lean + before) / (APART * APART);
    law->lean_slip = -law->lean_then[1] / across;
}
