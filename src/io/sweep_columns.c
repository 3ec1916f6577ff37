#include "io/sweep_columns.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const fst_state_names[FST_STATE_SIZE] = {"X", "Y", "vX", "vY", "nX", "nY", "nZ", "WX", "WY", "WZ"};

static const char TEXTS[] =
    "status TEXT, carried INTEGER, regime TEXT, symmetry TEXT, reason TEXT, dynamics TEXT";
static const char COUNTS[] =
    "returns INTEGER, rhs_calls INTEGER, steps_accepted INTEGER, steps_rejected INTEGER";
enum { TEXT_COUNT = 6, COUNT_COUNT = 4 };

char *fst_sweep_columns_sql(const fst_grid *grid)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    (void)fputs("point INTEGER PRIMARY KEY", out);
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const char *key = fst_grid_key(grid, i);
        const int choice = fst_param_at(fst_param_find(key))->kind == FST_KIND_CHOICE;
        (void)fprintf(out, ", \"%s\" %s", key, choice ? "TEXT" : "REAL");
    }
    (void)fprintf(out, ", %s", TEXTS);
    for (int i = 0; i < fst_result_count(); ++i)
        (void)fprintf(out, ", %s REAL", fst_result_at(i)->name);
    (void)fprintf(out, ", %s", COUNTS);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        (void)fprintf(out, ", final_%s REAL", fst_state_names[i]);
    return fclose(out) == 0 ? text : (free(text), NULL);
}

char *fst_sweep_insert_sql(const fst_grid *grid)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    const int count =
        fst_grid_axis_count(grid) + TEXT_COUNT + fst_result_count() + COUNT_COUNT + FST_STATE_SIZE;
    (void)fputs("INSERT OR IGNORE INTO rows VALUES(?", out);
    for (int i = 0; i < count; ++i)
        (void)fputs(", ?", out);
    (void)fputs(")", out);
    return fclose(out) == 0 ? text : (free(text), NULL);
}

char *fst_sweep_state_sql(void)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    (void)fputs("SELECT status = 'done' AND regime NOT IN ('ejected', 'lifted')", out);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        (void)fprintf(out, ", final_%s", fst_state_names[i]);
    (void)fputs(" FROM rows WHERE point = ?", out);
    return fclose(out) == 0 ? text : (free(text), NULL);
}

/* A choice by its name. */
static void bind_choice(sqlite3_stmt *insert, int place, const char *key, int value)
{
    const fst_param_info *info = fst_param_at(fst_param_find(key));
    fst_params params = fst_default_params();
    char name[64];
    memcpy((char *)&params + info->offset, &value, sizeof value);
    const int length = fst_params_get(&params, fst_param_find(key), name, sizeof name);
    (void)sqlite3_bind_text(insert, place, name, length, SQLITE_TRANSIENT);
}

static void bind_text(sqlite3_stmt *insert, int place, const char *text)
{
    if (text && text[0])
        (void)sqlite3_bind_text(insert, place, text, -1, SQLITE_TRANSIENT);
    else
        (void)sqlite3_bind_null(insert, place);
}

/* SQLite stores NaN as NULL: what is undefined. */
void fst_sweep_bind(sqlite3_stmt *insert, const fst_grid *grid, const fst_sweep_record *record)
{
    const fst_run_result *r = &record->result;
    int place = 1;
    (void)sqlite3_bind_int64(insert, place++, record->point);
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const char *key = fst_grid_key(grid, i);
        const double value = fst_grid_value(grid, i, record->point);
        if (fst_param_at(fst_param_find(key))->kind == FST_KIND_CHOICE)
            bind_choice(insert, place++, key, (int)value);
        else
            (void)sqlite3_bind_double(insert, place++, value);
    }
    bind_text(insert, place++, record->status == FST_OK ? "done" : fst_status_text(record->status));
    (void)sqlite3_bind_int(insert, place++, record->carried);
    bind_text(insert, place++, record->status == FST_OK ? fst_regime_name(r->regime) : NULL);
    bind_text(insert, place++, fst_symmetry_name(r->symmetry));
    bind_text(insert, place++, r->reason);
    bind_choice(insert, place++, "model.dynamics", record->dynamics);
    for (int i = 0; i < fst_result_count(); ++i) {
        double value;
        memcpy(&value, (const char *)r + fst_result_at(i)->offset, sizeof value);
        (void)sqlite3_bind_double(insert, place++, value);
    }
    (void)sqlite3_bind_int64(insert, place++, r->returns);
    (void)sqlite3_bind_int64(insert, place++, (sqlite3_int64)r->rhs_calls);
    (void)sqlite3_bind_int64(insert, place++, (sqlite3_int64)r->accepted);
    (void)sqlite3_bind_int64(insert, place++, (sqlite3_int64)r->rejected);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        (void)sqlite3_bind_double(insert, place++, record->status == FST_OK ? r->final_state[i] : NAN);
}
