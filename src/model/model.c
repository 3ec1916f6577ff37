/* model.c - from parameters in SI to the scaled model, and the model's public face. */
#include "model/modes.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/elementary.h"
#include "base/error.h"
#include "model/params.h"
#include "model/worlds.h"

#include "model/tangent.inl"

static void set_strength(const fst_params *p, fst_groups *g)
{
    g->kappa = fst_kappa_and_field(p, &g->field_unit);
    if (p->bead_material == FST_MATERIAL_PARAMAGNETIC)
        g->kappa = 0.0;
    g->a = p->bead_material == FST_MATERIAL_HARD ? 0.0 : p->bead_a;
    g->b = p->bead_material == FST_MATERIAL_MIXED ? p->bead_b : 0.0;
}

double fst_bead_height(const fst_params *p)
{
    return isnan(p->model_h) ? (p->magnet_depth + p->bead_radius) / p->magnet_half_length : p->model_h;
}

static void set_geometry(const fst_params *p, fst_groups *g)
{
    const double l = p->magnet_half_length;
    g->length_unit = l;
    g->eps = isnan(p->model_eps) ? p->bead_radius / l : p->model_eps;
    g->inertia = p->bead_inertia;
    g->h = fst_bead_height(p);
    g->lines = p->magnet_lines;
    g->lambda = isnan(p->model_lambda) ? p->magnet_width / ((p->magnet_lines - 1) * l) : p->model_lambda;
    if (p->magnet_lines == 1)
        g->lambda = 0.0;
}

/* The distance from the axis, in l, over which the field of a magnet of parts varies at a height: as far as the
 * magnet reaches, and no less than the height; l of any other magnet. */
static double magnet_reach(const fst_params *p, double height)
{
    double reach = height * p->magnet_half_length;
    if (p->magnet_shape != FST_MAGNET_PARTS)
        return 1.0;
    for (int i = 0; i < p->magnet_part_count; ++i) {
        const fst_part_shape seen = fst_part_seen(&p->magnet_parts[i]);
        reach = fmax(reach, hypot(p->magnet_parts[i].centre[0], p->magnet_parts[i].centre[1]));
        for (int k = 0; k < seen.count; ++k)
            reach = fmax(reach, hypot(seen.corners[k][0], seen.corners[k][1]));
    }
    return reach / p->magnet_half_length;
}

/* What the magnet's image lacks at a place, and the strength there.  Both only grow. */
static void compare_with_image(const fst_world_double *c, double x, double y, double *most, double *strongest)
{
    const double u[3] = {0.0};
    double here[3], there[3], unused[3];
    fst_field_along_double(c, x, y, c->height, u, here, unused);
    fst_field_along_double(c, -x, -y, c->height, u, there, unused);
    *strongest = fmax(*strongest, fabs(here[0]) + fabs(here[1]) + fabs(here[2]));
    for (int k = 0; k < 3; ++k)
        *most = fmax(*most, fabs(there[k] - (k == 2 ? -here[k] : here[k])));
}

/* Whether the field has the symmetry S2, which is asked of the field itself, at places that no other symmetry
 * maps onto each other, from the middle of the magnet to its surroundings (all within 1.7 scale), and beside
 * each part, where a small one is felt that the rest hides from afar.  Where the whole field is weak beside
 * that of other places, rounding decides: a difference counts against the strongest field that was seen. */
static int field_has_s2(const fst_params *p, const fst_world_double *c, const fst_groups *g)
{
    static const double places[][2] = {{0.31, 0.17}, {0.83, -0.59}, {-0.44, 1.07}, {1.63, 0.26}};
    enum { PLACES = sizeof places / sizeof *places };
    const double scale = fmin(magnet_reach(p, g->h), g->map_radius / 1.7), l = g->length_unit;
    double strongest = 0.0, most = 0.0;
    for (int i = 0; i < PLACES; ++i)
        compare_with_image(c, scale * places[i][0], scale * places[i][1], &most, &strongest);
    for (int i = 0; i < p->magnet_part_count && p->magnet_shape == FST_MAGNET_PARTS; ++i) {
        const double *centre = p->magnet_parts[i].centre, above = fabs(g->h - centre[2] / l);
        compare_with_image(c, centre[0] / l + places[0][0] * above, centre[1] / l + places[0][1] * above, &most,
                           &strongest);
    }
    return most <= 1e-9 * strongest;
}

