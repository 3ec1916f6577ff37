/* lanes.inl - the engine of lanes: four or eight runs make their steps at the same time.
 *
 * A processor's wide registers hold 4 (AVX2) or 8 (AVX-512) doubles, and one instruction works on all of them.
 * So the model's and the integrator's bodies are compiled once more with a REAL that is such a register, and
 * each of its lanes belongs to another run, with its own parameters, time and step size:
 *
 *     lane          0         1         2         3
 *     run          17        18        23        20
 *     t            5.21      1.07      0.02      9.96
 *     step size    0.031     0.044     0.028     0.009
 *                  `------- one try_step() -------'
 *     error        0.4       0.7       1.9       0.2
 *                 accept    accept    reject    accept, at its end: observed, unloaded, replaced by run 21
 *
 * All lanes do the same, always; where they differ, both outcomes are computed and a mask selects.  A lane
 * whose try was rejected tries again with a smaller step while its neighbours make their next one: nobody
 * waits.  A lane without a run goes on with steps of size 0.  What the lanes of a batch must share are the
 * integers of the model (number of lines, material, dynamics), because a branch is taken by all lanes or by
 * none.
 *
 * What a lane computes depends on nothing in the other lanes: no instruction works across lanes.  So a run has
 * the same bits in any lane, beside any neighbours.  There are two forms of arithmetic.  The portable form
 * makes the operations of the scalar code in its order, and so has the bits of fst_run().  The fast form
 * (FST_FUSED) fuses multiplications with additions, takes reciprocal roots from estimates, and damps the step
 * control; its rows name it.
 *
 * A round of a batch is
 *
 *     try_steps()   a try in every lane, accepted or rejected
 *     watch()       may the step hold an end of the run, a mark, a doubtful angle, a direction that turns fast?
 *     observe()     integrals over the step; may it hold a new extreme?
 *     ---           the caller looks closely at the few lanes for which the answer is yes
 *     advance()     the end of the step is the start of the next
 *
 * watch() and observe() err towards yes: every test has a margin.  For a close look extract() takes the step
 * out of its lane as a scalar step, and the code of single runs looks at it.
 *
 * Dry contacts.  An engine of its own (FST_DRY_LANES) knows the laws of dry friction at a point.  Each lane has
 * its mode (model/contact/coulomb.inl), and masks select what belongs to it: the force, the pace in which its
 * step is measured, and what could end the mode.  A step that may hold such an end, or the end of the way, is
 * not accepted but reported (`contact`), and the code of single runs looks for the event:
 *
 *     lane          0         1         2         3
 *     mode         slip      stick     slip      onset
 *     |V|          0.03        0       2e-9      7e-5
 *                 accept    accept    contact   contact: the event lies at the fraction 0.37, so that the lane
 *                                                        makes the step anew, 0.37 times as long
 *
 * Once such a step has passed, the flow enters the next mode, and the lane goes on from there (reload()).
 *
 * The including file defines ENGINE (the table's symbol), FST_LANES, and which of FST_FUSED and FST_DRY_LANES
 * it is.
 */
#include "lanes/engines.h"

#ifdef FST_HAVE_LANES
#include <stddef.h>
#include <string.h>

#include "base/wide.h"

#include "base/twofold.inl"
#include "model/bodies.inl"
#include "ode/bead_step.inl"
#include "ode/path.inl"
#include "ode/step_control.inl"
#if KNOWS_DRY
#include "model/tangent.inl"
#include "ode/carried.inl"
#include "ode/paced.inl"
#else
#include "ode/tangent_step.inl"
#endif
#include "observe/integrals.inl"
#include "observe/peaks.inl"

