/* flow.inl - a trajectory, step by step, over REAL and of any dimension.
 *
 * A flow owns one step of the method (dop853.inl) and moves it along:
 *
 *                 h                       t_start    last step      t
 *     ...--|-----------|-----------|---------|-----------------------|- - - - - - -> t_limit
 *                                          step.y    o  (dense     step.end
 *                                                    x   output)
 *
 * step() makes one accepted step.  The last step stays in memory until the next one begins, so that what
 * happened within it can be asked for afterwards: the state at its fraction x, 0 <= x <= 1, by the dense
 * output, which costs three more evaluations and is formed only if somebody asks.  Time is a sum of two
 * numbers, so that it loses nothing over 1e9 steps, and a step that reaches t_limit ends there exactly.  How
 * long steps are is decided in step_control.inl.
 *
 * A state has FLOW_DIM numbers, a constant of the unit that includes this file.  One bead has ten (flow.h); a
 * unit for several beads includes the body once more, with its own step and its own dimension.  The including
 * file brings model/drive.inl, step_control.inl and the step's body and defines
 *
 * - FLOW_DIM, the dimension, and FLOW_NUMBERS, if a step carries further numbers that are not a state;
 * - FLOW_TAG, the tag of the struct, and FLOW_NAME(name), how functions are named;
 * - FLOW_STEP(name), how the step's body names what it defines (STEP_NAME there);
 * - FLOW_BEGIN(s): evaluate the first stage at s->y;
 * - FLOW_FINISH(s): project the end of an accepted step, evaluate its last stage, return how far it was off;
 * - FLOW_NEXT(s, omega): make the end the start of the next step, where the drive is omega;
 * - FLOW_PROJECT(y): put a state of the dense output back to where states lie;
 * - FLOW_DERIVATIVE(s, y, dy): the right-hand side at a state, outside any step;
 * - FLOW_ERROR(flow), if its steps are judged by more than the method's own error: the error of a tried step
 * over its tolerance;
 * - FLOW_MEMBERS: what else belongs to a flow.
 *
 * What changes at an instant.  Between two events the right-hand side is smooth.  Besides the numbers it
 * depends on the world, which never changes, and on the modes of the motion, which are constant within a step
 * (a bead that sticks or slides).  Modes change between two steps: contact.c ends a step where a mode ends,
 * changes the mode, and restart() evaluates the first stage anew under the new one.
 *
 *     step.y o-----___            mode 0
 *                     ---o        <- the event: the step is made anew, as long as up to here
 *                         \
 *                  mode 1  `---___o step.end
 */
#ifndef FLOW_NUMBERS
#define FLOW_NUMBERS FLOW_DIM
#endif
#ifndef FLOW_ERROR
#define FLOW_ERROR(flow) FLOW_STEP(step_error)(&(flow)->step, (flow)->rtol, (flow)->atol)
#endif

typedef struct FLOW_TAG {
    FLOW_STEP(step) step; /* the last accepted step, from step.y to step.end */
    REAL rtol, atol[FLOW_DIM];
    FN(step_control) control;
    FN(twofold) t_start, t; /* times of step.y and step.end */
    FN(drive) drive;
    int has_step;    /* a step was made: step.end is the state, else step.y */
    int has_dense;   /* step.dense belongs to the last step */
    REAL norm_drift; /* sum of what FLOW_FINISH() returned */
    uint64_t rhs_calls, accepted, rejected;
    FLOW_MEMBERS
} FLOW_NAME(type);

/* Root mean square in units of the tolerance, the norm of the first step's size. */
static inline REAL FLOW_NAME(scaled_norm)(const FLOW_NAME(type) * flow, const REAL *v)
{
    REAL sum = R(0.0);
    for (int i = 0; i < FLOW_DIM; ++i) {
        const REAL scaled = v[i] / (flow->atol[i] + flow->rtol * REAL_ABS(flow->step.y[i]));
        sum += scaled * scaled;
    }
    return REAL_SQRT(sum / REAL_OF(FLOW_DIM));
}

static inline REAL FLOW_NAME(choose_first_size)(FLOW_NAME(type) * flow)
{
    FLOW_STEP(step) *s = &flow->step;
    const REAL slope = FLOW_NAME(scaled_norm)(flow, s->k[0]);
    const REAL trial = FN(first_trial)(FLOW_NAME(scaled_norm)(flow, s->y), slope);
    REAL state[FLOW_NUMBERS], next[FLOW_NUMBERS];
    memcpy(state, s->y, sizeof state);
    for (int i = 0; i < FLOW_DIM; ++i)
        state[i] += trial * s->k[0][i];
    FLOW_DERIVATIVE(s, state, next);
    flow->rhs_calls += 1;
    for (int i = 0; i < FLOW_DIM; ++i)
        next[i] -= s->k[0][i];
    return FN(first_size)(trial, slope, FLOW_NAME(scaled_norm)(flow, next) / trial);
}

/* Evaluate the first stage at step.y, where the flow stands from now on. */
static inline void FLOW_NAME(stand)(FLOW_NAME(type) * flow)
{
    FLOW_BEGIN(&flow->step);
    flow->rhs_calls += 1;
    flow->t_start = flow->t;
    flow->has_step = flow->has_dense = 0;
}

/* Begin at step.y, with the tolerances, the drive and step.context set and everything else zero.  A first size
 * or a greatest one of 0 counts as not given. */
