/* Beads of a list: their keys, what each says of its own, and what the setup says for it.
 * tests: model/bead_list.c model/bead_rows.c model/list_rows.c */
#include "keys.h"
#include "numeric.h"

#include <stdio.h>

#include <festoon/festoon.h>

static fst_params alone(const fst_params *p, int bead)
{
    fst_params one;
    assert_int_equal(fst_params_of_bead(p, bead, &one, NULL), FST_OK);
    assert_int_equal(one.bead_count, 0);
    return one;
}

static void rows_follow_one_another(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    int seen[FST_BEADS_MOST] = {0}, rows = 0;
    for (int i = 0; fst_param_at(i); ++i) {
        assert_int_equal(fst_param_find(fst_param_at(i)->key), i);
        if (fst_param_bead(i) >= 0)
            ++seen[fst_param_bead(i)];
        rows +=
            strncmp(fst_param_at(i)->key, "bead.", 5) == 0 || strncmp(fst_param_at(i)->key, "start.", 6) == 0;
    }
    for (int bead = 0; bead < FST_BEADS_MOST; ++bead)
        assert_int_equal(seen[bead], rows);
    const int none = fst_params_row_count(&p);
    set(&p, "beads[0].start.phi", "1");
    assert_int_equal(fst_params_row_count(&p), none + rows);
    assert_int_equal(fst_param_find("beads[2].radius"), fst_param_find("beads[2].bead.radius"));
    assert_int_equal(fst_param_find("beads[8].radius"), -1);
}

/* A bead has what it says, and the rest of the setup; nothing of another bead's. */
static void each_says_a_part(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    char text[64];
    set(&p, "start.phi", "3 deg");
    set(&p, "beads[0].start.r", "0.9");
    set(&p, "beads[1].start.phi", "183 deg");
    set(&p, "beads[1].radius", "2 mm");
    set(&p, "beads[1].bead.material", "mixed");
    assert_int_equal(p.bead_count, 2);
    const fst_params first = alone(&p, 0), second = alone(&p, 1);
    CHECK_SAME_BITS(first.start_r, 0.9);
    CHECK_SAME_BITS(first.start_phi, 3.0);
    CHECK_SAME_BITS(first.bead_radius, 2.5e-3);
    assert_int_equal(first.bead_material, FST_MATERIAL_HARD);
    CHECK_SAME_BITS(second.start_r, 0.95);
    CHECK_SAME_BITS(second.start_phi, 183.0);
    CHECK_SAME_BITS(second.bead_radius, 2e-3);
    assert_int_equal(second.bead_material, FST_MATERIAL_MIXED);
    assert_int_equal(fst_params_of_bead(&p, 2, &(fst_params){0}, NULL), FST_BAD_INPUT);
    assert_int_equal(fst_params_get(&p, fst_param_find("beads[0].bead.material"), text, sizeof text), 0);
    assert_true(fst_params_get(&p, fst_param_find("beads[1].bead.material"), text, sizeof text) > 0);
    assert_string_equal(text, "mixed");
    assert_int_equal(fst_params_unset(&p, "beads[1].bead.material", NULL), FST_OK);
    assert_int_equal(alone(&p, 1).bead_material, FST_MATERIAL_HARD);
}

/* A bead's own form of a quantity takes the place of the setup's other form, and of its own other form. */
static void forms(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    set(&p, "model.eps", "0.2");
    set(&p, "bead.density", "7500");
    set(&p, "start.position[0]", "10 mm");
    set(&p, "beads[0].radius", "3 mm");
    set(&p, "beads[0].mass", "1 g");
    set(&p, "beads[0].start.r", "0.7");
    fst_params one = alone(&p, 0);
    assert_true(isnan(one.model_eps) && isnan(one.bead_density) && isnan(one.start_position[0]));
    CHECK_SAME_BITS(one.bead_radius, 3e-3);
    CHECK_SAME_BITS(one.bead_mass, 1e-3);
    set(&p, "beads[0].density", "8000");
    set(&p, "beads[0].start.position[1]", "4 mm");
    one = alone(&p, 0);
    assert_true(isnan(p.beads[0].bead_mass) && isnan(p.beads[0].start_r));
    CHECK_SAME_BITS(one.bead_density, 8e3);
    CHECK_SAME_BITS(one.start_position[1], 4e-3);
    assert_true(fst_params_clash(&p, "beads[1].bead.mass", "beads[1].bead.density"));
    assert_false(fst_params_clash(&p, "beads[1].bead.mass", "beads[0].bead.density"));
}

