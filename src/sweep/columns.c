/* columns.c - a finished run as a row of the table `rows`: its columns, its values, its checksum. */
#include "sweep/columns.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/checksum.h"
#include "base/error.h"

const char *const fst_state_names[FST_STATE_SIZE] = {"X", "Y", "vX", "vY", "nX", "nY", "nZ", "WX", "WY", "WZ"};

static const char FIRST[] =
    "status TEXT, carried INTEGER, regime TEXT, symmetry TEXT, reason TEXT, dynamics TEXT, "
    "never_slips INTEGER";
static const char COUNTS[] =
    "returns INTEGER, rhs_calls INTEGER, steps_accepted INTEGER, steps_rejected INTEGER";
enum { FIRST_COUNT = 7, COUNT_COUNT = 4 };

static int is_choice(const fst_grid *grid, int axis)
{
    return fst_param_at(fst_param_find(fst_grid_key(grid, axis)))->kind == FST_KIND_CHOICE;
}

/* Whether rows have the columns of bead_columns.h. */
static int has_own(const fst_grid *grid)
{
    return fst_grid_row_kind(grid) != FST_ROWS_OF_RUNS;
}

int fst_sweep_column_count(const fst_grid *grid)
{
    if (has_own(grid)) /* point, axes, status, reason and their own */
        return 1 + fst_grid_axis_count(grid) + 2 + fst_bead_column_count(fst_grid_row_kind(grid));
    return 1 + fst_grid_axis_count(grid) + FIRST_COUNT + fst_result_count() + COUNT_COUNT + FST_STATE_SIZE;
}

char *fst_sweep_columns_sql(const fst_grid *grid)
{
    fst_printed printed;
    FILE *out = fst_print_begin(&printed);
    if (!out)
        return NULL;
    (void)fputs("point INTEGER PRIMARY KEY", out);
    for (int i = 0; i < fst_grid_axis_count(grid); ++i)
        (void)fprintf(out, ", \"%s\" %s", fst_grid_key(grid, i), is_choice(grid, i) ? "TEXT" : "REAL");
    if (has_own(grid)) {
        (void)fputs(", status TEXT, reason TEXT", out);
        const fst_bead_column *column;
        for (int i = 0; (column = fst_bead_column_at(fst_grid_row_kind(grid), i)); ++i)
            (void)fprintf(out, ", %s %s", column->name,
                          column->kind == FST_BEAD_NAME   ? "TEXT"
                          : column->kind == FST_BEAD_REAL ? "REAL"
                                                          : "INTEGER");
        (void)fputs(", checksum INTEGER", out);
        return fst_print_end(&printed);
    }
    (void)fprintf(out, ", %s", FIRST);
    for (int i = 0; i < fst_result_count(); ++i)
        (void)fprintf(out, ", %s REAL", fst_result_at(i)->name);
    (void)fprintf(out, ", %s", COUNTS);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        (void)fprintf(out, ", final_%s REAL", fst_state_names[i]);
    (void)fputs(", checksum INTEGER", out);
    return fst_print_end(&printed);
}

char *fst_sweep_insert_sql(const fst_grid *grid)
{
    fst_printed printed;
    FILE *out = fst_print_begin(&printed);
    if (!out)
        return NULL;
    (void)fputs("INSERT OR IGNORE INTO rows VALUES(?", out);
    for (int i = 0; i < fst_sweep_column_count(grid); ++i)
        (void)fputs(", ?", out);
    (void)fputs(")", out);
    return fst_print_end(&printed);
}

/* The definitions of the tables have been compared with ours, so that * means the columns above. */
char *fst_sweep_select_sql(void)
{
    return strdup("SELECT * FROM rows WHERE point >= ? ORDER BY point");
}

char *fst_sweep_state_sql(const fst_grid *grid)
{
    fst_printed printed;
    const fst_row_kind kind = fst_grid_row_kind(grid);
    if (kind == FST_ROWS_OF_BEADS || kind == FST_ROWS_OF_LEVITATION) /* whose states are not carried */
        return strdup("SELECT ?1 < 0 AND ?2 < 0");
    if (kind == FST_ROWS_OF_WORLDS)
        return strdup(
            "SELECT status = 'done' AND ?2 > 0 AND regime NOT IN ('ejected', 'lifted', 'touched', 'lost'), "
            "final_X, final_Y, final_Z, final_vX, final_vY, final_vZ, final_nX, final_nY, final_nZ, "
            "final_WX, final_WY, final_WZ FROM rows WHERE point = ?1");
    FILE *out = fst_print_begin(&printed);
    if (!out)
        return NULL;
    (void)fputs("SELECT status = 'done' AND regime NOT IN ('ejected', 'lifted')"
                " AND (periods >= ?2 OR settled_at IS NOT NULL)",
                out);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        (void)fprintf(out, ", final_%s", fst_state_names[i]);
    (void)fputs(" FROM rows WHERE point = ?1", out);
    return fst_print_end(&printed);
}

