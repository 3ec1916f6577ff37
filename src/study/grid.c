/* grid.c - the points of a sweep: any number of axes over any parameters.
 *
 * An axis is written KEY=LO:HI:COUNT (both ends included), KEY=LO:HI:COUNT:log, KEY=A,B,C or
 * KEY=LO:HI:random:COUNT. Axes multiply, the last one running fastest; random axes are drawn together and count
 * as one.
 */
#include <festoon/festoon.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "model/params.h"
#include "model/worlds.h"

typedef struct axis {
    const fst_param_info *info;
    int param;
    fst_spacing spaced;
    double least, greatest;
    int64_t count;
    double *list;   /* of a list: its values in SI, or the indices of choices */
    char *text;     /* as it was written */
    int64_t stride; /* points from one value of this axis to the next */
} axis;

struct fst_grid {
    fst_params base;
    axis axes[FST_AXIS_LIMIT];
    int axis_count;
    uint64_t seed;
    int64_t points;
    fst_row_kind kind;
};

/* Where errors say that the fault is. */
#define AXES "fst_grid.axes"

static const int64_t MOST_POINTS = 1000000000;

/* ------------------------------------------------------------------ reading an axis */

enum { PART_SIZE = 64, MOST_PARTS = 4 };

static fst_status wrong_form(const axis *a, fst_error *error)
{
    return fst_fail(
        error, FST_BAD_INPUT, AXES,
        "\"%.100s\" must be KEY=LO:HI:COUNT, KEY=LO:HI:COUNT:log, KEY=A,B,C or KEY=LO:HI:random:COUNT",
        a->text);
}

/* The value of one piece of text in SI, checked as the scene reader would. */
static fst_status read_value(const fst_params *base, const axis *a, const char *text, double *value,
                             fst_error *error)
{
    fst_params trial = *base;
    const fst_status status = fst_params_set(&trial, a->info->key, text, error);
    if (status != FST_OK) {
        if (error)
            (void)snprintf(error->where, sizeof error->where, AXES);
        return status;
    }
    if (a->info->kind == FST_KIND_REAL) {
        memcpy(value, (const char *)&trial + a->info->offset, sizeof *value);
    } else {
        int integer;
        memcpy(&integer, (const char *)&trial + a->info->offset, sizeof integer);
        *value = integer;
    }
    return FST_OK;
}

static fst_status read_count(axis *a, const char *text, fst_error *error)
{
    char *end;
    const long long count = strtoll(text, &end, 10);
    if (end == text || *end || count < 1 || count > MOST_POINTS)
        return fst_fail(error, FST_BAD_INPUT, AXES,
                        "the number of points \"%.40s\" in \"%.100s\" must be an "
                        "integer from 1 to %lld",
                        text, a->text, (long long)MOST_POINTS);
    a->count = count;
    return FST_OK;
}

/* Split at `separator`; the number of parts, or 0 where there are too many or one is too long. */
static int split(const char *text, char separator, char parts[][PART_SIZE], int most)
{
    int count = 0;
    for (;;) {
        const char *end = strchr(text, separator);
        const size_t length = end ? (size_t)(end - text) : strlen(text);
        if (count == most || length >= PART_SIZE)
            return 0;
        memcpy(parts[count], text, length);
        parts[count++][length] = '\0';
        if (!end)
            return count;
        text = end + 1;
    }
}

static fst_status read_list(const fst_params *base, axis *a, const char *text, fst_error *error)
{
    a->spaced = FST_SPACING_LIST;
    a->count = 1;
    for (const char *c = text; *c; ++c)
        a->count += *c == ',';
    a->list = calloc((size_t)a->count, sizeof *a->list);
    if (!a->list)
        return fst_fail(error, FST_NO_MEMORY, AXES, "out of memory");
    for (int64_t i = 0; i < a->count; ++i) {
        char part[PART_SIZE];
        const size_t length = strcspn(text, ",");
        if (length >= sizeof part)
            return wrong_form(a, error);
        memcpy(part, text, length);
        part[length] = '\0';
        const fst_status status = read_value(base, a, part, &a->list[i], error);
        if (status != FST_OK)
            return status;
        text += length + 1;
    }
    return FST_OK;
}

