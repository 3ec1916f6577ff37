/* spectrum.c - multipliers of orbits and eigenvalues of equilibria.
 *
 * The derivative M of a return (of an equilibrium: the Jacobian) is there from Newton's last iteration, as a 9
 * x 9 matrix in the tangent basis of the first state.  An orbit's M maps the flow direction f onto itself: one
 * eigenvalue is 1 and says nothing.  Left in, it would disturb any multiplier near 1, just where a fold is
 * looked for.  So f is split off by an orthogonal matrix Q whose first column is f/|f|:
 *
 *                   | 1  *  *  * |        first column: exactly this if the orbit were exact; its
 *       Q^T M Q  =  | 0            |        error is reported (trivial_error)
 *                   | 0   reduced  |
 *                   | 0            |        8 x 8: the return to the section across the flow
 *
 * The eigenvalues of the reduced matrix are the multipliers.  For an S2 orbit M belongs to half a turn and the
 * image under S2, so a whole turn has their squares: a multiplier -1 here is where the symmetric orbit splits.
 *
 * Stable means all multipliers within the unit circle, or all real parts of eigenvalues below zero by more
 * than rounding.  Equilibria on the axis do not count as stable: friction does not brake the swing of n about
 * the vertical there, and that pair has the real part zero.
 *
 * At the end of the file: the flow along a solution, and the division of an orbit into segments.
 */
#include "orbit/solution.h"

#include <stdlib.h>
#include <string.h>

#include "base/dot.h"
#include "base/error.h"
#include "ode/flight.h"

enum { SPECTRUM_WORK = 100 }; /* of LAPACK on a matrix of this size, in evaluations of the equations */

/* An orthogonal matrix (by a Householder reflection) whose first column is f/|f|. */
static void reflection(const double *f, double q[FST_TANGENT_SIZE][FST_TANGENT_SIZE])
{
    double u[FST_TANGENT_SIZE];
    const double length = sqrt(fst_dot(f, f, FST_TANGENT_SIZE)), sign = f[0] > 0 ? 1.0 : -1.0;
    for (int i = 0; i < FST_TANGENT_SIZE; ++i)
        u[i] = f[i] / length;
    u[0] += sign;
    const double u2 = fst_dot(u, u, FST_TANGENT_SIZE);
    for (int i = 0; i < FST_TANGENT_SIZE; ++i)
        for (int j = 0; j < FST_TANGENT_SIZE; ++j)
            q[i][j] = -sign * ((i == j ? 1.0 : 0.0) - 2.0 * u[i] * u[j] / u2);
}

/* b = q^T a q */
static void rotate(double q[FST_TANGENT_SIZE][FST_TANGENT_SIZE], double a[FST_TANGENT_SIZE][FST_TANGENT_SIZE],
                   double b[FST_TANGENT_SIZE][FST_TANGENT_SIZE])
{
    enum { N = FST_TANGENT_SIZE };
    double aq[N][N];
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) {
            aq[i][j] = 0.0;
            for (int k = 0; k < N; ++k)
                aq[i][j] += a[i][k] * q[k][j];
        }
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) {
            b[i][j] = 0.0;
            for (int k = 0; k < N; ++k)
                b[i][j] += q[k][i] * aq[k][j];
        }
}

/* The matrix whose eigenvalues count, n x n by rows, and for an orbit the rotation that splits the flow
 * direction off: in its basis the derivative of the return has the first column (1, 0, ..., 0), and the rest of
 * it is the derivative of the return to the section across the flow. */
static fst_status reduced_matrix(const fst_family *family, fst_solution *s, double *matrix,
                                 double q[FST_TANGENT_SIZE][FST_TANGENT_SIZE], fst_error *error)
{
    if (s->segments == 0) {
        memcpy(matrix, s->map, sizeof s->map);
        s->multipliers = FST_TANGENT_SIZE;
        return FST_OK;
    }
    fst_setup setup;
    double f[FST_STATE_SIZE], basis[FST_STATE_SIZE][FST_TANGENT_SIZE], local[FST_TANGENT_SIZE];
    const fst_status status = fst_family_setup(family, s->value, &setup, error);
    if (status != FST_OK)
        return status;
    fst_rhs(&setup.model, s->y[0], f);
    fst_tangent_basis(s->y[0], basis);
    fst_tangent_part(basis, f, local);
    double turned[FST_TANGENT_SIZE][FST_TANGENT_SIZE];
    reflection(local, q);
    rotate(q, s->map, turned);
    s->trivial_error = fabs(turned[0][0] - 1.0);
    s->multipliers = FST_TANGENT_SIZE - 1;
    for (int i = 0; i < s->multipliers; ++i) {
        if (fabs(turned[i + 1][0]) > s->trivial_error)
            s->trivial_error = fabs(turned[i + 1][0]);
        memcpy(matrix + i * s->multipliers, &turned[i + 1][1], (size_t)s->multipliers * sizeof *matrix);
    }
    return FST_OK;
}

