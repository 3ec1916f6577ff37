/* normal_form.c - the cubic coefficient of the normal form where a pair crosses the border of stability.
 *
 * Near a Hopf point (or, for the return map, a Neimark-Sacker point) the motion on the surface of the critical
 * pair is, in suitable coordinates, z' = (mu + i w) z + c z |z|^2.  The sign of Re c says what is born there:
 *
 *       Re c < 0: supercritical      Re c > 0: subcritical
 *              .----                  - - -.                 curved: |z| of the small orbit
 *             /                             \                straight: the equilibrium
 *       -----+- - - -                  -----+- - - -         full lines attract, broken ones do not
 *          mu = 0                         mu = 0
 *
 * c follows from the second and third derivatives B and C of the equations at the equilibrium, and the
 * eigenvectors q and p of the pair (Kuznetsov, Eqs. (5.39) and (5.65)):
 *
 *     2 c = <p, C(q, q, conj q) + 2 B(q, h11) + B(conj q, h20)>,
 *
 * where h11 and h20, from linear systems, are the response of all other directions to the pair.  At the
 * resonances 1:1 to 1:4 of a map the normal form is another one, and no coefficient is given.  Returned are Re
 * c/w, and for a map Re(e^-it c) with the angle t of the critical multiplier.
 *
 * Second and third derivatives are needed along the critical plane only, and come from differences along lines
 * (polarisation): of order 6 for B(u,u), of order 4 for C(u,u,u), taken with two lengths.
 */
#include "orbit/normal_form.h"

#include <string.h>

#include "base/dot.h"
#include "base/error.h"

enum { MOST = FST_NORMAL_FORM_MOST };

/* The critical pair, and the derivatives along lines. */
typedef struct forms {
    const fst_lapack *lapack;
    const fst_local_map *map;
    const double *matrix;
    double reach;
    double re, im;                       /* the eigenvalue, put on the border */
    double a[MOST], b[MOST];             /* q = a + i b, |q| = 1 */
    double left_re[MOST], left_im[MOST]; /* p, with <p, q> = conj(p).q = 1 */
    fst_status status;
    fst_error *error;
} forms;

/* Values at k h v, k = -3 ... 3 (the middle one is left out: it cancels or is zero). */
static void along_line(forms *f, const double *v, double h, double value[7][MOST])
{
    for (int k = -3; k <= 3; ++k) {
        double x[MOST];
        for (int i = 0; i < f->map->size; ++i)
            x[i] = k * h * v[i];
        if (f->status == FST_OK)
            f->status = f->map->at(f->map->user, x, value[k + 3], f->error);
    }
}

/* B(v, v) = d^2 f / dt^2 and C(v, v, v) = d^3 f / dt^3 along t v. */
static void line_derivatives(forms *f, const double *v, double second[MOST], double third[MOST])
{
    const int n = f->map->size;
    const double length = sqrt(fst_dot(v, v, n)), h = length > 0 ? f->reach / length : 0.0;
    double y[7][MOST] = {{0}};
    memset(second, 0, MOST * sizeof *second);
    memset(third, 0, MOST * sizeof *third);
    if (!(h > 0))
        return;
    along_line(f, v, h, y);
    for (int i = 0; i < n && f->status == FST_OK; ++i) {
        second[i] = (2.0 * (y[0][i] + y[6][i]) - 27.0 * (y[1][i] + y[5][i]) + 270.0 * (y[2][i] + y[4][i]) -
                     490.0 * y[3][i]) /
                    (180.0 * h * h);
        third[i] =
            ((y[0][i] - y[6][i]) - 8.0 * (y[1][i] - y[5][i]) + 13.0 * (y[2][i] - y[4][i])) / (8.0 * h * h * h);
    }
}

/* B(u, v) by polarisation. */
static void bilinear(forms *f, const double *u, const double *v, double out[MOST])
{
    double sum[MOST], difference[MOST], plus[MOST], minus[MOST], ignored[MOST];
    const int n = f->map->size;
    const double lu = sqrt(fst_dot(u, u, n)), lv = sqrt(fst_dot(v, v, n));
    memset(out, 0, MOST * sizeof *out);
    if (!(lu > 0 && lv > 0))
        return;
    for (int i = 0; i < n; ++i) { /* of equal lengths, lest one drowns in the other */
        sum[i] = u[i] / lu + v[i] / lv;
        difference[i] = u[i] / lu - v[i] / lv;
    }
    line_derivatives(f, sum, plus, ignored);
    line_derivatives(f, difference, minus, ignored);
    for (int i = 0; i < n; ++i)
        out[i] = 0.25 * lu * lv * (plus[i] - minus[i]);
}

