/* events.c - what ends the present state of contacts, and which one follows.
 *
 * May not become negative: the load of a pressing contact; the share theta of a grazing one, and 1 - theta; the
 * gap of an open one; the way to the plate's edge.  An event is armed where its value is positive at the start
 * of the step:
 *
 *     gap just opened     0 +- rounding: not armed up to ARMED; if it sinks first, the step is shortened
 *     load just begun     may be 0 too: not positive at the start, and negative at the end: STALE, an event
 *                         at the start
 *
 * Between the ends of a step a cubic through gaps and rates shows a contact that touches and parts.
 */
#include "beads/events.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "beads/impact.h"
#include "beads/select.h"

enum { MOST_CROWD = 1000 };
static const double ARMED = 1e-11, SUNK = -1e-13, CROWDED = 1e-3, STILL = 1e-6, AT_ONCE = 1e-12;

/* What may not become negative at contact k: the first value, or the second, which only a grazing one has. */
enum { FIRST, SECOND, VALUES };
static double value_of(const beads_flow *flow, const beads_look *look, int k, int value)
{
    if (value == SECOND)
        return flow->modes.contact[k] == BEADS_GRAZING ? 1.0 - look->held[k] : INFINITY;
    return flow->modes.contact[k] == BEADS_OPEN ? look->gap[k] : look->held[k];
}

static int is_armed(const beads_flow *flow, int k, int value)
{
    const double least = flow->modes.contact[k] == BEADS_OPEN ? ARMED : 0.0;
    return value_of(flow, &flow->start, k, value) > least;
}

/* The least value of contact k at a look that was armed at the start of the step. */
static double least_armed(const beads_flow *flow, const beads_look *look, int k)
{
    double least = INFINITY;
    for (int value = FIRST; value < VALUES; ++value)
        if (is_armed(flow, k, value))
            least = fmin(least, value_of(flow, look, k, value));
    return least;
}

/* Whether a value of contact k was not armed, and is negative at the end. */
static int fell_unarmed(const beads_flow *flow, int k)
{
    const double least = flow->modes.contact[k] == BEADS_OPEN ? SUNK : 0.0;
    for (int value = FIRST; value < VALUES; ++value)
        if (!is_armed(flow, k, value) && value_of(flow, &flow->end, k, value) < least)
            return 1;
    return 0;
}

static double to_edge(const beads_flow *flow, const double *y, int i)
{
    const double *bead = y + FST_BEAD_NUMBERS * i;
    return flow->world.plate_radius - sqrt(bead[0] * bead[0] + bead[1] * bead[1]);
}

double beads_least(const beads_flow *flow, const beads_look *look, const double *y, int *which)
{
    double least = INFINITY;
    *which = -1;
    for (int k = 0; k < flow->world.contacts; ++k) {
        const int counts = beads_can_meet(&flow->world, &flow->modes, k);
        const double value = counts ? least_armed(flow, look, k) : INFINITY;
        if (value < least) {
            least = value;
            *which = k;
        }
    }
    for (int i = 0; i < flow->world.count; ++i) {
        const double value = flow->modes.gone[i] ? INFINITY : to_edge(flow, y, i);
        if (value < least) {
            least = value;
            *which = BEADS_CONTACTS + i;
        }
    }
    return least;
}

/* The fraction of the step at which the cubic through gaps and rates is least, if it is negative there; else 0.
 */
static double brushes_at(const beads_flow *flow, int k)
{
    const double h = flow->step.h, g0 = flow->start.gap[k], g1 = flow->end.gap[k];
    const double r0 = h * flow->start.rate[k], r1 = h * flow->end.rate[k];
    if (!(r0 < 0 && r1 > 0))
        return 0.0;
    const double a = 2.0 * (g0 - g1) + r0 + r1, b = 3.0 * (g1 - g0) - 2.0 * r0 - r1;
    const double root = sqrt(fmax(b * b - 3.0 * a * r0, 0.0)),
                 x = -r0 / (b + root); /* of 3 a x^2 + 2 b x + r0 */
    const double least = g0 + x * (r0 + x * (b + x * a));
    return x > 1e-6 && x < 1.0 && least < 0 ? x : 0.0;
}

