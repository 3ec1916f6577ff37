/* beads_cycle.c - periodic orbits of several beads by Newton's method.
 *
 * The map P carries a state along the flow over the period and then renames it: two equal beads are exchanged, or the
 * image under S2 is taken.  On an orbit P(y) = y.  In the basis of directions at y (beads/manifold.h), whose first lies
 * along the flow, Newton's method asks for a correction c across the flow and a change d of the period,
 *
 *     (DP - 1) c + P'f d = -(P(y) - y),     c_0 = 0        DP by differences of whole passages
 *
 *           flow over the period          exchange
 *       y -------------------------> (b, a) ------> (a, b)       two beads opposite each other, after half a turn
 *
 * On an orbit DP keeps the flow direction, so the block across it has the other multipliers.  Contacts must stay as they
 * are: where one opens or closes the map is not smooth.
 */
#include "orbit/beads_cycle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "beads/impact.h"

enum { ITERATIONS = 14, SIDE = BEADS_NUMBERS };
static const double FOUND = 1e-9, STILL = 1e-9;     /* residual and correction, in the units of numbers */
static const double AT_REST = 1e-6, FARTHEST = 1.0; /* speed in these units; a correction */
static const double REACH = 0.25 * BEADS_REACH;     /* what is small at first grows along the way */

typedef struct newton {
    const fst_lapack *lapack;
    const beads_world *world;
    double rtol, most;
    beads_cycle *cycle;
    beads_flow flow;
    beads_manifold manifold;
    double matrix[SIDE * SIDE], jacobian[SIDE * SIDE], right[SIDE], image[BEADS_NUMBERS];
} newton;

static void rename_beads(const beads_world *world, beads_closing closing, double *y)
{
    static const double half_turn[FST_BEAD_NUMBERS] = {-1, -1, 1, -1, -1, 1, 1, 1, -1, -1, -1, 1}; /* S2 */
    for (int i = 0; i < FST_BEAD_NUMBERS; ++i) {
        const double kept = y[i];
        if (closing == BEADS_EXCHANGES) {
            y[i] = y[FST_BEAD_NUMBERS + i];
            y[FST_BEAD_NUMBERS + i] = kept;
        }
        for (int bead = 0; bead < world->count && closing == BEADS_IMAGES; ++bead)
            y[FST_BEAD_NUMBERS * bead + i] *= half_turn[i];
    }
}

static fst_status changed(fst_error *error)
{
    return fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                    "contacts between beads, or with the plate, open and close within a period: orbits through "
                    "impacts and releases are not sought; a run tells their means");
}

/* Along the flow for the time `after`, from y with its contacts as they are; the end is in n->flow. */
static fst_status fly(newton *n, const double *y, double after, fst_error *error)
{
    double start[BEADS_NUMBERS];
    memcpy(start, y, (size_t)(FST_BEAD_NUMBERS * n->world->count) * sizeof *start);
    beads_project(n->world, &n->cycle->modes, start);
    fst_status status = beads_begin(&n->flow, n->world, start, n->rtol, error);
    if (status == FST_OK)
        status = beads_go_to(&n->flow, after, error);
    if (status != FST_OK)
        return status;
    return n->flow.event_count || memcmp(&n->flow.modes, &n->cycle->modes, sizeof n->flow.modes) != 0
               ? changed(error)
               : FST_OK;
}

/* The map P, a beads_map. */
static fst_status pass(void *user, const double *y, double *out, fst_error *error)
{
    newton *n = user;
    const fst_status status = fly(n, y, n->cycle->period, error);
    memcpy(out, n->flow.step.y, (size_t)(FST_BEAD_NUMBERS * n->world->count) * sizeof *out);
    rename_beads(n->world, n->cycle->closing, out);
    return status;
}

/* The flow's direction at y; its length in the units of numbers. */
static double direction_at(const newton *n, const double *y, double *direction)
{
    double dy[BEADS_DIM], unit[BEADS_NUMBERS], square = 0.0;
    beads_look look;
    beads_look_at(n->world, &n->cycle->modes, y, &look);
    beads_derivatives(n->world, &n->cycle->modes, &look, y, dy);
    beads_units(n->world, unit);
    for (int i = 0; i < FST_BEAD_NUMBERS * n->world->count; ++i) {
        direction[i] = dy[i];
        square += dy[i] / unit[i] * (dy[i] / unit[i]);
    }
    return sqrt(square);
}

/* The defect, in n->right. */
static fst_status find_defect(newton *n, fst_error *error)
{
    beads_cycle *c = n->cycle;
    double difference[BEADS_NUMBERS];
    for (int i = 0; i < n->manifold.numbers; ++i)
        difference[i] = c->state[i] - n->image[i];
    beads_components(&n->manifold, difference, n->right);
    c->residual = 0.0;
    for (int i = 0; i < n->manifold.size; ++i)
        c->residual = fmax(c->residual, fabs(n->right[i]));
    return c->iterations == 0 && c->residual > n->most
               ? fst_fail(error, FST_NO_CONVERGENCE, "orbit", "the motion does not come back to itself")
               : FST_OK;
}

