/* special_curve.c - the curve along which a special point moves when a second parameter changes.
 *
 * On the surface of solutions over two parameters a fold, a multiplier -1, a pair on the border or a passage of
 * the origin is the zero of one function, the test.  One step along its zero line:
 *
 *                                 1. Lagrange's formula through the last places (*) predicts one (o)
 *                         + next
 *       *-----*-----*     |       2. Newton's method brings it back to the surface
 *                     '.  | across
 *                       ' o       3. secants across the way find the zero of the test (+), each try brought
 *                                    back to the surface too
 *
 * The tangent plane at the latest place is turned so that one direction points along the predicted way and the
 * other across it; corrections by Newton's method stay perpendicular to both.  So the curve is parametrised by
 * its own length, and goes through its turns in either parameter, and round cusps.
 *
 * Why secants, and not the test as one more equation of Newton's method: that would need the derivatives of
 * multipliers, which are second derivatives of the flow.  A secant needs values alone, and the slope across the
 * curve is a good first guess from step to step.
 *
 * Steps grow after few tries and shrink after many; one that fails or turns too sharply is halved.  To begin,
 * the gradient of the test in the tangent plane is taken by differences: the curve starts at right angles to
 * it, and is followed both ways.  A step that leaves the range is shortened until it ends on its border.
 */
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "orbit/branch_list.h"
#include "orbit/special_curve.h"
#include "orbit/special_test.h"
#include "orbit/surface.h"

#define SHORTEST_STEP 1e-6
#define LEAST_FREQUENCY 2e-3
enum { HISTORY = 3, MOST_PLACES = 1000, MOST_SECANTS = 12 };

typedef struct walk {
    const fst_branch_options *options;
    fst_surface surface;
    fst_watch *watch;
    fst_special_type type;
    double angle;            /* of the critical pair: its frequency, or that on the unit circle */
    fst_place past[HISTORY]; /* the latest places, the last one first */
    double length[HISTORY];  /* of the curve from each to the latest, falling from 0 */
    int known;               /* of them */
    double slope;            /* of the test across the curve, at the latest place; 0: not known */
    fst_heading way;         /* along the curve at the first place */
    fst_curve_end end;
} walk;

/* ------------------------------------------------------------------ tests */

static int is_pair(const walk *w)
{
    return w->type == FST_SPECIAL_HOPF || w->type == FST_SPECIAL_NEIMARK_SACKER;
}

/* The pair whose frequency (angle of a multiplier) is the nearest to the last one: how far it is from the
 * border.  -1 in *angle: no such place. */
static double pair_test(const fst_solution *s, double *angle)
{
    int best = -1;
    double least = INFINITY, wanted = *angle;
    for (int i = 0; i < s->multipliers; ++i) {
        const double here = s->segments > 0 ? atan2(s->im[i], s->re[i]) : s->im[i];
        /* of an orbit's pairs only those near the circle */
        const double off = s->segments > 0 ? fabs(hypot(s->re[i], s->im[i]) - 1.0) : fabs(s->re[i]);
        const double miss = fabs(here - wanted) + off;
        if (s->im[i] > 1e-9 && miss < least)
            best = i, least = miss, *angle = here;
    }
    if (best < 0) {
        *angle = -1.0;
        return NAN;
    }
    return s->segments > 0 ? s->re[best] * s->re[best] + s->im[best] * s->im[best] - 1.0 : s->re[best];
}

