/* steps.c - the motion of many beads by equal steps, after Moreau and Jean.
 *
 *     half a drift       places go on by v h/2, moments turn about W by |W| h/2, all turns back with the axes
 *     forces, contacts   at this middle; velocities change by h times the forces and by the contacts' impulses
 *     half a drift
 *
 * Contacts within reach of the step obey   0 <= push  complementary to  d(gap)/dt after + max(gap, 0)/h >= 0:  they close
 * within the step and not deeper.  ("Active once the gap is closed" lets a pair that turns open by its curvature in
 * each step; its friction then lacks in a share of the steps that does not vanish with h.)  A contact that
 * closes anew and faster than bounce_least bounces in the step that would close it, so that it does not sink in.
 *
 * Without contacts the error is of the order h^2; contacts begin and end within a step, which makes it h.  Energies
 * of contacts are impulses times the mean of the velocities before and after, so that the kinetic energy is accounted for
 * to rounding.
 */
#include "beads/steps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/elementary.h"
#include "base/error.h"
#include "base/grow.h"
#include "beads/act.h"
#include "beads/impact.h"

static const double SOLVED =
    1e-6; /* what contacts may leave wrong, over the greatest change of a velocity in a step */
static const double SKIN = 0.3;    /* reach of the list of near pairs beyond a step's, over a radius */
static const double PARTED = 1e-4; /* gap over a radius beyond which a contact has opened */

/* ------------------------------------------------------------------ drift */

/* Turn v about w by the angle |w| time. */
static void turn_about(const double w[3], double time, double v[3])
{
    const double rate = sqrt(beads_dot(w, w));
    if (rate == 0.0)
        return;
    const double axis[3] = {w[0] / rate, w[1] / rate, w[2] / rate}, along = beads_dot(axis, v);
    double sine, cosine, across[3], norm = 0.0;
    fst_sin_cos_degrees(rate * time * (180.0 / FST_PI), &sine, &cosine);
    fst_cross_double(axis, v, across);
    for (int m = 0; m < 3; ++m) {
        v[m] = cosine * v[m] + sine * across[m] + (1.0 - cosine) * along * axis[m];
        norm += v[m] * v[m];
    }
    for (int m = 0; m < 3; ++m)
        v[m] /= sqrt(norm);
}

/* Half a drift of all beads, with the axes. */
static void drift(beads_steps *s)
{
    const double time = 0.5 * s->h, cosine = s->half_turn[0], sine = s->half_turn[1];
    for (int p = 0; p < s->present_count; ++p) {
        double *bead = s->y + FST_BEAD_NUMBERS * s->present[p];
        for (int m = 0; m < 3; ++m)
            bead[m] += time * bead[BEADS_V + m];
        turn_about(bead + BEADS_W, time, bead + BEADS_N);
        for (int at = 0; at < FST_BEAD_NUMBERS; at += 3) {
            const double x = bead[at], y = bead[at + 1];
            bead[at] = cosine * x + sine * y;
            bead[at + 1] = cosine * y - sine * x;
        }
    }
}

/* ------------------------------------------------------------------ forces */

static void find_dipole_forces(beads_steps *s)
{
    const beads_world *world = &s->world;
    beads_dipoles *d = &s->dipoles;
    d->count = s->present_count;
    for (int p = 0; p < s->present_count; ++p) {
        const int i = s->present[p];
        const double *bead = s->y + FST_BEAD_NUMBERS * i;
        for (int m = 0; m < 3; ++m) {
            d->in[m][p] = bead[m];
            d->in[3 + m][p] = bead[BEADS_N + m];
        }
        d->in[2][p] = beads_height(world, i, s->y);
        d->in[6][p] = world->body[i].dipole;
    }
    beads_sum_dipoles(d);
}

