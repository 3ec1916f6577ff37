/* curve.c - following a curve of equilibria or orbits over a parameter ("pseudo-arclength continuation").
 *
 * The solutions over a parameter p form curves.  Stepping in p would fail at a fold, where the curve turns
 * back.  So a step goes a length h along the curve's tangent, in the space of states, period and p together,
 * and Newton's method brings the guess back to the curve across that direction:
 *
 *       state |        guess
 *             |  here *--h--->.               a fold is passed      .--*--.
 *             |     .'        | Newton        like any other place:        \
 *             |   .'          * next                                        * p falls again
 *             | .'            |                                            /
 *             +------------------- p                                  *---'
 *
 * The guess is bent by as much as the tangent turned in the step before.  Families may lie close together, and
 * a step must not jump from one to another: it is taken only if Newton's method ended near the guess and the
 * tangent turned by little; otherwise h is halved.  Easy steps make h grow, hard ones make it shrink.  A step
 * that leaves the range of p is cut where it crosses the border, and the last point lies on the border exactly.
 * After each step special.c looks at what happened on the way; if what changed has no place on the way, the step has
 * left the curve through a gap that is short beside it, and is refused too.
 */
#include "orbit/curve.h"

#include <string.h>

#include "base/error.h"
#include "observe/marks.h"

#define SHORTEST_STEP 1e-7
/* A step on which what changed has no place is refused down to this length; then the curve is lost. */
#define SHORTEST_IN_DOUBT 1e-5
/* Dry friction: a step so short may stand before a kink of the curve, which is leapt over; and one so short does. */
#define STEP_NEAR_KINK 4e-3
#define STEP_AT_KINK 2e-4
#define LARGEST_SPIN 60.0
enum { MOST_NODES = 4000 };

/* ------------------------------------------------------------------ steps along the curve */

static double length_of(const fst_family *family, const fst_solution *s, const fst_direction *d)
{
    return sqrt(fst_direction_product(family, s, d, d));
}

/* Whether an orbit is one of half the period that is gone round twice. */
static int is_twice_round(const fst_solution *s)
{
    return s->segments >= 2 && !s->symmetric && fst_state_distance(s->y[0], s->y[s->segments / 2]) < 1e-6;
}

/* How a step goes: along the curve, over a kink that may be there, or over one that stands before it. */
typedef enum gait { STRIDE, HOP, LEAP } gait;

/* How far from the prediction, in lengths of the step, a solution may be, and to which cosine the tangent may have
 * turned: after one iteration, and in the end. */
static const double BOUNDS[][2][2] = {[STRIDE] = {{0.3, 0.94}, {0.25, 0.95}},
                                      [HOP] = {{1.2, 0.4}, {1.0, 0.5}},
                                      [LEAP] = {{3.0, -0.2}, {2.0, 0.0}}};

/* Whether what was found is the curve's continuation over a step of length h. */
static fst_status goes_on(const fst_family *family, const fst_node *here, const fst_solution *predicted,
                          const fst_solution *found, double h, const double bounds[2], fst_error *error)
{
    fst_direction miss;
    fst_direction_between(predicted, found, &miss);
    if (length_of(family, found, &miss) <= bounds[0] * h && is_twice_round(found) <= is_twice_round(&here->s) &&
        fst_direction_product(family, found, &found->tangent, &here->s.tangent) >= bounds[1])
        return FST_OK;
    return fst_fail(error, FST_NO_CONVERGENCE, "continuation", "a step of %.3g was too long at %.10g", h,
                    here->s.value);
}

/* One step of length h from `here` along its tangent, bent as the curve bent in the step before (`last`, NULL
 * at the start).  FST_NO_CONVERGENCE also where the solution found is not the curve's continuation: too far
 * from the prediction, or with a tangent of another direction. */
