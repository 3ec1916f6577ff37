/* flow.c - the motion of several beads between and through events.
 *
 * Within a fixed state of contacts the motion is smooth: closed contacts are equalities, whose loads are found
 * at every stage (look.c).  The end of a step is projected onto them (impact.c).  A step in which something
 * happens is made anew with another length until it ends there:
 *
 *     load, share or gap
 *          |  start o---___
 *          |               ---__      end of the first try
 *        0 +-------------------x--___---------o------> h        x: regula falsi on the length of the step
 *
 * Then events.c changes the contacts, and the next step begins.  Repeating the step instead of asking a dense
 * output keeps the full order, and puts the event where the steps themselves have it.
 */
#include "beads/flow.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/bracket.h"
#include "base/error.h"
#include "beads/events.h"
#include "beads/impact.h"

enum { MOST_LOCATING = 100, MOST_CUTS = 60 };
static const double LOCATED = 1e-16, LEAST_CUT = 1e-9;

void beads_derivatives(const beads_world *world, const beads_modes *modes, const beads_look *look,
                       const double *y, double *dy)
{
    double *integral = dy + FST_BEAD_NUMBERS * world->count;
    memcpy(integral, look->power, sizeof look->power);
    for (int i = 0; i < world->count; ++i) {
        const double *bead = y + FST_BEAD_NUMBERS * i, mass = world->body[i].mass;
        const double omega = world->omega, inertia = world->body[i].inertia;
        double *rate = dy + FST_BEAD_NUMBERS * i, accelerated[3], spun[3], turn[3];
        integral[BEADS_R + i] = sqrt(bead[0] * bead[0] + bead[1] * bead[1]);
        integral[BEADS_LOAD + i] = look->held[i];
        if (modes->gone[i]) { /* stays where it is */
            memset(rate, 0, FST_BEAD_NUMBERS * sizeof *rate);
            continue;
        }
        for (int m = 0; m < 3; ++m) {
            accelerated[m] = look->force[i][m] / mass;
            spun[m] = look->torque[i][m] / inertia;
        }
        fst_transport_double(omega, bead, bead + BEADS_V, rate);
        fst_transport_double(omega, bead + BEADS_V, accelerated, rate + BEADS_V);
        fst_transport_double(omega, bead + BEADS_W, spun, rate + BEADS_W);
        fst_turning_seen_double(omega, bead + BEADS_W, turn);
        fst_cross_double(turn, bead + BEADS_N, rate + BEADS_N);
        rate[2] = bead[BEADS_V + 2];
        rate[BEADS_V + 2] = accelerated[2];
        rate[BEADS_W + 2] = spun[2];
    }
}

/* The first stage at step.y. */
static void stand(beads_flow *flow)
{
    beads_look_at(&flow->world, &flow->modes, flow->step.y, &flow->start);
    beads_derivatives(&flow->world, &flow->modes, &flow->start, flow->step.y, flow->step.k[0]);
    ++flow->looks;
}

fst_status beads_begin(beads_flow *flow, const beads_world *world, const double *state, double rtol,
                       fst_error *error)
{
    memset(flow, 0, sizeof *flow);
    flow->world = *world;
    flow->rtol = rtol;
    for (int i = 0; i < BEADS_DIM; ++i)
        flow->atol[i] = rtol;
    for (int i = 0; i < FST_BEADS_MOST; ++i)
        flow->ejected[i] = NAN;
    const int numbers = FST_BEAD_NUMBERS * world->count;
    flow->step.context = (beads_context){&flow->world, &flow->modes, numbers, numbers + BEADS_INTEGRALS};
    flow->step.omega = world->omega;
    memcpy(flow->step.y, state, (size_t)numbers * sizeof *state);
    flow->control = fst_begin_control_double(1e-3, INFINITY);
    const fst_status status = beads_settle(flow, error);
    if (status == FST_OK)
        stand(flow);
    return status;
}

/* A step of the length h, its end projected, and what is there. */
static void make(beads_flow *flow, double h)
{
    flow->step.h = h;
    beads_method_try_step(&flow->step);
    flow->looks += 11;
}

static void finish(beads_flow *flow)
{
    beads_project(&flow->world, &flow->modes, flow->step.end);
    beads_look_at(&flow->world, &flow->modes, flow->step.end, &flow->end);
    beads_derivatives(&flow->world, &flow->modes, &flow->end, flow->step.end, flow->step.k[12]);
    ++flow->looks;
}

/* Find the length at which the least value vanishes: it is positive at 0, and negative at h, where the step now
 * ends.  Regula falsi with the Illinois rule, halving where that is slow.  Returns the length. */
static double locate(beads_flow *flow, double h, double at_start, double at_end, int *which)
{
    fst_bracket z = {0.0, h, at_start, at_end, 0};
    const double close = LOCATED * (1.0 + fabs(flow->t.high));
    for (int i = 0; i < MOST_LOCATING && z.hi - z.lo > close; ++i) {
        const double next = i % 8 == 7 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
        if (!(next > z.lo && next < z.hi))
            break;
        make(flow, next);
        finish(flow);
        const double value = beads_least(flow, &flow->end, flow->step.end, which);
        if (value == 0.0)
            return next;
        fst_bracket_take(&z, next, value);
    }
    make(flow, z.hi);
    finish(flow);
    (void)beads_least(flow, &flow->end, flow->step.end, which);
    return z.hi;
}