typedef struct batch {
    FN(bead_step) step;
    REAL tolerance, absolute_tolerance[FST_STATE_SIZE];
    /* the clock, as in fst_flow */
    FN(step_control) control;
    FN(twofold) t_start, t;
    REAL t_limit;
    REAL norm_drift, accepted, rejected;
    REAL drift, speed; /* at the end of the last try: | |n| - 1 |, greatest component of |d(state)/dt| */
    REAL passes;       /* the time that the last try takes */
    /* what is watched */
    REAL plate_radius, next_mark, activity;
    REAL turns[2], turns_before[2], bead_angle_least[2], bead_angle_most[2];
    FN(integrals) sums;
    REAL records[FST_RECORD_COUNT];
    REAL peak_from[FST_RECORD_COUNT], peak_to[FST_RECORD_COUNT]; /* the nodes between which the extreme lies */
    /* No REAL below this line: save() and restore() take all that are above it. */
    unsigned in_use;
    unsigned observed; /* lanes whose last step was observed */
    unsigned anew;     /* lanes whose next try makes the last step anew */
    unsigned known;    /* lanes in which the integrands at the start of the present step are known */
} batch;

/* A wide value's lanes as doubles in memory. */
static double *lanes_of(void *wide)
{
    return wide;
}

static void view(void *memory, fst_lane_view *v)
{
    batch *b = memory;
    v->y = lanes_of(b->step.y);
    v->end = lanes_of(b->step.end);
    for (int i = 0; i < 2; ++i) {
        v->turns[i] = lanes_of(&b->turns[i]);
        v->turns_before[i] = lanes_of(&b->turns_before[i]);
    }
    v->activity = lanes_of(&b->activity);
    v->speed = lanes_of(&b->speed);
    v->next_mark = lanes_of(&b->next_mark);
    v->bead_angle_least = lanes_of(b->bead_angle_least);
    v->bead_angle_most = lanes_of(b->bead_angle_most);
    v->r_reference = lanes_of(&b->sums.r_reference);
    v->b_reference = lanes_of(&b->sums.b_reference);
    v->records = lanes_of(b->records);
}

/* ------------------------------------------------------------------ in and out */

#include "lanes/lane_world.inl"

static void load_pull(FN(pull) * to, int lane, const fst_flow *flow)
{
    const fst_pull_double *from = FST_PATH_PULL(&flow->step, FST_PATH_START);
    for (int i = 0; i < 3; ++i) {
        to->b[i][lane] = from->b[i];
        to->force[i][lane] = from->force[i];
    }
    to->strength[lane] = from->strength;
#ifdef FIELD_KEEPS_GRADIENT
    double b[3];
    fst_gradient_double g;
    const fst_world_double *c = fst_flow_world(flow);
    fst_field_double(c, flow->step.y[FST_X], flow->step.y[FST_Y], c->height, b, &g);
    to->gradient.xx[lane] = g.xx;
    to->gradient.yy[lane] = g.yy;
    to->gradient.xy[lane] = g.xy;
    to->gradient.xz[lane] = g.xz;
    to->gradient.yz[lane] = g.yz;
    to->gradient.yx[lane] = g.yx;
#endif
}

static void extract_pull(const FN(pull) * from, int lane, fst_pull_double *to)
{
    for (int i = 0; i < 3; ++i) {
        to->b[i] = from->b[i][lane];
        to->force[i] = from->force[i][lane];
    }
    to->strength = from->strength[lane];
}

static void load_clock(batch *b, int lane, const fst_flow *flow, double t_limit)
{
    b->t_start.high[lane] = b->t.high[lane] = flow->t.high;
    b->t_start.low[lane] = b->t.low[lane] = flow->t.low;
    b->t_limit[lane] = t_limit;
    b->control.proposal[lane] = flow->control.proposal;
    b->control.greatest[lane] = flow->control.greatest;
    b->control.root[lane] = flow->control.root;
    b->norm_drift[lane] = flow->norm_drift;
    b->accepted[lane] = (double)flow->accepted;
    b->rejected[lane] = (double)flow->rejected;
    b->tolerance[lane] = flow->rtol;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        b->absolute_tolerance[i][lane] = flow->atol[i];
}