static fst_status try_step(const fst_curve *curve, const fst_node *last, const fst_node *here, double h,
                           gait how, fst_node *next, fst_error *error)
{
    const fst_family *family = curve->family;
    fst_direction way = here->s.tangent, miss;
    if (last && here->length > 0) {
        fst_direction bend;
        fst_direction_combine(&bend, 1.0 / here->length, &here->s.tangent, -1.0 / here->length,
                              &last->s.tangent);
        fst_direction_combine(&way, 1.0, &here->s.tangent, 0.5 * h, &bend);
    }
    fst_solution predicted = here->s;
    predicted.on_section = 0;
    fst_solution_move(&predicted, &way, h);
    fst_solution found = predicted;
    fst_status status = fst_solution_approach(family, &found, &here->s.tangent, error);
    if (status == FST_OK)
        status = goes_on(family, here, &predicted, &found, h, BOUNDS[how][0], error);
    if (status == FST_OK)
        status = fst_solution_correct(family, &found, &here->s.tangent, error);
    if (status == FST_OK)
        status = goes_on(family, here, &predicted, &found, h, BOUNDS[how][1], error);
    if (status != FST_OK)
        return status;
    const int iterations = found.iterations + (found.segments > 0);
    status = fst_node_make(family, &found, next, error);
    next->s.iterations = iterations;
    fst_direction_between(&here->s, &found, &miss);
    next->length = length_of(family, &found, &miss);
    return status;
}

/* Cut the step that left the range at its border: where the cubic between its ends crosses it, and then
 * exactly, the parameter fixed. */
static fst_status land_on(const fst_curve *curve, const fst_node *here, double border, fst_node *next,
                          fst_error *error)
{
    const fst_node past = *next;
    fst_direction keep, way;
    fst_solution s;
    double inside = 0.0, outside = 1.0;
    for (int i = 0; i < 40; ++i) {
        const double x = 0.5 * (inside + outside);
        fst_solution_between(here, &past, x, &s);
        if ((s.value > border) == (past.s.value > border))
            outside = x;
        else
            inside = x;
    }
    s.value = border;
    const fst_solution guess = s;
    memset(&keep, 0, sizeof keep);
    keep.value = curve->family->scale;
    fst_status status = fst_solution_correct(curve->family, &s, &keep, error);
    if (status != FST_OK)
        return status;
    fst_direction_between(&guess, &s, &way);
    if (length_of(curve->family, &s, &way) > 0.25 * past.length)
        return fst_fail(error, FST_NO_CONVERGENCE, "continuation", "a step to the border was too long at %.10g",
                        here->s.value);
    fst_direction_between(&here->s, &s, &way);
    if (fst_direction_product(curve->family, &s, &s.tangent, &way) < 0.0)
        fst_direction_scale(&s.tangent, -1.0);
    s.value = border;
    status = fst_node_make(curve->family, &s, next, error);
    next->length = length_of(curve->family, &s, &way);
    return status;
}

static int is_closed(const fst_curve *curve, const fst_node *start, const fst_node *here, double h)
{
    fst_direction way;
    fst_direction_between(&here->s, &start->s, &way);
    return length_of(curve->family, &here->s, &way) < h &&
           fabs(fst_direction_product(curve->family, &here->s, &here->s.tangent, &start->s.tangent)) > 0.9;
}

