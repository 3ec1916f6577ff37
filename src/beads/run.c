/* run.c - a run of several beads, and what is told of it.
 *
 *     start           discard - 1 turn   discard          half            end - 1 turn   end
 *       |-------------------|---------------|---------------|-------------------|----------|
 *                            groups at the                                       groups at the
 *                            window's start                                      end: the same?
 *
 * Means are those of the window from run.discard to the end.  A motion is undecided where its groups are others at
 * the end than at the window's start, or where the mean r of a bead in the second half of the window is another than
 * in the first.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/listed.h"
#include "base/watch.h"
#include "beads/groups.h"
#include "beads/setup.h"

#define FST_BEADS_OPTIONS_COOKIE 0xfe570006u

static const double UNSETTLED = 0.05;   /* greatest change of a mean r between the halves of the window */
static const double WITH_MAGNET = 0.02; /* rates that differ by less, over omega, are the same */
static const double AT_AXIS = 0.5;      /* a centre nearer than this part of a radius stays at the axis */
static const double AT_REST = 1e-6;     /* speed in the turning frame below which a bead is locked */

fst_beads_options fst_default_beads_options(void)
{
    return (fst_beads_options){.cookie = FST_BEADS_OPTIONS_COOKIE, .pair_rate = NAN, .chi = NAN};
}

const char *fst_bead_event_name(fst_bead_event_kind kind)
{
    FST_NAME_IN(FST_BEAD_EVENT_LIST, kind, "unknown");
}

const char *fst_bead_group_name(fst_bead_group_kind kind)
{
    FST_NAME_IN(FST_BEAD_GROUPS, kind, "unknown");
}

const char *fst_beads_outcome_name(fst_beads_outcome outcome)
{
    FST_NAME_IN(FST_BEADS_OUTCOMES, outcome, "unknown");
}

/* What a flow has added up at a moment. */
typedef struct moment {
    double time, integral[BEADS_INTEGRALS], impacts, turned[FST_BEADS_MOST], twisted[BEADS_CONTACTS];
    double centre_turned[FST_BEADS_MOST], centre_r[FST_BEADS_MOST]; /* of the groups of the window */
} moment;

typedef struct run {
    beads_flow flow;
    fst_model *model;
    const fst_progress *progress;
    double end;
    int group_count; /* at the window's start */
    fst_bead_group groups[FST_BEADS_MOST];
    double centre_turned[FST_BEADS_MOST], centre_r[FST_BEADS_MOST];
} run;

static moment now(const run *r)
{
    moment m;
    m.time = r->flow.t.high;
    m.impacts = r->flow.impacts;
    memcpy(m.integral, r->flow.step.y + FST_BEAD_NUMBERS * r->flow.world.count, sizeof m.integral);
    memcpy(m.turned, r->flow.turned, sizeof m.turned);
    memcpy(m.twisted, r->flow.twisted, sizeof m.twisted);
    memcpy(m.centre_turned, r->centre_turned, sizeof m.centre_turned);
    memcpy(m.centre_r, r->centre_r, sizeof m.centre_r);
    return m;
}

/* ------------------------------------------------------------------ the way */

/* The centre of a group, in the plane, and the rate of its distance from the axis. */
static void centre_of(const run *r, const fst_bead_group *group, double x[2], double *distance, double *rate)
{
    double mass = 0.0, v[2] = {0.0, 0.0};
    x[0] = x[1] = 0.0;
    for (int i = 0; i < group->count; ++i) {
        const double *bead = r->flow.step.y + FST_BEAD_NUMBERS * group->members[i];
        const double m = r->flow.world.body[group->members[i]].mass;
        mass += m;
        for (int k = 0; k < 2; ++k) {
            x[k] += m * bead[k];
            v[k] += m * bead[BEADS_V + k];
        }
    }
    x[0] /= mass;
    x[1] /= mass;
    *distance = hypot(x[0], x[1]);
    *rate = *distance > 0 ? (x[0] * v[0] + x[1] * v[1]) / (mass * *distance) : 0.0;
}