/* Velocities after the forces alone.  Returns the greatest change of a bead's. */
static double accelerate(beads_steps *s)
{
    const beads_world *world = &s->world;
    double power[BEADS_R] = {0.0}, greatest = 0.0;
    find_dipole_forces(s);
    for (int p = 0; p < s->present_count; ++p) {
        const int i = s->present[p];
        const beads_body *body = &world->body[i];
        const double *from = s->speeds + BEADS_SPEEDS * i;
        double *to = s->after + BEADS_SPEEDS * i, size = 0.0;
        double force[3] = {s->dipoles.out[0][p], s->dipoles.out[1][p], s->dipoles.out[2][p]};
        double torque[3] = {s->dipoles.out[3][p], s->dipoles.out[4][p], s->dipoles.out[5][p]};
        beads_act_on_bead(world, i, s->y, force, torque, power);
        for (int m = 0; m < 3; ++m) {
            const double change = s->h * force[m] / beads_moved_mass(body);
            to[m] = from[m] + change;
            to[3 + m] = from[3 + m] + s->h * torque[m] / body->inertia;
            size += change * change;
        }
        greatest = fmax(greatest, size);
    }
    for (int q = 0; q < BEADS_R; ++q)
        s->work[q] += s->h * power[q];
    return sqrt(greatest);
}

/* ------------------------------------------------------------------ contacts */

static void note(beads_steps *s, const beads_touch *t, int is_plate_kind, int is_pair_kind, double speed)
{
    const int is_plate = t->second == s->world.count, kind = is_plate ? is_plate_kind : is_pair_kind;
    ++s->counts[kind];
    if (s->event_count < FST_BEADS_EVENTS)
        s->events[s->event_count++] = (fst_bead_event){
            (double)s->steps * s->h, (fst_bead_event_kind)kind, {t->first, is_plate ? -1 : t->second}, speed};
}

/* Whether a contact of the list stands before another one. */
static int is_before(const beads_steps *s, const beads_touch *a, int first, int second)
{
    const int plate = s->world.count, of_plate = second == plate;
    if ((a->second == plate) != of_plate)
        return a->second == plate;
    return a->first < first || (a->first == first && a->second < second);
}

/* The next of the contacts before that is not before this one; those that are passed have left the reach. */
static const beads_touch *pass_to(beads_steps *s, int *next, int first, int second)
{
    const beads_touch *t = s->before + *next, *end = s->before + s->before_count;
    for (; t < end && is_before(s, t, first, second); ++t, ++*next)
        if (t->closed)
            note(s, t, FST_BEAD_EVENT_LIFT, FST_BEAD_EVENT_PART, 0.0);
    return t < end && t->first == first && t->second == second ? t : NULL;
}

/* Two beads rub in the middle of their gap, which keeps their angular momentum. */
static void set_bodies(const beads_world *world, beads_touch *t)
{
    const beads_body *a = &world->body[t->first],
                     *b = t->second == world->count ? NULL : &world->body[t->second];
    t->inverse[0] = 1.0 / beads_moved_mass(a);
    t->inverse[1] = b ? 1.0 / beads_moved_mass(b) : 0.0;
    t->arm[0] = a->radius + (b ? 0.5 * t->gap : 0.0);
    t->arm[1] = b ? b->radius + 0.5 * t->gap : 0.0;
    t->spin[0] = t->arm[0] / a->inertia;
    t->spin[1] = b ? t->arm[1] / b->inertia : 0.0;
    t->ease[0] = t->inverse[0] + t->inverse[1];
    t->ease[1] = t->ease[0] + t->arm[0] * t->spin[0] + t->arm[1] * t->spin[1];
}

/* What the contact may and may not do in this step. */
static void set_rules(const beads_steps *s, beads_touch *t)
{
    const beads_world *world = &s->world;
    const int j = t->second == world->count ? -1 : t->second;
    double slip[3], free_rate;
    beads_touch_slip(t, s->speeds, t->slip, &t->rate);
    beads_touch_slip(t, s->after, slip, &free_rate);
    const int bounces = world->restitution > 0 && !t->pressed && t->rate < -world->bounce_least &&
                        t->gap + s->h * free_rate < 0;
    t->least = bounces ? -world->restitution * t->rate : -fmax(t->gap, 0.0) / s->h;
    t->mu = j < 0 ? world->plate_mu : world->pair_mu;
    const double half = 0.5 * s->h * beads_friction(world, t->first, j);
    t->rub = half / (1.0 + half * t->ease[1]);
}

