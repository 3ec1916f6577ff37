/* pace.c - steps that measure their own time: how long one takes, and how good it is.
 *
 * Under a law with modes the steps of a slip are measured in theta, with dt = pace dtheta (contact.c tells
 * why). theta has no meaning outside a step.  The time that passes in a step is the integral of the pace, taken
 * like all integrals along the trajectory (path.inl), with a dense output of its own.  A step that would pass
 * the end of the way is made anew, so short that it lands there.
 *
 * Errors.  While |V| falls over many orders of magnitude, a tolerance on v and W would stop seeing V long
 * before the end.  So a step must also keep some digits of V itself, however small it is.  Where the plate
 * resists rolling the same holds for W_h.
 */
#include "ode/flight.h"

#include "base/bracket.h"

int fst_contact_mode(const fst_flow *flow)
{
    return (int)flow->step.context.coefficients.law.coulomb.mode;
}

int fst_contact_roll(const fst_flow *flow)
{
    return (int)flow->step.context.coefficients.resistance.mode;
}

/* Whether the last step measured a time of its own. */
static int has_pace(const fst_flow *flow)
{
    return fst_measures_time_double(&flow->step.context.coefficients);
}

/* ------------------------------------------------------------------ errors */

double fst_bead_error(const fst_bead_step_double *s, double rtol, const double *atol)
{
    const double error = fst_bead_step_error_double(s, rtol, atol);
    const fst_coefficients_double *c = &s->context.coefficients;
    if (fst_is_in_flight_double(c))
        return fmax(error, fst_flight_error(s, rtol));
    return c->kinds.paced ? fst_paced_error_double(s, error) : error;
}

/* ------------------------------------------------------------------ time within a step */

/* The time that the last step took. */
double fst_contact_elapsed(const fst_flow *flow)
{
    return fst_paced_time_double(&flow->step);
}

static void make_clock(fst_flow *flow)
{
    if (flow->contact.has_clock)
        return;
    const fst_bead_step_double *s = &flow->step;
    fst_bead_flow_form_dense(flow);
    double pace[FST_DENSE_PLACES];
    for (int place = 0; place < FST_DENSE_PLACES; ++place)
        pace[place] = FST_PATH_PACE(s, place);
    const double whole = fst_contact_elapsed(flow);
    fst_path_dense_double(s, 1, &whole, pace, pace + FST_PATH_PLACES, flow->contact.clock);
    flow->contact.has_clock = 1;
}

double fst_contact_time(fst_flow *flow, double x)
{
    if (!has_pace(flow))
        return x * flow->step.h;
    double time;
    make_clock(flow);
    fst_bead_evaluate_dense_double(1, flow->contact.clock, 1, x, &time);
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