static void plan(batch *b, fst_wide_mask mask);

static void load_motion(batch *b, int lane, const fst_flow *flow, double t_limit)
{
    const fst_bead_step_double *from = &flow->step;
    load_world(FST_WORLD(&b->step), lane, FST_WORLD(from));
#if KNOWS_DRY
    load_modes(FST_MODES(&b->step), lane, FST_MODES(from));
#endif
    load_pull(FST_PATH_PULL(&b->step, FST_PATH_START), lane, flow);
    b->step.omega[lane] = from->omega;
    b->step.ramp[lane] = 0.0;
    for (int i = 0; i < BEAD_NUMBERS; ++i) {
        b->step.y[i][lane] = FST_PATH_STATE(&b->step, FST_PATH_START)[i][lane] = from->y[i];
        FST_PATH_SLOPE(&b->step, FST_PATH_START)[i][lane] = FST_PATH_SLOPE(from, FST_PATH_START)[i];
    }
    load_clock(b, lane, flow, t_limit);
    b->known &= ~(1u << lane);
    plan(b, fst_wide_mask_of(1u << lane));
}

static void load(void *memory, int lane, const fst_flow *flow, double t_limit)
{
    batch *b = memory;
    b->plate_radius[lane] = flow->groups.plate_radius;
    b->next_mark[lane] = INFINITY;
    b->activity[lane] = 0.0;
    b->turns[0][lane] = b->turns_before[0][lane] = (double)flow->bead_angle.turns;
    b->turns[1][lane] = b->turns_before[1][lane] = 0.0;
    for (int i = 0; i < 2; ++i)
        b->bead_angle_least[i][lane] = b->bead_angle_most[i][lane] = 0.0;
    for (int i = 0; i < FST_Q_COUNT; ++i)
        b->sums.total[i].high[lane] = b->sums.total[i].low[lane] = b->sums.increment[i][lane] = 0.0;
    b->sums.r_reference[lane] = b->sums.b_reference[lane] = 0.0;
    for (int i = 0; i < FST_RECORD_COUNT; ++i)
        b->records[i][lane] = -1e300;
    b->in_use |= 1u << lane;
    load_motion(b, lane, flow, t_limit);
}

#if KNOWS_DRY
static void reload(void *memory, int lane, const fst_flow *flow, double t_limit)
{
    load_motion(memory, lane, flow, t_limit);
}

static void make_anew(void *memory, int lane, double size)
{
    batch *b = memory;
    b->control.size[lane] = size;
    b->anew |= 1u << lane;
}
#endif

/* An idle lane goes on with steps of size 0. */
static void release(void *memory, int lane)
{
    batch *b = memory;
    b->in_use &= ~(1u << lane);
    b->anew &= ~(1u << lane);
    b->control.size[lane] = 0.0;
}

/* A lane as numbers: its share of every REAL of the batch, and its bits of the words.  Where the
 * integers of the world lie there are no REALs; restore() leaves them as load() set them. */
enum {
    LANE_REALS = offsetof(batch, in_use) / sizeof(REAL),
    FIRST_INTEGERS = offsetof(batch, FST_WORLD_OF_STEP(step)) / sizeof(REAL),
    AFTER_INTEGERS = offsetof(batch, FST_WORLD_OF_STEP(step).eps) / sizeof(REAL)
};

static void save(const void *memory, int lane, double *numbers)
{
    const batch *b = memory;
    const REAL *reals = memory;
    for (int i = 0; i < LANE_REALS; ++i)
        numbers[i] = i < FIRST_INTEGERS || i >= AFTER_INTEGERS ? reals[i][lane] : 0.0;
    numbers[LANE_REALS] = b->known >> lane & 1u;
    numbers[LANE_REALS + 1] = b->anew >> lane & 1u;
}

