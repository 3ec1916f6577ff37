/* start.c - where a bead begins: start.r, start.phi and start.spin, and the vectors that replace parts of them. */
#include "model/start.h"

#include <string.h>

#include "base/elementary.h"
#include "base/error.h"
#include "model/forms.h"
#include "model/model.h"
#include "model/params.h"
#include "model/surroundings.h"
#include "model/worlds.h"

static const double AT_REST = 1e-9; /* heights over the plate that differ by less, in l, are the same */

/* Numbers of a vector in their scaled unit; what was not given is 0.  0: nothing was given. */
static int take(const double given[3], double unit, double vector[3])
{
    if (isnan(given[0]) && isnan(given[1]) && isnan(given[2]))
        return 0;
    for (int k = 0; k < 3; ++k)
        vector[k] = isnan(given[k]) ? 0.0 : given[k] / unit;
    return 1;
}

/* The height of a bead that lies at the distance r from the axis, over that in the middle. */
static fst_status rest_height(const fst_params *params, const fst_groups *g, double r, double *height,
                              fst_error *error)
{
    const double rho = params->plate_bowl_radius / g->length_unit - g->eps;
    *height = 0.0;
    if (params->plate_shape != FST_PLATE_BOWL)
        return FST_OK;
    if (!(r < rho))
        return fst_fail(error, FST_BAD_INPUT, "start.r",
                        "the bead starts %g l from the axis, but its centre stays within %g l in the bowl "
                        "(plate.bowl_radius)",
                        r, rho);
    *height = fst_bowl_rise(rho, r);
    return FST_OK;
}

/* The place and its direction from the axis. */
static fst_status place(const fst_params *params, const fst_groups *g, double x[3], double direction[2],
                        fst_error *error)
{
    const double *position = params->start_position;
    const int given = take(position, g->length_unit, x) && !(isnan(position[0]) && isnan(position[1]));
    double r = params->start_r, sine, cosine, at_rest;
    fst_sin_cos_degrees(params->start_phi, &sine, &cosine);
    if (!given) {
        x[0] = r * cosine;
        x[1] = r * sine;
    } else {
        r = sqrt(x[0] * x[0] + x[1] * x[1]);
        cosine = r > 0 ? x[0] / r : 1.0;
        sine = r > 0 ? x[1] / r : 0.0;
    }
    if (params->plate_shape == FST_PLATE_NONE && isnan(position[2]))
        return fst_fail(error, FST_BAD_INPUT, "start.position",
                        "without a plate the bead starts at a height over the magnet's reference plane: give "
                        "start.position[2]");
    const fst_status status = rest_height(params, g, r, &at_rest, error);
    if (status != FST_OK)
        return status;
    x[2] = isnan(position[2]) ? at_rest : params->plate_shape == FST_PLATE_NONE ? x[2] : x[2] - g->eps;
    if (fabs(x[2] - at_rest) <= AT_REST)
        x[2] = at_rest;
    direction[0] = cosine;
    direction[1] = sine;
    if (r >= g->plate_radius)
        return fst_fail(error, FST_BAD_INPUT, given ? "start.position" : "start.r",
                        "%s = %g lies beyond the plate's edge at %g: choose a smaller %s",
                        given ? "the distance from the axis of start.position" : "start.r", r, g->plate_radius,
                        given ? "one" : "start.r");
    return FST_OK;
}

static fst_status direct(const fst_params *params, const fst_model *model, double height, const double x[3],
                         double n[3], fst_error *error)
{
    fst_gradient_double gradient;
    const int given = take(params->start_n, 1.0, n);
    if (!given && fst_key_of_surroundings(params)) {
        const double at[3] = {x[0], x[1], height + x[2]};
        double change[3];
        fst_surroundings around;
        const fst_status status = fst_make_surroundings(model, &around, error);
        if (status != FST_OK)
            return status;
        fst_surroundings_field(&around, 0.0, at, n, &gradient, change);
    } else if (!given)
        fst_field_double(&model->world, x[0], x[1], height + x[2], n, &gradient);
    const double norm = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(norm > 1e-150) && given)
        return fst_fail(error, FST_BAD_INPUT, "start.n", "start.n is not a direction: it has the length %g",
                        norm);
    if (!(norm > 1e-150))
        return fst_fail(error, FST_BAD_INPUT, "start.r",
                        "the magnet's field vanishes at the start, so n = B/|B| does not exist there: move "
                        "start.r or start.phi");
    for (int i = 0; i < 3; ++i)
        n[i] = n[i] / norm;
    return FST_OK;
}

