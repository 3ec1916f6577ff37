/* The field in long double: its gradient against finite differences, and Maxwell's equations by differences of
 * B alone.
 * tests: model/source/lines.inl model/source/local_field.inl model/bodies.inl
 * labels: long-double */
#include "physics_ld.h"

/* dB_i/dx_j by finite differences; the third direction is the height. */
static void differences_of_b(const world_ld *c, const long double at[2], long double g[3][3])
{
    const long double d = 4e-3L;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i)
            g[i][j] = 0;
        for (int k = 1; k <= 4; ++k)
            for (int sign = -1; sign <= 1; sign += 2) {
                const long double step = sign * k * d;
                const long double x = at[0] + (j == 0 ? step : 0), y = at[1] + (j == 1 ? step : 0);
                const long double z = c->height + (j == 2 ? step : 0);
                long double b[3];
                fst_gradient_long_double unused;
                fst_field_long_double(c, x, y, z, b, &unused);
                for (int i = 0; i < 3; ++i)
                    g[i][j] += sign * DIFFERENCE_WEIGHTS[k - 1] * b[i] / d;
            }
    }
}

static void test_gradient_and_maxwell(void **unused)
{
    (void)unused;
    static const int numbers[] = {1, 2, 5, 8, 99};
    uint64_t seed = 21;
    for (int number = 0; number < 5; ++number) {
        fst_params p = fst_default_params();
        p.magnet_lines = numbers[number];
        fst_model *model = model_of(&p);
        const world_ld c = world_of(&p);
        for (int trial = 0; trial < 20; ++trial) {
            const double x = uniform(&seed, -1.5, 1.5), y = uniform(&seed, -1.5, 1.5);
            double b[3], gradient[3][3];
            fst_field(model, x, y, b, gradient);
            long double g[3][3];
            differences_of_b(&c, (const long double[2]){x, y}, g);
            CHECK_CLOSE_LD(g[0][0] + g[1][1] + g[2][2], 0, 1e-13); /* div B = 0 */
            CHECK_CLOSE_LD(g[2][1] - g[1][2], 0, 1e-13);           /* curl B = 0 */
            CHECK_CLOSE_LD(g[0][2] - g[2][0], 0, 1e-13);
            CHECK_CLOSE_LD(g[1][0] - g[0][1], 0, 1e-13);
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    CHECK_CLOSE_LD(gradient[i][j], g[i][j], 3e-13);
        }
        fst_model_free(model);
    }
}

/* The field over double differs from the one over long double by rounding. */
static void test_double_rounds_only(void **unused)
{
    (void)unused;
    const fst_params p = fst_default_params();
    fst_model *model = model_of(&p);
    const world_ld c = world_of(&p);
    uint64_t seed = 22;
    for (int trial = 0; trial < 1000; ++trial) {
        const double x = uniform(&seed, -3, 3), y = uniform(&seed, -3, 3);
        double b[3], gradient[3][3];
        fst_field(model, x, y, b, gradient);
        long double exact[3];
        fst_gradient_long_double g;
        fst_field_long_double(&c, x, y, c.height, exact, &g);
        for (int i = 0; i < 3; ++i)
            CHECK_CLOSE_LD(b[i], exact[i], 1e-14);
        CHECK_CLOSE_LD(gradient[0][0], g.xx, 4e-14);
        CHECK_CLOSE_LD(gradient[1][1], g.yy, 4e-14);
        CHECK_CLOSE_LD(gradient[0][1], g.xy, 4e-14);
        CHECK_CLOSE_LD(gradient[0][2], g.xz, 4e-14);
        CHECK_CLOSE_LD(gradient[1][2], g.yz, 4e-14);
    }
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gradient_and_maxwell),
        cmocka_unit_test(test_double_rounds_only),
    };
    return cmocka_run_group_tests_name("field_ld", tests, NULL, NULL);
}
