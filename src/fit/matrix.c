/* matrix.c - eigenvalues of small symmetric matrices, by Jacobi's rotations (Golub and Van Loan, Matrix
 * Computations, section 8.5). */
#include "fit/matrix.h"

#include <math.h>
#include <string.h>

/* Turn rows and columns p and q so that a_pq vanishes. */
static void rotate(fit_matrix *m, fit_matrix *v, int p, int q)
{
    const double theta = (m->a[q][q] - m->a[p][p]) / (2.0 * m->a[p][q]);
    const double t = (theta >= 0 ? 1.0 : -1.0) / (fabs(theta) + hypot(theta, 1.0));
    const double c = 1.0 / hypot(t, 1.0), s = t * c;
    for (int k = 0; k < m->size; ++k) {
        const double kp = m->a[k][p], kq = m->a[k][q];
        m->a[k][p] = c * kp - s * kq;
        m->a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < m->size; ++k) {
        const double pk = m->a[p][k], qk = m->a[q][k];
        m->a[p][k] = c * pk - s * qk;
        m->a[q][k] = s * pk + c * qk;
    }
    for (int k = 0; k < m->size; ++k) {
        const double kp = v->a[k][p], kq = v->a[k][q];
        v->a[k][p] = c * kp - s * kq;
        v->a[k][q] = s * kp + c * kq;
    }
}

static void sort(double values[FIT_MOST], fit_matrix *v)
{
    for (int i = 0; i < v->size; ++i)
        for (int j = i + 1; j < v->size; ++j)
            if (values[j] < values[i]) {
                const double value = values[i];
                values[i] = values[j];
                values[j] = value;
                for (int k = 0; k < v->size; ++k) {
                    const double entry = v->a[k][i];
                    v->a[k][i] = v->a[k][j];
                    v->a[k][j] = entry;
                }
            }
}

void fit_eigen(const fit_matrix *symmetric, double values[FIT_MOST], fit_matrix *vectors)
{
    enum { MOST_SWEEPS = 60 };
    fit_matrix m = *symmetric;
    memset(vectors, 0, sizeof *vectors);
    vectors->size = m.size;
    for (int i = 0; i < m.size; ++i)
        vectors->a[i][i] = 1.0;
    for (int sweep = 0, turned = 1; sweep < MOST_SWEEPS && turned; ++sweep) {
        turned = 0;
        for (int p = 0; p < m.size; ++p)
            for (int q = p + 1; q < m.size; ++q)
                if (fabs(m.a[p][q]) > 1e-17 * sqrt(fabs(m.a[p][p] * m.a[q][q]))) {
                    rotate(&m, vectors, p, q);
                    turned = 1;
                }
    }
    for (int i = 0; i < m.size; ++i)
        values[i] = m.a[i][i];
    sort(values, vectors);
}

void fit_inverse(int size, const double values[FIT_MOST], const fit_matrix *vectors, fit_matrix *inverse)
{
    memset(inverse, 0, sizeof *inverse);
    inverse->size = size;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j)
            for (int k = 0; k < size; ++k)
                inverse->a[i][j] += vectors->a[i][k] * vectors->a[j][k] / values[k];
}

double fit_product(const fit_matrix *m, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < m->size; ++i)
        for (int j = 0; j < m->size; ++j)
            sum += a[i] * m->a[i][j] * b[j];
    return sum;
}