static fst_status test_at(const walk *w, const fst_place *p, double *value, fst_error *error)
{
    fst_node node;
    fst_description seen;
    const fst_family family = fst_surface_first(&w->surface, p->second);
    double angle = w->angle;
    switch (w->type) {
    case FST_SPECIAL_FOLD:
        *value = p->shadow;
        break;
    case FST_SPECIAL_PITCHFORK:
    case FST_SPECIAL_PERIOD_DOUBLING:
        node.s = p->s;
        *value = fst_test_value(&node, FST_TEST_MINUS);
        break;
    case FST_SPECIAL_ORIGIN_CROSSING: {
        const fst_status status = fst_describe_orbit(&family, &p->s, 0, &seen, error);
        if (status != FST_OK)
            return status;
        *value = seen.closest;
        break;
    }
    default:
        *value = pair_test(&p->s, &angle);
    }
    return isfinite(*value) ? FST_OK
                            : fst_fail(error, FST_NO_CONVERGENCE, "special curve",
                                       "a test is undefined at %.10g, %.10g", p->s.value, p->second);
}

/* ------------------------------------------------------------------ one step */

/* A place near `from`, moved by `heading` and brought back to the surface, with the test there. */
static fst_status try_place(const walk *w, const fst_place *from, const fst_heading *heading, double length,
                            const fst_heading across[2], fst_place *out, double *test, fst_error *error)
{
    *out = *from;
    fst_place_move(out, heading, length);
    const fst_status status = fst_place_correct(&w->surface, out, across, error);
    return status == FST_OK ? test_at(w, out, test, error) : status;
}

/* Where the curve would be `h` on: Lagrange's formula through the known places. */
static void predict(const walk *w, double h, fst_heading *out)
{
    memset(out, 0, sizeof *out);
    if (w->known < 2) {
        fst_heading_combine(out, h, &w->way, 0.0, &w->way);
        return;
    }
    for (int i = 1; i < w->known; ++i) {
        double weight = 1.0;
        for (int j = 0; j < w->known; ++j)
            if (j != i)
                weight *= (h - w->length[j]) / (w->length[i] - w->length[j]);
        fst_heading to;
        fst_heading_between(&w->past[0], &w->past[i], &to);
        fst_heading_combine(out, 1.0, out, weight, &to);
    }
}

/* The plane at the latest place, turned so that its first direction is along the predicted way. */
static int turn_plane(const walk *w, const fst_heading *way, fst_heading across[2])
{
    const fst_place *here = &w->past[0];
    const double a = fst_heading_product(&w->surface, &here->s, way, &here->plane[0]);
    const double b = fst_heading_product(&w->surface, &here->s, way, &here->plane[1]);
    const double length = hypot(a, b);
    if (!(length > 0))
        return 0;
    fst_heading_combine(&across[0], a / length, &here->plane[0], b / length, &here->plane[1]);
    fst_heading_combine(&across[1], -b / length, &here->plane[0], a / length, &here->plane[1]);
    return 1;
}

/* From a place near the curve, with its test, to the zero of the test, by secants along across[1]. */
static fst_status close_in(walk *w, fst_place *place, double test, const fst_heading across[2], double reach,
                           int *tries, fst_error *error)
{
    double off = 0.0, before = INFINITY, slope = w->slope;
    for (*tries = 1; *tries <= MOST_SECANTS; ++*tries) {
        const double step = slope != 0.0 ? -test / slope : 1e-4;
        if (!(fabs(off + step) <= reach))
            return fst_fail(error, FST_NO_CONVERGENCE, "special curve", "a step was too long at %.10g, %.10g",
                            place->s.value, place->second);
        fst_place next;
        double value;
        const fst_status status = try_place(w, place, &across[1], step, across, &next, &value, error);
        if (status != FST_OK)
            return status;
        if (value != test)
            slope = (value - test) / step;
        off += step;
        *place = next;
        test = value;
        const double rest = fabs(test / slope);
        if (rest < 1e-12 || (rest < 1e-9 && rest > 0.2 * before)) {
            w->slope = slope;
            return FST_OK;
        }
        before = rest;
    }
    return fst_fail(error, FST_NO_CONVERGENCE, "special curve", "the test did not vanish near %.10g, %.10g",
                    place->s.value, place->second);
}