/* The contact of bead `first` and `second` in the present list, if its gap is within reach. */
static void add_touch(beads_steps *s, int first, int second, double reach, int *next)
{
    beads_touch t = {.first = first, .second = second};
    double curve;
    const beads_touch *old = pass_to(s, next, first, second);
    beads_meet(&s->world, first, second == s->world.count ? -1 : second, s->y, t.u, &t.gap, &curve);
    if (!(t.gap < reach) && !(old && old->closed))
        return;
    if (old) {
        const double along = beads_dot(old->rubbed, t.u);
        t.push = old->push;
        t.pressed = old->push > 0 || (s->steps == 0 && old->pressed);
        t.closed = old->closed;
        for (int m = 0; m < 3; ++m)
            t.rubbed[m] = old->rubbed[m] - along * t.u[m];
        ++*next;
    }
    set_bodies(&s->world, &t);
    set_rules(s, &t);
    s->touches[s->touch_count++] = t;
}

static fst_status make_room_for_touches(beads_steps *s, fst_error *error)
{
    const int needed = s->world.count + s->near_count;
    if (needed <= s->touch_room)
        return FST_OK;
    const size_t room = 2 * (size_t)needed;
    if (!fst_resize(&s->touches, room, sizeof *s->touches) || !fst_resize(&s->before, room, sizeof *s->before))
        return fst_fail(error, FST_NO_MEMORY, "beads", "out of memory for contacts of beads");
    s->touch_room = (int)room;
    return FST_OK;
}

static void swap_lists(beads_steps *s)
{
    beads_touch *kept = s->before;
    s->before = s->touches;
    s->before_count = s->touch_count;
    s->touches = kept;
    s->touch_count = 0;
}

static fst_status list_touches(beads_steps *s, double reach, fst_error *error)
{
    int next = 0;
    fst_status status = FST_OK;
    if (!(s->moved + reach < s->within)) {
        s->within = 2.0 * reach + SKIN * s->world.body[0].radius;
        s->moved = 0.0;
        status = beads_find_near(&s->world, s->gone, s->y, s->within, &s->near, &s->near_count, error);
    }
    if (status == FST_OK)
        status = make_room_for_touches(s, error);
    if (status != FST_OK)
        return status;
    swap_lists(s);
    for (int p = 0; p < s->present_count && !isnan(s->world.plate); ++p)
        add_touch(s, s->present[p], s->world.count, reach, &next);
    for (int k = 0; k < s->near_count; ++k)
        add_touch(s, s->near[k].first, s->near[k].second, reach, &next);
    (void)pass_to(s, &next, s->world.count, s->world.count - 1);
    return FST_OK;
}

/* Energies, loads and events of the impulses found. */
static void account(beads_steps *s)
{
    for (int c = 0; c < s->touch_count; ++c) {
        beads_touch *t = &s->touches[c];
        const int is_plate = t->second == s->world.count;
        double slip[3], rate, lost = 0.0;
        beads_touch_slip(t, s->after, slip, &rate);
        for (int m = 0; m < 3; ++m)
            lost -= 0.5 * t->rubbed[m] * (t->slip[m] + slip[m]);
        s->work[is_plate ? BEADS_PLATE : BEADS_PAIR] += lost;
        s->impacts -= 0.5 * t->push * (t->rate + rate);
        s->deepest = fmax(s->deepest, -t->gap);
        if (is_plate)
            s->load[t->first] += t->push;
        if (t->push > 0 && !t->closed) {
            note(s, t, FST_BEAD_EVENT_LAND, FST_BEAD_EVENT_TOUCH, -t->rate);
            t->closed = 1;
        } else if (t->push == 0.0 && t->closed && t->gap > PARTED * s->world.body[t->first].radius) {
            note(s, t, FST_BEAD_EVENT_LIFT, FST_BEAD_EVENT_PART, 0.0);
            t->closed = 0;
        }
    }
}

