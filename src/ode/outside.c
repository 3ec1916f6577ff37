/* outside.c - what a caller adds to the motion of one flow: a field, a force, a torque.
 *
 *     magnet's B, G, force ---.
 *                             +--> the bead's strength, force and load ---> friction ---> v', W'
 *     act(): B, G, force -----'                                                            |
 *            torque -----------------------------------------------------------------------'
 *
 * The laws of the contact see the sums, so nothing in the model knows of a caller.  What acts may depend on time:
 * then the step carries its own time as a number of the motion, as it does under laws with modes (bead_step.inl), and
 * every stage knows when it is.
 *
 * A call that failed is not repeated: all stages that follow are NAN, the step is rejected until it is given up, and
 * the failure is told.  A number that is not finite is not a failure yet, because a rejected step may have gone too far.
 */
#include "ode/flow.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/constants.h"
#include "base/error.h"

static int is_finite(const fst_action *a)
{
    double sum = 0.0; /* of products with 0, which are NAN where a number is not finite */
    for (int i = 0; i < 3; ++i) {
        sum += 0.0 * a->field[i] + 0.0 * a->force[i] + 0.0 * a->torque[i];
        for (int j = 0; j < 3; ++j)
            sum += 0.0 * a->gradient[i][j];
    }
    return sum == 0.0;
}

/* What acts at the numbers y of a motion. */
static void ask(fst_outside_state *o, const double *y, fst_action *action)
{
    const fst_twofold t = fst_twofold_add(o->t, y[FST_STEP_TIME]);
    double whole, rest;
    memset(action, 0, sizeof *action);
    if (o->status == FST_OK) {
        fst_drive_turns(&o->drive, t, &whole, &rest);
        o->error = (fst_error){FST_OK, "", ""};
        o->status = o->given.act(o->given.user, t.high, FST_TWO_PI * rest, y, action, &o->error);
        if (o->status != FST_OK && !o->error.sentence[0])
            (void)fst_fail(&o->error, o->status, "fst_outside.act",
                           "the function that acts on the bead ended with status %d (%s) at t = %.10g",
                           (int)o->status, fst_status_text(o->status), t.high);
    }
    if (o->status != FST_OK)
        action->force[0] = NAN;
    else if (!is_finite(action))
        o->not_finite_at = t.high;
}

void fst_outside_pull(const fst_bead_double *bead, const double *y, fst_pull_double *p, double torque[3])
{
    const fst_world_double *c = &bead->world;
    const double z = fst_height_of_double(c, &bead->modes, y), *n = y + FST_NX;
    fst_action action;
    double u[3];
    fst_pull_at_double(c, y, z, p);
    ask(bead->outside, y, &action);
    for (int i = 0; i < 3; ++i)
        p->b[i] += action.field[i];
    p->strength = fst_strength_double(c, n, p->b);
    for (int i = 0; i < 3; ++i)
        u[i] = p->strength * n[i] + c->twice_a * p->b[i];
    if (c->kinds.magnetisable) /* else the field from outside does not change what the magnet's gradient does */
        fst_gradient_along_double(c, y[FST_X], y[FST_Y], z, p, u, p->force);
    for (int i = 0; i < 3; ++i) {
        p->force[i] += action.force[i];
        for (int j = 0; j < 3; ++j)
            p->force[i] += action.gradient[j][i] * u[j]; /* the gradient of u.B */
        torque[i] = action.torque[i];
    }
}

void fst_outside_rhs(const fst_bead_double *bead, double drive, const double *y, double *k, fst_pull_double *p)
{
    double torque[3];
    fst_kinematics_double(drive, y, k);
    fst_outside_pull(bead, y, p, torque);
    fst_dynamics_double(&bead->world, &bead->modes, drive, y, p, k);
    for (int i = 0; i < 3; ++i)
        k[FST_WX + i] += bead->world.torque * torque[i];
    k[FST_STEP_TIME] = 1.0;
    k[FST_HEIGHT] = k[FST_CLIMB] = 0.0;
}

fst_status fst_outside_begin(fst_flow *flow, const fst_outside *given, fst_error *error)
{
    if (!given->act)
        return fst_fail(error, FST_BAD_INPUT, "fst_flow_options.outside", "it has no function act()");
    if (fst_flow_world(flow)->kinds.dry)
        return fst_fail(
            error, FST_BAD_INPUT, "fst_flow_options.outside",
            "a field or a force from outside goes with friction.law viscous or none: contacts that stick "
            "are looked at without it");
    fst_outside_state *o = calloc(1, sizeof *o);
    if (!o)
        return fst_fail(error, FST_NO_MEMORY, "fst_flow_new", "out of memory");
    o->given = *given;
    o->drive = flow->drive;
    o->not_finite_at = NAN;
    flow->step.context.outside = o;
    return FST_OK;
}

fst_status fst_outside_begun(const fst_flow *flow, fst_error *error)
{
    return flow->step.context.outside ? fst_outside_fail(flow, error) : FST_OK;
}

void fst_outside_before_step(fst_flow *flow)
{
    fst_outside_state *o = flow->step.context.outside;
    o->t = flow->t;
    o->drive = flow->drive;
    if (o->must_restart || !isnan(o->not_finite_at)) { /* the first stage may be spoilt */
        if (o->must_restart)
            o->status = FST_OK;
        o->must_restart = 0;
        o->not_finite_at = NAN;
        fst_bead_flow_restart(flow);
    }
}

fst_status fst_outside_fail(const fst_flow *flow, fst_error *error)
{
    fst_outside_state *o = flow->step.context.outside;
    o->must_restart = o->status != FST_OK;
    if (o->status != FST_OK)
        return fst_fail(error, o->status, o->error.where, "%s", o->error.sentence);
    if (isnan(o->not_finite_at))
        return FST_OK;
    return fst_fail(error, FST_NOT_FINITE, "fst_outside.act",
                    "the function that acts on the bead gave a number that is not finite at t = %.10g",
                    o->not_finite_at);
}