/* (re + i im) x - M x = r, complex; r is overwritten by x. */
static int resolve(const forms *f, double re, double im, double *r_re, double *r_im)
{
    enum { TWICE = 2 * MOST };
    const int n = f->map->size;
    double a[TWICE * TWICE], b[TWICE];
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double real = (i == j ? re : 0.0) - f->matrix[i * n + j], imaginary = i == j ? im : 0.0;
            a[i * 2 * n + j] = a[(n + i) * 2 * n + n + j] = real;
            a[i * 2 * n + n + j] = -imaginary;
            a[(n + i) * 2 * n + j] = imaginary;
        }
        b[i] = r_re[i];
        b[n + i] = r_im[i];
    }
    if (f->lapack->solve(2 * n, 1, a, b) != 0)
        return 0;
    memcpy(r_re, b, (size_t)n * sizeof *b);
    memcpy(r_im, b + n, (size_t)n * sizeof *b);
    return 1;
}

/* The right or (of the transposed matrix) left eigenvector of the pair nearest to (re, im). */
static int eigenvector(const forms *f, int transposed, double frequency, double *re, double *im, double *value)
{
    const int n = f->map->size;
    double a[MOST * MOST], wr[MOST], wi[MOST], vectors[MOST * MOST], least = INFINITY;
    int best = -1;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            a[i * n + j] = transposed ? f->matrix[j * n + i] : f->matrix[i * n + j];
    if (f->lapack->eigen(n, a, wr, wi, vectors) != 0)
        return 0;
    for (int i = 0; i < n; ++i) {
        const double angle = f->map->is_map ? atan2(wi[i], wr[i]) : wi[i];
        const double off = f->map->is_map ? fabs(hypot(wr[i], wi[i]) - 1.0) : fabs(wr[i]);
        if (wi[i] > 0 && fabs(angle - frequency) + off < least)
            best = i, least = fabs(angle - frequency) + off;
    }
    if (best < 0)
        return 0;
    for (int i = 0; i < n; ++i) {
        re[i] = vectors[i * n + best];
        im[i] = vectors[i * n + best + 1];
    }
    value[0] = wr[best];
    value[1] = wi[best];
    return 1;
}

static int find_pair(forms *f, double frequency)
{
    const int n = f->map->size;
    double value[2], other[2], p_re[MOST], p_im[MOST], along_re = 0.0, along_im = 0.0;
    if (!eigenvector(f, 0, frequency, f->a, f->b, value) || !eigenvector(f, 1, frequency, p_re, p_im, other))
        return 0;
    const double size = hypot(sqrt(fst_dot(f->a, f->a, n)), sqrt(fst_dot(f->b, f->b, n))),
                 modulus = hypot(value[0], value[1]);
    for (int i = 0; i < n; ++i)
        f->a[i] /= size, f->b[i] /= size;
    f->re = f->map->is_map ? value[0] / modulus : 0.0;
    f->im = f->map->is_map ? value[1] / modulus : value[1];
    /* A^T x = lambda x: p = conj(x) up to a factor, and <p, q> = x.q */
    for (int i = 0; i < n; ++i) {
        along_re += p_re[i] * f->a[i] - p_im[i] * f->b[i];
        along_im += p_re[i] * f->b[i] + p_im[i] * f->a[i];
    }
    const double along2 = along_re * along_re + along_im * along_im;
    if (!(along2 > 0))
        return 0;
    for (int i = 0; i < n; ++i) { /* conj(p) = x / (x.q) */
        f->left_re[i] = (p_re[i] * along_re + p_im[i] * along_im) / along2;
        f->left_im[i] = (p_im[i] * along_re - p_re[i] * along_im) / along2;
    }
    return 1;
}

/* sum += factor <p, v> */
static void project(const forms *f, double factor, const double *re, const double *im, double sum[2])
{
    for (int i = 0; i < f->map->size; ++i) {
        sum[0] += factor * (f->left_re[i] * re[i] - f->left_im[i] * im[i]);
        sum[1] += factor * (f->left_re[i] * im[i] + f->left_im[i] * re[i]);
    }
}

