/* map_points.c - from samples in any order to the rectangular grid that they fill.
 *
 * The distinct values of a coordinate, sorted, must be evenly spaced; each sample then has one place in the
 * grid, and each place must have one sample.  Coordinates are rounded as people write them: values that differ
 * by less than a ten thousandth of the spacing are one value.
 */
#include "io/map_points.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"

static const char AXES[] = "xyz";

enum { ASK_EVERY = 4096 }; /* rows between two questions whether to go on */

fst_status fst_map_points_add(fst_map_points *p, const double row[MAP_COLUMNS], size_t number)
{
    if (p->count == p->room) {
        const size_t room = p->room ? 2 * p->room : 4096;
        double(*rows)[MAP_COLUMNS] = realloc(p->rows, room * sizeof *rows);
        if (rows)
            p->rows = rows;
        size_t *numbers = rows ? realloc(p->numbers, room * sizeof *numbers) : NULL;
        if (!numbers)
            return fst_fail(p->error, FST_NO_MEMORY, p->path, "no memory for %zu samples", room);
        p->numbers = numbers;
        p->room = room;
    }
    memcpy(p->rows[p->count], row, sizeof *p->rows);
    p->numbers[p->count++] = number;
    return p->count % ASK_EVERY ? FST_OK : fst_tell(p->progress, 0.0, "reading the map", p->error);
}

void fst_map_points_free(fst_map_points *points)
{
    free(points->rows);
    free(points->numbers);
    points->rows = NULL;
    points->numbers = NULL;
}

fst_status fst_map_points_fail(const fst_map_points *points, size_t number, const char *format, ...)
{
    char where[256], sentence[600];
    va_list values;
    va_start(values, format);
    (void)vsnprintf(sentence, sizeof sentence, format, values);
    va_end(values);
    (void)snprintf(where, sizeof where, strcmp(points->called, "line") ? "%.200s, %.20s %zu" : "%.200s:%.0s%zu",
                   points->path, points->called, number);
    return fst_fail(points->error, FST_BAD_INPUT, where, "%s", sentence);
}

fst_status fst_map_points_refuse(const fst_map_points *points, const char *format, ...)
{
    char sentence[600];
    va_list values;
    va_start(values, format);
    (void)vsnprintf(sentence, sizeof sentence, format, values);
    va_end(values);
    return fst_fail(points->error, FST_BAD_INPUT, points->path, "%s", sentence);
}

/* ------------------------------------------------------------------ one axis */

typedef struct map_axis {
    int count;
    double first, spacing;
} map_axis;

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The row whose coordinate is nearest to a value. */
static size_t row_at(const fst_map_points *p, int column, double value)
{
    size_t nearest = 0;
    for (size_t i = 1; i < p->count; ++i)
        if (fabs(p->rows[i][column] - value) < fabs(p->rows[nearest][column] - value))
            nearest = i;
    return nearest;
}

/* Find the distinct values among the sorted ones, which they replace; returns their number. */
static size_t merge(double *sorted, size_t count)
{
    /* Values closer than this are one: no grid has more than a million lines. */
    const double same = 1e-7 * (sorted[count - 1] - sorted[0]);
    size_t distinct = 1;
    for (size_t i = 1; i < count; ++i)
        if (sorted[i] - sorted[distinct - 1] > same)
            sorted[distinct++] = sorted[i];
    return distinct;
}

/* Check that the distinct values are evenly spaced. */
static fst_status measure_axis(const fst_map_points *p, int column, const double *values, size_t count,
                               map_axis *axis)
{
    axis->count = (int)count;
    axis->first = values[0];
    axis->spacing = count > 1 ? (values[count - 1] - values[0]) / (double)(count - 1) : 0.0;
    for (size_t i = 1; i < count; ++i) {
        const double step = values[i] - values[i - 1];
        if (fabs(step - axis->spacing) <= 1e-4 * axis->spacing)
            continue;
        /* A line that is missing doubles a step: the usual step says more than the mean one. */
        const double usual = fabs(values[1] - values[0]);
        return fst_map_points_fail(p, p->numbers[row_at(p, column, values[i])],
                                   "the samples are unevenly spaced along %c: %.9g mm follows on %.9g mm, %.6g "
                                   "mm further, where the first "
                                   "step is %.6g mm: a map is a full rectangular grid of equal steps",
                                   AXES[column], 1e3 * values[i], 1e3 * values[i - 1], 1e3 * step, 1e3 * usual);
    }
    return FST_OK;
}

static fst_status find_axis(const fst_map_points *p, int column, double *room, map_axis *axis)
{
    size_t told = 0;
    for (size_t i = 0; i < p->count; ++i)
        if (!isnan(p->rows[i][column]))
            room[told++] = p->rows[i][column];
    if (told == 0) { /* a map that does not tell its height */
        *axis = (map_axis){1, NAN, 0.0};
        return FST_OK;
    }
    qsort(room, told, sizeof *room, compare);
    return measure_axis(p, column, room, merge(room, told), axis);
}