/* One step, with the centres of the groups followed over it, by trapezia with their correction at the ends. */
static fst_status step(run *r, double limit, fst_error *error)
{
    double x[FST_BEADS_MOST][2], distance[FST_BEADS_MOST], rate[FST_BEADS_MOST], end[2], d, d_rate;
    const double from = r->flow.t.high;
    for (int g = 0; g < r->group_count; ++g)
        centre_of(r, &r->groups[g], x[g], &distance[g], &rate[g]);
    fst_status status = beads_go(&r->flow, limit, error);
    const double h = r->flow.t.high - from;
    for (int g = 0; g < r->group_count && status == FST_OK; ++g) {
        centre_of(r, &r->groups[g], end, &d, &d_rate);
        r->centre_turned[g] += atan2(x[g][0] * end[1] - x[g][1] * end[0], x[g][0] * end[0] + x[g][1] * end[1]);
        r->centre_r[g] += 0.5 * h * (distance[g] + d) + h * h / 12.0 * (rate[g] - d_rate);
    }
    if (status == FST_OK)
        status = fst_tell(r->progress, fmin(r->flow.t.high / r->end, 1.0), NULL, error);
    return status;
}

static fst_status go_on(run *r, double limit, fst_error *error)
{
    fst_status status = FST_OK;
    while (status == FST_OK && r->flow.t.high < limit)
        status = step(r, limit, error);
    return status;
}

/* Go on to `limit`, and find the groups of the turn before it. */
static fst_status go_and_group(run *r, double limit, fst_bead_group *groups, int *count, fst_error *error)
{
    const double period = FST_TWO_PI / r->flow.world.omega;
    fst_status status = go_on(r, fmax(limit - period, 0.0), error);
    for (int k = 0; k < r->flow.world.contacts; ++k)
        r->flow.widest[k] = r->flow.start.gap[k];
    if (status == FST_OK)
        status = go_on(r, limit, error);
    if (status == FST_OK)
        *count = beads_group(&r->flow, groups);
    return status;
}

/* ------------------------------------------------------------------ what is told */

static fst_regime regime_of(const beads_flow *flow, int i, double mean_alpha_dot)
{
    const double omega = flow->world.omega, *bead = flow->step.y + FST_BEAD_NUMBERS * i;
    const double u = bead[BEADS_V] + omega * bead[1], v = bead[BEADS_V + 1] - omega * bead[0];
    if (flow->modes.gone[i])
        return FST_REGIME_EJECTED;
    if (fabs(mean_alpha_dot - omega) < WITH_MAGNET * omega)
        return hypot(u, v) < AT_REST ? FST_REGIME_LOCKED : FST_REGIME_LIBRATING;
    return mean_alpha_dot < 0 ? FST_REGIME_COUNTER_ROTATING : FST_REGIME_COROTATING;
}

static void tell_beads(const run *r, const moment *from, const moment *to, fst_beads_result *result)
{
    const beads_flow *flow = &r->flow;
    const double time = to->time - from->time;
    for (int i = 0; i < flow->world.count; ++i) {
        fst_bead_result *bead = &result->beads[i];
        const double weight = flow->world.body[i].mass * flow->world.gravity;
        bead->mean_r = (to->integral[BEADS_R + i] - from->integral[BEADS_R + i]) / time;
        bead->mean_alpha_dot = flow->world.omega + (to->turned[i] - from->turned[i]) / time;
        bead->mean_load_weights =
            (to->integral[BEADS_LOAD + i] - from->integral[BEADS_LOAD + i]) / (time * weight);
        bead->ejected_at = flow->ejected[i];
        bead->regime = regime_of(flow, i, bead->mean_alpha_dot);
        if (flow->modes.gone[i])
            bead->mean_r = bead->mean_alpha_dot = bead->mean_load_weights = NAN;
        memcpy(bead->final_state, flow->step.y + FST_BEAD_NUMBERS * i, sizeof bead->final_state);
        bead->final_state[2] += flow->world.body[i].radius;
    }
}