/* Whether the curve is at its end; curve->end then says why. */
static int has_ended(fst_curve *curve, const fst_node *start, const fst_node *here, int nodes, double h)
{
    if (here->s.segments > 0 && here->s.period > FST_LONGEST_PERIOD)
        fst_curve_end_set(&curve->end, FST_END_PERIOD,
                          "the period grows without bound (%.4g): the orbit runs into an equilibrium",
                          here->s.period);
    else if (here->seen.mean_r > FST_LARGEST_RADIUS)
        fst_curve_end_set(&curve->end, FST_END_RADIUS, "it has left the magnet's field: <r> = %.4g",
                          here->seen.mean_r);
    else if (here->s.segments == 0 && fabs(here->s.y[0][FST_WZ] - here->seen.omega) > LARGEST_SPIN)
        fst_curve_end_set(&curve->end, FST_END_SPIN,
                          "its spin grows without bound (W_z = %.4g) while n turns upright",
                          here->s.y[0][FST_WZ]);
    else if (here->s.segments == 0 && here->floats)
        fst_curve_end_set(&curve->end, FST_END_LIFTED,
                          "the bead lifts off the plate, and nothing rubs any more");
    else if (nodes >= MOST_NODES)
        fst_curve_end_set(&curve->end, FST_END_COUNT_LIMIT, "%d points were followed", nodes);
    else if (nodes > 8 && is_closed(curve, start, here, h))
        fst_curve_end_set(&curve->end, FST_END_CLOSED, "the branch closes on itself");
    else
        return 0;
    return 1;
}

/* Dry friction: over a kink of the curve, where an orbit gains or loses a rest or a flight, Newton's method finds the other
 * side from here, but no continuation does.  1 if there is one, at the distance *h, from `length` on. */
static int leap(const fst_curve *curve, const fst_node *here, gait how, double length, fst_node *next,
                double *h, int *left)
{
    fst_error ignored;
    for (int i = 0; i < (how == HOP ? 1 : 3); ++i, length *= 4.0) {
        if (try_step(curve, NULL, here, length, how, next, &ignored) != FST_OK ||
            (how == HOP ? here->captures == next->captures : here->captures == 0 && next->captures == 0) ||
            next->s.value > curve->to || next->s.value < curve->from)
            continue;
        *left = 0;
        *h = length;
        return 1;
    }
    return 0;
}

/* The next node, on the border if the step left the range (*left); the step is halved until it is found.  0
 * where none is. */
static int next_node(fst_curve *curve, const fst_node *last, const fst_node *here, double *h, fst_node *next,
                     int *left)
{
    fst_error why;
    const double wanted = *h;
    const int kinks = fst_family_rests(curve->family) && here->s.segments > 0;
    for (int near = 0;;) {
        fst_status status = try_step(curve, last, here, *h, STRIDE, next, &why);
        *left = status == FST_OK && (next->s.value > curve->to || next->s.value < curve->from);
        if (*left)
            status = land_on(curve, here, next->s.value > curve->to ? curve->to : curve->from, next, &why);
        if (status == FST_OK)
            return 1;
        *h *= 0.5;
        if (*h < SHORTEST_STEP || fst_watch_ask(curve->family->watch, &why) != FST_OK)
            break;
        const int at = kinks && *h < STEP_AT_KINK;
        if (at || (kinks && !near && *h < STEP_NEAR_KINK)) {
            if (leap(curve, here, at ? LEAP : HOP, at ? 5.0 * STEP_AT_KINK : 2.0 * *h, next, h, left)) {
                *h = fmax(*h, 0.25 * wanted);
                return 1;
            }
            near = 1;
        }
        if (at)
            break;
    }
    if (here->s.segments == 0 && fst_family_rests(curve->family) && here->seen.slip < 1e-4)
        fst_curve_end_set(&curve->end, FST_END_ROLLS,
                          "its slip falls to nothing at %.10g: beyond, the bead rolls", here->s.value);
    else if (here->captures > 0)
        fst_curve_end_set(&curve->end, FST_END_LOST,
                          "it could not be followed beyond %.10g, where a slip may just come to rest, a rest "
                          "just begin, or a "
                          "flight just touch the plate, and the return jumps or bends",
                          here->s.value);
    else
        fst_curve_end_set(&curve->end, FST_END_LOST, "it could not be followed beyond %.10g: %.110s",
                          here->s.value, why.sentence);
    return 0;
}

/* A chain of states on the plate ends where a flight reaches one of them: the same orbit from another state, where
 * the bead stays on the plate for long.  1 if that is not the node that was. */
