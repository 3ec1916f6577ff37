/* seen.c - what is told of beads over a window of time: means, groups, powers, outcome.
 *
 * A motion is undecided where its groups are others at the end than at the window's start, or where the mean r of
 * a bead in the second half of the window is another than in the first; in a wave, which carries beads on for ever,
 * where its mean velocity is.  There a bead is locked if its moment, n = (cos phi, 0, -sin phi), keeps to the field from
 * below it, at the angle th = k x - omega t, or to that from above, at -th, by less than half a turn in either half of the
 * window, and if its mean velocity is about what rolling makes of phi' = th' or -th':
 *
 *     U = eps phi' = -eps omega/(1 - k eps),    or    eps omega/(1 + k eps).
 */
#include "beads/seen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/listed.h"

static const double UNSETTLED = 0.05;   /* greatest change of a mean r between the halves of the window */
static const double WITH_MAGNET = 0.02; /* rates that differ by less, over omega, are the same */
static const double AT_AXIS = 0.5;      /* a centre nearer than this part of a radius stays at the axis */
static const double ROLLS =
    0.5; /* a bead in the lock of a wave has its velocity, but for such a part: drag makes it slip */
static const double STUDENT = 6.35; /* 95 % limit of a mean's error over the difference of two halves: 12.7/2 */
static const double AT_REST = 1e-6; /* speed in the turning frame below which a bead is locked */
/* Mean rates of the window's halves that differ by more than <alpha'> over this leave the sense open; so does a rate that
 * is rounding, over omega. */
static const double ONE_WAY = 2.5, ROUNDING = 1e-9;
/* A centre nearer than this part of its radius is on the axis, about which it then has no angle. */
static const double ON_AXIS = 1e-9;

/* A limit of the error of a mean, over the swings of what it is the rate of in the window's time: swings, of which the ends
 * of the window may cut off the whole, or a walk of chance, which strays in a time by about as much as it swings. */
static const double SWINGS = 2.0;

/* Numbers of a group that are followed, of a bead in a moment, and of its swings. */
enum { TURNED, CENTRE_R, AXIS, OF_GROUP };
enum { R, LOAD, HEIGHT, ANGLE, X, OF_BEAD };
enum { LEAST_R, GREATEST_R, LEAST_ANGLE, GREATEST_ANGLE, OF_SWING };

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

const char *fst_beads_method_name(fst_beads_method method)
{
    FST_NAME_IN(FST_BEADS_METHODS, method, "unknown");
}

fst_status beads_make_room(int count, beads_groups *groups, beads_moment moments[3], fst_error *error)
{
    const size_t n = (size_t)count;
    memset(groups, 0, sizeof *groups);
    groups->members = calloc(n, sizeof *groups->members);
    groups->group = calloc(n, sizeof *groups->group);
    groups->numbers = calloc(n * OF_GROUP, sizeof *groups->numbers);
    int whole = groups->members && groups->group && groups->numbers;
    for (int i = 0; i < 3; ++i) {
        moments[i].numbers = calloc(n * (OF_BEAD + OF_GROUP + OF_SWING), sizeof *moments[i].numbers);
        whole = whole && moments[i].numbers;
    }
    return whole ? FST_OK : fst_fail(error, FST_NO_MEMORY, "beads", "out of memory for %d beads", count);
}

void beads_free_room(beads_groups *groups, beads_moment moments[3])
{
    free(groups->members);
    free(groups->group);
    free(groups->numbers);
    for (int i = 0; i < 3; ++i)
        free(moments[i].numbers);
}

