/* export.c - the rows of a sweep as CSV, JSON and HDF5. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/number.h"
#include "host/regular_file.h"
#include "host/whole_file.h"
#include "io/json_writer.h"
#include "io/load_hdf5.h"
#include "sweep/columns.h"
#include "sweep/database.h"
#include "sweep/file.h"
#include "sweep/lock.h"

typedef struct exporter {
    const char *path;
    fst_sweep_file file;
    fst_sweep_rows rows;
    sqlite3_stmt *row;
    int columns; /* all except the checksum */
    FILE *stream;
} exporter;

/* ------------------------------------------------------------------ CSV */

/* A text from the file as a new string, made fit for terminals: one line without control characters.  NULL: no
 * memory. */
static char *tame_text(sqlite3_stmt *rows, int column)
{
    const char *text = (const char *)sqlite3_column_text(rows, column);
    char *tame = text ? strdup(text) : NULL;
    if (tame)
        fst_text_tame(tame);
    return tame;
}

enum { COLUMN_SIZE = 128 };

/* NULL: no memory. */
static const char *tame_name(sqlite3_stmt *rows, int column, char name[COLUMN_SIZE])
{
    const char *given = sqlite3_column_name(rows, column);
    (void)snprintf(name, COLUMN_SIZE, "%s", given ? given : "");
    fst_text_tame(name);
    return given ? name : NULL;
}

static fst_status fail_memory(const exporter *e, fst_error *error)
{
    return fst_fail(error, FST_NO_MEMORY, e->path, "out of memory");
}

static fst_status csv_head(exporter *e, fst_error *error)
{
    for (int i = 0; i < e->columns; ++i) {
        char column[COLUMN_SIZE];
        const char *name = tame_name(e->row, i, column);
        if (!name)
            return fail_memory(e, error);
        (void)fprintf(e->stream, "%s%s", i ? "," : "", name);
    }
    (void)fputc('\n', e->stream);
    return FST_OK;
}

static fst_status csv_row(exporter *e, fst_error *error)
{
    for (int i = 0; i < e->columns; ++i) {
        char number[40], *text;
        if (i)
            (void)fputc(',', e->stream);
        switch (sqlite3_column_type(e->row, i)) {
        case SQLITE_INTEGER:
            (void)fprintf(e->stream, "%lld", (long long)sqlite3_column_int64(e->row, i));
            break;
        case SQLITE_FLOAT:
            (void)fst_number_write(number, sizeof number, sqlite3_column_double(e->row, i));
            (void)fputs(number, e->stream);
            break;
        case SQLITE_TEXT:
            text = tame_text(e->row, i);
            if (!text)
                return fail_memory(e, error);
            fst_sweep_write_quoted(e->stream, text);
            free(text);
            break;
        default: /* an undefined value stays empty */
            break;
        }
    }
    (void)fputc('\n', e->stream);
    return FST_OK;
}

/* ------------------------------------------------------------------ JSON */

static void put_value(fst_json *json, const char *key, sqlite3_stmt *rows, int column)
{
    char *text;
    switch (sqlite3_column_type(rows, column)) {
    case SQLITE_INTEGER:
        fst_json_integer(json, key, sqlite3_column_int64(rows, column));
        break;
    case SQLITE_FLOAT:
        fst_json_real(json, key, sqlite3_column_double(rows, column));
        break;
    case SQLITE_TEXT:
        text = tame_text(rows, column);
        fst_json_put(json, key, text ? fst_json_text_value(text) : NULL);
        free(text);
        break;
    default:
        fst_json_put(json, key, json_null());
    }
}

/* One object a line.  The components of the final state, the last columns, are gathered into one list, as `run`
 * prints them. */
static fst_status json_row(exporter *e, fst_error *error)
{
    int final = 0;
    fst_json json = fst_json_begin('{');
    for (int i = 0; i < e->columns; ++i) {
        char column[COLUMN_SIZE];
        const char *name = tame_name(e->row, i, column);
        json.failed |= !name;
        if (name && !final && strncmp(name, "final_", 6) == 0) {
            fst_json_open(&json, "final_state", '[');
            final = 1;
        }
        if (strcmp(column, "never_slips") == 0 && sqlite3_column_type(e->row, i) == SQLITE_INTEGER)
            fst_json_flag(&json, name, sqlite3_column_int(e->row, i) != 0); /* as `run` prints it */
        else
            put_value(&json, final ? NULL : column, e->row, i);
    }
    if (final)
        fst_json_close(&json);
    char *text = fst_json_end(&json, JSON_COMPACT);
    if (!text)
        return fail_memory(e, error);
    (void)fprintf(e->stream, "%.*s", (int)strlen(text) - 1, text);
    free(text);
    return FST_OK;
}

