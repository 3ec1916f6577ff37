/* events.c - what ends the present state of contacts, and which one follows.
 *
 * May not become negative: the load of a pressing contact; the share theta of a grazing one, and 1 - theta; the
 * gap of an open one; the way to the plate's edge or to the magnet.  An event is armed where its value is positive at the start
 * of the step:
 *
 *     gap just opened     0 +- rounding: not armed up to ARMED; if it sinks first, the step is shortened
 *     load just begun     may be 0 too: not positive at the start, and negative at the end: STALE, an event
 *                         at the start
 *
 * Under dry friction also: what the greatest friction of a sticking contact leaves over what it needs; the speed along
 * the push of a slip that begins, which grows from 0, and what it lacks to go on by itself (near enough is good enough
 * there).  A slip is over where it is smaller than world->still.
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

enum { MOST_CROWD = 1000, MOST_GENTLE = 4 };
static const double ARMED = 1e-11, SUNK = 1e-13, CROWDED = 1e-3, STILL = 1e-6, AT_ONCE = 1e-12,
                    JUST_BEGUN = 0.1;
static const double STRAYS = 10.0,
                    ALONG = 0.9;   /* a slip this fast, in world->still, is along its push by so much */
static const double STALLED = 0.9; /* a slip stays as it is of which a step leaves so much */
static const double FREE_WITHIN =
    3.0; /* a slip that begins may be faster than world->free_at by so many of it */

/* What may not become negative at contact k: the first value, or the second, which only a grazing one has. */
enum { FIRST, SECOND, THIRD, VALUES };
static double value_of(const beads_flow *flow, const beads_look *look, int k, int value)
{
    const double held = look->held[k], *f = look->friction[k];
    const int mode = flow->modes.contact[k];
    if (value == FIRST)
        return mode == BEADS_OPEN ? look->gap[k] : held;
    if (mode == BEADS_GRAZING)
        return value == SECOND ? 1.0 - held : INFINITY;
    if (mode == BEADS_STICKING)
        return value == SECOND
                   ? flow->world.contact[k].mu * held * (1.0 + FST_RELEASE_SLACK) - sqrt(beads_dot(f, f))
                   : INFINITY;
    if (mode != BEADS_BEGINNING)
        return INFINITY;
    const double speed = beads_dot(look->slip[k], look->way[k]);
    return value == SECOND ? speed : flow->world.free_at - speed;
}

/* Below this size a value that was not armed is not an event: a gap just opened, and a slip just begun. */
static double rounding_of(const beads_flow *flow, int k, int value, double of_gap)
{
    const int mode = flow->modes.contact[k];
    if (mode == BEADS_OPEN)
        return of_gap;
    return mode == BEADS_BEGINNING && value == SECOND ? flow->world.still : 0.0;
}

static int is_armed(const beads_flow *flow, int k, int value)
{
    return value_of(flow, &flow->start, k, value) > rounding_of(flow, k, value, ARMED);
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
    for (int value = FIRST; value < VALUES; ++value)
        if (!is_armed(flow, k, value) &&
            value_of(flow, &flow->end, k, value) < -rounding_of(flow, k, value, SUNK))
            return 1;
    return 0;
}

double beads_least(const beads_flow *flow, const beads_look *look, const double *y, int *which)
{
    double least = INFINITY;
    *which = -1;
    if (flow->paced) {
        least = flow->rest - y[FST_BEAD_NUMBERS * flow->world.count + BEADS_TIME];
        *which = BEADS_LIMIT;
    }
    for (int k = 0; k < flow->world.contacts; ++k) {
        const int counts = beads_can_meet(&flow->world, &flow->modes, k);
        const double value = counts ? least_armed(flow, look, k) : INFINITY;
        if (value < least) {
            least = value;
            *which = k;
        }
    }
    for (int i = 0; i < flow->world.count; ++i) {
        int unused;
        const double value = flow->modes.gone[i] ? INFINITY : beads_way_out(&flow->world, i, y, &unused);
        if (value < least) {
            least = value;
            *which = BEADS_CONTACTS + i;
        }
    }
    return least;
}

int beads_is_near_enough(const beads_flow *flow, int which, double value)
{
    return value <= 0 && which < BEADS_CONTACTS && flow->modes.contact[which] == BEADS_BEGINNING &&
           value == value_of(flow, &flow->end, which, THIRD) && value > -FREE_WITHIN * flow->world.free_at;
}

/* Whether the slip of a contact is over at the end of the step: it is smaller than what anything feels, or, smaller than the
 * tolerance, it stays as it is, because what pushes it has become as strong as its friction.  Steps that follow the slip
 * would take no time then; it begins anew from rest. */
