/* world_branch.c - the places where a bead floats, or a motion with the drive's period, followed over one parameter by
 * beads_curve.c.
 *
 * Curves of places begin at those found at some values of the parameter (levitation.c), and each is followed both ways
 * until the range ends, or the bead would touch the magnet.  The motion is the one to which the start leads
 * (world_orbit.c), at the scene's value of the parameter or, where that is not within the range, at its beginning.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/constants.h"
#include "base/watch.h"
#include "orbit/beads_curve.h"
#include "orbit/branch_list.h"
#include "orbit/family.h"
#include "orbit/levitation.h"
#include "orbit/world_orbit.h"

enum { STARTS = 9 };
static const double KNOWN = 0.02;

typedef struct tracer {
    fst_params params;
    const fst_branch_options *options;
    int driven;       /* motions are followed */
    fst_model *model; /* of the latest value, of places */
    world_strobe strobe;
    fst_branch *out;
    double done; /* of the values at which curves begin */
    beads_curve curve;
} tracer;

static fst_status params_at(const tracer *t, double value, fst_params *params, fst_error *error)
{
    char text[40];
    (void)fst_number_write(text, sizeof text, value);
    *params = t->params;
    return fst_params_set(params, t->options->key, text, error);
}

static fst_status world_at(void *user, double value, beads_world *world, fst_error *error)
{
    tracer *t = user;
    fst_params params;
    fst_model_free(t->model);
    t->model = NULL;
    const fst_status status = params_at(t, value, &params, error);
    if (status != FST_OK || !t->driven)
        return status == FST_OK ? levitation_world(&params, &t->model, world, error) : status;
    const fst_beads_options run = fst_default_beads_options();
    double start[BEADS_NUMBERS];
    const fst_status made = world_strobe_set(&t->strobe, &params, &run, start, error);
    *world = t->strobe.world;
    return made;
}

/* ------------------------------------------------------------------ what is kept */

/* Numbers of a motion, over one period. */
static fst_status describe_motion(tracer *t, const beads_node *at, fst_branch_point *p, fst_error *error)
{
    world_strobe *s = &t->strobe;
    const double period = s->repeat.period;
    double end[BEADS_NUMBERS];
    const fst_status status = s->repeat.after(s, at->lock.state, end, error);
    p->omega = s->world.omega;
    p->period = period;
    p->mean_r = s->flow.step.y[FST_BEAD_NUMBERS + BEADS_R] / period;
    p->mean_alpha_dot = (s->flow.turned[0] + fst_frame_angle(&s->world.around, period)) / period;
    p->multipliers = at->lock.size < FST_EIGENVALUE_COUNT ? at->lock.size : FST_EIGENVALUE_COUNT;
    for (int i = 0; i < p->multipliers; ++i)
        world_multiplier(&at->lock, period, i, &p->multiplier_re[i], &p->multiplier_im[i]);
    p->stable = at->lock.unstable == 0;
    memcpy(p->levitation.state, at->lock.state, sizeof p->levitation.state);
    p->levitation.state[2] += isnan(s->world.plate) ? 0.0 : s->world.body[0].radius;
    return status;
}

static void describe_place(const tracer *t, const beads_world *world, const beads_node *at, fst_branch_point *p)
{
    const fst_groups g = fst_model_groups(t->model);
    levitation_describe(world, &g, &at->lock, &p->levitation);
    p->omega = p->mean_alpha_dot = g.omega;
    p->mean_r = p->min_r = hypot(at->lock.state[0], at->lock.state[1]);
    p->mean_nz = at->lock.state[BEADS_N + 2];
    p->bead_angle_deg = atan2(at->lock.state[1], at->lock.state[0]) * FST_DEGREES;
    p->stable = p->levitation.stable;
}

static fst_status describe(tracer *t, const beads_world *world, const beads_node *at, fst_branch_point *p,
                           fst_error *error)
{
    fst_status status = FST_OK;
    *p = (fst_branch_point){.value = at->value, .branch = t->out->branches, .symmetry = FST_SYMMETRY_NONE};
    p->second = p->mean_nz = p->festoons = p->period = p->min_r = p->bead_angle_deg = p->slip = p->swing_ratio =
        p->levitation.height_mm = p->levitation.tilt_deg = p->levitation.circle_mm = p->levitation.gap_mm = NAN;
    if (t->driven)
        status = describe_motion(t, at, p, error);
    else
        describe_place(t, world, at, p);
    p->relaxation_time = p->stable ? -1.0 / at->lock.re[0] : NAN;
    return status;
}

static fst_status keep(void *user, const beads_world *world, const beads_node *at, fst_error *error)
{
    tracer *t = user;
    fst_branch_point p;
    fst_status status = describe(t, world, at, &p, error);
    if (status == FST_OK)
        status = fst_branch_add_point(t->out, &p, t->out->branches, error);
    return status == FST_OK ? fst_tell(t->options->progress, t->done, NULL, error) : status;
}

static fst_status keep_special(void *user, fst_special_type type, const beads_world *world,
                               const beads_node *at, fst_error *error)
{
    tracer *t = user;
    fst_special s = {.type = type, .value = at->value, .branch = t->out->branches, .born = -1};
    const fst_status status = describe(t, world, at, &s.at, error);
    s.omega = s.at.omega;
    return status == FST_OK ? fst_branch_add_special(t->out, &s, error) : status;
}

