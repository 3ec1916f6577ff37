/* act.c - what acts on one bead without touch, and where two bodies meet.
 *
 *     magnet:  force s G n, torque s n x B; the power of all that changes is -s n.(dB/dt at a place that stands still)
 *     medium:  force -(c_v + c_q |v|) v, torque -c_W W; it moves along as added mass, and bears a part of the weight
 *
 * In a bowl of the radius R_b, rho = R_b - R, the contact is where the bead is farthest from the bowl's centre c:
 * u = (x - c)/|x - c|, gap = rho - |x - c|.
 */
#include "beads/act.h"

#include <math.h>

static void magnet_acts(const beads_world *world, int i, const double *y, double force[3], double torque[3],
                        double *power)
{
    const double *bead = y + FST_BEAD_NUMBERS * i, *n = bead + BEADS_N, s = world->body[i].strength;
    const double x[3] = {bead[0], bead[1], beads_height(world, i, y)};
    double b[3], gn[3], nxb[3], change[3];
    fst_gradient_double g;
    if (world->surrounded)
        fst_surroundings_field(&world->around, beads_time(world, y), x, b, &g, change);
    else
        world->field(world->source, x[0], x[1], x[2], b, &g);
    fst_times_gradient_double(&g, n, gn);
    fst_cross_double(n, b, nxb);
    beads_add(force, s, gn);
    beads_add(torque, s, nxb);
    if (world->surrounded)
        power[BEADS_DRIVE] -= s * beads_dot(n, change);
    else
        power[BEADS_DRIVE] += world->omega * (s * (bead[0] * gn[1] - bead[1] * gn[0] + nxb[2]));
}

static void medium_acts(const beads_body *body, const double *bead, double force[3], double torque[3],
                        double *power)
{
    const double *v = bead + BEADS_V, *w = bead + BEADS_W;
    const double v2 = beads_dot(v, v), drag = body->drag + body->fast_drag * sqrt(v2);
    beads_add(force, -drag, v);
    beads_add(torque, -body->spin_drag, w);
    power[BEADS_MEDIUM] += drag * v2 + body->spin_drag * beads_dot(w, w);
}

void beads_act_on_bead(const beads_world *world, int i, const double *y, double force[3], double torque[3],
                       double *power)
{
    const beads_body *body = &world->body[i];
    const double weighed = body->mass - body->displaced;
    if (world->field || world->surrounded)
        magnet_acts(world, i, y, force, torque, power);
    force[0] += weighed * world->sideways[0];
    force[1] += weighed * world->sideways[1];
    force[2] -= weighed * world->gravity;
    medium_acts(body, y + FST_BEAD_NUMBERS * i, force, torque, power);
}

void beads_meet(const beads_world *world, int i, int j, const double *y, double u[3], double *gap,
                double *curve)
{
    const double *bead = y + FST_BEAD_NUMBERS * i;
    double d[3], reach;
    if (j >= 0) {
        beads_way(world, y, i, j, d);
        reach = world->body[i].radius + world->body[j].radius;
    } else if (world->bowl > 0) {
        reach = world->bowl - world->body[i].radius;
        d[0] = bead[0];
        d[1] = bead[1];
        d[2] = bead[2] - reach;
    } else {
        u[0] = u[1] = 0.0;
        u[2] = -1.0;
        *gap = bead[2];
        *curve = 0.0;
        return;
    }
    const double distance = sqrt(beads_dot(d, d)), sign = j >= 0 ? 1.0 : -1.0;
    for (int m = 0; m < 3; ++m)
        u[m] = d[m] / distance;
    *gap = sign * (distance - reach);
    *curve = sign / distance;
}
