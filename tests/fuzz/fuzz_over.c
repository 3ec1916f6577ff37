/* fuzz_over.c - the axes of a sweep, one a line: a refusal has a sentence; an accepted axis keeps to its ends,
 * and every point of an accepted grid has parameters. */
#include <festoon/festoon.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST_TEXT = 4096, MOST_AXES = FST_AXIS_LIMIT + 1, LOOKS = 17 };

static void check_grid(const fst_grid *grid)
{
    const int64_t points = fst_grid_points(grid);
    if (points < 1)
        abort();
    for (int look = 0; look < LOOKS; ++look) {
        const int64_t point = (int64_t)((double)(points - 1) * look / (LOOKS - 1));
        fst_params params;
        fst_error error = {FST_OK, "", ""};
        for (int i = 0; i < fst_grid_axis_count(grid); ++i)
            if (!isfinite(fst_grid_value(grid, i, point)))
                abort();
        if (fst_grid_params(grid, point, &params, &error) != FST_OK)
            abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char text[MOST_TEXT + 1];
    const char *axes[MOST_AXES];
    int count = 0;
    if (size > MOST_TEXT)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    for (char *line = text; count < MOST_AXES;) {
        axes[count++] = line;
        line = strchr(line, '\n');
        if (!line)
            break;
        *line++ = '\0';
    }
    const fst_params base = fst_default_params();
    fst_grid *grid;
    fst_error error = {FST_OK, "", ""};
    if (fst_grid_new(&base, axes, count, 1, &grid, &error) == FST_OK)
        check_grid(grid);
    else if (grid || error.code == FST_OK || !error.sentence[0])
        abort();
    fst_grid_free(grid);
    return 0;
}
