/* A measured field in long double: splines of degree 7 reproduce polynomials of degree 7, value by value up to
 * the edge; gradient and bend are derivatives of the field; and for any samples, with however much noise, the
 * force is the derivative of the energy and the tangent that of the motion.
 * tests: model/source/grid.inl model/source/local_field.inl
 * labels: long-double */
#include "measured_field.h"
#include "physics_ld.h"

#include "model/tangent.inl"

/* ------------------------------------------------------------------ polynomials */

enum { COUNT_X = 12, COUNT_Y = 9 };

/* p(x) with coefficients that alternate, and its derivatives; x from -1 to 1. */
static long double polynomial(long double x, int order)
{
    long double sum = 0;
    for (int k = 7; k >= order; --k) {
        long double factor = k % 3 == 1 ? -0.7L : 0.4L + 0.1L * k;
        for (int j = 0; j < order; ++j)
            factor *= k - j;
        sum = sum * x + factor;
    }
    return sum;
}

/* Each component is a product of polynomials in x and y, told apart by a factor and the sides exchanged. */
static long double component(int c, long double x, long double y, int by_x, int by_y)
{
    return (1 + c) * (c == 1 ? polynomial(y, by_y) * polynomial(-x, by_x) * (by_x % 2 ? -1 : 1)
                             : polynomial(x, by_x) * polynomial(y, by_y));
}

static void test_polynomials(void **unused)
{
    (void)unused;
    double b[COUNT_X * COUNT_Y * 3];
    fst_field_samples samples = {{COUNT_X, COUNT_Y, 1}, {-0.02, -0.015, NAN}, {0.0, 0.0, 0.0}, b};
    samples.spacing[0] = 0.04 / (COUNT_X - 1);
    samples.spacing[1] = 0.03 / (COUNT_Y - 1);
    const double l = 0.01;
    for (int j = 0; j < COUNT_Y; ++j)
        for (int i = 0; i < COUNT_X; ++i)
            for (int c = 0; c < 3; ++c)
                b[3 * (j * COUNT_X + i) + c] =
                    (double)component(c, (samples.first[0] + i * samples.spacing[0]) / 0.02L,
                                      (samples.first[1] + j * samples.spacing[1]) / 0.02L, 0, 0);
    fst_field_map *map = map_of_samples(&samples);
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    p.magnet_half_length = l;
    p.magnet_shape = FST_MAGNET_GRID;
    p.magnet_map = map;
    p.magnet_b0 = 1.0;
    const world_ld c = world_of(&p);
    uint64_t seed = 5;
    for (int trial = 0; trial < 300; ++trial) {
        const long double x = uniform(&seed, -2, 2), y = uniform(&seed, -1.5, 1.5);
        fst_local_field_long_double at;
        fst_source_look_long_double(&c.source, &c.kinds, x, y, c.height, &at);
        /* x in l is 2 u, u being what the polynomials are written in. */
        const long double u = x / 2, v = y / 2;
#define EXACT(c, by_x, by_y) component(c, u, v, by_x, by_y) / (1 << ((by_x) + (by_y)))
        for (int k = 0; k < 3; ++k)
            CHECK_CLOSE_LD(at.b[k], EXACT(k, 0, 0), 1e-12);
        CHECK_CLOSE_LD(at.gradient.xx, EXACT(0, 1, 0), 1e-11);
        CHECK_CLOSE_LD(at.gradient.xy, EXACT(0, 0, 1), 1e-11);
        CHECK_CLOSE_LD(at.gradient.yx, EXACT(1, 1, 0), 1e-11);
        CHECK_CLOSE_LD(at.gradient.yy, EXACT(1, 0, 1), 1e-11);
        CHECK_CLOSE_LD(at.gradient.xz, EXACT(2, 1, 0), 1e-11);
        CHECK_CLOSE_LD(at.gradient.yz, EXACT(2, 0, 1), 1e-11);
        CHECK_CLOSE_LD(at.bend.xxx, EXACT(0, 2, 0), 1e-10);
        CHECK_CLOSE_LD(at.bend.xxy, EXACT(0, 1, 1), 1e-10);
        CHECK_CLOSE_LD(at.bend.xyy, EXACT(0, 0, 2), 1e-10);
        CHECK_CLOSE_LD(at.bend.yxx, EXACT(1, 2, 0), 1e-10);
        CHECK_CLOSE_LD(at.bend.yxy, EXACT(1, 1, 1), 1e-10);
        CHECK_CLOSE_LD(at.bend.yyy, EXACT(1, 0, 2), 1e-10);
        CHECK_CLOSE_LD(at.bend.xxz, EXACT(2, 2, 0), 1e-10);
        CHECK_CLOSE_LD(at.bend.xyz, EXACT(2, 1, 1), 1e-10);
        CHECK_CLOSE_LD(at.bend.yyz, EXACT(2, 0, 2), 1e-10);
#undef EXACT
    }
    fst_field_map_free(map);
}

