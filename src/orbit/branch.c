/* branch.c - whole branches: the counter-rotating family, and every family of equilibria. */
#include "orbit/branch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "model/params.h"
#include "orbit/search.h"

const char *fst_special_name(fst_special_type type)
{
    static const char *const names[] = {"fold",           "pitchfork",       "period-doubling", "hopf",
                                        "neimark-sacker", "origin-crossing", "transcritical"};
    return (unsigned)type < sizeof names / sizeof *names ? names[type] : "unknown";
}

const char *fst_branch_kind_name(fst_branch_kind kind)
{
    static const char *const names[] = {"counter", "locked", "all"};
    return (unsigned)kind < sizeof names / sizeof *names ? names[kind] : "unknown";
}

fst_branch_options fst_default_branch_options(void)
{
    fst_branch_options o;
    memset(&o, 0, sizeof o);
    o.cookie = FST_BRANCH_OPTIONS_COOKIE;
    o.key = "drive.omega";
    o.from = o.to = NAN;
    o.tolerance = 1e-12;
    o.longest_step = 0.5;
    o.follow = 1;
    return o;
}

void fst_branch_free(fst_branch *branch)
{
    free(branch->points);
    free(branch->specials);
    free(branch->ends);
    memset(branch, 0, sizeof *branch);
}

/* ------------------------------------------------------------------ growing lists */

static fst_status out_of_memory(fst_error *error)
{
    return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
}

/* Room for one more element at the end of a list whose length is a power of two when full. */
static int grow(void **list, size_t count, size_t size)
{
    if (count & (count - 1) || (count == 0 && *list))
        return 1;
    void *larger = realloc(*list, (count ? 2 * count : 1) * size);
    if (!larger)
        return 0;
    *list = larger;
    return 1;
}

fst_status fst_branch_add_point(fst_branch *out, const fst_branch_point *seen, int branch, fst_error *error)
{
    if (!grow((void **)&out->points, out->point_count, sizeof *out->points))
        return out_of_memory(error);
    out->points[out->point_count] = *seen;
    out->points[out->point_count++].branch = branch;
    return FST_OK;
}

fst_status fst_branch_add_end(fst_branch *out, int branch, int family, double value, const char *reason,
                              fst_error *error)
{
    if (!grow((void **)&out->ends, out->end_count, sizeof *out->ends))
        return out_of_memory(error);
    fst_branch_end *end = &out->ends[out->end_count++];
    memset(end, 0, sizeof *end);
    end->branch = branch;
    end->family = family;
    end->value = value;
    (void)snprintf(end->reason, sizeof end->reason, "%s", reason);
    return FST_OK;
}

void fst_branch_reverse(fst_branch *out, size_t first)
{
    fst_branch_point *points = out->points + first;
    const size_t count = out->point_count - first;
    for (size_t i = 0; i + 1 < count - i; ++i) {
        const fst_branch_point kept = points[i];
        points[i] = points[count - 1 - i];
        points[count - 1 - i] = kept;
    }
}

/* ------------------------------------------------------------------ what a curve tells */

/* Nobody knows how long a branch is: forty points are taken for half of one. */
fst_status fst_tracer_progress(fst_tracer *t, fst_error *error)
{
    const double part = (t->done + t->nodes / (t->nodes + 40.0)) / (t->pending_count ? t->pending_count : 1);
    fst_watch_reach(&t->watch, part);
    return fst_watch_ask(&t->watch, error);
}

static fst_status take_node(void *user, const fst_node *node, fst_error *error)
{
    fst_tracer *t = user;
    t->nodes += 1;
    const fst_status status = fst_tracer_progress(t, error);
    t->last_value = node->s.value;
    return status == FST_OK ? fst_branch_add_point(t->out, &node->seen, t->branch, error) : status;
}

static int known_special(const fst_branch *out, fst_special_type type, const fst_node *at, double scale)
{
    for (size_t i = 0; i < out->special_count; ++i)
        if (out->specials[i].type == type && fabs(out->specials[i].value - at->s.value) < 1e-8 * scale &&
            fabs(out->specials[i].at.mean_r - at->seen.mean_r) < 1e-6)
            return 1;
    return 0;
}

