/* sweep_table.c - columns of a sweep's database by point, for figures. */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "io/database.h"

static fst_status damaged(const char *path, fst_error *error)
{
    return fst_fail(error, FST_BAD_INPUT, path, "this sweep database does not say what it is a sweep of");
}

/* The grid, from the scene and the axes in the file. */
static fst_status read_grid(sqlite3 *database, const char *path, fst_grid **grid, fst_error *error)
{
    char *texts[FST_AXIS_LIMIT] = {NULL};
    char *scene = fst_database_text(database, "scene"), *axes = fst_database_text(database, "axes");
    char *seed = fst_database_text(database, "seed");
    const int count = axes ? atoi(axes) : 0;
    int good = scene && seed && count >= 1 && count <= FST_AXIS_LIMIT;
    for (int i = 0; good && i < count; ++i) {
        char key[24];
        (void)snprintf(key, sizeof key, "axis_%d", i + 1);
        texts[i] = fst_database_text(database, key);
        good = texts[i] != NULL;
    }
    fst_params params = fst_default_params();
    fst_status status =
        good ? fst_scene_parse(scene, strlen(scene), path, &params, error) : damaged(path, error);
    if (status == FST_OK)
        status =
            fst_grid_new(&params, (const char *const *)texts, count, strtoull(seed, NULL, 10), grid, error);
    for (int i = 0; i < FST_AXIS_LIMIT; ++i)
        free(texts[i]);
    free(scene);
    free(axes);
    free(seed);
    return status;
}

fst_status fst_sweep_read_grid(const char *path, fst_grid **grid, fst_error *error)
{
    *grid = NULL;
    sqlite3 *database = NULL;
    fst_status status = fst_database_open(path, 0, &database, error);
    if (status == FST_OK)
        status = read_grid(database, path, grid, error);
    (void)sqlite3_close(database);
    return status;
}

static fst_status check_key(const char *key, fst_error *error)
{
    char names[4096] = "regime|symmetry|rhs_calls", nearest[48];
    for (int i = 0; i < fst_result_count(); ++i) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "|%s", fst_result_at(i)->name);
    }
    if (fst_nearest_name(key, names, nearest, sizeof nearest) == 0)
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, "--key", "unknown key \"%.60s\"; the nearest is %s", key, nearest);
}

/* Regimes and symmetries by their number. */
static double number_of(sqlite3_stmt *rows, int column)
{
    if (sqlite3_column_type(rows, column) == SQLITE_NULL)
        return NAN;
    if (sqlite3_column_type(rows, column) != SQLITE_TEXT)
        return sqlite3_column_double(rows, column);
    const char *text = (const char *)sqlite3_column_text(rows, column);
    for (int i = FST_REGIME_UNDECIDED; i <= FST_REGIME_LIFTED; ++i)
        if (strcmp(text, fst_regime_name((fst_regime)i)) == 0)
            return i;
    for (int i = FST_SYMMETRY_S1; i <= FST_SYMMETRY_S2; ++i)
        if (strcmp(text, fst_symmetry_name((fst_symmetry)i)) == 0)
            return i;
    return NAN;
}

static fst_status read_column(sqlite3 *database, const char *path, const char *key, int64_t points,
                              double *values, fst_error *error)
{
    sqlite3_stmt *rows = NULL;
    char *query = sqlite3_mprintf("SELECT point, %s FROM rows", key);
    if (!query)
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    int code = sqlite3_prepare_v2(database, query, -1, &rows, NULL);
    sqlite3_free(query);
    if (code == SQLITE_ERROR)
        return fst_fail(error, FST_BAD_INPUT, path,
                        "this is no database of a sweep: its rows have no column %s", key);
    for (int64_t i = 0; i < points; ++i)
        values[i] = NAN;
    while (code == SQLITE_OK || code == SQLITE_ROW) {
        code = sqlite3_step(rows);
        const int64_t point = code == SQLITE_ROW ? sqlite3_column_int64(rows, 0) : -1;
        if (point >= 0 && point < points)
            values[point] = number_of(rows, 1);
    }
    (void)sqlite3_finalize(rows);
    return code == SQLITE_DONE ? FST_OK : fst_database_fail(database, path, error);
}

fst_status fst_sweep_read(const char *path, const char *const *keys, int count, fst_sweep_table *table,
                          fst_error *error)
{
    memset(table, 0, sizeof *table);
    fst_status status = FST_OK;
    for (int i = 0; i < count && status == FST_OK; ++i)
        status = check_key(keys[i], error);
    sqlite3 *database = NULL;
    if (status == FST_OK)
        status = fst_database_open(path, 0, &database, error);
    if (status != FST_OK)
        return status;
    status = read_grid(database, path, &table->grid, error);
    if (status == FST_OK) {
        const int64_t points = fst_grid_points(table->grid);
        table->values = malloc((size_t)count * (size_t)points * sizeof *table->values);
        if (!table->values)
            status = fst_fail(error, FST_NO_MEMORY, path, "no memory for %lld points", (long long)points);
        for (int i = 0; i < count && status == FST_OK; ++i)
            status = read_column(database, path, keys[i], points, table->values + i * points, error);
    }
    (void)sqlite3_close(database);
    if (status != FST_OK)
        fst_sweep_table_free(table);
    return status;
}

void fst_sweep_table_free(fst_sweep_table *table)
{
    fst_grid_free(table->grid);
    free(table->values);
    memset(table, 0, sizeof *table);
}
