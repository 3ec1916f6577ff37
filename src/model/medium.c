/* medium.c - a medium's drag, buoyancy and added mass on a bead.
 *
 * For a sphere of the radius R and the density rho in a fluid (Stokes 1851; Landau and Lifshitz, Fluid Mechanics, 20):
 *
 *     force  6 pi eta R v                  c_v = (9/2) eta/(rho R^2)
 *     torque 8 pi eta R^3 W                c_W = 6 eta/(beta rho R^2),   beta = I/(m R^2)
 *     force  C_d (rho_f/2) pi R^2 |v| v    c_q = (3/8) C_d rho_f/(rho R)
 *     added mass C_a m rho_f/rho, C_a = 1/2 of ideal flow; weight m g (1 - rho_f/rho)
 */
#include "model/medium.h"

#include "base/constants.h"

/* The number if it is given, else 0. */
static double or_none(double value)
{
    return isnan(value) ? 0.0 : value;
}

fst_medium fst_medium_of(const fst_params *p, const fst_groups *g)
{
    const double radius = g->eps * g->length_unit,
                 density = g->mass / (4.0 / 3.0 * FST_PI * (radius * radius * radius));
    const double ratio = or_none(p->medium_density) / density;
    const double stokes = or_none(p->medium_viscosity) / (density * (radius * radius));
    fst_medium m;
    m.displaced = ratio;
    m.added = p->medium_added_mass * ratio;
    m.drag = isnan(p->medium_drag_rate) ? 4.5 * stokes : p->medium_drag_rate;
    m.spin_drag = isnan(p->medium_spin_drag_rate) ? 6.0 / g->inertia * stokes : p->medium_spin_drag_rate;
    m.fast_drag = isnan(p->medium_quadratic_drag) ? 0.375 * p->medium_drag_coefficient * ratio / radius
                                                  : p->medium_quadratic_drag;
    m.drag *= g->time_unit;
    m.spin_drag *= g->time_unit;
    m.fast_drag *= g->length_unit;
    return m;
}
