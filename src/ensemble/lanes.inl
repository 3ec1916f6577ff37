/* lanes.inl - the engine of a width and form: the model's and the integrator's bodies over lanes.
 *
 * The including file brings base/wide.h and defines ENGINE (the table's symbol), ENGINE_NAME and ENGINE_FUSED.
 */
#include <stddef.h>
#include <string.h>

#include "model/bodies.inl"
#include "ode/bead_step.inl"
#include "ode/summit.inl"
#include "ode/tangent_step.inl"

typedef struct batch {
    FN(bead_step) step;
    REAL tolerance, absolute_tolerance[FST_STATE_SIZE];
    /* the clock, as in fst_flow; `lands` is 1 or 0 */
    REAL t_high, t_low, t_start_high, t_start_low, t_limit;
    REAL h_next, greatest_step, lands, rejections, worst_error;
    REAL root; /* the last accepted step's error to the power -1/32 */
    REAL norm_drift, accepted, rejected;
    REAL drift, speed; /* of the last try: | |n| - 1 |, greatest component of |d(state)/dt| at its end */
    /* what is watched */
    REAL plate_radius, next_mark, activity;
    REAL turns[2], turns_before[2], phi_least[2], phi_most[2];
    REAL total_high[FST_Q_COUNT], total_low[FST_Q_COUNT], increment[FST_Q_COUNT];
    REAL r_reference, b_reference;
    REAL integrands[FST_PATH_STAGES][FST_Q_COUNT], tracked[FST_PATH_STAGES][FST_TRACK_COUNT];
    REAL records[FST_RECORD_COUNT];
    /* between which nodes the step's extreme lies */
    REAL summit_from[FST_RECORD_COUNT], summit_to[FST_RECORD_COUNT];
    /* No REAL below this line: save() and restore() take all that are above it. */
    unsigned in_use;
    unsigned observed; /* the lanes whose last step was */
    unsigned known;    /* those whose integrands at the start of the present step are there */
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
    v->phi_least = lanes_of(b->phi_least);
    v->phi_most = lanes_of(b->phi_most);
    v->total_high = lanes_of(b->total_high);
    v->total_low = lanes_of(b->total_low);
    v->increment = lanes_of(b->increment);
    v->r_reference = lanes_of(&b->r_reference);
    v->b_reference = lanes_of(&b->b_reference);
    v->integrands = lanes_of(b->integrands);
    v->tracked = lanes_of(b->tracked);
    v->records = lanes_of(b->records);
}

/* ------------------------------------------------------------------ in and out */

/* The coefficients' REALs begin at `eps` in both, and follow each other in one order. */
enum {
    COEFFICIENTS = (sizeof(fst_coefficients_double) - offsetof(fst_coefficients_double, eps)) / sizeof(double)
};
_Static_assert(sizeof(FN(coefficients)) - offsetof(FN(coefficients), eps) == COEFFICIENTS * sizeof(REAL),
               "the model's wide and scalar coefficients have the same members");

static void load_coefficients(FN(coefficients) * to, int lane, const fst_coefficients_double *from)
{
    const double *numbers = (const double *)((const char *)from + offsetof(fst_coefficients_double, eps));
    double *wide = (double *)((char *)to + offsetof(FN(coefficients), eps));
    to->kinds = from->kinds;
    for (int i = 0; i < COEFFICIENTS; ++i)
        wide[i * FST_LANES + lane] = numbers[i];
}

static void load_pull(FN(pull) * to, int lane, const fst_flow *flow)
{
    const fst_pull_double *from = &flow->step.context.pull[0];
    for (int i = 0; i < 3; ++i) {
        to->b[i][lane] = from->b[i];
        to->force[i][lane] = from->force[i];
    }
    to->strength[lane] = from->strength;
#ifdef FIELD_KEEPS_GRADIENT
    double b[3];
    fst_gradient_double g;
    fst_field_double(&flow->step.context.coefficients, flow->step.y[FST_X], flow->step.y[FST_Y], b, &g);
    to->gradient.xx[lane] = g.xx;
    to->gradient.yy[lane] = g.yy;
    to->gradient.xy[lane] = g.xy;
    to->gradient.xz[lane] = g.xz;
    to->gradient.yz[lane] = g.yz;
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
    b->t_high[lane] = b->t_start_high[lane] = flow->t.high;
    b->t_low[lane] = b->t_start_low[lane] = flow->t.low;
    b->t_limit[lane] = t_limit;
    b->h_next[lane] = flow->h_next;
    b->greatest_step[lane] = flow->greatest_step > 0 ? flow->greatest_step : INFINITY;
    b->root[lane] = 1.0;
    b->norm_drift[lane] = flow->norm_drift;
    b->accepted[lane] = (double)flow->accepted;
    b->rejected[lane] = (double)flow->rejected;
    b->tolerance[lane] = flow->rtol;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        b->absolute_tolerance[i][lane] = flow->atol[i];
}

