/* linear.c - elimination with pivots; Cholesky's factors, and what to do where they do not exist.
 *
 * A flat hexagon of seven beads has 19 contacts in 18 directions: its matrix A is singular, the accelerations
 * are unique all the same, the forces are not.  Then (A + d) x' = right + d x is repeated until x is still, with
 * d = 1e-5 of the diagonal, which finds one of the solutions.
 */
#include "beads/linear.h"

#include <math.h>
#include <string.h>

#include "beads/hold.h"

static const double LEAST_PIVOT = 1e-11, LIFT = 1e-5;
enum { MOST_ROUNDS = 60 };

static int pivot_of(int count, const double *matrix, int column)
{
    int best = column;
    for (int i = column + 1; i < count; ++i)
        if (fabs(matrix[i * count + column]) > fabs(matrix[best * count + column]))
            best = i;
    return best;
}

static void swap(double *a, double *b)
{
    const double kept = *a;
    *a = *b;
    *b = kept;
}

static int solve_by_pivots(int count, double *matrix, double *right)
{
    double greatest = 0.0;
    for (int i = 0; i < count * count; ++i)
        greatest = fmax(greatest, fabs(matrix[i]));
    for (int j = 0; j < count; ++j) {
        const int pivot = pivot_of(count, matrix, j);
        if (!(fabs(matrix[pivot * count + j]) > LEAST_PIVOT * greatest))
            return 0;
        for (int k = 0; k < count && pivot != j; ++k)
            swap(&matrix[pivot * count + k], &matrix[j * count + k]);
        if (pivot != j)
            swap(&right[pivot], &right[j]);
        for (int i = j + 1; i < count; ++i) {
            const double factor = matrix[i * count + j] / matrix[j * count + j];
            for (int k = j; k < count; ++k)
                matrix[i * count + k] -= factor * matrix[j * count + k];
            right[i] -= factor * right[j];
        }
    }
    for (int i = count - 1; i >= 0; --i) {
        for (int k = i + 1; k < count; ++k)
            right[i] -= matrix[i * count + k] * right[k];
        right[i] /= matrix[i * count + i];
    }
    return 1;
}

/* Cholesky's factor in the lower half; 0: a pivot vanishes. */
static int factor_of(int count, double *matrix)
{
    for (int j = 0; j < count; ++j) {
        const double diagonal = matrix[j * count + j];
        double pivot = diagonal;
        for (int k = 0; k < j; ++k)
            pivot -= matrix[j * count + k] * matrix[j * count + k];
        if (!(pivot > LEAST_PIVOT * diagonal))
            return 0;
        const double root = matrix[j * count + j] = sqrt(pivot);
        for (int i = j + 1; i < count; ++i) {
            double sum = matrix[i * count + j];
            for (int k = 0; k < j; ++k)
                sum -= matrix[i * count + k] * matrix[j * count + k];
            matrix[i * count + j] = sum / root;
        }
    }
    return 1;
}

static void solve_by_factor(int count, const double *factor, double *right)
{
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < i; ++k)
            right[i] -= factor[i * count + k] * right[k];
        right[i] /= factor[i * count + i];
    }
    for (int i = count - 1; i >= 0; --i) {
        for (int k = i + 1; k < count; ++k)
            right[i] -= factor[k * count + i] * right[k];
        right[i] /= factor[i * count + i];
    }
}

/* x' of (A + d) x' = right: by Cholesky's factor of A + d, or from that itself where it is not symmetric. */
static int solve_one_lifted(int count, const double *lifted, int symmetric, double *right)
{
    double work[BEADS_TIES * BEADS_TIES];
    if (symmetric) {
        solve_by_factor(count, lifted, right);
        return 1;
    }
    memcpy(work, lifted, (size_t)(count * count) * sizeof *work);
    return solve_by_pivots(count, work, right);
}

static int solve_lifted(int count, const double *matrix, int symmetric, double *right)
{
    double lifted[BEADS_TIES * BEADS_TIES], x[BEADS_TIES] = {0.0}, next[BEADS_TIES];
    memcpy(lifted, matrix, (size_t)(count * count) * sizeof *lifted);
    for (int i = 0; i < count; ++i)
        lifted[i * count + i] *= 1.0 + LIFT;
    if (symmetric && !factor_of(count, lifted))
        return 0;
    double change = 1.0, size = 0.0;
    for (int round = 0; round < MOST_ROUNDS && change > 1e-15 * size; ++round) {
        for (int i = 0; i < count; ++i)
            next[i] = right[i] + LIFT * matrix[i * count + i] * x[i];
        if (!solve_one_lifted(count, lifted, symmetric, next))
            return 0;
        change = size = 0.0;
        for (int i = 0; i < count; ++i) {
            change = fmax(change, fabs(next[i] - x[i]));
            size = fmax(size, fabs(next[i]));
            x[i] = next[i];
        }
    }
    memcpy(right, x, (size_t)count * sizeof *right);
    return change <= 1e-9 * size;
}

int beads_solve_symmetric(int count, double *matrix, double *right, int *unique)
{
    double kept[BEADS_TIES * BEADS_TIES];
    memcpy(kept, matrix, (size_t)(count * count) * sizeof *kept);
    if (factor_of(count, matrix)) {
        solve_by_factor(count, matrix, right);
        return 1;
    }
    *unique = 0;
    return solve_lifted(count, kept, 1, right);
}

int beads_solve_any(int count, double *matrix, double *right, int *unique)
{
    double kept[BEADS_TIES * BEADS_TIES], wanted[BEADS_TIES];
    memcpy(kept, matrix, (size_t)(count * count) * sizeof *kept);
    memcpy(wanted, right, (size_t)count * sizeof *wanted);
    if (solve_by_pivots(count, matrix, right))
        return 1;
    *unique = 0;
    memcpy(right, wanted, (size_t)count * sizeof *right);
    return solve_lifted(count, kept, 0, right);
}
