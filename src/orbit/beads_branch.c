/* beads_branch.c - locked states of several beads over one parameter.
 *
 * A step goes along the tangent of the curve of states and parameter, and Newton's method comes back to the curve across
 * it (curve.c has a picture).  The contacts are those of the start, so a curve ends where one of them would have to pull,
 * or where beads meet that no contact keeps apart.  Between two points are sought:
 *
 *     contact   the least load or force, or the least gap, passes 0; the curve ends there
 *     fold      the parameter turns back
 *     hopf      the real part of a pair of eigenvalues passes 0; of a real one: pitchfork where the state is its own image
 *               under half a turn with the beads exchanged, else transcritical
 *
 * each by secants on a number that passes 0 there, with the solution between corrected every time.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bracket.h"
#include "base/error.h"
#include "base/watch.h"
#include "beads/setup.h"
#include "orbit/beads_scene.h"
#include "orbit/family.h"

enum { MOST_NODES = 4000, LOCATING = 60 };
static const double FIRST_STEP = 0.02, LONGEST_STEP = 0.5, SHORTEST_STEP = 1e-8; /* in the units of numbers */
static const double STEP_OF_RANGE = 0.02, LEAST_COSINE = 0.95, LOCATED = 1e-13;

/* A point of the curve. */
typedef struct node {
    beads_lock lock;
    double value, way[BEADS_NUMBERS + 1];
} node;

typedef struct tracing {
    beads_scene scene;
    beads_world world; /* at the latest value */
    fst_model *model;  /* its own */
    beads_free_world over;
    const fst_beads_options *options;
    fst_beads_branch *out;
    double low, high;
    int count;
    fst_family family[FST_BEADS_MOST];
    fst_params params[FST_BEADS_MOST];
    node here, next, middle;
} tracing;

/* ------------------------------------------------------------------ the world at a value */

static void set_params(tracing *t, double value)
{
    for (int i = 0; i < t->count; ++i)
        t->params[i] = fst_family_params(&t->family[i], value);
}

static fst_status world_at(void *user, double value, beads_world *world, fst_error *error)
{
    tracing *t = user;
    double state[BEADS_NUMBERS];
    fst_model_free(t->model);
    t->model = NULL;
    set_params(t, value);
    const fst_status status = beads_set_up(t->params, t->count, t->options, &t->model, &t->world, state, error);
    *world = t->world;
    return status;
}

static double product(const tracing *t, const double *a, const double *b)
{
    const int numbers = FST_BEAD_NUMBERS * t->count;
    double unit[BEADS_NUMBERS], sum = a[numbers] * b[numbers];
    beads_units(&t->world, unit);
    for (int i = 0; i < numbers; ++i)
        sum += a[i] * b[i] / (unit[i] * unit[i]);
    return sum;
}

/* ------------------------------------------------------------------ the list */

static fst_status add_point(tracing *t, const node *at, fst_error *error)
{
    fst_beads_branch *out = t->out;
    if ((out->point_count & (out->point_count - 1)) == 0) { /* room for twice as many */
        const size_t room = out->point_count ? 2 * out->point_count : 1;
        double *values = realloc(out->values, room * sizeof *values);
        out->values = values ? values : out->values;
        fst_beads_locked *points = values ? realloc(out->points, room * sizeof *points) : NULL;
        if (!points)
            return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
        out->points = points;
    }
    out->values[out->point_count] = at->value;
    beads_tell_lock(&t->world, &at->lock, &out->points[out->point_count++]);
    return fst_tell(t->scene.progress, 1.0 - 40.0 / (40.0 + (double)out->point_count), NULL, error);
}

static void reverse_points(fst_beads_branch *out)
{
    for (size_t i = 0, k = out->point_count; i + 1 < k; ++i, --k) {
        const double value = out->values[i];
        const fst_beads_locked point = out->points[i];
        out->values[i] = out->values[k - 1];
        out->points[i] = out->points[k - 1];
        out->values[k - 1] = value;
        out->points[k - 1] = point;
    }
}