static void plan(batch *b, fst_wide_mask mask);

static void load(void *memory, int lane, const fst_flow *flow, double t_limit)
{
    batch *b = memory;
    const fst_bead_step_double *from = &flow->step;
    load_coefficients(&b->step.context.coefficients, lane, &from->context.coefficients);
    load_pull(&b->step.context.pull[0], lane, flow);
    b->step.omega[lane] = from->omega;
    b->step.ramp[lane] = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        b->step.y[i][lane] = b->step.stage[0][i][lane] = from->y[i];
        b->step.k[0][i][lane] = from->k[0][i];
    }
    load_clock(b, lane, flow, t_limit);
    b->plate_radius[lane] = flow->groups.plate_radius;
    b->next_mark[lane] = INFINITY;
    b->activity[lane] = 0.0;
    b->turns[0][lane] = b->turns_before[0][lane] = (double)flow->phi.turns;
    b->turns[1][lane] = b->turns_before[1][lane] = 0.0;
    for (int i = 0; i < 2; ++i)
        b->phi_least[i][lane] = b->phi_most[i][lane] = 0.0;
    for (int i = 0; i < FST_Q_COUNT; ++i)
        b->total_high[i][lane] = b->total_low[i][lane] = b->increment[i][lane] = 0.0;
    b->r_reference[lane] = b->b_reference[lane] = 0.0;
    for (int i = 0; i < FST_RECORD_COUNT; ++i)
        b->records[i][lane] = -1e300;
    b->in_use |= 1u << lane;
    b->known &= ~(1u << lane);
    plan(b, fst_wide_mask_of(1u << lane));
}

/* An idle lane goes on with steps of size 0. */
static void release(void *memory, int lane)
{
    batch *b = memory;
    b->in_use &= ~(1u << lane);
    b->step.h[lane] = 0.0;
}

/* A lane as numbers: its share of every REAL of the batch, and whether its integrands are known.  Where the
 * integers of the coefficients lie there are no REALs; restore() leaves them as load() set them. */
enum {
    LANE_REALS = offsetof(batch, in_use) / sizeof(REAL),
    FIRST_INTEGERS = offsetof(batch, step.context.coefficients) / sizeof(REAL),
    AFTER_INTEGERS = offsetof(batch, step.context.coefficients.eps) / sizeof(REAL)
};

static void save(const void *memory, int lane, double *numbers)
{
    const batch *b = memory;
    const REAL *reals = memory;
    for (int i = 0; i < LANE_REALS; ++i)
        numbers[i] = i < FIRST_INTEGERS || i >= AFTER_INTEGERS ? reals[i][lane] : 0.0;
    numbers[LANE_REALS] = b->known >> lane & 1u ? 1.0 : 0.0;
}

static void restore(void *memory, int lane, const double *numbers)
{
    batch *b = memory;
    REAL *reals = memory;
    for (int i = 0; i < LANE_REALS; ++i)
        if (i < FIRST_INTEGERS || i >= AFTER_INTEGERS)
            reals[i][lane] = numbers[i];
    b->known = (b->known & ~(1u << lane)) | (numbers[LANE_REALS] != 0.0 ? 1u << lane : 0u);
}

static void extract_clock(const void *memory, int lane, fst_flow *flow)
{
    const batch *b = memory;
    flow->t_start = (fst_twofold){b->t_start_high[lane], b->t_start_low[lane]};
    flow->t = (fst_twofold){b->t_high[lane], b->t_low[lane]};
    flow->h_next = b->h_next[lane];
    flow->attempt = flow->step.h = b->step.h[lane];
    flow->worst_error = b->worst_error[lane];
    flow->norm_drift = b->norm_drift[lane];
    const uint64_t accepted = (uint64_t)b->accepted[lane], rejected = (uint64_t)b->rejected[lane];
    /* The flow's own count is of what came before, and of what was extracted already. */
    flow->rhs_calls += 12 * (accepted - flow->accepted) + 11 * (rejected - flow->rejected);
    flow->accepted = accepted;
    flow->rejected = rejected;
    flow->has_step = accepted > 0;
    flow->has_dense = 0;
}

