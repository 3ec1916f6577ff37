/* export_keys.c - chosen columns of a sweep as CSV, in the units that a person wants.
 *
 * A column's name has its unit behind it, as in "mean_r [mm]".  The scaled units are those of each point,
 * because a sweep may vary them.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "host/whole_file.h"
#include "sweep/file.h"

typedef struct table_writer {
    const char *const *keys;
    int count;
    fst_shown_units units;
    fst_sweep_table table;
    FILE *stream;
} table_writer;

/* ------------------------------------------------------------------ units */

/* The unit of a parameter.  *shift: the power of ten by which a value in SI is more in it. */
static const char *parameter_unit(const fst_param_info *info, fst_shown_units units, int *shift)
{
    static const struct {
        fst_unit kind;
        const char *name;
    } lab[] = {{FST_UNIT_LENGTH, "mm"}, {FST_UNIT_MASS, "g"}, {FST_UNIT_FIELD, "mT"}};
    *shift = 0;
    if (info->kind != FST_KIND_REAL)
        return "1";
    for (size_t i = 0; units == FST_SHOWN_LAB && i < sizeof lab / sizeof *lab; ++i)
        if (info->unit == lab[i].kind) {
            *shift = 3;
            return lab[i].name;
        }
    return fst_unit_name(info->unit);
}

/* The scaled unit of a result; "1" for what is no number of a run. */
static const char *unit_of_result(const char *key)
{
    for (int i = 0; i < fst_result_count(); ++i)
        if (strcmp(fst_result_at(i)->name, key) == 0)
            return fst_result_at(i)->unit;
    return "1";
}

static void write_name(FILE *out, const char *name, const char *unit)
{
    if (strcmp(unit, "1") == 0)
        (void)fputs(name, out);
    else
        (void)fprintf(out, "%s [%s]", name, unit);
}

/* ------------------------------------------------------------------ rows */

static void write_head(const table_writer *w, const fst_scales *scales)
{
    const fst_grid *grid = w->table.grid;
    const char *unit;
    int shift;
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const char *key = fst_grid_key(grid, i);
        write_name(w->stream, key, parameter_unit(fst_param_at(fst_param_find(key)), w->units, &shift));
        (void)fputc(',', w->stream);
    }
    for (int i = 0; i < w->count; ++i) {
        (void)fst_unit_shown(unit_of_result(w->keys[i]), w->units, scales, &unit);
        write_name(w->stream, w->keys[i], unit);
        (void)fputc(i + 1 < w->count ? ',' : '\n', w->stream);
    }
}

/* The digits are shifted, so that 0.009 m are 9 mm and not 9.000000000000002. */
static void write_parameter(const table_writer *w, int axis, int64_t point, const fst_params *params)
{
    const int index = fst_param_find(fst_grid_key(w->table.grid, axis));
    const fst_param_info *info = fst_param_at(index);
    char text[64];
    int shift;
    (void)parameter_unit(info, w->units, &shift);
    if (info->kind == FST_KIND_REAL) {
        (void)fst_number_write(text, sizeof text, fst_grid_value(w->table.grid, axis, point));
        const double shifted = fst_number_read(text, fst_number_length(text), shift);
        (void)fst_number_write(text, sizeof text, shifted);
    } else {
        (void)fst_params_get(params, index, text, sizeof text);
    }
    (void)fprintf(w->stream, "%s,", text);
}

/* An undefined value stays empty. */
static void write_result(const table_writer *w, const char *key, double value, const fst_scales *scales)
{
    char text[64] = "";
    const char *unit;
    if (isfinite(value) && strcmp(key, "regime") == 0)
        (void)snprintf(text, sizeof text, "%s", fst_regime_name((fst_regime)value));
    else if (isfinite(value) && strcmp(key, "symmetry") == 0)
        (void)snprintf(text, sizeof text, "%s", fst_symmetry_name((fst_symmetry)value));
    else if (isfinite(value))
        (void)fst_number_write(text, sizeof text,
                               value * fst_unit_shown(unit_of_result(key), w->units, scales, &unit));
    (void)fputs(text, w->stream);
}

static fst_status write_rows(const table_writer *w, fst_error *error)
{
    const fst_grid *grid = w->table.grid;
    const int64_t points = fst_grid_points(grid);
    for (int64_t point = 0; point < points; ++point) {
        fst_params params;
        const fst_status status = fst_grid_params(grid, point, &params, error);
        if (status != FST_OK)
            return status;
        const fst_scales scales = fst_scales_of(&params);
        if (point == 0)
            write_head(w, &scales);
        if (w->table.refine && !w->table.computed[point])
            continue;
        for (int i = 0; i < fst_grid_axis_count(grid); ++i)
            write_parameter(w, i, point, &params);
        for (int i = 0; i < w->count; ++i) {
            write_result(w, w->keys[i], w->table.values[i * points + point], &scales);
            (void)fputc(i + 1 < w->count ? ',' : '\n', w->stream);
        }
    }
    return FST_OK;
}

fst_status fst_sweep_export_keys(const char *path, const char *const *keys, int count, fst_shown_units units,
                                 const char *out, FILE *stream, fst_error *error)
{
    static const char *const usual[] = {"regime", "mean_r", "std_r", "mean_alpha_dot"};
    table_writer w = {.keys = keys, .count = count, .units = units, .stream = stream};
    if (count == 0) {
        w.keys = usual;
        w.count = (int)(sizeof usual / sizeof *usual);
    }
    fst_whole_file file;
    fst_status status = fst_sweep_read(path, w.keys, w.count, &w.table, error);
    if (status == FST_OK && out) {
        status = fst_whole_file_open(&file, out, error);
        if (status == FST_OK) {
            w.stream = file.stream;
            status = write_rows(&w, error);
            if (status == FST_OK)
                status = fst_whole_file_commit(&file, error);
            else
                fst_whole_file_discard(&file);
        }
    } else if (status == FST_OK) {
        status = write_rows(&w, error);
    }
    fst_sweep_table_free(&w.table);
    return status;
}