static uint64_t sum_real(uint64_t sum, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return fst_checksum_word(fst_checksum_word(sum, SQLITE_FLOAT), bits);
}

/* ------------------------------------------------------------------ writing */

/* Values are bound and added to the checksum one after the other, in the form in which SQLite will
 * return them. */
typedef struct binding {
    sqlite3_stmt *insert;
    int place;
    uint64_t sum;
    int code; /* SQLITE_OK, or why a text was not taken: it is copied */
} binding;

static void bind_null(binding *b)
{
    b->sum = fst_checksum_word(b->sum, SQLITE_NULL);
    (void)sqlite3_bind_null(b->insert, b->place++);
}

static void bind_integer(binding *b, int64_t value)
{
    b->sum = fst_checksum_word(fst_checksum_word(b->sum, SQLITE_INTEGER), (uint64_t)value);
    (void)sqlite3_bind_int64(b->insert, b->place++, value);
}

/* SQLite stores NaN as NULL, which here means undefined, and -0 as 0. */
static void bind_real(binding *b, double value)
{
    if (isnan(value)) {
        bind_null(b);
        return;
    }
    const double stored = value == 0.0 ? 0.0 : value;
    b->sum = sum_real(b->sum, stored);
    (void)sqlite3_bind_double(b->insert, b->place++, stored);
}

static void bind_text(binding *b, const char *text)
{
    if (!text || !text[0]) {
        bind_null(b);
        return;
    }
    b->sum = fst_checksum_bytes(fst_checksum_word(b->sum, SQLITE_TEXT), text, strlen(text));
    const int code = sqlite3_bind_text(b->insert, b->place++, text, -1, SQLITE_TRANSIENT);
    b->code = b->code == SQLITE_OK ? code : b->code;
}

/* The place's name in a list, as a text of its own. */
static void name_place(const char *names, int place, char *name, size_t size)
{
    size_t length;
    const char *from = fst_name_at(names, place, &length);
    (void)snprintf(name, size, "%.*s", (int)length, from);
}

/* Write a choice by its name.  The key may be of a part, or of a bead of a list, which has no place in fst_params. */
static void name_choice(const char *key, int value, char *name, size_t size)
{
    name_place(fst_param_at(fst_param_find(key))->names, value, name, size);
}

/* Columns other than those of a run on the plate. */
static void bind_own(binding *b, fst_row_kind kind, const fst_sweep_record *record)
{
    char name[64];
    const int done = record->status == FST_OK;
    bind_text(b, done ? "done" : fst_status_text(record->status));
    bind_text(b, record->result.reason);
    const fst_bead_column *column;
    for (int i = 0; (column = fst_bead_column_at(kind, i)); ++i) {
        const void *field = (const char *)record + column->offset;
        if (!done) {
            bind_null(b);
        } else if (column->kind == FST_BEAD_REAL) {
            bind_real(b, *(const double *)field);
        } else if (column->kind == FST_BEAD_COUNT) {
            bind_integer(b, *(const int64_t *)field);
        } else if (column->kind == FST_BEAD_INT) {
            bind_integer(b, *(const int *)field);
        } else {
            name_place(column->names, *(const int *)field, name, sizeof name);
            bind_text(b, name);
        }
    }
    (void)sqlite3_bind_int64(b->insert, b->place, (sqlite3_int64)b->sum);
}