static void extract(const void *memory, int lane, fst_bead_step_double *to)
{
    const FN(bead_step) *from = &((const batch *)memory)->step;
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        to->y[i] = from->y[i][lane];
        to->end[i] = from->end[i][lane];
    }
    static const int needed[] = {0, 5, 6, 7, 8, 9, 10, 11, 12}; /* by the dense output */
    for (size_t j = 0; j < sizeof needed / sizeof *needed; ++j)
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            to->k[needed[j]][i] = from->k[needed[j]][i][lane];
}

static void extract_stages(const void *memory, int lane, fst_bead_step_double *to)
{
    const FN(bead_step) *from = &((const batch *)memory)->step;
    for (int n = 0; n < FST_PATH_STAGES; ++n) {
        const int j = FST_PATH_STAGE[n];
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            to->stage[j][i] = from->stage[j][i][lane];
        extract_pull(&from->context.pull[j], lane, &to->context.pull[j]);
    }
}

/* ------------------------------------------------------------------ steps */

/* fst_flow_plan() */
static void plan(batch *b, fst_wide_mask mask)
{
    const REAL zero = R(0.0), rest = (b->t_limit - b->t_high) + (zero - b->t_low), distance = REAL_ABS(rest);
    const REAL h = -REAL_MAX(-b->h_next, -b->greatest_step);
    const fst_wide_mask lands = WIDE_LESS_EQUAL(distance, h * R(1.01));
    const REAL signed_h = fst_wide_select(WIDE_LESS(rest, zero), -h, h);
    b->step.h = fst_wide_select(mask, fst_wide_select(lands, rest, signed_h), b->step.h);
    b->lands = fst_wide_select(mask, fst_wide_select(lands, R(1.0), zero), b->lands);
    b->rejections = fst_wide_select(mask, zero, b->rejections);
    b->worst_error = fst_wide_select(mask, zero, b->worst_error);
}

/* fst_twofold_add() */
static void add_twofold(REAL *high, REAL *low, REAL x)
{
    const REAL old = *high, sum = old + x, part = sum - old;
    const REAL error = (old - (sum - part)) + (x - part);
    const REAL all_low = *low + error;
    *high = sum + all_low;
    *low = all_low - (*high - sum);
}

#ifdef FST_FUSED
/* The step size after an accepted step, from step_factor() = 0.9 e^(-1/8) of its error e and from the error e_0
 * of the accepted step before: 0.9 e^(-3/32) e_0^(1/32), a proportional-integral controller (K. Gustafsson,
 * ACM Trans. Math. Softw. 17 (1991) 533).  Along an orbit errors rise and fall over some steps; that the
 * controller sees this leaves 0.3 % of rejections of 5 % at a tolerance of 1e-10, and the same error of a final
 * state takes an eighth less work. */
static REAL control(batch *b, fst_wide_mask mask, REAL factor)
{
    const REAL eighth = factor * R(1.0 / 0.9), sixteenth = eighth * fst_wide_rough_reciprocal_sqrt(eighth);
    const REAL root = sixteenth * fst_wide_rough_reciprocal_sqrt(sixteenth), before = b->root;
    b->root = fst_wide_select(mask, root, before);
    return factor * fst_wide_rough_reciprocal(root * before);
}
#endif

/* fst_flow_accept() */
static void accept(batch *b, fst_wide_mask mask, REAL factor)
{
    const REAL attempt = b->step.h, size = REAL_ABS(attempt), one = R(1.0), zero = R(0.0);
    b->norm_drift = fst_wide_add_where(mask, b->norm_drift, b->drift);
    b->accepted = fst_wide_add_where(mask, b->accepted, one);
    b->t_start_high = fst_wide_select(mask, b->t_high, b->t_start_high);
    b->t_start_low = fst_wide_select(mask, b->t_low, b->t_start_low);
    REAL high = b->t_high, low = b->t_low;
    add_twofold(&high, &low, attempt);
    const fst_wide_mask lands = WIDE_LESS(zero, b->lands);
    b->t_high = fst_wide_select(mask, fst_wide_select(lands, b->t_limit, high), b->t_high);
    b->t_low = fst_wide_select(mask, fst_wide_select(lands, zero, low), b->t_low);
    const REAL proposal = size * factor;
    const REAL kept =
        REAL_MAX(b->h_next, proposal); /* a step cut short says nothing against the planned size */
    REAL next = fst_wide_select(lands, kept, proposal);
    const REAL bounded = -REAL_MAX(-next, -size);
    next = fst_wide_select(WIDE_LESS(zero, b->rejections), bounded, next);
    b->h_next = fst_wide_select(mask, next, b->h_next);
}