fst_status fst_solution_section(const fst_family *family, const fst_solution *s, double *matrix,
                                double basis[FST_STATE_SIZE][FST_TANGENT_SIZE], fst_error *error)
{
    fst_solution copy = *s;
    double q[FST_TANGENT_SIZE][FST_TANGENT_SIZE], tangent[FST_STATE_SIZE][FST_TANGENT_SIZE];
    const fst_status status = reduced_matrix(family, &copy, matrix, q, error);
    fst_tangent_basis(s->y[0], tangent);
    for (int k = 0; k < FST_STATE_SIZE && status == FST_OK; ++k)
        for (int j = 0; j < FST_TANGENT_SIZE; ++j) {
            basis[k][j] = s->segments > 0 ? 0.0 : tangent[k][j];
            for (int i = 0; i < FST_TANGENT_SIZE && s->segments > 0; ++i)
                basis[k][j] += tangent[k][i] * q[i][j];
        }
    return status;
}

/* A contact that comes to rest loses both directions of its slip, and a disc that of its pivoting: so many multipliers
 * are exactly zero, but rounding leaves something of them, which is taken away here. */
static void clear_lost_directions(fst_solution *s, int lost)
{
    int cleared[FST_TANGENT_SIZE] = {0};
    for (int k = 0; k < lost; ++k) {
        int least = -1;
        for (int i = 0; i < s->multipliers; ++i)
            if (!cleared[i] && (least < 0 || hypot(s->re[i], s->im[i]) < hypot(s->re[least], s->im[least])))
                least = i;
        s->re[least] = s->im[least] = 0.0;
        cleared[least] = 1;
    }
}

fst_status fst_solution_spectrum(const fst_family *family, fst_solution *s, fst_error *error)
{
    double matrix[FST_TANGENT_SIZE * FST_TANGENT_SIZE], q[FST_TANGENT_SIZE][FST_TANGENT_SIZE];
    fst_status status = fst_watch_count(family->watch, SPECTRUM_WORK, error);
    if (status == FST_OK)
        status = reduced_matrix(family, s, matrix, q, error);
    if (status != FST_OK)
        return status;
    if (family->lapack->eigen(s->multipliers, matrix, s->re, s->im, NULL) != 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "spectrum", "the eigenvalues at %.10g were not found",
                        s->value);
    if (s->segments > 0 && s->sticks)
        clear_lost_directions(s, family->params.contact_patch == FST_PATCH_POINT ? 2 : 3);
    return FST_OK;
}

fst_status fst_solution_eigenvector(const fst_family *family, const fst_solution *s, double re, double im,
                                    double real[FST_STATE_SIZE], double imaginary[FST_STATE_SIZE],
                                    fst_error *error)
{
    fst_solution copy = *s;
    double matrix[FST_TANGENT_SIZE * FST_TANGENT_SIZE], q[FST_TANGENT_SIZE][FST_TANGENT_SIZE];
    double vectors[FST_TANGENT_SIZE * FST_TANGENT_SIZE], basis[FST_STATE_SIZE][FST_TANGENT_SIZE];
    const fst_status status = reduced_matrix(family, &copy, matrix, q, error);
    if (status != FST_OK)
        return status;
    const int n = copy.multipliers, dropped = FST_TANGENT_SIZE - n;
    if (family->lapack->eigen(n, matrix, copy.re, copy.im, vectors) != 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "spectrum", "the eigenvectors at %.10g were not found",
                        s->value);
    int best = 0;
    for (int i = 1; i < n; ++i)
        if (hypot(copy.re[i] - re, copy.im[i] - im) < hypot(copy.re[best] - re, copy.im[best] - im))
            best = i;
    if (copy.im[best] < 0 && best > 0)
        best -= 1; /* a pair's vectors stand at its first member */
    fst_tangent_basis(s->y[0], basis);
    for (int part = 0; part < (imaginary ? 2 : 1); ++part) {
        double local[FST_TANGENT_SIZE] = {0}, *out = part ? imaginary : real;
        for (int i = 0; i < FST_TANGENT_SIZE; ++i)
            for (int j = 0; j < n; ++j) {
                const double component = vectors[j * n + best + (copy.im[best] != 0 ? part : 0)];
                local[i] += dropped ? q[i][j + 1] * component : (i == j ? component : 0.0);
            }
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            out[k] = fst_dot(basis[k], local, FST_TANGENT_SIZE);
    }
    return FST_OK;
}

int fst_solution_is_stable(const fst_solution *s)
{
    for (int i = 0; i < s->multipliers; ++i)
        if (s->segments > 0 ? hypot(s->re[i], s->im[i]) >= 1.0 : s->re[i] > -1e-13)
            return 0;
    return 1;
}

