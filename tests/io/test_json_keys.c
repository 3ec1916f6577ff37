/* Every number of a result is under its own key and is read back with the same bits: the results hold numbers
 * that all differ, and jansson reads them.
 * tests: io/json_writer.c io/json.c io/orbit_json.c */
#include "numeric.h"

#include <jansson.h>
#include <stdlib.h>

#include <festoon/festoon_tools.h>

static double number_of(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    if (!json_is_number(value))
        fail_msg("%s is missing, or no number", key);
    return json_number_value(value);
}

static json_t *parsed(char *text)
{
    json_error_t why;
    assert_non_null(text);
    json_t *object = json_loads(text, 0, &why);
    if (!object)
        fail_msg("%s", why.text);
    free(text);
    return object;
}

/* 1/3, 2/3, ...: fifteen digits would not be enough for any of them. */
static double next_number(int *count)
{
    *count += 1;
    return *count / 3.0;
}

static void check_list(const json_t *object, const char *key, const double *expected, size_t count)
{
    const json_t *list = json_object_get(object, key);
    assert_int_equal(json_array_size(list), count);
    for (size_t i = 0; i < count; ++i)
        CHECK_SAME_BITS(json_number_value(json_array_get(list, i)), expected[i]);
}

static void results_of_a_run(void **state)
{
    (void)state;
    int count = 0;
    const fst_params params = fst_default_params();
    fst_run_result result;
    memset(&result, 0, sizeof result);
    for (int i = 0; i < fst_result_count(); ++i) {
        const double value = next_number(&count);
        memcpy((char *)&result + fst_result_at(i)->offset, &value, sizeof value);
    }
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        result.final_state[i] = next_number(&count);
    result.returns = 1001;
    result.rhs_calls = 1002;
    result.accepted = 1003;
    result.rejected = 1004;
    fst_ramp_point ramp[2];
    for (int i = 0; i < 2; ++i)
        ramp[i] = (fst_ramp_point){.omega = next_number(&count),
                                   .frequency_hz = next_number(&count),
                                   .mean_r = next_number(&count),
                                   .std_r = next_number(&count),
                                   .mean_alpha_dot = next_number(&count),
                                   .mean_phi_dot = next_number(&count),
                                   .mean_nz = next_number(&count)};
    json_t *object = parsed(fst_run_json(&params, &result, ramp, 2));
    for (int i = 0; i < fst_result_count(); ++i) {
        double value;
        memcpy(&value, (const char *)&result + fst_result_at(i)->offset, sizeof value);
        CHECK_SAME_BITS(number_of(object, fst_result_at(i)->name), value);
    }
    check_list(object, "final_state", result.final_state, FST_STATE_SIZE);
    CHECK_SAME_BITS(number_of(object, "returns"), 1001);
    CHECK_SAME_BITS(number_of(object, "rhs_calls"), 1002);
    CHECK_SAME_BITS(number_of(object, "steps_accepted"), 1003);
    CHECK_SAME_BITS(number_of(object, "steps_rejected"), 1004);
    const json_t *pieces = json_object_get(object, "ramp");
    assert_int_equal(json_array_size(pieces), 2);
    for (size_t i = 0; i < 2; ++i) {
        const json_t *piece = json_array_get(pieces, i);
        CHECK_SAME_BITS(number_of(piece, "omega"), ramp[i].omega);
        CHECK_SAME_BITS(number_of(piece, "frequency_hz"), ramp[i].frequency_hz);
        CHECK_SAME_BITS(number_of(piece, "mean_r"), ramp[i].mean_r);
        CHECK_SAME_BITS(number_of(piece, "std_r"), ramp[i].std_r);
        CHECK_SAME_BITS(number_of(piece, "mean_alpha_dot"), ramp[i].mean_alpha_dot);
        CHECK_SAME_BITS(number_of(piece, "mean_phi_dot"), ramp[i].mean_phi_dot);
        CHECK_SAME_BITS(number_of(piece, "mean_nz"), ramp[i].mean_nz);
    }
    json_decref(object);
}

/* An undefined number is null, neither zero nor a text. */
static void what_is_undefined(void **state)
{
    (void)state;
    const fst_params params = fst_default_params();
    fst_run_result result;
    memset(&result, 0, sizeof result);
    for (int i = 0; i < fst_result_count(); ++i) {
        const double value = i % 2 ? NAN : -INFINITY;
        memcpy((char *)&result + fst_result_at(i)->offset, &value, sizeof value);
    }
    json_t *object = parsed(fst_run_json(&params, &result, NULL, 0));
    for (int i = 0; i < fst_result_count(); ++i)
        assert_true(json_is_null(json_object_get(object, fst_result_at(i)->name)));
    json_decref(object);
}

static void orbits(void **state)
{
    (void)state;
    int count = 0;
    const fst_params params = fst_default_params();
    fst_orbit orbit;
    memset(&orbit, 0, sizeof orbit);
    for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i) {
        orbit.multiplier_re[i] = next_number(&count);
        orbit.multiplier_im[i] = next_number(&count);
    }
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        orbit.state[i] = next_number(&count);
    orbit.means.period = next_number(&count);
    orbit.relaxation_time = next_number(&count);
    orbit.swing_ratio = next_number(&count);
    orbit.residual = next_number(&count);
    orbit.trivial_error = next_number(&count);
    orbit.turns = -1;
    json_t *object = parsed(fst_orbit_json(&params, &orbit, NULL, 0, FST_SHOWN_SCALED));
    const json_t *pairs = json_object_get(object, "multipliers");
    assert_int_equal(json_array_size(pairs), FST_MULTIPLIER_COUNT);
    for (size_t i = 0; i < FST_MULTIPLIER_COUNT; ++i) {
        CHECK_SAME_BITS(json_number_value(json_array_get(json_array_get(pairs, i), 0)), orbit.multiplier_re[i]);
        CHECK_SAME_BITS(json_number_value(json_array_get(json_array_get(pairs, i), 1)), orbit.multiplier_im[i]);
    }
    check_list(object, "state", orbit.state, FST_STATE_SIZE);
    CHECK_SAME_BITS(number_of(object, "period"), orbit.means.period);
    CHECK_SAME_BITS(number_of(object, "relaxation_time"), orbit.relaxation_time);
    CHECK_SAME_BITS(number_of(object, "swing_ratio"), orbit.swing_ratio);
    CHECK_SAME_BITS(number_of(object, "residual"), orbit.residual);
    CHECK_SAME_BITS(number_of(object, "trivial_multiplier_error"), orbit.trivial_error);
    CHECK_SAME_BITS(number_of(object, "turns"), -1);
    json_decref(object);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_of_a_run),
        cmocka_unit_test(what_is_undefined),
        cmocka_unit_test(orbits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
