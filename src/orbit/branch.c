/* branch.c - whole branches, as the public call makes them.  Each file uses those below it:
 *
 *      branch.c           checks the options, and chooses
 *        counter.c          the counter-rotating family: simulate until an orbit is found, begin there
 *        locked.c           every equilibrium, by Newton's method from many starts at several parameter values
 *          tracer.c           a list of branches still to be followed; one after another, each both ways
 *            curve.c            point by point
 *              special.c          special points between; a branch that is born there goes on the list
 *        world_branch.c     places where a bead floats, motions with the drive's period, by beads_curve.c
 *        special_curve.c    with two parameters: special points of one type, each followed as a curve over both
 *
 *                    .----- 1 ---- end            0 is followed first, from its start both ways;
 *       end ---- 0 --*-- start --- 0 --- end      1 and 2, born at its special points (*), wait on the list,
 *                    '----- 2 ---- end            and are followed away from there only.
 *
 * A branch that is met again (a curve that closes, the other end of one that is known) is recognised by its
 * numbers and not followed twice.  Of two conjugate orbits, images of each other under S2, only one is
 * followed; every end says on which branch the images lie.  Over two parameters the branches over the first are
 * followed for their special points alone, at the scene's value of the second.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/listed.h"
#include "base/number.h"
#include "model/params.h"
#include "model/worlds.h"
#include "orbit/branch_list.h"
#include "orbit/levitation.h"
#include "orbit/special_curve.h"
#include "orbit/tracer.h"

const char *fst_special_name(fst_special_type type)
{
    FST_NAME_IN(FST_SPECIALS, type, "unknown");
}

const char *fst_branch_kind_name(fst_branch_kind kind)
{
    FST_NAME_IN(FST_BRANCH_KINDS, kind, "unknown");
}

const char *fst_end_name(fst_end_type type)
{
    FST_NAME_IN(FST_ENDS, type, "unknown");
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
    free(branch->scene);
    memset(branch, 0, sizeof *branch);
}

/* The field `name` of the options is wrong. */
#define WRONG(name, ...) return fst_fail(error, FST_BAD_INPUT, "fst_branch_options." name, __VA_ARGS__)

/* Whether the friction force is another one under another load: asked of the model, with two weights that are
 * far beyond the magnet's pull, at a bead that slips. */
static fst_status ask_load(const fst_params *params, int *matters, fst_error *error)
{
    static const double slipping[FST_STATE_SIZE] = {1.0, 0.5, 0.3, -0.2, 1.0, 0.0, 0.0, 0.5, 0.7, 0.1};
    const double greatest = fst_param_at(fst_param_find("plate.gravity"))->greatest;
    double rates[2][FST_STATE_SIZE];
    for (int i = 0; i < 2; ++i) {
        fst_params weighed = *params;
        fst_model *model = NULL;
        weighed.plate_gravity = i ? greatest : 0.5 * greatest;
        const fst_status status = fst_model_new(&weighed, &model, error);
        if (status != FST_OK)
            return status;
        fst_rhs(model, slipping, rates[i]);
        fst_model_free(model);
    }
    *matters = memcmp(rates[0], rates[1], sizeof rates[0]) != 0;
    return FST_OK;
}

/* The motion must depend on the parameter. */
static fst_status check_effect(const char *field, const char *key, const fst_params *params, fst_error *error)
{
    static const char *const apart[] = {"start.", "run.", "plate.radius"};
    for (size_t i = 0; i < sizeof apart / sizeof *apart; ++i)
        if (strncmp(key, apart[i], strlen(apart[i])) == 0)
            return fst_fail(
                error, FST_BAD_INPUT, field,
                "no orbit and no locked state depends on %s: expected a parameter of the magnet, the "
                "bead, the drive or the model",
                key);
    if (strcmp(key, "plate.gravity") != 0 || fst_key_of_world(params))
        return FST_OK;
    int matters;
    const fst_status status = ask_load(params, &matters, error);
    if (status != FST_OK || matters)
        return status;
    char law[64];
    (void)fst_params_get(params, fst_param_find("friction.law"), law, sizeof law);
    return fst_fail(
        error, FST_BAD_INPUT, field,
        "with friction.law = %s no orbit and no locked state depends on plate.gravity: this friction is "
        "the same under every load; expected another parameter, or a law that asks for the load",
        law);
}

/* The motion must depend on the parameter, and both ends must be values that it can have.  (What is no
 * parameter at all, fst_family_begin() refuses.) */
static fst_status check_key(const char *field, const char *key, double from, double to,
                            const fst_params *params, fst_error *error)
{
    const int row = fst_param_find(key);
    fst_params ends[2] = {*params, *params};
    const fst_status status = check_effect(field, key, params, error);
    if (status != FST_OK || row < 0 || fst_param_at(row)->kind != FST_KIND_REAL)
        return status;
    for (int end = 0; end < 2; ++end) {
        fst_error why;
        char text[40];
        (void)fst_number_write(text, sizeof text, end ? to : from);
        if (fst_params_set(&ends[end], key, text, &why) != FST_OK)
            return fst_fail(error, FST_BAD_INPUT, field, "%s", why.sentence);
    }
    const fst_scene_change change = fst_params_changes(&ends[0], &ends[1]);
    if (change == FST_CHANGE_MOTION)
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, field,
                    "no orbit and no locked state depends on %s in this scene: along it %s; expected another "
                    "parameter, or another scene",
                    key,
                    change == FST_CHANGE_UNITS ? "only units change, because other keys fix the scaled numbers"
                                               : "nothing changes, because other keys leave it without effect");
}

