/* The field of a loop of current (model/source/loop.inl): against Biot and Savart's integral, the formula of its axis,
 * that of a dipole far away, and double against long double.
 * tests: model/source/loop.inl
 * labels: long-double */
#include "both_precisions.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))
#define PI 3.14159265358979323846264338327950288L
enum { NUMBERS = 8, ANGLES = 6000 }; /* B; xx yy xy xz yz of G */

static void flat_ld(long double radius, const long double place[3], long double out[NUMBERS])
{
    fst_part_long_double loop = {.half = {radius, radius, 0}, .j = {0, 0, 1}};
    fst_gradient_long_double g;
    fst_loop_field_long_double(&loop, place, out, &g);
    const long double of_g[] = {g.xx, g.yy, g.xy, g.xz, g.yz};
    memcpy(out + 3, of_g, sizeof of_g);
}

static void flat_double(double radius, const long double place[3], long double out[NUMBERS])
{
    const fst_part_double loop = {.half = {radius, radius, 0}, .j = {0, 0, 1}};
    const double d[3] = {(double)place[0], (double)place[1], (double)place[2]};
    double b[3];
    fst_gradient_double g;
    fst_loop_field_double(&loop, d, b, &g);
    const long double all[NUMBERS] = {b[0], b[1], b[2], g.xx, g.yy, g.xy, g.xz, g.yz};
    memcpy(out, all, sizeof all);
}

/* Biot and Savart: the integral of dl x r/r^3 and its derivatives by the place, by equal angles, which converge
 * exponentially. */
static void by_quadrature(long double radius, const long double place[3], long double out[NUMBERS])
{
    static const int pairs[5][2] = {{0, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}};
    memset(out, 0, NUMBERS * sizeof *out);
    for (int n = 0; n < ANGLES; ++n) {
        const long double c = cosl(2 * PI * n / ANGLES), s = sinl(2 * PI * n / ANGLES);
        const long double w = radius * 2 * PI / ANGLES, dl[3] = {-s * w, c * w, 0};
        const long double r[3] = {place[0] - radius * c, place[1] - radius * s, place[2]};
        const long double r2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2], q3 = 1 / (r2 * sqrtl(r2));
        const long double turned[3] = {dl[1] * r[2], -dl[0] * r[2], dl[0] * r[1] - dl[1] * r[0]};
        const long double change[3][3] = {
            {0, 0, dl[1]}, {0, 0, -dl[0]}, {-dl[1], dl[0], 0}}; /* of turned[i] by j */
        for (int i = 0; i < 3; ++i)
            out[i] += turned[i] * q3;
        for (int k = 0; k < 5; ++k) {
            const int i = pairs[k][0], j = pairs[k][1];
            out[3 + k] += change[i][j] * q3 - 3 * turned[i] * r[j] * q3 / r2;
        }
    }
}

/* The greatest error of B, and of G, over the greatest component. */
static void errors_of(const long double *found, const long double *exact, double *of_b, double *of_g)
{
    long double off[2] = {0, 0}, size[2] = {0, 0};
    for (int i = 0; i < NUMBERS; ++i) {
        assert_true(isfinite(found[i]));
        off[i > 2] = fmaxl(off[i > 2], fabsl(found[i] - exact[i]));
        size[i > 2] = fmaxl(size[i > 2], fabsl(exact[i]));
    }
    *of_b = (double)(off[0] / size[0]);
    *of_g = (double)(off[1] / size[1]);
}

/* On the axis, beside it, within, over, under and beside the wire, in its plane, far away. */
static const long double places[][3] = {
    {0, 0, 0.6L},  {1e-12L, 0, 0.3L}, {1e-5L, 2e-5L, 0.4L}, {0.3L, 0.1L, 0.2L},  {0.5L, 0.2L, 0},
    {1, 0, 0.05L}, {0.98L, 0.02L, 0}, {1.03L, 0, -0.01L},   {0.6L, 0.8L, -0.2L}, {0.2L, -1.6L, 0.7L},
    {3, 1, 2},     {-4, 2, 0},        {0.1L, 0.2L, 9},      {40, 13, 30},        {300, -200, 10},
};