static inline void FLOW_NAME(begin)(FLOW_NAME(type) * flow, REAL first_size, REAL greatest_size)
{
    FLOW_STEP(step) *s = &flow->step;
    s->omega = FN(drive_rate)(&flow->drive, flow->t);
    s->ramp = flow->drive.ramp;
    FLOW_NAME(stand)(flow);
    memcpy(s->end, s->y, sizeof s->end);
    flow->control = FN(begin_control)(first_size > 0 ? first_size : FLOW_NAME(choose_first_size)(flow),
                                      greatest_size > 0 ? greatest_size : REAL_OF(INFINITY));
}

/* The end of the last step becomes a start, at which the first stage is evaluated anew. */
static inline void FLOW_NAME(restart)(FLOW_NAME(type) * flow)
{
    FLOW_STEP(step) *s = &flow->step;
    memcpy(s->y, s->end, sizeof s->y);
    s->omega = FN(drive_rate)(&flow->drive, flow->t);
    FLOW_NAME(stand)(flow);
}

/* Time and counters after an accepted step. */
static inline void FLOW_NAME(pass)(FLOW_NAME(type) * flow, REAL t_limit)
{
    flow->rhs_calls += 1;
    flow->accepted += 1;
    flow->t_start = flow->t;
    flow->t = FN(step_end)(&flow->control, flow->t, t_limit);
    flow->has_step = 1;
    flow->has_dense = 0;
}

/* The end of the last step, if there is one, becomes the start of the next. */
static inline void FLOW_NAME(prepare)(FLOW_NAME(type) * flow)
{
    if (!flow->has_step)
        return;
    FLOW_NEXT(&flow->step, FN(drive_rate)(&flow->drive, flow->t));
    flow->has_step = 0;
}

/* Make one accepted step of a way whose end is `rest` away; the time is its caller's to pass.  0: the step was
 * given up (step_control.inl), and the flow stays at the end of its last good step. */
static inline int FLOW_NAME(try_until_good)(FLOW_NAME(type) * flow, REAL rest)
{
    FLOW_STEP(step) *s = &flow->step;
    FN(step_control) *control = &flow->control;
    FN(plan_step)(control, REAL_EVERYWHERE, rest);
    for (;;) {
        s->h = control->size;
        FLOW_STEP(try_step)(s);
        flow->rhs_calls += DOP_TRY_EVALUATIONS;
        const REAL error = FLOW_ERROR(flow), factor = FN(step_factor)(error);
        if (error <= R(1.0)) {
            flow->norm_drift += FLOW_FINISH(s);
            FN(accept_step)(control, REAL_EVERYWHERE, factor, FST_HOLD_AFTER_REJECTION);
            return 1;
        }
        flow->rejected += 1;
        if (FN(reject_step)(control, REAL_EVERYWHERE, error, factor, flow->t.high) > 0)
            break;
    }
    memcpy(s->end, s->y, sizeof s->end);
    return 0;
}

/* Make one accepted step towards t_limit, forward or backward in time, landing on it exactly where it is in
 * reach. 0: the step was given up, and the flow stays at the end of its last good step. */
static inline int FLOW_NAME(go)(FLOW_NAME(type) * flow, REAL t_limit)
{
    FLOW_NAME(prepare)(flow);
    const FN(twofold) limit = {t_limit, R(0.0)};
    if (!FLOW_NAME(try_until_good)(flow, FN(twofold_difference)(limit, flow->t)))
        return 0;
    FLOW_NAME(pass)(flow, t_limit);
    return 1;
}

/* Form the dense output of the last step, unless that is done. */
static inline void FLOW_NAME(form_dense)(FLOW_NAME(type) * flow)
{
    if (flow->has_dense)
        return;
    FLOW_STEP(make_dense)
    (&flow->step); /* its evaluations are not counted: they belong to what watches the flow */
    flow->has_dense = 1;
}

/* The state at the fraction x of the last step. */
static inline void FLOW_NAME(state_at)(FLOW_NAME(type) * flow, REAL x, REAL state[FLOW_DIM])
{
    enum { ROW = sizeof flow->step.y / sizeof(REAL) };
    FLOW_NAME(form_dense)(flow);
    FLOW_STEP(evaluate_dense)(FLOW_DIM, &flow->step.dense[0][0], ROW, x, state);
    FLOW_PROJECT(state);
}

/* The time at the fraction x of the last step. */
static inline FN(twofold) FLOW_NAME(time_at)(const FLOW_NAME(type) * flow, REAL x)
{
    return x == R(1.0) ? flow->t : FN(twofold_add)(flow->t_start, x * flow->step.h);
}

/* End the last step at its fraction x; restart() must follow. */
static inline void FLOW_NAME(cut)(FLOW_NAME(type) * flow, REAL x)
{
    if (x == R(1.0))
        return;
    REAL state[FLOW_DIM];
    FLOW_NAME(state_at)(flow, x, state);
    flow->t = FLOW_NAME(time_at)(flow, x);
    memcpy(flow->step.end, state, sizeof state);
}

#undef FLOW_DIM
#undef FLOW_NUMBERS
#undef FLOW_TAG
#undef FLOW_NAME
#undef FLOW_STEP
#undef FLOW_BEGIN
#undef FLOW_FINISH
#undef FLOW_NEXT
#undef FLOW_PROJECT
#undef FLOW_DERIVATIVE
#undef FLOW_ERROR
#undef FLOW_MEMBERS
