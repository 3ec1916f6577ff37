/* newton.c - Newton's method for equilibria, and for periodic orbits by multiple shooting.
 *
 * An equilibrium is a state y at which the equations of motion y' = f(y, p) stand still: f(y, p) = 0, p being
 * the free parameter.  A periodic orbit is a state that the flow brings back to itself after a time T, which is
 * as unknown as the state.  Over a whole turn the flow may stretch a small difference ten thousandfold, and
 * Newton's method would have to guess the start to as many digits.  So the orbit is cut into segments that take
 * equal times, and the state at the beginning of each is an unknown of its own ("multiple shooting").  With two
 * segments:
 *
 *        y0 *-----> gap 1          integrate from y0 for T/2, and from y1 for T/2;
 *           ^       |              the ends miss y1 and y0 by gaps;
 *         gap 0 <---* y1           Newton's method closes all gaps at once.
 *
 * An orbit with the symmetry S2 needs half of that: the image under S2 of where half a turn ends is the start,
 * and T is the time of half a turn.
 *
 * Each iteration integrates every segment together with tangent vectors (family.c), which show how its end
 * moves when its start or p does.  Its linear system for the corrections dy0, dy1, dT, dp:
 *
 *       | D0      -1      f/2   d0  |  dy0       gap 1      D: derivative of a segment's end by its start
 *       | -1      D1      f/2   d1  |  dy1  =  - gap 0      f: the equations at the end: what more time changes
 *       | phase    0       0    0   |  dT          0        d: derivative of the end by p
 *       |  <------ across ------->  |  dp          0
 *
 * The row `phase` is needed because a state may slide along its own orbit: the first one may only move across
 * the flow, or stays on the section X = 0.  The last row keeps p as it is, or, when a curve of orbits is
 * followed (curve.c), keeps the correction perpendicular to the direction `across`.
 *
 * The bead's moment n has length 1, so a state has ten numbers but only nine directions.  Corrections are
 * written in a basis of these nine at each state (fst_tangent_basis), and n is put back onto the sphere after
 * each step: |n| = 1 needs no equation and leaves no multiplier.  The product of the D is the derivative of the
 * whole return, whose eigenvalues are the multipliers (spectrum.c).
 */
#include "orbit/newton.h"

#include <stdio.h>
#include <string.h>

#include "base/dot.h"
#include "base/error.h"

/* A Newton correction longer than this leaves the range in which the linear system is a good approximation.
 * (Equilibria that are sought from far away may take longer ones.) */
#define LONGEST_CORRECTION 0.3

/* Of an iteration without the integrations, in evaluations of the equations: the linear system. */
enum { ITERATION_WORK = 20 };

double fst_direction_product(const fst_family *family, const fst_solution *of, const fst_direction *a,
                             const fst_direction *b)
{
    const int states = fst_states_of(of);
    double sum = 0.0;
    for (int i = 0; i < states; ++i)
        sum += fst_dot(a->y[i], b->y[i], FST_STATE_SIZE) / states;
    return sum + 0.0025 * (a->period * b->period) + a->value * b->value / (family->scale * family->scale);
}

void fst_direction_between(const fst_solution *from, const fst_solution *to, fst_direction *out)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; i < fst_states_of(from); ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            out->y[i][k] = to->y[i][k] - from->y[i][k];
    out->period = to->period - from->period;
    out->value = to->value - from->value;
}

static void normalise(double *y)
{
    double *n = y + FST_NX;
    const double length = sqrt(fst_dot(n, n, 3));
    for (int i = 0; i < 3; ++i)
        n[i] /= length;
}

