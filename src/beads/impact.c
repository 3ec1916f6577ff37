/* impact.c - impulses of all contacts that meet at once, and the projection onto closed contacts.
 *
 * Impulses p along the normals solve, with the approach u = d(gap)/dt before and after,
 *
 *     0 <= p   complementary to   u_after + e u_before >= 0,      u_after = u_before + A p,   A = J J^T
 *
 * where e is the restitution for contacts that close faster than bounce_least, else 0.  This is not a Newton's
 * cradle: a bead at speed V against a touching pair gives ((1+e)V/3, (1+e)V/3, (1-2e)V/3), and the kinetic
 * energy is kept at e = 1.  Viscous friction has no impulse.
 *
 * The complementary set is found by Keller's principal pivots: change the last contact that is in the wrong,
 * which ends for any matrix of this kind; then redundant contacts cannot make it go round in a circle.
 *
 * Dry friction has the impulse f across each normal, against the slip that is left (Moreau):
 *
 *     |f| <= mu p;   where V_after is not 0, f = -mu p V_after/|V_after|
 *
 * A contact by itself gets what it had against a slip V: min(mu p, |V|/k), which stops the slip at most (k = yielding).
 * With e = 0 such impulses never add energy, whatever the contacts: their work is the sum of p u_after = 0 and
 * f.V_after <= 0, less half of a square.  With e > 0 several contacts may do so; then e is made smaller until they do
 * not.  Impulses are found by projected Gauss-Seidel sweeps: a contact of spheres has no coupling between its own normal
 * and its own slip, so that each sweep solves one contact after the other exactly.
 */
#include "beads/impact.h"

#include <math.h>
#include <string.h>

#include "beads/hold.h"
#include "beads/linear.h"

enum { MOST_PIVOTS = 2000, MOST_SWEEPS = 100000, PROJECTIONS = 3, MOST_SOFTER = 40 };
static const double STILL = 1e-16; /* change of an impulse in a sweep, over the greatest velocity */

typedef struct impulses {
    int count, of[BEADS_CONTACTS + 1]; /* contacts, and where the ties of each begin */
    int ties;
    beads_tie tie[BEADS_TIES];
    double matrix[BEADS_TIES * BEADS_TIES];
    double before[BEADS_TIES]; /* gap' or slip */
    double wanted[BEADS_TIES]; /* of gaps: u_before (1 + e) */
    double p[BEADS_TIES];
} impulses;

/* No contacts yet; the rest is filled as they are added. */
static void begin(impulses *all)
{
    all->count = all->ties = 0;
}

static void add_contact(const beads_look *look, int k, int with_slip, impulses *all)
{
    all->of[all->count++] = all->ties;
    all->ties += beads_tie_contact(look, k, with_slip, &all->tie[all->ties]);
    all->of[all->count] = all->ties;
}

/* Move along the ties: velocities, or places along the normals. */
static void move(const beads_world *world, const beads_look *look, const impulses *all, int offset, double *y)
{
    for (int s = 0; s < all->ties; ++s) {
        const beads_tie *tie = &all->tie[s];
        const beads_contact *c = &world->contact[tie->contact];
        double about[3];
        fst_cross_double(look->u[tie->contact], tie->push, about);
        for (int side = 0; side < 2; ++side) {
            const int i = side ? c->second : c->first;
            if (i < 0)
                continue;
            const beads_body *body = &world->body[i];
            double *bead = y + FST_BEAD_NUMBERS * i;
            const double push = (side ? -1.0 : 1.0) * c->inertia_of[side] * all->p[s];
            for (int m = 0; m < 3; ++m) {
                bead[offset + m] += push * tie->push[m];
                if (offset == BEADS_V)
                    bead[BEADS_W + m] += all->p[s] * body->radius / body->inertia * about[m];
            }
        }
    }
}

/* The impulses if just the ties `acting` have some. */
static int solve_acting(impulses *all, const int *acting)
{
    double matrix[BEADS_CONTACTS * BEADS_CONTACTS], right[BEADS_CONTACTS];
    int of[BEADS_CONTACTS], count = 0, unused;
    for (int r = 0; r < all->ties; ++r)
        if (acting[r])
            of[count++] = r;
    for (int r = 0; r < count; ++r) {
        right[r] = -all->wanted[of[r]];
        for (int s = 0; s < count; ++s)
            matrix[r * count + s] = all->matrix[of[r] * all->ties + of[s]];
    }
    memset(all->p, 0, sizeof all->p);
    if (count && !beads_solve_symmetric(count, matrix, right, &unused))
        return 0;
    for (int r = 0; r < count; ++r)
        all->p[of[r]] = right[r];
    return 1;
}

static double after(const impulses *all, const double *before, int r)
{
    double sum = before[r];
    for (int s = 0; s < all->ties; ++s)
        sum += all->matrix[r * all->ties + s] * all->p[s];
    return sum;
}

static double greatest(const impulses *all)
{
    double scale = 0.0;
    for (int r = 0; r < all->ties; ++r)
        scale = fmax(scale, fabs(all->wanted[r]));
    return scale;
}

/* Without dry friction. */
static int solve_normal(impulses *all)
{
    int acting[BEADS_CONTACTS] = {0};
    const double scale = greatest(all);
    for (int pivot = 0; pivot < MOST_PIVOTS; ++pivot) {
        int wrong = -1;
        if (!solve_acting(all, acting))
            return 0;
        for (int r = 0; r < all->ties; ++r) {
            const double bad =
                acting[r] ? -all->p[r] * all->matrix[r * all->ties + r] : -after(all, all->wanted, r);
            if (bad > 1e-13 * scale)
                wrong = r;
        }
        if (wrong < 0)
            return 1;
        acting[wrong] = !acting[wrong];
    }
    return 0;
}

