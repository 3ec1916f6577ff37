/* Scenes: which values are read, which are refused with which sentence at which line, and that writing and
 * reading again changes no bit.
 * tests: io/scene.c io/scene_reader.c io/scene_text.c host/regular_file.c
 * labels: bits */
#include "same_params.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <festoon/festoon_tools.h>

static fst_status parse(const char *text, fst_params *params, fst_error *error)
{
    *params = fst_default_params();
    return fst_scene_parse(text, strlen(text), "s.yaml", params, error);
}

static void scenes_are_read(void **state)
{
    (void)state;
    fst_params params;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(parse("bead:\n  radius: 3 mm # comment\n  material: mixed\ndrive: {frequency: 642 rpm}\n"
                           "magnet.lines: 1\nstart.phi: '0.5 turn'\n",
                           &params, &error),
                     FST_OK);
    CHECK_SAME_BITS(params.bead_radius, 0.003);
    CHECK_SAME_BITS(params.drive_frequency, 10.7);
    CHECK_SAME_BITS(params.start_phi, 180.0);
    assert_int_equal(params.bead_material, FST_MATERIAL_MIXED);
    assert_int_equal(params.magnet_lines, 1);
    const fst_params defaults = fst_default_params();
    CHECK_SAME_BITS(params.bead_mass, defaults.bead_mass);
}

/* An empty file changes nothing. */
static void empty_scenes_are_defaults(void **state)
{
    (void)state;
    static const char *const texts[] = {"",      "\n\n",       "# only a comment\n",
                                        "---\n", "---\n...\n", "\xEF\xBB\xBF# BOM\n"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        fst_params params, defaults = fst_default_params();
        fst_error error = {FST_OK, "", ""};
        if (parse(texts[i], &params, &error) != FST_OK)
            fail_msg("\"%s\": %s", texts[i], error.sentence);
        check_same_params(&params, &defaults);
    }
}

static void bad_scenes_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *where, *sentence;
    } bad[] = {
        {"bead:\n  raduis: 1 mm\n", "s.yaml:2", "bead.radius"},
        {"baed:\n  radius: 1 mm\n", "s.yaml:1", "bead"},
        {"bead.raduis: 1 mm\n", "s.yaml:1", "bead.radius"},
        {"bead:\n  radius: 1 Hz\n", "s.yaml:2", "um mm cm m"},
        {"bead:\n  radius: 2 m\n", "s.yaml:2", "out of range"},
        {"bead:\n  radius: 1 mm\n\n  radius: 1 mm\n", "s.yaml:4", "first on line 2"},
        {"bead.radius: 1 mm\nbead:\n  radius: 1 mm\n", "s.yaml:3", "first on line 1"},
        {"bead:\n  mass: 1 g\nbead:\n  radius: 1 mm\n", "s.yaml:3", "group bead is given twice"},
        {"bead: &b\n  radius: 1 mm\n", "s.yaml:1", "anchors"},
        {"bead:\n  radius: &r 1 mm\n", "s.yaml:2", "anchors"},
        {"bead:\n  radius: *r\n", "s.yaml:2", "aliases"},
        {"<<: *b\n", "s.yaml:1", "aliases"},
        {"bead:\n  radius: !!str 1 mm\n", "s.yaml:2", "tags"},
        {"!scene\nbead:\n  radius: 1 mm\n", "s.yaml:1", "tags"},
        {"drive:\n  frequency: 10 Hz\n  omega: 0.2\n", "s.yaml:3", "drive.frequency on line 2"},
        {"drive:\n  omega: 0.2\n  frequency: 10 Hz\n", "s.yaml:3", "drive.omega on line 2"},
        {"bead:\n  radius: 1 mm\nmodel:\n  eps: 0.1\n", "s.yaml:4", "bead.radius on line 2"},
        {"start:\n  r: 1\n  position: [1 mm, 2 mm, 3 mm]\n", "s.yaml:3", "start.r on line 2"},
        {"start:\n  position: [1 mm, 2 mm, 0, 0]\n", "s.yaml:2", "start.position[3]"},
        {"start:\n  position: [1 mm, [2 mm], 0]\n", "s.yaml:2", "list within a list"},
        {"start:\n  position: 1 mm\n", "s.yaml:2", "list of numbers"},
        {"start:\n  n:\n    - 1\n    - 1 mm\n    - 0\n", "s.yaml:4", "start.n[1]"},
        {"model:\n  h: 0.8\nmagnet:\n  depth: 1 mm\n", "s.yaml:4", "model.h on line 2"},
        {"magnet:\n  width: 1 mm\nmodel:\n  lambda: 1\n", "s.yaml:4", "magnet.width on line 2"},
        {"model: {kappa: 1}\nbead: {moment: 1}\nmagnet: {b0: 1 mT}\n", "s.yaml:3", "keep one"},
        {"bead:\n  radius:\n", "s.yaml:2", "no value"},
        {"bead:\n  radius: ~\n", "s.yaml:2", "no value"},
        {"bead:\n", "s.yaml:1", "is a group"},
        {"bead: {}\n", "s.yaml:1", "no keys"},
        {"bead: 1 mm\n", "s.yaml:1", "is a group"},
        {"bead:\n  radius: [1, 2]\n", "s.yaml:2", "not a list"},
        {"bead:\n  radius:\n    value: 1\n", "s.yaml:2", "not a group"},
        {"- bead\n", "s.yaml:1", "groups of keys"},
        {"bead\n", "s.yaml:1", "groups of keys"},
        {"? [a]\n: b\n", "s.yaml:1", "a key must be a word"},
        {"bead: {radius: 1 mm}\n---\nbead: {radius: 2 mm}\n", "s.yaml:2", "one YAML document"},
        {"bead:\n\tradius: 1 mm\n", "s.yaml:2", "not YAML"},
        {"bead: {radius: 1 mm\n", "s.yaml:2", "not YAML"},
        {"bead:\n  radius: \"1 m\\0m\"\n", "s.yaml:2", "no value"},
        {"bead:\n  radius: \"\xC3\x28\"\n", "s.yaml:2", "UTF-8"},
        {"\x01\x02\x03", "s.yaml:1", "UTF-8"},
        {"\xFF\xFE"
         "b",
         "s.yaml:1", "UTF-8"},
        {"model:\n  dynamics: rigit\n", "s.yaml:2", "rigid"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fst_params params, defaults = fst_default_params();
        fst_error error = {FST_OK, "", ""};
        if (parse(bad[i].text, &params, &error) != FST_BAD_INPUT)
            fail_msg("accepted: %s", bad[i].text);
        if (strcmp(error.where, bad[i].where) != 0)
            fail_msg("%s: at %s, expected %s: %s", bad[i].text, error.where, bad[i].where, error.sentence);
        CHECK_CONTAINS(error.sentence, bad[i].sentence);
        check_same_params(&params, &defaults);
        assert_int_equal(parse(bad[i].text, &params, NULL), FST_BAD_INPUT);
    }
}