static fst_status add_special(tracing *t, fst_special_type type, const node *at, fst_error *error)
{
    fst_beads_branch *out = t->out;
    fst_beads_special *specials = realloc(out->specials, (out->special_count + 1) * sizeof *specials);
    if (!specials)
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    out->specials = specials;
    specials += out->special_count++;
    specials->type = type;
    specials->value = at->value;
    const fst_status status = world_at(t, at->value, &t->world, error);
    beads_tell_lock(&t->world, &at->lock, &specials->at);
    return status;
}

static void set_end(fst_branch_end *end, fst_end_type type, double value, const char *reason)
{
    *end = (fst_branch_end){.type = type, .family = -1, .image = -1, .value = value};
    (void)snprintf(end->reason, sizeof end->reason, "%s", reason);
}

/* ------------------------------------------------------------------ between two points */

/* What passes 0. */
enum { FORCE, GAP, TURN, GROWTH };
static double test_of(tracing *t, const node *at, int test, int rank)
{
    int which;
    if (test == TURN)
        return at->way[FST_BEAD_NUMBERS * t->count];
    if (test == GROWTH)
        return at->lock.re[rank];
    return test == FORCE ? beads_lock_least_force(&t->world, &at->lock, &which)
                         : beads_lock_least_gap(&t->world, &at->lock, &which);
}

/* The solution at the fraction x between here and next. */
static fst_status between(tracing *t, double x, node *out, fst_error *error)
{
    const node *a = &t->here, *b = &t->next;
    *out = *a;
    for (int i = 0; i < FST_BEAD_NUMBERS * t->count; ++i)
        out->lock.state[i] += x * (b->lock.state[i] - a->lock.state[i]);
    out->value += x * (b->value - a->value);
    fst_status status = beads_lock_across(t->scene.lapack, &t->over, &out->value, &out->lock, out->way, error);
    return status == FST_OK ? world_at(t, out->value, &t->world, error) : status;
}

/* t->middle: where the test passes 0 between here and next. */
static fst_status locate(tracing *t, int test, int rank, fst_error *error)
{
    fst_bracket z = {0.0, 1.0, test_of(t, &t->here, test, rank), test_of(t, &t->next, test, rank), 0};
    fst_status status = FST_OK;
    t->middle = t->next;
    for (int i = 0; i < LOCATING && z.hi - z.lo > LOCATED && status == FST_OK; ++i) {
        const double x = i % 8 == 7 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
        if (!(x > z.lo && x < z.hi))
            break;
        status = between(t, x, &t->middle, error);
        const double value = status == FST_OK ? test_of(t, &t->middle, test, rank) : NAN;
        if (fabs(value) < LOCATED)
            break;
        fst_bracket_take(&z, x, value);
    }
    return status;
}

/* Whether half a turn maps the state onto itself, with the beads in the opposite order. */
static int is_own_image(const tracing *t, const beads_lock *lock)
{
    static const double half_turn[3] = {-1, -1, 1};
    for (int i = 0; i < t->count; ++i)
        for (int k = 0; k < 3; ++k)
            if (fabs(lock->state[FST_BEAD_NUMBERS * i + k] -
                     half_turn[k] * lock->state[FST_BEAD_NUMBERS * (t->count - 1 - i) + k]) > 1e-6)
                return 0;
    return 1;
}

/* The curve ends at a contact. */
static fst_status end_at_contact(tracing *t, int test, fst_branch_end *end, fst_error *error)
{
    char reason[192], bodies[64];
    int which;
    const fst_status status = locate(t, test, 0, error);
    if (status != FST_OK)
        return status;
    if (test == FORCE)
        (void)beads_lock_least_force(&t->world, &t->next.lock, &which);
    else
        (void)beads_lock_least_gap(&t->world, &t->next.lock, &which);
    const beads_contact *c = &t->world.contact[which];
    if (c->second < 0)
        (void)snprintf(bodies, sizeof bodies, "bead %d and the plate", c->first);
    else
        (void)snprintf(bodies, sizeof bodies, "beads %d and %d", c->first, c->second);
    (void)snprintf(reason, sizeof reason,
                   test == FORCE ? "the force between %s falls to 0 at %.12g" : "%s meet at %.12g", bodies,
                   t->middle.value);
    set_end(end, FST_END_CONTACT, t->middle.value, reason);
    return add_special(t, FST_SPECIAL_CONTACT, &t->middle, error);
}

