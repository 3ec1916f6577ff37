/* trajectory.c - files of trajectories of one bead on the plate, in CSV and HDF5. */
#include <festoon/festoon_tools.h>

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "host/regular_file.h"
#include "io/columns.h"
#include "io/csv.h"
#include "io/hdf5_module.h"
#include "io/json.h"
#include "io/load_hdf5.h"
#include "io/rows_file.h"

struct fst_trajectory {
    fst_params params;
    const fst_column_info *columns[FST_COLUMN_COUNT];
    fst_rows_file file;
};

static void list_columns(const fst_column_info *columns[FST_COLUMN_COUNT])
{
    for (int i = 0; i < FST_COLUMN_COUNT; ++i)
        columns[i] = fst_column_at(i);
}

/* ---------------------------------------------------------------- writing */

fst_status fst_trajectory_create(const char *path, const fst_params *params, fst_trajectory **out,
                                 fst_error *error)
{
    return fst_trajectory_create_in(path, params, FST_SHOWN_SCALED, out, error);
}

fst_status fst_trajectory_create_in(const char *path, const fst_params *params, fst_shown_units units,
                                    fst_trajectory **out, fst_error *error)
{
    *out = NULL;
    fst_trajectory *trajectory = calloc(1, sizeof *trajectory);
    if (!trajectory)
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    trajectory->params = *params;
    list_columns(trajectory->columns);
    const fst_status status = fst_rows_open(&trajectory->file, path, &trajectory->params, 0,
                                            trajectory->columns, FST_COLUMN_COUNT, units, error);
    if (status == FST_OK)
        *out = trajectory;
    else
        fst_trajectory_discard(trajectory);
    return status;
}

fst_status fst_trajectory_append(fst_trajectory *trajectory, const fst_sample *sample, fst_error *error)
{
    const double *values = trajectory->file.values;
    fst_column_values(sample, trajectory->file.values);
    /* The reader below refuses such a number, so it must not be written. */
    for (int i = 0; i < FST_COLUMN_COUNT; ++i)
        if (!isfinite(values[i]))
            return fst_fail(error, FST_BAD_INPUT, trajectory->file.whole.path,
                            "this sample is not written: its %s is %g, and a trajectory holds finite numbers",
                            fst_column_at(i)->name, values[i]);
    return fst_rows_append(&trajectory->file, error);
}

fst_status fst_trajectory_close(fst_trajectory *trajectory, const fst_run_result *result, int complete,
                                fst_error *error)
{
    char *line = result ? fst_result_line(&trajectory->params, result) : NULL;
    const fst_status status = fst_rows_close(&trajectory->file, result != NULL, line, complete, error);
    free(trajectory);
    return status;
}

void fst_trajectory_discard(fst_trajectory *trajectory)
{
    if (!trajectory)
        return;
    fst_rows_discard(&trajectory->file);
    free(trajectory);
}

/* ---------------------------------------------------------------- reading */

fst_status fst_look_for_hdf5(const char *path, int *is_hdf5, fst_error *error)
{
    static const char signature[8] = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
    char begin_bytes[8];
    int descriptor;
    const fst_status status = fst_open_regular(path, &descriptor, error);
    if (status != FST_OK)
        return status;
    const ssize_t got = fst_read_at(descriptor, begin_bytes, sizeof begin_bytes, 0);
    const int reason = errno;
    (void)close(descriptor);
    *is_hdf5 = got == sizeof begin_bytes && memcmp(begin_bytes, signature, sizeof signature) == 0;
    return got < 0 ? fst_fail(error, FST_IO, path, "reading this file failed: %s", strerror(reason)) : FST_OK;
}

static fst_status read_hdf5(const char *path, fst_table *table, fst_error *error)
{
    const fst_hdf5_module_table *module;
    const fst_column_info *columns[FST_COLUMN_COUNT];
    char *scene = NULL, *bytes;
    size_t size;
    fst_status status = fst_load_hdf5_file(&module, path, &bytes, &size, error);
    if (status != FST_OK)
        return status;
    list_columns(columns);
    status = module->read(path, bytes, size, columns, FST_COLUMNS_BEFORE_FLIGHTS, FST_COLUMN_COUNT,
                          table->columns, &table->rows, &scene, NULL, &table->complete, error);
    if (status == FST_OK)
        status = fst_scene_parse(scene, strlen(scene), path, &table->params, error);
    else if (scene && fst_scene_parse(scene, strlen(scene), path, &table->params, NULL) == FST_OK &&
             (table->params.bead_count || fst_key_of_world(&table->params)))
        status = fst_fail(error, FST_BAD_INPUT, path,
                          "this is a trajectory of several beads or of a world, and one of a bead on the plate "
                          "is wanted here");
    free(bytes);
    free(scene);
    return status;
}

