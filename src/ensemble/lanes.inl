/* lanes.inl - the engine of a width and form: the model's and the integrator's bodies over lanes.
 *
 * The including file brings base/wide.h and defines ENGINE (the table's symbol), ENGINE_NAME and ENGINE_FUSED.
 */
#include "model/coefficients.inl"
#include "model/field.inl"
#include "model/rhs.inl"
#include "model/observe.inl"
#include "ode/bead_step.inl"

typedef struct batch {
    FN(bead_step) step;
    REAL tolerance, absolute_tolerance[FST_STATE_SIZE];
    REAL error, factor, drift, activity;
    REAL plate_radius;
    REAL total_high[FST_Q_COUNT], total_low[FST_Q_COUNT], increment[FST_Q_COUNT];
    REAL r_reference, b_reference;
    REAL integrands[FST_PATH_STAGES][FST_Q_COUNT], tracked[FST_PATH_STAGES][FST_TRACK_COUNT];
    REAL greatest[FST_TRACK_COUNT], least[FST_TRACK_COUNT];
} batch;

/* A wide value's lanes as doubles in memory. */
static double *lanes_of(void *wide)
{
    return wide;
}

static void view(void *memory, fst_lane_view *v)
{
    batch *b = memory;
    v->h = lanes_of(&b->step.h);
    v->y = lanes_of(b->step.y);
    v->end = lanes_of(b->step.end);
    v->error = lanes_of(&b->error);
    v->factor = lanes_of(&b->factor);
    v->drift = lanes_of(&b->drift);
    v->activity = lanes_of(&b->activity);
    v->total_high = lanes_of(b->total_high);
    v->total_low = lanes_of(b->total_low);
    v->increment = lanes_of(b->increment);
    v->r_reference = lanes_of(&b->r_reference);
    v->b_reference = lanes_of(&b->b_reference);
    v->integrands = lanes_of(b->integrands);
    v->tracked = lanes_of(b->tracked);
    v->greatest = lanes_of(b->greatest);
    v->least = lanes_of(b->least);
}

/* ------------------------------------------------------------------ in and out */

/* The members of the model's wide structs, in the order of their scalar twins. */
static void load_coefficients(FN(coefficients) * to, int lane, const fst_coefficients_double *from)
{
    to->lines = from->lines;
    to->magnetisable = from->magnetisable;
    to->gyroscopic_term_lost = from->gyroscopic_term_lost;
#define LOAD(member) to->member[lane] = from->member
    LOAD(eps);
    LOAD(height);
    LOAD(spacing);
    LOAD(first_line);
    LOAD(line_strength);
    LOAD(hard);
    LOAD(twice_a);
    LOAD(twice_b);
    LOAD(torque);
    LOAD(traction);
    LOAD(friction);
    LOAD(gravity);
    LOAD(omega);
#undef LOAD
}

static void load_pull(FN(pull) * to, int lane, const fst_pull_double *from)
{
    for (int i = 0; i < 3; ++i) {
        to->b[i][lane] = from->b[i];
        to->force[i][lane] = from->force[i];
    }
    to->strength[lane] = from->strength;
}

static void extract_pull(const FN(pull) * from, int lane, fst_pull_double *to)
{
    for (int i = 0; i < 3; ++i) {
        to->b[i] = from->b[i][lane];
        to->force[i] = from->force[i][lane];
    }
    to->strength = from->strength[lane];
}

