/* Quantities that have several forms: every two forms that clash, given by fst_params_set() or written into the
 * struct, in each order and in one go.
 * tests: model/forms.c model/param_table.c */
#include "keys.h"
#include "same_params.h"

#include <stdlib.h>

#include <festoon/festoon_tools.h>

/* A number in the range of every form, and the default of none. */
static double number_for(const char *key)
{
    return fmax(0.5, 2.0 * fst_param_at(fst_param_find(key))->least);
}

static void set_number(fst_params *params, const char *key)
{
    char text[32];
    const fst_unit unit =
        fst_param_at(fst_param_find(key))->unit; /* with it, for without it some values are doubted */
    (void)snprintf(text, sizeof text, "%.17g %s", number_for(key),
                   unit == FST_UNIT_NUMBER ? "" : fst_unit_name(unit));
    set(params, key, text);
}

static void write_value(fst_params *params, const char *key, double value)
{
    memcpy((char *)params + fst_param_at(fst_param_find(key))->offset, &value, sizeof value);
}

static void write_number(fst_params *params, const char *key)
{
    write_value(params, key, number_for(key));
}

/* Setups in which different forms clash. */
enum { LINES, LINES_WITH_MOMENT, PARTS, BASES };

static fst_params base_of(int which)
{
    static const char *const parts[][2] = {{"magnet.shape", "parts"},
                                           {"magnet.parts[0].kind", "dipole"},
                                           {"magnet.parts[0].centre[2]", "-1 m"},
                                           {"magnet.parts[0].moment[0]", "1"}};
    fst_params params = fst_default_params();
    for (size_t i = 0; which == PARTS && i < sizeof parts / sizeof *parts; ++i)
        set(&params, parts[i][0], parts[i][1]);
    if (which == LINES_WITH_MOMENT) {
        set(&params, "bead.moment", "0.0625");
        set(&params, "magnet.b0", "8 mT");
    }
    return params;
}

static fst_status groups_of(const fst_params *params, fst_groups *groups, fst_error *error)
{
    fst_model *model;
    memset(groups, 0, sizeof *groups);
    const fst_status status = fst_model_new(params, &model, error);
    if (status == FST_OK)
        *groups = fst_model_groups(model);
    fst_model_free(model);
    return status;
}

static void check_same_groups(const fst_params *actual, const fst_params *expected)
{
    fst_groups a, b;
    fst_error error = {FST_OK, "", ""};
    const fst_status status = groups_of(expected, &b, &error), found = groups_of(actual, &a, &error);
    assert_int_equal(found, status); /* remanence beside lines without B0 is refused */
    CHECK_SAME_BITS(a.eps, b.eps);
    CHECK_SAME_BITS(a.h, b.h);
    CHECK_SAME_BITS(a.lambda, b.lambda);
    CHECK_SAME_BITS(a.kappa, b.kappa);
    CHECK_SAME_BITS(a.omega, b.omega);
    CHECK_SAME_BITS(a.mass, b.mass);
    CHECK_SAME_BITS(a.field_unit, b.field_unit);
}

/* All that can be asked of parameters: the model, each key as text, the scene, the JSON, mass and moment. */
static void check_alike(const fst_params *actual, const fst_params *expected)
{
    fst_params settled = *actual;
    char one[FST_PARAM_TEXT_SIZE], two[FST_PARAM_TEXT_SIZE];
    check_same_groups(actual, expected);
    for (int i = 0; i < fst_params_row_count(expected); ++i) {
        (void)fst_params_get(actual, i, one, sizeof one);
        (void)fst_params_get(expected, i, two, sizeof two);
        assert_string_equal(one, two);
    }
    char *texts[] = {fst_scene_text(actual, 1), fst_scene_text(expected, 1), fst_scene_json(actual),
                     fst_scene_json(expected)};
    assert_string_equal(texts[0], texts[1]);
    assert_string_equal(texts[2], texts[3]);
    for (int i = 0; i < 4; ++i)
        free(texts[i]);
    CHECK_SAME_BITS(fst_bead_mass(actual), fst_bead_mass(expected));
    CHECK_SAME_BITS(fst_bead_moment(actual), fst_bead_moment(expected));
    assert_int_equal(fst_params_settle(&settled, NULL), FST_OK);
    check_same_params(&settled, expected);
}

