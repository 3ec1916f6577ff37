/* automaton.inl - how what a plate can hold is held, let go and handed over to a free motion, along a
 * trajectory.
 *
 * A velocity v of two components obeys v' = a - c v/|v|: a push a against a friction of the strength c, which
 * is set-valued at v = 0.  There are two such velocities, and this body is compiled for each: the slip V of the
 * contact against the push A (slip.c), and the rotation W_h of the bead against the balance T (rest.c).  Their
 * modes are those of model/contact/modes.inl:
 *
 *              |v| nearly nothing and |a| < c
 *        +-------------------------------------------+
 *        |                                           v
 *      moves <---- |v| = handed over ---- begins    held
 *        ^                                 ^  |      |  ^
 *        |                                 |  +------|--+ |v| = 0
 *        +------- friction falls ----------+---------+ |a| > c
 *
 * Capture.  Two numbers, the components of v, must vanish for a motion to end, and no function of the state
 * changes its sign there: in time, |v| falls to zero like t* - t and its direction turns ever faster towards
 * that of a, so that a method of high order silently becomes one of low order.  In the time theta of the law's
 * pace it falls like exp(-theta) for ever, and the direction turns at a bounded rate: everything is smooth,
 * passes close by v = 0 too.  The motion is over at a size at which nothing feels the rest.
 *
 *     |v| |\                                  log |v| |\
 *         | \          in time                        | \      in theta
 *         |  `.                                       |  `.
 *         |    `.                                     |    `.
 *         +------*--- held --> t                      +      `. captured: held
 *                t*
 *
 * Release.  |a| passes the greatest c, a function of the state whose zero is located as other events are; the
 * step is made anew as long as up to there.  If friction is (nearly) as strong in motion, the motion begins: it
 * grows from nothing while its direction is tied to that of a (lag.inl, onset.c), and is handed over when it is
 * large enough to have a direction of its own.  If friction is weaker in motion, it moves at once, with a tiny
 * speed along a.
 *
 * Sizes follow the tolerance: what is nothing is a thousandth of it, and the hand-over goes with its power
 * 5/16, by which the error of a beginning, (hand-over)^(7/2), shrinks like the tolerance (onset.c).
 *
 * The including file defines
 *
 * - PART_NAME(name), how what this body defines is named, and PART_API, whether others may call it (static:
 * not);
 * - PART_MODE, PART_LAG: the members of FN(modes), and PART_STATE: that of fst_contact_state;
 * - PART_VELOCITY(c, y, v): v of a state; PART_PUSH(at): a of a contact;
 * - PART_LEFT(c, at): what the greatest c could still take of a; PART_STOPS(c, at): whether c stops a motion;
 * - PART_ASKED(m): the change of modes in which a is asked for, if any;
 * - PART_NOTHING(flow): the greatest v that is nothing; PART_OVER(flow): whether that of the last step is;
 * - PART_RELEASED(c): the mode that follows where a passes c;
 * - PART_STOP(c, y): take v out of a state; PART_SET(c, y, v): put it in;
 * - PART_BEGIN(flow, state): begin the lag, and set the sizes of the hand-over.
 */
/* The contact of a state, in the modes in which the push is asked for. */
static fst_contact_double PART_NAME(contact_at)(const fst_flow *flow, const double *state,
                                                fst_modes_double *asked)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_pull_double p;
    *asked = *fst_flow_modes(flow);
    PART_ASKED(asked);
    fst_magnetic_pull_double(c, asked, state, &p);
    return fst_contact_of_double(c, asked, state, &p);
}

static int PART_NAME(mode)(const fst_flow *flow)
{
    return (int)fst_flow_modes(flow)->PART_MODE;
}

/* ------------------------------------------------------------------ events that end a mode */

/* What the plate could still take. */
static double PART_NAME(left)(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_contact_double at = fst_contact_of_double(c, fst_flow_modes(flow), state, p);
    return PART_LEFT(c, &at);
}

/* Of a motion that begins: the speed along the push, which began at 0. */
static double PART_NAME(speed)(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_contact_double at = fst_contact_of_double(c, fst_flow_modes(flow), state, p);
    double v[2];
    PART_VELOCITY(c, state, v);
    return (v[0] * PART_PUSH(&at)[0] + v[1] * PART_PUSH(&at)[1]) / fst_norm_2_double(PART_PUSH(&at));
}

static double PART_NAME(until_free)(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    return flow->contact.PART_STATE.free_at - PART_NAME(speed)(flow, state, p);
}

static double PART_NAME(until_held)(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    return PART_NAME(speed)(flow, state, p) + PART_NOTHING(flow);
}

