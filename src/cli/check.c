/* check.c - festoon check: reading a scene, and telling what it means without running it. */
#include <stdlib.h>

#include <festoon/beads.h>

#include "cli/command.h"
#include "cli/groups.h"

static const option options[] = {SCENE_OPTIONS, JSON_OPTION, {NULL, '\0', NULL, NULL}};

static void print_text(FILE *out, const char *path, const fst_model *model, const double *state,
                       const char *scene)
{
    const fst_groups groups = fst_model_groups(model);
    char name[SHOWN_SIZE];
    (void)fprintf(out, "%s is a good scene.\n\nIn SI:\n%s\nScaled:\n",
                  path ? shown(path, name) : "The default scene", scene);
    print_groups(out, &groups);
    (void)fprintf(out, "\nStart state (X Y vX vY nX nY nZ WX WY WZ):\n ");
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        (void)fprintf(out, " %.6g", unsigned_zero(state[i], ALL_DIGITS));
    (void)fprintf(out, "\n");
}

/* How good a measured field is. */
static void print_map(FILE *out, const fst_field_map *map)
{
    const fst_field_map_facts facts = fst_field_map_describe(map);
    (void)fprintf(out,
                  "\nMap: %d x %d x %d samples, %.4g mm and %.4g mm apart, known to %.4g mm from the axis, |B| "
                  "up to %.4g mT\n  curl (dBx/dy - dBy/dx, rms, over all derivatives): %.2g\n",
                  facts.count[0], facts.count[1], facts.count[2], 1e3 * facts.spacing[0],
                  1e3 * facts.spacing[1], 1e3 * facts.radius, 1e3 * facts.greatest, facts.curl);
}

fst_status check_world(const fst_params *scene, fst_error *error)
{
    fst_beads_result result = {.count = 0};
    fst_world_result alone;
    fst_params shortest = *scene;
    const fst_beads_options usual = fst_default_beads_options();
    shortest.run_periods = 1e-3;
    shortest.run_discard = 0.0;
    shortest.run_duration = NAN;
    fst_status status = scene->bead_count ? fst_beads_run_scene(&shortest, &usual, &result, error)
                                          : fst_world_run(&shortest, &usual, &alone, error);
    if (status == FST_OK)
        fst_beads_free(&result);
    return status;
}

/* The same of a scene that lists beads. */
static fst_status check_beads(const arguments *given, const fst_params *scene, FILE *out, fst_error *error)
{
    char name[SHOWN_SIZE];
    const fst_status status = check_world(scene, error);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        return print_and_free(fst_scene_json(scene), out, error);
    char *text = fst_scene_text(scene, 0);
    (void)fprintf(out, "%s is a good scene; beads: %d.\n\nIn SI:\n",
                  operand(given) ? shown(operand(given), name) : "This",
                  scene->bead_count ? scene->bead_count : 1);
    return print_and_free(text, out, error);
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_model *model = NULL;
    double state[FST_STATE_SIZE];
    fst_status status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK)
        status = fst_field_model_new(&params, NAN, &model, error);
    if (status == FST_OK && (params.bead_count || fst_key_of_world(&params))) {
        fst_model_free(model);
        return check_beads(given, &params, out, error);
    }
    if (status == FST_OK)
        status = fst_start_state(&params, model, state, error);
    if (status == FST_OK)
        warn_of_material(&params);
    if (status == FST_OK && option_value(given, "json")) {
        status = print_and_free(fst_scene_json(&params), out, error);
    } else if (status == FST_OK) {
        char *scene = fst_scene_text(&params, 0);
        if (scene)
            print_text(out, operand(given), model, state, scene);
        if (scene && params.magnet_map)
            print_map(out, params.magnet_map);
        if (!scene)
            status = fail(error, FST_NO_MEMORY, "", "out of memory");
        free(scene);
    }
    fst_model_free(model);
    return status;
}

const command check_command = {
    .name = "check",
    .synopsis = "[SCENE.yaml] [--json]",
    .summary = "Read a scene and print what it means, in SI and scaled, without running it",
    .details = "",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