int fst_sweep_bind(sqlite3_stmt *insert, const fst_grid *grid, uint64_t seed, const fst_sweep_record *record)
{
    const fst_run_result *r = &record->result;
    binding b = {insert, 1, seed, SQLITE_OK};
    char name[64];
    bind_integer(&b, record->point);
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const double value = fst_grid_value(grid, i, record->point);
        if (is_choice(grid, i)) {
            name_choice(fst_grid_key(grid, i), (int)value, name, sizeof name);
            bind_text(&b, name);
        } else {
            bind_real(&b, value);
        }
    }
    if (has_own(grid)) {
        bind_own(&b, fst_grid_row_kind(grid), record);
        return b.code;
    }
    bind_text(&b, record->status == FST_OK ? "done" : fst_status_text(record->status));
    bind_integer(&b, record->carried);
    bind_text(&b, record->status == FST_OK ? fst_regime_name(r->regime) : NULL);
    bind_text(&b, fst_symmetry_name(r->symmetry));
    bind_text(&b, r->reason);
    name_choice("model.dynamics", record->dynamics, name, sizeof name);
    bind_text(&b, name);
    if (r->never_slips < 0)
        bind_null(&b);
    else
        bind_integer(&b, r->never_slips);
    for (int i = 0; i < fst_result_count(); ++i) {
        double value;
        memcpy(&value, (const char *)r + fst_result_at(i)->offset, sizeof value);
        bind_real(&b, value);
    }
    bind_integer(&b, r->returns);
    bind_integer(&b, (int64_t)r->rhs_calls);
    bind_integer(&b, (int64_t)r->accepted);
    bind_integer(&b, (int64_t)r->rejected);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        bind_real(&b, record->status == FST_OK ? r->final_state[i] : NAN);
    (void)sqlite3_bind_int64(insert, b.place, (sqlite3_int64)b.sum);
    return b.code;
}

/* ------------------------------------------------------------------ reading */

uint64_t fst_sweep_row_checksum(sqlite3_stmt *row, int count, uint64_t seed)
{
    uint64_t sum = seed;
    for (int i = 0; i < count; ++i) {
        const int type = sqlite3_column_type(row, i);
        switch (type) {
        case SQLITE_INTEGER:
            sum = fst_checksum_word(fst_checksum_word(sum, SQLITE_INTEGER),
                                    (uint64_t)sqlite3_column_int64(row, i));
            break;
        case SQLITE_FLOAT:
            sum = sum_real(sum, sqlite3_column_double(row, i));
            break;
        case SQLITE_TEXT:
        case SQLITE_BLOB: {
            const char *bytes = sqlite3_column_blob(row, i);
            sum = fst_checksum_bytes(fst_checksum_word(sum, (uint64_t)type), bytes,
                                     (size_t)sqlite3_column_bytes(row, i));
            break;
        }
        default:
            sum = fst_checksum_word(sum, SQLITE_NULL);
        }
    }
    return sum;
}

/* Whether the row has the axes' values that the grid has at its point. */
static int has_axes_of_point(sqlite3_stmt *row, const fst_grid *grid, int64_t point)
{
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const double value = fst_grid_value(grid, i, point);
        if (is_choice(grid, i)) {
            char name[64];
            name_choice(fst_grid_key(grid, i), (int)value, name, sizeof name);
            const char *there = (const char *)sqlite3_column_text(row, 1 + i);
            if (!there || strcmp(there, name) != 0)
                return 0;
        } else if (sqlite3_column_type(row, 1 + i) != SQLITE_FLOAT ||
                   sqlite3_column_double(row, 1 + i) != value) {
            return 0;
        }
    }
    return 1;
}

/* Whether each value is of its column's type, or undefined. */
static int has_types(sqlite3_stmt *row, int count)
{
    for (int i = 0; i < count; ++i) {
        const char *kind = sqlite3_column_decltype(row, i);
        const int type = sqlite3_column_type(row, i);
        const int wanted = !kind                       ? SQLITE_NULL
                           : strcmp(kind, "TEXT") == 0 ? SQLITE_TEXT
                           : strcmp(kind, "REAL") == 0 ? SQLITE_FLOAT
                                                       : SQLITE_INTEGER;
        if (type != SQLITE_NULL && type != wanted)
            return 0;
    }
    return 1;
}

int fst_sweep_row_is_sound(sqlite3_stmt *row, const fst_grid *grid, uint64_t seed)
{
    const int count = fst_sweep_column_count(grid);
    if (sqlite3_column_count(row) != count + 1 || !has_types(row, count + 1))
        return 0;
    const int64_t point = sqlite3_column_int64(row, 0);
    return point >= 0 && point < fst_grid_points(grid) && has_axes_of_point(row, grid, point) &&
           sqlite3_column_type(row, count) == SQLITE_INTEGER &&
           (uint64_t)sqlite3_column_int64(row, count) == fst_sweep_row_checksum(row, count, seed);
}

