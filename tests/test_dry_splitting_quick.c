/* The closed flow of the contact, on which the splitting method rests: against exact values, against itself,
 * and against an integration in small steps. */
#include "physics.h"

#include "base/real_double.h"
#include "model/model.h"
#include "ode/splitting.inl"

/* The slip at the end, and the time for which it lasted. */
static double flow_of_vectors(const double *push, double c, double h, const double *slip, double *end)
{
    fst_slide_result_double result;
    fst_contact_flow_double(push, c, h, slip, &result);
    memcpy(end, result.end, sizeof result.end);
    CHECK_CLOSE(hypot(end[0], end[1]), result.speed[1], 1e-15 * (result.speed[0] + result.speed[1]));
    return result.share * h;
}

static double flow(double a, double angle, double c, double h, double s0, double end[2])
{
    const double push[2] = {a, 0.0}, slip[2] = {s0 * cos(angle), s0 * sin(angle)};
    return flow_of_vectors(push, c, h, slip, end);
}

/* V' = A - c V/|V| by the classical method of order 4 in the time sigma, dt = |V| dsigma. */
static void integrate(double a, double angle, double c, double h, double s0, double end[2])
{
    enum { STEPS = 20000 };
    double v[3] = {s0 * cos(angle), s0 * sin(angle), 0.0}, step = h / s0 / STEPS;
    for (;;) {
        double k[4][3];
        const double before[3] = {v[0], v[1], v[2]};
        for (int i = 0; i < 4; ++i) {
            double w[3];
            const double x = i == 0 ? 0.0 : i == 3 ? 1.0 : 0.5;
            for (int j = 0; j < 3; ++j)
                w[j] = v[j] + (i ? x * step * k[i - 1][j] : 0.0);
            const double s = hypot(w[0], w[1]);
            k[i][0] = s * a - c * w[0];
            k[i][1] = -c * w[1];
            k[i][2] = s;
        }
        for (int j = 0; j < 3; ++j)
            v[j] += step / 6 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
        if (fabs(v[2] - h) < 1e-14 * h)
            break;
        if (v[2] > h) { /* once more, with the step that lands */
            const double rest = h - before[2], made = v[2] - before[2];
            step *= rest / made;
            memcpy(v, before, sizeof v);
        }
    }
    end[0] = v[0];
    end[1] = v[1];
}

static void test_agrees_with_integration(void **unused)
{
    (void)unused;
    uint64_t seed = 7;
    for (int i = 0; i < 60; ++i) {
        const double c = uniform(&seed, 0.0, 1.0), a = uniform(&seed, 0.0, 1.5), s0 = 1.0;
        const double angle = uniform(&seed, -3.1, 3.1);
        double h = uniform(&seed, 0.001, 2.0), closed[2], stepped[2];
        if (c > a) { /* before it ends */
            const double ends = 0.5 * ((1 + cos(angle)) / (c - a) + (1 - cos(angle)) / (c + a));
            h = fmin(h, 0.8 * ends);
        }
        assert_true(flow(a, angle, c, h, s0, closed) == h);
        integrate(a, angle, c, h, s0, stepped);
        CHECK_CLOSE(closed[0] - stepped[0], 0, 2e-13);
        CHECK_CLOSE(closed[1] - stepped[1], 0, 2e-13);
    }
}

/* c s + A.V falls at the rate c^2 - A^2, and s sin(d) tan(d/2)^(-c/|A|) is kept. */
static void test_invariants(void **unused)
{
    (void)unused;
    uint64_t seed = 11;
    for (int i = 0; i < 20000; ++i) {
        const double c = uniform(&seed, 0.01, 1.0), s0 = pow(10.0, uniform(&seed, -6.0, 1.0));
        const double near[] = {1.0, 1e-3, 1e-8, 1e-12, 0.0};
        const double a = c * (1.0 + near[i % 5] * uniform(&seed, -0.9, 2.0));
        const double d = uniform(&seed, 0.01, 3.1), h = pow(10.0, uniform(&seed, -4.0, 1.0));
        double v[2];
        const double moving = flow(a, d, c, h, s0, v);
        if (moving < h) {
            assert_true(v[0] == 0.0 && v[1] == 0.0);
            continue;
        }
        const double s = hypot(v[0], v[1]), size = c * (s0 + s) + (c * c + a * a) * h;
        CHECK_CLOSE((c * s + a * v[0]) - (c * s0 + a * s0 * cos(d)) + (c * c - a * a) * h, 0, 4e-15 * size);
        /* The second one by logarithms; where the slip is nearly over its direction has few digits. */
        if (s < 1e-3 * s0 || fabs(v[1]) < 1e-3 * s)
            continue;
        const double before = log(s0 * sin(d)) - c / a * log(tan(d / 2));
        const double after = log(v[1]) - c / a * log(v[1] / (s + v[0]));
        CHECK_CLOSE(after - before, 0, 2e-11);
    }
}