static int begin_elsewhere(fst_curve *curve, fst_node *here)
{
    const fst_family *family = curve->family;
    const fst_direction was = here->s.tangent;
    fst_direction keep = {.value = family->scale};
    fst_solution s = here->s;
    fst_node moved;
    fst_error ignored;
    if (here->s.segments == 0 || fst_solution_keep_to_plate(family, &s, &ignored) != FST_OK ||
        fst_state_distance(s.y[0], here->s.y[0]) < STEP_AT_KINK ||
        fst_solution_chain(family, &s, s.symmetric ? 1 : 2, &ignored) != FST_OK ||
        fst_solution_correct(family, &s, &keep, &ignored) != FST_OK)
        return 0;
    if (s.tangent.value * was.value + 0.0025 * family->scale * s.tangent.period * was.period < 0.0)
        fst_direction_scale(&s.tangent, -1.0);
    if (fst_node_make(family, &s, &moved, &ignored) != FST_OK)
        return 0;
    *here = moved;
    curve->end = (fst_curve_end){.type = FST_END_NONE};
    return 1;
}

static fst_status follow(fst_curve *curve, const fst_node *start, int sign, fst_error *error)
{
    fst_node last, here = *start, next;
    /* Points of equilibria cost next to nothing, and their pairs cross the axis one soon after another. */
    const double density = start->s.segments > 0 ? 1.0 : 0.04;
    double longest = density * curve->longest_step, h = 0.1 * longest;
    int nodes = 0, moved = 0;
    fst_direction_scale(&here.s.tangent, sign);
    here.length = 0.0;
    for (;;) {
        int left;
        const int bent = nodes > 0 && !moved && last.captures == here.captures; /* as in the step before */
        const int found = next_node(curve, bent ? &last : NULL, &here, &h, &next, &left);
        if (!found && !moved && begin_elsewhere(curve, &here)) {
            moved = 1;
            h = 0.1 * longest;
            continue;
        }
        if (!found)
            return nodes > 0 && here.s.segments > 0
                       ? fst_look_for_hopf_end(curve->family, &curve->sink, &last, &here, &curve->end, error)
                       : FST_OK;
        fst_status status = fst_specials_between(curve->family, &curve->sink, &here, &next, &curve->end, error);
        if (status == FST_OK && curve->end.type == FST_END_LOST && h > SHORTEST_IN_DOUBT) {
            curve->end = (fst_curve_end){.type = FST_END_NONE};
            h = 0.5 * fmin(h, next.length);
            continue;
        }
        if (status == FST_OK && curve->end.type == FST_END_NONE)
            status = curve->sink.node(curve->sink.user, &next, error);
        if (status != FST_OK || curve->end.type != FST_END_NONE)
            return status;
        if (left) {
            fst_curve_end_set(&curve->end, FST_END_RANGE, "the end of the range");
            return FST_OK;
        }
        const int iterations = next.s.iterations;
        last = here;
        here = next;
        moved = 0;
        nodes += 1;
        if (has_ended(curve, start, &here, nodes, h))
            return FST_OK;
        if (here.s.segments == 0) /* fast spins: in proportion */
            longest = density * curve->longest_step * (1.0 + fabs(here.s.y[0][FST_WZ]));
        const int easy = fst_family_rests(curve->family) ? 4 : 3; /* columns are less exact where it rests */
        h *= iterations <= easy ? 1.6 : iterations > easy + 2 ? 0.6 : 1.0;
        h = h > longest ? longest : h;
    }
}

/* A curve that the caller stopped looks as if it could not be followed: it gets no end. */
fst_status fst_curve_follow(fst_curve *curve, const fst_node *start, int sign, fst_error *error)
{
    curve->end = (fst_curve_end){.type = FST_END_NONE};
    const fst_status status = follow(curve, start, sign, error);
    return status == FST_OK ? fst_watch_ask(curve->family->watch, error) : status;
}