/* The keys of the rows of these kinds. */
static void name_keys(int from, int to, char *names, size_t size)
{
    names[0] = '\0';
    for (int kind = from; kind <= to; ++kind) {
        const int is_run = kind == FST_ROWS_OF_RUNS;
        if (is_run)
            (void)snprintf(
                names, size,
                "regime|symmetry|carried|never_slips|returns|rhs_calls|steps_accepted|steps_rejected");
        for (int i = 0; is_run && i < FST_STATE_SIZE; ++i) {
            const size_t used = strlen(names);
            (void)snprintf(names + used, size - used, "|final_%s", fst_state_names[i]);
        }
        for (int i = 0; i < (is_run ? fst_result_count() : fst_bead_column_count((fst_row_kind)kind)); ++i) {
            const size_t used = strlen(names);
            (void)snprintf(names + used, size - used, "%s%s", used ? "|" : "",
                           is_run ? fst_result_at(i)->name : fst_bead_column_at((fst_row_kind)kind, i)->name);
        }
    }
}

fst_status fst_sweep_check_key(const fst_grid *grid, const char *key, const char *where, fst_error *error)
{
    static const char *const texts[] = {"status", "reason", "dynamics"};
    char names[4096], suggestion[FST_SUGGESTION_SIZE];
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i)
        if (strcmp(key, texts[i]) == 0)
            return fst_fail(error, FST_BAD_INPUT, where,
                            "%s is a text: give regime, symmetry or a number of the runs, as mean_r", key);
    if (fst_param_find(key) >= 0)
        return fst_fail(
            error, FST_BAD_INPUT, where,
            "%s is a parameter, no result: give regime, symmetry or a number of the runs, as mean_r", key);
    name_keys(FST_ROWS_OF_RUNS, FST_ROWS_OF_LEVITATION, names, sizeof names);
    if (fst_name_place(key, names) >= 0)
        return FST_OK;
    if (grid)
        name_keys((int)fst_grid_row_kind(grid), (int)fst_grid_row_kind(grid), names, sizeof names);
    return fst_fail(error, FST_BAD_INPUT, where, "unknown key \"%.60s\"; %s", key,
                    fst_suggest_name(key, names, suggestion));
}

fst_status fst_sweep_find(sqlite3_stmt *row, const char *key, const char *where, int *place, fst_error *error)
{
    static const char *const whose[] = {[FST_ROWS_OF_RUNS] = "one bead",
                                        [FST_ROWS_OF_BEADS] = "several beads",
                                        [FST_ROWS_OF_WORLDS] = "a bead in a world",
                                        [FST_ROWS_OF_LEVITATION] = "places where a bead floats"};
    char names[4096], suggestion[FST_SUGGESTION_SIZE];
    *place = fst_sweep_place(row, key);
    if (*place > 0)
        return FST_OK;
    const int kind = fst_sweep_place(row, "outcome")  ? FST_ROWS_OF_BEADS
                     : fst_sweep_place(row, "frame")  ? FST_ROWS_OF_WORLDS
                     : fst_sweep_place(row, "places") ? FST_ROWS_OF_LEVITATION
                                                      : FST_ROWS_OF_RUNS;
    name_keys(kind, kind, names, sizeof names);
    return fst_fail(error, FST_BAD_INPUT, where, "the rows of this sweep, of %s, have no %s; %s", whose[kind],
                    key, fst_suggest_name(key, names, suggestion));
}

int fst_sweep_place(sqlite3_stmt *row, const char *key)
{
    for (int k = 1; k < sqlite3_column_count(row); ++k)
        if (strcmp(sqlite3_column_name(row, k), key) == 0)
            return k;
    return 0;
}

double fst_sweep_number(sqlite3_stmt *rows, int column)
{
    if (sqlite3_column_type(rows, column) == SQLITE_NULL)
        return NAN;
    if (sqlite3_column_type(rows, column) != SQLITE_TEXT)
        return sqlite3_column_double(rows, column);
    const char *text = (const char *)sqlite3_column_text(rows, column);
    const fst_bead_column *of_beads = fst_bead_column_find(sqlite3_column_name(rows, column));
    if (of_beads && of_beads->names) {
        const int place = fst_name_place(text, of_beads->names);
        return place < 0 ? NAN : (double)place;
    }
    for (int i = 0; i < FST_REGIME_COUNT; ++i)
        if (strcmp(text, fst_regime_name((fst_regime)i)) == 0)
            return i;
    for (int i = FST_SYMMETRY_S1; i < FST_SYMMETRY_COUNT; ++i)
        if (strcmp(text, fst_symmetry_name((fst_symmetry)i)) == 0)
            return i;
    return NAN;
}

void fst_sweep_write_quoted(FILE *out, const char *tame)
{
    (void)fputc('"', out);
    for (const char *c = tame; *c; ++c) {
        if (*c == '"')
            (void)fputc('"', out);
        (void)fputc(*c, out);
    }
    (void)fputc('"', out);
}