void beads_find_centres(const beads_seen *seen, const beads_groups *groups, double *centres)
{
    for (int g = 0; g < groups->count; ++g) {
        const fst_bead_group *group = &groups->group[g];
        const int first = group->members[0], last = group->members[group->count - 1];
        double *c = centres + BEADS_CENTRE * g, mass = 0.0, v[2] = {0.0, 0.0}, d[3];
        memset(c, 0, BEADS_CENTRE * sizeof *c);
        for (int i = 0; i < group->count; ++i) {
            const double *bead = seen->y + FST_BEAD_NUMBERS * group->members[i];
            const double m = seen->world->body[group->members[i]].mass;
            mass += m;
            for (int k = 0; k < 2; ++k) {
                c[k] += m * bead[k];
                v[k] += m * bead[BEADS_V + k];
            }
        }
        c[0] /= mass;
        c[1] /= mass;
        c[2] = hypot(c[0], c[1]);
        c[3] = c[2] > 0 ? (c[0] * v[0] + c[1] * v[1]) / (mass * c[2]) : 0.0;
        beads_way(seen->world, seen->y, first, last, d);
        memcpy(c + 4, d, 2 * sizeof *c);
        if (group->count == 1) { /* its moment's angle phi */
            c[4] = seen->y[FST_BEAD_NUMBERS * first + BEADS_N];
            c[5] = -seen->y[FST_BEAD_NUMBERS * first + BEADS_N + 2];
        }
    }
}

/* By trapezia with their correction at the ends. */
void beads_follow(const beads_seen *seen, const double *before, double h, beads_groups *groups)
{
    beads_groups one = *groups;
    for (int g = 0; g < groups->count; ++g) {
        const double *from = before + BEADS_CENTRE * g;
        double to[BEADS_CENTRE], *numbers = groups->numbers + OF_GROUP * g;
        one.count = 1;
        one.group = groups->group + g;
        beads_find_centres(seen, &one, to);
        numbers[TURNED] += beads_turned_by(from, to);
        numbers[CENTRE_R] += 0.5 * h * (from[2] + to[2]) + h * h / 12.0 * (from[3] - to[3]);
        numbers[AXIS] += beads_turned_by(from + 4, to + 4);
    }
}

void beads_keep(const beads_seen *seen, const beads_groups *groups, beads_moment *moment)
{
    const size_t n = (size_t)seen->world->count;
    moment->time = seen->time;
    moment->impacts = seen->impacts;
    memcpy(moment->work, seen->work, sizeof moment->work);
    memcpy(moment->numbers + n * R, seen->r, n * sizeof *seen->r);
    memcpy(moment->numbers + n * LOAD, seen->load, n * sizeof *seen->load);
    memcpy(moment->numbers + n * HEIGHT, seen->height, n * sizeof *seen->height);
    memcpy(moment->numbers + n * ANGLE, seen->turned, n * sizeof *seen->turned);
    for (size_t i = 0; i < n; ++i)
        moment->numbers[n * X + i] = seen->y[FST_BEAD_NUMBERS * i];
    memcpy(moment->numbers + n * OF_BEAD, groups->numbers, n * OF_GROUP * sizeof *groups->numbers);
}

/* The mean rate of a number of bead or group i. */
static double mean_rate(int count, const beads_moment *from, const beads_moment *to, int number, int i)
{
    const int at = number * count + i;
    return (to->numbers[at] - from->numbers[at]) / (to->time - from->time);
}

/* ------------------------------------------------------------------ what is told */

double beads_frame_turned(const beads_world *world, double from, double to)
{
    if (!world->surrounded)
        return world->omega * (to - from);
    return fst_frame_angle(&world->around, to) - fst_frame_angle(&world->around, from);
}

/* The mean rate at which bead i of n circles in the laboratory from one moment to the other. */
static double circled(const beads_world *world, int n, const beads_moment *from, const beads_moment *to, int i)
{
    return beads_frame_turned(world, from->time, to->time) / (to->time - from->time) +
           mean_rate(n, from, to, ANGLE, i);
}

void beads_follow_swings(const beads_seen *seen, beads_moment at[3])
{
    const int n = seen->world->count;
    const beads_moment *from = &at[0], *middle = &at[1];
    const double passed = seen->time - middle->time,
                 turned = beads_frame_turned(seen->world, middle->time, seen->time);
    for (int i = 0; i < n; ++i) {
        double *swing = middle->numbers + n * (OF_BEAD + OF_GROUP) + OF_SWING * i;
        const double r = seen->r[i] - middle->numbers[n * R + i] - passed * mean_rate(n, from, middle, R, i);
        const double angle = turned + seen->turned[i] - middle->numbers[n * ANGLE + i] -
                             passed * circled(seen->world, n, from, middle, i);
        swing[LEAST_R] = fmin(swing[LEAST_R], r);
        swing[GREATEST_R] = fmax(swing[GREATEST_R], r);
        swing[LEAST_ANGLE] = fmin(swing[LEAST_ANGLE], angle);
        swing[GREATEST_ANGLE] = fmax(swing[GREATEST_ANGLE], angle);
    }
}

