/* The smallest pieces of `src/base`: zeros in brackets, sums without loss, unwrapped angles, sines of whole
 * degrees, quoted texts, numbers as text.
 * tests: base/elementary.c base/number.c base/text.c base/bracket.h */
#include "numeric.h"

#include <stdint.h>

#include "base/bracket.h"
#include "base/compensated.h"
#include "base/elementary.h"
#include "base/number.h"
#include "base/text.h"
#include "base/winding.h"

/* ------------------------------------------------------------------ brackets */

/* How many function values it takes until the zero of x^9 - 1e-3 in [0, 1] is known to 1e-12; false position
 * alone needs thousands. */
static int looks_to_zero(double start_lo, double start_hi)
{
    fst_bracket b = {start_lo, start_hi, pow(start_lo, 9) - 1e-3, pow(start_hi, 9) - 1e-3, 0};
    const double zero = pow(1e-3, 1.0 / 9.0);
    int looks = 0;
    for (; looks < 10000; ++looks) {
        const double x = fst_bracket_next(&b);
        assert_true((x - b.lo) * (b.hi - x) >= 0.0);
        if (fabs(x - zero) < 1e-12)
            break;
        fst_bracket_take(&b, x, pow(x, 9) - 1e-3);
        assert_true((b.f_lo < 0) != (b.f_hi < 0));
        assert_true((zero - b.lo) * (b.hi - zero) >= -1e-15);
    }
    return looks;
}

/* Both ends of the bracket close in, even if the function is flat on one side. */
static void test_brackets_close_from_both_sides(void **state)
{
    (void)state;
    assert_true(looks_to_zero(0.0, 1.0) < 60);
    assert_true(looks_to_zero(1.0, 0.0) < 60);
}

/* ------------------------------------------------------------------ sums without loss */

/* A tenth added ten million times, and a product whose exact value is known in integers. */
static void test_sums_and_products_lose_nothing(void **state)
{
    (void)state;
    fst_twofold sum = {0.0, 0.0};
    for (int i = 0; i < 1000000; ++i)
        sum = fst_twofold_add(sum, 0.1);
    const fst_twofold exact = fst_twofold_times((fst_twofold){0.1, 0.0}, 1e6);
    assert_true(fabs(fst_twofold_difference(sum, exact)) < 1e-25 * 1e5);
    /* 1 + 2^-80 cannot be told from 1 in one double: its product with 3 must still be 3 + 3 2^-80. */
    const double tiny = ldexp(1.0, -80);
    const fst_twofold three = fst_twofold_times((fst_twofold){1.0, tiny}, 3.0);
    assert_true(three.high == 3.0);
    assert_true(three.low == 3.0 * tiny);
    const fst_twofold square =
        fst_twofold_times((fst_twofold){1.0 + ldexp(1.0, -30), 0.0}, 1.0 + ldexp(1.0, -30));
    assert_true(square.high == 1.0 + ldexp(1.0, -29));
    assert_true(square.low == ldexp(1.0, -60));
}

/* ------------------------------------------------------------------ angles */

static double angle_after(double points[][2], int count)
{
    fst_winding w = {0, points[0][0], points[0][1]};
    for (int i = 1; i < count; ++i)
        fst_winding_advance(&w, points[i][0], points[i][1]);
    return fst_winding_angle(&w);
}

/* Going once round and back ends at the same angle, from every starting point, those on the half-axis included.
 */
