/* hold.c - what closed contacts do to their bodies: loads and friction.
 *
 *     contact     load         friction f on the first body, -f on the second       conditions
 *     pressing    x            -c V - mu x V/|V|                                     gap'' = 0
 *     grazing     0            -x c V                                               gap'' = 0
 *     sticking    x            y t1 + z t2, t1 and t2 across u                      gap'' = 0, V' = 0 along t1 and t2
 *     beginning   x            -mu x q                                              gap'' = 0, V' along q
 *
 * Here V is the slip, c the rate of viscous friction, mu the coefficient of dry friction.  All x, y, z of all contacts
 * follow together from linear conditions on the accelerations:
 *
 *     acceleration of tie r without them + sum over s of coupling_rs x_s = 0
 *
 * Dry friction of a slip makes the matrix of couplings unsymmetric, because a load then pushes along -u - mu V/|V|.
 *
 * A slip that begins has no direction of its own yet: it goes where it is pushed, so that V' is along the direction q
 * against which friction acts.  With k mu x q taken from V', k being what a force does to V' at its own contact,
 *
 *     q is along V' + k mu x q
 *
 * which is sought from the direction of the force that the contact would need to stick.  A contact that no other one
 * feels has it at once.
 */
#include "beads/hold.h"

#include <math.h>
#include <string.h>

#include "beads/linear.h"

enum { MOST_ROUNDS = 60 };
static const double FOUND = 1e-14, NEARLY = 1e-9;   /* error of a direction: it is found, or as good as that */
static const double STEEPEST = 100.0, WIDEST = 0.5; /* of the steps to it */

static void add(double to[3], double factor, const double v[3])
{
    for (int m = 0; m < 3; ++m)
        to[m] += factor * v[m];
}

/* ------------------------------------------------------------------ ties */

int beads_tie_contact(const beads_look *look, int k, int sticks, beads_tie *ties)
{
    const double *u = look->u[k];
    double axis[3] = {0.0, 0.0, 0.0};
    ties[0].contact = k;
    for (int m = 0; m < 3; ++m)
        ties[0].along[m] = ties[0].push[m] = -u[m];
    if (!sticks)
        return 1;
    const int least = fabs(u[0]) <= fabs(u[1]) && fabs(u[0]) <= fabs(u[2]) ? 0
                      : fabs(u[1]) <= fabs(u[2])                           ? 1
                                                                           : 2;
    axis[least] = 1.0;
    ties[1].contact = ties[2].contact = k;
    fst_cross_double(u, axis, ties[1].along);
    const double size = sqrt(beads_dot(ties[1].along, ties[1].along));
    for (int m = 0; m < 3; ++m)
        ties[1].along[m] /= size;
    fst_cross_double(u, ties[1].along, ties[2].along);
    memcpy(ties[1].push, ties[1].along, sizeof ties[1].push);
    memcpy(ties[2].push, ties[2].along, sizeof ties[2].push);
    return 3;
}

static int body_of(const beads_contact *c, int side)
{
    return side ? c->second : c->first;
}

double beads_coupling(const beads_world *world, const beads_look *look, const beads_tie *of,
                      const beads_tie *by)
{
    const beads_contact *p = &world->contact[of->contact], *q = &world->contact[by->contact];
    double pushed = 0.0, turned = 0.0, about_of[3], about_by[3];
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b)
            if (body_of(p, a) >= 0 && body_of(p, a) == body_of(q, b)) {
                const beads_body *body = &world->body[body_of(p, a)];
                pushed += a == b ? p->inertia_of[a] : -p->inertia_of[a];
                turned += body->radius * body->radius / body->inertia;
            }
    if (turned == 0.0)
        return 0.0;
    fst_cross_double(look->u[of->contact], of->along, about_of);
    fst_cross_double(look->u[by->contact], by->push, about_by);
    return pushed * beads_dot(of->along, by->push) + turned * beads_dot(about_of, about_by);
}

void beads_couple(const beads_world *world, const beads_look *look, const beads_tie *ties, int count,
                  double *matrix)
{
    for (int r = 0; r < count; ++r)
        for (int s = 0; s < count; ++s)
            matrix[r * count + s] = beads_coupling(world, look, &ties[r], &ties[s]);
}

/* The acceleration of a tie under the forces found so far. */
static double change_of(const beads_world *world, const beads_look *look, const beads_tie *tie)
{
    const beads_contact *c = &world->contact[tie->contact];
    double about[3], sum = beads_dot(tie->along, look->drift[tie->contact]);
    fst_cross_double(look->u[tie->contact], tie->along, about);
    for (int side = 0; side < 2; ++side) {
        const int i = body_of(c, side);
        if (i < 0)
            continue;
        const beads_body *body = &world->body[i];
        const double pushed = c->inertia_of[side] * beads_dot(tie->along, look->force[i]);
        sum += (side ? -pushed : pushed) + body->radius / body->inertia * beads_dot(about, look->torque[i]);
    }
    return sum;
}

