/* flow.h - the motion of several beads, step by step. */
#ifndef FST_BEADS_FLOW_H
#define FST_BEADS_FLOW_H

#include "beads/look.h"

#include "ode/dop853_tableau.h"
#include "ode/step_control.inl"

typedef struct beads_context {
    const beads_world *world;
    const beads_modes *modes;
    int judged, count; /* numbers that judge the error; all of them */
} beads_context;

/* The derivatives in the turning frame, of a look at y. */
void beads_derivatives(const beads_world *world, const beads_modes *modes, const beads_look *look,
                       const double *y, double *dy);

static inline void beads_rhs(const beads_context *context, double omega, const double *y, double *dy)
{
    beads_look look;
    (void)omega; /* is the world's */
    beads_look_at(context->world, context->modes, y, &look);
    beads_derivatives(context->world, context->modes, &look, y, dy);
}

/* The method's own body, of as many numbers as there are beads. */
#define STEP_DIM BEADS_DIM
#define STEP_FEWER (s->context.count)
#define STEP_TAKES_ALL(s) 0
#define STEP_JUDGED (s->context.judged)
#define STEP_CONTEXT beads_context
#define STEP_NAME(name) beads_method_##name
#define STEP_RHS(context, drive, y, dy) beads_rhs(context, drive, y, dy)
#include "ode/dop853.inl"

typedef struct beads_flow {
    beads_world world;
    beads_modes modes;
    beads_method_step step; /* from step.y to step.end; between steps, at step.y */
    fst_step_control_double control;
    double rtol, atol[BEADS_DIM];
    fst_twofold_double t;
    int paced;   /* steps are measured in theta (flow.c) */
    double rest; /* of the way, at the start of the step */
    fst_beads_paradox paradox;
    beads_look start, end;          /* at step.y and, after a tried step, at step.end */
    double impacts;                 /* energy that impacts took */
    double carried;                 /* energy of beads that are gone, with that between them and the others */
    double ejected[FST_BEADS_MOST]; /* when, or NAN */
    double turned[FST_BEADS_MOST];  /* angle of each bead about the axis, in the turning frame, unwrapped */
    int64_t counts[FST_BEAD_EVENTS];
    fst_bead_event events[FST_BEADS_EVENTS];
    int event_count;
    double grazes_since[BEADS_CONTACTS];
    double crowded_at; /* the time at which events crowd, and how many there were */
    int crowd;
    uint64_t looks, accepted, rejected;
    int dense;          /* each step that passes leaves its dense output, */
    beads_modes during; /* and the modes that it had */
} beads_flow;

/* Begin at the state (12 numbers a bead), whose contacts are those with gaps below BEADS_TOUCH.  The world is
 * copied; the flow must not be moved. FST_NO_CONVERGENCE: no contact state is consistent. */
fst_status beads_begin(beads_flow *flow, const beads_world *world, const double *state, double rtol,
                       fst_error *error);

/* One step towards the time `limit`, or less where an event ends it; the state is then flow->step.y. */
fst_status beads_go(beads_flow *flow, double limit, fst_error *error);

/* Go on to the time `limit`. */
fst_status beads_go_to(beads_flow *flow, double limit, fst_error *error);

/* The energy now, less what was there and has come and gone by the integrals: 0 but for errors. */
static inline double beads_energy_now(const beads_flow *flow)
{
    return beads_energy(&flow->world, flow->modes.gone, flow->step.y);
}

/* The work that was done since, or the energy if that is greater. */
double beads_work(const beads_flow *flow, double energy_at_start);

double beads_residual(const beads_flow *flow, double energy_at_start);

#endif