/* The moment alone, or B0 alone, beside kappa sets only the tesla scale, in any order. */
static void kappa_with_a_tesla_scale(void **state)
{
    (void)state;
    fst_params params;
    assert_int_equal(parse("magnet.b0: 10 mT\nmodel.kappa: 2\n", &params, NULL), FST_OK);
    CHECK_SAME_BITS(params.magnet_b0, 0.01);
    CHECK_SAME_BITS(params.model_kappa, 2.0);
    assert_int_equal(parse("model.kappa: 2\nbead.moment: 0.1\n", &params, NULL), FST_OK);
    CHECK_SAME_BITS(params.bead_moment, 0.1);
    assert_int_equal(parse("magnet.b0: 10 mT\nbead.moment: 0.1\n", &params, NULL), FST_OK);
    CHECK_SAME_BITS(params.magnet_b0, 0.01);
}

static void text_reads_back(const fst_params *params)
{
    for (int commented = 0; commented <= 1; commented++) {
        char *text = fst_scene_text(params, commented);
        assert_non_null(text);
        fst_params back = fst_default_params();
        fst_error error = {FST_OK, "", ""};
        if (fst_scene_parse(text, strlen(text), "text", &back, &error) != FST_OK)
            fail_msg("%s: %s\n%s", error.where, error.sentence, text);
        check_same_params(&back, params);
        free(text);
    }
}

static void scenes_survive_writing(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    text_reads_back(&params);
    static const char *const settings[][2] = {
        {"bead.radius", "1.2345678901234567e-3"},
        {"drive.omega", "0.1"},
        {"model.eps", "0.10869565217391304"},
        {"model.h", "0.8130434782608695"},
        {"model.lambda", "0.4347826086956522"},
        {"drive.frequency", "1 rad/s"},
        {"start.phi", "-1 rad"},
        {"bead.moment", "0.0612 A m2"},
        {"magnet.b0", "12.3 mT"},
        {"model.kappa", "0.3"},
        {"model.dynamics", "farago2020"},
        {"magnet.lines", "1"},
        {"run.rtol", "1e-13"},
        {"start.position[1]", "12 mm"},
        {"start.position[0]", "-1 mm"},
        {"start.position[2]", "3.3 mm"},
    };
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++) {
        assert_int_equal(fst_params_set(&params, settings[i][0], settings[i][1], NULL), FST_OK);
        text_reads_back(&params);
    }
}

/* ---------------------------------------------------------------- files */

static void expect_refused(const char *path, const char *part)
{
    fst_params params = fst_default_params();
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_scene_read(path, &params, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.where, path);
    CHECK_CONTAINS(error.sentence, part);
}

static void files_are_checked(void **state)
{
    (void)state;
    char directory[] = "/tmp/festoon-scene-XXXXXX", path[64];
    assert_non_null(mkdtemp(directory));
    (void)snprintf(path, sizeof path, "%s/s.yaml", directory);
    expect_refused(path, "No such file");
    expect_refused(directory, "directory");
    expect_refused("/dev/null", "regular file");
    assert_int_equal(mkfifo(path, 0600), 0);
    expect_refused(path, "regular file"); /* must not wait for a writer */
    assert_int_equal(unlink(path), 0);

    const fst_params defaults = fst_default_params();
    fst_params params = fst_default_params();
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_scene_write(path, &defaults, 1, 0, &error), FST_OK);
    assert_int_equal(fst_scene_read(path, &params, &error), FST_OK);
    check_same_params(&params, &defaults);
    assert_int_equal(fst_scene_write(path, &defaults, 1, 0, &error), FST_BAD_INPUT);
    assert_int_equal(fst_scene_write(path, &defaults, 0, 1, &error), FST_OK);

    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int i = 0; i < FST_SCENE_SIZE_LIMIT + 1; i++)
        (void)fputc(i % 80 ? '#' : '\n', file);
    assert_int_equal(fclose(file), 0);
    expect_refused(path, "larger");
    assert_int_equal(truncate(path, FST_SCENE_SIZE_LIMIT), 0);
    assert_int_equal(fst_scene_read(path, &params, &error), FST_OK);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(directory), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_are_read),        cmocka_unit_test(empty_scenes_are_defaults),
        cmocka_unit_test(bad_scenes_are_refused), cmocka_unit_test(kappa_with_a_tesla_scale),
        cmocka_unit_test(scenes_survive_writing), cmocka_unit_test(files_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
