/* beads_lock.c - equilibria of several beads, or of one without a plate, in the turning frame.
 *
 * In a fixed state of contacts the beads move on a manifold, |n| = 1 and closed gaps (beads/manifold.h), and d(y)/dt
 * = f(y) lies in it.  With a basis Q of its directions at y Newton's method is
 *
 *     (Q^T Df Q) c = -Q^T f,      y <- project(y + Q c)
 *
 * Df Q are differences (beads/manifold.c).  Where equilibria form a continuum (spins of beads that nothing rubs) the
 * matrix is singular, and the shortest c of least squares is taken: then the state keeps its place along the continuum.
 * At an equilibrium Q^T Df Q is the linearised motion, whose eigenvalues do not depend on Q.
 *
 * Over a parameter p a row across the known direction of the curve is added, and the column f_p.
 */
#include "orbit/beads_lock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "beads/impact.h"

enum { ITERATIONS = 40, SIDE = BEADS_NUMBERS + 1 };
static const double FOUND = 1e-11, NEUTRAL = 1e-10; /* residual, and real parts that count as 0, over |Df| */
static const double CLOSED = 1e-10, AT_UNIT = 1e-6,
                    REACH = 1e-3; /* of a period: residual, log of a multiplier, and the
                                                                     reach of differences */
static const double STILL = 1e-8; /* a correction after which the next one is rounding, over the state */
static const double SINGULAR = 1e-10, SPREAD = 1e-4;
static const double FARTHEST = 0.4; /* that a correction takes a place, in radii, and a moment */

/* Room for one iteration. */
typedef struct newton {
    beads_manifold manifold;
    double matrix[SIDE * SIDE], jacobian[SIDE * SIDE], right[SIDE], f[BEADS_DIM];
} newton;

/* What is solved: in a world, or over a parameter. */
typedef struct problem {
    const fst_lapack *lapack;
    const beads_repeat *repeat;
    beads_world world;
    const beads_free_world *over; /* NULL: no parameter is free */
    double value, *way;
} problem;

typedef struct equations {
    const beads_repeat *repeat; /* NULL: equilibria */
    const beads_world *world;
    const beads_modes *modes;
} equations;

/* d(state)/dt, or the change over a period: a beads_map. */
static fst_status rates(void *user, const double *y, double *out, fst_error *error)
{
    const equations *of = user;
    double dy[BEADS_DIM];
    if (of->repeat) {
        const fst_status status = of->repeat->after(of->repeat->user, y, out, error);
        for (int i = 0; i < FST_BEAD_NUMBERS * of->world->count; ++i)
            out[i] -= y[i];
        return status;
    }
    beads_look look;
    beads_look_at(of->world, of->modes, y, &look);
    if (!look.solvable)
        return fst_fail(error, FST_NO_CONVERGENCE, "contacts", "no forces keep the closed contacts closed");
    beads_derivatives(of->world, of->modes, &look, y, dy);
    memcpy(out, dy, (size_t)(FST_BEAD_NUMBERS * of->world->count) * sizeof *dy);
    return FST_OK;
}

static double greatest_of(const double *v, int count)
{
    double greatest = 0.0;
    for (int i = 0; i < count; ++i)
        greatest = isnan(v[i]) ? NAN : fmax(greatest, fabs(v[i])); /* a NAN that is last stays */
    return greatest;
}

/* d(rates)/d(value), over the parameter's scale. */
static fst_status by_parameter(const problem *p, const beads_lock *lock, double *change, fst_error *error)
{
    const beads_free_world *over = p->over;
    const double value = p->value;
    beads_world beside;
    equations of = {p->repeat, &beside, &lock->modes};
    double below[BEADS_NUMBERS], apart = 0.0;
    for (int end = 0; end < 2; ++end) {
        fst_status status =
            over->at(over->user, value + (end ? SPREAD : -SPREAD) * over->scale, &beside, error);
        apart += status == FST_OK ? SPREAD : 0.0;
        if (status == FST_BAD_INPUT) /* the parameter can have no such value */
            status = over->at(over->user, value, &beside, error);
        if (status == FST_OK)
            status = rates(&of, lock->state, end ? change : below, error);
        if (status != FST_OK)
            return status;
    }
    for (int i = 0; i < FST_BEAD_NUMBERS * beside.count; ++i)
        change[i] = (change[i] - below[i]) / apart;
    return FST_OK;
}

