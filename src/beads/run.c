/* run.c - a run of several beads, by either method.
 *
 *     start           discard - 1 turn   discard          half            end - 1 turn   end
 *       |-------------------|---------------|---------------|-------------------|----------|
 *                            groups at the                                       groups at the
 *                            window's start                                      end: the same?
 *
 * Means are those of the window from run.discard to the end (seen.c).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bracket.h"
#include "base/constants.h"
#include "base/error.h"
#include "base/grow.h"
#include "base/watch.h"
#include "beads/flow.h"
#include "beads/seen.h"
#include "beads/select.h"
#include "beads/setup.h"
#include "beads/steps.h"
#include "model/drive.h"

enum { DENSE_ROW = (BEADS_DIM + 1) / 2 * 2 };
static const double LEAST_STEPS = 20, MOST_STEPS = 1e7;

fst_beads_options fst_default_beads_options(void)
{
    return (fst_beads_options){.cookie = FST_BEADS_OPTIONS_COOKIE,
                               .pair_rate = NAN,
                               .pair_mu = NAN,
                               .chi = NAN,
                               .sample_spacing = NAN,
                               .steps_per_turn = 2000};
}

typedef struct run {
    fst_beads_method method;
    beads_flow flow;   /* of the exact method */
    beads_steps steps; /* of stepping */
    beads_world world;
    fst_model *model;
    const fst_beads_options *options;
    double end, spacing; /* of samples */
    int64_t sampled;     /* samples so far */
    double *state, *centres;
    beads_groups groups; /* of the window's start */
    beads_moment at[3];
    beads_two *bonds; /* of the turn before the groups are found */
    int bond_count;
} run;

static beads_seen see(const run *r)
{
    if (r->method == FST_BEADS_STEPPING) {
        const beads_steps *s = &r->steps;
        return (beads_seen){&r->world, s->y,    s->gone,   s->ejected, s->turned,
                            s->r,      s->load, s->height, s->work,    s->h * (double)s->steps,
                            s->impacts};
    }
    const beads_flow *flow = &r->flow;
    const double *integral = flow->step.y + FST_BEAD_NUMBERS * r->world.count;
    return (beads_seen){&r->world,    flow->step.y,       flow->modes.gone,      flow->ejected,
                        flow->turned, integral + BEADS_R, integral + BEADS_LOAD, integral + BEADS_HEIGHT,
                        integral,     flow->t.high,       flow->impacts};
}

/* ------------------------------------------------------------------ samples */

/* The closed contacts of a look, with their forces. */
static int closed_contacts(const beads_world *world, const beads_modes *modes, const beads_look *look,
                           fst_bead_touch *touches)
{
    int count = 0;
    for (int k = 0; k < world->contacts; ++k)
        if (modes->contact[k] != BEADS_OPEN) {
            const beads_contact *c = &world->contact[k];
            const double force = beads_load(modes, look, k);
            touches[count++] = (fst_bead_touch){{c->first, c->second}, force};
        }
    return count;
}

/* The contacts of a step that press. */
static int pressing_contacts(const beads_steps *steps, fst_bead_touch *touches)
{
    int count = 0;
    for (int c = 0; c < steps->touch_count; ++c) {
        const beads_touch *t = &steps->touches[c];
        const int second = t->second == steps->world.count ? -1 : t->second;
        if (t->push > 0)
            touches[count++] = (fst_bead_touch){{t->first, second}, t->push / steps->h};
    }
    return count;
}

/* A bead that is gone stands since then, at rest in the laboratory, from whose axes the frame has `turned` on. */
static void let_stand(double turned, double *bead)
{
    double place[3], n[3];
    fst_drive_to_laboratory(-turned / FST_TWO_PI, bead, place);
    fst_drive_to_laboratory(-turned / FST_TWO_PI, bead + BEADS_N, n);
    memset(bead, 0, FST_BEAD_NUMBERS * sizeof *bead);
    memcpy(bead, place, sizeof place);
    memcpy(bead + BEADS_N, n, sizeof n);
}

