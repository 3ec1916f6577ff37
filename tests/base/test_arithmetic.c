/* The two pieces of arithmetic that long runs rest on: sums and products to twice the precision of a double,
 * and unwrapped angles.
 * tests: base/twofold.inl base/compensated.h base/winding.h
 * labels: memcheck */
#include "numeric.h"

#include "base/compensated.h"
#include "base/winding.h"

/* The factors are powers of two and sums of them, so every part of a product is known exactly. */
static void products_keep_what_a_double_loses(void **state)
{
    (void)state;
    const double u = 0x1p-52;
    /* (1 + u)^2 = 1 + 2u + u^2: the square of u is lost in a double. */
    fst_twofold p = fst_twofold_times((fst_twofold){1.0 + u, 0.0}, 1.0 + u);
    CHECK_SAME_BITS(p.high, 1.0 + 2.0 * u);
    CHECK_SAME_BITS(p.low, u * u);
    /* The low part of a factor counts too: (1 + u/8) 3 = 3 + 3u/8. */
    p = fst_twofold_times((fst_twofold){1.0, 0.125 * u}, 3.0);
    CHECK_SAME_BITS(p.high, 3.0);
    CHECK_SAME_BITS(p.low, 0.375 * u);
    /* Small parts in both factors, with signs: (1 + u - u/16) (-(1 + u)) = -(1 + 2u - u/16 + u^2 - u^2/16). */
    p = fst_twofold_times((fst_twofold){1.0 + u, -0.0625 * u}, -(1.0 + u));
    CHECK_SAME_BITS(p.high, -(1.0 + 2.0 * u));
    CHECK_SAME_BITS(p.low, 0.0625 * u - 0.9375 * (u * u));
}

/* 10^6 additions and the product agree to twice the precision. */
static void sums_and_products_agree(void **state)
{
    (void)state;
    const double step = 0.1234567890123456789;
    fst_twofold sum = {0.0, 0.0};
    for (int i = 0; i < 1000000; ++i)
        sum = fst_twofold_add(sum, step);
    const fst_twofold product = fst_twofold_times((fst_twofold){step, 0.0}, 1e6);
    CHECK_CLOSE(fst_twofold_difference(sum, product), 0.0, 1e-22);
    double plain = 0.0;
    for (int i = 0; i < 1000000; ++i)
        plain += step;
    assert_true(fabs(plain - product.high) > 1e-10); /* a plain sum is off by more */
}

/* Start at this point and go round by `turns` turns in small steps: the angle must grow by as many turns. */
static void check_turns(double x, double y, int turns)
{
    const double two_pi = 6.283185307179586476925287;
    const int steps = 40 * (turns < 0 ? -turns : turns);
    fst_winding w = {0, x, y};
    const double begin = fst_winding_angle(&w), r = hypot(x, y);
    double before = begin;
    for (int i = 1; i <= steps; ++i) {
        const double angle = begin + two_pi * turns * i / steps;
        fst_winding_advance(&w, r * cos(angle), r * sin(angle));
        const double now = fst_winding_angle(&w);
        CHECK_CLOSE(now - before, two_pi * turns / steps, 1e-9); /* the angle never jumps */
        before = now;
    }
    CHECK_CLOSE(before - begin, two_pi * turns, 1e-9);
}

/* The same from exactly Phi = 180 degrees, on either side of the half-axis on which turns are counted, and back
 * and forth over it. */
static void angles_do_not_jump(void **state)
{
    (void)state;
    static const double starts[][2] = {{-1.0, 0.0}, {-1.0, -0.0}, {-0.3, 1e-300}, {-0.3, -1e-300},
                                       {1.0, 0.0},  {1.0, -0.0},  {0.0, 1.0},     {0.0, -1.0}};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; ++i)
        for (int turns = -3; turns <= 3; ++turns)
            if (turns != 0)
                check_turns(starts[i][0], starts[i][1], turns);
    for (int zero = 0; zero < 2; ++zero)
        for (int side = -1; side <= 1; side += 2) {
            fst_winding w = {0, -1.0, zero ? -0.0 : 0.0};
            const double begin = fst_winding_angle(&w);
            fst_winding_advance(&w, -1.0, 1e-3 * side);
            CHECK_CLOSE(fst_winding_angle(&w) - begin, -1e-3 * side, 1e-6);
            fst_winding_advance(&w, -1.0, zero ? 0.0 : -0.0); /* back onto the half-axis, and over it */
            CHECK_CLOSE(fst_winding_angle(&w) - begin, 0.0, 1e-12);
            fst_winding_advance(&w, -1.0, -1e-3 * side);
            CHECK_CLOSE(fst_winding_angle(&w) - begin, 1e-3 * side, 1e-6);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_keep_what_a_double_loses),
        cmocka_unit_test(sums_and_products_agree),
        cmocka_unit_test(angles_do_not_jump),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
