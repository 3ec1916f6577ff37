/* creep.c - a slip so slow that its direction is known.
 *
 * Where the push A is nearly as strong as friction, c = k mu N, a bead may slip for a long time at a speed s that
 * hardly changes and is tiny: V' = A - c V/|V|.  The direction of V then follows that of A at the rate |A|/s.  An
 * explicit method must make steps of a few s/|A|, however smooth the motion is:
 *
 *     direction of V |\
 *                    | \ after a few s/|A| ...        ... it lags behind that of A by an angle that is known
 *                    |  `-----.___________________     (onset.c), for as long as s stays small
 *                    +---------------------------------> t
 *
 * Worse, at that size of step what a method leaves of a turned direction does not die out.  So the slip is then
 * turned into the known direction, and integrated in time with friction along it: the mode creep.  Its steps are
 * as long as those of a bead that sticks.  What the slip lacks of the known direction at the end of a step is
 * given back by the plate's impulse, which leaves the moment about the contact as it is; that is also the measure
 * of how good the lag was, and so of how long the next step may be.
 *
 *     slip ---- slow for long, and turned so ----> creep ---+ every step: another lag
 *      ^                                           ^  |  |  |
 *      +------------- no longer slow --------------+--+  +--+
 *                                                  |
 *                                                  +-- s = 0 ----> stick
 *
 * The orders that the lag leaves out are the fourth of s, if every order before is below that power of a `bound`.
 * The bound goes with the fourth root of the tolerance.
 *
 * A disc (model/contact/patch.inl) of the radius a that pivots at the rate w settles at the rate k mu N/(a |w|): where
 * the push is weaker than friction all of its slip is known, not its direction alone.  With f = (A - V')/k, nu is that
 * at which the plate gives |f|, V = a |w| nu f/|f|, and V' is found by rounds: of the slip that the last V' gives,
 * at three times beside each other.  Each round adds an order in the time in which the slip settles; a quadratic V'
 * leaves out the fourth.  The torque against pivoting follows from nu.  So nothing is left that is stiff, and w passes
 * through 0, comes to rest there and leaves it without a floor under |w| (model/disc.c):
 *
 *     w = 0 in a creep:  the disc could be held: stick; else it pivots the other way, in another creep
 *     stick, let go:     a creep, if nu is small there; else a slip
 *     nu too great:      slip
 */
#include "ode/creep.h"

#include "model/disc.h"
#include "model/tangent.inl"
#include "ode/onset.h"

static const double LONG = 50.0;     /* s/|A| in which a slip that creeps has not ended or doubled */
static const double BOUND = 0.25;    /* of the lag of a slip that begins to creep, over tolerance^(1/4) */
static const double LEAVE = 2.0;     /* how far it may grow */
static const double MOST = 0.01;     /* the greatest bound */
static const double DEFECT = 0.3;    /* what the slip may lack after a step, in tolerances */
static const double FIRST = 0.05;    /* the first step */
static const double STRONGER = 0.25; /* how much stronger than the push, over it, friction may be */
/* Of a disc: */
static const double BEGINS_AT = 0.8;       /* the greatest nu of one that begins to creep */
static const double GREATEST_SHARE = 0.86; /* of mu N, at which it no longer does (nu = 0.93) */
static const double NEAR = 0.1;            /* how far the first guess of its slip may be off, over the slip */
static const double LEFT_OUT = 1.0;        /* the last term of its slip, in tolerances */
enum { ROUNDS = 4 };

static double bound_of(const fst_flow *flow)
{
    return fmin(BOUND * sqrt(sqrt(flow->rtol)), MOST);
}

/* The slip at which the terms of the lag are bound, bound^2 and bound^3. */
static double greatest_slip(const fst_lag_double *lag, double bound)
{
    const double first = fabs(lag->lean[0]), second = sqrt(fabs(lag->slip)), third = cbrt(fabs(lag->curve));
    return bound / (fmax(first, fmax(second, third)) + 1e-290);
}