static fst_status take_special(void *user, fst_special_type type, const fst_node *at, int criticality,
                               const fst_node *born, fst_error *error)
{
    fst_tracer *t = user;
    fst_branch *out = t->out;
    const fst_status status = fst_watch_ask(&t->watch, error); /* what was stopped may be half known */
    if (status != FST_OK)
        return status;
    if (known_special(out, type, at, t->family.scale))
        return FST_OK; /* met again: a curve that closes, or a conjugate */
    if (!grow((void **)&out->specials, out->special_count, sizeof *out->specials))
        return out_of_memory(error);
    fst_special *s = &out->specials[out->special_count++];
    memset(s, 0, sizeof *s);
    s->type = type;
    s->value = at->s.value;
    s->omega = at->seen.omega;
    s->branch = t->branch;
    s->criticality = criticality;
    s->born = -1;
    s->at = at->seen;
    s->at.branch = t->branch;
    if (t->options->second_key && type == t->options->special && t->start_count < FST_PENDING)
        t->starts[t->start_count++] = (fst_special_start){type, *at};
    if (born && t->pending_count < FST_PENDING && t->depth < 3 &&
        (type != FST_SPECIAL_HOPF || t->follow_hopf)) {
        s->born = t->branch_count;
        /* Through a transcritical point the other branch passes: it is followed both ways. */
        const int one_way = type != FST_SPECIAL_TRANSCRITICAL;
        t->pending[t->pending_count++] =
            (fst_pending){*born, t->branch_count, t->branch, t->depth + 1, one_way};
        t->branch_count += 1;
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ following */

/* Whether a quantity may have this value between two neighbours a and b, x of the way from a: within `least` of
 * the straight line, and what a curve, steep as a square root beside a pitchfork, may differ from that. */
static int lies_between(double a, double b, double x, double value, double least)
{
    return fabs(a + x * (b - a) - value) < least + 0.25 * fabs(b - a);
}

/* Whether an orbit lies on a branch that was followed, by its numbers: its first state may be any.  -1: on
 * none.
 */
static int orbit_branch(const fst_branch *out, const fst_branch_point *seen)
{
    for (size_t i = 0; i + 1 < out->point_count; ++i) {
        const fst_branch_point *a = &out->points[i], *b = a + 1;
        if (a->branch != b->branch || a->multipliers != seen->multipliers || a->symmetry != seen->symmetry ||
            (a->value > seen->value) == (b->value > seen->value))
            continue;
        const double x = (seen->value - a->value) / (b->value - a->value);
        if (lies_between(a->mean_r, b->mean_r, x, seen->mean_r, 2e-3) &&
            lies_between(a->min_r, b->min_r, x, seen->min_r, 2e-2) &&
            lies_between(a->period, b->period, x, seen->period, 2e-3 * seen->period) &&
            lies_between(fabs(a->mean_nz), fabs(b->mean_nz), x, fabs(seen->mean_nz), 5e-3))
            return a->branch;
    }
    return -1;
}

/* Whether the branch born at a special point was met before, from its other end; the special point then names
 * it. */
static int was_met(fst_tracer *t, const fst_pending *from)
{
    const int met = from->start.s.segments > 0 && from->one_way ? orbit_branch(t->out, &from->start.seen) : -1;
    for (size_t i = 0; met >= 0 && i < t->out->special_count; ++i)
        if (t->out->specials[i].born == from->branch)
            t->out->specials[i].born = met;
    return met >= 0;
}

/* One branch from a node on it, both ways, or, if it was born at a special point, away from that. */
static fst_status follow_branch(fst_tracer *t, const fst_pending *from, fst_error *error)
{
    fst_curve curve = {.family = &t->family,
                       .from = fmin(t->options->from, t->options->to),
                       .to = fmax(t->options->from, t->options->to),
                       .longest_step = t->options->longest_step,
                       .follow = t->options->follow,
                       .sink = {t, take_node, take_special}};
    if (!(from->start.s.value >= curve.from && from->start.s.value <= curve.to) || was_met(t, from))
        return FST_OK;
    t->branch = from->branch;
    t->depth = from->depth;
    const size_t first = t->out->point_count;
    fst_status status = FST_OK;
    if (!from->one_way) {
        t->last_value = from->start.s.value;
        status = fst_curve_follow(&curve, &from->start, -1, error);
        fst_branch_reverse(t->out, first);
        if (status == FST_OK)
            status = fst_branch_add_end(t->out, from->branch, from->family, t->last_value, curve.reason, error);
        if (strstr(curve.reason, "closes on itself")) /* the other way would be the same points again */
            return status;
    }
    if (status == FST_OK)
        status = take_node(t, &from->start, error);
    if (status == FST_OK)
        status = fst_curve_follow(&curve, &from->start, 1, error);
    return status == FST_OK
               ? fst_branch_add_end(t->out, from->branch, from->family, t->last_value, curve.reason, error)
               : status;
}

fst_status fst_tracer_run(fst_tracer *t, fst_error *error)
{
    fst_status status = FST_OK;
    for (t->done = 0; t->done < t->pending_count && status == FST_OK; ++t->done) {
        t->nodes = 0;
        status = follow_branch(t, &t->pending[t->done], error);
    }
    t->pending_count = t->done = t->nodes = 0;
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

/* The branch on which a state lies, the nearest if there are several; -1: on none. */
static int branch_through(const fst_branch *out, double value, const double *state)
{
    int best = -1;
    double least = 1.0;
    for (size_t i = 0; i + 1 < out->point_count; ++i) {
        const fst_branch_point *a = &out->points[i], *b = a + 1;
        if (a->branch != b->branch || (a->value > value) == (b->value > value))
            continue;
        const double x = (value - a->value) / (b->value - a->value);
        double greatest = 0.0;
        for (int k = 0; k < FST_STATE_SIZE; ++k) {
            const double there = a->state[k] + x * (b->state[k] - a->state[k]);
            const double bent = 0.02 + 0.3 * fabs(b->state[k] - a->state[k]);
            greatest = fmax(greatest, fabs(there - state[k]) / bent);
        }
        if (greatest < least) {
            least = greatest;
            best = a->branch;
        }
    }
    return best;
}

int fst_tracer_knows(const fst_tracer *t, const fst_branch_point *seen)
{
    return branch_through(t->out, seen->value, seen->state) >= 0;
}

/* Where the images of each branch are.  Of orbits without the symmetry only one of the two is followed. */
static void find_images(fst_branch *out)
{
    for (size_t e = 0; e < out->end_count; ++e) {
        fst_branch_end *end = &out->ends[e];
        size_t first = 0, count = 0;
        for (size_t i = 0; i < out->point_count; ++i)
            if (out->points[i].branch == end->branch && count++ == 0)
                first = i;
        const fst_branch_point *middle = &out->points[first + count / 2];
        double image[FST_STATE_SIZE];
        end->image = -1;
        if (count == 0 || out->second_key[0])
            continue;
        fst_apply_s2(middle->state, image);
        if (middle->symmetry == FST_SYMMETRY_S2)
            end->image = end->branch;
        else if (middle->multipliers == FST_EIGENVALUE_COUNT)
            end->image = branch_through(out, middle->value, image);
    }
}

/* ------------------------------------------------------------------ the two kinds */

/* Search an orbit at one value; 1 if it counter-rotates. */
static int search_at(const fst_tracer *t, double value, fst_node *start, fst_error *why)
{
    fst_family fixed = t->family;
    fst_solution s;
    fixed.key = -1;
    fixed.params = fst_family_params(&t->family, value);
    fixed.params.run_periods = fmin(fixed.params.run_periods, 200.0);
    fixed.params.run_discard = 0.0;
    if (fst_search_orbit(&fixed, &s, why) != FST_OK)
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

static fst_status ignore_special(void *user, fst_special_type type, const fst_node *at, int criticality,
                                 const fst_node *born, fst_error *error)
{
    (void)user, (void)type, (void)at, (void)criticality, (void)born, (void)error;
    return FST_OK;
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
                           .sink = {&c, remember, ignore_special}};
        if (fst_curve_follow(&curve, start, sign, &why) != FST_OK || !strstr(curve.reason, "symmetric branch"))
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

/* Counter-rotating orbits to begin with: a symmetric one where there is one, for from it the others are born,
 * and before it the first that was met, in case it lies on none of the branches that are followed from the
 * other.  `end`: where this part of the work ends.
 */
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
    const char *advice = strstr(why.sentence, ". "); /* what follows is about a single orbit */
    const int length = advice ? (int)(advice - why.sentence) : (int)strlen(why.sentence);
    return fst_fail(
        error, FST_NO_CONVERGENCE, "branch",
        "no counter-rotating orbit was found between %.10g and %.10g from the scene's start; the last try: "
        "%.*s. Try another range or start.r",
        lo, hi, length < 400 ? length : 400, why.sentence);
}

static fst_status follow_counter(fst_tracer *t, fst_error *error)
{
    fst_node start[2];
    int count;
    const double end = t->watch.share[1], searching = 0.1 * end;
    fst_status status = first_orbits(t, searching, start, &count, error);
    fst_watch_part(&t->watch, searching, end);
    for (int i = count - 1; i >= 0 && status == FST_OK; --i) {
        if (orbit_branch(t->out, &start[i].seen) >= 0)
            continue;
        status = fst_tracer_add(t, &start[i], error);
        if (status == FST_OK)
            status = fst_tracer_run(t, error);
    }
    return status;
}

static fst_status check(const fst_branch_options *o, fst_error *error)
{
    const char *where = "fst_branch_follow";
    if (o->cookie != FST_BRANCH_OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, where,
                        "the options were not made by fst_default_branch_options()");
    if (!isfinite(o->from) || !isfinite(o->to) || o->from == o->to)
        return fst_fail(error, FST_BAD_INPUT, where,
                        "a branch needs a range with two different ends, not %g to %g", o->from, o->to);
    if (!(o->tolerance >= 1e-14 && o->tolerance <= 1e-6))
        return fst_fail(error, FST_BAD_INPUT, where, "tolerance = %g is out of range: 1e-14 to 1e-6",
                        o->tolerance);
    if (o->second_key &&
        (!isfinite(o->second_from) || !isfinite(o->second_to) || o->second_from == o->second_to))
        return fst_fail(error, FST_BAD_INPUT, where,
                        "the second parameter needs a range with two different ends, not %g to %g",
                        o->second_from, o->second_to);
    if (o->second_key && (unsigned)o->special > FST_SPECIAL_ORIGIN_CROSSING)
        return fst_fail(error, FST_BAD_INPUT, where, "curves of %s points are not followed over two parameters",
                        fst_special_name(o->special));
    if (o->second_key && strcmp(o->second_key, o->key) == 0)
        return fst_fail(error, FST_BAD_INPUT, where, "the second parameter must not be %s again", o->key);
    if (!(o->longest_step > 1e-5))
        return fst_fail(error, FST_BAD_INPUT, where, "longest_step = %g must be at least 1e-5",
                        o->longest_step);
    return FST_OK;
}

double fst_branch_scale(const char *key, double from, double to)
{
    /* the states themselves vary by several times omega */
    return strcmp(key, "drive.omega") == 0 ? 1.0 : fmax(fabs(from), fabs(to));
}

/* Over two parameters the branches over the first are followed for their special points alone: of these, which
 * are at the value `at` of the second, only the ones to be followed stay. */
static void keep_followed(fst_tracer *t, double at)
{
    fst_branch *out = t->out;
    size_t kept = 0;
    for (size_t i = 0; i < out->special_count; ++i)
        if (out->specials[i].type == t->options->special) {
            out->specials[kept] = out->specials[i];
            out->specials[kept].born = -1;
            out->specials[kept].at.second = at;
            out->specials[kept].branch = out->specials[kept].at.branch = (int)kept;
            kept += 1;
        }
    out->special_count = kept;
    out->point_count = out->end_count = 0;
    out->branches = (int)kept;
}

/* Their curves, one after another. */
static fst_status follow_specials(fst_tracer *t, const fst_params *params, fst_error *error)
{
    const fst_branch_options *o = t->options;
    fst_branch *out = t->out;
    fst_status status = FST_OK;
    if (out->special_count == 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "branch",
                        "no %s lies between %s = %.10g and %.10g, so none can be followed over %s: try another "
                        "range",
                        fst_special_name(o->special), o->key, o->from, o->to, o->second_key);
    for (int curve = 0; curve < t->start_count && status == FST_OK; ++curve) {
        const double begin =
            0.5 + 0.5 * curve / t->start_count; /* the curves are the second half of the work */
        fst_watch_part(&t->watch, begin, begin + 0.5 / t->start_count);
        status = fst_special_curve_follow(o, params, &t->starts[curve], curve, &t->watch, out, error);
    }
    return status;
}

/* Curves over two parameters begin at the scene's value of the second, *at: it must lie within its range. */
static fst_status check_second(const fst_params *params, const fst_branch_options *o, double *at,
                               fst_error *error)
{
    fst_family second;
    *at = NAN;
    if (!o->second_key)
        return FST_OK;
    const fst_status status = fst_family_begin(&second, params, o->second_key, error);
    if (status != FST_OK)
        return status;
    *at = fst_family_value(&second);
    if (*at < fmin(o->second_from, o->second_to) || *at > fmax(o->second_from, o->second_to))
        return fst_fail(
            error, FST_BAD_INPUT, "fst_branch_follow",
            "the curves begin at the scene's %s = %.10g, which must lie within the range %.10g to %.10g",
            o->second_key, *at, o->second_from, o->second_to);
    return FST_OK;
}

fst_status fst_branch_follow(const fst_params *params, const fst_branch_options *options, fst_branch *branch,
                             fst_error *error)
{
    memset(branch, 0, sizeof *branch);
    double second_at;
    fst_status status = check(options, error);
    if (status == FST_OK)
        status = check_second(params, options, &second_at, error);
    if (status != FST_OK)
        return status;
    fst_tracer *t = calloc(1, sizeof *t);
    if (!t)
        return out_of_memory(error);
    t->options = options;
    t->out = branch;
    t->follow_hopf = options->kind == FST_BRANCH_ALL;
    fst_watch_begin(&t->watch, options->progress);
    fst_watch_part(&t->watch, 0.0, options->second_key ? 0.5 : 1.0);
    branch->kind = options->kind;
    branch->from = options->from;
    branch->to = options->to;
    (void)snprintf(branch->key, sizeof branch->key, "%s", options->key);
    if (options->second_key) {
        (void)snprintf(branch->second_key, sizeof branch->second_key, "%s", options->second_key);
        branch->second_from = options->second_from;
        branch->second_to = options->second_to;
        branch->followed = options->special;
    }
    status = fst_family_begin(&t->family, params, options->key, error);
    t->family.scale = fst_branch_scale(options->key, options->from, options->to);
    fst_family_tighten(&t->family, options->tolerance);
    t->family.watch = &t->watch;
    if (status == FST_OK)
        status = options->kind == FST_BRANCH_COUNTER ? follow_counter(t, error) : fst_follow_locked(t, error);
    if (options->second_key)
        keep_followed(t, second_at);
    if (status == FST_OK && options->second_key)
        status = follow_specials(t, params, error);
    branch->complete = status == FST_OK;
    if (status == FST_OK || status == FST_INTERRUPTED)
        find_images(branch);
    else
        fst_branch_free(branch);
    free(t);
    return status;
}