static void restore(void *memory, int lane, const double *numbers)
{
    batch *b = memory;
    REAL *reals = memory;
    for (int i = 0; i < LANE_REALS; ++i)
        if (i < FIRST_INTEGERS || i >= AFTER_INTEGERS)
            reals[i][lane] = numbers[i];
    b->known = (b->known & ~(1u << lane)) | (numbers[LANE_REALS] != 0.0 ? 1u << lane : 0u);
    b->anew = (b->anew & ~(1u << lane)) | (numbers[LANE_REALS + 1] != 0.0 ? 1u << lane : 0u);
}

static void extract_clock(const void *memory, int lane, fst_flow *flow)
{
    const batch *b = memory;
    flow->t_start = (fst_twofold){b->t_start.high[lane], b->t_start.low[lane]};
    flow->t = (fst_twofold){b->t.high[lane], b->t.low[lane]};
    flow->step.h = b->step.h[lane];
    flow->control.proposal = b->control.proposal[lane];
    flow->control.size = b->control.size[lane];
    flow->control.worst_error = b->control.worst_error[lane];
#ifndef FST_FUSED /* there a run that changes its lane begins with 1 */
    flow->control.root = b->control.root[lane];
#endif
    flow->norm_drift = b->norm_drift[lane];
    const uint64_t accepted = (uint64_t)b->accepted[lane], rejected = (uint64_t)b->rejected[lane];
    /* The flow has counted what came before the lane, and what was extracted already. */
    flow->rhs_calls += DOP_TRY_EVALUATIONS * (accepted - flow->accepted + rejected - flow->rejected) +
                       (accepted - flow->accepted);
    flow->accepted = accepted;
    flow->rejected = rejected;
    flow->has_step = accepted > 0;
    flow->has_dense = 0;
}

static void extract(const void *memory, int lane, fst_bead_step_double *to)
{
    const FN(bead_step) *from = &((const batch *)memory)->step;
    for (int i = 0; i < BEAD_NUMBERS; ++i) {
        to->y[i] = from->y[i][lane];
        to->end[i] = from->end[i][lane];
    }
    for (int n = 0; n < FST_PATH_PLACES; ++n)
        for (int i = 0; i < BEAD_NUMBERS; ++i)
            FST_PATH_SLOPE(to, n)[i] = FST_PATH_SLOPE(from, n)[i][lane];
}

static void extract_path(const void *memory, int lane, fst_bead_step_double *to)
{
    const FN(bead_step) *from = &((const batch *)memory)->step;
    for (int n = 0; n < FST_PATH_PLACES; ++n) {
        for (int i = 0; i < BEAD_NUMBERS; ++i)
            FST_PATH_STATE(to, n)[i] = FST_PATH_STATE(from, n)[i][lane];
        extract_pull(FST_PATH_PULL(from, n), lane, FST_PATH_PULL(to, n));
    }
}

static void extract_integrals(const void *memory, int lane, fst_integrals_double *to)
{
    const REAL *from = (const REAL *)&((const batch *)memory)->sums;
    double *numbers = (double *)to;
    for (size_t i = 0; i < sizeof *to / sizeof *numbers; ++i)
        numbers[i] = from[i][lane];
}

static void set_increments(void *memory, int lane, const double *increments)
{
    batch *b = memory;
    for (int i = 0; i < FST_Q_COUNT; ++i)
        b->sums.increment[i][lane] = increments[i];
}

/* ------------------------------------------------------------------ steps */

/* Whether steps measure their own time, so that no size can be chosen to land: the end of the way is found in
 * the step that would pass it. */
static int own_time(const batch *b)
{
    (void)b; /* of lanes for other contacts none does */
    return HAS(FST_WORLD(&b->step)->kinds, modes);
}

static void plan(batch *b, fst_wide_mask mask)
{
    const FN(twofold) limit = {b->t_limit, R(0.0)};
    const REAL rest = own_time(b) ? R(INFINITY) : FN(twofold_difference)(limit, b->t);
    FN(plan_step)(&b->control, mask, rest);
}