static fst_status take_step(walk *w, double h, fst_place *next, int *tries, fst_error *error)
{
    fst_heading way, across[2], moved;
    double test;
    predict(w, h, &way);
    if (!turn_plane(w, &way, across))
        return fst_fail(error, FST_NO_CONVERGENCE, "special curve", "no way on");
    fst_status status = try_place(w, &w->past[0], &way, 1.0, across, next, &test, error);
    const double kept = w->slope;
    if (status == FST_OK)
        status = close_in(w, next, test, across, 0.3 * h + 2e-4, tries, error);
    if (status == FST_OK) {
        fst_heading_between(&w->past[0], next, &moved);
        const double along = fst_heading_product(&w->surface, &next->s, &moved, &across[0]);
        const double size = sqrt(fst_heading_product(&w->surface, &next->s, &moved, &moved));
        if (!(along > 0.8 * size))
            status = fst_fail(error, FST_NO_CONVERGENCE, "special curve", "a step turned too sharply");
    }
    if (status != FST_OK)
        w->slope = kept;
    return status;
}

static void remember(walk *w, const fst_place *next)
{
    fst_heading moved;
    fst_heading_between(&w->past[0], next, &moved);
    const double length = sqrt(fst_heading_product(&w->surface, &next->s, &moved, &moved));
    memmove(w->past + 1, w->past, (HISTORY - 1) * sizeof *w->past);
    memmove(w->length + 1, w->length, (HISTORY - 1) * sizeof *w->length);
    w->past[0] = *next;
    w->length[0] = 0.0;
    w->known += w->known < HISTORY;
    for (int i = 1; i < w->known; ++i)
        w->length[i] -= length;
    if (is_pair(w))
        (void)pair_test(&next->s, &w->angle);
}

/* ------------------------------------------------------------------ beginning */

/* Derivatives of the test along the two directions of the plane at the first place; their root of squares. */
static double gradient_at(const walk *w, double gradient[2])
{
    const fst_place *first = &w->past[0];
    const double step = 2e-4;
    fst_place beside;
    fst_error ignored;
    for (int i = 0; i < 2; ++i) {
        double above, below;
        if (try_place(w, first, &first->plane[i], step, first->plane, &beside, &above, &ignored) != FST_OK ||
            try_place(w, first, &first->plane[i], -step, first->plane, &beside, &below, &ignored) != FST_OK)
            return 0.0;
        gradient[i] = (above - below) / (2.0 * step);
    }
    return hypot(gradient[0], gradient[1]);
}

/* Which pair on the border is the critical one: that which leaves it.  (On the axis n swings about the vertical
 * without friction, and that pair stays on the border everywhere.) */
static double pair_gradient(walk *w, double gradient[2])
{
    const fst_solution *s = &w->past[0].s;
    double greatest = 0.0, best = 0.0;
    for (int i = 0; i < s->multipliers; ++i) {
        const double off = s->segments > 0 ? hypot(s->re[i], s->im[i]) - 1.0 : s->re[i];
        double here[2];
        if (!(s->im[i] > 1e-9 && fabs(off) < 1e-6))
            continue;
        w->angle = s->segments > 0 ? atan2(s->im[i], s->re[i]) : s->im[i];
        const double size = gradient_at(w, here);
        if (size > greatest) {
            greatest = size;
            best = w->angle;
            memcpy(gradient, here, sizeof here);
        }
    }
    w->angle = best;
    return greatest;
}

