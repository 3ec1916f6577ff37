/* Cubic coefficients of normal forms, against textbook systems whose coefficients are known in closed form, and
 * against iterates of a map.
 * tests: orbit/normal_form.c orbit/lapack.c orbit/lapack_module.c
 * labels: memcheck */
#include "numeric.h"

#include <complex.h>

#include <festoon/festoon.h>

#include "orbit/normal_form.h"

static const fst_lapack *lapack(void)
{
    const fst_lapack *table;
    fst_error error;
    if (fst_lapack_load(&table, &error) != FST_OK)
        skip();
    return table;
}

/* ------------------------------------------------------------------ a Hopf point in three dimensions */

/* In coordinates u: a planar field with all quadratic and cubic terms that count,
 *     u1' = -w u2 + f(u1, u2) + d u1 u3,  u2' = w u1 + g(u1, u2) + d u2 u3,  u3' = -l u3 + c (u1^2 + u2^2),
 * seen in coordinates x = T u, none of which are at right angles. */
typedef struct hopf_case {
    double w, l, c, d;
    double f[7], g[7]; /* coefficients of x^2, x y, y^2, x^3, x^2 y, x y^2, y^3 */
} hopf_case;

static const double T[3][3] = {{1.0, 0.3, -0.2}, {-0.4, 0.8, 0.5}, {0.25, -0.6, 1.3}};

/* Cramer's rule. */
static void solve3(const double m[3][3], const double *b, double *x)
{
    double det[4];
    for (int k = 0; k < 4; ++k) { /* k = 0: the determinant of m itself; else with column k - 1 replaced */
        double a[3][3];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                a[i][j] = j == k - 1 ? b[i] : m[i][j];
        det[k] = a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
                 a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
                 a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
    }
    for (int i = 0; i < 3; ++i)
        x[i] = det[i + 1] / det[0];
}

static double polynomial(const double p[7], double x, double y)
{
    return p[0] * x * x + p[1] * x * y + p[2] * y * y + p[3] * x * x * x + p[4] * x * x * y + p[5] * x * y * y +
           p[6] * y * y * y;
}

static fst_status hopf_field(void *user, const double *x, double *out, fst_error *error)
{
    const hopf_case *h = user;
    double u[3], rate[3];
    (void)error;
    solve3(T, x, u);
    rate[0] = -h->w * u[1] + polynomial(h->f, u[0], u[1]) + h->d * u[0] * u[2];
    rate[1] = h->w * u[0] + polynomial(h->g, u[0], u[1]) + h->d * u[1] * u[2];
    rate[2] = -h->l * u[2] + h->c * (u[0] * u[0] + u[1] * u[1]);
    for (int i = 0; i < 3; ++i)
        out[i] = T[i][0] * rate[0] + T[i][1] * rate[1] + T[i][2] * rate[2];
    return FST_OK;
}

/* r' = a r^3 in u: Guckenheimer and Holmes, Nonlinear Oscillations, Eq. (3.4.11), and on the centre manifold
 * u3 = c r^2/l + ... the coupling adds d c/l. */
static double planar_coefficient(const hopf_case *h)
{
    const double *f = h->f, *g = h->g;
    const double fxx = 2 * f[0], fxy = f[1], fyy = 2 * f[2], gxx = 2 * g[0], gxy = g[1], gyy = 2 * g[2];
    const double cubic = 6 * f[3] + 2 * f[5] + 2 * g[4] + 6 * g[6];
    return cubic / 16.0 + (fxy * (fxx + fyy) - gxy * (gxx + gyy) - fxx * gxx + fyy * gyy) / (16.0 * h->w) +
           h->d * h->c / h->l;
}

static void hopf_points(void **state)
{
    (void)state;
    static const hopf_case cases[] = {
        {1.0, 1.0, 0.0, 0.0, {0, 0, 0, -1, 0, -1, 0}, {0, 0, 0, 0, -1, 0, -1}},
        {2.5, 0.7, 0.0, 0.0, {0.4, -0.3, 0.8, 0.2, 0, 0, 0}, {-0.5, 0.9, 0.1, 0, 0, 0, 0.3}},
        {0.6, 2.0, 0.9, -1.1, {0, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0}},
        {1.7, 0.4, -0.6, -0.8, {-0.7, 0.2, 0.3, 0.5, 1, -0.4, 2}, {0.6, -0.1, 0.5, 1, 0.3, 3, -0.2}},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        hopf_case h = cases[k];
        const fst_local_map map = {.size = 3, .reach = 2e-3, .user = &h, .at = hopf_field};
        double matrix[9], coefficient, spread;
        /* T A T^-1, column by column */
        for (int j = 0; j < 3; ++j) {
            const double unit[3] = {j == 0, j == 1, j == 2};
            double u[3];
            solve3(T, unit, u);
            const double rate[3] = {-h.w * u[1], h.w * u[0], -h.l * u[2]};
            for (int i = 0; i < 3; ++i)
                matrix[i * 3 + j] = T[i][0] * rate[0] + T[i][1] * rate[1] + T[i][2] * rate[2];
        }
        assert_int_equal(fst_cubic_coefficient(lapack(), &map, matrix, h.w, &coefficient, &spread, NULL),
                         FST_OK);
        /* x = z q + conj with |q| = 1, while u1 + i u2 = r e^(i phi) is z = r |T (1, -i, 0)|/2 */
        double size2 = 0.0;
        for (int i = 0; i < 3; ++i)
            size2 += 0.25 * (T[i][0] * T[i][0] + T[i][1] * T[i][1]);
        const double expected = planar_coefficient(&h) / (size2 * h.w);
        CHECK_CLOSE(coefficient, expected, 1e-6 * (1.0 + fabs(expected)));
        assert_true(spread < 1e-5 * (1.0 + fabs(expected)));
    }
}