static int is_over(const beads_flow *flow, int k)
{
    const double *before = flow->start.slip[k], *after = flow->end.slip[k], still = flow->world.still;
    const double size2 = beads_dot(after, after), was2 = beads_dot(before, before);
    const double slow = fmax(STRAYS * still, flow->rtol);
    return flow->modes.contact[k] == BEADS_PRESSING && flow->world.contact[k].mu > 0 &&
           ((size2 <= still * still && size2 < was2) ||
            (flow->paced && size2 <= slow * slow && size2 > STALLED * STALLED * was2));
}

/* Whether a slip that begins does not go where it is pushed, because that changed: it goes on by its own direction. */
static int has_strayed(const beads_flow *flow, const beads_look *look, int k)
{
    const double speed = sqrt(beads_dot(look->slip[k], look->slip[k]));
    return flow->modes.contact[k] == BEADS_BEGINNING && speed > STRAYS * flow->world.still &&
           beads_dot(look->slip[k], look->way[k]) < ALONG * speed;
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

/* Whether a slip begins at the start of the step: then it is not over yet, however the step ends. */
static int has_just_begun(const beads_flow *flow, int k)
{
    return flow->modes.contact[k] == BEADS_BEGINNING &&
           value_of(flow, &flow->start, k, SECOND) > -JUST_BEGUN * flow->world.still;
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
            return open || has_just_begun(flow, k) ? BEADS_SINKS : BEADS_STALE;
        if (open && is_armed(flow, k, FIRST) && brushing < 0 && brushes_at(flow, k) > 0)
            brushing = k;
    }
    *value = beads_least(flow, &flow->end, flow->step.end, which);
    if (*value < 0)
        return BEADS_CROSSES;
    *which = -1;
    if (brushing >= 0) {
        *value = brushes_at(flow, brushing);
        return BEADS_BRUSHES;
    }
    for (int k = 0; k < flow->world.contacts; ++k)
        if (is_over(flow, k) || has_strayed(flow, &flow->end, k))
            *which = k;
    return BEADS_GOOD;
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
        if (was == BEADS_STICKING && is != BEADS_OPEN)
            note(flow, FST_BEAD_EVENT_SLIP, k, 0.0);
        if (is == BEADS_STICKING)
            note(flow, FST_BEAD_EVENT_STICK, k, 0.0);
        if (is == BEADS_OPEN)
            note(flow, plate ? FST_BEAD_EVENT_LIFT : FST_BEAD_EVENT_PART, k, 0.0);
        else if (is == BEADS_GRAZING) {
            note(flow, FST_BEAD_EVENT_GRAZE, k, 0.0);
            flow->grazes_since[k] = flow->t.high;
        } else if (was == BEADS_GRAZING)
            note(flow, FST_BEAD_EVENT_PRESS, k, 0.0);
    }
}

/* The contacts leave so many motions; one: it does not come on. */
static void note_paradox(beads_flow *flow, int motions, const int *touching)
{
    fst_beads_paradox *paradox = &flow->paradox;
    paradox->time = flow->t.high;
    paradox->motions = motions;
    paradox->touch_count = 0;
    for (int k = 0; k < flow->world.contacts; ++k)
        if (touching[k]) {
            paradox->touches[paradox->touch_count][0] = flow->world.contact[k].first;
            paradox->touches[paradox->touch_count++][1] = flow->world.contact[k].second;
        }
}

/* Of the contacts that touch, no state was found. */
static fst_status no_state(beads_flow *flow, const int *touching, fst_error *error)
{
    char where[64];
    (void)snprintf(where, sizeof where, "t = %.10g", flow->t.high);
    note_paradox(flow, 0, touching);
    return fst_fail(error, FST_NO_CONVERGENCE, where,
                    "no state of the contacts between beads and plate is consistent at %s; try another "
                    "friction between beads or start",
                    where);
}

