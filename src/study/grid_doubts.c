/* grid_doubts.c - what can be computed over a grid, but cannot be meant: beads of no material, axes without effect. */
#include <festoon/festoon.h>

#include <stdio.h>
#include <string.h>

/* The parameters of the point of look `i`, from the first point to the last. */
enum { LOOKS = 255 };
static int look(const fst_grid *grid, int64_t i, int64_t *point, fst_params *params)
{
    const int64_t last = fst_grid_points(grid) - 1, looks = last < LOOKS ? last : LOOKS;
    *point = looks > 0 ? i * last / looks : 0;
    return i <= looks && fst_grid_params(grid, *point, params, NULL) == FST_OK;
}

/* The first point at which parts overlap that do not in the scene itself. */
static int overlap_along(const fst_grid *grid, char *sentence, size_t size)
{
    char why[256];
    fst_params params;
    int64_t point;
    if (fst_grid_base(grid)->magnet_shape != FST_MAGNET_PARTS ||
        fst_parts_contradiction(fst_grid_base(grid), why, sizeof why))
        return 0;
    for (int64_t i = 0; i <= LOOKS; ++i)
        if (look(grid, i, &point, &params) && fst_parts_contradiction(&params, why, sizeof why)) {
            (void)snprintf(sentence, size, "at");
            for (int a = 0; a < fst_grid_axis_count(grid); ++a) {
                const size_t used = strlen(sentence);
                char value[64];
                (void)fst_params_get(&params, fst_param_find(fst_grid_key(grid, a)), value, sizeof value);
                (void)snprintf(sentence + used, size - used, " %s = %s,", fst_grid_key(grid, a), value);
            }
            const size_t used = strlen(sentence);
            (void)snprintf(sentence + used, size - used, " and maybe at others: %s", why);
            return 1;
        }
    return 0;
}

int fst_grid_contradiction(const fst_grid *grid, char *sentence, size_t size)
{
    fst_params params;
    int64_t point;
    int found = 0;
    for (int64_t i = 0; i <= LOOKS && !found; ++i)
        found = look(grid, i, &point, &params) && fst_bead_contradiction(&params, sentence, size) != 0;
    return found || overlap_along(grid, sentence, size);
}

/* What changes along an axis: seen from the first point and from the last one. */
static fst_scene_change change_along(const fst_grid *grid, int axis)
{
    const int64_t count = fst_grid_axis_points(grid, axis), stride = fst_grid_axis_stride(grid, axis);
    const int64_t corners[2] = {0, fst_grid_points(grid) - 1}, others[3] = {0, 1, count - 1};
    fst_scene_change most = count > 1 ? FST_CHANGE_NOTHING : FST_CHANGE_MOTION;
    for (int k = 0; k < 6 && most != FST_CHANGE_MOTION; ++k) {
        const int64_t corner = corners[k / 3],
                      moved = corner + (others[k % 3] - corner / stride % count) * stride;
        fst_params both[2];
        const int made = fst_grid_params(grid, corner, &both[0], NULL) == FST_OK &&
                         fst_grid_params(grid, moved, &both[1], NULL) == FST_OK;
        const fst_scene_change change = made ? fst_params_changes(&both[0], &both[1]) : FST_CHANGE_MOTION;
        most = change > most ? change : most;
    }
    return most;
}

int fst_grid_idle_axes(const fst_grid *grid, char *sentence, size_t size)
{
    static const char *const formats[FST_CHANGE_MOTION] = {
        "along %.160s the motion does not change: its values are the same, or other keys leave it without "
        "effect",
        "along %.160s only units change: the motion depends on scaled numbers, which other keys fix"};
    char keys[FST_CHANGE_MOTION + 1][160] = {"", "", ""};
    char told[2][280] = {"", ""};
    for (int a = 0; a < fst_grid_axis_count(grid); ++a) {
        char *list = keys[change_along(grid, a)];
        const size_t used = strlen(list);
        (void)snprintf(list + used, sizeof keys[0] - used, "%s%s", used ? " and " : "", fst_grid_key(grid, a));
    }
    for (int i = 0; i < FST_CHANGE_MOTION; ++i)
        if (keys[i][0])
            (void)snprintf(told[i], sizeof told[i], formats[i], keys[i]);
    if (told[0][0] || told[1][0])
        (void)snprintf(sentence, size, "%s%s%s", told[0], told[0][0] && told[1][0] ? "; " : "", told[1]);
    return told[0][0] || told[1][0];
}

int fst_grid_followers(const fst_grid *grid, char *sentence, size_t size)
{
    static const char *const keys[] = {"model.kappa", "bead.remanence", "bead.moment", "magnet.b0"};
    const fst_params *base = fst_grid_base(grid);
    for (int a = 0; a < fst_grid_axis_count(grid); ++a)
        for (size_t k = 0; k < sizeof keys / sizeof *keys; ++k) {
            fst_params params;
            if (fst_grid_params(grid, 0, &params, NULL) != FST_OK ||
                strcmp(fst_grid_key(grid, a), keys[k]) == 0 || !fst_params_takes_back(base, &params, keys[k]))
                continue;
            (void)snprintf(sentence, size, "%s is varied, so that %s follows: the given one does not count",
                           fst_grid_key(grid, a), keys[k]);
            return 1;
        }
    return 0;
}