/* What happens between here and next, and whether the curve ends there. */
static fst_status look_between(tracing *t, int *ends, fst_branch_end *end, fst_error *error)
{
    const int p = FST_BEAD_NUMBERS * t->count;
    const beads_lock *a = &t->here.lock, *b = &t->next.lock;
    for (int test = FORCE; test <= GAP; ++test)
        if (test_of(t, &t->next, test, 0) < 0) {
            *ends = 1;
            return end_at_contact(t, test, end, error);
        }
    int change = abs(b->unstable - a->unstable);
    fst_status status = FST_OK;
    if (t->here.way[p] * t->next.way[p] < 0) {
        status = locate(t, TURN, 0, error);
        if (status == FST_OK)
            status = add_special(t, FST_SPECIAL_FOLD, &t->middle, error);
        change -= change > 0;
    }
    for (int rank = a->unstable < b->unstable ? a->unstable : b->unstable; change > 0 && status == FST_OK;) {
        status = locate(t, GROWTH, rank, error);
        if (status != FST_OK)
            break;
        const int pair = t->middle.lock.im[rank] != 0.0;
        status = add_special(t,
                             pair                               ? FST_SPECIAL_HOPF
                             : is_own_image(t, &t->middle.lock) ? FST_SPECIAL_PITCHFORK
                                                                : FST_SPECIAL_TRANSCRITICAL,
                             &t->middle, error);
        rank += 1 + pair;
        change -= 1 + pair;
    }
    return status;
}

/* ------------------------------------------------------------------ following */

/* The point a step h along the tangent from here, or on the border of the range. */
static fst_status step(tracing *t, double h, int *at_border, fst_error *error)
{
    const int p = FST_BEAD_NUMBERS * t->count;
    const double ahead = t->here.value + h * t->here.way[p] * t->over.scale;
    const double border = ahead > t->high ? t->high : t->low;
    *at_border = ahead > t->high || ahead < t->low;
    const double part = *at_border ? (border - t->here.value) / (ahead - t->here.value) : 1.0;
    t->next = t->here;
    for (int i = 0; i < p; ++i)
        t->next.lock.state[i] += part * h * t->here.way[i];
    t->next.value = *at_border ? border : ahead;
    fst_status status;
    if (*at_border) {
        status = world_at(t, border, &t->world, error);
        return status == FST_OK ? beads_lock_correct(t->scene.lapack, &t->world, &t->next.lock, error) : status;
    }
    status = beads_lock_across(t->scene.lapack, &t->over, &t->next.value, &t->next.lock, t->next.way, error);
    if (status == FST_OK)
        status = world_at(t, t->next.value, &t->world, error);
    return status == FST_OK && product(t, t->here.way, t->next.way) < LEAST_COSINE
               ? fst_fail(error, FST_NO_CONVERGENCE, "branch", "the curve turns too sharply")
               : status;
}

/* From t->here to the end. */
static fst_status follow(tracing *t, fst_branch_end *end, fst_error *error)
{
    double h = FIRST_STEP;
    for (int nodes = 0; nodes < MOST_NODES; ++nodes) {
        int at_border = 0, ends = 0;
        const double slope = fabs(t->here.way[FST_BEAD_NUMBERS * t->count]) * t->over.scale;
        h = fmin(fmin(h, LONGEST_STEP), STEP_OF_RANGE * (t->high - t->low) / slope);
        fst_status status = step(t, h, &at_border, error);
        if (status == FST_INTERRUPTED || status == FST_NO_MEMORY)
            return status;
        if (status != FST_OK) {
            h *= 0.5;
            if (h > SHORTEST_STEP)
                continue;
            set_end(end, FST_END_LOST, t->here.value, "no further point was found");
            return FST_OK;
        }
        status = look_between(t, &ends, end, error);
        if (status != FST_OK)
            return status;
        t->here = ends ? t->middle : t->next;
        status = add_point(t, &t->here, error);
        if (status != FST_OK || ends)
            return status;
        if (at_border) {
            set_end(end, FST_END_RANGE, t->here.value, "at the end of the range");
            return FST_OK;
        }
        h *= t->here.lock.iterations <= 4 ? 1.5 : 0.8;
    }
    set_end(end, FST_END_COUNT_LIMIT, t->here.value, "so many points were followed that it was given up");
    return FST_OK;
}

