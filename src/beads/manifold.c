/* manifold.c - the directions in which beads can move, and derivatives along them.
 *
 * A bead has twelve numbers.  Its moment keeps its length, and a closed contact holds two numbers, its gap and the
 * gap's rate:
 *
 *     d|n|^2/2 = n.dn          d(gap) = u.(dx_j - dx_i)          d(rate) = u.(dv_j - dv_i) + v_t.(dx_j - dx_i)/|d|
 *
 * (with the curvature of beads_meet() for 1/|d|, so that a plate, and a bowl, are served too).
 *
 * The directions across all of these gradients span the manifold's tangent space, of 11 dimensions for a free
 * bead.  Derivatives are central differences of the eighth order,
 *
 *     f' = (4/5 (f_1 - f_-1) - 1/5 (f_2 - f_-2) + 4/105 (f_3 - f_-3) - 1/280 (f_4 - f_-4))/reach
 *
 * With BEADS_REACH, d/100 of the distance d of equal beads in touch, that of a force like 1/d^4 is in error by 3e-12 of
 * itself, and rounding brings 1e-12; eigenvalues are as good as 1e-9 where they are simple.
 */
#include "beads/manifold.h"

#include <math.h>
#include <string.h>

#include "beads/act.h"

static const double DEPENDENT = 1e-8;

void beads_units(const beads_world *world, double *unit)
{
    const double rate = 1.0 + fabs(world->omega);
    for (int i = 0; i < FST_BEAD_NUMBERS * world->count; ++i) {
        const int of = i % FST_BEAD_NUMBERS, is_rate = (of >= BEADS_V && of < BEADS_N) || of >= BEADS_W;
        unit[i] = (of < BEADS_N ? world->body[i / FST_BEAD_NUMBERS].radius : 1.0) * (is_rate ? rate : 1.0);
    }
}

static double product(int numbers, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < numbers; ++i)
        sum += a[i] * b[i];
    return sum;
}

/* Take from v what lies along the first `count` rows of `of`, twice for rounding; what is left gets unit length.
 * Returns the length that was left, 0: v depended on the others. */
static double across(int numbers, int count, double of[][BEADS_NUMBERS], double *v)
{
    const double before = sqrt(product(numbers, v, v));
    for (int round = 0; round < 2; ++round)
        for (int j = 0; j < count; ++j) {
            const double along = product(numbers, of[j], v);
            for (int i = 0; i < numbers; ++i)
                v[i] -= along * of[j][i];
        }
    const double length = sqrt(product(numbers, v, v));
    if (!(length > DEPENDENT * before))
        return 0.0;
    for (int i = 0; i < numbers; ++i)
        v[i] /= length;
    return length;
}

/* The gradients of a closed contact's gap and of its rate. */
static void contact_gradients(const beads_world *world, int k, const double *y, double *of_gap, double *of_rate)
{
    const beads_contact *c = &world->contact[k];
    const double *v_i = y + FST_BEAD_NUMBERS * c->first + BEADS_V;
    double *x_i = of_gap + FST_BEAD_NUMBERS * c->first, *r_i = of_rate + FST_BEAD_NUMBERS * c->first;
    double u[3], v[3], gap, curve;
    beads_meet(world, c->first, c->second, y, u, &gap, &curve);
    for (int m = 0; m < 3; ++m)
        v[m] = (c->second < 0 ? 0.0 : y[FST_BEAD_NUMBERS * c->second + BEADS_V + m]) - v_i[m];
    const double rate = beads_dot(u, v);
    for (int m = 0; m < 3; ++m) {
        const double turn = curve * (v[m] - rate * u[m]);
        x_i[m] = r_i[BEADS_V + m] = -u[m];
        r_i[m] = -turn;
        if (c->second < 0)
            continue;
        of_gap[FST_BEAD_NUMBERS * c->second + m] = of_rate[FST_BEAD_NUMBERS * c->second + BEADS_V + m] = u[m];
        of_rate[FST_BEAD_NUMBERS * c->second + m] = turn;
    }
}

/* The gradient as a row of `held`, across those before it; 0: it depends on them. */
static int add_row(int numbers, const double *unit, const double *gradient, int count,
                   double held[][BEADS_NUMBERS])
{
    for (int i = 0; i < numbers; ++i)
        held[count][i] = gradient[i] * unit[i];
    return across(numbers, count, held, held[count]) > 0;
}

