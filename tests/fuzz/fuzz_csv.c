/* fuzz_csv.c - trajectories as text: a refusal has a sentence, and an accepted table has its rows. */
#include <stdlib.h>

#include "io/csv.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fst_table table = {.rows = 0};
    fst_error error = {FST_OK, "", ""};
    union {
        const uint8_t *constant;
        void *plain; /* fmemopen() with "r" does not write to it */
    } bytes = {data};
    FILE *in = size > 0 ? fmemopen(bytes.plain, size, "r") : NULL;
    if (!in)
        return 0;
    double sum = 0.0;
    if (fst_csv_read(in, "fuzz", &table, &error) != FST_OK) {
        if (error.code == FST_OK || !error.sentence[0])
            abort();
    } else {
        for (int i = 0; i < fst_column_count(); ++i)
            for (size_t row = 0; row < table.rows; ++row)
                sum += table.columns[i][row];
    }
    const volatile double sink = sum; /* reads every number, so that the sanitizer sees it */
    (void)sink;
    (void)fclose(in);
    fst_table_free(&table);
    return 0;
}
