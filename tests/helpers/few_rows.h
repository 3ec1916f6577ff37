/* few_rows.h - a few runs as rows of a sweep, in an engine of lanes. */
#ifndef FST_TESTS_FEW_ROWS_H
#define FST_TESTS_FEW_ROWS_H

#include <string.h>

#include "numeric.h"

#include "lanes/engines.h"

enum { FEW_ROWS_MOST = 16 };

typedef struct few_rows {
    int count, next;
    void (*fill)(const void *with, int row, fst_row_job *job); /* the job's parameters, and its start */
    const void *with;
    fst_run_result results[FEW_ROWS_MOST];
} few_rows;

static inline int few_rows_next(void *user, fst_row_job *job)
{
    few_rows *rows = user;
    if (rows->next == rows->count)
        return 0;
    memset(job, 0, sizeof *job);
    job->point = rows->next++;
    rows->fill(rows->with, (int)job->point, job);
    return 1;
}

static inline int few_rows_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                                const fst_error *error)
{
    if (status != FST_OK)
        fail_msg("row %d: %s", (int)job->point, error->sentence);
    ((few_rows *)user)->results[job->point] = *result;
    return 0;
}

/* All rows; fails unless each has a result. */
static inline void do_few_rows(few_rows *rows, fst_arithmetic arithmetic, int lanes)
{
    const fst_row_work work = {rows, arithmetic, lanes, few_rows_next, few_rows_done, NULL};
    fst_error error = {FST_OK, "", ""};
    assert_true(rows->count <= FEW_ROWS_MOST);
    rows->next = 0;
    memset(rows->results, 0, sizeof rows->results);
    if (fst_rows(&work, &error) != FST_OK)
        fail_msg("fst_rows: %s", error.sentence);
    assert_int_equal(rows->next, rows->count);
}

#endif
