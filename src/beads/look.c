/* look.c - forces on beads, and the forces that keep closed contacts closed.
 *
 *     magnet:  force s G n, torque s n x B                     pair i, j:  dipoles, d = x_j - x_i, u = d/|d|
 *     contact: u from its first body towards the second (towards the plate: down), gap' = u.(v_j - v_i)
 *              slip V = (v_i - v_j)_t + (R_i W_i + R_j W_j) x u,   friction f = -c V on i, -f on j,
 *              torques R_i u x f and R_j u x f
 *
 * The plate is a body that never moves, so the same lines serve it.
 *
 * Closed contacts.  A pressing contact pushes with a load that keeps gap'' = 0.  A grazing one has no load and
 * rubs by a share of its friction such that gap'' = 0.  These conditions are linear in all loads and shares
 * together: with a the accelerations without them,
 *
 *     gap''_r = u_r.(a_j - a_i) + |v_t|^2/|d| + sum over s of coupling_rs held_s = 0
 *
 * Pairs of uniform spheres are point dipoles exactly (Edwards et al., Am. J. Phys. 85 (2017) 130).
 */
#include "beads/look.h"

#include <math.h>
#include <string.h>

#include "beads/linear.h"

static void add(double to[3], double factor, const double v[3])
{
    for (int k = 0; k < 3; ++k)
        to[k] += factor * v[k];
}

/* ------------------------------------------------------------------ what acts without touch */

static void magnet_acts(const beads_world *world, int i, const double *y, beads_look *look)
{
    const double *bead = y + FST_BEAD_NUMBERS * i, *n = bead + BEADS_N, s = world->body[i].strength;
    double b[3], gn[3], nxb[3];
    fst_gradient_double g;
    world->field(world->source, bead[0], bead[1], beads_height(world, i, y), b, &g);
    fst_times_gradient_double(&g, n, gn);
    fst_cross_double(n, b, nxb);
    add(look->force[i], s, gn);
    add(look->torque[i], s, nxb);
    look->power[BEADS_DRIVE] += s * (bead[0] * gn[1] - bead[1] * gn[0] + nxb[2]);
}

static void dipoles_act(const beads_world *world, int i, int j, const double *y, const double u[3],
                        double distance, beads_look *look)
{
    const double *n = y + FST_BEAD_NUMBERS * i + BEADS_N, *m = y + FST_BEAD_NUMBERS * j + BEADS_N;
    const double cubed = world->body[i].dipole * world->body[j].dipole / (distance * distance * distance);
    const double nu = beads_dot(n, u), mu = beads_dot(m, u), nm = beads_dot(n, m);
    double force[3], of_i[3], of_j[3], turning[3];
    for (int k = 0; k < 3; ++k) {
        force[k] = 3.0 * cubed / distance * (nu * m[k] + mu * n[k] + (nm - 5.0 * nu * mu) * u[k]);
        of_i[k] = cubed * (3.0 * nu * u[k] - n[k]); /* the field of bead i at j, and of j at i */
        of_j[k] = cubed * (3.0 * mu * u[k] - m[k]);
    }
    add(look->force[j], 1.0, force);
    add(look->force[i], -1.0, force);
    fst_cross_double(m, of_i, turning);
    add(look->torque[j], 1.0, turning);
    fst_cross_double(n, of_j, turning);
    add(look->torque[i], 1.0, turning);
}

/* ------------------------------------------------------------------ contacts */

int beads_can_meet(const beads_world *world, const beads_modes *modes, int contact)
{
    const beads_contact *c = &world->contact[contact];
    if (c->second < 0)
        return !isnan(world->plate) && !modes->gone[c->first];
    return !modes->gone[c->first] && !modes->gone[c->second];
}

static double look_at_pair(const beads_world *world, int k, const double *y, beads_look *look)
{
    const beads_contact *c = &world->contact[k];
    const double *a = y + FST_BEAD_NUMBERS * c->first, *b = y + FST_BEAD_NUMBERS * c->second;
    const double lift =
        isnan(world->plate) ? 0.0 : world->body[c->second].radius - world->body[c->first].radius;
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2] + lift}, distance = sqrt(beads_dot(d, d));
    const double v[3] = {b[3] - a[3], b[4] - a[4], b[5] - a[5]};
    for (int m = 0; m < 3; ++m)
        look->u[k][m] = d[m] / distance;
    look->gap[k] = distance - c->reach;
    look->rate[k] = beads_dot(look->u[k], v);
    look->turn[k] = (beads_dot(v, v) - look->rate[k] * look->rate[k]) / distance;
    return distance;
}

static void look_at_plate(int k, const double *bead, beads_look *look)
{
    look->u[k][0] = look->u[k][1] = 0.0;
    look->u[k][2] = -1.0;
    look->gap[k] = bead[2];
    look->rate[k] = bead[BEADS_V + 2];
    look->turn[k] = 0.0;
}

void beads_look_at_gaps(const beads_world *world, const beads_modes *modes, const double *y, beads_look *look)
{
    for (int k = 0; k < world->contacts; ++k) {
        if (!beads_can_meet(world, modes, k))
            continue;
        if (world->contact[k].second < 0)
            look_at_plate(k, y + FST_BEAD_NUMBERS * world->contact[k].first, look);
        else
            (void)look_at_pair(world, k, y, look);
    }
}

