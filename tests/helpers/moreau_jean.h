/* moreau_jean.h - the bead with dry friction by Moreau-Jean time stepping: what an engineer's package does.
 *
 * A step of length h (theta = 1/2): half a step of the place and of n with the old velocities, the magnet's
 * pull there, the impulse of the plate from a cone complementarity problem for the velocities at the step's
 * end, half a step with the new velocities; or, `early`, with the pull at the step's beginning.  No modes and
 * no events: order 1.  The problem is Siconos', with one contact and three dimensions: u = M r + q, where u is
 * the velocity of the contact point at the end (first component: upwards), r the plate's impulse per mass, M =
 * diag(1, 7/2, 7/2), and q the velocity without the plate.  That the load is known, since the plate is flat,
 * and that V decouples from it, Siconos is not told.
 *
 * Only dynamics `rigid`, without resistances.  Of the library it uses the magnet's pull alone; friction and the
 * equations of motion are written out here.
 */
#ifndef FST_TESTS_MOREAU_JEAN_H
#define FST_TESTS_MOREAU_JEAN_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/model.h"

#include <siconos/numerics/Friction_cst.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/SolverOptions.h>
#include <siconos/numerics/fc3d_Solvers.h>

typedef struct moreau_jean {
    const fst_model *model;
    double y[FST_STATE_SIZE]; /* in the axes that turn with the magnet, as everywhere */
    double h, half_cos, half_sin, mu;
    double matrix[9], free_velocity[3], impulse[3], velocity[3];
    NumericsMatrix *delassus;
    FrictionContactProblem problem;
    SolverOptions *options;
    int early;    /* the magnet's pull is that at a step's beginning */
    int failures; /* steps in which Siconos did not reach its tolerance */
} moreau_jean;

/* Ready to step from `start` by h with Siconos' solver `id` (SICONOS_FRICTION_3D_...) at `tolerance`. */
static inline void moreau_jean_begin(moreau_jean *s, const fst_model *model, double mu, const double *start,
                                     double h, int id, double tolerance)
{
    static const moreau_jean nothing;
    *s = nothing;
    s->model = model;
    s->mu = mu;
    memcpy(s->y, start, sizeof s->y);
    s->h = h;
    s->half_cos = cos(0.5 * h * model->world.omega);
    s->half_sin = sin(0.5 * h * model->world.omega);
    s->matrix[0] = 1.0;
    s->matrix[4] = s->matrix[8] = 3.5;
    s->delassus = NM_create_from_data(NM_DENSE, 3, 3, s->matrix);
    s->problem.dimension = 3;
    s->problem.numberOfContacts = 1;
    s->problem.M = s->delassus;
    s->problem.q = s->free_velocity;
    s->problem.mu = &s->mu;
    s->options = solver_options_create(id);
    s->options->dparam[SICONOS_DPARAM_TOL] = tolerance;
}

static inline void moreau_jean_end(moreau_jean *s)
{
    solver_options_delete(s->options);
    free(s->options);
    s->delassus->matrix0 = NULL; /* it is ours */
    NM_clear(s->delassus);
    free(s->delassus);
}

/* The axes turn on for half a step: every vector turns back in them. */
static inline void moreau_jean_turn(moreau_jean *s)
{
    static const int vectors[] = {FST_X, FST_VX, FST_NX, FST_WX};
    for (int i = 0; i < 4; ++i) {
        double *u = s->y + vectors[i];
        const double x = u[0], y = u[1];
        u[0] = s->half_cos * x + s->half_sin * y;
        u[1] = s->half_cos * y - s->half_sin * x;
    }
}