static double turned_by(const double *from, const double *to)
{
    return atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
}

/* The end of the step becomes the start of the next. */
static void pass(beads_flow *flow, fst_twofold_double t)
{
    beads_method_step *s = &flow->step;
    for (int i = 0; i < flow->world.count; ++i)
        flow->turned[i] += turned_by(s->y + FST_BEAD_NUMBERS * i, s->end + FST_BEAD_NUMBERS * i);
    for (int k = 0; k < flow->world.contacts; ++k) {
        flow->widest[k] = fmax(flow->widest[k], flow->end.gap[k]);
        if (flow->world.contact[k].second >= 0)
            flow->twisted[k] += turned_by(flow->start.u[k], flow->end.u[k]);
    }
    beads_method_next(s, s->omega);
    flow->start = flow->end;
    flow->t = t;
    ++flow->accepted;
}

static fst_status fail_at(const beads_flow *flow, fst_error *error)
{
    char where[64];
    (void)snprintf(where, sizeof where, "t = %.10g", flow->t.high);
    if (flow->control.worst_error == INFINITY)
        return fst_fail(error, FST_NOT_FINITE, where,
                        "the motion of the beads stopped being finite at %s; try a smaller run.rtol, and check "
                        "the start",
                        where);
    return fst_fail(error, FST_STEP_UNDERFLOW, where,
                    "the step size underflowed at %s (error %.3g times the tolerance at step %.3g); try a "
                    "larger run.rtol",
                    where, flow->control.worst_error, flow->control.size);
}

/* A step whose error is small enough. */
static fst_status make_good(beads_flow *flow, double rest, fst_error *error)
{
    fst_step_control_double *control = &flow->control;
    fst_plan_step_double(control, REAL_EVERYWHERE, rest);
    for (;;) {
        make(flow, control->size);
        const double wrong = beads_method_step_error(&flow->step, flow->rtol, flow->atol);
        const double factor = fst_step_factor_double(wrong);
        if (wrong <= 1.0) {
            fst_accept_step_double(control, REAL_EVERYWHERE, factor, FST_HOLD_AFTER_REJECTION);
            finish(flow);
            return FST_OK;
        }
        ++flow->rejected;
        if (fst_reject_step_double(control, REAL_EVERYWHERE, wrong, factor, flow->t.high) > 0)
            return fail_at(flow, error);
    }
}

/* What happens at step.y, and the first stage after it. */
static fst_status happen(beads_flow *flow, int which, fst_error *error)
{
    const fst_status status = beads_happen(flow, which, error);
    if (status == FST_OK)
        stand(flow);
    return status;
}

fst_status beads_go(beads_flow *flow, double limit, fst_error *error)
{
    const fst_twofold_double way = {limit, 0.0};
    const fst_status status = make_good(flow, fst_twofold_difference_double(way, flow->t), error);
    if (status != FST_OK)
        return status;
    double h = flow->step.h, value;
    int which = -1, was_cut = 0, brushed = 0;
    for (int cuts = 0;; ++cuts) {
        const beads_verdict verdict = beads_judge(flow, &which, &value);
        const int too_short = cuts >= MOST_CUTS || h < LEAST_CUT;
        if (verdict == BEADS_STALE || (verdict == BEADS_SINKS && too_short))
            return happen(flow, which, error);
        if (verdict == BEADS_CROSSES) {
            int unused;
            const double at_start = beads_least(flow, &flow->start, flow->step.y, &unused);
            h = locate(flow, h, at_start, value, &which);
            was_cut = 1;
        }
        if (verdict == BEADS_GOOD || verdict == BEADS_CROSSES || (verdict == BEADS_BRUSHES && brushed))
            break;
        brushed = verdict == BEADS_BRUSHES;
        h *= verdict == BEADS_SINKS ? 0.25 : value;
        was_cut = 1;
        make(flow, h);
        finish(flow);
    }
    pass(flow,
         was_cut ? fst_twofold_add_double(flow->t, h) : fst_step_end_double(&flow->control, flow->t, limit));
    return which >= 0 ? happen(flow, which, error) : FST_OK;
}

fst_status beads_go_to(beads_flow *flow, double limit, fst_error *error)
{
    fst_status status = FST_OK;
    while (status == FST_OK && flow->t.high < limit)
        status = beads_go(flow, limit, error);
    return status;
}

double beads_residual(const beads_flow *flow, double energy_at_start)
{
    const double *integral = flow->step.y + FST_BEAD_NUMBERS * flow->world.count;
    return beads_energy_now(flow) - energy_at_start - integral[BEADS_DRIVE] + integral[BEADS_PLATE] +
           integral[BEADS_PAIR] + flow->impacts + flow->carried;
}
