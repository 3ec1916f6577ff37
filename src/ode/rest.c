/* rest.c - rolling resistance along a trajectory: when a bead rolls, rests and starts to roll.
 *
 * The modes are those of model/contact/resistance.inl.  They follow each other as slip, stick and onset do
 * (contact.c), with the rotation W_h in place of the slip V and the balance T in place of the push A:
 *
 *              |W_h| nearly nothing and |T| < rho N
 *        +------------------------------------------+
 *        |                                          v
 *      rolls <---- |W_h| = handed over ---- starts  rests
 *                                           ^  |     |  ^
 *                                           |  +-----|--+ |W_h| = 0
 *                                           +--------+ |T| > rho N
 *
 * While a bead rolls, steps are measured in theta, in which a rotation that dies decays exponentially.
 *
 * Either pair of modes may change while the other one goes on.  But f differs where the contact changes from
 * slip to stick, and with it T; and A is another one where a bead rests.  So after every change contact.c asks
 * anew for both.
 *
 * Sizes.  A resistance is weak: c = 5 rho N/(7 eps^2) is 1e-4 to 1e-2, and a torque that grows at the rate k
 * leaves it behind within the time c/k, in which the rotation reaches c^2/k.  The sizes below which a rotation
 * is nothing, and at which a start is over, are in proportion to that.
 */
#include "ode/rest.h"

static const double SLOWER = 1e-3;           /* |W_h| that is nothing, in tolerances, */
static const double LEAST_SPEED = 1e-14;     /* of which rounding asks this at least; times c^2 */
static const double HAND_OVER = 0.12;        /* times tolerance^(5/16) and c^2/k */
static const double LEAST_HAND_OVER = 100.0; /* but at least so many times nothing */
static const double GREATEST = 0.05;         /* hand-over, of a torque that hardly grows */
static const double LONG = 4.0;              /* how much longer a start may take than at a steady growth */
static const double FEW = 0.01;              /* rotation then, in those of the hand-over */
static const double RELEASE_SLACK = 1e-13;   /* relative excess of |T| at a start */

static double size_of(const double v[2])
{
    return sqrt(v[0] * v[0] + v[1] * v[1]);
}

static double most(const fst_flow *flow, const fst_contact_double *at)
{
    return flow->step.context.coefficients.resistance.arm * fst_coulomb_load_double(at);
}

static fst_contact_double contact_at(const fst_flow *flow, const double *state)
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    fst_pull_double p;
    fst_magnetic_pull_double(c, state, &p);
    return fst_contact_of_double(c, state, &p);
}

/* The rotation that is nothing.  The load of a motion hardly changes it: that of the weight does. */
static double nothing(const fst_flow *flow)
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    const double strength = c->torque * c->resistance.arm * (c->gravity + c->hard);
    return fmax(SLOWER * flow->rtol, LEAST_SPEED) * fmin(1.0, strength * strength);
}

int fst_rest_is_still(const fst_flow *flow, const double *state)
{
    return size_of(state + FST_WX) <= nothing(flow);
}

int fst_rest_holds(const fst_flow *flow, const double *state)
{
    const fst_contact_double at = contact_at(flow, state);
    return size_of(at.balance) <= most(flow, &at) * (1.0 + RELEASE_SLACK);
}

/* ------------------------------------------------------------------ changes of mode */

static void start(fst_flow *flow, const double *state)
{
    const double quarter = sqrt(sqrt(flow->rtol)), part = HAND_OVER * (quarter * sqrt(sqrt(quarter)));
    double strength, growth, turning;
    fst_contact_begin_rolling(flow, state, &strength, &growth, &turning);
    growth = fabs(growth) + 1e-290;
    const double usual = growth * (strength / turning) * (strength / turning);
    flow->contact.rolls_from = fmax(part * fmin(GREATEST, usual), LEAST_HAND_OVER * nothing(flow));
    flow->contact.rolls_by = LONG * sqrt(2.0 * flow->contact.rolls_from / growth);
    flow->contact.roll_released = flow->t;
}

