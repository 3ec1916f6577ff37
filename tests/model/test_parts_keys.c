/* The keys of real magnets: what a scene says of parts and beads is read, written and read again to the same
 * bits; what cannot be is refused with the line and what was expected; and results in SI depend on no unit.
 * tests: model/part_rows.c model/part_geometry.c model/bead.c io/scene_parts.c */
#include "keys.h"
#include "same_params.h"

#include <stdio.h>
#include <stdlib.h>

#include <festoon/festoon_tools.h>

#include "model/model.h"

static fst_status parse(const char *text, fst_params *params, fst_error *error)
{
    *params = fst_default_params();
    return fst_scene_parse(text, strlen(text), "s.yaml", params, error);
}

/* (4 pi/3) R^3 1.2 T/mu_0 in A m^2, of 2.5 mm */
#define USUAL_MOMENT (4.0 / 3.0 * 3.14159265358979323846 * 2.5e-3 * 2.5e-3 * 2.5e-3 * 1.2 / 1.25663706127e-6)

#define MAGNET "magnet:\n  shape: parts\n  parts:\n"
#define CUBOID "    - {kind: cuboid, centre: [0, 0, 0], size: [56 mm, 40mm, 9 mm], remanence: [0.3 T, 0, 0]}\n"
#define CYLINDER                                                                                               \
    "    - kind: cylinder\n      centre: [2 cm, -1e-3, 0.5mm]\n      size: [12 mm, 0.005]\n"                   \
    "      remanence: [0, 100 mT, -1.1]\n      rotation: [30, 1, 1, 0]\n"
#define SPHERE "    - {kind: sphere, centre: [0, 1cm, 0], size: 5 mm, remanence: [0, 0, 1]}\n"
#define DIPOLE "    - {kind: dipole, centre: [0, 0, 1mm], moment: ['1.5 A m^2', 0, -2]}\n"

static fst_params whole(void)
{
    fst_params params;
    fst_error error = {FST_OK, "", ""};
    if (parse(MAGNET CUBOID CYLINDER SPHERE DIPOLE "bead: {density: 7.5 g/cm^3, remanence: 1.2 T}\n", &params,
              &error) != FST_OK)
        fail_msg("%s %s", error.where, error.sentence);
    return params;
}

static void parts_are_read(void **state)
{
    (void)state;
    const fst_params p = whole();
    assert_int_equal(p.magnet_part_count, 4);
    const fst_magnet_part *part = p.magnet_parts;
    assert_int_equal(part[0].kind, FST_PART_CUBOID);
    CHECK_SAME_BITS(part[0].size[0], 0.056);
    CHECK_SAME_BITS(part[0].remanence[0], 0.3);
    assert_int_equal(part[1].kind, FST_PART_CYLINDER);
    CHECK_SAME_BITS(part[1].centre[0], 0.02);
    CHECK_SAME_BITS(part[1].size[1], 0.005);
    CHECK_SAME_BITS(part[1].remanence[1], 0.1);
    CHECK_SAME_BITS(part[1].rotation[0], 30.0);
    CHECK_SAME_BITS(part[1].rotation[2], 1.0);
    CHECK_SAME_BITS(part[2].size[0], 0.005);
    CHECK_SAME_BITS(part[3].moment[2], -2.0);
    CHECK_SAME_BITS(p.bead_density, 7500.0);
    CHECK_CLOSE(fst_bead_mass(&p), 7500.0 * 4.0 / 3.0 * 3.14159265358979323846 * pow(2.5e-3, 3), 1e-18);
    CHECK_CLOSE(fst_bead_moment(&p), USUAL_MOMENT, 1e-16);
}

/* Every number of every part, also where it has no short decimal form. */
static void scenes_come_back(void **state)
{
    (void)state;
    fst_params first = whole(), second;
    double value = 1.0 / 3.0;
    for (int i = fst_param_count(); i < fst_params_row_count(&first); ++i) {
        char text[64];
        if (fst_param_at(i)->kind == FST_KIND_REAL && fst_params_get(&first, i, text, sizeof text) > 0) {
            value = fmod(value * 1.37, 1.0) + 1e-3;
            const double scaled = value * 1e-3;
            memcpy((char *)&first + fst_param_at(i)->offset, &scaled, sizeof scaled);
        }
    }
    char *text = fst_scene_text(&first, 0);
    assert_non_null(text);
    fst_error error = {FST_OK, "", ""};
    if (parse(text, &second, &error) != FST_OK)
        fail_msg("%s: %s\n%s", error.where, error.sentence, text);
    check_same_params(&second, &first);
    free(text);
    text = fst_scene_text(&first, 1); /* with the comments of `festoon init` */
    assert_int_equal(parse(text, &second, &error), FST_OK);
    check_same_params(&second, &first);
    free(text);
}