static fst_status read_csv(const char *path, fst_table *table, fst_error *error)
{
    fst_text text;
    fst_status status = fst_text_read(&text, path, SIZE_MAX / 8, error);
    if (status == FST_OK)
        status = fst_csv_read(&text, table, error);
    fst_text_free(&text);
    return status;
}

/* Every number of a trajectory must be finite: "nan" and "inf" come from another program, or from damage.  (The
 * CSV reader makes the same check, because it can name the line.) */
static fst_status check_numbers(const char *path, const fst_table *table, fst_error *error)
{
    for (int i = 0; i < FST_COLUMN_COUNT; ++i)
        for (size_t row = 0; row < table->rows; ++row)
            if (!isfinite(table->columns[i][row]))
                return fst_fail(error, FST_BAD_INPUT, path,
                                "row %zu: the column %s holds \"%g\", which is not finite: every number of a "
                                "trajectory is",
                                row + 1, fst_column_at(i)->name, table->columns[i][row]);
    return FST_OK;
}

/* Times and turns of the drive must rise: figures and films count on it. */
static fst_status check_order(const char *path, const fst_table *table, fst_error *error)
{
    static const int rising[] = {FST_COLUMN_t, FST_COLUMN_drive_turns};
    for (size_t i = 0; i < sizeof rising / sizeof *rising; ++i) {
        const double *values = table->columns[rising[i]];
        for (size_t row = 0; row < table->rows; ++row)
            if (!(fabs(values[row]) < 1e15) || (row > 0 && !(values[row] >= values[row - 1])))
                return fst_fail(error, FST_BAD_INPUT, path,
                                "row %zu: the column %s does not rise, as it must in a trajectory", row + 1,
                                fst_column_at(rising[i])->name);
    }
    return FST_OK;
}

/* The map of the scene, where it was or beside the trajectory.  Most uses of a trajectory need
 * no map; one that does says that it was not found. */
static void find_map(const char *path, fst_table *table)
{
    fst_params beside = table->params;
    const char *slash = strrchr(path, '/'), *name = strrchr(table->params.magnet_file, '/');
    if (fst_params_read_map(&table->params, NULL, &table->map, NULL) == FST_OK)
        return;
    const int length =
        snprintf(beside.magnet_file, sizeof beside.magnet_file, "%.*s%s", slash ? (int)(slash + 1 - path) : 0,
                 path, name ? name + 1 : table->params.magnet_file);
    if (length > 0 && (size_t)length < sizeof beside.magnet_file &&
        fst_params_read_map(&beside, NULL, &table->map, NULL) == FST_OK)
        table->params.magnet_map = table->map;
}

fst_status fst_trajectory_read(const char *path, fst_table *table, fst_error *error)
{
    *table = (fst_table){.params = fst_default_params()};
    int is_hdf5 = 0;
    fst_status status = fst_look_for_hdf5(path, &is_hdf5, error);
    if (status != FST_OK)
        return status;
    table->columns = calloc(FST_COLUMN_COUNT, sizeof *table->columns);
    if (!table->columns)
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    status = is_hdf5 ? read_hdf5(path, table, error) : read_csv(path, table, error);
    if (status == FST_OK)
        status = check_numbers(path, table, error);
    if (status == FST_OK)
        status = check_order(path, table, error);
    if (status == FST_OK)
        find_map(path, table);
    else
        fst_table_free(table);
    return status;
}

void fst_table_free(fst_table *table)
{
    for (int i = 0; table->columns && i < FST_COLUMN_COUNT; ++i)
        free(table->columns[i]);
    free(table->columns);
    fst_field_map_free(table->map);
    *table = (fst_table){.rows = 0};
}
