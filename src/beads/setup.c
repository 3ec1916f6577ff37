/* setup.c - from parameters to a world of several beads, and what several beads cannot be.
 *
 * Masses are in that of the first bead.  The moments of beads are as their magnetic strengths in the magnet's
 * field, for both are the same moment: chi is told, or follows from the moment, of the first alone.
 */
#include "beads/setup.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/elementary.h"
#include "base/error.h"
#include "model/medium.h"
#include "model/params.h"
#include "model/start.h"
#include "model/worlds.h"

static const double BOUNCE_LEAST = 1e-4, OVERLAP = 1e-9, USUAL_REMANENCE = 1.2;
/* Over the radius of the bowl, or of the bead: a start that is told with so few digits is one on the surface. */
static const double FEW_DIGITS = 1e-6;

/* ------------------------------------------------------------------ what cannot be */

static int is_of_bead(const char *key)
{
    return strncmp(key, "bead.", 5) == 0 || strncmp(key, "start.", 6) == 0;
}

/* A bead's own radius takes the place of model.eps, and its own moment that of model.kappa. */
static int follows_bead(const char *key)
{
    return strcmp(key, "model.eps") == 0 || strcmp(key, "model.h") == 0 || strcmp(key, "model.kappa") == 0;
}

static fst_status check_same(const fst_params *beads, int count, fst_error *error)
{
    char first[FST_PARAM_TEXT_SIZE], other[FST_PARAM_TEXT_SIZE];
    for (int bead = 1; bead < count; ++bead)
        for (int i = 0; i < fst_params_row_count(&beads[0]); ++i) {
            const char *key = fst_param_at(i)->key;
            (void)fst_params_get(&beads[0], i, first, sizeof first);
            (void)fst_params_get(&beads[bead], i, other, sizeof other);
            if (!is_of_bead(key) && !follows_bead(key) && strcmp(first, other) != 0)
                return fst_fail(
                    error, FST_BAD_INPUT, key,
                    "%s differs between bead 1 and bead %d: beads of one plate may differ in bead.* "
                    "and start.* alone",
                    key, bead + 1);
        }
    return FST_OK;
}

static fst_status check_kinds(const fst_params *p, int bead, fst_error *error)
{
    if (p->plate_shape == FST_PLATE_BOWL && p->run_method == FST_BEADS_STEPPING)
        return fst_fail(error, FST_BAD_INPUT, "plate.shape",
                        "time stepping knows flat plates alone: choose run.method exact for a bowl");
    if (fst_key_of_surroundings(p) && p->run_method == FST_BEADS_STEPPING)
        return fst_fail(error, FST_BAD_INPUT, fst_key_of_surroundings(p),
                        "time stepping knows a magnet that turns steadily over a level plate alone: "
                        "choose run.method exact for %s",
                        fst_key_of_surroundings(p));
    if (p->friction_law == FST_FRICTION_ROLLING)
        return fst_fail(error, FST_BAD_INPUT, "friction.law",
                        "several beads, or one in a world, slide as well as roll: friction.law must be "
                        "viscous, coulomb or none");
    if (p->model_dynamics != FST_DYNAMICS_RIGID)
        return fst_fail(
            error, FST_BAD_INPUT, "model.dynamics",
            "several beads, or one in a world, move as rigid spheres: model.dynamics must be rigid");
    if (p->magnet_shape == FST_MAGNET_GRID)
        return fst_fail(error, FST_BAD_INPUT, "magnet.shape",
                        "several beads, or one in a world, need the field in space, and the map of magnet.file "
                        "has that of one plane: "
                        "choose magnet.shape lines or parts");
    if (p->bead_material != FST_MATERIAL_HARD)
        return fst_fail(
            error, FST_BAD_INPUT, "bead.material",
            "bead %d: several beads, or one in a world, are hard magnets so far: bead.material must be hard",
            bead + 1);
    return FST_OK;
}

/* Dry friction of several beads has one coefficient, at points. */
static fst_status check_dry(const fst_params *p, const fst_beads_options *options, fst_error *error)
{
    static const char *const reason =
        "several beads, or one in a world, have dry friction at points, of one coefficient at the plate and "
        "one between beads: leave %s as it is";
    const char *key = NULL;
    if (options->pair_mu < 0)
        return fst_fail(error, FST_BAD_INPUT, "contact.pair_mu", "contact.pair_mu = %g must not be negative",
                        options->pair_mu);
    if (p->friction_law != FST_FRICTION_COULOMB) {
        if (isnan(options->pair_mu))
            return FST_OK;
        return fst_fail(error, FST_BAD_INPUT, "contact.pair_mu",
                        "contact.pair_mu has no effect without dry friction: set friction.law to coulomb");
    }
    if (options->pair_rate > 0)
        return fst_fail(
            error, FST_BAD_INPUT, "contact.pair_rate",
            "contact.pair_rate is of viscous friction: under friction.law coulomb set contact.pair_mu");
    if (!isnan(p->friction_mu_static) && p->friction_mu_static != p->friction_mu)
        key = "friction.mu_static";
    else if (!isnan(p->friction_stribeck_speed))
        key = "friction.stribeck_speed";
    else if (p->friction_rolling_resistance > 0)
        key = "friction.rolling_resistance";
    else if (p->contact_patch != FST_PATCH_POINT)
        key = "contact.patch";
    return key ? fst_fail(error, FST_BAD_INPUT, key, reason, key) : FST_OK;
}