/* Events that come without end within no time. */
static fst_status count_crowd(beads_flow *flow, fst_error *error)
{
    char where[64];
    int closed[BEADS_CONTACTS];
    if (fabs(flow->t.high - flow->crowded_at) > CROWDED) {
        flow->crowded_at = flow->t.high;
        flow->crowd = 0;
    }
    if (++flow->crowd <= MOST_CROWD)
        return FST_OK;
    for (int k = 0; k < flow->world.contacts; ++k)
        closed[k] = flow->modes.contact[k] != BEADS_OPEN;
    note_paradox(flow, 1, closed);
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

/* Whether the state found is the only one; under viscous friction it is kept, whatever others there are. */
static fst_status check_only(beads_flow *flow, const int *touching, fst_error *error)
{
    char where[64];
    if (!beads_is_dry(&flow->world) ||
        !beads_is_one_of_several(&flow->world, flow->step.y, touching, &flow->modes))
        return FST_OK;
    note_paradox(flow, 2, touching);
    (void)snprintf(where, sizeof where, "t = %.10g", flow->t.high);
    return fst_fail(
        error, FST_NO_CONVERGENCE, where,
        "dry friction leaves several motions at %s (a paradox of Painleve); try a smaller friction.mu", where);
}

static fst_status choose(beads_flow *flow, const int *touching, fst_error *error)
{
    if (!beads_select(&flow->world, flow->step.y, touching, &flow->modes))
        return no_state(flow, touching, error);
    return check_only(flow, touching, error);
}

/* Choose the contact state of what touches and does not part, each pressing or sticking at first. */
fst_status beads_settle(beads_flow *flow, fst_error *error)
{
    int touching[BEADS_CONTACTS];
    for (int k = 0; k < flow->world.contacts; ++k)
        if (flow->modes.contact[k] != BEADS_BEGINNING)
            flow->modes.contact[k] = BEADS_OPEN;
    find_touching(flow, flow->world.bounce_least, touching);
    beads_close(&flow->world, flow->step.y, touching, &flow->modes);
    beads_project(&flow->world, &flow->modes, flow->step.y);
    return choose(flow, touching, error);
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
    if (!beads_collide(&flow->world, &flow->modes, touching, flow->step.y))
        return no_state(flow, touching, error);
    const fst_status status = beads_settle(flow, error);
    if (status != FST_OK)
        return status;
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
    return choose(flow, touching, error);
}

/* Contacts that closed without an impact had a gap and a rate that are as good as 0.  These go now, and the energy that
 * goes with them is counted as of an impact; slips of others change by as little, and so may the state. */
static int close_gently(beads_flow *flow, const int *touching, beads_modes before)
{
    for (int round = 0; round < MOST_GENTLE; ++round) {
        int closes = 0;
        for (int k = 0; k < flow->world.contacts; ++k)
            closes = closes || (before.contact[k] == BEADS_OPEN && flow->modes.contact[k] != BEADS_OPEN);
        if (!closes)
            break;
        const double energy = beads_energy_now(flow);
        beads_project(&flow->world, &flow->modes, flow->step.y);
        flow->impacts += energy - beads_energy_now(flow);
        before = flow->modes;
        if (!beads_select(&flow->world, flow->step.y, touching, &flow->modes))
            return 0;
    }
    return 1;
}

/* Whether a contact that has just begun to graze wants more than its whole friction.  Then it neither grazes nor presses:
 * it opens, and others, which its friction held, change with it. */
static int opens_with_others(const beads_flow *flow, int k)
{
    return flow->modes.contact[k] == BEADS_GRAZING && flow->start.held[k] > 0.5 &&
           flow->t.high - flow->grazes_since[k] < AT_ONCE;
}

/* The next state of contact k under dry friction, of which the first value that ended the last one tells. */
static int go_over(beads_flow *flow, const int *touching, int k)
{
    static const unsigned char next[][VALUES] = {
        [BEADS_PRESSING] = {BEADS_OPEN},
        [BEADS_STICKING] = {BEADS_OPEN, BEADS_BEGINNING},
        [BEADS_BEGINNING] = {BEADS_OPEN, BEADS_STICKING, BEADS_PRESSING}};
    unsigned char then = BEADS_STICKING;
    int ended = FIRST;
    const int mode = flow->modes.contact[k];
    for (int value = SECOND; value < VALUES; ++value)
        if (value_of(flow, &flow->start, k, value) < value_of(flow, &flow->start, k, ended))
            ended = value;
    const double slip2 = beads_dot(flow->start.slip[k], flow->start.slip[k]), still = flow->world.still;
    if (mode != BEADS_PRESSING || (slip2 > still * still && flow->start.held[k] <= 0))
        then = next[mode][ended];
    if (has_strayed(flow, &flow->start, k))
        then = BEADS_PRESSING;
    flow->modes.contact[k] = then;
    if (then == BEADS_STICKING)
        beads_project(&flow->world, &flow->modes, flow->step.y);
    if (beads_is_consistent(&flow->world, flow->step.y, touching, &flow->modes))
        return 1;
    if (then == BEADS_STICKING) {
        flow->modes.contact[k] = BEADS_BEGINNING;
        if (beads_is_consistent(&flow->world, flow->step.y, touching, &flow->modes))
            return 1;
    }
    return beads_select(&flow->world, flow->step.y, touching, &flow->modes);
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
    if (flow->world.contact[which].mu > 0) {
        found = go_over(flow, touching, which);
    } else if (opens_with_others(flow, which)) {
        flow->modes.contact[which] = BEADS_OPEN;
        found = beads_select(&flow->world, flow->step.y, touching, &flow->modes);
    } else {
        found = beads_release(&flow->world, flow->step.y, touching, which, flow->start.held[which] > 0.5,
                              &flow->modes);
    }
    if (!found || !close_gently(flow, touching, before))
        return no_state(flow, touching, error);
    note_changes(flow, &before);
    return check_only(flow, touching, error);
}