static void load(void *memory, int lane, const fst_flow *flow)
{
    batch *b = memory;
    const fst_bead_step_double *from = &flow->step;
    load_coefficients(&b->step.context.coefficients, lane, &from->context.coefficients);
    load_pull(&b->step.context.pull[0], lane, &from->context.pull[0]);
    b->step.h[lane] = 0.0;
    b->step.omega[lane] = from->omega;
    b->step.ramp[lane] = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        b->step.y[i][lane] = b->step.stage[0][i][lane] = from->y[i];
        b->step.k[0][i][lane] = from->k[0][i];
        b->absolute_tolerance[i][lane] = flow->atol[i];
    }
    b->tolerance[lane] = flow->rtol;
    b->plate_radius[lane] = flow->groups.plate_radius;
    for (int i = 0; i < FST_Q_COUNT; ++i)
        b->total_high[i][lane] = b->total_low[i][lane] = b->increment[i][lane] = 0.0;
    b->r_reference[lane] = b->b_reference[lane] = 0.0;
    for (int i = 0; i < FST_TRACK_COUNT; ++i) {
        b->greatest[i][lane] = -INFINITY;
        b->least[i][lane] = INFINITY;
    }
}

static void extract(const void *memory, int lane, fst_bead_step_double *to)
{
    const FN(bead_step) *from = &((const batch *)memory)->step;
    to->h = from->h[lane];
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        to->y[i] = from->y[i][lane];
        to->end[i] = from->end[i][lane];
        to->slope[i] = from->slope[i][lane];
    }
    for (int j = 0; j < 13; ++j) {
        for (int i = 0; i < FST_STATE_SIZE; ++i) {
            to->stage[j][i] = from->stage[j][i][lane];
            to->k[j][i] = from->k[j][i][lane];
        }
        extract_pull(&from->context.pull[j], lane, &to->context.pull[j]);
    }
}

/* ------------------------------------------------------------------ steps */

static unsigned try_steps(void *memory)
{
    batch *b = memory;
    FN(bead_step) *s = &b->step;
    FN(bead_try_step)(s);
    b->error = FN(bead_step_error)(s, b->tolerance, b->absolute_tolerance);
    b->factor = FN(step_factor)(b->error);
    b->drift = FN(finish_step)(s);
    REAL activity = REAL_ABS(s->k[12][0]);
    for (int i = 1; i < FST_STATE_SIZE; ++i)
        activity = REAL_MAX(REAL_ABS(s->k[12][i]), activity);
    b->activity = activity;
    return fst_wide_lanes_of(WIDE_LESS_EQUAL(b->error, R(1.0)));
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
}

/* An event function f may cross zero in a step where its least value at the stages minus half their spread is
 * not positive (fst_flow_first_negative); for the edge, f = edge - r, the spread is taken at its greatest, r.
 */
static unsigned may_end(const void *memory)
{
    const FN(bead_step) *s = &((const batch *)memory)->step;
    const REAL edge = ((const batch *)memory)->plate_radius;
    REAL least = R(INFINITY), greatest = R(-INFINITY), farthest2 = R(0.0);
    for (int n = 0; n < FST_PATH_STAGES; ++n) {
        const int j = FST_PATH_STAGE[n];
        const REAL load = s->context.coefficients.gravity - s->context.pull[j].force[2];
        least = -REAL_MAX(-load, -least);
        greatest = REAL_MAX(load, greatest);
        farthest2 = REAL_MAX(s->stage[j][0] * s->stage[j][0] + s->stage[j][1] * s->stage[j][1], farthest2);
    }
    const REAL margin = R(1e-9) * greatest;
    const fst_wide_mask lifts = WIDE_LESS_EQUAL(least - R(0.5) * (greatest - least), margin);
    const fst_wide_mask leaves = WIDE_LESS_EQUAL(edge * edge, R(2.26) * farthest2);
    return fst_wide_lanes_of(lifts) | fst_wide_lanes_of(leaves);
}

/* ------------------------------------------------------------------ observables */

/* fst_twofold_add() of the last increments, in the lanes of `mask`. */
static void add_increments(batch *b, fst_wide_mask mask)
{
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        const REAL old = b->total_high[i], x = b->increment[i];
        const REAL sum = old + x, part = sum - old;
        const REAL error = (old - (sum - part)) + (x - part);
        const REAL low = b->total_low[i] + error, high = sum + low;
        b->total_low[i] = fst_wide_select(mask, low - (high - sum), b->total_low[i]);
        b->total_high[i] = fst_wide_select(mask, high, old);
    }
}

