/* describe.c - means, extremes and shape of an orbit: it is followed once round, observed by a window that
 * spans it.
 *
 * The window, its integrals and its extremes are those of a run (observe/), begun at the orbit's first state
 * and ended after its period.  So means of orbits and of runs are the same numbers, made by the same code;
 * those of an orbit are over exactly one period.  A symmetric orbit is followed over both halves.
 *
 *      r |    .-.                   .-
 *        |   /   \      .-.        /       two falls a period, each from a top to the next bottom:
 *        |  /     \    /   \      /        swing_ratio = greater fall/smaller fall - 1;
 *        | /       '--'     \    /         the lowest bottom is the closest approach to the axis
 *        |                   '--'
 *        +------------------------------ t
 *
 * Besides, three things are noted on the way:
 *
 * How often Phi turns in the period.  If it does not, the orbit is called librating, otherwise counter-rotating
 * or corotating by the sign of <alpha'>.
 *
 * The closest approach to the axis, positive or negative by the side on which the bead passes it.  r itself
 * only touches zero, but this number changes its sign, so the passage can be located (special_test.c).
 *
 * The state where Phi passes pi/2 downward.  The public description of an orbit that turns begins there,
 * corrected once more by Newton's method, so that the same orbit always has the same state.
 */
#include "orbit/describe.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/festoons.h"
#include "observe/means.h"
#include "ode/flight.h"
#include "study/conclude.h"

/* Distance from the axis where r is least, with the side on which the axis lies. */
static double signed_distance(const fst_flow *flow, const double *y)
{
    const double vx = y[FST_VX] + flow->step.omega * y[FST_Y], vy = y[FST_VY] - flow->step.omega * y[FST_X];
    const double speed = hypot(vx, vy);
    return speed > 0 ? (y[FST_Y] * vx - y[FST_X] * vy) / speed : hypot(y[FST_X], y[FST_Y]);
}

/* The extremes of r in their order; `count` goes on beyond those that are kept. */
typedef struct extremes {
    double r[4];
    int is_top[4];
    int count;
} extremes_of_r;

static void note_extreme(extremes_of_r *e, fst_flow *flow, double before, double after)
{
    if ((before > 0) == (after > 0))
        return;
    if (e->count < 4) {
        double y[FST_STATE_SIZE];
        fst_flow_at(flow, fst_flow_locate(flow, fst_radial_function, 0.0, 1.0, before, after), y);
        e->r[e->count] = hypot(y[FST_X], y[FST_Y]);
        e->is_top[e->count] = before > 0;
    }
    e->count += 1;
}

/* The larger of two falls, each from a top to the next bottom, over the other one, minus 1. */
static double swing_ratio(const extremes_of_r *e)
{
    if (e->count != 4)
        return NAN;
    const int top = e->is_top[0] ? 0 : 1;
    const double one = e->r[top] - e->r[top + 1], other = e->r[top + 2] - e->r[(top + 3) % 4];
    return fmax(one, other) / fmin(one, other) - 1.0;
}

/* Look for the closest approach and the passage of the section in the flow's last step. */
static void look_at_step(fst_flow *flow, extremes_of_r *e, fst_description *out)
{
    const double *start = flow->step.y, *end = flow->step.end;
    const double before = fst_radial_function(flow, start, NULL), after = fst_radial_function(flow, end, NULL);
    double y[FST_STATE_SIZE];
    note_extreme(e, flow, before, after);
    if (before < 0 && after >= 0) {
        const double x = fst_flow_locate(flow, fst_radial_function, 0.0, 1.0, before, after);
        fst_flow_at(flow, x, y);
        const double distance = signed_distance(flow, y);
        if (!(fabs(distance) >= fabs(out->closest)))
            out->closest = distance;
    }
    if (!out->has_section && !fst_flight_is_on(flow) && start[FST_X] < 0 && end[FST_X] >= 0) {
        const double x = fst_flow_locate(flow, fst_section_function, 0.0, 1.0, start[FST_X], end[FST_X]);
        fst_flow_at(flow, x, y);
        if (y[FST_Y] > 0) {
            memcpy(out->section, y, sizeof y);
            out->has_section = 1;
        }
    }
}