double beads_bend_of_gap(const beads_world *world, const beads_look *look, int contact)
{
    beads_tie tie;
    (void)beads_tie_contact(look, contact, 0, &tie);
    return change_of(world, look, &tie);
}

void beads_slip_change(const beads_world *world, const beads_look *look, int k, double change[3])
{
    beads_tie ties[3];
    memset(change, 0, 3 * sizeof *change);
    (void)beads_tie_contact(look, k, 1, ties);
    for (int i = 1; i < 3; ++i)
        add(change, change_of(world, look, &ties[i]), ties[i].along);
}

/* ------------------------------------------------------------------ forces */

static void push(const beads_world *world, int k, const double force[3], beads_look *look)
{
    const beads_contact *c = &world->contact[k];
    add(look->force[c->first], 1.0, force);
    if (c->second >= 0)
        add(look->force[c->second], -1.0, force);
}

/* The friction f on the first body. */
static void rub(const beads_world *world, int k, const double f[3], beads_look *look)
{
    const beads_contact *c = &world->contact[k];
    double turning[3];
    push(world, k, f, look);
    fst_cross_double(look->u[k], f, turning);
    add(look->torque[c->first], world->body[c->first].radius, turning);
    if (c->second >= 0)
        add(look->torque[c->second], world->body[c->second].radius, turning);
    add(look->friction[k], 1.0, f);
    look->power[c->second < 0 ? BEADS_PLATE : BEADS_PAIR] -= beads_dot(f, look->slip[k]);
}

/* The friction that does not depend on the load. */
static void rub_wet(const beads_world *world, int k, double share, beads_look *look)
{
    double f[3];
    for (int m = 0; m < 3; ++m)
        f[m] = -share * world->contact[k].friction * look->slip[k][m];
    rub(world, k, f, look);
}

/* What a contact's load pushes along. */
static void lean_push(const beads_world *world, int mode, const beads_look *look, beads_tie *tie)
{
    const int k = tie->contact;
    const beads_contact *c = &world->contact[k];
    for (int m = 0; m < 3; ++m) {
        if (mode == BEADS_GRAZING)
            tie->push[m] = -c->friction * look->slip[k][m];
        else if (mode != BEADS_STICKING)
            tie->push[m] -= c->mu * look->way[k][m];
    }
}

/* Apply what the ties of a contact hold. */
static void take(const beads_world *world, int mode, const beads_tie *ties, const double *x, beads_look *look)
{
    const int k = ties[0].contact;
    double load[3] = {0.0, 0.0, 0.0}, f[3] = {0.0, 0.0, 0.0};
    look->held[k] = x[0];
    if (mode == BEADS_GRAZING) {
        rub_wet(world, k, x[0], look);
        return;
    }
    add(load, -x[0], look->u[k]);
    push(world, k, load, look);
    if (mode == BEADS_STICKING) {
        add(f, x[1], ties[1].along);
        add(f, x[2], ties[2].along);
    } else {
        add(f, -world->contact[k].mu * x[0], look->way[k]);
    }
    if (world->contact[k].mu > 0)
        rub(world, k, f, look);
}

/* The ties of all closed contacts.  Returns how many; `begins`: where those of each begin. */
static int tie_all(const beads_world *world, const unsigned char *mode_of, const int *closed, int count,
                   const beads_look *look, beads_tie *ties, int *begins)
{
    int n = 0;
    ties[0].contact = -1; /* where nothing is closed */
    for (int s = 0; s < count; ++s) {
        const int mode = mode_of[closed[s]];
        begins[s] = n;
        n += beads_tie_contact(look, closed[s], mode == BEADS_STICKING, &ties[n]);
        lean_push(world, mode, look, &ties[begins[s]]);
    }
    return n;
}

/* Whether every force is along its condition. */
static int is_symmetric(const beads_world *world, const unsigned char *mode_of, const int *closed, int count)
{
    int symmetric = 1;
    for (int s = 0; s < count; ++s) {
        const int mode = mode_of[closed[s]];
        symmetric = symmetric && mode != BEADS_GRAZING &&
                    (mode == BEADS_STICKING || !(world->contact[closed[s]].mu > 0));
    }
    return symmetric;
}