static void pass_time(batch *b, fst_wide_mask mask)
{
    const FN(twofold) end =
        own_time(b) ? FN(twofold_add)(b->t, b->passes) : FN(step_end)(&b->control, b->t, b->t_limit);
    b->accepted = fst_wide_add_where(mask, b->accepted, R(1.0));
    b->t_start.high = fst_wide_select(mask, b->t.high, b->t_start.high);
    b->t_start.low = fst_wide_select(mask, b->t.low, b->t_start.low);
    b->t.high = fst_wide_select(mask, end.high, b->t.high);
    b->t.low = fst_wide_select(mask, end.low, b->t.low);
}

static void accept(batch *b, fst_wide_mask mask, REAL factor)
{
    FN(accept_step)(&b->control, mask, factor, FST_HOLD_AFTER_REJECTION);
}

/* The lanes that give up. */
static unsigned reject(batch *b, fst_wide_mask mask, REAL error, REAL factor)
{
    b->rejected = fst_wide_add_where(mask, b->rejected, R(1.0));
    const REAL given_up = FN(reject_step)(&b->control, mask, error, factor, b->t.high);
    return fst_wide_lanes_of(WIDE_LESS(R(0.0), given_up));
}

#if KNOWS_DRY
static void pass(void *memory, unsigned lanes)
{
    pass_time(memory, fst_wide_mask_of(lanes));
}

/* The lanes whose steps may hold the end of their mode or way.  An onset is short, and a creep is
 * followed step by step, so that each of their steps may. */
static unsigned may_end_mode(const batch *b)
{
    const FN(bead_step) *s = &b->step;
    const FN(world) *c = FST_WORLD(s);
    const FN(modes) *m = FST_MODES(s);
    const FN(twofold) limit = {b->t_limit, R(0.0)};
    const REAL rest = FN(twofold_difference)(limit, b->t);
    const unsigned sticking = fst_wide_lanes_of(FN(is_mode)(m->contact, FST_MODE_STICK)) & b->in_use;
    unsigned may = fst_wide_lanes_of(FN(is_mode)(m->contact, FST_MODE_ONSET)) |
                   fst_wide_lanes_of(WIDE_LESS_EQUAL(rest, b->passes * R(1.0 + 1e-12)));
    may |= fst_wide_lanes_of(FN(is_mode)(m->contact, FST_MODE_CREEP));
    may |= fst_wide_lanes_of(FN(is_moving)(m->contact)) &
           (fst_wide_lanes_of(FN(slip_is_over)(s, b->tolerance)) | fst_wide_lanes_of(FN(slip_may_creep)(s)));
    if (sticking) { /* as fst_flow_first_negative() has it */
        REAL least = R(INFINITY), greatest = R(-INFINITY);
        for (int n = 0; n < FST_PATH_PLACES; ++n) {
            const FN(contact) at = FN(contact_of)(c, m, FST_PATH_STATE(s, n), FST_PATH_PULL(s, n));
            const REAL left = FN(static_grip)(c, &at);
            least = -REAL_MAX(-left, -least);
            greatest = REAL_MAX(left, greatest);
        }
        may |= sticking & fst_wide_lanes_of(WIDE_LESS_EQUAL(least - R(0.5) * (greatest - least), R(0.0)));
    }
    return may;
}
#endif