/* The place of a special point, and the way along its curve: across the gradient of the test. */
static fst_status begin(walk *w, const fst_node *start, fst_error *error)
{
    fst_place *first = &w->past[0];
    fst_heading across[2];
    double gradient[2];
    memset(across, 0, sizeof across);
    memset(first, 0, sizeof *first);
    first->s = start->s;
    first->s.on_section = 0;
    first->second = fst_family_value(&w->surface.second);
    across[0].d = start->s.tangent;
    across[1].second = w->surface.second.scale;
    const fst_status status = fst_place_correct(&w->surface, first, across, error);
    if (status != FST_OK)
        return status;
    const double size = is_pair(w) ? pair_gradient(w, gradient) : gradient_at(w, gradient);
    if (!(size > 1e-9))
        return fst_fail(error, FST_NO_CONVERGENCE, "special curve", "the test is flat at %.10g",
                        first->s.value);
    fst_heading_combine(&w->way, -gradient[1] / size, &first->plane[0], gradient[0] / size, &first->plane[1]);
    w->slope = -size; /* across the way, which has the gradient on its right */
    return FST_OK;
}

/* ------------------------------------------------------------------ along the curve */

/* Whether it attracts but for what is critical. */
static int stable_but_for(const walk *w, const fst_solution *s)
{
    const int orbit = s->segments > 0;
    const double target = w->type == FST_SPECIAL_FOLD ? (orbit ? 1.0 : 0.0) : -1.0;
    const int pair = is_pair(w);
    int critical = -1;
    double least = w->type == FST_SPECIAL_ORIGIN_CROSSING ? 0.0 : INFINITY;
    for (int i = 0; i < s->multipliers; ++i) {
        const double angle = orbit ? atan2(fabs(s->im[i]), s->re[i]) : fabs(s->im[i]);
        const double off = orbit ? fabs(hypot(s->re[i], s->im[i]) - 1.0) : fabs(s->re[i]);
        const double miss = pair ? fabs(angle - w->angle) + off : hypot(s->re[i] - target, s->im[i]);
        if (miss < least)
            critical = i, least = miss;
    }
    for (int i = 0; i < s->multipliers; ++i) {
        const int twin =
            pair && critical >= 0 && s->re[i] == s->re[critical] && fabs(s->im[i]) == fabs(s->im[critical]);
        if (i != critical && !twin && (orbit ? hypot(s->re[i], s->im[i]) >= 1.0 : s->re[i] > -1e-13))
            return 0;
    }
    return 1;
}

static fst_status report(const walk *w, const fst_place *p, int branch, fst_branch *out, fst_error *error)
{
    fst_node node;
    const fst_family family = fst_surface_first(&w->surface, p->second);
    const fst_status status = fst_node_make(&family, &p->s, &node, error);
    if (status != FST_OK)
        return status;
    node.seen.second = p->second;
    node.seen.stable = stable_but_for(w, &node.s);
    return fst_branch_add_point(out, &node.seen, branch, error);
}

/* How far a place lies outside of the ranges, in parts of the worse one; negative inside. */
static double excess(const walk *w, const fst_place *p, const char **key)
{
    const fst_branch_options *o = w->options;
    const double lo = fmin(o->from, o->to), hi = fmax(o->from, o->to);
    const double second_lo = fmin(o->second_from, o->second_to), second_hi = fmax(o->second_from, o->second_to);
    const double first = fmax(p->s.value - hi, lo - p->s.value) / (hi - lo);
    const double second = fmax(p->second - second_hi, second_lo - p->second) / (second_hi - second_lo);
    *key = first > second ? o->key : o->second_key;
    return fmax(first, second);
}

/* The step of length h that led out of the range again, so much shorter that it ends on the border. */
static int land(walk *w, double h, fst_place *next)
{
    const char *key;
    fst_error ignored;
    double length[2] = {0.0, h}, off[2] = {excess(w, &w->past[0], &key), excess(w, next, &key)};
    int tries;
    fst_curve_end_set(&w->end, FST_END_RANGE, "the end of the range of %s", key);
    for (int i = 0; i < MOST_SECANTS && fabs(off[1]) > 1e-10; ++i) {
        const double shorter = length[1] - off[1] * (length[1] - length[0]) / (off[1] - off[0]);
        length[0] = length[1];
        off[0] = off[1];
        length[1] = shorter;
        if (!(shorter > 0 && shorter <= h) || take_step(w, shorter, next, &tries, &ignored) != FST_OK)
            return 0;
        off[1] = excess(w, next, &key);
    }
    return fabs(off[1]) < 1e-8;
}

