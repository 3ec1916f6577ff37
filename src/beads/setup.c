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
#include "base/error.h"
#include "model/params.h"

static const double BOUNCE_LEAST = 1e-4, OVERLAP = 1e-9, USUAL_REMANENCE = 1.2;

/* ------------------------------------------------------------------ what cannot be */

static int is_of_bead(const char *key)
{
    return strncmp(key, "bead.", 5) == 0 || strncmp(key, "start.", 6) == 0;
}

static fst_status check_same(const fst_params *beads, int count, fst_error *error)
{
    char first[FST_PARAM_TEXT_SIZE], other[FST_PARAM_TEXT_SIZE];
    for (int bead = 1; bead < count; ++bead)
        for (int i = 0; i < fst_params_row_count(&beads[0]); ++i) {
            const char *key = fst_param_at(i)->key;
            (void)fst_params_get(&beads[0], i, first, sizeof first);
            (void)fst_params_get(&beads[bead], i, other, sizeof other);
            if (!is_of_bead(key) && strcmp(first, other) != 0)
                return fst_fail(
                    error, FST_BAD_INPUT, key,
                    "%s differs between bead 0 and bead %d: beads of one plate may differ in bead.* "
                    "and start.* alone",
                    key, bead);
        }
    return FST_OK;
}

static fst_status check_kinds(const fst_params *p, int bead, fst_error *error)
{
    if (p->friction_law != FST_FRICTION_VISCOUS && p->friction_law != FST_FRICTION_NONE)
        return fst_fail(
            error, FST_BAD_INPUT, "friction.law",
            "several beads have viscous friction or none so far: friction.law must be viscous or none");
    if (p->model_dynamics != FST_DYNAMICS_RIGID)
        return fst_fail(error, FST_BAD_INPUT, "model.dynamics",
                        "several beads move as rigid spheres: model.dynamics must be rigid");
    if (p->magnet_shape == FST_MAGNET_GRID)
        return fst_fail(
            error, FST_BAD_INPUT, "magnet.shape",
            "beads that touch leave the plate, and the map of magnet.file has the field of one plane: "
            "choose magnet.shape lines or parts");
    if (p->bead_material != FST_MATERIAL_HARD)
        return fst_fail(error, FST_BAD_INPUT, "bead.material",
                        "bead %d: several beads are hard magnets so far: bead.material must be hard", bead);
    return FST_OK;
}

static fst_status check_apart(const beads_world *world, const double *state, fst_error *error)
{
    beads_modes modes = {.gone = {0}};
    beads_look look;
    beads_look_at_gaps(world, &modes, state, &look);
    for (int k = 0; k < world->contacts; ++k) {
        const beads_contact *c = &world->contact[k];
        if (c->second < 0 && look.gap[k] < -OVERLAP)
            return fst_fail(error, FST_BAD_INPUT, "start", "bead %d starts %g l below its place on the plate",
                            c->first, -look.gap[k]);
        if (c->second >= 0 && !(look.gap[k] >= -OVERLAP))
            return fst_fail(
                error, FST_BAD_INPUT, "start",
                "beads %d and %d overlap at the start: their centres are %g l apart, and the sum of their "
                "radii is %g l",
                c->first, c->second, look.gap[k] + c->reach, c->reach);
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
static fst_status add_body(const fst_params *p, int i, const fst_groups *first, fst_model *model,
                           beads_world *world, double *bead, fst_error *error)
{
    const fst_groups g = fst_model_groups(model);
    beads_body *body = &world->body[i];
    double one[FST_STATE_SIZE];
    body->radius = g.eps;
    body->mass = g.mass / first->mass;
    body->inertia = g.inertia * body->mass * (g.eps * g.eps);
    body->strength = g.kappa * (g.eps * g.eps) * body->mass;
    if (!isnan(g.field_unit) && !(fabs(g.field_unit - first->field_unit) <= 1e-9 * first->field_unit))
        return fst_fail(
            error, FST_BAD_INPUT, "bead.moment",
            "the moments of beads 0 and %d and their kappa give two values of B0, %g and %g T: give "
            "magnet.b0",
            i, first->field_unit, g.field_unit);
    const fst_status status = fst_start_state(p, model, one, error);
    if (status != FST_OK)
        return status;
    memset(bead, 0, FST_BEAD_NUMBERS * sizeof *bead);
    memcpy(bead, one + FST_X, 2 * sizeof *bead);
    memcpy(bead + BEADS_V, one + FST_VX, 2 * sizeof *bead);
    memcpy(bead + BEADS_N, one + FST_NX, 6 * sizeof *bead);
    return FST_OK;
}

static void set_plate(const fst_params *p, const fst_groups *g, const fst_beads_options *options,
                      beads_world *world)
{
    const double plate_rate = p->friction_law == FST_FRICTION_VISCOUS ? 1.0 : 0.0;
    const double pair_rate = isnan(options->pair_rate) ? plate_rate : options->pair_rate / p->friction_gamma;
    world->plate = g->h - g->eps;
    world->plate_radius = g->plate_radius;
    world->gravity = g->gravity;
    world->omega = g->omega;
    world->restitution = isnan(p->impact_restitution) ? 0.0 : p->impact_restitution;
    world->bounce_least = BOUNCE_LEAST;
    beads_number_contacts(world, plate_rate, pair_rate);
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
    memcpy(state, given, (size_t)(FST_BEAD_NUMBERS * world->count) * sizeof *state);
    for (int i = 0; i < world->count; ++i)
        state[FST_BEAD_NUMBERS * i + 2] -= world->body[i].radius;
}

static fst_status add_bodies(const fst_params *beads, const fst_groups *first, beads_world *world,
                             double *state, fst_error *error)
{
    fst_status status = FST_OK;
    for (int i = 0; i < world->count && status == FST_OK; ++i) {
        fst_model *model;
        status = check_kinds(&beads[i], i, error);
        if (status == FST_OK)
            status = fst_model_new(&beads[i], &model, error);
        if (status != FST_OK)
            return status;
        status = add_body(&beads[i], i, first, model, world, state + FST_BEAD_NUMBERS * i, error);
        fst_model_free(model);
    }
    return status;
}

fst_status beads_set_up(const fst_params *beads, int count, const fst_beads_options *options, fst_model **model,
                        beads_world *world, double state[BEADS_NUMBERS], fst_error *error)
{
    *model = NULL;
    memset(world, 0, sizeof *world);
    if (count < 1 || count > FST_BEADS_MOST)
        return fst_fail(error, FST_BAD_INPUT, "beads", "%d beads: the exact method takes 1 to %d", count,
                        FST_BEADS_MOST);
    if (options->pair_rate < 0 || options->chi < 0)
        return fst_fail(error, FST_BAD_INPUT, "beads", "pair_rate = %g and chi = %g must not be negative",
                        options->pair_rate, options->chi);
    fst_status status = check_kinds(&beads[0], 0, error);
    if (status == FST_OK)
        status = fst_model_new(&beads[0], model, error);
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
    set_dipoles(isnan(options->chi) ? chi_of_moment(&beads[0], &g) : options->chi, world);
    if (options->state)
        take_state(options->state, world, state);
    return check_apart(world, state, error);
}