/* The place goes along v, and n turns about W, for the time `during`. */
static inline void moreau_jean_drift(moreau_jean *s, const double v[2], const double w[3], double during)
{
    double *n = s->y + FST_NX, cross[3];
    s->y[FST_X] += during * v[0];
    s->y[FST_Y] += during * v[1];
    const double rate = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]), angle = during * rate;
    if (!(rate > 0.0))
        return;
    const double c = cos(angle), part = sin(angle) / rate;
    const double along = (1.0 - c) * (w[0] * n[0] + w[1] * n[1] + w[2] * n[2]) / (rate * rate);
    fst_cross_double(w, n, cross);
    for (int i = 0; i < 3; ++i)
        n[i] = c * n[i] + part * cross[i] + along * w[i];
}

/* The impulses of a step: the magnet's, by its pull at the present place, and the plate's. */
static inline void moreau_jean_kick(moreau_jean *s)
{
    const fst_world_double *c = &s->model->world;
    const double h = s->h, eps = c->eps, lever = 2.5 / eps;
    double *v = s->y + FST_VX, *w = s->y + FST_WX, twist[3];
    fst_pull_double p;
    fst_pull_at_double(c, s->y, c->height, &p);
    fst_cross_double(s->y + FST_NX, p.b, twist);
    v[0] += h * p.force[0];
    v[1] += h * p.force[1];
    for (int i = 0; i < 3; ++i)
        w[i] += h * 2.5 / (eps * eps) * p.strength * twist[i];
    s->free_velocity[0] = h * (p.force[2] - c->gravity);
    s->free_velocity[1] = v[0] - eps * w[1];
    s->free_velocity[2] = v[1] + eps * w[0];
    if (fc3d_driver(&s->problem, s->impulse, s->velocity, s->options) != 0)
        ++s->failures;
    v[0] += s->impulse[1];
    v[1] += s->impulse[2];
    w[0] += lever * s->impulse[2];
    w[1] -= lever * s->impulse[1];
}

/* The pull is taken in the middle of the step, or, if `early`, at its beginning. */
static inline void moreau_jean_step(moreau_jean *s)
{
    double *v = s->y + FST_VX, *w = s->y + FST_WX;
    if (!s->early) {
        moreau_jean_turn(s);
        moreau_jean_drift(s, v, w, 0.5 * s->h);
        moreau_jean_kick(s);
        moreau_jean_drift(s, v, w, 0.5 * s->h);
        moreau_jean_turn(s);
        return;
    }
    double mean_v[2] = {0.5 * v[0], 0.5 * v[1]}, mean_w[3] = {0.5 * w[0], 0.5 * w[1], 0.5 * w[2]};
    moreau_jean_kick(s);
    for (int i = 0; i < 3; ++i)
        mean_w[i] += 0.5 * w[i];
    for (int i = 0; i < 2; ++i)
        mean_v[i] += 0.5 * v[i];
    moreau_jean_drift(s, mean_v, mean_w, s->h);
    moreau_jean_turn(s);
    moreau_jean_turn(s);
}

/* The mean of r over `turns` whole turns of Phi, between upward passages of X through 0, after `discard` of
 * them; the time integrated goes to `end`.  Passages are interpolated within their step; NAN if t_most is
 * passed. */
static inline double moreau_jean_mean_r(moreau_jean *s, int discard, int turns, double t_most, double *end)
{
    double t = 0.0, integral = 0.0, t_first = 0.0, integral_first = 0.0, r = hypot(s->y[FST_X], s->y[FST_Y]);
    for (int passages = 0; t < t_most; t += s->h) {
        const double x = s->y[FST_X], r_before = r;
        moreau_jean_step(s);
        r = hypot(s->y[FST_X], s->y[FST_Y]);
        const double piece = 0.5 * s->h * (r_before + r);
        if (x < 0.0 && s->y[FST_X] >= 0.0) {
            const double part = x / (x - s->y[FST_X]);
            const double at = part * s->h * (r_before + 0.5 * part * (r - r_before));
            if (++passages == discard) {
                t_first = t + part * s->h;
                integral_first = integral + at;
            } else if (passages == discard + turns) {
                *end = t + s->h;
                return (integral + at - integral_first) / (t + part * s->h - t_first);
            }
        }
        integral += piece;
    }
    *end = t;
    return NAN;
}

#endif