/* ------------------------------------------------------------------ a step */

static void get_speeds(beads_steps *s)
{
    for (int i = 0; i < s->world.count; ++i) {
        memcpy(s->speeds + BEADS_SPEEDS * i, s->y + FST_BEAD_NUMBERS * i + BEADS_V, 3 * sizeof *s->y);
        memcpy(s->speeds + BEADS_SPEEDS * i + 3, s->y + FST_BEAD_NUMBERS * i + BEADS_W, 3 * sizeof *s->y);
    }
}

static void put_speeds(beads_steps *s)
{
    for (int p = 0; p < s->present_count; ++p) {
        const int i = s->present[p];
        memcpy(s->y + FST_BEAD_NUMBERS * i + BEADS_V, s->after + BEADS_SPEEDS * i, 3 * sizeof *s->y);
        memcpy(s->y + FST_BEAD_NUMBERS * i + BEADS_W, s->after + BEADS_SPEEDS * i + 3, 3 * sizeof *s->y);
    }
}

static double greatest_speed(const beads_steps *s, const double *speeds)
{
    double greatest = 0.0;
    for (int p = 0; p < s->present_count; ++p) {
        const double *v = speeds + BEADS_SPEEDS * s->present[p], size = beads_dot(v, v);
        greatest = size <= greatest ? greatest : size; /* NAN remains */
    }
    return sqrt(greatest);
}

static void find_present(beads_steps *s)
{
    s->present_count = 0;
    for (int i = 0; i < s->world.count; ++i)
        if (!s->gone[i])
            s->present[s->present_count++] = i;
}

/* Beads that passed the plate's edge. */
static void eject(beads_steps *s)
{
    for (int p = 0; p < s->present_count; ++p) {
        const int i = s->present[p];
        int unused;
        if (!(beads_way_out(&s->world, i, s->y, &unused) < 0))
            continue;
        s->carried += beads_energy(&s->world, s->gone, s->y);
        s->gone[i] = 1;
        s->carried -= beads_energy(&s->world, s->gone, s->y);
        s->ejected[i] = (double)s->steps * s->h;
        s->within = 0.0; /* the near pairs are others */
    }
    find_present(s);
}

static fst_status not_finite(const beads_steps *s, fst_error *error)
{
    char where[64];
    (void)snprintf(where, sizeof where, "t = %.10g", (double)s->steps * s->h);
    return fst_fail(
        error, FST_NOT_FINITE, where,
        "the motion of the beads stopped being finite at %s; try more steps a turn, and check the start",
        where);
}

/* Forces and contacts in the middle of the step. */
static fst_status kick(beads_steps *s, fst_error *error)
{
    get_speeds(s);
    const double before = greatest_speed(s, s->speeds), change = accelerate(s),
                 reach = 4.0 * s->h * (before + change);
    if (!isfinite(reach))
        return not_finite(s, error);
    const fst_status status = list_touches(s, reach, error);
    if (status != FST_OK)
        return status;
    const double wrong = beads_sweep(s->touches, s->touch_count, SOLVED * change, s->after, &s->sweeps);
    s->residual = fmax(s->residual, wrong);
    account(s);
    put_speeds(s);
    return FST_OK;
}

