/* look.c - forces on beads, and the forces that keep closed contacts closed.
 *
 *     without touch: act.h and dipoles.h
 *     contact: u from its first body towards the second (towards the plate: down), gap' = u.(v_j - v_i)
 *              slip V = (v_i - v_j)_t + (R_i W_i + R_j W_j) x u,   friction f on i, -f on j,
 *              torques R_i u x f and R_j u x f
 *              gap'' = u.(a_j - a_i) + u'.(v_j - v_i)
 *              V' across u = (a_i - a_j)_t + (R_i W_i' + R_j W_j') x u + ((R_i W_i + R_j W_j).u) u x u'
 *
 * The plate is a body that never moves, so the same lines serve it.
 *
 * Closed contacts hold loads and friction (hold.c).
 *
 * (in a bowl |v_t|^2/|x - c| has the other sign)
 */
#include "beads/look.h"

#include <math.h>
#include <string.h>

#include "beads/act.h"
#include "beads/dipoles.h"
#include "beads/hold.h"

static const double USUAL_SLIP = 0.05; /* l gamma: of slips that are far from stopping */

/* ------------------------------------------------------------------ what acts without touch */

static void dipoles_act(const beads_world *world, int i, int j, const double *y, const double u[3],
                        double nearness, beads_look *look)
{
    const double *n = y + FST_BEAD_NUMBERS * i + BEADS_N, *m = y + FST_BEAD_NUMBERS * j + BEADS_N;
    double force[3], on_i[3], on_j[3];
    beads_dipoles_of(n, m, u, nearness, world->body[i].dipole * world->body[j].dipole, force, on_i, on_j);
    beads_add(look->force[j], 1.0, force);
    beads_add(look->force[i], -1.0, force);
    beads_add(look->torque[j], 1.0, on_j);
    beads_add(look->torque[i], 1.0, on_i);
}

/* ------------------------------------------------------------------ contacts */

int beads_can_meet(const beads_world *world, const beads_modes *modes, int contact)
{
    const beads_contact *c = &world->contact[contact];
    if (c->second < 0)
        return !isnan(world->plate) && !modes->gone[c->first];
    return !modes->gone[c->first] && !modes->gone[c->second];
}

/* u turns as v across it does, at `by` of its speed: of the second body's v, gap'' has the part u'.v. */
static void look_at_turn(int k, const double v[3], double by, beads_look *look)
{
    const double *u = look->u[k], along = beads_dot(u, v);
    for (int m = 0; m < 3; ++m)
        look->turning[k][m] = by * (v[m] - along * u[m]);
    const double bend = beads_dot(look->turning[k], v);
    for (int m = 0; m < 3; ++m)
        look->drift[k][m] = -bend * u[m];
}

/* Gap, rate and direction of contact k.  Returns its curvature. */
static double look_at_contact(const beads_world *world, int k, const double *y, beads_look *look)
{
    const beads_contact *c = &world->contact[k];
    const double *a = y + FST_BEAD_NUMBERS * c->first + BEADS_V;
    double curve, v[3] = {-a[0], -a[1], -a[2]};
    beads_meet(world, c->first, c->second, y, look->u[k], &look->gap[k], &curve);
    if (c->second >= 0)
        beads_add(v, 1.0, y + FST_BEAD_NUMBERS * c->second + BEADS_V);
    look->rate[k] = beads_dot(look->u[k], v);
    look_at_turn(k, v, curve, look);
    return curve;
}

void beads_look_at_gaps(const beads_world *world, const beads_modes *modes, const double *y, beads_look *look)
{
    for (int k = 0; k < world->contacts; ++k)
        if (beads_can_meet(world, modes, k))
            (void)look_at_contact(world, k, y, look);
}

void beads_look_at_slip(const beads_world *world, int k, const double *y, beads_look *look)
{
    const beads_contact *c = &world->contact[k];
    const double *a = y + FST_BEAD_NUMBERS * c->first, *u = look->u[k];
    double v[3] = {a[3], a[4], a[5]}, turning[3] = {0.0, 0.0, 0.0}, swept[3];
    beads_add(turning, world->body[c->first].radius, a + BEADS_W);
    if (c->second >= 0) {
        const double *b = y + FST_BEAD_NUMBERS * c->second;
        beads_add(v, -1.0, b + BEADS_V);
        beads_add(turning, world->body[c->second].radius, b + BEADS_W);
    }
    beads_slip(u, v, turning, look->slip[k]);
    fst_cross_double(u, look->turning[k], swept);
    beads_add(look->drift[k], beads_dot(turning, u), swept);
}

/* Of slips that stop under dry friction: the rate of the time in which they fall for ever (flow.c). */
static double pace_of(const beads_world *world, const beads_modes *modes, const beads_look *look)
{
    double sum = 0.0;
    for (int k = 0; k < world->contacts; ++k)
        if (modes->contact[k] == BEADS_PRESSING && world->contact[k].mu > 0)
            sum += 1.0 / (beads_dot(look->slip[k], look->slip[k]) + 1e-290);
    return sum > 0 ? 1.0 / sqrt(1.0 + USUAL_SLIP * USUAL_SLIP * sum) : 1.0;
}

void beads_look_at(const beads_world *world, const beads_modes *modes, const double *y, beads_look *look)
{
    int closed[BEADS_CONTACTS], count = 0;
    memset(look->force, 0, sizeof look->force);
    memset(look->torque, 0, sizeof look->torque);
    memset(look->power, 0, sizeof look->power);
    look->unique = look->solvable = 1;
    for (int i = 0; i < world->count; ++i)
        if (!modes->gone[i])
            beads_act_on_bead(world, i, y, look->force[i], look->torque[i], look->power);
    for (int k = 0; k < world->contacts; ++k) {
        const beads_contact *c = &world->contact[k];
        look->held[k] = 0.0;
        memset(look->friction[k], 0, sizeof look->friction[k]);
        if (!beads_can_meet(world, modes, k))
            continue;
        const double curve = look_at_contact(world, k, y, look);
        if (c->second >= 0)
            dipoles_act(world, c->first, c->second, y, look->u[k], curve, look);
        if (modes->contact[k] == BEADS_OPEN)
            continue;
        beads_look_at_slip(world, k, y, look);
        closed[count++] = k;
    }
    look->pace = pace_of(world, modes, look);
    if (count)
        beads_hold(world, modes, closed, count, look);
}