beads_verdict beads_judge(const beads_flow *flow, int *which, double *value)
{
    int brushing = -1;
    for (int k = 0; k < flow->world.contacts; ++k) {
        if (!beads_can_meet(&flow->world, &flow->modes, k))
            continue;
        const int open = flow->modes.contact[k] == BEADS_OPEN;
        *which = k;
        if (fell_unarmed(flow, k))
            return open ? BEADS_SINKS : BEADS_STALE;
        if (open && is_armed(flow, k, FIRST) && brushing < 0 && brushes_at(flow, k) > 0)
            brushing = k;
    }
    *value = beads_least(flow, &flow->end, flow->step.end, which);
    if (*value < 0)
        return BEADS_CROSSES;
    *which = -1;
    if (brushing >= 0)
        *value = brushes_at(flow, brushing);
    return brushing >= 0 ? BEADS_BRUSHES : BEADS_GOOD;
}

/* ------------------------------------------------------------------ what happens */

static void note(beads_flow *flow, fst_bead_event_kind kind, int k, double speed)
{
    const beads_contact *c = &flow->world.contact[k];
    ++flow->counts[kind];
    if (flow->event_count < FST_BEADS_EVENTS)
        flow->events[flow->event_count++] = (fst_bead_event){flow->t.high, kind, {c->first, c->second}, speed};
}

static void note_changes(beads_flow *flow, const beads_modes *before)
{
    for (int k = 0; k < flow->world.contacts; ++k) {
        const int was = before->contact[k], is = flow->modes.contact[k];
        const int plate = flow->world.contact[k].second < 0;
        if (was == is)
            continue;
        if (is == BEADS_OPEN)
            note(flow, plate ? FST_BEAD_EVENT_LIFT : FST_BEAD_EVENT_PART, k, 0.0);
        else if (is == BEADS_GRAZING) {
            note(flow, FST_BEAD_EVENT_GRAZE, k, 0.0);
            flow->grazes_since[k] = flow->t.high;
        } else if (was == BEADS_GRAZING)
            note(flow, FST_BEAD_EVENT_PRESS, k, 0.0);
    }
}

static fst_status no_state(const beads_flow *flow, fst_error *error)
{
    char where[64];
    (void)snprintf(where, sizeof where, "t = %.10g", flow->t.high);
    return fst_fail(error, FST_NO_CONVERGENCE, where,
                    "no state of the contacts between beads and plate is consistent at %s; try another "
                    "contact.pair_rate or start",
                    where);
}

/* Events that come without end within no time. */
static fst_status count_crowd(beads_flow *flow, fst_error *error)
{
    char where[64];
    if (fabs(flow->t.high - flow->crowded_at) > CROWDED) {
        flow->crowded_at = flow->t.high;
        flow->crowd = 0;
    }
    if (++flow->crowd <= MOST_CROWD)
        return FST_OK;
    (void)snprintf(where, sizeof where, "t = %.10g", flow->t.high);
    return fst_fail(error, FST_NO_CONVERGENCE, where,
                    "more than %d impacts and releases follow each other within no time at %s; try another "
                    "start or impact.restitution",
                    MOST_CROWD, where);
}

/* Contacts whose gaps are 0 and stay so unless they open. */
static void find_touching(const beads_flow *flow, double slowest, int touching[BEADS_CONTACTS])
{
    beads_look look;
    beads_look_at_gaps(&flow->world, &flow->modes, flow->step.y, &look);
    for (int k = 0; k < flow->world.contacts; ++k)
        touching[k] = beads_can_meet(&flow->world, &flow->modes, k) &&
                      (flow->modes.contact[k] != BEADS_OPEN ||
                       (look.gap[k] < BEADS_TOUCH && fabs(look.rate[k]) < slowest));
}

