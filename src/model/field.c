/* field.c - the field at a place: of the turning magnet, and of all else that makes one. */
#include "model/surroundings.h"

#include <festoon/beads.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "model/params.h"
#include "model/worlds.h"

/* Give a model its surroundings, on the laboratory's axes. */
static fst_status surround(fst_model *model, fst_error *error)
{
    fst_surroundings *s = malloc(sizeof *s);
    model->surroundings = s;
    if (!s)
        return fst_fail(error, FST_NO_MEMORY, "fst_field_model_new", "out of memory");
    const fst_status status = fst_make_surroundings(model, s, error);
    s->laboratory = 1;
    return status;
}

fst_status fst_field_model_new(const fst_params *params, double height, fst_model **model, fst_error *error)
{
    *model = NULL;
    fst_model *made = malloc(sizeof *made);
    fst_status status = made ? fst_model_fill(params, height, made, error)
                             : fst_fail(error, FST_NO_MEMORY, "fst_model_new", "out of memory");
    if (status != FST_OK) {
        free(made);
        return status;
    }
    if (isnan(height) && params->plate_shape == FST_PLATE_BOWL && !made->map)
        made->bowl = params->plate_bowl_radius / made->groups.length_unit - made->groups.eps;
    if (fst_key_of_surroundings(params))
        status = surround(made, error);
    if (status == FST_OK)
        *model = made;
    else
        fst_model_free(made);
    return status;
}

fst_status fst_field_model_at(fst_model *model, double time, fst_error *error)
{
    const fst_status status = model->surroundings ? FST_OK : surround(model, error);
    if (status != FST_OK)
        return status;
    (void)fst_waveform_enter(&model->surroundings->drive, time);
    model->field_time = time;
    return FST_OK;
}

double fst_field_time(const fst_model *model)
{
    return model->field_time;
}

fst_status fst_model_new(const fst_params *params, fst_model **model, fst_error *error)
{
    *model = NULL;
    const fst_status status = fst_check_no_world(params, error);
    return status == FST_OK ? fst_field_model_new(params, NAN, model, error) : status;
}

void fst_model_free(fst_model *model)
{
    if (!model)
        return;
    fst_field_map_free(model->map);
    free(model->surroundings);
    free(model);
}

/* Whether the samples of a measured field surround a place. */
static int is_known(const fst_model *model, double x, double y)
{
    const fst_map_plane *plane = model->world.kinds.plane;
    const double place[2] = {x * model->groups.length_unit, y * model->groups.length_unit};
    for (int axis = 0; plane && axis < 2; ++axis) {
        const double cells = (place[axis] - plane->first[axis]) / plane->spacing[axis];
        if (!(cells >= -1e-9 && cells <= plane->cells[axis] + 1e-9))
            return 0;
    }
    return 1;
}

static void write_gradient(const fst_gradient_double *g, double grad[3][3])
{
    const double all[3][3] = {{g->xx, g->xy, g->xz}, {g->yx, g->yy, g->yz}, {g->xz, g->yz, -(g->xx + g->yy)}};
    memcpy(grad, all, sizeof all);
}

double fst_field_height(const fst_model *model, double x, double y)
{
    return model->world.height + (model->bowl > 0 ? fst_bowl_rise(model->bowl, hypot(x, y)) : 0.0);
}

/* The part in or on which a place lies, from its coordinates (l) and those on the magnet's axes; -1: none. */
static int part_around(const fst_model *model, const double place[3], const double own[3])
{
    const fst_params *p = &model->params;
    const int count = p->magnet_shape == FST_MAGNET_PARTS ? p->magnet_part_count : 0;
    for (int i = 0; i < count; ++i) {
        const double *of = p->magnet_parts[i].motion == FST_PART_FIXED ? place : own;
        const double metres[3] = {of[0] * model->groups.length_unit, of[1] * model->groups.length_unit,
                                  of[2] * model->groups.length_unit};
        if (fst_part_distance(&p->magnet_parts[i], metres) <= 0.0)
            return i;
    }
    return -1;
}

/* Where a field is asked for: the place, the same on the magnet's axes, and the time. */
static double locate(const fst_model *model, double x, double y, double place[3], double own[3])
{
    const double time = isnan(model->field_time) ? 0.0 : model->field_time;
    place[0] = own[0] = x;
    place[1] = own[1] = y;
    place[2] = own[2] = fst_field_height(model, x, y);
    if (model->surroundings)
        fst_place_on_magnet(model->surroundings, time, place, own);
    return time;
}

int fst_field_inside(const fst_model *model, double x, double y)
{
    double place[3], own[3];
    (void)locate(model, x, y, place, own);
    return part_around(model, place, own);
}

static void write_unknown(double b[3], double grad[3][3])
{
    for (int i = 0; i < 3; ++i)
        b[i] = grad[i][0] = grad[i][1] = grad[i][2] = NAN;
}

void fst_field(const fst_model *model, double x, double y, double b[3], double grad[3][3])
{
    double place[3], own[3], change[3];
    const double time = locate(model, x, y, place, own);
    if (!is_known(model, own[0], own[1]) || isnan(place[2]) || part_around(model, place, own) >= 0) {
        write_unknown(b, grad);
        return;
    }
    fst_gradient_double g;
    if (model->surroundings)
        fst_surroundings_field(model->surroundings, time, place, b, &g, change);
    else
        fst_field_double(&model->world, x, y, place[2], b, &g);
    write_gradient(&g, grad);
}

void fst_field_pull(const fst_model *model, double x, double y, double force[3], double *load)
{
    const fst_groups *g = &model->groups;
    double b[3], grad[3][3];
    fst_field(model, x, y, b, grad);
    const double norm = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    /* U = -kappa eps^2 B - (a + b) B^2 with n along B, and dB/dx_j = B_i G_ij/B. */
    const double pull = g->kappa * (g->eps * g->eps) + 2.0 * (g->a + g->b) * norm;
    for (int j = 0; j < 3; ++j) {
        const double slope = b[0] * grad[0][j] + b[1] * grad[1][j] + b[2] * grad[2][j];
        force[j] = norm > 0.0 ? pull * slope / norm : norm; /* 0, or NAN where no field is told */
    }
    *load = g->gravity - force[2];
}

fst_status fst_field_at(const fst_params *params, double time, const double place[3], double b[3],
                        double grad[3][3], fst_error *error)
{
    fst_model *model;
    fst_gradient_double g;
    double change[3];
    fst_status status = fst_field_model_new(params, NAN, &model, error);
    if (status == FST_OK && !model->surroundings)
        status = surround(model, error);
    if (status == FST_OK) {
        (void)fst_waveform_enter(&model->surroundings->drive, time);
        double own[3];
        fst_place_on_magnet(model->surroundings, time, place, own);
        fst_surroundings_field(model->surroundings, time, place, b, &g, change);
        write_gradient(&g, grad);
        if (part_around(model, place, own) >= 0)
            write_unknown(b, grad);
    }
    fst_model_free(model);
    return status;
}