static void tell_groups(const run *r, const moment *from, const moment *to, int same, fst_beads_result *result)
{
    const double time = to->time - from->time, omega = r->flow.world.omega;
    for (int g = 0; g < result->group_count; ++g) {
        fst_bead_group *group = &result->groups[g];
        const int last = group->members[group->count - 1];
        const int pair = group->count > 1 ? beads_pair_number(&r->flow.world, group->members[0], last) : -1;
        group->mean_r = group->centre_rate = group->axis_rate = NAN;
        if (!same)
            continue;
        group->mean_r = (to->centre_r[g] - from->centre_r[g]) / time;
        if (group->mean_r > AT_AXIS * r->flow.world.body[last].radius)
            group->centre_rate = omega + (to->centre_turned[g] - from->centre_turned[g]) / time;
        if (pair >= 0)
            group->axis_rate = omega + (to->twisted[pair] - from->twisted[pair]) / time;
    }
}

static void tell_contacts(const run *r, fst_beads_result *result)
{
    const beads_flow *flow = &r->flow;
    for (int k = 0; k < flow->world.contacts; ++k)
        if (flow->modes.contact[k] != BEADS_OPEN) {
            const beads_contact *c = &flow->world.contact[k];
            const double force = flow->modes.contact[k] == BEADS_PRESSING ? flow->start.held[k] : 0.0;
            result->touches[result->touch_count++] = (fst_bead_touch){{c->first, c->second}, force};
        }
    result->forces_unique = flow->start.unique;
    result->event_count = flow->event_count;
    memcpy(result->events, flow->events, sizeof result->events);
    memcpy(result->counts, flow->counts, sizeof result->counts);
}

static int same_groups(const run *r, const fst_beads_result *result)
{
    if (r->group_count != result->group_count)
        return 0;
    for (int g = 0; g < r->group_count; ++g) {
        const fst_bead_group *a = &r->groups[g], *b = &result->groups[g];
        if (a->kind != b->kind || a->count != b->count ||
            memcmp(a->members, b->members, sizeof a->members) != 0)
            return 0;
    }
    return 1;
}

static fst_beads_outcome outcome_of_group(const fst_bead_group *group, double omega, fst_beads_result *result)
{
    const size_t room = sizeof result->reason;
    if (group->kind == FST_BEAD_GROUP_SINGLE) {
        (void)snprintf(result->reason, room, "no bead touches another");
        return FST_BEADS_APART;
    }
    if (group->kind == FST_BEAD_GROUP_RING || group->kind == FST_BEAD_GROUP_CLUSTER) {
        (void)snprintf(result->reason, room, "%d beads form a %s", group->count,
                       fst_bead_group_name(group->kind));
        return group->kind == FST_BEAD_GROUP_RING ? FST_BEADS_RING : FST_BEADS_CLUSTER;
    }
    const int used =
        snprintf(result->reason, room, "the axis of %d beads turns at %.4g of the drive's rate, their centre ",
                 group->count, group->axis_rate / omega);
    if (isnan(group->centre_rate))
        (void)snprintf(result->reason + used, room - (size_t)used, "stays at the axis");
    else
        (void)snprintf(result->reason + used, room - (size_t)used, "at %.4g, %.4g l from the axis",
                       group->centre_rate / omega, group->mean_r);
    if (!(fabs(group->axis_rate - omega) < WITH_MAGNET * omega))
        return FST_BEADS_UNDECIDED;
    if (isnan(group->centre_rate))
        return FST_BEADS_BAR;
    return fabs(group->centre_rate - omega) > WITH_MAGNET * omega ? FST_BEADS_WALKER : FST_BEADS_UNDECIDED;
}