/* Both ways from the start. */
static fst_status follow_both(tracing *t, const node *start, fst_error *error)
{
    fst_status status = FST_OK;
    for (int way = 0; way < 2 && status == FST_OK; ++way) {
        t->here = *start;
        for (int i = 0; i <= FST_BEAD_NUMBERS * t->count && !way; ++i)
            t->here.way[i] = -t->here.way[i];
        status = world_at(t, start->value, &t->world, error);
        if (status == FST_OK && way)
            status = add_point(t, start, error);
        if (status == FST_OK)
            status = follow(t, &t->out->ends[way], error);
        if (status == FST_OK && !way)
            reverse_points(t->out);
    }
    return status;
}

static fst_status begin(tracing *t, const fst_params *beads, const char *key, fst_error *error)
{
    fst_status status = FST_OK;
    for (int i = 0; i < t->count && status == FST_OK; ++i)
        status = fst_family_begin(&t->family[i], &beads[i], key, error);
    if (status != FST_OK)
        return status;
    for (int end = 0; end < 2; ++end) { /* values that the parameter can have */
        status = world_at(t, end ? t->high : t->low, &t->world, error);
        if (status != FST_OK)
            return status;
    }
    const double value = fst_family_value(&t->family[0]);
    node *start = &t->middle;
    memset(start, 0, sizeof *start);
    start->value = value >= t->low && value <= t->high ? value : t->out->from;
    set_params(t, start->value);
    status = beads_scene_begin(t->params, t->count, t->options, &t->scene, error);
    if (status == FST_OK)
        status = beads_scene_lock(&t->scene, &start->lock, error);
    if (status != FST_OK)
        return status;
    const int p = FST_BEAD_NUMBERS * t->count;
    start->way[p] = 1.0; /* its tangent: first at the value itself, then along the curve */
    status = beads_lock_across(t->scene.lapack, &t->over, &start->value, &start->lock, start->way, error);
    const node kept = *start;
    return status == FST_OK ? follow_both(t, &kept, error) : status;
}

void fst_beads_branch_free(fst_beads_branch *branch)
{
    free(branch->values);
    free(branch->points);
    free(branch->specials);
    memset(branch, 0, sizeof *branch);
}

fst_status fst_beads_branch_follow(const fst_params *beads, int count, const fst_beads_options *options,
                                   const char *key, double from, double to, fst_beads_branch *branch,
                                   fst_error *error)
{
    memset(branch, 0, sizeof *branch);
    if (!isfinite(from) || !isfinite(to) || from == to)
        return fst_fail(error, FST_BAD_INPUT, "branch",
                        "a branch needs a range with two different ends, not %g to %g", from, to);
    if (count < 1 || count > FST_BEADS_MOST)
        return fst_fail(error, FST_BAD_INPUT, "beads", "%d beads: branches are followed for 1 to %d", count,
                        FST_BEADS_MOST);
    if (strncmp(key, "start.", 6) == 0 || strncmp(key, "run.", 4) == 0 || strncmp(key, "beads[", 6) == 0)
        return fst_fail(
            error, FST_BAD_INPUT, "branch",
            "no locked state of all beads depends on %s: expected a parameter of the magnet, the beads, "
            "the drive or the model",
            key);
    tracing *t = calloc(1, sizeof *t);
    if (!t)
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    (void)snprintf(branch->key, sizeof branch->key, "%s", key);
    branch->from = from;
    branch->to = to;
    t->out = branch;
    t->options = options;
    t->count = count;
    t->low = fmin(from, to);
    t->high = fmax(from, to);
    t->over = (beads_free_world){world_at, t, fmax(fabs(from), fabs(to))};
    const fst_status status = begin(t, beads, key, error);
    if (status != FST_OK)
        fst_beads_branch_free(branch);
    fst_model_free(t->scene.model);
    fst_model_free(t->model);
    free(t);
    return status;
}