static fst_lane_tries try_steps(void *memory)
{
    batch *b = memory;
    FN(bead_step) *s = &b->step;
    s->h = b->control.size;
    FN(bead_try_step)(s);
    REAL error = FN(bead_step_error)(s, b->tolerance, b->absolute_tolerance);
#if KNOWS_DRY
    error = FN(lasting_error)(s, b->tolerance, error);
    if (own_time(b))
        error = FN(paced_error)(s, error);
#endif
    const REAL factor = FN(step_factor)(error);
    b->drift = FN(finish_step)(s);
    const unsigned good = fst_wide_lanes_of(WIDE_LESS_EQUAL(error, R(1.0)));
    fst_lane_tries tries = {.accepted = good & b->in_use & ~b->anew, .anew = b->anew};
    const unsigned rejected = b->in_use & ~(tries.accepted | tries.anew);
    const fst_wide_mask accepted = fst_wide_mask_of(tries.accepted);
#ifdef FST_FUSED
    accept(b, accepted, FN(damped_factor)(&b->control, accepted, factor));
#else
    accept(b, accepted, factor);
#endif
    tries.accepted |= tries.anew;
    b->norm_drift = fst_wide_add_where(fst_wide_mask_of(tries.accepted), b->norm_drift, b->drift);
    b->anew = 0;
#if KNOWS_DRY
    if (own_time(b)) {
        b->passes = FN(paced_time)(s);
        tries.contact = tries.accepted & ~tries.anew & may_end_mode(b);
        tries.accepted &= ~tries.contact;
    }
#endif
    pass_time(b, fst_wide_mask_of(tries.accepted));
    if (rejected)
        tries.failed = reject(b, fst_wide_mask_of(rejected), error, factor);
    tries.landed = tries.accepted & fst_wide_lanes_of(WIDE_LESS_EQUAL(b->t_limit, b->t.high));
    return tries;
}

/* The integrands at the end of an observed step are those at the start of the next. */
static void keep_integrands(batch *b, unsigned accepted)
{
    const unsigned kept = accepted & b->observed;
    const fst_wide_mask mask = fst_wide_mask_of(kept);
    FN(integrals) *q = &b->sums;
    for (int i = 0; kept && i < SUMMED; ++i)
        q->integrands[0][i] = fst_wide_select(mask, q->integrands[FST_PATH_END][i], q->integrands[0][i]);
    for (int i = 0; kept && i < FST_TRACK_COUNT; ++i)
        q->tracked[0][i] = fst_wide_select(mask, q->tracked[FST_PATH_END][i], q->tracked[0][i]);
    b->known = (b->known & ~accepted) | kept;
    b->observed = 0;
}

static void advance(void *memory, unsigned accepted)
{
    batch *b = memory;
    const fst_wide_mask mask = fst_wide_mask_of(accepted);
    FN(next_step_where)(&b->step, mask);
    for (int i = 0; i < 2; ++i)
        b->turns_before[i] = fst_wide_select(mask, b->turns[i], b->turns_before[i]);
    keep_integrands(b, accepted);
    plan(b, mask);
}

/* An event function f may cross zero in a step where its least value at the places of its path minus half their
 * spread is not positive (fst_flow_first_negative); for the edge, f = edge - r, the spread is taken at its
 * greatest, r.
 */
static unsigned may_end(const batch *b)
{
    const FN(bead_step) *s = &b->step;
    const REAL edge = b->plate_radius;
    REAL least = R(INFINITY), greatest = R(-INFINITY), farthest2 = R(0.0);
    for (int n = 0; n < FST_PATH_PLACES; ++n) {
        const REAL load = FN(load)(FST_WORLD(s), FST_PATH_PULL(s, n)->force);
        const REAL *y = FST_PATH_STATE(s, n);
        least = -REAL_MAX(-load, -least);
        greatest = REAL_MAX(load, greatest);
        farthest2 = REAL_MAX(y[FST_X] * y[FST_X] + y[FST_Y] * y[FST_Y], farthest2);
    }
    const REAL margin = R(1e-9) * greatest;
    const fst_wide_mask lifts = WIDE_LESS_EQUAL(least - R(0.5) * (greatest - least), margin);
    const fst_wide_mask leaves = WIDE_LESS_EQUAL(edge * edge, R(2.26) * farthest2);
    return fst_wide_lanes_of(lifts) | fst_wide_lanes_of(leaves);
}

