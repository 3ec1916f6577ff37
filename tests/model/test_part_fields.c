/* Parts of a magnet as a whole: how far they are; a sphere is a dipole; parts add up;
 * a part that is turned has the turned field; and the field's gradient and bend are its differences.
 * tests: model/source/parts.inl model/source/dipole.inl model/source/part_local.inl model/part_geometry.c
 * labels: memcheck */
#include "physics.h"

#include "model/model.h"

static fst_params magnet_of(const fst_magnet_part *parts, int count)
{
    fst_params p = fst_default_params();
    p.magnet_shape = FST_MAGNET_PARTS;
    p.magnet_part_count = count;
    memcpy(p.magnet_parts, parts, (size_t)count * sizeof *parts);
    return p;
}

static void field_of(const fst_params *p, double x, double y, double b[3], double g[3][3])
{
    fst_model *model = model_of(p);
    fst_field(model, x, y, b, g);
    fst_model_free(model);
}

static void test_shape(void **unused)
{
    (void)unused;
    fst_magnet_part part = {.kind = FST_PART_CUBOID, .centre = {0, 0, 1}, .size = {6, 4, 2}};
    CHECK_CLOSE(fst_part_distance(&part, (const double[3]){2, 1, 1.5}), 0, 0);
    CHECK_CLOSE(fst_part_distance(&part, (const double[3]){6, 6, 2}), 5, 1e-15);
    /* A quarter turn about y brings the own z to x: 1 from the centre to the face, seen along x. */
    part.rotation[0] = 90;
    part.rotation[2] = 1;
    CHECK_CLOSE(fst_part_distance(&part, (const double[3]){3, 0, 3}), 2, 1e-15);
    part.kind = FST_PART_CYLINDER; /* diameter 6, height 4 along x now */
    CHECK_CLOSE(fst_part_distance(&part, (const double[3]){5, 0, 8}), 5, 1e-15);
    part.rotation[0] = 0;
    part.kind = FST_PART_SPHERE;
    CHECK_CLOSE(fst_part_distance(&part, (const double[3]){0, 4, 4}), 2, 1e-15);
    part.kind = FST_PART_DIPOLE;
    CHECK_CLOSE(fst_part_distance(&part, (const double[3]){0, 4, 4}), 5, 1e-15);
    const fst_magnet_part two[2] = {{.kind = FST_PART_SPHERE, .centre = {-5}, .size = {2}}, part};
    const fst_params p = magnet_of(two, 2);
    assert_int_equal(fst_part_touched(&p, (const double[3]){-2, 0, 0}, 1.9), -1);
    assert_int_equal(fst_part_touched(&p, (const double[3]){-2, 0, 0}, 2.0), 0);
    assert_int_equal(fst_part_touched(&p, (const double[3]){0, 0.5, 1}, 0.6), 1);
}

/* A sphere of remanence J and radius R has the moment 4 pi R^3 J/(3 mu_0). */
static void test_sphere_is_dipole(void **unused)
{
    (void)unused;
    const double moment = 4 * 3.14159265358979324 / 3 * 1e-6 / 1.25663706127e-6;
    fst_magnet_part sphere = {.kind = FST_PART_SPHERE, .size = {20e-3}, .remanence = {0.3, -0.5, 1.1}};
    fst_magnet_part dipole = {.kind = FST_PART_DIPOLE, .moment = {0.3 * moment, -0.5 * moment, 1.1 * moment}};
    const fst_params p = magnet_of(&sphere, 1), q = magnet_of(&dipole, 1);
    double b[2][3], g[2][3][3];
    field_of(&p, 0.4, -0.7, b[0], g[0]);
    field_of(&q, 0.4, -0.7, b[1], g[1]);
    for (int i = 0; i < 3; ++i) {
        CHECK_CLOSE(b[0][i], b[1][i], 1e-14 * fabs(b[0][2]));
        for (int j = 0; j < 3; ++j)
            CHECK_CLOSE(g[0][i][j], g[1][i][j], 1e-14 * fabs(g[0][2][2]));
    }
}

/* A part is the same body if its own axes are turned one way and its edges and remanence are given along them.
 */
static void test_turned(void **unused)
{
    (void)unused;
    const fst_magnet_part plain = {.kind = FST_PART_CUBOID,
                                   .centre = {5e-3, -3e-3, -6e-3},
                                   .size = {30e-3, 20e-3, 10e-3},
                                   .remanence = {0.3, -0.5, 1.1}};
    /* Own x, y, z along the magnet's y, z, x: 120 degrees about (1, 1, 1). */
    const fst_magnet_part turned = {.kind = FST_PART_CUBOID,
                                    .centre = {5e-3, -3e-3, -6e-3},
                                    .size = {20e-3, 10e-3, 30e-3},
                                    .remanence = {-0.5, 1.1, 0.3},
                                    .rotation = {120, 1, 1, 1}};
    const fst_params p = magnet_of(&plain, 1), q = magnet_of(&turned, 1);
    double b[2][3], g[2][3][3];
    for (int k = 0; k < 20; ++k) {
        field_of(&p, 0.2 * k - 1, 0.1 * k - 1, b[0], g[0]);
        field_of(&q, 0.2 * k - 1, 0.1 * k - 1, b[1], g[1]);
        for (int i = 0; i < 3; ++i) {
            CHECK_CLOSE(b[0][i], b[1][i], 1e-13);
            for (int j = 0; j < 3; ++j)
                CHECK_CLOSE(g[0][i][j], g[1][i][j], 1e-12);
        }
    }
}