/* fst_flow_reject(); the lanes that give up. */
static unsigned reject(batch *b, fst_wide_mask mask, REAL error, REAL factor)
{
    const REAL one = R(1.0), zero = R(0.0), infinity = R(INFINITY);
    const fst_wide_mask finite = WIDE_LESS(REAL_ABS(error), infinity);
    b->rejected = fst_wide_add_where(mask, b->rejected, one);
    b->rejections = fst_wide_add_where(mask, b->rejections, one);
    b->worst_error = fst_wide_select(mask, fst_wide_select(finite, error, infinity), b->worst_error);
    const REAL attempt = b->step.h * fst_wide_select(finite, factor, R(0.1));
    b->step.h = fst_wide_select(mask, attempt, b->step.h);
    b->lands = fst_wide_select(mask, zero, b->lands);
    const REAL least = R(1e-14) * (one + REAL_ABS(b->t_high));
    const unsigned large = fst_wide_lanes_of(WIDE_LESS_EQUAL(least, REAL_ABS(attempt)));
    const unsigned few = fst_wide_lanes_of(WIDE_LESS_EQUAL(b->rejections, R(401.0)));
    return fst_wide_lanes_of(mask) & ~(large & few);
}

static fst_lane_tries try_steps(void *memory)
{
    batch *b = memory;
    FN(bead_step) *s = &b->step;
    FN(bead_try_step)(s);
    const REAL error = FN(bead_step_error)(s, b->tolerance, b->absolute_tolerance);
    const REAL factor = FN(step_factor)(error);
    b->drift = FN(finish_step)(s);
    fst_lane_tries tries;
    tries.accepted = fst_wide_lanes_of(WIDE_LESS_EQUAL(error, R(1.0))) & b->in_use;
    const unsigned rejected = b->in_use & ~tries.accepted;
    tries.failed = 0;
#ifdef FST_FUSED
    accept(b, fst_wide_mask_of(tries.accepted), control(b, fst_wide_mask_of(tries.accepted), factor));
#else
    accept(b, fst_wide_mask_of(tries.accepted), factor);
#endif
    if (rejected)
        tries.failed = reject(b, fst_wide_mask_of(rejected), error, factor);
    tries.landed = tries.accepted & fst_wide_lanes_of(WIDE_LESS_EQUAL(b->t_limit, b->t_high));
    return tries;
}

/* The integrands at the end of an observed step are those at the start of the next. */
static void keep_integrands(batch *b, unsigned accepted)
{
    const unsigned kept = accepted & b->observed;
    const fst_wide_mask mask = fst_wide_mask_of(kept);
    enum { LAST = FST_PATH_STAGES - 1 };
    for (int i = 0; kept && i < FST_Q_COUNT; ++i)
        b->integrands[0][i] = fst_wide_select(mask, b->integrands[LAST][i], b->integrands[0][i]);
    for (int i = 0; kept && i < FST_TRACK_COUNT; ++i)
        b->tracked[0][i] = fst_wide_select(mask, b->tracked[LAST][i], b->tracked[0][i]);
    b->known = (b->known & ~accepted) | kept;
    b->observed = 0;
}

static void advance(void *memory, unsigned accepted)
{
    batch *b = memory;
    FN(bead_step) *s = &b->step;
    const fst_wide_mask mask = fst_wide_mask_of(accepted);
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        s->y[i] = s->stage[0][i] = fst_wide_select(mask, s->end[i], s->y[i]);
        s->k[0][i] = fst_wide_select(mask, s->k[12][i], s->k[0][i]);
    }
    FN(pull) *to = &s->context.pull[0];
    const FN(pull) *from = &s->context.pull[12];
    for (int i = 0; i < 3; ++i) {
        to->b[i] = fst_wide_select(mask, from->b[i], to->b[i]);
        to->force[i] = fst_wide_select(mask, from->force[i], to->force[i]);
    }
    to->strength = fst_wide_select(mask, from->strength, to->strength);
#ifdef FIELD_KEEPS_GRADIENT
    FN(gradient) *g = &to->gradient;
    g->xx = fst_wide_select(mask, from->gradient.xx, g->xx);
    g->yy = fst_wide_select(mask, from->gradient.yy, g->yy);
    g->xy = fst_wide_select(mask, from->gradient.xy, g->xy);
    g->xz = fst_wide_select(mask, from->gradient.xz, g->xz);
    g->yz = fst_wide_select(mask, from->gradient.yz, g->yz);
#endif
    for (int i = 0; i < 2; ++i)
        b->turns_before[i] = fst_wide_select(mask, b->turns[i], b->turns_before[i]);
    keep_integrands(b, accepted);
    plan(b, mask);
}