void fst_direction_combine(fst_direction *out, double a, const fst_direction *u, double b,
                           const fst_direction *v)
{
    for (int i = 0; i < FST_SEGMENTS; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            out->y[i][k] = a * u->y[i][k] + b * v->y[i][k];
    out->period = a * u->period + b * v->period;
    out->value = a * u->value + b * v->value;
}

void fst_solution_move(fst_solution *s, const fst_direction *direction, double length)
{
    for (int i = 0; i < fst_states_of(s); ++i) {
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            s->y[i][k] += length * direction->y[i][k];
        normalise(s->y[i]);
    }
    s->period += length * direction->period;
    s->value += length * direction->value;
}

/* ------------------------------------------------------------------ the equations */

static void put_residual(fst_newton_system *l, fst_solution *s, int row, const double *defect)
{
    double projected[FST_TANGENT_SIZE];
    fst_tangent_part(l->basis[row / FST_TANGENT_SIZE], defect, projected);
    for (int j = 0; j < FST_TANGENT_SIZE; ++j) {
        l->b[row + j] = -projected[j];
        if (!(fabs(projected[j]) <= s->residual))
            s->residual = fabs(projected[j]);
    }
}

/* Under dry friction a locked bead whose contact slips is an isolated state like others.  Where it does not
 * slip the equations have no derivative; these states come in families (rolling_lock.c). */
static fst_status contact_slips(const fst_setup *setup, const fst_solution *s, fst_error *error)
{
    const double least = 1e-9;
    double slip[2];
    if (!setup->model.world.kinds.dry || setup->model.world.kinds.patch)
        return FST_OK;
    fst_slip_double(&setup->model.world, s->y[0], slip);
    if (setup->model.world.kinds.modes && hypot(slip[0], slip[1]) > least)
        return FST_OK;
    return fst_fail(error, FST_NO_CONVERGENCE, "Newton's method",
                    "the contact does not slip at %.10g: under dry friction such states are not isolated",
                    s->value);
}

static void equilibrium_equations(const fst_setup *setup, fst_solution *s, fst_newton_system *l)
{
    double f[FST_STATE_SIZE], jacobian[FST_STATE_SIZE][FST_STATE_SIZE], by[FST_STATE_SIZE],
        part[FST_TANGENT_SIZE];
    fst_rhs(&setup->model, s->y[0], f);
    fst_jacobian(&setup->model, s->y[0], jacobian, NULL);
    fst_setup_by_parameter(setup, s->y[0], by);
    l->rows = FST_TANGENT_SIZE;
    l->size = l->rows + 1;
    for (int j = 0; j < FST_TANGENT_SIZE; ++j) {
        double column[FST_STATE_SIZE] = {0};
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            for (int k = 0; k < FST_STATE_SIZE; ++k)
                column[i] += jacobian[i][k] * l->basis[0][k][j];
        fst_tangent_part(l->basis[0], column, part);
        for (int i = 0; i < FST_TANGENT_SIZE; ++i)
            s->map[i][j] = l->a[i][j] = part[i];
    }
    fst_tangent_part(l->basis[0], by, part);
    for (int i = 0; i < FST_TANGENT_SIZE; ++i)
        l->a[i][l->size - 1] = part[i];
    put_residual(l, s, 0, f);
}

/* One column of a segment's derivative, seen in the basis at its end. */
static void put_column(fst_newton_system *l, int row, int column, const double *v)
{
    double part[FST_TANGENT_SIZE];
    fst_tangent_part(l->basis[row / FST_TANGENT_SIZE], v, part);
    for (int i = 0; i < FST_TANGENT_SIZE; ++i)
        l->a[row + i][column] += part[i];
}

/* Segment i of a chain: the equations that its end is the next state; its derivative is multiplied onto s->map.
 */
static fst_status segment_equations(const fst_family *family, const fst_setup *setup, fst_solution *s, int i,
                                    fst_newton_system *l, fst_error *error)
{
    const int last = i == s->segments - 1, next = last ? 0 : i + 1, row = FST_TANGENT_SIZE * next;
    double y[FST_STATE_SIZE], tangent[FST_STATE_SIZE][FST_COLUMNS], f[FST_STATE_SIZE], v[FST_STATE_SIZE];
    memcpy(y, s->y[i], sizeof y);
    for (int k = 0; k < FST_STATE_SIZE; ++k) {
        memcpy(tangent[k], l->basis[i][k], sizeof l->basis[i][k]);
        tangent[k][FST_TANGENT_SIZE] = 0.0;
    }
    const fst_status status = fst_carry(setup, family->tolerance, s->period / s->segments, y, tangent, error);
    if (status != FST_OK)
        return status;
    fst_rhs(&setup->model, y, f);
    const int mirror = last && s->symmetric;
    double segment[FST_TANGENT_SIZE][FST_TANGENT_SIZE], product[FST_TANGENT_SIZE][FST_TANGENT_SIZE];
    for (int c = 0; c < FST_COLUMNS + 1; ++c) { /* the basis, the parameter, the time */
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            v[k] = c < FST_COLUMNS ? tangent[k][c] : f[k] / s->segments;
        if (mirror)
            fst_apply_s2(v, v);
        const int column = c < FST_TANGENT_SIZE ? FST_TANGENT_SIZE * i + c
                           : c < FST_COLUMNS    ? l->size - 1
                                                : l->size - 2;
        put_column(l, row, column, v);
        if (c >= FST_TANGENT_SIZE)
            continue;
        double part[FST_TANGENT_SIZE];
        fst_tangent_part(l->basis[next], v, part);
        for (int k = 0; k < FST_TANGENT_SIZE; ++k)
            segment[k][c] = part[k];
    }
    for (int j = 0; j < FST_TANGENT_SIZE; ++j) /* minus the next state */
        l->a[row + j][FST_TANGENT_SIZE * next + j] -= 1.0;
    if (mirror)
        fst_apply_s2(y, y);
    for (int k = 0; k < FST_STATE_SIZE; ++k)
        v[k] = y[k] - s->y[next][k];
    put_residual(l, s, row, v);
    for (int j = 0; j < FST_TANGENT_SIZE; ++j)
        for (int k = 0; k < FST_TANGENT_SIZE; ++k) {
            product[j][k] = 0.0;
            for (int m = 0; m < FST_TANGENT_SIZE; ++m)
                product[j][k] += segment[j][m] * s->map[m][k];
        }
    memcpy(s->map, product, sizeof product);
    return FST_OK;
}

static fst_status orbit_equations(const fst_family *family, const fst_setup *setup, fst_solution *s,
                                  fst_newton_system *l, fst_error *error)
{
    if (s->symmetric && !setup->model.has_s2)
        return fst_fail(error, FST_NO_CONVERGENCE, "Newton's method",
                        "the magnet is not its own image under half a turn, so no orbit is");
    fst_setup watched = *setup;
    s->sticks = 0;
    watched.sticks = &s->sticks;
    l->rows = FST_TANGENT_SIZE * s->segments + 1;
    l->size = l->rows + 1;
    memset(s->map, 0, sizeof s->map);
    for (int j = 0; j < FST_TANGENT_SIZE; ++j)
        s->map[j][j] = 1.0;
    for (int i = 0; i < s->segments; ++i) {
        const fst_status status = segment_equations(family, &watched, s, i, l, error);
        if (status != FST_OK)
            return status;
    }
    /* The first state moves across the flow, or stays on the section X = 0. */
    double across[FST_STATE_SIZE] = {1.0};
    if (!s->on_section)
        fst_rhs(&setup->model, s->y[0], across);
    const double length = sqrt(fst_dot(across, across, FST_STATE_SIZE));
    fst_tangent_part(l->basis[0], across, l->a[l->rows - 1]);
    for (int j = 0; j < FST_TANGENT_SIZE; ++j)
        l->a[l->rows - 1][j] /= length;
    l->b[l->rows - 1] = s->on_section ? -s->y[0][FST_X] : 0.0;
    return FST_OK;
}

fst_status fst_newton_equations(const fst_family *family, fst_solution *s, fst_newton_system *l,
                                fst_error *error)
{
    fst_setup setup;
    fst_status status = fst_watch_count(family->watch, ITERATION_WORK, error);
    if (status == FST_OK)
        status = fst_family_setup(family, s->value, &setup, error);
    if (status != FST_OK)
        return status;
    memset(l->a, 0, sizeof l->a);
    memset(l->b, 0, sizeof l->b);
    s->residual = 0.0;
    for (int i = 0; i < fst_states_of(s); ++i)
        fst_tangent_basis(s->y[i], l->basis[i]);
    if (s->segments > 0)
        return orbit_equations(family, &setup, s, l, error);
    status = contact_slips(&setup, s, error);
    if (status == FST_OK)
        equilibrium_equations(&setup, s, l);
    return status;
}

/* ------------------------------------------------------------------ solving them */

void fst_newton_row(const fst_family *family, const fst_solution *s, fst_newton_system *l,
                    const fst_direction *across, double *row)
{
    const int states = fst_states_of(s);
    for (int i = 0; i < states; ++i) {
        double part[FST_TANGENT_SIZE];
        fst_tangent_part(l->basis[i], across->y[i], part);
        for (int j = 0; j < FST_TANGENT_SIZE; ++j)
            row[FST_TANGENT_SIZE * i + j] = part[j] / states;
    }
    if (s->segments > 0)
        row[l->size - 2] = 0.0025 * across->period;
    row[l->size - 1] = across->value / (family->scale * family->scale);
}

void fst_newton_direction(const fst_solution *s, fst_newton_system *l, const double *x, fst_direction *out)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; i < fst_states_of(s); ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            out->y[i][k] = fst_dot(l->basis[i][k], x + FST_TANGENT_SIZE * i, FST_TANGENT_SIZE);
    out->period = s->segments > 0 ? x[l->size - 2] : 0.0;
    out->value = x[l->size - 1];
}