static fst_status check_range(const axis *a, fst_error *error)
{
    if (a->info->kind == FST_KIND_CHOICE)
        return fst_fail(error, FST_BAD_INPUT, AXES, "%s is a choice: list its values, as in %s=A,B",
                        a->info->key, a->info->key);
    if (a->spaced == FST_SPACING_LOG && !(a->least > 0 && a->greatest > 0))
        return fst_fail(error, FST_BAD_INPUT, AXES, "a logarithmic axis needs positive ends: \"%.100s\"",
                        a->text);
    if (a->info->kind == FST_KIND_INT && a->count > 1) {
        const double step = (a->greatest - a->least) / (double)(a->count - 1);
        if (a->spaced != FST_SPACING_LINEAR || step != floor(step))
            return fst_fail(error, FST_BAD_INPUT, AXES,
                            "%s is an integer, and \"%.100s\" has values between the integers: list the values",
                            a->info->key, a->text);
    }
    return FST_OK;
}

static fst_status read_spaced(const fst_params *base, axis *a, const char *text, fst_error *error)
{
    char parts[MOST_PARTS][PART_SIZE];
    const int count = split(text, ':', parts, MOST_PARTS);
    if (count < 3)
        return wrong_form(a, error);
    const char *number = parts[2], *word = count == 4 ? parts[3] : "";
    if (count == 4 && parts[2][0] >= 'a' && parts[2][0] <= 'z') { /* the word may stand before the count */
        number = parts[3];
        word = parts[2];
    }
    if (strcmp(word, "log") == 0)
        a->spaced = FST_SPACING_LOG;
    else if (strcmp(word, "random") == 0)
        a->spaced = FST_SPACING_RANDOM;
    else if (word[0] && strcmp(word, "linear") != 0)
        return fst_fail(error, FST_BAD_INPUT, AXES,
                        "unknown spacing \"%.40s\" in \"%.100s\": linear, log or random", word, a->text);
    fst_status status = read_count(a, number, error);
    if (status == FST_OK)
        status = read_value(base, a, parts[0], &a->least, error);
    if (status == FST_OK)
        status = read_value(base, a, parts[1], &a->greatest, error);
    return status == FST_OK ? check_range(a, error) : status;
}

static fst_status read_axis(fst_grid *grid, const char *text, fst_error *error)
{
    axis *a = &grid->axes[grid->axis_count++];
    a->text = strdup(text);
    if (!a->text)
        return fst_fail(error, FST_NO_MEMORY, AXES, "out of memory");
    const size_t length = strcspn(text, "=");
    if (text[length] != '=')
        return wrong_form(a, error);
    char key[PART_SIZE];
    (void)snprintf(key, sizeof key, "%.*s", (int)(length < sizeof key ? length : sizeof key - 1), text);
    a->param = fst_param_find(key);
    if (a->param < 0) {
        fst_params trial = grid->base;
        (void)fst_params_set(&trial, key, "0", error); /* its sentence names the nearest key */
        if (error)
            (void)snprintf(error->where, sizeof error->where, AXES);
        return FST_BAD_INPUT;
    }
    a->info = fst_param_at(a->param);
    if (a->info->kind == FST_KIND_TEXT)
        return fst_fail(error, FST_BAD_INPUT, AXES, "%s is a text, which a sweep does not vary", key);
    for (int i = 0; i + 1 < grid->axis_count; ++i) {
        const char *other = fst_param_other_form(grid->axes[i].info->key);
        if (grid->axes[i].param == a->param || (other && strcmp(other, key) == 0) ||
            fst_params_clash(&grid->base, grid->axes[i].info->key, key))
            return fst_fail(error, FST_BAD_INPUT, AXES, "%s is varied twice%s", key,
                            grid->axes[i].param == a->param ? "" : ", in both its forms");
    }
    const char *values = text + length + 1;
    return strchr(values, ':') ? read_spaced(&grid->base, a, values, error)
                               : read_list(&grid->base, a, values, error);
}

static const axis *axis_over(const fst_grid *grid, const char *key)
{
    for (int i = 0; i < grid->axis_count; ++i)
        if (strcmp(grid->axes[i].info->key, key) == 0)
            return &grid->axes[i];
    return NULL;
}