/* Tell the sample of the numbers y at the time t. */
static fst_status tell_sample(run *r, double t, double *y, int count, const fst_bead_touch *touches,
                              fst_error *error)
{
    const beads_seen seen = see(r);
    for (int i = 0; i < r->world.count; ++i) {
        double *bead = y + FST_BEAD_NUMBERS * i, *n = bead + BEADS_N;
        if (t > seen.ejected[i]) /* never of one that is not gone: NAN */
            let_stand(beads_frame_turned(&r->world, seen.ejected[i], t), bead);
        const double norm = sqrt(beads_dot(n, n));
        bead[2] += isnan(r->world.plate) ? 0.0 : r->world.body[i].radius;
        for (int k = 0; k < 3; ++k)
            n[k] /= norm;
    }
    const double turns =
        r->world.surrounded ? fst_magnet_turns(&r->world.around, t) : t * r->world.omega / FST_TWO_PI;
    const fst_beads_sample sample = {t, turns, r->world.count, y, count, touches};
    ++r->sampled;
    return r->options->sample(r->options->user, &sample, error);
}

/* The fraction of the exact step, which takes the time `whole`, at which the time `part` of it has passed.  Where dry
 * friction has steps measured in theta (flow.c), time is one of their numbers, and no straight line. */
static double fraction_at(const run *r, double part, double whole)
{
    enum { MOST = 60, HALVED = 4 };
    static const double CLOSE = 1e-14;
    const int time = FST_BEAD_NUMBERS * r->world.count + BEADS_TIME;
    fst_bracket z = {0.0, 1.0, -part, whole - part, 0};
    double x = fmin(part / whole, 1.0), passed;
    for (int i = 1; i < MOST && x > z.lo && x < z.hi; ++i) {
        beads_method_evaluate_dense(1, &r->flow.step.dense[0][time], DENSE_ROW, x, &passed);
        if (fabs(passed - part) <= CLOSE * whole)
            break;
        fst_bracket_take(&z, x, passed - part);
        x = i % HALVED == 0 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
    }
    return x;
}

/* Tell the samples of the exact step from the time `from` to `to`, by its dense output. */
static fst_status tell_exact(run *r, double from, double to, fst_error *error)
{
    static const double EARLY = 1e-12; /* over the spacing: a sample at the very end of a step or of the run */
    const beads_modes *modes = &r->flow.during;
    const size_t numbers = (size_t)(FST_BEAD_NUMBERS * r->world.count);
    fst_bead_touch touches[BEADS_CONTACTS];
    double y[BEADS_DIM];
    fst_status status = FST_OK;
    if (r->world.surrounded) /* the piece of the drive in which this step lies */
        (void)fst_waveform_enter(&r->world.around.drive, from);
    while (status == FST_OK && to > from) {
        const double next = (double)r->sampled * r->spacing;
        if (next > to + EARLY * r->spacing)
            break;
        beads_look look;
        if (r->sampled == 0)
            memcpy(y, r->state, numbers * sizeof *y);
        else
            beads_method_evaluate_dense((int)numbers, &r->flow.step.dense[0][0], DENSE_ROW,
                                        fraction_at(r, next - from, to - from), y);
        y[numbers + BEADS_TIME] = fmin(next, to) - r->world.now;
        beads_look_at(&r->world, modes, y, &look);
        const int count = closed_contacts(&r->world, modes, &look, touches);
        status = tell_sample(r, fmin(next, to), y, count, touches, error);
    }
    return status;
}

