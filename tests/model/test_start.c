/* Where a bead begins: vectors take the place of distance, angle and spin, and say the same where they are the same.
 * tests: model/start.c */
#include "numeric.h"

#include <stdio.h>
#include <string.h>

#include <festoon/festoon.h>

static fst_status start(const fst_params *p, double state[FST_STATE_SIZE], fst_error *error)
{
    fst_model *model;
    assert_int_equal(fst_field_model_new(p, NAN, &model, NULL), FST_OK);
    const fst_status status = fst_start_state(p, model, state, error);
    fst_model_free(model);
    return status;
}

static void set(fst_params *p, const char *key, double value)
{
    char text[64];
    (void)snprintf(text, sizeof text, "%.17g", value);
    assert_int_equal(fst_params_set(p, key, text, NULL), FST_OK);
}

/* The same start told by r and Phi, and by vectors in SI. */
static void vectors_say_the_same(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    double usual[FST_STATE_SIZE], told[FST_STATE_SIZE];
    assert_int_equal(start(&p, usual, NULL), FST_OK);
    const double l = p.magnet_half_length, gamma = p.friction_gamma;
    static const struct {
        const char *key;
        int at;
    } keys[] = {{"start.position[0]", FST_X},
                {"start.position[1]", FST_Y},
                {"start.velocity[0]", FST_VX},
                {"start.velocity[1]", FST_VY},
                {"start.n[0]", FST_NX},
                {"start.n[1]", FST_NY},
                {"start.n[2]", FST_NZ},
                {"start.angular_velocity[0]", FST_WX},
                {"start.angular_velocity[1]", FST_WY}};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
        const int at = keys[i].at;
        const double unit = at < FST_VX ? l : at < FST_NX ? l * gamma : at < FST_WX ? 3.0 : gamma;
        set(&p, keys[i].key, usual[at] * unit);
    }
    set(&p, "start.position[2]", p.bead_radius);
    assert_int_equal(start(&p, told, NULL), FST_OK);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        assert_true(fabs(told[i] - usual[i]) <= 1e-15);
    CHECK_SAME_BITS(p.start_r, 0.95);
}

/* A place alone keeps the spin: the contact rests, as r and Phi have it. */
static void place_alone_rolls(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params(), q = p;
    double polar[FST_STATE_SIZE], placed[FST_STATE_SIZE];
    set(&p, "start.r", 0.8);
    set(&p, "start.phi", 90.0);
    set(&q, "start.position[1]", 0.8 * q.magnet_half_length);
    assert_int_equal(start(&p, polar, NULL), FST_OK);
    assert_int_equal(start(&q, placed, NULL), FST_OK);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        assert_true(fabs(placed[i] - polar[i]) <= 1e-15);
}

/* The other form of the place is taken back, either way round; a height alone is no other form. */
static void forms_of_the_place(void **unused)
{
    (void)unused;
    fst_params p = fst_default_params();
    set(&p, "start.r", 0.5);
    set(&p, "start.position[0]", 0.01);
    CHECK_SAME_BITS(p.start_r, 0.95);
    set(&p, "start.position[2]", 0.0025);
    set(&p, "start.phi", 20.0);
    assert_true(isnan(p.start_position[0]));
    CHECK_SAME_BITS(p.start_position[2], 0.0025);
    assert_true(fst_params_clash(&p, "start.position[1]", "start.r"));
    assert_false(fst_params_clash(&p, "start.position[2]", "start.r"));
    assert_false(fst_params_clash(&p, "start.position[1]", "start.position[0]"));
}

static void refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *key, *value, *sentence;
    } rows[] = {{"start.position[2]", "3 mm", "start.position[2] asks for a bead in three dimensions"},
                {"start.velocity[2]", "1 mm/s", "start.velocity[2] asks for a bead in three dimensions"},
                {"start.n[1]", "0", "not a direction"},
                {"start.position[0]", "24 cm", "beyond the plate's edge"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        fst_params p = fst_default_params();
        double state[FST_STATE_SIZE];
        fst_error error;
        assert_int_equal(fst_params_set(&p, rows[i].key, rows[i].value, NULL), FST_OK);
        assert_int_equal(start(&p, state, &error), FST_BAD_INPUT);
        assert_non_null(strstr(error.sentence, rows[i].sentence));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(vectors_say_the_same),
                                       cmocka_unit_test(place_alone_rolls),
                                       cmocka_unit_test(forms_of_the_place), cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