/* Axes along which all rows would be alike are mistakes. */
static fst_status check_effects(const fst_grid *grid, fst_error *error)
{
    if (axis_over(grid, "run.samples"))
        return fst_fail(error, FST_BAD_INPUT, AXES,
                        "run.samples concerns written trajectories only and changes nothing in a row");
    if (axis_over(grid, "plate.tilt_azimuth") && grid->base.plate_tilt == 0 && !axis_over(grid, "plate.tilt"))
        return fst_fail(error, FST_BAD_INPUT, AXES,
                        "plate.tilt_azimuth has no effect with this plate.tilt: give one");
    for (int i = 0; i < grid->axis_count; ++i) {
        const int bead = fst_param_bead(grid->axes[i].param);
        if (bead >= grid->base.bead_count)
            return fst_fail(error, FST_BAD_INPUT, AXES, "%s: the scene lists %d beads: list this one too",
                            grid->axes[i].info->key, grid->base.bead_count);
        const char *key = grid->axes[i].info->key, *of,
                   *choice = fst_param_missing_choice(&grid->base, key, &of);
        if (choice && !axis_over(grid, of))
            return fst_fail(error, FST_BAD_INPUT, AXES, "%s has no effect with this %s: choose %s", key, of,
                            choice);
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ the grid */

/* Strides of the axes, the last one fastest; random axes share the stride of the last of them. */
static fst_status lay_out(fst_grid *grid, fst_error *error)
{
    const axis *drawn = NULL;
    grid->points = 1;
    for (int i = grid->axis_count - 1; i >= 0; --i) {
        axis *a = &grid->axes[i];
        if (a->spaced == FST_SPACING_RANDOM && drawn) {
            if (a->count != drawn->count)
                return fst_fail(
                    error, FST_BAD_INPUT, AXES,
                    "random axes are drawn together and need the same count: \"%.100s\" and \"%.100s\"",
                    a->text, drawn->text);
            a->stride = drawn->stride;
            continue;
        }
        if (a->spaced == FST_SPACING_RANDOM)
            drawn = a;
        a->stride = grid->points;
        if (a->count > MOST_POINTS / grid->points)
            return fst_fail(error, FST_BAD_INPUT, AXES, "the axes make more than %lld points",
                            (long long)MOST_POINTS);
        grid->points *= a->count;
    }
    return FST_OK;
}

/* Whether a point has a world.  What makes one are keys that differ from the plate's values, so that three values of an
 * evenly spaced axis show it, with the first values of the others. */
static int has_worlds(const fst_grid *grid)
{
    enum { SHOW = 3 };
    fst_params params;
    for (int i = 0; i < grid->axis_count; ++i) {
        const axis *a = &grid->axes[i];
        const int64_t count = a->list || a->count < SHOW ? a->count : SHOW;
        for (int64_t k = 0; k < count; ++k)
            if (fst_grid_params(grid, k * a->stride, &params, NULL) == FST_OK && fst_key_of_world(&params))
                return 1;
    }
    return 0;
}

fst_row_kind fst_grid_row_kind(const fst_grid *grid)
{
    return grid->kind;
}

fst_status fst_grid_ask_levitation(fst_grid *grid, fst_error *error)
{
    if (grid->base.bead_count || grid->base.plate_shape != FST_PLATE_NONE)
        return fst_fail(error, FST_BAD_INPUT, "plate.shape",
                        "a bead levitates alone and without a plate: choose plate.shape none");
    grid->kind = FST_ROWS_OF_LEVITATION;
    return FST_OK;
}

fst_status fst_grid_new(const fst_params *base, const char *const *axes, int count, uint64_t seed,
                        fst_grid **grid, fst_error *error)
{
    *grid = NULL;
    if (count < 1 || count > FST_AXIS_LIMIT)
        return fst_fail(error, FST_BAD_INPUT, AXES,
                        "a sweep needs 1 to %d axes, as in "
                        "drive.frequency=5Hz:20Hz:31; there are %d",
                        FST_AXIS_LIMIT, count);
    fst_grid *made = calloc(1, sizeof *made);
    if (!made)
        return fst_fail(error, FST_NO_MEMORY, AXES, "out of memory");
    made->base = *base;
    made->seed = seed;
    fst_status status = fst_params_settle(&made->base, error);
    for (int i = 0; i < count && status == FST_OK; ++i)
        status = read_axis(made, axes[i], error);
    if (status == FST_OK)
        status = check_effects(made, error);
    if (status == FST_OK)
        status = lay_out(made, error);
    if (status != FST_OK) {
        fst_grid_free(made);
        return status;
    }
    made->kind = made->base.bead_count ? FST_ROWS_OF_BEADS
                 : has_worlds(made)    ? FST_ROWS_OF_WORLDS
                                       : FST_ROWS_OF_RUNS;
    *grid = made;
    return FST_OK;
}

void fst_grid_free(fst_grid *grid)
{
    if (!grid)
        return;
    for (int i = 0; i < grid->axis_count; ++i) {
        free(grid->axes[i].list);
        free(grid->axes[i].text);
    }
    free(grid);
}

int64_t fst_grid_points(const fst_grid *grid)
{
    return grid->points;
}

int fst_grid_axis_count(const fst_grid *grid)
{
    return grid->axis_count;
}

const char *fst_grid_key(const fst_grid *grid, int index)
{
    return grid->axes[index].info->key;
}

const char *fst_grid_axis_text(const fst_grid *grid, int index)
{
    return grid->axes[index].text;
}

int64_t fst_grid_axis_points(const fst_grid *grid, int index)
{
    return grid->axes[index].count;
}

int64_t fst_grid_axis_stride(const fst_grid *grid, int index)
{
    return grid->axes[index].stride;
}

fst_spacing fst_grid_axis_spacing(const fst_grid *grid, int index)
{
    return grid->axes[index].spaced;
}

const fst_params *fst_grid_base(const fst_grid *grid)
{
    return &grid->base;
}

/* A number in [0, 1[ that depends on seed, axis and index alone (splitmix64; Steele, Lea, Flood 2014). */
static double uniform(uint64_t seed, int axis_index, int64_t index)
{
    uint64_t z = seed + 0x9e3779b97f4a7c15u * ((uint64_t)index * FST_AXIS_LIMIT + (uint64_t)axis_index + 1u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return (double)(z >> 11) / 9007199254740992.0;
}

/* Logarithmic points are rounded to 15 digits, so that the last bit of a machine's pow() does not matter. */
static double logarithmic(const axis *a, int64_t index)
{
    char text[40];
    const double value = a->least * pow(a->greatest / a->least, (double)index / (double)(a->count - 1));
    const fst_c_locale locale = fst_c_locale_enter();
    (void)snprintf(text, sizeof text, "%.14e", value);
    fst_c_locale_leave(locale);
    return fst_number_read(text, strlen(text), 0);
}

double fst_grid_value(const fst_grid *grid, int axis_index, int64_t point)
{
    const axis *a = &grid->axes[axis_index];
    const int64_t index = point / a->stride % a->count;
    if (a->spaced == FST_SPACING_LIST)
        return a->list[index];
    if (a->spaced == FST_SPACING_RANDOM)
        return a->least + (a->greatest - a->least) * uniform(grid->seed, axis_index, index);
    if (index == 0)
        return a->least;
    if (index == a->count - 1)
        return a->greatest;
    if (a->spaced == FST_SPACING_LOG)
        return logarithmic(a, index);
    return a->least + (a->greatest - a->least) * ((double)index / (double)(a->count - 1));
}

fst_status fst_grid_params(const fst_grid *grid, int64_t point, fst_params *params, fst_error *error)
{
    *params = grid->base;
    for (int i = 0; i < grid->axis_count; ++i) {
        const axis *a = &grid->axes[i];
        const double value = fst_grid_value(grid, i, point);
        char text[64];
        if (a->info->kind == FST_KIND_CHOICE) {
            fst_params named = grid->base;
            const int choice = (int)value;
            memcpy((char *)&named + a->info->offset, &choice, sizeof choice);
            (void)fst_params_get(&named, a->param, text, sizeof text);
        } else {
            (void)fst_number_write(text, sizeof text, value);
        }
        const fst_status status = fst_params_set(params, a->info->key, text, error);
        if (status != FST_OK)
            return status;
    }
    return FST_OK;
}
