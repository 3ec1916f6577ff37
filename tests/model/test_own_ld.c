/* A source and a contact law from examples/c/own, in long double: the field is that of two charges, tangents
 * are derivatives of the equations of motion, and the energy balance closes. No file of src/ knows of them.
 * tests: model/source/sources.inl model/contact/contacts.inl model/tangent.inl
 * labels: long-double own */
#include "physics_ld.h"

#include "model/tangent.inl"

/* The own source and the own law, each alone and both together, with every material and both dynamics. */
enum { OWN_CASES = 3 * 6 };
static fst_params own_params(int which)
{
    fst_params p = bead_at(0.31, which & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
    p.magnet_shape = which % 3 == 0 ? FST_MAGNET_LINES : FST_MAGNET_CHARGES;
    p.friction_law = which % 3 == 1 ? FST_FRICTION_VISCOUS : FST_FRICTION_QUADRATIC;
    p.bead_material = which / 6;
    p.bead_a = which / 6 == FST_MATERIAL_HARD ? 0.0 : 2.3e-3;
    p.bead_b = which / 6 == FST_MATERIAL_MIXED ? -1.7e-3 : 0.0;
    p.own_reach = 0.9;
    p.own_shift = 0.1;
    p.own_charge = 4.5;
    p.own_grip = 11.0;
    p.plate_gravity = 1000.0; /* so heavy that the load is mostly positive in random states */
    return p;
}

/* ------------------------------------------------------------------ the field */

/* B of the two charges, by the definition. */
static void field_by_hand(const fst_params *p, long double h, long double x, long double y, long double b[3])
{
    b[0] = b[1] = b[2] = 0;
    for (int sign = -1; sign <= 1; sign += 2) {
        const long double d[3] = {x - p->own_shift - sign * (long double)p->own_reach, y, h};
        const long double distance = sqrtl(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int i = 0; i < 3; ++i)
            b[i] += sign * p->own_charge * d[i] / (distance * distance * distance);
    }
}

static void test_field(void **unused)
{
    (void)unused;
    const fst_params p = own_params(1);
    fst_model *model = model_of(&p);
    const long double h = fst_model_groups(model).h, d = 4e-3L;
    uint64_t seed = 51;
    for (int trial = 0; trial < 200; ++trial) {
        const double x = uniform(&seed, -1.5, 1.5), y = uniform(&seed, -1.5, 1.5);
        double b[3], g[3][3];
        long double exact[3], above[3], below[3];
        fst_field(model, x, y, b, g);
        field_by_hand(&p, h, x, y, exact);
        for (int i = 0; i < 3; ++i)
            CHECK_CLOSE_LD(b[i], exact[i], 2e-14);
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                long double slope = 0;
                for (int k = 1; k <= 4; ++k) {
                    const long double dx = j == 0 ? k * d : 0, dy = j == 1 ? k * d : 0, dz = j == 2 ? k * d : 0;
                    field_by_hand(&p, h + dz, x + dx, y + dy, above);
                    field_by_hand(&p, h - dz, x - dx, y - dy, below);
                    slope += DIFFERENCE_WEIGHTS[k - 1] * (above[i] - below[i]) / d;
                }
                CHECK_CLOSE_LD(g[i][j], slope, 1e-12);
            }
    }
    fst_model_free(model);
}

/* ------------------------------------------------------------------ tangents */

static void rate(const world_ld *c, const long double *y, long double *dy)
{
    fst_pull_long_double pull;
    fst_rhs_long_double(c, NULL, c->omega, y, dy, &pull);
}

/* The derivative of the right-hand side along a vector, by differences. */
static void difference_along(const world_ld *c, const long double *y, const long double *along,
                             long double *change)
{
    const long double d = 3e-4L;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        change[i] = 0;
    for (int k = 1; k <= 4; ++k) {
        long double above[FST_NUMBERS], below[FST_NUMBERS], up[FST_NUMBERS], down[FST_NUMBERS];
        for (int i = 0; i < FST_STATE_SIZE; ++i) {
            above[i] = y[i] + k * d * along[i];
            below[i] = y[i] - k * d * along[i];
        }
        rate(c, above, up);
        rate(c, below, down);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            change[i] += DIFFERENCE_WEIGHTS[k - 1] * (up[i] - down[i]) / d;
    }
}