/* The matrix at lock->state, with the row and the column of a free parameter. */
static fst_status fill(const problem *p, const beads_lock *lock, newton *n, fst_error *error)
{
    equations of = {p->repeat, &p->world, &lock->modes};
    beads_span(&p->world, &lock->modes, lock->state, NULL, &n->manifold);
    const int size = n->manifold.size, side = size + (p->over != NULL), numbers = n->manifold.numbers;
    double change[BEADS_NUMBERS], part[BEADS_NUMBERS];
    fst_status status = beads_derivative(&n->manifold, rates, &of, lock->state, p->repeat ? REACH : BEADS_REACH,
                                         n->jacobian, error);
    if (status == FST_OK)
        status = rates(&of, lock->state, n->f, error);
    if (status == FST_OK && p->over)
        status = by_parameter(p, lock, change, error);
    if (status != FST_OK)
        return status;
    beads_components(&n->manifold, n->f, n->right);
    for (int i = 0; i < size; ++i) {
        n->right[i] = -n->right[i];
        memcpy(n->matrix + i * side, n->jacobian + i * size, (size_t)size * sizeof *n->matrix);
    }
    if (!p->over)
        return FST_OK;
    beads_components(&n->manifold, change, part);
    for (int i = 0; i < size; ++i)
        n->matrix[i * side + size] = part[i];
    beads_components(&n->manifold, p->way, n->matrix + size * side);
    n->matrix[size * side + size] = p->way[numbers];
    n->right[size] = 0.0;
    return status;
}

static int by_real_part(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return x[0] != y[0] ? (x[0] < y[0]) - (x[0] > y[0]) : (x[1] < y[1]) - (x[1] > y[1]);
}

static fst_status find_spectrum(const problem *p, double scale, newton *n, beads_lock *lock, fst_error *error)
{
    const int size = n->manifold.size;
    double re[SIDE], im[SIDE], pair[SIDE][2];
    memcpy(n->matrix, n->jacobian, (size_t)(size * size) * sizeof *n->matrix);
    if (p->lapack->eigen(size, n->matrix, re, im, NULL) != 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "locked", "the eigenvalues were not found");
    for (int i = 0; i < size; ++i) {
        const double of_map = 1.0 + re[i], period = p->repeat ? p->repeat->period : NAN;
        pair[i][0] = p->repeat ? log(hypot(of_map, im[i])) / period : re[i];
        pair[i][1] = p->repeat ? atan2(im[i], of_map) / period : im[i];
    }
    const double neutral = p->repeat ? AT_UNIT / p->repeat->period : NEUTRAL * scale;
    qsort(pair, (size_t)size, sizeof *pair, by_real_part);
    lock->size = size;
    lock->unstable = 0;
    for (int i = 0; i < size; ++i) {
        lock->re[i] = pair[i][0];
        lock->im[i] = pair[i][1];
        lock->unstable += pair[i][0] > neutral;
    }
    return FST_OK;
}

/* The direction of the curve, of unit length, forward as before. */
static int find_way(const problem *p, newton *n)
{
    const int size = n->manifold.size, numbers = n->manifold.numbers;
    double square = 0.0;
    int rank;
    memset(n->right, 0, sizeof n->right);
    n->right[size] = 1.0;
    if (p->lapack->shortest(size + 1, n->matrix, n->right, SINGULAR, &rank) != 0)
        return 0;
    beads_vector(&n->manifold, n->right, p->way);
    p->way[numbers] = n->right[size];
    for (int i = 0; i <= size; ++i)
        square += n->right[i] * n->right[i];
    for (int i = 0; i <= numbers; ++i)
        p->way[i] /= sqrt(square);
    return square > 0;
}