static int has_ended(walk *w, const fst_place *start, int places, double h)
{
    const fst_place *here = &w->past[0];
    const int pair = is_pair(w);
    fst_heading way;
    fst_heading_between(start, here, &way);
    if (here->s.segments > 0 && here->s.period > FST_LONGEST_PERIOD)
        fst_curve_end_set(&w->end, FST_END_PERIOD, "the period grows without bound (%.4g)", here->s.period);
    else if (hypot(here->s.y[0][FST_X], here->s.y[0][FST_Y]) > FST_LARGEST_RADIUS)
        fst_curve_end_set(&w->end, FST_END_RADIUS, "it has left the magnet's field");
    else if (pair &&
             (w->angle < LEAST_FREQUENCY || (here->s.segments > 0 && w->angle > FST_PI - LEAST_FREQUENCY)))
        fst_curve_end_set(&w->end, FST_END_REAL_AXIS, "the critical pair meets on the real axis");
    else if (places >= MOST_PLACES)
        fst_curve_end_set(&w->end, FST_END_COUNT_LIMIT, "%d points were followed", places);
    else if (places > 8 && sqrt(fst_heading_product(&w->surface, &here->s, &way, &way)) < h)
        fst_curve_end_set(&w->end, FST_END_CLOSED, "the curve closes on itself");
    else
        return 0;
    return 1;
}

/* Under dry friction the multipliers of an orbit jump where it gains or loses a rest or a flight, so that the curve
 * ends: whether they do so right beyond the last place, on the surface of solutions, which goes on. */
static int ends_at_grazing(const walk *w, const fst_place *last)
{
    const fst_family family = fst_surface_first(&w->surface, last->second);
    fst_heading way, across[2];
    fst_node here, there;
    fst_error ignored;
    predict(w, SHORTEST_STEP, &way);
    if (!fst_family_rests(&family) || last->s.segments == 0 || !turn_plane(w, &way, across) ||
        fst_node_make(&family, &last->s, &here, &ignored) != FST_OK)
        return 0;
    for (double beyond = 2.0 * SHORTEST_STEP; beyond < 100.0 * SHORTEST_STEP; beyond *= 4.0) {
        fst_place next = *last;
        fst_place_move(&next, &across[0], beyond);
        if (fst_place_correct(&w->surface, &next, across, &ignored) != FST_OK)
            continue;
        const fst_family beside = fst_surface_first(&w->surface, next.second);
        if (fst_node_make(&beside, &next.s, &there, &ignored) == FST_OK && there.captures != here.captures)
            return 1;
    }
    return 0;
}

/* No further point was found: where, and why. */
static void lose(walk *w, const fst_error *why)
{
    const fst_place *last = &w->past[0];
    if (ends_at_grazing(w, last))
        fst_curve_end_set(&w->end, FST_END_LOST,
                          "at %.10g, %.10g the orbit gains or loses a rest or a flight (grazing), where its "
                          "multipliers jump",
                          last->s.value, last->second);
    else
        fst_curve_end_set(&w->end, FST_END_LOST, "it could not be followed beyond %.10g, %.10g: %.90s",
                          last->s.value, last->second, why->sentence);
}

