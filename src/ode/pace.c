/* pace.c - steps that measure their own time: how long one takes, and how good it is.
 *
 * Under a law with modes the steps of a slip are measured in theta, with dt = pace dtheta (automaton.inl says
 * why). theta has no meaning outside a step.  The time that passes in a step is one of its numbers.  A step
 * that would pass the end of the way is made anew, so short that it lands there.
 *
 * Errors.  While |V| falls over many orders of magnitude, a tolerance on v and W would stop seeing V long
 * before the end.  So a step must also keep some digits of V itself, however small it is.  Where the plate
 * resists rolling the same holds for W_h.
 */
#include "ode/flight.h"

#include "base/bracket.h"

/* Whether the last step measured a time of its own. */
static int has_pace(const fst_flow *flow)
{
    return fst_flow_world(flow)->kinds.modes && fst_measures_time_double(&flow->step);
}

/* ------------------------------------------------------------------ errors */

double fst_bead_error(const fst_bead_step_double *s, double rtol, const double *atol)
{
    const double error = fst_lasting_error_double(s, rtol, fst_bead_step_error_double(s, rtol, atol));
    if (fst_in_flight_double(FST_MODES(s)))
        return fmax(error, fst_flight_error(s, rtol));
    return FST_WORLD(s)->kinds.modes ? fst_paced_error_double(s, error) : error;
}

/* ------------------------------------------------------------------ time within a step */

/* The time that the last step took. */
double fst_contact_elapsed(const fst_flow *flow)
{
    return has_pace(flow) ? flow->step.end[FST_STEP_TIME] : flow->step.h;
}

double fst_contact_time(fst_flow *flow, double x)
{
    double time;
    if (!has_pace(flow))
        return x * flow->step.h;
    fst_flow_components_at(flow, x, FST_STEP_TIME, 1, &time);
    return time;
}

double fst_contact_fraction(fst_flow *flow, double since_start)
{
    const double whole = fst_contact_elapsed(flow);
    if (!has_pace(flow) || !(since_start > 0 && since_start < whole))
        return since_start / whole;
    fst_bracket z = {0.0, 1.0, -since_start, whole - since_start, 0};
    for (int i = 0; i < 100 && z.hi - z.lo > 1e-16; ++i) {
        const double x = i % 8 == 7 ? 0.5 * (z.lo + z.hi) : fst_bracket_next(&z);
        if (x == z.lo || x == z.hi)
            break;
        const double late = fst_contact_time(flow, x) - since_start;
        if (late == 0)
            return x;
        fst_bracket_take(&z, x, late);
    }
    return fabs(z.f_lo) < fabs(z.f_hi) ? z.lo : z.hi;
}

double fst_flow_fraction(fst_flow *flow, fst_twofold t)
{
    if (fst_flow_world(flow)->kinds.modes && fst_twofold_difference(t, flow->t) == 0.0)
        return 1.0; /* a step that landed did so just there */
    return fst_contact_fraction(flow, fst_twofold_difference(t, flow->t_start));
}

fst_twofold fst_flow_time(fst_flow *flow, double x)
{
    return x == 1.0 ? flow->t : fst_twofold_add(flow->t_start, fst_contact_time(flow, x));
}