static fst_status check_apart(const beads_world *world, const double *state, fst_error *error)
{
    double at_start[BEADS_DIM] = {0.0}; /* with the time, which fields that change ask for */
    if (world->surrounded && world->count <= FST_BEADS_MOST)
        state = memcpy(at_start, state, (size_t)(FST_BEAD_NUMBERS * world->count) * sizeof *state);
    for (int i = 0; i < world->count; ++i) {
        const double gap = beads_plate_gap(world, i, state);
        int what;
        if (gap < -OVERLAP)
            return fst_fail(error, FST_BAD_INPUT, "start", "bead %d starts %g l below its place on the plate",
                            i + 1, -gap);
        if (beads_way_out(world, i, state, &what) <= 0)
            return fst_fail(error, FST_BAD_INPUT, "start.position",
                            what == BEADS_AT_MAGNET
                                ? "bead %d starts inside the magnet, or touches it: its centre must be farther "
                                  "from it than its radius of %g l"
                            : what == BEADS_AT_SOURCES
                                ? "bead %d, of the radius %g l, starts more than a wave.length from where "
                                  "wave.amplitude is told"
                                : "bead %d, of the radius %g l, starts beyond plate.radius",
                            i + 1, world->body[i].radius);
        for (int j = i + 1; j < world->count; ++j) {
            double d[3];
            beads_way(world, state, i, j, d);
            const double distance = sqrt(beads_dot(d, d)),
                         reach = world->body[i].radius + world->body[j].radius;
            if (!(distance >= reach - OVERLAP))
                return fst_fail(
                    error, FST_BAD_INPUT, "start",
                    "beads %d and %d overlap at the start: their centres are %g l apart, and the sum of their "
                    "radii is %g l",
                    i + 1, j + 1, distance, reach);
        }
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ numbers */

/* The moment of a bead of which nothing tells it. */
static double usual_moment(const fst_groups *g)
{
    const double radius = g->eps * g->length_unit;
    return 4.0 / 3.0 * FST_PI * radius * radius * radius * USUAL_REMANENCE / FST_MU_0;
}

static double chi_of_moment(const fst_params *p, const fst_groups *g)
{
    double moment = fst_bead_moment(p);
    if (isnan(moment))
        moment = usual_moment(g);
    const double l = g->length_unit;
    return FST_MU_0 * moment * moment * g->time_unit * g->time_unit /
           (4.0 * FST_PI * g->mass * (l * l * l * l * l));
}

/* Bead i of the world. */
static fst_status add_body(int i, const fst_groups *first, fst_model *model, beads_world *world, double *bead,
                           fst_error *error)
{
    const fst_groups g = fst_model_groups(model);
    beads_body *body = &world->body[i];
    const fst_medium medium = fst_medium_of(&model->params, &g);
    const int none = model->params.plate_shape == FST_PLATE_NONE;
    const double height = none ? 0.0 : g.eps == first->eps ? first->h : first->h - first->eps + g.eps;
    fst_start_numbers start;
    body->radius = g.eps;
    body->mass = g.mass / first->mass;
    body->inertia = g.inertia * body->mass * (g.eps * g.eps);
    body->strength = g.kappa * (g.eps * g.eps) * body->mass;
    body->displaced = medium.displaced * body->mass;
    body->added = medium.added * body->mass;
    body->drag = medium.drag * body->mass;
    body->fast_drag = medium.fast_drag * body->mass;
    body->spin_drag = medium.spin_drag * body->inertia;
    if (!isnan(g.field_unit) && !(fabs(g.field_unit - first->field_unit) <= 1e-9 * first->field_unit))
        return fst_fail(
            error, FST_BAD_INPUT, "bead.moment",
            "the moments of beads 1 and %d and their kappa give two values of B0, %g and %g T: give "
            "magnet.b0",
            i + 1, first->field_unit, g.field_unit);
    const fst_status status = fst_start(&model->params, model, height, &start, error);
    memcpy(bead, start.x, sizeof start.x);
    memcpy(bead + BEADS_V, start.v, sizeof start.v);
    memcpy(bead + BEADS_N, start.n, sizeof start.n);
    memcpy(bead + BEADS_W, start.w, sizeof start.w);
    return status;
}

static void set_plate(const fst_params *p, const fst_groups *g, const fst_beads_options *options,
                      beads_world *world)
{
    const double plate_rate = p->friction_law == FST_FRICTION_VISCOUS ? 1.0 : 0.0;
    const double pair_rate = isnan(options->pair_rate) ? plate_rate : options->pair_rate / p->friction_gamma;
    const int none = p->plate_shape == FST_PLATE_NONE;
    world->plate = none ? NAN : g->h - g->eps;
    world->bowl = p->plate_shape == FST_PLATE_BOWL ? p->plate_bowl_radius / g->length_unit : 0.0;
    world->clearance = none ? beads_model_clearance : NULL;
    world->plate_radius = g->plate_radius;
    world->gravity = g->gravity;
    world->omega = g->omega;
    world->restitution = isnan(p->impact_restitution) ? 0.0 : p->impact_restitution;
    world->bounce_least = BOUNCE_LEAST;
    if (p->friction_law == FST_FRICTION_COULOMB) {
        world->plate_mu = p->friction_mu;
        world->pair_mu = isnan(options->pair_mu) ? p->friction_mu : options->pair_mu;
    }
    beads_number_contacts(world, plate_rate, pair_rate);
}

/* What makes the field beside a magnet that turns steadily, and gravity along a tilted plate. */
static fst_status surround(const fst_model *model, beads_world *world, fst_error *error)
{
    const fst_params *p = &model->params;
    double sine, cosine, aside[2];
    if (!fst_key_of_surroundings(p))
        return FST_OK;
    world->surrounded = 1;
    if (p->drive_waveform == FST_WAVEFORM_WAVE)
        world->clearance = NULL;
    fst_sin_cos_degrees(p->plate_tilt, &sine, &cosine);
    fst_sin_cos_degrees(p->plate_tilt_azimuth, &aside[1], &aside[0]);
    for (int k = 0; k < 2; ++k)
        world->sideways[k] = world->gravity * sine * aside[k];
    world->gravity *= cosine;
    return fst_make_surroundings(model, &world->around, error);
}

/* Moments as strengths; where the magnet has none to pull with, as volumes. */
static void set_dipoles(double chi, beads_world *world)
{
    const beads_body *first = &world->body[0];
    for (int i = 0; i < world->count; ++i) {
        beads_body *body = &world->body[i];
        const double size = body->radius / first->radius;
        body->dipole =
            sqrt(chi) * (first->strength > 0 ? body->strength / first->strength : size * size * size);
    }
}

/* The state that the caller gave, whose Z are over the plate's surface. */
static void take_state(const double *given, const beads_world *world, double *state)
{
    const int over_plate = !isnan(world->plate);
    memcpy(state, given, (size_t)(FST_BEAD_NUMBERS * world->count) * sizeof *state);
    for (int i = 0; i < world->count; ++i)
        state[FST_BEAD_NUMBERS * i + 2] -= over_plate ? world->body[i].radius : 0.0;
}

/* A start that is hardly below the surface is on it. */
static void raise_starts(const beads_world *world, double *state)
{
    for (int i = 0; i < world->count; ++i) {
        double *x = state + FST_BEAD_NUMBERS * i;
        const double gap = beads_plate_gap(world, i, state), rho = world->bowl - world->body[i].radius;
        if (gap >= -OVERLAP || gap < -FEW_DIGITS * fmax(world->bowl, world->body[i].radius))
            continue;
        if (world->bowl > 0) { /* towards its centre */
            for (int k = 0; k < 2; ++k)
                x[k] *= rho / (rho - gap);
            x[2] = rho + (x[2] - rho) * (rho / (rho - gap));
        } else
            x[2] = 0.0;
    }
}

static fst_status add_bodies(const fst_params *beads, const fst_groups *first, beads_world *world,
                             double *state, fst_error *error)
{
    fst_status status = FST_OK;
    for (int i = 0; i < world->count && status == FST_OK; ++i) {
        fst_model *model;
        status = check_kinds(&beads[i], i, error);
        if (status == FST_OK)
            status = fst_field_model_new(&beads[i], NAN, &model, error);
        if (status != FST_OK)
            return status;
        status = add_body(i, first, model, world, state + FST_BEAD_NUMBERS * i, error);
        fst_model_free(model);
    }
    return status;
}

fst_status beads_set_up(const fst_params *beads, int count, const fst_beads_options *options, fst_model **model,
                        beads_world *world, double *state, fst_error *error)
{
    *model = NULL;
    memset(world, 0, sizeof *world);
    if (options->pair_rate < 0 || options->chi < 0)
        return fst_fail(error, FST_BAD_INPUT, "beads", "pair_rate = %g and chi = %g must not be negative",
                        options->pair_rate, options->chi);
    fst_status status = check_dry(&beads[0], options, error);
    if (status == FST_OK)
        status = check_kinds(&beads[0], 0, error);
    if (status == FST_OK)
        status = fst_field_model_new(&beads[0], NAN, model, error);
    if (status == FST_OK)
        status = check_same(beads, count, error);
    if (status != FST_OK)
        return status;
    const fst_groups g = fst_model_groups(*model);
    world->count = count;
    world->field = beads_model_field;
    world->source = *model;
    status = add_bodies(beads, &g, world, state, error);
    if (status != FST_OK)
        return status;
    set_plate(&beads[0], &g, options, world);
    status = surround(*model, world, error);
    if (status != FST_OK)
        return status;
    set_dipoles(isnan(options->chi) ? chi_of_moment(&beads[0], &g) : options->chi, world);
    if (options->state)
        take_state(options->state, world, state);
    raise_starts(world, state);
    return check_apart(world, state, error);
}