/* One way along the curve from the first place. */
static fst_status walk_on(walk *w, int branch, fst_branch *out, fst_error *error)
{
    const fst_place start = w->past[0];
    const double longest = 0.2 * w->options->longest_step;
    double h = 0.1 * longest;
    fst_error why;
    int places = 0;
    for (;;) {
        fst_place next;
        const char *key, *border;
        int tries = 0;
        while (take_step(w, h, &next, &tries, &why) != FST_OK)
            if ((h *= 0.5) < SHORTEST_STEP) {
                lose(w, &why);
                return fst_watch_ask(w->watch, error);
            }
        const int left = excess(w, &next, &key) > 0;
        if (left && excess(w, &w->past[0], &border) > -1e-10) { /* it began on the border, and leads out */
            fst_curve_end_set(&w->end, FST_END_RANGE, "the end of the range of %s", key);
            return fst_watch_ask(w->watch, error);
        }
        if (left && !land(w, h, &next)) { /* the border is nearer to a smaller step */
            if ((h *= 0.5) >= SHORTEST_STEP)
                continue;
            fst_curve_end_set(&w->end, FST_END_LOST,
                              "the border of the range could not be reached from %.10g, %.10g",
                              w->past[0].s.value, w->past[0].second);
            return fst_watch_ask(w->watch, error);
        }
        remember(w, &next);
        fst_status status = report(w, &next, branch, out, error);
        fst_watch_reach(w->watch, places / (places + 20.0));
        if (status == FST_OK)
            status = fst_watch_ask(w->watch, error);
        if (status != FST_OK || left || has_ended(w, &start, places, h))
            return status;
        h *= tries <= 3 ? 1.5 : tries > 5 ? 0.6 : 1.0;
        h = h > longest ? longest : h;
        ++places;
    }
}

static fst_status begin_surface(walk *w, const fst_params *params, fst_error *error)
{
    const fst_branch_options *o = w->options;
    fst_status status = fst_family_begin(&w->surface.first, params, o->key, error);
    if (status == FST_OK)
        status = fst_family_begin(&w->surface.second, &w->surface.first.params, o->second_key, error);
    if (status != FST_OK)
        return status;
    if (!isfinite(fst_family_value(&w->surface.second)))
        return fst_fail(error, FST_BAD_INPUT, o->second_key, "%s has no value in this scene: give it one",
                        o->second_key);
    w->surface.first.params = w->surface.second.params; /* the other forms of both are cleared */
    w->surface.first.scale = fst_family_scale(o->key, o->from, o->to);
    w->surface.second.scale = fst_family_scale(o->second_key, o->second_from, o->second_to);
    w->surface.first.watch = w->surface.second.watch = w->watch;
    fst_family_tighten(&w->surface.first, o->tolerance);
    fst_family_tighten(&w->surface.second, o->tolerance);
    return FST_OK;
}

fst_status fst_special_curve_follow(const fst_branch_options *options, const fst_params *params,
                                    const fst_node *start, int branch, fst_watch *watch, fst_branch *out,
                                    fst_error *error)
{
    walk w;
    memset(&w, 0, sizeof w);
    w.watch = watch;
    w.options = options;
    w.type = options->special;
    fst_status status = begin_surface(&w, params, error);
    if (status != FST_OK)
        return status;
    const fst_status begun = begin(&w, start, error);
    status = fst_watch_ask(watch, error);
    if (status != FST_OK)
        return status;
    if (begun != FST_OK) {
        fst_curve_end_set(&w.end, FST_END_NOT_BEGUN,
                          "its curve could not be begun: the test is not regular here");
        return fst_branch_add_end(out, branch, -1, start->s.value, &w.end, error);
    }
    const size_t first = out->point_count;
    walk back = w;
    back.known = w.known = 1;
    fst_heading_combine(&back.way, -1.0, &w.way, 0.0, &w.way);
    back.slope = -w.slope;
    status = walk_on(&back, branch, out, error);
    fst_branch_reverse(out, first);
    if (status == FST_OK)
        status = fst_branch_add_end(out, branch, -1, back.past[0].s.value, &back.end, error);
    if (status == FST_OK)
        status = report(&w, &w.past[0], branch, out, error);
    if (status != FST_OK || back.end.type == FST_END_CLOSED)
        return status;
    status = walk_on(&w, branch, out, error);
    return status == FST_OK ? fst_branch_add_end(out, branch, -1, w.past[0].s.value, &w.end, error) : status;
}
