/* standstill.c - is a state of rest stable?
 *
 * A bead may come to an unstable place of rest as near as 1e-8 and leave it only a hundred turns later, when
 * the deviation that the place repels has grown again.  How fast deviations grow shows it at once: with the
 * Jacobian J of the right-hand side at rest they are multiplied by exp(J t), whose norm goes as exp(rate t)
 * when t is long.  So a step's worth of it is squared again and again,
 *
 *     M = exp(J h),   M^2 = exp(2 J h),   M^4,   ...   M^(2^k),   rate = log |M^(2^k)|/(2^k h),
 *
 * each product scaled to norm 1, the logarithms added up.  After 40 squarings a constant factor in the norm
 * changes the rate by less than 1e-10.  J conserves |n|: deviations along n, for which the rate is 0, are
 * projected out.  Where nothing acts on n it turns freely, and nothing depends on it: all of n is projected
 * out.
 */
#include "study/settle.h"

#include <math.h>
#include <string.h>

#include "base/elementary.h"

enum { DIM = FST_STATE_SIZE, SQUARINGS = 40, TERMS = 14 };

typedef double matrix[DIM][DIM];

static void multiply(matrix a, matrix b, matrix product)
{
    for (int i = 0; i < DIM; ++i)
        for (int j = 0; j < DIM; ++j) {
            product[i][j] = 0.0;
            for (int k = 0; k < DIM; ++k)
                product[i][j] += a[i][k] * b[k][j];
        }
}

static double norm(matrix a)
{
    double greatest = 0.0;
    for (int i = 0; i < DIM; ++i) {
        double sum = 0.0;
        for (int j = 0; j < DIM; ++j)
            sum += fabs(a[i][j]);
        greatest = fmax(greatest, sum);
    }
    return greatest;
}

static void scale(matrix a, double factor)
{
    for (int i = 0; i < DIM; ++i)
        for (int j = 0; j < DIM; ++j)
            a[i][j] *= factor;
}

/* The projector that takes out of a deviation what lies along n, because n keeps its length, or, where n turns
 * freely, all of its change of n, because nothing holds n. */
static void across(const double *n, int is_free, matrix p)
{
    const double n2 = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    memset(p, 0, sizeof(matrix));
    for (int i = 0; i < DIM; ++i)
        p[i][i] = 1.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            p[FST_NX + i][FST_NX + j] -= is_free ? (i == j) : n[i] * n[j] / n2;
}

/* m = P exp(a), by its series; a is small. */
static void exponential(matrix a, matrix p, matrix m)
{
    matrix term, next;
    memcpy(m, p, sizeof(matrix));
    memcpy(term, p, sizeof(matrix));
    for (int k = 1; k <= TERMS; ++k) {
        multiply(term, a, next);
        scale(next, 1.0 / k);
        memcpy(term, next, sizeof term);
        for (int i = 0; i < DIM; ++i)
            for (int j = 0; j < DIM; ++j)
                m[i][j] += term[i][j];
    }
}

double fst_rest_rate(const fst_model *model, const double state[FST_STATE_SIZE])
{
    matrix j, p, a, m, square;
    const fst_world_double *c = &model->world;
    fst_jacobian(model, state, j, NULL);
    across(state + FST_NX, c->hard == 0.0 && c->twice_b == 0.0, p);
    multiply(p, j, a);
    multiply(a, p, j);
    const double size = norm(j);
    if (!(size > 0.0))
        return 0.0;
    const double h = 0.5 / size;
    scale(j, h);
    exponential(j, p, m);
    double logarithm = 0.0, time = h;
    for (int k = 0; k < SQUARINGS; ++k) {
        multiply(m, m, square);
        const double length = norm(square);
        if (!(length > 0.0))
            return -INFINITY;
        scale(square, 1.0 / length);
        memcpy(m, square, sizeof m);
        logarithm = 2.0 * logarithm + fst_log(length);
        time *= 2.0;
    }
    return logarithm / time;
}
