/* The field of a uniformly magnetised cylinder (model/source/cylinder.inl) in double: it is that in long double
 * but for rounding, at places of all sorts.
 * tests: model/source/cylinder.inl
 * labels: long-double */
#include "cylinder_fields.h"

/* Places of several sorts outside of a cylinder of radius 1. */
static void random_place(uint64_t *seed, int sort, double half, double place[3])
{
    const double angle = uniform(seed, 0, TWO_PI), corner = hypot(1, half);
    double rho = 0, z = 0, r = 0, slope = uniform(seed, 0, TWO_PI);
    switch (sort) {
    case 0: /* above */
        rho = uniform(seed, 0, 6);
        z = half + uniform(seed, 0.05, 6);
        break;
    case 1: /* near the axis */
        rho = pow(10, uniform(seed, -12, 0));
        z = half + uniform(seed, 0.01, 5);
        break;
    case 2: /* over the rim */
        rho = 1 + uniform(seed, -0.5, 0.5) * pow(10, uniform(seed, -12, 0));
        z = half + uniform(seed, 0.02, 3);
        break;
    case 3: /* beside */
        rho = uniform(seed, 1.02, 6);
        z = half * uniform(seed, -1, 1);
        break;
    default: /* all round, from twice the half diagonal to 1000 times */
        r = corner * pow(10, uniform(seed, 0.3, 3));
        rho = r * fabs(sin(slope));
        z = r * cos(slope);
    }
    place[0] = rho * cos(angle);
    place[1] = rho * sin(angle);
    place[2] = z;
}

/* Against long double at random places.  Flat cylinders lose what the fields of their two faces have in common.
 */
static void test_double_rounds_only(void **unused)
{
    (void)unused;
    static const struct bound {
        double half, b, g, t;
    } bounds[] = {{0.1, 5e-14, 1e-13, 2e-13},
                  {0.5, 1e-14, 3e-14, 6e-14},
                  {2, 1e-14, 2e-14, 4e-14},
                  {20, 1e-14, 2e-14, 4e-14}};
    uint64_t seed = 12;
    for (size_t n = 0; n < COUNT(bounds); ++n)
        for (int trial = 0; trial < 10000; ++trial) {
            double place[3];
            random_place(&seed, trial % 5, bounds[n].half, place);
            const cylinder c = {1, bounds[n].half, {trial % 3 != 0, trial % 3 == 2, trial % 3 != 1}};
            const long double exactly[3] = {place[0], place[1], place[2]};
            long double found[FIELD_NUMBERS], exact[FIELD_NUMBERS];
            field_double(&c, place, found);
            field_ld(&c, exactly, exact);
            check_errors(errors_of(found, exact, exactly), bounds[n].b, bounds[n].g, bounds[n].t);
        }
}

/* Exactly on the axis, on the cylinder's continuation, in the planes of its faces, one unit in the last place
 * beside these, and so near the axis that squares underflow. */
static void test_exact_places(void **unused)
{
    (void)unused;
    static const double rhos[] = {0, 1e-320, 1e-160, 1e-20, 0.5, 1 - 1.2e-16, 1, 1 + 2.3e-16, 2};
    static const double heights[] = {0.5, 0.5 + 1.2e-16, 0.6, 1.5, 0, -0.5, -0.6};
    const cylinder c = {1, 0.5, {0.3, -0.5, 0.8}};
    for (size_t i = 0; i < COUNT(rhos); ++i)
        for (size_t k = 0; k < COUNT(heights); ++k) {
            if (rhos[i] < 1.5 && fabs(heights[k]) < 0.55)
                continue;
            const double places[2][3] = {{rhos[i], 0, heights[k]}, {0, -rhos[i], heights[k]}};
            for (int n = 0; n < 2; ++n) {
                const long double exactly[3] = {places[n][0], places[n][1], places[n][2]};
                long double found[FIELD_NUMBERS], exact[FIELD_NUMBERS];
                field_double(&c, places[n], found);
                field_ld(&c, exactly, exact);
                check_errors(errors_of(found, exact, exactly), 5e-15, 1e-14, 3e-14);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_double_rounds_only),
        cmocka_unit_test(test_exact_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
