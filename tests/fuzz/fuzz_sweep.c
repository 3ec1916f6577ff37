/* fuzz_sweep.c - the bytes of a sweep's database: a refusal has a sentence; what is accepted has its points,
 * and is exported as text without a control character. */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void refused(fst_status status, const fst_error *error)
{
    if (error->code != status || !error->sentence[0])
        abort();
}

/* Texts from the file reach terminals. */
static void check_export(const char *path)
{
    char *text = NULL;
    size_t size = 0;
    fst_error error = {FST_OK, "", ""};
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return;
    const fst_status status = fst_sweep_export(path, FST_EXPORT_CSV, NULL, out, NULL, &error);
    if (fclose(out) != 0)
        abort();
    if (status != FST_OK)
        refused(status, &error);
    for (size_t i = 0; status == FST_OK && i < size; ++i)
        if ((unsigned char)text[i] < ' ' && text[i] != '\n')
            abort();
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[256];
    static const char *const keys[] = {"mean_r", "regime"};
    const char *folder = getenv("TMPDIR");
    (void)snprintf(path, sizeof path, "%.200s/festoon-fuzz-XXXXXX", folder ? folder : "/tmp");
    const int descriptor = mkstemp(path);
    if (descriptor < 0)
        return 0;
    const int whole = write(descriptor, data, size) == (ssize_t)size;
    (void)close(descriptor);
    fst_sweep_table table;
    fst_error error = {FST_OK, "", ""};
    if (whole) {
        const fst_status status = fst_sweep_read(path, keys, 2, &table, &error);
        if (status == FST_OK) {
            if (fst_grid_points(table.grid) < 1)
                abort();
            fst_sweep_table_free(&table);
        } else {
            refused(status, &error);
        }
        check_export(path);
    }
    (void)unlink(path);
    return 0;
}
