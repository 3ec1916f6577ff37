/* Parameters: the table's consistency, values with units, what tells kappa, messages that name the
 * nearest valid thing, and independence of the locale.
 * tests: model/params.c model/run_length.c model/param_field.c model/param_table.c model/material.c
 *   base/error.c base/nearest.c base/units.c */
#include "keys.h"
#include "same_params.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

#include <festoon/festoon.h>

#include "base/number.h"
#include "base/units.h"
#include "model/params.h"

static void table_is_consistent(void **state)
{
    (void)state;
    fst_params defaults = fst_default_params();
    assert_int_equal(fst_params_validate(&defaults, NULL), FST_OK);
    for (int i = 0; i < fst_param_count(); i++) {
        const fst_param_info *info = fst_param_at(i);
        assert_int_equal(fst_param_find(info->key), i);
        assert_non_null(strchr(info->key, '.'));
        assert_true(strlen(info->doc) > 10);
        if (info->kind == FST_KIND_CHOICE)
            assert_non_null(info->names);
        else
            assert_true(isnan(info->initial) ||
                        (info->initial >= info->least && info->initial <= info->greatest));
    }
    assert_null(fst_param_at(-1));
    assert_null(fst_param_at(fst_param_find("beads[7].start.angular_velocity[2]") + 1));
    assert_int_equal(fst_param_find("bead"), -1);
}

/* Each kind of quantity accepts the units that the header lists for it. */
static void units_are_read(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        fst_unit unit;
        double value;
    } good[] = {
        {"2.5 mm", FST_UNIT_LENGTH, 0.0025},
        {" 2.5mm ", FST_UNIT_LENGTH, 0.0025},
        {"16.2 mm", FST_UNIT_LENGTH, 0.0162},
        {"2500 um", FST_UNIT_LENGTH, 0.0025},
        {"2500 \xC2\xB5m", FST_UNIT_LENGTH, 0.0025},
        {"2500 \xCE\xBCm", FST_UNIT_LENGTH, 0.0025},
        {"0.25 cm", FST_UNIT_LENGTH, 0.0025},
        {"25e-4", FST_UNIT_LENGTH, 0.0025},
        {"+.0025 m", FST_UNIT_LENGTH, 0.0025},
        {"500 mg", FST_UNIT_MASS, 0.5e-3},
        {"0.5 g", FST_UNIT_MASS, 0.5e-3},
        {"5e-4 kg", FST_UNIT_MASS, 0.5e-3},
        {"0.06 A m^2", FST_UNIT_MOMENT, 0.06},
        {"0.06 A m2", FST_UNIT_MOMENT, 0.06},
        {"0.06 A.m2", FST_UNIT_MOMENT, 0.06},
        {"0.06 A*m^2", FST_UNIT_MOMENT, 0.06},
        {"0.06 A\xC2\xB7m\xC2\xB2", FST_UNIT_MOMENT, 0.06},
        {"60 mA  m2", FST_UNIT_MOMENT, 0.06},
        {"20 mT", FST_UNIT_FIELD, 0.02},
        {"200 G", FST_UNIT_FIELD, 0.02},
        {"20000 uT", FST_UNIT_FIELD, 0.02},
        {"642 rpm", FST_UNIT_FREQUENCY, 10.7},
        {"642 RPM", FST_UNIT_FREQUENCY, 10.7},
        {"642 1/min", FST_UNIT_FREQUENCY, 10.7},
        {"642 U/min", FST_UNIT_FREQUENCY, 10.7},
        {"642 tr/min", FST_UNIT_FREQUENCY, 10.7},
        {"10 hz", FST_UNIT_FREQUENCY, 10},
        {"2 KHZ", FST_UNIT_FREQUENCY, 2000},
        {"0.0107 kHz", FST_UNIT_FREQUENCY, 10.7},
        {"1 rad/s", FST_UNIT_FREQUENCY, 0.15915494309189535},
        {"312.5 1/s", FST_UNIT_RATE, 312.5},
        {"312.5 s-1", FST_UNIT_RATE, 312.5},
        {"312.5 s^-1", FST_UNIT_RATE, 312.5},
        {"0.3125 1/ms", FST_UNIT_RATE, 312.5},
        {"9.81 m/s^2", FST_UNIT_ACCELERATION, 9.81},
        {"9.81 m/s2", FST_UNIT_ACCELERATION, 9.81},
        {"90", FST_UNIT_ANGLE, 90.0},
        {"90\xC2\xB0", FST_UNIT_ANGLE, 90.0},
        {"0.25 turn", FST_UNIT_ANGLE, 90.0},
        {"1 rad", FST_UNIT_ANGLE, 57.295779513082323},
        {"-1.5e-3", FST_UNIT_NUMBER, -0.0015},
    };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        double value = NAN;
        fst_error error = {FST_OK, "", ""};
        if (fst_parse_value(good[i].text, good[i].unit, &value, &error) != FST_OK)
            fail_msg("\"%s\": %s", good[i].text, error.sentence);
        CHECK_SAME_BITS(value, good[i].value);
    }
}