/* Choose the contact state of what touches and does not part, each pressing at first. */
static int settle(beads_flow *flow)
{
    int touching[BEADS_CONTACTS];
    beads_modes before;
    memset(flow->modes.contact, BEADS_OPEN, sizeof flow->modes.contact);
    find_touching(flow, flow->world.bounce_least, touching);
    for (int k = 0; k < flow->world.contacts; ++k)
        flow->modes.contact[k] = touching[k] ? BEADS_PRESSING : BEADS_OPEN;
    beads_project(&flow->world, &flow->modes, flow->step.y);
    before = flow->modes;
    if (beads_select(&flow->world, flow->step.y, touching, &flow->modes))
        return 1;
    flow->modes = before;
    return 0;
}

fst_status beads_settle(beads_flow *flow, fst_error *error)
{
    return settle(flow) ? FST_OK : no_state(flow, error);
}

static fst_status collide(beads_flow *flow, fst_error *error)
{
    const double energy = beads_energy_now(flow);
    const beads_modes before = flow->modes;
    int touching[BEADS_CONTACTS];
    beads_look look;
    beads_look_at_gaps(&flow->world, &flow->modes, flow->step.y, &look);
    find_touching(flow, INFINITY, touching);
    for (int k = 0; k < flow->world.contacts; ++k)
        if (touching[k] && before.contact[k] == BEADS_OPEN && look.rate[k] < -STILL)
            note(flow, flow->world.contact[k].second < 0 ? FST_BEAD_EVENT_LAND : FST_BEAD_EVENT_TOUCH, k,
                 -look.rate[k]);
    if (!beads_collide(&flow->world, &flow->modes, touching, flow->step.y) || !settle(flow))
        return no_state(flow, error);
    flow->impacts += energy - beads_energy_now(flow);
    note_changes(flow, &before);
    return FST_OK;
}

static fst_status eject(beads_flow *flow, int bead, fst_error *error)
{
    const double energy = beads_energy_now(flow);
    int touching[BEADS_CONTACTS];
    flow->ejected[bead] = flow->t.high;
    flow->modes.gone[bead] = 1;
    for (int k = 0; k < flow->world.contacts; ++k)
        if (!beads_can_meet(&flow->world, &flow->modes, k))
            flow->modes.contact[k] = BEADS_OPEN;
    flow->carried += energy - beads_energy_now(flow);
    find_touching(flow, STILL, touching);
    return beads_select(&flow->world, flow->step.y, touching, &flow->modes) ? FST_OK : no_state(flow, error);
}

/* Whether a contact that has just begun to graze wants more than its whole friction.  Then it neither grazes nor presses:
 * it opens, and others, which its friction held, change with it. */
static int opens_with_others(const beads_flow *flow, int k)
{
    return flow->modes.contact[k] == BEADS_GRAZING && flow->start.held[k] > 0.5 &&
           flow->t.high - flow->grazes_since[k] < AT_ONCE;
}

fst_status beads_happen(beads_flow *flow, int which, fst_error *error)
{
    const beads_modes before = flow->modes;
    int touching[BEADS_CONTACTS];
    const fst_status status = count_crowd(flow, error);
    if (status != FST_OK)
        return status;
    if (which >= BEADS_CONTACTS)
        return eject(flow, which - BEADS_CONTACTS, error);
    if (flow->modes.contact[which] == BEADS_OPEN)
        return collide(flow, error);
    find_touching(flow, STILL, touching);
    int found;
    if (opens_with_others(flow, which)) {
        flow->modes.contact[which] = BEADS_OPEN;
        found = beads_select(&flow->world, flow->step.y, touching, &flow->modes);
    } else {
        found = beads_release(&flow->world, flow->step.y, touching, which, flow->start.held[which] > 0.5,
                              &flow->modes);
    }
    if (!found)
        return no_state(flow, error);
    note_changes(flow, &before);
    return FST_OK;
}
