/* disc.c - a contact that is a disc (model/contact/patch.inl) comes to rest and lets go.
 *
 * While such a bead slips or pivots its friction is smooth, if stiff: it creeps where a point would stick. Only
 * a bead that neither slips nor pivots, V = 0 and w = W.e = 0, is held, as long as the force f and the torque m
 * that this takes lie within the curve of what friction can give, (mu N tau(nu), mu N a m(nu)):
 *
 *      m/a ^
 *          |--...
 *          |     `-.     x (f, m/a) out here: the bead lets go
 *          |        `.
 *          |  held    \
 *          |           |
 *          +-----------+---> f
 *         0            mu N
 *
 * w passes zero often, and then the rate at which a creep settles, k (3 pi/8) mu N/(a |w|), would be
 * infinite for a moment.  The floor under |w| (patch.inl) bounds it.  A passage, which takes the time
 * slow/|w'|, then is off by a slow^2/|w'| in the place, which is nothing, and w is off by less than `slow`
 * where the bead comes to rest or lets go.  So `slow` follows the tolerance.
 *
 * It lets go in the only consistent way, with the nu of the place on the curve and against (f, m).
 */
#include "model/disc.h"

static const double RELEASED = 2.0; /* how fast a contact moves that was released, in a times the floor */
static const double SLOW = 1e3;     /* the floor under |w|, in tolerances; */
static const double LEAST_SLOW = 1e-9, GREATEST_SLOW = 1e-5;
static const double CREEP = 10.0; /* how fast a contact may creep that is to be held, in a times the floor */

double fst_disc_slow_2(double rtol)
{
    const double slow = fmin(fmax(SLOW * rtol, LEAST_SLOW), GREATEST_SLOW);
    return slow * slow;
}

/* The contact of a bead that is held: its push, and the torque that holds it. */
static fst_contact_double held_contact(const fst_world_double *c, const fst_modes_double *m,
                                       const double *state, const fst_pull_double *p)
{
    fst_modes_double held = *m;
    held.contact = FST_MODE_STICK;
    return fst_contact_of_double(c, &held, state, p);
}

/* What friction of the coefficient mu could give at the contact beyond what it must: the distances from the
 * origin along the way to (f, m/a).  *slip and *pivot, of which one may be 0, are in the proportion nu of the
 * curve's place there. */
static double left_over(const fst_world_double *c, const fst_contact_double *at, double mu, double *slip,
                        double *pivot)
{
    const fst_patch_double *patch = &c->law.coulomb.patch;
    const double load = fst_coulomb_load_double(at), a = fst_patch_radius_double(patch, load);
    const double force = c->share * fst_norm_2_double(at->push);
    const double torque = fabs(at->torque[2]) / a;
    double lo = 0.0, hi = 1.0, tau = 1.0, m = 0.0;
    for (int i = 0; i < 60; ++i) {
        const double x = 0.5 * (lo + hi);
        const fst_shares_double shares = fst_hertz_shares_double(x, 1.0 - x);
        tau = x * shares.grip;
        m = shares.twist;
        if (force * m > torque * tau)
            lo = x;
        else
            hi = x;
    }
    *slip = lo;
    *pivot = 1.0 - lo;
    return mu * load * sqrt(tau * tau + m * m) - sqrt(force * force + torque * torque);
}

double fst_disc_hold(const fst_world_double *c, const fst_modes_double *m, const double *state,
                     const fst_pull_double *p)
{
    double slip, pivot;
    const fst_contact_double at = held_contact(c, m, state, p);
    return left_over(c, &at, c->law.coulomb.holding, &slip, &pivot);
}

/* The curve is that of (tau, m) where tau slip + m pivot is greatest, for every slip and pivot (both are derivatives
 * of one potential): across (slip, pivot) its place does not change. */
double fst_disc_hold_change(const fst_world_double *c, const fst_contact_double *at,
                            const fst_contact_double *by)
{
    const fst_coulomb_double *law = &c->law.coulomb;
    const double load = fst_coulomb_load_double(at), a = fst_patch_radius_double(&law->patch, load);
    const double da = fst_patch_radius_by_load_double(&law->patch, load, a) * by->load;
    const double *push = at->push, torque = at->torque[2];
    double slip, pivot;
    (void)left_over(c, at, law->holding, &slip, &pivot);
    const fst_shares_double shares = fst_hertz_shares_double(slip, pivot);
    const double tau = slip * shares.grip, m = shares.twist, across = tau * slip + m * pivot;
    const double dforce =
        c->share * (push[0] * by->push[0] + push[1] * by->push[1]) / (fst_norm_2_double(push) + 1e-290);
    const double dtorque = ((torque < 0 ? -by->torque[2] : by->torque[2]) - fabs(torque) * da / a) / a;
    return (law->holding * by->load * across - dforce * slip - dtorque * pivot) * sqrt(tau * tau + m * m) /
           across;
}

int fst_disc_rests(const fst_world_double *c, const fst_modes_double *m, const double *state,
                   const fst_pull_double *p)
{
    const fst_coulomb_double *law = &c->law.coulomb;
    const fst_contact_double at = held_contact(c, m, state, p);
    const double s2 = at.slip[0] * at.slip[0] + at.slip[1] * at.slip[1], w2 = at.pivot * at.pivot;
    const double a = CREEP * law->patch.radius;
    double slip, pivot;
    return w2 <= m->slow_2 && s2 <= a * a * m->slow_2 &&
           left_over(c, &at, fst_coulomb_mu_double(law, 0.0), &slip, &pivot) > 0;
}

void fst_disc_release(const fst_world_double *c, const fst_modes_double *m, const double *state,
                      const fst_pull_double *p, double velocity[2], double *pivot)
{
    const fst_coulomb_double *law = &c->law.coulomb;
    const fst_contact_double at = held_contact(c, m, state, p);
    double slip, turn;
    const double a = fst_patch_radius_double(&law->patch, fst_coulomb_load_double(&at));
    (void)left_over(c, &at, law->holding, &slip, &turn);
    const double size = RELEASED * a * sqrt(m->slow_2) / sqrt(slip * slip + turn * turn);
    const double push = fst_norm_2_double(at.push) + 1e-290;
    for (int i = 0; i < 2; ++i)
        velocity[i] = size * slip * (at.push[i] / push);
    *pivot = (at.torque[2] > 0 ? -size : size) * turn / a;
}
