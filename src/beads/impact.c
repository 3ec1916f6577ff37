/* impact.c - impulses of all contacts that meet at once, and the projection onto closed contacts.
 *
 * Impulses p along the normals solve, with the approach u = d(gap)/dt before and after,
 *
 *     0 <= p   complementary to   u_after + e u_before >= 0,      u_after = u_before + A p,   A = J J^T
 *
 * where e is the restitution for contacts that close faster than bounce_least, else 0.  This is no Newton's
 * cradle: a bead at speed V against a touching pair gives ((1+e)V/3, (1+e)V/3, (1-2e)V/3), and the kinetic
 * energy is kept at e = 1.  Viscous friction has no impulse.
 *
 * The complementary set is found by Keller's principal pivots: change the last contact that is in the wrong,
 * which ends for any matrix of this kind; then redundant contacts cannot make it go round in a circle.
 */
#include "beads/impact.h"

#include <math.h>
#include <string.h>

#include "beads/linear.h"

enum { MOST_PIVOTS = 2000, PROJECTIONS = 3 };

typedef struct impulses {
    int count, list[BEADS_CONTACTS];
    double matrix[BEADS_CONTACTS * BEADS_CONTACTS];
    double wanted[BEADS_CONTACTS]; /* u_before (1 + e) */
    double p[BEADS_CONTACTS];
} impulses;

static void fill_matrix(const beads_world *world, const beads_look *look, impulses *all)
{
    for (int r = 0; r < all->count; ++r)
        for (int s = 0; s < all->count; ++s)
            all->matrix[r * all->count + s] =
                beads_coupling(world, all->list[r], look->u[all->list[r]], all->list[s], look->u[all->list[s]]);
}

/* Move along the normals: x and v alike. */
static void move(const beads_world *world, const beads_look *look, const impulses *all, int offset, double *y)
{
    for (int s = 0; s < all->count; ++s) {
        const beads_contact *c = &world->contact[all->list[s]];
        for (int m = 0; m < 3; ++m) {
            const double push = all->p[s] * look->u[all->list[s]][m];
            y[FST_BEAD_NUMBERS * c->first + offset + m] -= c->inertia_of[0] * push;
            if (c->second >= 0)
                y[FST_BEAD_NUMBERS * c->second + offset + m] += c->inertia_of[1] * push;
        }
    }
}

/* The impulses if just the contacts `acting` have some. */
static int solve_acting(impulses *all, const int *acting)
{
    double matrix[BEADS_CONTACTS * BEADS_CONTACTS], right[BEADS_CONTACTS];
    int of[BEADS_CONTACTS], count = 0, unused;
    for (int r = 0; r < all->count; ++r)
        if (acting[r])
            of[count++] = r;
    for (int r = 0; r < count; ++r) {
        right[r] = -all->wanted[of[r]];
        for (int s = 0; s < count; ++s)
            matrix[r * count + s] = all->matrix[of[r] * all->count + of[s]];
    }
    memset(all->p, 0, sizeof all->p);
    if (count && !beads_solve_symmetric(count, matrix, right, &unused))
        return 0;
    for (int r = 0; r < count; ++r)
        all->p[of[r]] = right[r];
    return 1;
}

static int solve_impulses(impulses *all)
{
    int acting[BEADS_CONTACTS] = {0};
    double scale = 0.0;
    for (int r = 0; r < all->count; ++r)
        scale = fmax(scale, fabs(all->wanted[r]));
    for (int pivot = 0; pivot < MOST_PIVOTS; ++pivot) {
        int wrong = -1;
        if (!solve_acting(all, acting))
            return 0;
        for (int r = 0; r < all->count; ++r) {
            double after = all->wanted[r];
            for (int s = 0; s < all->count; ++s)
                after += all->matrix[r * all->count + s] * all->p[s];
            const double bad = acting[r] ? -all->p[r] * all->matrix[r * all->count + r] : -after;
            if (bad > 1e-13 * scale)
                wrong = r;
        }
        if (wrong < 0)
            return 1;
        acting[wrong] = !acting[wrong];
    }
    return 0;
}

int beads_collide(const beads_world *world, const beads_modes *modes, const int *touching, double *y)
{
    impulses all = {.count = 0};
    beads_look look;
    beads_look_at_gaps(world, modes, y, &look);
    for (int k = 0; k < world->contacts; ++k) {
        if (!touching[k])
            continue;
        const double u = look.rate[k];
        all.wanted[all.count] = u < -world->bounce_least ? u * (1.0 + world->restitution) : u;
        all.list[all.count++] = k;
    }
    fill_matrix(world, &look, &all);
    if (!solve_impulses(&all))
        return 0;
    move(world, &look, &all, BEADS_V, y);
    return 1;
}

static void unit_moments(const beads_world *world, double *y)
{
    for (int i = 0; i < world->count; ++i) {
        double *n = y + FST_BEAD_NUMBERS * i + BEADS_N;
        const double norm = sqrt(beads_dot(n, n));
        for (int m = 0; m < 3; ++m)
            n[m] /= norm;
    }
}

/* One step of Newton's method along the normals; `what`: the gaps, or their rates. */
static void project_once(const beads_world *world, const beads_modes *modes, impulses *all, int offset,
                         double *y)
{
    beads_look look;
    int unused;
    double worst = 0.0;
    beads_look_at_gaps(world, modes, y, &look);
    for (int s = 0; s < all->count; ++s) {
        all->p[s] = offset == BEADS_V ? -look.rate[all->list[s]] : -look.gap[all->list[s]];
        worst = fmax(worst, fabs(all->p[s]));
    }
    if (worst == 0.0)
        return;
    fill_matrix(world, &look, all);
    if (beads_solve_symmetric(all->count, all->matrix, all->p, &unused))
        move(world, &look, all, offset, y);
}

void beads_project(const beads_world *world, const beads_modes *modes, double *y)
{
    impulses all = {.count = 0};
    for (int k = 0; k < world->contacts; ++k)
        if (modes->contact[k] != BEADS_OPEN)
            all.list[all.count++] = k;
    unit_moments(world, y);
    if (!all.count)
        return;
    for (int i = 0; i < PROJECTIONS; ++i)
        project_once(world, modes, &all, 0, y);
    project_once(world, modes, &all, BEADS_V, y);
}
