/* flight.c - a bead that leaves the plate, flies, and comes down again.
 *
 * Where the magnet's pull no longer presses the bead onto the plate, N = 0, and impact.restitution is given,
 * the bead flies.  It then has a height z over the plate and a speed of climb z', no friction, and the field of
 * its own height:
 *
 *     z'' = F_z - g,      f = 0
 *
 *     z ^        ..--..
 *       |     .-'      `-.        .--.
 *       |   .'            `.    .'    `.  .-.
 *     --+--o----------------o--o--------o-o--o----> t
 *        N = 0          impacts                contact again
 *
 * A step has the state's ten numbers.  Height and climb are the flight's own: bead_step.inl carries them
 * through the stages of a step with the method's weights, so that they are as exact as the rest.
 *
 * Impact.  The plate returns the part e_n of the speed with which the bead comes down, by an impulse p_n = (1 +
 * e_n)|z'|, and rubs with the impulse p_t = min(mu p_n, (2/7)|V|) against the slip V, which stays along its
 * line: V -> V (1 - (7/2) p_t/|V|).  (An impact is taken as one at a point, whatever the contact's patch is: it
 * does not change W.e.)
 *
 * Hops become ever shorter, infinitely many within a finite time.  So the bead stays down when it would bounce
 * with less than a tolerance of speed and the load is positive.
 */
#include "ode/flight.h"

#include "base/bracket.h"

static const double LIFT = 1e-12;        /* how far the load may fall below 0 before a bead flies, in weights */
static const double LEAST_BOUNCE = 1.0;  /* speed of a bead that bounces, in tolerances, */
static const double LEAST_CLIMB = 1e-14; /* which no tolerance makes smaller */

int fst_flight_allowed(const fst_flow *flow)
{
    return flow->step.context.coefficients.kinds.flies;
}

int fst_flight_is_on(const fst_flow *flow)
{
    return fst_is_in_flight_double(&flow->step.context.coefficients);
}

void fst_flight_begin(fst_flow *flow, double climb)
{
    flow->step.context.flight.start[0] = 0.0;
    flow->step.context.flight.start[1] = climb;
}

void fst_flight_go_on(fst_flow *flow)
{
    fst_flight_double *flight = &flow->step.context.flight;
    const int end = FST_PATH_STAGE_[FST_PATH_END];
    flight->start[0] = flight->height[end];
    flight->start[1] = flight->climb[end];
}

double fst_flight_load(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    (void)state;
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    return fst_load_double(c, p->force) + LIFT * (c->gravity + c->hard);
}

int fst_flight_impact(fst_flow *flow, double *state)
{
    fst_coefficients_double *c = &flow->step.context.coefficients;
    fst_flight_double *flight = &flow->step.context.flight;
    const double falls = fmax(-flight->climb[FST_PATH_STAGE_[FST_PATH_END]], 0.0);
    const double bounces = c->law.coulomb.restitution * falls, normal = falls + bounces;
    fst_raise_source_double(&flow->step.context, 0.0);
    c->law.coulomb.mode = FST_MODE_SLIP;
    fst_pull_double p;
    fst_magnetic_pull_double(c, state, &p);
    const fst_contact_double at = fst_contact_of_double(c, state, &p);
    const double s2 = at.slip[0] * at.slip[0] + at.slip[1] * at.slip[1], s = sqrt(s2);
    const double tangential = fmin(fst_coulomb_mu_double(&c->law.coulomb, s2) * normal, 2.0 / 7.0 * s);
    const double left = s > 0 ? 1.0 - 3.5 * tangential / s : 0.0;
    fst_set_slip_double(c, state, (const double[2]){left * at.slip[0], left * at.slip[1]});
    flow->contact.impacts += 1;
    flow->contact.impulse += normal;
    flow->contact.impact_loss +=
        0.5 * (falls * falls - bounces * bounces) + 0.5 * tangential * s * (1.0 + left);
    const double load = fst_load_double(c, p.force);
    if (bounces <= fmax(LEAST_BOUNCE * flow->rtol, LEAST_CLIMB) && load > 0) {
        flow->contact.impact_loss += 0.5 * bounces * bounces;
        flow->contact.impulse -= bounces;
        return 1;
    }
    c->law.coulomb.mode = FST_MODE_FLIGHT;
    fst_flight_begin(flow, bounces);
    /* A short hop lasts 2 z'/N: the first step is hardly longer. */
    flow->contact.proposal[FST_MODE_FLIGHT][FST_ROLL_ROLLS] =
        load > 0 ? fmin(2.5 * bounces / load, flow->control.proposal) : flow->control.proposal;
    return 0;
}