/* Move by the correction, or by as much of it as is trusted; returns its size over that of the state. */
static double move(problem *p, const newton *n, beads_lock *lock)
{
    const int size = n->manifold.size;
    double step[BEADS_NUMBERS], longest = 1.0, state = 1.0;
    beads_vector(&n->manifold, n->right, step);
    for (int i = 0; i < n->manifold.numbers; ++i) {
        const int of = i % FST_BEAD_NUMBERS;
        if (of < BEADS_V || (of >= BEADS_N && of < BEADS_W))
            longest = fmax(longest, fabs(step[i]) / (FARTHEST * n->manifold.unit[i]));
        state = fmax(state, fabs(lock->state[i]) / n->manifold.unit[i]);
    }
    for (int i = 0; i < n->manifold.numbers; ++i)
        lock->state[i] += step[i] / longest;
    if (p->over)
        p->value += n->right[size] * p->over->scale / longest;
    beads_project(&p->world, &lock->modes, lock->state);
    return greatest_of(n->right, size) / state;
}

static fst_status set_world(problem *p, fst_error *error)
{
    return p->over ? p->over->at(p->over->user, p->value, &p->world, error) : FST_OK;
}

static fst_status iterate(problem *p, beads_lock *lock, newton *n, fst_error *error)
{
    double correction = INFINITY;
    fst_status status = set_world(p, error);
    if (status == FST_OK)
        beads_project(&p->world, &lock->modes, lock->state);
    for (lock->iterations = 0; lock->iterations < ITERATIONS; ++lock->iterations) {
        if (status == FST_OK)
            status = fill(p, lock, n, error);
        if (status != FST_OK)
            return status;
        const int size = n->manifold.size, side = size + (p->over != NULL);
        const double scale = 1.0 + greatest_of(n->jacobian, size * size);
        int rank;
        lock->residual = greatest_of(n->right, size);
        if (lock->residual < (p->repeat ? CLOSED : FOUND) * scale && correction < STILL)
            return p->over && !find_way(p, n)
                       ? fst_fail(error, FST_NO_CONVERGENCE, "locked", "the curve has no direction")
                       : find_spectrum(p, scale, n, lock, error);
        if (!(lock->residual < INFINITY) ||
            p->lapack->shortest(side, n->matrix, n->right, SINGULAR, &rank) != 0)
            break;
        lock->free = side - rank;
        correction = move(p, n, lock);
        status = set_world(p, error);
    }
    return fst_fail(error, FST_NO_CONVERGENCE, "locked",
                    "Newton's method found no %s near the start (residual %.3g after %d iterations)",
                    p->repeat ? "motion that repeats itself with the drive"
                              : "state in which the beads turn with the magnet",
                    lock->residual, lock->iterations);
}

static fst_status correct(problem *p, beads_lock *lock, fst_error *error)
{
    newton *n = malloc(sizeof *n);
    if (!n)
        return fst_fail(error, FST_NO_MEMORY, "locked", "out of memory");
    const fst_status status = iterate(p, lock, n, error);
    free(n);
    return status;
}

fst_status beads_lock_correct(const fst_lapack *lapack, const beads_repeat *repeat, const beads_world *world,
                              beads_lock *lock, fst_error *error)
{
    problem p = {.lapack = lapack, .repeat = repeat, .world = *world};
    return correct(&p, lock, error);
}

fst_status beads_lock_across(const fst_lapack *lapack, const beads_repeat *repeat, const beads_free_world *over,
                             double *value, beads_lock *lock, double way[BEADS_NUMBERS + 1], fst_error *error)
{
    problem p = {.lapack = lapack, .repeat = repeat, .over = over, .value = *value, .way = way};
    const fst_status status = correct(&p, lock, error);
    *value = p.value;
    return status;
}

/* The least of what contacts in a state hold: loads of pressing ones, gaps of open ones. */
static double least_of(const beads_world *world, const beads_lock *lock, int contact_state, int *which)
{
    double least = INFINITY;
    beads_look look;
    *which = -1;
    beads_look_at(world, &lock->modes, lock->state, &look);
    for (int k = 0; k < world->contacts; ++k) {
        if (lock->modes.contact[k] != contact_state || !beads_can_meet(world, &lock->modes, k))
            continue;
        const double value = contact_state == BEADS_OPEN ? look.gap[k] : look.held[k];
        if (value < least) {
            least = value;
            *which = k;
        }
    }
    return least;
}

double beads_lock_least_force(const beads_world *world, const beads_lock *lock, int *which)
{
    return least_of(world, lock, BEADS_PRESSING, which);
}

double beads_lock_least_gap(const beads_world *world, const beads_lock *lock, int *which)
{
    return least_of(world, lock, BEADS_OPEN, which);
}
