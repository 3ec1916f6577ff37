/* counter.c - the family of counter-rotating orbits. */
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

/* The first orbit found, and after it a symmetric one if there is any.  Other families branch off the symmetric
 * one; the first is kept in case it lies on none of these.  If no symmetric one is found, the one on which the
 * first orbit's curve ends takes its place.  `end`: where this part of the work ends. */
static fst_status first_orbits(fst_tracer *t, double end, fst_node start[2], int *count, fst_error *error)
{
    enum { TRIALS = 8 };
    static const double part[TRIALS] = {0.5, 0.25, 0.1, 0.75, 0.35, 0.05, 0.9, 0.02};
    const double lo = fmin(t->options->from, t->options->to), hi = fmax(t->options->from, t->options->to);
    const double given = fst_family_value(&t->family);
    fst_error why;
    memset(&why, 0, sizeof why);
    *count = 0;
    for (int i = -1; i < TRIALS && *count < 2 && t->watch.status == FST_OK; ++i) {
        const double value = i < 0 ? given : lo + (hi - lo) * part[i];
        fst_watch_part(&t->watch, end * (i + 1) / (TRIALS + 1), end * (i + 2) / (TRIALS + 1));
        if (!(value >= lo && value <= hi) || !search_at(t, value, &start[*count], &why))
            continue;
        if (start[*count].s.symmetric || *count == 0)
            *count += 1;
        if (start[*count - 1].s.symmetric)
            return fst_watch_ask(&t->watch, error);
    }
    if (*count > 0)
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

fst_status fst_follow_counter(fst_tracer *t, fst_error *error)
{
    fst_node start[2];
    int count;
    const double end = t->watch.share[1], searching = 0.1 * end;
    fst_status status = first_orbits(t, searching, start, &count, error);
    fst_watch_part(&t->watch, searching, end);
    for (int i = count - 1; i >= 0 && status == FST_OK; --i) {
        if (fst_branch_of_orbit(t->out, &start[i].seen) >= 0)
            continue;
        status = fst_tracer_add(t, &start[i], error);
        if (status == FST_OK)
            status = fst_tracer_run(t, error);
    }
    return status;
}
