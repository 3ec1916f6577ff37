/* counter.c - the family of counter-rotating orbits.
 *
 * Under a magnet with the symmetry S2 the orbits without it come in pairs, images of each other, born at pitchforks
 * of symmetric ones: one branch leads to all.  Under a magnet without it a pitchfork falls apart: one branch passes,
 * and two that meet at a fold are connected with it by no curve.  Images of the first, which are nearly orbits, lead to
 * them, and so may runs at other values.
 *
 *       with S2:   __________o/----       without:   __________/----
 *                             \____                            (____
 */
#include "orbit/tracer.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "orbit/branch_list.h"
#include "orbit/search.h"

/* Search an orbit at one value; 1 if it counter-rotates. */
static int search_at(const fst_tracer *t, double value, fst_node *start, fst_error *why)
{
    fst_family fixed = t->family;
    fst_solution s;
    fixed.key = -1;
    fixed.params = fst_family_params(&t->family, value);
    fixed.params.run_periods = fmin(fst_run_periods(&fixed.params), 200.0);
    fixed.params.run_duration = NAN;
    fixed.params.run_discard = 0.0;
    fst_orbit_outcome outcome;
    if (fst_search_orbit(&fixed, &s, &outcome, why) != FST_OK)
        return 0;
    s.value = value;
    s.on_section = 0;
    if (fst_solution_correct(&t->family, &s, NULL, why) != FST_OK ||
        fst_node_make(&t->family, &s, start, why) != FST_OK)
        return 0;
    if (start->seen.turns < 0)
        return 1;
    (void)fst_fail(why, FST_NO_CONVERGENCE, "branch", "the orbit met at %s = %.10g %s", t->options->key, value,
                   start->seen.turns == 0 ? "librates" : "does not counter-rotate");
    return 0;
}

/* The symmetric orbit on which a curve of S1 orbits ends: followed there on trial. */
typedef struct climb {
    fst_node last;
    fst_watch *watch;
} climb;

static fst_status remember(void *user, const fst_node *node, fst_error *error)
{
    climb *c = user;
    c->last = *node;
    return fst_watch_ask(c->watch, error);
}

static void climb_to_symmetric(fst_tracer *t, fst_node *start)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        climb c = {*start, &t->watch};
        fst_error why;
        fst_curve curve = {.family = &t->family,
                           .from = fmin(t->options->from, t->options->to),
                           .to = fmax(t->options->from, t->options->to),
                           .longest_step = t->options->longest_step,
                           .sink = {&c, 0, remember, NULL}};
        if (fst_curve_follow(&curve, start, sign, &why) != FST_OK || curve.end.type != FST_END_SYMMETRIC_ORBIT)
            continue;
        fst_solution s = c.last.s;
        s.symmetric = 1;
        s.segments = 1;
        s.period *= 0.5;
        fst_node node;
        if (fst_solution_correct(&t->family, &s, NULL, &why) == FST_OK &&
            fst_node_make(&t->family, &s, &node, &why) == FST_OK) {
            *start = node;
            return;
        }
    }
}

/* Of a magnet with S2: the first orbit found, and after it a symmetric one if there is any.  Other families branch off
 * the symmetric one; the first is kept in case it lies on none of these.  If no symmetric one is found, the one on which
 * the first orbit's curve ends takes its place.  Of another magnet: every orbit found.  `end`: where this part of the
 * work ends. */
