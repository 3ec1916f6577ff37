/* test_caption.c - the line below a figure's title names what is not the default, each key of the table once.
 * tests: draw/caption.c */
#include "numeric.h"

#include <stdio.h>
#include <string.h>

#include <festoon/festoon.h>
#include "draw/caption.h"

/* Another value of a row that it may have; NULL: a text. */
static const char *another(const fst_param_info *row, char text[64])
{
    if (row->kind == FST_KIND_TEXT)
        return NULL;
    if (row->kind ==
        FST_KIND_CHOICE) { /* the second of the names, or the first where the default is the second */
        const char *second = strchr(row->names, '|') + 1;
        const char *chosen = row->initial == 1 ? row->names : second;
        (void)snprintf(text, 64, "%.*s", (int)strcspn(chosen, "|"), chosen);
        return text;
    }
    const double least = row->least > 0 ? row->least : 0;
    const double value =
        isnan(row->initial) || row->initial == least ? fmin(row->greatest, 2 * least + 1) : least;
    (void)snprintf(text, 64, "%.17g", value);
    return text;
}

static void each_key_is_named(void **state)
{
    (void)state;
    int named = 0;
    for (int i = 0; i < fst_param_count(); ++i) {
        const fst_param_info *row = fst_param_at(i);
        char value[64], text[256] = "";
        fst_params params = fst_default_params();
        if (!another(row, value) || fst_params_set(&params, row->key, value, NULL) != FST_OK)
            continue;
        fst_caption(&params, NULL, 0, text, sizeof text);
        const int told = strncmp(row->key, "run.", 4) != 0 && strcmp(row->key, "world.frame") != 0;
        const char *place = strstr(text, row->key);
        assert_int_equal(place != NULL, told);
        if (!told)
            continue;
        ++named;
        assert_null(strstr(place + 1, row->key));
        const char *keys[] = {row->key};
        char silent[256] = "";
        fst_caption(&params, keys, 1, silent, sizeof silent);
        assert_null(strstr(silent, row->key));
    }
    assert_true(named > 40);
}

/* Of three scenes, the third like the first: each key differs once, and then is not what all have in common.  What runs do not
 * depend on tells none from another. */
static void each_difference_is_named(void **state)
{
    (void)state;
    int named = 0, counted = 0;
    for (int i = 0; i < fst_param_count(); ++i) {
        const fst_param_info *row = fst_param_at(i);
        char value[64], wanted[FST_CAPTION_SIZE], names[3][FST_CAPTION_SIZE], same[FST_CAPTION_SIZE];
        const fst_params usual = fst_default_params();
        fst_params params = usual;
        const fst_params *const different[3] = {&usual, &params, &usual}, *const equal[2] = {&params, &params};
        if (!another(row, value) || fst_params_set(&params, row->key, value, NULL) != FST_OK ||
            strncmp(row->key, "run.", 4) == 0 || strcmp(row->key, "world.frame") == 0)
            continue;
        wanted[0] = '\0';
        fst_caption(&params, NULL, 0, wanted, sizeof wanted);
        fst_caption_differences(different, 3, NULL, 0, names, same, sizeof same);
        const int counts = fst_params_changes(&usual, &params) != FST_CHANGE_NOTHING;
        assert_string_equal(names[1], counts ? wanted : "");
        assert_string_equal(names[0], names[2]);
        assert_int_equal(strcmp(names[0], names[1]) != 0, counts);
        assert_int_equal(strstr(names[1], row->key) != NULL, counts);
        counted += counts;
        assert_string_equal(same, "");
        fst_caption_differences(equal, 2, NULL, 0, names, same, sizeof same);
        assert_string_equal(names[0], "");
        assert_string_equal(same, wanted);
        fst_caption_differences(different, 3, (const char *[]){row->key}, 1, names, same, sizeof same);
        assert_null(strstr(names[1], row->key));
        ++named;
    }
    assert_true(named > 40 && counted > 30);
}