/* ------------------------------------------------------------------ all rows, as text */

static fst_status write_text(exporter *e, fst_export_format format, fst_error *error)
{
    fst_status status = FST_OK;
    int more, first = 1;
    if (format == FST_EXPORT_CSV)
        status = csv_head(e, error);
    else
        (void)fputc('[', e->stream);
    while (status == FST_OK && (status = fst_sweep_rows_next(&e->rows, &more, error)) == FST_OK && more) {
        if (format == FST_EXPORT_JSON)
            (void)fputs(first ? "\n" : ",\n", e->stream);
        first = 0;
        status = format == FST_EXPORT_CSV ? csv_row(e, error) : json_row(e, error);
    }
    if (format == FST_EXPORT_JSON)
        (void)fputs(first ? "]\n" : "\n]\n", e->stream);
    return status;
}

static fst_status export_text(exporter *e, fst_export_format format, const char *out, FILE *stream,
                              fst_error *error)
{
    if (!out) {
        e->stream = stream;
        return write_text(e, format, error);
    }
    fst_whole_file file;
    fst_status status = fst_whole_file_open(&file, out, error);
    if (status != FST_OK)
        return status;
    e->stream = file.stream;
    status = write_text(e, format, error);
    if (status == FST_OK)
        return fst_whole_file_commit(&file, error);
    fst_whole_file_discard(&file);
    return status;
}

/* ------------------------------------------------------------------ HDF5 */

#define STATUS_WORD(name, text) "|" text
/* The list of texts whose index stands in HDF5 for a column of texts; NULL where the column is left out. */
static const char *codes_of(const char *column)
{
    static const char *const lists[][2] = {{"regime", FST_WORDS(FST_REGIMES)},
                                           {"symmetry", FST_WORDS(FST_SYMMETRIES)},
                                           {"dynamics", FST_WORDS(FST_DYNAMICS)},
                                           {"status", &(FST_STATUS_LIST(STATUS_WORD))[1]}};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; ++i)
        if (strcmp(lists[i][0], column) == 0)
            return lists[i][1];
    const fst_bead_column *of_beads = fst_bead_column_find(column);
    if (of_beads && of_beads->names)
        return of_beads->names;
    const int param = fst_param_find(column);
    const fst_param_info *info = fst_param_at(param);
    return info && info->kind == FST_KIND_CHOICE ? info->names : NULL;
}

/* The place of `text` in a list; NAN where it is not there. */
static double code_of(const char *list, const char *text)
{
    const int place = fst_name_place(text, list);
    return place < 0 ? NAN : (double)place;
}

typedef struct hdf5_columns {
    fst_column_info *infos;
    const fst_column_info **pointers;
    int *places; /* the columns of the table that are exported */
    double *values;
    int count, reason; /* `reason`: the place of the free texts */
} hdf5_columns;

static void describe(const fst_grid *grid, const char *name, fst_column_info *info)
{
    *info = (fst_column_info){name, fst_sweep_key_unit(grid, name), ""};
    const fst_param_info *param = fst_param_at(fst_param_find(name));
    if (param) {
        info->unit = param->kind == FST_KIND_CHOICE ? "1" : fst_unit_name(param->unit);
        info->doc = param->doc;
    }
    for (int i = 0; i < fst_result_count(); ++i)
        if (strcmp(fst_result_at(i)->name, name) == 0)
            info->doc = fst_result_at(i)->doc;
    if (codes_of(name))
        info->doc = codes_of(name); /* the texts in the order of their codes 0, 1, ... */
}

static int list_columns(exporter *e, hdf5_columns *c)
{
    const size_t most = (size_t)e->columns;
    c->infos = calloc(most, sizeof *c->infos);
    c->pointers = calloc(most, sizeof *c->pointers);
    c->places = calloc(most, sizeof *c->places);
    c->values = calloc(most, sizeof *c->values);
    if (!c->infos || !c->pointers || !c->places || !c->values)
        return 0;
    for (int i = 0; i < e->columns; ++i) {
        const char *name = sqlite3_column_name(e->row, i);
        const char *type = sqlite3_column_decltype(e->row, i);
        if (!name || !type)
            return 0;
        if (strcmp(type, "TEXT") == 0 && !codes_of(name)) {
            c->reason = i;
            continue;
        }
        describe(e->file.grid, name, &c->infos[c->count]);
        c->pointers[c->count] = &c->infos[c->count];
        c->places[c->count++] = i;
    }
    return 1;
}