/* <p, C(q, q, conj q)> + 2 <p, B(q, h11)> + <p, B(conj q, h20)>, the quadratic terms' response h11 and h20 by
 * linear systems. */
static int cubic_sum(forms *f, double sum[2])
{
    const int n = f->map->size;
    double aa[MOST], bb[MOST], ab[MOST], aaa[MOST], bbb[MOST], plus[MOST], minus[MOST], ignored[MOST];
    double u[MOST], v[MOST], re[MOST], im[MOST], h20_re[MOST], h20_im[MOST], h11[MOST], none[MOST] = {0};
    line_derivatives(f, f->a, aa, aaa);
    line_derivatives(f, f->b, bb, bbb);
    bilinear(f, f->a, f->b, ab);
    for (int i = 0; i < n; ++i) {
        u[i] = f->a[i] + f->b[i];
        v[i] = f->a[i] - f->b[i];
    }
    line_derivatives(f, u, ignored, plus);
    line_derivatives(f, v, ignored, minus);
    for (int i = 0; i < n; ++i) {
        /* C(a,b,b) = (C(u) + C(v) - 2 C(a))/6, C(a,a,b) = (C(u) - C(v) - 2 C(b))/6 */
        re[i] = aaa[i] + (plus[i] + minus[i] - 2.0 * aaa[i]) / 6.0;
        im[i] = bbb[i] + (plus[i] - minus[i] - 2.0 * bbb[i]) / 6.0;
        h11[i] = aa[i] + bb[i];
        h20_re[i] = aa[i] - bb[i];
        h20_im[i] = 2.0 * ab[i];
    }
    project(f, 1.0, re, im, sum);
    /* A field: h11 = -A^-1 B(q, conj q), h20 = (2 i w - A)^-1 B(q, q); a map: (1 - A)^-1 and (e^2it - A)^-1. */
    const double twice_re = f->map->is_map ? f->re * f->re - f->im * f->im : 0.0;
    const double twice_im = f->map->is_map ? 2.0 * f->re * f->im : 2.0 * f->im;
    if (!resolve(f, f->map->is_map ? 1.0 : 0.0, 0.0, h11, none) ||
        !resolve(f, twice_re, twice_im, h20_re, h20_im))
        return 0;
    bilinear(f, f->a, h11, re);
    bilinear(f, f->b, h11, im);
    project(f, 2.0, re, im, sum);
    /* B(a - ib, x + iy) = B(a,x) + B(b,y) + i (B(a,y) - B(b,x)) */
    bilinear(f, f->a, h20_re, aa);
    bilinear(f, f->b, h20_im, bb);
    bilinear(f, f->a, h20_im, plus);
    bilinear(f, f->b, h20_re, minus);
    for (int i = 0; i < n; ++i) {
        re[i] = aa[i] + bb[i];
        im[i] = plus[i] - minus[i];
    }
    project(f, 1.0, re, im, sum);
    return f->status == FST_OK;
}

fst_status fst_cubic_coefficient(const fst_lapack *lapack, const fst_local_map *map, const double *matrix,
                                 double frequency, double *coefficient, double *spread, fst_error *error)
{
    forms f = {.lapack = lapack, .map = map, .matrix = matrix, .status = FST_OK, .error = error};
    double value[2];
    if (!find_pair(&f, frequency))
        return fst_fail(error, FST_NO_CONVERGENCE, "normal form", "there is no pair of frequency %.10g",
                        frequency);
    /* At the resonances 1:1 to 1:4 the normal form is another one. */
    for (int k = 1; map->is_map && k <= 4; ++k)
        if (hypot(cos(k * atan2(f.im, f.re)) - 1.0, sin(k * atan2(f.im, f.re))) < 1e-3)
            return fst_fail(error, FST_NO_CONVERGENCE, "normal form", "the resonance 1:%d is too near", k);
    for (int i = 0; i < 2; ++i) {
        double sum[2] = {0.0, 0.0};
        f.reach = map->reach * (i + 1);
        if (!cubic_sum(&f, sum))
            return f.status != FST_OK
                       ? f.status
                       : fst_fail(error, FST_NO_CONVERGENCE, "normal form", "a matrix is singular");
        value[i] = map->is_map ? 0.5 * (f.re * sum[0] + f.im * sum[1]) : 0.5 * sum[0] / f.im;
    }
    *coefficient = value[0];
    *spread = fabs(value[0] - value[1]);
    return FST_OK;
}
