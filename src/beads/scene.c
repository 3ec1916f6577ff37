/* scene.c - the beads of a scene: each as parameters of its own, and the options that the scene's keys say. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "beads/setup.h"

static double given_or(double option, double key)
{
    return isnan(option) ? key : option;
}

/* run.step as steps a turn: a number of 1 or more is that already, another a time in s. */
static double steps_per_turn(const fst_params *p, double otherwise)
{
    if (isnan(p->run_step))
        return otherwise;
    return p->run_step >= 1.0 ? p->run_step : 1.0 / (p->run_step * fst_drive_frequency(p));
}

fst_status beads_of_scene(const fst_params *scene, const fst_beads_options *options, fst_params **beads,
                          fst_beads_options *said, fst_error *error)
{
    const int count = beads_in_scene(scene);
    *beads = NULL;
    *said = *options;
    if (count < 1)
        return fst_fail(error, FST_BAD_INPUT, "beads", "the scene lists no beads");
    *beads = malloc((size_t)count * sizeof **beads);
    if (!*beads)
        return fst_fail(error, FST_NO_MEMORY, "beads", "out of memory for %d beads", count);
    fst_status status = FST_OK;
    for (int bead = 0; bead < count && status == FST_OK; ++bead)
        if (scene->bead_count)
            status = fst_params_of_bead(scene, bead, &(*beads)[bead], error);
        else
            (*beads)[bead] = *scene;
    said->pair_rate = given_or(options->pair_rate, scene->contact_pair_rate);
    said->chi = given_or(options->chi, scene->model_chi);
    if (scene->friction_law == FST_FRICTION_COULOMB)
        said->pair_mu = given_or(options->pair_mu, scene->contact_pair_mu);
    said->method = (fst_beads_method)scene->run_method;
    said->steps_per_turn = steps_per_turn(scene, options->steps_per_turn);
    return status;
}

fst_status fst_beads_run_scene(const fst_params *scene, const fst_beads_options *options,
                               fst_beads_result *result, fst_error *error)
{
    fst_params *beads;
    fst_beads_options said;
    memset(result, 0, sizeof *result);
    fst_status status = beads_of_scene(scene, options, &beads, &said, error);
    if (status == FST_OK)
        status = fst_beads_run(beads, beads_in_scene(scene), &said, result, error);
    free(beads);
    return status;
}