/* The force -c V and its torques, times `share`. */
static void rub(const beads_world *world, int k, double share, beads_look *look)
{
    const beads_contact *c = &world->contact[k];
    double f[3], turning[3];
    for (int m = 0; m < 3; ++m)
        f[m] = -share * c->friction * look->slip[k][m];
    fst_cross_double(look->u[k], f, turning);
    add(look->force[c->first], 1.0, f);
    add(look->torque[c->first], world->body[c->first].radius, turning);
    if (c->second >= 0) {
        add(look->force[c->second], -1.0, f);
        add(look->torque[c->second], world->body[c->second].radius, turning);
    }
    look->power[c->second < 0 ? BEADS_PLATE : BEADS_PAIR] +=
        share * c->friction * beads_dot(look->slip[k], look->slip[k]);
}

static void find_slip(const beads_world *world, int k, const double *y, beads_look *look)
{
    const beads_contact *c = &world->contact[k];
    const double *a = y + FST_BEAD_NUMBERS * c->first, *u = look->u[k];
    double v[3] = {a[3], a[4], a[5]}, turning[3] = {0.0, 0.0, 0.0}, of_turn[3];
    add(turning, world->body[c->first].radius, a + BEADS_W);
    if (c->second >= 0) {
        const double *b = y + FST_BEAD_NUMBERS * c->second;
        add(v, -1.0, b + BEADS_V);
        add(turning, world->body[c->second].radius, b + BEADS_W);
    }
    fst_cross_double(turning, u, of_turn);
    const double along = beads_dot(v, u);
    for (int m = 0; m < 3; ++m)
        look->slip[k][m] = v[m] - along * u[m] + of_turn[m];
}

double beads_coupling(const beads_world *world, int r, const double u[3], int s, const double d[3])
{
    const beads_contact *p = &world->contact[r], *q = &world->contact[s];
    double sum = 0.0;
    if (p->first == q->first)
        sum += p->inertia_of[0];
    if (p->second >= 0 && p->second == q->second)
        sum += p->inertia_of[1];
    if (p->first == q->second)
        sum -= p->inertia_of[0];
    if (p->second >= 0 && p->second == q->first)
        sum -= p->inertia_of[1];
    return sum == 0.0 ? 0.0 : sum * beads_dot(u, d);
}

double beads_bend_of_gap(const beads_world *world, const beads_look *look, int contact)
{
    const beads_contact *c = &world->contact[contact];
    double bend = look->turn[contact] - c->inertia_of[0] * beads_dot(look->u[contact], look->force[c->first]);
    if (c->second >= 0)
        bend += c->inertia_of[1] * beads_dot(look->u[contact], look->force[c->second]);
    return bend;
}

/* Find what the closed contacts hold, and apply it. */
static void hold(const beads_world *world, const beads_modes *modes, const int *closed, int count,
                 beads_look *look)
{
    double matrix[BEADS_CONTACTS * BEADS_CONTACTS], right[BEADS_CONTACTS], push[BEADS_CONTACTS][3];
    int symmetric = 1;
    for (int s = 0; s < count; ++s) {
        const int k = closed[s], grazes = modes->contact[k] == BEADS_GRAZING;
        for (int m = 0; m < 3; ++m) /* on the second body; the first has its opposite */
            push[s][m] = grazes ? world->contact[k].friction * look->slip[k][m] : look->u[k][m];
        symmetric = symmetric && !grazes;
        right[s] = -beads_bend_of_gap(world, look, k);
    }
    for (int r = 0; r < count; ++r)
        for (int s = 0; s < count; ++s)
            matrix[r * count + s] = beads_coupling(world, closed[r], look->u[closed[r]], closed[s], push[s]);
    look->solvable = symmetric ? beads_solve_symmetric(count, matrix, right, &look->unique)
                               : beads_solve(count, matrix, right);
    for (int s = 0; s < count && look->solvable; ++s) {
        const int k = closed[s];
        look->held[k] = right[s];
        if (modes->contact[k] == BEADS_GRAZING) {
            rub(world, k, right[s], look);
            continue;
        }
        add(look->force[world->contact[k].first], -right[s], look->u[k]);
        if (world->contact[k].second >= 0)
            add(look->force[world->contact[k].second], right[s], look->u[k]);
    }
}

void beads_look_at(const beads_world *world, const beads_modes *modes, const double *y, beads_look *look)
{
    int closed[BEADS_CONTACTS], count = 0;
    memset(look->force, 0, sizeof look->force);
    memset(look->torque, 0, sizeof look->torque);
    memset(look->power, 0, sizeof look->power);
    look->unique = look->solvable = 1;
    for (int i = 0; i < world->count; ++i) {
        if (modes->gone[i])
            continue;
        if (world->field)
            magnet_acts(world, i, y, look);
        look->force[i][2] -= world->body[i].mass * world->gravity;
    }
    look->power[BEADS_DRIVE] *= world->omega;
    for (int k = 0; k < world->contacts; ++k) {
        const beads_contact *c = &world->contact[k];
        look->held[k] = 0.0;
        if (!beads_can_meet(world, modes, k))
            continue;
        if (c->second < 0)
            look_at_plate(k, y + FST_BEAD_NUMBERS * c->first, look);
        else
            dipoles_act(world, c->first, c->second, y, look->u[k], look_at_pair(world, k, y, look), look);
        if (modes->contact[k] == BEADS_OPEN)
            continue;
        find_slip(world, k, y, look);
        if (modes->contact[k] == BEADS_PRESSING)
            rub(world, k, 1.0, look);
        closed[count++] = k;
    }
    if (count)
        hold(world, modes, closed, count, look);
}