/* Find what the closed contacts hold, and apply it; `mode_of` are their modes as they are taken. */
static void solve(const beads_world *world, const unsigned char *mode_of, const int *closed, int count,
                  beads_look *look)
{
    beads_tie ties[BEADS_TIES];
    double matrix[BEADS_TIES * BEADS_TIES], x[BEADS_TIES];
    int begins[BEADS_CONTACTS];
    const int n = tie_all(world, mode_of, closed, count, look, ties, begins);
    for (int r = 0; r < n; ++r)
        x[r] = -change_of(world, look, &ties[r]);
    beads_couple(world, look, ties, n, matrix);
    look->solvable = is_symmetric(world, mode_of, closed, count)
                         ? beads_solve_symmetric(n, matrix, x, &look->unique)
                         : beads_solve_any(n, matrix, x, &look->unique);
    for (int s = 0; s < count && look->solvable; ++s)
        take(world, mode_of[closed[s]], &ties[begins[s]], &x[begins[s]], look);
}

/* ------------------------------------------------------------------ where a slip that begins goes */

/* The direction of v as `way`. */
static void turn_to(const double v[3], double way[3])
{
    const double size = sqrt(beads_dot(v, v));
    for (int m = 0; m < 3 && size > 0; ++m)
        way[m] = v[m] / size;
}

/* What a force does to the slip of its own contact. */
static double yielding(const beads_world *world, int k)
{
    const beads_contact *c = &world->contact[k];
    double sum = 0.0;
    for (int side = 0; side < 2; ++side)
        if (body_of(c, side) >= 0) {
            const beads_body *body = &world->body[body_of(c, side)];
            sum += c->inertia_of[side] + body->radius * body->radius / body->inertia;
        }
    return sum;
}

/* What is known of a direction that is sought: the last error of its angle about u, and by how much it was turned. */
typedef struct sought {
    double error, turned;
} sought;

/* Turn the direction of contact k towards that of the push v.  Returns by how much it was wrong.  Where friction of
 * others stiffens the contact, the error tells too little of the way: the secant's slope mends that. */
static double turn_towards(const double v[3], int k, sought *of, beads_look *look)
{
    double *way = look->way[k], side[3];
    fst_cross_double(look->u[k], way, side);
    const double error = atan2(beads_dot(v, side), beads_dot(v, way));
    const double slope = of->turned / (of->error - error),
                 factor = slope >= 1.0 && slope < STEEPEST ? slope : 1.0;
    const double angle = fmax(-WIDEST, fmin(factor * error, WIDEST)), c = cos(angle), s = sin(angle);
    for (int m = 0; m < 3; ++m)
        way[m] = c * way[m] + s * side[m];
    *of = (sought){error, angle};
    return fabs(error);
}

/* Find the directions in which slips begin, from that in which they go, if they go already, or would need to be held. */
static void find_ways(const beads_world *world, const beads_modes *modes, const int *closed, int count,
                      beads_look *look)
{
    unsigned char first[BEADS_CONTACTS];
    sought of[BEADS_CONTACTS];
    double wrong = 1.0;
    memcpy(first, modes->contact, sizeof first);
    for (int s = 0; s < count; ++s) {
        const int k = closed[s];
        of[k] = (sought){0.0, 0.0};
        if (modes->contact[k] != BEADS_BEGINNING)
            continue;
        if (beads_dot(look->slip[k], look->slip[k]) > world->still * world->free_at)
            turn_to(look->slip[k], look->way[k]);
        else
            first[k] = BEADS_STICKING;
    }
    for (int round = 0; round < MOST_ROUNDS && wrong > FOUND; ++round) {
        beads_look trial = *look;
        solve(world, round ? modes->contact : first, closed, count, &trial);
        if (!trial.solvable)
            break;
        wrong = 0.0;
        for (int s = 0; s < count; ++s) {
            const int k = closed[s];
            double v[3];
            if (modes->contact[k] != BEADS_BEGINNING)
                continue;
            beads_slip_change(world, &trial, k, v);
            add(v, -yielding(world, k), trial.friction[k]);
            if (round || first[k] == BEADS_BEGINNING) {
                wrong = fmax(wrong, turn_towards(v, k, &of[k], look));
            } else {
                turn_to(v, look->way[k]);
                wrong = 1.0;
            }
        }
    }
    look->solvable = wrong < NEARLY;
}

void beads_hold(const beads_world *world, const beads_modes *modes, const int *closed, int count,
                beads_look *look)
{
    int begins = 0;
    for (int s = 0; s < count; ++s) {
        const int k = closed[s], mode = modes->contact[k];
        memset(look->way[k], 0, sizeof look->way[k]);
        begins = begins || mode == BEADS_BEGINNING;
        if (mode == BEADS_STICKING)
            memset(look->slip[k], 0, sizeof look->slip[k]);
        if (mode != BEADS_PRESSING)
            continue;
        if (world->contact[k].mu > 0)
            turn_to(look->slip[k], look->way[k]);
        rub_wet(world, k, 1.0, look);
    }
    if (begins)
        find_ways(world, modes, closed, count, look);
    if (look->solvable)
        solve(world, modes->contact, closed, count, look);
}
