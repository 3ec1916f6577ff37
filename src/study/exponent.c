/* exponent.c - largest Lyapunov exponents across the flow, by the variational equations.
 *
 * Beside each bead a tangent vector is carried along: the difference to a neighbour that starts infinitely
 * close. Its length grows as exp(lambda t), and lambda is the exponent.
 *
 *     |v|        .|        .|        .|      the time is cut into pieces; at the end of each the vector
 *              .  |      .  |      .  |      is made short again, and the logarithms of what it had grown
 *           .     |   .     |   .     |      to are averaged as growth.h says
 *         +-------+---------+---------+-- t
 *           piece     piece     piece
 *
 * Two directions say nothing of neighbouring orbits and are taken out at the end of each piece: along the flow,
 * where a difference only means to be ahead on the same orbit, and along |n|, which does not change.  At first
 * the vector turns towards the direction that grows fastest; the growth counts from then on.
 *
 * Under dry friction the vector follows the flow, step by step, through its changes of mode.  In lanes an engine
 * carries the vectors of all lanes along their steps; where a step ends in another mode, or a piece does, the lane's
 * own flow and vector go on from there, as they do alone.
 *
 * As many beads as the engine is wide are followed side by side, each with its own steps.  A bead with its
 * vector can be put down between two tries (keep_way()) and taken up again, so that an interrupted sweep loses
 * nothing.
 */
#include "study/exponent.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/dot.h"
#include "base/elementary.h"
#include "base/error.h"
#include "base/watch.h"
#include "ode/flight.h"
#include "ode/neighbours.h"
#include "study/growth.h"
#include "study/lane_contact.h"

/* Exponents are computed at these tolerances where the run's own is tighter: the regime comes out the same, and
 * what the steps' errors change is far less than the exponent's error bar (docs/regimes.md).  Without friction
 * nothing damps the errors of the steps. */
static const double LOOSEST = 1e-7, LOOSEST_WITHOUT_FRICTION = 1e-9;
/* The vector turns into place during the first eleventh of the time.  There are at least so many pieces, and
 * they are short enough for no direction to shrink to nothing within one. */
static const double ALIGNING = 1.0 / 11, LONGEST_PIECE = 16.0;
static const double ALIGNING_PIECES = 32, PIECES = 320;
/* Where another direction shrinks at nearly the same rate, the vector turns away from it so slowly that all
 * parts of the time look alike, and none of them shows the error.  The length is then known up to a factor of
 * about e. */
static const double TURNING = 1.0;
/* Error of a growth rate due to the errors of the steps, in units of the tolerance (docs/regimes.md). */
static const double OF_TOLERANCE = 10.0;
static const double FIRST_SIZE = 0.1; /* of a step; the controller mends it within a few */
enum { STEPS_UNTOLD = 64 };
/* Evaluations of a try: stages 2 to 12, and the first one of what follows, which accept() makes after every try
 * because other lanes may need it. */
enum { CALLS_A_TRY = 12 };

/* One bead and its vector. */
typedef struct follower {
    fst_exponent *asked;
    double t, piece; /* the time in the present piece, and a piece's length */
    fst_step_control_double control;
    double aligning, pieces, done; /* pieces before the growth counts; all pieces; pieces already done */
    double rtol;
    fst_growth growth;
    fst_growth_clock clock;
    int over;
} follower;

typedef struct batch {
    const fst_tangent_engine *engine;
    void *memory;
    double *y;
    const double *slope;
    follower followers[FST_MOST_LANES];
    int count;
} batch;

/* Take the parts along |n| and along the flow out of the tangent vector, of so many numbers, at a state.
 * Returns its length, and scales it to 1. */
static double project(const double *y, double *tangent, const double *flow_direction, int numbers)
{
    const double *n = y + FST_NX;
    const double along_n = fst_dot(tangent + FST_NX, n, 3) / fst_dot(n, n, 3);
    for (int i = 0; i < 3; ++i)
        tangent[FST_NX + i] -= along_n * n[i];
    const double speed2 = fst_dot(flow_direction, flow_direction, numbers);
    if (speed2 > 0) {
        const double along = fst_dot(tangent, flow_direction, numbers) / speed2;
        for (int i = 0; i < numbers; ++i)
            tangent[i] -= along * flow_direction[i];
    }
    const double length = sqrt(fst_dot(tangent, tangent, numbers));
    for (int i = 0; i < numbers; ++i)
        tangent[i] /= length;
    return length;
}