/* A measured field is known on the plane of the map, and in the disc about the axis that the map covers: there
 * the plate ends. */
static fst_status use_map(const fst_params *p, fst_groups *g, fst_error *error)
{
    if (!p->magnet_map && !p->magnet_file[0])
        return fst_fail(error, FST_BAD_INPUT, "magnet.file",
                        "magnet.shape: grid needs the map of the field: give magnet.file");
    if (!p->magnet_map)
        return fst_fail(error, FST_BAD_INPUT, "magnet.file", "the map %s has not been read", p->magnet_file);
    const double height = g->h * g->length_unit;
    if (!fst_map_plane_at(p->magnet_map, height))
        return fst_fail(error, FST_BAD_INPUT, "magnet.file",
                        "the bead's centre moves %.7g mm over the magnet's reference plane, but the map was "
                        "taken at %.7g mm: take one there, or change magnet.depth",
                        1e3 * height, 1e3 * fst_map_nearest_height(p->magnet_map, height));
    if (!isnan(p->impact_restitution) && p->friction_law == FST_FRICTION_COULOMB)
        return fst_fail(error, FST_BAD_INPUT, "impact.restitution",
                        "a bead that flies needs the field above the plate, and the map has one plane: leave "
                        "impact.restitution out");
    g->map_radius = fst_field_map_describe(p->magnet_map).radius / g->length_unit;
    g->plate_radius = fmin(g->plate_radius, g->map_radius);
    return FST_OK;
}

/* The same without the parts that stand still: surroundings.c has those. */
static fst_params turning_parts(const fst_params *params)
{
    fst_params turning = *params;
    turning.magnet_part_count = 0;
    for (int i = 0; i < params->magnet_part_count; ++i)
        if (params->magnet_parts[i].motion == FST_PART_TURNING)
            turning.magnet_parts[turning.magnet_part_count++] = params->magnet_parts[i];
    return turning;
}

static fst_status make_model(const fst_params *params, double height, fst_model *made, fst_error *error)
{
    fst_groups g;
    memset(&g, 0, sizeof g);
    const double gamma = params->friction_gamma;
    set_geometry(params, &g);
    set_strength(params, &g);
    if (!isnan(height))
        g.h = height;
    g.omega = isnan(params->drive_omega) ? FST_TWO_PI * params->drive_frequency / gamma : params->drive_omega;
    g.gravity = params->plate_gravity / (g.length_unit * (gamma * gamma));
    g.plate_radius = params->plate_radius / g.length_unit;
    g.map_radius = INFINITY;
    g.shape = (fst_magnet_shape)params->magnet_shape;
    g.material = (fst_material)params->bead_material;
    g.friction = (fst_friction_law)params->friction_law;
    g.dynamics = (fst_dynamics)params->model_dynamics;
    g.time_unit = 1.0 / gamma;
    g.mass = fst_bead_mass(params);
    if (!isfinite(g.kappa) || !isfinite(g.omega) || !isfinite(g.h) || (isnan(height) && g.h <= 0))
        return fst_fail(error, FST_BAD_INPUT, "fst_model_new",
                        "the scaled groups are out of range: kappa = %g, omega = %g, h = %g", g.kappa, g.omega,
                        g.h);
    const fst_status status = g.shape == FST_MAGNET_GRID ? use_map(params, &g, error) : FST_OK;
    if (status != FST_OK)
        return status;
    made->groups = g;
    const fst_params turning = turning_parts(params);
    made->world = fst_make_world_double(&turning, &g);
    made->params = *params;
    made->has_s2 = field_has_s2(params, &made->world, &g);
    made->bowl = 0.0;
    made->surroundings = NULL;
    made->field_time = NAN;
    made->map = g.shape == FST_MAGNET_GRID ? fst_field_map_share(params->magnet_map) : NULL;
    return FST_OK;
}