/* Solve with the last row `across` (NULL: the parameter alone) and the right-hand side b, or, for the tangent,
 * the last unit vector. */
static fst_status solve(const fst_family *family, const fst_solution *s, fst_newton_system *l,
                        const fst_direction *across, int for_tangent, fst_direction *out, fst_error *error)
{
    const int n = l->size;
    double a[FST_UNKNOWNS * FST_UNKNOWNS], b[FST_UNKNOWNS], row[FST_UNKNOWNS] = {0};
    if (across)
        fst_newton_row(family, s, l, across, row);
    else
        row[n - 1] = 1.0;
    for (int i = 0; i < n; ++i) {
        memcpy(a + i * n, i < l->rows ? l->a[i] : row, (size_t)n * sizeof *a);
        b[i] = for_tangent ? (i == n - 1 ? 1.0 : 0.0) : (i < l->rows ? l->b[i] : 0.0);
    }
    if (family->lapack->solve(n, 1, a, b) != 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "Newton's method", "its matrix is singular at %.10g",
                        s->value);
    fst_newton_direction(s, l, b, out);
    return FST_OK;
}

static fst_status find_tangent(const fst_family *family, fst_solution *s, fst_newton_system *l,
                               const fst_direction *across, fst_error *error)
{
    const fst_status status = solve(family, s, l, across, 1, &s->tangent, error);
    if (status != FST_OK)
        return status;
    fst_direction_scale(&s->tangent, 1.0 / sqrt(fst_direction_product(family, s, &s->tangent, &s->tangent)));
    return FST_OK;
}