static fst_status check_second(const fst_branch_options *o, const fst_params *params, fst_error *error)
{
    if (!isfinite(o->second_from) || !isfinite(o->second_to) || o->second_from == o->second_to)
        WRONG("second_from", "the second parameter needs a range with two different ends, not %g to %g",
              o->second_from, o->second_to);
    static const char *const followed[] = {FST_FOLLOWED_SPECIALS(FST_ROW_NAME)};
    if ((unsigned)o->special >= sizeof followed / sizeof *followed)
        WRONG("special", "curves of %s points are not followed over two parameters",
              fst_special_name(o->special));
    if (strcmp(o->second_key, o->key) == 0)
        WRONG("second_key", "the second parameter must not be %s again", o->key);
    return check_key("fst_branch_options.second_key", o->second_key, o->second_from, o->second_to, params,
                     error);
}

static fst_status check(const fst_branch_options *o, const fst_params *params, fst_error *error)
{
    if (o->cookie != FST_BRANCH_OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_branch_follow",
                        "the options were not made by fst_default_branch_options()");
    if (!isfinite(o->from) || !isfinite(o->to) || o->from == o->to)
        WRONG("from", "a branch needs a range with two different ends, not %g to %g", o->from, o->to);
    if (!(o->tolerance >= 1e-14 && o->tolerance <= 1e-6))
        WRONG("tolerance", "%g is out of range: 1e-14 to 1e-6", o->tolerance);
    if (!(o->longest_step > 1e-5))
        WRONG("longest_step", "%g is out of range: it must be greater than 1e-5", o->longest_step);
    const fst_status status = check_key("fst_branch_options.key", o->key, o->from, o->to, params, error);
    return status == FST_OK && o->second_key ? check_second(o, params, error) : status;
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
static fst_status begin_second(const fst_params *params, const fst_branch_options *o, double *at,
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
        WRONG("second_from",
              "the curves begin at the scene's %s = %.10g, which must lie within the range %.10g to %.10g",
              o->second_key, *at, o->second_from, o->second_to);
    return FST_OK;
}

/* What a branch says of itself. */
static void begin(const fst_params *params, const fst_branch_options *options, fst_branch *branch)
{
    branch->kind = options->kind;
    branch->from = options->from;
    branch->half_length = params->magnet_half_length;
    branch->gamma = params->friction_gamma;
    branch->to = options->to;
    (void)snprintf(branch->key, sizeof branch->key, "%s", options->key);
    if (options->second_key) {
        (void)snprintf(branch->second_key, sizeof branch->second_key, "%s", options->second_key);
        branch->second_from = options->second_from;
        branch->second_to = options->second_to;
        branch->followed = options->special;
    }
}

static fst_status finish(fst_status status, fst_branch *branch)
{
    branch->complete = status == FST_OK;
    if (status != FST_OK && status != FST_INTERRUPTED)
        fst_branch_free(branch);
    else if (!fst_branch_is_of_world(branch->kind))
        fst_branch_find_images(branch);
    return status;
}

fst_status fst_branch_follow(const fst_params *params, const fst_branch_options *options, fst_branch *branch,
                             fst_error *error)
{
    memset(branch, 0, sizeof *branch);
    double second_at;
    fst_status status = check(options, params, error);
    if (status == FST_OK && fst_branch_is_of_world(options->kind)) {
        begin(params, options, branch);
        return finish(fst_follow_world(params, options, branch, error), branch);
    }
    if (status == FST_OK)
        status = begin_second(params, options, &second_at, error);
    if (status != FST_OK)
        return status;
    fst_tracer *t = calloc(1, sizeof *t);
    if (!t)
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    t->options = options;
    t->out = branch;
    t->follow_hopf = options->kind == FST_BRANCH_ALL;
    fst_watch_begin(&t->watch, options->progress);
    fst_watch_part(&t->watch, 0.0, options->second_key ? 0.5 : 1.0);
    begin(params, options, branch);
    status =
        params->friction_law == FST_FRICTION_ROLLING && !(params->friction_rolling_resistance > 0)
            ? fst_fail(error, FST_BAD_INPUT, "friction.law",
                       "under friction.law: rolling a bead has no locked state and no orbit of its own: they "
                       "come in continua, so that no branch can be followed; give "
                       "friction.rolling_resistance, or another law")
            : FST_OK;
    if (status == FST_OK)
        status = fst_family_begin(&t->family, params, options->key, error);
    t->family.scale = fst_family_scale(options->key, options->from, options->to);
    fst_family_tighten(&t->family, options->tolerance);
    t->family.watch = &t->watch;
    if (status == FST_OK)
        status =
            options->kind == FST_BRANCH_COUNTER ? fst_follow_counter(t, error) : fst_follow_locked(t, error);
    if (options->second_key)
        keep_followed(t, second_at);
    if (status == FST_OK && options->second_key)
        status = follow_specials(t, params, error);
    free(t);
    return finish(status, branch);
}