fst_status fst_model_fill(const fst_params *params, double height, fst_model *model, fst_error *error)
{
    fst_params settled = *params;
    const fst_status status = fst_params_validate(&settled, error);
    return status == FST_OK ? make_model(&settled, height, model, error) : status;
}

fst_groups fst_model_groups(const fst_model *model)
{
    return model->groups;
}

void fst_slip(const fst_model *model, const double state[FST_STATE_SIZE], double slip[2])
{
    fst_slip_double(&model->world, state, slip);
}

void fst_rhs(const fst_model *model, const double state[FST_STATE_SIZE], double derivative[FST_STATE_SIZE])
{
    const fst_world_double *c = &model->world;
    const fst_motion_double motion = fst_motion_at(c, state, model->params.run_rtol);
    fst_pull_double p;
    fst_rhs_double(c, &motion.modes, c->omega, motion.numbers, derivative, &p);
}

void fst_jacobian(const fst_model *model, const double state[FST_STATE_SIZE],
                  double jacobian[FST_STATE_SIZE][FST_STATE_SIZE], double by_omega[FST_STATE_SIZE])
{
    const fst_world_double *c = &model->world;
    const fst_motion_double motion = fst_motion_at(c, state, model->params.run_rtol);
    fst_jacobian_double(c, &motion.modes, c->omega, motion.numbers, jacobian);
    if (by_omega)
        fst_rhs_by_omega_double(state, by_omega);
}

fst_observation fst_observe_motion(const fst_world_double *c, const fst_motion_double *motion, double omega)
{
    const fst_modes_double *m = &motion->modes;
    fst_pull_double p;
    fst_seen_double o;
    fst_magnetic_pull_double(c, m, motion->numbers, &p);
    fst_see_double(c, m, omega, motion->numbers, &p, &o);
    fst_observation out;
    memset(&out, 0, sizeof out);
    out.r = o.r;
    out.cos_bead_angle = o.cos_bead_angle;
    out.sin_bead_angle = o.sin_bead_angle;
    memcpy(out.n, o.n, sizeof o.n);
    memcpy(out.b, o.b, sizeof o.b);
    out.b_norm = o.b_norm;
    out.angle = fst_angle_of_gap(o.gap2);
    out.slip[0] = o.slip_r;
    out.slip[1] = o.slip_alpha;
    out.slip_norm = sqrt(o.slip2);
    out.spin = o.spin;
    out.load = o.load;
    out.energy = fst_energy_double(c, m, motion->numbers, &p);
    out.friction_power = o.friction_power;
    out.drive_power = o.drive_power;
    out.sticks = o.sticking > 0.5;
    double force[2];
    const fst_contact_double contact = fst_contact_of_double(c, m, motion->numbers, &p);
    fst_friction_double(&c->law, &c->kinds, &contact, force);
    out.friction = fst_norm_2_double(force);
    const double most = c->holding * contact.load;
    out.friction_use = most > 0 ? out.friction / most : 0.0;
    return out;
}

double fst_angle_of_gap(double gap2)
{
    const double half = 0.5 * sqrt(gap2);
    return 2.0 * fst_asin(half < 1.0 ? half : 1.0);
}

fst_observation fst_observe(const fst_model *model, const double state[FST_STATE_SIZE])
{
    const fst_world_double *c = &model->world;
    const fst_motion_double motion = fst_motion_at(c, state, model->params.run_rtol);
    return fst_observe_motion(c, &motion, c->omega);
}

void fst_apply_s2(const double state[FST_STATE_SIZE], double image[FST_STATE_SIZE])
{
    static const double sign[FST_STATE_SIZE] = {-1, -1, -1, -1, 1, 1, -1, -1, -1, 1};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        image[i] = sign[i] * state[i];
}