/* An orbit on its way round. */
typedef struct round_trip {
    fst_params params;
    fst_model *model;
    fst_flow *flow;
    double changed; /* when the contact began to slip, rest or fly; NAN: before the start */
    fst_window window;
    fst_mark_series ends; /* marks of the orbit's start and end, between which the means are taken */
    extremes_of_r extremes_met;
} round_trip;

static void mark_end(round_trip *trip)
{
    fst_mark mark;
    fst_mark_take(&mark, &trip->window.quadrature, trip->flow, 1.0, 1);
    fst_marks_offer(&trip->ends, &mark);
}

/* Whether a contact slips in that mode: one that begins to slip or creeps does. */
static int slips(int mode)
{
    return mode == FST_MODE_SLIP || mode == FST_MODE_ONSET || mode == FST_MODE_CREEP;
}

/* Look for the end of a slip, a rest or a flight in the flow's last step. */
static void note_change(round_trip *trip, fst_description *out)
{
    const int next = trip->flow->contact.slip.next;
    if (next < 0 || (slips(fst_contact_mode(trip->flow)) && slips(next)))
        return;
    out->shortest = fmin(out->shortest, trip->flow->t.high - trip->changed);
    trip->changed = trip->flow->t.high;
}

/* An orbit means nothing where the field is not known. */
static fst_status stay_on_map(fst_flow *flow, fst_error *error)
{
    double x;
    if (isinf(flow->groups.map_radius) || !fst_flow_first_negative(flow, fst_map_function, 0.0, &x))
        return FST_OK;
    return fst_fail(
        error, FST_NO_CONVERGENCE, "orbit",
        "the orbit leaves the map of magnet.file, which covers a disc of r = %.6g about the axis: the field "
        "beyond is not known",
        flow->groups.map_radius);
}

/* Follow the orbit once round; `extremes`: locate them too. */
static fst_status go_round(round_trip *trip, const fst_family *family, double period, int extremes,
                           fst_description *out, fst_error *error)
{
    fst_window *window = &trip->window;
    const fst_twofold end = {period, 0.0};
    const fst_span span = {.from = 0.0, .until = period};
    fst_status status = FST_OK;
    fst_window_begin(window, &span, fst_drive_period_double(trip->model->groups.omega), trip->flow);
    fst_marks_begin(&trip->ends);
    mark_end(trip);
    while (status == FST_OK && fst_twofold_difference(end, trip->flow->t) > 0) {
        status = fst_flow_step(trip->flow, end.high, error);
        if (status == FST_OK)
            status = fst_watch_count(family->watch, 2 * FST_FLOW_STEP_WORK, error);
        if (status == FST_OK)
            status = stay_on_map(trip->flow, error);
        if (status != FST_OK)
            return status;
        fst_quadrature_step(&window->quadrature, trip->flow, trip->flow->accepted == 1);
        fst_quadrature_resolve(&window->quadrature, trip->flow);
        if (extremes)
            fst_extremes_step(window->extremes, &window->quadrature, trip->flow, 0.0);
        look_at_step(trip->flow, &trip->extremes_met, out);
        note_change(trip, out);
        out->flights += !fst_flight_is_on(trip->flow) && trip->flow->contact.slip.next == FST_MODE_FLIGHT;
    }
    mark_end(trip);
    return status;
}