static double project_lane(batch *b, int l)
{
    const int width = b->engine->width;
    double y[FST_TANGENT_DIM], flow_direction[FST_STATE_SIZE];
    for (int i = 0; i < FST_TANGENT_DIM; ++i)
        y[i] = b->y[i * width + l];
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        flow_direction[i] = b->slope[i * width + l];
    const double length = project(y, y + FST_STATE_SIZE, flow_direction, FST_STATE_SIZE);
    for (int i = FST_STATE_SIZE; i < FST_TANGENT_DIM; ++i)
        b->y[i * width + l] = y[i];
    return length;
}

_Static_assert(sizeof(follower) <= FST_EXPONENT_WAY, "the way of an exponent has room for its follower");

/* Note all that a lane knows between two tries, so that the work can go on from there. */
static void keep_way(batch *b, int l)
{
    follower kept = b->followers[l];
    fst_exponent *asked = kept.asked;
    kept.asked = NULL;
    memcpy(asked->way, &kept, sizeof kept);
    for (int i = 0; i < FST_TANGENT_DIM; ++i)
        asked->way_state[i] = b->y[i * b->engine->width + l];
    asked->has_way = 1;
}

static void take_up_way(batch *b, int l, fst_exponent *asked)
{
    memcpy(&b->followers[l], asked->way, sizeof b->followers[l]);
    b->followers[l].asked = asked;
    for (int i = 0; i < FST_TANGENT_DIM; ++i)
        b->y[i * b->engine->width + l] = asked->way_state[i];
}

static follower follower_of(fst_exponent *asked, double rtol)
{
    const double aligned = asked->duration * ALIGNING, measured = asked->duration - aligned;
    const double finer = fmax(1.0, ceil(measured / PIECES / LONGEST_PIECE));
    asked->rhs_calls = 0;
    asked->failed = 0;
    return (follower){.asked = asked,
                      .piece = measured / PIECES / finer,
                      .aligning = ALIGNING_PIECES * finer,
                      .pieces = (ALIGNING_PIECES + PIECES) * finer,
                      .rtol = rtol,
                      .clock = {.duration = measured},
                      .control = fst_begin_control_double(FIRST_SIZE, INFINITY)};
}

/* Put a bead and a fresh vector into a lane. */
static void begin(batch *b, int l, fst_exponent *asked)
{
    double y[FST_TANGENT_DIM], atol[FST_TANGENT_DIM];
    const double loosest = fst_kinds_brake(&asked->world->kinds) ? LOOSEST : LOOSEST_WITHOUT_FRICTION;
    const double rtol = asked->rtol > loosest ? asked->rtol : loosest;
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        y[i] = asked->state[i];
        y[FST_STATE_SIZE + i] = 1.0 / (1.0 + i); /* any direction will do */
        atol[i] = rtol;
        atol[FST_STATE_SIZE + i] = 1e-6;
    }
    b->engine->load(b->memory, l, asked->world, y, rtol, atol);
    if (l >= b->count || asked->has_way)
        return;
    b->followers[l] = follower_of(asked, rtol);
    fst_plan_step_double(&b->followers[l].control, REAL_EVERYWHERE, b->followers[l].piece);
}

/* Accept or reject a try: 1 or 0. */
static int judge(follower *f, double error, double factor)
{
    f->asked->rhs_calls += CALLS_A_TRY;
    if (!(error <= 1.0)) {
        f->over = f->asked->failed =
            fst_reject_step_double(&f->control, REAL_EVERYWHERE, error, factor, f->t) > 0;
        return 0;
    }
    f->t = f->control.lands > 0 ? f->piece : f->t + f->control.size;
    fst_accept_step_double(&f->control, REAL_EVERYWHERE, factor, FST_GROW_AFTER_REJECTION);
    return 1;
}

/* A piece is over, and the vector has grown to `length`. */
static void end_piece(follower *f, double length)
{
    f->t = 0.0;
    if (++f->done > f->aligning) {
        fst_growth_pass(&f->clock, f->piece);
        fst_growth_add(&f->growth, &f->clock, fst_log(length));
    }
    if (f->done < f->pieces)
        return;
    const fst_growth_rate rate = fst_growth_conclude(&f->growth);
    f->asked->value = rate.value;
    f->asked->chance = fmax(rate.chance, OF_TOLERANCE * f->rtol);
    f->asked->standard_error = fmax(fmax(rate.error, TURNING / f->clock.duration), OF_TOLERANCE * f->rtol);
    f->over = 1;
}

