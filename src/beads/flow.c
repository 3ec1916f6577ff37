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
 *
 * Dry friction stops a slip s in a finite time, while its direction turns ever faster, which no method of high order
 * follows.  While a contact slips so, steps are measured in a time theta with
 *
 *     dt/dtheta = (1 + s_r^2 (1/s_1^2 + 1/s_2^2 + ...))^(-1/2)
 *
 * in which slips fall for ever, and smoothly; the single bead's way (ode/automaton.inl).  The time is then one of the
 * numbers of the step, and the end of the way an event.  A slip is over where nothing feels the rest (world->still).
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
static const double FIRST_PACED = 0.05;                      /* first step after the measure of time changed */
static const double LEAST_DIGITS = 0.03;                     /* relative error of a slip that a step may make */
static const double CAPTURED = 1e-3, LEAST_CAPTURED = 1e-13; /* world->still, in tolerances, and at least */

void beads_derivatives(const beads_world *world, const beads_modes *modes, const beads_look *look,
                       const double *y, double *dy)
{
    double *integral = dy + FST_BEAD_NUMBERS * world->count;
    memcpy(integral, look->power, sizeof look->power);
    const double omega =
        world->surrounded ? fst_frame_rate(&world->around, beads_time(world, y)) : world->omega;
    for (int i = 0; i < world->count; ++i) {
        const double *bead = y + FST_BEAD_NUMBERS * i, mass = beads_moved_mass(&world->body[i]);
        const double inertia = world->body[i].inertia;
        double *rate = dy + FST_BEAD_NUMBERS * i, accelerated[3], spun[3], turn[3];
        integral[BEADS_R + i] = sqrt(bead[0] * bead[0] + bead[1] * bead[1]);
        integral[BEADS_LOAD + i] = isnan(world->plate) ? 0.0 : beads_load(modes, look, i);
        integral[BEADS_HEIGHT + i] = bead[2];
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
    integral[BEADS_TIME] = 1.0;
    for (int i = 0; look->pace != 1.0 && i < FST_BEAD_NUMBERS * world->count + BEADS_INTEGRALS; ++i)
        dy[i] *= look->pace;
}

/* The first stage at step.y. */
static void stand(beads_flow *flow)
{
    beads_look_at(&flow->world, &flow->modes, flow->step.y, &flow->start);
    beads_derivatives(&flow->world, &flow->modes, &flow->start, flow->step.y, flow->step.k[0]);
    ++flow->looks;
    const int paced = flow->start.pace != 1.0;
    if (paced != flow->paced)
        flow->control.proposal = FIRST_PACED;
    flow->paced = paced;
}

fst_status beads_begin(beads_flow *flow, const beads_world *world, const double *state, double rtol,
                       fst_error *error)
{
    memset(flow, 0, sizeof *flow);
    flow->world = *world;
    flow->rtol = rtol;
    flow->paradox.time = NAN;
    flow->world.still = fmax(CAPTURED * rtol, LEAST_CAPTURED);
    flow->world.free_at = sqrt(rtol);
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
    if (beads_is_near_enough(flow, *which, at_end))
        return h;
    for (int i = 0; i < MOST_LOCATING && z.hi - z.lo > close; ++i) {
        const double next = i % 8 == 7 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
        if (!(next > z.lo && next < z.hi))
            break;
        make(flow, next);
        finish(flow);
        const double value = beads_least(flow, &flow->end, flow->step.end, which);
        if (value == 0.0 || beads_is_near_enough(flow, *which, value))
            return next;
        fst_bracket_take(&z, next, value);
    }
    make(flow, z.hi);
    finish(flow);
    (void)beads_least(flow, &flow->end, flow->step.end, which);
    return z.hi;
}

/* The end of the step becomes the start of the next. */
static void pass(beads_flow *flow, fst_twofold_double t)
{
    beads_method_step *s = &flow->step;
    for (int i = 0; i < flow->world.count; ++i)
        flow->turned[i] += beads_turned_by(s->y + FST_BEAD_NUMBERS * i, s->end + FST_BEAD_NUMBERS * i);
    if (flow->dense) {
        beads_method_make_dense(s);
        flow->during = flow->modes;
    }
    beads_method_next(s, s->omega);
    s->y[FST_BEAD_NUMBERS * flow->world.count + BEADS_TIME] = 0.0;
    flow->world.now = t.high;
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

/* The error of slips in the step, over what a step may make. */
static double wrong_of_slips(const beads_flow *flow)
{
    static const int slot[8] = {0, 5, 6, 7, 8, 9, 10, 11};
    static const double fifth[8] = {DOP_E5_1, DOP_E5_6,  DOP_E5_7,  DOP_E5_8,
                                    DOP_E5_9, DOP_E5_10, DOP_E5_11, DOP_E5_12};
    const beads_method_step *s = &flow->step;
    double error[BEADS_NUMBERS] = {0.0}, worst = 0.0;
    beads_look look;
    if (!flow->paced)
        return 0.0;
    for (int i = 0; i < FST_BEAD_NUMBERS * flow->world.count; ++i)
        for (int j = 0; j < 8; ++j)
            error[i] += s->h * fifth[j] * s->k[slot[j]][i];
    beads_look_at_gaps(&flow->world, &flow->modes, s->end, &look);
    for (int k = 0; k < flow->world.contacts; ++k) {
        if (flow->modes.contact[k] != BEADS_PRESSING || !(flow->world.contact[k].mu > 0))
            continue;
        beads_look_at_slip(&flow->world, k, s->end, &look);
        const double least =
            fmin(beads_dot(flow->start.slip[k], flow->start.slip[k]), beads_dot(look.slip[k], look.slip[k]));
        beads_look_at_slip(&flow->world, k, error, &look);
        worst = fmax(worst, beads_dot(look.slip[k], look.slip[k]) / least);
    }
    return sqrt(worst) / LEAST_DIGITS;
}

/* A step whose error is small enough. */
static fst_status make_good(beads_flow *flow, double rest, fst_error *error)
{
    fst_step_control_double *control = &flow->control;
    fst_plan_step_double(control, REAL_EVERYWHERE, rest);
    for (;;) {
        make(flow, control->size);
        const double wrong =
            fmax(beads_method_step_error(&flow->step, flow->rtol, flow->atol), wrong_of_slips(flow));
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

/* Make the step that was good shorter where something happens within it.  Returns its length; *which: what happens at
 * its end, or -1; *was_cut: it ends where it was not meant to; *stale: it happens at the start. */
static double cut(beads_flow *flow, int *which, int *was_cut, int *stale)
{
    double h = flow->step.h, value;
    int brushed = 0;
    *was_cut = *stale = 0;
    for (int cuts = 0;; ++cuts) {
        const beads_verdict verdict = beads_judge(flow, which, &value);
        const int too_short = cuts >= MOST_CUTS || h < LEAST_CUT;
        *stale = verdict == BEADS_STALE || (verdict == BEADS_SINKS && too_short);
        if (*stale || verdict == BEADS_GOOD || (verdict == BEADS_BRUSHES && brushed))
            return h;
        *was_cut = 1;
        if (verdict == BEADS_CROSSES) {
            int unused;
            const double at_start = beads_least(flow, &flow->start, flow->step.y, &unused);
            return locate(flow, h, at_start, value, which);
        }
        brushed = verdict == BEADS_BRUSHES;
        h *= verdict == BEADS_SINKS ? 0.25 : value;
        make(flow, h);
        finish(flow);
    }
}

/* The time at the end of the step. */
static fst_twofold_double time_at_end(const beads_flow *flow, double h, int which, int was_cut, double limit)
{
    const fst_twofold_double end = {limit, 0.0};
    if (which == BEADS_LIMIT)
        return end;
    if (flow->paced)
        return fst_twofold_add_double(flow->t,
                                      flow->step.end[FST_BEAD_NUMBERS * flow->world.count + BEADS_TIME]);
    return was_cut ? fst_twofold_add_double(flow->t, h) : fst_step_end_double(&flow->control, flow->t, limit);
}

fst_status beads_go(beads_flow *flow, double limit, fst_error *error)
{
    fst_waveform *drive = &flow->world.around.drive;
    if (flow->world.surrounded) {
        if (fst_waveform_enter(drive, flow->t.high))
            stand(flow);
        limit = fmin(limit, fst_waveform_jump(drive));
    }
    const fst_twofold_double way = {limit, 0.0};
    flow->rest = fst_twofold_difference_double(way, flow->t);
    const fst_status status = make_good(flow, flow->paced ? INFINITY : flow->rest, error);
    if (status != FST_OK)
        return status;
    int which = -1, was_cut, stale;
    const double h = cut(flow, &which, &was_cut, &stale);
    if (stale)
        return happen(flow, which, error);
    pass(flow, time_at_end(flow, h, which, was_cut, limit));
    return which >= 0 && which != BEADS_LIMIT ? happen(flow, which, error) : FST_OK;
}

fst_status beads_go_to(beads_flow *flow, double limit, fst_error *error)
{
    fst_status status = FST_OK;
    while (status == FST_OK && flow->t.high < limit)
        status = beads_go(flow, limit, error);
    return status;
}

double beads_work(const beads_flow *flow, double energy_at_start)
{
    const double *integral = flow->step.y + FST_BEAD_NUMBERS * flow->world.count;
    const double work = fmax(fabs(integral[BEADS_DRIVE]), integral[BEADS_PLATE] + integral[BEADS_PAIR] +
                                                              integral[BEADS_MEDIUM] + flow->impacts);
    return fmax(work, fabs(energy_at_start));
}

double beads_residual(const beads_flow *flow, double energy_at_start)
{
    const double *integral = flow->step.y + FST_BEAD_NUMBERS * flow->world.count;
    return beads_energy_now(flow) - energy_at_start - integral[BEADS_DRIVE] + integral[BEADS_PLATE] +
           integral[BEADS_PAIR] + integral[BEADS_MEDIUM] + flow->impacts + flow->carried;
}