/* Go on with a winding from (x0, y0) to (x, y); the lanes where that is doubtful (base/winding.h). */
static unsigned wind(REAL *turns, REAL x0, REAL y0, REAL x, REAL y)
{
    const REAL cross = x0 * y - y0 * x, zero = R(0.0), one = R(1.0);
    const unsigned below0 = fst_wide_lanes_of(WIDE_LESS(y0, zero)),
                   below = fst_wide_lanes_of(WIDE_LESS(y, zero));
    const unsigned left = fst_wide_lanes_of(WIDE_LESS(zero, cross)),
                   right = fst_wide_lanes_of(WIDE_LESS(cross, zero));
    if ((below0 ^ below) & (left | right)) {
        *turns = fst_wide_add_where(fst_wide_mask_of(~below0 & below & left), *turns, one);
        *turns = fst_wide_add_where(fst_wide_mask_of(below0 & ~below & right), *turns, -one);
    }
    const REAL dx = x - x0, dy = y - y0, length2 = dx * dx + dy * dy;
    const REAL along0 = x0 * dx + y0 * dy, along1 = x * dx + y * dy;
    const unsigned an_end =
        fst_wide_lanes_of(WIDE_LESS(zero, along0)) | fst_wide_lanes_of(WIDE_LESS(along1, zero));
    return ~an_end & fst_wide_lanes_of(WIDE_LESS(R(16.0) * (cross * cross), length2 * length2));
}

static fst_lane_events watch(void *memory, unsigned accepted, unsigned observed, unsigned in_window)
{
    batch *b = memory;
    const REAL *y = b->step.y, *end = b->step.end, zero = R(0.0);
    const REAL speed = b->speed = FN(step_speed)(&b->step);
    const unsigned ending = may_end(b), landed = fst_wide_lanes_of(WIDE_LESS_EQUAL(b->t_limit, b->t.high));
    const unsigned at_mark = fst_wide_lanes_of(WIDE_LESS_EQUAL(b->next_mark, b->t.high + R(1e-9) * b->step.h));
    const unsigned crossing = fst_wide_lanes_of(WIDE_LESS_EQUAL(y[FST_X] * end[FST_X], zero)) & in_window;
    unsigned close = ending | landed | crossing | (own_time(b) ? at_mark : 0);
    b->turns[0] = b->turns_before[0];
    b->turns[1] = b->turns_before[1];
    close |= wind(&b->turns[0], y[FST_X], y[FST_Y], end[FST_X], end[FST_Y]);
    if (observed) {
        REAL u0, w0, u, w;
        FN(moment_angle_point)(y, &u0, &w0);
        FN(moment_angle_point)(end, &u, &w);
        close |= wind(&b->turns[1], u0, w0, u, w) & observed;
        const REAL from[2] = {u0, w0}, to[2] = {u, w};
        const REAL pole = FN(passes_closely)(from, to, b->tolerance);
        const REAL axis = FN(passes_closely)(&y[FST_X], &end[FST_X], b->tolerance);
        close |= fst_wide_lanes_of(WIDE_LESS(zero, REAL_MAX(pole, axis))) & in_window;
        b->turns[1] = fst_wide_select(fst_wide_mask_of(observed), b->turns[1], b->turns_before[1]);
    }
    const REAL *l = b->bead_angle_least, *m = b->bead_angle_most, margin = R(1e-12);
    const REAL after_least = l[0] * end[FST_Y] - l[1] * end[FST_X];
    const REAL before_most = end[FST_X] * m[1] - end[FST_Y] * m[0];
    const unsigned inside = fst_wide_lanes_of(WIDE_LESS(margin, -REAL_MAX(-after_least, -before_most)));
    const unsigned quiet = accepted & ~(close | at_mark);
    b->activity = fst_wide_select(fst_wide_mask_of(quiet), REAL_MAX(speed, b->activity), b->activity);
    const REAL outward = y[FST_X] * y[FST_VX] + y[FST_Y] * y[FST_VY],
               after = end[FST_X] * end[FST_VX] + end[FST_Y] * end[FST_VY];
    const unsigned at_maximum =
        fst_wide_lanes_of(WIDE_LESS(zero, outward)) & fst_wide_lanes_of(WIDE_LESS_EQUAL(after, zero));
    const fst_lane_events events = {accepted & ending, accepted & at_mark, accepted & close, accepted & ~inside,
                                    accepted & at_maximum};
    return events;
}

