/* A trajectory in HDF5 one of whose columns says that it is shorter or longer than the others is refused, and
 * names the column; one that is too large for this computer's memory is refused before it is read.  HDF5 keeps
 * a length as a number of 64 bits before the greatest length, which is unlimited here.
 * tests: io/hdf5_module.c io/trajectory.c */
#include "numeric.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <festoon/festoon_tools.h>

enum { ROWS = 50, MOST = 1 << 24 };

static size_t read_whole(const char *path, unsigned char *bytes)
{
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    const size_t size = fread(bytes, 1, MOST, in);
    (void)fclose(in);
    return size;
}

static void write_whole(const char *path, const unsigned char *bytes, size_t size)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}

static void columns_of_unequal_length(void **state)
{
    (void)state;
    char folder[] = "/tmp/festoon-hdf5-XXXXXX", path[64];
    fst_error error = {FST_OK, "", ""};
    fst_trajectory *file;
    fst_table table;
    fst_sample sample;
    const fst_params params = fst_default_params();
    memset(&sample, 0, sizeof sample);
    assert_non_null(mkdtemp(folder));
    (void)snprintf(path, sizeof path, "%s/t.h5", folder);
    if (fst_trajectory_create(path, &params, &file, &error) == FST_UNAVAILABLE) {
        print_message("this build has no HDF5\n");
        (void)rmdir(folder);
        return;
    }
    for (int i = 0; i < ROWS; ++i)
        assert_int_equal(fst_trajectory_append(file, &sample, &error), FST_OK);
    assert_int_equal(fst_trajectory_close(file, NULL, 1, &error), FST_OK);
    unsigned char *bytes = malloc(MOST), length[16];
    assert_non_null(bytes);
    memset(length, 0, 8);
    memset(length + 8, 0xff, 8);
    length[0] = ROWS;
    const size_t size = read_whole(path, bytes);
    int columns = 0;
    for (size_t at = 0; at + sizeof length <= size; ++at) {
        if (memcmp(bytes + at, length, sizeof length) != 0)
            continue;
        for (int change = -1; change <= 1; change += 2) {
            bytes[at] = (unsigned char)(ROWS + change);
            write_whole(path, bytes, size);
            error.sentence[0] = '\0';
            assert_int_equal(fst_trajectory_read(path, &table, &error), FST_BAD_INPUT);
            CHECK_CONTAINS(error.sentence, "column");
        }
        bytes[at] = ROWS;
        columns += 1;
    }
    assert_true(columns >= fst_column_count());
    write_whole(path, bytes, size);
    assert_int_equal(fst_trajectory_read(path, &table, &error), FST_OK);
    assert_int_equal(table.rows, ROWS);
    fst_table_free(&table);
    free(bytes);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

/* A file with a hole, which takes no space on the disk. */
static void a_file_larger_than_memory(void **state)
{
    (void)state;
    char path[] = "/tmp/festoon-hdf5-XXXXXX";
    const off_t half = (off_t)sysconf(_SC_PHYS_PAGES) / 2 * sysconf(_SC_PAGESIZE);
    const int file = mkstemp(path);
    assert_true(file >= 0);
    assert_int_equal(write(file, "\x89HDF\r\n\x1a\n", 8), 8);
    const int failed = ftruncate(file, half + 1);
    (void)close(file);
    fst_table table;
    fst_error error = {FST_OK, "", ""};
    const fst_status status = failed ? FST_UNAVAILABLE : fst_trajectory_read(path, &table, &error);
    assert_int_equal(unlink(path), 0);
    if (status == FST_UNAVAILABLE) {
        print_message("this build has no HDF5, or this disk no such files\n");
        return;
    }
    assert_int_equal(status, FST_NO_MEMORY);
    CHECK_CONTAINS(error.sentence, "half of this computer's memory");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(columns_of_unequal_length),
                                       cmocka_unit_test(a_file_larger_than_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
