/* levitation_branch.c - the places where a bead floats, followed over one parameter.
 *
 * A curve is followed by steps h along its direction and Newton's method across it (beads_lock_across()), so that it may
 * turn back. Between two points
 *
 *     fold    the direction's component along the parameter changes its sign
 *     hopf    a complex pair of eigenvalues crosses the imaginary axis
 *
 * is located by bisection of the step that ends there.  Curves begin at the places found at some values of the parameter
 * (levitation.c), and each is followed both ways until the range ends, or the bead would touch the magnet.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/watch.h"
#include "orbit/levitation.h"

enum { STARTS = 9, MOST_POINTS = 4000, LOCATING = 40, EASY = 6 };
static const double FIRST = 0.02, LONGEST = 0.1, SHORTEST = 1e-7, MOST_TURN = 0.97, KNOWN = 0.02;

typedef struct point {
    double value;
    beads_lock lock;
    double way[BEADS_NUMBERS + 1];
} point;

typedef struct tracer {
    const fst_lapack *lapack;
    fst_params params;
    char key[64];
    double from, to;
    fst_model *model; /* of `world`, which was made last */
    beads_world world;
    fst_levitation_branch *branch;
    const fst_progress *progress;
    point at, next;
} tracer;

/* The world at a value of the key, for beads_free_world. */
static fst_status world_at(void *user, double value, beads_world *world, fst_error *error)
{
    tracer *t = user;
    char text[40];
    (void)fst_number_write(text, sizeof text, value);
    fst_params params = t->params;
    fst_status status = fst_params_set(&params, t->key, text, error);
    fst_model_free(t->model);
    t->model = NULL;
    if (status == FST_OK)
        status = levitation_world(&params, &t->model, &t->world, error);
    *world = t->world;
    return status;
}

static beads_free_world over(tracer *t)
{
    return (beads_free_world){world_at, t, t->to - t->from};
}

/* ------------------------------------------------------------------ what is kept */

/* Room for one more in a list, whose length doubles. */
static int make_room(void **list, size_t count, size_t size)
{
    if (count & (count - 1))
        return 1;
    void *longer = realloc(*list, (count ? 2 * count : 1) * size);
    *list = longer ? longer : *list;
    return longer != NULL;
}

static fst_levitation_point describe(const tracer *t, const point *p)
{
    const fst_groups g = fst_model_groups(t->model);
    fst_levitation_point out = {.value = p->value, .branch = t->branch->branches};
    levitation_describe(&t->world, &g, &p->lock, &out.at);
    return out;
}

static fst_status keep_point(tracer *t, const point *p, fst_error *error)
{
    fst_levitation_branch *b = t->branch;
    if (!make_room((void **)&b->points, b->point_count, sizeof *b->points))
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    b->points[b->point_count++] = describe(t, p);
    return FST_OK;
}

static fst_status keep_special(tracer *t, fst_special_type type, const point *p, fst_error *error)
{
    fst_levitation_branch *b = t->branch;
    if (!make_room((void **)&b->specials, b->special_count, sizeof *b->specials))
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    b->specials[b->special_count++] = (fst_levitation_special){type, describe(t, p)};
    return FST_OK;
}

/* ------------------------------------------------------------------ a step */

/* From t->at by h along its direction into t->next; `found` is 0 if Newton's method did not find the curve there. */
static fst_status step(tracer *t, double h, int *found, fst_error *error)
{
    const beads_free_world free = over(t);
    t->next = t->at;
    for (int i = 0; i < FST_BEAD_NUMBERS; ++i)
        t->next.lock.state[i] += h * t->at.way[i];
    t->next.value += h * t->at.way[FST_BEAD_NUMBERS] * free.scale;
    const fst_status status =
        beads_lock_across(t->lapack, &free, &t->next.value, &t->next.lock, t->next.way, error);
    *found = status == FST_OK;
    return status == FST_NO_MEMORY ? status : FST_OK;
}

/* The eigenvalue whose real part leaves one side of the axis for the other between two points, in both lists. */
static int crossing(const point *a, const point *b)
{
    return a->lock.unstable < b->lock.unstable ? a->lock.unstable : b->lock.unstable;
}

/* What changes its sign at a special point. */
static double test(const point *p, fst_special_type type, int which)
{
    return type == FST_SPECIAL_FOLD ? p->way[FST_BEAD_NUMBERS] : p->lock.re[which];
}

/* Bisect the step of the length h, which ended in `end`, and keep what is found. */
static fst_status locate(tracer *t, fst_special_type type, double h, const point *end, fst_error *error)
{
    const int which = crossing(&t->at, end);
    const double before = test(&t->at, type, which);
    double low = 0.0, high = h;
    for (int i = 0; i < LOCATING && high - low > 1e-13; ++i) {
        const double middle = 0.5 * (low + high);
        int found;
        const fst_status status = step(t, middle, &found, error);
        if (!found)
            return status;
        *(test(&t->next, type, which) * before > 0 ? &low : &high) = middle;
    }
    return keep_special(t, type, &t->next, error);
}

/* Look for special points between t->at and t->next. */
static fst_status look_between(tracer *t, double h, fst_error *error)
{
    point *end = malloc(sizeof *end);
    if (!end)
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    *end = t->next;
    fst_status status = FST_OK;
    const int which = crossing(&t->at, end);
    const int pair = abs(end->lock.unstable - t->at.lock.unstable) == 2 && end->lock.im[which] != 0.0;
    if (end->way[FST_BEAD_NUMBERS] * t->at.way[FST_BEAD_NUMBERS] < 0)
        status = locate(t, FST_SPECIAL_FOLD, h, end, error);
    if (pair && status == FST_OK)
        status = locate(t, FST_SPECIAL_HOPF, h, end, error);
    t->next = *end;
    free(end);
    return status;
}

