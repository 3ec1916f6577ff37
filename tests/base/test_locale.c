/* Numbers in files do not depend on the caller's locale: with a decimal comma, parameters, scenes, trajectories
 * and grids keep every bit. The test makes such a locale where none is installed.
 * tests: base/number.c io/csv.c */
#include "numeric.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <festoon/festoon_tools.h>

#include "base/number.h"

static char folder[] = "/tmp/festoon-locale-XXXXXX";

/* Sets a locale with a decimal comma; 0 if this machine cannot make one. */
static int enter_comma(void)
{
    static const char source[] =
        "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \"\"\ngrouping -1\nEND LC_NUMERIC\n";
    char path[256], command[1024];
    (void)snprintf(path, sizeof path, "%s/comma.source", folder);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    (void)fputs(source, out);
    assert_int_equal(fclose(out), 0);
    (void)snprintf(command, sizeof command, "localedef -c -i %s %s/comma >%s/words 2>&1", path, folder, folder);
    if (system(command) < 0 || setenv("LOCPATH", folder, 1) != 0)
        return 0;
    return setlocale(LC_ALL, "comma") != NULL && strcmp(localeconv()->decimal_point, ",") == 0;
}

static int make_locale(void **state)
{
    (void)state;
    assert_non_null(mkdtemp(folder));
    if (!enter_comma()) {
        print_message("no locale with a decimal comma can be made here (localedef)\n");
        exit(77);
    }
    char text[16];
    (void)snprintf(text, sizeof text, "%g", 1.5);
    assert_string_equal(text, "1,5");
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[256];
    (void)setlocale(LC_ALL, "C");
    (void)snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

static void test_numbers(void **state)
{
    (void)state;
    char text[64];
    assert_true(fst_number_read("2.5", 3, 0) == 2.5);
    assert_true(fst_number_read("2.5e-1", 6, -3) == 2.5e-4);
    (void)fst_number_write(text, sizeof text, 0.1);
    assert_string_equal(text, "0.1");
    fst_params p = fst_default_params();
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_params_set(&p, "bead.radius", "1.25 mm", &error), FST_OK);
    assert_true(p.bead_radius == 1.25e-3);
    assert_string_equal(localeconv()->decimal_point, ","); /* the caller's locale is unchanged */
}

static void test_scenes(void **state)
{
    (void)state;
    fst_params p = fst_default_params(), back = fst_default_params();
    p.start_r = 0.123456789012345678;
    char *text = fst_scene_text(&p, 0);
    assert_non_null(text);
    assert_null(strchr(text, ','));
    assert_int_equal(fst_scene_parse(text, strlen(text), "scene", &back, NULL), FST_OK);
    assert_true(back.start_r == p.start_r);
    free(text);
    text = fst_scene_json(&p);
    CHECK_CONTAINS(text, "\"start.r\": 0.1234567890123456");
    free(text);
}

static void test_trajectories(void **state)
{
    (void)state;
    char path[256];
    fst_error error = {FST_OK, "", ""};
    fst_params p = fst_default_params();
    fst_trajectory *file;
    fst_table table;
    fst_sample sample;
    memset(&sample, 0, sizeof sample);
    sample.t = 1.0 / 3.0;
    sample.state[FST_X] = -0.7;
    (void)snprintf(path, sizeof path, "%s/file.csv", folder);
    assert_int_equal(fst_trajectory_create(path, &p, &file, &error), FST_OK);
    for (int i = 0; i < 3; ++i)
        assert_int_equal(fst_trajectory_append(file, &sample, &error), FST_OK);
    assert_int_equal(fst_trajectory_close(file, NULL, 1, &error), FST_OK);
    if (fst_trajectory_read(path, &table, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
    assert_int_equal(table.rows, 3);
    assert_true(table.columns[0][2] == 1.0 / 3.0);
    assert_true(table.columns[3][2] == -0.7);
    fst_table_free(&table);
}

static void test_grids(void **state)
{
    (void)state;
    const char *axis = "drive.omega=0.1:0.4:3:log";
    fst_params p = fst_default_params(), at;
    fst_grid *grid;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_grid_new(&p, &axis, 1, 0, &grid, &error), FST_OK);
    CHECK_CLOSE(fst_grid_value(grid, 0, 1), 0.2, 1e-14);
    assert_int_equal(fst_grid_params(grid, 1, &at, &error), FST_OK);
    CHECK_CLOSE(at.drive_omega, 0.2, 1e-14);
    fst_grid_free(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_scenes),
        cmocka_unit_test(test_trajectories),
        cmocka_unit_test(test_grids),
    };
    return cmocka_run_group_tests(tests, make_locale, remove_folder);
}