/* Each lane tries one step.  Returns 0 if all exponents are known. */
static int step(batch *b)
{
    double h[FST_MOST_LANES] = {0}, errors[FST_MOST_LANES], factors[FST_MOST_LANES];
    unsigned accepted = 0;
    int at_work = 0, projected = 0;
    for (int l = 0; l < b->count; ++l)
        h[l] = b->followers[l].over ? 0.0 : b->followers[l].control.size;
    b->engine->try_steps(b->memory, h, errors, factors);
    for (int l = 0; l < b->count; ++l)
        if (!b->followers[l].over && judge(&b->followers[l], errors[l], factors[l]))
            accepted |= 1u << l;
    b->engine->accept(b->memory, accepted);
    for (int l = 0; l < b->count; ++l) {
        follower *f = &b->followers[l];
        if (accepted & 1u << l && f->control.lands > 0) {
            end_piece(f, project_lane(b, l));
            projected = 1;
        }
        if (accepted & 1u << l)
            fst_plan_step_double(&f->control, REAL_EVERYWHERE, f->piece - f->t);
        at_work |= !f->over;
    }
    if (projected)
        b->engine->evaluate(b->memory);
    return at_work;
}

/* The share of its work that the slowest bead has done. */
static double fraction_done(const batch *b)
{
    double least = 1.0;
    for (int l = 0; l < b->count; ++l)
        if (!b->followers[l].over)
            least = fmin(least, b->followers[l].done / b->followers[l].pieces);
    return least;
}

/* ------------------------------------------------------------------ dry friction */

/* A piece of a motion whose contact slips and sticks is over: the vector's length, scaled to 1.  Of a bead in the
 * air height and climb count as well. */
static double project_neighbour(fst_neighbours *b, const fst_flow *flow)
{
    double direction[FST_NUMBERS] = {0.0};
    const double *end = flow->step.end;
    const int numbers = fst_flight_is_on(flow) ? FST_NUMBERS : FST_STATE_SIZE;
    fst_neighbours_at_equal_times(b, flow);
    fst_flow_slope(flow, direction);
    if (numbers == FST_NUMBERS) {
        direction[FST_HEIGHT] = end[FST_CLIMB];
        direction[FST_CLIMB] =
            -fst_load_double(fst_flow_world(flow), FST_PATH_PULL(&flow->step, FST_PATH_END)->force);
    }
    const double length = project(end, b->d[0], direction, numbers);
    for (int i = numbers; i < FST_NUMBERS; ++i)
        b->d[0][i] /= length;
    return length;
}

/* Any direction will do. */
static fst_neighbours one_vector(fst_flow *flow)
{
    fst_neighbours b = {.count = 1, .parameter = -1};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        b.d[0][i] = 1.0 / (1.0 + i);
    fst_neighbours_start(&b, flow);
    return b;
}

static double end_of_piece(const follower *f)
{
    return (f->done + 1.0) * f->piece;
}

/* The vector follows the flow through its changes of mode (ode/neighbours.c).  Work that was interrupted begins
 * anew, and ends with the same bits. */
static fst_status follow_dry(fst_exponent *asked, fst_flow *flow, double rtol, const fst_progress *progress,
                             fst_error *error)
{
    follower f = follower_of(asked, rtol);
    fst_neighbours b = one_vector(flow);
    for (unsigned steps = 1; !f.over; ++steps) {
        const double end = end_of_piece(&f);
        fst_status status =
            progress && steps % STEPS_UNTOLD == 0 ? fst_tell(progress, f.done / f.pieces, NULL, error) : FST_OK;
        if (status != FST_OK)
            return status;
        if (fst_flow_step(flow, end, error) != FST_OK) {
            asked->failed = 1;
            return FST_OK;
        }
        if (!fst_neighbours_known(flow)) {
            asked->unknown = 1;
            return FST_OK;
        }
        fst_neighbours_follow(&b, flow);
        if (!(fst_twofold_difference((fst_twofold){end, 0.0}, flow->t) > 0.0))
            end_piece(&f, project_neighbour(&b, flow));
    }
    asked->rhs_calls = flow->rhs_calls;
    return FST_OK;
}

/* The tolerance, and what it makes of the modes, too. */
static double dry_tolerance(const fst_exponent *asked)
{
    return fmax(asked->rtol, LOOSEST_WITHOUT_FRICTION);
}