static void wrong_values_are_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {"",     " ",     "nan", "inf", "-inf", "0x10",   "1,5",  "1e400",
                                      "mm",   "--1",   "1 2", "e5",  ".",    "1mm mm", "1 Mm", "1 Hz",
                                      "1e 5", "5 m m", "+",   "1_0", "1 m.", "1\x01",  "\xFF", "1 m\n2"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        double value = 7.0;
        fst_error error = {FST_OK, "", ""};
        if (fst_parse_value(bad[i], FST_UNIT_LENGTH, &value, &error) != FST_BAD_INPUT)
            fail_msg("\"%s\" was read as %g", bad[i], value);
        assert_true(value == 7.0);
        assert_true(strlen(error.sentence) > 5);
    }
    char digits[2000];
    double value;
    memset(digits, '9', sizeof digits - 1);
    digits[sizeof digits - 1] = '\0';
    assert_int_equal(fst_parse_value(digits, FST_UNIT_NUMBER, &value, NULL), FST_BAD_INPUT);
}

/* Values that are written read back with the same bits, awkward numbers included. */
static void values_survive_writing(void **state)
{
    (void)state;
    uint64_t seed = 42;
    for (int i = 0; i < 20000; i++) {
        char text[64];
        double back;
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        double value = ldexp((double)(seed >> 11), -60 + (int)(seed % 40));
        fst_unit unit = (fst_unit)(i % FST_UNIT_COUNT);
        (void)fst_value_write(text, sizeof text, value, unit);
        assert_int_equal(fst_parse_value(text, unit, &back, NULL), FST_OK);
        CHECK_SAME_BITS(back, value);
    }
    char text[64];
    (void)fst_value_write(text, sizeof text, 0.0025, FST_UNIT_LENGTH);
    assert_string_equal(text, "2.5 mm");
    (void)fst_value_write(text, sizeof text, 10.7, FST_UNIT_FREQUENCY);
    assert_string_equal(text, "10.7 Hz");
}

static void expect_message(const char *key, const char *value, const char *part)
{
    fst_params params = fst_default_params();
    const fst_params before = params;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_params_set(&params, key, value, &error), FST_BAD_INPUT);
    assert_int_equal(error.code, FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, part);
    check_same_params(&params, &before);
    assert_int_equal(fst_params_set(&params, key, value, NULL), FST_BAD_INPUT);
}