/* At rest the direction of the flow is mapped to anything; on an orbit onto itself, within what the steps' errors make of
 * it: with dry friction, whose flow has corners, up to some 1e4 times their tolerance. */
int fst_solution_moves(const fst_family *family, const fst_solution *s)
{
    const double exact = fmin(fmax(1e-6, 1e5 * family->tolerance), 1e-2);
    fst_setup setup;
    fst_error ignored;
    double f[FST_STATE_SIZE], greatest = 0.0;
    if (s->segments == 0 || fst_family_setup(family, s->value, &setup, &ignored) != FST_OK)
        return 0;
    fst_rhs(&setup.model, s->y[0], f);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        greatest = fmax(greatest, fabs(f[i]));
    return greatest * s->period > 1e-6 && s->trivial_error < exact;
}

double fst_solution_relaxation(const fst_solution *s)
{
    double slowest = -INFINITY;
    if (!fst_solution_is_stable(s))
        return NAN;
    for (int i = 0; i < s->multipliers; ++i)
        slowest = fmax(slowest, s->segments > 0 ? log(hypot(s->re[i], s->im[i])) / s->period : s->re[i]);
    return -1.0 / slowest;
}

/* ------------------------------------------------------------------ along the orbit */

fst_status fst_solution_flow(const fst_family *family, double value, const double *state, double tolerance,
                             fst_model **model, fst_flow **flow, fst_error *error)
{
    const fst_params params = fst_family_params(family, value);
    *flow = NULL;
    fst_status status = fst_model_new(&params, model, error);
    if (status != FST_OK)
        return fst_watch_end(family->watch, status, error);
    fst_flow_options o = fst_default_flow_options();
    o.rtol = tolerance;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = tolerance;
    status = fst_flow_new(*model, &o, state, flow, error);
    if (status != FST_OK) {
        fst_model_free(*model);
        *model = NULL;
    }
    return fst_watch_end(family->watch, status, error);
}

fst_status fst_solution_advance(const fst_family *family, fst_flow *flow, double time, fst_error *error)
{
    const fst_twofold end = {time, 0.0};
    fst_status status = fst_watch_count(family->watch, 0, error);
    while (status == FST_OK && fst_twofold_difference(end, flow->t) != 0.0) {
        status = fst_flow_step(flow, time, error);
        if (status == FST_OK)
            status = fst_watch_count(family->watch, FST_FLOW_STEP_WORK, error);
    }
    return status;
}

fst_status fst_solution_chain(const fst_family *family, fst_solution *s, int segments, fst_error *error)
{
    fst_model *model;
    fst_flow *flow;
    fst_status status = fst_solution_flow(family, s->value, s->y[0], family->tolerance, &model, &flow, error);
    s->segments = segments;
    for (int i = 1; i < s->segments && status == FST_OK; ++i) {
        status = fst_solution_advance(family, flow, s->period * i / segments, error);
        memcpy(s->y[i], flow->step.end, sizeof s->y[i]);
        if (fst_flight_is_on(flow)) /* which is not a state: one segment has none but the first */
            s->segments = 1;
    }
    fst_flow_free(flow);
    fst_model_free(model);
    return status;
}

/* The middle of the longest time on the plate, and whether the bead flies at all. */
static fst_status longest_on_plate(const fst_family *family, fst_flow *flow, double until, double *middle,
                                   int *flies, fst_error *error)
{
    double touched = 0.0, longest = 0.0;
    fst_status status = FST_OK;
    while (status == FST_OK && flow->t.high < until) {
        status = fst_flow_step(flow, until, error);
        if (status == FST_OK)
            status = fst_watch_count(family->watch, FST_FLOW_STEP_WORK, error);
        if (fst_flight_is_on(flow)) {
            touched = flow->t.high;
        } else if (flow->t.high - touched > longest) {
            longest = flow->t.high - touched;
            *middle = touched + 0.5 * longest;
        }
    }
    *flies = flow->contact.impacts > 0;
    return status;
}

fst_status fst_solution_keep_to_plate(const fst_family *family, fst_solution *s, fst_error *error)
{
    double middle = 0.0;
    int flies = 0;
    for (int pass = 0; pass < 2; ++pass) {
        fst_model *model;
        fst_flow *flow;
        fst_status status =
            fst_solution_flow(family, s->value, s->y[0], family->tolerance, &model, &flow, error);
        if (status == FST_OK && pass == 0 && model->world.kinds.flies)
            status = longest_on_plate(family, flow, 1.5 * s->period, &middle, &flies, error);
        else if (status == FST_OK && pass == 1)
            status = fst_solution_advance(family, flow, middle, error);
        if (status == FST_OK && pass == 1)
            memcpy(s->y[0], flow->step.end, sizeof s->y[0]);
        fst_flow_free(flow);
        fst_model_free(model);
        if (status != FST_OK || !flies)
            return status;
    }
    s->on_section = 0;
    return FST_OK;
}