/* ------------------------------------------------------------------ within a step */

/* What z or z' has gained at the fraction x, by its derivative at the stages. */
static double gained(fst_flow *flow, const double *slope, double x)
{
    const fst_bead_step_double *s = &flow->step;
    double values[FST_DENSE_PLACES], coefficients[8], gain;
    fst_bead_flow_form_dense(flow);
    for (int place = 0; place < FST_DENSE_PLACES; ++place)
        values[place] = slope[FST_PATH_STAGE_[place]];
    const double whole = fst_path_integral_double(s, values, 1);
    fst_path_dense_double(s, 1, &whole, values, values + FST_PATH_PLACES, coefficients);
    fst_bead_evaluate_dense_double(1, coefficients, 1, x, &gain);
    return gain;
}

void fst_flight_at(fst_flow *flow, double x, double *height, double *climb)
{
    fst_flight_double *flight = &flow->step.context.flight;
    *height = flight->start[0] + gained(flow, flight->climb, x);
    *climb = flight->start[1] + gained(flow, flight->lift, x);
}

static double height_at(fst_flow *flow, double x)
{
    double height, climb;
    if (x == 1.0)
        return flow->step.context.flight.height[FST_PATH_STAGE_[FST_PATH_END]];
    fst_flight_at(flow, x, &height, &climb);
    return height;
}

/* The fraction in [lo, hi] at which the bead, over the plate at lo and under it at hi, comes down. */
static double locate_landing(fst_flow *flow, double lo, double hi)
{
    fst_bracket b = {lo, hi, height_at(flow, lo), height_at(flow, hi), 0};
    for (int k = 0; k < 100 && b.hi - b.lo > 1e-14; ++k) {
        const double middle = k % 8 == 7 ? 0.5 * (b.lo + b.hi) : fst_bracket_next(&b);
        if (middle == b.lo || middle == b.hi)
            break;
        fst_bracket_take(&b, middle, height_at(flow, middle));
    }
    return b.lo;
}

int fst_flight_lands(fst_flow *flow, double *x)
{
    enum { PIECES = 16 };
    const double least = 1e-15;
    for (int i = 1; i <= PIECES; ++i) {
        const double at = (double)i / PIECES;
        if (height_at(flow, at) >= 0)
            continue;
        /* A bead that has just left the plate is over it for some time, however short a hop that is. */
        double over = i > 1 ? (double)(i - 1) / PIECES : 0.5 * at, under = at;
        while (over > least && height_at(flow, over) < 0) {
            under = over;
            over *= 0.5;
        }
        *x = over > least ? locate_landing(flow, over, under) : under;
        return 1;
    }
    return 0;
}

double fst_flight_missing(const fst_flow *flow)
{
    const fst_flight_double *flight = &flow->step.context.flight;
    const int end = FST_PATH_STAGE_[FST_PATH_END];
    return flight->climb[end] < 0 ? -flight->height[end] / flight->climb[end] : 0.0;
}

double fst_flight_error(const fst_bead_step_double *s, double rtol)
{
    static const int slot[8] = {0, 5, 6, 7, 8, 9, 10, 11};
    static const double fifth[8] = {DOP_E5_1, DOP_E5_6,  DOP_E5_7,  DOP_E5_8,
                                    DOP_E5_9, DOP_E5_10, DOP_E5_11, DOP_E5_12};
    const fst_flight_double *flight = &s->context.flight;
    double height = 0.0, climb = 0.0;
    for (int j = 0; j < 8; ++j) {
        height += s->h * fifth[j] * flight->climb[slot[j]];
        climb += s->h * fifth[j] * flight->lift[slot[j]];
    }
    return fmax(fabs(height), fabs(climb)) / rtol;
}

double fst_flight_energy(fst_flow *flow, double x)
{
    double height, climb;
    if (!fst_flight_is_on(flow))
        return 0.0;
    fst_flight_at(flow, x, &height, &climb);
    fst_raise_source_double(&flow->step.context, height);
    return 0.5 * climb * climb + flow->step.context.coefficients.gravity * height;
}