/* The limits of the errors of a bead's mean r and rate; the window may have ended before its middle. */
static void tell_errors(int n, const beads_moment at[3], int i, fst_bead_result *bead)
{
    const double *swing = at[1].numbers + n * (OF_BEAD + OF_GROUP) + OF_SWING * i;
    const double part = at[2].time > at[1].time ? SWINGS / (at[2].time - at[0].time) : NAN;
    bead->mean_r_error = part * (swing[GREATEST_R] - swing[LEAST_R]);
    bead->mean_alpha_dot_error = part * (swing[GREATEST_ANGLE] - swing[LEAST_ANGLE]);
}

/* Whether bead i ends on the axis. */
static int is_on_axis(const beads_seen *seen, int i)
{
    const double *bead = seen->y + FST_BEAD_NUMBERS * i;
    return hypot(bead[0], bead[1]) < ON_AXIS * seen->world->body[i].radius;
}

/* `apart`: by how much the mean rates of the window's halves differ. */
static fst_regime regime_of(const beads_seen *seen, int i, double mean_alpha_dot, double apart)
{
    const double omega = seen->world->omega, *bead = seen->y + FST_BEAD_NUMBERS * i;
    const double u = bead[BEADS_V] + omega * bead[1], v = bead[BEADS_V + 1] - omega * bead[0];
    const int held = !isnan(seen->world->plate);
    int what;
    (void)beads_way_out(seen->world, i, seen->y, &what);
    if (seen->gone[i])
        return what == BEADS_AT_MAGNET         ? FST_REGIME_TOUCHED
               : held && what == BEADS_AT_EDGE ? FST_REGIME_EJECTED
                                               : FST_REGIME_LOST;
    if (!held)
        return FST_REGIME_LEVITATING;
    if (seen->world->surrounded && seen->world->around.drive.kind != FST_WAVEFORM_STEADY)
        return FST_REGIME_UNDECIDED; /* words for motions beside a magnet that turns steadily */
    if (is_on_axis(seen, i))
        return !seen->world->surrounded && hypot(u, v) < AT_REST ? FST_REGIME_LOCKED : FST_REGIME_UNDECIDED;
    if (fabs(mean_alpha_dot - omega) < WITH_MAGNET * omega)
        return hypot(u, v) < AT_REST ? FST_REGIME_LOCKED : FST_REGIME_LIBRATING;
    if (!(fabs(mean_alpha_dot) > ONE_WAY * apart + ROUNDING * omega))
        return FST_REGIME_UNDECIDED;
    return mean_alpha_dot < 0 ? FST_REGIME_COUNTER_ROTATING : FST_REGIME_COROTATING;
}

static int is_in_wave(const beads_world *world)
{
    return world->surrounded && world->around.drive.kind == FST_WAVEFORM_WAVE;
}

/* Whether bead i, which is the group g, is locked to the field from below (side = 1) or from above (-1). */
static int is_locked_to_wave(const beads_seen *seen, const beads_moment at[3], int i, int g, int side)
{
    const int n = seen->world->count, axis = n * OF_BEAD + OF_GROUP * g + AXIS;
    const double k = seen->world->around.wave_number, omega = seen->world->omega,
                 eps = seen->world->body[i].radius;
    const double rolls = -side * eps * omega / (1.0 - side * k * eps);
    int keeps = fabs(mean_rate(n, &at[0], &at[2], X, i) - rolls) < ROLLS * fabs(rolls);
    for (int half = 0; half < 2; ++half) {
        const beads_moment *from = &at[half], *to = &at[half + 1];
        const double passed = (to->time - from->time) * (k * mean_rate(n, from, to, X, i) - omega);
        keeps = keeps && fabs(to->numbers[axis] - from->numbers[axis] - side * passed) < FST_PI;
    }
    return keeps;
}

