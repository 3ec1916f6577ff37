/* change.c - what differs between the motions of two scenes: asked of the numbers of which their models are made, so that no
 * list of keys says which of them count. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "model/forms.h"
#include "model/model.h"
#include "model/params.h"

/* Without what the law in effect does not read. */
static fst_world_double acting(const fst_model *model)
{
    fst_world_double world = model->world;
    if (!world.kinds.dry)
        world.holding = 0.0;
    if (!world.kinds.resists)
        world.resistance.arm = 0.0;
    return world;
}

static int moves_alike(const fst_model *one, const fst_model *other)
{
    const fst_world_double a = acting(one), b = acting(other);
    const size_t numbers = offsetof(fst_world_double, eps);
    return fst_kinds_equal(&a.kinds, &b.kinds) &&
           memcmp((const char *)&a + numbers, (const char *)&b + numbers, sizeof a - numbers) == 0 &&
           one->groups.plate_radius == other->groups.plate_radius &&
           one->groups.map_radius == other->groups.map_radius &&
           (!a.kinds.flies || one->params.impact_restitution == other->params.impact_restitution);
}

static int starts_alike(const fst_model *one, const fst_model *other)
{
    double a[FST_STATE_SIZE], b[FST_STATE_SIZE];
    return fst_start_state(&one->params, one, a, NULL) == FST_OK &&
           fst_start_state(&other->params, other, b, NULL) == FST_OK && memcmp(a, b, sizeof a) == 0;
}

/* Whether run.* are the same. */
static int runs_alike(const fst_params *one, const fst_params *other)
{
    int alike = 1;
    for (int i = 0; i < fst_param_count(); ++i) {
        char a[FST_PARAM_TEXT_SIZE], b[FST_PARAM_TEXT_SIZE];
        if (strncmp(fst_param_at(i)->key, "run.", 4) != 0)
            continue;
        (void)fst_params_get(one, i, a, sizeof a);
        (void)fst_params_get(other, i, b, sizeof b);
        alike &= strcmp(a, b) == 0;
    }
    return alike;
}

static int same_units(const fst_groups *a, const fst_groups *b)
{
    return a->length_unit == b->length_unit && a->time_unit == b->time_unit && a->mass == b->mass &&
           (a->field_unit == b->field_unit || (isnan(a->field_unit) && isnan(b->field_unit)));
}

/* Whether the field's unit says nothing else: magnet and bead are known in tesla.  Numbers scaled by it differ in rounding. */
static int field_unit_is_free(const fst_params *p)
{
    return fst_magnet_in_tesla(p) && fst_kappa_follows(p) && p->bead_material == FST_MATERIAL_HARD;
}

/* A coil without a current makes no field, wherever it is. */
static fst_params without_idle_coils(const fst_params *p)
{
    fst_params left = *p;
    left.coil_count = 0;
    memset(left.coils, 0, sizeof left.coils);
    for (int i = 0; i < p->coil_count; ++i)
        if (p->coils[i].current != 0 || p->coils[i].ac != 0)
            left.coils[left.coil_count++] = p->coils[i];
    return left;
}

fst_scene_change fst_params_changes(const fst_params *one, const fst_params *other)
{
    const fst_params a = without_idle_coils(one), b = without_idle_coils(other);
    if (memcmp(&a, &b, sizeof a) == 0)
        return FST_CHANGE_NOTHING;
    fst_params alike = *other;
    fst_model *models[2] = {NULL, NULL};
    fst_scene_change change = FST_CHANGE_MOTION;
    if (field_unit_is_free(one) && field_unit_is_free(other))
        alike.magnet_b0 = one->magnet_b0;
    if (one->bead_count == 0 && other->bead_count == 0 && runs_alike(one, other) &&
        fst_model_new(one, &models[0], NULL) == FST_OK && fst_model_new(&alike, &models[1], NULL) == FST_OK &&
        moves_alike(models[0], models[1]) && starts_alike(models[0], models[1]))
        change = !same_units(&models[0]->groups, &models[1]->groups) ||
                         (field_unit_is_free(one) && fst_field_unit(one) != fst_field_unit(other))
                     ? FST_CHANGE_UNITS
                     : FST_CHANGE_NOTHING;
    fst_model_free(models[0]);
    fst_model_free(models[1]);
    return change;
}