/* Free rolling: alpha' = -eps omega/(r - eps), W = rate e_r; in a bowl W lies along its slope. */
static fst_status roll(const fst_params *params, const fst_groups *g, const double x[3],
                       const double direction[2], double v[3], double w[3], fst_error *error)
{
    const double r = sqrt(x[0] * x[0] + x[1] * x[1]), gap = r - g->eps;
    const double rho = params->plate_bowl_radius / g->length_unit - g->eps;
    const double sine = params->plate_shape == FST_PLATE_BOWL ? r / rho : 0.0, cosine = sqrt(1.0 - sine * sine);
    if (!(fabs(gap) > 1e-9) || r == 0.0)
        return fst_fail(error, FST_BAD_INPUT, "start.r",
                        "a free-rolling start does not exist at start.r = %g with eps = %g: choose start.r > "
                        "eps, or start.spin = rest",
                        r, g->eps);
    const double rate = g->omega * r / gap;
    v[0] = g->eps * rate * direction[1];
    v[1] = -g->eps * rate * direction[0];
    w[0] = rate * direction[0] * cosine;
    w[1] = rate * direction[1] * cosine;
    w[2] = rate * sine;
    return FST_OK;
}

fst_status fst_start(const fst_params *params, const fst_model *model, double height, fst_start_numbers *start,
                     fst_error *error)
{
    const fst_groups *g = &model->groups;
    double v[3], w[3], direction[2] = {1.0, 0.0};
    memset(start, 0, sizeof *start);
    fst_status status = place(params, g, start->x, direction, error);
    if (status == FST_OK)
        status = direct(params, model, height, start->x, start->n, error);
    const int moves = take(params->start_velocity, g->length_unit / g->time_unit, v);
    const int turns = take(params->start_angular_velocity, 1.0 / g->time_unit, w);
    const int turns_steadily = params->drive_waveform == FST_WAVEFORM_STEADY && model->world.kinds.pieces > 0;
    const int rolls =
        params->start_spin != FST_SPIN_REST && params->plate_shape != FST_PLATE_NONE && turns_steadily;
    if (status == FST_OK && rolls && !(moves && turns))
        status = roll(params, g, start->x, direction, start->v, start->w, error);
    if (moves)
        memcpy(start->v, v, sizeof v);
    if (turns)
        memcpy(start->w, w, sizeof w);
    return status;
}

fst_status fst_start_state(const fst_params *params, const fst_model *model, double state[FST_STATE_SIZE],
                           fst_error *error)
{
    fst_start_numbers start;
    fst_params room;
    if (params->bead_count)
        return fst_fail(error, FST_BAD_INPUT, "beads",
                        "this computation takes one bead that no list holds, and the scene has a list of %d: "
                        "leave beads out",
                        params->bead_count);
    fst_status status = fst_start(fst_params_settled(params, &room), model, model->world.height, &start, error);
    if (status == FST_OK && (start.x[2] != 0.0 || start.v[2] != 0.0))
        status = fst_check_no_world(params, error);
    if (status != FST_OK)
        return status;
    memcpy(state + FST_X, start.x, 2 * sizeof *state);
    memcpy(state + FST_VX, start.v, 2 * sizeof *state);
    memcpy(state + FST_NX, start.n, sizeof start.n);
    memcpy(state + FST_WX, start.w, sizeof start.w);
    return FST_OK;
}
