/* bead.c - the bead's mass and magnetic moment, as given, or from density and remanence.
 */
#include <math.h>

#include "base/constants.h"
#include "model/forms.h"
#include "model/kinds.h"
#include "model/params.h"

/* The remanence in T of a bead beside a real magnet of which nothing is said: neodymium, as sold. */
static const double USUAL_REMANENCE = 1.2;

/* R in m: of a scaled bead it follows from model.eps, R/l. */
static double radius_of(const fst_params *p)
{
    return isnan(p->model_eps) ? p->bead_radius : p->model_eps * p->magnet_half_length;
}

static double volume_of(const fst_params *p)
{
    const double radius = radius_of(p);
    return 4.0 / 3.0 * FST_PI * (radius * radius * radius);
}

double fst_bead_mass(const fst_params *params)
{
    fst_params room;
    const fst_params *p = fst_params_settled(params, &room);
    return isnan(p->bead_density) ? p->bead_mass : p->bead_density * volume_of(p);
}

double fst_moment_unit(const fst_params *p)
{
    const int physical = fst_magnet_in_tesla(p) || !isnan(p->bead_density) || !isnan(p->bead_remanence);
    const double radius = physical ? radius_of(p) : p->bead_radius;
    return fst_bead_mass(p) * (radius * radius) * (p->friction_gamma * p->friction_gamma);
}

double fst_given_moment(const fst_params *p)
{
    double remanence = p->bead_remanence;
    if (!isnan(p->bead_moment))
        return p->bead_moment;
    if (isnan(remanence) && fst_magnet_in_tesla(p) && !fst_kappa_given(p))
        remanence = USUAL_REMANENCE;
    return volume_of(p) * remanence / FST_MU_0;
}

double fst_field_unit(const fst_params *p)
{
    return isnan(p->magnet_b0) && fst_magnet_in_tesla(p) ? FST_PARTS_FIELD_UNIT : p->magnet_b0;
}

double fst_kappa_and_field(const fst_params *params, double *field)
{
    fst_params room;
    const fst_params *p = fst_params_settled(params, &room);
    const double unit = fst_moment_unit(p), moment = fst_given_moment(p);
    *field = fst_field_unit(p);
    if (!isnan(moment) && !isnan(*field))
        return moment * *field / unit;
    if (!isnan(moment) && moment > 0)
        *field = p->model_kappa * unit / moment;
    return p->model_kappa;
}

double fst_field_scale(const fst_params *params)
{
    double field;
    (void)fst_kappa_and_field(params, &field);
    return field;
}

double fst_bead_moment(const fst_params *params)
{
    fst_params room;
    const fst_params *p = fst_params_settled(params, &room);
    const double given = fst_given_moment(p);
    if (p->bead_material == FST_MATERIAL_PARAMAGNETIC)
        return 0.0;
    return isnan(given) ? p->model_kappa * fst_moment_unit(p) / fst_field_unit(p) : given;
}