static void test_quadrature(void **unused)
{
    (void)unused;
    for (size_t n = 0; n < COUNT(places); ++n) {
        long double found[NUMBERS], exact[NUMBERS];
        double of_b, of_g;
        flat_ld(1, places[n], found);
        by_quadrature(1, places[n], exact);
        errors_of(found, exact, &of_b, &of_g);
        /* far away the integral is a difference of like terms */
        const double far = (double)(1 + fabsl(places[n][0]) + fabsl(places[n][1]) + fabsl(places[n][2]));
        CHECK_WITHIN(of_b, 0, 4e-18 * far);
        CHECK_WITHIN(of_g, 0, 4e-17 * far);
    }
}

/* What a double rounds, at random places from 1e-6 from the wire on to 1000 radii away. */
static void test_rounding(void **unused)
{
    (void)unused;
    uint64_t seed = 11;
    double most_b = 0, most_g = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const double distance = pow(10, uniform(&seed, -6, 3)), angle = uniform(&seed, 0, TWO_PI);
        const double about = uniform(&seed, 0, TWO_PI), rho = fabs((trial % 3 ? 1 : 0) + distance * cos(angle));
        const long double place[3] = {rho * cos(about), rho * sin(about), distance * sin(angle)};
        long double found[NUMBERS], exact[NUMBERS];
        double of_b, of_g;
        flat_double(1, place, found);
        const long double same[3] = {(double)place[0], (double)place[1], (double)place[2]};
        flat_ld(1, same, exact);
        errors_of(found, exact, &of_b, &of_g);
        /* the distance from the wire is rho - 1, whose rounding counts for the field as 1/distance */
        const double near = trial % 3 && distance < 0.1 ? 1 / distance : 1;
        most_b = fmax(most_b, of_b / near);
        most_g = fmax(most_g, of_g / near);
    }
    CHECK_WITHIN(most_b, 0, 4e-15);
    CHECK_WITHIN(most_g, 0, 8e-15);
}

/* On the axis B_z = (mu_0 I/2) R^2/(R^2 + z^2)^(3/2). */
static void test_axis(void **unused)
{
    (void)unused;
    for (long double z = -3; z < 1000; z = z < 1 ? z + 0.37L : 2 * z) {
        const long double place[3] = {0, 0, z}, square = 0.25L + z * z;
        long double found[NUMBERS];
        flat_ld(0.5L, place, found);
        const long double exact = 2 * PI * 0.25L / (square * sqrtl(square)); /* times mu_0 I/(4 pi) */
        CHECK_CLOSE_LD(found[2] / exact, 1, 1e-17);
        CHECK_CLOSE_LD(found[0], 0, 0);
        CHECK_CLOSE_LD((found[3] + found[4]) / (3 * z * exact / square), 1, 1e-16); /* -dB_z/dz */
    }
}

/* Far away it is the dipole pi R^2 I: what is left falls as the square of the distance. */
static void test_dipole(void **unused)
{
    (void)unused;
    const fst_part_long_double dipole = {.j = {0, 0, PI}};
    double of_b[2], of_g[2];
    for (int level = 0; level < 2; ++level) {
        const long double r = level ? 1000 : 100, place[3] = {0.36L * r, 0.48L * r, 0.8L * r};
        long double found[NUMBERS], exact[NUMBERS];
        fst_gradient_long_double g;
        fst_dipole_field_long_double(&dipole, place, exact, &g);
        const long double of[] = {g.xx, g.yy, g.xy, g.xz, g.yz};
        memcpy(exact + 3, of, sizeof of);
        flat_ld(1, place, found);
        errors_of(found, exact, &of_b[level], &of_g[level]);
    }
    CHECK_CLOSE(log10(of_b[0] / of_b[1]), 2, 1e-3);
    CHECK_CLOSE(log10(of_g[0] / of_g[1]), 2, 1e-3);
    CHECK_WITHIN(of_b[0], 1e-6, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quadrature),
        cmocka_unit_test(test_rounding),
        cmocka_unit_test(test_axis),
        cmocka_unit_test(test_dipole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
