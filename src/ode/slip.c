/* slip.c - the slip of a contact along a trajectory: the automaton's first instance (automaton.inl).
 *
 *     in general      moves   held    begins    v    a    c
 *     here            slip    stick   onset     V    A    k mu N
 *
 * A contact that is a disc (model/disc.c) is held and let go without an onset: while it slips or pivots its
 * friction is smooth.
 */
#include "ode/slip.h"

#include "model/disc.h"
#include "model/modes.h"
#include "model/tangent.inl"
#include "ode/creep.h"
#include "ode/onset.h"

static const double HAND_OVER = 0.12;        /* times tolerance^(5/16) */
static const double LEAST_HAND_OVER = 100.0; /* but at least so many captured */
/* How close to letting go, over friction and the root of the tolerance, a contact is that may do so at another one: so
 * large may swings be that the errors of steps still damp. */
static const double CLOSE = 10.0;
static const double USUAL_GROWTH = 0.1; /* of a slip, in l gamma^3: the time of the hand-over follows from it */

static double captured(const fst_flow *flow)
{
    return fst_captured_double(flow->rtol);
}

/* The slip that is nearly nothing ends where sliding friction brakes it. */
static int stops(const fst_world_double *c, const fst_contact_double *at)
{
    return fst_grip_double(at, c->yielding, fst_coulomb_mu_double(&c->law.coulomb, 0.0), 0.0) > 0;
}

static void begin(fst_flow *flow, const double *state)
{
    const double part = fst_begin_onset(flow, state);
    flow->contact.slip.free_at =
        fmax(HAND_OVER * fst_hand_over(flow->rtol) * part * part, LEAST_HAND_OVER * captured(flow));
    flow->contact.slip.free_by = sqrt(2.0 * flow->contact.slip.free_at / USUAL_GROWTH);
}

static void stop(const fst_world_double *c, double *state)
{
    static const double nothing[2] = {0.0, 0.0};
    fst_set_slip_double(c, state, nothing);
}

#define PART_NAME(name) slip_##name
#define PART_API static
#define PART_MODE contact
#define PART_LAG onset
#define PART_STATE slip
#define PART_VELOCITY(c, y, v) fst_slip_double(c, y, v)
#define PART_PUSH(at) ((at)->push)
#define PART_LEFT(c, at) fst_static_grip_double(c, at)
#define PART_STOPS(c, at) stops(c, at)
#define PART_ASKED(m) ((void)(m))
#define PART_NOTHING(flow) captured(flow)
#define PART_OVER(flow) fst_slip_is_over_double(&(flow)->step, (flow)->rtol)
#define PART_RELEASED(c) fst_released_mode(c)
#define PART_STOP(c, y) stop(c, y)
#define PART_SET(c, y, v) fst_set_slip_double(c, y, v)
#define PART_BEGIN(flow, state) begin(flow, state)
#include "ode/automaton.inl"

/* ------------------------------------------------------------------ a disc */

static int is_disc(const fst_flow *flow)
{
    return fst_flow_world(flow)->kinds.patch != FST_PATCH_POINT;
}

static double disc_left(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    return fst_disc_hold(fst_flow_world(flow), fst_flow_modes(flow), state, p) + FST_RELEASE_SLACK;
}

/* A disc is held, or let go of, at `state`. */
static void enter_disc(fst_flow *flow, int mode, double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_modes_double *m = fst_flow_modes(flow);
    double slip[2] = {0.0, 0.0}, pivot = 0.0;
    if (mode == FST_MODE_SLIP && m->contact != FST_MODE_STICK)
        return;
    if (mode == FST_MODE_SLIP) {
        fst_pull_double p;
        fst_magnetic_pull_double(c, m, state, &p);
        fst_disc_release(c, m, state, &p, slip, &pivot);
    }
    fst_set_slip_double(c, state, slip);
    state[FST_WZ] = pivot;
}

/* ------------------------------------------------------------------ whatever the contact */