/* A scene that lists parts replaces the parts that the setup had. */
static void lists_replace(void **state)
{
    (void)state;
    fst_params params = whole();
    fst_error error = {FST_OK, "", ""};
    const char one[] = MAGNET DIPOLE;
    assert_int_equal(fst_scene_parse(one, strlen(one), "s.yaml", &params, &error), FST_OK);
    assert_int_equal(params.magnet_part_count, 1);
    assert_int_equal(params.magnet_parts[0].kind, FST_PART_DIPOLE);
}

static void bad_parts_are_refused(void **state)
{
    (void)state;
#define LIST "magnet:\n  parts:\n"
    static const struct {
        const char *text, *where, *sentence;
    } bad[] = {
        {"magnet:\n  shape: parts\n  parts: 3\n", "s.yaml:3", "must be a list of parts"},
        {"magnet:\n  shape: parts\n  parts: []\n", "s.yaml:3", "lists no part"},
        {MAGNET "    - cuboid\n", "s.yaml:4", "magnet.parts[0] must be keys and values"},
        {MAGNET CUBOID "    - {centre: [0, 0, 0]}\n", "s.yaml:5",
         "magnet.parts[1] has no kind: one of cuboid|"},
        {MAGNET "    - kind: cubiod\n", "s.yaml:4", "the nearest is cuboid"},
        {MAGNET "    - kind: cuboid\n      centre: [0, 0, 0]\n", "s.yaml:4",
         "a cuboid, lacks its size: [edge along x"},
        {MAGNET "    - kind: dipole\n      centre: [0, 0, 0]\n", "s.yaml:4",
         "a dipole, lacks its moment: [x, y, z]"},
        {MAGNET "    - kind: sphere\n      size: 5mm\n", "s.yaml:4", "lacks its centre: [x, y, z]"},
        {MAGNET "    - kind: cuboid\n      centre: [0, 0]\n", "s.yaml:5",
         "magnet.parts[0].centre has 2 values"},
        {MAGNET "    - kind: cuboid\n      centre: [0, 0, 0, 0]\n", "s.yaml:5", "has more than 3 values"},
        {MAGNET "    - kind: cuboid\n      centre: [0, 0, 0]\n      size: [1mm, 2mm]\n", "s.yaml:6",
         "that of a cuboid is [edge along x"},
        {MAGNET "    - kind: cylinder\n      centre: [0, 0, 0]\n      size: [1mm, 2mm, 3mm]\n", "s.yaml:6",
         "magnet.parts[0].size[2]: a cylinder has two sizes, its diameter and its height"},
        {MAGNET "    - kind: dipole\n      centre: [0, 0, 0]\n      size: 3mm\n", "s.yaml:6",
         "a dipole has no size"},
        {MAGNET "    - kind: dipole\n      centre: [0, 0, 0]\n      remanence: [0, 0, 1]\n", "s.yaml:6",
         "a dipole has no remanence: give its moment"},
        {MAGNET "    - {kind: sphere, centre: [0, 0, 0], size: 5mm, remanence: [0, 0, 1],\n       moment: [0, "
                "0, 1]}\n",
         "s.yaml:5", "a sphere has no moment of its own: give its remanence"},
        {MAGNET "    - kind: sphere\n      centre: [0, 0, 0]\n      size: 0 mm\n", "s.yaml:6", "out of range"},
        {MAGNET "    - kind: sphere\n      centre: [0, 0, 0]\n      size: -5 mm\n", "s.yaml:6", "out of range"},
        {MAGNET "    - kind: sphere\n      centre: [0, 0, 0]\n      size: 5 mT\n", "s.yaml:6",
         "units here: um mm cm m"},
        {MAGNET "    - kind: sphere\n      centre: [0 T, 0, 0]\n", "s.yaml:5", "unknown unit \"T\""},
        {MAGNET "    - {kind: sphere, centre: [0, 0, 0], size: 5mm,\n       remanence: [0, 0, 5 mm]}\n",
         "s.yaml:5", "magnet.parts[0].remanence[2]"},
        {MAGNET "    - {kind: sphere, centre: [0, 0, 0], size: 5mm,\n       remanence: [0, 0, 1200]}\n",
         "s.yaml:5", "out of range"},
        {MAGNET "    - kind: sphere\n      sise: 5 mm\n", "s.yaml:5",
         "unknown key \"sise\"; the nearest is size"},
        {MAGNET "    - kind: sphere\n      kind: sphere\n", "s.yaml:5", "kind is given twice: first on line 4"},
        {MAGNET "    - kind: sphere\n      centre: [0, [0], 0]\n", "s.yaml:5", "must be a list of numbers"},
        {MAGNET "    - kind: sphere\n      centre: [0, , 0]\n", "s.yaml:5", ""},
        {MAGNET "    - kind: [sphere, cuboid]\n", "s.yaml:4", "has more than 1 value"},
        {MAGNET CUBOID "    - {kind: sphere, centre: [0, 0, 0], size: 5mm, remanence: [0, 0, 1],\n"
                       "       rotation: [30, 0, 0, 0]}\n",
         "s.yaml:5", "magnet.parts[1].rotation: a turn by 30 degrees needs an axis"},
        {MAGNET "    - {kind: sphere, centre: [0, 0, 0], size: 5mm, remanence: [0, 0, 1],\n"
                "       rotation: [30, 0, 1]}\n",
         "s.yaml:5", "is [degrees, x, y, z]"},
        {MAGNET CUBOID "  depth: 4.5 mm\n", "s.yaml:4", "magnet.parts[0], a cuboid, reaches 4.5 mm"},
        {MAGNET "    - {kind: cylinder, centre: [0, 0, 10mm], size: [14 mm, 2mm], remanence: [0, 0, 1],\n"
                "       rotation: [90, 1, 0, 0]}\n",
         "s.yaml:4", "reaches 17 mm above the magnet's reference plane, but the plate lies at 16.2 mm"},
        {"magnet:\n  parts[0].kind: cuboid\n", "s.yaml:2", "a scene lists its parts whole"},
        {"magnet:\n  shape: parts\n  parts:\n" DIPOLE "  parts:\n" DIPOLE, "s.yaml:5", "given twice"},
        {MAGNET DIPOLE "model: {kappa: 2}\nbead:\n  moment: 0.05\n", "s.yaml:7", "keep one"},
        {MAGNET DIPOLE "model: {kappa: 1.5}\nbead:\n  remanence: 1.1\n", "s.yaml:7", "keep one"},
        {"bead:\n  density: 7000\n  mass: 1 g\n", "s.yaml:3", "keep one"},
        {"bead:\n  remanence: 1.2\n  moment: 0.1\n", "s.yaml:3", "keep one"},
        {"bead: {density: 7 kg}\n", "s.yaml:1", "kg/m^3 g/cm^3"},
        {"bead: {remanence: 1.1}\nmagnet: {b0: 10 mT}\nmodel:\n  kappa: 2\n", "s.yaml:4", "keep one"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        fst_params params;
        fst_error error = {FST_OK, "", ""};
        if (parse(bad[i].text, &params, &error) != FST_BAD_INPUT)
            fail_msg("%s\nwas accepted", bad[i].text);
        if (strcmp(error.where, bad[i].where) != 0 || !strstr(error.sentence, bad[i].sentence))
            fail_msg("%s\n%s: %s\nexpected %s: %s", bad[i].text, error.where, error.sentence, bad[i].where,
                     bad[i].sentence);
    }
}

static void too_many_parts_are_refused(void **state)
{
    (void)state;
    char text[4096] = MAGNET;
    for (int i = 0; i <= FST_PARTS_MAX; ++i)
        strncat(text, DIPOLE, sizeof text - strlen(text) - 1);
    fst_params params;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(parse(text, &params, &error), FST_BAD_INPUT);
    assert_string_equal(error.where, "s.yaml:20");
    CHECK_CONTAINS(error.sentence, "more than 16 parts");
}

static void refuse(const fst_params *before, const char *key, const char *value, const char *sentence)
{
    fst_params params = *before;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_params_set(&params, key, value, &error), FST_BAD_INPUT);
    if (!strstr(error.sentence, sentence))
        fail_msg("%s: %s", key, error.sentence);
    check_same_params(&params, before);
}

