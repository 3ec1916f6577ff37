/* filled.c - the values of a refined sweep between its points, as figures show them.
 *
 * The rows are told to the refinement again, which makes the cells that the sweep had.
 */
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "sweep/refined.h"

/* Find the cells that the rows make. */
static fst_status replay(fst_refinement *r, const fst_sweep_table *table, const double *values,
                         fst_error *error)
{
    fst_status status = FST_OK;
    int64_t point;
    while (status == FST_OK && fst_refinement_next(r, &point))
        if (table->computed[point])
            status = fst_refinement_note(r, point, values[point], error);
    return status;
}

typedef struct filling {
    const fst_sweep_table *table;
    double *values; /* of the key that is filled in */
    int names;      /* its values are names: they are never between two others */
} filling;

/* The value at a place of a cell, from those of its corners; NAN where it does not follow from them. */
static double value_between(const filling *f, const fst_refined_cell *c, const int64_t at[FST_REFINED_AXES])
{
    double sum = 0.0;
    const double first = f->values[c->corners[0]];
    for (int i = 0; i < 1 << c->axes; ++i) {
        const double value = f->values[c->corners[i]];
        double weight = 1.0;
        for (int a = 0; a < c->axes; ++a) {
            const double part = (double)at[a] / (double)c->lengths[a];
            weight *= i >> a & 1 ? part : 1.0 - part;
        }
        if (isnan(value) || (f->names && value != first))
            return NAN;
        sum += weight * value;
    }
    return f->names ? first : sum;
}

static void fill_cell(void *user, const fst_refined_cell *c)
{
    const filling *f = user;
    int64_t at[FST_REFINED_AXES] = {0}, point = c->corners[0];
    for (int a = 0; a < c->axes;) {
        const double value = f->table->computed[point] ? NAN : value_between(f, c, at);
        if (!isnan(value)) /* on an edge the cell on its other side may know the value alone */
            f->values[point] = value;
        for (a = 0; a < c->axes && at[a] == c->lengths[a]; ++a) { /* the next place, as a counter counts */
            point -= at[a] * c->strides[a];
            at[a] = 0;
        }
        if (a < c->axes) {
            at[a] += 1;
            point += c->strides[a];
        }
    }
}

/* Fill in one key, where the table has `by`, the key by which the sweep was refined. */
static fst_status fill_key(const fst_refining *refining, const double *by, int names, double *values,
                           const fst_sweep_table *table, fst_error *error)
{
    fst_refinement *r;
    fst_status status = fst_refinement_new(table->grid, refining->levels, refining->step, &r, error);
    if (status != FST_OK)
        return status;
    status = replay(r, table, by, error);
    filling f = {table, values, names};
    if (status == FST_OK)
        fst_refinement_tell_cells(r, fill_cell, &f);
    fst_refinement_free(r);
    return status;
}

fst_status fst_sweep_read_filled(const char *path, const char *const *keys, int count, fst_sweep_table *table,
                                 fst_error *error)
{
    const char *all[FST_SWEEP_FILLED_KEYS + 1];
    memset(table, 0, sizeof *table);
    if (count > FST_SWEEP_FILLED_KEYS)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_read.keys", "at most %d keys are filled in",
                        FST_SWEEP_FILLED_KEYS);
    fst_refining refining;
    fst_sweep_file file;
    fst_status status = fst_sweep_file_open(path, 0, &file, error);
    if (status == FST_OK)
        status = fst_refining_read(&file.lines, path, &refining, error);
    fst_sweep_file_close(&file);
    if (status != FST_OK || refining.levels == 0)
        return status == FST_OK ? fst_sweep_read(path, keys, count, table, error) : status;
    memcpy(all, keys, (size_t)count * sizeof *all);
    all[count] = refining.key;
    status = fst_sweep_read(path, all, count + 1, table, error);
    const int64_t points = status == FST_OK ? fst_grid_points(table->grid) : 0;
    const double *by = table->values + count * points;
    for (int i = 0; i < count && status == FST_OK; ++i)
        status =
            fill_key(&refining, by, fst_sweep_has_names(keys[i]), table->values + i * points, table, error);
    if (status != FST_OK)
        fst_sweep_table_free(table);
    return status;
}