/* Of stepping: tell the start, and the state of the first step that ends at a sample's time or behind it. */
static fst_status tell_stepped(run *r, double to, fst_error *error)
{
    const size_t numbers = (size_t)(FST_BEAD_NUMBERS * r->world.count);
    double *y = malloc(numbers * sizeof *y);
    fst_bead_touch *touches = malloc(((size_t)r->steps.touch_count + 1) * sizeof *touches);
    fst_status status =
        y && touches ? FST_OK : fst_fail(error, FST_NO_MEMORY, "beads", "out of memory for a sample");
    if (status == FST_OK && r->sampled == 0) {
        memcpy(y, r->state, numbers * sizeof *y);
        status = tell_sample(r, 0.0, y, 0, touches, error);
    }
    if (status == FST_OK && (double)r->sampled * r->spacing <= to + 0.5 * r->steps.h) {
        memcpy(y, r->steps.y, numbers * sizeof *y);
        status = tell_sample(r, to, y, pressing_contacts(&r->steps, touches), touches, error);
        r->sampled = llround(floor(to / r->spacing + 0.5 * r->steps.h / r->spacing)) + 1;
    }
    free(y);
    free(touches);
    return status;
}

static fst_status tell_samples(run *r, double from, double to, fst_error *error)
{
    if (!r->options->sample)
        return FST_OK;
    return r->method == FST_BEADS_STEPPING ? tell_stepped(r, to, error) : tell_exact(r, from, to, error);
}

/* ------------------------------------------------------------------ the way */

/* Whether it has come to the time `limit`; equal steps end as near as they can. */
static int is_there(const run *r, double limit)
{
    return r->method == FST_BEADS_STEPPING ? r->steps.steps >= llround(limit / r->steps.h)
                                           : r->flow.t.high >= limit;
}

static fst_status go(run *r, double limit, fst_error *error)
{
    return r->method == FST_BEADS_STEPPING ? beads_step(&r->steps, error) : beads_go(&r->flow, limit, error);
}

static fst_status go_on(run *r, double limit, fst_error *error)
{
    fst_status status = FST_OK;
    for (beads_seen seen = see(r); status == FST_OK && !is_there(r, limit);) {
        const double from = seen.time;
        beads_find_centres(&seen, &r->groups, r->centres);
        status = go(r, limit, error);
        seen = see(r);
        beads_follow(&seen, r->centres, seen.time - from, &r->groups);
        if (r->at[1].time > 0)
            beads_follow_swings(&seen, r->at);
        r->bond_count = beads_keep_bonds(&r->world, seen.gone, seen.y, r->bonds, r->bond_count);
        if (status == FST_OK)
            status = tell_samples(r, from, seen.time, error);
        if (status == FST_OK)
            status = fst_tell(r->options->progress, fmin(seen.time / r->end, 1.0), NULL, error);
    }
    return status;
}

/* Go on to `limit`, and find the groups of the turn before it. */
static fst_status go_and_group(run *r, double limit, fst_bead_group *groups, int *members, int *count,
                               fst_error *error)
{
    fst_status status = go_on(r, fmax(limit - FST_TWO_PI / r->world.omega, 0.0), error);
    beads_seen seen = see(r);
    if (status == FST_OK)
        status = beads_find_bonds(&r->world, seen.gone, seen.y, &r->bonds, &r->bond_count, error);
    if (status == FST_OK)
        status = go_on(r, limit, error);
    if (status == FST_OK)
        *count = beads_group(r->world.count, seen.gone, r->bonds, r->bond_count, groups, members);
    free(r->bonds);
    r->bonds = NULL;
    r->bond_count = 0;
    return status;
}

/* ------------------------------------------------------------------ what is told */

/* The contacts, and what happened there. */
static void tell_contacts(const beads_flow *flow, fst_beads_result *result)
{
    result->touch_count = closed_contacts(&flow->world, &flow->modes, &flow->start, result->touches);
    result->forces_unique = flow->start.unique;
    result->event_count = flow->event_count;
    memcpy(result->events, flow->events, sizeof flow->events);
    memcpy(result->counts, flow->counts, sizeof result->counts);
    result->rhs_calls = flow->looks;
    result->accepted = flow->accepted;
    result->rejected = flow->rejected;
}

