/* Trajectory files: both formats give back every bit, say whether they are complete, appear whole or not at
 * all, and damaged or foreign files are refused with a sentence.
 * tests: io/trajectory.c io/rows_file.c io/csv.c io/columns.c io/load_hdf5.c io/hdf5_module.c io/hdf5_session.c
 *   host/module.c */
#include "numeric.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <festoon/festoon_tools.h>

#include "io/columns.h"
#include "io/csv.h"
#include "host/module.h"
#include "io/load_hdf5.h"

static char directory[] = "/tmp/festoon-trajectory-XXXXXX";
static const char *const endings[] = {"h5", "csv"};

static int make_directory(void **state)
{
    (void)state;
    return mkdtemp(directory) ? 0 : 1;
}

/* Every test removes its files, so that any other file, such as a temporary one, makes this fail. */
static int remove_directory(void **state)
{
    (void)state;
    return rmdir(directory);
}

static const char *path_of(const char *name, const char *ending)
{
    static char path[128];
    (void)snprintf(path, sizeof path, "%s/%s.%s", directory, name, ending);
    return path;
}

static int file_count(void)
{
    int count = 0;
    DIR *listing = opendir(directory);
    assert_non_null(listing);
    for (struct dirent *entry = readdir(listing); entry; entry = readdir(listing))
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    (void)closedir(listing);
    return count;
}

/* A sample whose fields are all different and awkward. */
static fst_sample sample_at(int index)
{
    fst_sample sample;
    memset(&sample, 0, sizeof sample);
    double value = index + 0.1;
    sample.t = value / 3.0;
    sample.omega = 0.2;
    sample.drive_turns = value / 7.0;
    for (int i = 0; i < FST_STATE_SIZE; i++)
        sample.state[i] = sin(value + i);
    sample.bead_angle = -value;
    sample.alpha = 1e-300 * value;
    sample.x = cos(value);
    sample.y = cos(value + 0.3);
    for (int i = 0; i < 2; i++)
        sample.v_lab[i] = cos(value - 0.2 * (1 + i));
    for (int i = 0; i < 3; i++) {
        sample.n_lab[i] = cos(0.7 * value + i);
        sample.w_lab[i] = cos(0.9 * value + i);
    }
    sample.seen.r = 1.0 / value;
    sample.seen.angle = 0.1;
    sample.seen.load = index % 7 == 3 ? 5e-324 : 1e300;
    return sample;
}