/* The slip ends after t* = (c s0 + A.V0)/(c^2 - A^2), with the impulse of friction (2/7) (A t* + V0). */
static void test_capture(void **unused)
{
    (void)unused;
    uint64_t seed = 5;
    for (int i = 0; i < 2000; ++i) {
        const double c = uniform(&seed, 0.1, 1.0), a = c * (1.0 - pow(10.0, uniform(&seed, -6.0, 0.0)));
        const double d = uniform(&seed, 0.0, (TWO_PI / 2)), s0 = uniform(&seed, 1e-3, 1.0);
        const double ends = (c * s0 + a * s0 * cos(d)) / ((c - a) * (c + a));
        double v[2];
        CHECK_CLOSE(flow(a, d, c, ends * (1 + 1e-9), s0, v) / ends, 1.0, 2e-15 * c / (c - a));
        assert_true(v[0] == 0.0 && v[1] == 0.0);
        assert_true(flow(a, d, c, ends * (1 - 1e-9), s0, v) == ends * (1 - 1e-9));
        assert_true(hypot(v[0], v[1]) < 2 * (c + a) * 1e-9 * ends);
        assert_true(hypot(v[0], v[1]) > 0.0);
    }
}

/* A slip exactly against A: it ends after s0/(c + a) and stays, or goes on along A. */
static void test_against_the_push(void **unused)
{
    (void)unused;
    const double push[] = {0.2, 0.5, 0.5 + 1e-9, 0.8};
    for (int i = 0; i < 4; ++i) {
        const double a = push[i], c = 0.5, s0 = 0.03, turns = s0 / (c + a), p[2] = {a, 0.0},
                     slip[2] = {-s0, 0.0};
        double v[2];
        for (int k = 1; k < 30; ++k) {
            const double h = 0.1 * k * turns;
            (void)flow_of_vectors(p, c, h, slip, v);
            CHECK_CLOSE(v[0], h < turns ? -s0 + (c + a) * h : fmax(0.0, (a - c) * (h - turns)), 1e-16);
            assert_true(v[1] == 0.0);
        }
    }
}

/* From rest: it stays while a <= c, else it slips on along A with a - c. */
static void test_from_rest(void **unused)
{
    (void)unused;
    const double slip[2] = {0.0, 0.0}, push[2] = {0.3, 0.4}, c[] = {0.7, 0.5, 0.5 - 1e-10, 0.3, 0.0};
    for (int i = 0; i < 5; ++i) {
        double v[2], moving;
        moving = flow_of_vectors(push, c[i], 0.05, slip, v);
        const double s = fmax(0.0, 0.5 - c[i]) * 0.05;
        CHECK_CLOSE(v[0], 0.6 * s, 3e-17);
        CHECK_CLOSE(v[1], 0.8 * s, 3e-17);
        assert_true(c[i] > 0.5 ? moving < 1e-30 : c[i] == 0.5 || moving == 0.05);
    }
}

/* Without a push the slip keeps its direction and loses c h; without friction it gains A h. */
static void test_plain_cases(void **unused)
{
    (void)unused;
    const double none[2] = {0.0, 0.0}, push[2] = {0.3, -0.2}, slip[2] = {0.06, 0.08};
    double v[2], moving;
    moving = flow_of_vectors(none, 0.5, 0.1, slip, v);
    CHECK_CLOSE(v[0], 0.03, 5e-17);
    CHECK_CLOSE(v[1], 0.04, 5e-17);
    moving = flow_of_vectors(none, 0.5, 0.3, slip, v);
    assert_true(v[0] == 0.0 && v[1] == 0.0);
    CHECK_CLOSE(moving, 0.2, 1e-16);
    moving = flow_of_vectors(push, 0.0, 0.3, slip, v);
    CHECK_CLOSE(v[0], 0.06 + 0.09, 1e-16);
    CHECK_CLOSE(v[1], 0.08 - 0.06, 1e-16);
}

/* Two steps make one of both lengths: every start is on the way of another. */
static void test_steps_add_up(void **unused)
{
    (void)unused;
    uint64_t seed = 3;
    for (int i = 0; i < 20000; ++i) {
        const double c = uniform(&seed, 0.0, 1.0), a = c * pow(10.0, uniform(&seed, -2.0, 1.0));
        const double d = (TWO_PI / 2) - pow(10.0, uniform(&seed, -9.0, 0.4)),
                     s0 = pow(10.0, uniform(&seed, -5.0, 0.0));
        const double h1 = pow(10.0, uniform(&seed, -4.0, 0.5)), h2 = pow(10.0, uniform(&seed, -4.0, 0.5));
        const double push[2] = {a, 0.0};
        double once[2], first[2], second[2];
        flow(a, d, c, h1 + h2, s0, once);
        flow(a, d, c, h1, s0, first);
        (void)flow_of_vectors(push, c, h2, first, second);
        const double size = s0 + (c + a) * (h1 + h2);
        CHECK_CLOSE(second[0] - once[0], 0, 1e-14 * size);
        CHECK_CLOSE(second[1] - once[1], 0, 1e-14 * size);
    }
}

/* The turn of n about W against sine and cosine of the C library. */
static void test_turns(void **unused)
{
    (void)unused;
    uint64_t seed = 9;
    for (int i = 0; i < 1000; ++i) {
        double axis[3], n[3], turned[3];
        random_unit(&seed, axis);
        random_unit(&seed, n);
        const double rate = uniform(&seed, 0.0, 10.0), h = 0.1;
        const double w[3] = {rate * axis[0], rate * axis[1], rate * axis[2]};
        turn_about(axis, rate * h, n, turned);
        fst_turn_about_double(w, h, n);
        CHECK_CLOSE(greatest_difference(n, turned, 3), 0, 1e-15);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_agrees_with_integration),
        cmocka_unit_test(test_invariants),
        cmocka_unit_test(test_capture),
        cmocka_unit_test(test_against_the_push),
        cmocka_unit_test(test_from_rest),
        cmocka_unit_test(test_plain_cases),
        cmocka_unit_test(test_steps_add_up),
        cmocka_unit_test(test_turns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
