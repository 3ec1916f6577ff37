/* grid_doubts.c - what can be computed over a grid, but cannot be meant: beads of no material, axes without effect. */
#include <festoon/festoon.h>

#include <stdio.h>
#include <string.h>

#include "model/worlds.h"

int fst_grid_contradiction(const fst_grid *grid, char *sentence, size_t size)
{
    enum { LOOKS = 255 };
    const int64_t last = fst_grid_points(grid) - 1, looks = last < LOOKS ? last : LOOKS;
    fst_params params;
    int found = 0;
    for (int64_t i = 0; i <= looks && !found; ++i)
        found = fst_grid_params(grid, looks > 0 ? i * last / looks : 0, &params, NULL) == FST_OK &&
                fst_bead_contradiction(&params, sentence, size) != 0;
    return found;
}

/* Whether beads with these parameters, which differ in a key of the bead or of the magnet, move alike but for units: from one
 * start, with the same rates at any other state, and the same load and edge. */
static int same_motion(const fst_params both[2])
{
    static const double any[FST_STATE_SIZE] = {0.3, 0.5, 0.02, -0.01, 0.6, 0.0, 0.8, 0.1, -0.2, 0.05};
    double numbers[2][2 * FST_STATE_SIZE + 2];
    int made = 0;
    for (int i = 0; i < 2; ++i) {
        fst_model *model;
        if (both[i].bead_count || fst_key_of_world(&both[i]) || fst_model_new(&both[i], &model, NULL) != FST_OK)
            continue;
        const fst_groups g = fst_model_groups(model);
        made += fst_start_state(&both[i], model, numbers[i], NULL) == FST_OK;
        fst_rhs(model, any, numbers[i] + FST_STATE_SIZE);
        numbers[i][2 * FST_STATE_SIZE] = g.gravity;
        numbers[i][2 * FST_STATE_SIZE + 1] = g.plate_radius;
        fst_model_free(model);
    }
    return made == 2 && memcmp(numbers[0], numbers[1], sizeof *numbers) == 0;
}

/* Whether an axis changes nothing but units: seen from the first point and from the last one. */
static int is_idle(const fst_grid *grid, int axis)
{
    const char *key = fst_grid_key(grid, axis);
    const int64_t count = fst_grid_axis_points(grid, axis), stride = fst_grid_axis_stride(grid, axis);
    const int64_t corners[2] = {0, fst_grid_points(grid) - 1}, others[3] = {0, 1, count - 1};
    int alike = count > 1 && (strncmp(key, "bead.", 5) == 0 || strncmp(key, "magnet.", 7) == 0);
    for (int k = 0; k < 6 && alike; ++k) {
        const int64_t corner = corners[k / 3],
                      moved = corner + (others[k % 3] - corner / stride % count) * stride;
        fst_params both[2];
        alike = fst_grid_params(grid, corner, &both[0], NULL) == FST_OK &&
                fst_grid_params(grid, moved, &both[1], NULL) == FST_OK && same_motion(both);
    }
    return alike;
}

int fst_grid_idle_axes(const fst_grid *grid, char *sentence, size_t size)
{
    char keys[160] = "";
    for (int a = 0; a < fst_grid_axis_count(grid); ++a)
        if (is_idle(grid, a)) {
            const size_t used = strlen(keys);
            (void)snprintf(keys + used, sizeof keys - used, "%s%s", used ? " and " : "", fst_grid_key(grid, a));
        }
    if (keys[0])
        (void)snprintf(sentence, size,
                       "along %s only units change: the motion depends on scaled numbers, which other keys fix",
                       keys);
    return keys[0] != '\0';
}