fst_status fst_solution_approach(const fst_family *family, fst_solution *s, const fst_direction *across,
                                 fst_error *error)
{
    const double rough = fst_family_rests(family) ? 1e-10 : 1e-8; /* of releases more is left at either */
    if (s->segments == 0 || family->tolerance >= rough)
        return FST_OK;
    fst_family eased = *family;
    fst_newton_system l;
    fst_direction step;
    eased.tolerance = rough;
    fst_status status = fst_newton_equations(&eased, s, &l, error);
    if (status == FST_OK)
        status = solve(family, s, &l, across, 0, &step, error);
    if (status == FST_OK)
        status = find_tangent(family, s, &l, across, error);
    if (status != FST_OK)
        return status;
    const double size = sqrt(fst_direction_product(family, s, &step, &step));
    if (!(size < LONGEST_CORRECTION))
        return fst_fail(error, FST_NO_CONVERGENCE, "Newton's method", "the guess at %.10g is too far off: %.3g",
                        s->value, size);
    fst_solution_move(s, &step, 1.0);
    return FST_OK;
}

fst_status fst_solution_correct(const fst_family *family, fst_solution *s, const fst_direction *across,
                                fst_error *error)
{
    fst_newton_system l;
    double before = INFINITY;
    /* From far away, as equilibria are sought, the way is long and the residual may rise on it; an orbit's
     * iterations are dear, and its guess is good. */
    const int far = s->segments == 0 && !across, most = far ? 40 : 14, patience = far ? 20 : 4;
    /* Dry friction: beside a motion that rolls the system is singular, and a way far longer than the guess is
     * dear. */
    const double longest = fst_family_rests(family) ? 2.0 * s->period : 1e4;
    for (s->iterations = 1; s->iterations <= most; ++s->iterations) {
        fst_status status = fst_newton_equations(family, s, &l, error);
        if (status != FST_OK)
            return status;
        if (fst_newton_is_done(family, s, before))
            return family->key >= 0 ? find_tangent(family, s, &l, across, error) : FST_OK;
        if (!isfinite(s->residual) || (s->iterations > patience && s->residual > before))
            break;
        before = s->residual;
        fst_direction step;
        status = solve(family, s, &l, across, 0, &step, error);
        if (status != FST_OK)
            return status;
        const double size = sqrt(fst_direction_product(family, s, &step, &step));
        if (!isfinite(size))
            break;
        const double limit = far ? 1.0 : LONGEST_CORRECTION;
        fst_solution_move(s, &step, size > limit ? limit / size : 1.0);
        if (s->segments > 0 && !(s->period > 1e-3 && s->period < longest))
            break;
    }
    return fst_fail(error, FST_NO_CONVERGENCE, "Newton's method",
                    "it did not converge at %.10g: residual %.3g after %d iterations", s->value, s->residual,
                    s->iterations);
}