static void conclude(const round_trip *trip, const fst_solution *s, fst_description *out)
{
    const fst_mark *first = &trip->ends.kept[0], *last = &trip->ends.latest;
    const fst_groups *groups = &trip->model->groups;
    const double turned = (last->bead_angle - first->bead_angle) / FST_TWO_PI, omega = groups->omega;
    out->turns = (int)floor(turned + 0.5);
    fst_run_result *means = &out->means;
    fst_means_fill(&trip->window, &trip->ends, &trip->params, means);
    means->omega = omega;
    means->frequency_hz = omega / (FST_TWO_PI * groups->time_unit);
    means->period = fst_whole_period(s);
    means->mean_alpha_dot = omega + FST_TWO_PI * out->turns / means->period;
    if (s->symmetric)
        means->mean_nz = 0.0; /* exactly: the two halves cancel */
    means->symmetry = s->symmetric ? FST_SYMMETRY_S2 : out->turns ? FST_SYMMETRY_S1 : FST_SYMMETRY_NONE;
    means->regime = out->turns == 0             ? FST_REGIME_LIBRATING
                    : means->mean_alpha_dot < 0 ? FST_REGIME_COUNTER_ROTATING
                                                : FST_REGIME_COROTATING;
    if (out->turns)
        means->festoons = fst_festoons_a_lap(s->symmetric ? 2 : 1, omega, means->mean_alpha_dot);
    out->swing_ratio = out->turns == 0                                 ? NAN
                       : s->symmetric && trip->extremes_met.count == 4 ? 0.0
                                                                       : swing_ratio(&trip->extremes_met);
    out->captures = (int)trip->flow->contact.captures;
    if (trip->model->world.kinds.dry && out->turns != 0)
        means->captures_per_return = (double)out->captures / abs(out->turns);
    out->least_load = trip->window.extremes[FST_TRACK_LOAD].least;
}

fst_status fst_describe_orbit(const fst_family *family, const fst_solution *s, int extremes,
                              fst_description *out, fst_error *error)
{
    memset(out, 0, sizeof *out);
    fst_result_clear(&out->means);
    out->closest = NAN;
    out->shortest = INFINITY;
    round_trip *trip = calloc(1, sizeof *trip);
    if (!trip)
        return fst_watch_end(family->watch,
                             fst_fail(error, FST_NO_MEMORY, "fst_describe_orbit", "out of memory"), error);
    trip->params = fst_family_params(family, s->value);
    trip->changed = NAN;
    fst_status status =
        fst_solution_flow(family, s->value, s->y[0], family->tolerance, &trip->model, &trip->flow, error);
    if (status == FST_OK)
        status = go_round(trip, family, fst_whole_period(s), extremes, out, error);
    if (status == FST_OK)
        conclude(trip, s, out);
    fst_flow_free(trip->flow);
    fst_model_free(trip->model);
    free(trip);
    return status;
}

void fst_orbit_fill(const fst_description *d, const fst_solution *at, fst_orbit *orbit)
{
    orbit->means = d->means;
    orbit->means.period = fst_whole_period(at);
    orbit->symmetry = d->means.symmetry;
    orbit->turns = d->turns;
    orbit->stable = fst_solution_is_stable(at);
    orbit->residual = at->residual;
    orbit->relaxation_time = fst_solution_relaxation(at);
    orbit->swing_ratio = d->swing_ratio;
    orbit->trivial_error = at->trivial_error;
    memcpy(orbit->multiplier_re, at->re, sizeof orbit->multiplier_re);
    memcpy(orbit->multiplier_im, at->im, sizeof orbit->multiplier_im);
    memcpy(orbit->state, at->y[0], sizeof orbit->state);
}

fst_status fst_orbit_from_solution(const fst_family *family, const fst_solution *s, fst_orbit *orbit,
                                   fst_error *error)
{
    memset(orbit, 0, sizeof *orbit);
    fst_solution at = *s;
    fst_description d;
    fst_status status = fst_describe_orbit(family, &at, 0, &d, error);
    if (status == FST_OK && d.turns != 0 && d.has_section) {
        memcpy(at.y[0], d.section, sizeof d.section);
        at.y[0][FST_X] = 0.0;
        at.on_section = 1;
        fst_family fixed = *family; /* the parameter stays */
        fixed.key = -1;
        fixed.params = fst_family_params(family, s->value);
        status = fst_solution_chain(&fixed, &at, at.segments, error);
        if (status == FST_OK)
            status = fst_solution_correct(&fixed, &at, NULL, error);
        if (status == FST_OK)
            status = fst_solution_spectrum(&fixed, &at, error);
    }
    if (status == FST_OK && !fst_solution_moves(family, &at))
        status =
            fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                     "what was found at %.10g stands still in the turning frame, or does not repeat itself "
                     "(the flow direction is mapped onto itself to %.2g)",
                     at.value, at.trivial_error);
    if (status == FST_OK)
        status = fst_describe_orbit(family, &at, 1, &d, error);
    if (status != FST_OK)
        return status;
    fst_orbit_fill(&d, &at, orbit);
    return FST_OK;
}