/* Turning the whole magnet by an angle about the vertical turns the field: B(R x) = R B(x). */
static void test_turned_by_any_angle(void **unused)
{
    (void)unused;
    fst_magnet_part part = {
        .kind = FST_PART_CUBOID, .size = {30e-3, 20e-3, 10e-3}, .remanence = {0.3, -0.5, 1.1}};
    const fst_params p = magnet_of(&part, 1);
    part.rotation[0] = 30;
    part.rotation[3] = 2; /* any length */
    const fst_params q = magnet_of(&part, 1);
    const double c = sqrt(0.75), s = 0.5, x = 0.7, y = -0.4;
    double b[2][3], g[2][3][3];
    field_of(&p, x, y, b[0], g[0]);
    field_of(&q, c * x - s * y, s * x + c * y, b[1], g[1]);
    CHECK_CLOSE(b[1][0], c * b[0][0] - s * b[0][1], 1e-13);
    CHECK_CLOSE(b[1][1], s * b[0][0] + c * b[0][1], 1e-13);
    CHECK_CLOSE(b[1][2], b[0][2], 1e-13);
    CHECK_CLOSE(g[1][2][0], c * g[0][2][0] - s * g[0][2][1], 1e-12);
    CHECK_CLOSE(g[1][2][2], g[0][2][2], 1e-12);
    CHECK_CLOSE(g[1][0][0], c * c * g[0][0][0] - 2 * s * c * g[0][0][1] + s * s * g[0][1][1], 1e-12);
}

/* Several parts, turned ones among them: the whole is the sum, and G and T follow from B by differences, which
 * is what the equations of motion and their tangents use. */
static void test_many(void **unused)
{
    (void)unused;
    const fst_magnet_part parts[3] = {
        {.kind = FST_PART_CUBOID,
         .centre = {-10e-3, 0, -5e-3},
         .size = {12e-3, 9e-3, 6e-3},
         .remanence = {0, 1.2, 0.3},
         .rotation = {50, 1, 2, -0.5}},
        {.kind = FST_PART_SPHERE,
         .centre = {12e-3, 4e-3, -5e-3},
         .size = {9e-3},
         .remanence = {0.2, 0, -1},
         .rotation = {-20, 0, 1, 0}},
        {.kind = FST_PART_DIPOLE, .centre = {0, 15e-3, -4e-3}, .moment = {0.3, 0.1, 0.2}}};
    const fst_params all = magnet_of(parts, 3);
    const double x = 0.3, y = -0.2;
    double b[3], g[3][3], sum[3] = {0};
    field_of(&all, x, y, b, g);
    for (int i = 0; i < 3; ++i) {
        double own[3], own_g[3][3];
        const fst_params one = magnet_of(&parts[i], 1);
        field_of(&one, x, y, own, own_g);
        for (int k = 0; k < 3; ++k)
            sum[k] += own[k];
    }
    for (int k = 0; k < 3; ++k)
        CHECK_CLOSE(sum[k], b[k], 1e-13);
    fst_model *model = model_of(&all);
    const fst_world_double *c = &model->world;
    fst_local_field_double at, there[2];
    fst_source_look_double(&c->source, &c->kinds, x, y, c->height, &at);
    const double d = 1e-4;
    for (int axis = 0; axis < 2; ++axis) {
        for (int side = 0; side < 2; ++side) {
            const double step = side ? d : -d;
            fst_source_look_double(&c->source, &c->kinds, x + (axis == 0 ? step : 0),
                                   y + (axis == 1 ? step : 0), c->height, &there[side]);
        }
        for (int i = 0; i < 3; ++i)
            CHECK_CLOSE((there[1].b[i] - there[0].b[i]) / (2 * d), g[i][axis], 1e-5);
        fst_gradient_double change;
        fst_gradient_change_double(&at.bend, axis == 0, axis == 1, &change);
        const double *before = &there[0].gradient.xx, *after = &there[1].gradient.xx, *expected = &change.xx;
        for (int i = 0; i < 5; ++i)
            CHECK_CLOSE((after[i] - before[i]) / (2 * d), expected[i], 2e-5);
    }
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shape),  cmocka_unit_test(test_sphere_is_dipole),
        cmocka_unit_test(test_turned), cmocka_unit_test(test_turned_by_any_angle),
        cmocka_unit_test(test_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
