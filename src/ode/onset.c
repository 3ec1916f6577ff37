/* onset.c - how a slip begins: its direction, from which onset (contact.c) follows the bead while it is slow.
 * And how a bead begins to roll that a plate's resistance had kept from it (rest.c), which is the same for
 * another velocity: W_h, with the push a T and the strength a rho N, a = 1/(beta k eps^2) of a contact that
 * sticks and 1/(beta eps^2) of one that slips.
 *
 * Let delta be the angle by which V lags behind A, B the rate at which A turns in space, s = |V|, a = |A|, and
 * c = k mu N.  In a slip
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
#include "ode/onset.h"

#include "model/tangent.inl"

static const double APART = 1e-3; /* of the states before and after, in 1/gamma, */
static const double PART = 0.1;   /* or of the time in which the push doubles */
static const double TURNS = 2.0;  /* how far an onset may go while its push turns, over radians */

/* A push a and its change, with the strength c of what it works against. */
typedef struct pushed {
    double a[2], da[2], c, dc;
} pushed;

static pushed push_of_slip(const fst_world_double *c, const fst_contact_double *at,
                           const fst_contact_double *by)
{
    /* A bead that does not roll feels A as A/k: model/dynamics.inl */
    const double share = c->kinds.resists && fst_rests_double(at->modes) ? c->share : 1.0;
    const double mu = c->yielding * share * fst_coulomb_mu_double(&c->law.coulomb, 0.0);
    const pushed p = {{share * at->push[0], share * at->push[1]},
                      {share * by->push[0], share * by->push[1]},
                      mu * fst_coulomb_load_double(at),
                      mu * by->load};
    return p;
}

static pushed push_of_roll(const fst_world_double *c, const fst_contact_double *at,
                           const fst_contact_double *by)
{
    const double share = fst_sticks_double(c, at->modes) > 0.5 ? c->share * c->torque : c->torque;
    const pushed p = {{share * at->balance[0], share * at->balance[1]},
                      {share * by->balance[0], share * by->balance[1]},
                      share * c->resistance.arm * fst_coulomb_load_double(at),
                      share * c->resistance.arm * by->load};
    return p;
}

typedef pushed (*push_function)(const fst_world_double *, const fst_contact_double *,
                                const fst_contact_double *);

/* The push on a bead in this state of this motion, and its change in time. */
static pushed push_in(const fst_flow *flow, push_function push, double omega, const double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_linear_double l;
    double dy[FST_STATE_SIZE], force[3], turning[3], twist[3], torque[3];
    fst_linearise_double(c, fst_flow_modes(flow), omega, state, &l, dy);
    fst_contact_double by;
    fst_pull_change_double(c, &l, state, dy, force, turning);
    fst_slip_double(c, dy, by.slip);
    by.load = -force[2];
    fst_cross_double(dy + FST_NX, l.at.b, twist);
    fst_cross_double(state + FST_NX, turning, torque);
    fst_dry_change_double(c, &l, state, dy, force, twist, torque, &by);
    return push(c, &l.contact, &by);
}

/* `lean` in a state of this motion; *across: 3 a - 2 c there. */
static double lean_in(const fst_flow *flow, push_function push, double omega, const double *state,
                      double *across)
{
    const pushed p = push_in(flow, push, omega, state);
    const double size2 = p.a[0] * p.a[0] + p.a[1] * p.a[1], size = sqrt(size2);
    const double turns = omega + (p.a[0] * p.da[1] - p.a[1] * p.da[0]) / size2;
    const double excess = size - p.c;
    *across = size + 2.0 * excess;
    return turns / (size + excess);
}

/* The states `apart` before (0) and after (1) the given one, to the second order in time. */
static void states_around(const fst_flow *flow, double omega, const double *state, double apart,
                          double around[2][FST_NUMBERS])
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_modes_double *m = fst_flow_modes(flow);
    double slope[FST_STATE_SIZE], slopes[2][FST_STATE_SIZE];
    fst_pull_double unused;
    memset(around, 0, 2 * sizeof *around); /* they do not lag yet, at no time */
    fst_rhs_double(c, m, omega, state, slope, &unused);
    for (int side = 0; side < 2; ++side) {
        const double time = side ? apart : -apart;
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            around[side][i] = state[i] + time * slope[i];
        fst_rhs_double(c, m, omega + time * flow->drive.ramp, around[side], slopes[side], &unused);
    }
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            around[side][i] += 0.25 * apart * (slopes[1][i] - slopes[0][i]); /* y'' apart^2/2 */
}

/* The lag of a motion that begins in this state, whose mode is set; `apart` is the time between the states of
 * which it is made. */
static void begin_lag(const fst_flow *flow, push_function push, double apart, const double *state,
                      fst_lag_double *lag)
{
    const double omega = fst_drive_rate_double(&flow->drive, flow->t), turn = apart * flow->drive.ramp;
    double around[2][FST_NUMBERS], across;
    states_around(flow, omega, state, apart, around);
    const double before = lean_in(flow, push, omega - turn, around[0], &across),
                 after = lean_in(flow, push, omega + turn, around[1], &across);
    const double lean = lean_in(flow, push, omega, state, &across);
    lag->lean[0] = lean;
    lag->lean[1] = (after - before) / (2.0 * apart);
    lag->lean[2] = 0.5 * (after - 2.0 * lean + before) / (apart * apart);
    lag->slip = -lag->lean[1] / across;
    lag->since = 0.0;
}

double fst_hand_over(double rtol)
{
    const double quarter = sqrt(sqrt(rtol));
    return quarter * sqrt(sqrt(quarter));
}

/* The time, in 1/gamma but at most 1, in which the push on a slip may turn.  It does so at the rate at which
 * the direction of a slow rotation does, from which the plate's torque comes. */
static double time_of_turning(const fst_flow *flow, const double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_modes_double *m = fst_flow_modes(flow);
    if (!c->kinds.resists || m->rolling != FST_ROLL_ROLLS)
        return 1.0;
    fst_pull_double p;
    fst_magnetic_pull_double(c, m, state, &p);
    const double spin = fst_norm_2_double(state + FST_WX);
    const double strength = c->share * c->torque * c->resistance.arm * fmax(fst_load_double(c, p.force), 0.0);
    return fmin(1.0, TURNS * spin / (strength + 1e-290));
}

double fst_begin_onset(fst_flow *flow, const double *state)
{
    fst_modes_double *modes = &flow->step.context.modes;
    fst_lag_double lag;
    modes->contact = FST_MODE_ONSET;
    modes->onset = fst_new_modes_double().onset;
    const double time = time_of_turning(flow, state);
    begin_lag(flow, push_of_slip, fmin(APART, PART * time), state, &lag);
    modes->onset = lag;
    return time;
}

void fst_begin_rolling(fst_flow *flow, const double *state, double *strength, double *growth, double *turning)
{
    fst_modes_double *modes = &flow->step.context.modes;
    fst_lag_double lag;
    modes->rolling = FST_ROLL_STARTS;
    modes->start = fst_new_modes_double().start;
    const pushed p = push_in(flow, push_of_roll, fst_drive_rate_double(&flow->drive, flow->t), state);
    const double size = fst_norm_2_double(p.a) + 1e-290;
    *turning = fst_norm_2_double(p.da) + 1e-290;
    *strength = p.c;
    *growth = (p.a[0] * p.da[0] + p.a[1] * p.da[1]) / size - p.dc;
    begin_lag(flow, push_of_roll, fmin(APART, PART * size / *turning), state, &lag);
    modes->start = lag;
}
