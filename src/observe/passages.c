/* passages.c - integrals over steps in which the bead passes the axis, or its moment the radial direction.
 *
 * Some integrands have local components, along e_r and e_alpha.  These directions do not exist on the axis
 * r = 0, and beside it they turn within b/v, b the distance at which the bead passes it.  Two more (the terms
 * of the printed balances) have the direction of n in the plane (alpha, z), an angle that does not exist where
 * n is along e_r, and turns fast beside it:
 *
 *           n_z                     the integrand, a component of the direction
 *            |      path                        ____
 *       -----+----o------> n_alpha             /           over the step, 1 wide
 *            |  b |                     ______/
 *            0                               b
 *
 * In the magnet's frame nothing of this is seen, so that the steps are much longer than b, and the values at
 * their places say nothing of the turn.  The integrals exist all the same: the integrands are bounded (but
 * one, see below), and go on smoothly through b = 0, where the direction jumps to its opposite.
 *
 * A point on a straight path has its square root sqrt(b^2 + v^2 (t - t0)^2) for a length, with branch points at
 * t0 +- i b/v, and a rule errs by a power of how far these are (integrals.inl), which decides what steps are
 * not resolved, and what pieces of them are: pieces are halved until they are, and then Gauss's rule takes
 * them.
 *
 * One is not bounded: r alpha'^2 grows like b^2/(b^2 + v^2 t^2)^(3/2), a peak whose area, 2 v, does not depend
 * on b.  It is the part of dv_r/dt that comes from the turn of e_r, so that with the acceleration a
 *
 *     integral of r alpha'^2 = change of v_r - integral of a_r,
 *
 * and a_r is bounded.  (v_r is 0 on the axis, half way of its jump.)
 */
#include "observe/passages.h"

#include <math.h>

#include "observe/integrals.inl"

/* In terms of (rho + 1/rho)/2; the rule on pieces then errs by some 1e-12. */
static const double CLEAR = 3.0;

/* The halvings after which a piece is no longer resolved: what it may still hold is 1e-10 of a step. */
enum { MOST_HALVINGS = 34 };

/* Gauss's rule with eight points on [0, 1], by halves. */
enum { POINTS = 8 };
static const double NODE[POINTS / 2] = {0.019855071751231884158, 0.10166676129318663020, 0.23723379504183550709,
                                        0.40828267875217509753};
static const double WEIGHT[POINTS / 2] = {0.050614268145188129576, 0.11119051722668723527,
                                          0.15685332293894364367, 0.18134189168918099148};

/* The quantities that turn with each. */
static const int AT_AXIS[] = {FST_Q_R,         FST_Q_R2,          FST_Q_SLIP_R,       FST_Q_SLIP_ALPHA,
                              FST_Q_SPIN_TERM, FST_Q_CENTRIFUGAL, FST_Q_FORCE_R,      FST_Q_FORCE_R_PRINTED,
                              FST_Q_EQ23,      FST_Q_N_R,         FST_Q_N_ALPHA,      FST_Q_N_RR,
                              FST_Q_N_RALPHA,  FST_Q_N_RZ,        FST_Q_N_ALPHAALPHA, FST_Q_N_ALPHAZ};
static const int AT_POLE[] = {FST_Q_FORCE_R_PRINTED, FST_Q_EQ23};

/* The points whose directions turn. */
typedef struct points {
    double x[2], m[2];
} points;

static points points_of(const double *y)
{
    points p = {.x = {y[FST_X], y[FST_Y]}};
    fst_moment_angle_point_double(y, &p.m[0], &p.m[1]);
    return p;
}

/* Whether a piece with these ends needs halving. */
static int is_close(const points *a, const points *b)
{
    const double limit2 = CLEAR * CLEAR;
    return fst_passage_measure_double(a->x, b->x, limit2) > 0 ||
           fst_passage_measure_double(a->m, b->m, limit2) > 0;
}