/* friction.mu counts under dry friction alone, wherever the scene with it stands. */
static void what_does_not_count_is_left_out(void **state)
{
    (void)state;
    char names[2][FST_CAPTION_SIZE], same[FST_CAPTION_SIZE];
    fst_params viscous = fst_default_params(), dry = viscous;
    assert_int_equal(fst_params_set(&dry, "friction.law", "coulomb", NULL), FST_OK);
    assert_int_equal(fst_params_set(&dry, "friction.mu", "0.3", NULL), FST_OK);
    for (int i = 0; i < 2; ++i) {
        const fst_params *const scenes[2] = {i ? &dry : &viscous, i ? &viscous : &dry};
        fst_caption_differences(scenes, 2, NULL, 0, names, same, sizeof same);
        assert_string_equal(names[i], "friction.law viscous");
        assert_string_equal(names[1 - i], "friction.law coulomb, friction.mu 0.3");
        assert_string_equal(same, "");
    }
}

static void values_have_their_units(void **state)
{
    (void)state;
    char text[256] = "dynamics rigid";
    fst_params params = fst_default_params();
    fst_caption(&params, NULL, 0, text, sizeof text);
    assert_string_equal(text, "dynamics rigid");
    assert_int_equal(fst_params_set(&params, "friction.law", "coulomb", NULL), FST_OK);
    assert_int_equal(fst_params_set(&params, "bead.radius", "2 mm", NULL), FST_OK);
    fst_caption(&params, NULL, 0, text, sizeof text);
    assert_string_equal(text, "dynamics rigid, bead.radius 2 mm, friction.law coulomb");
}

/* Many differences: what has no room is counted. */
static void what_has_no_room_is_counted(void **state)
{
    (void)state;
    char text[256] = "", value[64];
    int all = 0, told = 0, left = 0;
    fst_params params = fst_default_params();
    for (int i = 0; i < fst_param_count(); ++i) {
        const fst_param_info *row = fst_param_at(i);
        if (strncmp(row->key, "start.", 6) == 0 || strncmp(row->key, "plate.", 6) == 0)
            all += another(row, value) && fst_params_set(&params, row->key, value, NULL) == FST_OK;
    }
    fst_caption(&params, NULL, 0, text, sizeof text);
    const char *more = strstr(text, " and ");
    assert_non_null(more);
    assert_int_equal(sscanf(more, " and %d more", &left), 1);
    for (const char *at = text; at && at < more; at = strstr(at + 1, ", "))
        ++told;
    assert_int_equal(told + left, all);
}

/* One key that has no room in two lines is told rather than counted; of two scenes of which one has room, by both. */
static void one_more_is_named(void **state)
{
    (void)state;
    static const char *const sets[][2] = {
        {"bead.radius", "2.123456 mm"},        {"bead.mass", "0.9876543 g"},
        {"magnet.half_length", "31.23456 mm"}, {"magnet.depth", "12.34567 mm"},
        {"friction.gamma", "123.4567 1/s"},    {"plate.radius", "123.45678 mm"}};
    char text[256] = "", names[2][FST_CAPTION_SIZE], same[FST_CAPTION_SIZE];
    fst_params one = fst_default_params(), other;
    for (int i = 0; i < 6; ++i) {
        assert_null(strstr(text, " more"));
        assert_int_equal(fst_params_set(&one, sets[i][0], sets[i][1], NULL), FST_OK);
        text[0] = '\0';
        fst_caption(&one, NULL, 0, text, sizeof text);
    }
    assert_true(strlen(text) > 150 && strlen(text) < 190);
    for (int i = 0; i < 6; ++i)
        assert_non_null(strstr(text, sets[i][0]));
    other = one;
    other.plate_radius = 0.2;
    other.bead_radius = 1e-3;
    other.bead_mass = 1e-3;
    other.magnet_half_length = 0.03;
    other.magnet_depth = 0.01;
    other.friction_gamma = 300;
    fst_caption_differences((const fst_params *[]){&one, &other}, 2, NULL, 0, names, same, sizeof same);
    assert_string_equal(names[0], text);
    for (int i = 0; i < 6; ++i) {
        const char *place = strstr(names[1], sets[i][0]);
        assert_true(place && !strstr(place + 1, sets[i][0]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_key_is_named),
                                       cmocka_unit_test(each_difference_is_named),
                                       cmocka_unit_test(what_does_not_count_is_left_out),
                                       cmocka_unit_test(values_have_their_units),
                                       cmocka_unit_test(what_has_no_room_is_counted),
                                       cmocka_unit_test(one_more_is_named)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