static void messages_help(void **state)
{
    (void)state;
    expect_message("bead.raduis", "1 mm", "bead.radius");
    expect_message("radius", "1 mm", "bead.radius");
    expect_message("drive.freqency", "1", "drive.frequency");
    expect_message("Bead.Radius", "1 mm", "bead.radius");
    expect_message("", "1", "unknown key");
    /* A name without a group is compared with names without one. */
    expect_message("kapa", "1", "the nearest is model.kappa");
    expect_message("frequncy", "1", "the nearest is drive.frequency");
    expect_message("radus", "1", "the nearest is bead.radius");
    /* No name is proposed that is far off. */
    expect_message("zebra", "1", "no name is like it");
    expect_message("plate.zebra", "1", "no name is like it");
    expect_message("run.method", "splitting", "splitting is gone");
    expect_message("run.controller", "plain", "leave the key out");
    expect_message("friction.contact_rate", "0", "leave the key out");
    expect_message("contact.patch", " pade ", "pade is gone");
    expect_message("contact.patch", "pad", "unknown choice");
    expect_message("bead.radius", "1 km", "um mm cm m");
    expect_message("bead.radius", "1 MM", "nearest is mm");
    expect_message("drive.frequency", "10 hertz", "nearest is Hz");
    expect_message("drive.freq", "1", "nearest is drive.frequency");
    expect_message("freq", "1", "nearest is drive.frequency");
    expect_message("magnet.frequency", "1", "nearest is drive.frequency");
    expect_message("plat.radius", "1", "nearest is plate.radius");
    expect_message("bead.moment_", "1", "nearest is bead.moment ");
    expect_message("drive.frequency", "1,5 Hz", "decimal comma: write \"1.5 Hz\"");
    expect_message("drive.frequency", "1,234.5 Hz", "nothing between thousands");
    expect_message("drive.frequency", "1.234,5 Hz", "nothing between thousands");
    expect_message("drive.frequency", "1,234,5 Hz", "nothing between thousands");
    expect_message("model.kappa", "1,5", "decimal comma: write \"1.5\"");
    expect_message("run.samples", "1,5", "decimal comma");
    expect_message("model.kappa", "1,", "unit \",\"");
    expect_message("magnet.b0", "3 MT", "nearest is mT");
    expect_message("bead.radius", "5 m", "1000 mm");
    expect_message("bead.radius", "-1 mm", "0.0001 mm to 1000 mm");
    expect_message("model.kappa", "1.5 mm", "without a unit");
    expect_message("model.dynamics", "farago", "farago2020");
    expect_message("model.dynamics", "", "rigid, farago2020");
    expect_message("magnet.lines", "2.5", "integer");
    expect_message("magnet.lines", "100", "1 to 99");
    expect_message("run.rtol", "nan", "not a decimal number");
}

static double kappa_of(const fst_params *params)
{
    fst_model *model;
    assert_int_equal(fst_model_new(params, &model, NULL), FST_OK);
    double kappa = fst_model_groups(model).kappa;
    fst_model_free(model);
    return kappa;
}

/* kappa is model.kappa unless moment and B0 are both given; whichever was set last counts. */
static void kappa_has_two_makers(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    double made = 0.1 * 0.01 / (0.5e-3 * 0.0025 * 0.0025 * 312.5 * 312.5);
    CHECK_CLOSE(kappa_of(&params), 1.5, 0.0);
    set(&params, "model.kappa", "2");
    set(&params, "bead.moment", "0.1 A m2");
    CHECK_CLOSE(kappa_of(&params), 2.0, 0.0);
    set(&params, "magnet.b0", "10 mT");
    CHECK_CLOSE(kappa_of(&params), made, 1e-14 * made);
    set(&params, "model.kappa", "3");
    CHECK_CLOSE(kappa_of(&params), 3.0, 0.0);
    assert_true(isnan(params.magnet_b0));
    set(&params, "magnet.b0", "10 mT");
    CHECK_CLOSE(kappa_of(&params), made, 1e-14 * made);
}

