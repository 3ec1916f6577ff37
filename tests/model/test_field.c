/* The magnet's field against Maxwell's equations, superposition and symmetry.
 * tests: model/source/lines.inl model/source/sources.inl */
#include "physics.h"

typedef struct field_at {
    double b[3], g[3][3];
} field_at;

static field_at field_of(const fst_model *model, double x, double y)
{
    field_at f;
    fst_field(model, x, y, f.b, f.g);
    return f;
}

static fst_model *lines_model(int lines)
{
    fst_params p = fst_default_params();
    p.magnet_lines = lines;
    return model_of(&p);
}

/* Values of B and G summed with 40 digits over the ten charges, for eps = 2.5/23, h = 18.7/23, lambda = 40/92.
 */
static void test_reference_values(void **unused)
{
    (void)unused;
    static const struct {
        double x, y, b[3], g[3][3];
    } reference[] = {
        {-0.7,
         1.1,
         {-1.6677122549435399651, -1.2811688318788262966, -1.8814256856197944215},
         {{-2.5618474706361484581, 1.4723842226226316597, 2.3853658171681046132},
          {1.4723842226226316597, -0.1267791071823983248, 2.6302303395203906605},
          {2.3853658171681046132, 2.6302303395203906605, 2.6886265778185467829}}},
        {0.3,
         -0.4,
         {-3.3105608722020941152, -0.25994395559784315749, 1.3231295419154513588},
         {{0.80696030798998994281, -0.84230898228686792523, 4.6299654588493960378},
          {-0.84230898228686792523, 0.64362482484720124709, 0.39477765787989699335},
          {4.6299654588493960378, 0.39477765787989699335, -1.4505851328371911899}}},
    };
    fst_model *model = lines_model(5);
    for (int k = 0; k < 2; ++k) {
        const field_at f = field_of(model, reference[k].x, reference[k].y);
        for (int i = 0; i < 3; ++i) {
            CHECK_CLOSE(f.b[i], reference[k].b[i], 2e-14);
            for (int j = 0; j < 3; ++j)
                CHECK_CLOSE(f.g[i][j], reference[k].g[i][j], 5e-14);
        }
    }
    fst_model_free(model);
}

/* One line: two charges of five times the strength, B = 5 (d+/|d+|^3 - d-/|d-|^3). */
static void test_single_line(void **unused)
{
    (void)unused;
    fst_model *model = lines_model(1);
    const fst_groups g = fst_model_groups(model);
    assert_true(g.lambda == 0.0);
    uint64_t seed = 11;
    for (int trial = 0; trial < 50; ++trial) {
        const double x = uniform(&seed, -2, 2), y = uniform(&seed, -2, 2);
        const double plus = pow((x - 1) * (x - 1) + y * y + g.h * g.h, -1.5);
        const double minus = pow((x + 1) * (x + 1) + y * y + g.h * g.h, -1.5);
        const field_at f = field_of(model, x, y);
        CHECK_CLOSE(f.b[0], 5 * ((x - 1) * plus - (x + 1) * minus), 1e-13);
        CHECK_CLOSE(f.b[1], 5 * y * (plus - minus), 1e-13);
        CHECK_CLOSE(f.b[2], 5 * g.h * (plus - minus), 1e-13);
    }
    fst_model_free(model);
}

/* Superposition: N lines are N single lines of the strength 5/N, lambda apart, for every N from 1 to 99. */
static void test_lines_superpose(void **unused)
{
    (void)unused;
    fst_model *one = lines_model(1);
    uint64_t seed = 12;
    for (int lines = 1; lines <= 99; ++lines) {
        fst_model *model = lines_model(lines);
        const fst_groups g = fst_model_groups(model);
        CHECK_CLOSE(g.lambda * (lines - 1), lines > 1 ? 40.0 / 23.0 : 0.0, 1e-14);
        const double x = uniform(&seed, -1.5, 1.5), y = uniform(&seed, -1.5, 1.5);
        const field_at f = field_of(model, x, y);
        double b[3] = {0, 0, 0}, gradient[3][3] = {{0}};
        for (int line = 0; line < lines; ++line) {
            const field_at part = field_of(one, x, y - (line - 0.5 * (lines - 1)) * g.lambda);
            for (int i = 0; i < 3; ++i) {
                b[i] += part.b[i] / lines;
                for (int j = 0; j < 3; ++j)
                    gradient[i][j] += part.g[i][j] / lines;
            }
        }
        CHECK_CLOSE(greatest_difference(f.b, b, 3), 0.0, 5e-14);
        CHECK_CLOSE(greatest_difference(&f.g[0][0], &gradient[0][0], 9), 0.0, 2e-13);
        fst_model_free(model);
    }
    fst_model_free(one);
}

/* Far away every magnet is a dipole of moment 2 x 5 along X, whatever its number of lines; the rest falls as
 * 1/r^2 of the field. */
static double defect_of_dipole(const fst_model *model, double r, double angle)
{
    const double h = fst_model_groups(model).h;
    const double d[3] = {r * cos(angle), r * sin(angle), h}, d2 = dot(d, d), d3 = d2 * sqrt(d2);
    const field_at f = field_of(model, d[0], d[1]);
    double defect = 0, size = 0;
    for (int i = 0; i < 3; ++i) {
        const double dipole = 10.0 * (3.0 * d[0] * d[i] / d2 - (i == 0)) / d3;
        defect += (f.b[i] - dipole) * (f.b[i] - dipole);
        size += dipole * dipole;
    }
    return sqrt(defect / size);
}