static void write_file(const char *path, int rows, int complete)
{
    fst_params params = fst_default_params();
    fst_trajectory *trajectory;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_params_set(&params, "drive.omega", "0.1", NULL), FST_OK);
    if (fst_trajectory_create(path, &params, &trajectory, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
    for (int i = 0; i < rows; i++) {
        fst_sample sample = sample_at(i);
        assert_int_equal(fst_trajectory_append(trajectory, &sample, &error), FST_OK);
    }
    assert_int_equal(access(path, F_OK), -1); /* the file appears only when it is closed */
    fst_run_result result;
    memset(&result, 0, sizeof result);
    result.mean_r = NAN;
    assert_int_equal(fst_trajectory_close(trajectory, &result, complete, &error), FST_OK);
    assert_int_equal(access(path, F_OK), 0);
}

static int column(const char *name)
{
    for (int i = 0; i < fst_column_count(); i++)
        if (strcmp(fst_column_at(i)->name, name) == 0)
            return i;
    fail_msg("no column %s", name);
    return -1;
}

/* The laboratory's columns differ from those of the turning frame. */
static void check_laboratory(const fst_table *table, int row, const fst_sample *sample)
{
    static const char *const names[] = {"x", "y", "vx", "vy", "n_x", "n_y", "n_z", "w_x", "w_y", "w_z"};
    const double values[] = {sample->x,        sample->y,        sample->v_lab[0], sample->v_lab[1],
                             sample->n_lab[0], sample->n_lab[1], sample->n_lab[2], sample->w_lab[0],
                             sample->w_lab[1], sample->w_lab[2]};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        CHECK_SAME_BITS(table->columns[column(names[i])][row], values[i]);
}

/* 10000 rows: more than two chunks of the HDF5 file. */
static void files_give_back_every_bit(void **state)
{
    (void)state;
    static const int lengths[] = {0, 1, 4096, 10000};
    for (int e = 0; e < 2; e++)
        for (size_t l = 0; l < sizeof lengths / sizeof lengths[0]; l++) {
            const char *path = path_of("t", endings[e]);
            int complete = l % 2 == 0;
            write_file(path, lengths[l], complete);
            fst_table table;
            fst_error error = {FST_OK, "", ""};
            if (fst_trajectory_read(path, &table, &error) != FST_OK)
                fail_msg("%s: %s", error.where, error.sentence);
            assert_int_equal(table.rows, lengths[l]);
            assert_int_equal(table.complete, complete);
            CHECK_SAME_BITS(table.params.drive_omega, 0.1);
            for (int i = 0; i < lengths[l]; i++) {
                const fst_sample sample = sample_at(i);
                CHECK_SAME_BITS(table.columns[column("t")][i], sample.t);
                CHECK_SAME_BITS(table.columns[column("WZ")][i], sample.state[FST_WZ]);
                CHECK_SAME_BITS(table.columns[column("alpha")][i], sample.alpha);
                CHECK_SAME_BITS(table.columns[column("r")][i], sample.seen.r);
                check_laboratory(&table, i, &sample);
                CHECK_CLOSE(table.columns[column("angle")][i], 5.729577951308232, 1e-14);
                CHECK_SAME_BITS(table.columns[column("load")][i], sample.seen.load);
            }
            fst_table_free(&table);
            assert_int_equal(unlink(path), 0);
        }
}

static void discarding_leaves_nothing(void **state)
{
    (void)state;
    const fst_params params = fst_default_params();
    for (int e = 0; e < 2; e++) {
        fst_trajectory *trajectory;
        const fst_sample sample = sample_at(0);
        assert_int_equal(fst_trajectory_create(path_of("t", endings[e]), &params, &trajectory, NULL), FST_OK);
        assert_int_equal(fst_trajectory_append(trajectory, &sample, NULL), FST_OK);
        assert_int_equal(file_count(), 1);
        fst_trajectory_discard(trajectory);
        assert_int_equal(file_count(), 0);
    }
    fst_trajectory_discard(NULL);
}

static void bad_names_are_refused(void **state)
{
    (void)state;
    const fst_params params = fst_default_params();
    fst_trajectory *trajectory;
    fst_error error;
    assert_int_equal(fst_trajectory_create(path_of("t", "txt"), &params, &trajectory, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, ".csv");
    assert_null(trajectory);
    for (int e = 0; e < 2; e++) {
        const char *path = path_of("d", endings[e]);
        assert_int_equal(mkdir(path, 0700), 0);
        assert_int_equal(fst_trajectory_create(path, &params, &trajectory, &error), FST_BAD_INPUT);
        CHECK_CONTAINS(error.sentence, "directory");
        assert_int_equal(rmdir(path), 0);
        assert_int_equal(fst_trajectory_create(path_of("none/t", endings[e]), &params, &trajectory, &error),
                         FST_IO);
        CHECK_CONTAINS(error.sentence, "No such file");
    }
}

static void expect_refused(const char *path, const char *part)
{
    fst_table table;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_trajectory_read(path, &table, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.where, path);
    CHECK_CONTAINS(error.sentence, part);
    assert_null(table.columns);
}

static void replace_file(const char *path, const char *contents, size_t size)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(contents, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void foreign_files_are_refused(void **state)
{
    (void)state;
    static const char signature[] = "\x89HDF\r\n\x1a\nand then nothing that HDF5 knows";
    const char *path = path_of("t", "csv");
    expect_refused(path, "No such file");
    expect_refused(directory, "directory");
    expect_refused("/dev/zero", "regular file");
    replace_file(path, "", 0);
    expect_refused(path, "not a trajectory");
    replace_file(path, "\0\0\0\0", 4);
    expect_refused(path, "not a trajectory");
    replace_file(path, "a,b\n1,2\n", 8);
    expect_refused(path, "not a trajectory");
    replace_file(path, "# festoon trajectory\n", 21);
    expect_refused(path, "scene");
    replace_file(path, signature, sizeof signature);
    expect_refused(path, "damaged");
    assert_int_equal(unlink(path), 0);
}

static char *contents_of(const char *path, size_t *size)
{
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    char *contents = malloc(1 << 24);
    assert_non_null(contents);
    *size = fread(contents, 1, 1 << 24, file);
    (void)fclose(file);
    return contents;
}

/* A file that is cut off anywhere is refused, because its last lines say how the run ended. */
static void cut_files_are_refused(void **state)
{
    (void)state;
    for (int e = 0; e < 2; e++) {
        const char *path = path_of("t", endings[e]);
        write_file(path, 50, 1);
        size_t size;
        char *contents = contents_of(path, &size);
        for (size_t cut = 0; cut < size; cut += size / 61 + 1) {
            fst_table table;
            fst_error error = {FST_OK, "", ""};
            replace_file(path, contents, cut);
            assert_int_equal(fst_trajectory_read(path, &table, &error), FST_BAD_INPUT);
            assert_true(strlen(error.sentence) > 5);
        }
        free(contents);
        assert_int_equal(unlink(path), 0);
    }
}

/* A wrong byte among the numbers of a CSV file is reported with its line. */
static void damaged_rows_are_refused(void **state)
{
    (void)state;
    const char *path = path_of("t", "csv");
    write_file(path, 3, 1);
    size_t size;
    char *contents = contents_of(path, &size);
    contents[size] = '\0';
    char *row = strstr(contents, "\nt [1/gamma],");
    assert_non_null(row);
    row = strchr(row + 1, '\n');
    row[1] = 'x';
    replace_file(path, contents, size);
    expect_refused(path, "the column t holds \"x");
    free(contents);
    assert_int_equal(unlink(path), 0);
}

/* A file of three rows whose last one is as `change` makes it; by the writers of the formats themselves,
 * because fst_trajectory_append() refuses such a row. */
static void write_odd_file(const char *path, int hdf5, const char *name, double value)
{
    const fst_column_info *columns[FST_COLUMN_COUNT];
    double values[FST_COLUMN_COUNT];
    const fst_params params = fst_default_params();
    const fst_hdf5_module_table *module = NULL;
    fst_hdf5_writer *writer = NULL;
    fst_error error = {FST_OK, "", ""};
    char *scene = fst_scene_text(&params, 0);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    for (int i = 0; i < FST_COLUMN_COUNT; i++)
        columns[i] = fst_column_at(i);
    if (hdf5) {
        assert_int_equal(fst_load_hdf5_module(&module, path, &error), FST_OK);
        assert_int_equal(module->create(path, columns, FST_COLUMN_COUNT, NULL, scene, &writer, &error), FST_OK);
    } else {
        fst_csv_begin(out, 0, scene, columns, FST_COLUMN_COUNT, NULL);
    }
    for (int i = 0; i < 3; i++) {
        const fst_sample sample = sample_at(i);
        fst_column_values(&sample, values);
        if (i == 2)
            values[column(name)] = value;
        if (hdf5)
            assert_int_equal(module->row(writer, values, NULL, &error), FST_OK);
        else
            fst_csv_row(out, values, FST_COLUMN_COUNT);
    }
    if (hdf5)
        assert_int_equal(module->finish(writer, NULL, 1, out, &error), FST_OK);
    else
        fst_csv_end(out, NULL, 1);
    assert_int_equal(fclose(out), 0);
    free(scene);
}

/* "nan" and "inf" are found in every column, with their place, and are not written. */
static void numbers_that_are_not_finite(void **state)
{
    (void)state;
    const double odd[] = {NAN, INFINITY, -INFINITY};
    const int hdf5_too = fst_module_present(FST_HDF5_MODULE);
    for (int i = 0; i < fst_column_count(); i++)
        for (int e = hdf5_too ? 0 : 1; e < 2; e++) {
            const char *path = path_of("t", endings[e]), *name = fst_column_at(i)->name;
            char part[64];
            write_odd_file(path, e == 0, name, odd[i % 3]);
            (void)snprintf(part, sizeof part, "the column %s holds \"%s\"", name,
                           i % 3 == 0   ? "nan"
                           : i % 3 == 1 ? "inf"
                                        : "-inf");
            expect_refused(path, part);
            fst_table table;
            fst_error error = {FST_OK, "", ""};
            assert_int_equal(fst_trajectory_read(path, &table, &error), FST_BAD_INPUT);
            CHECK_CONTAINS(e == 0 ? error.sentence : error.where, e == 0 ? "row 3" : "t.csv:");
            assert_int_equal(unlink(path), 0);
        }
    for (int e = 0; e < 2; e++) {
        const fst_params params = fst_default_params();
        fst_trajectory *trajectory;
        fst_error error = {FST_OK, "", ""};
        fst_sample sample = sample_at(0);
        sample.seen.slip_norm = NAN;
        if (fst_trajectory_create(path_of("t", endings[e]), &params, &trajectory, &error) == FST_UNAVAILABLE)
            continue;
        assert_int_equal(fst_trajectory_append(trajectory, &sample, &error), FST_BAD_INPUT);
        CHECK_CONTAINS(error.sentence, "slip is nan");
        fst_trajectory_discard(trajectory);
    }
}

/* The trajectory of three rows with its first `count` columns only. */
static void write_old_file(const char *path, int hdf5, int count)
{
    const fst_column_info *columns[FST_COLUMN_COUNT];
    double values[FST_COLUMN_COUNT];
    const fst_params params = fst_default_params();
    const fst_hdf5_module_table *module = NULL;
    fst_hdf5_writer *writer = NULL;
    fst_error error = {FST_OK, "", ""};
    if (!hdf5) {
        write_file(path, 3, 1);
        size_t size;
        char *contents = contents_of(path, &size);
        contents[size] = '\0';
        FILE *out = fopen(path, "w");
        assert_non_null(out);
        for (char *line = strtok(contents, "\n"); line; line = strtok(NULL, "\n")) {
            for (int cut = count; line[0] != '#' && cut < FST_COLUMN_COUNT; cut++)
                *strrchr(line, ',') = '\0';
            (void)fprintf(out, "%s\n", line);
        }
        assert_int_equal(fclose(out), 0);
        free(contents);
        return;
    }
    for (int i = 0; i < FST_COLUMN_COUNT; i++)
        columns[i] = fst_column_at(i);
    char *scene = fst_scene_text(&params, 0);
    assert_int_equal(fst_load_hdf5_module(&module, path, &error), FST_OK);
    assert_int_equal(module->create(path, columns, count, NULL, scene, &writer, &error), FST_OK);
    for (int i = 0; i < 3; i++) {
        const fst_sample sample = sample_at(i);
        fst_column_values(&sample, values);
        assert_int_equal(module->row(writer, values, NULL, &error), FST_OK);
    }
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    assert_int_equal(module->finish(writer, NULL, 1, out, &error), FST_OK);
    assert_int_equal(fclose(out), 0);
    free(scene);
}

/* A trajectory of before beads could fly is read, with a bead that stays on the plate; one that has only some
 * of the columns of a flight is damaged. */
static void files_without_flights(void **state)
{
    (void)state;
    for (int e = fst_module_present(FST_HDF5_MODULE) ? 0 : 1; e < 2; e++) {
        const char *path = path_of("t", endings[e]);
        fst_table table;
        fst_error error = {FST_OK, "", ""};
        write_old_file(path, e == 0, column("z"));
        if (fst_trajectory_read(path, &table, &error) != FST_OK)
            fail_msg("%s: %s", error.where, error.sentence);
        assert_int_equal(table.rows, 3);
        for (int i = 0; i < 3; i++) {
            CHECK_SAME_BITS(table.columns[column("t")][i], sample_at(i).t);
            CHECK_SAME_BITS(table.columns[column("load")][i], sample_at(i).seen.load);
            CHECK_SAME_BITS(table.columns[column("z")][i], 0.0);
            CHECK_SAME_BITS(table.columns[column("vz")][i], 0.0);
            CHECK_SAME_BITS(table.columns[column("flying")][i], 0.0);
        }
        fst_table_free(&table);
        assert_int_equal(unlink(path), 0);
        for (int count = column("z") - 1; count < FST_COLUMN_COUNT; count++) {
            write_old_file(path, e == 0, count);
            if (count != column("z"))
                expect_refused(path, count < column("z") ? "the column" : "is missing");
            assert_int_equal(unlink(path), 0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_give_back_every_bit),   cmocka_unit_test(discarding_leaves_nothing),
        cmocka_unit_test(bad_names_are_refused),       cmocka_unit_test(foreign_files_are_refused),
        cmocka_unit_test(cut_files_are_refused),       cmocka_unit_test(damaged_rows_are_refused),
        cmocka_unit_test(numbers_that_are_not_finite), cmocka_unit_test(files_without_flights),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