#if KNOWS_DRY
/* The derivatives by theta of a difference d at a state. */
RHS_KIND void difference_rhs(const FN(world) * c, const FN(modes) * m, REAL omega, const REAL *y, const REAL *d,
                             REAL *k)
{
    FN(linear) l;
    REAL f[FST_STATE_SIZE];
    FN(linearise)(c, m, omega, y, &l, f);
    FN(neighbour_slope)(c, m, omega, y, &l, f, FN(pace)(c, m, y), d, k);
}

/* As carry_along_step() of ode/neighbours.c does it, one difference a lane. */
static void carry(const void *memory, unsigned lanes, double *differences)
{
    enum { STAGES = 12 };
    const FN(bead_step) *s = &((const batch *)memory)->step;
    const FN(world) *c = FST_WORLD(s);
    const FN(modes) *m = FST_MODES(s);
    REAL d[BEAD_NUMBERS], at[BEAD_NUMBERS], k[STAGES][BEAD_NUMBERS], slip[2];
    memcpy(d, differences, sizeof d);
    for (int stage = 0; stage <= STAGES; ++stage) {
        FN(neighbour_at_stage)(s->h, stage, BEAD_NUMBERS, d, k[0], BEAD_NUMBERS, at);
        if (stage < STAGES)
            difference_rhs(c, m, s->omega, s->stage[stage], at, k[stage]);
    }
    const fst_wide_mask carried = fst_wide_mask_of(lanes), sticks = WIDE_LESS(R(0.5), FN(sticks)(c, m));
    FN(slip)(c, at, slip);
    for (int i = 0; i < 2; ++i)
        slip[i] = fst_wide_select(sticks, -slip[i], R(0.0));
    FN(change_neighbour_slip)(c, slip, at);
    FN(slip)(c, at, slip); /* what rounding left */
    for (int i = 0; i < 2; ++i)
        at[FST_VX + i] = fst_wide_select(sticks, at[FST_VX + i] - slip[i], at[FST_VX + i]);
    for (int i = 0; i < BEAD_NUMBERS; ++i)
        d[i] = fst_wide_select(carried, at[i], d[i]);
    memcpy(differences, d, sizeof d);
}
#endif

#include "lanes/lane_observables.inl"
#ifdef FST_FUSED
#include "lanes/lane_extremes.inl"
#endif

#if !KNOWS_DRY
#define TANGENT_WIDTH FST_LANES
#include "lanes/tangents.inl"
#endif

const fst_lane_engine ENGINE = {
    .width = FST_LANES,
    .bytes = sizeof(batch),
    .view = view,
    .load = load,
    .release = release,
    .numbers = LANE_REALS + 2,
    .save = save,
    .restore = restore,
    .try_steps = try_steps,
    .watch = watch,
    .observe = observe,
    .advance = advance,
    .extract = extract,
    .extract_path = extract_path,
    .extract_clock = extract_clock,
    .extract_integrals = extract_integrals,
    .set_increments = set_increments,
#if KNOWS_DRY
    .pass = pass,
    .make_anew = make_anew,
    .reload = reload,
    .carry = carry,
#else
    .tangents = TANGENT_ENGINE,
#endif
#ifdef FST_FUSED
    .name = FST_LANES == 8 ? "avx512" : "avx2",
    .fused = 1,
    .waiting_bytes = sizeof(waiting),
    .set_aside = set_aside,
    .locate = locate,
#else
    .name = "portable",
#endif
};
#endif