/* ------------------------------------------------------------------ a Neimark-Sacker point */

/* u -> m u - v + p u^2 + s u v + t v^3, v -> u, whose multipliers at the origin are e^(+-i theta) with m = 2
 * cos theta (Henon's map with more terms). */
typedef struct map_case {
    double theta, p, s, t;
} map_case;

static fst_status planar_map(void *user, const double *x, double *out, fst_error *error)
{
    const map_case *c = user;
    (void)error;
    const double u = x[0], v = x[1];
    out[0] = 2.0 * cos(c->theta) * u - v + c->p * u * u + c->s * u * v + c->t * v * v * v;
    out[1] = u;
    return FST_OK;
}

/* |z| changes by a |z|^3 in an iteration, so 1/|z|^2 falls by 2 a. Here z = <p, x> plus quadratic terms, which
 * a mean over many iterations removes; two amplitudes are extrapolated to zero. */
static double measured(const map_case *c, double amplitude)
{
    enum { ITERATES = 40000, MEAN = 4000 };
    map_case copy = *c;
    const double complex lambda = cos(c->theta) + I * sin(c->theta);
    double x[2] = {amplitude * sqrt(2.0), amplitude * sqrt(2.0) * cos(c->theta)}, next[2], first = 0, last = 0;
    for (int n = 0; n < ITERATES; ++n) {
        /* q = (lambda, 1)/sqrt 2; left vector (1, -conj lambda), over its product with q */
        const double complex z = (x[0] - conj(lambda) * x[1]) / ((lambda - conj(lambda)) / sqrt(2.0));
        const double size2 = creal(z * conj(z));
        first += n < MEAN ? 1.0 / size2 / MEAN : 0.0;
        last += n >= ITERATES - MEAN ? 1.0 / size2 / MEAN : 0.0;
        (void)planar_map(&copy, x, next, NULL);
        memcpy(x, next, sizeof x);
    }
    return -(last - first) / (2.0 * (ITERATES - MEAN));
}

static void neimark_sacker_points(void **state)
{
    (void)state;
    static const map_case cases[] = {
        {1.0, 0.5, -0.8, 0.0}, {1.3, -0.2, 0.4, 0.3}, {0.7, 0.3, 0.3, -0.5}, {2.3, 0.6, 0.1, 0.2}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        map_case c = cases[k];
        const double matrix[4] = {2.0 * cos(c.theta), -1.0, 1.0, 0.0};
        const fst_local_map map = {.size = 2, .is_map = 1, .reach = 2e-3, .user = &c, .at = planar_map};
        double coefficient, spread;
        assert_int_equal(fst_cubic_coefficient(lapack(), &map, matrix, c.theta, &coefficient, &spread, NULL),
                         FST_OK);
        const double wide = measured(&c, 0.002), narrow = measured(&c, 0.001);
        CHECK_CLOSE(coefficient, (4.0 * narrow - wide) / 3.0, 1e-3 * fabs(coefficient));
        assert_true(spread < 1e-5);
    }
}

/* At a strong resonance the normal form is another one, and the function gives no answer. */
static void resonances_are_refused(void **state)
{
    (void)state;
    map_case c = {1.5707963267948966, 0.5, 0.2, 0.1};
    const double matrix[4] = {0.0, -1.0, 1.0, 0.0};
    const fst_local_map map = {.size = 2, .is_map = 1, .reach = 2e-3, .user = &c, .at = planar_map};
    double coefficient, spread;
    fst_error error;
    assert_int_equal(fst_cubic_coefficient(lapack(), &map, matrix, c.theta, &coefficient, &spread, &error),
                     FST_NO_CONVERGENCE);
    CHECK_CONTAINS(error.sentence, "1:4");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hopf_points),
        cmocka_unit_test(neimark_sacker_points),
        cmocka_unit_test(resonances_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