/* The slip along u, the known direction, of V; *off: what V has besides. */
static double turn_slip(const fst_creeping *k, const double v[2], double u[2], double *off)
{
    fst_lag_direction_double(&k->lag, 0.0, k->push, v, u);
    *off = fabs(u[0] * v[1] - u[1] * v[0]);
    return v[0] * u[0] + v[1] * u[1];
}

static int is_disc(const fst_flow *flow)
{
    return fst_flow_world(flow)->kinds.patch != FST_PATCH_POINT;
}

/* ------------------------------------------------------------------ a disc */

static fst_disc_creep_double creep_at(const fst_world_double *c, const fst_modes_double *m, const double *state,
                                      const fst_pull_double *p)
{
    const fst_contact_double at = fst_contact_of_double(c, m, state, p);
    return fst_coulomb_creep_double(&c->law.coulomb, &at);
}

/* The last term of its slip that is not left out. */
static double disc_leaves(const fst_world_double *c, const fst_modes_double *m, const double *state,
                          const fst_disc_creep_double *k)
{
    const double time = k->radius * fabs(state[FST_WZ]) * fst_disc_eases(k) / (c->yielding * k->dry);
    return 2.0 * time * time * time * hypot(m->gain[0][2], m->gain[1][2]);
}

/* Whether the disc that slips has the slip of one that creeps; what costs little is asked first. */
static int disc_begins(const fst_flow *flow)
{
    const fst_bead_step_double *s = &flow->step;
    const fst_world_double *c = FST_WORLD(s);
    fst_modes_double m = *FST_MODES(s);
    double v[2], now[FST_NUMBERS];
    memcpy(now, s->end, sizeof now);
    now[FST_STEP_TIME] = 0.0;
    fst_slip_double(c, now, v);
    m.contact = FST_MODE_CREEP;
    m.way = now[FST_WZ] < 0 ? -1.0 : 1.0;
    memset(m.gain, 0, sizeof m.gain);
    fst_disc_creep_double k = creep_at(c, &m, now, FST_PATH_PULL(s, FST_PATH_END));
    if (k.nu > BEGINS_AT || hypot(v[0] - k.slip[0], v[1] - k.slip[1]) > NEAR * fst_norm_2_double(v))
        return 0;
    fst_fit_gain(flow, now, &m, ROUNDS);
    k = creep_at(c, &m, now, FST_PATH_PULL(s, FST_PATH_END));
    return hypot(v[0] - k.slip[0], v[1] - k.slip[1]) <= flow->rtol &&
           disc_leaves(c, &m, now, &k) <= LEFT_OUT * flow->rtol;
}

/* Which way a disc pivots, or begins to pivot. */
static double way_of(const fst_flow *flow, const double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_modes_double held = *fst_flow_modes(flow);
    fst_pull_double p;
    held.contact = FST_MODE_STICK;
    if (fabs(state[FST_WZ]) > 1.001 * fst_captured_double(flow->rtol))
        return state[FST_WZ] < 0 ? -1.0 : 1.0;
    fst_magnetic_pull_double(c, &held, state, &p);
    return fst_contact_of_double(c, &held, state, &p).torque[2] > 0 ? -1.0 : 1.0;
}

static void enter_disc(fst_flow *flow, double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_modes_double *m = &flow->step.context.modes;
    fst_pull_double p;
    const double way = way_of(flow, state), h = flow->step.h;
    const int goes_on = m->contact == FST_MODE_CREEP && m->way == way;
    for (int i = 0; i < 2; ++i) {
        double *gain = m->gain[i];
        gain[0] = goes_on ? gain[0] + h * (gain[1] + h * gain[2]) : 0.0;
        gain[1] = goes_on ? gain[1] + 2.0 * h * gain[2] : 0.0;
        gain[2] = goes_on ? gain[2] : 0.0;
    }
    m->contact = FST_MODE_CREEP;
    m->way = way;
    state[FST_STEP_TIME] = 0.0;
    fst_fit_gain(flow, state, m, goes_on ? 1 : ROUNDS);
    fst_magnetic_pull_double(c, m, state, &p);
    fst_set_slip_double(c, state, creep_at(c, m, state, &p).slip);
}

