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
#include "sweep/columns.h"
#include "sweep/refined.h"
#include "sweep/sweep.h"

enum { MOST_KEYS = 256 };

typedef struct table_writer {
    const char *const *keys;
    int count;
    fst_shown_units units;
    fst_sweep_file file;
    int is_refined; /* points without a row are left out; else their results stay empty */
    const char *all[MOST_KEYS];
    int places[MOST_KEYS];            /* of the keys among the columns of the database */
    const char *key_units[MOST_KEYS]; /* as the head tells them */
    int status, reason;               /* the places of these there */
    FILE *stream;
    const fst_progress *progress;
} table_writer;

/* ------------------------------------------------------------------ units */

/* The unit of a parameter.  *shift: the power of ten by which a value in SI is more in it. */
static const char *parameter_unit(const fst_param_info *info, fst_shown_units units, int *shift)
{
    *shift = 0;
    if (info->kind != FST_KIND_REAL)
        return "1";
    return units == FST_SHOWN_LAB ? fst_unit_customary(info->unit, shift) : fst_unit_name(info->unit);
}

const char *fst_sweep_key_unit(const fst_grid *grid, const char *key)
{
    const fst_row_kind kind = fst_grid_row_kind(grid);
    for (int i = 0; i < fst_result_count() && kind == FST_ROWS_OF_RUNS; ++i)
        if (strcmp(fst_result_at(i)->name, key) == 0)
            return fst_result_at(i)->unit;
    for (int i = 0; i < fst_column_count() && strncmp(key, "final_", 6) == 0; ++i)
        if (strcmp(fst_column_at(i)->name, key + 6) == 0)
            return fst_column_at(i)->unit;
    for (int i = 0; i < fst_bead_column_count(kind); ++i)
        if (strcmp(fst_bead_column_at(kind, i)->name, key) == 0)
            return fst_bead_column_at(kind, i)->unit;
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

static void write_head(table_writer *w, const fst_scales *scales)
{
    const fst_grid *grid = w->file.grid;
    int shift;
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const char *key = fst_grid_key(grid, i);
        write_name(w->stream, key, parameter_unit(fst_param_at(fst_param_find(key)), w->units, &shift));
        (void)fputc(',', w->stream);
    }
    for (int i = 0; i < w->count; ++i) {
        (void)fst_number_shown(w->keys[i], fst_sweep_key_unit(grid, w->keys[i]), w->units, scales,
                               &w->key_units[i]);
        write_name(w->stream, w->keys[i], w->key_units[i]);
        (void)fputc(',', w->stream);
    }
    (void)fputs("status\n", w->stream);
}

/* The digits are shifted, so that 0.009 m are 9 mm and not 9.000000000000002. */
static void write_parameter(const table_writer *w, int axis, int64_t point, const fst_params *params)
{
    const int index = fst_param_find(fst_grid_key(w->file.grid, axis));
    const fst_param_info *info = fst_param_at(index);
    char text[64];
    int shift;
    (void)parameter_unit(info, w->units, &shift);
    if (info->kind == FST_KIND_REAL) {
        (void)fst_number_write(text, sizeof text, fst_grid_value(w->file.grid, axis, point));
        const double shifted = fst_number_read(text, fst_number_length(text), shift);
        (void)fst_number_write(text, sizeof text, shifted);
    } else {
        (void)fst_params_get(params, index, text, sizeof text);
    }
    (void)fprintf(w->stream, "%s,", text);
}

/* A value in the unit of the head.  One that is undefined, or has none in that unit at this point, stays empty. */
static void write_result(const table_writer *w, int i, sqlite3_stmt *row, const fst_scales *scales)
{
    char text[64] = "";
    const char *unit = fst_sweep_key_unit(w->file.grid, w->keys[i]), *shown;
    const int type = row ? sqlite3_column_type(row, w->places[i]) : SQLITE_NULL;
    double factor = 1.0;
    if (w->key_units[i] != unit) {
        factor = fst_number_shown(w->keys[i], unit, w->units, scales, &shown);
        if (shown == unit)
            factor = NAN;
    }
    if (type == SQLITE_TEXT) { /* a name */
        (void)snprintf(text, sizeof text, "%s", (const char *)sqlite3_column_text(row, w->places[i]));
        fst_text_tame(text);
    } else if (type != SQLITE_NULL && isfinite(factor)) {
        (void)fst_number_write(text, sizeof text, factor * sqlite3_column_double(row, w->places[i]));
    }
    (void)(strpbrk(text, ",\"") ? fst_sweep_write_quoted(w->stream, text) : (void)fputs(text, w->stream));
}

/* "done", "missing" where there is no row, or how and why the run failed: one of the texts of statuses, and the reason. */
static void write_status(const table_writer *w, sqlite3_stmt *row)
{
    char why[sizeof((fst_error *)NULL)->sentence + 64];
    const char *text = row ? (const char *)sqlite3_column_text(row, w->status) : NULL, *failed = NULL;
    for (int i = FST_BAD_INPUT; text && i < FST_STATUS_COUNT; ++i)
        if (strcmp(text, fst_status_text((fst_status)i)) == 0)
            failed = fst_status_text((fst_status)i);
    const char *reason = failed ? (const char *)sqlite3_column_text(row, w->reason) : NULL;
    if (reason && *reason) {
        (void)snprintf(why, sizeof why, "%s: %s", failed, reason);
        fst_text_tame(why);
        fst_sweep_write_quoted(w->stream, why);
        (void)fputc('\n', w->stream);
    } else {
        (void)fprintf(w->stream, "%s\n", failed ? failed : row ? "done" : "missing");
    }
}