/* Along the axes, whose changes are the columns of fst_jacobian(), and along a vector of all components. */
static void test_tangents_are_derivatives(void **unused)
{
    (void)unused;
    uint64_t seed = 52;
    for (int which = 0; which < OWN_CASES; ++which) {
        const fst_params p = own_params(which);
        fst_model *model = model_of(&p);
        const world_ld c = world_of(&p);
        for (int trial = 0; trial < 10; ++trial) {
            double state[FST_STATE_SIZE], jacobian[FST_STATE_SIZE][FST_STATE_SIZE];
            long double y[FST_NUMBERS], dy[FST_NUMBERS], expected_dy[FST_NUMBERS];
            random_state(&seed, state);
            fst_jacobian(model, state, jacobian, NULL);
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                y[i] = state[i];
            rate(&c, y, expected_dy);
            long double speed = 1;
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                speed = fmaxl(speed, fabsl(expected_dy[i]));
            for (int axis = 0; axis <= FST_STATE_SIZE; ++axis) {
                long double along[FST_NUMBERS], change[FST_NUMBERS], expected[FST_NUMBERS], size = 1;
                for (int i = 0; i < FST_STATE_SIZE; ++i)
                    along[i] = axis == FST_STATE_SIZE ? cosl(1.0L + 3.0L * i) : axis == i ? 1.0L : 0.0L;
                fst_rhs_and_tangent_long_double(&c, NULL, c.omega, y, along, dy, change);
                difference_along(&c, y, along, expected);
                for (int i = 0; i < FST_STATE_SIZE; ++i)
                    size = fmaxl(size, fabsl(expected[i]));
                for (int i = 0; i < FST_STATE_SIZE; ++i) {
                    CHECK_CLOSE_LD(change[i] / size, expected[i] / size, 1e-13);
                    CHECK_CLOSE_LD(dy[i] / speed, expected_dy[i] / speed, 1e-17);
                    if (axis < FST_STATE_SIZE)
                        CHECK_CLOSE_LD(jacobian[i][axis] / size, change[i] / size, 1e-14);
                }
            }
        }
        fst_model_free(model);
    }
}

/* ------------------------------------------------------------------ energy */

static long double energy_at(const world_ld *c, const long double *y)
{
    fst_pull_long_double pull;
    fst_magnetic_pull_long_double(c, NULL, y, &pull);
    return fst_energy_long_double(c, NULL, y, &pull);
}

/* Along the motion the energy changes by the drive's power less the loss that the law states. */
static void test_energy_balance(void **unused)
{
    (void)unused;
    uint64_t seed = 53;
    for (int which = 0; which < OWN_CASES; ++which) {
        const fst_params p = own_params(which);
        const world_ld c = world_of(&p);
        for (int trial = 0; trial < 20; ++trial) {
            double state[FST_STATE_SIZE];
            long double y[FST_NUMBERS], dy[FST_NUMBERS], change = 0;
            random_state(&seed, state);
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                y[i] = state[i];
            fst_pull_long_double pull;
            fst_seen_long_double seen;
            fst_rhs_long_double(&c, NULL, c.omega, y, dy, &pull);
            fst_see_long_double(&c, NULL, c.omega, y, &pull, &seen);
            const long double d = 1e-3L, size = 1 + fabsl(seen.friction_power);
            assert_true((seen.load > 0) == (seen.friction_power > 0));
            for (int k = 1; k <= 4; ++k) {
                long double above[FST_NUMBERS], below[FST_NUMBERS];
                for (int i = 0; i < FST_STATE_SIZE; ++i) {
                    above[i] = y[i] + k * d * dy[i];
                    below[i] = y[i] - k * d * dy[i];
                }
                change += DIFFERENCE_WEIGHTS[k - 1] * (energy_at(&c, above) - energy_at(&c, below)) / d;
            }
            const long double expected = seen.drive_power - seen.friction_power;
            CHECK_CLOSE_LD(change / size, expected / size, 1e-13);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_field),
        cmocka_unit_test(test_tangents_are_derivatives),
        cmocka_unit_test(test_energy_balance),
    };
    return cmocka_run_group_tests_name("own_ld", tests, NULL, NULL);
}