static void test_far_field_is_a_dipole(void **unused)
{
    (void)unused;
    static const int numbers[] = {1, 2, 5, 99};
    for (int k = 0; k < 4; ++k) {
        fst_model *model = lines_model(numbers[k]);
        for (double angle = 0.3; angle < 6.0; angle += 1.1) {
            const double near = defect_of_dipole(model, 50, angle), far = defect_of_dipole(model, 100, angle);
            CHECK_WITHIN(near, 0, 4e-3);
            CHECK_WITHIN(near / far, 3.8, 4.2);
        }
        fst_model_free(model);
    }
}

/* The magnet turned by pi is the magnet with its poles exchanged: B(P x) = -P B(x); the bar's mirrors give
 * B(M x) = M B(x) across Y and the opposite, -M' B, across X. */
static void test_symmetries_of_the_bar(void **unused)
{
    (void)unused;
    uint64_t seed = 13;
    for (int lines = 1; lines <= 6; ++lines) {
        fst_model *model = lines_model(lines);
        for (int trial = 0; trial < 20; ++trial) {
            const double x = uniform(&seed, -2, 2), y = uniform(&seed, -2, 2);
            const field_at f = field_of(model, x, y), turned = field_of(model, -x, -y);
            const field_at across_y = field_of(model, x, -y), across_x = field_of(model, -x, y);
            static const double p[3] = {-1, -1, 1}, my[3] = {1, -1, 1}, mx[3] = {-1, 1, 1};
            for (int i = 0; i < 3; ++i) {
                CHECK_CLOSE(turned.b[i], -p[i] * f.b[i], 2e-14);
                CHECK_CLOSE(across_y.b[i], my[i] * f.b[i], 2e-14);
                CHECK_CLOSE(across_x.b[i], -mx[i] * f.b[i], 2e-14);
                for (int j = 0; j < 3; ++j) {
                    CHECK_CLOSE(turned.g[i][j], -p[i] * p[j] * f.g[i][j], 1e-13);
                    CHECK_CLOSE(across_y.g[i][j], my[i] * my[j] * f.g[i][j], 1e-13);
                    CHECK_CLOSE(across_x.g[i][j], -mx[i] * mx[j] * f.g[i][j], 1e-13);
                }
            }
        }
        fst_model_free(model);
    }
}

/* curl B = 0 and div B = 0: the gradient that fst_field() returns is symmetric and traceless. */
static void test_gradient_symmetric_traceless(void **unused)
{
    (void)unused;
    fst_model *model = lines_model(5);
    uint64_t seed = 14;
    for (int trial = 0; trial < 200; ++trial) {
        const field_at f = field_of(model, uniform(&seed, -3, 3), uniform(&seed, -3, 3));
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                assert_true(f.g[i][j] == f.g[j][i]);
        CHECK_CLOSE(f.g[0][0] + f.g[1][1] + f.g[2][2], 0.0, 1e-14);
    }
    fst_model_free(model);
}

static double strength_at(const fst_model *model, double x, double y)
{
    const field_at f = field_of(model, x, y);
    return sqrt(dot(f.b, f.b));
}

/* The paper fits l so that the maxima of the field on the plate lie 41 mm apart; at the height of the bead's
 * centre its numbers give 40.536 mm and |B| = 4.333739249 (maximised with 40 digits). */
static void test_maxima_of_the_strength(void **unused)
{
    (void)unused;
    fst_model *model = lines_model(5);
    double lo = 0.5, hi = 1.2;
    while (hi - lo > 1e-9) { /* ternary search: a single maximum lies between */
        const double third = (hi - lo) / 3;
        if (strength_at(model, lo + third, 0) < strength_at(model, hi - third, 0))
            lo += third;
        else
            hi -= third;
    }
    const double x = 0.5 * (lo + hi), top = strength_at(model, x, 0);
    CHECK_CLOSE(top, 4.3337392491022654775, 1e-13);
    CHECK_CLOSE(2 * x * 23.0, 40.536028695926862997, 1e-5);
    CHECK_WITHIN(2 * x * 23.0, 40.5, 41.0);
    CHECK_CLOSE(strength_at(model, 0, 0), 3.5881763330877854623, 1e-13);
    for (double angle = 0; angle < TWO_PI; angle += 0.1)
        assert_true(strength_at(model, x + 1e-3 * cos(angle), 1e-3 * sin(angle)) < top);
    for (double u = -3; u <= 3; u += 0.05)
        for (double w = -3; w <= 3; w += 0.05)
            assert_true(strength_at(model, u, w) <= top);
    fst_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference_values),       cmocka_unit_test(test_single_line),
        cmocka_unit_test(test_lines_superpose),        cmocka_unit_test(test_far_field_is_a_dipole),
        cmocka_unit_test(test_symmetries_of_the_bar),  cmocka_unit_test(test_gradient_symmetric_traceless),
        cmocka_unit_test(test_maxima_of_the_strength),
    };
    return cmocka_run_group_tests_name("field", tests, NULL, NULL);
}
