/* collect.c - a run whose samples are collected in memory, as a table like that of a trajectory file. */
#include <festoon/festoon_tools.h>

#include "base/error.h"
#include "base/grow.h"
#include "io/columns.h"

#include <stdlib.h>
#include <string.h>

static fst_status take(void *user, const fst_sample *sample, fst_error *error)
{
    fst_table *table = user;
    double values[FST_COLUMN_COUNT];
    fst_column_values(sample, values);
    for (int i = 0; i < FST_COLUMN_COUNT; ++i) {
        if (!fst_grow(&table->columns[i], table->rows, sizeof *table->columns[i]))
            return fst_fail(error, FST_NO_MEMORY, "trajectory", "no memory for more than %zu samples",
                            table->rows);
        table->columns[i][table->rows] = values[i];
    }
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
    fst_run_options options = fst_default_run_options();
    options.sink.user = table;
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