static void refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *key, *value, *part;
    } rows[] = {
        {"beads[1].radius", "2 mm", "lists 0 beads"}, {"beads[0].radus", "2 mm", "beads[0].radius"},
        {"beads[0].radius", "2 Hz", "um mm cm m"},    {"beads[0].start.spin", "wild", "rolling"},
        {"beads[9].radius", "2 mm", "beads[7]"},      {"beads.radius", "2 mm", "such as beads[0].start.phi"}};
    fst_error error;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        fst_params p = fst_default_params();
        assert_int_equal(fst_params_set(&p, rows[i].key, rows[i].value, &error), FST_BAD_INPUT);
        if (!strstr(error.sentence, rows[i].part))
            fail_msg("%s: %s", rows[i].key, error.sentence);
        assert_int_equal(p.bead_count, 0);
    }
    fst_params p = fst_default_params();
    fst_model *model;
    p.bead_count = 9;
    assert_int_equal(fst_model_new(&p, &model, &error), FST_BAD_INPUT);
    set(&p, "bead.radius", "2.5 mm");
}

/* What has no effect: pair keys without beads, a bead's own key of another material, what one bead without a plate touches
 * nothing with, a long list with `exact`. */
static void effects(void **unused)
{
    (void)unused;
    fst_error error;
    fst_params p = fst_default_params();
    set(&p, "contact.pair_rate", "100");
    assert_int_equal(fst_params_check_effects(&p, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "list several in beads"));
    set(&p, "beads[0].start.phi", "3");
    set(&p, "beads[1].start.phi", "183");
    assert_int_equal(fst_params_check_effects(&p, &error), FST_OK);
    set(&p, "bead.a", "1");
    assert_int_equal(fst_params_check_effects(&p, &error), FST_BAD_INPUT); /* on no bead */
    set(&p, "beads[0].bead.material", "paramagnetic");
    assert_int_equal(fst_params_check_effects(&p, &error), FST_OK);
    set(&p, "beads[1].bead.a", "2");
    assert_int_equal(fst_params_check_effects(&p, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "bead 2: bead.a"));
    fst_params floating = fst_default_params();
    set(&floating, "plate.shape", "none");
    set(&floating, "impact.restitution", "0.5");
    assert_int_equal(fst_params_check_effects(&floating, &error), FST_BAD_INPUT);
    floating.bead_count = 2; /* which touch each other */
    set(&floating, "friction.law", "coulomb");
    set(&floating, "friction.mu", "0.5");
    assert_int_equal(fst_params_check_effects(&floating, &error), FST_OK);
    set(&floating, "contact.pair_mu", "0.4");
    assert_int_equal(fst_params_check_effects(&floating, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "friction.mu has no effect"));
    fst_bead_params many[9];
    for (int i = 0; i < 9; ++i)
        many[i] = p.beads[0];
    p = fst_default_params();
    p.bead_count = 9;
    p.bead_list = many;
    assert_int_equal(fst_params_check_effects(&p, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "at most 8 beads"));
    assert_int_equal(fst_params_set(&p, "beads[1].radius", "2 mm", &error), FST_BAD_INPUT);
    assert_int_equal(alone(&p, 8).bead_material, FST_MATERIAL_PARAMAGNETIC);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rows_follow_one_another),
                                       cmocka_unit_test(each_says_a_part), cmocka_unit_test(forms),
                                       cmocka_unit_test(refused), cmocka_unit_test(effects)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