static void tell_beads(const beads_seen *seen, const beads_moment at[3], fst_bead_result *beads)
{
    const int n = seen->world->count, over_plate = !isnan(seen->world->plate);
    const beads_moment *from = &at[0], *to = &at[2];
    for (int i = 0; i < n; ++i) {
        fst_bead_result *bead = &beads[i];
        bead->mean_r = mean_rate(n, from, to, R, i);
        bead->mean_alpha_dot = circled(seen->world, n, from, to, i);
        const double apart =
            fabs(circled(seen->world, n, &at[1], to, i) - circled(seen->world, n, from, &at[1], i));
        const double load = mean_rate(n, from, to, LOAD, i);
        bead->mean_load_weights = over_plate ? load / (seen->world->body[i].mass * seen->world->gravity) : NAN;
        bead->mean_height =
            mean_rate(n, from, to, HEIGHT, i) + (over_plate ? seen->world->body[i].radius : 0.0);
        bead->ejected_at = seen->ejected[i];
        bead->regime = regime_of(seen, i, bead->mean_alpha_dot, apart);
        bead->mean_velocity = is_in_wave(seen->world) ? mean_rate(n, from, to, X, i) : NAN;
        bead->mean_velocity_error =
            STUDENT * fabs(mean_rate(n, &at[1], to, X, i) - mean_rate(n, from, &at[1], X, i));
        tell_errors(n, at, i, bead);
        if (seen->gone[i])
            bead->mean_r = bead->mean_alpha_dot = bead->mean_r_error = bead->mean_alpha_dot_error =
                bead->mean_load_weights = bead->mean_height = bead->mean_velocity = NAN;
        if (is_on_axis(seen, i))
            bead->mean_alpha_dot = bead->mean_alpha_dot_error = NAN;
        if (isnan(bead->mean_velocity))
            bead->mean_velocity_error = NAN;
        memcpy(bead->final_state, seen->y + FST_BEAD_NUMBERS * i, sizeof bead->final_state);
        bead->final_state[2] += over_plate ? seen->world->body[i].radius : 0.0;
    }
}

static void tell_groups(const beads_seen *seen, const beads_moment at[3], int same, fst_beads_result *result)
{
    const beads_moment *from = &at[0], *to = &at[2];
    const double omega = seen->world->omega, time = to->time - from->time;
    const double *first = from->numbers + OF_BEAD * result->count,
                 *last = to->numbers + OF_BEAD * result->count;
    for (int g = 0; g < result->group_count; ++g, first += OF_GROUP, last += OF_GROUP) {
        fst_bead_group *group = &result->groups[g];
        group->mean_r = group->centre_rate = group->axis_rate = NAN;
        if (!same)
            continue;
        if (is_in_wave(seen->world) && group->count == 1)
            result->beads[group->members[0]].regime =
                is_locked_to_wave(seen, at, group->members[0], g, 1)    ? FST_REGIME_BACKWARD
                : is_locked_to_wave(seen, at, group->members[0], g, -1) ? FST_REGIME_FORWARD
                                                                        : FST_REGIME_DRIFTING;
        group->mean_r = (last[CENTRE_R] - first[CENTRE_R]) / time;
        if (group->mean_r > AT_AXIS * seen->world->body[group->members[group->count - 1]].radius)
            group->centre_rate = omega + (last[TURNED] - first[TURNED]) / time;
        if (group->count > 1)
            group->axis_rate = omega + (last[AXIS] - first[AXIS]) / time;
    }
}

static int same_groups(const beads_groups *before, const fst_beads_result *result)
{
    if (before->count != result->group_count)
        return 0;
    for (int g = 0; g < before->count; ++g) {
        const fst_bead_group *a = &before->group[g], *b = &result->groups[g];
        if (a->kind != b->kind || a->count != b->count ||
            memcmp(a->members, b->members, (size_t)a->count * sizeof *a->members) != 0)
            return 0;
    }
    return 1;
}