/* The contacts left no motion, or several, or one that does not come on: the groups are those of that moment. */
static fst_status tell_paradox(run *r, fst_beads_result *result, fst_error *error)
{
    static const char *const found[] = {"there is no consistent state", "impacts and releases do not end",
                                        "there are several motions"};
    const int is_dry = beads_is_dry(&r->world);
    const fst_beads_paradox *paradox = &r->flow.paradox;
    const int is_sure = paradox->motions != 0 || paradox->touch_count <= BEADS_MOST_TRIED;
    const beads_seen seen = see(r);
    const fst_status status = beads_find_bonds(&r->world, seen.gone, seen.y, &r->bonds, &r->bond_count, error);
    if (status != FST_OK)
        return status;
    result->paradox = *paradox;
    result->group_count =
        beads_group(r->world.count, seen.gone, r->bonds, r->bond_count, result->groups, result->members);
    result->outcome = FST_BEADS_UNDECIDED;
    (void)snprintf(result->reason, sizeof result->reason,
                   "%s at t = %.6g %s of %d contacts%s; run.method: stepping goes on",
                   paradox->motions == 1 || !is_sure ? "crowded:" : "paradox:", paradox->time,
                   is_sure ? found[paradox->motions] : "no consistent state was found", paradox->touch_count,
                   is_dry ? " with dry friction" : "");
    return FST_OK;
}

static fst_status tell_steps(const beads_steps *s, fst_beads_result *result, fst_error *error)
{
    if (!fst_resize(&result->touches, (size_t)s->touch_count + 1, sizeof *result->touches))
        return fst_fail(error, FST_NO_MEMORY, "beads", "out of memory for %d contacts", s->touch_count);
    result->touch_count = pressing_contacts(s, result->touches);
    result->event_count = s->event_count;
    memcpy(result->events, s->events, FST_BEADS_EVENTS * sizeof *s->events);
    memcpy(result->counts, s->counts, sizeof result->counts);
    result->rhs_calls = result->accepted = (uint64_t)s->steps;
    result->solver_residual = s->residual;
    result->solver_sweeps = s->sweeps;
    result->deepest = s->deepest;
    return FST_OK;
}

/* Begin by the method. */
static fst_status begin(run *r, const fst_params *p, double steps_per_turn, fst_error *error)
{
    if (r->method == FST_BEADS_EXACT)
        return beads_begin(&r->flow, &r->world, r->state, p->run_rtol, error);
    if (!(steps_per_turn >= LEAST_STEPS && steps_per_turn <= MOST_STEPS))
        return fst_fail(
            error, FST_BAD_INPUT, "run.step",
            "time stepping makes %g steps in a turn of the drive; it needs %g to %g (2000 is usual)",
            steps_per_turn, LEAST_STEPS, MOST_STEPS);
    return beads_steps_begin(&r->steps, &r->world, r->state, FST_TWO_PI / (r->world.omega * steps_per_turn),
                             error);
}

/* `status`: of the beginning, which contacts may have left without a motion. */
static fst_status simulate(run *r, const fst_params *p, fst_status status, fst_beads_result *result,
                           fst_error *error)
{
    const double period = FST_TWO_PI / r->world.omega, discard = fst_run_discard(p);
    const double energy = beads_energy(&r->world, see(r).gone, see(r).y);
    beads_seen seen;
    r->end = fst_run_periods(p) * period;
    r->spacing = isnan(r->options->sample_spacing) ? period / p->run_samples : r->options->sample_spacing;
    r->flow.dense = r->options->sample != NULL;
    r->flow.during = r->flow.modes;
    if (status == FST_OK)
        status = go_and_group(r, discard * period, r->groups.group, r->groups.members, &r->groups.count, error);
    seen = see(r);
    beads_keep(&seen, &r->groups, &r->at[0]);
    if (status == FST_OK)
        status = go_on(r, 0.5 * (discard + fst_run_periods(p)) * period, error);
    seen = see(r);
    beads_keep(&seen, &r->groups, &r->at[1]);
    if (status == FST_OK)
        status = go_and_group(r, r->end, result->groups, result->members, &result->group_count, error);
    seen = see(r);
    beads_keep(&seen, &r->groups, &r->at[2]);
    const int is_paradox =
        r->method == FST_BEADS_EXACT && status == FST_NO_CONVERGENCE && !isnan(r->flow.paradox.time);
    if (status != FST_OK && !is_paradox)
        return status;
    beads_conclude(&seen, &r->groups, r->at, result);
    result->periods = fst_run_periods(p);
    if (r->method == FST_BEADS_STEPPING) {
        result->energy_residual = beads_steps_residual(&r->steps, energy);
        return tell_steps(&r->steps, result, error);
    }
    result->energy_residual = beads_residual(&r->flow, energy);
    result->energy_scale = beads_work(&r->flow, energy);
    tell_contacts(&r->flow, result);
    return is_paradox ? tell_paradox(r, result, error) : FST_OK;
}