/* An event function f may cross zero in a step where its least value at the stages minus half their spread is
 * not positive (fst_flow_first_negative); for the edge, f = edge - r, the spread is taken at its greatest, r.
 */
static unsigned may_end(const batch *b)
{
    const FN(bead_step) *s = &b->step;
    const REAL edge = b->plate_radius;
    REAL least = R(INFINITY), greatest = R(-INFINITY), farthest2 = R(0.0);
    for (int n = 0; n < FST_PATH_STAGES; ++n) {
        const int j = FST_PATH_STAGE[n];
        const REAL load = FN(load)(&s->context.coefficients, s->context.pull[j].force);
        least = -REAL_MAX(-load, -least);
        greatest = REAL_MAX(load, greatest);
        farthest2 = REAL_MAX(s->stage[j][0] * s->stage[j][0] + s->stage[j][1] * s->stage[j][1], farthest2);
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

/* The plane in which phi turns, as in the quadrature. */
static void small_phi_point(const REAL *y, REAL *u, REAL *w)
{
    *u = -y[FST_NZ] * REAL_SQRT(y[FST_X] * y[FST_X] + y[FST_Y] * y[FST_Y]);
    *w = y[FST_X] * y[FST_NY] - y[FST_Y] * y[FST_NX];
}

static fst_lane_events watch(void *memory, unsigned accepted, unsigned observed, unsigned in_window)
{
    batch *b = memory;
    const REAL *y = b->step.y, *end = b->step.end, zero = R(0.0);
    REAL speed = REAL_ABS(b->step.k[12][0]);
    for (int i = 1; i < FST_STATE_SIZE; ++i)
        speed = REAL_MAX(REAL_ABS(b->step.k[12][i]), speed);
    b->speed = speed;
    const unsigned ending = may_end(b), landed = fst_wide_lanes_of(WIDE_LESS_EQUAL(b->t_limit, b->t_high));
    const unsigned at_mark = fst_wide_lanes_of(WIDE_LESS_EQUAL(b->next_mark, b->t_high + R(1e-9) * b->step.h));
    const unsigned crossing = fst_wide_lanes_of(WIDE_LESS_EQUAL(y[FST_X] * end[FST_X], zero)) & in_window;
    unsigned close = ending | landed | crossing;
    b->turns[0] = b->turns_before[0];
    b->turns[1] = b->turns_before[1];
    close |= wind(&b->turns[0], y[FST_X], y[FST_Y], end[FST_X], end[FST_Y]);
    if (observed) {
        REAL u0, w0, u, w;
        small_phi_point(y, &u0, &w0);
        small_phi_point(end, &u, &w);
        close |= wind(&b->turns[1], u0, w0, u, w) & observed;
        b->turns[1] = fst_wide_select(fst_wide_mask_of(observed), b->turns[1], b->turns_before[1]);
    }
    const REAL *l = b->phi_least, *m = b->phi_most, margin = R(1e-12);
    const REAL after_least = l[0] * end[FST_Y] - l[1] * end[FST_X];
    const REAL before_most = end[FST_X] * m[1] - end[FST_Y] * m[0];
    const unsigned inside = fst_wide_lanes_of(WIDE_LESS(margin, -REAL_MAX(-after_least, -before_most)));
    const unsigned quiet = accepted & ~(close | at_mark);
    b->activity = fst_wide_select(fst_wide_mask_of(quiet), REAL_MAX(speed, b->activity), b->activity);
    const fst_lane_events events = {accepted & ending, accepted & at_mark, accepted & close,
                                    accepted & ~inside};
    return events;
}

#include "ensemble/lane_observables.inl"
#ifdef FST_FUSED
#include "ensemble/lane_extremes.inl"
#endif

#define TANGENT_WIDTH FST_LANES
#include "ensemble/tangents.inl"

const fst_lane_engine ENGINE = {
    .name = ENGINE_NAME,
    .width = FST_LANES,
    .fused = ENGINE_FUSED,
    .bytes = sizeof(batch),
    .view = view,
    .load = load,
    .release = release,
    .numbers = LANE_REALS + 1,
    .save = save,
    .restore = restore,
    .try_steps = try_steps,
    .watch = watch,
    .observe = observe,
    .advance = advance,
    .extract = extract,
    .extract_stages = extract_stages,
    .extract_clock = extract_clock,
    .tangents = TANGENT_ENGINE,
#ifdef FST_FUSED
    .slots_bytes = sizeof(slots),
    .set_aside = set_aside,
    .locate = locate,
#endif
};