static fst_status dry_flow(const fst_exponent *asked, fst_flow **flow, fst_error *error)
{
    fst_model model;
    fst_flow_options o = fst_default_flow_options();
    memset(&model, 0, sizeof model);
    model.world = *asked->world;
    model.groups.omega = asked->world->omega;
    o.rtol = dry_tolerance(asked);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = o.rtol;
    return fst_flow_new(&model, &o, asked->state, flow, error);
}

static fst_status dry_exponent(fst_exponent *asked, const fst_progress *progress, fst_error *error)
{
    fst_flow *flow;
    fst_status status = dry_flow(asked, &flow, error);
    if (status == FST_OK)
        status = follow_dry(asked, flow, dry_tolerance(asked), progress, error);
    fst_flow_free(flow);
    return status;
}

/* ------------------------------------------------------------------ the same in lanes */

/* Numbers of a vector that lanes carry. */
enum { CARRIED = FST_STEP_TIME + 1 };

/* Lanes carry the vectors along whole steps; where a mode or a piece ends, the flows do. */
struct fst_dry_exponents {
    fst_lane_flows at; /* no flow: the lane is idle */
    fst_lane_view view;
    follower followers[FST_MOST_LANES];
    fst_neighbours vectors[FST_MOST_LANES];
    double carried[CARRIED * FST_MOST_LANES]; /* the same vectors, as the engine has them */
};

static void take_vector(fst_dry_exponents *b, int l)
{
    for (int i = 0; i < CARRIED; ++i)
        b->vectors[l].d[0][i] = b->carried[i * b->at.engine->width + l];
}

static void put_vector(fst_dry_exponents *b, int l)
{
    for (int i = 0; i < CARRIED; ++i)
        b->carried[i * b->at.engine->width + l] = b->vectors[l].d[0][i];
}

/* A lane goes on from where its flow stands. */
static void go_on(fst_dry_exponents *b, int l)
{
    put_vector(b, l);
    b->at.limits[l] = end_of_piece(&b->followers[l]);
    fst_contact_begin_step(b->at.flows[l]);
    b->at.engine->reload(b->at.memory, l, b->at.flows[l], b->at.limits[l]);
}

/* Another mode begins at the end of a lane's step. */
static void turn(fst_dry_exponents *b, int l)
{
    fst_flow *flow = b->at.flows[l];
    b->at.engine->extract_clock(b->at.memory, l, flow);
    for (int i = 0; i < CARRIED; ++i)
        flow->step.end[i] = b->view.end[i * b->at.engine->width + l];
    take_vector(b, l);
    fst_neighbours_change(&b->vectors[l], flow);
    go_on(b, l);
}

/* A piece ends in a lane's step. */
static void land(fst_dry_exponents *b, int l)
{
    fst_lane_land(&b->at, l);
    take_vector(b, l);
    fst_neighbours_follow(&b->vectors[l], b->at.flows[l]);
    end_piece(&b->followers[l], project_neighbour(&b->vectors[l], b->at.flows[l]));
    go_on(b, l);
}

/* The bead of a lane is done with.  As in follow_dry(), evaluations that led to nothing do not count. */
static void leave(fst_dry_exponents *b, int l)
{
    if (!b->followers[l].asked->failed)
        b->followers[l].asked->rhs_calls = b->at.flows[l]->rhs_calls;
    b->at.engine->release(b->at.memory, l);
    fst_flow_free(b->at.flows[l]);
    b->at.flows[l] = NULL;
}

/* Each lane tries one step.  Returns the lanes whose exponents are known then, one bit each. */
static unsigned step_dry(fst_dry_exponents *b)
{
    const fst_lane_engine *engine = b->at.engine;
    const fst_lane_tries tries = engine->try_steps(b->at.memory);
    const fst_lane_contacts contacts = fst_lanes_look_at_contacts(&b->at, tries);
    const unsigned accepted = tries.accepted | contacts.passed;
    unsigned over = 0;
    engine->carry(b->at.memory, accepted, b->carried);
    for (int l = 0; ((contacts.turned | contacts.landed | tries.failed) >> l) != 0; ++l) {
        follower *f = &b->followers[l];
        if (contacts.turned & fst_lane_bit(l))
            turn(b, l);
        if (contacts.landed & fst_lane_bit(l))
            land(b, l);
        if (tries.failed & fst_lane_bit(l))
            f->over = f->asked->failed = 1;
        if ((contacts.landed | tries.failed) & fst_lane_bit(l) && f->over)
            over |= fst_lane_bit(l);
    }
    engine->advance(b->at.memory, accepted & ~contacts.turned);
    return over;
}