int fst_creep_is_released(const fst_flow *flow, const double *state)
{
    fst_pull_double p;
    double slip[2], pivot;
    if (flow->contact.followed)
        return 0;
    fst_magnetic_pull_double(fst_flow_world(flow), fst_flow_modes(flow), state, &p);
    fst_disc_release(fst_flow_world(flow), fst_flow_modes(flow), state, &p, slip, &pivot);
    return fst_norm_2_double(slip) < BEGINS_AT * fst_flow_world(flow)->law.coulomb.patch.radius * fabs(pivot);
}

/* ------------------------------------------------------------------ begin and go on */

/* Whether the slip has hardly changed in the last step, which is cheap to say. */
static int may_begin(const fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    return fst_contact_mode(flow) == FST_MODE_SLIP && !flow->contact.followed &&
           (!c->kinds.resists || fst_contact_roll(flow) == FST_ROLL_ROLLS) &&
           fst_slip_may_creep_double(&flow->step);
}

int fst_creep_begins(const fst_flow *flow)
{
    const fst_coulomb_double *law = &fst_flow_world(flow)->law.coulomb;
    double v[2], u[2], off;
    if (!may_begin(flow))
        return 0;
    if (is_disc(flow))
        return disc_begins(flow);
    const double *end = flow->step.end, bound = bound_of(flow);
    fst_slip_double(fst_flow_world(flow), end, v);
    const double s = fst_norm_2_double(v);
    const fst_creeping k = fst_creeping_at(flow, end);
    const double a = k.size, along = turn_slip(&k, v, u, &off);
    const int lasts = fabs(k.excess) * LONG <= a && fabs(k.growth) * s * LONG * LONG <= 2.0 * a * a;
    const int steady = s * s * law->stribeck * law->fall <= bound * bound * law->sliding;
    return lasts && steady && along > 0 && s <= greatest_slip(&k.lag, bound) && off <= flow->rtol;
}

static void enter_point(fst_flow *flow, double *state)
{
    const fst_creeping k = fst_creeping_at(flow, state);
    double v[2], u[2], off;
    fst_slip_double(fst_flow_world(flow), state, v);
    const double s = turn_slip(&k, v, u, &off);
    flow->step.context.modes.contact = FST_MODE_CREEP;
    flow->step.context.modes.onset = k.lag;
    flow->contact.slip.free_at = LEAVE * greatest_slip(&k.lag, bound_of(flow));
    fst_set_slip_double(fst_flow_world(flow), state, (const double[2]){s * u[0], s * u[1]});
}

void fst_creep_enter(fst_flow *flow, double *state)
{
    if (fst_contact_mode(flow) != FST_MODE_CREEP)
        flow->contact.slip.longest = FIRST;
    if (is_disc(flow))
        enter_disc(flow, state);
    else
        enter_point(flow, state);
}

void fst_creep_is_followed(fst_flow *flow)
{
    flow->contact.followed = is_disc(flow);
    if (is_disc(flow) &&
        (fst_contact_mode(flow) == FST_MODE_CREEP || flow->contact.slip.next == FST_MODE_CREEP))
        flow->contact.slip.next = FST_MODE_SLIP;
}

/* ------------------------------------------------------------------ what ends a step */

/* The speed along the push. */
static double speed(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    const fst_contact_double at = fst_contact_of_double(fst_flow_world(flow), fst_flow_modes(flow), state, p);
    return (at.slip[0] * at.push[0] + at.slip[1] * at.push[1]) / fst_norm_2_double(at.push);
}

static double until_free(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    if (is_disc(flow))
        return GREATEST_SHARE - creep_at(fst_flow_world(flow), fst_flow_modes(flow), state, p).share;
    return flow->contact.slip.free_at - speed(flow, state, p);
}

static double until_held(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    if (is_disc(flow))
        return fst_flow_modes(flow)->way * state[FST_WZ] + fst_captured_double(flow->rtol);
    return speed(flow, state, p) - 0.5 * fst_captured_double(flow->rtol);
}

