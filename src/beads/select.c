/* select.c - which touching contacts press, graze or open.
 *
 * For a fixed set of contacts that rub the accelerations are unique (Gauss's principle of least constraint).
 * But friction acts "only while it presses", and friction of one contact changes the load of another: then no
 * set may be consistent, or two.  The rule that always has an answer lets the friction of a closed contact be
 * -theta c V with 0 <= theta <= 1:
 *
 *                     load falls to 0                       theta falls to 0
 *        pressing ---------------------> open if that is  <------------------- grazing
 *     (load, theta = 1) <-----------      consistent,        (load 0, theta solves gap'' = 0)
 *                      theta rises to 1   else grazing,
 *                                         else choose anew
 *
 * Under dry friction a contact without load has no friction, and opens.  One that does not slip sticks while its
 * friction suffices, and begins to slip where it does not.  Then no set may be consistent, or several with different
 * accelerations: paradoxes of Painleve, which are told.
 *
 * A contact that would need more than its whole friction as soon as it grazes opens, and others with it (events.c).
 *
 * Choosing anew: change the contact that is most in the wrong, at most MOST_FLIPS times; then the last one that is
 * wrong, which does not go round in circles where friction is weak; then do so with one contact after the other grazing
 * at first.  Of few contacts all sets are tried after that, without grazing contacts, with one, with two.
 */
#include "beads/select.h"

#include <math.h>

#include "beads/hold.h"

enum { MOST_FLIPS = 60, SETTINGS = 3, MOST_COMPARED = 4 };
enum { THE_WORST, THE_LAST };
static const double SLACK = 1e-10, ANOTHER = 1e-6;
static const double ALIGNED =
    0.9; /* cosine of the angle by which a slip that begins lags behind the push at most */

/* How fast a contact slips. */
static double speed_of(const beads_world *world, const beads_modes *modes, const double *y, int k)
{
    beads_look look;
    beads_look_at_gaps(world, modes, y, &look);
    beads_look_at_slip(world, k, y, &look);
    return sqrt(beads_dot(look.slip[k], look.slip[k]));
}

/* The state of a closed contact in which it would be without the others. */
static unsigned char home_of(const beads_world *world, const beads_modes *modes, const double *y, int k)
{
    const int dry = world->contact[k].mu > 0;
    return dry && speed_of(world, modes, y, k) <= world->still ? BEADS_STICKING : BEADS_PRESSING;
}

/* The same, but a slip that has just begun goes on so if it may (wrongness()). */
static unsigned char home_or_on(const beads_world *world, const beads_modes *modes, const double *y, int k)
{
    const unsigned char home = home_of(world, modes, y, k);
    const int on = modes->contact[k] == BEADS_BEGINNING && home == BEADS_PRESSING &&
                   speed_of(world, modes, y, k) < world->free_at;
    return on ? BEADS_BEGINNING : home;
}

void beads_close(const beads_world *world, const double *y, const int *touching, beads_modes *modes)
{
    for (int k = 0; k < world->contacts; ++k)
        modes->contact[k] = touching[k] ? home_or_on(world, modes, y, k) : BEADS_OPEN;
}

/* How far a contact is from its condition, as an acceleration; at most 0: it meets it. */
static double wrongness(const beads_world *world, const beads_modes *modes, const beads_look *look, int k)
{
    const beads_contact *c = &world->contact[k];
    const double ease = c->inertia_of[0] + c->inertia_of[1], held = look->held[k];
    if (modes->contact[k] == BEADS_OPEN)
        return -beads_bend_of_gap(world, look, k);
    if (modes->contact[k] == BEADS_PRESSING)
        return -held * ease;
    if (modes->contact[k] == BEADS_STICKING) {
        const double needed = sqrt(beads_dot(look->friction[k], look->friction[k]));
        return ease * fmax(-held, needed - c->mu * held);
    }
    if (modes->contact[k] == BEADS_BEGINNING) {
        double change[3];
        beads_slip_change(world, look, k, change);
        const double speed = sqrt(beads_dot(look->slip[k], look->slip[k]));
        const double across =
            speed > world->still ? ALIGNED * speed - beads_dot(look->slip[k], look->way[k]) : 0.0;
        if (across > 0)
            return ease * c->mu * fabs(held);
        return fmax(-held * ease, -beads_dot(change, look->way[k]));
    }
    const double rub = ease * c->friction * sqrt(beads_dot(look->slip[k], look->slip[k]));
    return rub * fmax(-held, held - 1.0);
}