fst_status beads_step(beads_steps *s, fst_error *error)
{
    for (int i = 0; i < s->world.count; ++i)
        memcpy(s->started + 2 * i, s->y + FST_BEAD_NUMBERS * i, 2 * sizeof *s->y);
    drift(s);
    for (int i = 0; i < s->world.count; ++i) {
        const double *bead = s->y + FST_BEAD_NUMBERS * i;
        s->r[i] += s->h * sqrt(bead[0] * bead[0] + bead[1] * bead[1]);
        s->height[i] += s->h * bead[2];
    }
    const fst_status status = kick(s, error);
    if (status != FST_OK)
        return status;
    drift(s);
    ++s->steps;
    s->moved += 2.0 * s->h * fmax(greatest_speed(s, s->speeds), greatest_speed(s, s->after));
    for (int i = 0; i < s->world.count; ++i)
        s->turned[i] += beads_turned_by(s->started + 2 * i, s->y + FST_BEAD_NUMBERS * i);
    eject(s);
    return FST_OK;
}

/* ------------------------------------------------------------------ begin and end */

/* Contacts that have pressed before the first step. */
static fst_status begin_touches(beads_steps *s, fst_error *error)
{
    get_speeds(s);
    memcpy(s->after, s->speeds, (size_t)(BEADS_SPEEDS * s->world.count) * sizeof *s->after);
    const fst_status status = list_touches(s, BEADS_TOUCH, error);
    for (int c = 0; c < s->touch_count; ++c)
        s->touches[c].closed = s->touches[c].pressed = 1;
    return status;
}

static int make_room(beads_steps *s, int count)
{
    const size_t n = (size_t)count;
    const size_t sizes[] = {FST_BEAD_NUMBERS * n,   n,    n, n, n, n, BEADS_SPEEDS * (n + 1),
                            BEADS_SPEEDS * (n + 1), 2 * n};
    double **arrays[] = {&s->y,      &s->ejected, &s->turned, &s->r,      &s->load,
                         &s->height, &s->speeds,  &s->after,  &s->started};
    enum { ARRAYS = sizeof sizes / sizeof *sizes };
    size_t sum = (BEADS_DIPOLE_IN + BEADS_DIPOLE_OUT) * n;
    for (int a = 0; a < ARRAYS; ++a)
        sum += sizes[a];
    double *next = s->numbers = calloc(sum, sizeof *s->numbers);
    s->gone = calloc(n, sizeof *s->gone);
    s->present = calloc(n, sizeof *s->present);
    s->events = calloc(FST_BEADS_EVENTS, sizeof *s->events);
    if (!s->numbers || !s->gone || !s->present || !s->events)
        return 0;
    for (int a = 0; a < ARRAYS; next += sizes[a++])
        *arrays[a] = next;
    for (int q = 0; q < BEADS_DIPOLE_IN; ++q, next += n)
        s->dipoles.in[q] = next;
    for (int q = 0; q < BEADS_DIPOLE_OUT; ++q, next += n)
        s->dipoles.out[q] = next;
    return 1;
}

fst_status beads_steps_begin(beads_steps *s, const beads_world *world, const double *state, double h,
                             fst_error *error)
{
    memset(s, 0, sizeof *s);
    s->world = *world;
    s->h = h;
    if (!make_room(s, world->count))
        return fst_fail(error, FST_NO_MEMORY, "beads", "out of memory for %d beads", world->count);
    memcpy(s->y, state, (size_t)(FST_BEAD_NUMBERS * world->count) * sizeof *state);
    for (int i = 0; i < world->count; ++i)
        s->ejected[i] = NAN;
    fst_sin_cos_degrees(0.5 * world->omega * h * (180.0 / FST_PI), &s->half_turn[1], &s->half_turn[0]);
    find_present(s);
    return begin_touches(s, error);
}

void beads_steps_free(beads_steps *s)
{
    free(s->numbers);
    free(s->gone);
    free(s->present);
    free(s->events);
    free(s->touches);
    free(s->before);
    free(s->near);
}

double beads_steps_residual(const beads_steps *s, double energy_at_start)
{
    return beads_energy(&s->world, s->gone, s->y) - energy_at_start - s->work[BEADS_DRIVE] +
           s->work[BEADS_PLATE] + s->work[BEADS_PAIR] + s->work[BEADS_MEDIUM] + s->impacts + s->carried;
}
