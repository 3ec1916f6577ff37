/* collect.c - a run whose samples are collected in memory, as a table like that of a trajectory file. */
#include "io/collect.h"

#include "base/error.h"
#include "io/columns.h"

#include <stdlib.h>
#include <string.h>

typedef struct collector {
    fst_table *table;
    size_t room;
} collector;

static fst_status grow(collector *collected, fst_error *error)
{
    size_t room = collected->room ? 2 * collected->room : 4096;
    for (int i = 0; i < FST_COLUMN_COUNT; ++i) {
        double *column = realloc(collected->table->columns[i], room * sizeof *column);
        if (!column)
            return fst_fail(error, FST_NO_MEMORY, "trajectory", "no memory for %zu samples", room);
        collected->table->columns[i] = column;
    }
    collected->room = room;
    return FST_OK;
}

static fst_status take(void *user, const fst_sample *sample, fst_error *error)
{
    collector *collected = user;
    fst_table *table = collected->table;
    if (table->rows == collected->room) {
        fst_status status = grow(collected, error);
        if (status != FST_OK)
            return status;
    }
    double values[FST_COLUMN_COUNT];
    fst_column_values(sample, values);
    for (int i = 0; i < FST_COLUMN_COUNT; ++i)
        table->columns[i][table->rows] = values[i];
    ++table->rows;
    return FST_OK;
}

fst_status fst_collect_run(const fst_params *params, const fst_progress *progress, fst_run_result *result,
                           fst_table *table, fst_error *error)
{
    *table = (fst_table){.params = *params};
    table->columns = calloc(FST_COLUMN_COUNT, sizeof *table->columns);
    if (!table->columns)
        return fst_fail(error, FST_NO_MEMORY, "trajectory", "no memory for a table");
    collector collected = {.table = table};
    fst_run_options options = fst_default_run_options();
    options.sink.user = &collected;
    options.sink.sample = take;
    options.progress = progress;
    options.sample_from = params->run_discard;
    fst_status status = fst_run(params, &options, result, error);
    table->complete = status == FST_OK;
    return status;
}

const double *fst_collected(const fst_table *table, const char *name)
{
    for (int i = 0; i < FST_COLUMN_COUNT; ++i)
        if (!strcmp(fst_column_at(i)->name, name))
            return table->columns[i];
    return NULL;
}