/* The contact that is in the wrong, most of all or last of all, or -1: the modes are consistent; -2: no loads keep these
 * contacts closed. */
static int wrong_one(const beads_world *world, const double *y, const int *touching, const beads_modes *modes,
                     int rule, beads_look *look)
{
    int found = -1;
    double greatest = 0.0, scale = 0.0;
    beads_look_at(world, modes, y, look);
    if (!look->solvable)
        return -2;
    for (int i = 0; i < world->count; ++i)
        for (int m = 0; m < 3; ++m)
            scale = fmax(scale, fabs(look->force[i][m]) / world->body[i].mass);
    for (int k = 0; k < world->contacts; ++k)
        if (touching[k] && modes->contact[k] != BEADS_OPEN)
            scale = fmax(scale, fabs(wrongness(world, modes, look, k)));
    for (int k = 0; k < world->contacts; ++k) {
        const double wrong = touching[k] ? wrongness(world, modes, look, k) : 0.0;
        if (wrong > SLACK * scale && (rule == THE_LAST || wrong > greatest)) {
            greatest = wrong;
            found = k;
        }
    }
    return found;
}

int beads_is_consistent(const beads_world *world, const double *y, const int *touching,
                        const beads_modes *modes)
{
    beads_look look;
    return wrong_one(world, y, touching, modes, THE_WORST, &look) == -1;
}

static void flip(beads_modes *modes, const beads_look *look, unsigned char home, int k)
{
    if (modes->contact[k] == BEADS_STICKING || modes->contact[k] == BEADS_BEGINNING) {
        const unsigned char other = modes->contact[k] == BEADS_STICKING ? BEADS_BEGINNING : home;
        modes->contact[k] = look->held[k] < 0 ? BEADS_OPEN : other;
        return;
    }
    const int opens =
        modes->contact[k] == BEADS_PRESSING || (modes->contact[k] == BEADS_GRAZING && look->held[k] < 0.5);
    modes->contact[k] = opens ? BEADS_OPEN : home;
}

/* The states that a contact may have: open, that in which it is by itself, and another one; `setting` of 0 to 2. */
static int set_one(const beads_world *world, unsigned char home, int setting, int k, beads_modes *modes)
{
    const unsigned char other = home == BEADS_STICKING ? BEADS_BEGINNING : BEADS_GRAZING;
    const unsigned char states[SETTINGS] = {BEADS_OPEN, home, other};
    modes->contact[k] = states[setting];
    return setting < 2 || home == BEADS_STICKING || !(world->contact[k].mu > 0);
}

/* The contacts that touch.  Returns how many ways there are to set them all, or 0: there are more than `most`. */
static long list_touching(const beads_world *world, const int *touching, int most, int list[BEADS_CONTACTS],
                          int *count)
{
    long settings = 1;
    *count = 0;
    for (int k = 0; k < world->contacts; ++k)
        if (touching[k])
            list[(*count)++] = k;
    for (int i = 0; i < *count && settings; ++i)
        settings = *count > most ? 0 : settings * SETTINGS;
    return settings;
}

/* Set all contacts: `setting` counts the ways in base 3.  Returns how many graze, or -1: there is no such state. */
static int set_all(const beads_world *world, const unsigned char *home, const int *list, int count,
                   long setting, beads_modes *modes)
{
    int grazing = 0;
    for (int i = 0; i < count; ++i, setting /= SETTINGS) {
        if (!set_one(world, home[list[i]], (int)(setting % SETTINGS), list[i], modes))
            return -1;
        grazing += modes->contact[list[i]] == BEADS_GRAZING;
    }
    return grazing;
}

