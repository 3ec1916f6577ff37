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
 * Height and climb are numbers of the motion like others (bead_step.inl), and the field is that of its height.
 *
 * Impact.  The plate returns the part e_n of the speed with which the bead comes down, by an impulse p_n = (1 +
 * e_n)|z'|, and rubs with the impulse p_t = min(mu p_n, |V|/k) against the slip V, which stays along its
 * line: V -> V (1 - k p_t/|V|).  (An impact is taken as one at a point, whatever the contact's patch is: it
 * does not change W.e.)
 *
 * Hops become ever shorter, infinitely many within a finite time.  So the bead stays down when it would bounce
 * with less than a tolerance of speed and the load is positive.
 */
#include "ode/flight.h"

#include "base/bracket.h"

static const double LEAST_BOUNCE = 1.0;  /* speed of a bead that bounces, in tolerances, */
static const double LEAST_CLIMB = 1e-14; /* which no tolerance makes smaller */

void fst_flight_begin(double *state, double climb)
{
    state[FST_HEIGHT] = 0.0;
    state[FST_CLIMB] = climb;
}

double fst_impact_leaves(const fst_world_double *c, double s2, double normal, double *impulse)
{
    const double s = sqrt(s2);
    *impulse = fmin(fst_coulomb_mu_double(&c->law.coulomb, s2) * normal, c->share * s);
    return s > 0 ? 1.0 - c->yielding * *impulse / s : 0.0;
}

int fst_flight_impact(fst_flow *flow, double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_modes_double *m = &flow->step.context.modes;
    const double falls = fmax(-state[FST_CLIMB], 0.0);
    const double bounces = c->law.coulomb.restitution * falls, normal = falls + bounces;
    fst_pull_double p;
    m->contact = FST_MODE_SLIP;
    fst_flight_begin(state, 0.0);
    fst_magnetic_pull_double(c, m, state, &p);
    const fst_contact_double at = fst_contact_of_double(c, m, state, &p);
    const double s2 = at.slip[0] * at.slip[0] + at.slip[1] * at.slip[1], s = sqrt(s2);
    double tangential;
    const double left = fst_impact_leaves(c, s2, normal, &tangential);
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
    m->contact = FST_MODE_FLIGHT;
    fst_flight_begin(state, bounces);
    /* A short hop lasts 2 z'/N: the first step is hardly longer. */
    flow->contact.proposal[FST_MODE_FLIGHT][FST_ROLL_ROLLS] =
        load > 0 ? fmin(2.5 * bounces / load, flow->control.proposal) : flow->control.proposal;
    return 0;
}

/* ------------------------------------------------------------------ within a step */

static double height_at(fst_flow *flow, double x)
{
    double height;
    if (x == 1.0)
        return flow->step.end[FST_HEIGHT];
    fst_flow_components_at(flow, x, FST_HEIGHT, 1, &height);
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
    const double *end = flow->step.end;
    return end[FST_CLIMB] < 0 ? -end[FST_HEIGHT] / end[FST_CLIMB] : 0.0;
}

double fst_flight_error(const fst_bead_step_double *s, double rtol)
{
    static const int slot[8] = {0, 5, 6, 7, 8, 9, 10, 11};
    static const double fifth[8] = {DOP_E5_1, DOP_E5_6,  DOP_E5_7,  DOP_E5_8,
                                    DOP_E5_9, DOP_E5_10, DOP_E5_11, DOP_E5_12};
    double error[2] = {0.0, 0.0};
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 8; ++j)
            error[i] += s->h * fifth[j] * s->k[slot[j]][FST_HEIGHT + i];
    return fmax(fabs(error[0]), fabs(error[1])) / rtol;
}