/* ------------------------------------------------------------------ the call */

void fst_beads_free(fst_beads_result *result)
{
    free(result->beads);
    free(result->groups);
    free(result->members);
    free(result->touches);
    free(result->events);
    memset(result, 0, sizeof *result);
}

static fst_status make_room(run *r, int count, fst_beads_result *result, fst_error *error)
{
    const size_t n = (size_t)count;
    result->count = count;
    result->beads = calloc(n, sizeof *result->beads);
    result->groups = calloc(n, sizeof *result->groups);
    result->members = calloc(n, sizeof *result->members);
    result->touches = calloc(BEADS_CONTACTS, sizeof *result->touches);
    result->events = calloc(FST_BEADS_EVENTS, sizeof *result->events);
    r->state = calloc(n * FST_BEAD_NUMBERS, sizeof *r->state);
    r->centres = calloc(n * BEADS_CENTRE, sizeof *r->centres);
    if (!result->beads || !result->groups || !result->members || !result->touches || !result->events ||
        !r->state || !r->centres)
        return fst_fail(error, FST_NO_MEMORY, "beads", "out of memory for %d beads", count);
    return beads_make_room(count, &r->groups, r->at, error);
}

static fst_status make_run(run *r, const fst_params *beads, int count, const fst_beads_options *options,
                           fst_beads_result *result, fst_error *error)
{
    fst_status status = make_room(r, count, result, error);
    r->options = options;
    r->method = result->method = options->method;
    result->steps_per_turn = r->method == FST_BEADS_STEPPING ? options->steps_per_turn : NAN;
    if (status == FST_OK)
        status = beads_set_up(beads, count, options, &r->model, &r->world, r->state, error);
    if (status != FST_OK)
        return status;
    status = begin(r, &beads[0], options->steps_per_turn, error);
    if (status == FST_OK || (r->method == FST_BEADS_EXACT && status == FST_NO_CONVERGENCE))
        status = simulate(r, &beads[0], status, result, error);
    return status;
}

fst_status fst_beads_run(const fst_params *beads, int count, const fst_beads_options *options,
                         fst_beads_result *result, fst_error *error)
{
    const int most = options->method == FST_BEADS_STEPPING ? FST_BEADS_MANY : FST_BEADS_MOST;
    memset(result, 0, sizeof *result);
    result->paradox.time = NAN;
    if (options->cookie != FST_BEADS_OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_beads_run",
                        "the options were never initialised: get them from fst_default_beads_options()");
    if (count < 1 || count > most)
        return fst_fail(error, FST_BAD_INPUT, "beads", "%d beads: the method %s takes 1 to %d", count,
                        fst_beads_method_name(options->method), most);
    run *r = calloc(1, sizeof *r);
    if (!r)
        return fst_fail(error, FST_NO_MEMORY, "fst_beads_run", "out of memory");
    const fst_status status = make_run(r, beads, count, options, result, error);
    if (status != FST_OK)
        fst_beads_free(result);
    beads_free_room(&r->groups, r->at);
    beads_steps_free(&r->steps);
    fst_model_free(r->model);
    free(r->state);
    free(r->centres);
    free(r->bonds);
    free(r);
    return status;
}