void fst_rest_enter(fst_flow *flow, int roll, double *state)
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    double *mode = &flow->step.context.coefficients.resistance.mode;
    *mode = FST_ROLL_RESTS; /* that of the balance */
    const fst_contact_double at = contact_at(flow, state);
    *mode = roll;
    if (roll != FST_ROLL_ROLLS)
        fst_stop_rolling_double(c, state);
    if (roll == FST_ROLL_STARTS)
        start(flow, state);
    if (roll == FST_ROLL_ROLLS && size_of(state + FST_WX) < nothing(flow)) {
        double slip[2];
        const double part = nothing(flow) / (size_of(at.balance) + 1e-290);
        fst_slip_double(c, state, slip);
        for (int i = 0; i < 2; ++i)
            state[FST_WX + i] = part * at.balance[i];
        state[FST_VX] = slip[0] + c->eps * state[FST_WY];
        state[FST_VY] = slip[1] - c->eps * state[FST_WX];
    }
}

void fst_rest_go_on(fst_flow *flow)
{
    if (fst_contact_roll(flow) == FST_ROLL_STARTS)
        flow->step.context.coefficients.resistance.lag.since =
            fst_twofold_difference(flow->t, flow->contact.roll_released);
}

/* ------------------------------------------------------------------ events that end a mode */

/* What the resistance could still take. */
static double hold(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    const fst_contact_double at = fst_contact_of_double(&flow->step.context.coefficients, state, p);
    return most(flow, &at) * (1.0 + RELEASE_SLACK) - size_of(at.balance);
}

/* Of a bead that starts: the rotation along T, which began at 0. */
static double speed(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    const fst_contact_double at = fst_contact_of_double(&flow->step.context.coefficients, state, p);
    return (state[FST_WX] * at.balance[0] + state[FST_WY] * at.balance[1]) / size_of(at.balance);
}

static double until_rolls(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    return flow->contact.rolls_from - speed(flow, state, p);
}

static double until_still(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    return speed(flow, state, p) + nothing(flow);
}

/* Where the rotation hardly grows, its direction is no longer known after some time; *x: that place. */
static int start_is_long(fst_flow *flow, double *x)
{
    const double left = flow->contact.rolls_by - flow->step.context.coefficients.resistance.lag.since;
    *x = left > 0 ? fst_contact_fraction(flow, left) : 1.0;
    *x = fmin(*x, 1.0);
    return left <= fst_contact_elapsed(flow) &&
           fst_flow_function_at(flow, *x, speed) >= FEW * flow->contact.rolls_from;
}

double fst_rest_ends(fst_flow *flow, int *next)
{
    double first = 2.0, x;
    const int roll = fst_contact_roll(flow);
    if (roll == FST_ROLL_RESTS && fst_flow_first_negative(flow, hold, 0.0, &x)) {
        *next = FST_ROLL_STARTS;
        first = x;
    }
    if (roll != FST_ROLL_STARTS)
        return first;
    if (fst_flow_first_negative(flow, until_rolls, 0.0, &x) || start_is_long(flow, &x)) {
        *next = FST_ROLL_ROLLS;
        first = x;
    }
    if (fst_flow_first_negative(flow, until_still, 0.0, &x) && x < first) {
        *next = FST_ROLL_RESTS;
        first = x;
    }
    return first;
}

int fst_rest_after(const fst_flow *flow)
{
    const fst_bead_step_double *s = &flow->step;
    if (!s->context.coefficients.kinds.resists || fst_contact_mode(flow) == FST_MODE_FLIGHT ||
        fst_contact_roll(flow) != FST_ROLL_ROLLS || !fst_rest_is_still(flow, s->end))
        return -1;
    fst_coefficients_double c = s->context.coefficients;
    c.resistance.mode = FST_ROLL_RESTS;
    const fst_contact_double at = fst_contact_of_double(&c, s->end, FST_PATH_PULL(s, FST_PATH_END));
    if (size_of(at.balance) < most(flow, &at))
        return FST_ROLL_RESTS;
    const double ahead = s->end[FST_WX] * at.balance[0] + s->end[FST_WY] * at.balance[1];
    return ahead < 0 ? FST_ROLL_STARTS : -1;
}