/* A magnet can be built key by key, and a number of a part is set like any other. */
static void keys_are_set(void **state)
{
    (void)state;
    char text[64];
    fst_params p = fst_default_params();
    refuse(&p, "magnet.parts[0].size[0]", "1 mm", "magnet.parts[0].kind adds one");
    refuse(&p, "magnet.parts[1].kind", "sphere", "so there is no part 1");
    refuse(&p, "magnet.parts[16].kind", "sphere", "at most 16 parts");
    refuse(&p, "magnet.parts", "sphere", "magnet.parts[0].size[2]");
    set(&p, "magnet.parts[0].kind", "cuboid");
    assert_int_equal(p.magnet_part_count, 1);
    set(&p, "magnet.parts[0].size[2]", "9 mm");
    CHECK_SAME_BITS(p.magnet_parts[0].size[2], 0.009);
    refuse(&p, "magnet.parts[0].sizes[2]", "9 mm", "the nearest is magnet.parts[0].size[2]");
    refuse(&p, "magnet.parts[0].moment[2]", "1", "a cuboid has no moment");
    set(&p, "magnet.parts[0].kind", "cylinder"); /* which has no third size */
    CHECK_SAME_BITS(p.magnet_parts[0].size[2], 0.0);
    const int row = fst_param_find("magnet.parts[0].size[2]");
    assert_int_equal(fst_param_part(row), 0);
    assert_int_equal(fst_params_get(&p, row, text, sizeof text), 0);
    fst_error error = {FST_OK, "", ""};
    p.magnet_shape = FST_MAGNET_PARTS;
    fst_model *model;
    assert_int_equal(fst_model_new(&p, &model, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "magnet.parts[0].size[0] = 0 mm is out of range");
    p.magnet_part_count = 0;
    assert_int_equal(fst_model_new(&p, &model, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "magnet.shape is parts, but there are none");
    p = whole();
    p.magnet_shape = FST_MAGNET_LINES;
    assert_int_equal(fst_params_check_effects(&p, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "magnet.parts has no effect with magnet.shape lines");
    static const char *const of_lines[][2] = {
        {"magnet.lines", "7"}, {"magnet.width", "0.03"}, {"model.lambda", "0.4"}};
    for (size_t i = 0; i < sizeof of_lines / sizeof *of_lines; ++i) {
        p = whole();
        p.magnet_shape = FST_MAGNET_PARTS;
        assert_int_equal(fst_params_check_effects(&p, &error), FST_OK);
        assert_int_equal(fst_params_set(&p, of_lines[i][0], of_lines[i][1], &error), FST_OK);
        assert_int_equal(fst_params_check_effects(&p, &error), FST_BAD_INPUT);
        assert_string_equal(error.where, of_lines[i][0]);
        CHECK_CONTAINS(error.sentence, "has no effect with magnet.shape parts: choose lines");
    }
}

static fst_groups groups_of(const fst_params *p)
{
    fst_model *model;
    fst_error error = {FST_OK, "", ""};
    if (fst_model_new(p, &model, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    const fst_groups g = fst_model_groups(model);
    fst_model_free(model);
    return g;
}

/* Beside a real magnet the bead is 1.2 T, or what the last key set says; B0 is a unit. */
static void strengths_replace_each_other(void **state)
{
    (void)state;
    fst_params p;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(parse(MAGNET DIPOLE, &p, &error), FST_OK);
    const double unit = 0.5e-3 * 2.5e-3 * 2.5e-3 * 312.5 * 312.5;
    CHECK_CLOSE(fst_bead_moment(&p), USUAL_MOMENT, 1e-16);
    CHECK_CLOSE(groups_of(&p).kappa, USUAL_MOMENT * 0.01 / unit, 1e-13);
    CHECK_CLOSE(groups_of(&p).field_unit, 0.01, 0.0);
    set(&p, "model.kappa", "1.5"); /* its default, but given */
    CHECK_CLOSE(groups_of(&p).kappa, 1.5, 0.0);
    CHECK_CLOSE(fst_bead_moment(&p), 1.5 * unit / 0.01, 1e-15);
    set(&p, "bead.moment", "0.1");
    CHECK_CLOSE(groups_of(&p).kappa, 0.1 * 0.01 / unit, 1e-13);
    set(&p, "bead.remanence", "0.6 T");
    assert_true(isnan(p.bead_moment));
    CHECK_CLOSE(fst_bead_moment(&p), 0.5 * USUAL_MOMENT, 1e-16);
    set(&p, "magnet.b0", "1 T");
    CHECK_CLOSE(groups_of(&p).kappa, 0.5 * USUAL_MOMENT / unit, 1e-12);
    set(&p, "bead.radius", "5 mm"); /* eight times the moment, four times R^2 */
    CHECK_CLOSE(groups_of(&p).kappa, 2.0 * 0.5 * USUAL_MOMENT / unit, 1e-12);
    set(&p, "bead.density", "7500");
    CHECK_CLOSE(groups_of(&p).mass, 7500.0 * 4.0 / 3.0 * 3.14159265358979323846 * pow(5e-3, 3), 1e-16);
    set(&p, "bead.mass", "1 g");
    assert_true(isnan(p.bead_density));
    p = fst_default_params(); /* with lines a remanence needs B0, and gives kappa with it */
    set(&p, "bead.remanence", "1.2 T");
    fst_model *model;
    assert_int_equal(fst_model_new(&p, &model, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "bead.remanence = 1.2 T needs magnet.b0");
    set(&p, "magnet.b0", "7.3 mT");
    CHECK_CLOSE(groups_of(&p).kappa, USUAL_MOMENT * 0.0073 / unit, 1e-13);
}

/* Field, force and motion in SI depend neither on B0 nor on the unit of length. */
static void units_do_not_matter(void **state)
{
    (void)state;
    fst_error error = {FST_OK, "", ""};
    double shown[3][16];
    for (int i = 0; i < 3; ++i) {
        fst_params p;
        assert_int_equal(
            parse(MAGNET "    - {kind: dipole, centre: [-15mm, 2mm, 0], moment: [0, 0, 1]}\n"
                         "    - {kind: sphere, centre: [15mm, 0, 0], size: 12mm, remanence: [0.5, 0, -1],\n"
                         "       rotation: [25, 0, 1, 0]}\n"
                         "bead: {density: 7500}\n",
                  &p, &error),
            FST_OK);
        if (i == 1)
            set(&p, "magnet.b0", "0.37 T");
        if (i == 2) {
            set(&p, "magnet.half_length", "41 mm");
            p.start_r *= 23.0 / 41.0;
        }
        p.run_periods = 4;
        p.run_discard = 1;
        p.run_rtol = 1e-12;
        fst_model *model;
        assert_int_equal(fst_model_new(&p, &model, &error), FST_OK);
        const fst_groups g = fst_model_groups(model);
        double b[3], grad[3][3], force[3], load, *out = shown[i];
        fst_field(model, 0.01 / g.length_unit, 0.005 / g.length_unit, b, grad);
        fst_field_pull(model, 0.01 / g.length_unit, 0.005 / g.length_unit, force, &load);
        const double newton = g.mass * g.length_unit / (g.time_unit * g.time_unit);
        for (int k = 0; k < 3; ++k) {
            out[k] = g.field_unit * b[k];
            out[3 + k] = g.field_unit / g.length_unit * grad[k][2];
            out[6 + k] = newton * force[k];
        }
        out[9] = newton * load;
        fst_run_options options = fst_default_run_options();
        fst_run_result result;
        if (fst_run(&p, &options, &result, &error) != FST_OK)
            fail_msg("%s", error.sentence);
        const double x = result.final_state[FST_X], y = result.final_state[FST_Y];
        out[10] = g.length_unit * x;
        out[11] = g.length_unit * y;
        /* <r^2>: r itself has a kink on the axis, past which this bead comes closely */
        out[12] = g.length_unit * g.length_unit * (result.mean_r * result.mean_r + result.std_r * result.std_r);
        out[13] = g.field_unit * result.mean_b;
        out[14] = newton * g.length_unit / g.time_unit * result.mean_friction_power;
        out[15] = result.frequency_hz;
        fst_model_free(model);
    }
    for (int k = 0; k < 16; ++k)
        for (int i = 1; i < 3; ++i)
            CHECK_CLOSE(shown[i][k], shown[0][k], 1e-11 * fabs(shown[0][k]));
}

/* The load is what the observation of a bead at rest there says, and the force the field's slope. */
static void pulls_agree_with_the_motion(void **state)
{
    (void)state;
    fst_params p;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(parse(MAGNET SPHERE DIPOLE, &p, &error), FST_OK);
    fst_model *model;
    assert_int_equal(fst_model_new(&p, &model, &error), FST_OK);
    double b[3], grad[3][3], force[3], load, y[FST_STATE_SIZE] = {0.4, -0.3}, rate[FST_STATE_SIZE];
    fst_field(model, y[0], y[1], b, grad);
    const double norm = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    for (int k = 0; k < 3; ++k)
        y[FST_NX + k] = b[k] / norm;
    const double omega = fst_model_groups(model).omega;
    y[FST_VX] = y[FST_WY] = 0.0; /* at rest in the laboratory: no slip, no friction */
    fst_field_pull(model, y[0], y[1], force, &load);
    CHECK_CLOSE(fst_observe(model, y).load, load, 1e-13);
    fst_rhs(model, y, rate); /* v = 0, so v' is the force alone */
    CHECK_CLOSE(rate[FST_VX], force[0], 1e-13);
    CHECK_CLOSE(rate[FST_VY], force[1], 1e-13);
    assert_true(omega > 0);
    fst_model_free(model);
}

/* The symmetry S2 is the magnet's, whatever the unit of length. */
static void s2_is_asked_of_the_magnet(void **state)
{
    (void)state;
#define PAIR(x, z) "    - {kind: dipole, centre: [" x ", 0, 0], moment: [0, 0, " z "]}\n"
    static const struct {
        const char *parts;
        int has;
    } magnets[] = {
        {PAIR("-20mm", "1") PAIR("20mm", "-1"), 1},
        {PAIR("-20mm", "1") PAIR("20mm", "1"), 0},
        {PAIR("-20mm", "1") PAIR("20mm", "-1.001"), 0},
        {PAIR("-20mm", "1") PAIR("20.001mm", "-1"), 0},
        {PAIR("0", "1"), 0},
        {"    - {kind: dipole, centre: [0, 0, -2mm], moment: [1, 0.5, 0]}\n", 1},
        {"    - {kind: dipole, centre: [1mm, 0, 0], moment: [1, 0, 0]}\n", 0},
        {"    - {kind: sphere, centre: [0, 0, 0], size: 1cm, remanence: [0, 0, 1], rotation: [90, 1, 1, 0]}\n",
         1},
        {PAIR("-0.2mm", "1") PAIR("0.2mm", "-1"), 1},
        /* close to the axis the four, which cancel there, do not show beside the one */
        {"    - {kind: dipole, centre: [0, 0, -2mm], moment: [1, 0, 0]}\n" PAIR("-20mm", "1")
             PAIR("20mm", "1") "    - {kind: dipole, centre: [0, -20mm, 0], moment: [0, 0, -1]}\n"
                               "    - {kind: dipole, centre: [0, 20mm, 0], moment: [0, 0, -1]}\n",
         0},
        {PAIR("-0.2mm", "1") PAIR("0.2mm", "1"), 0},
        /* a grain close below the plate, which is felt above it alone */
        {"    - {kind: cuboid, centre: [0, 0, -10mm], size: [2m, 40mm, 9mm], remanence: [1, 0, 0]}\n"
         "    - {kind: sphere, centre: [1mm, 0, 16.18mm], size: 0.02mm, remanence: [0, 0, 1]}\n",
         0},
    };
    static const char *const units[] = {"1 mm", "23 mm", "2 m"};
    for (size_t i = 0; i < sizeof magnets / sizeof magnets[0]; ++i)
        for (size_t k = 0; k < sizeof units / sizeof units[0]; ++k) {
            char text[512];
            fst_params p;
            fst_error error = {FST_OK, "", ""};
            fst_model *model;
            (void)snprintf(text, sizeof text, MAGNET "%s  half_length: %s\n", magnets[i].parts, units[k]);
            assert_int_equal(parse(text, &p, &error), FST_OK);
            if (fst_model_new(&p, &model, &error) != FST_OK)
                fail_msg("%s", error.sentence);
            if (model->has_s2 != magnets[i].has)
                fail_msg("%swith l = %s: %d, expected %d", magnets[i].parts, units[k], model->has_s2,
                         magnets[i].has);
            fst_model_free(model);
        }
}

/* Outlines: a block turned by 45 degrees about z, one lying on its edge, a disc, a ball, and what holds a
 * place. */
static void parts_are_seen(void **state)
{
    (void)state;
    fst_magnet_part part = {.kind = FST_PART_CUBOID, .centre = {0.01, 0.0, 0.0}, .size = {0.02, 0.02, 0.01}};
    part.remanence[0] = 1.0;
    fst_part_shape seen = fst_part_seen(&part);
    assert_int_equal(seen.count, 4);
    CHECK_CLOSE(seen.high, 0.005, 1e-15);
    part.rotation[0] = 45.0;
    part.rotation[3] = 1.0;
    seen = fst_part_seen(&part);
    assert_int_equal(seen.count, 4);
    double reach = 0.0;
    for (int k = 0; k < seen.count; ++k)
        reach = fmax(reach, seen.corners[k][0]);
    CHECK_CLOSE(reach, 0.01 + 0.01 * sqrt(2.0), 1e-15);
    CHECK_CLOSE(seen.magnetisation[1], sqrt(0.5), 1e-15);
    part.rotation[3] = 0.0;
    part.rotation[2] = 1.0; /* about y: x turns towards -z */
    seen = fst_part_seen(&part);
    CHECK_CLOSE(seen.high, (0.01 + 0.005) * sqrt(0.5), 1e-15);
    CHECK_CLOSE(seen.magnetisation[2], -sqrt(0.5), 1e-15);
    fst_params p = fst_default_params();
    p.magnet_shape = FST_MAGNET_PARTS;
    p.magnet_part_count = 1;
    p.magnet_parts[0] = part;
    const double within[3] = {0.01, 0.009, 0.0105}, above[3] = {0.01, 0.009, 0.0107},
                 beside[3] = {0.01, 0.011, 0.0};
    assert_int_equal(fst_part_touched(&p, (const double[3]){0.01, 0.009, 0.0070}, 0), 0);
    assert_int_equal(fst_part_touched(&p, within, 0), -1); /* over the edge of the turned block */
    assert_int_equal(fst_part_touched(&p, above, 0), -1);
    assert_int_equal(fst_part_touched(&p, beside, 0), -1);
    part = (fst_magnet_part){.kind = FST_PART_SPHERE, .size = {0.02}, .rotation = {30, 0, 1, 0}};
    seen = fst_part_seen(&part);
    assert_int_equal(seen.count, FST_OUTLINE_MOST);
    for (int k = 0; k < seen.count; ++k) {
        const double *a = seen.corners[k], *b = seen.corners[(k + 1) % seen.count];
        CHECK_CLOSE(hypot(a[0], a[1]), 0.01, 1e-15);
        assert_true(hypot(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])) > 0.999 * 0.01); /* round to a pixel */
    }
    part.kind = FST_PART_CYLINDER;
    part.size[1] = 0.005;
    part.rotation[0] = 0;
    seen = fst_part_seen(&part);
    assert_true(seen.count >= 90); /* both rims in one */
    part = (fst_magnet_part){.kind = FST_PART_CYLINDER, .size = {0.02, 0.03}, .rotation = {90, 1, 0, 0}};
    seen = fst_part_seen(&part); /* lying: its axis along -y */
    CHECK_CLOSE(seen.high, 0.01, 1e-15);
    for (int k = 0; k < seen.count; ++k)
        CHECK_CLOSE(fabs(seen.corners[k][1]), 0.015, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_read),
        cmocka_unit_test(scenes_come_back),
        cmocka_unit_test(lists_replace),
        cmocka_unit_test(bad_parts_are_refused),
        cmocka_unit_test(too_many_parts_are_refused),
        cmocka_unit_test(keys_are_set),
        cmocka_unit_test(strengths_replace_each_other),
        cmocka_unit_test(units_do_not_matter),
        cmocka_unit_test(pulls_agree_with_the_motion),
        cmocka_unit_test(s2_is_asked_of_the_magnet),
        cmocka_unit_test(parts_are_seen),
    };
    return cmocka_run_group_tests_name("parts_keys", tests, NULL, NULL);
}
