/* dry_carry.c - a bundle of tangent vectors carried along a motion with dry friction (ode/neighbours.c), for
 * Newton's method and multipliers.
 */
#include "orbit/family.h"

#include <string.h>

#include "base/error.h"
#include "ode/flight.h"
#include "ode/neighbours.h"

_Static_assert((int)FST_COLUMNS <= (int)FST_NEIGHBOURS, "every column has a neighbour");

enum { STEP_WORK = 60 }; /* of a step with its columns, in evaluations of the equations */

/* Why there are no multipliers and no exponents of a motion. */
static fst_status refuse(const fst_flow *flow, fst_error *error)
{
    if (fst_flight_is_on(flow))
        return fst_fail(error, FST_NO_CONVERGENCE, "tangents",
                        "the bead is in the air where a piece of its orbit ends, at t = %.6g", flow->t.high);
    return fst_fail(
        error, FST_NO_CONVERGENCE, "tangents",
        "the plate stops a disc of contact, its slip and its pivoting at once, at t = %.6g, and "
        "neighbours are not followed through that: there are no multipliers and no exponents of this "
        "motion; try a friction.mu_static above friction.mu, contact.patch point, the limit of a small disc, "
        "or "
        "a drive at which the bead goes on pivoting",
        flow->t.high);
}

fst_status fst_dry_step(const fst_setup *setup, struct fst_neighbours *b, fst_flow *flow, double until,
                        fst_error *error)
{
    fst_status status = fst_watch_count(setup->watch, STEP_WORK, error);
    if (status == FST_OK)
        status = fst_flow_step(flow, until, error);
    if (status != FST_OK)
        return status;
    if (!fst_neighbours_known(flow))
        return refuse(flow, error);
    fst_neighbours_follow(b, flow);
    return FST_OK;
}

static fst_status follow(const fst_setup *setup, fst_neighbours *b, fst_flow *flow, double duration,
                         fst_error *error)
{
    const fst_twofold end = {duration, 0.0};
    fst_neighbours_start(b, flow);
    while (fst_twofold_difference(end, flow->t) > 0.0) {
        const fst_status status = fst_dry_step(setup, b, flow, duration, error);
        if (status != FST_OK)
            return status;
        if (setup->sticks && fst_sticks_double(fst_flow_world(flow), fst_flow_modes(flow)) > 0.5)
            *setup->sticks = 1;
    }
    if (fst_flight_is_on(flow))
        return refuse(flow, error);
    fst_neighbours_at_equal_times(b, flow);
    return FST_OK;
}

fst_status fst_dry_carry(const fst_setup *setup, double tolerance, double duration, double y[FST_STATE_SIZE],
                         double tangent[FST_STATE_SIZE][FST_COLUMNS], fst_error *error)
{
    fst_neighbours b = {.count = FST_COLUMNS,
                        .parameter = setup->differs ? FST_COLUMNS - 1 : -1,
                        .exact = setup->exact,
                        .spread = setup->spread,
                        .below = setup->below,
                        .above = setup->above};
    fst_flow *flow;
    fst_flow_options o = fst_default_flow_options();
    o.rtol = tolerance;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = tolerance;
    fst_status status = fst_flow_new(&setup->model, &o, y, &flow, error);
    if (status != FST_OK)
        return fst_watch_end(setup->watch, status, error);
    for (int column = 0; column < FST_COLUMNS; ++column)
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            b.d[column][i] = tangent[i][column];
    status = follow(setup, &b, flow, duration, error);
    memcpy(y, flow->step.end, FST_STATE_SIZE * sizeof *y);
    for (int column = 0; column < FST_COLUMNS; ++column)
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            tangent[i][column] = b.d[column][i];
    fst_flow_free(flow);
    return status;
}
