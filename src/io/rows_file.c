/* rows_file.c - writing trajectories: the format by the ending of the name, the units, a file that is whole or absent. */
#include "io/rows_file.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "io/csv.h"
#include "io/load_hdf5.h"
#include "io/text_table.h"

static fst_status no_memory(const char *path, fst_error *error)
{
    return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
}

static int in_other_units(fst_shown_units units)
{
    return units == FST_SHOWN_LAB || units == FST_SHOWN_SI;
}

static fst_status check_name(const char *path, int count, fst_shown_units units, int *hdf5, fst_error *error)
{
    *hdf5 = fst_ends_in(path, ".h5") || fst_ends_in(path, ".hdf5");
    if (*hdf5 && in_other_units(units))
        return fst_fail(error, FST_BAD_INPUT, path, "a trajectory in other than scaled units is a .csv");
    if (!*hdf5 && !fst_ends_in(path, ".csv"))
        return fst_fail(error, FST_BAD_INPUT, path, "the name of a trajectory ends in .h5 or .csv");
    if (!*hdf5 && count > FST_TEXT_CELLS)
        return fst_fail(error, FST_BAD_INPUT, path, "a .csv has no room for %d columns: choose .h5", count);
    return FST_OK;
}

/* Memory for a row, and units other than scaled ones. */
static int prepare(fst_rows_file *file, const fst_params *scene, const fst_column_info *const *columns,
                   fst_shown_units units)
{
    const size_t count = (size_t)file->count;
    file->values = calloc(count, sizeof *file->values);
    if (!in_other_units(units))
        return file->values != NULL;
    const fst_scales scales = fst_scales_of(scene);
    file->factors = calloc(count, sizeof *file->factors);
    file->units = calloc(count, sizeof *file->units);
    for (size_t i = 0; i < count && file->factors && file->units; ++i)
        file->factors[i] = fst_column_shown(columns[i], units, &scales, &file->units[i]);
    return file->values && file->factors && file->units;
}

static fst_status write_head(fst_rows_file *file, const fst_params *scene, int of_beads,
                             const fst_column_info *const *columns, fst_error *error)
{
    char *text = fst_scene_text(scene, 0);
    if (!text)
        return no_memory(file->whole.path, error);
    fst_status status = FST_OK;
    if (file->module)
        status = file->module->create(file->whole.path, columns, file->count, NULL, text, &file->writer, error);
    else
        fst_csv_begin(file->whole.stream, of_beads, text, columns, file->count, file->units);
    free(text);
    return status;
}

fst_status fst_rows_open(fst_rows_file *file, const char *path, const fst_params *scene, int of_beads,
                         const fst_column_info *const *columns, int count, fst_shown_units units,
                         fst_error *error)
{
    int hdf5 = 0;
    *file = (fst_rows_file){.count = count};
    fst_status status = check_name(path, count, units, &hdf5, error);
    if (status == FST_OK && !prepare(file, scene, columns, units))
        status = no_memory(path, error);
    if (status == FST_OK && hdf5)
        status = fst_load_hdf5_module(&file->module, path, error);
    if (status == FST_OK)
        status = fst_whole_file_open(&file->whole, path, error);
    return status == FST_OK ? write_head(file, scene, of_beads, columns, error) : status;
}

fst_status fst_rows_append(fst_rows_file *file, fst_error *error)
{
    for (int i = 0; i < file->count && file->factors; ++i)
        file->values[i] *= file->factors[i];
    if (file->writer)
        return file->module->row(file->writer, file->values, NULL, error);
    fst_csv_row(file->whole.stream, file->values, file->count);
    if (ferror(file->whole.stream))
        return fst_fail(error, FST_IO, file->whole.path, "writing this file failed: is the disk full?");
    return FST_OK;
}

fst_status fst_rows_close(fst_rows_file *file, int has_result, char *line, int complete, fst_error *error)
{
    fst_status status = FST_OK;
    if (has_result && !line) {
        status = no_memory(file->whole.path, error);
    } else if (file->writer) {
        status = file->module->finish(file->writer, line, complete, file->whole.stream, error);
        file->writer = NULL;
    } else {
        fst_csv_end(file->whole.stream, line, complete);
    }
    free(line);
    if (status == FST_OK)
        status = fst_whole_file_commit(&file->whole, error);
    fst_rows_discard(file); /* after a commit nothing is left to remove */
    return status;
}

void fst_rows_discard(fst_rows_file *file)
{
    if (file->writer)
        file->module->abandon(file->writer);
    fst_whole_file_discard(&file->whole);
    free(file->values);
    free(file->factors);
    free(file->units);
    *file = (fst_rows_file){.count = 0};
}