/* The points of the curve that is being followed are the last. */
static void reverse(void *user)
{
    fst_branch *out = ((const tracer *)user)->out;
    size_t first = out->point_count;
    while (first > 0 && out->points[first - 1].branch == out->branches)
        --first;
    fst_branch_reverse(out, first);
}

/* ------------------------------------------------------------------ the whole */

/* Whether a place at a value lies on a curve that was followed, between two of its points. */
static int is_on_curve(const fst_branch *b, double value, const fst_levitation *place)
{
    for (size_t i = 0; i + 1 < b->point_count; ++i) {
        const fst_branch_point *p = &b->points[i], *q = &b->points[i + 1];
        if (p->branch != q->branch || (value - p->value) * (value - q->value) > 0 || p->value == q->value)
            continue;
        const double share = (value - p->value) / (q->value - p->value);
        double greatest = 0.0;
        for (int k = 0; k < FST_BEAD_NUMBERS; ++k) {
            const double a = p->levitation.state[k], b_ = q->levitation.state[k];
            if (k < BEADS_V || (k >= BEADS_N && k < BEADS_W))
                greatest = fmax(greatest, fabs(a + share * (b_ - a) - place->state[k]));
        }
        if (greatest < KNOWN)
            return 1;
    }
    return 0;
}

/* Follow the curve through a solution both ways. */
static fst_status follow(tracer *t, double value, const beads_lock *lock, fst_error *error)
{
    fst_status status = beads_curve_follow(&t->curve, value, lock, error);
    for (int way = 0; way < 2 && status == FST_OK; ++way) {
        fst_curve_end end = {.type = t->curve.ends[way].type};
        memcpy(end.reason, t->curve.ends[way].reason, sizeof end.reason);
        status = fst_branch_add_end(t->out, t->out->branches, -1, t->curve.ends[way].value, &end, error);
    }
    ++t->out->branches;
    return status;
}

/* Places at a value that lie on no curve yet. */
static fst_status begin_at(tracer *t, double value, fst_error *error)
{
    fst_levitation_list list;
    fst_params params;
    beads_lock lock;
    fst_status status = params_at(t, value, &params, error);
    if (status == FST_OK)
        status = fst_levitation_find(&params, NULL, &list, error);
    if (status != FST_OK)
        return status;
    for (size_t i = 0; i < list.count && status == FST_OK; ++i) {
        memset(&lock, 0, sizeof lock);
        memcpy(lock.state, list.states[i].state, sizeof list.states[i].state);
        if (list.states[i].family)
            status =
                fst_fail(error, FST_BAD_INPUT, "medium.spin_drag_rate",
                         "without a drag on the rotation a place is one of a family with all spins, so that no "
                         "single curve goes through it: give medium.spin_drag_rate, as small as you like");
        else if (!is_on_curve(t->out, value, &list.states[i]))
            status = follow(t, value, &lock, error);
    }
    fst_levitation_free(&list);
    return status;
}

static fst_status follow_places(tracer *t, fst_error *error)
{
    const fst_branch_options *o = t->options;
    fst_status status = fst_lapack_load(&t->curve.lapack, error);
    for (int i = 0; i < STARTS && status == FST_OK; ++i) {
        t->done = (double)i / STARTS;
        status = begin_at(t, o->from + (o->to - o->from) * (i + 0.5) / STARTS, error);
    }
    return status;
}

static fst_status follow_motion(tracer *t, fst_error *error)
{
    const fst_beads_options run = fst_default_beads_options();
    fst_family family;
    beads_lock lock;
    double start[BEADS_NUMBERS];
    fst_status status = fst_family_begin_in_world(&family, &t->params, t->options->key, error);
    if (status != FST_OK)
        return status;
    const double given = fst_family_value(&family);
    const double value = given >= t->curve.low && given <= t->curve.high ? given : t->options->from;
    fst_params params;
    status = params_at(t, value, &params, error);
    if (status == FST_OK)
        status = world_strobe_set(&t->strobe, &params, &run, start, error);
    if (status == FST_OK)
        status = world_strobe_find(&t->strobe, &params, start, &lock, error);
    t->curve.lapack = t->strobe.lapack;
    t->curve.repeat = &t->strobe.repeat;
    return status == FST_OK ? follow(t, value, &lock, error) : status;
}

fst_status fst_follow_world(const fst_params *params, const fst_branch_options *options, fst_branch *branch,
                            fst_error *error)
{
    if (options->second_key)
        return fst_fail(error, FST_BAD_INPUT, "fst_branch_options.second_key",
                        "branches of a bead in a world are followed over one parameter alone");
    tracer *t = calloc(1, sizeof *t);
    if (!t)
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    t->params = *params;
    t->params.run_rtol = options->tolerance;
    t->options = options;
    t->driven = options->kind == FST_BRANCH_DRIVEN;
    t->out = branch;
    t->curve = (beads_curve){.count = 1,
                             .low = fmin(options->from, options->to),
                             .high = fmax(options->from, options->to),
                             .longest = options->longest_step,
                             .share = t->driven ? 0.1 : 0.02, /* a point of a motion takes a hundred periods */
                             .user = t,
                             .keep = keep,
                             .keep_special = keep_special,
                             .reverse = reverse};
    t->curve.over = (beads_free_world){world_at, t, t->curve.high - t->curve.low};
    const fst_status status = t->driven ? follow_motion(t, error) : follow_places(t, error);
    fst_model_free(t->model);
    fst_model_free(t->strobe.model);
    free(t);
    return status;
}