/* Whether the speed falls below 0 at some place.  It begins without a slope, so that between places it does not
 * dip below those beside. */
static int PART_NAME(falls_back)(const fst_flow *flow)
{
    double least, greatest;
    fst_flow_path_range(flow, PART_NAME(speed), &least, &greatest);
    return least < 0;
}

/* Where the speed hardly grows, its direction is no longer known after some time; *x: that place in the step.
 */
static int PART_NAME(is_long)(fst_flow *flow, double *x)
{
    static const double few = 0.01; /* the speed then, in those of the hand-over */
    const fst_part_state *part = &flow->contact.PART_STATE;
    const double time = part->free_by - fst_flow_modes(flow)->PART_LAG.since;
    const double whole = fst_contact_elapsed(flow);
    *x = time > 0 && time < whole ? fst_contact_fraction(flow, time) : 1.0;
    return time <= whole && fst_flow_function_at(flow, *x, PART_NAME(speed)) >= few * part->free_at;
}

/* The fraction of the last step at which its mode ends, 2 where it does not, and the one that follows. */
PART_API double PART_NAME(ends)(fst_flow *flow, int *next)
{
    const int mode = PART_NAME(mode)(flow);
    double first = 2.0, x;
    if (mode == FST_HELD && fst_flow_becomes_negative(flow, PART_NAME(left), &x)) {
        *next = PART_RELEASED(fst_flow_world(flow));
        first = x;
    }
    if (mode != FST_BEGINS)
        return first;
    if (fst_flow_becomes_negative(flow, PART_NAME(until_free), &x) || PART_NAME(is_long)(flow, &x)) {
        *next = FST_MOVES;
        first = x;
    }
    if (PART_NAME(falls_back)(flow) && fst_flow_first_negative(flow, PART_NAME(until_held), 0.0, &x) &&
        x < first) {
        *next = FST_HELD;
        first = x;
    }
    return first;
}

/* The mode that follows a motion that is nearly nothing, -1 where it goes on.  It ends where friction is
 * stronger than the push.  A motion straight against a push that is stronger stops as well, but is let go at
 * once; it would approach rest for ever in theta. */
PART_API int PART_NAME(after)(const fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    const double *end = flow->step.end;
    if (PART_NAME(mode)(flow) != FST_MOVES || !PART_OVER(flow))
        return -1;
    double v[2];
    fst_modes_double asked;
    const fst_contact_double at = PART_NAME(contact_at)(flow, end, &asked);
    PART_VELOCITY(c, end, v);
    const int against = v[0] * PART_PUSH(&at)[0] + v[1] * PART_PUSH(&at)[1] < 0;
    if (against ? PART_LEFT(c, &at) >= 0 : PART_STOPS(c, &at))
        return FST_HELD;
    return against ? PART_RELEASED(c) : -1;
}

/* ------------------------------------------------------------------ changes of mode */

/* The mode changes at `state`, which may be moved by less than anything else feels. */
PART_API void PART_NAME(enter)(fst_flow *flow, int mode, double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_modes_double asked;
    double v[2];
    if (mode != FST_MOVES)
        PART_STOP(c, state);
    const fst_contact_double at = PART_NAME(contact_at)(flow, state, &asked);
    flow->step.context.modes.PART_MODE = mode;
    if (mode == FST_BEGINS) {
        PART_BEGIN(flow, state);
        flow->contact.PART_STATE.released = flow->t;
    }
    PART_VELOCITY(c, state, v);
    if (mode == FST_MOVES && fst_norm_2_double(v) < PART_NOTHING(flow)) {
        const double part = PART_NOTHING(flow) / (fst_norm_2_double(PART_PUSH(&at)) + 1e-290);
        PART_SET(c, state, ((const double[2]){part * PART_PUSH(&at)[0], part * PART_PUSH(&at)[1]}));
    }
}

/* A motion that begins goes on from the end of the last step. */
PART_API void PART_NAME(go_on)(fst_flow *flow)
{
    if (PART_NAME(mode)(flow) == FST_BEGINS)
        flow->step.context.modes.PART_LAG.since =
            fst_twofold_difference(flow->t, flow->contact.PART_STATE.released);
}

#undef PART_NAME
#undef PART_API
#undef PART_MODE
#undef PART_LAG
#undef PART_STATE
#undef PART_VELOCITY
#undef PART_PUSH
#undef PART_LEFT
#undef PART_STOPS
#undef PART_ASKED
#undef PART_NOTHING
#undef PART_OVER
#undef PART_RELEASED
#undef PART_STOP
#undef PART_SET
#undef PART_BEGIN