/* `one` and then `two`, each by either door. */
static void check_one_after_the_other(const fst_params *base, const char *one, const char *two)
{
    char text[64];
    fst_params by_setters = *base, setter_field = *base, field_setter = *base, by_fields = *base;
    set_number(&by_setters, one);
    set_number(&by_setters, two);
    assert_true(fst_params_get(&by_setters, fst_param_find(two), text, sizeof text) > 0);
    assert_int_equal(fst_params_get(&by_setters, fst_param_find(one), text, sizeof text), 0);
    set_number(&setter_field, one);
    write_number(&setter_field, two);
    check_alike(&setter_field, &by_setters);
    write_number(&field_setter, one);
    set_number(&field_setter, two);
    check_alike(&field_setter, &by_setters);
    write_number(&by_fields, one);
    assert_int_equal(fst_params_settle(&by_fields, NULL), FST_OK);
    write_number(&by_fields, two);
    check_alike(&by_fields, &by_setters);
}

/* Both written in one go: refused with both names, shown as they are, and mended by either door. */
static void check_in_one_go(const fst_params *base, const char *one, const char *two)
{
    fst_params both = *base, only = *base, read = *base;
    fst_groups groups;
    fst_error error = {FST_OK, "", ""};
    char text[64];
    write_number(&both, one);
    write_number(&both, two);
    const fst_params before = both;
    assert_int_equal(groups_of(&both, &groups, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, one);
    CHECK_CONTAINS(error.sentence, two);
    assert_int_equal(fst_params_settle(&both, NULL), FST_BAD_INPUT);
    assert_int_equal(fst_params_set(&both, "magnet.lines", "3", NULL), FST_BAD_INPUT);
    check_same_params(&both, &before);
    assert_true(fst_params_get(&both, fst_param_find(one), text, sizeof text) > 0);
    assert_true(fst_params_get(&both, fst_param_find(two), text, sizeof text) > 0);
    char *scene = fst_scene_text(&both, 0);
    assert_int_equal(fst_scene_parse(scene, strlen(scene), "both.yaml", &read, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "keep one");
    free(scene);
    set_number(&only, one);
    write_value(&both, two, NAN);
    check_alike(&both, &only);
    both = before;
    set_number(&both, one);
    check_alike(&both, &only);
}

static void each_form_clears_the_others(void **state)
{
    (void)state;
    int clashes[BASES] = {0};
    for (int which = 0; which < BASES; ++which) {
        const fst_params base = base_of(which);
        for (int i = 0; i < fst_param_count(); ++i)
            for (int j = 0; j < fst_param_count(); ++j) {
                const char *one = fst_param_at(i)->key, *two = fst_param_at(j)->key;
                if (!fst_params_clash(&base, one, two))
                    continue;
                assert_true(fst_params_clash(&base, two, one));
                check_one_after_the_other(&base, one, two);
                check_in_one_go(&base, one, two);
                ++clashes[which];
            }
    }
    /* Nine pairs, in both orders; kappa clashes with B0, or beside a real magnet with both forms of the
     * moment. */
    assert_int_equal(clashes[LINES], 16);
    assert_int_equal(clashes[LINES_WITH_MOMENT], 18);
    assert_int_equal(clashes[PARTS], 20);
}

/* Each pair of the table clashes somewhere, and no key with itself. */
static void each_pair_clashes(void **state)
{
    (void)state;
    for (int i = 0; i < fst_param_count(); ++i) {
        const char *key = fst_param_at(i)->key, *other = fst_param_other_form(key);
        int clashes = 0;
        for (int which = 0; which < BASES; ++which) {
            const fst_params base = base_of(which);
            clashes += other && fst_params_clash(&base, key, other);
            assert_false(fst_params_clash(&base, key, key));
        }
        assert_int_equal(clashes > 0, other != NULL);
        if (other)
            assert_string_equal(fst_param_other_form(other), key);
    }
}

/* B0 written beside kappa is its scale, unless a moment is there too. */
static void kappa_keeps_its_scale(void **state)
{
    (void)state;
    fst_groups groups;
    fst_params params = fst_default_params();
    params.model_kappa = 2.0;
    params.magnet_b0 = 0.01;
    assert_int_equal(groups_of(&params, &groups, NULL), FST_OK);
    CHECK_SAME_BITS(groups.kappa, 2.0);
    CHECK_SAME_BITS(groups.field_unit, 0.01);
    params.bead_moment = 0.1; /* the three contradict each other */
    assert_int_equal(groups_of(&params, &groups, NULL), FST_BAD_INPUT);
    params = fst_default_params();
    set(&params, "bead.remanence", "1.2");
    params.model_kappa = 2.0; /* takes the place of the remanence */
    params.magnet_b0 = 0.01;
    assert_int_equal(groups_of(&params, &groups, NULL), FST_OK);
    CHECK_SAME_BITS(groups.kappa, 2.0);
    params.bead_remanence = 1.1;
    assert_int_equal(groups_of(&params, &groups, NULL), FST_BAD_INPUT);
}

/* A key that was set and taken back leaves nothing behind, nor does a form that it displaced. */
static void keys_are_taken_back(void **state)
{
    (void)state;
    fst_error error;
    for (int which = 0; which < BASES; ++which)
        for (int i = 0; i < fst_param_count(); ++i) {
            const fst_param_info *info = fst_param_at(i);
            const fst_params untouched = base_of(which);
            fst_params params = untouched, expected = untouched;
            const int is_form = fst_param_other_form(info->key) != NULL;
            if (is_form)
                set_number(&params, info->key);
            if (info->kind == FST_KIND_TEXT)
                set(&params, info->key, "abc");
            assert_int_equal(fst_params_unset(&params, info->key, NULL), FST_OK);
            assert_int_equal(fst_params_unset(&expected, info->key, NULL), FST_OK);
            if (which == LINES) {
                check_same_params(&expected, &untouched);
                check_alike(&params, &untouched);
            }
            char text[FST_PARAM_TEXT_SIZE];
            if (isnan(info->initial) && info->kind == FST_KIND_REAL)
                assert_int_equal(fst_params_get(&params, i, text, sizeof text), 0);
        }
    fst_params parts = base_of(PARTS);
    set(&parts, "model.kappa", "1.5"); /* given, though it is the default */
    assert_int_equal(fst_params_unset(&parts, "model.kappa", NULL), FST_OK);
    const fst_params untouched = base_of(PARTS);
    check_alike(&parts, &untouched);
    assert_int_equal(fst_params_unset(&parts, "drive.omga", &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "nearest is drive.omega");
    assert_int_equal(fst_params_unset(&parts, "magnet.parts[0].kind", &error), FST_BAD_INPUT);
    check_same_params(&parts, &untouched);
}

/* A run reads the form that was written last, and so does a ramp, which puts its own drive in its place. */
static void runs_obey_fields(void **state)
{
    (void)state;
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    fst_params params = fst_default_params();
    set(&params, "run.periods", "2");
    set(&params, "drive.omega", "0.3");
    params.drive_frequency = 12.0;
    assert_int_equal(fst_run(&params, &options, &result, NULL), FST_OK);
    CHECK_SAME_BITS(result.frequency_hz, 12.0);
    options.ramp_from = 0.25;
    options.ramp_to = 0.26;
    assert_int_equal(fst_run(&params, &options, &result, NULL), FST_OK);
    CHECK_CLOSE(result.omega, 0.26, 1e-12);
    params.drive_omega = 0.4;
    assert_int_equal(fst_run(&params, &options, &result, NULL), FST_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_form_clears_the_others),
        cmocka_unit_test(each_pair_clashes),
        cmocka_unit_test(kappa_keeps_its_scale),
        cmocka_unit_test(keys_are_taken_back),
        cmocka_unit_test(runs_obey_fields),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