/* ------------------------------------------------------------------ the grid */

static size_t place_of(const double row[MAP_COLUMNS], const map_axis axes[3])
{
    size_t place = 0;
    for (int axis = 2; axis >= 0; --axis) {
        const long index =
            axes[axis].count > 1 ? lround((row[axis] - axes[axis].first) / axes[axis].spacing) : 0;
        place = place * (size_t)axes[axis].count + (size_t)index;
    }
    return place;
}

/* Say where the first hole is. */
static fst_status tell_hole(const fst_map_points *p, const map_axis axes[3], const size_t *rows, size_t places)
{
    size_t hole = 0;
    while (hole < places && rows[hole])
        ++hole;
    size_t rest = hole;
    double at[3];
    for (int axis = 0; axis < 3; ++axis) {
        at[axis] = axes[axis].first + (double)(rest % (size_t)axes[axis].count) * axes[axis].spacing;
        rest /= (size_t)axes[axis].count;
    }
    char height[48] = "";
    if (axes[2].count > 1)
        (void)snprintf(height, sizeof height, ", z = %.7g mm", 1e3 * at[2]);
    return fst_fail(p->error, FST_BAD_INPUT, p->path,
                    "the map has a hole: the %zu samples fill a grid of %d x %d x %d but for %zu of its "
                    "places, and there is "
                    "none at x = %.7g mm, y = %.7g mm%s",
                    p->count, axes[0].count, axes[1].count, axes[2].count, places - p->count, 1e3 * at[0],
                    1e3 * at[1], height);
}

/* Put the samples in order, and make the map. */
static fst_status fill_grid(const fst_map_points *p, const map_axis axes[3], size_t *rows, double *b,
                            fst_field_map **map)
{
    const size_t places = (size_t)axes[0].count * (size_t)axes[1].count * (size_t)axes[2].count;
    for (size_t i = 0; i < p->count; ++i) {
        const size_t place = place_of(p->rows[i], axes);
        if (rows[place])
            return fst_map_points_fail(
                p, p->numbers[i], "this sample at x = %.7g mm, y = %.7g mm is there twice: first as %s %zu",
                1e3 * p->rows[i][MAP_X], 1e3 * p->rows[i][MAP_Y], p->called, p->numbers[rows[place] - 1]);
        rows[place] = i + 1;
        memcpy(&b[3 * place], &p->rows[i][MAP_BX], 3 * sizeof *b);
    }
    if (p->count < places)
        return tell_hole(p, axes, rows, places);
    fst_field_samples samples = {.b = b};
    for (int axis = 0; axis < 3; ++axis) {
        samples.count[axis] = axes[axis].count;
        samples.first[axis] = axes[axis].first;
        samples.spacing[axis] = axes[axis].spacing;
    }
    const fst_status status = fst_field_map_new(&samples, p->progress, map, p->error);
    if (status == FST_BAD_INPUT && p->error)
        (void)snprintf(p->error->where, sizeof p->error->where, "%.250s", p->path);
    return status;
}

fst_status fst_map_points_arrange(const fst_map_points *p, fst_field_map **map)
{
    map_axis axes[3];
    *map = NULL;
    if (p->count == 0)
        return fst_fail(p->error, FST_BAD_INPUT, p->path, "this map has no samples");
    double *room = malloc(p->count * sizeof *room), *b = NULL;
    size_t *rows = NULL;
    fst_status status = room ? FST_OK : FST_NO_MEMORY;
    for (int axis = 0; axis < 3 && status == FST_OK; ++axis)
        status = find_axis(p, axis, room, &axes[axis]);
    double places = 1.0;
    for (int axis = 0; axis < 3 && status == FST_OK; ++axis)
        places *= axes[axis].count;
    /* Half of the places empty: these were never meant to be a grid. */
    if (status == FST_OK && places > 2.0 * (double)p->count)
        status = fst_fail(
            p->error, FST_BAD_INPUT, p->path,
            "the %zu samples are at %d different x, %d different y and %d different z: a map is a full "
            "rectangular grid",
            p->count, axes[0].count, axes[1].count, axes[2].count);
    if (status == FST_OK) {
        rows = calloc((size_t)places, sizeof *rows);
        b = calloc((size_t)places, 3 * sizeof *b);
        status = rows && b ? fill_grid(p, axes, rows, b, map) : FST_NO_MEMORY;
    }
    if (status == FST_NO_MEMORY)
        (void)fst_fail(p->error, FST_NO_MEMORY, p->path, "no memory for %zu samples", p->count);
    free(room);
    free(rows);
    free(b);
    return status;
}