/* All sets with `grazing` grazing contacts. */
static int try_all(const beads_world *world, const double *y, const int *touching, const unsigned char *home,
                   int grazing, beads_modes *modes)
{
    int list[BEADS_CONTACTS], count;
    const long settings = list_touching(world, touching, BEADS_MOST_TRIED, list, &count);
    for (long setting = 0; setting < settings; ++setting)
        if (set_all(world, home, list, count, setting, modes) == grazing &&
            beads_is_consistent(world, y, touching, modes))
            return 1;
    return 0;
}

/* How far the forces of two looks are apart, over the greatest. */
static double difference(const beads_world *world, const beads_look *a, const beads_look *b)
{
    double apart = 0.0, scale = 0.0;
    for (int i = 0; i < world->count; ++i)
        for (int m = 0; m < 3; ++m) {
            apart = fmax(apart, fabs(a->force[i][m] - b->force[i][m]));
            scale = fmax(scale, fmax(fabs(a->force[i][m]), fabs(b->force[i][m])));
        }
    return scale > 0 ? apart / scale : 0.0;
}

int beads_is_one_of_several(const beads_world *world, const double *y, const int *touching,
                            const beads_modes *modes)
{
    int list[BEADS_CONTACTS], count;
    unsigned char home[BEADS_CONTACTS];
    beads_modes other = *modes;
    beads_look here, there;
    const long settings = list_touching(world, touching, MOST_COMPARED, list, &count);
    beads_look_at(world, modes, y, &here);
    for (int i = 0; i < count; ++i) { /* a slip that is over next counts as a slip still */
        const unsigned char mode = modes->contact[list[i]];
        home[list[i]] = home_of(world, modes, y, list[i]);
        if (mode == BEADS_PRESSING || (mode == BEADS_BEGINNING && home[list[i]] == BEADS_PRESSING))
            home[list[i]] = mode;
    }
    for (long setting = 0; setting < settings; ++setting) {
        if (set_all(world, home, list, count, setting, &other) != 0 ||
            !beads_is_consistent(world, y, touching, &other))
            continue;
        beads_look_at(world, &other, y, &there);
        if (difference(world, &here, &there) > ANOTHER)
            return 1;
    }
    return 0;
}

/* Flip one contact after the other. */
static int flip_on(const beads_world *world, const double *y, const int *touching, const unsigned char *home,
                   int rule, beads_modes *modes)
{
    beads_look look;
    for (int flips = 0; flips < MOST_FLIPS; ++flips) {
        const int k = wrong_one(world, y, touching, modes, rule, &look);
        if (k < 0)
            return k == -1;
        flip(modes, &look, home[k], k);
    }
    return 0;
}

int beads_select(const beads_world *world, const double *y, const int *touching, beads_modes *modes)
{
    const beads_modes before = *modes;
    unsigned char home[BEADS_CONTACTS] = {0};
    for (int k = 0; k < world->contacts; ++k)
        if (touching[k])
            home[k] = home_of(world, modes, y, k);
    for (int rule = THE_WORST; rule <= THE_LAST; ++rule) {
        *modes = before;
        if (flip_on(world, y, touching, home, rule, modes))
            return 1;
    }
    for (int k = 0; k < world->contacts; ++k)
        for (int rule = THE_WORST; rule <= THE_LAST && touching[k] && !(world->contact[k].mu > 0); ++rule) {
            *modes = before;
            modes->contact[k] = BEADS_GRAZING;
            if (flip_on(world, y, touching, home, rule, modes))
                return 1;
        }
    for (int grazing = 0; grazing <= 2; ++grazing)
        if (try_all(world, y, touching, home, grazing, modes))
            return 1;
    *modes = before;
    return 0;
}

int beads_release(const beads_world *world, const double *y, const int *touching, int k, int rises,
                  beads_modes *modes)
{
    static const unsigned char after_load[] = {BEADS_OPEN, BEADS_GRAZING};
    const int grazed = modes->contact[k] == BEADS_GRAZING;
    const beads_modes before = *modes;
    for (int i = 0; i < 2 && !grazed; ++i) {
        modes->contact[k] = after_load[i];
        if (beads_is_consistent(world, y, touching, modes))
            return 1;
    }
    *modes = before;
    modes->contact[k] = grazed && rises ? BEADS_PRESSING : BEADS_OPEN;
    if (beads_is_consistent(world, y, touching, modes))
        return 1;
    return beads_select(world, y, touching, modes);
}