/* v_r; 0 on the axis. */
static double radial_velocity(const double *y)
{
    const double r = sqrt(y[FST_X] * y[FST_X] + y[FST_Y] * y[FST_Y]);
    return r > 0 ? (y[FST_X] * y[FST_VX] + y[FST_Y] * y[FST_VY]) / r : 0.0;
}

int fst_passages_of(const fst_flow *flow)
{
    const points a = points_of(flow->step.y), b = points_of(flow->step.end);
    return (fst_passes_closely_double(a.x, b.x, flow->rtol) > 0 ? FST_PASSES_AXIS : 0) |
           (fst_passes_closely_double(a.m, b.m, flow->rtol) > 0 ? FST_PASSES_POLE : 0);
}

/* An integration over pieces of the flow's last step. */
typedef struct pieces {
    fst_flow *flow;
    double r_reference;
    double sums[FST_Q_COUNT];
} pieces;

/* The state at the fraction x, and the points there. */
static points look(const pieces *p, double x, double state[FST_STATE_SIZE])
{
    fst_flow_at(p->flow, x, state);
    return points_of(state);
}

/* Add the integrands at the fraction x with a weight. */
static void add(pieces *p, double x, double weight)
{
    const fst_world_double *c = fst_flow_world(p->flow);
    const double omega = p->flow->step.omega;
    double slope[FST_STATE_SIZE], integrands[FST_Q_COUNT];
    fst_motion_double at;
    fst_pull_double pull;
    fst_seen_double seen;
    fst_flow_motion_at(p->flow, x, &at);
    fst_rhs_double(c, &at.modes, omega, at.numbers, slope, &pull);
    fst_see_double(c, &at.modes, omega, at.numbers, &pull, &seen);
    fst_integrands_double(c, &at.modes, at.numbers, &pull, &seen, p->r_reference, 0.0, integrands);
    /* -a_r: in the magnet's frame the velocity turns besides, by -omega v_alpha. */
    integrands[FST_Q_CENTRIFUGAL] =
        omega * seen.v_alpha - slope[FST_VX] * seen.cos_bead_angle - slope[FST_VY] * seen.sin_bead_angle;
    weight *= fst_pace_double(c, &at.modes, at.numbers);
    for (int i = 0; i < FST_Q_COUNT; ++i)
        p->sums[i] += weight * integrands[i];
}

/* Add the piece between the fractions x0 and x1, where the points are a and b. */
static void add_piece(pieces *p, double x0, double x1, const points *a, const points *b, int halvings)
{
    const double length = x1 - x0, middle = 0.5 * (x0 + x1), h = p->flow->step.h;
    if (!is_close(a, b)) {
        for (int i = 0; i < POINTS / 2; ++i) {
            add(p, x0 + NODE[i] * length, h * length * WEIGHT[i]);
            add(p, x1 - NODE[i] * length, h * length * WEIGHT[i]);
        }
    } else if (halvings == MOST_HALVINGS) {
        add(p, middle, h * length);
    } else {
        double state[FST_STATE_SIZE];
        const points between = look(p, middle, state);
        add_piece(p, x0, middle, a, &between, halvings + 1);
        add_piece(p, middle, x1, &between, b, halvings + 1);
    }
}

void fst_passages_integrate(fst_flow *flow, int passages, double x, double r_reference,
                            double integrals[FST_Q_COUNT])
{
    pieces p = {.flow = flow, .r_reference = r_reference};
    double start[FST_STATE_SIZE], end[FST_STATE_SIZE];
    const points a = look(&p, 0.0, start), b = look(&p, x, end);
    add_piece(&p, 0.0, x, &a, &b, 0);
    p.sums[FST_Q_CENTRIFUGAL] += radial_velocity(end) - radial_velocity(start);
    for (size_t i = 0; (passages & FST_PASSES_AXIS) && i < sizeof AT_AXIS / sizeof *AT_AXIS; ++i)
        integrals[AT_AXIS[i]] = p.sums[AT_AXIS[i]];
    for (size_t i = 0; (passages & FST_PASSES_POLE) && i < sizeof AT_POLE / sizeof *AT_POLE; ++i)
        integrals[AT_POLE[i]] = p.sums[AT_POLE[i]];
}