/* An orthonormal basis of the gradients: the rows of `held`; their number. */
static int hold(const beads_world *world, const beads_modes *modes, const double *y, const double *unit,
                double held[][BEADS_NUMBERS])
{
    const int numbers = FST_BEAD_NUMBERS * world->count;
    int count = 0;
    for (int i = 0; i < world->count; ++i) {
        double gradient[BEADS_NUMBERS] = {0.0};
        memcpy(gradient + FST_BEAD_NUMBERS * i + BEADS_N, y + FST_BEAD_NUMBERS * i + BEADS_N, 3 * sizeof *y);
        count += add_row(numbers, unit, gradient, count, held);
    }
    for (int k = 0; k < world->contacts; ++k) {
        double gradient[2][BEADS_NUMBERS] = {{0.0}};
        if (modes->contact[k] == BEADS_OPEN)
            continue;
        contact_gradients(world, k, y, gradient[0], gradient[1]);
        for (int g = 0; g < 2 && count < numbers; ++g)
            count += add_row(numbers, unit, gradient[g], count, held);
    }
    return count;
}

void beads_span(const beads_world *world, const beads_modes *modes, const double *y, const double *first,
                beads_manifold *manifold)
{
    double all[BEADS_NUMBERS + 1][BEADS_NUMBERS], left[BEADS_NUMBERS];
    const int numbers = FST_BEAD_NUMBERS * world->count;
    beads_units(world, manifold->unit);
    const int held = hold(world, modes, y, manifold->unit, all);
    int count = held;
    if (first) {
        for (int i = 0; i < numbers; ++i)
            all[count][i] = first[i] / manifold->unit[i];
        count += across(numbers, count, all, all[count]) > 0;
    }
    for (; count < numbers; ++count) { /* the axis that is least known so far is next */
        int best = 0;
        for (int i = 0; i < numbers; ++i) {
            left[i] = 1.0;
            for (int j = 0; j < count; ++j)
                left[i] -= all[j][i] * all[j][i];
            best = left[i] > left[best] ? i : best;
        }
        memset(all[count], 0, sizeof all[count]);
        all[count][best] = 1.0;
        (void)across(numbers, count, all, all[count]);
    }
    manifold->numbers = numbers;
    manifold->size = numbers - held;
    memcpy(manifold->basis, all + held, (size_t)manifold->size * sizeof *all);
}

void beads_components(const beads_manifold *manifold, const double *v, double *components)
{
    for (int j = 0; j < manifold->size; ++j) {
        components[j] = 0.0;
        for (int i = 0; i < manifold->numbers; ++i)
            components[j] += manifold->basis[j][i] * v[i] / manifold->unit[i];
    }
}

void beads_vector(const beads_manifold *manifold, const double *components, double *v)
{
    memset(v, 0, (size_t)manifold->numbers * sizeof *v);
    for (int j = 0; j < manifold->size; ++j)
        for (int i = 0; i < manifold->numbers; ++i)
            v[i] += components[j] * manifold->basis[j][i] * manifold->unit[i];
}

fst_status beads_derivative(const beads_manifold *manifold, beads_map *map, void *user, const double *y,
                            double reach, double *matrix, fst_error *error)
{
    static const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    const int numbers = manifold->numbers, size = manifold->size;
    double at[BEADS_NUMBERS], value[BEADS_NUMBERS], column[BEADS_NUMBERS], part[BEADS_NUMBERS];
    for (int j = 0; j < size; ++j) {
        memset(column, 0, sizeof column);
        for (int step = 0; step < 8; ++step) {
            const double sign = step % 2 ? -1.0 : 1.0, way = sign * (1 + step / 2) * reach;
            for (int i = 0; i < numbers; ++i)
                at[i] = y[i] + way * manifold->basis[j][i] * manifold->unit[i];
            const fst_status status = map(user, at, value, error);
            if (status != FST_OK)
                return status;
            for (int i = 0; i < numbers; ++i)
                column[i] += sign * weight[step / 2] / reach * value[i];
        }
        beads_components(manifold, column, part);
        for (int i = 0; i < size; ++i)
            matrix[i * size + j] = part[i];
    }
    return FST_OK;
}