static void test_turns_are_counted_from_any_start(void **state)
{
    (void)state;
    enum { CORNERS = 8 };
    const double two_pi = 6.283185307179586476925287;
    for (int start = 0; start < CORNERS; ++start)
        for (int way = -1; way <= 1; way += 2) {
            double points[2 * CORNERS + 1][2];
            for (int i = 0; i <= 2 * CORNERS; ++i) {
                static const double corner[CORNERS][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                                          {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
                const int place = ((start + way * i) % CORNERS + CORNERS) % CORNERS;
                points[i][0] = corner[place][0];
                points[i][1] = corner[place][1];
            }
            const double begun = angle_after(points, 1);
            assert_true(fabs(angle_after(points, CORNERS + 1) - begun - way * two_pi) < 1e-14);
            assert_true(fabs(angle_after(points, 2 * CORNERS + 1) - begun - 2 * way * two_pi) < 2e-14);
            double step = begun;
            for (int i = 2; i <= 2 * CORNERS + 1; ++i) {
                const double next = angle_after(points, i);
                assert_true(fabs(next - step - way * two_pi / CORNERS) < 1e-13);
                step = next;
            }
        }
}

/* A step that passes the origin nearer than a quarter of its length is doubtful, one that stays away is not. */
static void test_close_passages_are_doubtful(void **state)
{
    (void)state;
    const fst_winding w = {0, -1.0, 0.0};
    static const struct {
        double x, y;
        int doubtful;
    } ends[] = {{1.0, 0.2, 1}, {1.0, -0.2, 1}, {0.5, 0.5, 1},  {0.5, -0.5, 1},
                {0.5, 1.2, 0}, {0.5, -1.2, 0}, {-2.0, 0.0, 0}, {-1.0, 1.0, 0}};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; ++i) {
        const double length = hypot(ends[i].x + 1.0, ends[i].y), away = fabs(ends[i].y) / length;
        const int crosses = ends[i].x > 0;
        assert_int_equal(fst_winding_is_doubtful(&w, ends[i].x, ends[i].y) != 0, ends[i].doubtful);
        assert_int_equal(ends[i].doubtful, crosses && away < 0.25 * length);
    }
}

/* ------------------------------------------------------------------ sines of degrees */

static void test_sines_of_degrees(void **state)
{
    (void)state;
    for (int i = -7300; i <= 7300; ++i) {
        const double degrees = 0.1 * i;
        double sine, cosine;
        fst_sin_cos_degrees(degrees, &sine, &cosine);
        const long double turned = fmodl((long double)degrees, 360.0L) * 0.0174532925199432957692369L;
        assert_true(fabsl(sine - sinl(turned)) < 3e-16L);
        assert_true(fabsl(cosine - cosl(turned)) < 3e-16L);
    }
    for (int quarter = -8; quarter <= 8; ++quarter) {
        static const double sines[4] = {0, 1, 0, -1};
        double sine, cosine;
        fst_sin_cos_degrees(90.0 * quarter, &sine, &cosine);
        assert_true(sine == sines[((quarter % 4) + 4) % 4]);
        assert_true(cosine == sines[((quarter % 4) + 5) % 4]);
    }
}

/* ------------------------------------------------------------------ arcs and logarithms */

/* Within two units in the last place of the C library's long double, all round and over many scales. */
static void test_arcs(void **state)
{
    (void)state;
    for (int i = -4000; i <= 4000; ++i) {
        const double angle = i * 7.853e-4;
        for (double size = 1e-100; size < 1e101; size *= 1e40) {
            const double x = size * cos(angle), y = size * sin(angle);
            const long double expected = atan2l((long double)y, (long double)x);
            assert_true(fabsl(fst_atan2(y, x) - expected) <= 4.4e-16L * fabsl(expected));
        }
        const double sine = i / 4000.0;
        const long double expected = asinl((long double)sine);
        assert_true(fabsl(fst_asin(sine) - expected) <= 4.4e-16L * fabsl(expected));
    }
    CHECK_SAME_BITS(fst_atan2(0.0, 1.0), 0.0);
    CHECK_SAME_BITS(fst_atan2(0.0, 0.0), 0.0);
    CHECK_SAME_BITS(fst_atan2(0.0, -1.0), acos(-1.0));
    CHECK_SAME_BITS(fst_atan2(-2.0, 0.0), -0.5 * acos(-1.0));
    CHECK_SAME_BITS(fst_atan2(-0.0, -1.0), -acos(-1.0));
    CHECK_SAME_BITS(fst_asin(1.0), 0.5 * acos(-1.0));
    assert_true(isnan(fst_atan2(NAN, 1.0)) && isnan(fst_atan2(1.0, NAN)));
}

static void test_logarithms(void **state)
{
    (void)state;
    for (double x = 1e-300; x < 1e300; x *= 1.00317) {
        const long double expected = logl((long double)x);
        assert_true(fabsl(fst_log(x) - expected) <= 4.4e-16L * fabsl(expected));
    }
    for (double away = 1e-15; away < 0.5; away *= 1.01) { /* near 1 the logarithm is small, and its error too */
        const double below = 1.0 - away, above = 1.0 + away;
        assert_true(fabsl(fst_log(below) - logl((long double)below)) <=
                    4.4e-16L * fabsl(logl((long double)below)));
        assert_true(fabsl(fst_log(above) - logl((long double)above)) <=
                    4.4e-16L * fabsl(logl((long double)above)));
    }
    CHECK_SAME_BITS(fst_log(1.0), 0.0);
}

/* ------------------------------------------------------------------ texts */

/* A text quoted in a message holds no control character and no half of a character, however long it was. */
static void test_quoted_texts_are_harmless(void **state)
{
    (void)state;
    char quoted[FST_QUOTE_SIZE], text[4 * FST_QUOTE_SIZE];
    assert_string_equal(fst_quote("a\nb\x1b[31m\x7f\tc", quoted), "\"a?b?[31m??c\"");
    for (size_t lead = 0; lead < 4; ++lead) {
        memset(text, 'x', sizeof text);
        for (size_t i = lead; i + 3 < sizeof text; i += 3)
            memcpy(text + i, "\xE2\x84\x93", 3); /* this character has three bytes */
        text[sizeof text - 1] = '\0';
        const char *shown = fst_quote(text, quoted);
        const size_t length = strlen(shown);
        assert_true(length < FST_QUOTE_SIZE);
        assert_string_equal(shown + length - 4, "...\"");
        assert_null(strchr(shown, '?')); /* a halved character would be shown as '?' */
        for (size_t i = 1; i + 4 < length; ++i)
            if (shown[i] == '\xE2')
                assert_memory_equal(shown + i, "\xE2\x84\x93", 3);
    }
}

/* Every double that is written comes back with the same bits. */
static void test_numbers_come_back(void **state)
{
    (void)state;
    uint64_t bits = 0x9e3779b97f4a7c15u;
    for (int i = 0; i < 20000; ++i) {
        double value;
        char text[40];
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value))
            continue;
        const int length = fst_number_write(text, sizeof text, value);
        assert_int_equal(length, strlen(text));
        assert_int_equal(fst_number_length(text), length);
        const double back = fst_number_read(text, (size_t)length, 0);
        assert_memory_equal(&back, &value, sizeof value);
    }
    assert_true(fst_number_read("25", 2, -4) == 0.0025);
    assert_true(fst_number_read("1.5e-3", 6, 3) == 1.5);
    assert_int_equal(fst_number_length("1e-3x"), 4);
    assert_int_equal(fst_number_length("-1.5E+07 m"), 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_brackets_close_from_both_sides),
        cmocka_unit_test(test_sums_and_products_lose_nothing),
        cmocka_unit_test(test_turns_are_counted_from_any_start),
        cmocka_unit_test(test_close_passages_are_doubtful),
        cmocka_unit_test(test_sines_of_degrees),
        cmocka_unit_test(test_arcs),
        cmocka_unit_test(test_logarithms),
        cmocka_unit_test(test_quoted_texts_are_harmless),
        cmocka_unit_test(test_numbers_come_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