void fst_slip_enter(fst_flow *flow, int mode, double *state)
{
    const int lets_go = is_disc(flow) && mode == FST_MODE_SLIP && fst_contact_mode(flow) == FST_MODE_STICK;
    if (mode == FST_MODE_CREEP || (lets_go && fst_creep_is_released(flow, state))) {
        fst_creep_enter(flow, state);
        return;
    }
    if (mode != FST_MODE_FLIGHT && !is_disc(flow)) {
        slip_enter(flow, mode, state);
        return;
    }
    if (mode != FST_MODE_FLIGHT)
        enter_disc(flow, mode, state);
    flow->step.context.modes.contact = mode;
}

void fst_slip_go_on(fst_flow *flow)
{
    slip_go_on(flow);
}

/* Whether a contact that sticks all along the last step was about to let go in it. */
static int touches(const fst_flow *flow)
{
    const fst_bead_step_double *s = &flow->step;
    const fst_world_double *c = FST_WORLD(s);
    const fst_contact_double at =
        fst_contact_of_double(c, FST_MODES(s), s->end, FST_PATH_PULL(s, FST_PATH_END));
    return flow->contact.dip < CLOSE * sqrt(flow->rtol) * c->law.coulomb.holding * at.load;
}

double fst_slip_ends(fst_flow *flow, int *next)
{
    const int sticks = fst_contact_mode(flow) == FST_MODE_STICK;
    double x = 2.0;
    if (fst_contact_mode(flow) == FST_MODE_CREEP)
        return fst_creep_ends(flow, next);
    flow->contact.dip = INFINITY;
    if (!is_disc(flow)) {
        x = slip_ends(flow, next);
    } else if (sticks && fst_flow_becomes_negative(flow, disc_left, &x)) {
        *next = FST_MODE_SLIP;
    }
    flow->contact.touches += sticks && x > 1.0 && touches(flow);
    return x;
}

int fst_slip_after(const fst_flow *flow)
{
    const fst_bead_step_double *s = &flow->step;
    if (fst_contact_mode(flow) == FST_MODE_CREEP)
        return fst_creep_after(flow);
    if (!is_disc(flow)) {
        const int next = slip_after(flow);
        return next < 0 && fst_creep_begins(flow) ? FST_MODE_CREEP : next;
    }
    const int rests = fst_contact_mode(flow) == FST_MODE_SLIP &&
                      fst_disc_rests(FST_WORLD(s), FST_MODES(s), s->end, FST_PATH_PULL(s, FST_PATH_END));
    return rests ? FST_MODE_STICK : fst_creep_begins(flow) ? FST_MODE_CREEP : -1;
}

int fst_slip_is_felt(const fst_flow *flow, const double *state)
{
    double slip[2];
    fst_slip_double(fst_flow_world(flow), state, slip);
    return fst_norm_2_double(slip) > captured(flow);
}

double fst_grip_left(const fst_world_double *c, const fst_modes_double *m, const double *y)
{
    fst_pull_double p;
    fst_magnetic_pull_double(c, m, y, &p);
    if (c->kinds.patch)
        return fst_disc_hold(c, m, y, &p);
    const fst_contact_double at = fst_contact_of_double(c, m, y, &p);
    return fst_grip_double(&at, c->yielding, c->law.coulomb.holding, 0.0);
}

double fst_grip_change(const fst_world_double *c, const fst_modes_double *m, double omega, const double *y,
                       const double *along)
{
    fst_linear_double l;
    double f[FST_STATE_SIZE];
    fst_linearise_double(c, m, omega, y, &l, f);
    const fst_contact_double by = fst_contact_change_double(c, &l, y, along);
    if (c->kinds.patch)
        return fst_disc_hold_change(c, &l.contact, &by);
    const double *a = l.contact.push;
    return c->yielding * c->law.coulomb.holding * by.load -
           (a[0] * by.push[0] + a[1] * by.push[1]) / fst_norm_2_double(a);
}