/* The cosine of the turn from one direction of the curve to another: of place, moment and parameter. */
static double cosine(const double *a, const double *b)
{
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (int i = 0; i <= FST_BEAD_NUMBERS; ++i) {
        if ((i >= BEADS_V && i < BEADS_N) || (i >= BEADS_W && i < FST_BEAD_NUMBERS))
            continue;
        ab += a[i] * b[i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
    }
    return ab / sqrt(aa * bb);
}

/* Whether the curve has come to an end of the range, or to the magnet. */
static int is_outside(const tracer *t, const point *p)
{
    int unused;
    return p->value < t->from || p->value > t->to || !(beads_way_out(&t->world, 0, p->lock.state, &unused) > 0);
}

/* Follow the curve through t->at towards its direction. */
static fst_status follow(tracer *t, fst_error *error)
{
    double h = FIRST;
    fst_status status = FST_OK;
    for (int points = 0; points < MOST_POINTS && status == FST_OK;) {
        int found;
        status = step(t, h, &found, error);
        if (status != FST_OK)
            return status;
        if (!found || cosine(t->at.way, t->next.way) < MOST_TURN) {
            h *= 0.5;
            if (h < SHORTEST)
                return FST_OK;
            continue;
        }
        if (is_outside(t, &t->next))
            return FST_OK;
        status = look_between(t, h, error);
        t->at = t->next;
        if (status == FST_OK)
            status = keep_point(t, &t->at, error);
        ++points;
        if (t->at.lock.iterations <= EASY)
            h = fmin(1.3 * h, LONGEST);
        if (status == FST_OK)
            status = fst_tell(t->progress, 0.5, NULL, error);
    }
    return status;
}

/* ------------------------------------------------------------------ the whole */

/* Whether a place at a value lies on a curve that was followed, between two of its points. */
static int is_on_curve(const fst_levitation_branch *b, double value, const fst_levitation *place)
{
    for (size_t i = 0; i + 1 < b->point_count; ++i) {
        const fst_levitation_point *p = &b->points[i], *q = &b->points[i + 1];
        if (p->branch != q->branch || (value - p->value) * (value - q->value) > 0 || p->value == q->value)
            continue;
        const double share = (value - p->value) / (q->value - p->value);
        double greatest = 0.0;
        for (int k = 0; k < FST_BEAD_NUMBERS; ++k)
            if (k < BEADS_V || (k >= BEADS_N && k < BEADS_W))
                greatest = fmax(greatest, fabs(p->at.state[k] + share * (q->at.state[k] - p->at.state[k]) -
                                               place->state[k]));
        if (greatest < KNOWN)
            return 1;
    }
    return 0;
}

/* Follow the curve through a place both ways: first down, so that its points are in order. */
static fst_status follow_both_ways(tracer *t, double value, const fst_levitation *place, fst_error *error)
{
    const size_t first = t->branch->point_count;
    fst_status status = FST_OK;
    for (int up = 0; up < 2 && status == FST_OK; ++up) {
        const beads_free_world free = over(t);
        memset(&t->at, 0, sizeof t->at);
        memcpy(t->at.lock.state, place->state, sizeof place->state);
        t->at.value = value;
        t->at.way[FST_BEAD_NUMBERS] = up ? 1.0 : -1.0;
        status = beads_lock_across(t->lapack, &free, &t->at.value, &t->at.lock, t->at.way, error);
        if (status == FST_OK && up)
            status = keep_point(t, &t->at, error);
        if (status == FST_OK)
            status = follow(t, error);
        const size_t count = t->branch->point_count - first;
        for (size_t i = 0; i < count / 2 && !up; ++i) {
            fst_levitation_point *points = t->branch->points + first, kept = points[i];
            points[i] = points[count - 1 - i];
            points[count - 1 - i] = kept;
        }
    }
    ++t->branch->branches;
    return status;
}

static fst_status begin_at(tracer *t, double value, fst_error *error)
{
    fst_levitation_list list;
    fst_params params = t->params;
    char text[40];
    (void)fst_number_write(text, sizeof text, value);
    fst_status status = fst_params_set(&params, t->key, text, error);
    if (status == FST_OK)
        status = fst_levitation_find(&params, NULL, &list, error);
    if (status != FST_OK)
        return status;
    for (size_t i = 0; i < list.count && status == FST_OK; ++i)
        if (!is_on_curve(t->branch, value, &list.states[i]))
            status = follow_both_ways(t, value, &list.states[i], error);
    fst_levitation_free(&list);
    return status;
}

fst_status fst_levitation_follow(const fst_params *params, const char *key, double from, double to,
                                 const fst_progress *progress, fst_levitation_branch *branch, fst_error *error)
{
    memset(branch, 0, sizeof *branch);
    tracer *t = calloc(1, sizeof *t);
    if (!t)
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    (void)snprintf(branch->key, sizeof branch->key, "%s", key);
    branch->from = from;
    branch->to = to;
    t->params = *params;
    memcpy(t->key, branch->key, sizeof t->key);
    t->from = from;
    t->to = to;
    t->branch = branch;
    t->progress = progress;
    fst_status status = fst_lapack_load(&t->lapack, error);
    for (int i = 0; i < STARTS && status == FST_OK; ++i)
        status = begin_at(t, from + (to - from) * (i + 0.5) / STARTS, error);
    fst_model_free(t->model);
    free(t);
    if (status != FST_OK)
        fst_levitation_branch_free(branch);
    return status;
}

void fst_levitation_branch_free(fst_levitation_branch *branch)
{
    free(branch->points);
    free(branch->specials);
    memset(branch, 0, sizeof *branch);
}