/* A struct filled in by hand is checked as a text would be. */
static void structs_are_validated(void **state)
{
    (void)state;
    fst_error error;
    fst_params params = fst_default_params();
    params.bead_radius = -1.0;
    assert_int_equal(fst_params_validate(&params, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "bead.radius");
    params = fst_default_params();
    params.bead_radius = NAN;
    assert_int_equal(fst_params_validate(&params, &error), FST_BAD_INPUT);
    params = fst_default_params();
    params.model_dynamics = 2;
    assert_int_equal(fst_params_validate(&params, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "rigid|farago2020");
    params = fst_default_params();
    params.magnet_lines = 0;
    assert_int_equal(fst_params_validate(&params, &error), FST_BAD_INPUT);
    params = fst_default_params();
    params.run_discard = params.run_periods;
    assert_int_equal(fst_params_validate(&params, &error), FST_BAD_INPUT);
    memset(&params, 0, sizeof params);
    assert_int_equal(fst_params_validate(&params, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "fst_default_params");
    assert_int_equal(fst_params_set(&params, "bead.radius", "1 mm", &error), FST_BAD_INPUT);
}

/* Each status has a text of its own, so that a failed row of a sweep cannot be taken for a finished one. */
static void statuses_have_texts(void **state)
{
    (void)state;
    assert_string_equal(fst_status_text(FST_OK), "done");
    for (int i = 0; i <= FST_INTERRUPTED; i++)
        for (int k = 0; k < i; k++)
            assert_string_not_equal(fst_status_text((fst_status)i), fst_status_text((fst_status)k));
}

static void nearest_names(void **state)
{
    (void)state;
    char nearest[16];
    assert_int_equal(fst_nearest_name("rnu", "run|field|plot", nearest, sizeof nearest), 1);
    assert_string_equal(nearest, "run");
    assert_int_equal(fst_nearest_name("field", "run|field|plot", nearest, sizeof nearest), 0);
    assert_string_equal(nearest, "field");
    (void)fst_nearest_name("freq", "omega|frequency", nearest, sizeof nearest);
    assert_string_equal(nearest, "frequency");
    (void)fst_nearest_name("out", "output|oat|frequency", nearest, sizeof nearest);
    assert_string_equal(nearest, "oat");
    (void)fst_nearest_name("out", "frequency|output|ot", nearest, sizeof nearest);
    assert_string_equal(nearest, "ot");
    (void)fst_nearest_name("out", "in|outputs|output", nearest, sizeof nearest);
    assert_string_equal(nearest, "output");
    (void)fst_nearest_name("MM", "um|mm|m", nearest, sizeof nearest);
    assert_string_equal(nearest, "mm");
    assert_int_equal(fst_nearest_name("x", "", nearest, sizeof nearest), -1);
    assert_string_equal(nearest, "");
    char huge[5000];
    memset(huge, 'a', sizeof huge - 1);
    huge[sizeof huge - 1] = '\0';
    assert_true(fst_nearest_name(huge, "run|field", nearest, sizeof nearest) > 0);
    (void)fst_nearest_name("fiel", "run|field", nearest, 3);
    assert_string_equal(nearest, "fi");
}

/* In a locale with decimal commas numbers are written the same way, and the locale is left as it was. */
static void locale_does_not_matter(void **state)
{
    (void)state;
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"};
    const char *taken = NULL;
    for (size_t i = 0; i < sizeof names / sizeof names[0] && !taken; i++)
        taken = setlocale(LC_ALL, names[i]);
    double value;
    char text[32], comma[32];
    (void)snprintf(comma, sizeof comma, "%g", 0.5);
    assert_int_equal(fst_parse_value("2.5 mm", FST_UNIT_LENGTH, &value, NULL), FST_OK);
    CHECK_SAME_BITS(value, 0.0025);
    (void)fst_number_write(text, sizeof text, 0.5);
    assert_string_equal(text, "0.5");
    char after[32];
    (void)snprintf(after, sizeof after, "%g", 0.5);
    assert_string_equal(after, comma);
    (void)setlocale(LC_ALL, "C");
    if (!taken)
        print_message("no locale with a decimal comma here: only the C locale was tried\n");
}

/* The names of the dynamics are those of the table of parameters. */
static void dynamics_have_names(void **state)
{
    (void)state;
    for (int i = 0; i < 2; ++i) {
        fst_params params = fst_default_params();
        char name[32];
        params.model_dynamics = i;
        (void)fst_params_get(&params, fst_param_find("model.dynamics"), name, sizeof name);
        assert_string_equal(fst_dynamics_name((fst_dynamics)i), name);
    }
    assert_string_equal(fst_dynamics_name((fst_dynamics)2), "unknown");
}

/* The library itself refuses a strength that the bead's material does not use. */
static void values_without_effect(void **state)
{
    (void)state;
    static const struct {
        const char *material, *key;
        int used;
    } cases[] = {{"hard", "bead.a", 0},         {"hard", "bead.b", 0},  {"paramagnetic", "bead.a", 1},
                 {"paramagnetic", "bead.b", 0}, {"mixed", "bead.a", 1}, {"mixed", "bead.b", 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        fst_params params = fst_default_params();
        fst_error error;
        assert_int_equal(fst_params_set(&params, "bead.material", cases[i].material, &error), FST_OK);
        assert_int_equal(fst_params_check_effects(&params, &error), FST_OK);
        assert_int_equal(fst_params_set(&params, cases[i].key, "1e-3", &error), FST_OK);
        assert_int_equal(fst_params_check_effects(&params, &error), cases[i].used ? FST_OK : FST_BAD_INPUT);
        if (!cases[i].used) {
            assert_string_equal(error.where, cases[i].key);
            CHECK_CONTAINS(error.sentence, "mixed");
        }
    }
}

/* Nor what belongs to another magnet or contact; under another law of friction it waits. */
static void values_of_another_choice(void **state)
{
    (void)state;
    static const struct {
        const char *choice, *chosen, *key, *value, *sentence; /* NULL: it has an effect, or waits */
    } cases[] = {
        {"magnet.shape", "grid", "magnet.lines", "7", "with magnet.shape grid: choose lines"},
        {"magnet.shape", "grid", "magnet.width", "30 mm", "with magnet.shape grid: choose lines"},
        {"magnet.shape", "grid", "model.lambda", "0.4", "with magnet.shape grid: choose lines"},
        {"magnet.shape", "lines", "magnet.lines", "7", NULL},
        {"magnet.lines", "1", "magnet.width", "30 mm", NULL},
        {"magnet.shape", "lines", "magnet.file", "map.csv", "with magnet.shape lines: choose grid"},
        {"magnet.shape", "lines", "magnet.checksum", "0123456789abcdef",
         "with magnet.shape lines: choose grid"},
        {"magnet.shape", "grid", "magnet.file", "map.csv", NULL},
        {"magnet.shape", "parts", "magnet.file", "map.csv", NULL},
        {"bead.material", "paramagnetic", "model.kappa", "1.8", NULL},
        {"bead.material", "mixed", "model.kappa", "1.8", NULL},
        {"friction.law", "coulomb", "friction.stribeck_speed", "0.01", "without friction.mu_static: choose"},
        {"friction.law", "viscous", "friction.stribeck_speed", "0.01", NULL},
        {"friction.mu_static", "0.3", "friction.stribeck_speed", "0.01", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        fst_params params = fst_default_params();
        fst_error error = {FST_OK, "", ""};
        if (strcmp(cases[i].choice, "friction.mu_static") == 0)
            params.friction_law = FST_FRICTION_COULOMB;
        assert_int_equal(fst_params_set(&params, cases[i].choice, cases[i].chosen, &error), FST_OK);
        assert_int_equal(fst_params_check_effects(&params, &error), FST_OK);
        assert_int_equal(fst_params_set(&params, cases[i].key, cases[i].value, &error), FST_OK);
        const fst_status status = fst_params_check_effects(&params, &error);
        if (status != (cases[i].sentence ? FST_BAD_INPUT : FST_OK))
            fail_msg("%s beside %s: %s", cases[i].key, cases[i].chosen, error.sentence);
        if (!cases[i].sentence)
            continue;
        assert_string_equal(error.where, cases[i].key);
        CHECK_CONTAINS(error.sentence, cases[i].sentence);
    }
}

/* A number says why a text is not a value; the sentence lists the units once, whatever the fault. */
static void faults_of_values(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        fst_unit unit;
        fst_value_fault fault;
    } cases[] = {
        {"2.5 mm", FST_UNIT_LENGTH, FST_VALUE_READ},     {" ", FST_UNIT_LENGTH, FST_VALUE_MISSING},
        {"two", FST_UNIT_LENGTH, FST_VALUE_NO_NUMBER},   {"0x10", FST_UNIT_LENGTH, FST_VALUE_NO_NUMBER},
        {"2 Hz", FST_UNIT_LENGTH, FST_VALUE_WRONG_UNIT}, {"2 Hz", FST_UNIT_NUMBER, FST_VALUE_WRONG_UNIT},
        {"1e999", FST_UNIT_LENGTH, FST_VALUE_TOO_LARGE}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        double value = 0.0;
        fst_params params = fst_default_params();
        fst_error error;
        assert_int_equal(fst_value_read(cases[i].text, cases[i].unit, &value, NULL), cases[i].fault);
        if (cases[i].unit != FST_UNIT_LENGTH || cases[i].fault == FST_VALUE_READ)
            continue;
        assert_int_equal(fst_params_set(&params, "bead.radius", cases[i].text, &error), FST_BAD_INPUT);
        const char *units = strstr(error.sentence, "units here");
        assert_non_null(units);
        assert_null(strstr(units + 1, "units here"));
    }
}

/* Every default written in the unit that people use, but without the unit: where it is then another value of more than 20
 * times the size, the unit is proposed; with the unit nothing is said. */
static void bare_numbers_are_doubted(void **state)
{
    (void)state;
    int doubted = 0;
    for (int i = 0; i < fst_param_count(); ++i) {
        const fst_param_info *row = fst_param_at(i);
        if (row->kind != FST_KIND_REAL || !(fabs(row->initial) > 0))
            continue;
        char text[64], sentence[512];
        fst_params params = fst_default_params();
        fst_error error = {FST_OK, "", ""};
        (void)fst_value_write(text, sizeof text, row->initial, row->unit);
        assert_int_equal(fst_params_set(&params, row->key, text, &error), FST_OK);
        assert_int_equal(fst_params_bare_number(&params, sentence, sizeof sentence), 0);
        char *unit = strchr(text, ' ');
        if (!unit)
            continue;
        *unit++ = '\0';
        if (strtod(text, NULL) <= 20 * fabs(row->initial))
            continue;
        ++doubted;
        const char *said = sentence;
        if (fst_params_set(&params, row->key, text, &error) != FST_OK)
            said = error.sentence;
        else
            assert_int_not_equal(fst_params_bare_number(&params, sentence, sizeof sentence), 0);
        assert_non_null(strstr(said, "did you mean "));
        assert_non_null(strstr(strstr(said, "did you mean "), unit));
        assert_int_equal(fst_params_set(&params, row->key, "1e-6", &error),
                         FST_OK); /* it is no longer the case */
        assert_int_equal(fst_params_bare_number(&params, sentence, sizeof sentence), 0);
    }
    assert_true(doubted >= 4);
}

/* What would be refused as well is not proposed. */
static void proposals_are_good(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    fst_error error = {FST_OK, "", ""};
    static const char *const cases[][3] = {{"bead.radius", "3", "did you mean 3 mm?"},
                                           {"bead.radius", "-3", NULL},
                                           {"bead.radius", "1e9", NULL},
                                           {"magnet.depth", "-8", NULL},
                                           {"magnet.half_length", "23", "did you mean 23 mm?"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        assert_int_equal(fst_params_set(&params, cases[i][0], cases[i][1], &error), FST_BAD_INPUT);
        assert_true(cases[i][2] ? strstr(error.sentence, cases[i][2]) != NULL
                                : !strstr(error.sentence, "did you mean"));
    }
}

static void bare_turns_a_minute_are_doubted(void **state)
{
    (void)state;
    static const struct {
        const char *key, *text, *said;
    } cases[] = {{"drive.frequency", "642", "did you mean 642 rpm"},
                 {"drive.frequency", "642 Hz", NULL},
                 {"drive.frequency", "200", NULL},
                 {"drive.omega", "10.7", "did you mean drive.frequency = 10.7 Hz"},
                 {"drive.omega", "5", NULL},
                 {"friction.gamma", "1e4", NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char sentence[512];
        fst_params params = fst_default_params();
        assert_int_equal(fst_params_set(&params, cases[i].key, cases[i].text, NULL), FST_OK);
        assert_int_equal(fst_params_bare_number(&params, sentence, sizeof sentence) != 0,
                         cases[i].said != NULL);
        if (cases[i].said)
            assert_non_null(strstr(sentence, cases[i].said));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bare_numbers_are_doubted),
        cmocka_unit_test(proposals_are_good),
        cmocka_unit_test(bare_turns_a_minute_are_doubted),
        cmocka_unit_test(table_is_consistent),
        cmocka_unit_test(units_are_read),
        cmocka_unit_test(wrong_values_are_refused),
        cmocka_unit_test(values_survive_writing),
        cmocka_unit_test(messages_help),
        cmocka_unit_test(kappa_has_two_makers),
        cmocka_unit_test(structs_are_validated),
        cmocka_unit_test(values_without_effect),
        cmocka_unit_test(values_of_another_choice),
        cmocka_unit_test(faults_of_values),
        cmocka_unit_test(statuses_have_texts),
        cmocka_unit_test(nearest_names),
        cmocka_unit_test(dynamics_have_names),
        cmocka_unit_test(locale_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