/* What a slip that comes to nothing at the fraction x of the last step goes on as: a disc may pivot on. */
static int held_at(fst_flow *flow, double x)
{
    fst_motion_double motion;
    fst_pull_double p;
    if (!is_disc(flow))
        return FST_MODE_STICK;
    fst_flow_motion_at(flow, x, &motion);
    fst_magnetic_pull_double(fst_flow_world(flow), &motion.modes, motion.numbers, &p);
    const double left = fst_disc_hold(fst_flow_world(flow), &motion.modes, motion.numbers, &p);
    const int turns_round = way_of(flow, motion.numbers) != fst_flow_modes(flow)->way;
    return left <= 0 && turns_round ? FST_MODE_CREEP : FST_MODE_STICK;
}

/* What the slip lacks of the known one at the end of the last step, over what it may. */
static double defect(const fst_flow *flow)
{
    const fst_bead_step_double *s = &flow->step;
    const fst_world_double *c = fst_flow_world(flow);
    const fst_pull_double *p = FST_PATH_PULL(s, FST_PATH_END);
    double u[2];
    const fst_contact_double at = fst_contact_of_double(c, fst_flow_modes(flow), s->end, p);
    if (is_disc(flow)) {
        const fst_disc_creep_double k = fst_coulomb_creep_double(&c->law.coulomb, &at);
        return hypot(at.slip[0] - k.slip[0], at.slip[1] - k.slip[1]) / (DEFECT * flow->rtol);
    }
    fst_lag_direction_double(&fst_flow_modes(flow)->onset, at.time, at.push, at.slip, u);
    return fabs(u[0] * at.slip[1] - u[1] * at.slip[0]) / (DEFECT * flow->rtol);
}

double fst_creep_ends(fst_flow *flow, int *next)
{
    static const double most = 2.0, least = 0.1; /* changes of the size of a step */
    const double off = defect(flow);             /* goes with the fourth power of the size */
    const double part = fmin(fmax(0.9 / sqrt(sqrt(off + 1e-290)), least), most);
    double first = off > 1.0 ? part : 2.0, x;
    flow->contact.slip.longest = part * flow->step.h;
    *next = FST_MODE_CREEP;
    if (fst_flow_first_negative(flow, until_held, 0.0, &x) && x < first) {
        *next = held_at(flow, x);
        first = x;
    }
    if (fst_flow_becomes_negative(flow, until_free, &x) && x < first) {
        *next = FST_MODE_SLIP;
        first = x;
    }
    return first;
}

int fst_creep_after(const fst_flow *flow)
{
    const fst_bead_step_double *s = &flow->step;
    const fst_world_double *c = fst_flow_world(flow);
    const fst_contact_double at =
        fst_contact_of_double(c, fst_flow_modes(flow), s->end, FST_PATH_PULL(s, FST_PATH_END));
    if (is_disc(flow)) {
        const fst_disc_creep_double k = fst_coulomb_creep_double(&c->law.coulomb, &at);
        const double left_out = disc_leaves(c, fst_flow_modes(flow), s->end, &k);
        return left_out > LEAVE * LEFT_OUT * flow->rtol ? FST_MODE_SLIP : FST_MODE_CREEP;
    }
    const double grip = fst_grip_double(&at, c->yielding, fst_coulomb_mu_double(&c->law.coulomb, 0.0), 0.0);
    return grip > STRONGER * fst_norm_2_double(at.push) ? FST_MODE_SLIP : FST_MODE_CREEP;
}

/* ------------------------------------------------------------------ neighbours */

void fst_creep_slip_change(const fst_world_double *c, const fst_modes_double *m, double omega, const double *y,
                           const double *d, double slip[2])
{
    fst_linear_double l;
    double f[FST_STATE_SIZE], u[2], turned[2];
    fst_linearise_double(c, m, omega, y, &l, f);
    const fst_contact_double by = fst_contact_change_double(c, &l, y, d), *at = &l.contact;
    fst_lag_direction_double(&m->onset, 0.0, at->push, at->slip, u);
    fst_lag_change_double(&m->onset, 0.0, at->push, at->slip, by.push, by.slip, 1.0, 0.0, turned);
    const double s = fst_norm_2_double(at->slip), along = u[0] * by.slip[0] + u[1] * by.slip[1];
    for (int i = 0; i < 2; ++i)
        slip[i] = along * u[i] + s * turned[i];
}