static void decide(const run *r, const moment at[3], int same, fst_beads_result *result)
{
    const size_t room = sizeof result->reason;
    const fst_bead_group *largest = &result->groups[0];
    for (int i = 0; i < result->count; ++i)
        if (r->flow.modes.gone[i]) {
            result->outcome = FST_BEADS_EJECTED;
            (void)snprintf(result->reason, room, "bead %d passed the plate's edge at t = %.6g", i,
                           r->flow.ejected[i]);
            return;
        }
    result->outcome = FST_BEADS_UNDECIDED;
    if (!same) {
        (void)snprintf(result->reason, room,
                       "the groups changed after the discard: make run.periods and "
                       "run.discard larger");
        return;
    }
    for (int i = 0; i < result->count; ++i) {
        const int q = BEADS_R + i;
        const double first = (at[1].integral[q] - at[0].integral[q]) / (at[1].time - at[0].time);
        const double second = (at[2].integral[q] - at[1].integral[q]) / (at[2].time - at[1].time);
        if (fabs(second - first) > UNSETTLED * fmax(result->beads[i].mean_r, r->flow.world.body[i].radius)) {
            (void)snprintf(result->reason, room,
                           "bead %d has not settled: its mean r goes from %.4g to %.4g in the window", i, first,
                           second);
            return;
        }
    }
    for (int g = 1; g < result->group_count; ++g)
        if (result->groups[g].count > largest->count)
            largest = &result->groups[g];
    result->outcome = outcome_of_group(largest, r->flow.world.omega, result);
}

static void conclude(const run *r, const moment at[3], double energy, fst_beads_result *result)
{
    const beads_flow *flow = &r->flow;
    const moment *from = &at[0], *to = &at[2];
    const double time = to->time - from->time;
    const int same = same_groups(r, result);
    result->count = flow->world.count;
    tell_beads(r, from, to, result);
    tell_groups(r, from, to, same, result);
    tell_contacts(r, result);
    decide(r, at, same, result);
    result->drive_power = (to->integral[BEADS_DRIVE] - from->integral[BEADS_DRIVE]) / time;
    result->plate_power = (to->integral[BEADS_PLATE] - from->integral[BEADS_PLATE]) / time;
    result->pair_power = (to->integral[BEADS_PAIR] - from->integral[BEADS_PAIR]) / time;
    result->impact_power = (to->impacts - from->impacts) / time;
    result->restitution = flow->world.restitution;
    result->energy_residual = beads_residual(flow, energy);
    result->omega = flow->world.omega;
    result->rhs_calls = flow->looks;
    result->accepted = flow->accepted;
    result->rejected = flow->rejected;
}

static fst_status simulate(run *r, const fst_params *p, fst_beads_result *result, fst_error *error)
{
    const double period = FST_TWO_PI / r->flow.world.omega, energy = beads_energy_now(&r->flow);
    const double discard = fst_run_discard(p);
    moment at[3];
    r->end = p->run_periods * period;
    fst_status status = go_and_group(r, discard * period, r->groups, &r->group_count, error);
    at[0] = now(r);
    if (status == FST_OK)
        status = go_on(r, 0.5 * (discard + p->run_periods) * period, error);
    at[1] = now(r);
    if (status == FST_OK)
        status = go_and_group(r, r->end, result->groups, &result->group_count, error);
    at[2] = now(r);
    if (status == FST_OK)
        conclude(r, at, energy, result);
    result->periods = p->run_periods;
    return status;
}

fst_status fst_beads_run(const fst_params *beads, int count, const fst_beads_options *options,
                         fst_beads_result *result, fst_error *error)
{
    beads_world world;
    double state[BEADS_NUMBERS];
    memset(result, 0, sizeof *result);
    if (options->cookie != FST_BEADS_OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_beads_run",
                        "the options were never initialised: get them from fst_default_beads_options()");
    run *r = calloc(1, sizeof *r);
    if (!r)
        return fst_fail(error, FST_NO_MEMORY, "fst_beads_run", "out of memory");
    r->progress = options->progress;
    fst_status status = beads_set_up(beads, count, options, &r->model, &world, state, error);
    if (status == FST_OK)
        status = beads_begin(&r->flow, &world, state, beads[0].run_rtol, error);
    if (status == FST_OK)
        status = simulate(r, &beads[0], result, error);
    fst_model_free(r->model);
    free(r);
    return status;
}
