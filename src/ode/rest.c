/* rest.c - the rotation of a bead on a plate that resists rolling: the automaton's second instance
 * (automaton.inl).
 *
 *     in general      moves   held    begins    v      a    c
 *     here            rolls   rests   starts    W_h    T    rho N
 *
 * Either part of a contact may change its mode while the other one goes on.  But f differs where the contact
 * changes from slip to stick, and with it T; and A is another one where a bead rests.  So after every change
 * contact.c asks anew for both.
 *
 * Sizes.  A resistance is weak: c = rho N/(beta k eps^2) is 1e-4 to 1e-2, and a torque that grows at the rate g
 * leaves it behind within the time c/g, in which the rotation reaches c^2/g.  The sizes below which a rotation
 * is nothing, and at which a start is over, are in proportion to that.
 */
#include "ode/rest.h"

#include "model/modes.h"
#include "ode/onset.h"

static const double HAND_OVER = 0.12;        /* times tolerance^(5/16) and c^2/g */
static const double LEAST_HAND_OVER = 100.0; /* but at least so many times nothing */
static const double GREATEST = 0.05;         /* hand-over, of a torque that hardly grows */
static const double LONG = 4.0;              /* how much longer a start may take than at a steady growth */

/* The rotation that is nothing. */
static double nothing(const fst_flow *flow)
{
    return fst_rotation_of_rest(fst_flow_world(flow), flow->rtol);
}

int fst_rest_is_still(const fst_flow *flow, const double *state)
{
    return fst_norm_2_double(state + FST_WX) <= nothing(flow);
}

static void begin(fst_flow *flow, const double *state)
{
    double strength, growth, turning;
    fst_begin_rolling(flow, state, &strength, &growth, &turning);
    growth = fabs(growth) + 1e-290;
    const double usual = growth * (strength / turning) * (strength / turning);
    fst_part_state *part = &flow->contact.roll;
    part->free_at =
        fmax(HAND_OVER * fst_hand_over(flow->rtol) * fmin(GREATEST, usual), LEAST_HAND_OVER * nothing(flow));
    part->free_by = LONG * sqrt(2.0 * part->free_at / growth);
}

static void set(const fst_world_double *c, double *state, const double w[2])
{
    double slip[2];
    fst_slip_double(c, state, slip);
    state[FST_WX] = w[0];
    state[FST_WY] = w[1];
    state[FST_VX] = slip[0] + c->eps * state[FST_WY];
    state[FST_VY] = slip[1] - c->eps * state[FST_WX];
}

/* Whether the rotation of a bead that the plate resists is nothing at the end of the last step. */
static int is_over(const fst_flow *flow)
{
    return fst_flow_world(flow)->kinds.resists && fst_contact_mode(flow) != FST_MODE_FLIGHT &&
           fst_rest_is_still(flow, flow->step.end);
}

#define PART_NAME(name) fst_rest_##name
#define PART_API
#define PART_MODE rolling
#define PART_LAG start
#define PART_STATE roll
#define PART_VELOCITY(c, y, v) ((void)(c), (v)[0] = (y)[FST_WX], (v)[1] = (y)[FST_WY])
#define PART_PUSH(at) ((at)->balance)
#define PART_LEFT(c, at) fst_resistance_left(c, at)
#define PART_STOPS(c, at) (fst_resistance_left(c, at) > 0)
#define PART_ASKED(m) ((m)->rolling = FST_ROLL_RESTS)
#define PART_NOTHING(flow) nothing(flow)
#define PART_OVER(flow) is_over(flow)
#define PART_RELEASED(c) ((void)(c), FST_ROLL_STARTS)
#define PART_STOP(c, y) fst_stop_rolling_double(c, y)
#define PART_SET(c, y, w) set(c, y, w)
#define PART_BEGIN(flow, state) begin(flow, state)
#include "ode/automaton.inl"

int fst_rest_holds(const fst_flow *flow, const double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_modes_double asked;
    const fst_contact_double at = fst_rest_contact_at(flow, state, &asked);
    return fst_resistance_left(c, &at) >= 0;
}
