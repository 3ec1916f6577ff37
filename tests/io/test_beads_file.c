/* Trajectories of several beads in files: what was written is read back, in either format, and what is no such file is
 * refused.
 * tests: io/beads_file.c */
#include "numeric.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <festoon/bead_files.h>
#include <festoon/festoon_tools.h>

enum { BEADS = 3, ROWS = 5 };

static fst_params scene_of_three(void)
{
    static const char text[] = "beads: [{start.phi: 0}, {start.phi: 120, radius: 2 mm}, {start.phi: 240}]\n";
    fst_params scene = fst_default_params();
    assert_int_equal(fst_scene_parse(text, strlen(text), "s.yaml", &scene, NULL), FST_OK);
    return scene;
}

/* Numbers that say where they stand. */
static double number(int row, int bead, int k)
{
    return row + 0.1 * bead + 0.003 * k + 1.0 / 3.0;
}

/* In row r bead 0 touches the plate, and from row 2 on beads 1 and 2 each other. */
static void write_file(const char *path, const fst_params *scene, int complete)
{
    fst_beads_trajectory *trajectory;
    fst_error error;
    if (fst_beads_trajectory_create(path, scene, FST_SHOWN_SCALED, &trajectory, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    for (int row = 0; row < ROWS; ++row) {
        double states[BEADS * FST_BEAD_NUMBERS];
        for (int i = 0; i < BEADS * FST_BEAD_NUMBERS; ++i)
            states[i] = number(row, i / FST_BEAD_NUMBERS, i % FST_BEAD_NUMBERS);
        const fst_bead_touch touches[] = {{{0, -1}, 2.0 + row}, {{2, 1}, 0.0}};
        const fst_beads_sample sample = {0.5 * row, 0.1 * row, BEADS, states, row < 2 ? 1 : 2, touches};
        assert_int_equal(fst_beads_trajectory_append(trajectory, &sample, NULL), FST_OK);
    }
    assert_int_equal(fst_beads_trajectory_close(trajectory, NULL, complete, NULL), FST_OK);
}

static void check_table(const fst_beads_table *table, int complete)
{
    assert_int_equal(table->rows, ROWS);
    assert_int_equal(table->count, BEADS);
    assert_int_equal(table->complete, complete);
    assert_int_equal(table->scene.bead_count, BEADS);
    CHECK_CLOSE(table->radii[1], 2.0 / 23.0, 1e-15);
    CHECK_CLOSE(table->radii[2], 2.5 / 23.0, 1e-15);
    for (int row = 0; row < ROWS; ++row) {
        CHECK_SAME_BITS(table->t[row], 0.5 * row);
        CHECK_SAME_BITS(table->drive_turns[row], 0.1 * row);
        for (int bead = 0; bead < BEADS; ++bead)
            for (int k = 0; k < FST_BEAD_NUMBERS; ++k)
                CHECK_SAME_BITS(fst_beads_table_state(table, (size_t)row, bead)[k], number(row, bead, k));
        const fst_bead_touch *touch = table->touches + table->first[row];
        assert_int_equal(table->first[row + 1] - table->first[row], row < 2 ? 1 : 2);
        assert_true(touch[0].beads[0] == 0 && touch[0].beads[1] == -1);
        CHECK_SAME_BITS(touch[0].force, 2.0 + row);
        assert_true(row < 2 || (touch[1].beads[0] == 1 && touch[1].beads[1] == 2 && touch[1].force == 0.0));
    }
}

static void come_back(void **unused)
{
    (void)unused;
    static const char *const names[] = {"beads.h5", "beads.csv"};
    const fst_params scene = scene_of_three();
    char directory[] = "/tmp/festoon-beads-XXXXXX", path[64];
    assert_non_null(mkdtemp(directory));
    for (int i = 0; i < 4; ++i) {
        fst_beads_table table;
        fst_table single;
        fst_error error;
        int has_beads = 0;
        (void)snprintf(path, sizeof path, "%s/%s", directory, names[i / 2]);
        write_file(path, &scene, i % 2);
        if (fst_beads_trajectory_read(path, &table, &error) != FST_OK)
            fail_msg("%s: %s", names[i / 2], error.sentence);
        check_table(&table, i % 2);
        fst_beads_table_free(&table);
        assert_int_equal(fst_trajectory_has_beads(path, &has_beads, NULL), FST_OK);
        assert_int_equal(has_beads, 1);
        assert_int_equal(fst_trajectory_read(path, &single, &error), FST_BAD_INPUT);
        assert_non_null(strstr(error.sentence, "several beads"));
        assert_int_equal(unlink(path), 0);
    }
    assert_int_equal(rmdir(directory), 0);
}

/* A list of more beads than have keys: the scene in the file has all of them, and the table owns them. */
static void a_long_list(void **unused)
{
    (void)unused;
    enum { MANY = 12 };
    static const char text[] =
        "beads: [{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {start.phi: 77}]\nrun: {method: stepping}\n";
    static const char *const names[] = {"many.h5", "many.csv"};
    fst_params scene = fst_default_params();
    fst_bead_params *beads;
    char directory[] = "/tmp/festoon-beads-XXXXXX", path[64];
    assert_int_equal(fst_scene_parse(text, strlen(text), "s.yaml", &scene, NULL), FST_BAD_INPUT);
    assert_int_equal(fst_scene_parse_beads(text, strlen(text), "s.yaml", &scene, &beads, NULL), FST_OK);
    assert_non_null(mkdtemp(directory));
    for (int i = 0; i < 2; ++i) {
        double states[MANY * FST_BEAD_NUMBERS] = {0};
        const fst_bead_touch touches[] = {{{11, -1}, 3.0}, {{2, 1}, 1.0}};
        const fst_beads_sample sample = {0.0, 0.0, MANY, states, 2, touches};
        fst_beads_trajectory *trajectory;
        fst_beads_table table;
        (void)snprintf(path, sizeof path, "%s/%s", directory, names[i]);
        assert_int_equal(fst_beads_trajectory_create(path, &scene, FST_SHOWN_SCALED, &trajectory, NULL),
                         FST_OK);
        assert_int_equal(fst_beads_trajectory_append(trajectory, &sample, NULL), FST_OK);
        assert_int_equal(fst_beads_trajectory_close(trajectory, NULL, 1, NULL), FST_OK);
        assert_int_equal(fst_beads_trajectory_read(path, &table, NULL), FST_OK);
        assert_int_equal(table.count, MANY);
        assert_int_equal(table.first[1], 1); /* the plate's contact alone: there are no columns of pairs */
        assert_int_equal(table.touches[0].beads[0], 11);
        CHECK_SAME_BITS(table.scene.bead_list[11].start_phi, 77.0);
        fst_beads_table_free(&table);
        assert_int_equal(unlink(path), 0);
    }
    free(beads);
    assert_int_equal(rmdir(directory), 0);
}

/* A world is a list of one: its file says the frame, and is none of a bead on the plate. */
static void of_a_world(void **unused)
{
    (void)unused;
    static const char *const texts[] = {"medium: {density: 1000}\n", "plate: {tilt: 1}\nmagnet: {b0: 7 mT}\n"};
    static const char *const names[] = {"world.h5", "world.csv"};
    char directory[] = "/tmp/festoon-beads-XXXXXX", path[64];
    assert_non_null(mkdtemp(directory));
    for (int i = 0; i < 4; ++i) {
        fst_params scene = fst_default_params();
        fst_beads_trajectory *trajectory;
        fst_beads_table table;
        fst_table single;
        fst_error error;
        int has_beads = 0;
        double state[FST_BEAD_NUMBERS];
        assert_int_equal(fst_scene_parse(texts[i % 2], strlen(texts[i % 2]), "w.yaml", &scene, NULL), FST_OK);
        (void)snprintf(path, sizeof path, "%s/%s", directory, names[i / 2]);
        for (int k = 0; k < FST_BEAD_NUMBERS; ++k)
            state[k] = number(0, 0, k);
        const fst_beads_sample sample = {0.25, 0.5, 1, state, 1, &(fst_bead_touch){{0, -1}, 3.0}};
        assert_int_equal(fst_beads_trajectory_create(path, &scene, FST_SHOWN_SCALED, &trajectory, NULL),
                         FST_OK);
        assert_int_equal(fst_beads_trajectory_append(trajectory, &sample, NULL), FST_OK);
        assert_int_equal(fst_world_trajectory_close(trajectory, NULL, 1, NULL), FST_OK);
        if (fst_beads_trajectory_read(path, &table, &error) != FST_OK)
            fail_msg("%s: %s", names[i / 2], error.sentence);
        assert_true(table.count == 1 && table.rows == 1 && table.complete);
        assert_int_equal(table.frame, i % 2 ? FST_FRAME_LABORATORY : FST_FRAME_TURNING);
        assert_memory_equal(fst_beads_table_state(&table, 0, 0), state, sizeof state);
        CHECK_SAME_BITS(table.touches[0].force, 3.0);
        CHECK_CLOSE(table.radii[0], 2.5 / 23.0, 1e-15);
        fst_beads_table_free(&table);
        assert_int_equal(fst_trajectory_has_beads(path, &has_beads, NULL), FST_OK);
        assert_int_equal(has_beads, 1);
        assert_int_equal(fst_trajectory_read(path, &single, &error), FST_BAD_INPUT);
        assert_non_null(strstr(error.sentence, "of a world"));
        assert_int_equal(unlink(path), 0);
    }
    assert_int_equal(rmdir(directory), 0);
}

/* The line of a CSV is changed by hand. */
static void refused(void **unused)
{
    (void)unused;
    const fst_params scene = scene_of_three();
    fst_params many = scene;
    fst_beads_trajectory *trajectory;
    fst_beads_table table;
    fst_error error;
    char directory[] = "/tmp/festoon-beads-XXXXXX", path[64], line[8192];
    assert_non_null(mkdtemp(directory));
    (void)snprintf(path, sizeof path, "%s/beads.csv", directory);
    write_file(path, &scene, 1);
    FILE *file = fopen(path, "r+");
    assert_non_null(file);
    long at = 0;
    while (fgets(line, sizeof line, file) && strncmp(line, "1,", 2) != 0) /* the row at t = 1 */
        at = ftell(file);
    assert_int_equal(fseek(file, at, SEEK_SET), 0);
    assert_int_equal(fputs("0", file), 1); /* its time falls */
    assert_int_equal(fclose(file), 0);
    assert_int_equal(fst_beads_trajectory_read(path, &table, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "times rise"));
    assert_int_equal(fst_beads_trajectory_read("/nowhere/x.h5", &table, &error), FST_BAD_INPUT);
    const fst_params flat = fst_default_params();
    assert_int_equal(fst_beads_trajectory_create(path, &flat, FST_SHOWN_SCALED, &trajectory, &error),
                     FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "lists no beads"));
    many.bead_count = 100;
    assert_int_equal(fst_beads_trajectory_create(path, &many, FST_SHOWN_SCALED, &trajectory, &error),
                     FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "choose .h5"));
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(directory), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(come_back), cmocka_unit_test(a_long_list),
                                       cmocka_unit_test(of_a_world), cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
