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
 * A contact that would need more than its whole friction as soon as it grazes opens, and others with it (events.c).
 *
 * Choosing anew: change the contact that is most in the wrong, at most MOST_FLIPS times; then the last one that is
 * wrong, which does not go round in circles where friction is weak; then do so with one contact after the other grazing
 * at first.  Of few contacts all sets are tried after that, without grazing contacts, with one, with two.
 */
#include "beads/select.h"

#include <math.h>
#include <string.h>

enum { MOST_FLIPS = 60, MOST_TRIED = 10, SETTINGS = 3 };
enum { THE_WORST, THE_LAST };
static const double SLACK = 1e-10;

/* How far a contact is from its condition, as an acceleration; at most 0: it meets it. */
static double wrongness(const beads_world *world, const beads_modes *modes, const beads_look *look, int k)
{
    const beads_contact *c = &world->contact[k];
    const double ease = c->inertia_of[0] + c->inertia_of[1], held = look->held[k];
    if (modes->contact[k] == BEADS_OPEN)
        return -beads_bend_of_gap(world, look, k);
    if (modes->contact[k] == BEADS_PRESSING)
        return -held * ease;
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

static int is_consistent(const beads_world *world, const double *y, const int *touching,
                         const beads_modes *modes)
{
    beads_look look;
    return wrong_one(world, y, touching, modes, THE_WORST, &look) == -1;
}

static void flip(beads_modes *modes, const beads_look *look, int k)
{
    const int opens =
        modes->contact[k] == BEADS_PRESSING || (modes->contact[k] == BEADS_GRAZING && look->held[k] < 0.5);
    modes->contact[k] = opens ? BEADS_OPEN : BEADS_PRESSING;
}

/* All sets with `grazing` grazing contacts: `setting` counts them in base 3. */
static int try_all(const beads_world *world, const double *y, const int *touching, int grazing,
                   beads_modes *modes)
{
    int list[BEADS_CONTACTS], count = 0;
    for (int k = 0; k < world->contacts; ++k)
        if (touching[k])
            list[count++] = k;
    if (count > MOST_TRIED)
        return 0;
    long settings = 1;
    for (int i = 0; i < count; ++i)
        settings *= SETTINGS;
    for (long setting = 0; setting < settings; ++setting) {
        long rest = setting;
        int graze = 0;
        for (int i = 0; i < count; ++i, rest /= SETTINGS) {
            modes->contact[list[i]] = (unsigned char)(rest % SETTINGS);
            graze += rest % SETTINGS == BEADS_GRAZING;
        }
        if (graze == grazing && is_consistent(world, y, touching, modes))
            return 1;
    }
    return 0;
}

/* Flip one contact after the other. */
static int flip_on(const beads_world *world, const double *y, const int *touching, int rule, beads_modes *modes)
{
    beads_look look;
    for (int flips = 0; flips < MOST_FLIPS; ++flips) {
        const int k = wrong_one(world, y, touching, modes, rule, &look);
        if (k < 0)
            return k == -1;
        flip(modes, &look, k);
    }
    return 0;
}

int beads_select(const beads_world *world, const double *y, const int *touching, beads_modes *modes)
{
    const beads_modes before = *modes;
    for (int rule = THE_WORST; rule <= THE_LAST; ++rule) {
        *modes = before;
        if (flip_on(world, y, touching, rule, modes))
            return 1;
    }
    for (int k = 0; k < world->contacts; ++k)
        for (int rule = THE_WORST; rule <= THE_LAST && touching[k]; ++rule) {
            *modes = before;
            modes->contact[k] = BEADS_GRAZING;
            if (flip_on(world, y, touching, rule, modes))
                return 1;
        }
    for (int grazing = 0; grazing <= 2; ++grazing)
        if (try_all(world, y, touching, grazing, modes))
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
        if (is_consistent(world, y, touching, modes))
            return 1;
    }
    *modes = before;
    modes->contact[k] = grazed && rises ? BEADS_PRESSING : BEADS_OPEN;
    if (is_consistent(world, y, touching, modes))
        return 1;
    return beads_select(world, y, touching, modes);
}