/* ------------------------------------------------------------------ energy and tangents over noise */

/* A map of noise as large as the field, on cells so large that a random state stays on it and a stencil mostly
 * within a cell. */
static fst_params noisy_case(int which, fst_field_map **map)
{
    const fst_params p = params_of_case(which);
    *map = map_of_model(&p, 0.5, 6, 2.0);
    return over_map(&p, *map);
}

static long double energy_at(const world_ld *c, const long double *y)
{
    fst_pull_long_double pull;
    fst_magnetic_pull_long_double(c, NULL, y, &pull);
    return fst_energy_long_double(c, NULL, y, &pull);
}

static void random_ld_state(uint64_t *seed, long double y[FST_STATE_SIZE])
{
    double state[FST_STATE_SIZE];
    random_state(seed, state);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        y[i] = (i >= FST_WX ? 0.5L : 1) * state[i];
}

/* Splines have jumps in the seventh derivative where cells meet: a stencil that crosses none is exact. */
static int crosses_a_cell(const long double *y, long double reach)
{
    for (int axis = 0; axis < 2; ++axis)
        if (floorl((y[axis] - reach) / 0.5L) != floorl((y[axis] + reach) / 0.5L))
            return 1;
    return 0;
}

static void test_energy(void **unused)
{
    (void)unused;
    uint64_t seed = 62;
    double curl_most = 0;
    for (int which = 0; which < CASES; ++which) {
        fst_field_map *map;
        const fst_params p = noisy_case(which, &map);
        const world_ld c = world_of(&p);
        for (int trial = 0; trial < 30; ++trial) {
            long double y[FST_NUMBERS], dy[FST_NUMBERS], moved[FST_NUMBERS], change = 0;
            random_ld_state(&seed, y);
            fst_pull_long_double pull;
            fst_seen_long_double seen;
            fst_rhs_long_double(&c, NULL, c.omega, y, dy, &pull);
            const long double d = 1e-3L;
            if (crosses_a_cell(y, 4 * d * hypotl(dy[0], dy[1])))
                continue;
            fst_see_long_double(&c, NULL, c.omega, y, &pull, &seen);
            for (int k = 1; k <= 4; ++k)
                for (int sign = -1; sign <= 1; sign += 2) {
                    for (int i = 0; i < FST_STATE_SIZE; ++i)
                        moved[i] = y[i] + sign * k * d * dy[i];
                    change += sign * DIFFERENCE_WEIGHTS[k - 1] * energy_at(&c, moved) / d;
                }
            CHECK_CLOSE_LD(change, seen.drive_power - seen.friction_power, 1e-12);
            fst_gradient_long_double g;
            long double b[3];
            fst_field_long_double(&c, y[FST_X], y[FST_Y], c.height, b, &g);
            curl_most = fmax(curl_most, (double)fabsl(g.yx - g.xy));
        }
        fst_field_map_free(map);
    }
    CHECK_WITHIN(curl_most, 1.0, INFINITY); /* the noise is there */
}

static void test_tangents(void **unused)
{
    (void)unused;
    uint64_t seed = 63;
    int compared = 0;
    for (int which = 0; which < CASES; ++which) {
        fst_field_map *map;
        const fst_params p = noisy_case(which, &map);
        const world_ld c = world_of(&p);
        for (int trial = 0; trial < 20; ++trial) {
            long double y[FST_NUMBERS], t[FST_NUMBERS], dy[FST_NUMBERS], change[FST_NUMBERS];
            long double slope[FST_NUMBERS] = {0}, moved[FST_NUMBERS], unused_dy[FST_NUMBERS];
            const long double d = 1e-3L;
            random_ld_state(&seed, y);
            random_ld_state(&seed, t);
            if (crosses_a_cell(y, 4 * d * hypotl(t[0], t[1])))
                continue;
            compared += 1;
            fst_rhs_and_tangent_long_double(&c, NULL, c.omega, y, t, unused_dy, change);
            for (int k = 1; k <= 4; ++k)
                for (int sign = -1; sign <= 1; sign += 2) {
                    fst_pull_long_double pull;
                    for (int i = 0; i < FST_STATE_SIZE; ++i)
                        moved[i] = y[i] + sign * k * d * t[i];
                    fst_rhs_long_double(&c, NULL, c.omega, moved, dy, &pull);
                    for (int i = 0; i < FST_STATE_SIZE; ++i)
                        slope[i] += sign * DIFFERENCE_WEIGHTS[k - 1] * dy[i] / d;
                }
            for (int i = 0; i < FST_STATE_SIZE; ++i)
                CHECK_CLOSE_LD(change[i], slope[i], 1e-10);
        }
        fst_field_map_free(map);
    }
    CHECK_WITHIN(compared, 100, INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_polynomials),
        cmocka_unit_test(test_energy),
        cmocka_unit_test(test_tangents),
    };
    return cmocka_run_group_tests_name("measured_ld", tests, NULL, NULL);
}
