/* A source that is asked at a height: what it tells there is bit for bit what the same magnet tells a bead that
 * moves at that height, and B changes with the height as the gradient says.  Every kind of source is here, one
 * from examples/c/own among them, but for measured maps, which know one plane.
 * tests: model/source/sources.inl model/tangent.inl
 * labels: own */
#include "model/model.h"

#include "model/tangent.inl"

#include "physics.h"

enum { CUBOID = 3, CYLINDER, SPHERE, DIPOLE, TURNED, ALL_PARTS, OWN, MAGNETS };

static fst_magnet_part part_of(int kind, int turned)
{
    fst_magnet_part part = {.kind = kind, .centre = {0.004, -0.003, -0.03}};
    static const double size[3] = {0.03, 0.02, 0.015}, strength[3] = {0.9, 0.2, -0.4};
    for (int i = 0; i < 3; ++i)
        if (kind == FST_PART_DIPOLE)
            part.moment[i] = 10 * strength[i];
        else
            part.remanence[i] = strength[i];
    const int sizes = kind == FST_PART_CUBOID     ? 3
                      : kind == FST_PART_CYLINDER ? 2
                      : kind == FST_PART_SPHERE   ? 1
                                                  : 0;
    memcpy(part.size, size, (size_t)sizes * sizeof *size);
    if (turned)
        memcpy(part.rotation, (const double[4]){25.0, 0.3, 1.0, -0.5}, sizeof part.rotation);
    return part;
}

/* A bead for which every term of the force counts, beside one of the magnets. */
static fst_params bead_beside(int which)
{
    static const int lines[CUBOID] = {1, 5, 8};
    fst_params p = params_of_case(8);
    if (which < CUBOID) {
        p.magnet_lines = lines[which];
        return p;
    }
    p.magnet_shape = which == OWN ? FST_MAGNET_CHARGES : FST_MAGNET_PARTS;
    if (which == OWN) {
        p.own_charge = 4.5;
        p.own_shift = 0.1;
        return p;
    }
    static const int kinds[] = {FST_PART_CUBOID, FST_PART_CYLINDER, FST_PART_SPHERE, FST_PART_DIPOLE};
    p.magnet_part_count = which == ALL_PARTS ? 4 : 1;
    p.magnet_parts[0] = part_of(kinds[which < TURNED ? which - CUBOID : 0], which == TURNED);
    for (int i = 0; which == ALL_PARTS && i < 4; ++i) {
        p.magnet_parts[i] = part_of(kinds[i], i == 1);
        p.magnet_parts[i].centre[0] = 0.05 * i - 0.08;
    }
    return p;
}

/* From beside the magnet to so far away that its parts are series. */
static const double HEIGHTS[] = {0.45, 0.8, 1.9, 30.0};
enum { HEIGHT_COUNT = sizeof HEIGHTS / sizeof *HEIGHTS };

static fst_model *model_at(fst_params p, double height)
{
    p.model_h = height;
    return model_of(&p);
}

#define CHECK_SAME(a, b) assert_memory_equal(&(a), &(b), sizeof(a))

/* Both read off the field at `state` and the height z: a model's numbers, and those of a model of that height.
 */
static void check_same_field(const fst_world_double *c, double z, const fst_world_double *there,
                             const double *state)
{
    const double x = state[FST_X], y = state[FST_Y];
    fst_local_field_double look[2];
    fst_gradient_double g[2];
    fst_pull_double pull[2];
    double b[2][3], slope[FST_STATE_SIZE];
    assert_true(z == there->height);
    fst_source_look_double(&c->source, &c->kinds, x, y, z, &look[0]);
    fst_source_look_double(&there->source, &there->kinds, x, y, z, &look[1]);
    CHECK_SAME(look[0], look[1]);
    fst_field_double(c, x, y, z, b[0], &g[0]);
    fst_field_double(there, x, y, z, b[1], &g[1]);
    CHECK_SAME(b[0], b[1]);
    CHECK_SAME(g[0], g[1]);
    fst_pull_at_double(c, state, z, &pull[0]);
    fst_pull_at_double(there, state, z, &pull[1]);
    CHECK_SAME(pull[0], pull[1]);
    fst_rhs_double(there, NULL, 0.3, state, slope, &pull[1]); /* on the plate */
    CHECK_SAME(pull[0], pull[1]);
}

static void test_same_bits_as_on_a_plate_there(void **unused)
{
    (void)unused;
    uint64_t seed = 61;
    for (int which = 0; which < MAGNETS; ++which) {
        const fst_params p = bead_beside(which);
        fst_model *low = model_at(p, HEIGHTS[0]);
        for (int i = 0; i < HEIGHT_COUNT; ++i) {
            fst_model *there = model_at(p, HEIGHTS[i]), *asked;
            assert_int_equal(fst_field_model_new(&p, HEIGHTS[i], &asked, NULL), FST_OK);
            for (int trial = 0; trial < 50; ++trial) {
                double state[FST_STATE_SIZE], b[2][3], g[2][3][3];
                random_state(&seed, state);
                check_same_field(&low->world, HEIGHTS[i], &there->world, state);
                fst_field(there, state[FST_X], state[FST_Y], b[0], g[0]);
                fst_field(asked, state[FST_X], state[FST_Y], b[1], g[1]);
                CHECK_SAME(b[0], b[1]);
                CHECK_SAME(g[0], g[1]);
            }
            fst_model_free(asked);
            fst_model_free(there);
        }
        fst_model_free(low);
    }
}

/* dB/dz at a place, by differences of eighth order with the step d: error d^8/630 of the ninth derivative. */
static void difference_by_height(const fst_world_double *c, double x, double y, double z, double d,
                                 double slope[3])
{
    static const double weights[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    slope[0] = slope[1] = slope[2] = 0;
    for (int k = 1; k <= 4; ++k)
        for (int sign = -1; sign <= 1; sign += 2) {
            double b[3];
            fst_gradient_double unused;
            fst_field_double(c, x, y, z + sign * k * d, b, &unused);
            for (int i = 0; i < 3; ++i)
                slope[i] += sign * weights[k - 1] * b[i] / d;
        }
}

static void test_changes_with_height_by_gradient(void **unused)
{
    (void)unused;
    uint64_t seed = 62;
    for (int which = 0; which < MAGNETS; ++which) {
        fst_model *model = model_at(bead_beside(which), HEIGHTS[0]);
        const fst_world_double *c = &model->world;
        for (int i = 0; i < HEIGHT_COUNT; ++i)
            for (int trial = 0; trial < 50; ++trial) {
                const double x = uniform(&seed, -1.5, 1.5), y = uniform(&seed, -1.5, 1.5), z = HEIGHTS[i];
                double b[3], slope[3];
                fst_gradient_double g;
                fst_field_double(c, x, y, z, b, &g);
                difference_by_height(c, x, y, z, 6e-3 * z, slope);
                const double size = sqrt(g.xx * g.xx + g.yy * g.yy + g.xz * g.xz + g.yz * g.yz);
                CHECK_CLOSE(slope[0] / size, g.xz / size, 1e-11);
                CHECK_CLOSE(slope[1] / size, g.yz / size, 1e-11);
                CHECK_CLOSE(slope[2] / size, -(g.xx + g.yy) / size, 1e-11);
            }
        fst_model_free(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bits_as_on_a_plate_there),
        cmocka_unit_test(test_changes_with_height_by_gradient),
    };
    return cmocka_run_group_tests_name("own_heights", tests, NULL, NULL);
}
