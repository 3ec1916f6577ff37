/* tracer.c - following one branch after another. */
#include "orbit/tracer.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "orbit/branch_list.h"

/* ------------------------------------------------------------------ what a curve shows */

/* Tell the caller how far the work is; the answer.  Nobody knows how long a branch is: forty points are taken
 * for half of one. */
static fst_status tell_progress(fst_tracer *t, fst_error *error)
{
    const double part = (t->done + t->nodes / (t->nodes + 40.0)) / (t->pending_count ? t->pending_count : 1);
    (void)snprintf(t->what, sizeof t->what, "branch %d of %d, %s = %.5g", t->done + 1, t->pending_count,
                   t->options->key, t->last_value);
    t->watch.what = t->what;
    fst_watch_reach(&t->watch, part);
    return fst_watch_ask(&t->watch, error);
}

static fst_status take_node(void *user, const fst_node *node, fst_error *error)
{
    fst_tracer *t = user;
    t->nodes += 1;
    t->last_value = node->s.value;
    const fst_status status = tell_progress(t, error);
    return status == FST_OK ? fst_branch_add_point(t->out, &node->seen, t->branch, error) : status;
}

/* Dry friction: where an orbit repels on both sides of a special point, what is born there repels too, and so do most
 * of its children; their curves are long and dear, and no bead comes to them. */
static int is_worth_following(const fst_tracer *t, const fst_node *at)
{
    const double critical = 1e-3; /* a multiplier so near to the circle is the one that crosses it */
    if (t->options->kind != FST_BRANCH_COUNTER || !fst_family_rests(&t->family))
        return 1;
    for (int i = 0; i < at->s.multipliers; ++i)
        if (hypot(at->s.re[i], at->s.im[i]) > 1.0 + critical)
            return 0;
    return 1;
}

static fst_status take_special(void *user, fst_special_type type, const fst_node *at, int criticality,
                               const fst_node *born, fst_error *error)
{
    fst_tracer *t = user;
    const fst_status status = fst_watch_ask(&t->watch, error); /* what was stopped may be half known */
    if (status != FST_OK)
        return status;
    fst_special special;
    memset(&special, 0, sizeof special);
    special.type = type;
    special.value = at->s.value;
    special.omega = at->seen.omega;
    special.branch = t->branch;
    special.criticality = criticality;
    special.born = -1;
    special.at = at->seen;
    special.at.branch = t->branch;
    const int known = fst_branch_find_special(t->out, &special, t->family.scale);
    if (known >= 0 && type == FST_SPECIAL_HOPF)
        t->other = t->out->specials[known].branch;
    if (known >= 0)
        return FST_OK;
    if (t->options->second_key && type == t->options->special && t->start_count < FST_PENDING)
        t->starts[t->start_count++] = *at;
    if (born && t->pending_count < FST_PENDING && t->depth < 3 &&
        (type != FST_SPECIAL_HOPF || t->follow_hopf) && is_worth_following(t, at)) {
        special.born = t->branch_count;
        /* Through a transcritical point the other branch passes: it is followed both ways. */
        const int one_way = type != FST_SPECIAL_TRANSCRITICAL;
        t->pending[t->pending_count++] =
            (fst_pending){*born, t->branch_count, t->branch, t->depth + 1, one_way};
        t->branch_count += 1;
    }
    return fst_branch_add_special(t->out, &special, error);
}

/* ------------------------------------------------------------------ following */

/* Whether the branch born at a special point was met before, from its other end; the special point then names
 * it. */
static int was_met(fst_tracer *t, const fst_pending *from)
{
    const int met = from->start.s.segments > 0 && from->one_way
                        ? fst_branch_of_orbit(t->out, &from->start.seen, t->family.has_s2)
                        : -1;
    for (size_t i = 0; met >= 0 && i < t->out->special_count; ++i)
        if (t->out->specials[i].born == from->branch)
            t->out->specials[i].born = met;
    return met >= 0;
}

/* Where a counter-rotating branch ends in the same orbit as another one, both are one branch, found twice: one curve alone
 * leads to a border at one orbit, or to a Hopf point. */
static fst_status end_branch(fst_tracer *t, const fst_pending *from, fst_curve_end *end, fst_error *error)
{
    int other = end->type == FST_END_EQUILIBRIUM ? t->other : -1;
    if (end->type == FST_END_RANGE && from->start.s.segments > 0)
        other = fst_branch_of_last(t->out);
    if (t->options->kind == FST_BRANCH_COUNTER && other >= 0 && other != from->branch)
        fst_curve_end_set(end, FST_END_OTHER_BRANCH, "it goes on as branch %d, and ends where that does",
                          other);
    return fst_branch_add_end(t->out, from->branch, from->family, t->last_value, end, error);
}

/* One branch from a node on it, both ways, or, if it was born at a special point, away from that. */
static fst_status follow_branch(fst_tracer *t, const fst_pending *from, fst_error *error)
{
    fst_curve curve = {.family = &t->family,
                       .from = fmin(t->options->from, t->options->to),
                       .to = fmax(t->options->from, t->options->to),
                       .longest_step = t->options->longest_step,
                       .sink = {t, t->options->follow, take_node, take_special}};
    if (!(from->start.s.value >= curve.from && from->start.s.value <= curve.to) || was_met(t, from))
        return FST_OK;
    t->branch = from->branch;
    t->depth = from->depth;
    const size_t first = t->out->point_count;
    fst_status status = FST_OK;
    t->other = -1;
    if (!from->one_way) {
        t->last_value = from->start.s.value;
        status = fst_curve_follow(&curve, &from->start, -1, error);
        if (status == FST_OK)
            status = end_branch(t, from, &curve.end, error);
        fst_branch_reverse(t->out, first);
        if (curve.end.type == FST_END_CLOSED) /* the other way would be the same points again */
            return status;
    }
    t->other = -1;
    if (status == FST_OK)
        status = take_node(t, &from->start, error);
    if (status == FST_OK)
        status = fst_curve_follow(&curve, &from->start, 1, error);
    return status == FST_OK ? end_branch(t, from, &curve.end, error) : status;
}

fst_status fst_tracer_run(fst_tracer *t, fst_error *error)
{
    fst_status status = FST_OK;
    for (t->done = 0; t->done < t->pending_count && status == FST_OK; ++t->done) {
        t->nodes = 0;
        status = follow_branch(t, &t->pending[t->done], error);
    }
    t->pending_count = t->done = t->nodes = 0;
    t->watch.what = NULL;
    t->out->branches = t->branch_count;
    return status;
}

fst_status fst_tracer_add(fst_tracer *t, const fst_node *start, fst_error *error)
{
    if (t->pending_count >= FST_PENDING)
        return fst_fail(error, FST_NO_CONVERGENCE, "branch", "more than %d branches", FST_PENDING);
    t->pending[t->pending_count++] = (fst_pending){*start, t->branch_count, -1, 0, 0};
    t->branch_count += 1;
    return FST_OK;
}