/* 0: no memory. */
static int hdf5_value(sqlite3_stmt *rows, int place, double *value)
{
    const char *name = sqlite3_column_name(rows, place), *text;
    switch (sqlite3_column_type(rows, place)) {
    case SQLITE_NULL:
        *value = NAN;
        return 1;
    case SQLITE_TEXT:
        text = (const char *)sqlite3_column_text(rows, place);
        *value = name && text ? code_of(codes_of(name), text) : NAN;
        return name && text;
    default:
        *value = sqlite3_column_double(rows, place);
        return 1;
    }
}

static fst_status fill_hdf5(exporter *e, const fst_hdf5_module_table *module, const fst_whole_file *file,
                            const hdf5_columns *c, fst_error *error)
{
    const char *scene = fst_identity_text(&e->file.lines, "scene");
    fst_hdf5_writer *writer = NULL;
    fst_status status =
        module->create(file->path, c->pointers, c->count, "reason", scene ? scene : "", &writer, error);
    int more;
    while (status == FST_OK && (status = fst_sweep_rows_next(&e->rows, &more, error)) == FST_OK && more) {
        for (int i = 0; i < c->count && status == FST_OK; ++i)
            if (!hdf5_value(e->row, c->places[i], &c->values[i]))
                status = fail_memory(e, error);
        char *reason = status == FST_OK ? tame_text(e->row, c->reason) : NULL;
        if (status == FST_OK)
            status = module->row(writer, c->values, reason, error);
        free(reason);
    }
    if (writer && status == FST_OK)
        status =
            module->finish(writer, NULL, e->rows.sound == fst_grid_points(e->file.grid), file->stream, error);
    else if (writer)
        module->abandon(writer);
    return status;
}

static fst_status export_hdf5(exporter *e, const char *out, fst_error *error)
{
    if (!out)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_export.out",
                        "HDF5 goes into a file, whose name is missing");
    const fst_hdf5_module_table *module;
    fst_status status = fst_load_hdf5_module(&module, out, error);
    if (status != FST_OK)
        return status;
    hdf5_columns c = {.count = 0};
    fst_whole_file file = {.path = NULL};
    status = list_columns(e, &c) ? fst_whole_file_open(&file, out, error)
                                 : fst_fail(error, FST_NO_MEMORY, out, "out of memory");
    if (status == FST_OK) {
        status = fill_hdf5(e, module, &file, &c, error);
        if (status == FST_OK)
            status = fst_whole_file_commit(&file, error);
        else
            fst_whole_file_discard(&file);
    }
    free(c.infos);
    free(c.pointers);
    free(c.places);
    free(c.values);
    return status;
}

/* ------------------------------------------------------------------ */

static fst_status export_rows(exporter *e, fst_export_format format, const char *out, FILE *stream,
                              const fst_progress *progress, fst_error *error)
{
    fst_status status = fst_sweep_rows_begin(&e->rows, &e->file, error);
    e->rows.progress = progress;
    if (status == FST_OK) {
        e->row = e->rows.row;
        e->columns = fst_sweep_column_count(e->file.grid);
        status =
            format == FST_EXPORT_HDF5 ? export_hdf5(e, out, error) : export_text(e, format, out, stream, error);
    }
    /* The sound rows have been written; the status says that others are missing. */
    if (status == FST_OK && !fst_sweep_rows_are_whole(&e->rows))
        status = fst_sweep_rows_fail(&e->rows,
                                     out ? "The other rows were exported. "
                                         : "An export into a file (-o FILE) has the other rows. ",
                                     error);
    fst_sweep_rows_end(&e->rows);
    return status;
}

fst_status fst_sweep_export(const char *path, fst_export_format format, const char *out, FILE *stream,
                            const fst_progress *progress, fst_error *error)
{
    exporter e = {.path = path};
    fst_status status = fst_sweep_file_open(path, 0, &e.file, error);
    if (status == FST_OK)
        status = export_rows(&e, format, out, stream, progress, error);
    fst_sweep_file_close(&e.file);
    return status;
}

fst_status fst_is_sweep(const char *path, int *is_sweep, fst_error *error)
{
    int descriptor;
    *is_sweep = fst_lock_check_own(path, path, NULL) != FST_OK;
    if (*is_sweep)
        return FST_OK;
    if (fst_open_regular(path, &descriptor, NULL) != FST_OK)
        return FST_OK;
    const fst_status status = fst_database_begins(descriptor, path, is_sweep, error);
    (void)close(descriptor);
    return status;
}