static fst_status begin_dry(fst_dry_exponents *b, int l, fst_exponent *asked, fst_error *error)
{
    const fst_status status = dry_flow(asked, &b->at.flows[l], error);
    if (status != FST_OK)
        return status;
    b->followers[l] = follower_of(asked, dry_tolerance(asked));
    b->vectors[l] = one_vector(b->at.flows[l]);
    b->at.engine->load(b->at.memory, l, b->at.flows[l], end_of_piece(&b->followers[l]));
    go_on(b, l);
    return FST_OK;
}

fst_dry_exponents *fst_dry_exponents_new(const fst_lane_engine *engine)
{
    const size_t bytes = (engine->bytes + 63) / 64 * 64;
    fst_dry_exponents *b = calloc(1, sizeof *b);
    void *memory = aligned_alloc(64, bytes);
    if (!b || !memory) {
        free(b);
        free(memory);
        return NULL;
    }
    memset(memory, 0, bytes);
    b->at.engine = engine;
    b->at.memory = memory;
    engine->view(memory, &b->view);
    return b;
}

void fst_dry_exponents_free(fst_dry_exponents *b)
{
    for (int l = 0; b && l < FST_MOST_LANES; ++l)
        fst_flow_free(b->at.flows[l]);
    if (b)
        free(b->at.memory);
    free(b);
}

/* The lane of a bead; where it has none yet, an idle one, which there is, because no more are asked for at a time than
 * there are lanes. */
static int lane_of(const fst_dry_exponents *b, const fst_exponent *asked)
{
    int l = 0;
    while (l < b->at.engine->width && !(b->at.flows[l] && b->followers[l].asked == asked))
        ++l;
    for (int k = 0; l == b->at.engine->width; ++k)
        l = b->at.flows[k] ? l : k;
    return l;
}

fst_status fst_dry_exponents_follow(fst_dry_exponents *b, fst_exponent *const *asked, int count, unsigned *over,
                                    const fst_progress *progress, fst_error *error)
{
    int lanes[FST_MOST_LANES];
    unsigned ends = 0;
    fst_status status = FST_OK;
    for (int i = 0; status == FST_OK && i < count; ++i) {
        lanes[i] = lane_of(b, asked[i]);
        if (!b->at.flows[lanes[i]])
            status = begin_dry(b, lanes[i], asked[i], error);
    }
    for (unsigned steps = 1; status == FST_OK && (ends = step_dry(b)) == 0; ++steps)
        if (steps % STEPS_UNTOLD == 0)
            status = fst_tell(progress, 0.0, NULL, error);
    *over = 0;
    for (int i = 0; status == FST_OK && i < count; ++i)
        if (ends & fst_lane_bit(lanes[i])) {
            leave(b, lanes[i]);
            *over |= 1u << i;
        }
    return status;
}

fst_status fst_largest_exponents(const fst_tangent_engine *engine, fst_exponent *const *asked, int count,
                                 const fst_progress *progress, fst_error *error)
{
    if (asked[0]->world->kinds.dry) {
        fst_status status = FST_OK;
        for (int i = 0; i < count && status == FST_OK; ++i)
            status = dry_exponent(asked[i], progress, error);
        return status;
    }
    batch b = {.engine = engine, .count = count};
    const size_t bytes = (engine->bytes + 63) / 64 * 64;
    b.memory = aligned_alloc(64, bytes);
    if (!b.memory)
        return fst_fail(error, FST_NO_MEMORY, "Lyapunov exponent", "out of memory");
    memset(b.memory, 0, bytes);
    engine->view(b.memory, &b.y, &b.slope);
    for (int l = 0; l < engine->width; ++l)
        begin(&b, l, asked[l < count ? l : 0]);
    engine->evaluate(b.memory);
    for (int l = 0; l < count; ++l)
        if (asked[l]->has_way)
            take_up_way(&b, l, asked[l]);
        else
            (void)project_lane(&b, l);
    engine->evaluate(b.memory);
    fst_status status = FST_OK;
    for (unsigned steps = 1; status == FST_OK && step(&b); ++steps)
        if (progress && steps % STEPS_UNTOLD == 0) {
            for (int l = 0; l < count; ++l)
                keep_way(&b, l);
            status = fst_tell(progress, fraction_done(&b), NULL, error);
        }
    free(b.memory);
    return status;
}