static fst_beads_outcome outcome_of_group(const fst_bead_group *group, double omega, fst_beads_result *result)
{
    const size_t room = sizeof result->reason;
    if (group->kind == FST_BEAD_GROUP_SINGLE) {
        (void)snprintf(result->reason, room, "no two beads stay together for a turn of the magnet");
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

/* A bead that is gone ends all questions. */
static int was_ejected(const beads_seen *seen, fst_beads_result *result)
{
    for (int i = 0; i < result->count; ++i)
        if (seen->gone[i]) {
            result->outcome = FST_BEADS_EJECTED;
            const fst_regime regime = result->beads[i].regime;
            (void)snprintf(result->reason, sizeof result->reason,
                           regime == FST_REGIME_TOUCHED ? "bead %d touched the magnet at t = %.6g"
                           : regime == FST_REGIME_LOST  ? "bead %d was lost at t = %.6g"
                                                        : "bead %d passed the plate's edge at t = %.6g",
                           i + 1, seen->ejected[i]);
            return 1;
        }
    return 0;
}

/* Whether mean r, without a plate the height, or in a wave the velocity, is the same in both halves of the
 * window. */
static int has_settled(const beads_seen *seen, const beads_moment at[3], int number, fst_beads_result *result)
{
    for (int i = 0; i < result->count; ++i) {
        const double first = mean_rate(result->count, &at[0], &at[1], number, i);
        const double second = mean_rate(result->count, &at[1], &at[2], number, i);
        const double radius = seen->world->body[i].radius,
                     scale = number == X ? radius * seen->world->omega : fmax(result->beads[i].mean_r, radius);
        if (fabs(second - first) > UNSETTLED * scale) {
            (void)snprintf(result->reason, sizeof result->reason,
                           "bead %d has not settled: its mean %s goes from %.4g to %.4g in the window", i + 1,
                           number == R   ? "r"
                           : number == X ? "velocity along the wave"
                                         : "height",
                           first, second);
            return 0;
        }
    }
    return 1;
}

static void decide(const beads_seen *seen, const beads_moment at[3], int same, fst_beads_result *result)
{
    const size_t room = sizeof result->reason;
    const fst_bead_group *largest = &result->groups[0];
    if (was_ejected(seen, result))
        return;
    result->outcome = FST_BEADS_UNDECIDED;
    if (!same) {
        (void)snprintf(result->reason, room,
                       "the groups changed after the discard: make run.periods and "
                       "run.discard larger");
        return;
    }
    if (!has_settled(seen, at, is_in_wave(seen->world) ? X : R, result) ||
        (isnan(seen->world->plate) && !has_settled(seen, at, HEIGHT, result)))
        return;
    for (int g = 1; g < result->group_count; ++g)
        if (result->groups[g].count > largest->count)
            largest = &result->groups[g];
    result->outcome = outcome_of_group(largest, seen->world->omega, result);
}

static int is_any_left(const beads_seen *seen)
{
    int left = 0;
    for (int i = 0; i < seen->world->count; ++i)
        left += !seen->gone[i];
    return left > 0;
}

void beads_conclude(const beads_seen *seen, const beads_groups *groups, const beads_moment at[3],
                    fst_beads_result *result)
{
    const beads_moment *from = &at[0], *to = &at[2];
    const double time = is_any_left(seen) ? to->time - from->time : NAN; /* no bead, no means */
    const int same = same_groups(groups, result);
    tell_beads(seen, at, result->beads);
    tell_groups(seen, at, same, result);
    decide(seen, at, same, result);
    result->drive_power = (to->work[BEADS_DRIVE] - from->work[BEADS_DRIVE]) / time;
    result->plate_power = (to->work[BEADS_PLATE] - from->work[BEADS_PLATE]) / time;
    result->pair_power = (to->work[BEADS_PAIR] - from->work[BEADS_PAIR]) / time;
    result->medium_power = (to->work[BEADS_MEDIUM] - from->work[BEADS_MEDIUM]) / time;
    result->impact_power = (to->impacts - from->impacts) / time;
    result->restitution = seen->world->restitution;
    result->omega = seen->world->omega;
}