static void see_stages(batch *b, fst_wide_mask before_window)
{
    const FN(bead_step) *s = &b->step;
    const FN(coefficients) *c = &s->context.coefficients;
    for (int n = 0; n < FST_PATH_STAGES; ++n) {
        const int j = FST_PATH_STAGE[n];
        FN(seen) seen;
        FN(see)(c, s->omega, s->stage[j], &s->context.pull[j], &seen);
        if (n == 0) {
            b->r_reference = fst_wide_select(before_window, seen.r, b->r_reference);
            b->b_reference = fst_wide_select(before_window, seen.b_norm, b->b_reference);
        }
        FN(integrands)(c, s->stage[j], &seen, b->r_reference, b->b_reference, b->integrands[n]);
        b->tracked[n][FST_TRACK_R] = seen.r;
        b->tracked[n][FST_TRACK_B] = seen.b_norm;
        b->tracked[n][FST_TRACK_GAP] = seen.gap2;
        b->tracked[n][FST_TRACK_SLIP] = seen.slip2;
        b->tracked[n][FST_TRACK_LOAD] = seen.load;
    }
}

/* h times the weighted sum of the integrands, in the order of the stages. */
static void integrate(batch *b, fst_wide_mask mask)
{
    const REAL weight[8] = {DOP_B1, DOP_B6, DOP_B7, DOP_B8, DOP_B9, DOP_B10, DOP_B11, DOP_B12};
    static const int place[8] = {0, 3, 1, 2, 5, 4, 6, 7}; /* of the stages 1, 6, 7, ... 12 in FST_PATH_STAGE */
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        REAL sum = R(0.0);
        for (int j = 0; j < 8; ++j)
            sum = sum + weight[j] * b->integrands[place[j]][i];
        b->increment[i] = fst_wide_select(mask, b->step.h * sum, b->increment[i]);
    }
}

/* Where sign times a tracked quantity may exceed its record (best_in_step() of the quadrature, which decides).
 */
static fst_wide_mask may_beat(const batch *b, int which, REAL sign, REAL record)
{
    REAL best = sign * b->tracked[0][which], before = best, after = sign * b->tracked[1][which];
    for (int n = 1; n < FST_PATH_STAGES; ++n) {
        const REAL value = sign * b->tracked[n][which];
        const fst_wide_mask higher = WIDE_LESS(best, value);
        const int next = n + 1 < FST_PATH_STAGES ? n + 1 : n;
        before = fst_wide_select(higher, sign * b->tracked[n - 1][which], before);
        after = fst_wide_select(higher, sign * b->tracked[next][which], after);
        best = fst_wide_select(higher, value, best);
    }
    const REAL fall = REAL_MAX(best - before, best - after);
    return WIDE_LESS(record, best + R(0.3) * fall);
}

static unsigned observe(void *memory, unsigned accepted, unsigned in_window)
{
    batch *b = memory;
    const fst_wide_mask mask = fst_wide_mask_of(accepted);
    add_increments(b, mask);
    see_stages(b, fst_wide_mask_of(accepted & ~in_window));
    integrate(b, mask);
    unsigned beaten = 0;
    for (int i = 0; i < FST_TRACK_COUNT; ++i) {
        beaten |= fst_wide_lanes_of(may_beat(b, i, R(1.0), b->greatest[i]));
        if (i != FST_TRACK_GAP && i != FST_TRACK_SLIP)
            beaten |= fst_wide_lanes_of(may_beat(b, i, R(-1.0), -b->least[i]));
    }
    return beaten & accepted;
}

const fst_lane_engine ENGINE = {
    .name = ENGINE_NAME,
    .width = FST_LANES,
    .fused = ENGINE_FUSED,
    .bytes = sizeof(batch),
    .view = view,
    .load = load,
    .try_steps = try_steps,
    .may_end = may_end,
    .observe = observe,
    .advance = advance,
    .extract = extract,
};