/* One line; `row` is NULL for a point without a row. */
static fst_status write_point(const table_writer *w, int64_t point, sqlite3_stmt *row, fst_error *error)
{
    fst_params params;
    const fst_status status = fst_grid_params(w->file.grid, point, &params, error);
    if (status != FST_OK)
        return status;
    const fst_scales scales = fst_scales_of(&params);
    for (int i = 0; i < fst_grid_axis_count(w->file.grid); ++i)
        write_parameter(w, i, point, &params);
    for (int i = 0; i < w->count; ++i) {
        write_result(w, i, row, &scales);
        (void)fputc(',', w->stream);
    }
    write_status(w, row);
    return FST_OK;
}

/* Points without a row, up to the next one that has one. */
static fst_status write_gap(const table_writer *w, const fst_sweep_rows *rows, int64_t from, int64_t to,
                            fst_error *error)
{
    fst_status status = FST_OK;
    for (int64_t point = from; point < to && !w->is_refined && status == FST_OK; ++point) {
        if (fst_sweep_has_point(&w->file.identity, point))
            status = write_point(w, point, NULL, error);
        if (status == FST_OK)
            status = fst_sweep_rows_tell(rows, point, error);
    }
    return status;
}

static int is_all(const table_writer *w)
{
    return w->count == 1 && strcmp(w->keys[0], "all") == 0;
}

static fst_status find_places(table_writer *w, sqlite3_stmt *row, fst_error *error)
{
    if (w->count > MOST_KEYS)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_export_keys.keys", "at most %d keys", MOST_KEYS);
    if (is_all(w)) {
        w->count = 0;
        w->keys = w->all;
        for (int i = 1 + fst_grid_axis_count(w->file.grid); i < fst_sweep_column_count(w->file.grid); ++i)
            if (strcmp(sqlite3_column_name(row, i), "status") != 0 &&
                strcmp(sqlite3_column_name(row, i), "reason") != 0 && w->count < MOST_KEYS)
                w->all[w->count++] = sqlite3_column_name(row, i);
    }
    fst_status found = FST_OK;
    for (int i = 0; i < w->count && found == FST_OK; ++i)
        found = fst_sweep_find(row, w->keys[i], w->file.name, &w->places[i], error);
    w->status = fst_sweep_place(row, "status");
    w->reason = fst_sweep_place(row, "reason");
    return found;
}

/* The lines come from the file one by one, so that a grid may have more points than memory has room for. */
static fst_status write_rows(table_writer *w, fst_error *error)
{
    fst_sweep_rows rows;
    int64_t behind = 0;
    int more = 0;
    fst_params first;
    fst_status status = fst_sweep_rows_begin(&rows, &w->file, error);
    rows.progress = w->progress;
    if (status == FST_OK)
        status = find_places(w, rows.row, error);
    if (status == FST_OK)
        status = fst_grid_params(w->file.grid, 0, &first, error);
    if (status == FST_OK) {
        const fst_scales scales = fst_scales_of(&first);
        write_head(w, &scales);
    }
    while (status == FST_OK && (status = fst_sweep_rows_next(&rows, &more, error)) == FST_OK && more) {
        status = write_gap(w, &rows, behind, rows.next - 1, error);
        if (status == FST_OK)
            status = write_point(w, rows.next - 1, rows.row, error);
        behind = rows.next;
    }
    if (status == FST_OK)
        status = write_gap(w, &rows, behind, fst_grid_points(w->file.grid), error);
    if (status == FST_OK && !fst_sweep_rows_are_whole(&rows))
        status = fst_sweep_rows_fail(&rows, "", error);
    fst_sweep_rows_end(&rows);
    return status;
}

static fst_status write_file(table_writer *w, const char *out, fst_error *error)
{
    fst_whole_file file;
    fst_status status = fst_whole_file_open(&file, out, error);
    if (status != FST_OK)
        return status;
    w->stream = file.stream;
    status = write_rows(w, error);
    if (status == FST_OK)
        return fst_whole_file_commit(&file, error);
    fst_whole_file_discard(&file);
    return status;
}

fst_status fst_sweep_export_keys(const char *path, const char *const *keys, int count, fst_shown_units units,
                                 const char *out, FILE *stream, const fst_progress *progress, fst_error *error)
{
    enum { USUAL = 4 };
    static const char *const usual[][USUAL] = {
        [FST_ROWS_OF_RUNS] = {"regime", "mean_r", "std_r", "mean_alpha_dot"},
        [FST_ROWS_OF_BEADS] = {"outcome", "groups", "mean_r", "centre_rate"},
        [FST_ROWS_OF_WORLDS] = {"regime", "mean_r", "mean_alpha_dot", "mean_velocity"},
        [FST_ROWS_OF_LEVITATION] = {"below", "below_height_mm", "above", "above_height_mm"}};
    table_writer w = {.keys = keys, .count = count, .units = units, .stream = stream, .progress = progress};
    fst_refining refining;
    fst_status status = FST_OK;
    status = fst_sweep_file_open(path, 0, &w.file, error);
    for (int i = 0; i < w.count && status == FST_OK && !is_all(&w); ++i)
        status = fst_sweep_check_key(w.file.grid, w.keys[i], "fst_sweep_export_keys.keys", error);
    if (status == FST_OK)
        status = fst_refining_read(&w.file.lines, path, &refining, error);
    if (status == FST_OK) {
        if (count == 0) {
            w.keys = usual[fst_grid_row_kind(w.file.grid)];
            w.count = USUAL;
        }
        w.is_refined = refining.levels > 0;
        status = out ? write_file(&w, out, error) : write_rows(&w, error);
    }
    fst_sweep_file_close(&w.file);
    return status;
}