/* The impulses of one contact, from those of the others. */
static void solve_contact(const beads_world *world, impulses *all, int first)
{
    double *p = &all->p[first];
    const double mu = world->contact[all->tie[first].contact].mu;
    const double ease = all->matrix[first * all->ties + first];
    p[0] = fmax(p[0] - after(all, all->wanted, first) / ease, 0.0);
    if (!(mu > 0))
        return;
    const double k = all->matrix[(first + 1) * all->ties + first + 1];
    const double f[2] = {p[1] - after(all, all->before, first + 1) / k,
                         p[2] - after(all, all->before, first + 2) / k};
    const double size = sqrt(f[0] * f[0] + f[1] * f[1]), part = size > mu * p[0] ? mu * p[0] / size : 1.0;
    p[1] = part * f[0];
    p[2] = part * f[1];
}

static int sweep(const beads_world *world, impulses *all)
{
    const double scale = greatest(all);
    double kept[BEADS_TIES], change = INFINITY;
    memset(all->p, 0, sizeof all->p);
    for (int i = 0; i < MOST_SWEEPS && change > STILL * scale; ++i) {
        memcpy(kept, all->p, sizeof kept);
        for (int c = 0; c < all->count; ++c)
            solve_contact(world, all, all->of[c]);
        change = 0.0;
        for (int r = 0; r < all->ties; ++r)
            change = fmax(change, fabs(all->p[r] - kept[r]));
    }
    return change < 1e-12 * scale;
}

/* Twice the work of the impulses. */
static double work_of(const impulses *all)
{
    double sum = 0.0;
    for (int r = 0; r < all->ties; ++r)
        sum += all->p[r] * (all->before[r] + after(all, all->before, r));
    return sum;
}

static void want(const beads_world *world, impulses *all, double restitution)
{
    memcpy(all->wanted, all->before, sizeof all->wanted);
    for (int c = 0; c < all->count; ++c)
        if (all->before[all->of[c]] < -world->bounce_least)
            all->wanted[all->of[c]] *= 1.0 + restitution;
}

/* With dry friction: as much restitution as adds no energy. */
static int solve_dry(const beads_world *world, impulses *all)
{
    for (int softer = 0; softer <= MOST_SOFTER; ++softer) {
        want(world, all, world->restitution * (1.0 - (double)softer / MOST_SOFTER));
        if (!sweep(world, all))
            return 0;
        if (work_of(all) <= 0)
            return 1;
    }
    return 1;
}

int beads_collide(const beads_world *world, const beads_modes *modes, const int *touching, double *y)
{
    impulses all;
    beads_look look;
    int dry = 0;
    begin(&all);
    beads_look_at_gaps(world, modes, y, &look);
    for (int k = 0; k < world->contacts; ++k) {
        if (!touching[k])
            continue;
        const int rubs = world->contact[k].mu > 0, first = all.ties;
        dry = dry || rubs;
        add_contact(&look, k, rubs, &all);
        all.before[first] = look.rate[k];
        if (!rubs)
            continue;
        beads_look_at_slip(world, k, y, &look);
        for (int i = first + 1; i < all.ties; ++i)
            all.before[i] = beads_dot(all.tie[i].along, look.slip[k]);
    }
    beads_couple(world, &look, all.tie, all.ties, all.matrix);
    want(world, &all, world->restitution);
    if (!(dry ? solve_dry(world, &all) : solve_normal(&all)))
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

/* What is to vanish at the contacts: the gaps, or their rates and the slips that stick. */
static void find_wrong(const beads_look *look, int offset, impulses *all)
{
    for (int c = 0; c < all->count; ++c) {
        const int first = all->of[c], k = all->tie[first].contact;
        all->p[first] = offset == BEADS_V ? -look->rate[k] : -look->gap[k];
        for (int i = first + 1; i < all->of[c + 1]; ++i)
            all->p[i] = -beads_dot(all->tie[i].along, look->slip[k]);
    }
}

/* One step of Newton's method, for places or velocities. */
static void project_once(const beads_world *world, const beads_modes *modes, int offset, double *y)
{
    impulses all;
    beads_look look;
    int unused;
    double worst = 0.0;
    begin(&all);
    beads_look_at_gaps(world, modes, y, &look);
    for (int k = 0; k < world->contacts; ++k) {
        if (modes->contact[k] == BEADS_OPEN)
            continue;
        const int sticks = offset == BEADS_V && modes->contact[k] == BEADS_STICKING;
        if (sticks)
            beads_look_at_slip(world, k, y, &look);
        add_contact(&look, k, sticks, &all);
    }
    find_wrong(&look, offset, &all);
    for (int i = 0; i < all.ties; ++i)
        worst = fmax(worst, fabs(all.p[i]));
    if (worst == 0.0)
        return;
    beads_couple(world, &look, all.tie, all.ties, all.matrix);
    if (beads_solve_symmetric(all.ties, all.matrix, all.p, &unused))
        move(world, &look, &all, offset, y);
}

void beads_project(const beads_world *world, const beads_modes *modes, double *y)
{
    int closed = 0;
    for (int k = 0; k < world->contacts; ++k)
        closed = closed || modes->contact[k] != BEADS_OPEN;
    unit_moments(world, y);
    if (!closed)
        return;
    for (int i = 0; i < PROJECTIONS; ++i)
        project_once(world, modes, 0, y);
    project_once(world, modes, BEADS_V, y);
}