/* The basis, DP - 1 in n->matrix, DP in n->jacobian, the defect in n->right. */
static fst_status fill(newton *n, fst_error *error)
{
    beads_cycle *c = n->cycle;
    double along[BEADS_NUMBERS], part[BEADS_NUMBERS];
    const double speed = direction_at(n, c->state, along);
    if (!(speed > AT_REST))
        return fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                        "the beads come to rest in the turning frame: there is no orbit, but a locked state");
    beads_span(n->world, &c->modes, c->state, along, &n->manifold);
    const int size = n->manifold.size;
    fst_status status = pass(n, c->state, n->image, error);
    if (status == FST_OK)
        status = find_defect(n, error);
    if (status == FST_OK)
        status = beads_derivative(&n->manifold, pass, n, c->state, REACH, n->jacobian, error);
    if (status != FST_OK)
        return status;
    (void)direction_at(n, n->image, along);
    beads_components(&n->manifold, along, part);
    c->trivial_error = 0.0;
    for (int i = 0; i < size; ++i) {
        for (int j = 0; j < size; ++j)
            n->matrix[i * size + j] = j == 0 ? part[i] : n->jacobian[i * size + j] - (i == j);
        c->trivial_error = fmax(c->trivial_error, fabs(n->jacobian[i * size] - (i == 0)));
    }
    return FST_OK;
}

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b, p = hypot(x[0], x[1]), q = hypot(y[0], y[1]);
    return p != q ? (p < q) - (p > q) : (x[1] < y[1]) - (x[1] > y[1]);
}

static fst_status find_multipliers(newton *n, fst_error *error)
{
    const int size = n->manifold.size, fewer = size - 1;
    double re[SIDE], im[SIDE], pair[SIDE][2];
    for (int i = 0; i < fewer; ++i)
        for (int j = 0; j < fewer; ++j)
            n->matrix[i * fewer + j] = n->jacobian[(i + 1) * size + j + 1];
    if (n->lapack->eigen(fewer, n->matrix, re, im, NULL) != 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "orbit", "the multipliers were not found");
    for (int i = 0; i < fewer; ++i) {
        pair[i][0] = re[i];
        pair[i][1] = im[i];
    }
    qsort(pair, (size_t)fewer, sizeof *pair, by_size);
    n->cycle->size = fewer;
    for (int i = 0; i < fewer; ++i) {
        n->cycle->re[i] = pair[i][0];
        n->cycle->im[i] = pair[i][1];
    }
    return FST_OK;
}

/* What is seen along the orbit. */
static fst_status describe(newton *n, fst_error *error)
{
    beads_cycle *c = n->cycle;
    const fst_status status = fly(n, c->state, c->period, error);
    const double *integral = n->flow.step.y + FST_BEAD_NUMBERS * n->world->count;
    for (int i = 0; i < n->world->count; ++i) {
        c->mean_r[i] = integral[BEADS_R + i] / c->period;
        c->turned[i] = n->flow.turned[i];
    }
    for (int i = 0; i < BEADS_R; ++i)
        c->power[i] = integral[i] / c->period;
    return status;
}

/* Move by the correction, or by as much of it as is trusted; returns its size. */
static double move(newton *n)
{
    beads_cycle *c = n->cycle;
    double step[BEADS_NUMBERS], greatest = 0.0;
    const double longer = n->right[0];
    n->right[0] = 0.0;
    for (int i = 0; i < n->manifold.size; ++i)
        greatest = isfinite(n->right[i]) ? fmax(greatest, fabs(n->right[i])) : INFINITY;
    greatest = isfinite(longer) ? fmax(greatest, fabs(longer) / (0.1 * c->period)) : INFINITY;
    const double part = greatest > FARTHEST ? FARTHEST / greatest : 1.0;
    beads_vector(&n->manifold, n->right, step);
    for (int i = 0; i < n->manifold.numbers; ++i)
        c->state[i] += part * step[i];
    c->period += part * longer;
    beads_project(n->world, &c->modes, c->state);
    return greatest;
}

static fst_status iterate(newton *n, fst_error *error)
{
    beads_cycle *c = n->cycle;
    double correction = INFINITY;
    beads_project(n->world, &c->modes, c->state);
    for (c->iterations = 0; c->iterations < ITERATIONS; ++c->iterations) {
        fst_status status = fill(n, error);
        if (status != FST_OK)
            return status;
        if (c->residual < FOUND && correction < STILL) {
            status = find_multipliers(n, error);
            return status == FST_OK ? describe(n, error) : status;
        }
        if (n->lapack->solve(n->manifold.size, 1, n->matrix, n->right) != 0)
            break;
        correction = move(n);
        if (!(correction < INFINITY) || !(c->period > 0))
            break;
    }
    return fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                    "Newton's method found no orbit near the start (residual %.3g after %d iterations)",
                    c->residual, c->iterations);
}

fst_status beads_cycle_correct(const fst_lapack *lapack, const beads_world *world, double rtol, double most,
                               beads_cycle *cycle, fst_error *error)
{
    newton *n = malloc(sizeof *n);
    if (!n)
        return fst_fail(error, FST_NO_MEMORY, "orbit", "out of memory");
    n->lapack = lapack;
    n->world = world;
    n->rtol = rtol;
    n->most = most;
    n->cycle = cycle;
    const fst_status status = iterate(n, error);
    free(n);
    return status;
}
