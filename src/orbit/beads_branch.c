/* beads_branch.c - locked states of several beads over one parameter, by beads_curve.c, from the state to which their
 * start leads.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/grow.h"
#include "base/watch.h"
#include "beads/setup.h"
#include "orbit/beads_curve.h"
#include "orbit/beads_scene.h"
#include "orbit/family.h"

static const double LONGEST_STEP = 0.5; /* in the units of numbers */

typedef struct tracing {
    beads_scene scene;
    fst_model *model; /* of the latest value */
    const fst_beads_options *options;
    fst_beads_branch *out;
    int count;
    fst_family family[FST_BEADS_MOST];
    fst_params params[FST_BEADS_MOST];
    beads_curve curve;
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
    return beads_set_up(t->params, t->count, t->options, &t->model, world, state, error);
}

/* ------------------------------------------------------------------ the list */

static fst_status keep(void *user, const beads_world *world, const beads_node *at, fst_error *error)
{
    const tracing *t = user;
    fst_beads_branch *out = t->out;
    if (!fst_grow(&out->values, out->point_count, sizeof *out->values) ||
        !fst_grow(&out->points, out->point_count, sizeof *out->points))
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    out->values[out->point_count] = at->value;
    beads_tell_lock(world, &at->lock, &out->points[out->point_count++]);
    return fst_tell(t->scene.progress, 1.0 - 40.0 / (40.0 + (double)out->point_count), NULL, error);
}

static void reverse(void *user)
{
    fst_beads_branch *out = ((const tracing *)user)->out;
    for (size_t i = 0, k = out->point_count; i + 1 < k; ++i, --k) {
        const double value = out->values[i];
        const fst_beads_locked point = out->points[i];
        out->values[i] = out->values[k - 1];
        out->points[i] = out->points[k - 1];
        out->values[k - 1] = value;
        out->points[k - 1] = point;
    }
}

static fst_status keep_special(void *user, fst_special_type type, const beads_world *world,
                               const beads_node *at, fst_error *error)
{
    fst_beads_branch *out = ((const tracing *)user)->out;
    if (!fst_grow(&out->specials, out->special_count, sizeof *out->specials))
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    fst_beads_special *special = &out->specials[out->special_count++];
    special->type = type;
    special->value = at->value;
    beads_tell_lock(world, &at->lock, &special->at);
    return FST_OK;
}

static fst_status begin(tracing *t, const fst_params *beads, const char *key, fst_error *error)
{
    beads_curve *curve = &t->curve;
    beads_lock lock;
    fst_status status = FST_OK;
    for (int i = 0; i < t->count && status == FST_OK; ++i)
        status = fst_family_begin_in_world(&t->family[i], &beads[i], key, error);
    for (int end = 0; end < 2 && status == FST_OK; ++end) /* values that the parameter can have */
        status = world_at(t, end ? curve->high : curve->low, &curve->world, error);
    if (status != FST_OK)
        return status;
    const double given = fst_family_value(&t->family[0]);
    const double value = given >= curve->low && given <= curve->high ? given : t->out->from;
    set_params(t, value);
    memset(&lock, 0, sizeof lock);
    status = beads_scene_begin(t->params, t->count, t->options, &t->scene, error);
    curve->lapack = t->scene.lapack;
    if (status == FST_OK)
        status = beads_scene_lock(&t->scene, &lock, error);
    if (status == FST_OK)
        status = beads_curve_follow(curve, value, &lock, error);
    memcpy(t->out->ends, curve->ends, sizeof curve->ends);
    return status;
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
    t->curve = (beads_curve){.over = {world_at, t, fmax(fabs(from), fabs(to))},
                             .count = count,
                             .low = fmin(from, to),
                             .high = fmax(from, to),
                             .longest = LONGEST_STEP,
                             .share = 0.02,
                             .user = t,
                             .keep = keep,
                             .keep_special = keep_special,
                             .reverse = reverse};
    const fst_status status = begin(t, beads, key, error);
    if (status != FST_OK)
        fst_beads_branch_free(branch);
    fst_model_free(t->scene.model);
    fst_model_free(t->model);
    free(t);
    return status;
}
