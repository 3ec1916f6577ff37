/* table.c - columns of a sweep's database in the order of the points, for figures. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "sweep/columns.h"
#include "sweep/refined.h"
#include "sweep/sweep.h"

fst_status fst_sweep_read_grid(const char *path, fst_grid **grid, fst_error *error)
{
    fst_sweep_file file;
    const fst_status status = fst_sweep_file_open(path, 0, &file, error);
    *grid = status == FST_OK ? file.grid : NULL;
    const int kept = *grid != NULL;
    if (kept)
        file.grid = NULL;
    fst_sweep_file_close(&file);
    return status;
}

/* Read all rows, or fail: a figure cannot show that some are lost. */
static fst_status read_rows(const fst_sweep_file *file, const char *const *keys, int count,
                            fst_sweep_table *table, fst_error *error)
{
    const int64_t points = fst_grid_points(file->grid);
    int more = 0, *places = calloc((size_t)count + 1, sizeof *places);
    fst_sweep_rows rows;
    fst_status status = fst_sweep_rows_begin(&rows, file, error);
    if (!places && status == FST_OK)
        status = fst_fail(error, FST_NO_MEMORY, file->name, "out of memory");
    for (int i = 0; i < count && status == FST_OK; ++i)
        status = fst_sweep_find(rows.row, keys[i], file->name, &places[i], error);
    while (status == FST_OK && (status = fst_sweep_rows_next(&rows, &more, error)) == FST_OK && more) {
        table->computed[rows.next - 1] = 1;
        for (int i = 0; i < count; ++i)
            table->values[i * points + rows.next - 1] = fst_sweep_number(rows.row, places[i]);
    }
    table->rows = rows.sound;
    if (status == FST_OK && !fst_sweep_rows_are_whole(&rows))
        status = fst_sweep_rows_fail(&rows, "", error);
    fst_sweep_rows_end(&rows);
    free(places);
    return status;
}

static fst_status read_values(const fst_sweep_file *file, const char *const *keys, int count,
                              fst_sweep_table *table, fst_error *error)
{
    const int64_t points = fst_grid_points(table->grid), all = count * points;
    table->values = malloc((size_t)all * sizeof *table->values + 1);
    table->computed = calloc((size_t)points, 1);
    if (!table->values || !table->computed)
        return fst_fail(error, FST_NO_MEMORY, file->name, "no memory for %lld points", (long long)points);
    for (int64_t i = 0; i < all; ++i)
        table->values[i] = NAN;
    return read_rows(file, keys, count, table, error);
}

fst_status fst_sweep_read(const char *path, const char *const *keys, int count, fst_sweep_table *table,
                          fst_error *error)
{
    memset(table, 0, sizeof *table);
    fst_status status = FST_OK;
    fst_sweep_file file;
    fst_refining refining;
    status = fst_sweep_file_open(path, 0, &file, error);
    for (int i = 0; i < count && status == FST_OK; ++i)
        status = fst_sweep_check_key(file.grid, keys[i], "fst_sweep_read.keys", error);
    if (status == FST_OK)
        status = fst_refining_read(&file.lines, path, &refining, error);
    if (status == FST_OK) {
        table->refine = refining.levels;
        table->wanted = fst_sweep_point_count(&file.identity);
        table->carry = file.identity.carry;
        table->at_work = file.at_work;
        table->grid = file.grid;
        status = read_values(&file, keys, count, table, error);
        file.grid = status == FST_OK ? NULL : file.grid;
        table->grid = status == FST_OK ? table->grid : NULL;
    }
    fst_sweep_file_close(&file);
    if (status != FST_OK)
        fst_sweep_table_free(table);
    return status;
}

void fst_sweep_table_free(fst_sweep_table *table)
{
    fst_grid_free(table->grid);
    free(table->values);
    free(table->computed);
    memset(table, 0, sizeof *table);
}
