/* fuzz_csv.c - trajectories as text: a refusal has a sentence, and an accepted table has its rows. */
#include <stdlib.h>

#include "io/csv.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fst_table table = {.rows = 0};
    fst_text text;
    fst_error error = {FST_OK, "", ""};
    double *columns[FST_COLUMN_COUNT] = {NULL};
    double sum = 0.0;
    fst_status status = fst_text_take(&text, "fuzz", (const char *)data, size, &error);
    table.columns = columns;
    if (status == FST_OK)
        status = fst_csv_read(&text, &table, &error);
    if (status != FST_OK) {
        if (error.code == FST_OK || !error.sentence[0])
            abort();
    } else {
        for (int i = 0; i < fst_column_count(); ++i)
            for (size_t row = 0; row < table.rows; ++row)
                sum += table.columns[i][row];
    }
    const volatile double sink = sum; /* reads every number, so that the sanitizer sees it */
    (void)sink;
    for (int i = 0; i < FST_COLUMN_COUNT; ++i)
        free(columns[i]);
    fst_text_free(&text);
    return 0;
}