enum { TRIALS = 8, STARTS = TRIALS + 1 };
static fst_status first_orbits(fst_tracer *t, double end, fst_node start[STARTS], int *count, fst_error *error)
{
    static const double part[TRIALS] = {0.5, 0.25, 0.1, 0.75, 0.35, 0.05, 0.9, 0.02};
    const double lo = fmin(t->options->from, t->options->to), hi = fmax(t->options->from, t->options->to);
    const double given = fst_family_value(&t->family);
    const int most = t->family.has_s2 ? 2 : STARTS;
    fst_error why;
    memset(&why, 0, sizeof why);
    *count = 0;
    for (int i = -1; i < TRIALS && *count < most && t->watch.status == FST_OK; ++i) {
        const double value = i < 0 ? given : lo + (hi - lo) * part[i];
        fst_watch_part(&t->watch, end * (i + 1) / (TRIALS + 1), end * (i + 2) / (TRIALS + 1));
        if (!(value >= lo && value <= hi) || !search_at(t, value, &start[*count], &why))
            continue;
        if (start[*count].s.symmetric || *count == 0 || !t->family.has_s2)
            *count += 1;
        if (start[*count - 1].s.symmetric)
            return fst_watch_ask(&t->watch, error);
    }
    if (*count > 0 && t->family.has_s2)
        climb_to_symmetric(t, start);
    const fst_status status = fst_watch_ask(&t->watch, error);
    if (*count > 0 || status != FST_OK)
        return status;
    return fst_fail(
        error, FST_NO_CONVERGENCE, "branch",
        "no counter-rotating orbit was found between %.10g and %.10g from the scene's start; the last try: "
        "%.400s. Try another range or start.r",
        lo, hi, why.sentence);
}

static fst_status follow_from(fst_tracer *t, const fst_node *start, fst_error *error)
{
    if (fst_branch_of_orbit(t->out, &start->seen, t->family.has_s2) >= 0)
        return FST_OK;
    const fst_status status = fst_tracer_add(t, start, error);
    return status == FST_OK ? fst_tracer_run(t, error) : status;
}

/* The orbit of the magnet, which has not S2, beside the image of one. */
static int orbit_beside_image(const fst_tracer *t, const fst_branch_point *of, fst_node *node)
{
    fst_solution s;
    fst_error ignored;
    memset(&s, 0, sizeof s);
    s.value = of->value;
    s.period = of->period;
    fst_apply_s2(of->state, s.y[0]);
    return of->turns < 0 && fst_solution_chain(&t->family, &s, 2, &ignored) == FST_OK &&
           fst_solution_correct(&t->family, &s, NULL, &ignored) == FST_OK &&
           fst_node_make(&t->family, &s, node, &ignored) == FST_OK && node->seen.turns < 0;
}

/* Follow branches that images lead to, of some points of each branch that was not born on another; the new ones have
 * images too. */
static fst_status follow_images(fst_tracer *t, fst_error *error)
{
    enum { TRIED = 8 };
    fst_status status = FST_OK;
    for (size_t e = 0; e < t->out->end_count && t->branch_count < FST_PENDING && status == FST_OK; ++e) {
        const fst_branch_end end = t->out->ends[e];
        size_t first = 0, count = 0;
        for (size_t i = 0; i < t->out->point_count; ++i)
            if (t->out->points[i].branch == end.branch && count++ == 0)
                first = i;
        const int again = e > 0 && t->out->ends[e - 1].branch == end.branch;
        for (size_t k = 0; k < TRIED && end.family < 0 && !again && status == FST_OK; ++k) {
            fst_node node;
            const fst_branch_point at = t->out->points[first + (2 * k + 1) * count / (2 * TRIED)];
            if (orbit_beside_image(t, &at, &node))
                status = follow_from(t, &node, error);
            if (status == FST_OK)
                status = fst_watch_ask(&t->watch, error);
        }
    }
    return status;
}

fst_status fst_follow_counter(fst_tracer *t, fst_error *error)
{
    fst_node start[STARTS];
    int count;
    const double end = t->watch.share[1], searching = 0.1 * end;
    fst_status status = first_orbits(t, searching, start, &count, error);
    fst_watch_part(&t->watch, searching, end);
    for (int i = 0; i < count && status == FST_OK; ++i)
        status = follow_from(t, &start[t->family.has_s2 ? count - 1 - i : i], error);
    return status == FST_OK && !t->family.has_s2 ? follow_images(t, error) : status;
}
